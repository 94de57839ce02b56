//! A chain drawn by one point: the point gets there, the body follows as a rope does, and ranges hold.

mod chains;
mod seeded;

use chains::{Kind, goal_of, kind, line, pose};
use glam::{DQuat, DVec3};
use kin::Frame;
use kin::chain::{Chain, Goal, Joint, Node, Options, Place, Root, Solved, Value};
use seeded::Seeded;

fn root() -> Frame {
    Frame::new(DQuat::from_rotation_z(0.7), DVec3::new(0.1, -2.0, 0.4))
}

fn drawn(chain: &Chain, start: &[Value], at: Frame, goal: Goal) -> Solved {
    let goal = Goal { root: Root::Follows, ..goal };
    chain.solve(start, at, &goal, &Options::of(chain)).expect("a sound problem")
}

fn places(chain: &Chain, solved: &Solved) -> Vec<Place> {
    chain.place(&solved.values, solved.world_from_root).expect("a sound problem")
}

#[test]
fn the_head_gets_there_and_the_body_keeps_its_ranges() {
    for seed in 0..5000 {
        let mut seeded = Seeded(seed);
        let (kind, links) = (kind(&mut seeded), seeded.between(1.0, 31.0) as usize);
        let chain = line(&mut seeded, kind, links, seed % 2 == 0);
        let start = pose(&mut seeded, &chain);
        let mut goal = goal_of(&chain, &start, root());
        goal.target += seeded.direction() * seeded.between(0.0, 0.5) * chain.length();
        let solved = drawn(&chain, &start, root(), goal);
        assert!(solved.reached && solved.residual_m < 1e-9 * chain.length(), "{seed}: {}", solved.residual_m);
        let end = places(&chain, &solved)[links - 1].tip;
        assert!(end.distance(goal.target) < 1e-9 * chain.length(), "{seed}");
        for (node, &value) in chain.nodes().iter().zip(&solved.values) {
            assert!(node.joint.excess(value) < 1e-9, "{seed}: {}", node.joint.excess(value));
        }
    }
}

#[test]
fn no_joint_of_a_rope_moves_further_than_its_head() {
    let mut seeded = Seeded(2);
    for _ in 0..500 {
        let chain = line(&mut seeded, Kind::Balls, 20, false);
        let start = pose(&mut seeded, &chain);
        let before = chain.place(&start, root()).unwrap();
        let mut goal = goal_of(&chain, &start, root());
        let way = seeded.direction() * seeded.between(0.0, 0.3) * chain.length();
        goal.target += way;
        let after = places(&chain, &drawn(&chain, &start, root(), goal));
        let moved: Vec<f64> = before.iter().zip(&after).map(|(a, b)| a.joint.distance(b.joint)).collect();
        assert!(moved.iter().all(|moved| *moved <= way.length() + 1e-9), "{moved:?}");
    }
}

#[test]
fn a_snake_whose_head_goes_straight_ends_up_behind_it() {
    let mut chain = Chain::default();
    let hinge = Joint::Revolute { axis: DVec3::Y, range: kin::Interval::new(-0.6, 0.6) };
    for i in 0..20_usize {
        chain.append(Node::link(i.checked_sub(1), hinge, DVec3::Z * 0.1)).unwrap();
    }
    let mut solved =
        drawn(&chain, &chain.rest(), Frame::IDENTITY, Goal::tip(&chain, 19, DVec3::Z * 2.0).unwrap());
    for step in 1..=400 {
        let target = DVec3::new(0.02 * f64::from(step), 0.0, 2.0);
        solved =
            drawn(&chain, &solved.values, solved.world_from_root, Goal::tip(&chain, 19, target).unwrap());
    }
    for (i, place) in places(&chain, &solved).iter().enumerate() {
        assert!(place.joint.abs_diff_eq(DVec3::new(6.0 + 0.1 * i as f64, 0.0, 2.0), 0.01), "{i}: {place:?}");
    }
}

#[test]
fn a_drag_in_two_parts_ends_near_one_in_whole() {
    let mut seeded = Seeded(4);
    let chain = line(&mut seeded, Kind::Balls, 20, false);
    let values: Vec<Value> =
        (0..20).map(|_| Value::Turn(DQuat::from_axis_angle(seeded.direction(), 0.3))).collect();
    let goal = goal_of(&chain, &values, root());
    let way = seeded.direction() * chain.length() * 0.2;
    let whole = drawn(&chain, &values, root(), Goal { target: goal.target + way, ..goal });
    let half = drawn(&chain, &values, root(), Goal { target: goal.target + way * 0.5, ..goal });
    let second = Goal { target: goal.target + way, ..goal };
    let halves = drawn(&chain, &half.values, half.world_from_root, second);
    for (a, b) in places(&chain, &whole).iter().zip(places(&chain, &halves)) {
        assert!(a.joint.distance(b.joint) < 0.03 * chain.length(), "{a:?} {b:?}");
    }
}

#[test]
fn a_chain_where_nothing_turns_is_carried() {
    let chain = Chain::new(vec![Node::link(None, Joint::Fixed, DVec3::X)]).unwrap();
    let goal = Goal::tip(&chain, 0, DVec3::new(3.0, 1.0, 0.0)).unwrap();
    let solved = drawn(&chain, &chain.rest(), Frame::IDENTITY, goal);
    assert!(solved.reached);
    assert_eq!(solved.world_from_root, Frame::new(DQuat::IDENTITY, DVec3::new(2.0, 1.0, 0.0)));
    let far = Goal { target: DVec3::X * 1e308, ..goal };
    assert!(drawn(&chain, &chain.rest(), Frame::IDENTITY, far).world_from_root.position.is_finite());
}
