//! A figure file and the files that it is based on, as one.

use super::file::{AnyVersion, FigureFile, VERSION};
use super::shipped::LIBRARY;
use super::{Fetch, FigureError, keys};
use crate::Spot;

/// The most files that may be based on each other.
const DEEPEST: usize = 8;

/// One figure file's text.
struct Layer {
    /// As the outermost file names it; empty for that file itself.
    name: String,
    text: String,
}

/// A figure file with what it takes from its base, and where each value stands.
pub(super) struct Layers {
    /// Everything that is written, the outermost file first; names of other files are relative to that file.
    pub file: FigureFile,
    layers: Vec<Layer>,
}

impl Layers {
    /// Reads a figure file and what it is based on.
    ///
    /// # Errors
    /// The first fault in one of the texts, a base that can't be had, bases in a circle or more than eight deep.
    pub fn read(text: &str, fetch: Fetch<'_>) -> Result<Layers, FigureError> {
        let mut layers = vec![Layer { name: String::new(), text: text.to_owned() }];
        let mut file = parse("", text)?;
        let mut next = file.base.take();
        while let Some(name) = next {
            let base = base(&layers, &name, fetch)?;
            let mut below = parse(&base.name, &base.text)?;
            next = below.base.take();
            below.skeleton = below.skeleton.map(|file| beside(&base.name, &file));
            below.skin = below.skin.map(|file| beside(&base.name, &file));
            layers.push(base);
            file = file.on(below);
        }
        Ok(Layers { file, layers })
    }

    /// A fault of the value at that path of keys, in the file that it was taken from.
    pub fn fault(&self, path: &[&str], message: impl Into<String>) -> FigureError {
        let found = self.layers.iter().map(|layer| (layer, keys::find(&layer.text, path)));
        // The first of the deepest: a file's own value hides its base's.
        let best = found.rev().max_by_key(|(_, (_, depth))| *depth);
        let (name, spot) = best.map_or(("", Spot::default()), |(layer, (spot, _))| (&*layer.name, spot));
        FigureError::new(name, spot, message)
    }
}

/// Fetches the base that the innermost layer names.
fn base(layers: &[Layer], name: &str, fetch: Fetch<'_>) -> Result<Layer, FigureError> {
    let Some(above) = layers.last() else {
        return Err(FigureError::new("", Spot::default(), "no figure file"));
    };
    let fault = |message: String| FigureError::new(&above.name, keys::spot(&above.text, &["base"]), message);
    let name = beside(&above.name, name);
    if let Some(first) = layers.iter().position(|layer| layer.name == name) {
        let round: Vec<&str> = layers[first..].iter().map(|layer| &*layer.name).chain([&*name]).collect();
        return Err(fault(format!("figures are based on each other in a circle: {}", round.join(" -> "))));
    }
    if layers.len() >= DEEPEST {
        return Err(fault(format!("more than {DEEPEST} figure files are based on each other")));
    }
    let bytes = fetch(&name).map_err(|why| fault(format!("\"{name}\": {why}")))?;
    let text = String::from_utf8(bytes).map_err(|e| {
        let valid = std::str::from_utf8(&e.as_bytes()[..e.utf8_error().valid_up_to()]).unwrap_or_default();
        FigureError::new(&name, Spot::at(valid, valid.len()), "this is not UTF-8 text")
    })?;
    Ok(Layer { name, text })
}

/// The name of a file that another file names, as the outermost file would: relative to the other's folder.
fn beside(file: &str, name: &str) -> String {
    if name.starts_with(LIBRARY) || is_absolute(name) {
        return name.to_owned();
    }
    if file.starts_with(LIBRARY) {
        return format!("{LIBRARY}{name}");
    }
    let folder = file.rfind(['/', '\\']).map_or("", |i| &file[..=i]);
    format!("{folder}{name}")
}

/// Whether a name starts at a file system's root, of whichever system.
pub(super) fn is_absolute(name: &str) -> bool {
    name.starts_with(['/', '\\']) || name.as_bytes().get(1) == Some(&b':')
}

fn parse(name: &str, text: &str) -> Result<FigureFile, FigureError> {
    let fault =
        |f: rig::TextFault| FigureError::new(name, Spot { line: f.line, column: f.column }, f.message);
    let AnyVersion { version } = rig::from_ron(text).map_err(fault)?;
    if version != VERSION {
        let message = format!("version {version} is not known to this program, expected {VERSION}");
        return Err(FigureError::new(name, keys::spot(text, &["version"]), message));
    }
    rig::from_ron(text).map_err(fault)
}
