//! Random chains and poses in range, for the tests of the solvers.
#![allow(dead_code)]

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use kin::chain::{BallRange, Chain, Goal, Joint, Node, Value};
use kin::{Cone, Frame, Interval};

use crate::seeded::Seeded;

/// What a random chain is made of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Balls, hinges and a few slides in any direction.
    Mixed,
    /// Balls alone.
    Balls,
    /// Parallel hinges, the links across them.
    Planar,
}

pub fn kind(seeded: &mut Seeded) -> Kind {
    [Kind::Mixed, Kind::Balls, Kind::Planar][seeded.between(0.0, 3.0) as usize]
}

/// A line of so many links, with ranges or without.
pub fn line(seeded: &mut Seeded, kind: Kind, links: usize, ranges: bool) -> Chain {
    let mut chain = Chain::default();
    for i in 0..links {
        let tip = match kind {
            Kind::Planar => DVec3::X,
            _ => seeded.direction(),
        };
        let tip = tip * seeded.between(0.3, 1.0);
        let joint = joint(seeded, kind, tip, ranges);
        chain.append(Node::link(i.checked_sub(1), joint, tip)).expect("a sound problem");
    }
    chain
}

fn joint(seeded: &mut Seeded, kind: Kind, tip: DVec3, ranges: bool) -> Joint {
    let turn = |seeded: &mut Seeded| match ranges {
        true => Interval::new(-seeded.between(0.2, PI), seeded.between(0.2, PI)),
        false => Interval::FREE,
    };
    let lot = match kind {
        Kind::Mixed => seeded.between(0.0, 10.0) as u32,
        Kind::Balls => 9,
        Kind::Planar => 10,
    };
    match lot {
        0 => Joint::Prismatic {
            axis: seeded.direction(),
            range: Interval::new(-seeded.between(0.0, 0.5), seeded.between(0.1, 1.0)),
        },
        1..=6 => Joint::Revolute { axis: seeded.direction(), range: turn(seeded) },
        10 => Joint::Revolute { axis: DVec3::Z, range: turn(seeded) },
        _ if ranges => {
            let cone = Cone {
                axis: (tip + seeded.direction() * 0.2).normalize(),
                half_angle: seeded.between(0.3, 2.0),
            };
            Joint::Ball { range: Some(BallRange { bone: tip.normalize(), cone, twist: turn(seeded) }) }
        }
        _ => Joint::Ball { range: None },
    }
}

/// A value in range.
pub fn value(seeded: &mut Seeded, joint: &Joint) -> Value {
    match joint {
        Joint::Fixed => Value::Amount(0.0),
        Joint::Revolute { range, .. } | Joint::Prismatic { range, .. } => {
            Value::Amount(seeded.between(range.min.max(-PI), range.max.min(PI)))
        }
        Joint::Ball { range: None } => Value::Turn(seeded.rotation().normalize()),
        Joint::Ball { range: Some(range) } => {
            let angle = range.cone.half_angle * seeded.unit().sqrt();
            let across = range.cone.axis.cross(seeded.direction()).normalize();
            let bone = DQuat::from_axis_angle(across, angle) * range.cone.axis;
            let twist = seeded.between(range.twist.min.max(-PI), range.twist.max.min(PI));
            let swing = DQuat::from_rotation_arc(range.bone, bone.normalize());
            Value::Turn((swing * DQuat::from_axis_angle(range.bone, twist)).normalize())
        }
    }
}

pub fn pose(seeded: &mut Seeded, chain: &Chain) -> Vec<Value> {
    chain.nodes().iter().map(|node| value(seeded, &node.joint)).collect()
}

/// Where the last node is.
pub fn last_frame(chain: &Chain, values: &[Value], root: Frame) -> Frame {
    let mut frames = Vec::new();
    chain.frames(values, root, &mut frames).expect("a sound problem");
    frames[chain.len() - 1]
}

/// The tip of the last link to where it is in a pose.
pub fn goal_of(chain: &Chain, values: &[Value], root: Frame) -> Goal {
    let last = chain.len() - 1;
    let target = last_frame(chain, values, root).point(chain.nodes()[last].tip);
    Goal::tip(chain, last, target).expect("a sound problem")
}
