//! The soles of a figure's feet: the points on which it stands.

use glam::DVec3;
use rig::{Articulator, Bone, Figure, Frames, Limb, Mesh, Side, bone_of_place};

/// The points of one sole: a middle and two edges at heel, ball and toes.
///
/// At rest they lie in one level plane, that of the skin's underside.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sole {
    /// Fixed in the joint frames of foot or toes, metres. In the order heel, ball, toes; of each the middle, the outer
    /// and the inner edge, so that [`Sole::HEEL`], [`Sole::BALL`] and [`Sole::TOES`] are places in it.
    pub points: [Articulator; Sole::COUNT],
    /// From the back of the heel to the tip of the toes, metres.
    pub length_m: f64,
}

/// Both soles.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Soles {
    /// Left, right.
    pub feet: [Sole; 2],
}

/// Foot breadth over foot length (Drillis & Contini 1966).
const BREADTH: f64 = 0.055 / 0.152;
/// Foot length over the length of the leg from hip to ankle (the same).
const LENGTH_OVER_LEG: f64 = 0.152 / 0.491;
/// Ankle height over foot length (the same).
const ANKLE_HEIGHT: f64 = 0.039 / 0.152;
/// The part of the foot's breadth that touches the ground, and how it is shared at the ball, as the mannequin has it.
const TOUCHING: f64 = 0.85;
const OUTER_SHARE: f64 = 0.6;
/// Heel and toes are round, the sole is flat: its corners are where it touches ground that is tilted so, degrees, as when
/// the heel comes down and the toes leave.
const HEEL_PITCH: f64 = 18.0;
const TOES_PITCH: f64 = 30.0;
/// Skin up to here above the sole's plane still counts as sole, over foot length: 3 mm.
const UNDERSIDE: f64 = 0.012;

impl Sole {
    /// How many points a sole has.
    pub const COUNT: usize = 9;
    /// The middle of the heel's back edge; the two after it are the heel's outer and inner edge.
    pub const HEEL: usize = 0;
    /// The middle under the toes' joints; the two after it are its edges.
    pub const BALL: usize = 3;
    /// The middle of the toes' front edge; the two after it are the toes' edges.
    pub const TOES: usize = 6;

    /// The points where a pose takes them, in the space of the frames, metres.
    pub fn points(&self, frames: &Frames) -> [DVec3; Sole::COUNT] {
        self.points.map(|p| frames[p.bone].point(p.at))
    }

    /// The height of the lowest point, metres, in the space of the frames.
    pub fn lowest(&self, frames: &Frames) -> f64 {
        self.points(frames).iter().map(|p| p.y).fold(f64::INFINITY, f64::min)
    }
}

impl Soles {
    /// The soles of a figure; `None` if it lacks a foot.
    ///
    /// From its articulators `heel`, `ball` and `toeTip` and its skin; what is missing is guessed from its joints and
    /// mean human measures. A figure without toes has its points on the foot.
    pub fn of(figure: &Figure) -> Option<Soles> {
        Some(Soles { feet: [sole(figure, Limb::LeftLeg)?, sole(figure, Limb::RightLeg)?] })
    }

    /// The lower of the two soles' lowest heights, metres.
    pub fn lowest(&self, frames: &Frames) -> f64 {
        self.feet[0].lowest(frames).min(self.feet[1].lowest(frames))
    }
}

/// The lines of a sole in figure space at rest, metres.
struct Outline {
    /// The middle line.
    x: f64,
    /// Height of the plane.
    y: f64,
    heel_z: f64,
    ball_z: f64,
    toes_z: f64,
}

impl Outline {
    fn length(&self) -> f64 {
        self.toes_z - self.heel_z
    }

    /// Where the edges of heel, ball and toes lie, and how far before and behind the skin is asked for its breadth.
    fn bands(&self) -> [(f64, f64); 3] {
        let (length, toes) = (self.length(), self.toes_z - self.ball_z);
        [
            (self.heel_z + 0.06 * length, 0.06 * length),
            (self.ball_z, 0.05 * length),
            (self.ball_z + 0.6 * toes, 0.25 * toes),
        ]
    }
}

fn sole(figure: &Figure, leg: Limb) -> Option<Sole> {
    let parts = leg.parts();
    let foot = parts.end;
    figure.skeleton.joint(foot)?;
    let outward = if foot.side() == Some(Side::Right) { -1.0 } else { 1.0 };
    let toes = if foot == Bone::RightFoot { Bone::RightToes } else { Bone::LeftToes };
    let toes = figure.skeleton.joint(toes).map_or(foot, |_| toes);
    let mut line = outline(figure, leg, foot, toes);
    let skin = figure.skin.as_ref().map(|skin| skin_of_foot(skin, foot, toes)).unwrap_or_default();
    line.heel_z = -corner(&skin, line.y, -1.0, HEEL_PITCH).unwrap_or(-line.heel_z);
    line.toes_z = corner(&skin, line.y, 1.0, TOES_PITCH).unwrap_or(line.toes_z);
    let height = UNDERSIDE * line.length();
    let underside: Vec<DVec3> = skin.into_iter().filter(|p| p.y < line.y + height).collect();
    let breadths = [0.5, 1.0, 0.9].map(|share| share * TOUCHING * BREADTH * line.length());
    let shares = [0.5, OUTER_SHARE, OUTER_SHARE];
    let middles = [line.heel_z, line.ball_z, line.toes_z];
    let bones = [foot, foot, toes];
    let mut points = [Articulator { bone: foot, at: DVec3::ZERO }; Sole::COUNT];
    for (i, (z, around)) in line.bands().into_iter().enumerate() {
        let touching =
            underside.iter().filter(|p| (p.z - z).abs() <= around).map(|p| (p.x - line.x) * outward);
        let (inner, outer) = touching.fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        let guess = (-breadths[i] * (1.0 - shares[i]), breadths[i] * shares[i]);
        let (inner, outer) = if inner < 0.0 && outer > 0.0 { (inner, outer) } else { guess };
        let on = |x: f64, z: f64| {
            let at = DVec3::new(line.x + x * outward, line.y, z) - figure.skeleton.rest_position(bones[i]);
            Articulator { bone: bones[i], at }
        };
        points[3 * i..3 * i + 3].copy_from_slice(&[on(0.0, middles[i]), on(outer, z), on(inner, z)]);
    }
    Some(Sole { points, length_m: line.length() })
}

/// The lines from articulators, else from joints.
fn outline(figure: &Figure, leg: Limb, foot: Bone, toes: Bone) -> Outline {
    let at = |bone| figure.skeleton.rest_position(bone);
    let named = |name: &str| {
        let articulator = figure.articulators[leg.index()].get(name)?;
        Some(at(articulator.bone) + articulator.at)
    };
    let parts = leg.parts();
    let leg_m = at(parts.root).distance(at(parts.hinge)) + at(parts.hinge).distance(at(foot));
    let ankle = at(foot);
    // The toes' joint is half a foot before the ankle.
    let ahead = if toes == foot { 0.5 * LENGTH_OVER_LEG * leg_m } else { (at(toes) - ankle).z.abs() };
    let length = 2.0 * ahead;
    let height = ANKLE_HEIGHT * length;
    // Figures stand at height 0, unless their ankles say that it can't be.
    let guessed_y = if (0.3 * height..3.0 * height).contains(&ankle.y) { 0.0 } else { ankle.y - height };
    let ball = named("ball").unwrap_or(DVec3::new(ankle.x, guessed_y, ankle.z + ahead));
    let heel = named("heel").unwrap_or(DVec3::new(ankle.x, ball.y, ankle.z - 0.12 * length));
    let y = heel.y.min(ball.y);
    let tip = named("toeTip").unwrap_or(DVec3::new(ball.x, y, ball.z + 0.27 * length));
    Outline {
        x: ball.x,
        y,
        heel_z: heel.z - 0.034 * (ball.z - heel.z).abs(),
        ball_z: ball.z,
        // The tip of a round toe is in front of where it touches.
        toes_z: tip.z - 0.08 * (tip.y - y).abs(),
    }
}

/// The skin of foot and toes at rest.
fn skin_of_foot(skin: &Mesh, foot: Bone, toes: Bone) -> Vec<DVec3> {
    let of_foot = |vertex: usize| {
        let heaviest = (0..4).max_by_key(|&k| skin.weights[vertex][k]).unwrap_or(0);
        let bone = bone_of_place(usize::from(skin.joints[vertex][heaviest]));
        bone == foot || bone == toes
    };
    let positions = skin.positions.iter().map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into()));
    positions.enumerate().filter(|(i, _)| of_foot(*i)).map(|(_, p)| p).collect()
}

/// How far ahead (or behind, for -1) the plane of the sole meets ground that is tilted so and touches the skin, metres;
/// `None` without skin.
fn corner(skin: &[DVec3], sole_y: f64, ahead: f64, tilt_degrees: f64) -> Option<f64> {
    let (sine, cosine) = tilt_degrees.to_radians().sin_cos();
    let least = skin.iter().map(|p| (p.y - sole_y) * cosine - p.z * ahead * sine).reduce(f64::min)?;
    Some(-least / sine)
}
