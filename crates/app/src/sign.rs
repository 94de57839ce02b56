//! Small painted signs that go with words: a fault, a check mark.

use egui::{Color32, Pos2, Response, Sense, Shape, Stroke, Ui, pos2, vec2};

/// A triangle with an exclamation mark, as high as a line of text; the words beside it say what it is about.
pub fn fault(ui: &mut Ui, color: Color32) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(14.0, 13.0), Sense::hover());
    let corners = vec![rect.center_top(), rect.right_bottom(), rect.left_bottom()];
    let painter = ui.painter();
    painter.add(Shape::closed_line(corners, Stroke::new(1.4, color)));
    let x = rect.center().x;
    painter.vline(x, (rect.top() + 4.5)..=(rect.bottom() - 4.5), Stroke::new(1.4, color));
    painter.circle_filled(pos2(x, rect.bottom() - 2.6), 0.9, color);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Fault"));
    response
}

/// A check mark around a place.
pub fn check(ui: &Ui, at: Pos2, color: Color32) {
    let points = [at + vec2(-4.0, 0.0), at + vec2(-1.2, 3.2), at + vec2(4.5, -4.0)];
    ui.painter().add(Shape::line(points.to_vec(), Stroke::new(1.8, color)));
}
