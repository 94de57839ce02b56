//! Walks and clips as a shell sees them: reports against what is worked out anew from their numbers, pictures, bad input.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod shell;

use std::fs;

use glam::{DQuat, DVec3};
use motion::Ground;
use serde_json::Value;
use shell::{Folder, code, posewright, said, text};

/// The report of a walk.
fn walk(arguments: &[&str]) -> Value {
    let output = posewright(&[&["walk", "--report", "-"], arguments].concat());
    assert_eq!(code(&output), 0, "{arguments:?}: {}", said(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn point(value: &Value) -> DVec3 {
    DVec3::from_slice(&numbers(value))
}

fn frames(report: &Value) -> &[Value] {
    report["frames"].as_array().unwrap()
}

/// A foot of a frame: sole points, the ground's height under them, whether it stands.
fn foot(frame: &Value, side: &str) -> (Vec<DVec3>, Vec<f64>, bool) {
    let foot = &frame["feet"][side];
    let points = foot["sole_points_in_world"].as_array().unwrap().iter().map(point).collect();
    (points, numbers(&foot["ground_under_sole_points"]), foot["stance"].as_bool().unwrap())
}

fn summary(report: &Value, key: &str) -> f64 {
    report["summary"][key].as_f64().unwrap_or_else(|| panic!("{key}: {}", report["summary"]))
}

/// Penetration and floating of standing soles and their slide within a stance, millimetres, from the frames alone.
fn worked_out(report: &Value) -> [f64; 3] {
    let [mut deep, mut high, mut slide] = [0.0_f64; 3];
    for side in ["left", "right"] {
        let mut touched: Vec<DVec3> = Vec::new();
        for frame in frames(report) {
            let (points, heights, stance) = foot(frame, side);
            if !stance {
                touched.clear();
                continue;
            }
            for (at, height) in points.iter().zip(&heights) {
                deep = deep.max(1000.0 * (height - at.y));
                high = high.max(1000.0 * (at.y - height));
            }
            if touched.is_empty() {
                touched.clone_from(&points);
            }
            for (at, was) in points.iter().zip(&touched) {
                slide = slide.max(1000.0 * DVec3::new(at.x - was.x, 0.0, at.z - was.z).length());
            }
        }
    }
    [deep, high, slide]
}

#[test]
fn the_same_walk_gives_the_same_bytes() {
    let folder = Folder::new();
    let run = |name: &str| {
        let (report, frames) = (folder.path(&format!("{name}.json")), folder.path(&format!("{name}/")));
        let output = posewright(&[
            "walk",
            "--ground",
            "hills",
            "--seed",
            "7",
            "--seconds",
            "1",
            "--fps",
            "4",
            "--size",
            "80x60",
            "--report",
            text(&report),
            "-o",
            text(&frames),
        ]);
        assert_eq!(code(&output), 0, "{}", said(&output));
        let pictures: Vec<Vec<u8>> =
            (1..=4).map(|i| fs::read(frames.join(format!("frame-{i:04}.png"))).unwrap()).collect();
        assert!(!frames.join("frame-0005.png").exists());
        (fs::read(report).unwrap(), pictures)
    };
    let (first, second) = (run("a"), run("b"));
    assert!(first == second);
    assert_ne!(first.1[0], first.1[3], "it moves");
    let image = image::load_from_memory(&first.1[0]).unwrap();
    assert_eq!((image.width(), image.height()), (80, 60));
}

#[test]
fn a_report_has_every_step_of_time_and_the_ground_where_it_is() {
    let report = walk(&["--ground", "slope", "--seconds", "2", "--rate", "50"]);
    assert_eq!(frames(&report).len(), 100);
    let ground = Ground::parse_kind("slope", 1).unwrap();
    for (i, frame) in frames(&report).iter().enumerate() {
        assert!((frame["time"].as_f64().unwrap() - 0.02 * (i + 1) as f64).abs() < 1e-12);
        let weights: f64 = frame["weights"].as_object().unwrap().values().map(|w| w.as_f64().unwrap()).sum();
        assert!((weights - 1.0).abs() < 1e-9, "{weights}");
        assert_eq!(frame["joints"].as_object().unwrap().len(), 55);
        assert_eq!(frame["joints"]["hips"]["position"], frame["hips"]);
        let turn = DQuat::from_slice(&numbers(&frame["joints"]["leftFoot"]["rotation"]));
        assert!((turn.length() - 1.0).abs() < 1e-12);
        for side in ["left", "right"] {
            let (points, heights, _) = foot(frame, side);
            assert!(points.len() >= 4 && points.len() == heights.len());
            for (at, height) in points.iter().zip(&heights) {
                // By default the slope rises by 10 degrees along +Z.
                assert!((height - 10.0_f64.to_radians().tan() * at.z).abs() < 1e-9);
                assert!((height - ground.under(at.x, at.z).height).abs() < 1e-12);
            }
            let ankle = point(&frame["joints"][format!("{side}Foot")]["position"]);
            assert!(points.iter().all(|at| at.distance(ankle) < 0.3), "the sole is at the ankle");
            assert!(frame["feet"][side]["hips_drop"].is_f64());
        }
    }
    let way = point(&frames(&report)[99]["hips"]) - point(&frames(&report)[49]["hips"]);
    assert!((way.z - 1.4).abs() < 0.1 && way.x.abs() < 0.1, "a second at 1.4 m/s: {way}");
}

#[test]
fn the_summary_says_what_the_frames_say() {
    let report = walk(&["--ground", "hills", "--seed", "3", "--seconds", "6"]);
    let [deep, high, slide] = worked_out(&report);
    for (key, found) in [("penetration_mm", deep), ("float_mm", high)] {
        assert!((summary(&report, key) - found).abs() < 1e-6, "{key}: {found} {}", report["summary"]);
    }
    // A slide is told of whichever two moments of a stance are farthest apart.
    let told = summary(&report, "slide_mm");
    assert!(told >= slide - 1e-6 && told <= 2.0 * slide + 1e-6, "{slide} {told}");
    let keys: Vec<&String> = report["summary"].as_object().unwrap().keys().collect();
    assert!(keys.len() >= 4 && summary(&report, "pop_deg") > 0.0, "{keys:?}");
}

#[test]
fn standing_soles_keep_to_the_hills() {
    for seed in ["1", "2"] {
        let report = walk(&["--ground", "hills", "--seed", seed, "--speed", "1.4", "--seconds", "10"]);
        let standing = |side| frames(&report).iter().filter(|frame| foot(frame, side).2).count();
        assert!(standing("left") > 100 && standing("right") > 100, "they do stand");
        let [deep, high, slide] = worked_out(&report);
        assert!(deep <= 10.0 && high <= 10.0 && slide <= 8.0, "seed {seed}: {deep} {high} {slide}");
        assert!(summary(&report, "pop_ratio") <= 1.5, "{}", report["summary"]);
    }
}

#[test]
fn without_foot_placement_the_faults_are_seen() {
    let with = walk(&["--ground", "hills", "--seconds", "6"]);
    let without = walk(&["--ground", "hills", "--seconds", "6", "--no-foot-placement"]);
    let off = |report: &Value| summary(report, "penetration_mm").max(summary(report, "float_mm"));
    assert!(off(&without) > 5.0 * off(&with) && off(&without) > 50.0, "{} {}", off(&without), off(&with));
}

#[test]
fn every_figure_walks_on_every_ground() {
    for figure in ["child", "elderly", "heroic", "man", "woman", "mannequin"] {
        let file = format!("library:{figure}.figure.ron");
        let report = walk(&["--ground", "hills", "--seconds", "3", "--figure", &file]);
        let last = frames(&report).last().unwrap();
        assert!(point(&last["hips"]).z > 2.0, "{figure} gets on");
        assert!(summary(&report, "penetration_mm") < 12.0, "{figure}: {}", report["summary"]);
    }
    for ground in ["flat", "slope", "stairs", "stones"] {
        let report = walk(&["--ground", ground, "--seconds", "3"]);
        assert!(point(&frames(&report).last().unwrap()["hips"]).z > 2.0, "{ground}");
    }
}

#[test]
fn speeds_from_standing_to_jogging() {
    for (speed, sideways) in [("0", "0"), ("0.5", "0"), ("2.6", "0"), ("0", "0.6")] {
        let report = walk(&["--speed", speed, "--sideways", sideways, "--seconds", "4"]);
        let at = |i: usize| point(&frames(&report)[i]["hips"]);
        let found = (at(239) - at(119)) / 2.0;
        let asked = [sideways, speed].map(|v| v.parse::<f64>().unwrap());
        assert!((found.x - asked[0]).abs() < 0.1 && (found.z - asked[1]).abs() < 0.15, "{asked:?}: {found}");
    }
}

/// A ramp of two triangles that rises by half a metre a metre along +Z.
const RAMP: &str = "v -40 -20 -40\nv 40 -20 -40\nv 40 20 40\nv -40 20 40\nf 1 3 2\nf 1 4 3\n";

#[test]
fn the_ground_of_a_file_is_walked_on_and_drawn() {
    let folder = Folder::new();
    let gentle = RAMP.replace("20", "8");
    let obj = folder.file("ramp.obj", &gentle);
    let corner = |i: usize| gentle.lines().nth(i - 1).unwrap().trim_start_matches("v ").to_owned();
    let facet = |a, b, c| {
        let corners = [a, b, c].map(|i| format!("vertex {}\n", corner(i))).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let stl = format!("solid ramp\n{}{}endsolid\n", facet(1, 3, 2), facet(1, 4, 3));
    let stl = folder.file("ramp.STL", stl);
    let reports = [&obj, &stl].map(|file| walk(&["--ground", text(file), "--seconds", "2"]));
    assert_eq!(reports[0], reports[1], "the same triangles");
    for frame in frames(&reports[0]) {
        let (points, heights, _) = foot(frame, "left");
        for (at, height) in points.iter().zip(&heights) {
            assert!((height - 0.2 * at.z).abs() < 1e-6, "{at} {height}");
        }
    }
    assert!(point(&frames(&reports[0]).last().unwrap()["hips"]).y > 1.1, "it climbs");
    let png = folder.path("a.png");
    let output = posewright(&[
        "walk",
        "--ground",
        text(&obj),
        "--seconds",
        "0.01",
        "-o",
        text(&png),
        "--size",
        "90x60",
    ]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert!(png.exists());
}

#[test]
fn bad_walks_say_why_in_a_sentence() {
    let folder = Folder::new();
    let broken = folder.file("broken.obj", "v 0 0 0\nv 1 0\n");
    let empty = folder.file("empty.stl", "");
    let glb = folder.file("no.glb", "nothing");
    let wall = folder.file("wall.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    let tree = folder.file("odd.blend.ron", "(version: 1,\n root: Clip(name: \"wlak\"))");
    let syntax = folder.file("broken.blend.ron", "(version: 1,\n root: Clip(nam: \"walk\"))");
    let missing = folder.path("none/report.json");
    let report = folder.path("a.json");
    let cases: &[(&[&str], i32, &str)] = &[
        (&["--speed", "-1"], 2, "expected metres a second from 0 to"),
        (&["--speed", "NaN"], 2, "expected metres a second from 0 to"),
        (&["--speed", "1e9"], 2, "expected metres a second from 0 to"),
        (&["--seconds", "0"], 2, "more than 0"),
        (&["--seconds", "inf"], 2, "more than 0"),
        (&["--rate", "0"], 2, "--rate"),
        (&["--turn", "x"], 2, "degrees a second"),
        (&["--sideways", "-13"], 2, "from -12 to 12"),
        (&["--seed", "-3"], 2, "--seed"),
        (&["--ground", "hils"], 2, "did you mean \"hills\"?"),
        (&["--ground", "grass.txt"], 1, "grass.txt"),
        (&["--ground", text(&broken)], 1, "broken.obj:1:1: "),
        (&["--ground", text(&empty)], 1, "empty.stl:1:1: "),
        (&["--ground", text(&glb)], 1, "no.glb:1:1: "),
        (&["--ground", text(&wall)], 1, "wall.obj:1:1: "),
        (&["--ground", "none.obj"], 1, "none.obj: no such file"),
        (&["--tree", text(&tree)], 1, "odd.blend.ron:2:"),
        (&["--tree", text(&syntax)], 1, "broken.blend.ron:2:"),
        (&["--tree", "library:wlk.blend.ron"], 1, "did you mean"),
        (&["--figure", "none.figure.ron"], 1, "none.figure.ron"),
        (&["--report", text(&missing)], 1, "report.json: no such file or folder"),
        (&["-o", "walk.bmp"], 2, ".webp"),
        (&["-o", "walk.png"], 2, "several frames need a folder"),
        (&["-o", "none/at/all/"], 1, "none/at/all"),
        (&["-o", "walk.mp4", "--transparent"], 2, "can't be transparent"),
        (&["--fps", "100"], 2, "steps of time"),
    ];
    for (arguments, expected, sentence) in cases {
        let short = ["walk", "--seconds", "0.2", "--size", "40x30"];
        let told = if arguments.contains(&"--seconds") { &short[..1] } else { &short[..] };
        let mut told = [told, arguments].concat();
        if !arguments.contains(&"--report") {
            told.extend(["--report", text(&report)]);
        }
        let output = posewright(&told);
        assert_eq!(code(&output), *expected, "{arguments:?}: {}", said(&output));
        assert!(said(&output).contains(sentence), "{arguments:?}: {}", said(&output));
        assert!(!said(&output).contains("panicked"), "{arguments:?}");
    }
}

#[test]
fn clips_and_trees_are_checked_with_the_place_of_the_fault() {
    let folder = Folder::new();
    let good = folder.file(
        "nod.clip.ron",
        "(version: 1, name: \"nod\", length: 1.0, loops: true,\n joints: {\"head\": (keys: [(0.0, (flexion: 0.0)), (0.5, (flexion: 20.0))])})",
    );
    let tree = folder.file("nod.blend.ron", "(version: 1, root: Clip(name: \"nod\"))");
    let output = posewright(&["check", text(&good), text(&tree), "library:walk.clip.ron"]);
    assert_eq!((code(&output), said(&output).as_str()), (0, ""));
    let report = walk(&["--tree", text(&tree), "--seconds", "1"]);
    assert_eq!(frames(&report)[0]["weights"]["nod"], 1.0, "the clip beside the tree is played");
    let bad = fs::read_to_string(&good).unwrap().replace("\"head\"", "\"haed\"");
    let bad = folder.file("bad.clip.ron", bad);
    let lost = folder.file("lost.blend.ron", "(version: 1,\n root: Clip(name: \"lost\"))");
    let output = posewright(&["check", text(&bad), text(&lost)]);
    assert_eq!(code(&output), 1);
    let told = said(&output);
    assert!(told.contains("bad.clip.ron:2:") && told.contains("lost.blend.ron:2:"), "{told}");
}

#[test]
fn a_clip_is_drawn_whole_in_part_and_as_it_begins() {
    let folder = Folder::new();
    let draw = |to: &str, more: &[&str]| {
        let to = folder.path(to);
        let small = ["render", "library:walk.clip.ron", "-o", text(&to), "--size", "60x80"];
        let output = posewright(&[&small, more].concat());
        assert_eq!(code(&output), 0, "{more:?}: {}", said(&output));
        fs::read(to).unwrap_or_default()
    };
    let begins = draw("a.png", &[]);
    assert_eq!(begins, draw("b.png", &["--frames", "0"]));
    assert_ne!(begins, draw("c.png", &["--frames", "6"]));
    draw("part-%03d.png", &["--frames", "4..6", "--fps", "12"]);
    let written = |i: usize| folder.path(&format!("part-{i:03}.png")).exists();
    assert_eq!([1, 2, 3, 4].map(written), [true, true, true, false]);
    assert!(!draw("d.gif", &["--fps", "10"]).is_empty());
    for (arguments, expected) in [
        (&["library:walk.clip.ron", "--frames", "7..3"][..], 2),
        (&["library:standing.pose.ron", "--frames", "1..2"], 2),
    ] {
        let to = folder.path("no.png");
        let output = posewright(&[&["render", "-o", text(&to)], arguments].concat());
        assert_eq!(code(&output), expected, "{}", said(&output));
        assert!(said(&output).contains("--frames"), "{}", said(&output));
    }
    let output = posewright(&["inspect", "library:walk.clip.ron", "--json"]);
    assert_eq!(code(&output), 0, "{}", said(&output));
}
