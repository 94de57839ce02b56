//! The command line as a shell sees it: outputs, exit codes, what is said of bad input.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod shell;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use shell::{Folder, code, posewright, said, text};

fn script(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/scripts").join(name);
    text(&path).to_owned()
}

#[test]
fn run_saves_a_pose_and_reports_every_command() {
    let folder = Folder::new();
    let (pose, report) = (folder.path("end.pose.ron"), folder.path("report.json"));
    let nose = script("fingertip-to-nose.script.ron");
    let output = posewright(&["run", &nose, "--save", text(&pose), "--report", text(&report)]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    let records: Value = serde_json::from_str(&fs::read_to_string(&report).unwrap()).unwrap();
    let records = records.as_array().unwrap();
    assert!(records.len() > 10);
    let rotation = records[0]["joints"]["leftHand"]["rotation"].as_array().unwrap();
    assert_eq!(rotation.iter().map(|v| v.as_f64().unwrap().abs()).collect::<Vec<_>>(), [0.0, 0.0, 0.0, 1.0]);
    for record in records {
        assert!(record["command"].is_string() && record["clamped"].is_boolean());
        assert_eq!(record["joints"].as_object().unwrap().len(), 55);
        assert_eq!(record["limbs"].as_object().unwrap().len(), 4);
        assert_eq!(record["center_of_mass"].as_array().unwrap().len(), 3);
        let arm = &record["limbs"]["leftArm"];
        for key in [
            "contact",
            "articulator",
            "target",
            "residual",
            "rotation_residual",
            "elevation",
            "elevation_range",
            "branch",
        ] {
            assert!(!arm[key].is_null(), "{key}");
        }
    }
    // What was saved is what was reported last, to the last bit.
    let output = posewright(&["inspect", text(&pose), "--json"]);
    let inspected: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(inspected["joints"], records.last().unwrap()["joints"]);
}

#[test]
fn run_starts_on_a_pose() {
    let folder = Folder::new();
    let pose = folder.file("a.pose.ron", "(version: 1, joints: {\"leftLowerArm\": (flexion: 30.0)})");
    let turn = folder.file(
        "a.script.ron",
        "(version: 1, commands: [Turn(joint: \"leftLowerArm\", dof: Flexion, degrees: 12.5, by: Delta)])",
    );
    let output = posewright(&["run", text(&turn), "--on", text(&pose), "--report", "-"]);
    let records: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(records[1]["joints"]["leftLowerArm"]["angles"]["flexion"], 42.5);
}

#[test]
fn render_draws_a_png_of_the_asked_size() {
    let folder = Folder::new();
    for pass in ["color", "depth", "normal", "silhouette", "parts", "openpose"] {
        let png = folder.path(&format!("{pass}.png"));
        let table = script("hand-on-table.script.ron");
        let output = posewright(&["render", &table, "-o", text(&png), "--size", "200x120", "--pass", pass]);
        assert_eq!(code(&output), 0, "{}", said(&output));
        let image = image::open(&png).unwrap().to_rgba8();
        assert_eq!(image.dimensions(), (200, 120));
        let first = *image.get_pixel(100, 60);
        assert!(image.pixels().any(|p| *p != first), "{pass} is one colour");
    }
}

/// The arguments of a small picture.
fn small<'a>(file: &'a str, to: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["render", file, "-o", to, "--size", "60x50"];
    arguments.extend(more);
    arguments
}

#[test]
fn the_same_command_gives_the_same_bytes_in_every_format() {
    let folder = Folder::new();
    let table = script("hand-on-table.script.ron");
    let has_ffmpeg = Command::new("ffmpeg").arg("-version").output().is_ok();
    for (number, (name, options)) in [
        ("a.png", &["--look", "clay", "--wood", "--keypoints", "KEYS"][..]),
        ("a.webp", &["--transparent", "--yaw", "-30", "--zoom", "1.5"]),
        ("moving.webp", &["--turntable", "3"]),
        ("a.gif", &["--turntable", "3", "--transparent", "--ground", "none"]),
        ("a.mp4", &["--turntable", "3", "--fps", "10"]),
        ("{pass}.png", &["--pass", "depth,parts"]),
        ("%02d.png", &["--turntable", "2", "--orthographic"]),
    ]
    .into_iter()
    .enumerate()
    {
        if name.ends_with("mp4") && !has_ffmpeg {
            continue;
        }
        let once = |round: &str| {
            let room = folder.path(&format!("{round}-{number}"));
            fs::create_dir(&room).unwrap();
            let (to, keys) = (room.join(name), room.join("keys.json"));
            let options: Vec<&str> =
                options.iter().map(|o| if *o == "KEYS" { text(&keys) } else { o }).collect();
            let output = posewright(&small(&table, text(&to), &options));
            assert_eq!(code(&output), 0, "{name}: {}", said(&output));
            let mut files: Vec<PathBuf> =
                room.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
            files.sort();
            files
                .iter()
                .map(|f| (f.file_name().unwrap().to_owned(), fs::read(f).unwrap()))
                .collect::<Vec<_>>()
        };
        let first = once("first");
        assert_eq!(first.len(), if name.contains(['%', '{']) || name == "a.png" { 2 } else { 1 }, "{name}");
        assert!(first == once("second"), "{name} differs");
        let holds =
            |words: &str| first.iter().any(|(_, b)| b.windows(words.len()).any(|w| w == words.as_bytes()));
        assert!(holds("hand-on-table") && holds("mannequin"), "{name} names pose and figure");
    }
}

#[test]
fn a_turntable_in_a_folder_has_a_picture_from_each_side() {
    let folder = Folder::new();
    let to = format!("{}/", text(&folder.path("frames")));
    let table = script("hand-on-table.script.ron");
    let output = posewright(&small(&table, &to, &["--turntable", "4", "--view", "front"]));
    assert_eq!(code(&output), 0, "{}", said(&output));
    let frame =
        |i: u32| image::open(folder.path("frames").join(format!("frame-{i:04}.png"))).unwrap().into_rgb8();
    let frames: Vec<_> = (1..=4).map(frame).collect();
    assert!((0..4).all(|i| (0..i).all(|j| frames[i] != frames[j])), "all sides look different");
    assert!(!folder.path("frames").join("frame-0005.png").exists());
}

#[test]
fn a_still_larger_than_the_device_holds_is_whole() {
    let folder = Folder::new();
    let png = folder.path("wide.png");
    let table = script("hand-on-table.script.ron");
    let output =
        posewright(&["render", &table, "-o", text(&png), "--size", "17000x24", "--pass", "silhouette"]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    let image = image::open(&png).unwrap().into_luma8();
    assert_eq!(image.dimensions(), (17000, 24));
    assert!(image.pixels().any(|p| p.0[0] == 255) && image.get_pixel(0, 0).0[0] == 0);
}

#[test]
fn what_an_output_can_t_hold_is_wrong_usage_and_said() {
    let folder = Folder::new();
    let table = script("hand-on-table.script.ron");
    for (name, options, words) in [
        ("a.bmp", &[][..], ".webp"),
        ("a.png", &["--turntable", "3"], "frame-%04d.png"),
        ("a%d.gif", &["--turntable", "3"], "leave the number out"),
        ("a.png", &["--pass", "color,depth"], "{pass}"),
        ("a.mp4", &["--turntable", "3", "--transparent"], "transparent"),
        ("a.webp", &["--turntable", "3", "--keypoints", "k.json"], "points-%04d.json"),
        ("a.gif", &["--frames", "1..10"], "--turntable"),
        ("a.gif", &["--turntable", "0"], "1..=10000"),
        ("a.png", &["--zoom", "nan"], "0.05"),
    ] {
        let output = posewright(&small(&table, text(&folder.path(name)), options));
        assert_eq!(code(&output), 2, "{name} {options:?}: {}", said(&output));
        assert!(said(&output).contains(words), "{name} {options:?}: {}", said(&output));
    }
    assert_eq!(folder.root().read_dir().unwrap().count(), 0, "nothing is written");
}

#[test]
fn without_ffmpeg_an_mp4_is_told_with_the_cure() {
    let folder = Folder::new();
    let film = folder.file("a.mp4", "former");
    let table = script("hand-on-table.script.ron");
    let mut command = Command::new(env!("CARGO_BIN_EXE_posewright"));
    let output =
        command.args(small(&table, text(&film), &["--turntable", "3"])).env("PATH", "").output().unwrap();
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("apt install ffmpeg"), "{}", said(&output));
    assert_eq!(fs::read(&film).unwrap(), b"former");
    assert_eq!(folder.root().read_dir().unwrap().count(), 1, "nothing half is left");
}

#[cfg(unix)]
#[test]
fn a_film_that_is_stopped_leaves_the_former_one_and_nothing_beside_it() {
    let folder = Folder::new();
    let table = script("hand-on-table.script.ron");
    for name in ["a.webp", "a.gif"] {
        let film = folder.file(name, "former");
        let mut command = Command::new(env!("CARGO_BIN_EXE_posewright"));
        let mut program = command.args(small(&table, text(&film), &["--turntable", "9000"])).spawn().unwrap();
        let others = || folder.root().read_dir().unwrap().count() > 1;
        for _ in 0..600 {
            if others() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
        assert!(others(), "{name}: it has begun");
        let stopped = Command::new("kill").args(["-INT", &program.id().to_string()]).status().unwrap();
        assert!(stopped.success());
        assert_eq!(program.wait().unwrap().code(), Some(130), "{name}");
        assert_eq!(fs::read(&film).unwrap(), b"former");
        fs::remove_file(&film).unwrap();
        assert_eq!(folder.root().read_dir().unwrap().count(), 0, "{name}: nothing half is left");
    }
}

#[test]
fn a_sheet_holds_a_tile_for_each_pose_and_look() {
    let folder = Folder::new();
    let pose = folder.file("bow.pose.ron", "(version: 1, joints: {\"spine\": (flexion: 40.0)})");
    let draw = |name: &str, options: &[&str]| {
        let png = folder.path(name);
        let mut arguments = vec!["sheet", text(&pose), "library:thinker.pose.ron", "-o", text(&png)];
        arguments.extend(["--size", "60x80", "--columns", "3"]);
        arguments.extend(options);
        let output = posewright(&arguments);
        assert_eq!(code(&output), 0, "{}", said(&output));
        (fs::read(&png).unwrap(), image::open(&png).unwrap().into_rgb8())
    };
    let (bytes, plain) = draw("plain.png", &[]);
    assert_eq!(plain.dimensions(), (2 * 66 + 6, 86 + 6), "two tiles, 6 pixels between them");
    assert!(draw("again.png", &[]).0 == bytes, "the same bytes each time");
    let (_, labelled) = draw("labels.png", &["--labels", "--look", "studio,clay"]);
    assert_eq!(labelled.dimensions(), (3 * 66 + 6, 2 * (80 + 22 + 6) + 6));
    let bright = |x: std::ops::Range<u32>| {
        x.flat_map(|x| (86..108).map(move |y| (x, y)))
            .filter(|(x, y)| labelled.get_pixel(*x, *y).0[0] > 180)
            .count()
    };
    assert!(bright(6..66) > 20 && bright(72..132) > 20, "each tile has its words below it");
    let output = posewright(&["sheet", text(&pose), "-o", text(&folder.path("a.gif"))]);
    assert_eq!(code(&output), 2);
}

#[test]
fn render_shows_in_the_window_what_is_asked_for() {
    let folder = Folder::new();
    let table = script("hand-on-table.script.ron");
    let draw = |name: &str, options: &[&str]| {
        let png = folder.path(name);
        let mut arguments = vec!["render", &table, "-o", text(&png), "--ui", "--size", "700x500"];
        arguments.extend(options);
        let output = posewright(&arguments);
        assert_eq!(code(&output), 0, "{options:?}: {}", said(&output));
        image::open(&png).unwrap().into_rgb8()
    };
    let plain = draw("plain.png", &[]);
    for options in [
        &["--select", "leftHand,leftLowerArm"][..],
        &["--do", "SecondView,Theme"],
        &["--do", "MatcapLook"],
        &["--look", "clay"],
        &["--guides", "leftArm:outer"],
        &["--pointer", "520,250"],
        &["--pointer", "520,250", "--drag-to", "560,220"],
    ] {
        assert_ne!(draw("shown.png", options), plain, "{options:?}");
    }
}

#[test]
fn bad_input_is_exit_1_with_its_place() {
    let folder = Folder::new();
    let many = "(".repeat(15 << 20);
    let cases: [(&str, String, &str); 9] = [
        ("malformed.pose.ron", "(version: 1,\n joints: {\"head\" (flexion: 3)})".to_owned(), ":2:"),
        ("truncated.pose.ron", "(version: 1,\n joints: {\"head\": (flexi".to_owned(), ":2:"),
        ("version.pose.ron", "(\n version: 99)".to_owned(), ":2:2: version 99"),
        ("bone.pose.ron", "(version: 1, joints: {\n\"tail\": (flexion: 3)})".to_owned(), ":2:"),
        ("field.pose.ron", "(version: 1,\n\n colour: 1)".to_owned(), ":3:"),
        ("nan.pose.ron", "(version: 1, joints: {\"head\": (flexion: NaN)})".to_owned(), ":1:"),
        ("brackets.pose.ron", many, ":1:"),
        ("command.script.ron", "(version: 1, commands: [\n  Fly(limb: LeftArm)])".to_owned(), ":2:"),
        ("bone.script.ron", "(version: 1, commands: [\n\n  Turn(joint: \"leftLowerArm\", dof: Abduction, degrees: 3, by: To)])".to_owned(), ":3:3: Turn: \"leftLowerArm\" has no abduction"),
    ];
    for (name, content, place) in &cases {
        let path = folder.file(name, content);
        let png = folder.file("kept.png", "kept");
        for arguments in [
            vec!["check", text(&path)],
            vec!["inspect", text(&path), "--json"],
            vec!["render", text(&path), "-o", text(&png)],
        ] {
            let output = posewright(&arguments);
            let message = said(&output);
            assert_eq!(code(&output), 1, "{arguments:?}: {message}");
            assert!(message.contains(&format!("{}{place}", path.display())), "{arguments:?}: {message}");
            assert!(output.stdout.is_empty(), "{arguments:?}");
            assert!(!message.contains("panicked"), "{message}");
        }
        assert_eq!(fs::read(&png).unwrap(), b"kept", "nothing is overwritten");
    }
}

#[test]
fn a_hundred_megabytes_of_brackets_are_turned_down() {
    let folder = Folder::new();
    let path = folder.file("brackets.pose.ron", vec![b'['; 100 << 20]);
    let output = posewright(&["check", text(&path)]);
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("brackets.pose.ron:1:1: larger than"), "{}", said(&output));
}

#[test]
fn a_script_that_stops_halfway_saves_nothing() {
    let folder = Folder::new();
    let half = folder.file(
        "half.script.ron",
        "(version: 1, commands: [\n  Ranges(on: false),\n  Handshape(side: Left, name: \"claw\"),\n])",
    );
    let saved = folder.file("kept.pose.ron", "kept");
    let output = posewright(&["run", text(&half), "--save", text(&saved)]);
    assert_eq!(code(&output), 1);
    let message = said(&output);
    assert!(
        message.contains("half.script.ron:3:3:") && message.contains("claw") && message.contains("fist"),
        "{message}"
    );
    assert_eq!(fs::read(&saved).unwrap(), b"kept");
}

#[test]
fn a_save_killed_at_any_moment_leaves_the_former_file_or_the_new_one() {
    let folder = Folder::new();
    let turn = folder.file(
        "a.script.ron",
        "(version: 1, commands: [Turn(joint: \"head\", dof: Twist, degrees: 20, by: To)])",
    );
    let saved = folder.path("a.pose.ron");
    assert_eq!(code(&posewright(&["run", text(&turn), "--save", text(&saved)])), 0);
    let new = fs::read(&saved).unwrap();
    let former = b"(version: 1, joints: {})".to_vec();
    // How long a whole run takes here, so that the kills fall before, in and after the save.
    let start = std::time::Instant::now();
    assert_eq!(code(&posewright(&["run", text(&turn), "--save", text(&saved)])), 0);
    let whole = start.elapsed();
    let (mut former_left, mut new_left) = (0, 0);
    // A machine that has become slower since is given longer.
    for step in 0..400 {
        if step >= 30 && new_left.min(former_left) > 0 {
            break;
        }
        fs::write(&saved, &former).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_posewright"));
        let mut child = command.args(["run", text(&turn), "--save", text(&saved)]).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(f64::from(step) / 22.0));
        let _ = child.kill();
        let _ = child.wait();
        let left = fs::read(&saved).unwrap();
        former_left += u32::from(left == former);
        new_left += u32::from(left == new);
        assert!(left == former || left == new, "half a file after {step}");
    }
    assert!(former_left > 0 && new_left > 0, "{former_left} former, {new_left} new");
}

#[test]
fn check_names_each_fault_and_passes_what_is_good() {
    let folder = Folder::new();
    let good = folder.file("good.pose.ron", "(version: 1, joints: {})");
    assert_eq!(code(&posewright(&["check", text(&good), &script("hand-on-hip.script.ron")])), 0);
    let (a, b) = (folder.file("a.pose.ron", "("), folder.file("b.pose.ron", "(version: 2)"));
    let output = posewright(&["check", text(&a), text(&good), text(&b)]);
    assert_eq!(code(&output), 1);
    let message = said(&output);
    assert!(message.contains("a.pose.ron:") && message.contains("b.pose.ron:1:2: version 2"), "{message}");
    assert!(!message.contains("good.pose.ron"));
}

#[test]
fn files_that_are_missing_or_unknown_are_exit_1() {
    for file in ["missing.pose.ron", "picture.jpeg"] {
        let output = posewright(&["inspect", file]);
        assert_eq!(code(&output), 1);
        assert!(said(&output).contains(file), "{}", said(&output));
    }
}

#[test]
fn wrong_usage_is_exit_2_and_help_is_0() {
    for arguments in [
        vec!["render"],
        vec!["fly"],
        vec!["run", "--loud"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--size", "0x9"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--view", "below"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--select", "head"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--ui", "--select", "haed"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--ui", "--do", "Save"],
        vec!["render", "a.pose.ron", "-o", "a.png", "--ui", "--drag-to", "9,9"],
    ] {
        assert_eq!(code(&posewright(&arguments)), 2, "{arguments:?}");
    }
    for task in ["run", "render", "inspect", "check"] {
        let output = posewright(&[task, "--help"]);
        assert_eq!(code(&output), 0);
        assert!(String::from_utf8_lossy(&output.stdout).contains("Usage"));
    }
}

#[test]
fn without_a_display_the_window_is_exit_3_with_the_cure() {
    let output = posewright(&[]);
    assert_eq!(code(&output), 3, "{}", said(&output));
    let message = said(&output);
    assert!(message.contains("display") && message.contains("render"), "{message}");
}

#[test]
fn without_an_adapter_render_is_exit_3_with_the_cure() {
    let folder = Folder::new();
    let png = folder.path("a.png");
    let mut command = Command::new(env!("CARGO_BIN_EXE_posewright"));
    // No driver is found where the loader looks, and no other backend is asked.
    command
        .env("VK_ICD_FILENAMES", "none.json")
        .env("VK_DRIVER_FILES", "none.json")
        .env("WGPU_BACKEND", "vulkan");
    let table = script("hand-on-table.script.ron");
    let output = command.args(["render", &table, "-o", text(&png)]).output().unwrap();
    assert_eq!(code(&output), 3, "{}", said(&output));
    assert!(said(&output).contains("mesa-vulkan-drivers"), "{}", said(&output));
    assert!(!png.exists());
}
