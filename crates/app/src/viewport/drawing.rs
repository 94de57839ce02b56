//! What is drawn over the figure, as it is gathered: strokes and words whose sizes are in points of the window.

use edit::Sight;
use egui::{Align2, Color32, FontId, Painter, Rect, vec2};
use glam::{DVec3, Vec2, Vec3};
use render::{Color, Layer, Line, Marker, Overlay, Shape};

/// Marks and words over one picture.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// What the picture is seen through; its size is in points.
    pub sight: Sight,
    /// Pixels of the picture in a point of the window.
    pub scale: f32,
    /// What the renderer draws.
    pub overlay: Overlay,
    /// What egui writes above it.
    pub words: Vec<Words>,
}

/// Some words beside a place of the world.
#[derive(Clone, PartialEq, Debug)]
pub struct Words {
    /// Metres, world.
    pub at_in_world: DVec3,
    /// From there to the words' middle, points: right and down.
    pub shift: Vec2,
    /// One line.
    pub text: String,
    /// The colour of the letters.
    pub color: Color32,
}

/// How a stroke looks; its width is in points.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pen {
    /// The colour.
    pub color: Color,
    /// Points.
    pub width: f32,
    /// A dash with its gap, points; 0 is solid.
    pub dash: f32,
    /// What hides it.
    pub layer: Layer,
}

impl Pen {
    /// A solid pen that is always seen.
    pub const fn new(color: Color, width: f32) -> Pen {
        Pen { color, width, dash: 0.0, layer: Layer::OnTop }
    }

    /// The same pen, dashed.
    pub const fn dashed(self, dash: f32) -> Pen {
        Pen { dash, ..self }
    }

    /// The same pen, faint behind the figure.
    pub const fn ghosted(self) -> Pen {
        Pen { layer: Layer::Ghosted, ..self }
    }

    /// A dark pen under this one, wider by a point on either side: what sets a stroke off from any skin.
    pub const fn under(self) -> Pen {
        Pen { color: [12, 12, 14, 170], width: self.width + 2.0, ..self }
    }
}

/// A colour of the window as a mark's.
pub fn rgba(color: Color32, alpha: u8) -> Color {
    let [r, g, b, _] = color.to_array();
    [r, g, b, alpha]
}

impl Drawing {
    /// Nothing yet.
    pub fn new(sight: Sight, scale: f32) -> Drawing {
        Drawing { sight, scale, overlay: Overlay::default(), words: Vec::new() }
    }

    /// A stroke without ends, to pass to the overlay's arcs and rings.
    pub fn style(&self, pen: Pen) -> Line {
        Line {
            from: Vec3::ZERO,
            to: Vec3::ZERO,
            color: pen.color,
            width_px: pen.width * self.scale,
            dash_px: pen.dash * self.scale,
            layer: pen.layer,
        }
    }

    /// A straight stroke.
    pub fn line(&mut self, from: DVec3, to: DVec3, pen: Pen) {
        self.overlay.lines.push(Line { from: from.as_vec3(), to: to.as_vec3(), ..self.style(pen) });
    }

    /// A circle about a unit axis, metres.
    pub fn ring(&mut self, center: DVec3, axis: DVec3, radius_m: f64, pen: Pen) {
        self.overlay.ring(center.as_vec3(), axis.as_vec3(), radius_m as f32, self.style(pen));
    }

    /// An arc of a circle, from one angle to another, radians.
    pub fn arc(&mut self, circle: &edit::Circle, from_rad: f64, to_rad: f64, pen: Pen) {
        let start = (circle.direction(from_rad) * circle.radius_m).as_vec3();
        let turn = (to_rad - from_rad) as f32;
        self.overlay.arc(circle.center.as_vec3(), circle.axis.as_vec3(), start, turn, self.style(pen));
    }

    /// A round point, points wide from middle to outline.
    pub fn disc(&mut self, at: DVec3, radius: f32, color: Color, layer: Layer) {
        self.overlay.markers.push(Marker {
            at: at.as_vec3(),
            radius_px: radius * self.scale,
            color,
            outline: [16, 16, 18, (u16::from(color[3]) * 3 / 4) as u8],
            outline_px: self.scale,
            layer,
            shape: Shape::Disc,
        });
    }

    /// Strokes that face the viewer: each from one place to another, points right and up of a place of the world.
    pub fn glyph(&mut self, at: DVec3, strokes: &[[Vec2; 2]], pen: Pen) {
        let axes = self.sight.camera.axes();
        let metres = self.sight.metres_per_px(at);
        let (right, up) = (axes.x_axis.as_dvec3() * metres, axes.y_axis.as_dvec3() * metres);
        let place = |v: Vec2| at + right * f64::from(v.x) + up * f64::from(v.y);
        for pen in [pen.under(), pen] {
            for [from, to] in strokes {
                self.line(place(*from), place(*to), pen);
            }
        }
    }

    /// Words beside a place: `right` and `down` points of it.
    pub fn write(&mut self, at: DVec3, [right, down]: [f32; 2], text: impl Into<String>, color: Color32) {
        let shift = Vec2::new(right, down);
        self.words.push(Words { at_in_world: at, shift, text: text.into(), color });
    }
}

/// Letters are thin: they are this much nearer to white than the strokes of their colour.
const LIGHTER: f32 = 0.4;

/// Writes the words into the picture's rectangle, each on a dark ground, none over another: the later one moves down.
pub fn write_words(painter: &Painter, rect: Rect, sight: &Sight, words: &[Words]) {
    let painter = painter.with_clip_rect(rect);
    let mut taken: Vec<Rect> = Vec::new();
    for words in words {
        let Some(pixel) = sight.pixel_of(words.at_in_world) else { continue };
        let middle = rect.min + vec2(pixel.x + words.shift.x, pixel.y + words.shift.y);
        if !rect.expand(40.0).contains(middle) {
            continue;
        }
        let color = words.color.lerp_to_gamma(Color32::WHITE, LIGHTER);
        let text = painter.layout_no_wrap(words.text.clone(), FontId::proportional(12.0), color);
        let mut place = Align2::CENTER_CENTER.anchor_size(middle, text.size()).expand2(vec2(4.0, 1.0));
        // A place that two limbs share is rare, more than a few words there do not occur.
        for _ in 0..taken.len() {
            let Some(other) = taken.iter().find(|other| other.intersects(place)) else { break };
            place = place.translate(vec2(0.0, other.bottom() - place.top() + 1.0));
        }
        taken.push(place);
        painter.rect_filled(place, 3.0, Color32::from_black_alpha(165));
        painter.galley(place.min + vec2(4.0, 1.0), text, color);
    }
}

/// Points of a circle that faces the viewer, as strokes for [`Drawing::glyph`].
pub fn circle_strokes(radius: f32, steps: u32) -> Vec<[Vec2; 2]> {
    let at = |i: u32| Vec2::from_angle(std::f32::consts::TAU * i as f32 / steps as f32) * radius;
    (0..steps).map(|i| [at(i), at(i + 1)]).collect()
}
