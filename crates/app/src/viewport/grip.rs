//! What the pointer has taken hold of on the figure, and where it goes from there.

use edit::{Axis, Constraint, Drag, Editor, Grab, Handle, Hit, Modifiers, Request};
use glam::DVec3;
use rig::{Bone, Camera, Limb, Ray};

use crate::labels;
use crate::reaching::reach;

/// A drag of the figure.
#[derive(Clone, Debug)]
pub struct Grip {
    what: What,
    drag: Drag,
    modifiers: Modifiers,
    /// The last goal that was asked for.
    goal: DVec3,
    asked: bool,
}

#[derive(Clone, Debug)]
enum What {
    Skin(Box<Grab>),
    Target(Limb),
}

impl Grip {
    /// Takes hold of the skin where a ray met it.
    pub fn of_skin(editor: &Editor, hit: &Hit, camera: &Camera, ray: Ray) -> Grip {
        let grab = Grab::begin(editor.figure(), editor.pose(), editor.evaluation(), hit);
        Grip::new(What::Skin(Box::new(grab)), hit.point_in_world, camera, ray)
    }

    /// Takes hold of a limb's target with the pointer on that ray.
    pub fn of_target(editor: &Editor, limb: Limb, camera: &Camera, ray: Ray) -> Grip {
        let first = editor.evaluation().limbs[limb.index()].target;
        Grip::new(What::Target(limb), first, camera, ray)
    }

    fn new(what: What, first: DVec3, camera: &Camera, ray: Ray) -> Grip {
        let drag = Drag::begin(first, camera, ray);
        Grip { what, drag, modifiers: Modifiers::default(), goal: first, asked: false }
    }

    /// Holds the drag to an axis or a plane, or no longer.
    pub fn toggle(&mut self, constraint: Constraint) {
        self.drag.toggle(constraint);
    }

    /// Goes where the pointer is; the change of the pose that this asks for, if any.
    pub fn follow(&mut self, editor: &Editor, ray: Ray, modifiers: Modifiers) -> Option<Request> {
        self.modifiers = modifiers;
        let goal = self.drag.point(ray, modifiers);
        if goal == self.goal {
            return None;
        }
        self.goal = goal;
        let commands = match &self.what {
            What::Skin(grab) => grab.commands(editor.figure(), goal),
            What::Target(limb) => vec![reach(editor, *limb, goal)],
        };
        self.asked |= !commands.is_empty();
        (!commands.is_empty()).then_some(Request::PreviewAll(commands))
    }

    /// Whether its gesture has been ended from elsewhere, by Escape or undo.
    pub fn is_over(&self, editor: &Editor) -> bool {
        self.asked && !editor.in_gesture()
    }

    /// The bone whose skin is held.
    pub fn bone(&self) -> Option<Bone> {
        match &self.what {
            What::Skin(grab) => Some(grab.bone),
            What::Target(_) => None,
        }
    }

    /// Where it began, metres, world, and the axes along which it may go; none if that is all of the view's plane.
    pub fn guides(&self) -> (DVec3, Vec<Axis>) {
        let free = |axis: &Axis| match self.drag.constraint() {
            Constraint::View => false,
            Constraint::Along(only) => *axis == only,
            Constraint::Across(not) => *axis != not,
        };
        (self.drag.first_in_world(), Axis::ALL.into_iter().filter(free).collect())
    }

    /// What moves, how, and what else could be pressed.
    pub fn telling(&self) -> String {
        let mut words = match &self.what {
            What::Skin(grab) => moved(grab.handle),
            What::Target(limb) => format!("{} reaches", labels::limb(*limb)),
        };
        match self.drag.constraint() {
            Constraint::View => {}
            Constraint::Along(axis) => words.push_str(&format!(" along {}", axis.name())),
            Constraint::Across(axis) => words.push_str(&format!(" in the plane across {}", axis.name())),
        }
        if self.modifiers.slow {
            words.push_str(", a tenth as far");
        }
        if self.modifiers.snap {
            words.push_str(", by whole centimetres");
        }
        for hint in self.hints() {
            words.push_str(" · ");
            words.push_str(&hint);
        }
        words
    }

    fn hints(&self) -> Vec<String> {
        let mut hints = vec![match self.drag.constraint() {
            Constraint::View => "X Y Z: along an axis, with Shift across it".to_owned(),
            Constraint::Along(axis) => format!("{} again: freely", axis.name()),
            Constraint::Across(axis) => format!("Shift+{} again: freely", axis.name()),
        }];
        if !self.modifiers.slow {
            hints.push("Shift: slowly".to_owned());
        }
        if !self.modifiers.snap {
            hints.push("Ctrl: 1 cm steps".to_owned());
        }
        hints.push("Esc: back".to_owned());
        hints
    }
}

/// `Left arm reaches`, `Left shoulder turns`.
fn moved(handle: Handle) -> String {
    match handle {
        Handle::Reach(limb) => format!("{} reaches", labels::limb(limb)),
        Handle::Elevate(limb) => format!("{} swings, the rest holds", labels::full(limb.parts().hinge)),
        Handle::Swing(bone) => format!("{} turns", labels::full(bone)),
        Handle::Hips => "Hips move".to_owned(),
        Handle::Spine => "Spine bends".to_owned(),
        Handle::Head => "Head turns".to_owned(),
    }
}
