//! Marks over the picture: lines and points whose width is in pixels.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

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

/// A round point.
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
}

/// All marks of a picture: lines in their order, then points in theirs; tested ones below those on top.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Overlay {
    /// The lines.
    pub lines: Vec<Line>,
    /// The points.
    pub markers: Vec<Marker>,
}

impl Overlay {
    /// Adds an arc about an axis: starts at `center + start` and turns by `angle_rad` about the unit `axis`, in
    /// short lines like `style`, whose own ends are ignored.
    pub fn arc(&mut self, center: Vec3, axis: Vec3, start: Vec3, angle_rad: f32, style: Line) {
        if !(axis.is_finite() && start.is_finite() && angle_rad.is_finite()) {
            return;
        }
        let axis = axis.normalize_or(Vec3::Y);
        let steps = (angle_rad.abs() / 0.1).ceil().clamp(1.0, 128.0);
        let at = |i: f32| center + glam::Quat::from_axis_angle(axis, angle_rad * i / steps) * start;
        for i in 0..steps as u32 {
            self.lines.push(Line { from: at(i as f32), to: at(i as f32 + 1.0), ..style });
        }
    }

    /// Adds a full circle about the unit `axis`.
    pub fn ring(&mut self, center: Vec3, axis: Vec3, radius_m: f32, style: Line) {
        let start = axis.normalize_or(Vec3::Y).any_orthonormal_vector() * radius_m;
        self.arc(center, axis, start, std::f32::consts::TAU, style);
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
    /// Radius, outline, dash period, 1 for an ellipse.
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
        let shape = [mark.radius_px * scale, mark.outline_px * scale, 0.0, 0.0];
        Stroke { from: at, to: at, color: mark.color, outline: mark.outline, shape }
    }

    fn is_finite(&self) -> bool {
        self.from.iter().chain(&self.to).chain(&self.shape).all(|x| x.is_finite())
    }
}

/// The strokes of an overlay, sorted by layer. Marks that are not finite are left out.
#[derive(Clone, Default, Debug)]
pub(crate) struct Strokes {
    pub tested: Vec<Stroke>,
    pub ghosted: Vec<Stroke>,
    pub on_top: Vec<Stroke>,
}

impl Strokes {
    /// `scale` is drawn pixels over the scene's pixels.
    pub fn of(overlay: &Overlay, scale: f32) -> Strokes {
        let mut strokes = Strokes::default();
        let lines = overlay.lines.iter().map(|l| (l.layer, Stroke::line(l, scale)));
        let markers = overlay.markers.iter().map(|m| (m.layer, Stroke::marker(m, scale)));
        for (layer, stroke) in lines.chain(markers).filter(|(_, s)| s.is_finite()) {
            match layer {
                Layer::Tested => strokes.tested.push(stroke),
                Layer::Ghosted => strokes.ghosted.push(stroke),
                Layer::OnTop => strokes.on_top.push(stroke),
            }
        }
        strokes
    }
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
        let strokes = Strokes::of(&overlay, 0.5);
        assert_eq!(strokes.tested.len(), overlay.lines.len() - 1);
        assert_eq!(strokes.tested[0].shape[0], 0.5);
    }
}
