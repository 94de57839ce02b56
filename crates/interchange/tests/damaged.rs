//! Damaged files: each kind is an error that names the place and what was expected, and none is a panic.

use std::collections::BTreeMap;

use interchange::figure::{self, FigureError};
use interchange::urdf::{self, UrdfFault};
use proptest::prelude::*;

const URDF: &str = include_str!("../../../assets/figures/mannequin.urdf");
const FIGURE: &str = include_str!("../../../assets/figures/mannequin.figure.ron");

fn urdf_fault(text: &str) -> (usize, usize, String, UrdfFault) {
    let error = urdf::read(text, &BTreeMap::new()).expect_err("the file is damaged");
    (error.spot.line, error.spot.column, error.fault.to_string(), error.fault)
}

/// The text with one place changed, and the line of that place.
fn changed(text: &str, from: &str, to: &str) -> (String, usize) {
    let at = text.find(from).unwrap_or_else(|| panic!("{from:?} is not in the file"));
    (format!("{}{to}{}", &text[..at], &text[at + from.len()..]), 1 + text[..at].matches('\n').count())
}

fn load_with(figure: &str, urdf: &[u8]) -> Result<(), FigureError> {
    let mut fetch = |name: &str| match name {
        "mannequin.urdf" => Ok(urdf.to_vec()),
        "mannequin.glb" => Err("no such file".to_owned()),
        other => Err(format!("{other} was not expected")),
    };
    let skinless = figure.replace("skin: \"mannequin.glb\"", "skin: None");
    figure::load(&skinless, &mut fetch).map(|_| ())
}

/// The figure file with one change: where the error is and what it says.
fn figure_fault(from: &str, to: &str) -> (usize, String) {
    let (text, line) = changed(FIGURE, from, to);
    let error = load_with(&text, URDF.as_bytes()).expect_err("the file is damaged");
    assert_eq!(error.file, "", "{error}");
    assert_eq!(error.line, line, "{error}, after {from:?} became {to:?}");
    assert!(error.column > 0);
    (error.column, error.message)
}

#[test]
fn urdf_syntax() {
    let cases: [(&str, &str, &str); 9] = [
        ("<link name=\"spine\">", "<link name=\"spine>", "is not closed"),
        ("<link name=\"spine\">", "<link name=spine>", "expected =\"…\" after name"),
        ("<link name=\"spine\">", "<link name=\"spine\" name=\"x\">", "has name twice"),
        ("<link name=\"spine_flexion\"/>", "<link name=\"spine_flexion\">", ""),
        ("<parent link=\"hips\"/>", "<parent link=\"hips\"/", "is not closed, expected `>`"),
        ("<child link=\"spine\"/>", "<child link=\"spine\"/></joint></robot><x/>", "second root"),
        ("<link name=\"ground\"/>", "<!DOCTYPE lol>", "have no place"),
        ("<link name=\"ground\"/>", "<!-- oops", "expected `-->`"),
        ("<link name=\"ground\"/>", "</link>", "</link> closes <robot>, expected </robot>"),
    ];
    for (from, to, expected) in cases {
        let (text, line) = changed(URDF, from, to);
        let (at, column, message, fault) = urdf_fault(&text);
        assert!(matches!(fault, UrdfFault::Syntax(_)), "{to}: {fault:?}");
        assert!(message.contains(expected), "{to}: {message}");
        assert!(column > 0);
        if !expected.is_empty() {
            assert_eq!(at, line, "{to}: {message}");
        }
    }
    let (text, line) = changed(URDF, "<link name=\"ground\"/>", "<link name=\"gr&ound\"/>");
    assert_eq!(urdf_fault(&text).0, line, "an entity");
    assert!(urdf_fault("").2.contains("expected a <robot>"));
    assert!(urdf_fault("<sdf/>").2.contains("expected <robot>"));
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(99_999), "</a>".repeat(99_999));
    assert!(urdf_fault(&deep).2.contains("nested deeper"));
}

#[test]
fn urdf_values_name_joint_and_attribute() {
    let axis = "<axis xyz=\"0 0 -1\"/>";
    let cases: [(&str, &str, &str); 10] = [
        (
            axis,
            "<axis xyz=\"0 0\"/>",
            "joint \"spine_abduction\", <axis>: xyz=\"0 0\", expected three finite",
        ),
        (axis, "<axis xyz=\"0 x 0 -1\"/>", "expected three finite numbers"),
        (axis, "<axis xyz=\"0 NaN -1\"/>", "expected three finite numbers"),
        (axis, "<axis/>", "joint \"spine_abduction\", <axis> has no attribute xyz"),
        ("<mass value=\"6.3202\"/>", "<mass value=\"inf\"/>", "link \"spine\", <mass>: value=\"inf\""),
        ("<mass value=\"6.3202\"/>", "<mass/>", "has no attribute value"),
        (
            "<joint name=\"spine_twist\" type=\"revolute\">",
            "<joint name=\"spine_twist\">",
            "no attribute type",
        ),
        ("<joint name=\"spine_twist\" type=\"revolute\">", "<joint type=\"revolute\">", "no attribute name"),
        (
            "name=\"spine_twist\" type=\"revolute\"",
            "name=\"spine_twist\" type=\"hinge\"",
            "type=\"hinge\", expected",
        ),
        ("<link name=\"spine_flexion\"/>", "<link/>", "has no attribute name"),
    ];
    for (from, to, expected) in cases {
        let (text, line) = changed(URDF, from, to);
        let (at, _, message, _) = urdf_fault(&text);
        assert!(message.contains(expected), "{to}: {message}");
        assert_eq!(at, line, "{to}: {message}");
    }
    let (no_child, _) = changed(URDF, "<child link=\"spine\"/>", "");
    assert!(urdf_fault(&no_child).2.contains("joint \"spine_twist\" has no <child>"));
    let start = URDF.find("<limit").unwrap();
    let end = start + URDF[start..].find("/>").unwrap() + 2;
    let no_limit = format!("{}{}", &URDF[..start], &URDF[end..]);
    assert!(urdf_fault(&no_limit).2.contains("joint \"spine_flexion\" has no <limit>"));
}

#[test]
fn urdf_structure_names_joints_and_links() {
    let child = "<child link=\"leftLowerArm\"/>";
    let cases: [(&str, &str, &str); 11] = [
        (
            child,
            "<child link=\"leftLowerArn\"/>",
            "link \"leftLowerArn\", which the file lacks, did you mean \"leftLowerArm\"?",
        ),
        (
            child,
            "<child link=\"leftUpperArm\"/>",
            "joint \"leftUpperArm_twist\" and of joint \"leftLowerArm_twist\"",
        ),
        ("<parent link=\"leftUpperArm\"/>", "<parent link=\"leftHand\"/>", "carries itself"),
        (
            "<link name=\"spine_flexion\"/>",
            "<link name=\"spine_flexion\"/><link name=\"spine_flexion\"/>",
            "link \"spine_flexion\" is given twice",
        ),
        (
            "\"leftLowerArm_twist\" type",
            "\"leftLowerArm_roll\" type",
            "joint \"leftLowerArm_roll\" does not say",
        ),
        (
            "\"leftLowerArm_twist\" type",
            "\"leftLowerArm2_flexion\" type",
            "bone \"leftLowerArm\" has flexion already",
        ),
        (
            "\"leftLowerArm_twist\" type=\"revolute\"",
            "\"leftLowerArm_twist\" type=\"prismatic\"",
            "\"leftLowerArm_twist\" of bone \"leftLowerArm\" is prismatic, expected revolute",
        ),
        (
            "name=\"hips\" type=\"floating\"",
            "name=\"hips\" type=\"planar\"",
            "is planar, expected floating or fixed",
        ),
        (
            "<axis xyz=\"0 0 -1\"/>",
            "<axis xyz=\"0 0 0\"/>",
            "joint \"spine_abduction\" has an axis of no length",
        ),
        (
            "<axis xyz=\"0 0 -1\"/>",
            "<axis xyz=\"0 0.1 -1\"/>",
            "the three axes of bone \"spine\" are not at right angles",
        ),
        (
            "<parent link=\"leftUpperLeg\"/>",
            "<parent link=\"ground\"/>",
            "bone \"leftLowerLeg\" (link \"leftLowerLeg\") is not carried by the hips",
        ),
    ];
    for (from, to, expected) in cases {
        let (text, _) = changed(URDF, from, to);
        let (line, column, message, _) = urdf_fault(&text);
        assert!(message.contains(expected), "{to}: {message}");
        assert!(line > 18 && column > 0, "{to}: {line}:{column} {message}");
    }
    let (moved, _) = changed(URDF, "<origin xyz=\"0 0 0\" rpy", "<origin xyz=\"0 0.1 0\" rpy");
    assert!(urdf_fault(&moved).2.contains("joint \"spine_abduction\" lies 0.1 m beyond"));
    let swapped =
        URDF.replace("spine_flexion\" type", "swap").replace("spine_twist\" type", "spine_flexion\" type");
    let swapped = swapped.replace("swap", "spine_twist\" type");
    assert!(urdf_fault(&swapped).2.contains("not flexion, abduction, twist in that order"));
    let (upside, _) = changed(URDF, "lower=\"-0.15707963267948966\"", "lower=\"1\"");
    assert!(urdf_fault(&upside).2.contains("joint \"spine_flexion\" has lower 1 above upper 0.47"));
}

#[test]
fn urdf_beyond_measure() {
    let links: String = (0..5000).map(|i| format!("<link name=\"l{i}\"/>")).collect();
    assert_eq!(urdf_fault(&format!("<robot>{links}</robot>")).3, UrdfFault::TooMany(5000));
    let huge = " ".repeat(urdf::MAX_BYTES + 1);
    assert!(matches!(urdf_fault(&huge).3, UrdfFault::TooLarge(_)));
    assert!(
        urdf_fault("<robot name=\"x\"><link name=\"spine\"/></robot>").2.contains("not carried by the hips")
    );
    assert!(urdf_fault("<robot name=\"x\"/>").2.contains("\"hips\" is missing"));
}

#[test]
fn turned_frames_come_out_along_the_world() {
    // The same elbow, written in a frame that is turned by 90 degrees about y.
    let upright = "<robot name=\"r\"><link name=\"hips\"/><link name=\"spine\"><inertial><origin xyz=\"0 0 1\"/>\
        <mass value=\"2\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>\
        <link name=\"tool\"><inertial><mass value=\"2\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" \
        izz=\"0\"/></inertial></link><joint name=\"t\" type=\"fixed\"><origin xyz=\"0 0 3\"/><parent link=\"spine\"/>\
        <child link=\"tool\"/></joint><joint name=\"spine_flexion\" type=\"continuous\">\
        <origin xyz=\"0 1 0\" rpy=\"0 1.5707963267948966 0\"/><parent link=\"hips\"/><child link=\"spine\"/>\
        <axis xyz=\"0 0 2\"/></joint></robot>";
    let (skeleton, warnings) = urdf::read(upright, &BTreeMap::new()).unwrap();
    let spine = skeleton.joint(rig::Bone::Spine).unwrap();
    let rig::Articulation::Hinges(hinges) = &spine.articulation else { panic!("one hinge") };
    assert!((hinges[0].axis - glam::DVec3::X).length() < 1e-12);
    assert_eq!(hinges[0].range, kin::Interval::FREE);
    assert_eq!(spine.mass, 4.0);
    assert!(
        (spine.center_of_mass - glam::DVec3::new(2.0, 0.0, 0.0)).length() < 1e-12,
        "{}",
        spine.center_of_mass
    );
    assert_eq!(warnings, ["link \"tool\" is no bone: it moves with the bone that carries it"]);
}

#[test]
fn figure_syntax_has_line_and_column() {
    let cases = [
        ("version: 1", "version: 2", "version 2 is not known"),
        ("name: \"mannequin\"", "nome: \"mannequin\"", "nome"),
        ("name: \"mannequin\"", "name: 3", "string"),
        ("half_angle: 125.0", "half_angel: 125.0", "half_angel"),
        ("\"leftUpperArm\": (axis", "\"leftUperArm\": (axis", "such as \"leftUpperArm\""),
        (
            "\"leftLeg\": (0.0",
            "\"leftLimb\": (0.0",
            "unknown limb \"leftLimb\", expected one of leftArm, rightArm",
        ),
        ("\"flat\": {", "\"relaxed\": {", "\"relaxed\" is given twice"),
    ];
    for (from, to, expected) in cases {
        let (text, line) = changed(FIGURE, from, to);
        let error = load_with(&text, URDF.as_bytes()).expect_err(to);
        assert!(error.message.contains(expected), "{to}: {error}");
        assert!(error.line.abs_diff(line) <= 1 && error.column > 0, "{to}: {error}, expected line {line}");
    }
    assert!(load_with("", b"").is_err());
}

#[test]
fn figure_values_are_checked_at_their_place() {
    let wrist = "\"wrist\": (bone: \"leftHand\", at: (0.0, 0.0, 0.0))";
    let cases = [
        ("\"mannequin\",", "\" \",", "name is empty"),
        ("roles: {}", "roles: { Bone: \"x\" }", ""),
        ("axis: (0.6, -0.1, 0.75)", "axis: (0.0, 0.0, 0.0)", "expected a direction"),
        ("axis: (0.6, -0.1, 0.75)", "axis: (NaN, 0.0, 0.0)", "expected a direction"),
        ("half_angle: 125.0", "half_angle: 181.0", "half_angle is 181"),
        ("half_angle: 125.0", "half_angle: 0.0", "half_angle is 0"),
        (
            "\"leftUpperArm\": (axis",
            "\"leftLowerArm\": (axis",
            "bone \"leftLowerArm\" has a cone, but its joint is not a ball",
        ),
        ("\"leftLeg\": (0.0, -1.0, 0.0)", "\"leftLeg\": (0.0, 0.0, 0.0)", "the base is (0, 0, 0)"),
        (
            wrist,
            "\"wrist\": (bone: \"leftFoot\", at: (0.0, 0.0, 0.0))",
            "\"leftFoot\" can't reach for \"leftArm\"",
        ),
        (
            wrist,
            "\"wrist\": (bone: \"leftUpperArm\", at: (0.0, 0.0, 0.0))",
            "expected \"leftLowerArm\", \"leftHand\"",
        ),
        (wrist, "\"wrist\": (bone: \"leftHand\", at: (inf, 0.0, 0.0))", "expected metres"),
        (
            "\"leftThumbProximal\": (flexion: 10.0)",
            "\"leftThumbProximal\": (flexion: 99.0)",
            "flexion of bone \"leftThumbProximal\" is 99, expected -10 to 60",
        ),
        (
            "\"leftThumbProximal\": (flexion: 10.0)",
            "\"leftThumbProximal\": (flexion: NaN)",
            "is NaN, expected -10 to 60",
        ),
        ("\"leftThumbProximal\": (flexion: 10.0)", "\"leftThumbProximal\": (twist: 1.0)", "has no twist"),
        (
            "\"leftThumbProximal\": (flexion: 10.0)",
            "\"rightThumbProximal\": (flexion: 10.0)",
            "no finger bone of the left hand",
        ),
    ];
    for (from, to, expected) in cases {
        let (_, message) = figure_fault(from, to);
        assert!(message.contains(expected), "{to}: {message}");
    }
    let (text, _) = changed(FIGURE, "\"palm\"", "\"Palm\"");
    let error = load_with(&text, URDF.as_bytes()).unwrap_err();
    assert!(error.message.contains("limb \"leftArm\" has no articulator \"palm\""), "{error}");
}

#[test]
fn a_role_that_the_skeleton_lacks_is_the_figure_files_fault() {
    let (_, message) = figure_fault("roles: {}", "roles: { \"neck\": \"nek\" }");
    assert!(message.contains("link \"nek\", which the file lacks, did you mean \"neck\"?"), "{message}");
}

#[test]
fn faults_of_the_skeleton_name_its_file() {
    let (urdf, line) = changed(URDF, "<axis xyz=\"0 0 -1\"/>", "<axis xyz=\"0\"/>");
    let error = load_with(FIGURE, urdf.as_bytes()).unwrap_err().named("figures/own.figure.ron");
    assert_eq!((error.file.as_str(), error.line), ("figures/mannequin.urdf", line));
    let shown = error.to_string();
    assert!(shown.starts_with(&format!("figures/mannequin.urdf:{line}:11: joint \"spine_abd")), "{shown}");
    let error = load_with(FIGURE, b"<robot>\n\xff").unwrap_err();
    assert_eq!((error.line, error.column), (2, 1), "{error}");
    let (text, line) = changed(FIGURE, "mannequin.urdf", "other.urdf");
    let error = load_with(&text, b"").unwrap_err().named("own.figure.ron");
    assert_eq!((error.file.as_str(), error.line), ("own.figure.ron", line));
    let hinge = URDF.replace("leftLowerLeg_flexion", "leftLowerLeg_twist");
    let error = load_with(FIGURE, hinge.as_bytes()).unwrap_err();
    assert!(error.message.contains("expected a joint leftLowerLeg_flexion"), "{error}");
}

#[test]
fn faults_of_the_skin_name_its_file() {
    let with = |skin: Result<Vec<u8>, String>| {
        let mut fetch = |name: &str| match name {
            "mannequin.urdf" => Ok(URDF.as_bytes().to_vec()),
            _ => skin.clone(),
        };
        figure::load(FIGURE, &mut fetch).map(|_| ()).unwrap_err()
    };
    let error = with(Ok(b"glTF".to_vec())).named("figures/own.figure.ron");
    assert_eq!((error.file.as_str(), error.line), ("figures/mannequin.glb", 0));
    assert!(error.to_string().starts_with("figures/mannequin.glb: "), "{error}");
    let error = with(Err("no such file".to_owned())).named("own.figure.ron");
    let line = 1 + FIGURE[..FIGURE.find("skin:").unwrap()].matches('\n').count();
    assert_eq!(error.to_string(), format!("own.figure.ron:{line}:5: \"mannequin.glb\": no such file"));
}

#[test]
fn what_is_left_out_takes_its_twin_or_its_default() {
    let (text, _) = changed(FIGURE, "\"leftArm\": (0.5, -0.33, 0.8),", "");
    let (text, _) = changed(&text, "\"leftLeg\": (0.0, -1.0, 0.0),", "\"rightLeg\": (0.1, -1.0, 0.0),");
    let skinless = text.replace("\"mannequin.glb\"", "None");
    let mut fetch = |_: &str| Ok(URDF.as_bytes().to_vec());
    let (figure, _) = figure::load(&skinless, &mut fetch).unwrap();
    let [left_arm, right_arm, left_leg, right_leg] = rig::Limb::ALL.map(|limb| figure.limbs.swing_base(limb));
    assert!(left_arm.x > 0.0 && left_arm.x == -right_arm.x);
    assert!(right_leg.x > 0.0 && left_leg.x == -right_leg.x);
    let (text, _) = changed(&skinless, "\"leftLittleDistal\": (flexion: 20.0),", "");
    let (_, warnings) = figure::load(&text, &mut fetch).unwrap();
    assert_eq!(warnings, ["handshape \"relaxed\" leaves bone \"leftLittleDistal\" as it is"]);
}

/// A text damaged in a few places: cut off, or bytes put in, taken out or swapped.
fn damaged(text: &'static str) -> impl Strategy<Value = String> {
    let bits = [
        "", "\"", "<", ">", "/", "(", ")", "{", "}", ":", ",", "-", "1e999", "NaN", "é", "<!--", "<a>", "&",
        "&#0;", "\0", "=", "--",
    ];
    let edit = (0..text.len(), 0..12_usize, proptest::sample::select(bits.to_vec()));
    (proptest::collection::vec(edit, 0..4), proptest::option::of(0..text.len())).prop_map(
        move |(edits, cut)| {
            let mut out = text.to_owned();
            if let Some(cut) = cut {
                out.truncate(out.floor_char_boundary(cut));
            }
            for (at, length, bit) in edits {
                let start = out.floor_char_boundary(at.min(out.len()));
                let end = out.ceil_char_boundary((start + length).min(out.len()));
                out.replace_range(start..end, bit);
            }
            out
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_skeletons_never_panic(text in damaged(URDF)) {
        if let Err(error) = load_with(FIGURE, text.as_bytes()) {
            prop_assert!(!error.message.is_empty());
            prop_assert!(error.line <= 1 + text.matches('\n').count());
        }
    }

    #[test]
    fn damaged_figures_never_panic(text in damaged(FIGURE)) {
        if let Err(error) = load_with(&text, URDF.as_bytes()) {
            prop_assert!(!error.message.is_empty());
            prop_assert!(error.line <= 1 + text.matches('\n').count());
        }
    }

    #[test]
    fn any_text_never_panics(text in "\\PC{0,200}") {
        let _ = urdf::read(&text, &BTreeMap::new());
        let _ = urdf::read(&format!("<robot>{text}</robot>"), &BTreeMap::new());
        let _ = load_with(&text, b"");
    }
}
