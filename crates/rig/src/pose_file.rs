//! Pose files: RON, versioned, for people. Angles in degrees, lengths in metres.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use crate::text::{AnglesText, Number, PlaceText, TextFault, Triple, check_version, from_ron, ron_options};
use crate::{
    Bone, Contact, Dof, Figure, GestureError, Limb, LimbState, Part, Pose, PosePatch, Reacher, Size, Space,
};

/// The newest version of pose files.
pub const POSE_VERSION: u32 = 1;

/// A unit quaternion `(x, y, z, w)`.
#[derive(Clone, Copy, Debug)]
struct Rotation(DQuat);

impl Serialize for Rotation {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.0.x, self.0.y, self.0.z, self.0.w).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Rotation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Rotation, D::Error> {
        let (Number(x), Number(y), Number(z), Number(w)) = Deserialize::deserialize(deserializer)?;
        let q = DQuat::from_xyzw(x, y, z, w);
        // What was saved is taken bit for bit; what a person typed is made unit.
        if (q.length() - 1.0).abs() <= 1e-12 {
            return Ok(Rotation(q));
        }
        if (q.length() - 1.0).abs() > 1e-2 {
            return Err(D::Error::custom("a rotation (x, y, z, w) must have length 1"));
        }
        Ok(Rotation(q.normalize()))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Pose")]
struct PoseText {
    version: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    figure: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    size: Option<Size>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    place: Option<PlaceText>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hips: Option<Triple>,
    #[serde(default)]
    joints: BTreeMap<Bone, AnglesText>,
    #[serde(default)]
    limbs: LimbsText,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(transparent)]
struct LimbsText(BTreeMap<LimbName, LimbText>);

/// `leftArm` in pose files and reports; `LeftArm` in commands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
struct LimbName(Limb);

impl From<LimbName> for String {
    fn from(name: LimbName) -> String {
        name.0.name().to_owned()
    }
}

impl TryFrom<String> for LimbName {
    type Error = String;
    fn try_from(name: String) -> Result<LimbName, String> {
        Limb::ALL.into_iter().find(|l| l.name() == name).map(LimbName).ok_or_else(|| {
            format!("unknown limb \"{name}\", expected leftArm, rightArm, leftLeg or rightLeg")
        })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LimbText {
    articulator: ReacherText,
    #[serde(default)]
    contact: ContactText,
}

#[derive(Serialize, Deserialize)]
enum ReacherText {
    Named(String),
    Point(Bone, Triple),
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
enum ContactText {
    #[default]
    Free,
    Point {
        space: Space,
        target: Triple,
    },
    Planted {
        space: Space,
        target: Triple,
        rotation: Rotation,
    },
}

/// Reads a pose file, which may name only some bones.
///
/// # Errors
/// Malformed text, a version that is not known, unknown bones, limbs or fields, numbers that are not
/// finite: what and where.
pub fn parse_pose(text: &str) -> Result<PosePatch, TextFault> {
    check_version(text, POSE_VERSION)?;
    let file: PoseText = from_ron(text)?;
    Ok(PosePatch {
        figure: file.figure,
        size: file.size,
        place: file.place.map(Into::into),
        hips: file.hips.map(DVec3::from),
        joints: file.joints.into_iter().map(|(bone, angles)| (bone, angles.into())).collect(),
        limbs: file.limbs.0.into_iter().map(|(name, limb)| (name.0, limb.into())).collect(),
    })
}

/// Checks that a figure has what a patch names.
///
/// # Errors
/// The first bone, degree of freedom or articulator that the figure lacks; contacts in a circle.
pub fn check_patch(figure: &Figure, patch: &PosePatch) -> Result<(), GestureError> {
    for (bone, angles) in &patch.joints {
        let joint = figure.skeleton.joint(*bone).ok_or(GestureError::NoBone(*bone))?;
        for dof in Dof::ALL {
            if angles.get(dof) != 0.0 && !joint.has(dof) {
                return Err(GestureError::NoDof { bone: *bone, dof, has: joint.dofs().collect() });
            }
        }
    }
    for (limb, state) in &patch.limbs {
        crate::check_reacher(figure, *limb, &state.reacher)?;
        if let Some((Space::Body(bone), _)) = state.contact.target() {
            figure.skeleton.joint(bone).ok_or(GestureError::NoBone(bone))?;
        }
    }
    crate::contact_order(&patch.onto(&figure.rest_pose())).map(|_| ())
}

/// Writes a whole pose: every joint of the figure, one a line. Reading it back gives the same bits.
pub fn write_pose(figure: &Figure, pose: &Pose) -> String {
    write_parts(figure, pose, &[])
}

/// Writes some parts of a pose, all if none is named: arms and legs with what they hold on to, the torso with the
/// hips. Where the figure stands is written with the whole only.
pub fn write_parts(figure: &Figure, pose: &Pose, parts: &[Part]) -> String {
    let wanted = |bone: Bone| parts.is_empty() || parts.contains(&bone.part());
    write(figure, pose, parts.is_empty(), &wanted)
}

/// Writes the joints of some bones: a limb's articulator and contact go along with the whole limb, root, hinge and end;
/// the hips' place with the hips. Where the figure stands is left out.
pub fn write_bones(figure: &Figure, pose: &Pose, bones: &[Bone]) -> String {
    write(figure, pose, false, &|bone| bones.contains(&bone))
}

fn write(figure: &Figure, pose: &Pose, placed: bool, wanted: &dyn Fn(Bone) -> bool) -> String {
    let joints = figure.skeleton.joints().filter(|joint| joint.dofs().next().is_some());
    let joints = joints
        .filter(|joint| wanted(joint.bone))
        .map(|joint| (joint.bone, AnglesText::of(pose.angles(joint.bone), |dof| joint.has(dof))));
    let whole = |limb: &Limb| {
        let parts = limb.parts();
        [parts.root, parts.hinge, parts.end].into_iter().all(wanted)
    };
    let limbs = Limb::ALL.into_iter().filter(whole);
    let file = PoseText {
        version: POSE_VERSION,
        figure: Some(figure.name.clone()),
        size: Some(Size::of(&figure.skeleton)),
        place: placed.then(|| pose.place.into()),
        hips: wanted(Bone::Hips).then(|| pose.hips.into()),
        joints: joints.collect(),
        limbs: LimbsText(limbs.map(|l| (LimbName(l), LimbText::from(pose.limb(l)))).collect()),
    };
    let pretty = ron::ser::PrettyConfig::new().depth_limit(2).separate_tuple_members(false).new_line("\n");
    let mut text = ron_options().to_string_pretty(&file, pretty).unwrap_or_default();
    text.push('\n');
    text
}

impl From<LimbText> for LimbState {
    fn from(text: LimbText) -> LimbState {
        let reacher = match text.articulator {
            ReacherText::Named(name) => Reacher::Named(name),
            ReacherText::Point(bone, at) => Reacher::Point(bone, at.into()),
        };
        let contact = match text.contact {
            ContactText::Free => Contact::Free,
            ContactText::Point { space, target } => Contact::Point { space, target: target.into() },
            ContactText::Planted { space, target, rotation } => {
                Contact::Planted { space, target: target.into(), rotation: rotation.0 }
            }
        };
        LimbState { reacher, contact }
    }
}

impl From<&LimbState> for LimbText {
    fn from(state: &LimbState) -> LimbText {
        let articulator = match &state.reacher {
            Reacher::Named(name) => ReacherText::Named(name.clone()),
            Reacher::Point(bone, at) => ReacherText::Point(*bone, (*at).into()),
        };
        let contact = match state.contact {
            Contact::Free => ContactText::Free,
            Contact::Point { space, target } => ContactText::Point { space, target: target.into() },
            Contact::Planted { space, target, rotation } => {
                ContactText::Planted { space, target: target.into(), rotation: Rotation(rotation) }
            }
        };
        LimbText { articulator, contact }
    }
}
