//! Chains forward: what a turn carries, where ranges stop it, and what stays when nodes come and go.

mod seeded;

use glam::{DQuat, DVec3};
use kin::chain::{BallRange, Chain, ChainError, Joint, Node, Value};
use kin::{Cone, Frame, Interval};
use seeded::Seeded;

/// A joint of any kind, sometimes with a range.
fn joint(seeded: &mut Seeded) -> Joint {
    let axis = seeded.direction();
    let range = match seeded.between(0.0, 3.0) as u32 {
        0 => Interval::FREE,
        _ => Interval::new(seeded.between(-2.0, 0.0), seeded.between(0.0, 2.0)),
    };
    match seeded.between(0.0, 8.0) as u32 {
        0 => Joint::Fixed,
        1..=3 => Joint::Revolute { axis, range },
        4 => Joint::Prismatic { axis, range },
        5 => Joint::Ball { range: None },
        _ => {
            let cone = Cone { axis: seeded.direction(), half_angle: seeded.between(0.1, 2.5) };
            Joint::Ball { range: Some(BallRange { bone: axis, cone, twist: range }) }
        }
    }
}

/// A tree of up to 30 nodes.
fn tree(seeded: &mut Seeded) -> Chain {
    let mut chain = Chain::default();
    for i in 0..seeded.between(2.0, 31.0) as usize {
        let parent = (i > 0).then(|| seeded.between(0.0, i as f64) as usize);
        let tip = seeded.direction() * seeded.between(0.1, 1.0);
        let node = Node::link(parent, joint(seeded), tip);
        if seeded.unit() < 0.5 {
            chain.append(node).expect("a sound problem");
        } else {
            let origin = Frame::new(seeded.rotation(), seeded.direction());
            chain.attach(Node { origin, ..node }).expect("a sound problem");
        }
    }
    chain
}

fn values(chain: &Chain, seeded: &mut Seeded) -> Vec<Value> {
    let value = |node: &Node| match node.joint {
        Joint::Ball { .. } => Value::Turn(seeded.rotation().normalize()),
        _ => Value::Amount(seeded.between(-2.5, 2.5)),
    };
    chain.nodes().iter().map(value).collect()
}

fn delta(joint: &Joint, seeded: &mut Seeded) -> Value {
    match joint {
        Joint::Fixed => Value::Amount(0.0),
        Joint::Ball { .. } => Value::Turn(seeded.rotation().normalize()),
        _ => Value::Amount(seeded.between(-3.0, 3.0)),
    }
}

fn frames(chain: &Chain, values: &[Value]) -> Vec<Frame> {
    let mut out = Vec::new();
    chain
        .frames(values, Frame::new(DQuat::from_rotation_y(0.4), DVec3::ONE), &mut out)
        .expect("a sound problem");
    out
}

fn same(a: Frame, b: Frame) -> bool {
    a.position.abs_diff_eq(b.position, 1e-9) && a.rotation.dot(b.rotation).abs() > 1.0 - 1e-12
}

fn descends(chain: &Chain, node: usize, from: usize) -> bool {
    chain.path(node).expect("a sound problem").contains(&from)
}

#[test]
fn a_turn_moves_exactly_the_descendants_and_them_rigidly() {
    let mut seeded = Seeded(51);
    for _ in 0..2000 {
        let chain = tree(&mut seeded);
        let mut pose = values(&chain, &mut seeded);
        let node = seeded.between(0.0, chain.len() as f64) as usize;
        let before = frames(&chain, &pose);
        let turn = delta(&chain.nodes()[node].joint, &mut seeded);
        chain.turn(&mut pose, node, turn).unwrap();
        let after = frames(&chain, &pose);
        let moved = after[node].then(before[node].inverse());
        for i in 0..chain.len() {
            if descends(&chain, i, node) {
                assert!(same(moved.then(before[i]), after[i]), "{i} below {node}");
            } else {
                assert_eq!(before[i], after[i], "{i} beside {node}");
            }
        }
    }
}

#[test]
fn a_turn_ends_at_the_range_and_from_outside_goes_only_inward() {
    let mut seeded = Seeded(52);
    for _ in 0..20_000 {
        let joint = joint(&mut seeded);
        let chain = Chain::new(vec![Node::link(None, joint, DVec3::X)]).unwrap();
        let mut pose = values(&chain, &mut seeded);
        let before = joint.excess(pose[0]);
        let turn = delta(&joint, &mut seeded);
        let now = chain.turn(&mut pose, 0, turn).unwrap();
        assert_eq!(now, pose[0]);
        assert!(joint.excess(now) <= before + 1e-9, "{joint:?}: {before} to {}", joint.excess(now));
    }
}

#[test]
fn a_turn_of_nothing_keeps_what_is_outside_its_range() {
    let mut seeded = Seeded(56);
    for _ in 0..5000 {
        let joint = joint(&mut seeded);
        let chain = Chain::new(vec![Node::link(None, joint, DVec3::X)]).unwrap();
        let mut pose = values(&chain, &mut seeded);
        let before = pose[0];
        let nothing = joint.rest();
        chain.turn(&mut pose, 0, nothing).unwrap();
        match (before, pose[0]) {
            (Value::Turn(a), Value::Turn(b)) => assert!(a.dot(b).abs() > 1.0 - 1e-12, "{a} {b}"),
            (a, b) => assert_eq!(a, b),
        }
    }
}

#[test]
fn a_clamped_ball_is_in_range_and_one_in_range_keeps_its_bits() {
    let mut seeded = Seeded(53);
    for _ in 0..20_000 {
        let joint = joint(&mut seeded);
        let Joint::Ball { range: Some(range) } = joint else { continue };
        let clamped = range.clamp(seeded.rotation().normalize());
        assert!(range.excess(clamped) < 1e-9, "{}", range.excess(clamped));
        let inside = range.clamp(DQuat::from_rotation_arc(range.bone, range.cone.axis));
        assert_eq!(inside, range.clamp(inside));
    }
}

#[test]
fn a_range_of_twist_may_lie_across_the_half_turn() {
    let twist = Interval::new(170f64.to_radians(), 200f64.to_radians());
    let range = BallRange { bone: DVec3::Y, cone: Cone { axis: DVec3::Y, half_angle: 0.5 }, twist };
    let at = |degrees: f64| DQuat::from_rotation_y(degrees.to_radians());
    assert!(range.excess(at(-165.0)) == 0.0);
    assert!((range.excess(at(-150.0)) - 10f64.to_radians()).abs() < 1e-12);
    assert!(range.clamp(at(-150.0)).dot(at(200.0)).abs() > 1.0 - 1e-12);
}

#[test]
fn append_joins_at_the_tip_and_leaves_the_rest() {
    let mut seeded = Seeded(54);
    for _ in 0..500 {
        let mut chain = tree(&mut seeded);
        let mut pose = values(&chain, &mut seeded);
        let before = frames(&chain, &pose);
        let parent = seeded.between(0.0, chain.len() as f64) as usize;
        let node = chain.append(Node::link(Some(parent), Joint::Fixed, DVec3::X)).unwrap();
        pose.push(Value::Amount(0.0));
        let after = frames(&chain, &pose);
        assert_eq!(before[..], after[..node]);
        assert!(after[node].position.abs_diff_eq(after[parent].point(chain.nodes()[parent].tip), 1e-12));
        assert_eq!(chain.select(node).unwrap().parent, Some(parent));
        assert!(chain.select(parent).unwrap().children.contains(&node));
        assert_eq!(chain.remove(node).unwrap().tip, DVec3::X);
    }
}

#[test]
fn what_follows_a_removed_node_joins_on_and_the_rest_keeps_its_place() {
    let mut seeded = Seeded(55);
    for _ in 0..2000 {
        let mut chain = tree(&mut seeded);
        let mut pose = values(&chain, &mut seeded);
        let node = seeded.between(1.0, chain.len() as f64) as usize;
        let (old, before) = (chain.clone(), frames(&chain, &pose));
        let removed = chain.remove(node).unwrap();
        pose.remove(node);
        let after = frames(&chain, &pose);
        let index = |i: usize| i - usize::from(i > node);
        for i in (0..old.len()).filter(|&i| i != node) {
            let (was, now) = (old.nodes()[i], chain.nodes()[index(i)]);
            if !descends(&old, i, node) {
                assert_eq!(before[i], after[index(i)]);
            } else if was.parent != Some(node) {
                assert_eq!((was.origin, was.parent.map(index)), (now.origin, now.parent), "{i}");
            } else {
                // As far from where the node joined as it was from the node's end.
                let joined = before[removed.parent.unwrap()].then(removed.origin);
                let way = was.origin.position - removed.tip;
                assert_eq!(now.parent, removed.parent.map(index));
                assert!(after[index(i)].position.distance(joined.point(way)) < 2.6, "{i}");
                if !matches!(now.joint, Joint::Prismatic { .. }) {
                    assert!(after[index(i)].position.abs_diff_eq(joined.point(way), 1e-9), "{i}");
                }
            }
        }
    }
}

#[test]
fn a_line_without_its_middle_is_one_link_shorter() {
    let hinge = Joint::Revolute { axis: DVec3::Z, range: Interval::FREE };
    let mut chain = Chain::default();
    for i in 0..4_usize {
        chain.append(Node::link(i.checked_sub(1), hinge, DVec3::X * (i as f64 + 1.0))).unwrap();
    }
    assert_eq!(chain.length(), 10.0);
    chain.remove(1).unwrap();
    assert_eq!(chain.length(), 8.0);
    let ends = chain.place(&chain.rest(), Frame::IDENTITY).unwrap();
    let tips: Vec<f64> = ends.iter().map(|end| end.tip.x).collect();
    assert_eq!(tips, [1.0, 4.0, 8.0]);
    chain.remove(0).unwrap();
    assert_eq!(chain.nodes()[0].parent, None);
    assert_eq!(chain.place(&chain.rest(), Frame::IDENTITY).unwrap()[1].tip.x, 7.0);
}

#[test]
fn a_longer_link_takes_along_what_joins_at_its_tip() {
    let hinge = Joint::Revolute { axis: DVec3::Z, range: Interval::FREE };
    let node = |parent, origin| Node { origin, ..Node::link(parent, hinge, DVec3::X) };
    let at = |x| Frame::new(DQuat::IDENTITY, DVec3::X * x);
    let mut chain =
        Chain::new(vec![node(None, Frame::IDENTITY), node(Some(0), at(1.0)), node(Some(0), at(0.5))])
            .unwrap();
    chain.set_length(0, 3.0).unwrap();
    let ends = chain.place(&chain.rest(), Frame::IDENTITY).unwrap();
    let joints: Vec<f64> = ends.iter().map(|end| end.joint.x).collect();
    assert_eq!(joints, [0.0, 3.0, 0.5]);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(chain.set_length(0, bad), Err(ChainError::Length { node: 0, .. })));
    }
    chain.set_tip(1, DVec3::ZERO).unwrap();
    assert_eq!(chain.set_length(1, 1.0), Err(ChainError::NoDirection { node: 1 }));
}

#[test]
fn what_is_wrong_is_named() {
    let hinge = |axis| Joint::Revolute { axis, range: Interval::FREE };
    let node = Node::link(None, hinge(DVec3::Z), DVec3::X);
    let second = |change: fn(&mut Node)| {
        let mut other = Node { parent: Some(0), ..node };
        change(&mut other);
        Chain::new(vec![node, other]).unwrap_err().to_string()
    };
    assert!(second(|n| n.parent = None).contains("node 1 has no parent"));
    assert!(second(|n| n.parent = Some(1)).contains("node 1 is carried by 1"));
    assert!(second(|n| n.tip.x = f64::NAN).contains("node 1: its tip"));
    assert!(second(|n| n.origin.position.x = f64::INFINITY).contains("place of the joint"));
    assert!(second(|n| n.origin.rotation = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)).contains("length zero"));
    assert!(
        second(|n| n.joint = Joint::Revolute { axis: DVec3::ZERO, range: Interval::FREE }).contains("axis")
    );
    let mut chain = Chain::new(vec![node]).unwrap();
    let bad = Interval { min: 1.0, max: -1.0 };
    assert!(chain.set_range(0, bad).unwrap_err().to_string().contains("from 1 to -1"));
    assert!(chain.set_range(0, Interval { min: f64::NAN, max: 1.0 }).is_err());
    assert!(chain.set_range(3, Interval::FREE).unwrap_err().to_string().contains("no node 3"));
    assert!(chain.set_ball_range(0, None).is_err());
    let mut values = vec![Value::Amount(f64::NAN)];
    assert!(chain.turn(&mut values, 0, Value::Amount(1.0)).unwrap_err().to_string().contains("node 0"));
    values[0] = Value::Turn(DQuat::IDENTITY);
    assert!(chain.check(&values).unwrap_err().to_string().contains("an angle in radians"));
    values[0] = Value::Amount(0.0);
    assert!(chain.turn(&mut values, 0, Value::Amount(f64::NAN)).is_err());
    assert!(chain.check(&[]).unwrap_err().to_string().contains("0 values for 1 nodes"));
    let nowhere = Frame::new(DQuat::IDENTITY, DVec3::NAN);
    assert!(chain.place(&values, nowhere).is_err());
    for _ in 0..2 {
        chain.append(Node { parent: Some(0), ..node }).unwrap();
    }
    assert_eq!(chain.remove(0), Err(ChainError::ManyRoots { children: 2 }));
}
