//! The picture of the figure and what the pointer does in it.
//!
//! What the pointer does to the figure is told to [`edit::Hands`], what it does to the view to [`edit::Navigator`];
//! this only translates egui's input, and draws. Every change of the pose leaves as a request.

pub mod axis_ball;
pub mod backdrop;
pub mod balance;
pub mod drawing;
mod framed;
pub mod guides;
mod handles;
mod marks;
pub mod navigation;
pub mod pace;
mod picture;
mod picture_camera;
pub mod pointer;
mod side_view;

use std::collections::VecDeque;

use edit::{Choose, Editor, Hands, Navigator, Preset, Request, Selection, Sight, Stage};
use egui::{Pos2, Rect, Sense, Ui};
use glam::{DVec3, Vec2};
use render::Look;
use rig::{Bone, Camera, Limb, Space, View};

use backdrop::Backdrop;
use drawing::{Drawing, write_words};
pub use guides::{Guide, Guides};
use pace::{Pace, Quality};
pub use picture::{Body, Part, Picture, drawn, install};

use crate::finish::Finish;
use crate::keymap::Keymap;
use crate::picture::Underfoot;

/// How the figure is looked at, and the gesture in the picture.
#[derive(Clone, Debug)]
pub struct Viewport {
    /// Where it is seen from.
    pub camera: Camera,
    /// Whether joints, targets and handles are marked, and can be taken.
    pub marks: bool,
    /// Whose habits looking around follows.
    pub preset: Preset,
    /// Which keys count while something is held.
    pub keymap: Keymap,
    /// What the figure is made of and drawn with.
    pub finish: Finish,
    /// How well it is drawn while it moves.
    pace: Pace,
    /// How well it was drawn last.
    drawn_in: Quality,
    /// Whether the pace is that of an adapter known to be slow.
    slow: bool,
    /// Width and height of the pictures that the picture camera takes, pixels.
    pub picture_size: [u32; 2],
    /// Whether the small second picture is shown.
    pub side_view: bool,
    /// A picture behind the figure.
    pub backdrop: Backdrop,
    /// What of each limb's reach is shown.
    pub guides: Guides,
    /// What each limb touches, and at which revision.
    touching: Option<(u64, [Space; Limb::ALL.len()])>,
    /// The ground under the figure, if it isn't the plane at height 0.
    pub ground: Option<Underfoot>,
    /// Whether the centre of mass over the soles is shown.
    pub balance: bool,
    /// What the pointer does to the figure.
    hands: Hands,
    /// What it does to the view.
    navigator: Navigator,
    /// Input that came in one frame with the end of a drag, each event with whether the picture is meant.
    waiting: VecDeque<(egui::Event, bool)>,
    /// Whether the camera still has to be fitted to the picture's shape.
    unframed: bool,
    /// The bone to which a panel points.
    hinted: Option<Bone>,
    /// What the pointer could do where it is, for the status line.
    offering: Option<String>,
    /// The camera with which pictures are taken, apart from the working one.
    pub picture_camera: Option<Camera>,
    /// Whether the pointer is in the second picture, or began to drag there.
    in_side: bool,
    /// The working camera while one looks through the picture camera.
    working: Option<Camera>,
    /// Where the picture was last, points.
    rect: Rect,
    /// When the wheel last turned, seconds of the context's clock.
    wheeled_at: f64,
}

/// What the picture asks for.
#[derive(Clone, Default, Debug)]
pub struct Asked {
    /// Changes of the pose.
    pub requests: Vec<Request>,
    /// A click: what it chooses.
    pub chosen: Option<Choose>,
}

impl Default for Viewport {
    fn default() -> Viewport {
        Viewport {
            camera: Camera::default().seen_from(View::ThreeQuarter),
            marks: true,
            preset: Preset::default(),
            keymap: Keymap::default(),
            finish: Finish::default(),
            pace: Pace::default(),
            drawn_in: Quality::Full,
            slow: false,
            picture_size: [1280, 800],
            side_view: false,
            backdrop: Backdrop::default(),
            guides: Guides::default(),
            touching: None,
            ground: None,
            balance: false,
            hands: Hands::default(),
            navigator: Navigator::default(),
            waiting: VecDeque::new(),
            unframed: true,
            hinted: None,
            offering: None,
            picture_camera: None,
            in_side: false,
            working: None,
            rect: Rect::from_min_size(Pos2::ZERO, egui::vec2(1.0, 1.0)),
            wheeled_at: f64::NEG_INFINITY,
        }
    }
}

impl Viewport {
    /// Shows the picture in what is left of the window; `slow` if the processor draws.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor, selection: &Selection, slow: bool) -> Asked {
        let (id, rect) = (egui::Id::unique("viewport"), ui.available_rect_before_wrap());
        ui.allocate_rect(rect, Sense::hover());
        self.rect = rect;
        if self.unframed {
            self.frame_all(editor);
        }
        self.refit_picture_camera();
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Figure"));
        let here = self.pane(ui).unwrap_or(response);
        let asked = self.point(ui, &here, editor, selection);
        let quality = self.quality(ui, editor, slow);
        self.paint(ui, editor, selection, quality);
        let stage = Stage { sight: self.sight(), ..self.stage(editor, selection.active()) };
        handles::paint(ui, &self.hands, &stage, rect);
        if self.looks_through_picture_camera() {
            self.paint_frame(ui);
        }
        self.paint_side(ui, editor, selection, quality);
        self.axis_ball(ui);
        asked
    }

    /// The bone whose skin is lit: the one under the pointer, or the one that is dragged.
    pub fn hovered(&self) -> Option<Bone> {
        self.hands.hovered()
    }

    /// Lights up a bone's skin while the pointer is on its name in a panel.
    pub fn hint(&mut self, bone: Option<Bone>) {
        self.hinted = bone;
    }

    /// What a drag of the figure is doing and which keys change it; `None` while there is none.
    pub fn telling(&self) -> Option<String> {
        pointer::told_with(&self.keymap, |words| self.hands.telling(words))
    }

    /// Whether the pointer has hold of the figure, or its button is still down after a drag that ended: keys are for it.
    pub fn holds(&self) -> bool {
        self.hands.holds()
    }

    /// What a drag or a click would do where the pointer is; `None` beside the figure and while something is dragged.
    pub fn offering(&self) -> Option<&str> {
        self.offering.as_deref()
    }

    /// Where a press takes each handle of the picture, by its name, in points of the window.
    pub fn handle_places(&self, editor: &Editor, selected: Option<Bone>) -> Vec<(String, Pos2)> {
        let stage = Stage { sight: self.sight(), ..self.stage(editor, selected) };
        let place = |placed: &edit::Placed| {
            let at = self.hands.place_of(&stage, placed)?;
            Some((placed.knob.name(), self.outside(at)))
        };
        self.hands.knobs(&stage).iter().filter_map(place).collect()
    }

    /// What a limb would best hold on to where it is: the bone whose skin it touches, or else the world.
    pub fn nearest_space(&mut self, editor: &Editor, limb: Limb) -> Space {
        let picker = self.hands.skin(editor).picker();
        edit::nearest_space(editor.figure(), editor.pose(), editor.evaluation(), picker, limb)
    }

    /// As [`Viewport::nearest_space`] for every limb, worked out once for a pose.
    pub fn nearest_spaces(&mut self, editor: &Editor) -> [Space; Limb::ALL.len()] {
        match self.touching {
            Some((revision, spaces)) if revision == editor.revision() => spaces,
            _ => {
                let spaces = Limb::ALL.map(|limb| self.nearest_space(editor, limb));
                self.touching = Some((editor.revision(), spaces));
                spaces
            }
        }
    }

    /// Where a point of the world is in the window, points; `None` behind the eye.
    pub fn window_of(&self, point_in_world: DVec3) -> Option<Pos2> {
        self.sight().pixel_of(point_in_world).map(|at| self.outside(at))
    }

    /// Where the picture is, points.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    fn aspect(&self) -> f32 {
        self.rect.width() / self.rect.height().max(1.0)
    }

    fn size(&self) -> Vec2 {
        Vec2::new(self.rect.width(), self.rect.height())
    }

    fn sight(&self) -> Sight {
        Sight { camera: self.camera, size_px: self.size() }
    }

    fn stage<'a>(&self, editor: &'a Editor, selected: Option<Bone>) -> Stage<'a> {
        Stage { editor, sight: self.sight_here(), selected, marks: self.marks }
    }

    /// From the window's points to those of the picture in which the pointer is.
    fn inside(&self, at: Pos2) -> Vec2 {
        let corner = self.rect_here().min;
        Vec2::new(at.x - corner.x, at.y - corner.y)
    }

    /// From the picture's points to the window's.
    fn outside(&self, at: Vec2) -> Pos2 {
        self.rect.min + egui::vec2(at.x, at.y)
    }

    /// How well to draw now; asks for the picture in full once movement has come to rest.
    fn quality(&mut self, ui: &Ui, editor: &Editor, slow: bool) -> Quality {
        if self.slow != slow {
            self.slow = slow;
            self.pace = if slow { Pace::slow() } else { Pace::default() };
        }
        let now = ui.input(|i| i.time);
        let moving = self.is_moving(ui, editor);
        let quality = self.pace.quality(now, moving);
        // What is held and stands still needs no frames; its end brings one.
        if let Some(secs) = self.pace.rests_in(now).filter(|_| !moving) {
            ui.ctx().request_repaint_after_secs(secs as f32 + 0.01);
        }
        self.drawn_in = quality;
        quality
    }

    /// How well the last frame drew the figure.
    pub fn drawn_in(&self) -> Quality {
        self.drawn_in
    }

    /// A frame in which the figure was drawn anew took so long, from its begin to its end on the screen.
    pub fn took(&mut self, now: f64, secs: f32) {
        self.pace.took(now, secs);
    }

    /// What the figure and its surroundings look like at rest.
    fn look(&self, ui: &Ui) -> Look {
        self.finish.on(Look::default()).in_surroundings(!ui.visuals().dark_mode)
    }

    fn is_moving(&self, ui: &Ui, editor: &Editor) -> bool {
        let held = self.hands.is_dragging() || self.navigator.motion().is_some();
        held || editor.in_gesture() || self.is_wheeling(ui)
    }

    fn paint(&self, ui: &Ui, editor: &Editor, selection: &Selection, quality: Quality) {
        let scale = ui.ctx().pixels_per_point();
        let lit = self.hovered().or(self.hinted);
        let mut drawing = Drawing::new(self.sight(), scale);
        marks::draw(&mut drawing, editor, selection, lit.as_slice(), self.marks);
        guides::draw(&mut drawing, editor, &self.guides);
        if self.balance {
            balance::draw(&mut drawing, editor);
        }
        let Drawing { mut overlay, words, sight, .. } = drawing;
        if let Some((first, axes)) = self.hands.guides() {
            marks::axes(&mut overlay, first, &axes, self.camera.distance, scale);
        }
        if self.marks {
            self.mark_picture_camera(&mut overlay, scale);
        }
        let lit = picture::Lit { selected: selection.bones(), hovered: lit };
        let look = quality.of(self.look(ui));
        let picture = Picture::new(editor, self.camera, self.rect, scale, overlay, lit, look)
            .before(self.backdrop.shown())
            .upon(self.ground.as_ref());
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(self.rect, picture));
        write_words(ui.painter(), self.rect, &sight, &words);
    }
}
