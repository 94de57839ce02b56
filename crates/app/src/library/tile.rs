//! One pose of the grid: its portrait and its name. A click applies it, a drag sideways blends it in.

use egui::epaint::{Mesh, Vertex};
use egui::{
    Align2, Color32, CursorIcon, FontId, Id, Key, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui,
    UiBuilder, WidgetInfo, pos2, vec2,
};

use super::entry::Entry;
use super::making::Making;
use super::portraits::Portrait;

/// The space between tiles, points.
pub const GAP: f32 = 8.0;
/// The whole height of a tile, points.
pub const HEIGHT: f32 = PICTURE + NAME;
/// The least that can be blended, per cent.
pub const LEAST: f64 = -50.0;
/// The most, per cent.
pub const MOST: f64 = 150.0;

const PICTURE: f32 = 140.0;
const NAME: f32 = 20.0;
const NARROWEST: f32 = 104.0;
/// How far the pointer goes for one per cent, points.
const POINTS_A_PERCENT: f64 = 2.0;

/// How many tiles stand beside each other in that width.
pub fn columns(width: f32) -> usize {
    (((width + GAP) / (NARROWEST + GAP)) as usize).max(1)
}

/// How wide each of them is.
pub fn width(width: f32, columns: usize) -> f32 {
    ((width - GAP * (columns - 1) as f32) / columns as f32).floor().max(40.0)
}

/// A blend under way.
#[derive(Clone, PartialEq, Debug)]
pub struct Blend {
    /// Which pose.
    path: String,
    /// Where the hand is, per cent, ends not yet applied.
    goal: f64,
}

/// What was done to a tile.
#[derive(Clone, PartialEq, Debug)]
pub enum Deed {
    /// It is to be applied.
    Apply,
    /// It is to be blended in by that many per cent, for now.
    Blend(f64),
    /// It gets another name.
    Rename(String),
    /// It goes to the trash.
    Remove,
}

/// A tile.
pub struct Shown<'a> {
    /// The pose.
    pub entry: &'a Entry,
    /// Its portrait, once it is drawn.
    pub portrait: Option<Portrait>,
    /// Whether portraits can be drawn at all.
    pub drawable: bool,
    /// Whether it is applied mirrored; its portrait is then the mirror image.
    pub flip: bool,
    /// Whether there is something to apply it to.
    pub enabled: bool,
}

impl Shown<'_> {
    /// Shows the tile; says what was done to it.
    pub fn show(
        &self,
        ui: &mut Ui,
        width: f32,
        making: &mut Making,
        blend: &mut Option<Blend>,
    ) -> Option<Deed> {
        let (_, rect) = ui.allocate_space(vec2(width, HEIGHT));
        let picture = Rect::from_min_size(rect.min, vec2(width, PICTURE));
        let name = Rect::from_min_max(pos2(rect.left(), picture.bottom()), rect.max);
        let response = self.button(ui, picture, blend.as_ref());
        let mut deed = self.handled(ui, &response, blend);
        self.keys(ui, &response, making);
        if ui.is_rect_visible(rect) {
            self.paint(ui, &response, blend.as_ref());
        }
        deed = deed.or(self.name(ui, name, &response, making));
        if making.is_removing(&self.entry.path) {
            deed = question(ui, picture, self.entry, making).or(deed);
        }
        deed
    }

    fn button(&self, ui: &Ui, rect: Rect, blend: Option<&Blend>) -> Response {
        let id = Id::unique(("library tile", &self.entry.path));
        let sense = if self.enabled { Sense::click_and_drag() } else { Sense::hover() };
        let response = ui.interact(rect, id, sense).on_hover_cursor(CursorIcon::PointingHand);
        let label = format!("Pose {}", self.entry.title);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, self.enabled, &label));
        let state = match &self.portrait {
            Some(Portrait::Broken(why)) => format!("broken file: {why}"),
            _ => self.entry.tags.join(", "),
        };
        let value = blend.filter(|blend| blend.path == self.entry.path).map(|blend| told(blend.percent(ui)));
        ui.ctx().accesskit_node_builder(id, |node| {
            node.set_description(state);
            if let Some(value) = value {
                node.set_value(value);
            }
        });
        if response.dragged() { response } else { response.on_hover_ui(|ui| self.tip(ui)) }
    }

    fn tip(&self, ui: &mut Ui) {
        ui.strong(&self.entry.title);
        ui.label(self.entry.tags.join(", "));
        match &self.portrait {
            Some(Portrait::Broken(why)) => {
                ui.colored_label(ui.visuals().error_fg_color, format!("Broken file: {why}"));
            }
            _ if self.enabled => {
                ui.label("Click to apply; drag sideways to blend, Esc takes it back; Alt: mirrored");
            }
            _ => {
                ui.label("Nothing to apply it to: choose a part above");
            }
        }
    }

    /// Clicks and drags.
    fn handled(&self, ui: &Ui, response: &Response, blend: &mut Option<Blend>) -> Option<Deed> {
        let mine = blend.as_ref().is_some_and(|blend| blend.path == self.entry.path);
        if response.drag_started() {
            let from = ui.input(|i| i.pointer.press_origin()).unwrap_or_default();
            let now = response.interact_pointer_pos().unwrap_or(from);
            let goal = f64::from(now.x - from.x) / POINTS_A_PERCENT;
            *blend = Some(Blend { path: self.entry.path.clone(), goal });
            response.request_focus();
        } else if mine && !response.dragged() {
            *blend = None;
            return None;
        } else if let Some(blend) = blend.as_mut().filter(|_| mine) {
            let fine = if ui.input(|i| i.modifiers.shift) { 0.1 } else { 1.0 };
            blend.goal += f64::from(response.drag_delta().x) / POINTS_A_PERCENT * fine;
        }
        if let Some(blend) = blend.as_ref().filter(|blend| blend.path == self.entry.path) {
            return Some(Deed::Blend(blend.percent(ui)));
        }
        response.clicked().then_some(Deed::Apply)
    }

    /// Keys of the tile that has the focus, and its menu.
    fn keys(&self, ui: &Ui, response: &Response, making: &mut Making) {
        if self.entry.file.is_none() {
            return;
        }
        let pressed =
            |key| response.has_focus() && ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, key));
        let (mut rename, mut remove) = (pressed(Key::F2), pressed(Key::Delete));
        response.context_menu(|ui| {
            rename |= ui.button("Rename… (F2)").clicked();
            remove |= ui.button("Delete… (Del)").clicked();
        });
        if rename {
            making.begin_rename(&self.entry.path, &self.entry.title);
        } else if remove {
            making.begin_remove(&self.entry.path);
        }
    }

    /// The name below, or the field in which it is changed.
    fn name(&self, ui: &mut Ui, rect: Rect, tile: &Response, making: &mut Making) -> Option<Deed> {
        let own = self.entry.file.is_some();
        if making.is_renaming(&self.entry.path) {
            let mut name = None;
            ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
                name = making.field(ui, "New name");
                if making.fault.is_some() {
                    egui::Tooltip::always_open(
                        ui.ctx().clone(),
                        ui.layer_id(),
                        Id::unique("name fault"),
                        rect,
                    )
                    .show(|ui| making.tell_fault(ui));
                }
            });
            return name.map(Deed::Rename);
        }
        let sense = if own { Sense::click() } else { Sense::hover() };
        let response = ui.interact(rect, Id::unique(("library name of", &self.entry.path)), sense);
        if own {
            let label = format!("Name {}", self.entry.title);
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
            if response.double_clicked() || response.triple_clicked() {
                making.begin_rename(&self.entry.path, &self.entry.title);
            }
        }
        let lit = tile.hovered() || tile.has_focus();
        let color = if lit { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
        let layout = one_line(ui, &self.entry.title, 12.0, color, rect.width());
        let at = pos2(rect.center().x - layout.size().x * 0.5, rect.center().y - layout.size().y * 0.5);
        ui.painter().galley(at, layout, color);
        None
    }

    fn paint(&self, ui: &Ui, response: &Response, blend: Option<&Blend>) {
        let rect = response.rect;
        backdrop(ui, rect);
        match &self.portrait {
            Some(Portrait::Drawn(texture)) => {
                let uv = if self.flip {
                    [pos2(1.0, 0.0), pos2(0.0, 1.0)]
                } else {
                    [pos2(0.0, 0.0), pos2(1.0, 1.0)]
                };
                let [width, height] = super::portrait::SIZE.map(|edge| edge as f32);
                let scale = (rect.width() / width).min(rect.height() / height);
                let place = Rect::from_center_size(rect.center(), vec2(width, height) * scale);
                let tint = if self.enabled { Color32::WHITE } else { Color32::from_white_alpha(110) };
                ui.painter().image(texture.id(), place, Rect { min: uv[0], max: uv[1] }, tint);
            }
            Some(Portrait::Broken(why)) => words(ui, rect, "Broken file", why, ui.visuals().error_fg_color),
            None if self.drawable => words(ui, rect, "…", "", ui.visuals().weak_text_color()),
            None => words(ui, rect, "No portrait", "", ui.visuals().weak_text_color()),
        }
        frame(ui, response);
        if let Some(blend) = blend.filter(|blend| blend.path == self.entry.path) {
            meter(ui, rect, blend.percent(ui));
        }
    }
}

impl Blend {
    /// The amount: whole per cent, tenths with Shift, tens with Ctrl.
    fn percent(&self, ui: &Ui) -> f64 {
        let modifiers = ui.input(|i| i.modifiers);
        let grain = if modifiers.command {
            10.0
        } else if modifiers.shift {
            0.1
        } else {
            1.0
        };
        ((self.goal / grain).round() * grain).clamp(LEAST, MOST)
    }
}

/// A soft light behind the figure, that of the theme.
fn backdrop(ui: &Ui, rect: Rect) {
    let dark = ui.visuals().dark_mode;
    let (top, bottom) = if dark {
        (Color32::from_rgb(86, 90, 97), Color32::from_rgb(48, 50, 55))
    } else {
        (Color32::from_rgb(246, 247, 249), Color32::from_rgb(206, 210, 216))
    };
    let mut mesh = Mesh::default();
    for (corner, color) in [
        (rect.left_top(), top),
        (rect.right_top(), top),
        (rect.right_bottom(), bottom),
        (rect.left_bottom(), bottom),
    ] {
        mesh.vertices.push(Vertex { pos: corner, uv: egui::epaint::WHITE_UV, color });
    }
    mesh.indices = vec![0, 1, 2, 0, 2, 3];
    ui.painter().add(mesh);
}

/// Round corners, and an edge that tells what is under the hand.
fn frame(ui: &Ui, response: &Response) {
    let rect = response.rect;
    // The corners of the portrait are covered with what is around it.
    let around = Stroke::new(4.0, ui.visuals().panel_fill);
    ui.painter().rect_stroke(rect, 7, around, StrokeKind::Outside);
    let held = response.has_focus() || response.dragged();
    let edge = if held {
        Stroke::new(2.0, ui.visuals().hyperlink_color)
    } else if response.hovered() {
        ui.visuals().widgets.hovered.bg_stroke
    } else {
        ui.visuals().widgets.noninteractive.bg_stroke
    };
    ui.painter().rect_stroke(rect, 5, edge, StrokeKind::Inside);
}

/// What stands in a tile that has no portrait.
fn words(ui: &Ui, rect: Rect, sign: &str, why: &str, color: Color32) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(
        rect.center_top() + vec2(0.0, 30.0),
        Align2::CENTER_CENTER,
        sign,
        FontId::proportional(13.0),
        color,
    );
    let layout = painter.layout(
        why.to_owned(),
        FontId::proportional(10.5),
        ui.visuals().text_color(),
        rect.width() - 12.0,
    );
    painter.galley(rect.left_top() + vec2(6.0, 50.0), layout, color);
}

/// An amount in words, to a tenth: `120 %`.
fn told(percent: f64) -> String {
    format!("{} %", (percent * 10.0).round() / 10.0)
}

/// The amount of a blend, as a number and as a bar with marks at 0 and 100.
fn meter(ui: &Ui, rect: Rect, percent: f64) {
    let painter = ui.painter();
    let strip = Rect::from_min_max(pos2(rect.left() + 2.0, rect.bottom() - 30.0), rect.max - vec2(2.0, 2.0));
    painter.rect_filled(strip, 4.0, Color32::from_black_alpha(170));
    let up = strip.center_top() + vec2(0.0, 9.0);
    painter.text(up, Align2::CENTER_CENTER, told(percent), FontId::proportional(13.0), Color32::WHITE);
    let rail = Rect::from_min_max(pos2(strip.left() + 6.0, strip.bottom() - 9.0), strip.max - vec2(6.0, 5.0));
    let x = |percent: f64| rail.left() + rail.width() * ((percent - LEAST) / (MOST - LEAST)) as f32;
    painter.rect_filled(rail, 2.0, Color32::from_white_alpha(50));
    let (from, to) = (x(0.0).min(x(percent)), x(0.0).max(x(percent)));
    let done = Rect::from_x_y_ranges(from..=to, rail.y_range());
    painter.rect_filled(done, 2.0, ui.visuals().hyperlink_color);
    for mark in [0.0, 100.0] {
        let line = Stroke::new(1.0, Color32::WHITE);
        painter.vline(x(mark), rail.top() - 2.0..=rail.bottom() + 2.0, line);
    }
}

/// Whether a pose is really to be removed, over its portrait.
fn question(ui: &mut Ui, rect: Rect, entry: &Entry, making: &mut Making) -> Option<Deed> {
    ui.painter().rect_filled(rect, 5.0, Color32::from_black_alpha(200));
    let mut deed = None;
    let mut keep = ui.input(|i| i.key_pressed(Key::Escape));
    ui.scope_builder(UiBuilder::new().max_rect(rect.shrink(8.0)), |ui| {
        ui.vertical_centered(|ui| {
            let button = |text: &str| egui::Button::new(text.to_owned()).min_size(vec2(80.0, 24.0));
            ui.add_space(12.0);
            ui.colored_label(Color32::WHITE, "Move to the trash?");
            ui.add_space(6.0);
            let delete = ui.add(button("Delete")).accessible_name(format!("Delete {}", entry.title));
            if making.take_fresh() {
                delete.request_focus();
            }
            if delete.clicked() {
                deed = Some(Deed::Remove);
            }
            keep |= ui.add(button("Keep")).accessible_name(format!("Keep {}", entry.title)).clicked();
        });
    });
    if keep && deed.is_none() {
        making.end();
    }
    deed
}

/// One line of text, cut off with an ellipsis.
fn one_line(ui: &Ui, text: &str, size: f32, color: Color32, width: f32) -> std::sync::Arc<egui::Galley> {
    let mut job =
        egui::text::LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width);
    ui.painter().layout_job(job)
}
