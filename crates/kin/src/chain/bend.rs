//! The even bend: a straight chain whose joints all turn by one angle, the root so that the chord meets the target.
//!
//! With link lengths `l_k` the chord after a bend `a` a joint is `|sum l_k exp(i k a)|`: one scalar equation,
//! solved by Newton's method between brackets. All turns are about one axis of the world, so each joint's own
//! axis is that axis seen from the straight chain.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::ccd::aimed;
use super::goal::{Goal, Options};
use super::{Chain, Joint, Node, Value};
use crate::{Frame, axis_angle, axis_angle::sin_cos};

/// What a walk along the path finds: where the point is, and whether the even bend applies.
pub(super) struct Survey {
    /// The goal's point with the values of the start.
    pub end: Frame,
    /// What the even bend needs, where it applies.
    pub straight: Option<Straight>,
}

/// A chain that is straight, on joints that can share a bend.
pub(super) struct Straight {
    world_from_root: DQuat,
    /// Where the first joint that may move is.
    root: DVec3,
    /// Unit vector along the links.
    along: DVec3,
    /// The hinges' common axis; `None` if all joints are balls.
    hinge: Option<DVec3>,
    lengths: Vec<f64>,
}

/// How far off its line a link may point, as a sine.
const NEARLY_STRAIGHT: f64 = 1e-3;

/// A walk along the joints that may move, as long as they lie on a line and can share a bend.
struct Walk {
    straight: bool,
    lengths: Vec<f64>,
    root: DVec3,
    last: DVec3,
    along: DVec3,
    hinge: Option<DVec3>,
    joints: usize,
}

impl Walk {
    /// A joint that may move, or the goal's point.
    #[inline(always)]
    fn pass(&mut self, place: DVec3) {
        let link = place - self.last;
        self.last = place;
        match self.joints {
            0 => self.root = place,
            1 => self.along = link.normalize_or_zero(),
            _ => {}
        }
        if self.joints > 0 {
            // Within the thousandth, the way along the line is the length but for half a millionth.
            let length = self.along.dot(link);
            let off = link.length_squared() - length * length;
            self.straight &= length > 0.0 && off <= (NEARLY_STRAIGHT * length) * (NEARLY_STRAIGHT * length);
            self.lengths.push(length);
        }
        self.joints += 1;
    }

    /// The axis of the joint that was passed, which may move; none for a ball. Hinges must be parallel, and only
    /// the root may be a ball with them.
    #[inline(always)]
    fn turns_about(&mut self, axis: Option<DVec3>) {
        match (axis, self.hinge) {
            (None, None) => {}
            (Some(axis), None) => {
                self.straight &= self.joints <= 2;
                self.hinge = Some(axis);
            }
            (Some(axis), Some(hinge)) => self.straight &= axis.cross(hinge).length_squared() < 1e-12,
            (None, Some(_)) => self.straight = false,
        }
    }
}

impl Chain {
    /// Walks along a path of nodes with the values of the start.
    pub(super) fn survey(
        &self,
        path: &[usize],
        values: &[Value],
        world_from_root: Frame,
        goal: &Goal,
        options: &Options,
    ) -> Survey {
        let mut walk = Walk {
            straight: true,
            lengths: Vec::with_capacity(path.len()),
            root: DVec3::ZERO,
            last: DVec3::ZERO,
            along: DVec3::ZERO,
            hinge: None,
            joints: 0,
        };
        let mut at = world_from_root;
        for &i in path {
            let node = &self.nodes[i];
            at = node.carried(at, values[i]);
            if !walk.straight || matches!(node.joint, Joint::Fixed) || options.holds(i) {
                continue;
            }
            walk.pass(at.position);
            match node.joint {
                Joint::Revolute { axis, .. } => walk.turns_about(Some(at.vector(axis))),
                Joint::Ball { .. } => walk.turns_about(None),
                _ => walk.straight = false,
            }
        }
        let end = Frame::new(at.rotation, at.point(goal.point));
        walk.pass(end.position);
        let Walk { root, along, hinge, lengths, .. } = walk;
        let across = hinge.is_none_or(|hinge| hinge.dot(along).abs() < 1e-6);
        let straight = walk.straight && across && lengths.len() > 1;
        let world_from_root = world_from_root.rotation;
        let found = Straight { world_from_root, root, along, hinge, lengths };
        Survey { end, straight: straight.then_some(found) }
    }

    /// The frame of a point of the last node of a path.
    pub(super) fn end(&self, path: &[usize], values: &[Value], world_from_root: Frame, goal: &Goal) -> Frame {
        let node = path.iter().fold(world_from_root, |at, &i| self.nodes[i].carried(at, values[i]));
        Frame::new(node.rotation, node.point(goal.point))
    }

    /// The values of the even bend that brings the point to the target; `None` where it does not apply. Hinges
    /// can bend to either side: `turned_over` takes the side to which the root turns further. A target out of
    /// reach is pointed at with the chain straight; joints stop at their ranges.
    pub(super) fn even_bend(
        &self,
        path: &[usize],
        values: &[Value],
        goal: &Goal,
        options: &Options,
        straight: &Straight,
        turned_over: bool,
    ) -> Option<Vec<Value>> {
        let to = goal.target - straight.root;
        let chord = chord(&straight.lengths, to.length())?;
        let axis = straight.bend_axis(to, turned_over);
        let (sine, cosine) = chord.lean.sin_cos();
        // Where the chord of the bent chain points before the root turns.
        let from = straight.along * cosine + axis.cross(straight.along) * sine;
        let mut bend = Bend { axis, angle: chord.bend, last: None };
        let mut out = values.to_vec();
        let mut before = straight.world_from_root;
        let mut first = true;
        for &i in path {
            let (node, value) = (&self.nodes[i], values[i]);
            if node.origin.rotation != DQuat::IDENTITY {
                before *= node.origin.rotation;
            }
            if !(matches!(node.joint, Joint::Fixed) || options.holds(i)) {
                out[i] = if std::mem::take(&mut first) {
                    let world_from_node =
                        Frame::new(before * node.joint.frame(value).rotation, straight.root);
                    aimed(&node.joint.reaching(value), value, world_from_node, from, to)
                } else {
                    bend.turned(node, value, before)
                };
            }
            if value != Value::Turn(DQuat::IDENTITY) {
                before *= node.joint.frame(value).rotation;
            }
        }
        Some(out)
    }
}

impl Straight {
    /// Whether hinges set the plane in which the chain bends, so that there are two sides to bend to.
    pub(super) fn has_sides(&self) -> bool {
        self.hinge.is_some()
    }

    /// The axis of the bend: the hinges', or, for balls, the one that lets the chain bow in the plane of its
    /// line and the target. Either way the first link then leans to the side where it was, so that the root
    /// turns least.
    fn bend_axis(&self, to: DVec3, turned_over: bool) -> DVec3 {
        let aside = self.along.cross(to);
        match self.hinge {
            Some(hinge) => {
                if (hinge.dot(aside) < 0.0) != turned_over {
                    -hinge
                } else {
                    hinge
                }
            }
            None => {
                let length = aside.length();
                let any = || self.along.any_orthonormal_vector();
                if length > 1e-9 * to.length() { aside / length } else { any() }
            }
        }
    }
}

/// One turn to be handed out along a path.
struct Bend {
    axis: DVec3,
    angle: f64,
    /// The last ball's turn, and the rotation of the joint's frame that it was made for.
    last: Option<(DQuat, DQuat)>,
}

impl Bend {
    /// A joint's value after its turn, in range; `world_from_joint` is that of the straight chain.
    #[inline(always)]
    fn turned(&mut self, node: &Node, value: Value, world_from_joint: DQuat) -> Value {
        match (node.joint, value) {
            (Joint::Revolute { axis, range }, Value::Amount(x)) => {
                let along = (world_from_joint * axis).dot(self.axis);
                Value::Amount(range.reaching(x).clamp(x + self.angle * along.signum()))
            }
            (Joint::Ball { range }, Value::Turn(q)) => {
                let turn = match self.last {
                    Some((joint, turn)) if joint == world_from_joint => turn,
                    _ => axis_angle(world_from_joint.conjugate() * self.axis, self.angle),
                };
                self.last = Some((world_from_joint, turn));
                let moved = if q == DQuat::IDENTITY { turn } else { (turn * q).normalize() };
                Value::Turn(range.map_or(moved, |range| range.reaching(q).clamp(moved)))
            }
            _ => value,
        }
    }
}

/// A bend a joint, and how far the first link then leans off the chord, radians.
struct Chord {
    bend: f64,
    lean: f64,
}

/// The bend that makes links' chord as long as a distance: 0 if it is out of reach, `None` if they can't fold
/// that far evenly.
fn chord(lengths: &[f64], distance: f64) -> Option<Chord> {
    let total: f64 = lengths.iter().sum();
    if !(total > 0.0 && distance.is_finite()) {
        return None;
    }
    let ratio = distance / total;
    if ratio >= 1.0 {
        return Some(Chord { bend: 0.0, lean: 0.0 });
    }
    let many = lengths.len() as f64;
    let even = lengths.iter().all(|length| (length - lengths[0]).abs() <= 1e-12 * lengths[0]);
    let fold = |bend: f64| if even { equal(many, bend) } else { unequal(lengths, bend, total) };
    let (mut low, mut high) = (0.0, TAU / many);
    if !even && fold(high).length_squared > ratio * ratio {
        return None;
    }
    let mut bend = guess(ratio, many) / many;
    for _ in 0..60 {
        let at = fold(bend);
        let over = at.length_squared - ratio * ratio;
        if over > 0.0 {
            low = bend;
        } else {
            high = bend;
        }
        let newton = bend - over / at.slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let change = (next - bend).abs();
        bend = next;
        // Newton's error after a step is about the square of the step.
        if change * many < 3e-6 {
            break;
        }
    }
    let lean = if even { 0.5 * (many - 1.0) * bend } else { fold(bend).lean };
    Some(Chord { bend, lean })
}

/// A bend times the number of links for a chord of that part of the length: an inverse of `sin(x/2) / (x/2)`, to
/// a two-thousandth for many links.
fn guess(ratio: f64, many: f64) -> f64 {
    let s = 1.0 - ratio;
    // (x/2)² by sinc(x/2) = 1 - s: 6 s and on by the series, then a polynomial through five points.
    let square = s * (6.0 + s * (1.8029 + s * (0.6788 + s * (1.5115 + s * (-2.2426 + s * 2.1078)))));
    // A few links: sin(n h) / (n sin h) is 1 - (n² - 1) h²/6 for a small bend.
    2.0 * (square * (1.0 + ratio / (many * many - 1.0))).sqrt()
}

/// A chord's squared length as a part of the chain's, its derivative by the bend, and its angle from the first link.
struct Fold {
    length_squared: f64,
    slope: f64,
    lean: f64,
}

/// Links of one length: `sin(n h) / (n sin h)` with half a bend `h`.
fn equal(many: f64, bend: f64) -> Fold {
    let half = 0.5 * bend;
    let ((s, c), (sn, cn)) = (sin_cos(half), sin_cos(many * half));
    let ratio = sn / (many * s);
    let slope = 0.5 * (many * cn * s - sn * c) / (many * s * s);
    Fold { length_squared: ratio * ratio, slope: 2.0 * ratio * slope, lean: (many - 1.0) * half }
}

/// Links of any lengths: the sum itself, each direction made from the one before.
fn unequal(lengths: &[f64], bend: f64, total: f64) -> Fold {
    let (sine, cosine) = bend.sin_cos();
    let (mut c, mut s) = (1.0, 0.0);
    let (mut x, mut y, mut dx, mut dy) = (0.0, 0.0, 0.0, 0.0);
    for (k, length) in lengths.iter().enumerate() {
        let (lx, ly) = (length * c, length * s);
        (x, y) = (x + lx, y + ly);
        (dx, dy) = (dx - k as f64 * ly, dy + k as f64 * lx);
        (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
    }
    let scale = 1.0 / (total * total);
    Fold { length_squared: (x * x + y * y) * scale, slope: 2.0 * (x * dx + y * dy) * scale, lean: y.atan2(x) }
}
