//! The texts of files for people: RON with the place of a fault, and the values that several kinds of files share.

use glam::DVec3;
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize};

use crate::{Angles, Dof, Place};

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

    /// A fault at the first occurrence of a piece of the text; of the whole if it doesn't occur.
    pub fn at(text: &str, piece: &str, message: impl Into<String>) -> TextFault {
        let before = text.find(piece).and_then(|offset| text.get(..offset)).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        TextFault { line, column, message: message.into() }
    }
}

/// Reads RON, with the place of a fault.
///
/// Nesting is bounded, so that a hostile text can't exhaust the stack.
///
/// # Errors
/// Malformed text, unknown or missing fields, wrong types, values that a type turns down.
pub fn from_ron<T: DeserializeOwned>(text: &str) -> Result<T, TextFault> {
    ron_options().from_str(text).map_err(|e| TextFault {
        line: e.span.start.line.max(1),
        column: e.span.start.col.max(1),
        message: e.code.to_string(),
    })
}

/// What may be left out is written without a `Some` around it; files that have it are read all the same.
pub fn ron_options() -> ron::Options {
    ron::Options::default()
        .with_recursion_limit(32)
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// Reads the version of a versioned text before the rest, so that a newer file is named as such.
///
/// # Errors
/// A version that this program does not know.
pub fn check_version(text: &str, newest: u32) -> Result<(), TextFault> {
    #[derive(Deserialize)]
    struct Head {
        version: u32,
    }
    // Only a whole text can be read; what is wrong elsewhere is found again with its place by the full reader.
    match from_ron::<Head>(text) {
        Ok(Head { version }) if version == 0 || version > newest => {
            let message = format!("version {version} is not known, expected 1 to {newest}");
            Err(TextFault::at(text, "version", message))
        }
        _ => Ok(()),
    }
}

/// A number that is neither NaN nor infinite, and of a size that means something.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(transparent)]
pub struct Number(pub f64);

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
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Triple(pub Number, pub Number, pub Number);

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

/// A place `(position: (x, y, z), turn: degrees)`; the turn may be left out.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Place")]
pub struct PlaceText {
    /// Metres.
    pub position: Triple,
    /// Degrees about +Y.
    #[serde(default = "zero")]
    pub turn: Number,
}

fn zero() -> Number {
    Number(0.0)
}

impl From<Place> for PlaceText {
    fn from(place: Place) -> PlaceText {
        PlaceText { position: place.position.into(), turn: Number(place.turn) }
    }
}

impl From<PlaceText> for Place {
    fn from(text: PlaceText) -> Place {
        Place { position: text.position.into(), turn: text.turn.0 }
    }
}

/// Joint angles `(flexion: degrees, abduction: degrees, twist: degrees)`; those that are left out are 0.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Angles")]
#[allow(missing_docs)]
pub struct AnglesText {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flexion: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub abduction: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twist: Option<Number>,
}

impl AnglesText {
    /// Those of a joint's angles that are wanted.
    pub fn of(angles: Angles, wanted: impl Fn(Dof) -> bool) -> AnglesText {
        let value = |dof| wanted(dof).then(|| Number(angles.get(dof)));
        AnglesText {
            flexion: value(Dof::Flexion),
            abduction: value(Dof::Abduction),
            twist: value(Dof::Twist),
        }
    }
}

impl From<AnglesText> for Angles {
    fn from(text: AnglesText) -> Angles {
        let value = |n: Option<Number>| n.map_or(0.0, |n| n.0);
        Angles { flexion: value(text.flexion), abduction: value(text.abduction), twist: value(text.twist) }
    }
}
