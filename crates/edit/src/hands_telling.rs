//! What the pointer is doing, in words for the status line.

use rig::{Bone, Dof, Limb, Space};

use crate::held::{Held, Moving, Rolling, Turn, Turning, What};
use crate::knob::contact_limb;
use crate::swivel::wrapped;
use crate::telling;
use crate::{Axis, Circle, Constraint, Grab, Handle, Hands, Knob, Mark, Modifiers, Stage, Typed};

/// What the user knows things by.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    /// Names of joints: `Left elbow`.
    pub joint: &'a dyn Fn(Bone) -> String,
    /// The key that holds a drag to an axis or plane: `X`, `Shift+X`; empty where there is none.
    pub key: &'a dyn Fn(Constraint) -> String,
    /// The key that makes rings turn in contact; empty where there is none.
    pub in_contact: &'a str,
}

impl Words<'_> {
    fn named(&self, bone: Bone) -> String {
        (self.joint)(bone)
    }

    /// The keys for the three axes, `X Y Z`, and whether Shift with them means the planes across; `None` without keys.
    fn axes(&self) -> Option<(String, bool)> {
        let along = Axis::ALL.map(|axis| (self.key)(Constraint::Along(axis)));
        let across = Axis::ALL.map(|axis| (self.key)(Constraint::Across(axis)));
        let shifted = along.iter().zip(&across).all(|(along, across)| *across == format!("Shift+{along}"));
        let keys: Vec<String> = along.into_iter().filter(|key| !key.is_empty()).collect();
        (!keys.is_empty()).then(|| (keys.join(" "), shifted))
    }
}

/// A ring or an arc while it is turned, as it is to be drawn.
#[derive(Clone, PartialEq, Debug)]
pub struct Turned {
    /// The knob in the hand.
    pub knob: Knob,
    /// The ring; angle 0 is where the turn began.
    pub circle: Circle,
    /// The turn so far, radians.
    pub angle_rad: f64,
    /// How far it may go, radians; `None` where nothing is known to stop it.
    pub range_rad: Option<[f64; 2]>,
    /// The turn so far and, for a joint's own angle, what it comes to: `+12.5°, 92.5°`.
    pub text: String,
}

impl Hands {
    /// What a drag of the figure is doing and which keys change it; `None` while there is none.
    pub fn telling(&self, words: &Words) -> Option<String> {
        let dragging = self.dragging()?;
        let (typed, modifiers) = (&dragging.typed, self.modifiers());
        let mut told = match &dragging.held {
            Held::Point(moving) => point(moving, typed, modifiers, words),
            Held::Ring(turning) => ring(turning, typed, modifiers, words),
            Held::Ball(rolling) => ball(rolling, typed, modifiers, words),
        };
        if typed.is_empty() {
            told.push("numbers: how far".to_owned());
        } else {
            told.push("Enter: done".to_owned());
        }
        told.push("Esc: back".to_owned());
        Some(told.join(" · "))
    }

    /// What a drag from where the pointer is would do, and a click; `None` beside the figure and while dragging.
    pub fn offering(&self, stage: &Stage, words: &Words) -> Option<String> {
        let editor = stage.editor;
        let (spot, dragging) = (self.under(), self.dragging());
        let drag = match (spot.mark, &spot.skin) {
            _ if dragging.is_some() => return None,
            (Some(Mark::Knob(knob)), _) => of_knob(knob, words),
            (Some(Mark::Target(limb)), _) => format!("{} reaches, onto surfaces too", limb_name(limb)),
            (_, Some(hit)) => {
                moved(Grab::begin(editor.figure(), editor.pose(), editor.evaluation(), hit).handle, words)
            }
            _ => return None,
        };
        let bone = spot.mark.map_or(spot.skin_bone(), |mark| mark.bone(editor));
        let click = bone.map(|bone| format!(" · Click: choose {}", lower(&words.named(bone))));
        let contact = match spot.mark {
            Some(Mark::Knob(Knob::Turn(bone, _)))
                if contact_limb(bone).is_some() && !words.in_contact.is_empty() =>
            {
                format!(" · {}: about the contact", words.in_contact)
            }
            _ => String::new(),
        };
        Some(format!("Drag: {}{}{contact}", lower(&drag), click.unwrap_or_default()))
    }

    /// The ring or arc in the hand.
    pub fn turned(&self) -> Option<Turned> {
        let Held::Ring(turning) = &self.dragging()?.held else { return None };
        Some(Turned {
            knob: turning.knob,
            circle: *turning.swivel.circle(),
            angle_rad: turning.angle_rad,
            range_rad: turning.range_rad(),
            text: angles(turning),
        })
    }

    /// Where a drag of a point began, metres, world, and the axes along which it may go; no axes if it may go
    /// anywhere in the view's plane.
    pub fn guides(&self) -> Option<(glam::DVec3, Vec<Axis>)> {
        let Held::Point(moving) = &self.dragging()?.held else { return None };
        let free = |axis: &Axis| match moving.drag.constraint() {
            Constraint::View => false,
            Constraint::Along(only) => *axis == only,
            Constraint::Across(not) => *axis != not,
        };
        let axes = Axis::ALL.into_iter().filter(free).collect();
        Some((moving.drag.first_in_world(), axes))
    }
}

fn lower(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

fn upper(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn limb_name(limb: Limb) -> String {
    upper(&telling::words(limb.name()))
}

/// `Left arm reaches`, `Left shoulder turns`.
fn moved(handle: Handle, words: &Words) -> String {
    match handle {
        Handle::Reach(limb) => format!("{} reaches", limb_name(limb)),
        Handle::Elevate(limb) => format!("{} swings, the rest holds", words.named(limb.parts().hinge)),
        Handle::Swing(bone) => format!("{} turns", words.named(bone)),
        Handle::Hips => "Hips move".to_owned(),
        Handle::Spine => "Spine bends".to_owned(),
        Handle::Head => "Head turns".to_owned(),
    }
}

fn of_knob(knob: Knob, words: &Words) -> String {
    match knob {
        Knob::Turn(bone, dof) => format!("{} turns, {}", joint_of(bone, dof, words), dof.name()),
        Knob::InContact(limb, dof) => {
            format!("{} turns about its contact, {}", limb_name(limb), dof.name())
        }
        Knob::Trackball(bone) => format!("{} turns every way", words.named(bone)),
        Knob::Elevation(limb) => moved(Handle::Elevate(limb), words),
        Knob::Collar(bone) => moved(Handle::Swing(bone), words),
        Knob::Spine => moved(Handle::Spine, words),
        Knob::Hips => moved(Handle::Hips, words),
        Knob::Place => "Figure moves over the ground".to_owned(),
        Knob::TurnFigure => "Figure turns where it stands".to_owned(),
    }
}

/// The twist of the elbow's bone is the forearm's.
fn joint_of(bone: Bone, dof: Dof, words: &Words) -> String {
    match (bone, dof) {
        (Bone::LeftLowerArm, Dof::Twist) => "Left forearm".to_owned(),
        (Bone::RightLowerArm, Dof::Twist) => "Right forearm".to_owned(),
        _ => words.named(bone),
    }
}

fn point(moving: &Moving, typed: &Typed, modifiers: Modifiers, words: &Words) -> Vec<String> {
    let mut doing = match &moving.what {
        What::Grab(grab, _) => moved(grab.handle, words),
        What::Target(limb, ..) => format!("{} reaches", limb_name(*limb)),
        What::Place => of_knob(Knob::Place, words),
    };
    if !typed.is_empty() {
        doing.push_str(&format!(" {} cm", typed.text()));
    }
    match moving.drag.constraint() {
        Constraint::View => {}
        Constraint::Along(axis) => doing.push_str(&format!(" along {}", axis.name())),
        Constraint::Across(axis) => doing.push_str(&format!(" in the plane across {}", axis.name())),
    }
    if modifiers.slow {
        doing.push_str(", a tenth as far");
    }
    match moving.snap.map(|snap| snap.space) {
        Some(Space::World) => doing.push_str(", onto the ground"),
        Some(Space::Body(bone)) => doing.push_str(&format!(", onto {}", lower(&words.named(bone)))),
        None if modifiers.snap => doing.push_str(", by whole centimetres"),
        None => {}
    }
    let mut told = vec![doing];
    told.extend(constraint_hint(moving.drag.constraint(), words));
    if !modifiers.slow {
        told.push("Shift: slowly".to_owned());
    }
    if !modifiers.snap {
        told.push(match &moving.what {
            What::Target(..) => "Ctrl: 1 cm steps, no surfaces".to_owned(),
            What::Grab(grab, _) if matches!(grab.handle, Handle::Reach(_)) => {
                "Ctrl: onto a surface, 1 cm steps".to_owned()
            }
            _ => "Ctrl: 1 cm steps".to_owned(),
        });
    }
    told
}

fn constraint_hint(constraint: Constraint, words: &Words) -> Option<String> {
    if constraint == Constraint::View {
        let (keys, shifted) = words.axes()?;
        return Some(format!("{keys}: along an axis{}", if shifted { ", with Shift across it" } else { "" }));
    }
    let key = (words.key)(constraint);
    (!key.is_empty()).then(|| format!("{key} again: freely"))
}

fn ring(turning: &Turning, typed: &Typed, modifiers: Modifiers, words: &Words) -> Vec<String> {
    let mut doing = of_knob(turning.knob, words);
    match typed.is_empty() {
        true => doing.push_str(&format!(", {}", angles(turning))),
        false => doing.push_str(&format!(" by {}°", typed.text())),
    }
    let mut told = vec![doing];
    told.extend(turning_hints(modifiers));
    told
}

fn turning_hints(modifiers: Modifiers) -> Vec<String> {
    let mut told = Vec::new();
    told.push(if modifiers.slow { "a tenth as far" } else { "Shift: slowly" }.to_owned());
    told.push(if modifiers.snap { "by 5° steps" } else { "Ctrl: 5° steps" }.to_owned());
    told
}

/// `+12.5°, 92.5°`.
fn angles(turning: &Turning) -> String {
    let [low, high] = turning.range_rad().unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let by = turning.angle_rad.max(low.min(0.0)).min(high.max(0.0)).to_degrees() + 0.0;
    match &turning.turn {
        Turn::Joint(ring) => format!("{by:+.1}°, {:.1}°", ring.angle_deg(by.to_radians()) + 0.0),
        Turn::InContact { ring, .. } => format!("{by:+.1}°, {:.1}°", ring.start_deg + by + 0.0),
        Turn::Elevation { sense, start_deg, .. } => {
            let now = wrapped((start_deg + sense * by).to_radians()).to_degrees();
            format!("{:+.1}°, {now:.1}°", sense * by + 0.0)
        }
        Turn::Figure { .. } => format!("{by:+.1}°"),
    }
}

fn ball(rolling: &Rolling, typed: &Typed, modifiers: Modifiers, words: &Words) -> Vec<String> {
    let mut doing = of_knob(Knob::Trackball(rolling.bone), words);
    match typed.is_empty() {
        true => doing.push_str(&format!(", {:.1}°", rolling.turned.length().to_degrees())),
        false => doing.push_str(&format!(" by {}°", typed.text())),
    }
    match rolling.constraint {
        Constraint::View => {}
        Constraint::Along(axis) => doing.push_str(&format!(" about {}", axis.name())),
        Constraint::Across(axis) => doing.push_str(&format!(" but not about {}", axis.name())),
    }
    let mut told = vec![doing];
    told.extend(words.axes().map(|(keys, _)| format!("{keys}: about an axis")));
    told.extend(turning_hints(modifiers));
    told
}
