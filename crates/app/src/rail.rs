//! The slider of the panels: a rail that shows a range, the part of it that is open now, zero, and the value.
//!
//! Dragging is relative: the handle moves as far as the pointer, wherever on the rail one begins, so that touching it
//! never makes the figure jump. With Shift it moves a tenth as far.

use egui::{Color32, CornerRadius, CursorIcon, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use kin::Interval;

use crate::theme;

/// What a control asks for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Change {
    /// A value on the way, while the pointer is down.
    Preview(f64),
    /// A value to have, as one step.
    Set(f64),
}

/// A rail.
#[derive(Clone, Copy, Debug)]
pub struct Rail<'a> {
    /// Its accessible name.
    pub name: &'a str,
    /// The value that it shows.
    pub value: f64,
    /// The values at its two ends.
    pub span: Interval,
    /// The values that can be had now; may exceed the span.
    pub live: Option<Interval>,
    /// Whether the span is a full circle, in which values wrap around.
    pub wraps: bool,
    /// What a double click sets.
    pub rest: f64,
}

impl Rail<'_> {
    /// Shows the rail in a rectangle.
    pub fn show(&self, ui: &mut Ui, rect: Rect) -> (Response, Option<Change>) {
        self.show_in_steps(ui, rect, 1.0)
    }

    /// The same with a step that an arrow key takes; drags go by tenths of it.
    pub fn show_in_steps(&self, ui: &mut Ui, rect: Rect, step: f64) -> (Response, Option<Change>) {
        let response = ui
            .interact(rect, egui::Id::unique(("rail", self.name)), Sense::click_and_drag())
            .on_hover_cursor(CursorIcon::ResizeHorizontal);
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), self.value, self.name));
        self.declare(ui, &response, step);
        let change = self.change(ui, &response, step);
        if ui.is_rect_visible(rect) {
            self.paint(ui, &response);
        }
        (response, change)
    }

    fn declare(&self, ui: &Ui, response: &Response, step: f64) {
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_min_numeric_value(self.span.min);
            node.set_max_numeric_value(self.span.max);
            node.set_numeric_value_step(step);
            node.add_action(egui::accesskit::Action::SetValue);
            node.add_action(egui::accesskit::Action::Increment);
            node.add_action(egui::accesskit::Action::Decrement);
        });
    }

    fn change(&self, ui: &mut Ui, response: &Response, step: f64) -> Option<Change> {
        if response.clicked() || response.drag_started() {
            // The arrow keys go on where the hand left off.
            response.request_focus();
        }
        if response.double_clicked() {
            return Some(Change::Set(self.rest));
        }
        if let Some(value) = asked_for(ui, response) {
            return Some(Change::Set(value));
        }
        let steps = steps(ui, response);
        if steps != 0.0 {
            return Some(Change::Set(whole(self.value + steps * step, 0.1 * step)));
        }
        // The goal, not the value: what a range holds back is still owed when the pointer comes back.
        let goal_id = response.id.with("goal");
        if !response.dragged() {
            ui.data_mut(|data| data.remove::<f64>(goal_id));
            return None;
        }
        // Whole tenths: what a hand sets reads well in a file.
        let (fine, grain) = if ui.input(|i| i.modifiers.shift) { (0.1, 0.01) } else { (1.0, 0.1) };
        let per_point = (self.span.max - self.span.min) / f64::from(response.rect.width().max(1.0));
        let former = ui.data(|data| data.get_temp::<f64>(goal_id));
        let goal = former.unwrap_or(self.value) + f64::from(response.drag_delta().x) * per_point * fine;
        ui.data_mut(|data| data.insert_temp(goal_id, goal));
        (former != Some(goal)).then(|| Change::Preview(whole(goal, grain * step)))
    }

    fn x_of(&self, rect: Rect, value: f64) -> f32 {
        let t = (value - self.span.min) / (self.span.max - self.span.min).max(1e-9);
        rect.left() + rect.width() * t.clamp(0.0, 1.0) as f32
    }

    fn paint(&self, ui: &Ui, response: &Response) {
        let rect = response.rect;
        let (painter, palette) = (ui.painter(), theme::of(ui));
        let bar = |from: f32, to: f32, height: f32, color: Color32| {
            let y = rect.center().y;
            let bar = Rect::from_min_max(pos2(from, y - height * 0.5), pos2(to, y + height * 0.5));
            painter.rect_filled(bar, CornerRadius::same(2), color);
        };
        bar(rect.left(), rect.right(), 4.0, palette.rail);
        for (from, to) in self.live_parts() {
            bar(self.x_of(rect, from), self.x_of(rect, to), 4.0, palette.live);
        }
        let at = self.x_of(rect, self.value);
        let zero = self.x_of(rect, self.rest);
        let inside = self.live.is_none_or(|live| live.excess(self.wrapped(live, self.value)) < 0.05);
        let color = if inside { palette.accent } else { palette.warning };
        bar(at.min(zero), at.max(zero), 4.0, color.gamma_multiply(0.75));
        if self.span.contains(self.rest) {
            let y = rect.center().y;
            painter.vline(zero, (y - 5.0)..=(y + 5.0), Stroke::new(1.0, palette.faint_text));
        }
        let held = response.dragged() || response.has_focus();
        let handle = match (held, response.hovered()) {
            (true, _) | (false, true) => palette.strong_text,
            (false, false) => palette.text,
        };
        let grip = Rect::from_center_size(pos2(at, rect.center().y), vec2(7.0, 14.0));
        painter.rect_filled(grip, CornerRadius::same(2), handle);
        if held {
            let ring = Stroke::new(1.5, palette.accent);
            painter.rect_stroke(grip.expand(1.5), CornerRadius::same(3), ring, egui::StrokeKind::Outside);
        }
    }

    /// The live interval as it lies on the rail; on a circle one that passes an end goes on at the other.
    fn live_parts(&self) -> Vec<(f64, f64)> {
        let Some(live) = self.live else { return Vec::new() };
        let (min, max) = (live.min.max(-1e4), live.max.min(1e4));
        if !self.wraps {
            return vec![(min, max)];
        }
        [-360.0, 0.0, 360.0]
            .into_iter()
            .map(|turn| ((min + turn).max(self.span.min), (max + turn).min(self.span.max)))
            .filter(|(from, to)| from < to)
            .collect()
    }

    /// The turn of a value that lies nearest to the interval, on a circle.
    fn wrapped(&self, live: Interval, value: f64) -> f64 {
        if !self.wraps {
            return value;
        }
        let turns = [value - 360.0, value, value + 360.0];
        turns.into_iter().fold(value, |best, v| if live.excess(v) < live.excess(best) { v } else { best })
    }
}

/// The nearest whole number of grains, as near as decimals come.
fn whole(value: f64, grain: f64) -> f64 {
    let grains = (1.0 / grain).round();
    (value * grains).round() / grains
}

/// The value that a screen reader or a test asks for.
fn asked_for(ui: &Ui, response: &Response) -> Option<f64> {
    use egui::accesskit::{Action, ActionData};
    ui.input(|input| {
        let requests = input.accesskit_action_requests(response.id, Action::SetValue);
        requests
            .filter_map(|request| match request.data {
                Some(ActionData::NumericValue(value)) => Some(value),
                _ => None,
            })
            .last()
    })
}

/// Degrees that arrow keys and screen readers ask for.
fn steps(ui: &Ui, response: &Response) -> f64 {
    use egui::Key;
    use egui::accesskit::Action;
    let mut steps = ui.input(|input| {
        input.num_accesskit_action_requests(response.id, Action::Increment) as f64
            - input.num_accesskit_action_requests(response.id, Action::Decrement) as f64
    });
    if response.has_focus() {
        let keep = egui::EventFilter { horizontal_arrows: true, ..egui::EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, keep));
        let pressed = |key| ui.input(|input| input.num_presses(key)) as f64;
        let step = if ui.input(|input| input.modifiers.shift) { 0.1 } else { 1.0 };
        steps += (pressed(Key::ArrowRight) - pressed(Key::ArrowLeft)) * step;
    }
    steps
}
