//! Rings, arcs and handles over the picture. Each kind has a line of its own besides its colour.

use edit::{Circle, Hands, Knob, Mark, Placed, Shape, Sight, Stage, Turned};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};
use glam::DVec3;
use rig::Dof;

use crate::{labels, theme};

/// Flexion, abduction and twist: near the colours of the axes X, Y and Z.
const DOFS: [Color32; 3] =
    [Color32::from_rgb(242, 98, 88), Color32::from_rgb(138, 208, 98), Color32::from_rgb(94, 160, 252)];
const ELEVATION: Color32 = Color32::from_rgb(214, 164, 255);
/// Handles of the body on a dark picture and on a light one.
const BODY: [Color32; 2] = [Color32::from_rgb(240, 224, 170), Color32::from_rgb(122, 92, 20)];
/// Under every line, so that it shows on light skin too.
const SHADE: Color32 = Color32::from_black_alpha(70);
const STEPS: u32 = 96;

/// How the lines of one knob look.
#[derive(Clone, Copy)]
struct Pen {
    color: Color32,
    width: f32,
    dash: Dash,
}

#[derive(Clone, Copy, PartialEq)]
enum Dash {
    Solid,
    Long,
    Dots,
}

/// Draws the knobs of a stage, what is turned, and a name at what the pointer is on.
pub fn paint(ui: &Ui, hands: &Hands, stage: &Stage, rect: Rect) {
    let painter = ui.painter().with_clip_rect(rect);
    let body = BODY[usize::from(!ui.visuals().dark_mode)];
    let canvas = Canvas { painter, sight: stage.sight, origin: rect.min, body };
    if let Some(turned) = hands.turned() {
        canvas.turned(&turned);
    } else if !hands.is_dragging() {
        let hot = hands.knob();
        for placed in hands.knobs(stage) {
            canvas.knob(&placed, hot == Some(placed.knob));
        }
        canvas.name(hands, stage);
    }
    if let Some(snap) = hands.snap() {
        canvas.snap(snap.surface_in_world, snap.normal_in_world);
    }
}

struct Canvas {
    painter: Painter,
    sight: Sight,
    origin: Pos2,
    body: Color32,
}

impl Canvas {
    fn place(&self, point: DVec3) -> Option<Pos2> {
        let at = self.sight.pixel_of(point)?;
        Some(self.origin + vec2(at.x, at.y))
    }

    fn knob(&self, placed: &Placed, hot: bool) {
        let pen = pen(placed.knob, hot, self.body);
        match placed.shape {
            Shape::Ring(circle) => self.ring(placed.knob, &circle, pen),
            Shape::Arc(circle, range) => {
                self.arc(&circle, range, Pen { width: pen.width * 0.8, ..pen });
                self.ticks(&circle, range, pen);
                self.diamond(self.place(circle.point(0.0)), if hot { 7.5 } else { 6.0 }, pen.color);
            }
            Shape::Handle(at) => self.diamond(self.place(at), if hot { 6.5 } else { 4.5 }, pen.color),
            Shape::Disc(middle, radius) => {
                if let Some(at) = self.place(middle) {
                    self.painter.circle_filled(
                        at,
                        radius,
                        Color32::from_white_alpha(if hot { 40 } else { 12 }),
                    );
                    self.painter.circle_stroke(at, radius, Stroke::new(pen.width + 1.5, SHADE));
                    self.painter.circle_stroke(at, radius, Stroke::new(pen.width, pen.color));
                }
            }
            Shape::Cross(middle, arm) => self.cross(middle, arm, pen),
        }
    }

    /// A ring whose hidden half is faint, with its letter; two lines for one that turns in contact.
    fn ring(&self, knob: Knob, circle: &Circle, pen: Pen) {
        let radii: &[f64] = if matches!(knob, Knob::InContact(..)) { &[0.97, 1.04] } else { &[1.0] };
        for share in radii {
            let circle = Circle { radius_m: circle.radius_m * share, ..*circle };
            let step = std::f64::consts::TAU / f64::from(STEPS);
            let (mut front, mut back) = (Vec::new(), Vec::new());
            let flush = |line: &mut Vec<Pos2>, front: bool| {
                let line = std::mem::take(line);
                if front { self.line(line, pen) } else { self.faint(line, pen.color) }
            };
            // From the middle of the far half, so that the near half is one line and dashes don't start anew.
            for i in 0..=STEPS {
                let angle = f64::from(i) * step + std::f64::consts::PI;
                let Some(at) = self.place(circle.point(angle)) else { continue };
                if circle.is_front(&self.sight, angle) {
                    front.push(at);
                    back.push(at);
                    flush(&mut back, false);
                } else {
                    back.push(at);
                    flush(&mut front, true);
                }
            }
            flush(&mut front, true);
            flush(&mut back, false);
        }
        if let Knob::Turn(_, dof) | Knob::InContact(_, dof) = knob {
            self.letter(circle, dof, pen.color);
        }
    }

    /// F, A or T beside the ring's near half.
    fn letter(&self, circle: &Circle, dof: Dof, color: Color32) {
        let (Some(middle), Some(at)) = (self.place(circle.center), self.place(circle.point(0.55))) else {
            return;
        };
        let outward = (at - middle).normalized();
        let outward = if outward.is_finite() { outward } else { Vec2::UP };
        let letter = match dof {
            Dof::Flexion => "F",
            Dof::Abduction => "A",
            Dof::Twist => "T",
        };
        self.words(at + outward * 9.0, Align2::CENTER_CENTER, letter, 11.0, color);
    }

    /// What is turned: the ring, how far it may go and has gone, and the angle.
    fn turned(&self, turned: &Turned) {
        let (circle, pen) = (turned.circle, pen(turned.knob, true, self.body));
        let outside = Circle { radius_m: circle.radius_m * 1.1, ..circle };
        self.ring(turned.knob, &circle, Pen { width: 1.2, ..pen });
        if let Some(range) = turned.range_rad {
            let range = range.map(|end| end.clamp(-std::f64::consts::PI, std::f64::consts::PI));
            self.arc(&outside, range, Pen { width: 2.5, dash: Dash::Solid, ..pen });
            self.ticks(&outside, range, pen);
        }
        let [low, high] = turned.range_rad.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let angle = turned.angle_rad.max(low.min(0.0)).min(high.max(0.0));
        self.fan(&circle, angle, pen.color);
        for (at, width) in [(0.0, 1.0), (angle, 2.0)] {
            if let (Some(from), Some(to)) = (self.place(circle.center), self.place(circle.point(at))) {
                self.line(vec![from, to], Pen { width, dash: Dash::Solid, ..pen });
            }
        }
        if let (Some(middle), Some(at)) = (self.place(circle.center), self.place(circle.point(angle))) {
            let away = (at - middle).normalized() * 30.0;
            let away = if away.is_finite() { away } else { vec2(0.0, -30.0) };
            self.words(at + away, Align2::CENTER_CENTER, &turned.text, 13.0, Color32::WHITE);
        }
    }

    /// The sector between the start and where the turn is now.
    fn fan(&self, circle: &Circle, angle: f64, color: Color32) {
        let whole = angle.clamp(-std::f64::consts::TAU, std::f64::consts::TAU);
        let steps = (whole.abs() / 0.08).ceil().max(1.0);
        let Some(middle) = self.place(circle.center) else { return };
        let rim = (0..=steps as u32).filter_map(|i| self.place(circle.point(whole * f64::from(i) / steps)));
        let rim: Vec<Pos2> = rim.collect();
        let mut mesh = egui::Mesh::default();
        let fill = color.gamma_multiply(0.22);
        mesh.colored_vertex(middle, fill);
        for (i, at) in rim.iter().enumerate() {
            mesh.colored_vertex(*at, fill);
            if i > 0 {
                mesh.add_triangle(0, i as u32, i as u32 + 1);
            }
        }
        self.painter.add(mesh);
    }

    fn arc(&self, circle: &Circle, [from, to]: [f64; 2], pen: Pen) {
        let steps = ((to - from) / 0.06).ceil().clamp(1.0, f64::from(2 * STEPS));
        let at = |i: u32| self.place(circle.point(from + (to - from) * f64::from(i) / steps));
        self.line((0..=steps as u32).filter_map(at).collect(), pen);
    }

    /// Short strokes across a circle at the ends of a range; none where it goes all the way round.
    fn ticks(&self, circle: &Circle, range: [f64; 2], pen: Pen) {
        if range[1] - range[0] >= std::f64::consts::TAU - 1e-6 {
            return;
        }
        for end in range {
            let share = |share: f64| Circle { radius_m: circle.radius_m * share, ..*circle }.point(end);
            if let (Some(from), Some(to)) = (self.place(share(0.93)), self.place(share(1.07))) {
                self.line(vec![from, to], Pen { width: 2.0, dash: Dash::Solid, ..pen });
            }
        }
    }

    fn cross(&self, middle: DVec3, arm: f64, pen: Pen) {
        let at = |x: f64, z: f64| self.place(middle + DVec3::new(x, 0.0, z) * arm);
        for (x, z) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let (side_x, side_z) = (z * 0.16, x * 0.16);
            let head =
                [at(x * 0.7 + side_x, z * 0.7 + side_z), at(x, z), at(x * 0.7 - side_x, z * 0.7 - side_z)];
            let [Some(one), Some(tip), Some(other)] = head else { continue };
            if let Some(from) = at(x * 0.15, z * 0.15) {
                self.line(vec![from, tip], pen);
            }
            self.line(vec![one, tip, other], pen);
        }
    }

    fn diamond(&self, at: Option<Pos2>, radius: f32, color: Color32) {
        let Some(at) = at else { return };
        let corners = [vec2(0.0, -radius), vec2(radius, 0.0), vec2(0.0, radius), vec2(-radius, 0.0)];
        let points = corners.map(|corner| at + corner).to_vec();
        let light = color.intensity() < 0.5;
        let fill = if light { Color32::from_white_alpha(190) } else { Color32::from_black_alpha(150) };
        self.painter.add(egui::Shape::convex_polygon(points, fill, Stroke::new(1.6, color)));
    }

    /// A small ring lying on a surface, and its normal.
    fn snap(&self, at: DVec3, normal: DVec3) {
        let radius = 9.0 * self.sight.metres_per_px(at);
        let circle = Circle::new(at, normal, DVec3::Y, radius);
        let pen = Pen { color: theme::ACCENT, width: 2.0, dash: Dash::Solid };
        self.arc(&circle, [0.0, std::f64::consts::TAU], pen);
        if let (Some(from), Some(to)) = (self.place(at), self.place(at + normal * radius * 1.6)) {
            self.line(vec![from, to], pen);
        }
    }

    fn line(&self, points: Vec<Pos2>, pen: Pen) {
        if points.len() < 2 {
            return;
        }
        let shade = Stroke::new(pen.width + 1.6, SHADE);
        let stroke = Stroke::new(pen.width, pen.color);
        match pen.dash {
            Dash::Solid => {
                self.painter.add(egui::Shape::line(points.clone(), shade));
                self.painter.add(egui::Shape::line(points, stroke));
            }
            Dash::Long => {
                self.painter.extend(egui::Shape::dashed_line(&points, stroke, 9.0, 4.0));
            }
            Dash::Dots => {
                self.painter.extend(egui::Shape::dashed_line(&points, stroke, 2.5, 3.0));
            }
        }
    }

    fn faint(&self, points: Vec<Pos2>, color: Color32) {
        if points.len() > 1 {
            let stroke = Stroke::new(1.0, color.gamma_multiply(0.25));
            self.painter.add(egui::Shape::line(points, stroke));
        }
    }

    /// A ring and a name at what a click would choose.
    fn name(&self, hands: &Hands, stage: &Stage) {
        let Some(mark) = hands.under().mark else { return };
        let Some(at) = mark.place(stage.editor).and_then(|place| self.place(place)) else { return };
        self.painter.circle_stroke(at, 8.0, Stroke::new(2.0, theme::ACCENT));
        let words = match mark {
            Mark::Joint(bone) => labels::full(bone),
            Mark::Target(limb) => format!("{} target", labels::limb(limb)),
            Mark::Knob(_) => return,
        };
        self.words(at + vec2(14.0, 0.0), Align2::LEFT_CENTER, &words, 12.5, Color32::WHITE);
    }

    /// Words on a dark ground.
    fn words(&self, at: Pos2, anchor: Align2, words: &str, size: f32, color: Color32) {
        let font = FontId::proportional(size);
        let text = self.painter.layout_no_wrap(words.to_owned(), font, color);
        let place = anchor.anchor_size(at, text.size());
        self.painter.rect_filled(place.expand2(vec2(4.0, 1.0)), 3.0, Color32::from_black_alpha(150));
        self.painter.galley(pos2(place.left(), place.top()), text, color);
    }
}

fn pen(knob: Knob, hot: bool, body: Color32) -> Pen {
    let (color, dash) = match knob {
        Knob::Turn(_, dof) | Knob::InContact(_, dof) => (DOFS[dof as usize], DASHES[dof as usize]),
        Knob::Trackball(_) => (Color32::from_gray(225), Dash::Solid),
        Knob::Elevation(_) => (ELEVATION, Dash::Dots),
        Knob::Collar(_) | Knob::Spine | Knob::Hips | Knob::Place => (body, Dash::Solid),
        Knob::TurnFigure => (body, Dash::Long),
    };
    let quiet = matches!(knob, Knob::Place | Knob::TurnFigure | Knob::Trackball(_)) && !hot;
    let color = if quiet { color.gamma_multiply(0.55) } else { color };
    let width = match (hot, quiet) {
        (true, _) => 3.0,
        (false, true) => 1.2,
        (false, false) => 1.8,
    };
    Pen { color, width, dash }
}

/// Flexion is a whole line, abduction one of dashes, twist one of dots.
const DASHES: [Dash; 3] = [Dash::Solid, Dash::Long, Dash::Dots];
