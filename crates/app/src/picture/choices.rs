//! What the dialog for pictures offers, as it is remembered.

use render::{Look, Pass};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::shot::pass_name;

/// The longest edge that can be chosen, pixels.
pub const MOST_EDGE: u32 = 32_768;
/// As many frames a turntable can be given.
pub const MOST_FRAMES: u32 = 1_000;

/// How pictures are saved from the window.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Choices {
    /// Width and height, pixels.
    #[serde(deserialize_with = "size")]
    pub size: [u32; 2],
    /// What each pixel says.
    #[serde(serialize_with = "write_pass", deserialize_with = "read_pass")]
    pub pass: Pass,
    /// Leaves the background clear.
    pub transparent: bool,
    /// Draws the grid on the ground.
    pub grid: bool,
    /// Turns the view once around the figure.
    pub turntable: bool,
    /// In so many frames.
    #[serde(deserialize_with = "frames")]
    pub frames: u32,
    /// So many of them a second.
    #[serde(deserialize_with = "fps")]
    pub fps: u32,
    /// Writes the keypoints beside the picture as OpenPose does.
    pub keypoints: bool,
}

impl Default for Choices {
    fn default() -> Choices {
        Choices {
            size: [1280, 800],
            pass: Pass::Color,
            transparent: false,
            grid: true,
            turntable: false,
            frames: 48,
            fps: 24,
            keypoints: false,
        }
    }
}

impl Choices {
    /// Sizes to choose from; those of paper have 300 pixels an inch.
    pub const SIZES: [(&'static str, [u32; 2]); 7] = [
        ("1280 × 800", [1280, 800]),
        ("Full HD", [1920, 1080]),
        ("4K", [3840, 2160]),
        ("Square", [1080, 1080]),
        ("Portrait", [1080, 1350]),
        ("A4", [2480, 3508]),
        ("A3", [3508, 4961]),
    ];

    /// A look with what was chosen here.
    #[must_use]
    pub fn on(&self, look: Look) -> Look {
        Look { transparent: self.transparent && self.pass == Pass::Color, grid: self.grid, ..look }
    }
}

fn within<'de, D: Deserializer<'de>>(from: D, what: &str, most: u32) -> Result<u32, D::Error> {
    let number = u32::deserialize(from)?;
    if (1..=most).contains(&number) {
        return Ok(number);
    }
    Err(serde::de::Error::custom(format!("{what} is {number}; 1 to {most} is allowed")))
}

fn frames<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    within(from, "frames", MOST_FRAMES)
}

fn fps<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    within(from, "fps", 120)
}

fn size<'de, D: Deserializer<'de>>(from: D) -> Result<[u32; 2], D::Error> {
    let (width, height) = <(u32, u32)>::deserialize(from)?;
    if [width, height].iter().all(|edge| (1..=MOST_EDGE).contains(edge)) {
        return Ok([width, height]);
    }
    let message = format!("size is {width} by {height}; each edge from 1 to {MOST_EDGE} is allowed");
    Err(serde::de::Error::custom(message))
}

#[allow(clippy::trivially_copy_pass_by_ref)] // the signature that serde asks for
fn write_pass<S: Serializer>(pass: &Pass, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(pass_name(*pass))
}

fn read_pass<'de, D: Deserializer<'de>>(from: D) -> Result<Pass, D::Error> {
    let name = String::deserialize(from)?;
    let found = Pass::ALL.into_iter().find(|pass| pass_name(*pass) == name);
    found.ok_or_else(|| {
        let known = Pass::ALL.map(pass_name).join(", ");
        serde::de::Error::custom(format!("no pass \"{name}\", there are {known}"))
    })
}
