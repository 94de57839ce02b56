//! How the figure looks in the window and in its pictures: style, joint planes, ambient occlusion.

use render::{Look, Style};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::picture::style_name;

/// What the user chose of the figure's look; it is remembered.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Finish {
    /// What it is made of and drawn with.
    #[serde(serialize_with = "write_style", deserialize_with = "read_style")]
    pub style: Style,
    /// In joint planes, as on a wooden lay figure.
    pub joint_planes: bool,
    /// Dark creases.
    pub ambient_occlusion: bool,
}

impl Default for Finish {
    fn default() -> Finish {
        Finish { style: Style::Studio, joint_planes: false, ambient_occlusion: true }
    }
}

impl Finish {
    /// A look with this finish, and all else as it was.
    #[must_use]
    pub fn on(self, look: Look) -> Look {
        let Finish { style, joint_planes, ambient_occlusion } = self;
        Look { style, joint_planes, ambient_occlusion, ..look }
    }

    /// The finish of a look.
    pub fn of(look: &Look) -> Finish {
        Finish {
            style: look.style,
            joint_planes: look.joint_planes,
            ambient_occlusion: look.ambient_occlusion,
        }
    }

    /// The next style, the first after the last.
    #[must_use]
    pub fn next(self) -> Finish {
        let place = Style::ALL.iter().position(|style| *style == self.style).unwrap_or(0);
        Finish { style: Style::ALL[(place + 1) % Style::ALL.len()], ..self }
    }
}

/// The words for a style in menus.
pub const fn style_words(style: Style) -> &'static str {
    match style {
        Style::Studio => "Studio",
        Style::Clay => "Clay",
        Style::Matcap => "Matcap",
        Style::Flat => "Flat tones",
        Style::Line => "Line drawing",
    }
}

#[allow(clippy::trivially_copy_pass_by_ref)] // the signature that serde asks for
fn write_style<S: Serializer>(style: &Style, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(style_name(*style))
}

fn read_style<'de, D: Deserializer<'de>>(from: D) -> Result<Style, D::Error> {
    let name = String::deserialize(from)?;
    let found = Style::ALL.into_iter().find(|style| style_name(*style) == name);
    found.ok_or_else(|| {
        let known = Style::ALL.map(style_name).join(", ");
        serde::de::Error::custom(format!("no look \"{name}\", there are {known}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_of_the_last_is_the_first() {
        let mut finish = Finish { joint_planes: true, ..Finish::default() };
        let mut seen = Vec::new();
        for _ in Style::ALL {
            seen.push(finish.style);
            finish = finish.next();
        }
        assert_eq!(seen, Style::ALL);
        assert_eq!(finish, Finish { joint_planes: true, ..Finish::default() });
        assert_eq!(Finish::of(&finish.on(Look::default())), finish);
        assert_eq!(Finish::of(&Look::default()), Finish::default(), "the default is that of pictures");
    }
}
