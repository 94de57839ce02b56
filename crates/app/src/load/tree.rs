//! Blend trees from their files, bound to the clips of a figure.

use std::path::Path;
use std::sync::Arc;

use motion::{Clip, Tree};
use rig::Figure;

use super::at;
use super::clip::motion_text;
use super::fit::Makers;
use crate::failure::Failure;
use crate::library::clips;

/// The tree of a `*.blend.ron` file, or the one that comes with the program, for a figure. A clip that it names is the file
/// `NAME.clip.ron` beside it, or else the one that comes with the program.
///
/// # Errors
/// A file at fault, the tree's or a clip's: which, where and why.
pub fn tree(figure: &Arc<Figure>, path: Option<&Path>) -> Result<Arc<Tree>, Failure> {
    let path = path.unwrap_or(Path::new(clips::TREE));
    let text = motion_text(path)?;
    let plan = motion::parse_plan(&text).map_err(|fault| at(path, &fault))?;
    let (mut makers, mut fitted) = (Makers::default(), Vec::new());
    for name in plan.clip_names() {
        if let Some(clip) = named(path, name)? {
            fitted.push(Arc::new(makers.fit(&clip, figure)?));
        }
    }
    let tree = Tree::new(&plan, &fitted).map_err(|fault| at(path, &fault.in_text(&text)))?;
    Ok(Arc::new(tree))
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
