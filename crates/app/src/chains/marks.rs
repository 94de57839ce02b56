//! What is drawn over a chain: links of which nothing is seen, its joints, and the handles of what is chosen with their ranges.

use std::f64::consts::TAU;

use edit::{ChainEditor, ChainHandle, ChainNode, ChainShape, ChainSpot, ChainTrack, Circle};
use egui::Color32;
use glam::{DVec3, Vec2};
use render::{Color, Layer};
use rig::DofPart;

use super::picture::ChainPicture;
use crate::theme;
use crate::viewport::drawing::{Drawing, Pen, rgba};

/// Near the colours of the axes X, Y and Z: of rolls, pitches, yaws and what slides so.
const X: Color32 = Color32::from_rgb(242, 98, 88);
const Y: Color32 = Color32::from_rgb(138, 208, 98);
const Z: Color32 = Color32::from_rgb(94, 160, 252);
const GROUND: Color = [24, 26, 30, 150];
const BARE: Color = [205, 206, 210, 255];
/// Links that are thinner in the picture are drawn as lines.
const THIN_PX: f64 = 2.0;
/// Joints that are nearer to the one marked before are not marked: they would hide the chain.
const APART_PX: f32 = 9.0;

/// Draws the marks.
pub fn draw(drawing: &mut Drawing, picture: &ChainPicture, editor: &ChainEditor, node: ChainNode) {
    if picture.is_side_view() {
        ground(drawing);
    }
    thin_links(drawing, picture, editor);
    joints(drawing, editor, node);
    let held = match picture.under() {
        ChainSpot::Handle(handle) => Some(handle.slot),
        _ => None,
    };
    // While a link is dragged, or another handle, they would only be in the way.
    for handle in edit::chain_handles(editor, node, &drawing.sight.clone()) {
        let hot = held == Some(handle.slot);
        if !picture.is_dragging() || hot {
            let main = node == ChainNode::Value(handle.slot);
            draw_handle(drawing, &handle, [hot, main]);
        }
    }
}

/// The ground as a line, where a flat view sees it from its edge.
fn ground(drawing: &mut Drawing) {
    let camera = drawing.sight.camera;
    let (right, toward) = (camera.axes().x_axis.as_dvec3(), camera.axes().z_axis.as_dvec3());
    if toward.y.abs() > 1e-3 {
        return;
    }
    let middle = DVec3 { y: 0.0, ..camera.target.as_dvec3() };
    let far = right * f64::from(camera.distance) * 4.0;
    drawing.line(middle - far, middle + far, Pen { layer: Layer::Tested, ..Pen::new(GROUND, 1.5) });
}

/// Links of which nothing is seen, or hardly anything from so far away, are lines.
fn thin_links(drawing: &mut Drawing, picture: &ChainPicture, editor: &ChainEditor) {
    let pen = Pen { layer: Layer::Ghosted, ..Pen::new(BARE, 2.5) };
    for (link, frame) in editor.frames().iter().enumerate() {
        let (tip, metres) = (editor.robot().tip(link), drawing.sight.metres_per_px(frame.position));
        if tip.length_squared() > 0.0 && picture.picker.thickness(link) < THIN_PX * metres {
            drawing.line(frame.position, frame.point(tip), pen);
        }
    }
}

/// Joints that lie apart from each other are marked, and the chosen one.
fn joints(drawing: &mut Drawing, editor: &ChainEditor, node: ChainNode) {
    let robot = editor.robot();
    let chosen = node.joint(robot);
    let mut former: Option<Vec2> = None;
    for joint in (0..robot.joints().len()).filter(|joint| !robot.slot(*joint).is_empty()) {
        let Some(frame) = editor.frames().get(joint + 1).filter(|_| chosen != Some(joint)) else { continue };
        let Some(at) = drawing.sight.pixel_of(frame.position) else { continue };
        if former.is_none_or(|former| former.distance(at) > APART_PX) {
            drawing.disc(frame.position, 3.0, [236, 236, 238, 190], Layer::OnTop);
            former = Some(at);
        }
    }
    if let Some(frame) = chosen.and_then(|joint| editor.frames().get(joint + 1)) {
        drawing.disc(frame.position, 4.5, rgba(theme::ACCENT, 255), Layer::OnTop);
    }
}

/// The colour of a part's handle.
pub fn color(part: DofPart) -> Color32 {
    match part {
        DofPart::X | DofPart::Roll => X,
        DofPart::Y | DofPart::Pitch => Y,
        DofPart::Z | DofPart::Yaw => Z,
        DofPart::Turn | DofPart::Slide => theme::ACCENT,
    }
}

/// Of a joint with several ways to move, the chosen one is drawn strongest.
fn draw_handle(drawing: &mut Drawing, handle: &ChainHandle, [hot, main]: [bool; 2]) {
    let full = color(handle.part);
    let color = if hot || main { full } else { full.lerp_to_gamma(Color32::from_gray(120), 0.45) };
    match handle.shape {
        ChainShape::Ring(circle) => ring(drawing, &circle, handle.range, color, hot),
        ChainShape::Track(track) => self::track(drawing, &track, handle.range, color, hot),
    }
}

/// A ring: what the range leaves open is a filled sector with a strong arc and ticks at its ends, the rest a thin line.
fn ring(drawing: &mut Drawing, circle: &Circle, range: [f64; 2], color: Color32, hot: bool) {
    let [low, high] = range.map(|end| end.clamp(-TAU, TAU));
    let whole = high - low >= TAU - 1e-6;
    let width = if hot { 4.0 } else { 2.6 };
    let strong = Pen::new(rgba(color, 255), width);
    if whole {
        let (center, axis, radius) = (circle.center, circle.axis, circle.radius_m);
        drawing.ring(center, axis, radius, strong.under());
        drawing.ring(center, axis, radius, strong);
    } else {
        let thin = Pen::new(rgba(color, 110), 1.2);
        drawing.ring(circle.center, circle.axis, circle.radius_m, thin);
        let start = (circle.direction(low) * circle.radius_m).as_vec3();
        let (center, axis) = (circle.center.as_vec3(), circle.axis.as_vec3());
        let fill = rgba(color, if hot { 76 } else { 48 });
        drawing.overlay.sector(center, axis, start, (high - low) as f32, fill, Layer::OnTop);
        for pen in [strong.under(), strong] {
            drawing.arc(circle, low, high, pen);
        }
        for end in [low, high] {
            let out = circle.direction(end) * circle.radius_m;
            drawing.line(circle.center + out * 0.93, circle.center + out * 1.07, strong);
        }
    }
    let now = circle.point(0.0);
    drawing.line(circle.center, now, Pen::new(rgba(color, 150), 1.4));
    drawing.disc(now, if hot { 6.5 } else { 5.0 }, rgba(color, 255), Layer::OnTop);
}

/// An arrow both ways on a thin line that shows how far the joint slides.
fn track(drawing: &mut Drawing, track: &ChainTrack, range: [f64; 2], color: Color32, hot: bool) {
    let strong = Pen::new(rgba(color, 255), if hot { 4.0 } else { 3.0 });
    let place = |along: f64| track.at + track.direction * along;
    // A range without ends is as long as the handle.
    let [low, high] = range.map(|end| if end.is_finite() { end } else { end.signum() * track.arm_m });
    drawing.line(place(low), place(high), Pen::new(rgba(color, 130), 1.4));
    let metres = drawing.sight.metres_per_px(track.at);
    let toward = drawing.sight.toward_viewer(track.at);
    let side = track.direction.cross(toward).normalize_or_zero();
    for end in range.into_iter().filter(|end| end.is_finite()) {
        let half = side * 8.0 * metres;
        drawing.line(place(end) - half, place(end) + half, strong);
    }
    let [from, to] = track.ends();
    for pen in [strong.under(), strong] {
        drawing.line(from, to, pen);
        for (tip, back) in [(to, -1.0), (from, 1.0)] {
            for wing in [-1.0, 1.0] {
                let barb = track.direction * back * 11.0 * metres + side * wing * 7.0 * metres;
                drawing.line(tip, tip + barb, pen);
            }
        }
    }
}
