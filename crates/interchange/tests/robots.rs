//! Robots from URDF: where their links are, what they say of themselves, and that they come back as they were written.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::{DQuat, DVec3};
use interchange::urdf::{figure_robot, read, read_robot, write_robot};
use interchange::{figure, solid};
use proptest::prelude::*;
use rig::{Articulation, Frame, Robot, RobotPose, Shape, Skeleton};

/// A robot of lines "type name parent child | xyz | rpy | axis | more".
fn robot(lines: &str) -> Robot {
    let mut links: Vec<&str> = Vec::new();
    let mut joints = String::new();
    for line in lines.lines().map(str::trim).filter(|l| !l.is_empty()) {
        let parts: Vec<&str> = line.split('|').map(str::trim).collect();
        let words: Vec<&str> = parts[0].split_whitespace().collect();
        let [kind, name, parent, child] = words[..] else { panic!("{line}") };
        for link in [parent, child] {
            if !links.contains(&link) {
                links.push(link);
            }
        }
        let part = |i: usize| parts.get(i).filter(|p| !p.is_empty());
        let xyz = part(1).unwrap_or(&"0 0 0");
        let rpy = part(2).unwrap_or(&"0 0 0");
        let axis = part(3).map_or(String::new(), |a| format!("<axis xyz=\"{a}\"/>"));
        let more = part(4).copied().unwrap_or_default();
        joints += &format!(
            "<joint name=\"{name}\" type=\"{kind}\"><origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><parent link=\"{parent}\"/>\
             <child link=\"{child}\"/>{axis}<limit lower=\"-9\" upper=\"9\" effort=\"1\" velocity=\"1\"/>{more}</joint>\n"
        );
    }
    let links: String = links.iter().map(|l| format!("<link name=\"{l}\"/>\n")).collect();
    let text = format!("<robot name=\"test\">\n{links}{joints}</robot>");
    read_robot(&text).unwrap_or_else(|e| panic!("{e}\n{text}")).0
}

fn posed(robot: &Robot, values: &[(&str, f64)]) -> RobotPose {
    let mut pose = robot.rest();
    for (name, value) in values {
        let slot = robot.slot(robot.joint(name).unwrap_or_else(|| panic!("{name}")));
        assert_eq!(slot.len(), 1, "{name}");
        pose.0[slot.start] = *value;
    }
    pose
}

fn frame(robot: &Robot, pose: &RobotPose, link: &str) -> Frame {
    robot.frames(pose)[robot.link(link).unwrap_or_else(|| panic!("{link}"))]
}

/// Every link within 2e-5, the rounding of the values, of what another program gives.
fn assert_frames(robot: &Robot, pose: &RobotPose, expected: &[(&str, [f64; 3], [f64; 4])]) {
    for (link, place, rotation) in expected {
        let found = frame(robot, pose, link);
        let away = (found.position - DVec3::from_array(*place)).abs().max_element();
        assert!(away < 2e-5, "{link} is at {}, {away} off", found.position);
        let wanted = DQuat::from_array(*rotation);
        let off = |sign: f64| ((found.rotation * sign) - wanted).to_array().map(f64::abs);
        let worst = |sign| off(sign).into_iter().fold(0.0, f64::max);
        assert!(worst(1.0).min(worst(-1.0)) < 2e-5, "{link} is turned {}", found.rotation);
    }
}

// The three tables are from pinocchio 4.1.0 on robots of the same joints: a double pendulum (example-robot-data), the
// excavator ZX120 (PWRI OPERA), the arm Panda (Franka Emika); yourdfpy and MuJoCo agree with it to 1e-12 m.

#[test]
fn a_double_pendulum_hangs_where_pinocchio_says() {
    let robot = robot(
        "continuous joint1 base link1 | 0.0060872 0 0.035 | | 1 0 0
         continuous joint2 link1 link2 | 0.023 0 0.1 | | 1 0 0",
    );
    let pose = posed(&robot, &[("joint1", -2.19381), ("joint2", 2.0846)]);
    assert_frames(
        &robot,
        &pose,
        &[
            ("base", [0.0; 3], [0.0, 0.0, 0.0, 1.0]),
            ("link1", [0.00609, 0.0, 0.035], [-0.8898, 0.0, 0.0, 0.45635]),
            ("link2", [0.02909, 0.08121, -0.02335], [-0.05458, 0.0, 0.0, 0.99851]),
        ],
    );
}

#[test]
fn an_excavator_digs_where_pinocchio_says() {
    // Its first axis is two long.
    let robot = robot(
        "fixed base base_link track_link
         continuous swing track_link body_link | 0 0 1 | | 0 0 2
         revolute boom body_link boom_link | 0.14 -0.16443 0.424 | 0 1.57079632679 0 | 0 1 0
         revolute arm boom_link arm_link | 0 0 4.6 | | 0 1 0
         revolute bucket arm_link bucket_link | 0 0 2.519 | | 0 1 0
         revolute end bucket_link end_link | 0 0 1.23 | 0 0.872664625997 0 | 1 0 0",
    );
    let values =
        [("swing", -2.19381), ("boom", 0.46439), ("arm", 2.14991), ("bucket", 0.20756), ("end", -0.02867)];
    assert_frames(
        &robot,
        &posed(&robot, &values),
        &[
            ("track_link", [0.0; 3], [0.0, 0.0, 0.0, 1.0]),
            ("body_link", [0.0, 0.0, 1.0], [0.0, 0.0, -0.8898, 0.45635]),
            ("boom_link", [-0.21523, -0.01775, 1.424], [0.75708, 0.38828, -0.46752, 0.23977]),
            ("arm_link", [-2.61502, -3.35788, -0.63623], [-0.77141, -0.39563, -0.44347, 0.22744]),
            ("bucket_link", [-1.34486, -1.59002, -1.90379], [-0.72132, -0.36994, -0.521, 0.2672]),
            ("end_link", [-0.66354, -0.64174, -2.29041], [-0.43922, -0.2112, -0.78014, 0.39226]),
        ],
    );
}

#[test]
fn an_arm_and_its_mimicking_finger_are_where_pinocchio_says() {
    let robot = robot(
        "revolute j1 l0 l1 | 0 0 0.333 | | 0 0 1
         revolute j2 l1 l2 | | -1.5707963267948966 0 0 | 0 0 1
         revolute j3 l2 l3 | 0 -0.316 0 | 1.5707963267948966 0 0 | 0 0 1
         revolute j4 l3 l4 | 0.0825 0 0 | 1.5707963267948966 0 0 | 0 0 1
         revolute j5 l4 l5 | -0.0825 0.384 0 | -1.5707963267948966 0 0 | 0 0 1
         revolute j6 l5 l6 | | 1.5707963267948966 0 0 | 0 0 1
         revolute j7 l6 l7 | 0.088 0 0 | 1.5707963267948966 0 0 | 0 0 1
         fixed j8 l7 l8 | 0 0 0.107
         fixed h l8 hand | | 0 0 -0.7853981633974483
         prismatic f1 hand left | 0 0 0.0584 | | 0 1 0
         prismatic f2 hand right | 0 0 0.0584 | | 0 -1 0 | <mimic joint=\"f1\"/>",
    );
    let values = [
        ("j1", -2.11871),
        ("j2", 1.22491),
        ("j3", 1.52847),
        ("j4", -2.30608),
        ("j5", -0.02645),
        ("j6", 1.67708),
        ("j7", 0.87842),
        ("f1", 0.03155),
        // It follows the other finger though it is named.
        ("f2", -7.0),
    ];
    let turned = [-0.79362, 0.08863, 0.13274, 0.58711];
    assert_frames(
        &robot,
        &posed(&robot, &values),
        &[
            ("l3", [-0.15486, -0.25377, 0.44013], [0.55661, -0.14378, -0.23799, 0.78286]),
            ("l5", [0.29867, -0.32117, 0.35672], [0.43461, 0.66301, 0.40621, 0.45445]),
            ("l7", [0.38425, -0.31743, 0.33657], [-0.69929, 0.38559, 0.34731, 0.49162]),
            ("hand", [0.37284, -0.2152, 0.3071], turned),
            ("left", [0.35726, -0.16871, 0.26237], turned),
            ("right", [0.37597, -0.15011, 0.31968], turned),
        ],
    );
}

#[test]
fn values_are_used_as_given_and_mimics_follow_through_each_other() {
    let robot = robot(
        "revolute a root la | | | 0 0 1
         revolute b root lb | | | 0 0 1 | <mimic joint=\"c\" multiplier=\"2\" offset=\"0.5\"/>
         revolute c root lc | | | 0 0 1 | <mimic joint=\"a\" multiplier=\"-1\" offset=\"0.25\"/>",
    );
    let pose = robot.followed(&posed(&robot, &[("a", 20.0), ("b", 1.0), ("c", 1.0)]));
    let value = |name| robot.values(&pose, robot.joint(name).unwrap())[0];
    assert_eq!([value("a"), value("c"), value("b")], [20.0, -19.75, -39.0]);
    let rest = robot.rest();
    assert_eq!(robot.values(&rest, robot.joint("b").unwrap()), [1.0]);
    let clamped = robot.clamped(&pose);
    assert_eq!(robot.values(&clamped, robot.joint("a").unwrap()), [9.0]);
}

#[test]
fn joints_of_several_values_move_in_all_their_ways() {
    let robot = robot(
        "planar p root lp | 1 0 0 | | 0 0 1
         planar q root lq | | | 1 0 0
         floating f root lf | 0 0 1
         spherical s root ls",
    );
    let mut pose = robot.rest();
    let set = |pose: &mut RobotPose, name: &str, values: &[f64]| {
        pose.0[robot.slot(robot.joint(name).unwrap())].copy_from_slice(values);
    };
    set(&mut pose, "p", &[0.5, 0.25, FRAC_PI_2]);
    set(&mut pose, "q", &[0.0, 0.0, FRAC_PI_2]);
    set(&mut pose, "f", &[1.0, 2.0, 3.0, 0.0, 0.0, PI]);
    set(&mut pose, "s", &[FRAC_PI_2, 0.0, FRAC_PI_2]);
    let found = |link: &str| frame(&robot, &pose, link);
    assert!(found("lp").position.abs_diff_eq(DVec3::new(1.5, 0.25, 0.0), 1e-12));
    assert!(found("lp").vector(DVec3::X).abs_diff_eq(DVec3::Y, 1e-12));
    assert!(found("lq").vector(DVec3::Y).abs_diff_eq(DVec3::Z, 1e-12));
    assert!(found("lf").position.abs_diff_eq(DVec3::new(1.0, 2.0, 4.0), 1e-12));
    assert!(found("lf").vector(DVec3::X).abs_diff_eq(DVec3::NEG_X, 1e-12));
    // Roll first, about x, then yaw about the same z as before.
    assert!(found("ls").vector(DVec3::Y).abs_diff_eq(DVec3::Z, 1e-12));
    assert!(found("ls").vector(DVec3::X).abs_diff_eq(DVec3::Y, 1e-12));
}

/// A robot of every kind of joint.
fn every_kind() -> Robot {
    robot(
        "revolute a root l1 | 0.1 0.2 0.3 | 0.4 0.5 0.6 | 1 2 3
         prismatic b l1 l2 | 0 0 1 | | 0 -1 0
         planar c l2 l3 | 1 0 0 | 0 1 0 | 0 1 1
         floating d l3 l4 | 0 1 0
         spherical e l4 l5 | 0 0 1 | 1 0 0
         continuous f l5 l6 | 1 1 1 | 0 0 1 | 1 0 0
         fixed g l6 l7 | 0 0 1 | 1 2 3
         revolute h l7 l8 | 0 0 1 | | 0 0 1 | <mimic joint=\"a\" multiplier=\"0.5\" offset=\"0.1\"/>
         continuous i l1 l9 | 0 0 2 | | 0 0 1",
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_chain_of_nodes_stands_where_its_robot_does(values in prop::collection::vec(-3.0..3.0_f64, 20)) {
        let robot = every_kind();
        let pose = robot.followed(&RobotPose(values[..robot.value_count()].to_vec()));
        let chain = robot.chain(&pose).unwrap();
        let mut frames = Vec::new();
        chain.chain.frames(&chain.values, Frame::IDENTITY, &mut frames).unwrap();
        for (link, frame) in robot.frames(&pose).iter().enumerate() {
            let node = frames[chain.node_of_link[link]];
            prop_assert!(node.position.abs_diff_eq(frame.position, 1e-12));
            prop_assert!(node.rotation.dot(frame.rotation).abs() > 1.0 - 1e-12);
            let joint = chain.joint_of_node(chain.node_of_link[link]);
            prop_assert_eq!(joint, link.checked_sub(1));
        }
        let back = robot.pose_of(&chain, &chain.values, &robot.rest());
        let (was, is) = (robot.frames(&pose), robot.frames(&back));
        for (was, is) in was.iter().zip(&is) {
            prop_assert!(is.position.abs_diff_eq(was.position, 1e-9));
            prop_assert!(is.rotation.dot(was.rotation).abs() > 1.0 - 1e-9);
        }
    }
}

const LOOKS: &str = r#"<robot name="a &amp; b">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="root">
    <inertial><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><mass value="4"/>
      <inertia ixx="1" ixy="0.1" ixz="0.2" iyy="2" iyz="0.3" izz="3"/></inertial>
    <visual name="body"><origin xyz="0 0 1" rpy="0 1.5707963267948966 0"/>
      <geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
    <visual><geometry><cylinder radius="0.5" length="2"/></geometry>
      <material name="red"><color rgba="1 0 0 0.5"/></material></visual>
    <visual><geometry><sphere radius="0.25"/></geometry><material name="red"/></visual>
    <visual><geometry><mesh filename="package://x/a.stl" scale="0.001 0.001 0.001"/></geometry></visual>
    <visual><geometry><capsule radius="0.1" length="1"/></geometry><material name="lost"/></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
    <collision_checking><capsule name="of another program"/></collision_checking>
  </link>
  <link name="tip"/>
  <joint name="slide" type="prismatic">
    <parent link="root"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-0.25" upper="0.5" effort="10" velocity="2"/>
  </joint>
  <transmission name="t"><mass value="none of ours"/></transmission>
</robot>"#;

#[test]
fn looks_masses_and_limits_are_read() {
    let (robot, warnings) = read_robot(LOOKS).unwrap();
    assert_eq!(robot.name(), "a & b");
    let root = &robot.links()[0];
    assert_eq!(root.inertial.unwrap().inertia, [1.0, 0.1, 0.2, 2.0, 0.3, 3.0]);
    assert_eq!(root.visuals[0].shape, Shape::Box(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(root.visuals[0].paint.as_ref().unwrap().rgba, [0.0, 0.0, 1.0, 1.0], "a colour of the robot");
    assert_eq!(root.visuals[2].paint.as_ref().unwrap().rgba, [1.0, 0.0, 0.0, 0.5], "a colour of a link");
    let limit = robot.joints()[0].limit.unwrap();
    assert_eq!((limit.range.min, limit.range.max, limit.effort, limit.velocity), (-0.25, 0.5, 10.0, 2.0));
    assert_eq!(warnings, ["link \"root\": material \"lost\" has no colour"]);
}

fn assert_alike(a: &Robot, b: &Robot) {
    let near = |a: Frame, b: Frame| {
        a.position.abs_diff_eq(b.position, 1e-12) && a.rotation.dot(b.rotation).abs() > 1.0 - 1e-14
    };
    assert_eq!((a.name(), a.links().len()), (b.name(), b.links().len()));
    for (a, b) in a.links().iter().zip(b.links()) {
        assert_eq!(
            (&a.name, a.visuals.len(), a.collisions.len()),
            (&b.name, b.visuals.len(), b.collisions.len())
        );
        for (a, b) in a.visuals.iter().chain(&a.collisions).zip(b.visuals.iter().chain(&b.collisions)) {
            assert_eq!((&a.name, &a.shape, &a.paint), (&b.name, &b.shape, &b.paint));
            assert!(near(a.link_from_visual, b.link_from_visual));
        }
        assert_eq!(a.inertial.map(|i| (i.mass, i.inertia)), b.inertial.map(|i| (i.mass, i.inertia)));
    }
    for (a, b) in a.joints().iter().zip(b.joints()) {
        assert!(near(a.parent_from_joint, b.parent_from_joint), "{}", a.name);
        let mut same = b.clone();
        same.parent_from_joint = a.parent_from_joint;
        assert_eq!(*a, same);
    }
}

#[test]
fn a_robot_that_is_written_comes_back_as_it_was() {
    for robot in [every_kind(), read_robot(LOOKS).unwrap().0] {
        let text = write_robot(&robot);
        let (back, _) = read_robot(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_alike(&robot, &back);
        assert_eq!(write_robot(&back), text, "a second time nothing changes");
    }
}

#[test]
fn a_slide_without_ends_is_written_as_such() {
    let mut joints = robot("prismatic j a b | | | 0 0 1").joints().to_vec();
    joints[0].limit.as_mut().unwrap().range.max = f64::INFINITY;
    let links = robot("prismatic j a b | | | 0 0 1").links().to_vec();
    let endless = Robot::new("endless", links, joints).unwrap();
    let text = write_robot(&endless);
    assert!(text.contains("version=\"1.2\""), "{text}");
    assert_alike(&endless, &read_robot(&text).unwrap().0);
}

/// The skeleton as URDF can say it: without cones.
fn without_cones(skeleton: &Skeleton) -> Vec<rig::Joint> {
    let mut joints: Vec<rig::Joint> = skeleton.joints().cloned().collect();
    for joint in &mut joints {
        if let Articulation::Ball { cone, .. } = &mut joint.articulation {
            *cone = None;
        }
    }
    joints
}

#[test]
fn a_figure_comes_back_from_urdf_with_the_same_skeleton() {
    let figure = figure::bare_mannequin().unwrap();
    let robot = figure_robot(&figure).unwrap();
    let (skeleton, _) = read(&write_robot(&robot), &std::collections::BTreeMap::new()).unwrap();
    let (was, is) = (without_cones(&figure.skeleton), without_cones(&skeleton));
    assert_eq!(was.len(), is.len());
    for (was, is) in was.iter().zip(&is) {
        assert_eq!((was.bone, was.carrier, &was.articulation), (is.bone, is.carrier, &is.articulation));
        assert!(was.offset.abs_diff_eq(is.offset, 1e-12), "{}: {} {}", was.bone, was.offset, is.offset);
        assert!((was.mass - is.mass).abs() < 1e-12, "{}", was.bone);
        assert!(was.center_of_mass.abs_diff_eq(is.center_of_mass, 1e-12), "{}", was.bone);
    }
}

#[test]
fn a_figure_stands_upright_as_a_robot() {
    let robot = figure_robot(&figure::bare_mannequin().unwrap()).unwrap();
    let place = |link| frame(&robot, &robot.rest(), link).position;
    let (head, toes, heel, left) = (place("head"), place("leftToes"), place("leftFoot"), place("leftHand"));
    assert!(head.z > 1.4 && toes.z < 0.1, "z is up: {head} {toes}");
    assert!(toes.x > heel.x + 0.05, "x is ahead: {toes} {heel}");
    assert!(left.y > 0.5, "y is to the left: {left}");
}

#[test]
fn meshes_are_fetched_once_and_what_is_missing_has_a_stand_in() {
    let text = LOOKS
        .replace("<sphere radius=\"0.25\"/>", "<mesh filename=\"package://x/a.stl\"/>")
        .replace("<capsule radius=\"0.1\" length=\"1\"/>", "<mesh filename=\"lost.dae\"/>");
    let (mut robot, _) = read_robot(&text).unwrap();
    let stl = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\nvertex 0 1000 0\nendloop\n\
        endfacet\nendsolid\n";
    let mut asked = Vec::new();
    let missing = robot.fill_meshes(&mut |file| {
        asked.push(file.to_owned());
        if file.ends_with("lost.dae") {
            return Err("no such file".to_owned());
        }
        solid::read(file, stl.as_bytes(), &mut |_| Err(String::new())).map(Arc::new)
    });
    assert_eq!(asked, ["package://x/a.stl", "lost.dae"]);
    assert_eq!(missing, ["link \"root\": mesh \"lost.dae\": no such file; a box stands in"]);
    let visuals = &robot.links()[0].visuals;
    let [_, high] = visuals[3].solid().bounds().unwrap();
    assert!((high.x - 1.0).abs() < 1e-6, "scaled to metres: {high}");
    assert_eq!(visuals[2].solid().colors[0], [1.0, 0.0, 0.0], "the link's paint goes over the mesh's own");
    assert_eq!(visuals[4].solid().colors[0], rig::STAND_IN);
}
