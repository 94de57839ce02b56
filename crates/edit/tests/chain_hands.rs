//! The pointer on a chain: picking against every triangle, handles where they are drawn, drags as one step.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{
    ChainEditor, ChainHands, ChainNode, ChainRequest, ChainRoot, ChainShape, ChainSolver, ChainSpot,
    ChainStage, LinkPicker, Modifiers, Sight, chain_axis, chain_handles, chain_span,
};
use glam::{DQuat, DVec3, Vec2, Vec3};
use kin::{Frame, Interval};
use rig::{
    Camera, JointLimit, NewLink, Robot, RobotJoint, RobotJointKind, RobotLink, RobotPose, RobotSkin,
    RootMoves, View, skin_positions,
};

/// A line of links along x, each half a metre, that turn about the y of the root's frame.
fn line(count: usize) -> Robot {
    let root = RobotLink { name: "root".to_owned(), tip: Some(DVec3::X * 0.5), ..RobotLink::default() };
    let mut robot = Robot::new("line", vec![root], Vec::new()).unwrap();
    for i in 1..=count {
        let range = Interval::new(-1.5, 1.5);
        let new = NewLink { name: format!("link{i}"), length: 0.5, range, axis: DVec3::Y };
        robot = robot.appended(i - 1, new).unwrap();
    }
    robot
}

/// A link on a joint of that kind, turned and shifted from the root.
fn one(kind: RobotJointKind) -> Robot {
    let link = |name: &str| RobotLink { name: name.to_owned(), tip: Some(DVec3::X), ..RobotLink::default() };
    let limit = JointLimit { range: Interval::new(-2.0, 2.0), effort: 0.0, velocity: 0.0 };
    let joint = RobotJoint {
        name: "joint".to_owned(),
        kind,
        parent: "root".to_owned(),
        child: "link".to_owned(),
        parent_from_joint: Frame::new(DQuat::from_rotation_z(0.7), DVec3::new(0.1, 0.2, 0.3)),
        axis: DVec3::new(0.0, 0.6, 0.8),
        limit: Some(limit),
        mimic: None,
    };
    Robot::new("one", vec![link("root"), link("link")], vec![joint]).unwrap()
}

fn editor(robot: Robot, values: &[f64]) -> ChainEditor {
    ChainEditor::new(Arc::new(robot), &RobotPose(values.to_vec()))
}

fn sight() -> Sight {
    let camera =
        Camera { target: Vec3::new(0.7, 0.0, 0.0), ..Camera::default().seen_from(View::ThreeQuarter) };
    Sight { camera, size_px: Vec2::new(900.0, 700.0) }
}

fn stage<'a>(editor: &'a ChainEditor, picker: &'a LinkPicker, node: ChainNode) -> ChainStage<'a> {
    let (solver, root) = (ChainSolver::Best, ChainRoot::Held);
    ChainStage { editor, picker, sight: sight(), node, solver, root }
}

const PLAIN: Modifiers = Modifiers { slow: false, snap: false, in_contact: false };

#[test]
fn a_pixel_picks_the_link_whose_triangle_is_first() {
    let editor = editor(line(4), &[0.3, -0.5, 0.8, 0.2]);
    let skin = RobotSkin::of(editor.robot());
    let (picker, palettes) = (LinkPicker::of(&skin), skin.palettes(editor.frames()));
    let posed = skin_positions(&skin.meshes[0], &palettes[0]);
    let mut hits = 0;
    for i in 0..1500 {
        let pixel = Vec2::new((i * 37 % 900) as f32, (i * 101 % 700) as f32);
        let ray = sight().ray(pixel);
        let mut first: Option<(f32, usize)> = None;
        for corners in skin.meshes[0].indices.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|v| posed[v as usize]);
            let normal = (b - a).cross(c - a);
            let far = (a - ray.origin).dot(normal) / ray.direction.dot(normal);
            let at = ray.origin + ray.direction * far;
            let inside =
                [(a, b), (b, c), (c, a)].iter().all(|(p, q)| (*q - *p).cross(at - *p).dot(normal) >= 0.0);
            let link = usize::from(skin.meshes[0].joints[corners[0] as usize][0]);
            if inside && far > 0.0 && first.is_none_or(|(near, _)| far < near) {
                first = Some((far, link));
            }
        }
        let picked = picker.pick(editor.frames(), ray);
        // Where two links meet either may be first.
        if let (Some(hit), Some((far, _))) = (picked, first) {
            hits += 1;
            let off = hit.point_in_world.distance((ray.origin + ray.direction * far).as_dvec3());
            assert!(off < 1e-3, "pixel {pixel}: {off}");
            let back = editor.frames()[hit.link].point(hit.point_in_link);
            assert!(back.distance(hit.point_in_world) < 1e-9);
        }
        assert_eq!(picked.is_some(), first.is_some(), "pixel {pixel}");
    }
    assert!(hits > 20, "{hits}");
}

#[test]
fn axes_are_those_in_which_values_move_the_link() {
    for kind in RobotJointKind::ALL.into_iter().filter(|kind| !kind.parts().is_empty()) {
        let values: Vec<f64> = (0..kind.parts().len()).map(|i| 0.3 - 0.2 * i as f64).collect();
        let editor = editor(one(kind), &values);
        for (i, part) in kind.parts().iter().enumerate() {
            let axis = chain_axis(&editor, 0, *part).unwrap();
            let mut moved = editor.document().clone();
            moved.pose.0[i] += 1e-6;
            let (before, after) = (editor.frames()[1], moved.frames()[1]);
            let way = if part.is_angle() {
                let (turn, angle) = (after.rotation * before.rotation.conjugate()).to_axis_angle();
                turn * angle
            } else {
                after.position - before.position
            };
            assert!(way.distance(axis * 1e-6) < 1e-10, "{kind:?} {part:?}: {way} {axis}");
        }
    }
}

#[test]
fn handles_are_taken_where_they_are_and_turn_or_slide_in_one_step() {
    for kind in
        [RobotJointKind::Revolute, RobotJointKind::Prismatic, RobotJointKind::Planar, RobotJointKind::Ball]
    {
        let count = kind.parts().len();
        for slot in 0..count {
            let mut editor = editor(one(kind), &vec![0.1; count]);
            let picker = LinkPicker::of(&RobotSkin::of(editor.robot()));
            let handles = chain_handles(&editor, ChainNode::Value(0), &sight());
            assert_eq!(handles.len(), count);
            let Some(at) = handles[slot].place(&sight()) else { panic!("{kind:?} is seen") };
            let mut hands = ChainHands::default();
            assert!(hands.press(&stage(&editor, &picker, ChainNode::Value(0)), at));
            let ChainSpot::Handle(taken) = hands.under() else { panic!("{kind:?}: {:?}", hands.under()) };
            // Rings cross each other: another one of the same joint may be nearer there.
            let slot = taken.slot;
            let to = at + Vec2::new(23.0, -17.0);
            let asked = hands.drag(&stage(&editor, &picker, ChainNode::Value(0)), to, PLAIN).unwrap();
            editor.submit(asked).unwrap();
            assert_eq!(
                hands.release(&stage(&editor, &picker, ChainNode::Value(0))),
                None,
                "a drag chooses nothing"
            );
            editor.submit(ChainRequest::Commit).unwrap();
            assert_eq!(editor.undo_depth(), 1);
            for (i, value) in editor.document().pose.0.iter().enumerate() {
                assert_eq!(*value != 0.1, i == slot, "{kind:?} {slot}: {:?}", editor.document().pose);
            }
            if let ChainShape::Ring(circle) = taken.shape {
                assert!((circle.center - editor.frames()[1].position).length() < 1e-9);
            }
        }
    }
}

#[test]
fn a_press_that_goes_nowhere_is_a_click_and_beside_the_chain_nothing() {
    let editor = editor(line(3), &[0.2, 0.2, 0.2]);
    let picker = LinkPicker::of(&RobotSkin::of(editor.robot()));
    let stage = stage(&editor, &picker, ChainNode::Root);
    let mut hands = ChainHands::default();
    let middle = editor.frames()[2].point(DVec3::X * 0.25);
    let at = sight().pixel_of(middle).unwrap();
    assert!(hands.press(&stage, at) && hands.holds());
    assert!(hands.drag(&stage, at + Vec2::splat(1.5), PLAIN).is_none());
    assert_eq!(hands.release(&stage), Some(ChainNode::Value(1)));
    assert!(!hands.press(&stage, Vec2::new(3.0, 3.0)) && !hands.holds());
    assert!(hands.drag(&stage, at, PLAIN).is_none() && hands.release(&stage).is_none());
}

#[test]
fn the_walk_leaves_out_a_root_that_is_held_or_has_a_base() {
    let free = editor(line(2), &[0.0, 0.0]).document().clone();
    let values = [ChainNode::Value(0), ChainNode::Value(1)];
    assert_eq!(ChainNode::all(&free), [&[ChainNode::Root][..], &values].concat());
    let held = edit::ChainDocument { root: RootMoves::Held, ..free };
    assert_eq!(ChainNode::all(&held), values);
    let sliding = editor(one(RobotJointKind::Prismatic), &[0.0]);
    assert_eq!(ChainNode::all(sliding.document()), [ChainNode::Value(0)]);
    assert!(ChainNode::Value(0).is_base(sliding.robot()));
    assert_eq!(ChainNode::of_link(sliding.robot(), 0), ChainNode::Value(0), "the root goes with its base");
    let lone =
        Robot::new("lone", vec![RobotLink { name: "a".to_owned(), ..RobotLink::default() }], Vec::new());
    let lone = editor(lone.unwrap(), &[]);
    assert_eq!(ChainNode::Root.next(lone.document(), true), ChainNode::Root);
}

/// A ball joint with a link of half a metre, and a hinge across it with one of 40 cm that bends up to 150 degrees.
fn limb() -> Robot {
    let link = |name: &str, tip: f64| RobotLink {
        name: name.to_owned(),
        tip: Some(DVec3::X * tip),
        ..RobotLink::default()
    };
    let joint = |kind, [name, parent, child]: [&str; 3], at: f64| RobotJoint {
        name: name.to_owned(),
        kind,
        parent: parent.to_owned(),
        child: child.to_owned(),
        parent_from_joint: Frame::new(DQuat::IDENTITY, DVec3::X * at),
        axis: DVec3::Y,
        limit: Some(JointLimit {
            range: Interval::new(0.0, 150f64.to_radians()),
            effort: 0.0,
            velocity: 0.0,
        }),
        mimic: None,
    };
    let joints = vec![
        joint(RobotJointKind::Ball, ["upper", "root", "upper"], 0.2),
        joint(RobotJointKind::Revolute, ["lower", "upper", "lower"], 0.5),
    ];
    Robot::new("limb", vec![link("root", 0.2), link("upper", 0.5), link("lower", 0.4)], joints).unwrap()
}

#[test]
fn a_limb_s_limits_are_those_of_its_hinge_and_its_middle_swings_about_the_line_to_its_end() {
    let mut editor = editor(limb(), &[0.3, 0.4, 0.5, 1.2]);
    let span = chain_span(&editor, ChainNode::Value(0)).unwrap();
    assert_eq!((span.link, span.joints.as_slice()), (2, &[0, 1][..]));
    assert!((span.outer_m - 0.9).abs() < 1e-9);
    let folded = (0.25f64 + 0.16 + 2.0 * 0.2 * 150f64.to_radians().cos()).sqrt();
    assert!((span.inner_m - folded).abs() < 1e-9, "{}", span.inner_m);
    let circle = span.swing.unwrap();
    let elbow = editor.frames()[2].position;
    assert!(circle.point(0.0).distance(elbow) < 1e-9);
    for angle in [1.0, 2.5, 4.0] {
        let swung = circle.point(angle);
        assert!((swung.distance(span.root_in_world) - 0.5).abs() < 1e-9);
        assert!((swung.distance(span.end_in_world) - 0.4).abs() < 1e-9);
    }
    editor.submit(ChainRequest::Do(edit::ChainCommand::Ranges { on: false })).unwrap();
    let free = chain_span(&editor, ChainNode::Value(3)).unwrap();
    assert!((free.inner_m - 0.1).abs() < 1e-9 && (free.outer_m - 0.9).abs() < 1e-9);
}

#[test]
fn a_longer_line_reaches_as_far_as_its_links_are_long_and_what_doesn_t_turn_nowhere() {
    let long = editor(line(4), &[0.3; 4]);
    let span = chain_span(&long, ChainNode::Value(1)).unwrap();
    assert_eq!((span.link, span.joints.len()), (4, 4));
    assert!((span.outer_m - 2.0).abs() < 1e-9 && span.inner_m == 0.0 && span.swing.is_none());
    let sliding = editor(one(RobotJointKind::Prismatic), &[0.0]);
    assert_eq!(chain_span(&sliding, ChainNode::Value(0)), None);
}
