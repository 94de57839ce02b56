//! Poses and handshapes blended in, parts put back to rest or mirrored.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use crate::contacts::{hold_here, keep_contacts};
use crate::{
    Angles, Articulation, Bone, Contact, Dof, Figure, GestureError, Limb, LimbState, Moved, Part, Place,
    Pose, Reacher, Side, Size, Space,
};

/// Some of a pose: what a file names.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PosePatch {
    /// The name of the figure that it was made with.
    pub figure: Option<String>,
    /// The size of that figure.
    pub size: Option<Size>,
    /// Where the figure stands.
    pub place: Option<Place>,
    /// The hips joint in figure space, metres.
    pub hips: Option<DVec3>,
    /// Angles by bone.
    pub joints: BTreeMap<Bone, Angles>,
    /// Limbs.
    pub limbs: BTreeMap<Limb, LimbState>,
}

impl PosePatch {
    /// The pose that the patch makes of another: what it names is replaced.
    pub fn onto(&self, pose: &Pose) -> Pose {
        let mut pose = pose.clone();
        pose.place = self.place.unwrap_or(pose.place);
        pose.hips = self.hips.unwrap_or(pose.hips);
        for (bone, angles) in &self.joints {
            pose.angles[bone.index()] = *angles;
        }
        for (limb, state) in &self.limbs {
            pose.limbs[limb.index()] = state.clone();
        }
        pose
    }
}

/// The named parts, all if none is named.
fn wanted(parts: &[Part]) -> impl Fn(Part) -> bool + '_ {
    move |part| parts.is_empty() || parts.contains(&part)
}

/// The part whose limb this is: contacts go with arms and legs.
fn part_of(limb: Limb) -> Part {
    match limb {
        Limb::LeftArm => Part::LeftArm,
        Limb::RightArm => Part::RightArm,
        Limb::LeftLeg => Part::LeftLeg,
        Limb::RightLeg => Part::RightLeg,
    }
}

/// After a forward change of some limbs: their contacts move along, other limbs follow theirs.
fn settle(
    figure: &Figure,
    before: &Pose,
    mut pose: Pose,
    set: &[Limb],
    ranges: bool,
) -> Result<Moved, GestureError> {
    let locks = figure.skeleton.locks();
    for bone in locks.iter() {
        pose.angles[bone.index()] = before.angles(bone);
    }
    if locks.contains(Bone::Hips) {
        pose.hips = before.hips;
    }
    for limb in set {
        hold_here(figure, &mut pose, *limb);
    }
    let clamped = keep_contacts(figure, before, &mut pose, set, ranges)?;
    Ok(Moved { pose, clamped })
}

/// Blends parts of a pose toward a patch: 0 leaves them, 1 is the patch, beyond is more of the same. The place of
/// the figure stays.
///
/// Ball joints go by the shortest turn from 0 to 1 and by their angles beyond, hinges by the angle, so that no joint
/// jumps as the amount grows. At amount 1 limbs take the patch's contacts, held where they then are; otherwise they
/// keep their own, which move along.
///
/// # Errors
/// An amount that is not finite, contacts that would go round in a circle, limbs that can't be solved.
pub fn apply_patch(
    figure: &Figure,
    before: &Pose,
    patch: &PosePatch,
    parts: &[Part],
    amount: f64,
    ranges: bool,
) -> Result<Moved, GestureError> {
    if !amount.is_finite() || amount.abs() > 1e3 {
        return Err(GestureError::NotFinite { what: "the amount" });
    }
    let wanted = wanted(parts);
    let mut pose = before.clone();
    for (bone, goal) in patch.joints.iter().filter(|(bone, _)| wanted(bone.part())) {
        let from = before.angles(*bone);
        let to = blended(figure, *bone, from, *goal, amount);
        pose.angles[bone.index()] = if ranges { held(figure, *bone, from, to) } else { to };
    }
    if let Some(hips) = patch.hips.filter(|_| wanted(Part::Torso)) {
        pose.hips = if amount == 1.0 { hips } else { before.hips.lerp(hips, amount) };
    }
    let set: Vec<Limb> =
        Limb::ALL.into_iter().filter(|l| wanted(part_of(*l)) && touches(patch, *l)).collect();
    for limb in &set {
        if let Some(state) = patch.limbs.get(limb).filter(|_| amount == 1.0) {
            pose.limbs[limb.index()] = state.clone();
        }
    }
    settle(figure, before, pose, &set, ranges)
}

/// Whether a patch says anything of a limb's own joints or contact.
fn touches(patch: &PosePatch, limb: Limb) -> bool {
    let parts = limb.parts();
    patch.limbs.contains_key(&limb) || patch.joints.keys().any(|b| *b >= parts.root && *b <= parts.end)
}

fn blended(figure: &Figure, bone: Bone, from: Angles, to: Angles, amount: f64) -> Angles {
    if amount == 1.0 {
        return to;
    }
    let mix = |dof: Dof| from.get(dof) + (to.get(dof) - from.get(dof)) * amount;
    let mixed = Angles { flexion: mix(Dof::Flexion), abduction: mix(Dof::Abduction), twist: mix(Dof::Twist) };
    let joint = figure.skeleton.joint(bone);
    match joint.map(|j| (j, &j.articulation)) {
        // Beyond the ends a turn that goes on would pass the point opposite to rest, where angles change sides.
        Some((joint, Articulation::Ball { ball, .. })) if (0.0..=1.0).contains(&amount) => {
            let (a, b) = (joint.rotation(from), joint.rotation(to));
            let turn = a.conjugate() * b;
            let turn = if turn.w < 0.0 { -turn } else { turn };
            let [flexion, abduction, twist] =
                ball.angles(a * DQuat::from_scaled_axis(turn.to_scaled_axis() * amount));
            Angles {
                flexion: flexion.to_degrees(),
                abduction: abduction.to_degrees(),
                twist: twist.to_degrees(),
            }
        }
        _ => mixed,
    }
}

/// Angles brought inside their ranges, which stretch to hold those of before.
pub(crate) fn held(figure: &Figure, bone: Bone, before: Angles, mut angles: Angles) -> Angles {
    let Some(joint) = figure.skeleton.joint(bone) else { return angles };
    for dof in joint.dofs() {
        if let Some(range) = joint.range(dof) {
            angles.set(dof, range.reaching(before.get(dof)).clamp(angles.get(dof)));
        }
    }
    if let (Articulation::Ball { ball, cone: Some(cone), .. }, Some(bone)) =
        (&joint.articulation, joint.bone_direction())
    {
        let cone = cone.reaching(joint.rotation(before) * bone);
        let points = joint.rotation(angles) * bone;
        let inside = cone.clamp(points);
        if inside != points {
            let turned = DQuat::from_rotation_arc(points, inside) * joint.rotation(angles);
            let [flexion, abduction, _] = ball.angles(turned);
            angles.flexion = flexion.to_degrees();
            angles.abduction = abduction.to_degrees();
        }
    }
    angles
}

/// Blends the fingers of a hand toward a handshape; a contact on a finger keeps its target and the arm follows.
///
/// # Errors
/// A handshape that the figure lacks, an amount that is not finite, limbs that can't be solved.
pub fn handshape(
    figure: &Figure,
    before: &Pose,
    side: Side,
    name: &str,
    amount: f64,
    ranges: bool,
) -> Result<Moved, GestureError> {
    let shape = figure.handshapes.get(name).ok_or_else(|| GestureError::NoHandshape {
        name: name.to_owned(),
        known: figure.handshapes.keys().cloned().collect::<Vec<_>>().join(", "),
    })?;
    let twin = |bone: Bone| if side == Side::Left { bone } else { bone.mirrored() };
    let joints = shape.iter().map(|(bone, angles)| (twin(*bone), *angles)).collect();
    apply_patch(figure, before, &PosePatch { joints, ..PosePatch::default() }, &[], amount, ranges)
}

/// Puts parts back to rest, angle 0 and limbs free with their default articulators; the place of the figure stays.
///
/// # Errors
/// Limbs that can't be solved.
pub fn reset(figure: &Figure, before: &Pose, parts: &[Part], ranges: bool) -> Result<Moved, GestureError> {
    let wanted = wanted(parts);
    let mut pose = before.clone();
    for bone in Bone::ALL.into_iter().filter(|b| wanted(b.part())) {
        pose.angles[bone.index()] = Angles::REST;
    }
    if wanted(Part::Torso) {
        pose.hips = figure.rest_pose().hips;
    }
    let set: Vec<Limb> = Limb::ALL.into_iter().filter(|l| wanted(part_of(*l))).collect();
    for limb in &set {
        pose.limbs[limb.index()] = LimbState::rest(*limb);
    }
    settle(figure, before, pose, &set, ranges)
}

/// Each named part takes the mirror image of its twin, in the figure's own middle plane; no parts: the whole pose.
///
/// # Errors
/// Limbs that can't be solved.
pub fn mirror(figure: &Figure, before: &Pose, parts: &[Part], ranges: bool) -> Result<Moved, GestureError> {
    let image = mirrored_pose(before);
    if parts.is_empty() && figure.skeleton.locks().is_empty() {
        return Ok(Moved { pose: image, clamped: false });
    }
    let wanted = wanted(parts);
    let mut pose = before.clone();
    for bone in Bone::ALL.into_iter().filter(|b| wanted(b.part())) {
        pose.angles[bone.index()] = image.angles(bone);
    }
    if wanted(Part::Torso) {
        pose.hips = image.hips;
    }
    let set: Vec<Limb> = Limb::ALL.into_iter().filter(|l| wanted(part_of(*l))).collect();
    for limb in &set {
        pose.limbs[limb.index()] = image.limb(*limb).clone();
    }
    settle(figure, before, pose, &set, ranges)
}

/// The mirror image of a pose in the placed figure's middle plane; twice is the same, bit for bit, for a figure
/// that is placed at the origin, and to rounding elsewhere.
pub fn mirrored_pose(pose: &Pose) -> Pose {
    let world_from_figure = pose.place.world_from_figure();
    let mut image = pose.clone();
    image.hips = flipped(pose.hips);
    for bone in Bone::ALL {
        image.angles[bone.index()] = mirrored_angles(bone, pose.angles(bone.mirrored()));
    }
    for limb in Limb::ALL {
        image.limbs[limb.index()] = mirrored_limb(pose.limb(limb.mirrored()), &world_from_figure);
    }
    image
}

/// The mirror image of a patch: twins change sides.
pub fn mirrored_patch(patch: &PosePatch) -> PosePatch {
    let here = patch.place.unwrap_or_default().world_from_figure();
    PosePatch {
        figure: patch.figure.clone(),
        size: patch.size,
        place: patch.place,
        hips: patch.hips.map(flipped),
        joints: patch.joints.iter().map(|(bone, a)| (bone.mirrored(), mirrored_angles(*bone, *a))).collect(),
        limbs: patch.limbs.iter().map(|(limb, s)| (limb.mirrored(), mirrored_limb(s, &here))).collect(),
    }
}

/// Twins mirror their axes, so their angles agree; a middle joint bends and turns to the other side.
fn mirrored_angles(bone: Bone, angles: Angles) -> Angles {
    if bone.mirrored() != bone {
        return angles;
    }
    Angles { abduction: 0.0 - angles.abduction, twist: 0.0 - angles.twist, ..angles }
}

fn mirrored_limb(state: &LimbState, world_from_figure: &kin::Frame) -> LimbState {
    let reacher = match &state.reacher {
        Reacher::Named(name) => Reacher::Named(name.clone()),
        Reacher::Point(bone, at) => Reacher::Point(bone.mirrored(), flipped(*at)),
    };
    LimbState { reacher, contact: mirrored_contact(&state.contact, world_from_figure) }
}

/// Adding to zero keeps a zero's sign plain, so that mirroring twice gives the same bits.
fn flipped(v: DVec3) -> DVec3 {
    DVec3::new(0.0 - v.x, v.y, v.z)
}

fn flipped_turn(q: DQuat) -> DQuat {
    DQuat::from_xyzw(q.x, 0.0 - q.y, 0.0 - q.z, q.w)
}

fn mirrored_contact(contact: &Contact, world_from_figure: &kin::Frame) -> Contact {
    let at_home = *world_from_figure == kin::Frame::IDENTITY;
    let point = |space: Space, v: DVec3| match space {
        Space::World if !at_home => world_from_figure.point(flipped(world_from_figure.inverse().point(v))),
        _ => flipped(v),
    };
    let turn = |space: Space, q: DQuat| match space {
        Space::World if !at_home => {
            let world = world_from_figure.rotation;
            (world * flipped_turn(world.conjugate() * q)).normalize()
        }
        _ => flipped_turn(q),
    };
    match *contact {
        Contact::Free => Contact::Free,
        Contact::Point { space, target } => {
            Contact::Point { space: twin(space), target: point(space, target) }
        }
        Contact::Planted { space, target, rotation } => Contact::Planted {
            space: twin(space),
            target: point(space, target),
            rotation: turn(space, rotation),
        },
    }
}

fn twin(space: Space) -> Space {
    match space {
        Space::World => Space::World,
        Space::Body(bone) => Space::Body(bone.mirrored()),
    }
}
