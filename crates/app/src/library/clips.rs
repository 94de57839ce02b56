//! The clips that come with the program and the blend tree over them. They are part of it, so an installed program has them, too.

use super::shipped::PREFIX;

/// One entry for each file of a folder; the folders themselves are compared with these lists by a test.
macro_rules! texts {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../../../assets/", $folder, "/", $name)))),*]
    };
}

const CLIPS: &[(&str, &str)] = texts! { "clips": "idle.clip.ron" "walk.clip.ron" };

const TREES: &[(&str, &str)] = texts! { "blend": "walk.blend.ron" };

/// How a command names the tree by which figures walk unless another is given.
pub const TREE: &str = "library:walk.blend.ron";

/// Whether a name means a shipped file.
pub fn is_shipped(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// The names of the shipped clips, as commands name them.
pub fn names() -> impl Iterator<Item = String> {
    CLIPS.iter().map(|(name, _)| format!("{PREFIX}{name}"))
}

/// The text of a shipped clip or tree, `library:` and its name; `None` for names that mean no shipped file.
///
/// # Errors
/// There is none of that name: the sentence names the nearest.
pub fn text(name: &str) -> Option<Result<&'static str, String>> {
    let bare = name.strip_prefix(PREFIX)?;
    let all = || CLIPS.iter().chain(TREES);
    let found = all().find(|(file, _)| *file == bare).map(|(_, text)| *text);
    Some(found.ok_or_else(|| {
        let near = rig::nearest(bare, all().map(|(file, _)| *file));
        format!("{name}: no shipped clip or tree has that name (did you mean \"{PREFIX}{near}\"?)")
    }))
}
