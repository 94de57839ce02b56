//! The walk in a figure's window: its keys, what is done with it, and how the window is laid out meanwhile.

use std::path::Path;

use edit::{Request, Step};
use egui::{Context, Ui};
use motion::Footing;
use rig::{Contact, Limb, Pose, View};

use super::{PANEL_LEAST, PICTURE_LEAST, Session};
use crate::action::Action;
use crate::dialogs::Paper;
use crate::failure::Failure;
use crate::theme;
use crate::walk::{self, Asked, Walk};

/// What the step is called that takes a walker's pose.
const TAKE: &str = "Take pose";
/// And the one that puts the feet on the ground.
const STAND: &str = "Stand on the ground";

impl Session {
    /// The walk.
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// The walk, to change how it is steered and shown.
    pub fn walk_mut(&mut self) -> &mut Walk {
        &mut self.walk
    }

    /// Whether the window shows the walk.
    pub fn is_walking(&self) -> bool {
        self.walk.is_open()
    }

    /// Goes over to the walk, or back to posing.
    pub(super) fn toggle_walk(&mut self) {
        self.submit(Request::Commit);
        match self.walk.is_open() {
            true => self.walk.leave(),
            false => {
                self.walk.enter(self.editor.figure());
                let fault = self.walk.fault().map(|fault| Failure::Input(fault.to_owned()));
                self.tell(fault.map_or(Ok(()), Err));
            }
        }
    }

    /// What actions of the walk do; nothing while the window poses.
    pub(super) fn act_on_walk(&mut self, action: Action) {
        use Action::*;
        let walk = &mut self.walk;
        if !walk.is_open() {
            return;
        }
        match action {
            WalkAlone => walk.steer.alone = !walk.steer.alone,
            WalkSit => walk.steer.sit = !walk.steer.sit,
            WalkPlay => walk.clock.playing = !walk.clock.playing,
            WalkStep => walk.clock.single(),
            WalkSlower => walk.clock.motion = walk.clock.motion.next(),
            WalkRestart => walk.restart(),
            WalkPlacement => walk.toggle_placement(),
            WalkBeside => walk.toggle_beside(),
            WalkFollow => walk.picture.follows = !walk.picture.follows,
            TakePose => self.take_pose(),
            // Held keys are read frame by frame.
            _ => {}
        }
    }

    /// The walker's present pose becomes the document's, and the window shows it.
    fn take_pose(&mut self) {
        let (figure, document) = (self.editor.figure(), self.editor.pose());
        let Some(pose) = self.walk.pose(figure, document) else { return };
        // Whoever moves it or stands it on the ground again begins with what it is over level ground.
        if let Some(flat) = self.walk.flat_pose(figure, document).filter(|_| self.walk.is_placed()) {
            self.walk.standings.learn(flat, pose.clone());
        }
        let before = self.editor.evaluation().frames[rig::Bone::Hips].position;
        self.submit(Request::PreviewPose { pose: Box::new(pose), name: TAKE });
        self.submit(Request::Commit);
        let after = self.editor.evaluation().frames[rig::Bone::Hips].position;
        self.viewport.go_along(after - before);
        self.walk.ground_in_pose = !self.walk.terrain.is_flat();
        self.walk.leave();
        self.say("Took the walker's pose".to_owned());
    }

    /// What actions on the view do to the walk's picture.
    pub(super) fn look_at_walk(&mut self, action: Action) {
        use Action::*;
        let picture = &mut self.walk.picture;
        match action {
            Front => picture.look_from(View::Front),
            Back => picture.look_from(View::Back),
            Left => picture.look_from(View::Left),
            Right => picture.look_from(View::Right),
            Top => picture.look_from(View::Top),
            Bottom => picture.look_from(View::Bottom),
            ThreeQuarter => picture.look_from(View::ThreeQuarter),
            Opposite => picture.camera = picture.camera.opposite(),
            OrbitLeft => picture.step(Step::Left),
            OrbitRight => picture.step(Step::Right),
            OrbitUp => picture.step(Step::Up),
            OrbitDown => picture.step(Step::Down),
            ZoomIn => picture.step(Step::Nearer),
            ZoomOut => picture.step(Step::Farther),
            FrameAll | FrameSelection => picture.frame_all(),
            Projection => picture.toggle_projection(),
            _ => {}
        }
    }

    /// Lays the window out while the figure walks; the bar has been shown.
    pub(super) fn show_walk(&mut self, ui: &mut Ui) {
        let wish = match self.dialogs.is_open() || ui.ctx().text_edit_focused() {
            true => walk::Wish::default(),
            false => walk::wish(ui, &self.keymap, self.means_walk(ui)),
        };
        let figure = self.editor.figure().clone();
        self.walk.go_on(ui, &figure, wish);
        if self.settings.panel {
            self.walk_panel(ui);
        }
        self.walk.picture.finish = self.settings.finish;
        self.walk.picture.preset = self.viewport.preset;
        let (walk, slow) = (&mut self.walk, self.software);
        egui::CentralPanel::no_frame().show(ui, |ui| walk.show(ui, slow));
    }

    fn walk_panel(&mut self, ui: &mut Ui) {
        let most = (ui.available_width() - PICTURE_LEAST).clamp(PANEL_LEAST, 560.0);
        let panel = egui::Panel::left("panel").default_size(most.min(396.0)).size_range(PANEL_LEAST..=most);
        let frame = egui::Frame::new().fill(theme::of(ui).panel).inner_margin(egui::Margin::symmetric(6, 6));
        let (walk, keymap) = (&mut self.walk, &self.keymap);
        let asked = panel.frame(frame).show(ui, |ui| walk::panel(ui, walk, keymap)).inner;
        for asked in asked {
            self.do_asked(ui.ctx(), asked);
        }
    }

    fn do_asked(&mut self, ctx: &Context, asked: Asked) {
        match asked {
            Asked::Do(action) => self.act(ctx, action),
            Asked::OpenGround => {
                let present = self.walk.terrain.choice.file.clone();
                self.dialogs.open_other(Paper::Ground, present.as_deref());
            }
            Asked::OpenTree => {
                let present = self.walk.tree.path().map(Path::to_owned);
                self.dialogs.open_other(Paper::Tree, present.as_deref());
            }
            Asked::ShippedTree => self.walk.shipped_tree(),
            Asked::Cast(name) => {
                let chosen = self.walk.let_walk(name);
                self.tell(chosen);
            }
        }
    }

    /// The feet of the posed figure come to the ground, as one step; from now on the ground shows.
    pub(super) fn stand_on_ground(&mut self) {
        self.submit(Request::Commit);
        self.walk.terrain.follow();
        let before = self.editor.pose().clone();
        let held =
            [Limb::LeftLeg, Limb::RightLeg].iter().any(|leg| before.limb(*leg).contact != Contact::Free);
        match self.stood(&before) {
            Some(pose) => {
                self.submit(Request::PreviewPose { pose: Box::new(pose), name: STAND });
                self.submit(Request::Commit);
                self.walk.ground_in_pose = true;
                let also = if held { "; the feet let go and now go along with the hips" } else { "" };
                self.say(format!("Stands on the ground{also}"));
            }
            None => self.say("Stand on the ground: the figure has no legs to stand on".to_owned()),
        }
    }

    /// A pose with its feet on the ground that is chosen.
    fn stood(&mut self, pose: &Pose) -> Option<Pose> {
        let footing = Footing::of(self.editor.figure())?;
        let Walk { standings, terrain, .. } = &mut self.walk;
        Some(standings.stand(&footing, terrain.ground(), pose))
    }

    /// Tells the panel which ground is chosen.
    pub(super) fn tell_of_ground(&mut self) {
        let row = self.panels.ground_mut();
        (row.words, row.shows) = (self.walk.terrain.choice.source.words(), self.walk.ground_in_pose);
    }

    /// Does what was asked for in the panel's row about the ground.
    pub(super) fn take_ground_row(&mut self) {
        let row = self.panels.ground_mut();
        self.walk.ground_in_pose = row.shows;
        if std::mem::take(&mut row.stand) {
            self.stand_on_ground();
        }
    }

    /// Lays the ground under the posed figure, if it is shown there; feet follow it while hips or figure are moved over it.
    pub(super) fn lay_ground(&mut self, ui: &Ui) {
        let at = self.editor.evaluation().frames[rig::Bone::Hips].position;
        let (distance, bright) = (self.viewport.camera.distance, !ui.visuals().dark_mode);
        self.viewport.ground = self.walk.under_pose(at, distance, bright);
    }

    /// A gesture that moves hips or figure of a pose that stands, over the ground that shows, brings the feet along on it.
    pub(super) fn keep_standing(&mut self) {
        if !self.editor.in_gesture() || self.viewport.ground.is_none() {
            return;
        }
        let (first, now) = (self.editor.first().pose.clone(), self.editor.pose().clone());
        let moved = (first.hips, first.place) != (now.hips, now.place);
        // Legs that hold on to something, or that the hand itself moves, are left as they are.
        if !moved || !self.walk.standings.knows(&first) || !self.walk.standings.knows(&now) {
            return;
        }
        if let Some(pose) = self.stood(&now).filter(|pose| *pose != now) {
            self.submit(Request::PreviewPose { pose: Box::new(pose), name: STAND });
        }
    }

    /// Whether arrows, Space and Enter mean the walk: no control has the keyboard, or the pointer is on the picture.
    pub(super) fn means_walk(&self, ui: &Ui) -> bool {
        let at = ui.input(|i| i.pointer.hover_pos());
        at.is_some_and(|at| self.walk.picture.rect().contains(at)) || ui.memory(|m| m.focused().is_none())
    }

    /// Takes on a file of ground or a blend tree; nothing if it is none of those, by its name.
    pub(super) fn walks_on(&mut self, path: &Path) -> Option<Result<(), Failure>> {
        let (ground, tree) = (walk::is_ground(path), walk::is_tree(path));
        if !ground && !tree {
            return None;
        }
        if !self.walk.is_open() {
            self.toggle_walk();
        }
        let opened = if ground { self.walk.open_ground(path) } else { self.walk.open_tree(path) };
        if opened.is_ok() {
            self.say(format!("Opened {}", path.display()));
        }
        Some(opened)
    }
}
