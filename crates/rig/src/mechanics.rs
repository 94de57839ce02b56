//! Body mechanics that an animator may switch on: the collar goes along with the arm, the torso follows a far reach.
//!
//! What a gesture brings along is the difference between what the mechanics say of its goal and of its beginning. So
//! switching them on moves nothing, and how far a collar was from its rhythm stays.

use glam::DVec3;
use kin::{CollarTurn, Interval, Rhythm, collar_turn};

use crate::evaluation::angle_between;
use crate::gesture::reach_from;
use crate::limb_rig::set;
use crate::torso::Spine;
use crate::turn::turn_along;
use crate::{
    Angles, Articulation, Bone, Contact, Dof, Figure, Frames, GestureError, Limb, Moved, Pose, Space, Target,
    articulator_in, frames, reach, turn,
};

/// Which joints gestures bring along that their names don't say. None by default.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Mechanics {
    /// Whether the collar rises with its arm.
    pub collar_rhythm: bool,
    /// How much the torso leans and turns after a far reach: 0 not at all, 1 fully. Other numbers count as the
    /// nearer of the two, NaN as 0.
    pub torso_follow: f64,
}

impl Mechanics {
    fn follow(&self) -> f64 {
        if self.torso_follow > 0.0 { self.torso_follow.min(1.0) } else { 0.0 }
    }
}

/// How much farther than without mechanics a limb may be off its target, metres: beyond, less is brought along.
pub const MECHANICS_TOLERANCE_M: f64 = 1e-6;

/// As [`reach`] with collar and torso brought along. An arm in any contact keeps it to [`MECHANICS_TOLERANCE_M`], and the
/// reach itself is nowhere farther from its target than without: where it would be, less is brought along.
///
/// # Errors
/// As [`reach`].
pub fn reach_with(
    figure: &Figure,
    before: &Pose,
    limb: Limb,
    target: Target,
    ranges: bool,
    mechanics: &Mechanics,
) -> Result<Moved, GestureError> {
    let plain = reach(figure, before, limb, target, ranges)?;
    if !limb.is_arm() || (!mechanics.collar_rhythm && mechanics.follow() == 0.0) {
        return Ok(plain);
    }
    let Some(along) = Along::new(figure, before, limb, target, mechanics) else { return Ok(plain) };
    let without = missed(figure, &plain.pose, limb, target);
    let brought = |share: f64| -> Option<Moved> {
        let pose = along.brought(share, ranges)?;
        let moved = reach_from(figure, before, pose, limb, target, ranges).ok()?;
        let with = missed(figure, &moved.pose, limb, target);
        let holds = with.iter().zip(without).all(|(with, without)| *with <= without + MECHANICS_TOLERANCE_M);
        holds.then_some(moved)
    };
    // First what can be told without solving: how far the other limbs' contacts stretch.
    let most = along.within_reach(ranges).min(along.unstopped(without[limb.index()], ranges));
    if most == 0.0 {
        return Ok(plain);
    }
    if let Some(moved) = brought(most) {
        return Ok(moved);
    }
    let (mut best, mut good, mut bad) = (plain, 0.0, most);
    for _ in 0..HALVINGS {
        if bad - good < 1e-3 {
            break;
        }
        let middle = 0.5 * (good + bad);
        match brought(middle) {
            Some(moved) => (best, good) = (moved, middle),
            None => bad = middle,
        }
    }
    Ok(best)
}

/// The most halvings in search of how much can be brought along; with solving, a thousandth of it is enough.
const HALVINGS: usize = 14;

/// As [`turn`] with the collar brought along by its arm's root.
///
/// # Errors
/// As [`turn`].
pub fn turn_with(
    figure: &Figure,
    before: &Pose,
    bone: Bone,
    dof: Dof,
    degrees: f64,
    ranges: bool,
    mechanics: &Mechanics,
) -> Result<Moved, GestureError> {
    let arm = Limb::of(bone).filter(|limb| limb.is_arm() && limb.parts().root == bone);
    let Some(girdle) = arm.filter(|_| mechanics.collar_rhythm).and_then(|limb| Girdle::of(figure, limb))
    else {
        return turn(figure, before, bone, dof, degrees, ranges);
    };
    let from = girdle.rise(girdle.along(before.angles(bone)));
    turn_along(figure, before, bone, dof, degrees, ranges, |pose| {
        let to = girdle.rise(girdle.along(pose.angles(bone)));
        girdle.raise(pose, before, to - from, ranges);
    })
}

/// How far each limb is off: the reaching one from its goal, others from their contacts; metres. A planted end that
/// turns away counts, too, by a centimetre for each radian.
fn missed(figure: &Figure, pose: &Pose, limb: Limb, target: Target) -> [f64; 4] {
    let now = frames(figure, pose);
    Limb::ALL.map(|other| {
        let contact = pose.limb(other).contact;
        let (space, point) = match contact.target() {
            _ if other == limb => (target.space, target.point),
            Some(held) => held,
            None => return 0.0,
        };
        let at = figure.articulator(pose, other);
        let off = now[at.bone].point(at.at).distance(now.space(space).point(point));
        match contact {
            Contact::Planted { space, rotation, .. } => {
                let turned =
                    angle_between(now[other.parts().end].rotation, now.space(space).rotation * rotation);
                off + 0.01 * turned
            }
            _ => off,
        }
    })
}

/// What a reach brings along.
struct Along<'a> {
    figure: &'a Figure,
    before: &'a Pose,
    limb: Limb,
    target: Target,
    girdle: Option<Girdle>,
    spine: Option<Spine<'a>>,
    /// Rotation vector of the spine's lean in the hips' frame, radians.
    lean: DVec3,
}

impl<'a> Along<'a> {
    /// `None` if nothing is to be brought along.
    fn new(
        figure: &'a Figure,
        before: &'a Pose,
        limb: Limb,
        target: Target,
        mechanics: &Mechanics,
    ) -> Option<Along<'a>> {
        let girdle = Girdle::of(figure, limb).filter(|_| mechanics.collar_rhythm);
        let now = frames(figure, before);
        // What is carried by the torso can't be approached by leaning.
        let still = match target.space {
            Space::World | Space::Body(Bone::Hips) => true,
            Space::Body(bone) => Limb::of(bone).is_some_and(|limb| !limb.is_arm()),
        };
        let share = mechanics.follow();
        let lean = if still && share > 0.0 { lean(figure, before, &now, limb, target) } else { DVec3::ZERO };
        let spine = Spine::of(figure).ok().filter(|_| lean != DVec3::ZERO);
        let any = girdle.is_some() || spine.is_some();
        any.then_some(Along { figure, before, limb, target, girdle, spine, lean: lean * share })
    }

    /// The nearest and the farthest from the shoulder at which the arm can hold the point that reaches, metres.
    fn span(&self, ranges: bool) -> Option<(f64, f64)> {
        let rig = self.figure.limbs.get(self.limb)?;
        let at = self.figure.articulator(self.before, self.limb);
        let in_hinge = rig.in_hinge(self.figure, self.before, at.bone, at.at);
        let hinge = if ranges { rig.ranges.hinge } else { Interval::FREE };
        let hinge = hinge.reaching(rig.state(self.figure, self.before).hinge);
        Some(rig.kin.reach_in(in_hinge, hinge))
    }

    /// The share that is left where the arm alone misses its target: all where it is only too far, fading out where the
    /// shoulder's range stops it. There a little more or less of the collar makes another place the nearest, and the
    /// arm would hop from one to the other.
    fn unstopped(&self, missed: f64, ranges: bool) -> f64 {
        let now = frames(self.figure, self.before);
        let there = now.space(self.target.space).point(self.target.point);
        let distance = now[self.limb.parts().root].position.distance(there);
        let Some((near, far)) = self.span(ranges) else { return 0.0 };
        let stopped = missed - (distance - far).max(near - distance).max(0.0);
        let left = 1.0 - (stopped / FADES_M).clamp(0.0, 1.0);
        left * left * (3.0 - 2.0 * left)
    }

    /// The largest share with which every other limb's hold in the world stays as near as the limb is long.
    fn within_reach(&self, ranges: bool) -> f64 {
        let was = frames(self.figure, self.before);
        let holds: Vec<(Limb, DVec3, f64)> =
            Limb::ALL.into_iter().filter_map(|limb| self.hold(limb, &was)).collect();
        let within = |share: f64| {
            let now = self.brought(share, ranges).map(|pose| frames(self.figure, &pose));
            let near = |now: &Frames| {
                holds.iter().all(|(limb, at, far)| now[limb.parts().root].position.distance(*at) <= *far)
            };
            now.as_ref().is_some_and(near)
        };
        if holds.is_empty() || within(1.0) {
            return 1.0;
        }
        let (mut good, mut bad) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            if within(middle) { good = middle } else { bad = middle }
        }
        good
    }

    /// Where another limb holds on in the world, the point about which it elevates, and how far its root may be from it;
    /// a limb that is stretched already may stay so.
    fn hold(&self, limb: Limb, frames: &Frames) -> Option<(Limb, DVec3, f64)> {
        let (Space::World, _) = self.before.limb(limb).contact.target()? else { return None };
        let rig = self.figure.limbs.get(limb).filter(|_| limb.is_arm() && limb != self.limb)?;
        let about = rig.about(self.figure, self.before);
        let in_limb = rig.kin.articulator(&rig.state(self.figure, self.before), about);
        let at = frames[rig.base].point(rig.point_in_base(in_limb));
        Some((limb, at, rig.kin.reach(about).1.max(in_limb.length())))
    }

    /// The pose with a share of all that is to be brought along.
    fn brought(&self, share: f64, ranges: bool) -> Option<Pose> {
        let mut pose = self.before.clone();
        if let Some(spine) = &self.spine {
            spine.lean(&mut pose, self.before, self.lean * share, ranges).ok()?;
        }
        if let Some(girdle) = &self.girdle {
            let (was, now) = (frames(self.figure, self.before), frames(self.figure, &pose));
            let here = articulator_in(self.figure, self.before, self.limb, Space::World);
            let there = now.space(self.target.space).point(self.target.point);
            let rise = |frames: &Frames, point| girdle.rise_for(frames[girdle.chest].inverse().point(point));
            girdle.raise(&mut pose, self.before, share * (rise(&now, there) - rise(&was, here)), ranges);
            let shoulder = was[self.limb.parts().root].position;
            let allowed = self.span(ranges)?.1.max(shoulder.distance(there));
            let in_chest = now[girdle.chest].inverse().point(there);
            girdle.bring_back(self.figure, &mut pose, self.before, in_chest, allowed, ranges);
        }
        Some(pose)
    }
}

/// The lean of the whole spine that brings the shoulder after a target beyond the arm's easy reach, as a rotation vector
/// in the hips' frame; none for a target that is no farther than the hand was when the gesture began.
fn lean(figure: &Figure, before: &Pose, now: &Frames, limb: Limb, target: Target) -> DVec3 {
    let Some(rig) = figure.limbs.get(limb) else { return DVec3::ZERO };
    let at = figure.articulator(before, limb);
    let (_, far) = rig.kin.reach(rig.in_hinge(figure, before, at.bone, at.at));
    let (foot, shoulder) = (now[Bone::Spine].position, now[limb.parts().root].position);
    let there = now.space(target.space).point(target.point) - shoulder;
    let here = now[at.bone].point(at.at) - shoulder;
    let strain = |distance: f64| {
        let beyond = (distance - EASY * far).max(0.0);
        // Begins without a kink.
        beyond * beyond / (beyond + 0.1 * far).max(f64::MIN_POSITIVE)
    };
    let more = (strain(there.length()) - strain(here.length())).max(0.0);
    let shift = MOST_M * (1.0 - (-more / MOST_M).exp());
    let Some(toward) = there.try_normalize() else { return DVec3::ZERO };
    let arm = shoulder - foot;
    // An even bend's chord goes two thirds of the way of its last segment.
    let turn = arm.cross(toward) * (1.5 * shift / arm.length_squared().max(1e-6));
    now[Bone::Hips].rotation.conjugate() * turn
}

/// How far the shoulder's range keeps a hand off its target until nothing is brought along any more, metres.
const FADES_M: f64 = 0.06;
/// The share of the arm's length up to which no torso follows.
const EASY: f64 = 0.75;
/// The most that a shoulder is brought after a target, metres.
const MOST_M: f64 = 0.3;

/// A collar and what its rhythm is measured by, in the frame of what carries it.
struct Girdle {
    collar: Bone,
    chest: Bone,
    /// The shoulder with the collar at rest.
    shoulder: DVec3,
    /// The arm at rest: from shoulder to elbow.
    arm: DVec3,
    /// How long the arm is, about; metres.
    reach: f64,
    root: crate::Joint,
    range: Interval,
}

impl Girdle {
    /// `None` for a figure whose arm hangs on no collar that can rise.
    fn of(figure: &Figure, limb: Limb) -> Option<Girdle> {
        let parts = limb.parts();
        let joint = |bone| figure.skeleton.joint(bone);
        let (collar, root) = (joint(parts.base)?, joint(parts.root)?);
        let (hinge, end) = (joint(parts.hinge)?, joint(parts.end)?);
        if root.carrier != Some(parts.base) || figure.skeleton.locks().contains(parts.base) {
            return None;
        }
        Some(Girdle {
            collar: parts.base,
            chest: collar.carrier?,
            shoulder: collar.offset + root.offset,
            arm: hinge.offset,
            reach: hinge.offset.length() + end.offset.length(),
            root: root.clone(),
            range: collar.range(Dof::Abduction).filter(|_| collar.has(Dof::Abduction))?,
        })
    }

    /// Where the upper arm points with the collar at rest.
    fn along(&self, angles: Angles) -> DVec3 {
        self.root.rotation(angles) * self.arm
    }

    /// The rise for an arm along a direction, radians.
    fn rise(&self, along: DVec3) -> f64 {
        Rhythm::INMAN.elevation(along, DVec3::NEG_Y).unwrap_or(0.0)
    }

    /// The rise for a hand at a point; near the shoulder, where the direction is of no weight, it fades.
    fn rise_for(&self, point: DVec3) -> f64 {
        let along = point - self.shoulder;
        let out = ((along.length() / self.reach.max(1e-9) - 0.1) / 0.4).clamp(0.0, 1.0);
        self.rise(along) * out * out * (3.0 - 2.0 * out)
    }

    /// Turns the collar so that its shoulder is no farther from a point in the chest's frame than allowed, by the smallest
    /// turn: raising the collar takes the shoulder away from what lies across the body.
    fn bring_back(
        &self,
        figure: &Figure,
        pose: &mut Pose,
        before: &Pose,
        point: DVec3,
        allowed: f64,
        ranges: bool,
    ) {
        let Some(joint) = figure.skeleton.joint(self.collar) else { return };
        let Articulation::Ball { ball, ranges: limits, .. } = &joint.articulation else { return };
        let turned = joint.rotation(pose.angles(self.collar));
        let turn = collar_turn(turned * self.root.offset, point - joint.offset, allowed);
        if let CollarTurn::Turned(turn) = turn {
            for (dof, angle) in Dof::ALL.into_iter().zip(ball.angles(turn * turned)) {
                let range = if ranges { limits[dof as usize] } else { Interval::FREE };
                let range = range.reaching(before.angles(self.collar).get(dof));
                set(pose, self.collar, dof, range.clamp(angle.to_degrees()));
            }
        }
    }

    /// Raises the collar by an angle in radians, as far as it goes.
    fn raise(&self, pose: &mut Pose, before: &Pose, by: f64, ranges: bool) {
        let now = before.angles(self.collar).abduction;
        let range = if ranges { self.range.reaching(now) } else { Interval::FREE };
        set(pose, self.collar, Dof::Abduction, range.clamp(now + by.to_degrees()));
    }
}
