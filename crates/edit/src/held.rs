//! What the pointer holds of the figure, and the commands that bring it to where the pointer is.

use glam::{DQuat, DVec3, Vec2};
use rig::{Bone, Frames, Limb, Space};

use crate::drag::Drag;
use crate::elevation::elevation_circle;
use crate::knob::{Shape, acromion};
use crate::ring::{Ring, Swing};
use crate::swivel::{Swivel, stepped};
use crate::{
    At, Axis, By, Circle, Command, Constraint, Editor, Goal, Grab, Handle, Hit, Knob, Modifiers, Placed,
    PosedSkin, Sight, Snap, Stage, Surfaces, Typed,
};

/// A part of the figure, a target or a knob in the hand.
#[derive(Clone, Debug)]
pub(crate) enum Held {
    /// A point that goes where the pointer is.
    Point(Moving),
    /// A ring or an arc.
    Ring(Turning),
    /// The disc inside the rings.
    Ball(Rolling),
}

/// A point held by the pointer.
#[derive(Clone, Debug)]
pub(crate) struct Moving {
    pub what: What,
    pub drag: Drag,
    pub surfaces: Option<Box<Surfaces>>,
    /// The surface on which it lies now.
    pub snap: Option<Snap>,
    /// Where a typed distance is counted from the first number on.
    heading: Option<DVec3>,
    sight: Sight,
}

/// What the point moves.
#[derive(Clone, Debug)]
pub(crate) enum What {
    /// A grabbed place of the skin, or a handle that works like one.
    Grab(Box<Grab>, Option<Knob>),
    /// A limb's target, in the space that it holds on to.
    Target(Limb, Option<Bone>, Box<Frames>),
    /// The whole figure, over the ground.
    Place,
}

/// A ring held by the pointer.
#[derive(Clone, Debug)]
pub(crate) struct Turning {
    pub knob: Knob,
    pub swivel: Swivel,
    pub turn: Turn,
    /// The turn so far, radians.
    pub angle_rad: f64,
}

/// What turning the ring does.
#[derive(Clone, Debug)]
pub(crate) enum Turn {
    Joint(Box<Ring>),
    InContact { limb: Limb, ring: Box<Ring> },
    Elevation { limb: Limb, sense: f64, start_deg: f64, range_rad: Option<[f64; 2]> },
    Figure { about: DVec3, from_place: DVec3 },
}

/// A ball joint held by its disc.
#[derive(Clone, Debug)]
pub(crate) struct Rolling {
    pub bone: Bone,
    swing: Swing,
    sight: Sight,
    from_px: Vec2,
    /// Where the pointer is, and where it was and counted as being when slowness last began or ended.
    pointer: Vec2,
    turning: (Vec2, Vec2),
    slow: bool,
    pub constraint: Constraint,
    /// The rotation so far as axis times angle, radians, world.
    pub turned: DVec3,
}

/// A drag of this many pixels over the disc turns by one radian.
const PX_PER_RAD: f32 = 110.0;
const SLOW: f32 = 0.1;

impl Held {
    /// Takes hold of a place of the skin.
    pub(crate) fn of_skin(stage: &Stage, skin: &PosedSkin, hit: &Hit, at_px: Vec2) -> Held {
        let editor = stage.editor;
        let grab = Grab::begin(editor.figure(), editor.pose(), editor.evaluation(), hit);
        let surfaces = match grab.handle {
            Handle::Reach(limb) => {
                let at = rig::Articulator { bone: hit.bone, at: hit.point_in_bone };
                Some(surfaces(editor, skin, limb, at))
            }
            _ => None,
        };
        Held::point(stage, What::Grab(Box::new(grab), None), surfaces, hit.point_in_world, at_px)
    }

    /// Takes hold of a limb's target.
    pub(crate) fn of_target(stage: &Stage, skin: &PosedSkin, limb: Limb, at_px: Vec2) -> Held {
        let editor = stage.editor;
        let space = match editor.pose().limb(limb).contact.target() {
            Some((Space::Body(bone), _)) => Some(bone),
            Some((Space::World, _)) | None => None,
        };
        let frames = Box::new(editor.evaluation().frames);
        let surfaces = surfaces(editor, skin, limb, editor.figure().articulator(editor.pose(), limb));
        let first = editor.evaluation().limbs[limb.index()].target;
        Held::point(stage, What::Target(limb, space, frames), Some(surfaces), first, at_px)
    }

    /// Takes hold of a knob; `None` if the figure has nothing for it to move.
    pub(crate) fn of_knob(stage: &Stage, placed: &Placed, at_px: Vec2) -> Option<Held> {
        let (editor, knob) = (stage.editor, placed.knob);
        match (knob, placed.shape) {
            (Knob::Turn(bone, dof), Shape::Ring(circle)) => {
                let ring = Box::new(ring(editor, bone, dof)?);
                Some(Held::ring(stage, knob, circle, Turn::Joint(ring), at_px))
            }
            (Knob::InContact(limb, dof), Shape::Ring(circle)) => {
                let bone = rig::contact_joint(editor.figure(), limb, dof).ok()?;
                let ring = Box::new(ring(editor, bone, dof)?);
                Some(Held::ring(stage, knob, circle, Turn::InContact { limb, ring }, at_px))
            }
            (Knob::TurnFigure, Shape::Ring(circle)) => {
                let turn = Turn::Figure { about: circle.center, from_place: editor.pose().place.position };
                Some(Held::ring(stage, knob, circle, turn, at_px))
            }
            (Knob::Elevation(limb), Shape::Arc(circle, range)) => {
                let frames = &editor.evaluation().frames;
                let (_, sense) = elevation_circle(editor.figure(), editor.pose(), frames, limb)?;
                let view = &editor.evaluation().limbs[limb.index()];
                let range_rad = view.elevation_range.map(|_| range);
                let start_deg = view.elevation?;
                let turn = Turn::Elevation { limb, sense, start_deg, range_rad };
                let swivel = Swivel::begin(circle, 0.0, stage.sight, at_px);
                Some(Held::Ring(Turning { knob, swivel, turn, angle_rad: 0.0 }))
            }
            (Knob::Trackball(bone), _) => Rolling::begin(stage, bone, at_px).map(Held::Ball),
            (Knob::Place, Shape::Cross(middle, _)) => {
                let mut held = Held::point(stage, What::Place, None, middle, at_px);
                held.constrain(Constraint::Across(Axis::Y));
                Some(held)
            }
            _ => Held::of_handle(stage, knob, at_px),
        }
    }

    /// The handles that work like a grab of the skin.
    fn of_handle(stage: &Stage, knob: Knob, at_px: Vec2) -> Option<Held> {
        let editor = stage.editor;
        let frames = &editor.evaluation().frames;
        let (handle, bone, place) = match knob {
            Knob::Collar(bone) => {
                let limb = if bone == Bone::LeftShoulder { Limb::LeftArm } else { Limb::RightArm };
                (Handle::Swing(bone), bone, acromion(frames, limb))
            }
            Knob::Spine => (Handle::Spine, Bone::UpperChest, frames[Bone::Neck].position),
            Knob::Hips => (Handle::Hips, Bone::Hips, frames[Bone::Hips].position),
            _ => return None,
        };
        let grab = Grab::of(handle, bone, place, editor.pose(), editor.evaluation());
        Some(Held::point(stage, What::Grab(Box::new(grab), Some(knob)), None, place, at_px))
    }

    fn point(stage: &Stage, what: What, surfaces: Option<Surfaces>, first: DVec3, at_px: Vec2) -> Held {
        let drag = Drag::begin(first, &stage.sight.camera, stage.sight.ray(at_px));
        let surfaces = surfaces.map(Box::new);
        Held::Point(Moving { what, drag, surfaces, snap: None, heading: None, sight: stage.sight })
    }

    fn ring(stage: &Stage, knob: Knob, circle: Circle, turn: Turn, at_px: Vec2) -> Held {
        let taken = circle.nearest(&stage.sight, at_px).map_or(0.0, |near| near.angle_rad);
        let swivel = Swivel::begin(circle, taken, stage.sight, at_px);
        Held::Ring(Turning { knob, swivel, turn, angle_rad: 0.0 })
    }

    /// The knob in the hand; `None` for skin and targets.
    pub(crate) fn knob(&self) -> Option<Knob> {
        match self {
            Held::Point(Moving { what: What::Grab(_, knob), .. }) => *knob,
            Held::Point(Moving { what: What::Place, .. }) => Some(Knob::Place),
            Held::Point(_) => None,
            Held::Ring(turning) => Some(turning.knob),
            Held::Ball(rolling) => Some(Knob::Trackball(rolling.bone)),
        }
    }

    /// The bone whose skin is held.
    pub(crate) fn skin_bone(&self) -> Option<Bone> {
        match self {
            Held::Point(Moving { what: What::Grab(grab, None), .. }) => Some(grab.bone),
            _ => None,
        }
    }

    /// Holds it to an axis or a plane, or no longer. Rings have their axis already.
    pub(crate) fn constrain(&mut self, constraint: Constraint) {
        match self {
            Held::Point(moving) => {
                moving.drag.toggle(constraint);
                moving.heading = None;
            }
            Held::Ball(rolling) => {
                let same = rolling.constraint == constraint;
                rolling.constraint = if same { Constraint::View } else { constraint };
            }
            Held::Ring(_) => {}
        }
    }

    /// The commands with the pointer at a place, from the state in which it was taken; none where nothing moves.
    pub(crate) fn commands(
        &mut self,
        editor: &Editor,
        skin: &PosedSkin,
        at_px: Vec2,
        modifiers: Modifiers,
        typed: &Typed,
    ) -> Vec<Command> {
        match self {
            Held::Point(moving) => moving.commands(editor, skin, at_px, modifiers, typed),
            Held::Ring(turning) => turning.commands(at_px, modifiers, typed),
            Held::Ball(rolling) => rolling.commands(at_px, modifiers, typed),
        }
    }
}

/// The ring of a joint; that of a locked one does not turn.
fn ring(editor: &Editor, bone: Bone, dof: rig::Dof) -> Option<Ring> {
    let (frames, document) = (&editor.evaluation().frames, editor.document());
    let mut ring = Ring::of(editor.figure(), &document.pose, frames, bone, dof, document.ranges)?;
    if document.locks.contains(bone) {
        ring.range_rad = [0.0; 2];
    }
    Some(ring)
}

fn surfaces(editor: &Editor, skin: &PosedSkin, limb: Limb, at: rig::Articulator) -> Surfaces {
    let ranges = editor.document().ranges;
    Surfaces::of(editor.figure(), editor.pose(), editor.evaluation(), skin.picker(), limb, at, ranges)
}

impl Moving {
    fn commands(
        &mut self,
        editor: &Editor,
        skin: &PosedSkin,
        at_px: Vec2,
        modifiers: Modifiers,
        typed: &Typed,
    ) -> Vec<Command> {
        let ray = self.sight.ray(at_px);
        let pointed = self.drag.point(ray, modifiers);
        self.snap = self.snapped(editor, skin, at_px, modifiers, typed);
        let goal = self.typed(typed).unwrap_or(pointed);
        if let Some(snap) = self.snap {
            return self.to_surface(&snap);
        }
        match &self.what {
            What::Grab(grab, _) => grab.commands(editor.figure(), goal),
            What::Target(limb, space, frames) => {
                let to = match space {
                    Some(bone) => Goal::Body(*bone, frames[*bone].inverse().point(goal)),
                    None => Goal::World(goal),
                };
                vec![Command::Reach { limb: *limb, to }]
            }
            What::Place => vec![Command::Place { by: goal - self.drag.first_in_world(), turn: 0.0 }],
        }
    }

    /// A typed distance in centimetres, along the axis or the way gone when the first digit came.
    fn typed(&mut self, typed: &Typed) -> Option<DVec3> {
        let Some(centimetres) = typed.value() else {
            self.heading = None;
            return None;
        };
        self.heading = self.heading.or_else(|| self.drag.direction());
        Some(self.drag.first_in_world() + self.heading? * (centimetres * 0.01))
    }

    /// The surface under the pointer: a target looks for one unless the steps are on, the skin only if they are.
    fn snapped(
        &self,
        editor: &Editor,
        skin: &PosedSkin,
        at_px: Vec2,
        modifiers: Modifiers,
        typed: &Typed,
    ) -> Option<Snap> {
        let looks = matches!(self.what, What::Target(..)) != modifiers.snap;
        let free = self.drag.constraint() == Constraint::View && typed.is_empty() && !modifiers.slow;
        let surfaces = self.surfaces.as_ref().filter(|_| looks && free)?;
        surfaces.snap(editor.figure(), skin.picker(), self.sight.ray(at_px))
    }

    fn to_surface(&self, snap: &Snap) -> Vec<Command> {
        let articulate = match &self.what {
            What::Grab(grab, _) => {
                Some(Command::Articulate { limb: snap.limb, at: At::Point(grab.bone, grab.point_in_bone) })
            }
            _ => None,
        };
        articulate.into_iter().chain(snap.commands()).collect()
    }
}

impl Turning {
    /// How far it may turn, radians from where it began; `None` where nothing is known to stop it.
    pub(crate) fn range_rad(&self) -> Option<[f64; 2]> {
        match &self.turn {
            Turn::Joint(ring) | Turn::InContact { ring, .. } => Some(ring.range_rad),
            Turn::Elevation { range_rad, .. } => *range_rad,
            Turn::Figure { .. } => None,
        }
    }

    fn commands(&mut self, at_px: Vec2, modifiers: Modifiers, typed: &Typed) -> Vec<Command> {
        let pointed = self.swivel.angle(at_px, modifiers);
        // A typed angle is one of the joint's: for an elevation + is outward.
        let sense = match self.turn {
            Turn::Elevation { sense, .. } => sense,
            _ => 1.0,
        };
        self.angle_rad = typed.value().map_or(pointed, |degrees| degrees.to_radians() * sense);
        let degrees = self.angle_rad.to_degrees();
        match &self.turn {
            Turn::Joint(ring) => ring.commands(self.angle_rad),
            Turn::InContact { limb, ring } => vec![Command::TurnInContact {
                limb: *limb,
                dof: ring.dof,
                degrees: ring.start_deg + degrees,
                by: By::To,
            }],
            Turn::Elevation { limb, sense, .. } => {
                vec![Command::Elevate { limb: *limb, degrees: sense * degrees, by: By::Delta }]
            }
            Turn::Figure { about, from_place } => {
                let arm = *about - *from_place;
                let by = arm - DQuat::from_rotation_y(self.angle_rad) * arm;
                vec![Command::Place { by: DVec3 { y: 0.0, ..by }, turn: degrees }]
            }
        }
    }
}

impl Rolling {
    fn begin(stage: &Stage, bone: Bone, at_px: Vec2) -> Option<Rolling> {
        let editor = stage.editor;
        let swing = Swing::of(editor.figure(), editor.pose(), &editor.evaluation().frames, bone)?;
        Some(Rolling {
            bone,
            swing,
            sight: stage.sight,
            from_px: at_px,
            pointer: at_px,
            turning: (at_px, at_px),
            slow: false,
            constraint: Constraint::View,
            turned: DVec3::ZERO,
        })
    }

    fn counted(&self) -> Vec2 {
        self.turning.1 + (self.pointer - self.turning.0) * if self.slow { SLOW } else { 1.0 }
    }

    fn commands(&mut self, at_px: Vec2, modifiers: Modifiers, typed: &Typed) -> Vec<Command> {
        if modifiers.slow != self.slow {
            self.turning = (self.pointer, self.counted());
            self.slow = modifiers.slow;
        }
        if at_px.is_finite() {
            self.pointer = at_px;
        }
        let moved = ((self.counted() - self.from_px) / PX_PER_RAD).as_dvec2();
        let moved = if modifiers.snap { glam::DVec2::new(stepped(moved.x), stepped(moved.y)) } else { moved };
        let axes = self.sight.camera.axes();
        let free = axes.y_axis.as_dvec3() * moved.x + axes.x_axis.as_dvec3() * moved.y;
        let held = match self.constraint {
            Constraint::View => free,
            Constraint::Along(axis) => axis.vector() * free.dot(axis.vector()),
            Constraint::Across(axis) => free.reject_from_normalized(axis.vector()),
        };
        self.turned = match (typed.value(), held.try_normalize()) {
            (Some(degrees), Some(axis)) => axis * degrees.to_radians(),
            _ => held,
        };
        self.swing.commands(DQuat::from_scaled_axis(self.turned))
    }
}
