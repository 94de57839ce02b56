//! Forward gestures: one angle of one joint, and the live interval in which it may move.

use kin::{Cone, Interval};

use crate::contacts::{hold_here, keep_contacts};
use crate::lock::check_unlocked;
use crate::{Angles, Articulation, Bone, Dof, Figure, GestureError, Joint, Limb, Pose};

/// What a gesture made of a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Moved {
    /// The pose after it.
    pub pose: Pose,
    /// Whether a range, the reach or a contact stopped it short.
    pub clamped: bool,
}

/// A slider: one angle, where it is and where it may go now.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slider {
    /// Which angle.
    pub dof: Dof,
    /// Degrees.
    pub value: f64,
    /// The interval around the value in which the other angles of the joint let it move, degrees.
    pub range: Interval,
}

/// The sliders of a bone's joint, outermost axis first; none if the figure lacks the bone.
pub fn sliders(figure: &Figure, pose: &Pose, bone: Bone, ranges: bool) -> Vec<Slider> {
    let Some(joint) = figure.skeleton.joint(bone) else { return Vec::new() };
    let angles = pose.angles(bone);
    let slider = |dof| Slider { dof, value: angles.get(dof), range: live_range(joint, angles, dof, ranges) };
    joint.dofs().map(slider).collect()
}

/// The interval in which one angle of a joint may move now, degrees. It holds the angle itself, even
/// where that lies outside the joint's range; with `ranges` off it is a whole turn either way.
pub fn live_range(joint: &Joint, angles: Angles, dof: Dof, ranges: bool) -> Interval {
    let value = angles.get(dof);
    let whole = Interval::new(-180.0, 180.0).reaching(value);
    let Some(range) = joint.range(dof).filter(|_| ranges) else { return whole };
    let range = Interval { min: range.min.max(-180.0), max: range.max.min(180.0) }.reaching(value);
    match &joint.articulation {
        Articulation::Ball { cone: Some(cone), .. } if dof != Dof::Twist => {
            cone_interval(joint, angles, dof, cone, range)
        }
        _ => range,
    }
}

/// The interval of a swing angle around its value that keeps the bone in the cone: found by walking out a degree at
/// a time, its ends by bisection to 1e-10 degrees.
fn cone_interval(joint: &Joint, angles: Angles, dof: Dof, cone: &Cone, range: Interval) -> Interval {
    let bone = joint.bone_direction().unwrap_or(cone.axis);
    let bone_at = |value: f64| {
        let mut at = angles;
        at.set(dof, value);
        joint.rotation(at) * bone
    };
    let value = angles.get(dof);
    let cone = cone.reaching(bone_at(value));
    let other = if dof == Dof::Flexion { angles.abduction } else { angles.flexion };
    // A swing vector longer than half a turn says the same as a shorter one the other way round.
    let inside = |value: f64| cone.contains(bone_at(value), 1e-13) && value.hypot(other) <= 179.9;
    let edge = |end: f64| {
        let (mut good, step) = (value, (end - value).signum());
        for _ in 0..WALK {
            let next = if (end - good).abs() <= 1.0 { end } else { good + step };
            if !inside(next) {
                return bisected(good, next, &inside);
            }
            good = next;
            if good == end {
                break;
            }
        }
        good
    };
    Interval { min: edge(range.min), max: edge(range.max) }
}

/// Steps of a walk: a whole turn either way.
const WALK: usize = 360;

/// The last good value between a good and a bad one.
pub(crate) fn bisected(mut good: f64, mut bad: f64, is_good: &dyn Fn(f64) -> bool) -> f64 {
    while (good - bad).abs() > 1e-11 {
        let middle = 0.5 * (good + bad);
        if middle == good || middle == bad {
            break;
        }
        if is_good(middle) { good = middle } else { bad = middle }
    }
    good
}

/// Turns one angle of a joint to a value in degrees; limbs in contact keep their targets, and a contact of the limb
/// that is turned moves along with it.
///
/// # Errors
/// A bone or degree of freedom that the figure lacks, a number that is not finite, a limb that can't be solved.
pub fn turn(
    figure: &Figure,
    before: &Pose,
    bone: Bone,
    dof: Dof,
    degrees: f64,
    ranges: bool,
) -> Result<Moved, GestureError> {
    turn_along(figure, before, bone, dof, degrees, ranges, |_| ())
}

/// As [`turn`]; what the turned joint brings along is done to the pose before its limb's contact is read off it.
pub(crate) fn turn_along(
    figure: &Figure,
    before: &Pose,
    bone: Bone,
    dof: Dof,
    degrees: f64,
    ranges: bool,
    along: impl FnOnce(&mut Pose),
) -> Result<Moved, GestureError> {
    let joint = figure.skeleton.joint(bone).ok_or(GestureError::NoBone(bone))?;
    if !joint.has(dof) {
        return Err(GestureError::NoDof { bone, dof, has: joint.dofs().collect() });
    }
    if !degrees.is_finite() {
        return Err(GestureError::NotFinite { what: "the angle" });
    }
    check_unlocked(&figure.skeleton, &[bone])?;
    let held =
        if ranges { live_range(joint, before.angles(bone), dof, true).clamp(degrees) } else { degrees };
    let mut pose = before.clone();
    pose.angles[bone.index()].set(dof, held);
    along(&mut pose);
    let own = Limb::of(bone).filter(|limb| bone <= limb.parts().end);
    if let Some(limb) = own {
        hold_here(figure, &mut pose, limb);
    }
    let limited = keep_contacts(figure, before, &mut pose, own.as_slice(), ranges)?;
    Ok(Moved { pose, clamped: limited || (held - degrees).abs() > 1e-9 })
}
