//! One foot's way through a stride: it rolls over its print, swings, and rolls over the next.

use glam::{DQuat, DVec2, DVec3};
use rig::Frame;

use super::curve::Curve;
use super::leg::Foot;
use super::path::Path;
use super::sole::Sole;

/// A difference of phase for rates, small against any curve.
const TICK: f64 = 1e-4;

/// How one foot steps. Phases count from its own contact.
#[derive(Clone, Debug)]
pub struct Step {
    /// Where its print lies at mid stance: outward and ahead of the figure's origin, metres.
    pub print: DVec2,
    /// Toes outward, degrees.
    pub out_turn: f64,
    /// The phase at which the print lies there.
    pub middle: f64,
    /// The phase at which it leaves the ground.
    pub lift: f64,
    /// Toes up over the ground, degrees; negative: heel up.
    pub pitch: Curve,
    /// The toes' own slope, tips down, degrees.
    pub toes_down: Curve,
    /// Heights of the ankle in swing, metres: (fraction of the swing, height), one to three.
    pub heights: Vec<(f64, f64)>,
    /// The ankle's way in swing against an even one, outward and ahead, metres at mid swing.
    pub detour: DVec2,
    /// How hard the foot is braked as it lands, metres a second squared, level and upward.
    pub brake: DVec2,
    /// The sole's turn inward in mid swing, degrees.
    pub sole_in: f64,
}

/// A step of one leg along a path.
pub struct Stepping<'a> {
    pub step: &'a Step,
    pub sole: Sole,
    pub path: Path,
    /// Seconds of a stride.
    pub length_secs: f64,
    /// +1 left, -1 right.
    pub side: f64,
}

impl Stepping<'_> {
    /// The foot in the figure's space, so many strides after its contact.
    pub fn at(&self, phase: f64) -> Foot {
        let phase = phase.rem_euclid(1.0);
        let (pitch, toes_down) = (self.step.pitch.at(phase), self.step.toes_down.at(phase));
        let (ankle, yaw, roll) =
            if phase <= self.step.lift { self.standing(phase) } else { self.swinging(phase) };
        let world = self.path.frame(phase * self.length_secs).inverse();
        let turn = DQuat::from_rotation_y(yaw)
            * DQuat::from_rotation_z(-self.side * roll.to_radians())
            * DQuat::from_rotation_x(-pitch.to_radians());
        Foot { ankle: world.point(ankle), rotation: world.rotation * turn, toes: pitch + toes_down }
    }

    /// The frame of the print on the ground at stride 0 or the next, world.
    fn print(&self, stride: f64) -> Frame {
        let place = self.path.frame((stride + self.step.middle) * self.length_secs);
        let at = DVec3::new(self.side * self.step.print.x, 0.0, self.step.print.y);
        place.then(Frame::new(DQuat::from_rotation_y(self.side * self.step.out_turn.to_radians()), at))
    }

    fn rolling(&self, stride: f64, phase: f64) -> DVec3 {
        let (pitch, toes_down) = (self.step.pitch.at(phase), self.step.toes_down.at(phase));
        let at = self.sole.ankle(pitch.to_radians(), toes_down.to_radians());
        self.print(stride).point(DVec3::new(0.0, at.y, at.x))
    }

    /// Ankle (world), yaw (radians), roll (degrees).
    fn standing(&self, phase: f64) -> (DVec3, f64, f64) {
        (self.rolling(0.0, phase), self.yaw(0.0), 0.0)
    }

    fn yaw(&self, stride: f64) -> f64 {
        let turn = self.path.turn_rate * (stride + self.step.middle) * self.length_secs;
        (turn + self.side * self.step.out_turn).to_radians()
    }

    fn swinging(&self, phase: f64) -> (DVec3, f64, f64) {
        let (lift, span) = (self.step.lift, 1.0 - self.step.lift);
        let part = (phase - lift) / span;
        let leave = self.moving(0.0, lift);
        let mut land = self.moving(1.0, 1.0);
        let seconds = span * self.length_secs;
        let way = (land[0] - leave[0]).with_y(0.0).normalize_or_zero();
        land[2] += (DVec3::Y * self.step.brake.y - way * self.step.brake.x) * seconds * seconds;
        let mut ankle = quintic(part, leave, land);
        ankle.y += self.rise(part, |at| quintic(at, leave, land).y);
        let hump = hump(part);
        let aside = DVec3::new(self.side * self.step.detour.x, 0.0, self.step.detour.y);
        ankle += self.path.frame(phase * self.length_secs).rotation * aside * hump;
        let ease = part * part * part * (10.0 - 15.0 * part + 6.0 * part * part);
        let yaw = self.yaw(0.0) + ease * (self.yaw(1.0) - self.yaw(0.0));
        (ankle, yaw, self.step.sole_in * hump)
    }

    /// Place, rate and second rate by the fraction of the swing, at one of its ends.
    fn moving(&self, stride: f64, phase: f64) -> [DVec3; 3] {
        let span = 1.0 - self.step.lift;
        let [before, at, after] = [-TICK, 0.0, TICK].map(|tick| self.rolling(stride, phase + tick));
        let tick = TICK / span;
        [at, (after - before) / (2.0 * tick), (after + before - 2.0 * at) / (tick * tick)]
    }

    /// What is added to a height so that it passes the step's own heights.
    fn rise(&self, part: f64, plain: impl Fn(f64) -> f64) -> f64 {
        let keys = &self.step.heights;
        // A hump times the polynomial (Lagrange) through what the keys lack.
        let lacking = |key: &(f64, f64)| (key.1 - plain(key.0)) / hump(key.0);
        let term = |(index, key): (usize, &(f64, f64))| {
            let others = keys.iter().enumerate().filter(|(other, _)| *other != index);
            lacking(key) * others.map(|(_, other)| (part - other.0) / (key.0 - other.0)).product::<f64>()
        };
        hump(part) * keys.iter().enumerate().map(term).sum::<f64>()
    }
}

/// 0 at the ends with two rates, 1 in the middle.
fn hump(part: f64) -> f64 {
    64.0 * (part * (1.0 - part)).powi(3)
}

/// From one end's place, rate and second rate to the other's.
fn quintic(s: f64, [p0, v0, a0]: [DVec3; 3], [p1, v1, a1]: [DVec3; 3]) -> DVec3 {
    let (d, v, a) = (p1 - p0 - v0 - a0 / 2.0, v1 - v0 - a0, a1 - a0);
    let c3 = 10.0 * d - 4.0 * v + a / 2.0;
    let c4 = -15.0 * d + 7.0 * v - a;
    let c5 = 6.0 * d - 3.0 * v + a / 2.0;
    p0 + s * (v0 + s * (a0 / 2.0 + s * (c3 + s * (c4 + s * c5))))
}
