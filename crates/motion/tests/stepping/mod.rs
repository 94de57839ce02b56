//! A walk made by hand: feet on a prescribed path.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use motion::{Clip, FootGoal, Key, Legs, Mode, Sole, Soles, Track};
use rig::{Bone, Figure, Frame, Place};

const LENGTH_SECS: f64 = 1.1;
const STRIDE_M: f64 = 1.0;
/// When the whole sole comes down, when the heel rises, when the toes leave.
const FLAT: f64 = 0.1;
const RISE: f64 = 0.3;
const LEAVE: f64 = 0.62;
const STRIKE_DEGREES: f64 = -15.0;
const LEAVE_DEGREES: f64 = 40.0;
/// The height of the mannequin's toes' joint over its sole, metres.
const TOES_M: f64 = 0.022;

fn smooth(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// The foot's pitch at a phase from its heel's contact, degrees; positive lifts the heel.
fn pitch(phase: f64) -> f64 {
    if phase < RISE {
        STRIKE_DEGREES * (1.0 - smooth(phase / FLAT))
    } else if phase < LEAVE {
        LEAVE_DEGREES * smooth((phase - RISE) / (LEAVE - RISE) * 0.5) * 2.0
    } else {
        LEAVE_DEGREES + (STRIKE_DEGREES - LEAVE_DEGREES) * smooth((phase - LEAVE) / (1.0 - LEAVE))
    }
}

/// The ankle in the frame in which the figure starts at the origin, and the foot's turn, while the foot stands.
fn standing(sole: &Sole, phase: f64) -> Frame {
    let rotation = DQuat::from_rotation_x(pitch(phase).to_radians());
    // The foot turns about its heel, then about its toes' joint, which stays over the ball.
    let pivot = if phase < FLAT {
        sole.points[Sole::HEEL].at
    } else {
        sole.points[Sole::BALL].at + DVec3::Y * TOES_M
    };
    // The heel's place is given; the toes' joint is where it is with a flat foot.
    let heel = sole.points[Sole::HEEL].at;
    let place = pivot - heel + DVec3::Z * STRIDE_M * 0.24;
    Frame::new(rotation, place - rotation * pivot)
}

/// The ankle in figure space.
fn foot(sole: &Sole, phase: f64) -> Frame {
    let carried =
        |frame: Frame, phase: f64| Frame::new(frame.rotation, frame.position - DVec3::Z * STRIDE_M * phase);
    if phase <= LEAVE {
        return carried(standing(sole, phase), phase);
    }
    let u = (phase - LEAVE) / (1.0 - LEAVE);
    let from = standing(sole, LEAVE).position;
    let to = standing(sole, 0.0).position + DVec3::Z * STRIDE_M;
    let height = DVec3::Y * 0.07 * (std::f64::consts::PI * u).sin();
    let position = from.lerp(to, smooth(u)) + height;
    carried(Frame::new(DQuat::from_rotation_x(pitch(phase).to_radians()), position), phase)
}

/// A stride of that figure at 0.9 m/s, straight ahead, made with its own legs.
pub fn walk(figure: &Figure) -> Clip {
    let (legs, soles) = (Legs::of(figure).unwrap(), Soles::of(figure).unwrap());
    let hips = figure.rest_pose().hips - DVec3::Y * 0.05;
    let mut joints: BTreeMap<Bone, Track<rig::Angles>> = BTreeMap::new();
    for (side, leg) in legs.sides.iter().enumerate() {
        let mut angles = figure.rest_pose().angles;
        for (i, at) in (0..=110).map(|i| (i, f64::from(i) / 110.0)) {
            let phase = (at + 0.5 * side as f64).rem_euclid(1.0);
            let mut goal = foot(&soles.feet[side], phase);
            goal.position.x += leg.hip(Frame::new(DQuat::IDENTITY, hips)).x;
            let knee = leg.limb().parts().hinge.index();
            angles[knee].flexion = angles[knee].flexion.max(10.0);
            let bend = leg.bend(&angles);
            let goal = FootGoal { ankle: goal.position, rotation: goal.rotation };
            let miss = leg.solve(Frame::new(DQuat::IDENTITY, hips), &goal, &bend, 0.0, &mut angles);
            assert!(miss.ankle_m < 1e-6 && miss.foot_degrees < 1e-3, "{at}: {miss:?}");
            let standing = (RISE..LEAVE).contains(&phase);
            let lifted =
                if standing { pitch(phase) } else { LEAVE_DEGREES * (1.0 - smooth((phase - LEAVE) * 5.0)) };
            angles[leg.toes_bone().index()].flexion = if phase < RISE { 0.0 } else { -lifted };
            let parts = leg.limb().parts();
            for bone in [parts.root, parts.hinge, parts.end, leg.toes_bone()] {
                let track = joints.entry(bone).or_insert(Track { mode: Mode::Linear, keys: vec![] });
                let at_secs = if i == 110 { LENGTH_SECS } else { LENGTH_SECS * at };
                track.keys.push(Key { at_secs, value: angles[bone.index()] });
            }
        }
    }
    let end = Place { position: DVec3::Z * STRIDE_M, turn: 0.0 };
    let root = [(0.0, Place::default()), (LENGTH_SECS, end)].map(|(at_secs, value)| Key { at_secs, value });
    Clip {
        name: "hand-made".into(),
        figure: Some(figure.name.clone()),
        size: None,
        length_secs: LENGTH_SECS,
        loops: true,
        stride: true,
        root: Some(Track { mode: Mode::Linear, keys: root.to_vec() }),
        hips: Some(Track { mode: Mode::Linear, keys: vec![Key { at_secs: 0.0, value: hips }] }),
        joints,
    }
}
