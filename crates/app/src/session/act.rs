//! What each action does.

use edit::{Choose, Command, Hold, Request, Step, clear_place, to_rest};
use egui::Context;
use render::Style;
use rig::{Contact, Limb, Locks, Part, View};

use super::Session;
use crate::action::{Action, Group};
use crate::dialogs::{Dialog, Intent};
use crate::keymap::Keymap;
use crate::settings::Look;
use crate::toolbar::Acting;

impl Session {
    /// Does what an action says, as if its key had been pressed.
    pub fn act(&mut self, ctx: &Context, action: Action) {
        match action.group() {
            Group::File => self.file(action),
            Group::Edit => self.step(ctx, action),
            Group::Selection => self.choose(action),
            Group::Pose => self.pose(action),
            Group::View if self.is_walking() => {
                self.look(action);
                self.look_at_walk(action);
            }
            Group::View => self.look(action),
            Group::Window => self.window(ctx, action),
            Group::Walk => self.act_on_walk(action),
            // The picture reads these itself.
            Group::Drag => {}
        }
    }

    fn file(&mut self, action: Action) {
        match action {
            Action::New => self.intend(Intent::New),
            Action::Open => self.intend(Intent::Open(None)),
            Action::Save => {
                let saved = self.save_or_ask(None);
                self.tell(saved);
            }
            Action::SaveAs => self.dialogs.save(self.path.as_deref(), None),
            Action::SavePicture => self.dialogs.save_picture(self.path.as_deref(), &self.settings.picture),
            Action::Settings => self.dialogs.ask(Dialog::Settings),
            Action::Quit => self.quit_asking(),
            _ => {}
        }
    }

    fn step(&mut self, ctx: &Context, action: Action) {
        match action {
            Action::Undo => self.submit(Request::Undo),
            Action::Redo => self.submit(Request::Redo),
            Action::Copy => self.copy(ctx),
            Action::Paste => self.paste(ctx, false),
            Action::PasteMirrored => self.paste(ctx, true),
            _ => {}
        }
    }

    fn choose(&mut self, action: Action) {
        let how = match action {
            Action::Parent => Choose::Parent,
            Action::Child => Choose::Child,
            Action::NextJoint => Choose::Next,
            Action::PreviousJoint => Choose::Previous,
            Action::NextOfLevel => Choose::NextOfLevel,
            Action::PreviousOfLevel => Choose::PreviousOfLevel,
            _ => Choose::None,
        };
        self.panels.choose(&self.editor.figure().skeleton, how);
    }

    fn pose(&mut self, action: Action) {
        let limb = self.panels.selected().and_then(Limb::of);
        let parts = self.chosen_parts();
        match action {
            Action::Mirror => self.submit(Request::Do(Command::Mirror { parts })),
            Action::Reset => self.submit(Request::Do(Command::Reset { parts })),
            Action::StandOnGround => self.stand_on_ground(),
            Action::Balance => self.submit(Request::Do(Command::Balance { amount: 1.0 })),
            Action::Ranges => {
                let on = !self.editor.document().ranges;
                self.submit(Request::Do(Command::Ranges { on }));
            }
            Action::Lock => self.lock(),
            Action::Symmetry => self.submit(Request::Symmetry(!self.document().symmetry)),
            Action::ClearRotation => {
                let chosen = self.panels.selection().bones();
                self.submit_as_one(chosen.iter().flat_map(|bone| to_rest(&self.editor, *bone)).collect());
            }
            Action::ClearPlace => self.submit_as_one(self.to_place_at_rest()),
            Action::CycleContact => match limb {
                Some(limb) => {
                    let next = self.next_contact(limb);
                    self.submit(Request::Do(next));
                }
                None => self.ask_for_a_limb(action),
            },
            Action::Flip => match limb {
                Some(limb) => self.submit(Request::Do(Command::Flip { limb })),
                None => self.ask_for_a_limb(action),
            },
            _ => {}
        }
    }

    fn ask_for_a_limb(&mut self, action: Action) {
        self.say(format!("{}: choose an arm or a leg first", action.words()));
    }

    /// The parts that are chosen; none means all.
    pub(super) fn chosen_parts(&self) -> Vec<Part> {
        self.panels.selection().parts()
    }

    /// Several commands as one step.
    pub(super) fn submit_as_one(&mut self, commands: Vec<Command>) {
        if !commands.is_empty() {
            self.submit(Request::PreviewAll(commands));
            self.submit(Request::Commit);
        }
    }

    /// Free, then a point, then planted, then free again; a contact keeps its space.
    fn next_contact(&mut self, limb: Limb) -> Command {
        let contact = self.editor.pose().limb(limb).contact;
        let next = match contact {
            Contact::Free => Hold::Point,
            Contact::Point { .. } => Hold::Planted,
            Contact::Planted { .. } => Hold::Free,
        };
        let space = match contact.target() {
            Some((space, _)) => space,
            None => self.viewport.nearest_space(&self.editor, limb),
        };
        Command::Keep { limb, contact: next, space }
    }

    /// The figure to the middle of the ground, or what the chosen joints have of a place of their own.
    fn to_place_at_rest(&self) -> Vec<Command> {
        let chosen = self.panels.selection().bones();
        if !chosen.is_empty() {
            return chosen.iter().flat_map(|bone| clear_place(&self.editor, *bone)).collect();
        }
        let place = self.editor.pose().place;
        let placed = place != self.editor.figure().rest_pose().place;
        placed.then_some(Command::Place { by: -place.position, turn: -place.turn }).into_iter().collect()
    }

    /// Locks the chosen joints as one step, or frees them if all are locked.
    fn lock(&mut self) {
        let chosen: Locks = self.panels.selection().bones().iter().copied().collect();
        let on = !chosen.iter().all(|bone| self.document().locks.contains(bone));
        match chosen.is_empty() {
            true => self.say("Lock joint: choose one first".to_owned()),
            false => self.submit(Request::Lock(chosen, on)),
        }
    }

    fn look(&mut self, action: Action) {
        use Action::*;
        let (view, finish) = (&mut self.viewport, &mut self.settings.finish);
        if let Some(style) = style_of(action) {
            finish.style = style;
        }
        match action {
            NextLook => *finish = finish.next(),
            JointPlanes => finish.joint_planes = !finish.joint_planes,
            AmbientOcclusion => finish.ambient_occlusion = !finish.ambient_occlusion,
            Front => view.view(View::Front),
            Back => view.view(View::Back),
            Left => view.view(View::Left),
            Right => view.view(View::Right),
            Top => view.view(View::Top),
            Bottom => view.view(View::Bottom),
            ThreeQuarter => view.view(View::ThreeQuarter),
            Opposite => view.view_opposite(),
            OrbitLeft => view.step(Step::Left),
            OrbitRight => view.step(Step::Right),
            OrbitUp => view.step(Step::Up),
            OrbitDown => view.step(Step::Down),
            ZoomIn => view.step(Step::Nearer),
            ZoomOut => view.step(Step::Farther),
            FrameAll => view.frame_all(&self.editor),
            FrameSelection => view.frame(&self.editor, self.panels.selected()),
            Projection => view.toggle_projection(),
            LookThroughPictureCamera => view.toggle_picture_camera(),
            SetPictureCamera => view.set_picture_camera(),
            _ => {}
        }
    }

    fn window(&mut self, ctx: &Context, action: Action) {
        let settings = &mut self.settings;
        match action {
            Action::Marks => self.viewport.marks = !self.viewport.marks,
            Action::SecondView => self.viewport.side_view = !self.viewport.side_view,
            Action::Panel => settings.panel = !settings.panel,
            Action::Library => settings.library = !settings.library,
            Action::Theme => {
                settings.look = if ctx.theme() == egui::Theme::Dark { Look::Light } else { Look::Dark };
            }
            Action::LargerUi => settings.step_ui_scale(ctx.zoom_factor(), 1.0),
            Action::SmallerUi => settings.step_ui_scale(ctx.zoom_factor(), -1.0),
            Action::ResetUi => settings.ui_scale = 1.0,
            Action::Controls => ctx.memory_mut(|m| m.move_focus(egui::FocusDirection::Next)),
            Action::Help => self.dialogs.ask(Dialog::Help),
            Action::Walk => self.toggle_walk(),
            _ => {}
        }
    }
}

impl Acting for Session {
    fn keymap(&self) -> &Keymap {
        &self.keymap
    }

    fn is_on(&self, action: Action) -> Option<bool> {
        match action {
            Action::Ranges => Some(self.document().ranges),
            Action::Marks => Some(self.viewport.marks),
            Action::Panel => Some(self.settings.panel),
            Action::Library => Some(self.settings.library),
            Action::Symmetry => Some(self.document().symmetry),
            Action::SecondView => Some(self.viewport.side_view),
            Action::Walk => Some(self.is_walking()),
            Action::WalkAlone => Some(self.walk.steer.alone),
            Action::WalkSit => Some(self.walk.steer.sit),
            Action::WalkPlay => Some(self.walk.clock.playing),
            Action::WalkPlacement => Some(self.walk.is_placed()),
            Action::WalkBeside => Some(self.walk.beside),
            Action::WalkFollow => Some(self.walk.picture.follows),
            Action::LookThroughPictureCamera => Some(self.viewport.looks_through_picture_camera()),
            Action::JointPlanes => Some(self.settings.finish.joint_planes),
            Action::AmbientOcclusion => Some(self.settings.finish.ambient_occlusion),
            Action::Projection => Some(self.viewport.camera.projection == rig::Projection::Orthographic),
            Action::Lock => {
                let chosen = self.panels.selection();
                Some(
                    !chosen.is_empty()
                        && chosen.bones().iter().all(|bone| self.document().locks.contains(*bone)),
                )
            }
            _ => style_of(action).map(|style| style == self.settings.finish.style),
        }
    }

    fn can(&self, action: Action) -> bool {
        let chosen = !self.panels.selection().is_empty();
        let posing = matches!(action.group(), Group::Selection | Group::Pose);
        match action {
            _ if posing && self.is_walking() => false,
            _ if action.group() == Group::Walk => self.is_walking(),
            Action::Undo => self.editor.undo_name().is_some(),
            Action::Redo => self.editor.redo_name().is_some(),
            Action::Parent | Action::Child | Action::SelectNone | Action::Lock | Action::ClearRotation => {
                chosen
            }
            Action::CycleContact | Action::Flip => {
                self.panels.selected().is_some_and(|bone| Limb::of(bone).is_some())
            }
            _ => true,
        }
    }

    fn undo_name(&self) -> Option<&str> {
        self.editor.undo_name()
    }

    fn redo_name(&self) -> Option<&str> {
        self.editor.redo_name()
    }
}

/// The style that an action chooses.
pub const fn style_of(action: Action) -> Option<Style> {
    match action {
        Action::StudioLook => Some(Style::Studio),
        Action::ClayLook => Some(Style::Clay),
        Action::MatcapLook => Some(Style::Matcap),
        Action::FlatLook => Some(Style::Flat),
        Action::LineLook => Some(Style::Line),
        _ => None,
    }
}
