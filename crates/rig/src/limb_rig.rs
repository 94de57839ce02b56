//! A figure's limb in the frame of the closed form: axes, mirror, ranges, and the way back to angles.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::{DQuat, DVec3};
use kin::{Carrier, Cone, Elevations, Interval, LimbGoal, LimbRanges, LimbState, RootRange, wrapped};

use crate::{Articulation, Bone, Contact, Dof, Figure, Frames, Joint, Limb, Pose, Skeleton};

/// One limb of a figure, ready to solve. Lengths and angles are those of the limb frame: x outward.
///
/// A right limb is solved as the left limb of the figure's mirror image.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbRig {
    /// Which limb.
    pub limb: Limb,
    /// Its closed form, in the limb frame.
    pub kin: kin::Limb,
    /// The ranges of root and hinge, limb axes, radians.
    pub ranges: LimbRanges,
    /// What carries the root joint.
    pub base: Bone,
    /// Whether the root keeps its angles, so that the hinge alone can reach.
    pub root_locked: bool,
    root_offset: DVec3,
    axes: Axes,
}

/// The limb's axes in its base's.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Axes {
    base_from_limb: DQuat,
    mirrored: bool,
}

/// A skeleton's limbs, made ready to solve once.
#[derive(Clone, PartialEq, Debug)]
pub struct LimbRigs {
    swing_bases: [DVec3; Limb::ALL.len()],
    rigs: [Option<LimbRig>; Limb::ALL.len()],
}

impl LimbRigs {
    /// Makes the limbs ready. `swing_bases`, by [`Limb::index`], are unit directions in figure axes along which each
    /// limb's elevation has no singularity at rest; the carrier's singular direction is the opposite.
    ///
    /// A limb that lacks a joint, or whose rest pose leaves it no plane to bend in, is left out: it can't reach.
    pub fn new(skeleton: &Skeleton, swing_bases: [DVec3; Limb::ALL.len()]) -> LimbRigs {
        let rigs = Limb::ALL.map(|limb| LimbRig::new(skeleton, swing_bases[limb.index()], limb));
        LimbRigs { swing_bases, rigs }
    }

    /// The direction of a limb in which its elevation has no singularity.
    pub fn swing_base(&self, limb: Limb) -> DVec3 {
        self.swing_bases[limb.index()]
    }

    /// A limb made ready; `None` if the figure lacks one of its joints or it has no plane to bend in.
    pub fn get(&self, limb: Limb) -> Option<&LimbRig> {
        self.rigs[limb.index()].as_ref()
    }
}

impl LimbRig {
    /// `None` if the figure lacks a joint of the limb, or its rest pose leaves the limb no plane to bend in.
    fn new(skeleton: &Skeleton, swing_base: DVec3, limb: Limb) -> Option<LimbRig> {
        let parts = limb.parts();
        let (root, hinge) = (skeleton.joint(parts.root)?, skeleton.joint(parts.hinge)?);
        let axes = Axes::of(limb);
        let flexion = flexion(hinge)?;
        let base = axes.point_in_limb(swing_base);
        let (knee, axis) = (axes.point_in_limb(hinge.offset), axes.axis_in_limb(flexion.axis));
        Some(LimbRig {
            limb,
            kin: kin::Limb::new(knee, axis, Carrier::Swing { base }).ok()?,
            ranges: LimbRanges { root: axes.root_range(root)?, hinge: radians(flexion.range) },
            base: root.carrier?,
            root_locked: skeleton.locks().contains(parts.root),
            root_offset: root.offset,
            axes,
        })
    }

    /// A point of the base's joint frame in the limb frame.
    pub fn target_in_limb(&self, point_in_base: DVec3) -> DVec3 {
        self.axes.point_in_limb(point_in_base - self.root_offset)
    }

    /// A point of the limb frame in the base's joint frame.
    pub fn point_in_base(&self, point: DVec3) -> DVec3 {
        let v = self.axes.base_from_limb * point;
        self.root_offset + if self.axes.mirrored { DVec3::new(-v.x, v.y, v.z) } else { v }
    }

    /// A difference of points in base axes, in limb axes.
    pub fn vector_in_limb(&self, vector: DVec3) -> DVec3 {
        self.axes.point_in_limb(vector)
    }

    /// The root's turn in base axes, in limb axes.
    pub fn root_in_limb(&self, base_from_root: DQuat) -> DQuat {
        self.axes.rotation_in_limb(base_from_root)
    }

    /// The root's turn in limb axes, in base axes.
    pub fn root_in_base(&self, root: DQuat) -> DQuat {
        self.axes.rotation_in_base(root)
    }

    /// The root's rotation, read off the pose's frames.
    pub(crate) fn root_in(&self, frames: &Frames) -> DQuat {
        let base_from_world = frames[self.base].rotation.conjugate();
        self.axes.rotation_in_limb(base_from_world * frames[self.limb.parts().root].rotation)
    }

    /// The limb's joints, read off a pose.
    pub(crate) fn state(&self, figure: &Figure, pose: &Pose) -> LimbState {
        let parts = self.limb.parts();
        let root = figure
            .skeleton
            .joint(parts.root)
            .map_or(DQuat::IDENTITY, |j| j.rotation(pose.angles(parts.root)));
        LimbState {
            root: self.axes.rotation_in_limb(root),
            hinge: pose.angles(parts.hinge).flexion.to_radians(),
        }
    }

    /// Writes the limb's joints into a pose: root and hinge, nothing else. An angle that comes out as it
    /// was, give or take the rounding, keeps its bits.
    pub(crate) fn write(&self, figure: &Figure, pose: &mut Pose, state: &LimbState) {
        let parts = self.limb.parts();
        if let Some(Articulation::Ball { ball, .. }) =
            figure.skeleton.joint(parts.root).map(|j| &j.articulation)
        {
            let angles = ball.angles(self.axes.rotation_in_base(state.root));
            for (dof, angle) in Dof::ALL.into_iter().zip(angles) {
                set(pose, parts.root, dof, angle.to_degrees());
            }
        }
        set(pose, parts.hinge, Dof::Flexion, state.hinge.to_degrees());
    }

    /// A point of a bone of the limb, at or beyond the hinge, in the hinge's frame and limb axes.
    pub(crate) fn in_hinge(&self, figure: &Figure, pose: &Pose, bone: Bone, at: DVec3) -> DVec3 {
        let hinge = self.limb.parts().hinge;
        let (mut bone, mut point) = (bone, at);
        while bone != hinge {
            if let Some(joint) = figure.skeleton.joint(bone) {
                point = joint.offset + joint.rotation(pose.angles(bone)) * point;
            }
            bone = bone.carrier();
        }
        self.axes.point_in_limb(beyond_hinge(figure, pose, hinge) * point)
    }

    /// The point about which the limb elevates: its articulator, or the end's joint where the end is
    /// planted and carries the articulator.
    pub(crate) fn about(&self, figure: &Figure, pose: &Pose) -> DVec3 {
        let at = figure.articulator(pose, self.limb);
        let parts = self.limb.parts();
        let planted = matches!(pose.limb(self.limb).contact, Contact::Planted { .. });
        if planted && at.bone != parts.hinge {
            self.in_hinge(figure, pose, parts.end, DVec3::ZERO)
        } else {
            self.in_hinge(figure, pose, at.bone, at.at)
        }
    }

    /// The elevation as reported, degrees: for arms 0 with the elbow lowest, for legs 0 with the knee
    /// foremost; + moves the hinge outward.
    pub(crate) fn reported(&self, elevation: f64) -> f64 {
        let turned = if self.limb.is_arm() { elevation - std::f64::consts::PI } else { -elevation };
        // Adding zero makes a plain zero of a negative one.
        wrapped(turned).to_degrees() + 0.0
    }

    /// The elevation of a reported one, radians.
    pub(crate) fn internal(&self, degrees: f64) -> f64 {
        let angle = degrees.to_radians();
        if self.limb.is_arm() { wrapped(angle + std::f64::consts::PI) } else { wrapped(-angle) }
    }

    /// The feasible interval around the present elevation, as reported.
    pub(crate) fn reported_range(&self, goal: &LimbGoal, feasible: &Elevations) -> Option<[f64; 2]> {
        let full = Some([-180.0, 180.0]);
        let around = feasible.around(goal.elevation)?;
        if around.1 - around.0 >= std::f64::consts::TAU - 1e-12 {
            return full;
        }
        let (below, above) =
            ((around.0 - goal.elevation).to_degrees(), (around.1 - goal.elevation).to_degrees());
        let now = self.reported(goal.elevation);
        Some(if self.limb.is_arm() { [now + below, now + above] } else { [now - above, now - below] })
    }
}

/// The turn of the hinge's bone apart from the hinge itself: the forearm's twist.
pub(crate) fn beyond_hinge(figure: &Figure, pose: &Pose, hinge: Bone) -> DQuat {
    let straight = crate::Angles { flexion: 0.0, ..pose.angles(hinge) };
    figure.skeleton.joint(hinge).map_or(DQuat::IDENTITY, |j| j.rotation(straight))
}

/// Sets an angle in degrees unless it differs from what is there by less than the rounding of a solve.
pub(crate) fn set(pose: &mut Pose, bone: Bone, dof: Dof, degrees: f64) {
    if (pose.angles(bone).get(dof) - degrees).abs() > 1e-12 {
        pose.angles[bone.index()].set(dof, degrees);
    }
}

pub(crate) fn radians(degrees: Interval) -> Interval {
    Interval { min: degrees.min.to_radians(), max: degrees.max.to_radians() }
}

/// The hinge of flexion among a joint's hinges.
fn flexion(joint: &Joint) -> Option<&crate::Hinge> {
    match &joint.articulation {
        Articulation::Hinges(hinges) => hinges.iter().find(|h| h.dof == Dof::Flexion),
        Articulation::Ball { .. } => None,
    }
}

impl Axes {
    /// Of the left side: arm x outward, y forward, z down; leg x outward, y down, z back.
    fn of(limb: Limb) -> Axes {
        let base_from_limb = if limb.is_arm() {
            DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2)
        } else {
            DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0)
        };
        Axes { base_from_limb, mirrored: limb.side() == crate::Side::Right }
    }

    /// A direction or difference of points: base axes to limb axes.
    fn point_in_limb(&self, v: DVec3) -> DVec3 {
        let v = if self.mirrored { DVec3::new(-v.x, v.y, v.z) } else { v };
        self.base_from_limb.conjugate() * v
    }

    /// An axis of rotation: a mirror turns its sense round.
    fn axis_in_limb(&self, v: DVec3) -> DVec3 {
        let v = if self.mirrored { DVec3::new(v.x, -v.y, -v.z) } else { v };
        self.base_from_limb.conjugate() * v
    }

    fn rotation_in_limb(&self, q: DQuat) -> DQuat {
        self.base_from_limb.conjugate() * mirrored_if(self.mirrored, q) * self.base_from_limb
    }

    fn rotation_in_base(&self, q: DQuat) -> DQuat {
        mirrored_if(self.mirrored, self.base_from_limb * q * self.base_from_limb.conjugate())
    }

    fn root_range(&self, root: &Joint) -> Option<RootRange> {
        let Articulation::Ball { ball, ranges, cone } = &root.articulation else { return None };
        let cone = cone.map_or(Cone::FREE, |c| Cone { axis: self.point_in_limb(c.axis), ..c });
        Some(RootRange {
            cone,
            bone: self.point_in_limb(root.bone_direction()?),
            twist_axis: self.axis_in_limb(ball.twist),
            twist: radians(ranges[Dof::Twist as usize]),
        })
    }
}

fn mirrored_if(mirrored: bool, q: DQuat) -> DQuat {
    if mirrored { DQuat::from_xyzw(q.x, -q.y, -q.z, q.w) } else { q }
}
