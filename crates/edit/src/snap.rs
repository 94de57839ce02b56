//! Snapping: the surface under the pointer on which a dragged target comes to lie, and what a limb then holds on to.
//!
//! Like a grab, a snap is worked out from the pose at which the gesture began, so only the last pointer counts.

use glam::DVec3;
use rig::{
    Articulator, Bone, Contact, Evaluation, Figure, Frames, Limb, Mesh, Palette, Pose, Ray, ReachLimits,
    Reacher, Space, contact_order, reach_limits,
};

use crate::{Command, Goal, Hold, SkinPicker};

/// A surface of the body may be this much farther than the limb reaches: the limb then points at it.
const STRETCH: f64 = 1.15;
/// Nearer to a surface than this, an articulator touches it, metres.
const TOUCH_M: f64 = 0.008;
/// The farthest that an articulator lies below its own skin, metres.
const DEEPEST_M: f64 = 0.15;

/// What a limb's target may come to lie on, read off the pose when a gesture begins.
#[derive(Clone, PartialEq, Debug)]
pub struct Surfaces {
    limb: Limb,
    hold: Hold,
    limits: Option<ReachLimits>,
    frames: Frames,
    palette: Palette,
    /// By [`Bone::index`]: whether the limb may hold on to its skin.
    counts: [bool; Bone::COUNT],
    /// How far the articulator stays from a skin, and from the ground, metres.
    clearance_m: [f64; 2],
}

/// A target on a surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Snap {
    /// The limb whose target it is.
    pub limb: Limb,
    /// What the surface moves with: a bone, or the world for the ground.
    pub space: Space,
    /// Where the target is in that space, metres.
    pub target: DVec3,
    /// The same in the world.
    pub target_in_world: DVec3,
    /// The place of the surface, metres, world.
    pub surface_in_world: DVec3,
    /// The surface's unit normal there, outward, world.
    pub normal_in_world: DVec3,
    /// How the limb holds on now.
    hold: Hold,
}

impl Surfaces {
    /// Reads off a pose what the target of a limb with that articulator may lie on: the skin of all that the limb
    /// neither moves nor is, and the ground at height 0.
    pub fn of(
        figure: &Figure,
        pose: &Pose,
        evaluation: &Evaluation,
        picker: Option<&SkinPicker>,
        limb: Limb,
        at: Articulator,
        ranges: bool,
    ) -> Surfaces {
        let mut reaching = pose.clone();
        reaching.limbs[limb.index()].reacher = Reacher::Point(at.bone, at.at);
        let frames = evaluation.frames;
        let palette = Palette::new(&frames, &Bone::ALL.map(|bone| figure.skeleton.rest_position(bone)));
        let skin = figure.skin.as_ref().zip(picker);
        let depth =
            skin.map_or(0.0, |skin| depth(skin, &palette, limb, at.bone, frames[at.bone].point(at.at)));
        Surfaces {
            limb,
            hold: hold(&pose.limb(limb).contact),
            limits: reach_limits(figure, &reaching, &frames, limb, ranges),
            frames,
            palette,
            counts: holdable(pose, limb),
            clearance_m: [depth, over_ground(figure, limb, at).unwrap_or(depth)],
        }
    }

    /// The surface that a ray meets first, if the limb can reach it; `picker` is that of the figure's skin.
    pub fn snap(&self, figure: &Figure, picker: Option<&SkinPicker>, ray: Ray) -> Option<Snap> {
        let skin = figure.skin.as_ref().zip(picker);
        let counts = |bone: Bone| self.counts[bone.index()];
        let hit = skin.and_then(|(m, picker)| picker.pick_of(m, &self.palette, &self.frames, ray, counts));
        let ground = ground(ray).filter(|(_, far)| hit.is_none_or(|hit| *far < hit.distance));
        match (ground, hit) {
            // No stretch here: a foot that is lifted passes over ground that its straight leg all but reaches.
            (Some((place, _)), _) => self.at(Space::World, place, DVec3::Y, self.clearance_m[1], 1.0),
            (None, Some(hit)) => {
                let space = Space::Body(hit.bone);
                self.at(space, hit.point_in_world, hit.normal_in_world, self.clearance_m[0], STRETCH)
            }
            (None, None) => None,
        }
    }

    /// The target over a place of a surface; `None` if that is farther than a share of the limb's reach.
    fn at(&self, space: Space, place: DVec3, normal: DVec3, clearance: f64, share: f64) -> Option<Snap> {
        let target_in_world = place + normal * clearance;
        let limits = self.limits?;
        let near = limits.root_in_world.distance(target_in_world) <= share * limits.outer_m;
        near.then(|| Snap {
            limb: self.limb,
            space,
            target: self.frames.space(space).inverse().point(target_in_world),
            target_in_world,
            surface_in_world: place,
            normal_in_world: normal,
            hold: self.hold,
        })
    }
}

impl Snap {
    /// What brings the limb there and holds it: a free limb takes hold with its articulator, another goes on as it held.
    pub fn commands(&self) -> Vec<Command> {
        let Snap { limb, space, target, .. } = *self;
        let to = match space {
            Space::World => Goal::World(target),
            Space::Body(bone) => Goal::Body(bone, target),
        };
        let keep = Command::Keep { limb, contact: Hold::Point, space };
        let reach = Command::Reach { limb, to };
        if self.hold == Hold::Free { vec![keep, reach] } else { vec![reach] }
    }
}

/// What a limb would best hold on to where it is: the bone whose skin its articulator touches, or else the world. A
/// foot on the ground holds on to the world even if it touches the other one.
pub fn nearest_space(
    figure: &Figure,
    pose: &Pose,
    evaluation: &Evaluation,
    picker: Option<&SkinPicker>,
    limb: Limb,
) -> Space {
    let at = figure.articulator(pose, limb);
    let here = evaluation.frames[at.bone].point(at.at);
    let stands = over_ground(figure, limb, at).is_some_and(|height| here.y - height <= TOUCH_M);
    let Some((mesh, picker)) = figure.skin.as_ref().zip(picker).filter(|_| !stands) else {
        return Space::World;
    };
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let palette = Palette::new(&evaluation.frames, &rest);
    let within = TOUCH_M + depth((mesh, picker), &palette, limb, at.bone, here);
    let counts = holdable(pose, limb);
    let near = picker.nearest_of(mesh, &palette, here, within, |bone| counts[bone.index()]);
    near.map_or(Space::World, |near| Space::Body(near.bone))
}

fn hold(contact: &Contact) -> Hold {
    match contact {
        Contact::Free => Hold::Free,
        Contact::Point { .. } => Hold::Point,
        Contact::Planted { .. } => Hold::Planted,
    }
}

/// By [`Bone::index`], whether a limb may hold on to a bone: not to itself, nor to a limb that holds on to it.
fn holdable(pose: &Pose, limb: Limb) -> [bool; Bone::COUNT] {
    let limbs = Limb::ALL.map(|other| {
        let mut held = pose.clone();
        let space = Space::Body(other.parts().end);
        held.limbs[limb.index()].contact = Contact::Point { space, target: DVec3::ZERO };
        other != limb && contact_order(&held).is_ok()
    });
    Bone::ALL.map(|bone| Limb::of(bone).is_none_or(|other| limbs[other.index()]))
}

/// How far below its own skin a point of a limb lies, metres; 0 on the skin and outside of it.
fn depth(
    (mesh, picker): (&Mesh, &SkinPicker),
    palette: &Palette,
    limb: Limb,
    bone: Bone,
    point: DVec3,
) -> f64 {
    // A fingertip that touches its own palm is not inside it: only the skin about the bone itself counts.
    let own =
        |b: Bone| b == bone || (Limb::of(b) == Some(limb) && (b.carrier() == bone || b == bone.carrier()));
    let near = picker.nearest_of(mesh, palette, point, DEEPEST_M, own);
    near.map_or(0.0, |near| (-near.height_m).max(0.0))
}

/// How far above the sole a point of a foot is at rest, metres; `None` for what is no foot.
fn over_ground(figure: &Figure, limb: Limb, at: Articulator) -> Option<f64> {
    let foot = !limb.is_arm() && at.bone >= limb.parts().end;
    foot.then(|| (figure.skeleton.rest_position(at.bone).y + at.at.y).max(0.0))
}

/// Where a ray from above meets the ground, and how far along it that is, metres.
fn ground(ray: Ray) -> Option<(DVec3, f64)> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let far = -origin.y / direction.y;
    let place = DVec3 { y: 0.0, ..origin + direction * far };
    (direction.y < 0.0 && far >= 0.0 && place.is_finite()).then_some((place, far))
}
