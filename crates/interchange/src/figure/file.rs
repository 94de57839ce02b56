//! The figure file as it is written.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use rig::{Angles, Body, BodySlider, Bone, Limb};
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
    #[serde(default)]
    pub base: Option<String>,
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub skeleton: Option<String>,
    #[serde(default)]
    pub skin: Option<String>,
    #[serde(default)]
    pub body: BodyFile,
    #[serde(default)]
    pub roles: Unique<Bone, String>,
    #[serde(default)]
    pub cones: Unique<Bone, ConeFile>,
    #[serde(default)]
    pub swing_bases: Unique<LimbName, (f64, f64, f64)>,
    #[serde(default)]
    pub articulators: Unique<LimbName, Unique<String, ArticulatorFile>>,
    #[serde(default)]
    pub handshapes: Unique<String, Unique<Bone, AnglesFile>>,
}

impl FigureFile {
    /// What is not written here is taken from a base; maps key by key.
    pub fn on(mut self, base: FigureFile) -> FigureFile {
        self.name = self.name.or(base.name);
        self.skeleton = self.skeleton.or(base.skeleton);
        self.skin = self.skin.or(base.skin);
        self.body = self.body.on(&base.body);
        self.roles.fill(base.roles);
        self.cones.fill(base.cones);
        self.swing_bases.fill(base.swing_bases);
        self.handshapes.fill(base.handshapes);
        for (limb, points) in base.articulators.0 {
            self.articulators.0.entry(limb).or_default().fill(points);
        }
        self
    }
}

/// Sliders of the body; what isn't written is as it is in the figure.
#[derive(serde::Deserialize, Clone, Copy, Default)]
#[serde(deny_unknown_fields, default)]
pub struct BodyFile {
    stature: Option<f64>,
    sex: Option<f64>,
    build: Option<f64>,
    muscle: Option<f64>,
    age: Option<f64>,
    heads: Option<f64>,
    arms: Option<f64>,
    legs: Option<f64>,
    shoulders: Option<f64>,
    hips: Option<f64>,
    flexibility: Option<f64>,
}

impl BodyFile {
    fn get(&self, slider: BodySlider) -> Option<f64> {
        match slider {
            BodySlider::Stature => self.stature,
            BodySlider::Sex => self.sex,
            BodySlider::Build => self.build,
            BodySlider::Muscle => self.muscle,
            BodySlider::Age => self.age,
            BodySlider::Heads => self.heads,
            BodySlider::Arms => self.arms,
            BodySlider::Legs => self.legs,
            BodySlider::Shoulders => self.shoulders,
            BodySlider::Hips => self.hips,
            BodySlider::Flexibility => self.flexibility,
        }
    }

    fn on(self, base: &BodyFile) -> BodyFile {
        BodyFile {
            stature: self.stature.or(base.stature),
            sex: self.sex.or(base.sex),
            build: self.build.or(base.build),
            muscle: self.muscle.or(base.muscle),
            age: self.age.or(base.age),
            heads: self.heads.or(base.heads),
            arms: self.arms.or(base.arms),
            legs: self.legs.or(base.legs),
            shoulders: self.shoulders.or(base.shoulders),
            hips: self.hips.or(base.hips),
            flexibility: self.flexibility.or(base.flexibility),
        }
    }

    /// The body.
    ///
    /// # Errors
    /// The first slider out of its range, and that range.
    pub fn body(&self) -> Result<Body, (BodySlider, String)> {
        let mut body = Body::AS_IS;
        for slider in BodySlider::ALL {
            let Some(value) = self.get(slider) else { continue };
            let range = slider.range();
            if !range.contains(value) {
                let (name, unit) =
                    (slider.name(), if slider == BodySlider::Stature { " metres" } else { "" });
                let expected = format!("expected {} to {}{unit}", range.min, range.max);
                return Err((slider, format!("{name} of the body is {value}, {expected}")));
            }
            body = body.with(slider, value);
        }
        Ok(body)
    }
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

impl<K: Ord, V> Unique<K, V> {
    /// Takes the entries of another whose keys are missing here.
    fn fill(&mut self, other: Unique<K, V>) {
        for (key, value) in other.0 {
            self.0.entry(key).or_insert(value);
        }
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
