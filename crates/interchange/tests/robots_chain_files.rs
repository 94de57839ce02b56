//! Chain files: what they say is what is read, what is written comes back, and what is broken says where.

use glam::DVec3;
use interchange::chain_file::{ChainFile, ChainFileError, read, write};
use kin::Interval;
use proptest::prelude::*;
use rig::{RobotJointKind, RobotPose, RootMoves, Shape};

const LAMP: &str = r#"// A lamp.
(
    version: 1,
    name: "lamp",
    mode: Planar,
    root: Sideways(-1, 1.5),
    place: (0.5, 0, 0),
    turned: (0, 0, 90),
    base: (name: "foot", tip: (0, 0, 0.05)),
    nodes: {
        "lower": (length: 0.4, range: (-120, 0), value: -60),
        "upper": (length: 0.35, range: (0, 150), value: 80, shape: Rod(0.01), color: (1, 0, 0)),
        "strut": (parent: "foot", length: 0.2, follows: (joint: "lower", times: -1, plus: 10)),
        "shade": (parent: "upper", joint: Ball, value: (10, -20, 30),
            shapes: [(shape: Ball(0.05)), (shape: Cylinder(radius: 0.02, length: 0.1), at: (0, 0, 0.1))]),
        "pull": (parent: "lower", joint: Slider, axis: (0, 0, 2), range: (0, 0.1), value: 0.05,
            at: (0.1, 0, 0), turned: (0, 90, 0), mass: 0.2),
    },
)
"#;

fn chain(text: &str) -> (ChainFile, Vec<String>) {
    read(text, &mut |name| Err(format!("{name} was not expected"))).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn what_a_file_says_is_what_is_read() {
    let (lamp, warnings) = chain(LAMP);
    assert_eq!(warnings, Vec::<String>::new());
    let robot = &lamp.robot;
    assert_eq!((robot.name(), robot.links().len(), lamp.planar), ("lamp", 6, true));
    assert_eq!(lamp.root, RootMoves::Sideways(Interval { min: -1.0, max: 1.5 }));
    assert_eq!(lamp.world_from_root.position, DVec3::new(0.5, 0.0, 0.0));
    // The root's x, turned a quarter about its z, is its y, which lies along the world's -z.
    assert!(lamp.world_from_root.vector(DVec3::X).abs_diff_eq(DVec3::NEG_Z, 1e-12));
    let joint = |name: &str| robot.joint(name).unwrap();
    let degrees = |name: &str| -> Vec<f64> {
        robot.values(&lamp.pose, joint(name)).iter().map(|v| v.to_degrees().round()).collect()
    };
    assert_eq!(degrees("lower"), [-60.0]);
    assert_eq!(degrees("strut"), [70.0], "it follows");
    assert_eq!(degrees("shade"), [10.0, -20.0, 30.0]);
    assert_eq!(robot.values(&lamp.pose, joint("pull")), [0.05]);
    assert_eq!(robot.joints()[joint("strut")].kind, RobotJointKind::Continuous);
    let upper = &robot.links()[robot.link("upper").unwrap()];
    assert_eq!(upper.visuals[0].shape, Shape::Capsule { radius: 0.01, length: 0.35 });
    assert_eq!(upper.visuals[0].paint.as_ref().unwrap().rgba, [1.0, 0.0, 0.0, 1.0]);
    // A hinge turns about y, which brings x down: 60 degrees the other way is up.
    let frames = robot.frames(&lamp.pose);
    let elbow = frames[robot.link("upper").unwrap()].position;
    assert!(
        elbow.abs_diff_eq(DVec3::new(0.2, 0.0, 0.05 + 0.4 * 60_f64.to_radians().sin()), 1e-12),
        "{elbow}"
    );
}

#[test]
fn a_written_chain_comes_back_and_is_written_alike() {
    let (lamp, _) = chain(LAMP);
    let text = write(&lamp);
    let (back, _) = chain(&text);
    assert_eq!(write(&back), text);
    assert_eq!((lamp.root, lamp.planar), (back.root, back.planar));
    let (was, is) = (lamp.robot.frames(&lamp.pose), back.robot.frames(&back.pose));
    for (was, is) in was.iter().zip(&is) {
        assert!(was.position.abs_diff_eq(is.position, 1e-10));
        assert!(was.rotation.dot(is.rotation).abs() > 1.0 - 1e-12);
    }
    for (was, is) in lamp.robot.links().iter().zip(back.robot.links()) {
        assert_eq!((&was.name, was.tip, was.visuals.len()), (&is.name, is.tip, is.visuals.len()));
        for (was, is) in was.visuals.iter().zip(&is.visuals) {
            assert_eq!((&was.shape, &was.paint), (&is.shape, &is.paint));
        }
    }
}

const DIGGER: &str = r#"<robot name="digger"><link name="a"/><link name="b"/>
<joint name="boom" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;

#[test]
fn a_file_may_name_a_urdf_and_is_written_so_again() {
    let text = "(\n    version: 1,\n    mode: Planar,\n    root: Held,\n    urdf: \"digger.urdf\",\n    values: {\n        \"boom\": 30,\n    },\n)\n";
    let mut asked = Vec::new();
    let mut fetch = |name: &str| {
        asked.push(name.to_owned());
        Ok(DIGGER.as_bytes().to_vec())
    };
    let (chain, _) = read(text, &mut fetch).unwrap();
    assert_eq!(asked, ["digger.urdf"]);
    assert!((chain.pose.0[0].to_degrees() - 30.0).abs() < 1e-12);
    assert_eq!(write(&chain), text);
    let broken = DIGGER.replace("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>");
    let error = read(text, &mut |_| Ok(broken.as_bytes().to_vec())).unwrap_err();
    assert_eq!((error.file.as_str(), error.spot.line), ("digger.urdf", 2));
    assert!(error.named("robots/x.chain.ron").to_string().starts_with("robots/digger.urdf:2:"));
}

fn fault(text: &str) -> ChainFileError {
    let mut fetch = |_: &str| Ok(DIGGER.as_bytes().to_vec());
    read(text, &mut fetch).expect_err("the file is broken")
}

/// The lamp with one change: the line where the error is, and what it says.
fn changed(from: &str, to: &str) -> (usize, usize, String) {
    let at = LAMP.find(from).unwrap_or_else(|| panic!("{from:?} is not in the file"));
    let text = format!("{}{to}{}", &LAMP[..at], &LAMP[at + from.len()..]);
    let line = 1 + LAMP[..at].matches('\n').count();
    let error = fault(&text);
    assert!(error.file.is_empty(), "{error}");
    (line, error.spot.line, error.message)
}

#[test]
fn faults_say_what_and_where() {
    let cases = [
        ("length: 0.4", "lenght: 0.4", "lenght"),
        ("name: \"lamp\"", "nmae: \"lamp\"", "nmae"),
        ("Planar", "Flat", "Flat"),
        ("Sideways(-1, 1.5)", "Sideways(2, 1)", "the lower end first"),
        ("range: (-120, 0)", "range: (0, -120)", "expected the lower end first"),
        ("length: 0.4", "length: -1", "length -1, expected metres"),
        ("length: 0.4", "length: 0.4, tip: (1, 0, 0)", "a length or a tip"),
        ("value: -60", "value: (1, 2)", "joint \"lower\" takes turn"),
        ("value: (10, -20, 30)", "value: 3", "takes roll, pitch, yaw"),
        ("value: -60", "value: \"much\"", "a number"),
        ("parent: \"foot\"", "parent: \"fot\"", "did you mean \"foot\"?"),
        ("joint: \"lower\"", "joint: \"lowr\"", "did you mean \"lower\"?"),
        ("joint: \"lower\"", "joint: \"strut\"", "mimics itself"),
        ("joint: \"lower\"", "joint: \"shade\"", "to have one value"),
        ("axis: (0, 0, 2)", "axis: (0, 0, 0)", "no length"),
        ("\"upper\": (", "\"lower\": (", "\"lower\" is given twice"),
        ("joint: Ball", "joint: Ball, range: (0, 1)", "only hinges and sliders have a range"),
        ("mass: 0.2", "mass: -2", "expected kilograms"),
        ("shape: Rod(0.01)", "shape: Rod(0.01), shapes: []", "not both"),
        ("at: (0.1, 0, 0)", "at: (0.1, inf, 0)", "finite"),
        ("version: 1", "version: 7", "version 7"),
    ];
    for (from, to, expected) in cases {
        let (line, at, message) = changed(from, to);
        assert!(message.contains(expected), "{to}: {message}");
        assert_eq!(at, line, "{to}: {message}");
    }
    let (_, _, message) = changed("\"upper\": (", "\"upper\": (parent: \"shade\", ");
    assert!(message.contains("carries itself"), "{message}");
    assert!(fault("(version: 1)").message.contains("missing field `nodes`"));
    assert!(fault("(version: 1, urdf: \"x\", nodes: {})").message.contains("not both"));
    assert!(
        fault("(version: 1, urdf: \"x\", values: {\"bom\": 1})").message.contains("did you mean \"boom\"?")
    );
    assert!(fault("(version: 1, urdf: \"x\", name: \"y\")").message.contains("said by the urdf"));
    assert!(read("(version: 1, urdf: \"x\")", &mut |_| Err("no such file".to_owned())).is_err());
}

#[test]
fn the_chain_of_the_guide_is_one() {
    let guide = include_str!("../../../docs/guide/files.md");
    let example = guide.split("```ron chain\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let (lamp, warnings) = chain(example);
    assert_eq!((lamp.robot.links().len(), lamp.planar, warnings.len()), (4, true, 0));
}

#[test]
fn a_planar_chain_that_leaves_its_plane_is_told() {
    let (_, warnings) = chain(&LAMP.replace("\"upper\": (", "\"upper\": (axis: (1, 0, 0), "));
    assert_eq!(
        warnings,
        ["the chain is planar, but joint \"upper\" turns about another axis than the first"]
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn chains_of_any_length_come_back(
        nodes in prop::collection::vec((0..60_usize, 0.01..2.0_f64, -180.0..180.0_f64, 0..4_u8), 1..60),
        joints in prop::collection::vec(-3.0..3.0_f64, 180),
    ) {
        let mut text = "(version: 1, nodes: {".to_owned();
        for (i, (parent, length, from, kind)) in nodes.iter().enumerate() {
            let parent = if i > 0 && *parent < i { format!("parent: \"n{parent}\", ") } else { String::new() };
            let kind = match kind {
                0 => format!("range: ({from}, {})", from + 40.0),
                1 => "axis: (1, -2, 0.5)".to_owned(),
                2 => format!("joint: Slider, range: ({from}, {})", from + 0.5),
                _ => "joint: Ball".to_owned(),
            };
            text += &format!("\"n{i}\": ({parent}length: {length}, {kind}),");
        }
        text += "})";
        let (mut first, _) = chain(&text);
        first.pose = first.robot.followed(&RobotPose(joints));
        first.pose.0.truncate(first.robot.value_count());
        let written = write(&first);
        let (second, _) = chain(&written);
        prop_assert_eq!(&write(&second), &written);
        let (was, is) = (first.robot.frames(&first.pose), second.robot.frames(&second.pose));
        for (was, is) in was.iter().zip(&is) {
            prop_assert!(was.position.abs_diff_eq(is.position, 1e-7));
            prop_assert!(was.rotation.dot(is.rotation).abs() > 1.0 - 1e-10);
        }
    }

    #[test]
    fn damaged_files_never_panic(at in 0..LAMP.len(), length in 0..30_usize, insert in "[(){}\\[\\]0-9a-z:,.\"-]{0,6}") {
        let mut text = LAMP.to_owned();
        let end = (at + length).min(text.len());
        text.replace_range(at..end, &insert);
        let _ = read(&text, &mut |_| Ok(DIGGER.as_bytes().to_vec()));
    }
}
