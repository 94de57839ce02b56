//! The figure walks: a window's other mode beside posing. It has a state of its own and never touches the document; what it
//! shows can be taken as the pose.

pub mod bar;
mod blend_map;
mod cast;
mod clock;
mod keys;
mod marks;
#[cfg(any(test, feature = "gamepad"))]
mod pad;
mod panel;
mod picture;
mod prints;
mod stage;
mod standing;
mod steer;
mod terrain;
mod tree_file;
mod tree_view;

use std::path::Path;
use std::sync::Arc;

use egui::Ui;
use glam::DVec3;
use motion::{Ground, Tree, Walker};
use rig::{Bone, Figure, Place, Pose};

use crate::failure::Failure;
use crate::picture::{Subject, Underfoot};
use blend_map::BlendMap;
use cast::Cast;
pub use clock::{Clock, Motion, STEP_SECS};
pub use keys::wish;
pub use marks::{Mark, Marks};
pub use panel::{Asked, show as panel};
pub use picture::WalkPicture;
use picture::{Figured, Shown};
use stage::{Moment, Stage, frames_of};
use standing::Standings;
pub use steer::{Steer, Wish};
pub use terrain::{Source as GroundSource, Terrain, is_ground};
use tree_file::TreeFile;
pub use tree_file::is_tree;

/// The walk of a window's figure.
#[derive(Default)]
pub struct Walk {
    open: bool,
    /// What time does.
    pub clock: Clock,
    /// What steers.
    pub steer: Steer,
    /// What is walked on.
    pub terrain: Terrain,
    /// What is drawn over the figure.
    pub marks: Marks,
    /// Whether feet are not placed on the ground.
    pub unplaced: bool,
    /// Whether the walk is shown twice, without foot placement and with it.
    pub beside: bool,
    /// Whether the ground is shown under the figure while it is posed.
    pub ground_in_pose: bool,
    /// How it is looked at.
    pub picture: WalkPicture,
    pub(crate) tree: TreeFile,
    /// Who walks.
    cast: Cast,
    stage: Option<Stage>,
    /// Why the figure can't walk.
    fault: Option<String>,
    /// When the last frame was, seconds of the context's clock.
    framed_at: Option<f64>,
    /// Poses that were brought to the ground.
    pub(crate) standings: Standings,
    patch: Patch,
    pose_patch: Patch,
    #[cfg(feature = "gamepad")]
    pads: pad::Pads,
}

/// The ground's piece that is drawn, and of which ground it is.
#[derive(Clone, Debug, Default)]
struct Patch(Option<(u64, Underfoot)>);

impl Patch {
    /// The piece around a place as far as a camera shows it; nothing where the ground is level at 0.
    fn around(&mut self, terrain: &Terrain, at: DVec3, distance: f32, bright: bool) -> Option<&Underfoot> {
        if terrain.is_flat() {
            self.0 = None;
            return None;
        }
        let (ground, distance) = (terrain.ground(), f64::from(distance));
        let patch = match &self.0 {
            Some((revision, patch)) if *revision == terrain.revision() => {
                patch.following(ground, at, distance, bright)
            }
            _ => Underfoot::around(ground, at, distance, bright),
        };
        self.0 = Some((terrain.revision(), patch));
        self.0.as_ref().map(|(_, patch)| patch)
    }
}

impl Walk {
    /// Whether the window shows the walk.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Why the figure can't walk, if it can't.
    pub fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }

    /// Goes over to the walk of a figure, which begins where it left off if it is the same one.
    pub fn enter(&mut self, figure: &Arc<Figure>) {
        self.open = true;
        self.framed_at = None;
        self.keep_up(figure);
    }

    /// Goes back to posing.
    pub fn leave(&mut self) {
        self.open = false;
        self.framed_at = None;
    }

    /// Makes walkers of a figure that is another one than before.
    fn keep_up(&mut self, figure: &Arc<Figure>) {
        let figure = self.cast.figure(figure);
        let same = self.stage.as_ref().is_some_and(|stage| Arc::ptr_eq(stage.figure(), figure));
        if same {
            return;
        }
        match self.tree.read_for(figure) {
            Ok(tree) => {
                let walker = Walker::new(figure.clone(), tree);
                self.stage = Some(Stage::new(figure.clone(), walker));
                self.fault = None;
                self.picture.frame_all();
                self.settle();
            }
            Err(fault) => {
                self.stage = None;
                self.fault = Some(fault.to_string());
            }
        }
    }

    /// Brings the walkers onto the ground where they are.
    fn settle(&mut self) {
        let (placement, beside) = (!self.unplaced, self.beside);
        if let Some(stage) = &mut self.stage {
            stage.place(placement, beside);
        }
    }

    /// Begins anew where the walk began.
    pub fn restart(&mut self) {
        self.clock.restart();
        self.steer.restart();
        if let Some(stage) = &mut self.stage {
            stage.restart();
        }
        self.settle();
        self.picture.frame_all();
    }

    /// Whether the feet of the walker that is steered are placed on the ground.
    pub fn is_placed(&self) -> bool {
        !self.unplaced || self.beside
    }

    /// Places feet, or no longer.
    pub fn toggle_placement(&mut self) {
        if !self.beside {
            self.unplaced = !self.unplaced;
            self.settle();
        }
    }

    /// Shows both ways side by side, or no longer.
    pub fn toggle_beside(&mut self) {
        self.beside = !self.beside;
        self.settle();
        self.picture.frame_all();
    }

    /// Takes on the ground of a file.
    ///
    /// # Errors
    /// A file that is no ground.
    pub fn open_ground(&mut self, path: &Path) -> Result<(), Failure> {
        self.terrain.open(path)
    }

    /// Takes on a blend tree, now and whenever it is saved.
    ///
    /// # Errors
    /// A file that is no blend tree: line and column. The tree of before goes on.
    pub fn open_tree(&mut self, path: &Path) -> Result<(), Failure> {
        let Some(stage) = &self.stage else { return Ok(()) };
        let tree = self.tree.open(stage.figure(), path)?;
        self.take(&tree);
        Ok(())
    }

    /// Goes back to the blend tree that comes with the program.
    pub fn shipped_tree(&mut self) {
        self.tree.reset();
        self.read_tree();
    }

    /// Reads the tree's file again; the walkers keep the tree of before if it is at fault.
    fn read_tree(&mut self) {
        let Some(stage) = &self.stage else { return };
        if let Ok(tree) = self.tree.read(stage.figure()) {
            self.take(&tree);
        }
    }

    /// Gives the walkers another tree; their phases stay.
    fn take(&mut self, tree: &Arc<Tree>) {
        if let Some(stage) = &mut self.stage {
            stage.change(|walker| walker.replace_tree(tree.clone()));
        }
    }

    /// Lets another figure walk, or the window's own.
    ///
    /// # Errors
    /// A figure that can't be read.
    pub fn let_walk(&mut self, name: Option<&'static str>) -> Result<(), Failure> {
        self.cast.choose(name)
    }

    /// The walking figure's present pose: on level ground the figure stays where the document's pose stands, elsewhere it
    /// stands where it has come to.
    pub fn pose(&self, figure: &Figure, document: &Pose) -> Option<Pose> {
        let stage = self.stage.as_ref()?;
        Some(self.taken(figure, document, &stage.actor().now().pose, stage))
    }

    /// The same as it is over level ground, before its feet are placed.
    pub(crate) fn flat_pose(&self, figure: &Figure, document: &Pose) -> Option<Pose> {
        let stage = self.stage.as_ref()?;
        let (pose, flat) = (&stage.actor().now().pose, stage.actor().walker().flat());
        Some(self.taken(
            figure,
            document,
            &Pose { hips: flat.hips, angles: flat.angles, ..pose.clone() },
            stage,
        ))
    }

    /// A walker's pose as one of the document's figure.
    fn taken(&self, figure: &Figure, document: &Pose, pose: &Pose, stage: &Stage) -> Pose {
        let place = if self.terrain.is_flat() { document.place } else { pose.place };
        let own = match self.cast.is_own() {
            true => pose.clone(),
            false => rig::carried_over(stage.figure(), pose, figure),
        };
        Pose { place, ..own }
    }

    /// What a picture of the walker shows, on its ground.
    pub fn subject(&self) -> Option<Subject> {
        let stage = self.stage.as_ref()?;
        let moment = stage.actor().shown(self.clock.between());
        let patch = self.patch.0.as_ref().map(|(_, patch)| patch.clone());
        Some(Subject::of_pose(stage.figure(), &moment.pose, patch))
    }

    /// Where the walker has come to.
    pub fn place(&self) -> Option<Place> {
        Some(self.stage.as_ref()?.actor().now().pose.place)
    }

    /// Goes on for so many seconds at once, with nobody steering, and halts; for pictures.
    pub fn walk_on(&mut self, secs: f64) {
        self.terrain.follow();
        for _ in 0..(secs.clamp(0.0, 600.0) / STEP_SECS).round() as u32 {
            self.step(Wish::default());
        }
        self.clock.playing = false;
        self.picture.frame_all();
    }

    fn step(&mut self, wish: Wish) {
        let steering = self.steer.step(wish, STEP_SECS);
        if let Some(stage) = &mut self.stage {
            stage.step(self.terrain.ground(), &steering);
        }
    }

    /// Where the walker's hips are, metres, world.
    pub fn hips(&self) -> Option<DVec3> {
        let stage = self.stage.as_ref()?;
        Some(frames_of(stage.figure(), stage.actor().now())[Bone::Hips].position)
    }

    /// What is walked on.
    pub fn ground(&self) -> &Ground {
        self.terrain.ground()
    }

    /// The ground's piece under a figure that is posed, if it is to be shown there.
    pub fn under_pose(&mut self, at: DVec3, distance: f32, bright: bool) -> Option<Underfoot> {
        if !self.ground_in_pose {
            return None;
        }
        self.terrain.follow();
        self.pose_patch.around(&self.terrain, at, distance, bright).cloned()
    }

    /// A frame: time goes on by what has passed since the last one, steered by what is wished for.
    pub fn go_on(&mut self, ui: &Ui, figure: &Arc<Figure>, wish: Wish) {
        self.keep_up(figure);
        if self.tree.is_saved_anew(ui.input(|i| i.time)) {
            self.read_tree();
        }
        self.terrain.follow();
        let now = ui.input(|i| i.time);
        let passed = self.framed_at.map_or(0.0, |then| now - then);
        self.framed_at = Some(now);
        #[cfg(feature = "gamepad")]
        let wish = wish.and(self.pads.wish());
        for _ in 0..self.clock.advance(passed) {
            self.step(wish);
        }
        if self.clock.playing && self.stage.is_some() {
            ui.ctx().request_repaint();
        } else {
            // A tree that is saved is seen without a key.
            self.tree.wake(ui.ctx());
        }
    }

    /// Shows the picture in what is left of the window.
    pub fn show(&mut self, ui: &mut Ui, slow: bool) {
        let Some(stage) = &self.stage else {
            return nobody(ui, self.fault.as_deref().unwrap_or("There is no figure"));
        };
        let (figure, share) = (stage.figure(), self.clock.between());
        let actors = [stage.unplaced(), Some(stage.actor())].into_iter().flatten();
        let moments: Vec<_> = actors.map(|actor| (actor.shown(share), actor.prints())).collect();
        let frames: Vec<_> = moments.iter().map(|(moment, _)| frames_of(figure, moment)).collect();
        let several = moments.len() > 1;
        let walkers = moments.iter().zip(&frames).enumerate();
        let walkers: Vec<Figured> = walkers
            .map(|(i, ((moment, prints), frames))| {
                let title = several.then(|| caption(i == 1, moment));
                Figured { moment, frames, prints, title }
            })
            .collect();
        let at = walkers.last().map_or(DVec3::ZERO, |walker| walker.frames[Bone::Hips].position);
        let bright = !ui.visuals().dark_mode;
        let ground = self.patch.around(&self.terrain, at, self.picture.camera.distance, bright);
        let (marks, playing) = (self.marks, self.clock.playing);
        self.picture.show(ui, &Shown { figure, walkers: &walkers, ground, marks, playing, slow });
    }

    /// What the ground is like where the walker stands.
    pub(crate) fn ground_words(&self) -> String {
        match self.hips().filter(|_| !self.terrain.is_flat()) {
            Some(at) => {
                let under = self.terrain.ground().under(at.x, at.z);
                format!("{:.0}° here", under.normal.y.clamp(-1.0, 1.0).acos().to_degrees())
            }
            None => String::new(),
        }
    }

    /// The nodes of the walker's tree as they are drawn.
    pub(crate) fn tree_rows(&self) -> Vec<tree_view::Row> {
        let Some(stage) = &self.stage else { return Vec::new() };
        let walker = stage.actor().walker();
        let row = |node: motion::OutlineNode| tree_view::Row {
            depth: node.depth,
            label: node.label.to_owned(),
            weight: node.weight,
            is_clip: node.is_clip,
        };
        walker.tree().outline(walker.state()).map(row).collect()
    }

    /// The axis blend that is live.
    pub(crate) fn blend_map(&self) -> Option<BlendMap> {
        let walker = self.stage.as_ref()?.actor().walker();
        BlendMap::of(walker.tree().outline(walker.state()), walker.steering())
    }

    /// How the feet stand, and how far the hips are lowered.
    pub(crate) fn feet_words(&self) -> String {
        let Some(stage) = &self.stage else { return String::new() };
        let now = stage.actor().now();
        let foot = |i: usize| if now.feet[i].stance { "stands" } else { "swings" };
        let drop = now.hips_drop_m * 100.0;
        format!("Left {}, right {} · hips {drop:.1} cm lower", foot(0), foot(1))
    }
}

/// What stands above one of two pictures: which it is, and how its soles meet the ground.
fn caption(placed: bool, moment: &Moment) -> String {
    let [deep, high] = moment.off_the_ground().map(|m| m * 1000.0);
    let title = if placed { "With foot placement" } else { "Without foot placement" };
    format!("{title}\n{deep:.0} mm in the ground, {high:.0} mm above it")
}

fn nobody(ui: &mut Ui, why: &str) {
    ui.centered_and_justified(|ui| ui.label(why));
}
