//! Keys that act on the chosen joint: contact, carrier and carried, back to rest.

use edit::{By, Command, Editor, Hold};
use egui::{Key, Modifiers, Ui};
use rig::{Bone, Contact, Limb, Space};

/// What a key asks for.
#[derive(Clone, PartialEq, Debug)]
pub enum Wish {
    /// A change of the pose, one step.
    Ask(Vec<Command>),
    /// Another joint is chosen.
    Choose(Bone),
}

/// The wish of the keys that were pressed, if any. Typing in a field wishes for nothing.
pub fn wish(ui: &Ui, editor: &Editor, chosen: Option<Bone>) -> Option<Wish> {
    let bone = chosen.filter(|_| !ui.ctx().text_edit_focused() && !editor.in_gesture())?;
    let pressed = |modifiers, key| ui.input_mut(|i| i.consume_key(modifiers, key));
    if pressed(Modifiers::ALT, Key::R) {
        return Some(Wish::Ask(to_rest(editor, bone)));
    }
    if pressed(Modifiers::NONE, Key::P) {
        return Limb::of(bone).map(|limb| Wish::Ask(vec![next_contact(editor, limb)]));
    }
    if pressed(Modifiers::NONE, Key::OpenBracket) {
        return editor.figure().skeleton.joint(bone)?.carrier.map(Wish::Choose);
    }
    if pressed(Modifiers::NONE, Key::CloseBracket) {
        let carried = |joint: &&rig::Joint| joint.carrier == Some(bone);
        return editor.figure().skeleton.joints().find(carried).map(|joint| Wish::Choose(joint.bone));
    }
    None
}

/// Free, then a point, then planted, then free again; a contact keeps its space.
fn next_contact(editor: &Editor, limb: Limb) -> Command {
    let contact = editor.pose().limb(limb).contact;
    let next = match contact {
        Contact::Free => Hold::Point,
        Contact::Point { .. } => Hold::Planted,
        Contact::Planted { .. } => Hold::Free,
    };
    let space = contact.target().map_or(Space::World, |(space, _)| space);
    Command::Keep { limb, contact: next, space }
}

/// Every angle of the joint to 0.
fn to_rest(editor: &Editor, bone: Bone) -> Vec<Command> {
    let joint = editor.figure().skeleton.joint(bone);
    let zero = |dof| Command::Turn { joint: bone, dof, degrees: 0.0, by: By::To };
    joint.into_iter().flat_map(rig::Joint::dofs).map(zero).collect()
}
