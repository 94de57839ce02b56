//! Chains inversely: what can be reached is reached, ranges hold, nothing gets worse, and the shape stays near
//! the start's.

mod chains;
mod seeded;

use chains::{Kind, goal_of, kind, last_frame, line, pose};
use glam::{DQuat, DVec3};
use kin::chain::{Chain, ChainError, Goal, Joint, Node, Options, Solved, Solver, Value};
use kin::{Frame, Interval};
use seeded::Seeded;

const ALL: [Solver; 5] =
    [Solver::Best, Solver::ClosedForm, Solver::DampedLeastSquares, Solver::Ccd, Solver::Fabrik];

/// Where all chains of these tests stand.
fn root() -> Frame {
    Frame::new(DQuat::from_rotation_x(0.7), DVec3::new(0.1, -2.0, 0.4))
}

fn solve(chain: &Chain, start: &[Value], goal: &Goal, options: &Options) -> Solved {
    chain.solve(start, root(), goal, options).expect("a sound problem")
}

fn by(solver: Solver, chain: &Chain) -> Options<'static> {
    Options { solver, ..Options::of(chain) }
}

/// How many of so many targets, made by forward kinematics of random poses in range, a solver misses.
fn missed(solver: Solver, seeds: u64, turned: bool) -> u64 {
    let mut missed = 0;
    for seed in 0..seeds {
        let mut seeded = Seeded(seed * 7919 + 1);
        let links = seeded.between(2.0, 31.0) as usize;
        let (kind, ranges) = (kind(&mut seeded), seeded.unit() < 0.5);
        let chain = line(&mut seeded, kind, links, ranges);
        let there = pose(&mut seeded, &chain);
        let mut goal = goal_of(&chain, &there, root());
        goal.rotation = turned.then(|| last_frame(&chain, &there, root()).rotation);
        let start = if seeded.unit() < 0.5 { chain.rest() } else { pose(&mut seeded, &chain) };
        missed += u64::from(!solve(&chain, &start, &goal, &by(solver, &chain)).reached);
    }
    missed
}

#[test]
fn the_best_solver_meets_what_can_be_met() {
    assert!(missed(Solver::Best, 10_000, false) <= 10);
}

#[test]
fn damped_least_squares_meet_what_can_be_met() {
    assert!(missed(Solver::DampedLeastSquares, 10_000, false) <= 10);
}

#[test]
fn coordinate_descent_meets_what_can_be_met() {
    assert!(missed(Solver::Ccd, 10_000, false) <= 10);
}

#[test]
fn forward_and_backward_reaching_meets_what_can_be_met() {
    assert!(missed(Solver::Fabrik, 10_000, false) <= 10);
}

#[test]
fn places_with_rotations_are_met() {
    assert!(missed(Solver::Best, 10_000, true) <= 10);
    assert!(missed(Solver::DampedLeastSquares, 10_000, true) <= 10);
}

/// A chain that starts in range or out of it, with a target in reach or not, some nodes held.
fn hard(seeded: &mut Seeded) -> (Chain, Vec<Value>, Goal, Vec<bool>) {
    let (links, kind) = (seeded.between(1.0, 16.0) as usize, kind(seeded));
    let mut chain = line(seeded, kind, links, true);
    for _ in 0..seeded.between(0.0, 4.0) as usize {
        let parent = seeded.between(0.0, chain.len() as f64) as usize;
        let hinge = Joint::Revolute { axis: seeded.direction(), range: Interval::new(-0.5, 1.0) };
        chain.append(Node::link(Some(parent), hinge, seeded.direction())).expect("a sound problem");
    }
    let mut start = pose(seeded, &chain);
    for value in &mut start {
        if seeded.unit() < 0.3 {
            *value = match value {
                Value::Amount(_) => Value::Amount(seeded.between(-4.0, 4.0)),
                Value::Turn(_) => Value::Turn(seeded.rotation().normalize()),
            };
        }
    }
    let node = seeded.between(0.0, chain.len() as f64) as usize;
    let target = root().position + seeded.direction() * seeded.between(0.0, 1.3) * chain.length();
    let goal =
        Goal { point: seeded.direction(), ..Goal::tip(&chain, node, target).expect("a sound problem") };
    let held = (0..chain.len()).map(|_| seeded.unit() < 0.15).collect();
    (chain, start, goal, held)
}

#[test]
fn no_solver_leaves_a_range_or_gets_worse_or_moves_what_is_held() {
    for seed in 0..10_000 {
        let mut seeded = Seeded(seed);
        let (chain, start, goal, held) = hard(&mut seeded);
        let solver = ALL[seed as usize % ALL.len()];
        let options = Options { held: &held, cap: 60, ..by(solver, &chain) };
        let mut frames = Vec::new();
        chain.frames(&start, root(), &mut frames).unwrap();
        let before = frames[goal.node].point(goal.point).distance(goal.target);
        let solved = solve(&chain, &start, &goal, &options);
        chain.frames(&solved.values, solved.world_from_root, &mut frames).unwrap();
        let after = frames[goal.node].point(goal.point).distance(goal.target);
        assert!((after - solved.residual_m).abs() < 1e-9, "{seed}");
        assert!(after <= before + 1e-12, "{seed} {solver:?}: {before} to {after}");
        assert_eq!(solved.reached, solved.residual_m <= options.tolerance_m);
        assert!(solved.iterations <= options.cap + 3, "{seed}: {}", solved.iterations);
        let path = chain.path(goal.node).unwrap();
        for (i, node) in chain.nodes().iter().enumerate() {
            if held[i] || !path.contains(&i) {
                assert_eq!(start[i], solved.values[i], "{seed}: {i} moved");
            }
            let (was, is) = (node.joint.excess(start[i]), node.joint.excess(solved.values[i]));
            assert!(is <= was + 1e-9, "{seed} {solver:?}: {i} from {was} to {is} outside");
        }
    }
}

#[test]
fn the_same_problem_has_the_same_bits() {
    for seed in 0..200 {
        let (chain, start, goal, held) = hard(&mut Seeded(seed));
        let options = Options { held: &held, ..by(ALL[seed as usize % ALL.len()], &chain) };
        assert_eq!(solve(&chain, &start, &goal, &options), solve(&chain, &start, &goal, &options));
    }
}

#[test]
fn a_goal_that_is_met_changes_nothing() {
    for seed in 0..500 {
        let mut seeded = Seeded(seed);
        let kind = kind(&mut seeded);
        let chain = line(&mut seeded, kind, 7, true);
        let start = pose(&mut seeded, &chain);
        let goal = goal_of(&chain, &start, root());
        for solver in ALL {
            let solved = solve(&chain, &start, &goal, &by(solver, &chain));
            assert_eq!((solved.values, solved.reached, solved.iterations), (start.clone(), true, 0));
        }
    }
}

/// The greatest turn or slide between two poses.
fn change(a: &[Value], b: &[Value]) -> f64 {
    let one = |(a, b): (&Value, &Value)| match (a, b) {
        (Value::Amount(a), Value::Amount(b)) => (a - b).abs(),
        (Value::Turn(a), Value::Turn(b)) => a.angle_between(*b),
        _ => f64::NAN,
    };
    a.iter().zip(b).map(one).fold(0.0, f64::max)
}

#[test]
fn a_small_drag_of_a_bent_chain_turns_its_joints_a_little() {
    let mut worst = 0.0_f64;
    for seed in 0..2000 {
        let mut seeded = Seeded(seed);
        let kind = [Kind::Balls, Kind::Planar][seed as usize % 2];
        let links = seeded.between(4.0, 31.0) as usize;
        let chain = line(&mut seeded, kind, links, false);
        let start: Vec<Value> = chain
            .nodes()
            .iter()
            .map(|node| match node.joint {
                Joint::Ball { .. } => Value::Turn(DQuat::from_axis_angle(seeded.direction(), 0.4)),
                _ => Value::Amount(seeded.between(0.1, 0.5)),
            })
            .collect();
        let mut goal = goal_of(&chain, &start, root());
        let side = match kind {
            Kind::Planar => {
                root().rotation * DVec3::new(seeded.between(-1.0, 1.0), seeded.between(-1.0, 1.0), 0.0)
            }
            _ => seeded.direction(),
        };
        goal.target += side * 0.005 * chain.length();
        let solved = solve(&chain, &start, &goal, &by(Solver::Best, &chain));
        if solved.reached {
            worst = worst.max(change(&start, &solved.values));
        }
    }
    assert!(worst < 0.05, "{worst} rad");
}

/// Equal links on balls, a metre in all, along +y.
fn rope(links: usize) -> Chain {
    let mut chain = Chain::default();
    for i in 0..links {
        let tip = DVec3::Y / links as f64;
        chain
            .append(Node::link(i.checked_sub(1), Joint::Ball { range: None }, tip))
            .expect("a sound problem");
    }
    chain
}

#[test]
fn a_straight_chain_bends_evenly_in_one_step() {
    let mut seeded = Seeded(7);
    for links in [2, 3, 20, 100, 1000] {
        let chain = rope(links);
        for _ in 0..50 {
            let target = root().position + seeded.direction() * seeded.between(0.05, 0.99);
            let goal = Goal::tip(&chain, links - 1, target).unwrap();
            let solved = solve(&chain, &chain.rest(), &goal, &by(Solver::Best, &chain));
            assert!(solved.residual_m < 1e-10, "{links}: {}", solved.residual_m);
            assert_eq!((solved.reached, solved.iterations), (true, 1));
            assert!(solved.values[1..].iter().all(|value| *value == solved.values[1]));
        }
    }
}

#[test]
fn unequal_straight_chains_on_hinges_and_balls_bend_evenly_too() {
    let mut seeded = Seeded(8);
    let mut closed = 0;
    for _ in 0..1000 {
        let mut chain = Chain::default();
        let hinge = Joint::Revolute { axis: DVec3::Z, range: Interval::new(-0.1, 1.5) };
        let planar = seeded.unit() < 0.5;
        for i in 0..8_usize {
            let joint = if i == 0 && !planar { Joint::Ball { range: None } } else { hinge };
            let joint = match joint {
                Joint::Revolute { axis, .. } if i == 0 => Joint::Revolute { axis, range: Interval::FREE },
                joint => joint,
            };
            let tip = DVec3::X * seeded.between(0.5, 1.0);
            chain.append(Node::link(i.checked_sub(1), joint, tip)).unwrap();
        }
        let way = if planar {
            DQuat::from_rotation_z(seeded.between(-3.0, 3.0)) * DVec3::X
        } else {
            seeded.direction()
        };
        let target = root().point(way * chain.length() * seeded.between(0.4, 0.99));
        let goal = Goal::tip(&chain, 7, target).unwrap();
        let solved = solve(&chain, &chain.rest(), &goal, &by(Solver::ClosedForm, &chain));
        let bends: Vec<f64> = solved.values[1..].iter().map(|value| value.amount().unwrap()).collect();
        assert!(bends.iter().all(|bend| (-0.1..=1.5).contains(bend)));
        closed +=
            u32::from(solved.residual_m < 1e-9 && bends.iter().all(|bend| (bend - bends[0]).abs() < 1e-12));
    }
    assert_eq!(closed, 1000);
}

#[test]
fn two_links_are_exact_and_the_elbow_keeps_its_side() {
    let mut seeded = Seeded(9);
    for _ in 0..10_000 {
        let hinge = |range| Joint::Revolute { axis: DVec3::Z, range };
        let planar = seeded.unit() < 0.5;
        let first = if planar { hinge(Interval::FREE) } else { Joint::Ball { range: None } };
        let lengths = [seeded.between(0.3, 1.0), seeded.between(0.3, 1.0)];
        let mut chain = Chain::new(vec![Node::link(None, first, DVec3::X * lengths[0])]).unwrap();
        let ball = !planar && seeded.unit() < 0.5;
        let second = if ball { Joint::Ball { range: None } } else { hinge(Interval::FREE) };
        chain.append(Node::link(Some(0), second, DVec3::X * lengths[1])).unwrap();
        let start = pose(&mut seeded, &chain);
        let way = if planar {
            DQuat::from_rotation_z(seeded.between(-3.0, 3.0)) * DVec3::X
        } else {
            seeded.direction()
        };
        let (near, far) = ((lengths[0] - lengths[1]).abs(), lengths[0] + lengths[1]);
        let target = root().point(way * seeded.between(near, far));
        let goal = Goal::tip(&chain, 1, target).unwrap();
        let solved = solve(&chain, &start, &goal, &by(Solver::ClosedForm, &chain));
        assert!(solved.residual_m < 1e-9, "{}", solved.residual_m);
        if let (Value::Amount(was), Value::Amount(is)) = (start[1], solved.values[1]) {
            assert!(was.sin() * is.sin() >= 0.0, "{was} to {is}");
        }
        assert_eq!(solve(&chain, &start, &goal, &by(Solver::Best, &chain)).values, solved.values);
    }
}

#[test]
fn out_of_reach_a_chain_points_at_its_target() {
    let mut seeded = Seeded(10);
    for links in [1, 2, 5, 20, 100] {
        let chain = rope(links);
        for start in [chain.rest(), pose(&mut seeded, &chain)] {
            let target = root().position + seeded.direction() * 1.7;
            let goal = Goal::tip(&chain, links - 1, target).unwrap();
            for solver in ALL {
                if solver == Solver::ClosedForm && links != 2 {
                    continue;
                }
                let solved = solve(&chain, &start, &goal, &by(solver, &chain));
                assert!(!solved.reached && solved.restarts == 0);
                assert!(solved.residual_m < 0.7 + 1e-9, "{solver:?} {links}: {}", solved.residual_m);
            }
        }
    }
}

#[test]
fn a_target_on_the_line_of_a_straight_chain_is_met() {
    for solver in ALL {
        let chain = rope(12);
        let goal = Goal::tip(&chain, 11, root().point(DVec3::Y * 0.5)).unwrap();
        assert!(solve(&chain, &chain.rest(), &goal, &by(solver, &chain)).reached, "{solver:?}");
    }
}

#[test]
fn numbers_that_are_none_are_named() {
    let chain = rope(4);
    let good = Goal::tip(&chain, 3, DVec3::X).unwrap();
    let options = Options::of(&chain);
    let fault = |goal: Goal, options: Options| {
        chain.solve(&chain.rest(), root(), &goal, &options).unwrap_err().to_string()
    };
    assert_eq!(fault(Goal { target: DVec3::NAN, ..good }, options), "the target is not finite");
    assert_eq!(
        fault(Goal { point: DVec3::INFINITY, ..good }, options),
        "the point of the goal is not finite"
    );
    assert!(
        fault(Goal { rotation: Some(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)), ..good }, options)
            .contains("rotation")
    );
    assert!(fault(Goal { node: 4, ..good }, options).contains("no node 4"));
    assert!(fault(good, Options { tolerance_m: f64::NAN, ..options }).contains("tolerance in metres"));
    assert!(fault(good, Options { tolerance_rad: 0.0, ..options }).contains("tolerance in radians"));
    assert!(fault(good, Options { held: &[true], ..options }).contains("1 flags for 4 nodes"));
    let turned = Goal { rotation: Some(DQuat::IDENTITY), ..good };
    assert!(fault(turned, by(Solver::Ccd, &chain)).contains("Ccd solves for positions only"));
    let nowhere = Frame::new(DQuat::NAN, DVec3::ZERO);
    assert!(chain.solve(&chain.rest(), nowhere, &good, &options).is_err());
    assert!(matches!(Goal::tip(&Chain::default(), 0, DVec3::X), Err(ChainError::NoNode { .. })));
}

#[test]
fn huge_and_tiny_chains_give_finite_values() {
    for scale in [1e-300, 1e-160, 1e-12, 1e12, 1e160, 1e300] {
        let mut seeded = Seeded(11);
        for kind in [Kind::Mixed, Kind::Balls, Kind::Planar] {
            let mut chain = line(&mut seeded, kind, 6, true);
            let start = pose(&mut seeded, &chain);
            for node in 0..6 {
                let tip = chain.nodes()[node].tip;
                chain.set_tip(node, tip * scale).unwrap();
            }
            let target = seeded.direction() * scale;
            let goal = Goal::tip(&chain, 5, target).unwrap();
            for solver in ALL {
                let solved = solve(&chain, &start, &goal, &by(solver, &chain));
                chain.check(&solved.values).unwrap();
            }
        }
    }
}

#[test]
fn a_chain_where_nothing_may_move_stays() {
    let mut seeded = Seeded(12);
    let chain = line(&mut seeded, Kind::Mixed, 5, true);
    let start = pose(&mut seeded, &chain);
    let goal = Goal::tip(&chain, 4, DVec3::X).unwrap();
    for solver in ALL {
        let options = Options { held: &[true; 5], ..by(solver, &chain) };
        let solved = solve(&chain, &start, &goal, &options);
        assert_eq!((solved.values, solved.reached), (start.clone(), false));
    }
}

#[test]
fn slides_alone_go_as_far_as_they_must() {
    let slide = |axis| Joint::Prismatic { axis, range: Interval::new(-3.0, 30.0) };
    let mut chain = Chain::default();
    for (i, axis) in DVec3::AXES.into_iter().enumerate() {
        chain.append(Node::link(i.checked_sub(1), slide(axis), DVec3::ZERO)).unwrap();
    }
    let goal = Goal::tip(&chain, 2, root().point(DVec3::new(20.0, -2.5, 7.0))).unwrap();
    for solver in [Solver::Best, Solver::DampedLeastSquares, Solver::Ccd, Solver::Fabrik] {
        let options = Options { tolerance_m: 1e-6, ..by(solver, &chain) };
        let solved = solve(&chain, &chain.rest(), &goal, &options);
        assert!(solved.reached && solved.restarts == 0, "{solver:?} {}", solved.residual_m);
        assert!((solved.values[1].amount().unwrap() + 2.5).abs() < 1e-5);
    }
}

#[test]
fn a_target_that_moves_slowly_turns_the_joints_slowly() {
    let mut jumps: Vec<f64> = Vec::new();
    for seed in 0..200 {
        let mut seeded = Seeded(seed);
        let kind = [Kind::Balls, Kind::Planar, Kind::Mixed][seed as usize % 3];
        let chain = line(&mut seeded, kind, 10, seed % 2 == 0);
        let start = pose(&mut seeded, &chain);
        let goal = goal_of(&chain, &start, root());
        let way = match kind {
            Kind::Planar => root().rotation * (DQuat::from_rotation_z(seeded.between(-3.0, 3.0)) * DVec3::X),
            _ => seeded.direction(),
        };
        let mut last = start.clone();
        let mut worst = 0.0_f64;
        for step in 1..=100 {
            let target = goal.target + way * (2e-3 * f64::from(step) * chain.length());
            let solved = solve(&chain, &start, &Goal { target, ..goal }, &by(Solver::Best, &chain));
            if !solved.reached {
                break;
            }
            worst = worst.max(change(&last, &solved.values));
            last = solved.values;
        }
        jumps.push(worst);
    }
    jumps.sort_by(f64::total_cmp);
    // Two thousandths of the length a step. Beyond the ninth tenth, ranges stop a joint and the chain leaps.
    assert!(jumps[100] < 0.01 && jumps[180] < 0.04, "{} {} rad", jumps[100], jumps[180]);
}

#[test]
fn a_joint_that_starts_outside_its_range_is_not_thrown_inside() {
    let hinge = |i: usize| Joint::Revolute {
        axis: DVec3::Z,
        range: if i == 2 { Interval::new(-1.0, 1.0) } else { Interval::FREE },
    };
    let mut chain = Chain::default();
    for i in 0..5_usize {
        chain.append(Node::link(i.checked_sub(1), hinge(i), DVec3::X)).unwrap();
    }
    let start: Vec<Value> = [0.3, 0.5, 2.0, -0.4, 0.6].map(Value::Amount).to_vec();
    let mut goal = goal_of(&chain, &start, root());
    goal.target += root().rotation * DVec3::new(0.03, 0.02, 0.0);
    for solver in [Solver::Best, Solver::DampedLeastSquares, Solver::Ccd] {
        let solved = solve(&chain, &start, &goal, &by(solver, &chain));
        assert!(solved.reached && change(&start, &solved.values) < 0.1, "{solver:?}: {:?}", solved.values);
        assert!(solved.values[2].amount().unwrap() <= 2.0);
    }
}

#[test]
fn no_solver_needs_another_start_for_a_long_rope() {
    let mut seeded = Seeded(13);
    let chain = rope(100);
    for _ in 0..100 {
        let target = root().position + seeded.direction() * seeded.between(0.2, 0.95);
        let goal = Goal::tip(&chain, 99, target).unwrap();
        for solver in [Solver::Ccd, Solver::Fabrik] {
            let solved = solve(&chain, &chain.rest(), &goal, &by(solver, &chain));
            assert!(solved.reached && solved.restarts == 0, "{solver:?}: {}", solved.iterations);
        }
    }
}

#[test]
fn where_ranges_stop_a_chain_it_is_nearly_as_near_as_a_dense_search() {
    let degrees = |a: f64, b: f64| Interval::new(a.to_radians(), b.to_radians());
    let ranges = [Interval::new(-1.0, 1.0), degrees(-45.0, 45.0), degrees(0.0, 90.0), degrees(45.0, 135.0)];
    let mut chain = Chain::default();
    let slide = Joint::Prismatic { axis: DVec3::X, range: ranges[0] };
    chain.append(Node::link(None, slide, DVec3::Y)).unwrap();
    for (i, length) in [2.6, 1.0, 0.6].into_iter().enumerate() {
        let hinge = Joint::Revolute { axis: -DVec3::Z, range: ranges[i + 1] };
        chain.append(Node::link(Some(i), hinge, DVec3::X * length)).unwrap();
    }
    let mut tips: Vec<DVec3> = Vec::new();
    for i in 0..6 * 16 * 16 * 16 {
        let at = |k: usize, of: usize, many: usize| {
            let part = (i / of % many) as f64 / (many - 1) as f64;
            Value::Amount(ranges[k].min + part * (ranges[k].max - ranges[k].min))
        };
        let pose = [at(0, 4096, 6), at(1, 256, 16), at(2, 16, 16), at(3, 1, 16)];
        tips.push(chain.place(&pose, Frame::IDENTITY).unwrap()[3].tip);
    }
    let start = [0.0, -0.2, 0.8, 1.2].map(Value::Amount);
    let mut seeded = Seeded(14);
    for _ in 0..200 {
        let target = DVec3::new(seeded.between(-3.0, 5.0), seeded.between(-3.0, 4.0), 0.0);
        let goal = Goal::tip(&chain, 3, target).unwrap();
        let solved = chain.solve(&start, Frame::IDENTITY, &goal, &Options::of(&chain)).unwrap();
        let dense = tips.iter().map(|tip| tip.distance(target)).fold(f64::INFINITY, f64::min);
        assert!(solved.residual_m < 1.06 * dense + 0.01, "{target}: {} for {dense}", solved.residual_m);
    }
}
