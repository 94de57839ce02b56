//! What is drawn over the figure to be taken hold of: rings, arcs and handles, and where they are.

use glam::{DVec3, Vec2};
use rig::{Bone, Dof, Frames, Limb};

use crate::elevation::elevation_circle;
use crate::ring::axis;
use crate::{Circle, Editor, Sight, Stage};

/// Something drawn that can be taken hold of.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Knob {
    /// Turns one degree of freedom of a joint; all beyond it follows.
    Turn(Bone, Dof),
    /// Turns a limb's end about the articulator, which stays.
    InContact(Limb, Dof),
    /// Turns a ball joint about the axes of the view.
    Trackball(Bone),
    /// Swings elbow or knee about the line from root to articulator.
    Elevation(Limb),
    /// Swings a collar.
    Collar(Bone),
    /// Bends the spine.
    Spine,
    /// Moves the hips.
    Hips,
    /// Moves the whole figure over the ground.
    Place,
    /// Turns the whole figure about the vertical through its hips.
    TurnFigure,
}

/// A knob and where it is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placed {
    /// What it is.
    pub knob: Knob,
    /// Where.
    pub shape: Shape,
}

/// The shape of a knob. Sizes follow the picture: the same pixels from near and far.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// A ring, taken by its line.
    Ring(Circle),
    /// An arc between two angles, radians, taken by its handle at angle 0.
    Arc(Circle, [f64; 2]),
    /// A handle at a point of the world, metres.
    Handle(DVec3),
    /// A disc that faces the viewer: its middle in the world, and its radius.
    Disc(DVec3, f32),
    /// Arrows on the ground along X and Z: their middle, and how long they are, metres.
    Cross(DVec3, f64),
}

/// Radius of a joint's rings.
const RING_PX: f64 = 78.0;
/// Radius of the disc inside them.
const TRACKBALL_PX: f32 = 20.0;
/// Radius of the ring on the ground, and length of the arrows inside.
const GROUND_PX: [f64; 2] = [64.0, 30.0];
/// An elevation's arc is no smaller, also for a straight limb.
const LEAST_ARC_PX: f64 = 30.0;
/// How near a line must be.
const LINE_REACH_PX: f32 = 7.0;
/// How near a handle must be.
const HANDLE_REACH_PX: f32 = 9.0;
/// Above the joint of the upper arm lies the collar's end, metres.
const ACROMION_M: f64 = 0.055;

impl Knob {
    /// The bone that a click on it chooses; `None` where it chooses nothing.
    pub fn bone(self) -> Option<Bone> {
        match self {
            Knob::Trackball(bone) | Knob::Collar(bone) => Some(bone),
            Knob::Elevation(limb) => Some(limb.parts().hinge),
            Knob::Spine => Some(Bone::Neck),
            Knob::Hips => Some(Bone::Hips),
            Knob::Turn(..) | Knob::InContact(..) | Knob::Place | Knob::TurnFigure => None,
        }
    }

    /// A name in the words of commands: `turn leftUpperArm flexion`.
    pub fn name(self) -> String {
        match self {
            Knob::Turn(bone, dof) => format!("turn {bone} {}", dof.name()),
            Knob::InContact(limb, dof) => format!("turn {} in contact {}", limb.name(), dof.name()),
            Knob::Trackball(bone) => format!("trackball {bone}"),
            Knob::Elevation(limb) => format!("elevate {}", limb.name()),
            Knob::Collar(bone) => format!("swing {bone}"),
            Knob::Spine => "aim spine".to_owned(),
            Knob::Hips => "move hips".to_owned(),
            Knob::Place => "place".to_owned(),
            Knob::TurnFigure => "turn figure".to_owned(),
        }
    }

    /// Whether it is a ring about a joint or an articulator.
    pub(crate) fn is_ring(self) -> bool {
        matches!(self, Knob::Turn(..) | Knob::InContact(..) | Knob::Trackball(_))
    }

    /// Whether skin before it hides it from the pointer.
    pub(crate) fn is_on_ground(self) -> bool {
        matches!(self, Knob::Place | Knob::TurnFigure)
    }

    /// Whether a limb's target at the same place comes before it.
    pub(crate) fn yields_to_targets(self) -> bool {
        matches!(self, Knob::Trackball(_))
    }
}

impl Placed {
    /// How near the pointer is, for choosing among knobs: the least wins; `None` out of reach.
    pub(crate) fn cost_px(&self, sight: &Sight, at_px: Vec2) -> Option<f32> {
        match self.shape {
            Shape::Ring(circle) => {
                let near = circle.nearest(sight, at_px).filter(|near| near.distance_px <= LINE_REACH_PX)?;
                Some(near.distance_px + if near.front { 0.0 } else { 3.0 })
            }
            Shape::Arc(circle, _) => handle_cost(sight, circle.point(0.0), at_px),
            Shape::Handle(place) => handle_cost(sight, place, at_px),
            Shape::Disc(middle, radius) => {
                let distance = sight.pixel_of(middle)?.distance(at_px);
                // Rings that cross it are taken on the very line.
                (distance <= radius).then_some(0.5 * LINE_REACH_PX)
            }
            Shape::Cross(middle, arm) => {
                let place = |x: f64, z: f64| sight.pixel_of(middle + DVec3::new(x, 0.0, z) * arm);
                let ends = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
                let from = place(0.0, 0.0)?;
                let far = ends.iter().filter_map(|(x, z)| Some(to_line(at_px, from, place(*x, *z)?)));
                far.min_by(f32::total_cmp).filter(|px| *px <= LINE_REACH_PX)
            }
        }
    }
}

fn handle_cost(sight: &Sight, place: DVec3, at_px: Vec2) -> Option<f32> {
    let distance = sight.pixel_of(place)?.distance(at_px);
    (distance <= HANDLE_REACH_PX).then_some(distance - 4.0)
}

fn to_line(at: Vec2, from: Vec2, to: Vec2) -> f32 {
    let along = to - from;
    let share = ((at - from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (from + along * share).distance(at)
}

/// The knobs of a stage; none where nothing is marked.
pub fn placed(stage: &Stage, in_contact: bool) -> Vec<Placed> {
    if !stage.marks {
        return Vec::new();
    }
    let mut all = body(stage);
    if let Some(bone) = stage.selected.filter(|bone| stage.editor.figure().skeleton.joint(*bone).is_some()) {
        match contact_limb(bone).filter(|_| in_contact) {
            Some(limb) => all.extend(contact_rings(stage, limb)),
            None => all.extend(rings(stage, bone)),
        }
        all.extend(Limb::of(bone).and_then(|limb| elevation(stage.editor, &stage.sight, limb)));
    }
    all
}

/// The limb whose end a chosen bone turns in contact: hand, forearm, foot.
pub(crate) fn contact_limb(bone: Bone) -> Option<Limb> {
    let limb = Limb::of(bone)?;
    let parts = limb.parts();
    (bone == parts.end || (limb.is_arm() && bone == parts.hinge)).then_some(limb)
}

/// The handles that are always there: collars, spine, hips, ground.
fn body(stage: &Stage) -> Vec<Placed> {
    let (editor, sight) = (stage.editor, &stage.sight);
    let frames = &editor.evaluation().frames;
    let has = |bone: Bone| editor.figure().skeleton.joint(bone).is_some();
    let mut all = Vec::new();
    for limb in [Limb::LeftArm, Limb::RightArm] {
        let collar = limb.parts().base;
        if has(collar) && has(limb.parts().root) {
            let place = acromion(frames, limb);
            all.push(Placed { knob: Knob::Collar(collar), shape: Shape::Handle(place) });
        }
    }
    if has(Bone::Neck) && rig::spine_twist(editor.figure(), editor.pose()).is_some() {
        all.push(Placed { knob: Knob::Spine, shape: Shape::Handle(frames[Bone::Neck].position) });
    }
    let hips = frames[Bone::Hips].position;
    all.push(Placed { knob: Knob::Hips, shape: Shape::Handle(hips) });
    let ground = DVec3 { y: 0.0, ..hips };
    let metres = sight.metres_per_px(ground);
    let ring = Circle::new(ground, DVec3::Y, DVec3::Z, GROUND_PX[0] * metres);
    all.push(Placed { knob: Knob::Place, shape: Shape::Cross(ground, GROUND_PX[1] * metres) });
    all.push(Placed { knob: Knob::TurnFigure, shape: Shape::Ring(ring) });
    all
}

/// The outer end of an arm's collar, metres, world.
pub(crate) fn acromion(frames: &Frames, limb: Limb) -> DVec3 {
    let parts = limb.parts();
    frames[parts.root].position + frames[parts.base].rotation * DVec3::Y * ACROMION_M
}

fn rings(stage: &Stage, bone: Bone) -> Vec<Placed> {
    let (editor, frames) = (stage.editor, &stage.editor.evaluation().frames);
    let Some(joint) = editor.figure().skeleton.joint(bone) else { return Vec::new() };
    let center = frames[bone].position;
    let radius = RING_PX * stage.sight.metres_per_px(center);
    let ring = |dof: Dof| {
        let axis = axis(editor.figure(), editor.pose(), frames, bone, dof)?;
        let circle = Circle::new(center, axis, stage.sight.toward_viewer(center), radius);
        Some(Placed { knob: Knob::Turn(bone, dof), shape: Shape::Ring(circle) })
    };
    let mut all: Vec<Placed> = joint.dofs().filter_map(ring).collect();
    if matches!(joint.articulation, rig::Articulation::Ball { .. }) {
        all.push(Placed { knob: Knob::Trackball(bone), shape: Shape::Disc(center, TRACKBALL_PX) });
    }
    all
}

fn contact_rings(stage: &Stage, limb: Limb) -> Vec<Placed> {
    let (editor, frames) = (stage.editor, &stage.editor.evaluation().frames);
    let center = editor.evaluation().limbs[limb.index()].articulator;
    let radius = RING_PX * stage.sight.metres_per_px(center);
    let ring = |dof: Dof| {
        let bone = rig::contact_joint(editor.figure(), limb, dof).ok()?;
        let axis = axis(editor.figure(), editor.pose(), frames, bone, dof)?;
        let circle = Circle::new(center, axis, stage.sight.toward_viewer(center), radius);
        Some(Placed { knob: Knob::InContact(limb, dof), shape: Shape::Ring(circle) })
    };
    Dof::ALL.into_iter().filter_map(ring).collect()
}

fn elevation(editor: &Editor, sight: &Sight, limb: Limb) -> Option<Placed> {
    let view = &editor.evaluation().limbs[limb.index()];
    let now = view.elevation?;
    let (circle, sense) =
        elevation_circle(editor.figure(), editor.pose(), &editor.evaluation().frames, limb)?;
    let least = LEAST_ARC_PX * sight.metres_per_px(circle.center);
    let circle = Circle { radius_m: circle.radius_m.max(least), ..circle };
    let [low, high] = view.elevation_range.unwrap_or([now, now]).map(|end| (end - now).to_radians() * sense);
    let shape = Shape::Arc(circle, [low.min(high), low.max(high)]);
    Some(Placed { knob: Knob::Elevation(limb), shape })
}

impl Placed {
    /// Places of the picture that lie on it, the likeliest to be taken first.
    pub(crate) fn places(&self, sight: &Sight) -> Vec<Vec2> {
        let around = |circle: &Circle| {
            let angles = (0..48).map(|i| (f64::from(i) * 0.61) % std::f64::consts::TAU);
            angles
                .filter(|a| circle.is_front(sight, *a))
                .filter_map(|a| sight.pixel_of(circle.point(a)))
                .collect()
        };
        match self.shape {
            Shape::Ring(circle) => around(&circle),
            Shape::Arc(circle, _) => sight.pixel_of(circle.point(0.0)).into_iter().collect(),
            Shape::Handle(place) => sight.pixel_of(place).into_iter().collect(),
            Shape::Disc(middle, radius) => {
                let turned =
                    (0..32).map(|i| Vec2::from_angle(i as f32 * 0.4) * radius * (0.9 - 0.01 * i as f32));
                let middle = sight.pixel_of(middle);
                middle.into_iter().flat_map(|m| turned.clone().map(move |shift| m + shift)).collect()
            }
            Shape::Cross(middle, arm) => {
                let along = [0.0, 0.8, -0.8].map(|x| middle + DVec3::new(x * arm, 0.0, 0.0));
                let across = [0.8, -0.8].map(|z| middle + DVec3::new(0.0, 0.0, z * arm));
                along.into_iter().chain(across).filter_map(|p| sight.pixel_of(p)).collect()
            }
        }
    }
}
