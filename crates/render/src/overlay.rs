//! Marks over the picture: lines and points whose width is in pixels, translucent balls and fans of a size in the world.

use bytemuck::{Pod, Zeroable};
use glam::{Quat, Vec3};

use crate::layered::Layered;

/// sRGB with straight alpha, 0 to 255.
pub type Color = [u8; 4];

/// Whether the figures hide a mark.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Layer {
    /// Hidden by what is before it.
    Tested,
    /// Faint where something is before it.
    Ghosted,
    /// Always seen.
    #[default]
    OnTop,
}

/// A straight line between world points, with round ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    /// Metres, world.
    pub from: Vec3,
    /// Metres, world.
    pub to: Vec3,
    /// Its colour.
    pub color: Color,
    /// Pixels of [`crate::Scene::size`].
    pub width_px: f32,
    /// Length of a dash and its gap together, pixels; 0 is solid.
    pub dash_px: f32,
    /// What hides it.
    pub layer: Layer,
}

/// What a point looks like, so that marks differ by more than colour.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Shape {
    /// A filled circle.
    #[default]
    Disc,
    /// A circle's line.
    Ring,
    /// A filled square on its corner.
    Diamond,
    /// A filled square.
    Square,
    /// Two bars across each other, like an x.
    Cross,
}

/// A point. `..Marker::default()` is a small white disc on top.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Marker {
    /// Metres, world.
    pub at: Vec3,
    /// Pixels of [`crate::Scene::size`], without the outline.
    pub radius_px: f32,
    /// Colour inside.
    pub color: Color,
    /// Colour of the outline.
    pub outline: Color,
    /// Width of the outline, outside the radius; 0 for none.
    pub outline_px: f32,
    /// What hides it.
    pub layer: Layer,
    /// What it looks like.
    pub shape: Shape,
}

impl Default for Marker {
    fn default() -> Marker {
        Marker {
            at: Vec3::ZERO,
            radius_px: 3.0,
            color: [255; 4],
            outline: [0; 4],
            outline_px: 0.0,
            layer: Layer::OnTop,
            shape: Shape::Disc,
        }
    }
}

/// A translucent ball: clear in its middle, denser along its rim, with a net of fine lines that shows its curve from
/// within as well.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ball {
    /// Metres, world.
    pub center: Vec3,
    /// Metres; a ball without radius is left out.
    pub radius_m: f32,
    /// Its colour; alpha is the density of the rim.
    pub color: Color,
    /// What hides it.
    pub layer: Layer,
}

/// A translucent sheet: triangles from a centre to each stretch of a rim. For a polygon, the rim ends where it begins.
#[derive(Clone, PartialEq, Debug)]
pub struct Fan {
    /// Metres, world.
    pub center: Vec3,
    /// Metres, world; fewer than two points make nothing.
    pub rim: Vec<Vec3>,
    /// Colour at the rim.
    pub color: Color,
    /// Colour at the centre.
    pub center_color: Color,
    /// What hides it.
    pub layer: Layer,
}

/// All marks of a picture: balls, fans, lines, then points, each in their order; tested ones below those on top.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Overlay {
    /// The lines.
    pub lines: Vec<Line>,
    /// The points.
    pub markers: Vec<Marker>,
    /// The balls.
    pub balls: Vec<Ball>,
    /// The sheets.
    pub fans: Vec<Fan>,
}

/// How much fainter a sector is at its centre than at its arc.
const SECTOR_CENTER: f32 = 0.3;

impl Overlay {
    /// An overlay with nothing in it.
    pub const EMPTY: Overlay =
        Overlay { lines: Vec::new(), markers: Vec::new(), balls: Vec::new(), fans: Vec::new() };

    /// Adds an arc about an axis: starts at `center + start` and turns by `angle_rad` about the unit `axis`, in
    /// short lines like `style`, whose own ends are ignored.
    pub fn arc(&mut self, center: Vec3, axis: Vec3, start: Vec3, angle_rad: f32, style: Line) {
        let points = arc_points(center, axis, start, angle_rad);
        self.lines.extend(points.windows(2).map(|p| Line { from: p[0], to: p[1], ..style }));
    }

    /// Adds the sheet between a centre and the arc that starts at `center + start` and turns by `angle_rad` about the
    /// unit `axis`: the range of a joint, filled, fainter toward the centre.
    pub fn sector(
        &mut self,
        center: Vec3,
        axis: Vec3,
        start: Vec3,
        angle_rad: f32,
        color: Color,
        layer: Layer,
    ) {
        let [r, g, b, a] = color;
        let center_color = [r, g, b, (f32::from(a) * SECTOR_CENTER) as u8];
        let rim = arc_points(center, axis, start, angle_rad);
        self.fans.push(Fan { center, rim, color, center_color, layer });
    }

    /// Adds a filled convex polygon, its corners in order.
    pub fn polygon(&mut self, corners: &[Vec3], color: Color, layer: Layer) {
        let Some(first) = corners.first() else { return };
        let center = corners.iter().sum::<Vec3>() / corners.len() as f32;
        let rim = corners.iter().chain([first]).copied().collect();
        self.fans.push(Fan { center, rim, color, center_color: color, layer });
    }

    /// Adds a full circle about the unit `axis`.
    pub fn ring(&mut self, center: Vec3, axis: Vec3, radius_m: f32, style: Line) {
        let start = axis.normalize_or(Vec3::Y).any_orthonormal_vector() * radius_m;
        self.arc(center, axis, start, std::f32::consts::TAU, style);
    }
}

/// The points of an arc, ends included; none if a number is not finite.
fn arc_points(center: Vec3, axis: Vec3, start: Vec3, angle_rad: f32) -> Vec<Vec3> {
    if !(axis.is_finite() && start.is_finite() && angle_rad.is_finite()) {
        return Vec::new();
    }
    let axis = axis.normalize_or(Vec3::Y);
    let steps = (angle_rad.abs() / 0.1).ceil().clamp(1.0, 128.0);
    let at = |i: u32| center + Quat::from_axis_angle(axis, angle_rad * i as f32 / steps) * start;
    (0..=steps as u32).map(at).collect()
}

/// Which outline a stroke has; as in overlay.wgsl.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Form {
    /// A line or a round point.
    Capsule = 0,
    /// The line is the long axis.
    Ellipse = 1,
    Ring = 2,
    Diamond = 3,
    Square = 4,
    Cross = 5,
}

impl From<Shape> for Form {
    fn from(shape: Shape) -> Form {
        match shape {
            Shape::Disc => Form::Capsule,
            Shape::Ring => Form::Ring,
            Shape::Diamond => Form::Diamond,
            Shape::Square => Form::Square,
            Shape::Cross => Form::Cross,
        }
    }
}

/// One instance of `Stroke` in overlay.wgsl.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Stroke {
    pub from: [f32; 3],
    pub to: [f32; 3],
    pub color: Color,
    pub outline: Color,
    /// Radius, outline, dash period, number of the [`Form`].
    pub shape: [f32; 4],
}

impl Stroke {
    fn line(line: &Line, scale: f32) -> Stroke {
        let shape = [line.width_px * 0.5 * scale, 0.0, line.dash_px * scale, 0.0];
        Stroke {
            from: line.from.to_array(),
            to: line.to.to_array(),
            color: line.color,
            outline: [0; 4],
            shape,
        }
    }

    fn marker(mark: &Marker, scale: f32) -> Stroke {
        let at = mark.at.to_array();
        let shape =
            [mark.radius_px * scale, mark.outline_px * scale, 0.0, Form::from(mark.shape) as u8 as f32];
        Stroke { from: at, to: at, color: mark.color, outline: mark.outline, shape }
    }

    fn is_finite(&self) -> bool {
        self.from.iter().chain(&self.to).chain(&self.shape).all(|x| x.is_finite())
    }
}

/// The strokes of an overlay. Marks that are not finite are left out. `scale` is drawn pixels over the scene's pixels.
pub(crate) fn strokes(overlay: &Overlay, scale: f32) -> Layered<Stroke> {
    let lines = overlay.lines.iter().map(|l| (l.layer, Stroke::line(l, scale)));
    let markers = overlay.markers.iter().map(|m| (m.layer, Stroke::marker(m, scale)));
    lines.chain(markers).filter(|(_, s)| s.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_closes_and_bad_marks_are_left_out() {
        let style = Line {
            from: Vec3::ZERO,
            to: Vec3::ZERO,
            color: [255; 4],
            width_px: 2.0,
            dash_px: 0.0,
            layer: Layer::Tested,
        };
        let mut overlay = Overlay::default();
        overlay.ring(Vec3::Y, Vec3::X, 0.3, style);
        let (first, last) = (overlay.lines[0], overlay.lines[overlay.lines.len() - 1]);
        assert!((first.from - last.to).length() < 1e-5);
        assert!(overlay.lines.iter().all(|l| ((l.from - Vec3::Y).length() - 0.3).abs() < 1e-5));
        overlay.lines.push(Line { to: Vec3::NAN, ..style });
        let strokes = strokes(&overlay, 0.5);
        let tested = strokes.layer(Layer::Tested);
        assert_eq!(tested.len(), overlay.lines.len() - 1);
        assert_eq!(tested[0].shape[0], 0.5);
    }
}
