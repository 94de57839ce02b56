//! Inverse gestures as functions from pose to pose.

use glam::DVec3;

use crate::contacts::{contact_order, hold_here, keep_contacts};
use crate::lock::check_unlocked;
use crate::reach::{Elevate, Grip};
use crate::{Articulator, Bone, Contact, Figure, GestureError, Limb, Moved, Pose, Reacher, Space, frames};

/// Where a reach goes: a point in a space, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Target {
    /// The frame in which the point is fixed.
    pub space: Space,
    /// Metres.
    pub point: DVec3,
}

/// Brings a limb's articulator to a target. A limb in contact keeps holding: its target moves there.
///
/// # Errors
/// Numbers that are not finite, limbs that can't be solved, contacts that would go round in a circle.
pub fn reach(
    figure: &Figure,
    before: &Pose,
    limb: Limb,
    target: Target,
    ranges: bool,
) -> Result<Moved, GestureError> {
    reach_from(figure, before, before.clone(), limb, target, ranges)
}

/// As [`reach`] with torso and collar brought along already in `pose`; elevation and branch are those of `before`.
pub(crate) fn reach_from(
    figure: &Figure,
    before: &Pose,
    mut pose: Pose,
    limb: Limb,
    target: Target,
    ranges: bool,
) -> Result<Moved, GestureError> {
    finite(target.point, "the target")?;
    let parts = limb.parts();
    check_unlocked(&figure.skeleton, &[parts.root, parts.hinge])?;
    let now = frames(figure, &pose);
    match &mut pose.limbs[limb.index()].contact {
        Contact::Free => {}
        Contact::Point { space, target: held } => (*space, *held) = (target.space, target.point),
        Contact::Planted { space, target: held, rotation } => {
            // The end keeps its rotation as it is in the world when the target changes its space.
            let in_world = now.space(*space).rotation * *rotation;
            *rotation = (now.space(target.space).rotation.conjugate() * in_world).normalize();
            (*space, *held) = (target.space, target.point);
        }
    }
    contact_order(&pose)?;
    let grip = Grip::new(figure, before, limb, ranges)?;
    let goal = match pose.limb(limb).contact {
        Contact::Free => Contact::Point { space: target.space, target: target.point },
        contact => contact,
    };
    let mut clamped = grip.follow(&mut pose, &now, &goal)?;
    clamped |= keep_contacts(figure, before, &mut pose, &[limb], ranges)?;
    Ok(Moved { pose, clamped })
}

/// Swings the hinge about the line from root to articulator, degrees; `to` is a goal, else a change.
///
/// # Errors
/// As [`reach`].
pub fn elevate(
    figure: &Figure,
    before: &Pose,
    limb: Limb,
    degrees: f64,
    to: bool,
    ranges: bool,
) -> Result<Moved, GestureError> {
    if !degrees.is_finite() {
        return Err(GestureError::NotFinite { what: "the elevation" });
    }
    check_unlocked(&figure.skeleton, &[limb.parts().root])?;
    let grip = Grip::new(figure, before, limb, ranges)?;
    let sense = if limb.is_arm() { 1.0 } else { -1.0 };
    let goal =
        if to { Elevate::To(grip.rig.internal(degrees)) } else { Elevate::By(sense * degrees.to_radians()) };
    let mut pose = before.clone();
    let mut clamped = grip.elevate(&mut pose, goal);
    clamped |= replant(figure, &mut pose, limb, ranges)?;
    clamped |= keep_contacts(figure, before, &mut pose, &[limb], ranges)?;
    Ok(Moved { pose, clamped })
}

/// Turns a planted end back to its rotation after root and hinge have moved about its joint.
fn replant(figure: &Figure, pose: &mut Pose, limb: Limb, ranges: bool) -> Result<bool, GestureError> {
    let contact = pose.limb(limb).contact;
    if !matches!(contact, Contact::Planted { .. }) {
        return Ok(false);
    }
    let swung = pose.clone();
    Grip::new(figure, &swung, limb, ranges)?.follow(pose, &frames(figure, &swung), &contact)
}

/// Takes the other bend of the hinge for the same place of the articulator.
///
/// # Errors
/// The other bend is out of range; else as [`reach`].
pub fn flip(figure: &Figure, before: &Pose, limb: Limb, ranges: bool) -> Result<Moved, GestureError> {
    let parts = limb.parts();
    check_unlocked(&figure.skeleton, &[parts.root])?;
    check_unlocked(&figure.skeleton, &[parts.hinge])?;
    let grip = Grip::new(figure, before, limb, ranges)?;
    let mut pose = before.clone();
    let mut clamped = grip.flip(&mut pose)?;
    clamped |= replant(figure, &mut pose, limb, ranges)?;
    clamped |= keep_contacts(figure, before, &mut pose, &[limb], ranges)?;
    Ok(Moved { pose, clamped })
}

/// Chooses the point of a limb that reaches: nothing moves, and a contact's target becomes the new point's place.
///
/// # Errors
/// A name that the figure lacks, a point on a bone that can't reach.
pub fn articulate(
    figure: &Figure,
    before: &Pose,
    limb: Limb,
    reacher: Reacher,
) -> Result<Pose, GestureError> {
    check_reacher(figure, limb, &reacher)?;
    let mut pose = before.clone();
    pose.limbs[limb.index()].reacher = reacher;
    hold_here(figure, &mut pose, limb);
    Ok(pose)
}

/// Whether a point can reach for a limb.
///
/// # Errors
/// A name that the figure lacks, a point on a bone that can't reach.
pub fn check_reacher(figure: &Figure, limb: Limb, reacher: &Reacher) -> Result<(), GestureError> {
    match reacher {
        Reacher::Named(name) if !figure.articulators[limb.index()].contains_key(name) => {
            let known = figure.articulators[limb.index()].keys().cloned().collect::<Vec<_>>().join(", ");
            Err(GestureError::NoArticulator { limb, name: name.clone(), known })
        }
        Reacher::Named(_) => Ok(()),
        Reacher::Point(bone, at) => {
            finite(*at, "the articulator")?;
            let reaches = Limb::of(*bone) == Some(limb) && *bone >= limb.parts().hinge;
            if !reaches {
                return Err(GestureError::NotOnLimb { limb, bone: *bone });
            }
            figure.skeleton.joint(*bone).map(|_| ()).ok_or(GestureError::NoBone(*bone))
        }
    }
}

/// Holds a limb's articulator where it is now, in a space; or lets go.
///
/// # Errors
/// A space that the figure lacks, a contact on the limb itself or round in a circle.
pub fn keep(figure: &Figure, before: &Pose, limb: Limb, contact: Contact) -> Result<Pose, GestureError> {
    if let Some((Space::Body(bone), _)) = contact.target() {
        figure.skeleton.joint(bone).ok_or(GestureError::NoBone(bone))?;
    }
    let mut pose = before.clone();
    pose.limbs[limb.index()].contact = contact;
    contact_order(&pose)?;
    hold_here(figure, &mut pose, limb);
    Ok(pose)
}

/// Shifts the hips by a vector of the world; limbs in contact keep their targets.
///
/// # Errors
/// Numbers that are not finite, limbs that can't be solved.
pub fn move_hips(figure: &Figure, before: &Pose, by: DVec3, ranges: bool) -> Result<Moved, GestureError> {
    finite(by, "the shift")?;
    check_unlocked(&figure.skeleton, &[Bone::Hips])?;
    let mut pose = before.clone();
    pose.hips += pose.place.world_from_figure().rotation.conjugate() * by;
    let clamped = keep_contacts(figure, before, &mut pose, &[], ranges)?;
    Ok(Moved { pose, clamped })
}

/// Shifts the whole figure and turns it about the vertical through its place, degrees; contacts with the world go along.
///
/// # Errors
/// Numbers that are not finite.
pub fn place(before: &Pose, by: DVec3, turn: f64) -> Result<Pose, GestureError> {
    finite(by, "the shift")?;
    if !turn.is_finite() {
        return Err(GestureError::NotFinite { what: "the turn" });
    }
    let mut pose = before.clone();
    let was = before.place.world_from_figure();
    pose.place.position += by;
    pose.place.turn += turn;
    let after_from_before = pose.place.world_from_figure().then(was.inverse());
    for state in &mut pose.limbs {
        match &mut state.contact {
            Contact::Point { space: Space::World, target } => *target = after_from_before.point(*target),
            Contact::Planted { space: Space::World, target, rotation } => {
                *target = after_from_before.point(*target);
                *rotation = (after_from_before.rotation * *rotation).normalize();
            }
            _ => {}
        }
    }
    Ok(pose)
}

/// Where a limb's articulator is, in a space, metres.
pub fn articulator_in(figure: &Figure, pose: &Pose, limb: Limb, space: Space) -> DVec3 {
    let frames = frames(figure, pose);
    let Articulator { bone, at } = figure.articulator(pose, limb);
    frames.space(space).inverse().point(frames[bone].point(at))
}

pub(crate) fn finite(v: DVec3, what: &'static str) -> Result<(), GestureError> {
    // Far beyond any scene, and small enough that squares stay finite.
    let usable = v.is_finite() && v.abs().max_element() < 1e6;
    usable.then_some(()).ok_or(GestureError::NotFinite { what })
}

/// Whether the figure has every joint that a limb needs to reach.
///
/// # Errors
/// The limb that lacks one.
pub fn limb_parts_present(figure: &Figure, limb: Limb) -> Result<(), GestureError> {
    figure.limbs.get(limb).map(|_| ()).ok_or(GestureError::NoLimb(limb))
}

/// Whether the figure has a bone, as an error if not.
pub(crate) fn present(figure: &Figure, bone: Bone) -> Result<&crate::Joint, GestureError> {
    figure.skeleton.joint(bone).ok_or(GestureError::NoBone(bone))
}
