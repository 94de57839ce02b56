//! A leg that holds its foot where a motion wants it, the knee bending in an upright plane.

use glam::{DMat3, DQuat, DVec3};
use rig::{Angles, Articulation, Bone, Figure, Frame, Joint, Limb};

/// A foot in the figure's space.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// The ankle's joint, metres.
    pub ankle: DVec3,
    /// `figure_from_foot`.
    pub rotation: DQuat,
    /// The toes' angle, degrees, positive curled.
    pub toes: f64,
}

/// How far hips must sink so that a leg holds its foot with a knee bent by no less than some degrees, metres.
/// `None` if the figure lacks the leg.
pub fn sinks(figure: &Figure, figure_from_hips: Frame, limb: Limb, foot: &Foot, knee: f64) -> Option<f64> {
    let parts = limb.parts();
    let hip = figure_from_hips.point(figure.skeleton.joint(parts.root)?.offset);
    let thigh = figure.skeleton.joint(parts.hinge)?.offset.length();
    let shank = figure.skeleton.joint(parts.end)?.offset.length();
    let reach_squared = thigh * thigh + shank * shank + 2.0 * thigh * shank * knee.to_radians().cos();
    let off = foot.ankle - hip;
    Some((-off.y - (reach_squared - off.x * off.x - off.z * off.z).max(0.0).sqrt()).max(0.0))
}

/// Writes the angles of hip, knee, ankle and toes that hold a foot; `knee_ahead` is the level direction that the knee
/// points to. A foot out of reach is left short of its place by a straight leg.
pub fn hold(
    figure: &Figure,
    figure_from_hips: Frame,
    limb: Limb,
    foot: &Foot,
    knee_ahead: DVec3,
    angles: &mut [Angles; Bone::COUNT],
) -> Option<()> {
    let parts = limb.parts();
    let joint = |bone: Bone| figure.skeleton.joint(bone);
    let (hip, knee, ankle) = (joint(parts.root)?, joint(parts.hinge)?, joint(parts.end)?);
    let to_ankle = foot.ankle - figure_from_hips.point(hip.offset);
    let (thigh, shank) = (knee.offset.length(), ankle.offset.length());
    let distance = to_ankle.length().clamp(1e-3, thigh + shank);
    let along = to_ankle.normalize();
    let axis = knee_ahead.cross(along).normalize();
    let cosine = |a: f64, b: f64, opposite: f64| {
        ((a * a + b * b - opposite * opposite) / (2.0 * a * b)).clamp(-1.0, 1.0).acos()
    };
    let bend = std::f64::consts::PI - cosine(thigh, shank, distance);
    let down = DQuat::from_axis_angle(axis, -cosine(thigh, distance, shank)) * along;
    let figure_from_thigh = DQuat::from_mat3(&DMat3::from_cols(axis, -down, axis.cross(-down)));
    let figure_from_shank = figure_from_thigh * DQuat::from_rotation_x(bend);
    angles[parts.root.index()] = angles_of(hip, figure_from_hips.rotation.conjugate() * figure_from_thigh)?;
    angles[parts.hinge.index()].flexion = bend.to_degrees();
    angles[parts.end.index()] = angles_of(ankle, figure_from_shank.conjugate() * foot.rotation)?;
    let toes = if limb == Limb::LeftLeg { Bone::LeftToes } else { Bone::RightToes };
    angles[toes.index()].flexion = foot.toes;
    Some(())
}

/// The angles of a ball joint's rotation, degrees; `None` for other joints.
pub fn angles_of(joint: &Joint, rotation: DQuat) -> Option<Angles> {
    let Articulation::Ball { ball, .. } = &joint.articulation else { return None };
    let [flexion, abduction, twist] = ball.angles(rotation).map(f64::to_degrees);
    Some(Angles { flexion, abduction, twist })
}
