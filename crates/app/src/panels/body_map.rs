//! The body map: a figure drawn from the front, on which every shape chooses a joint.

mod figure;
mod outline;

use edit::Choose;
use egui::accesskit::{self, Action};
use egui::{Align2, Color32, CursorIcon, FontId, Key, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui};
use egui::{WidgetInfo, pos2, vec2};
use rig::{Bone, Limb, Part, Side};

use super::{Sheet, glyph};
use crate::choosing::way_of_click;
use crate::labels;
use crate::theme::{self, Palette};

/// How far beside a shape the pointer may be, points: fingertips are small.
const NEAR: f32 = 2.5;

impl Sheet<'_> {
    /// The map, as wide as the panel.
    pub(super) fn body_map(&mut self, ui: &mut Ui) {
        let (_, place) = ui.allocate_space(vec2(ui.available_width(), figure::SIZE.y));
        let origin = pos2(place.center().x.round(), place.top().round());
        let canvas = ui.interact(place, egui::Id::unique("body map"), Sense::click());
        canvas.widget_info(|| WidgetInfo::labeled(Role::Canvas, ui.is_enabled(), "Body map"));
        let under = canvas.hover_pos().and_then(|at| self.shape_at(at - origin.to_vec2()));
        let asked = self.declare_shapes(ui, origin);
        if ui.is_rect_visible(place) {
            self.paint_map(ui, origin, under, canvas.has_focus());
        }
        if canvas.clicked() {
            self.panels.click_on(&canvas);
        }
        if let Some(how) = asked.or_else(|| clicked(ui, &canvas, under)).or_else(|| walked(ui, &canvas)) {
            self.panels.choose(&self.editor.figure().skeleton, how);
        }
        if let Some(bone) = under {
            self.panels.hinted = Some(bone);
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
            canvas.on_hover_text_at_pointer(self.told(bone));
        }
    }

    /// The bone whose shape is at a place of the map, or just beside it.
    fn shape_at(&self, at: Pos2) -> Option<Bone> {
        let known = |shape: &&figure::Shape| self.editor.figure().skeleton.joint(shape.bone).is_some();
        let shapes = figure::SHAPES.iter().rev().filter(known);
        let all = shapes.map(|shape| (outline::distance(&shape.outline, at), shape.bone));
        // The first of the nearest, which is the one on top.
        let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (nearest.0 <= NEAR).then_some(nearest.1)
    }

    /// Names every shape for assistive technology; what that asks to choose.
    fn declare_shapes(&self, ui: &Ui, origin: Pos2) -> Option<Choose> {
        let mut asked = None;
        for bone in Bone::ALL {
            if self.editor.figure().skeleton.joint(bone).is_none() {
                continue;
            }
            // A hand has two shapes; the large one comes later.
            let Some(shape) = figure::SHAPES.iter().rev().find(|shape| shape.bone == bone) else { continue };
            let rect = Rect::from_points(&shape.outline).translate(origin.to_vec2());
            let id = egui::Id::unique(("body map", bone.index()));
            // The canvas below takes the clicks, since shapes are not rectangles.
            let response = ui.interact(rect, id, Sense::empty());
            let (name, chosen) = (map_name(bone), self.panels.selection.contains(bone));
            response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), chosen, &name));
            ui.ctx().accesskit_node_builder(id, |node: &mut accesskit::Node| node.add_action(Action::Click));
            if ui.input(|input| input.has_accesskit_action_request(id, Action::Click)) {
                asked = Some(way_of_click(ui, bone));
            }
        }
        asked
    }

    fn paint_map(&self, ui: &Ui, origin: Pos2, under: Option<Bone>, focused: bool) {
        let (painter, palette) = (ui.painter(), theme::of(ui));
        let moved = |at: &Pos2| *at + origin.to_vec2();
        let pointed = under.or(self.panels.lit);
        for shape in figure::SHAPES.iter() {
            let points: Vec<Pos2> = shape.outline.iter().map(moved).collect();
            let fill = self.fill(palette, shape.bone, pointed == Some(shape.bone));
            // A seam in the panel's colour parts each shape from those behind it; eyes are too small for one.
            let seam = if shape.bone.name().ends_with("Eye") { 0.0 } else { 1.6 };
            painter.add(Shape::convex_polygon(points, fill, Stroke::new(seam, palette.panel)));
        }
        for shape in figure::SHAPES.iter() {
            let points: Vec<Pos2> = shape.outline.iter().map(moved).collect();
            if let Some(stroke) = self.rim(palette, shape.bone, pointed == Some(shape.bone)) {
                painter.add(Shape::closed_line(points, stroke));
            }
        }
        self.paint_signs(ui, origin);
        if focused {
            let place = Rect::from_center_size(origin + vec2(0.0, figure::SIZE.y * 0.5), figure::SIZE);
            let ring = Stroke::new(1.0, palette.accent);
            painter.rect_stroke(place.shrink(1.0), 4.0, ring, egui::StrokeKind::Inside);
        }
    }

    /// Sides, contacts and locks.
    fn paint_signs(&self, ui: &Ui, origin: Pos2) {
        let (painter, palette) = (ui.painter(), theme::of(ui));
        for (side, letter, x) in [(Side::Left, "L", 1.0), (Side::Right, "R", -1.0)] {
            let at = origin + vec2(x * 113.0, 120.0);
            painter.text(at, Align2::CENTER_CENTER, letter, FontId::proportional(15.0), palette.side(side));
        }
        for limb in Limb::ALL {
            let at = origin + figure::contact_place(limb).to_vec2();
            let contact = &self.editor.pose().limb(limb).contact;
            glyph::contact(painter, at, 10.0, contact, palette.side(limb.side()));
        }
        let mut marked = [false; Bone::COUNT];
        for shape in figure::SHAPES.iter().rev().filter(|shape| self.is_locked(shape.bone)) {
            // A hand has two shapes and one padlock.
            if !std::mem::replace(&mut marked[shape.bone.index()], true) {
                self.paint_lock(ui, origin, shape);
            }
        }
    }

    fn paint_lock(&self, ui: &Ui, origin: Pos2, shape: &figure::Shape) {
        let finger = matches!(shape.bone.part(), Part::LeftHand | Part::RightHand);
        let (size, radius) = if finger { (6.5, 0.0) } else { (9.0, 7.0) };
        let at = origin + shape.joint.to_vec2();
        let palette = theme::of(ui);
        ui.painter().circle_filled(at, radius, palette.panel);
        glyph::lock(ui.painter(), at, size, true, palette.text);
    }

    fn fill(&self, palette: &Palette, bone: Bone, pointed: bool) -> Color32 {
        let middle = palette.panel.lerp_to_gamma(palette.text, 0.4);
        let plain = bone.side().map_or(middle, |side| middle.lerp_to_gamma(palette.side(side), 0.16));
        if self.editor.figure().skeleton.joint(bone).is_none() {
            palette.header
        } else if self.panels.selection.contains(bone) {
            palette.accent
        } else if pointed {
            plain.lerp_to_gamma(palette.text, 0.35)
        } else if matches!(bone, Bone::LeftEye | Bone::RightEye | Bone::Jaw) {
            plain.lerp_to_gamma(palette.text, 0.2)
        } else {
            plain
        }
    }

    /// The line around a shape: strong if it is the active one, thin if it is chosen too, or pointed at.
    fn rim(&self, palette: &Palette, bone: Bone, pointed: bool) -> Option<Stroke> {
        if self.panels.selected() == Some(bone) {
            Some(Stroke::new(2.0, palette.text))
        } else if self.panels.selection.contains(bone) || pointed {
            Some(Stroke::new(1.0, palette.text))
        } else {
            None
        }
    }

    /// What the tip over a shape says.
    fn told(&self, bone: Bone) -> String {
        let mut words = labels::full(bone);
        if let Some(limb) = Limb::of(bone) {
            let contact = &self.editor.pose().limb(limb).contact;
            words.push_str(&format!("\n{}: {}", labels::limb(limb), glyph::contact_word(contact)));
        }
        if self.is_locked(bone) {
            words.push_str("\nlocked");
        }
        words
    }
}

/// The accessible name of a shape: `Left elbow on the map`.
fn map_name(bone: Bone) -> String {
    format!("{} on the map", labels::full(bone))
}

/// A click chooses the shape under it, a second one all of its part, and one beside the figure nothing.
fn clicked(ui: &Ui, canvas: &Response, under: Option<Bone>) -> Option<Choose> {
    if canvas.double_clicked() {
        return under.map(|bone| Choose::Part(bone.part()));
    }
    canvas.clicked().then(|| under.map_or(Choose::None, |bone| way_of_click(ui, bone)))
}

/// Arrow keys on the focused map: up and down along the limb, left and right to the same joint beside.
fn walked(ui: &Ui, canvas: &Response) -> Option<Choose> {
    if !canvas.has_focus() {
        return None;
    }
    let keep = egui::EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(canvas.id, keep));
    let ways = [
        (Key::ArrowUp, Choose::Parent),
        (Key::ArrowDown, Choose::Child),
        (Key::ArrowRight, Choose::NextOfLevel),
        (Key::ArrowLeft, Choose::PreviousOfLevel),
    ];
    ui.input(|input| ways.into_iter().find(|(key, _)| input.key_pressed(*key)).map(|(_, how)| how))
}
