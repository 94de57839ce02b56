//! What each action does in a window on a chain, and which there are.

use edit::{ChainCommand, ChainNode, ChainRequest, Step};
use egui::Context;
use rig::View;

use super::ChainSession;
use crate::action::{Action, Group};
use crate::dialogs::{Dialog, Intent};
use crate::session::style_of;
use crate::settings::Look;
use crate::toolbar::Acting;

/// Whether an action means something for a chain.
pub fn knows(action: Action) -> bool {
    use Action::*;
    match action.group() {
        Group::File => action != New,
        Group::Edit => matches!(action, Undo | Redo),
        Group::Selection => matches!(action, Parent | Child | NextJoint | PreviousJoint),
        Group::Pose => matches!(action, ClearRotation | Reset | Ranges),
        Group::View => !matches!(action, LookThroughPictureCamera | SetPictureCamera | JointPlanes),
        Group::Window => !matches!(action, SecondView | Library | Marks | Walk),
        Group::Walk => false,
        Group::Drag => action != TurnInContact,
    }
}

/// Whether an action is done again while its key is held.
pub(super) fn repeats(action: Action) -> bool {
    use Action::*;
    matches!(action, Undo | Redo | NextJoint | PreviousJoint)
        || matches!(action, OrbitLeft | OrbitRight | OrbitUp | OrbitDown | ZoomIn | ZoomOut)
}

/// The words of an action in a window on a chain.
pub const fn words(action: Action) -> &'static str {
    match action {
        Action::Panel => "Joints and sliders",
        Action::ClearRotation => "Joint to 0",
        Action::Reset => "All joints to 0",
        other => other.words(),
    }
}

impl Acting for ChainSession {
    fn keymap(&self) -> &crate::keymap::Keymap {
        &self.keymap
    }

    fn is_on(&self, action: Action) -> Option<bool> {
        match action {
            Action::Ranges => Some(self.editor.document().ranges),
            Action::Panel => Some(self.settings.panel),
            Action::AmbientOcclusion => Some(self.settings.finish.ambient_occlusion),
            Action::Projection => Some(self.picture.camera.projection == rig::Projection::Orthographic),
            _ => style_of(action).map(|style| style == self.settings.finish.style),
        }
    }

    fn can(&self, action: Action) -> bool {
        match action {
            Action::Undo => self.editor.undo_name().is_some(),
            Action::Redo => self.editor.redo_name().is_some(),
            Action::Parent => self.node != ChainNode::Root,
            Action::ClearRotation => self.node.joint(self.editor.robot()).is_some(),
            _ => true,
        }
    }

    fn undo_name(&self) -> Option<&str> {
        self.editor.undo_name()
    }

    fn redo_name(&self) -> Option<&str> {
        self.editor.redo_name()
    }

    fn words(&self, action: Action) -> &'static str {
        words(action)
    }

    fn explained(&self, action: Action) -> &'static str {
        match action {
            Action::Open => "Opens a robot, a chain, a pose, a script or a figure.",
            Action::Save => "Saves the chain to its file.",
            Action::SaveAs => "Saves the chain to another file.",
            Action::SavePicture => {
                "Saves what the view shows: a still, or the view turning around the chain."
            }
            Action::ClearRotation => "The chosen joint back to 0, or as near as its range lets it.",
            Action::Reset => "All joints back to 0, or as near as their ranges let them.",
            Action::Ranges => "Whether joints stop at the ends of their ranges.",
            Action::FrameAll => "Brings the whole chain into the picture.",
            Action::NextJoint => "The next joint toward the tip.",
            Action::PreviousJoint => "The joint before, toward the root.",
            other => other.explained(),
        }
    }
}

impl ChainSession {
    /// Does what an action says, as if its key had been pressed.
    pub fn act(&mut self, ctx: &Context, action: Action) {
        match action.group() {
            _ if !knows(action) => {}
            Group::File => self.file(action),
            Group::Edit => {
                self.driving.stopped_short();
                self.submit(if action == Action::Undo { ChainRequest::Undo } else { ChainRequest::Redo });
            }
            Group::Selection => self.walk(action),
            Group::Pose => self.pose(action),
            Group::View => self.look(action),
            Group::Window => self.window(ctx, action),
            // The picture reads these itself.
            Group::Drag | Group::Walk => {}
        }
    }

    fn file(&mut self, action: Action) {
        match action {
            Action::Open => self.intend(Intent::Open(None)),
            Action::Save => {
                let saved = self.save_or_ask(None);
                self.tell(saved);
            }
            Action::SaveAs => self.ask_where(None),
            Action::SavePicture => self.dialogs.save_picture(self.named().as_deref(), &self.settings.picture),
            Action::Settings => self.dialogs.ask(Dialog::Settings),
            Action::Quit => self.quit_asking(),
            _ => {}
        }
    }

    fn walk(&mut self, action: Action) {
        let robot = self.editor.robot().clone();
        let node = match action {
            Action::NextJoint => self.node.next(self.editor.document(), false),
            Action::PreviousJoint => self.node.next(self.editor.document(), true),
            Action::Parent => {
                let carrier = self.node.joint(&robot).and_then(|joint| robot.carrier(joint));
                carrier.map_or(self.node, |link| ChainNode::of_link(&robot, link))
            }
            _ => {
                let link = self.node.link(&robot);
                let hangs = |node: &ChainNode| {
                    let joint = node.joint(&robot);
                    let carrier = joint.and_then(|joint| robot.carrier(joint));
                    joint.map(|joint| joint + 1) != Some(link)
                        && carrier
                            .is_some_and(|carrier| ChainNode::of_link(&robot, carrier).link(&robot) == link)
                };
                ChainNode::all(self.editor.document()).into_iter().find(hangs).unwrap_or(self.node)
            }
        };
        self.choose(node);
    }

    fn pose(&mut self, action: Action) {
        let chosen = self.node.joint(self.editor.robot());
        let name = |joint: usize| self.editor.robot().joints()[joint].name.clone();
        let command = match action {
            Action::Ranges => ChainCommand::Ranges { on: !self.editor.document().ranges },
            Action::Reset => ChainCommand::Reset { joints: Vec::new() },
            _ => match chosen {
                Some(joint) => ChainCommand::Reset { joints: vec![name(joint)] },
                None => return,
            },
        };
        self.submit_all(vec![ChainRequest::Do(command)]);
    }

    fn look(&mut self, action: Action) {
        use Action::*;
        let (view, finish) = (&mut self.picture, &mut self.settings.finish);
        if let Some(style) = style_of(action) {
            finish.style = style;
        }
        match action {
            NextLook => *finish = finish.next(),
            AmbientOcclusion => finish.ambient_occlusion = !finish.ambient_occlusion,
            Front => view.look_from(View::Front),
            Back => view.look_from(View::Back),
            Left => view.look_from(View::Left),
            Right => view.look_from(View::Right),
            Top => view.look_from(View::Top),
            Bottom => view.look_from(View::Bottom),
            ThreeQuarter => view.look_from(View::ThreeQuarter),
            Opposite => view.camera = view.camera.opposite(),
            OrbitLeft => Step::Left.apply(&mut view.camera),
            OrbitRight => Step::Right.apply(&mut view.camera),
            OrbitUp => Step::Up.apply(&mut view.camera),
            OrbitDown => Step::Down.apply(&mut view.camera),
            ZoomIn => Step::Nearer.apply(&mut view.camera),
            ZoomOut => Step::Farther.apply(&mut view.camera),
            FrameAll => view.frame(&self.editor, None),
            FrameSelection => view.frame(&self.editor, Some(self.node)),
            Projection => view.toggle_projection(),
            _ => {}
        }
    }

    fn window(&mut self, ctx: &Context, action: Action) {
        let settings = &mut self.settings;
        match action {
            Action::Panel => settings.panel = !settings.panel,
            Action::Theme => {
                settings.look = if ctx.theme() == egui::Theme::Dark { Look::Light } else { Look::Dark };
            }
            Action::LargerUi => settings.step_ui_scale(ctx.zoom_factor(), 1.0),
            Action::SmallerUi => settings.step_ui_scale(ctx.zoom_factor(), -1.0),
            Action::ResetUi => settings.ui_scale = 1.0,
            Action::Controls => ctx.memory_mut(|m| m.move_focus(egui::FocusDirection::Next)),
            Action::Help => self.dialogs.ask(Dialog::Help),
            _ => {}
        }
    }
}
