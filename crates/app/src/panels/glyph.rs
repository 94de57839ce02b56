//! Small drawn signs, told apart by their form: how a limb holds on, and whether a joint is locked.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2};
use rig::Contact;

/// A limb's contact as the picture marks it: a small disc if free, crosshairs on a point, a square on feet if planted.
pub fn contact(painter: &Painter, at: Pos2, size: f32, contact: &Contact, color: Color32) {
    let half = size * 0.5;
    let stroke = Stroke::new((size * 0.13).max(1.0), color);
    let tick = |way: Vec2, from: f32| painter.line_segment([at + way * half * from, at + way * half], stroke);
    match contact {
        Contact::Free => {
            painter.circle_filled(at, half * 0.45, color.gamma_multiply(0.75));
        }
        Contact::Point { .. } => {
            painter.circle_stroke(at, half * 0.62, stroke);
            painter.circle_filled(at, half * 0.22, color);
            for way in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
                tick(way, 0.62);
            }
        }
        Contact::Planted { .. } => {
            painter.rect_filled(Rect::from_center_size(at, vec2(half, half) * 1.4), 0.5, color);
            for way in [vec2(1.0, 1.0), vec2(-1.0, 1.0), vec2(1.0, -1.0), vec2(-1.0, -1.0)] {
                tick(way * 0.95, 0.6);
            }
        }
    }
}

/// A word for a contact.
pub const fn contact_word(contact: &Contact) -> &'static str {
    match contact {
        Contact::Free => "free",
        Contact::Point { .. } => "held at a point",
        Contact::Planted { .. } => "planted",
    }
}

/// A padlock as high as `size`; its bow is beside the body while it is open.
pub fn lock(painter: &Painter, at: Pos2, size: f32, closed: bool, color: Color32) {
    let body = Rect::from_center_size(at + vec2(0.0, size * 0.2), vec2(size * 0.82, size * 0.58));
    let (shift, radius) = (if closed { 0.0 } else { size * 0.42 }, size * 0.25);
    let top = pos2(at.x + shift, body.top() - size * 0.1);
    let mut bow = vec![pos2(top.x - radius, body.top())];
    bow.extend((0..=8).map(|step| {
        let (sin, cos) = (std::f32::consts::PI * step as f32 / 8.0).sin_cos();
        pos2(top.x - radius * cos, top.y - radius * sin)
    }));
    bow.push(pos2(top.x + radius, if closed { body.top() } else { top.y + size * 0.06 }));
    let stroke = Stroke::new((size * 0.13).max(1.0), color);
    painter.add(Shape::line(bow, stroke));
    if closed {
        painter.rect_filled(body, 1.0, color);
    } else {
        painter.rect_stroke(body, 1.0, Stroke::new(1.0, color), StrokeKind::Inside);
    }
}
