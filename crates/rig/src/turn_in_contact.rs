//! Turning the end, or the forearm's twist, about the articulator, which stays.

use crate::contacts::keep_contacts;
use crate::evaluation::angle_between;
use crate::lock::check_unlocked;
use crate::reach::Grip;
use crate::turn::bisected;
use crate::{
    Bone, Contact, Dof, Figure, GestureError, Limb, Moved, Pose, Space, articulator_in, frames, live_range,
};

/// The joint that carries an angle of turning in contact: wrist flexion and abduction, forearm twist; the ankle's three.
///
/// # Errors
/// An angle that the limb's end lacks.
pub fn contact_joint(figure: &Figure, limb: Limb, dof: Dof) -> Result<Bone, GestureError> {
    let parts = limb.parts();
    let bone = if limb.is_arm() && dof == Dof::Twist { parts.hinge } else { parts.end };
    let has = figure.skeleton.joint(bone).is_some_and(|joint| joint.has(dof));
    let allowed = if limb.is_arm() {
        "flexion and abduction of the wrist and twist of the forearm"
    } else {
        "flexion, abduction and twist of the foot"
    };
    has.then_some(bone).ok_or(GestureError::NotInContact { limb, allowed })
}

/// Turns an angle of the end to a value in degrees while the articulator stays: root and hinge follow with the
/// elevation kept. Stops at the last angle, going from where it is, that keeps the contact.
///
/// # Errors
/// An angle that the end lacks, numbers that are not finite, a limb that can't be solved.
pub fn turn_in_contact(
    figure: &Figure,
    before: &Pose,
    limb: Limb,
    dof: Dof,
    degrees: f64,
    ranges: bool,
) -> Result<Moved, GestureError> {
    let bone = contact_joint(figure, limb, dof)?;
    let joint = crate::gesture::present(figure, bone)?;
    check_unlocked(&figure.skeleton, &[bone])?;
    if !degrees.is_finite() {
        return Err(GestureError::NotFinite { what: "the angle" });
    }
    let now = before.angles(bone).get(dof);
    let goal = live_range(joint, before.angles(bone), dof, ranges).clamp(degrees);
    let turner = Turner::new(figure, before, limb, bone, dof, ranges)?;
    let mut held = now;
    while held != goal {
        let next = if (goal - held).abs() <= STEP { goal } else { held + STEP * (goal - held).signum() };
        if turner.keeps(next) {
            held = next;
        } else {
            held = bisected(held, next, &|angle| turner.keeps(angle));
            break;
        }
    }
    let mut pose = if held == now { before.clone() } else { turner.turned(held)? };
    turner.take_rotation_along(&mut pose);
    let clamped = keep_contacts(figure, before, &mut pose, &[limb], ranges)?;
    Ok(Moved { pose, clamped: clamped || (held - degrees).abs() > 1e-9 })
}

/// Degrees between the angles that are tried on the way.
const STEP: f64 = 1.0;

struct Turner<'a> {
    grip: Grip<'a>,
    bone: Bone,
    dof: Dof,
    contact: Contact,
    missed: f64,
}

impl<'a> Turner<'a> {
    fn new(
        figure: &'a Figure,
        before: &'a Pose,
        limb: Limb,
        bone: Bone,
        dof: Dof,
        ranges: bool,
    ) -> Result<Turner<'a>, GestureError> {
        // The line that elevation turns about is the articulator's here, planted or not.
        let grip = Grip::about_articulator(figure, before, limb, ranges)?;
        let (space, target) = before
            .limb(limb)
            .contact
            .target()
            .unwrap_or_else(|| (Space::World, articulator_in(figure, before, limb, Space::World)));
        let missed = articulator_in(figure, before, limb, space).distance(target);
        Ok(Turner { grip, bone, dof, contact: Contact::Point { space, target }, missed })
    }

    /// The pose with the end at an angle and the articulator brought back.
    fn turned(&self, degrees: f64) -> Result<Pose, GestureError> {
        let mut pose = self.grip.before.clone();
        pose.angles[self.bone.index()].set(self.dof, degrees);
        let base = frames(self.grip.figure, self.grip.before);
        self.grip.follow_strictly(&mut pose, &base, &self.contact)?;
        Ok(pose)
    }

    /// Whether the contact holds at an angle as well as it does now, with the elevation kept.
    fn keeps(&self, degrees: f64) -> bool {
        let (limb, figure) = (self.grip.rig.limb, self.grip.figure);
        let (Ok(pose), Contact::Point { space, target }) = (self.turned(degrees), self.contact) else {
            return false;
        };
        articulator_in(figure, &pose, limb, space).distance(target) <= self.missed + 1e-11
    }

    /// A planted end was turned on purpose: its new rotation is the one to keep.
    fn take_rotation_along(&self, pose: &mut Pose) {
        let (figure, limb) = (self.grip.figure, self.grip.rig.limb);
        let end = limb.parts().end;
        let (was, is) = (frames(figure, self.grip.before), frames(figure, pose));
        if let Contact::Planted { space, rotation, .. } = &mut pose.limbs[limb.index()].contact {
            let turned = is[end].rotation * was[end].rotation.conjugate();
            if angle_between(is[end].rotation, was[end].rotation) > 0.0 {
                let space = was.space(*space).rotation;
                *rotation = (space.conjugate() * turned * space * *rotation).normalize();
            }
        }
    }
}
