//! A figure file that gives another figure a body: written, and read for its body alone.

use rig::{Body, BodySlider};

use super::layers::Layers;
use super::shipped::{LIBRARY, shipped, shipped_by_path, shipped_figures};
use super::{FigureError, file::VERSION};

/// A figure file of a name that makes a body of the figure in another file; `base` is that file's name as seen from the
/// new one's folder.
pub fn write_based(name: &str, base: &str, body: &Body) -> String {
    let mut text =
        format!("(\n    version: {VERSION},\n    base: {base:?},\n    name: {name:?},\n    body: (\n");
    for slider in BodySlider::ALL {
        if let Some(value) = body.given(slider) {
            text += &format!("        {}: {value:?},\n", slider.name());
        }
    }
    text + "    ),\n)\n"
}

/// The body that a figure file gives, its bases' included; no skeleton or skin is read.
///
/// # Errors
/// Faults of the texts, a slider out of its range.
pub fn read_body(
    figure_ron: &str,
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<Body, FigureError> {
    let layers = Layers::read(figure_ron, &mut |name| match shipped_by_path(name) {
        Some(found) => found.map(<[u8]>::to_vec),
        None => fetch(name),
    })?;
    layers.file.body.body().map_err(|(slider, message)| layers.fault(&["body", slider.name()], message))
}

/// The shipped bodies of the mannequin: the bare name of each figure file and its body, the mannequin itself first.
pub fn shipped_bodies() -> Vec<(&'static str, Body)> {
    let body = |name: &'static str| {
        let text = std::str::from_utf8(shipped(name)?).ok()?;
        let absent = |file: &str| format!("\"{LIBRARY}{file}\" is no shipped file");
        let mut beside = |file: &str| shipped(file).map(<[u8]>::to_vec).ok_or_else(|| absent(file));
        read_body(text, &mut beside).ok().map(|body| (name, body))
    };
    shipped_figures().filter_map(body).collect()
}
