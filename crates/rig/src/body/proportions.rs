//! Stature and head count of a figure, and the size of head that gives a head count.

use glam::DVec3;

use super::warp::{Factors, Warp};
use crate::{Bone, Mesh, Skeleton, bone_of_place};

/// Over the height of the joint between neck and head, where a figure has no skin to measure: that of the mannequin.
const STATURE_BY_HEAD_JOINT: f64 = 1.72 / 1.562;
/// Chin to crown over the stature where there is no skin to measure. [DRILLIS-CONTINI-1966]
const HEAD_BY_STATURE: f64 = 0.130;

/// The chin lies before this part of the way from the head's joint to the tip of the nose.
const CHIN_FRONT: f32 = 0.62;
/// How far above its lowest point the chin reaches, of the way to the crown.
const CHIN_REACH: f32 = 0.06;

/// A point of the body and what moves it.
#[derive(Clone, Copy, Debug)]
struct Mark {
    place: DVec3,
    joints: [u8; 4],
    weights: [u16; 4],
}

impl Mark {
    fn of_bone(bone: Bone, place: DVec3) -> Mark {
        Mark { place, joints: [bone.index() as u8, 0, 0, 0], weights: [u16::MAX, 0, 0, 0] }
    }

    fn of_vertex(mesh: &Mesh, v: usize) -> Mark {
        let place = DVec3::from(mesh.positions[v].map(f64::from));
        Mark { place, joints: mesh.joints[v], weights: mesh.weights[v] }
    }

    fn after(&self, warp: &Warp) -> Mark {
        Mark { place: warp.vertex(self.place, self.joints, self.weights), ..*self }
    }
}

/// The points between which a figure is measured.
#[derive(Clone, Debug)]
pub(super) struct Marks {
    sole: Mark,
    crown: Mark,
    /// What may be the chin's lowest point in one body or another.
    chin: Vec<Mark>,
}

impl Marks {
    /// Of a skin, or by the joints where there is none or it has no head. `None` for a figure without a head or
    /// without height.
    pub fn new(skeleton: &Skeleton, skin: Option<&Mesh>) -> Option<Marks> {
        let measured = skin.and_then(|mesh| Marks::of_skin(skeleton, mesh));
        let marks = measured.or_else(|| Marks::of_joints(skeleton))?;
        let (sole, chin, crown) = (marks.sole.place.y, marks.chin(), marks.crown.place.y);
        (crown - chin > 1e-3 && chin - sole > 1e-3).then_some(marks)
    }

    fn of_joints(skeleton: &Skeleton) -> Option<Marks> {
        let joint = skeleton.joint(Bone::Head).map(|_| skeleton.rest_position(Bone::Head))?;
        let stature = joint.y * STATURE_BY_HEAD_JOINT;
        let at = |y: f64| DVec3::new(0.0, y, joint.z);
        let foot = [Bone::LeftFoot, Bone::Hips].into_iter().find(|b| skeleton.joint(*b).is_some())?;
        Some(Marks {
            sole: Mark::of_bone(foot, skeleton.rest_position(foot) * DVec3::new(1.0, 0.0, 1.0)),
            crown: Mark::of_bone(Bone::Head, at(stature)),
            chin: vec![Mark::of_bone(Bone::Head, at(stature * (1.0 - HEAD_BY_STATURE)))],
        })
    }

    /// The lowest and the highest vertex, and the lowest of the head's front.
    fn of_skin(skeleton: &Skeleton, mesh: &Mesh) -> Option<Marks> {
        let share = |v: usize, wanted: &[Bone]| -> u32 {
            let rows = mesh.joints[v].iter().zip(mesh.weights[v]);
            rows.filter(|(j, _)| wanted.contains(&bone_of_place(usize::from(**j))))
                .map(|(_, w)| u32::from(w))
                .sum()
        };
        let all = 0..mesh.vertex_count();
        let height = |v: &usize| mesh.positions[*v][1];
        let lowest = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
        let most = |bones: &[Bone]| -> Vec<usize> {
            all.clone().filter(|v| share(*v, bones) > u32::from(u16::MAX / 2)).collect()
        };
        let head = most(&[Bone::Head, Bone::Jaw, Bone::LeftEye, Bone::RightEye]);
        // Further back the skin under the chin runs down into the throat.
        let joint = skeleton.rest_position(Bone::Head).z as f32;
        let foremost = head.iter().map(|v| mesh.positions[*v][2]).fold(joint, f32::max);
        let front = |v: &usize| mesh.positions[*v][2] > joint + CHIN_FRONT * (foremost - joint);
        let face: Vec<usize> = head.iter().copied().filter(front).collect();
        let chin = face.iter().map(height).reduce(f32::min)?;
        let crown = all.clone().max_by(lowest)?;
        let reach = chin + CHIN_REACH * (height(&crown) - chin);
        let chin = face.into_iter().filter(|v| height(v) < reach);
        Some(Marks {
            sole: Mark::of_vertex(mesh, all.min_by(lowest)?),
            crown: Mark::of_vertex(mesh, crown),
            chin: chin.map(|v| Mark::of_vertex(mesh, v)).collect(),
        })
    }

    /// Sole to crown, metres, of the figure as it is.
    pub fn stature(&self) -> f64 {
        self.crown.place.y - self.sole.place.y
    }

    /// The height of the chin's lowest point as it is.
    fn chin(&self) -> f64 {
        self.chin.iter().map(|mark| mark.place.y).fold(f64::INFINITY, f64::min)
    }

    /// Stature over head height of the figure as it is.
    pub fn heads(&self) -> f64 {
        self.stature() / (self.crown.place.y - self.chin())
    }

    /// How high the lowest point of the figure as it is stands above the ground, metres.
    pub fn sole(&self) -> f64 {
        self.sole.place.y
    }

    /// The same points after a warp.
    pub fn after(&self, warp: &Warp) -> Marks {
        let chin = self.chin.iter().map(|mark| mark.after(warp)).collect();
        Marks { sole: self.sole.after(warp), crown: self.crown.after(warp), chin }
    }

    /// The factor of the head that gives a head count; by bisection, to rounding. It falls as the head grows.
    pub fn head_factor(&self, skeleton: &Skeleton, factors: &Factors, heads: f64) -> f64 {
        let count = |head: f64| self.after(&Warp::new(skeleton, &Factors { head, ..*factors })).heads();
        let (mut small, mut large) = (0.1_f64, 10.0_f64);
        for _ in 0..64 {
            let middle = (small * large).sqrt();
            if count(middle) > heads { small = middle } else { large = middle }
        }
        (small * large).sqrt()
    }
}
