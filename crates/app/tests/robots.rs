//! Robots and chains as a shell sees them: inspected at joint values, checked, converted.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod shell;

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;
use shell::{Folder, code, posewright, said, text};

fn record(output: &Output) -> Value {
    assert_eq!(code(output), 0, "{}", said(output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn near(found: &Value, expected: &[f64]) -> bool {
    let found = numbers(found);
    found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9)
}

const GRIPPER: &str = r#"<robot name="gripper">
  <link name="base"><visual><geometry><mesh filename="package://gripper/meshes/base.stl"/></geometry></visual></link>
  <link name="arm"/><link name="left"/><link name="right"/>
  <joint name="turn" type="revolute"><origin xyz="0 0 1"/><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="open_left" type="prismatic"><origin xyz="1 0 0"/><parent link="arm"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.1" effort="1" velocity="1"/></joint>
  <joint name="open_right" type="prismatic"><origin xyz="1 0 0"/><parent link="arm"/><child link="right"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.1" effort="1" velocity="1"/><mimic joint="open_left" multiplier="2" offset="0.01"/></joint>
</robot>"#;
const STL: &str = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

#[test]
fn inspect_tells_links_at_joint_values_in_the_root_link_s_frame() {
    let folder = Folder::new();
    let urdf = folder.file("gripper/urdf/gripper.URDF", GRIPPER);
    folder.file("gripper/meshes/base.stl", STL);
    // Beyond its limit, and the follower is named in vain.
    let joints = r#"{"turn": 1.5707963267948966, "open_left": 0.5, "open_right": 9}"#;
    let output = posewright(&["inspect", text(&urdf), "--json", "--joints", joints]);
    let told = record(&output);
    assert_eq!(said(&output), "", "the mesh of the package is found one folder up");
    let links = &told["links"];
    assert!(
        near(&links["base"]["position"], &[0.0; 3])
            && near(&links["base"]["rotation"], &[0.0, 0.0, 0.0, 1.0])
    );
    assert!(near(&links["left"]["position"], &[-0.5, 1.0, 1.0]), "{}", links["left"]);
    assert!(near(&links["right"]["position"], &[1.01, 1.0, 1.0]), "{}", links["right"]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    assert!(near(&links["left"]["rotation"], &[0.0, 0.0, half, half]));
    let right = &told["joints"]["open_right"];
    assert_eq!(
        (right["type"].as_str(), right["mimic"]["joint"].as_str()),
        (Some("prismatic"), Some("open_left"))
    );
    assert!((right["value"].as_f64().unwrap() - 1.01).abs() < 1e-12);
    assert_eq!(told["joints"]["turn"]["upper"], 1.0);
    assert_eq!((told["robot"].as_str(), told["root"].as_str()), (Some("gripper"), Some("base")));
    let rest = record(&posewright(&["inspect", text(&urdf), "--json"]));
    assert!(near(&rest["links"]["right"]["position"], &[1.0, -0.01, 1.0]));
}

#[test]
fn inspect_says_what_is_wrong_with_joint_values() {
    let folder = Folder::new();
    let urdf = folder.file("gripper.urdf", GRIPPER);
    let cases = [
        (r#"{"trun": 1}"#, 1, "joint \"trun\" is not there, did you mean \"turn\"?"),
        (r#"{"turn": "far"}"#, 1, "joint \"turn\" takes one number: turn"),
        (r#"{"turn": [1, 2]}"#, 1, "joint \"turn\" takes one number: turn"),
        ("turn=1", 2, "expected an object such as"),
    ];
    for (joints, expected, sentence) in cases {
        let output = posewright(&["inspect", text(&urdf), "--json", "--joints", joints]);
        assert_eq!(code(&output), expected, "{joints}");
        assert!(said(&output).contains(sentence), "{joints}: {}", said(&output));
        assert!(output.stdout.is_empty());
    }
    let output = posewright(&["inspect", "library:standing.pose.ron", "--joints", "{}"]);
    assert_eq!(code(&output), 2, "a figure has no such joints");
}

#[test]
fn a_missing_mesh_is_a_warning() {
    let folder = Folder::new();
    let urdf = folder.file("gripper.urdf", GRIPPER);
    for arguments in [["inspect", text(&urdf)], ["check", text(&urdf)]] {
        let output = posewright(&arguments);
        assert_eq!(code(&output), 0);
        let told = said(&output);
        assert!(
            told.contains("warning: link \"base\": mesh \"package://gripper/meshes/base.stl\""),
            "{told}"
        );
    }
    folder.file("meshes/base.stl", "solid x\nfacet\n");
    assert!(said(&posewright(&["check", text(&urdf)])).contains("triangle 1"), "a broken one, too");
}

#[test]
fn broken_robots_end_with_exit_code_1_and_their_place() {
    let folder = Folder::new();
    let cases = [
        ("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>", ":4:", "has an axis of no length"),
        ("lower=\"-1\"", "lower=\"3\"", ":5:", "has lower 3 above upper 1"),
        ("joint=\"open_left\"", "joint=\"open_right\"", ":9:", "mimics itself"),
        ("<child link=\"left\"/>", "<child link=\"arm\"/>", ":6:", "is the child of joint"),
        ("<link name=\"left\"/>", "", ":6:", "link \"left\", which is not there"),
        ("</robot>", "", ":1:", "is not closed"),
    ];
    for (from, to, place, sentence) in cases {
        let urdf = folder.file("broken.urdf", GRIPPER.replacen(from, to, 1));
        for task in [&["inspect", "--json"][..], &["check"]] {
            let output = posewright(&[task, &[text(&urdf)]].concat());
            assert_eq!(code(&output), 1, "{to}");
            let told = said(&output);
            assert!(told.contains(&format!("broken.urdf{place}")) && told.contains(sentence), "{told}");
        }
    }
}

#[test]
fn a_figure_becomes_urdf_and_a_figure_of_that_urdf_is_the_same() {
    let folder = Folder::new();
    let urdf = folder.path("body.urdf");
    let output = posewright(&["convert", "library:mannequin.figure.ron", text(&urdf)]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    let based = "(version: 1, base: \"library:mannequin.figure.ron\", skeleton: \"body.urdf\", skin: None)";
    let figure = folder.file("body.figure.ron", based);
    let of = |figure: &str| {
        record(&posewright(&["inspect", "library:waving.pose.ron", "--json", "--figure", figure]))
    };
    let (again, first) = (of(text(&figure)), of("library:mannequin.figure.ron"));
    for (name, limb) in first["limbs"].as_object().unwrap() {
        let (was, is) = (numbers(&limb["articulator"]), numbers(&again["limbs"][name]["articulator"]));
        assert!(was.iter().zip(&is).all(|(a, b)| (a - b).abs() < 1e-9), "{name}: {was:?} {is:?}");
    }
    let upright = record(&posewright(&["inspect", text(&urdf), "--json"]));
    assert!(upright["links"]["head"]["position"][2].as_f64().unwrap() > 1.4, "z is up");
}

#[test]
fn robots_and_chains_become_each_other() {
    let folder = Folder::new();
    let urdf = folder.file("gripper.urdf", GRIPPER);
    let (chain, back) = (folder.path("gripper.chain.ron"), folder.path("back.urdf"));
    for (from, to) in [(&urdf, &chain), (&chain, &back)] {
        assert_eq!(code(&posewright(&["convert", text(from), text(to)])), 0);
    }
    let joints = r#"{"turn": 0.5, "open_left": 0.05}"#;
    let links =
        |path| record(&posewright(&["inspect", text(path), "--json", "--joints", joints]))["links"].clone();
    let first = links(&urdf);
    for path in [&chain, &back] {
        let found = links(path);
        for (name, link) in first.as_object().unwrap() {
            assert!(near(&found[name]["position"], &numbers(&link["position"])), "{name}");
            assert!(near(&found[name]["rotation"], &numbers(&link["rotation"])), "{name}");
        }
    }
    folder.file("meshes/base.stl", STL);
    let elsewhere = folder.file("elsewhere/x.chain.ron", "");
    let named = folder.file("named.urdf", GRIPPER.replace("package://gripper/", ""));
    assert_eq!(code(&posewright(&["convert", text(&named), text(&elsewhere)])), 0);
    let chain = fs::read_to_string(&elsewhere).unwrap();
    assert!(chain.contains("../meshes/base.stl"), "meshes are named from the new place: {chain}");
    assert_eq!(said(&posewright(&["check", text(&elsewhere)])), "");
    let output = posewright(&["convert", text(&urdf), text(&folder.path("x.glb"))]);
    assert_eq!(code(&output), 2);
    assert!(said(&output).contains("becomes a .urdf or a .chain.ron file"), "{}", said(&output));
    assert!(!folder.path("x.glb").exists());
}

#[test]
fn a_chain_file_is_inspected_with_its_own_values_and_checked() {
    let folder = Folder::new();
    let text_of =
        "(version: 1, nodes: {\n\"a\": (length: 1, range: (-90, 90), value: -90),\n\"b\": (length: 1),\n})";
    let chain = folder.file("line.chain.ron", text_of);
    let told = record(&posewright(&["inspect", text(&chain), "--json"]));
    assert!(near(&told["links"]["b"]["position"], &[0.0, 0.0, 1.0]), "{told}");
    let straight = record(&posewright(&["inspect", text(&chain), "--json", "--joints", "{}"]));
    assert!(
        near(&straight["links"]["b"]["position"], &[1.0, 0.0, 0.0]),
        "values named on the command line count alone"
    );
    let broken = folder.file("broken.chain.ron", text_of.replace("(-90, 90)", "(90, -90)"));
    let output = posewright(&["check", text(&chain), text(&broken)]);
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("broken.chain.ron:2:"), "{}", said(&output));
    // What is wrong in the file that it names is told of that file.
    folder.file("gripper.urdf", GRIPPER.replace("lower=\"-1\"", "lower=\"3\""));
    let by_name = folder.file("named.chain.ron", "(version: 1, urdf: \"gripper.urdf\")");
    assert!(said(&posewright(&["check", text(&by_name)])).contains("gripper.urdf:5:"));
}

#[test]
fn every_shipped_script_of_a_chain_runs_and_reaches() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scripts");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if edit::chain_of_script(&fs::read_to_string(&entry).unwrap()).is_none() {
            continue;
        }
        let reports = record(&posewright(&["run", text(&entry), "--report", "-"]));
        for report in reports.as_array().unwrap() {
            assert_eq!(report["clamped"], false, "{}: {}", entry.display(), report["command"]);
            assert!(report["reach"].is_null() || report["reach"]["reached"] == true, "{}", report["command"]);
        }
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn a_chain_that_a_script_has_moved_is_saved_and_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("bend.script.ron");
    let commands = r#"Turn(joint: "lower arm", degrees: -60.0, by: To), Append(to: "shade", name: "tassel", length: 0.05)"#;
    let head = r#"version: 1, chain: "library:desk-lamp.chain.ron""#;
    fs::write(&script, format!("({head}, commands: [{commands}])")).unwrap();
    let saved = folder.path().join("bent.chain.ron");
    let ran = posewright(&["run", text(&script), "--save", text(&saved), "--report", "-"]);
    let links = record(&ran).as_array().unwrap().last().unwrap()["links"].clone();
    let again = folder.path().join("still.script.ron");
    fs::write(&again, r#"(version: 1, chain: "bent.chain.ron", commands: [])"#).unwrap();
    let read = record(&posewright(&["run", text(&again), "--report", "-"]))[0]["links"].clone();
    for (name, link) in links.as_object().unwrap() {
        assert!(near(&read[name]["end"], &numbers(&link["end"])), "{name}: {} and {link}", read[name]);
    }
    assert!(links.as_object().unwrap().contains_key("tassel"));
}
