//! A pose made with one figure fitted to another: feet on the ground, hands where they were on the body.

use glam::{DQuat, DVec3};

use crate::blend::held;
use crate::reach::Grip;
use crate::{
    Angles, Bone, Contact, Figure, Frames, Joint, Limb, LimbState, Locks, Place, Pose, PosePatch, Reacher,
    Size, Skeleton, Space, contact_order, frames,
};

/// Rounds in which the hips give way to feet that the legs can't bring to the ground.
const ROUNDS: usize = 12;
/// From this far off its target a foot moves the hips, metres.
const OFF: f64 = 1e-3;

/// Rounds in which a free foot is brought to its height over the ground.
const RISES: usize = 6;
const GROUNDINGS: usize = 3;
/// A free foot whose sole lies no higher than this stands on the ground, metres.
const GROUNDED: f64 = 0.05;

/// A patch as it fits a figure: one that was made with a figure of another [`Size`] is scaled to this one.
///
/// Angles are kept, inside the ranges that this figure has. The hips' place goes by the length of the legs, as do
/// targets in the world, about the place of the figure; feet in contact come as high over the ground, by their soles,
/// as they were in proportion, and so do free feet that rest on it. Targets and articulators on a body go by the size of that part of it. Then limbs in
/// contact are brought to their targets, and the hips give way to feet that would not reach theirs.
///
/// A patch that names no size, or this figure's to a thousandth, is returned as it is, bit for bit. Contacts that a limb can't reach
/// keep their targets.
#[must_use]
pub fn fitted(figure: &Figure, patch: &PosePatch) -> PosePatch {
    let here = Size::of(&figure.skeleton);
    let Some(made_with) = patch.size.filter(|size| !here.is_near(size)) else { return patch.clone() };
    let ratio = here.over(&made_with);
    let mut fitted = PosePatch { size: Some(here), ..patch.clone() };
    fitted.hips = patch.hips.map(|hips| hips * ratio.hips);
    for (bone, angles) in &mut fitted.joints {
        *angles = held(figure, *bone, Angles::REST, *angles);
    }
    for state in fitted.limbs.values_mut() {
        if let Reacher::Point(bone, at) = &mut state.reacher {
            *at *= ratio.of_bone(*bone);
        }
    }
    let grounded = grounded(figure, patch, &ratio);
    let pose = fitted.onto(&figure.rest_pose());
    let posed = frames(figure, &pose);
    for (limb, state) in &mut fitted.limbs {
        let sole = Sole { figure, pose: &pose, frames: &posed, limb: *limb, ratio: &ratio };
        state.contact = sole.contact(&state.contact);
    }
    met(figure, fitted, &grounded)
}

/// How high the soles of free feet on the ground should come, metres in figure space.
fn grounded(figure: &Figure, patch: &PosePatch, ratio: &Size) -> Vec<(Limb, f64)> {
    let Some(made_with) = unscaled(figure, ratio) else { return Vec::new() };
    let was = patch.onto(&made_with.rest_pose());
    let free = |limb: &Limb| {
        !limb.is_arm()
            && was.limb(*limb).contact == Contact::Free
            && patch.joints.contains_key(&limb.parts().root)
    };
    let legs = Limb::ALL.into_iter().filter(free);
    let soles = legs.filter_map(|limb| Some((limb, sole(&made_with, &was, limb)?)));
    soles.filter(|(_, high)| *high < GROUNDED).map(|(limb, high)| (limb, high * ratio.hips)).collect()
}

/// The figure that a pose was made with, as far as its size tells: this one, scaled back.
fn unscaled(figure: &Figure, ratio: &Size) -> Option<Figure> {
    let mut joints: Vec<Joint> = figure.skeleton.joints().cloned().collect();
    for joint in &mut joints {
        joint.offset /= joint.carrier.map_or(DVec3::splat(ratio.hips), |carrier| ratio.of_bone(carrier));
    }
    let skeleton = Skeleton::new(joints).ok()?;
    let bare = Figure { skin: None, ..figure.with_locks(&figure.rest_pose(), Locks::NONE, true) };
    let mut articulators = bare.articulators.clone();
    for point in articulators.iter_mut().flat_map(|points| points.values_mut()) {
        point.at /= ratio.of_bone(point.bone);
    }
    Some(Figure { skeleton, articulators, ..bare })
}

/// The lowest of a foot's named points, metres in figure space; `None` if it has none.
fn sole(figure: &Figure, pose: &Pose, limb: Limb) -> Option<f64> {
    let figure_from_world = pose.place.world_from_figure().inverse();
    let posed = frames(figure, pose);
    let points = figure.articulators[limb.index()].values();
    points.map(|a| figure_from_world.point(posed[a.bone].point(a.at)).y).min_by(f64::total_cmp)
}

/// One limb's contact on its way to another figure.
struct Sole<'a> {
    figure: &'a Figure,
    pose: &'a Pose,
    frames: &'a Frames,
    limb: Limb,
    ratio: &'a Size,
}

impl Sole<'_> {
    fn contact(&self, contact: &Contact) -> Contact {
        let place = |space: Space, target: DVec3, rotation: Option<DQuat>| match space {
            Space::Body(bone) => target * self.ratio.of_bone(bone),
            Space::World => self.in_world(target, rotation),
        };
        match *contact {
            Contact::Free => Contact::Free,
            Contact::Point { space, target } => Contact::Point { space, target: place(space, target, None) },
            Contact::Planted { space, target, rotation } => {
                Contact::Planted { space, target: place(space, target, Some(rotation)), rotation }
            }
        }
    }

    /// A target in the world, about the place of the figure by the length of the legs; a foot's by its sole.
    fn in_world(&self, target: DVec3, rotation: Option<DQuat>) -> DVec3 {
        let world_from_figure = self.pose.place.world_from_figure();
        let was = world_from_figure.inverse().point(target);
        let mut is = was * self.ratio.hips;
        if !self.limb.is_arm() {
            let end = self.frames[self.limb.parts().end].rotation;
            let lowest = self.lowest(rotation.unwrap_or(end));
            let lowest_was = lowest / self.ratio.ankle;
            is.y = (was.y + lowest_was) * self.ratio.hips - lowest;
        }
        world_from_figure.point(is)
    }

    /// How far the lowest point of the sole lies below the articulator (below is negative), the foot being turned so.
    fn lowest(&self, world_from_foot: DQuat) -> f64 {
        let end = self.limb.parts().end;
        let foot_from_world = self.frames[end].inverse();
        let in_foot = |bone: Bone, at: DVec3| foot_from_world.point(self.frames[bone].point(at));
        let own = self.figure.articulator(self.pose, self.limb);
        let own = in_foot(own.bone, own.at);
        let points = &self.figure.articulators[self.limb.index()];
        let below = points.values().map(|a| in_foot(a.bone, a.at));
        let heights = below.map(|p| (world_from_foot * (p - own)).y);
        heights.fold(0.0, f64::min)
    }
}

/// Brings the limbs of a patch to their targets, where it names both their joints and a contact.
fn met(figure: &Figure, mut patch: PosePatch, grounded: &[(Limb, f64)]) -> PosePatch {
    let mut pose = patch.onto(&figure.rest_pose());
    let Ok(order) = contact_order(&pose) else { return patch };
    let whole = |limb: &Limb| {
        let parts = limb.parts();
        patch.limbs.contains_key(limb)
            && [parts.root, parts.hinge, parts.end].iter().all(|bone| patch.joints.contains_key(bone))
    };
    let limbs: Vec<Limb> = order.into_iter().filter(whole).collect();
    let start = pose.clone();
    for round in 0..ROUNDS {
        for limb in &limbs {
            follow(figure, &start, &mut pose, *limb);
        }
        let off = short(figure, &pose, &limbs);
        if off.length() < OFF || patch.hips.is_none() || round + 1 == ROUNDS {
            break;
        }
        pose.hips += pose.place.world_from_figure().rotation.conjugate() * off;
        for limb in &limbs {
            restore(&start, &mut pose, *limb);
        }
    }
    ground(figure, &mut pose, grounded, patch.hips.is_some());
    // Hands on a leg that has moved come along.
    for limb in limbs.iter().filter(|limb| limb.is_arm() && !grounded.is_empty()) {
        restore(&start, &mut pose, *limb);
        follow(figure, &start, &mut pose, *limb);
    }
    patch.hips = patch.hips.map(|_| pose.hips);
    for (bone, angles) in &mut patch.joints {
        *angles = pose.angles(*bone);
    }
    patch
}

/// Brings one limb to its contact, elevation and branch as at the start; one that can't be solved stays.
fn follow(figure: &Figure, start: &Pose, pose: &mut Pose, limb: Limb) {
    let contact = pose.limb(limb).contact;
    let Ok(grip) = Grip::new(figure, start, limb, true) else { return };
    let mut solved = pose.clone();
    if grip.follow(&mut solved, &frames(figure, pose), &contact).is_ok() {
        *pose = solved;
    }
}

/// Brings free feet to their heights over the ground; what they can't rise, the hips do if they may.
fn ground(figure: &Figure, pose: &mut Pose, grounded: &[(Limb, f64)], with_hips: bool) {
    for _ in 0..GROUNDINGS {
        let mut sunk = 0.0_f64;
        for (limb, high) in grounded {
            // Each time from where it then is: a leg that the ranges stop may need to swing out further.
            for _ in 0..RISES {
                let by = sole(figure, pose, *limb).map_or(0.0, |is| high - is);
                if by.abs() < OFF {
                    break;
                }
                rise(figure, pose, *limb, by);
            }
            sunk = sunk.max(sole(figure, pose, *limb).map_or(0.0, |is| high - is));
        }
        if sunk < OFF || !with_hips {
            return;
        }
        pose.hips.y += sunk;
    }
}

/// Brings a free foot higher by some metres, its turn in the world kept.
fn rise(figure: &Figure, pose: &mut Pose, limb: Limb, by: f64) {
    let foot = frames(figure, pose)[limb.parts().end];
    let mut held = pose.clone();
    held.limbs[limb.index()] = LimbState {
        reacher: Reacher::Point(limb.parts().end, DVec3::ZERO),
        contact: Contact::Planted {
            space: Space::World,
            target: foot.position + DVec3::Y * by,
            rotation: foot.rotation,
        },
    };
    follow(figure, &held.clone(), &mut held, limb);
    pose.angles = held.angles;
}

fn restore(start: &Pose, pose: &mut Pose, limb: Limb) {
    let parts = limb.parts();
    for bone in [parts.root, parts.hinge, parts.end] {
        pose.angles[bone.index()] = start.angles(bone);
    }
}

/// The mean way from the feet that hold on to the world to their targets, metres; zero if both meet them.
fn short(figure: &Figure, pose: &Pose, limbs: &[Limb]) -> DVec3 {
    let posed = frames(figure, pose);
    let mut ways = Vec::new();
    for limb in limbs.iter().filter(|limb| !limb.is_arm()) {
        if let Some((Space::World, target)) = pose.limb(*limb).contact.target() {
            let at = figure.articulator(pose, *limb);
            ways.push(target - posed[at.bone].point(at.at));
        }
    }
    let count = ways.len().max(1) as f64;
    ways.into_iter().sum::<DVec3>() / count
}

/// Reads a pose file for a figure: checked, and fitted where it was made with one of another size.
///
/// # Errors
/// Faults of the text with their places; what the figure lacks as a fault of the whole.
pub fn read_pose(figure: &Figure, text: &str) -> Result<PosePatch, crate::TextFault> {
    let patch = crate::parse_pose(text)?;
    crate::check_patch(figure, &patch).map_err(|fault| crate::TextFault::whole(fault.to_string()))?;
    Ok(fitted(figure, &patch))
}

/// A whole pose of one figure as it fits another; the place stays.
pub fn carried_over(from: &Figure, pose: &Pose, to: &Figure) -> Pose {
    let patch = PosePatch {
        figure: None,
        size: Some(Size::of(&from.skeleton)),
        place: Some(Place { ..pose.place }),
        hips: Some(pose.hips),
        joints: Bone::ALL.into_iter().map(|bone| (bone, pose.angles(bone))).collect(),
        limbs: Limb::ALL.into_iter().map(|limb| (limb, pose.limb(limb).clone())).collect(),
    };
    fitted(to, &patch).onto(&to.rest_pose())
}
