//! Contacts: in which order limbs follow them, and which need to.

use glam::{DQuat, DVec3};

use crate::evaluation::angle_between;
use crate::reach::Grip;
use crate::{Bone, Contact, Figure, Frames, GestureError, Limb, Pose, Space, frames};

/// Limbs such that each comes after those that carry its contact's space.
///
/// # Errors
/// Contacts that go round in a circle, by name.
pub fn contact_order(pose: &Pose) -> Result<[Limb; 4], GestureError> {
    let mut order = Vec::with_capacity(4);
    for limb in Limb::ALL {
        let mut path = vec![limb];
        while let Some(next) = path.last().and_then(|l| carrier(pose, *l)) {
            if let Some(at) = path.iter().position(|l| *l == next) {
                return Err(GestureError::Cycle(path[at..].to_vec()));
            }
            path.push(next);
        }
        for limb in path.into_iter().rev() {
            if !order.contains(&limb) {
                order.push(limb);
            }
        }
    }
    order.try_into().map_err(GestureError::Cycle)
}

/// The limb on which a limb holds, if it holds on one.
fn carrier(pose: &Pose, limb: Limb) -> Option<Limb> {
    match pose.limb(limb).contact.target()? {
        (Space::Body(bone), _) => Limb::of(bone),
        (Space::World, _) => None,
    }
}

/// Brings every limb in contact back to its target after the pose has changed from `before`.
///
/// A limb whose root, target and articulator have kept their places to each other keeps its bits. `moved`
/// are the limbs that the gesture itself moved: they are left as they are. Elevation and branch are those of
/// `before`. Returns whether a limb was stopped by a range.
pub(crate) fn keep_contacts(
    figure: &Figure,
    before: &Pose,
    pose: &mut Pose,
    moved: &[Limb],
    ranges: bool,
) -> Result<bool, GestureError> {
    let order = contact_order(pose)?;
    if pose.limbs.iter().all(|l| l.contact == Contact::Free) {
        return Ok(false);
    }
    let (before_frames, mut now) = (frames(figure, before), frames(figure, pose));
    let mut limited = false;
    for limb in order {
        let contact = pose.limb(limb).contact;
        if moved.contains(&limb) || contact == Contact::Free {
            continue;
        }
        let was = relation(figure, before, &before_frames, limb, &contact);
        let is = relation(figure, pose, &now, limb, &contact);
        if was.near(&is) {
            continue;
        }
        let grip = Grip::new(figure, before, limb, ranges)?;
        limited |= grip.follow(pose, &now, &contact)?;
        now = frames(figure, pose);
    }
    Ok(limited)
}

/// How a limb's target lies to what carries its root, and its articulator to its end.
struct Relation {
    target_in_base: DVec3,
    rotation_in_base: DQuat,
    articulator_in_end: DVec3,
}

impl Relation {
    fn near(&self, other: &Relation) -> bool {
        self.target_in_base.distance(other.target_in_base) < 1e-12
            && self.articulator_in_end.distance(other.articulator_in_end) < 1e-12
            && angle_between(self.rotation_in_base, other.rotation_in_base) < 1e-12
    }
}

fn relation(figure: &Figure, pose: &Pose, frames: &Frames, limb: Limb, contact: &Contact) -> Relation {
    let parts = limb.parts();
    let base = figure.skeleton.joint(parts.root).and_then(|j| j.carrier).unwrap_or(Bone::Hips);
    let base_from_world = frames[base].inverse();
    let (space, target) = contact.target().unwrap_or((Space::World, DVec3::ZERO));
    let space = frames.space(space);
    let rotation = match contact {
        Contact::Planted { rotation, .. } => *rotation,
        _ => DQuat::IDENTITY,
    };
    let at = figure.articulator(pose, limb);
    let planted = matches!(contact, Contact::Planted { .. });
    Relation {
        target_in_base: base_from_world.point(space.point(target)),
        rotation_in_base: if planted {
            base_from_world.rotation * space.rotation * rotation
        } else {
            rotation
        },
        articulator_in_end: frames[parts.end].inverse().point(frames[at.bone].point(at.at)),
    }
}

/// Holds the limb where it is: its contact's target and rotation are read off the pose.
pub(crate) fn hold_here(figure: &Figure, pose: &mut Pose, limb: Limb) {
    let frames = frames(figure, pose);
    let at = figure.articulator(pose, limb);
    let here = frames[at.bone].point(at.at);
    let end = frames[limb.parts().end].rotation;
    match &mut pose.limbs[limb.index()].contact {
        Contact::Free => {}
        Contact::Point { space, target } => *target = frames.space(*space).inverse().point(here),
        Contact::Planted { space, target, rotation } => {
            let from_world = frames.space(*space).inverse();
            *target = from_world.point(here);
            *rotation = (from_world.rotation * end).normalize();
        }
    }
}
