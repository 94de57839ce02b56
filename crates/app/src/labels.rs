//! Plain words for bones, angles, limbs and parts, as the panels show them.

use rig::{Bone, Dof, Limb, Part, Side};

/// The title of a shipped figure's file: `Child` of `child.figure.ron`; the mannequin is the adult.
pub fn shipped_figure(file: &str) -> String {
    let name = file.strip_suffix(".figure.ron").unwrap_or(file);
    let name = if name == "mannequin" { "adult" } else { name };
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// What people call the joint of a bone, without its side: `Elbow`, `Index base`.
pub fn joint(bone: Bone) -> &'static str {
    use Bone::*;
    match bone {
        Hips => "Pelvis",
        Spine => "Spine",
        Chest => "Chest",
        UpperChest => "Upper chest",
        Neck => "Neck",
        Head => "Head",
        Jaw => "Jaw",
        LeftEye | RightEye => "Eye",
        LeftShoulder | RightShoulder => "Collar",
        LeftUpperArm | RightUpperArm => "Shoulder",
        LeftLowerArm | RightLowerArm => "Elbow",
        LeftHand | RightHand => "Wrist",
        LeftThumbMetacarpal | RightThumbMetacarpal => "Thumb root",
        LeftThumbProximal | RightThumbProximal => "Thumb base",
        LeftThumbDistal | RightThumbDistal => "Thumb tip",
        LeftIndexProximal | RightIndexProximal => "Index base",
        LeftIndexIntermediate | RightIndexIntermediate => "Index mid",
        LeftIndexDistal | RightIndexDistal => "Index tip",
        LeftMiddleProximal | RightMiddleProximal => "Middle base",
        LeftMiddleIntermediate | RightMiddleIntermediate => "Middle mid",
        LeftMiddleDistal | RightMiddleDistal => "Middle tip",
        LeftRingProximal | RightRingProximal => "Ring base",
        LeftRingIntermediate | RightRingIntermediate => "Ring mid",
        LeftRingDistal | RightRingDistal => "Ring tip",
        LeftLittleProximal | RightLittleProximal => "Little base",
        LeftLittleIntermediate | RightLittleIntermediate => "Little mid",
        LeftLittleDistal | RightLittleDistal => "Little tip",
        LeftUpperLeg | RightUpperLeg => "Hip",
        LeftLowerLeg | RightLowerLeg => "Knee",
        LeftFoot | RightFoot => "Ankle",
        LeftToes | RightToes => "Toes",
    }
}

/// The joint's name for one of its angles: the twist of the elbow's bone is the forearm's.
pub fn joint_of(bone: Bone, dof: Dof) -> &'static str {
    match (bone, dof) {
        (Bone::LeftLowerArm | Bone::RightLowerArm, Dof::Twist) => "Forearm",
        _ => joint(bone),
    }
}

/// The name of an angle.
pub const fn angle(dof: Dof) -> &'static str {
    match dof {
        Dof::Flexion => "flexion",
        Dof::Abduction => "abduction",
        Dof::Twist => "twist",
    }
}

/// `Left` or `Right`.
pub const fn side(side: Side) -> &'static str {
    match side {
        Side::Left => "Left",
        Side::Right => "Right",
    }
}

/// The full name of one slider: `Left elbow · flexion`.
pub fn slider(bone: Bone, dof: Dof) -> String {
    format!("{} · {}", full_of(bone, dof), angle(dof))
}

/// The full name of what one angle turns: `Left forearm`.
pub fn full_of(bone: Bone, dof: Dof) -> String {
    with_side(bone.side(), joint_of(bone, dof))
}

/// The full name of a joint: `Left elbow`.
pub fn full(bone: Bone) -> String {
    with_side(bone.side(), joint(bone))
}

fn with_side(of: Option<Side>, name: &str) -> String {
    match of {
        Some(s) => format!("{} {}", side(s), name.to_lowercase()),
        None => name.to_owned(),
    }
}

/// Bone, angle and what a positive angle means: `leftLowerArm flexion: + bends the elbow`.
pub fn meaning(bone: Bone, dof: Dof) -> String {
    format!("{} {}: + {}", bone.name(), dof.name(), positive(bone, dof))
}

/// What a positive angle does. The right side mirrors the left.
fn positive(bone: Bone, dof: Dof) -> &'static str {
    use Dof::*;
    match (kind(bone), dof) {
        (Kind::Middle, Flexion) => "bends forward",
        (Kind::Middle, Abduction) => "bends to the figure's left",
        (Kind::Middle, Twist) => "turns to the figure's left",
        (Kind::Jaw, Flexion) => "opens the mouth",
        (Kind::Jaw, _) => "shifts the jaw to the figure's left",
        (Kind::Eye, Flexion) => "looks down",
        (Kind::Eye, _) => "looks outward",
        (Kind::Collar, Flexion) => "draws the shoulder forward",
        (Kind::Collar, Abduction) => "lifts the shoulder",
        (Kind::Collar, Twist) => "rolls its top forward",
        (Kind::UpperArm, Flexion) => "swings the arm forward",
        (Kind::UpperArm, Abduction) => "lifts the arm",
        (Kind::UpperArm, Twist) => "turns the arm inward (medial)",
        (Kind::LowerArm, Twist) => "pronates the forearm (palm down)",
        (Kind::LowerArm, _) => "bends the elbow",
        (Kind::Hand, Flexion) => "bends to the palm",
        (Kind::Hand, _) => "bends to the thumb",
        (Kind::Finger, Flexion) => "curls",
        (Kind::Finger, _) => "spreads away from the middle finger",
        (Kind::UpperLeg, Flexion) => "lifts the thigh forward",
        (Kind::UpperLeg, Abduction) => "swings the leg outward",
        (Kind::UpperLeg, Twist) => "turns the leg inward (medial)",
        (Kind::LowerLeg, _) => "bends the knee",
        (Kind::Foot, Flexion) => "lifts the toes",
        (Kind::Foot, Abduction) => "turns the toes out",
        (Kind::Foot, Twist) => "turns the sole out",
        (Kind::Toes, _) => "curls the toes",
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Middle,
    Jaw,
    Eye,
    Collar,
    UpperArm,
    LowerArm,
    Hand,
    Finger,
    UpperLeg,
    LowerLeg,
    Foot,
    Toes,
}

fn kind(bone: Bone) -> Kind {
    use Bone::*;
    match bone {
        Hips | Spine | Chest | UpperChest | Neck | Head => Kind::Middle,
        Jaw => Kind::Jaw,
        LeftEye | RightEye => Kind::Eye,
        LeftShoulder | RightShoulder => Kind::Collar,
        LeftUpperArm | RightUpperArm => Kind::UpperArm,
        LeftLowerArm | RightLowerArm => Kind::LowerArm,
        LeftHand | RightHand => Kind::Hand,
        LeftUpperLeg | RightUpperLeg => Kind::UpperLeg,
        LeftLowerLeg | RightLowerLeg => Kind::LowerLeg,
        LeftFoot | RightFoot => Kind::Foot,
        LeftToes | RightToes => Kind::Toes,
        _ => Kind::Finger,
    }
}

/// The name of a limb: `Left arm`.
pub const fn limb(limb: Limb) -> &'static str {
    match limb {
        Limb::LeftArm => "Left arm",
        Limb::RightArm => "Right arm",
        Limb::LeftLeg => "Left leg",
        Limb::RightLeg => "Right leg",
    }
}

/// The name of a part: `Left hand`.
pub const fn part(part: Part) -> &'static str {
    match part {
        Part::Torso => "Torso",
        Part::Head => "Head",
        Part::LeftArm => "Left arm",
        Part::RightArm => "Right arm",
        Part::LeftHand => "Left hand",
        Part::RightHand => "Right hand",
        Part::LeftLeg => "Left leg",
        Part::RightLeg => "Right leg",
    }
}

/// An articulator's file name in words: `indexTip` becomes `index tip`.
pub fn articulator(name: &str) -> String {
    let mut words = String::new();
    for c in name.chars() {
        if c.is_uppercase() {
            words.push(' ');
        }
        words.extend(c.to_lowercase());
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_slider_has_a_name_of_its_own() {
        let mut names: Vec<String> =
            Bone::ALL.into_iter().flat_map(|b| Dof::ALL.map(|d| slider(b, d))).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 3 * Bone::COUNT);
        assert_eq!(slider(Bone::LeftLowerArm, Dof::Twist), "Left forearm · twist");
    }

    #[test]
    fn camel_case_reads_as_words() {
        assert_eq!(articulator("indexTip"), "index tip");
        assert_eq!(articulator("palm"), "palm");
    }
}
