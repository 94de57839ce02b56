//! The picture of a chain: its camera, what the pointer does in it, and how it is painted.

use std::sync::Arc;

use edit::{
    ChainEditor, ChainHands, ChainNode, ChainReach, ChainRequest, ChainSpot, ChainStage, LinkPicker,
    Navigator, Preset, Sight,
};
use egui::{Pos2, Rect, Sense, Ui};
use glam::{DVec3, Vec2, Vec3};
use render::Look;
use rig::{Bone, Bounds, Camera, Projection, Robot, RobotSkin, View};

use super::guides::ChainGuides;
use super::panel::Reaching;
use super::{brackets, marks};
use crate::finish::Finish;
use crate::keymap::Keymap;
use crate::viewport::axis_ball::{self, BallTurn};
use crate::viewport::drawing::{Drawing, write_words};
use crate::viewport::pace::{Pace, Quality};
use crate::viewport::{Body, Part, Picture};

/// Axes count as parallel with a larger cosine between them.
const PARALLEL: f64 = 1.0 - 1e-6;
/// What is left free around a chain when it is framed, as a part of its size: its joints turn.
const AIR: f32 = 0.06;

/// The ends of ranges that a flat view makes room for.
const MOST_ENDS: usize = 16;
/// Tints of what is chosen and of what is under the pointer: faint, for robots have colours of their own, and there are brackets.
const SELECTED: render::Color = [255, 128, 30, 88];
const HOVERED: render::Color = [255, 232, 196, 84];

/// How a chain is looked at, and the gesture in the picture.
#[derive(Clone, Debug)]
pub struct ChainPicture {
    /// Where it is seen from.
    pub camera: Camera,
    /// Whose habits looking around follows.
    pub preset: Preset,
    /// What it is made of and drawn with.
    pub finish: Finish,
    pub(super) hands: ChainHands,
    pub(super) navigator: Navigator,
    pub(super) rect: Rect,
    pub(super) wheeled_at: f64,
    robot: Arc<Robot>,
    skin: Arc<RobotSkin>,
    pub(super) picker: LinkPicker,
    /// From where a chain that moves in one plane is seen flat: the plane's normal.
    flat: DVec3,
    pace: Pace,
    drawn_in: Quality,
    slow: bool,
    unframed: bool,
    /// The joint to which a panel points.
    hinted: Option<usize>,
}

/// What the picture shows, and what it only reads of the window.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The chain.
    pub editor: &'a ChainEditor,
    /// What is chosen.
    pub node: ChainNode,
    /// How a dragged link reaches.
    pub how: Reaching,
    /// What is shown of what the chosen line of links reaches.
    pub guides: ChainGuides,
    /// How the last reach went.
    pub reach: Option<&'a ChainReach>,
    /// Which keys count while something is held.
    pub keymap: &'a Keymap,
    /// Whether the processor draws.
    pub slow: bool,
    /// Whether keys move the chain.
    pub driven: bool,
}

/// What the picture asks for.
#[derive(Clone, Default, Debug)]
pub struct Asked {
    /// Changes of the chain.
    pub requests: Vec<ChainRequest>,
    /// What a click chooses.
    pub chosen: Option<ChainNode>,
}

impl ChainPicture {
    /// A picture of a chain: flat from the side if it moves in one plane, else from the front and left.
    pub fn of(editor: &ChainEditor) -> ChainPicture {
        let (robot, skin) = (editor.robot().clone(), Arc::new(RobotSkin::of(editor.robot())));
        let plane = plane(editor);
        let mut picture = ChainPicture {
            camera: Camera::default().seen_from(View::ThreeQuarter),
            preset: Preset::default(),
            finish: Finish::default(),
            hands: ChainHands::default(),
            navigator: Navigator::default(),
            rect: Rect::from_min_size(Pos2::ZERO, egui::vec2(1.0, 1.0)),
            wheeled_at: f64::NEG_INFINITY,
            picker: LinkPicker::of(&skin),
            robot,
            skin,
            flat: plane.unwrap_or(DVec3::Z),
            pace: Pace::default(),
            drawn_in: Quality::Full,
            slow: false,
            unframed: true,
            hinted: None,
        };
        if plane.is_some() || editor.document().planar {
            picture.look_flat();
        }
        picture
    }

    /// Shows the picture in what is left of the window.
    pub fn show(&mut self, ui: &mut Ui, shown: &Shown) -> Asked {
        let Shown { editor, node, .. } = *shown;
        let (id, rect) = (egui::Id::unique("chain picture"), ui.available_rect_before_wrap());
        ui.allocate_rect(rect, Sense::hover());
        self.rect = rect;
        self.follow(editor);
        if self.unframed {
            self.frame(editor, None);
        }
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Chain"));
        let asked = self.point(ui, &response, shown);
        let quality = self.quality(ui, shown);
        self.paint(ui, shown, quality);
        brackets::paint(ui, self, editor, node);
        match axis_ball::show(ui, rect, &self.camera) {
            Some(BallTurn::Orbit(yaw_rad, pitch_rad)) => self.camera.orbit(yaw_rad, pitch_rad),
            Some(BallTurn::Look(view)) if self.camera.is_at(view) => self.camera = self.camera.opposite(),
            Some(BallTurn::Look(view)) => self.look_from(view),
            None => {}
        }
        asked
    }

    /// Takes on the looks of a chain that has been edited.
    fn follow(&mut self, editor: &ChainEditor) {
        if !Arc::ptr_eq(&self.robot, editor.robot()) {
            self.robot = editor.robot().clone();
            self.skin = Arc::new(RobotSkin::of(&self.robot));
            self.picker = LinkPicker::of(&self.skin);
        }
    }

    /// The link that is lit: the one under the pointer, or the one that is dragged.
    pub fn hovered(&self) -> Option<usize> {
        match self.hands.under() {
            ChainSpot::Link(hit) => Some(hit.link),
            _ => None,
        }
    }

    /// What lies under the pointer, or is held.
    pub fn under(&self) -> ChainSpot {
        self.hands.under()
    }

    /// Whether something is being dragged.
    pub fn is_dragging(&self) -> bool {
        self.hands.is_dragging()
    }

    /// Whether the pointer has hold of the chain.
    pub fn holds(&self) -> bool {
        self.hands.holds()
    }

    /// Lets go of what is held.
    pub fn let_go(&mut self) {
        self.hands.let_go();
    }

    /// Lights up what a joint carries while the pointer is on its name in the panel.
    pub fn hint(&mut self, joint: Option<usize>) {
        self.hinted = joint;
    }

    /// Where the picture is, points.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// How well the last frame drew the chain.
    pub fn drawn_in(&self) -> Quality {
        self.drawn_in
    }

    /// A frame in which the chain was drawn anew took so long.
    pub fn took(&mut self, now: f64, secs: f32) {
        self.pace.took(now, secs);
    }

    /// What is drawn.
    pub fn body(&self) -> Body {
        Body::Robot(self.skin.clone())
    }

    /// Where a point of the world is in the window, points; `None` behind the eye.
    pub fn window_of(&self, point_in_world: DVec3) -> Option<Pos2> {
        self.sight().pixel_of(point_in_world).map(|at| self.rect.min + egui::vec2(at.x, at.y))
    }

    /// Where a press takes each handle of what is chosen, by the names of joint and part, in points of the window.
    pub fn handle_places(&self, editor: &ChainEditor, node: ChainNode) -> Vec<(String, Pos2)> {
        let sight = self.sight();
        let place = |handle: edit::ChainHandle| {
            let at = handle.place(&sight)?;
            let name = format!("{} {}", editor.robot().joints()[handle.joint].name, handle.part.name());
            Some((name, self.rect.min + egui::vec2(at.x, at.y)))
        };
        edit::chain_handles(editor, node, &sight).into_iter().filter_map(place).collect()
    }

    /// From a named side, with the same target and lens.
    pub fn look_from(&mut self, view: View) {
        self.camera = self.camera.seen_from(view);
    }

    /// The other projection.
    pub fn toggle_projection(&mut self) {
        self.camera.projection = match self.camera.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        };
    }

    /// Whether the chain is seen flat, from the side.
    pub fn is_side_view(&self) -> bool {
        let toward = self.camera.axes().z_axis.as_dvec3();
        self.camera.projection == Projection::Orthographic && toward.dot(self.flat) > 1.0 - 1e-4
    }

    /// Sees the chain flat from the side, or from the front and left again.
    pub fn set_side_view(&mut self, on: bool, editor: &ChainEditor) {
        if on {
            self.look_flat();
        } else {
            self.camera.projection = Projection::Perspective;
            self.look_from(View::ThreeQuarter);
        }
        self.frame(editor, None);
    }

    fn look_flat(&mut self) {
        self.camera.projection = Projection::Orthographic;
        let toward = self.flat.as_vec3();
        self.camera.yaw_rad = if toward.y.abs() > 1.0 - 1e-4 { 0.0 } else { toward.x.atan2(toward.z) };
        self.camera.pitch_rad = toward.y.clamp(-1.0, 1.0).asin();
    }

    /// Brings the whole chain into the picture, or what is chosen.
    pub fn frame(&mut self, editor: &ChainEditor, node: Option<ChainNode>) {
        self.unframed = false;
        let own = node.filter(|node| *node != ChainNode::Root);
        let tight = match own {
            Some(node) => Bounds::of(self.corners(editor, node).into_iter().map(|p| p.as_vec3())),
            None if self.is_side_view() => self.swept(editor),
            None => self.skin.bounds(editor.frames()),
        };
        let air = (tight.radius() * if own.is_some() { 1.2 } else { AIR }).max(0.02);
        let bounds = Bounds { min: tight.min - Vec3::splat(air), max: tight.max + Vec3::splat(air) };
        self.camera.frame(bounds, self.rect.width() / self.rect.height().max(1.0));
    }

    /// A box around a chain as it is and with each joint that turns at the ends of its range, so that a flat view has room for what
    /// it does. A chain with many joints is taken as it is.
    fn swept(&self, editor: &ChainEditor) -> Bounds {
        let document = editor.document();
        let turns = document.robot.dofs().enumerate().filter(|(_, dof)| dof.part.is_angle());
        let ends = turns.flat_map(|(slot, dof)| [(slot, dof.range.min), (slot, dof.range.max)]);
        let ends = ends.filter(|(_, end)| end.is_finite()).take(MOST_ENDS + 1);
        let ends: Vec<(usize, f64)> = ends.collect();
        let mut bounds = self.skin.bounds(editor.frames());
        for (slot, end) in ends.iter().filter(|_| ends.len() <= MOST_ENDS) {
            let mut turned = document.clone();
            turned.pose.0[*slot] = *end;
            bounds = bounds.union(self.skin.bounds(&turned.frames()));
        }
        bounds
    }

    /// Points around what a node moves by itself, links fixed to its own included, metres, world.
    pub(super) fn corners(&self, editor: &ChainEditor, node: ChainNode) -> Vec<DVec3> {
        let mut all = Vec::new();
        for link in self.rigid(editor, node) {
            let Some(frame) = editor.frames().get(link) else { continue };
            all.extend(self.picker.outermost(link).map(|corner| frame.point(corner)));
        }
        if all.is_empty() {
            let link = node.link(editor.robot());
            let frame = editor.frames().get(link).copied().unwrap_or(editor.document().world_from_root);
            all.extend([frame.position, frame.point(editor.robot().tip(link))]);
        }
        all
    }

    /// The link of a node, and those that are fixed to it.
    pub(super) fn rigid(&self, editor: &ChainEditor, node: ChainNode) -> Vec<usize> {
        let robot = editor.robot();
        let mut links = vec![node.link(robot)];
        for joint in 0..robot.joints().len() {
            let fixed = robot.slot(joint).is_empty();
            if fixed && robot.carrier(joint).is_some_and(|carrier| links.contains(&carrier)) {
                links.push(joint + 1);
            }
        }
        links
    }

    pub(super) fn sight(&self) -> Sight {
        Sight { camera: self.camera, size_px: Vec2::new(self.rect.width(), self.rect.height()) }
    }

    pub(super) fn stage<'a>(&'a self, shown: &Shown<'a>) -> ChainStage<'a> {
        let Shown { editor, node, how, .. } = *shown;
        let sight = self.sight();
        ChainStage { editor, picker: &self.picker, sight, node, solver: how.solver, root: how.root }
    }

    /// How well to draw now; asks for the picture in full once movement has come to rest.
    fn quality(&mut self, ui: &Ui, shown: &Shown) -> Quality {
        let Shown { editor, slow, driven, .. } = *shown;
        if self.slow != slow {
            self.slow = slow;
            self.pace = if slow { Pace::slow() } else { Pace::default() };
        }
        let now = ui.input(|i| i.time);
        let held = self.hands.is_dragging() || self.navigator.motion().is_some();
        let moving = held || driven || editor.in_gesture() || self.is_wheeling(ui);
        let quality = self.pace.quality(now, moving);
        if let Some(secs) = self.pace.rests_in(now).filter(|_| !moving) {
            ui.ctx().request_repaint_after_secs(secs as f32 + 0.01);
        }
        self.drawn_in = quality;
        quality
    }

    fn paint(&self, ui: &Ui, shown: &Shown, quality: Quality) {
        let Shown { editor, node, guides, reach, .. } = *shown;
        let scale = ui.ctx().pixels_per_point();
        let mut drawing = Drawing::new(self.sight(), scale);
        marks::draw(&mut drawing, self, editor, node);
        guides.draw(&mut drawing, editor, node, reach);
        let Drawing { overlay, words, sight, .. } = drawing;
        let chosen = self.rigid(editor, node);
        let chosen = if node == ChainNode::Root { &[][..] } else { &chosen[..] };
        let hovered: Vec<usize> = match self.hinted {
            Some(joint) => vec![joint + 1],
            None => self.hovered().into_iter().collect(),
        };
        let palettes = self.skin.palettes(editor.frames());
        let parts = palettes.into_iter().enumerate().map(|(mesh, palette)| Part {
            palette,
            selected: places(chosen, mesh),
            hovered: places(&hovered, mesh),
        });
        let look = self.finish.on(Look::default()).in_surroundings(!ui.visuals().dark_mode);
        let look = Look { joint_planes: false, selected: SELECTED, hovered: HOVERED, ..quality.of(look) };
        let picture = Picture::of(self.body(), parts.collect(), self.camera, self.rect, scale, overlay, look);
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(self.rect, picture));
        write_words(ui.painter(), self.rect, &sight, &words);
    }
}

/// The places in a mesh of those links that it shows.
fn places(links: &[usize], mesh: usize) -> Vec<Bone> {
    let place = |link: &usize| Some(RobotSkin::place_of(*link)).filter(|(of, _)| *of == mesh);
    links.iter().filter_map(place).map(|(_, bone)| bone).collect()
}

/// The normal, toward a viewer before, beside or above it, of the plane in which all of a chain moves; `None` if it doesn't.
fn plane(editor: &ChainEditor) -> Option<DVec3> {
    let robot = editor.robot();
    let axes = |angles: bool| {
        let dofs = robot.dofs().filter(move |dof| dof.part.is_angle() == angles);
        dofs.filter_map(|dof| edit::chain_axis(editor, dof.joint, dof.part))
    };
    let normal = axes(true).next()?;
    let turns = axes(true).all(|axis| axis.dot(normal).abs() > PARALLEL);
    let slides = axes(false).all(|axis| axis.dot(normal).abs() < 1e-3);
    let toward = [normal.z, normal.x, normal.y].into_iter().find(|part| part.abs() > 0.5)?;
    (turns && slides).then_some(normal * toward.signum())
}
