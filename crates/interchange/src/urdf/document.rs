//! The text of a URDF file, its outline and what `urdf-rs` makes of it.

use urdf_rs::Robot;

use super::outline::{Element, outline};
use super::tree::MAX_LINKS;
use super::{MAX_BYTES, UrdfError, UrdfFault, check};
use crate::Spot;

/// Where a file begins, for what is wrong with it as a whole.
const START: Spot = Spot { line: 1, column: 1 };

/// A file that reads well; what it says may still make no sense.
pub(super) struct Document<'a> {
    text: &'a str,
    outline: Vec<Element<'a>>,
    /// The file as `urdf-rs` reads it.
    pub robot: Robot,
}

impl<'a> Document<'a> {
    /// Reads a text.
    ///
    /// # Errors
    /// Text that is too long or no XML, parts that are missing, names twice, numbers that are none.
    pub fn read(text: &'a str) -> Result<Document<'a>, UrdfError> {
        if text.len() > MAX_BYTES {
            return Err(UrdfFault::TooLarge(text.len()).at(START));
        }
        let outline = outline(text)
            .map_err(|broken| UrdfFault::Syntax(broken.message).at(Spot::at(text, broken.at)))?;
        check::check(text, &outline)?;
        let links = outline.iter().filter(|e| e.parent == Some(0) && e.name == "link").count();
        if links > MAX_LINKS {
            return Err(UrdfFault::TooMany(links).at(START));
        }
        let robot = urdf_rs::read_from_string(text).map_err(|error| {
            let unread = unread(&error.to_string());
            // It may be text between elements that it stumbles over, and it says not where.
            match check::stray(&outline).filter(|_| unread.spot == START) {
                Some((at, fault)) => fault.at(Spot::at(text, at)),
                None => unread,
            }
        })?;
        Ok(Document { text, outline, robot })
    }

    /// The fault with the place of what it is about.
    pub fn locate(&self, fault: UrdfFault) -> UrdfError {
        let spot = fault.subject().and_then(|(tag, name)| {
            let named = |e: &Element<'_>| e.name == tag && e.attribute("name") == Some(name);
            let element = self.outline.iter().position(|e| e.parent == Some(0) && named(e))?;
            let part = fault.part().and_then(|part| {
                let inside = self.outline.iter().filter(|e| e.parent == Some(element));
                inside.into_iter().find(|e| e.name == part)
            });
            Some(Spot::at(self.text, part.unwrap_or(&self.outline[element]).at))
        });
        fault.at(spot.unwrap_or(START))
    }
}

/// What `urdf-rs` finds and the outline doesn't, such as an unknown entity. Its XML reader writes the place into
/// the message.
fn unread(message: &str) -> UrdfError {
    let located = || {
        let (line, rest) = message.strip_prefix("Parse error; Line: ")?.split_once(", Column: ")?;
        let (column, reason) = rest.split_once(", Reason: ")?;
        let spot = Spot { line: line.parse().ok()?, column: column.parse().ok()? };
        Some(UrdfFault::Syntax(reason.to_owned()).at(spot))
    };
    located().unwrap_or_else(|| UrdfFault::Syntax(message.to_owned()).at(START))
}
