//! Blend trees from their files, bound to the clips of a figure.

use std::path::Path;
use std::sync::Arc;

use motion::{Clip, FittedClip, Tree};
use rig::Figure;

use super::at;
use crate::disk::read_text;
use crate::failure::Failure;
use crate::library::clips;

/// The tree of a `*.blend.ron` file, or the one that comes with the program, for a figure. A clip that it names is the file
/// `NAME.clip.ron` beside it, or else the one that comes with the program.
///
/// # Errors
/// A file at fault, the tree's or a clip's: which, where and why.
pub fn tree(figure: &Arc<Figure>, path: Option<&Path>) -> Result<Arc<Tree>, Failure> {
    let path = path.unwrap_or(Path::new(clips::TREE));
    let text = text(path)?;
    let plan = motion::parse_plan(&text).map_err(|fault| at(path, &fault))?;
    let mut fitted = Vec::new();
    for name in plan.clip_names() {
        if let Some(clip) = named(path, name)? {
            fitted.push(Arc::new(fit(&clip, figure)?));
        }
    }
    let tree = Tree::new(&plan, &fitted).map_err(|fault| at(path, &fault.in_text(&text)))?;
    Ok(Arc::new(tree))
}

/// A clip made ready for a figure.
///
/// # Errors
/// A figure without legs.
pub fn fit(clip: &Clip, figure: &Arc<Figure>) -> Result<FittedClip, Failure> {
    let made_with = made_with(clip)?;
    FittedClip::new(clip, &made_with, figure).map_err(|e| Failure::Input(e.to_string()))
}

/// The figure that a clip was made with: the shipped one of that name, or else the mannequin.
fn made_with(clip: &Clip) -> Result<Arc<Figure>, Failure> {
    let shipped = |name: &String| {
        let file = format!("{}{name}.figure.ron", interchange::figure::LIBRARY);
        super::figure(Some(Path::new(&file))).ok()
    };
    clip.figure.as_ref().and_then(shipped).map_or_else(|| super::figure(None), Ok)
}

/// The clip that a tree names; `None` if there is none of that name.
fn named(tree: &Path, name: &str) -> Result<Option<Clip>, Failure> {
    let file = format!("{name}.clip.ron");
    let own = tree.with_file_name(&file);
    if !clips::is_shipped(&tree.to_string_lossy()) && own.is_file() {
        return super::clip(&own).map(Some);
    }
    let shipped = format!("{}{file}", crate::library::shipped::PREFIX);
    match clips::text(&shipped) {
        Some(Ok(_)) => super::clip(Path::new(&shipped)).map(Some),
        _ => Ok(None),
    }
}

fn text(path: &Path) -> Result<String, Failure> {
    match clips::text(&path.to_string_lossy()) {
        Some(found) => found.map(str::to_owned).map_err(Failure::Input),
        None => read_text(path),
    }
}
