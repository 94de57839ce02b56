//! Pose files: RON, versioned, for people. Angles in degrees, lengths in metres.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize};

use crate::{
    Angles, Bone, Contact, Dof, Figure, GestureError, Limb, LimbState, Part, Place, Pose, PosePatch, Reacher,
    Size, Space,
};

/// What is wrong with a text, and where.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{line}:{column}: {message}")]
pub struct TextFault {
    /// Line, from 1; 1 for faults of the text as a whole.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What was found and what was expected.
    pub message: String,
}

impl TextFault {
    /// A fault of the text as a whole.
    pub fn whole(message: impl Into<String>) -> TextFault {
        TextFault { line: 1, column: 1, message: message.into() }
    }
}

/// Reads RON, with the place of a fault.
///
/// Nesting is bounded, so that a hostile text can't exhaust the stack.
///
/// # Errors
/// Malformed text, unknown or missing fields, wrong types, values that a type turns down.
pub fn from_ron<T: DeserializeOwned>(text: &str) -> Result<T, TextFault> {
    options().from_str(text).map_err(|e| TextFault {
        line: e.span.start.line.max(1),
        column: e.span.start.col.max(1),
        message: e.code.to_string(),
    })
}

/// What may be left out is written without a `Some` around it; files that have it are read all the same.
fn options() -> ron::Options {
    ron::Options::default()
        .with_recursion_limit(32)
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// Reads the version of a versioned text before the rest, so that a newer file is named as such.
///
/// # Errors
/// No version, or one that this program does not know.
pub fn check_version(text: &str, newest: u32) -> Result<(), TextFault> {
    #[derive(Deserialize)]
    struct Head {
        version: u32,
    }
    // Only a whole text can be read; what is wrong elsewhere is found again with its place by the full reader.
    match from_ron::<Head>(text) {
        Ok(Head { version }) if version == 0 || version > newest => {
            let offset = text.find("version").unwrap_or(0);
            let before = &text[..offset];
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
            let message = format!("version {version} is not known, expected 1 to {newest}");
            Err(TextFault { line, column, message })
        }
        _ => Ok(()),
    }
}

/// The newest version of pose files.
pub const POSE_VERSION: u32 = 1;

/// A number that is neither NaN nor infinite, and of a size that means something.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(transparent)]
struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Number, D::Error> {
        let value = f64::deserialize(deserializer)?;
        if value.is_finite() && value.abs() <= 1e6 {
            Ok(Number(value))
        } else {
            Err(D::Error::custom(format!("{value} found, expected a number between -1000000 and 1000000")))
        }
    }
}

/// A point or vector `(x, y, z)`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Triple(Number, Number, Number);

impl From<DVec3> for Triple {
    fn from(v: DVec3) -> Triple {
        Triple(Number(v.x), Number(v.y), Number(v.z))
    }
}

impl From<Triple> for DVec3 {
    fn from(t: Triple) -> DVec3 {
        DVec3::new(t.0.0, t.1.0, t.2.0)
    }
}

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

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaceText {
    position: Triple,
    #[serde(default = "zero")]
    turn: Number,
}

fn zero() -> Number {
    Number(0.0)
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct AnglesText {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    flexion: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    abduction: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    twist: Option<Number>,
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
    let value = |n: Option<Number>| n.map_or(0.0, |n| n.0);
    Ok(PosePatch {
        figure: file.figure,
        size: file.size,
        place: file.place.map(|p| Place { position: p.position.into(), turn: p.turn.0 }),
        hips: file.hips.map(DVec3::from),
        joints: file
            .joints
            .into_iter()
            .map(|(bone, a)| {
                let angles = Angles {
                    flexion: value(a.flexion),
                    abduction: value(a.abduction),
                    twist: value(a.twist),
                };
                (bone, angles)
            })
            .collect(),
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
    let joints = joints.filter(|joint| wanted(joint.bone)).map(|joint| {
        let angles = pose.angles(joint.bone);
        let value = |dof| joint.has(dof).then(|| Number(angles.get(dof)));
        let text = AnglesText {
            flexion: value(Dof::Flexion),
            abduction: value(Dof::Abduction),
            twist: value(Dof::Twist),
        };
        (joint.bone, text)
    });
    let whole = |limb: &Limb| {
        let parts = limb.parts();
        [parts.root, parts.hinge, parts.end].into_iter().all(wanted)
    };
    let limbs = Limb::ALL.into_iter().filter(whole);
    let place = PlaceText { position: pose.place.position.into(), turn: Number(pose.place.turn) };
    let file = PoseText {
        version: POSE_VERSION,
        figure: Some(figure.name.clone()),
        size: Some(Size::of(&figure.skeleton)),
        place: placed.then_some(place),
        hips: wanted(Bone::Hips).then(|| pose.hips.into()),
        joints: joints.collect(),
        limbs: LimbsText(limbs.map(|l| (LimbName(l), LimbText::from(pose.limb(l)))).collect()),
    };
    let pretty = ron::ser::PrettyConfig::new().depth_limit(2).separate_tuple_members(false).new_line("\n");
    let mut text = options().to_string_pretty(&file, pretty).unwrap_or_default();
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
