//! A row for every value of a chain's joints: name, slider, number.

use edit::{By, ChainNode};
use egui::{Align2, FontId, Rect, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};
use kin::Interval;
use rig::{RobotDof, RobotJointKind};

use super::ask;
use super::panel::Sheet;
use super::value::{self, Unit};
use crate::number::Number;
use crate::rail::Rail;
use crate::theme;

const HEIGHT: f32 = 22.0;
const GAP: f32 = 2.0;
/// The names begin below the heading's words.
const INDENT: f32 = 10.0;
const NAME: f32 = 144.0;
const NUMBER: f32 = 74.0;
/// Slides without ends show so much to either side of 0, metres.
const FREE_M: f64 = 2.0;

/// A row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Row {
    /// The root, where it can be chosen.
    Root,
    /// The value of a pose at that place.
    Value(usize),
}

/// Shows the rows whose names have the letters of a filter. Only those in view are laid out: a chain may have a thousand.
pub fn show(sheet: &mut Sheet, ui: &mut Ui, filter: &str, reveal: &mut bool) {
    let robot = sheet.editor.robot().clone();
    let dofs: Vec<RobotDof> = robot.dofs().collect();
    let wanted = filter.trim().to_lowercase();
    let has = |dof: &RobotDof| value::name(&robot, dof).to_lowercase().contains(&wanted);
    let root = ChainNode::first(sheet.editor.document()) == ChainNode::Root && "root".contains(&wanted);
    let values = dofs.iter().enumerate().filter(|(_, dof)| has(dof)).map(|(slot, _)| Row::Value(slot));
    let rows: Vec<Row> = root.then_some(Row::Root).into_iter().chain(values).collect();
    if rows.is_empty() {
        ui.weak(if dofs.is_empty() { "No joint of it moves." } else { "No joint has these letters." });
        return;
    }
    ui.spacing_mut().item_spacing.y = GAP;
    let mut scroll = ScrollArea::vertical().auto_shrink(false);
    if std::mem::take(reveal) {
        let chosen = rows.iter().position(|row| row.node() == sheet.node);
        let top = |at: usize| at as f32 * (HEIGHT + GAP);
        let id = egui::Id::unique("seen joints");
        let seen = ui.data(|data| data.get_temp::<[f32; 2]>(id)).unwrap_or([0.0, f32::INFINITY]);
        if let Some(at) = chosen.filter(|at| top(*at) < seen[0] || top(*at) + HEIGHT > seen[1]) {
            scroll = scroll.vertical_scroll_offset((top(at) - 0.4 * (seen[1] - seen[0])).max(0.0));
        }
    }
    let shown = scroll.id_salt("joints").show_rows(ui, HEIGHT, rows.len(), |ui, range| {
        for row in &rows[range] {
            match row {
                Row::Root => root_row(sheet, ui),
                Row::Value(slot) => value_row(sheet, ui, *slot, &dofs[*slot]),
            }
        }
    });
    let top = shown.state.clamped_offset().y;
    let id = egui::Id::unique("seen joints");
    ui.data_mut(|data| data.insert_temp(id, [top, top + shown.inner_rect.height()]));
}

impl Row {
    fn node(self) -> ChainNode {
        match self {
            Row::Root => ChainNode::Root,
            Row::Value(slot) => ChainNode::Value(slot),
        }
    }
}

fn root_row(sheet: &mut Sheet, ui: &mut Ui) {
    let (_, whole) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    name_cell(sheet, ui, whole, ChainNode::Root, ["root", ""], "root");
    let rest = Rect::from_min_max(pos2(whole.left() + NAME + 8.0, whole.top()), whole.max);
    let at = sheet.editor.document().world_from_root.position;
    let words = format!("at {:.2}, {:.2}, {:.2} m", at.x, at.y, at.z);
    let font = FontId::proportional(12.0);
    ui.painter().text(
        rest.right_center() - vec2(4.0, 0.0),
        Align2::RIGHT_CENTER,
        words,
        font,
        theme::of(ui).faint_text,
    );
}

fn value_row(sheet: &mut Sheet, ui: &mut Ui, slot: usize, dof: &RobotDof) {
    let robot = sheet.editor.robot().clone();
    let joint = &robot.joints()[dof.joint];
    let (_, whole) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    let first = robot.slot(dof.joint).start == slot;
    let part = if joint.kind.parts().len() > 1 { value::word(dof.part) } else { "" };
    let label = value::name(&robot, dof);
    let title = if first { joint.name.as_str() } else { "" };
    name_cell(sheet, ui, whole, ChainNode::Value(slot), [title, part], &label);
    let number = Rect::from_min_max(pos2(whole.right() - NUMBER, whole.top()), whole.max);
    let from = pos2(whole.left() + NAME + 8.0, whole.top());
    let rail = Rect::from_min_max(from, pos2((number.left() - 10.0).max(from.x), whole.bottom()));
    let unit = Unit::of(dof);
    let shown = unit.shown(sheet.editor.document().pose.0.get(slot).copied().unwrap_or(0.0));
    if let Some(master) = robot.master(dof.joint) {
        follower(ui, rail, number, &label, &robot.joints()[master].name, unit.written(shown));
        return;
    }
    let set = |to: f64| ask::value(&robot, slot, unit.asked(to), By::To);
    let ranges = sheet.editor.document().ranges;
    let range = Interval { min: unit.shown(dof.range.min), max: unit.shown(dof.range.max) };
    let control = Rail {
        name: &label,
        value: shown,
        span: span(range, unit, shown),
        live: ranges.then_some(range),
        wraps: false,
        rest: if ranges { range.clamp(0.0) } else { 0.0 },
    };
    let (response, change) = control.show_in_steps(ui, rail, unit.step());
    let kind = joint.kind.name();
    let words = match joint.kind {
        RobotJointKind::Revolute | RobotJointKind::Prismatic => {
            format!("{kind}, {} to {}", unit.written(range.min), unit.written(range.max))
        }
        _ => format!("{kind}, no range"),
    };
    response.on_hover_text(format!("{label}\n{words}"));
    sheet.ask(change, set);
    let field = Number {
        name: &label,
        value: shown,
        speed: 0.5 * unit.step(),
        decimals: unit.decimals(),
        prefix: "",
        suffix: unit.suffix(),
    };
    let (_, change) = field.show(ui, number);
    sheet.ask(change, set);
}

/// The name with what is chosen marked; a click chooses.
fn name_cell(
    sheet: &mut Sheet,
    ui: &mut Ui,
    whole: Rect,
    node: ChainNode,
    [title, part]: [&str; 2],
    label: &str,
) {
    let palette = theme::of(ui);
    let robot = sheet.editor.robot();
    let (chosen, lit) = (sheet.node == node, sheet.lit == Some(node.link(robot)));
    if chosen || lit {
        ui.painter().rect_filled(whole, 2.0, palette.header);
    }
    if chosen {
        let mark = Rect::from_min_size(whole.min, vec2(3.0, whole.height()));
        ui.painter().rect_filled(mark, 1.0, palette.accent);
    }
    let left = whole.left() + INDENT;
    let cell = Rect::from_min_max(pos2(left, whole.top()), pos2(whole.left() + NAME, whole.bottom()));
    let response = ui.interact(cell, egui::Id::unique(("choose", label)), Sense::click());
    let name = format!("Choose {label}");
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), chosen, &name));
    let color = match (chosen, response.hovered()) {
        (true, _) => palette.accent,
        (_, true) => palette.strong_text,
        _ => palette.text,
    };
    let font = FontId::proportional(12.5);
    let small = ui.painter().layout_no_wrap(part.to_owned(), FontId::proportional(12.0), palette.faint_text);
    let room = cell.width() - if part.is_empty() { 0.0 } else { small.size().x + 8.0 };
    let text = fitted(ui, title, &font, color, room);
    ui.painter().galley(pos2(cell.left(), cell.center().y - 0.5 * text.size().y), text, color);
    let at = pos2(cell.right() - small.size().x, cell.center().y - 0.5 * small.size().y);
    ui.painter().galley(at, small, if chosen { palette.accent } else { palette.faint_text });
    if response.contains_pointer() {
        sheet.asked.hinted = node.joint(robot);
    }
    let child = node.joint(robot).map(|joint| format!("\ncarries {}", robot.joints()[joint].child));
    if response.on_hover_text(format!("{label}{}", child.unwrap_or_default())).clicked() {
        sheet.asked.chosen = Some(node);
    }
}

/// A line of text cut off with dots where it doesn't fit.
fn fitted(
    ui: &Ui,
    words: &str,
    font: &FontId,
    color: egui::Color32,
    room: f32,
) -> std::sync::Arc<egui::Galley> {
    let mut job = egui::text::LayoutJob::simple_singleline(words.to_owned(), font.clone(), color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(8.0));
    ui.painter().layout_job(job)
}

/// A joint that follows another: nothing of it can be moved by hand.
fn follower(ui: &mut Ui, rail: Rect, number: Rect, label: &str, master: &str, shown: String) {
    let palette = theme::of(ui);
    let response = ui.interact(rail, egui::Id::unique(("rail", label)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, false, label));
    let font = FontId::proportional(12.0);
    let words = fitted(ui, &format!("follows {master}"), &font, palette.faint_text, rail.width());
    ui.painter().galley(pos2(rail.left(), rail.center().y - 0.5 * words.size().y), words, palette.faint_text);
    ui.painter().text(
        number.center(),
        Align2::CENTER_CENTER,
        shown,
        FontId::proportional(13.0),
        palette.faint_text,
    );
    response.on_hover_text(format!("{label}\nfollows {master}: move that"));
}

/// The ends of a slider: the range, widened to hold the value; a full circle where there is none.
fn span(range: Interval, unit: Unit, value: f64) -> Interval {
    let free = if unit == Unit::Degrees { 180.0 } else { unit.shown(FREE_M) };
    let end = |end: f64, free: f64| if end.is_finite() { end } else { free };
    let span = Interval { min: end(range.min, -free), max: end(range.max, free) };
    if value.is_finite() { span.reaching(value) } else { span }
}
