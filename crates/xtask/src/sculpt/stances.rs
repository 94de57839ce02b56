//! Poses that try a skin hardest: every joint of the left half at the ends of its ranges, alone and together.

use super::hand::FINGERS;
use glam::{DQuat, DVec3};
use rig::{Angles, Articulation, Bone, Dof, Frame, Frames, Joint, Palette, Side, Skeleton};

/// Every joint's angles, and what to call them.
#[derive(Clone, Debug)]
pub struct Stance {
    /// Joints and angles, for messages.
    pub name: String,
    /// Angles by [`Bone::index`].
    pub angles: [Angles; Bone::COUNT],
}

/// Directions around the rim of a cone.
const RIM: usize = 16;

/// Arms hanging, a little bent: what people start from.
pub fn relaxed() -> [Angles; Bone::COUNT] {
    let mut angles = [Angles::REST; Bone::COUNT];
    for bone in [Bone::LeftUpperArm, Bone::RightUpperArm] {
        angles[bone.index()] = Angles { flexion: 4.0, abduction: -82.0, twist: 0.0 };
    }
    for bone in [Bone::LeftLowerArm, Bone::RightLowerArm] {
        angles[bone.index()] = Angles { flexion: 14.0, abduction: 0.0, twist: -60.0 };
    }
    angles
}

/// All joints but the hips and those of the right side, each at its extremes, the others as in `base`.
pub fn extremes(skeleton: &Skeleton, base: &[Angles; Bone::COUNT], steps: usize) -> Vec<Stance> {
    let mut all = Vec::new();
    for joint in skeleton.joints().filter(|j| j.bone != Bone::Hips && j.bone.side() != Some(Side::Right)) {
        for end in ends(joint) {
            for step in 1..=steps {
                let part = step as f64 / steps as f64;
                let Angles { flexion, abduction, twist } = end;
                let now =
                    Angles { flexion: flexion * part, abduction: abduction * part, twist: twist * part };
                let mut angles = *base;
                angles[joint.bone.index()] = now;
                all.push(Stance { name: told(joint, now), angles });
            }
        }
    }
    all
}

/// What joints do together: arms with their collar, thighs with the spine, all fingers.
pub fn together(skeleton: &Skeleton) -> Vec<Stance> {
    let mut all = Vec::new();
    let mut add = |with: &str, other: Bone, turn: [f64; 3], bone: Bone| {
        let mut base = [Angles::REST; Bone::COUNT];
        base[other.index()] = Angles { flexion: turn[0], abduction: turn[1], twist: turn[2] };
        for end in skeleton.joint(bone).map_or(Vec::new(), ends) {
            let mut angles = base;
            angles[bone.index()] = end;
            let joint = skeleton.joint(bone).map_or(String::new(), |joint| told(joint, end));
            all.push(Stance { name: format!("{joint} with {with}"), angles });
        }
    };
    add("the collar up", Bone::LeftShoulder, [5.0, 30.0, 15.0], Bone::LeftUpperArm);
    add("the collar forward", Bone::LeftShoulder, [20.0, 0.0, 0.0], Bone::LeftUpperArm);
    add("the back bent", Bone::Spine, [20.0, 0.0, 0.0], Bone::LeftUpperLeg);
    for part in [0.5, 0.8, 1.0] {
        let mut angles = [Angles::REST; Bone::COUNT];
        for finger in &FINGERS[1..] {
            for (bone, degrees) in finger.iter().zip([90.0, 105.0, 70.0]) {
                angles[bone.index()].flexion = degrees * part;
            }
        }
        for (bone, flexion, abduction) in
            FINGERS[0].iter().zip([(6.0, 31.0), (52.0, 0.0), (60.0, 0.0)]).map(|(b, (f, a))| (b, f, a))
        {
            angles[bone.index()] =
                Angles { flexion: flexion * part, abduction: abduction * part, twist: 0.0 };
        }
        all.push(Stance { name: format!("fist {part}"), angles });
    }
    all
}

fn told(joint: &Joint, angles: Angles) -> String {
    let each = joint.dofs().map(|dof| format!("{} {:.0}", dof.name(), angles.get(dof)));
    format!("{} {}", joint.bone, each.collect::<Vec<_>>().join(", "))
}

/// The ends of a joint's ranges: each degree of freedom alone, and all together as far as an ellipsoid in the ranges
/// goes (hinges that twist, to the end); for a cone its rim with every twist.
pub fn ends(joint: &Joint) -> Vec<Angles> {
    let dofs: Vec<Dof> = joint.dofs().collect();
    let limits = |dof: Dof| joint.range(dof).map_or([0.0; 2], |r| [r.min, r.max]);
    let mut all = Vec::new();
    if let Articulation::Ball { ball, cone: Some(cone), .. } = &joint.articulation {
        let along = joint.bone_direction().unwrap_or(DVec3::X);
        for i in 0..RIM {
            let (sine, cosine) = (std::f64::consts::TAU * i as f64 / RIM as f64).sin_cos();
            let side = ball.flexion.cross(along) * cosine + ball.abduction.cross(along) * sine;
            let inside = |degrees: &f64| {
                let (s, c) = degrees.to_radians().sin_cos();
                cone.contains(along * c + side * s, 1e-6)
            };
            let degrees = (0..180).map(f64::from).take_while(inside).last().unwrap_or(0.0);
            let [low, high] = limits(Dof::Twist);
            for twist in [0.0, low, high] {
                all.push(Angles { flexion: cosine * degrees, abduction: sine * degrees, twist });
            }
        }
        return all;
    }
    for &dof in &dofs {
        for end in limits(dof).into_iter().filter(|e| *e != 0.0) {
            let mut angles = Angles::REST;
            angles.set(dof, end);
            all.push(angles);
        }
    }
    if dofs.len() > 1 {
        // Bone against bone, a joint doesn't reach all its ends at once; twisting a hinge is another matter.
        let part = if dofs == [Dof::Flexion, Dof::Twist] { 1.0 } else { (dofs.len() as f64).sqrt().recip() };
        for corner in 0..1usize << dofs.len() {
            let mut angles = Angles::REST;
            dofs.iter()
                .enumerate()
                .for_each(|(i, dof)| angles.set(*dof, part * limits(*dof)[corner >> i & 1]));
            all.push(angles);
        }
    }
    all
}

/// The palette of a skeleton with those angles, hips at rest.
pub fn palette(skeleton: &Skeleton, angles: &[Angles; Bone::COUNT]) -> Palette {
    let mut frames = Frames([Frame::IDENTITY; Bone::COUNT]);
    let mut rest = [DVec3::ZERO; Bone::COUNT];
    for joint in skeleton.joints() {
        let base = joint.carrier.map_or(Frame::IDENTITY, |c| frames[c]);
        let turn: DQuat = joint.rotation(angles[joint.bone.index()]);
        frames.0[joint.bone.index()] = base.then(Frame::new(turn, joint.offset));
        rest[joint.bone.index()] = skeleton.rest_position(joint.bone);
    }
    Palette::new(&frames, &rest)
}
