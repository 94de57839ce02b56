//! The figure file as it is written.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use rig::{Angles, Bone, Limb};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};

/// The version that is written.
pub const VERSION: u32 = 1;

/// What every version has.
#[derive(serde::Deserialize)]
pub struct AnyVersion {
    pub version: u32,
}

/// A figure file of version 1.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FigureFile {
    #[serde(rename = "version")]
    _version: u32,
    pub name: String,
    pub skeleton: String,
    #[serde(default)]
    pub skin: Option<String>,
    #[serde(default)]
    pub roles: Unique<Bone, String>,
    #[serde(default)]
    pub cones: Unique<Bone, ConeFile>,
    #[serde(default)]
    pub swing_bases: Unique<LimbName, (f64, f64, f64)>,
    pub articulators: Unique<LimbName, Unique<String, ArticulatorFile>>,
    #[serde(default)]
    pub handshapes: Unique<String, Unique<Bone, AnglesFile>>,
}

/// A swing's cone: axis in figure axes at rest, half angle in degrees.
#[derive(serde::Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
pub struct ConeFile {
    pub axis: (f64, f64, f64),
    pub half_angle: f64,
}

/// A point that reaches.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArticulatorFile {
    pub bone: Bone,
    pub at: (f64, f64, f64),
}

/// Angles in degrees; what isn't written is 0.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, default)]
#[derive(Default)]
pub struct AnglesFile {
    flexion: f64,
    abduction: f64,
    twist: f64,
}

impl From<&AnglesFile> for Angles {
    fn from(file: &AnglesFile) -> Angles {
        Angles { flexion: file.flexion, abduction: file.abduction, twist: file.twist }
    }
}

/// A limb by its file name.
#[derive(serde::Deserialize, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[serde(try_from = "String")]
pub struct LimbName(pub Limb);

impl TryFrom<String> for LimbName {
    type Error = String;
    fn try_from(name: String) -> Result<LimbName, String> {
        Limb::ALL.into_iter().find(|l| l.name() == name).map(LimbName).ok_or_else(|| {
            let all = Limb::ALL.map(Limb::name).join(", ");
            format!("unknown limb \"{name}\", expected one of {all}")
        })
    }
}

impl fmt::Display for LimbName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name())
    }
}

/// A map that refuses the same key twice, where the standard one would keep the last.
pub struct Unique<K, V>(pub BTreeMap<K, V>);

impl<K, V> Default for Unique<K, V> {
    fn default() -> Self {
        Unique(BTreeMap::new())
    }
}

impl<'de, K, V> Deserialize<'de> for Unique<K, V>
where
    K: Deserialize<'de> + Ord + fmt::Display,
    V: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(UniqueVisitor(PhantomData))
    }
}

struct UniqueVisitor<K, V>(PhantomData<(K, V)>);

impl<'de, K, V> Visitor<'de> for UniqueVisitor<K, V>
where
    K: Deserialize<'de> + Ord + fmt::Display,
    V: Deserialize<'de>,
{
    type Value = Unique<K, V>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Unique<K, V>, A::Error> {
        let mut map = BTreeMap::new();
        while let Some(key) = access.next_key::<K>()? {
            if map.contains_key(&key) {
                return Err(A::Error::custom(format_args!("\"{key}\" is given twice")));
            }
            map.insert(key, access.next_value()?);
        }
        Ok(Unique(map))
    }
}
