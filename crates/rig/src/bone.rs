//! The 55 humanoid bones of VRM 1.0, their order, their sides and the parts of the body.

use serde::{Deserialize, Serialize};

macro_rules! bones {
    ($($variant:ident $name:literal $parent:ident,)*) => {
        /// A bone of the VRM 1.0 humanoid; its file name is the VRM name (`leftUpperArm`).
        ///
        /// The order is topological: a bone comes after all bones that can carry it.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
        #[serde(into = "String", try_from = "String")]
        #[repr(u8)]
        #[allow(missing_docs)]
        pub enum Bone { $($variant,)* }

        impl Bone {
            /// Every bone, carriers first.
            pub const ALL: [Bone; Bone::COUNT] = [$(Bone::$variant,)*];
            /// The number of bones.
            pub const COUNT: usize = [$($name,)*].len();

            /// The VRM name.
            pub const fn name(self) -> &'static str {
                match self { $(Bone::$variant => $name,)* }
            }

            /// The bone that carries this one where all 55 exist; the hips carry themselves.
            pub const fn carrier(self) -> Bone {
                match self { $(Bone::$variant => Bone::$parent,)* }
            }

            /// The bone of that VRM name.
            pub fn from_name(name: &str) -> Option<Bone> {
                match name { $($name => Some(Bone::$variant),)* _ => None }
            }
        }
    };
}

bones! {
    Hips "hips" Hips,
    Spine "spine" Hips,
    Chest "chest" Spine,
    UpperChest "upperChest" Chest,
    Neck "neck" UpperChest,
    Head "head" Neck,
    Jaw "jaw" Head,
    LeftEye "leftEye" Head,
    RightEye "rightEye" Head,
    LeftShoulder "leftShoulder" UpperChest,
    LeftUpperArm "leftUpperArm" LeftShoulder,
    LeftLowerArm "leftLowerArm" LeftUpperArm,
    LeftHand "leftHand" LeftLowerArm,
    LeftThumbMetacarpal "leftThumbMetacarpal" LeftHand,
    LeftThumbProximal "leftThumbProximal" LeftThumbMetacarpal,
    LeftThumbDistal "leftThumbDistal" LeftThumbProximal,
    LeftIndexProximal "leftIndexProximal" LeftHand,
    LeftIndexIntermediate "leftIndexIntermediate" LeftIndexProximal,
    LeftIndexDistal "leftIndexDistal" LeftIndexIntermediate,
    LeftMiddleProximal "leftMiddleProximal" LeftHand,
    LeftMiddleIntermediate "leftMiddleIntermediate" LeftMiddleProximal,
    LeftMiddleDistal "leftMiddleDistal" LeftMiddleIntermediate,
    LeftRingProximal "leftRingProximal" LeftHand,
    LeftRingIntermediate "leftRingIntermediate" LeftRingProximal,
    LeftRingDistal "leftRingDistal" LeftRingIntermediate,
    LeftLittleProximal "leftLittleProximal" LeftHand,
    LeftLittleIntermediate "leftLittleIntermediate" LeftLittleProximal,
    LeftLittleDistal "leftLittleDistal" LeftLittleIntermediate,
    RightShoulder "rightShoulder" UpperChest,
    RightUpperArm "rightUpperArm" RightShoulder,
    RightLowerArm "rightLowerArm" RightUpperArm,
    RightHand "rightHand" RightLowerArm,
    RightThumbMetacarpal "rightThumbMetacarpal" RightHand,
    RightThumbProximal "rightThumbProximal" RightThumbMetacarpal,
    RightThumbDistal "rightThumbDistal" RightThumbProximal,
    RightIndexProximal "rightIndexProximal" RightHand,
    RightIndexIntermediate "rightIndexIntermediate" RightIndexProximal,
    RightIndexDistal "rightIndexDistal" RightIndexIntermediate,
    RightMiddleProximal "rightMiddleProximal" RightHand,
    RightMiddleIntermediate "rightMiddleIntermediate" RightMiddleProximal,
    RightMiddleDistal "rightMiddleDistal" RightMiddleIntermediate,
    RightRingProximal "rightRingProximal" RightHand,
    RightRingIntermediate "rightRingIntermediate" RightRingProximal,
    RightRingDistal "rightRingDistal" RightRingIntermediate,
    RightLittleProximal "rightLittleProximal" RightHand,
    RightLittleIntermediate "rightLittleIntermediate" RightLittleProximal,
    RightLittleDistal "rightLittleDistal" RightLittleIntermediate,
    LeftUpperLeg "leftUpperLeg" Hips,
    LeftLowerLeg "leftLowerLeg" LeftUpperLeg,
    LeftFoot "leftFoot" LeftLowerLeg,
    LeftToes "leftToes" LeftFoot,
    RightUpperLeg "rightUpperLeg" Hips,
    RightLowerLeg "rightLowerLeg" RightUpperLeg,
    RightFoot "rightFoot" RightLowerLeg,
    RightToes "rightToes" RightFoot,
}

impl Bone {
    /// Place in [`Bone::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The bone's side, if it has a twin.
    pub fn side(self) -> Option<Side> {
        if self.name().starts_with("left") {
            Some(Side::Left)
        } else if self.name().starts_with("right") {
            Some(Side::Right)
        } else {
            None
        }
    }

    /// The twin on the other side; a middle bone is its own.
    pub fn mirrored(self) -> Bone {
        let name = self.name();
        let twin = if let Some(rest) = name.strip_prefix("left") {
            Bone::from_name(&format!("right{rest}"))
        } else if let Some(rest) = name.strip_prefix("right") {
            Bone::from_name(&format!("left{rest}"))
        } else {
            None
        };
        twin.unwrap_or(self)
    }

    /// The part of the body that the bone's joint belongs to.
    pub fn part(self) -> Part {
        let i = self.index();
        match self {
            Bone::Hips | Bone::Spine | Bone::Chest | Bone::UpperChest => Part::Torso,
            Bone::Neck | Bone::Head | Bone::Jaw | Bone::LeftEye | Bone::RightEye => Part::Head,
            _ if i <= Bone::LeftHand.index() => Part::LeftArm,
            _ if i <= Bone::LeftLittleDistal.index() => Part::LeftHand,
            _ if i <= Bone::RightHand.index() => Part::RightArm,
            _ if i <= Bone::RightLittleDistal.index() => Part::RightHand,
            _ if i <= Bone::LeftToes.index() => Part::LeftLeg,
            _ => Part::RightLeg,
        }
    }
}

impl std::fmt::Display for Bone {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl From<Bone> for String {
    fn from(bone: Bone) -> String {
        bone.name().to_owned()
    }
}

impl TryFrom<String> for Bone {
    type Error = String;
    fn try_from(name: String) -> Result<Bone, String> {
        Bone::from_name(&name).ok_or_else(|| {
            let near = nearest(&name, Bone::ALL.iter().map(|b| b.name()));
            format!("unknown bone \"{name}\", expected a VRM humanoid bone such as \"{near}\"")
        })
    }
}

/// The candidate with the fewest edits from `word`; empty if there are none.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> &'a str {
    let clipped: String = word.chars().take(64).collect();
    candidates.min_by_key(|c| edits(&clipped.to_lowercase(), &c.to_lowercase())).unwrap_or("")
}

/// Levenshtein distance.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substitute = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substitute.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// Left or right of the body, as the figure itself would say.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Side {
    Left,
    Right,
}

impl Side {
    /// The other side.
    pub fn mirrored(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}

/// A part of the body, as commands name it. The collar belongs to its arm, the hips to the torso.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[allow(missing_docs)]
pub enum Part {
    Torso,
    Head,
    LeftArm,
    RightArm,
    LeftHand,
    RightHand,
    LeftLeg,
    RightLeg,
}

impl Part {
    /// Every part.
    pub const ALL: [Part; 8] = [
        Part::Torso,
        Part::Head,
        Part::LeftArm,
        Part::RightArm,
        Part::LeftHand,
        Part::RightHand,
        Part::LeftLeg,
        Part::RightLeg,
    ];

    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Part::Torso => "torso",
            Part::Head => "head",
            Part::LeftArm => "leftArm",
            Part::RightArm => "rightArm",
            Part::LeftHand => "leftHand",
            Part::RightHand => "rightHand",
            Part::LeftLeg => "leftLeg",
            Part::RightLeg => "rightLeg",
        }
    }

    /// The part on the other side.
    pub const fn mirrored(self) -> Part {
        match self {
            Part::Torso => Part::Torso,
            Part::Head => Part::Head,
            Part::LeftArm => Part::RightArm,
            Part::RightArm => Part::LeftArm,
            Part::LeftHand => Part::RightHand,
            Part::RightHand => Part::LeftHand,
            Part::LeftLeg => Part::RightLeg,
            Part::RightLeg => Part::LeftLeg,
        }
    }
}

impl From<Part> for String {
    fn from(part: Part) -> String {
        part.name().to_owned()
    }
}

impl TryFrom<String> for Part {
    type Error = String;
    fn try_from(name: String) -> Result<Part, String> {
        Part::ALL.into_iter().find(|p| p.name() == name).ok_or_else(|| {
            let all = Part::ALL.map(Part::name).join(", ");
            format!("unknown part \"{name}\", expected one of {all}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn carriers_come_first_and_twins_agree() {
        assert_eq!(Bone::COUNT, 55);
        for bone in Bone::ALL {
            assert_eq!(Bone::from_name(bone.name()), Some(bone));
            assert!(bone == Bone::Hips || bone.carrier() < bone, "{bone}");
            assert_eq!(bone.mirrored().mirrored(), bone);
            assert_eq!(bone.mirrored().part(), bone.part().mirrored(), "{bone}");
            assert_eq!(bone.mirrored().carrier(), bone.carrier().mirrored(), "{bone}");
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_nearest() {
        let error = Bone::try_from("leftUperArm".to_owned()).unwrap_err();
        assert!(error.contains("\"leftUpperArm\""), "{error}");
    }
}
