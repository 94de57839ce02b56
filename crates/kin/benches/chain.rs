//! Chains of 20, 100 and 1,000 links to a ten-thousandth of their length: from straight, and dragged on from
//! where they are.

mod sampling;
#[path = "../tests/seeded/mod.rs"]
mod seeded;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DQuat, DVec3};
use kin::Frame;
use kin::chain::{Chain, Goal, Joint, Node, Options, Solver, Value};
use sampling::each;
use seeded::Seeded;

/// Links of one length on balls, a metre in all.
fn rope(links: usize) -> Chain {
    let tip = DVec3::Y / links as f64;
    let node = |i: usize| Node {
        origin: Frame::new(DQuat::IDENTITY, if i == 0 { DVec3::ZERO } else { tip }),
        ..Node::link(i.checked_sub(1), Joint::Ball { range: None }, tip)
    };
    Chain::new((0..links).map(node).collect()).expect("a chain")
}

/// Targets as the peers have them: every direction, 0.2 to 0.95 of the length.
fn target(seeded: &mut Seeded) -> DVec3 {
    seeded.direction() * seeded.between(0.2, 0.95)
}

/// To a ten-thousandth of the metre.
fn by(solver: Solver, chain: &Chain) -> Options<'static> {
    Options { solver, tolerance_m: 1e-4, ..Options::of(chain) }
}

fn solve(chain: &Chain, start: &[Value], target: DVec3, options: &Options) -> f64 {
    let goal = Goal::tip(chain, chain.len() - 1, target).expect("a goal");
    let solved = chain.solve(start, Frame::IDENTITY, &goal, options).expect("an answer");
    assert!(solved.reached, "{} m off {target}", solved.residual_m);
    solved.residual_m
}

fn from_straight(c: &mut Criterion) {
    for links in [20, 100, 1000] {
        let chain = rope(links);
        let (rest, options, mut seeded) = (chain.rest(), by(Solver::Best, &chain), Seeded(11));
        let name = format!("chain of {links} from straight");
        each(c, &name, || target(&mut seeded), |&to| solve(&chain, &rest, to, &options));
    }
}

/// A drag of a fiftieth of the length from an even bend, where the shape of the start is to be kept.
fn dragged(c: &mut Criterion) {
    for links in [20, 100, 1000] {
        let chain = rope(links);
        let options = by(Solver::Best, &chain);
        let goal = Goal::tip(&chain, links - 1, DVec3::new(0.5, 0.3, 0.0)).expect("a goal");
        let bent = chain.solve(&chain.rest(), Frame::IDENTITY, &goal, &options).expect("a bend").values;
        let mut seeded = Seeded(12);
        let name = format!("chain of {links} dragged on");
        let near = || goal.target + seeded.direction() * 0.02;
        each(c, &name, near, |&to| solve(&chain, &bent, to, &options));
    }
}

/// The other solvers, 20 links from straight.
fn solvers(c: &mut Criterion) {
    let chain = rope(20);
    let rest = chain.rest();
    for solver in [Solver::DampedLeastSquares, Solver::Ccd, Solver::Fabrik] {
        let (options, mut seeded) = (by(solver, &chain), Seeded(13));
        let name = format!("chain of 20 from straight by {solver:?}");
        each(c, &name, || target(&mut seeded), |&to| solve(&chain, &rest, to, &options));
    }
}

criterion_group! {
    name = chain;
    config = sampling::many_short();
    targets = from_straight, dragged, solvers
}
criterion_main!(chain);
