//! The clips that come with the program and the blend tree over them. They are part of it, so an installed program has them, too.

use super::shipped::PREFIX;

/// One entry for each file of a folder; the folders themselves are compared with these lists by a test.
macro_rules! texts {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../../../assets/", $folder, "/", $name)))),*]
    };
}

const CLIPS: &[(&str, &str)] = texts! { "clips":
    "idle.clip.ron"
    "jog.clip.ron"
    "sit-to-stand.clip.ron"
    "strafe-left.clip.ron"
    "strafe-right.clip.ron"
    "turn-left.clip.ron"
    "turn-right.clip.ron"
    "walk-back.clip.ron"
    "walk-turn-left.clip.ron"
    "walk-turn-right.clip.ron"
    "walk.clip.ron"
};

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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;

    fn on_disk(folder: &str, ending: &str) -> BTreeSet<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(folder);
        let names = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.ends_with(ending)).collect()
    }

    #[test]
    fn every_clip_and_tree_of_the_folders_is_part_of_the_program() {
        for (held, folder, ending) in [(CLIPS, "clips", ".clip.ron"), (TREES, "blend", ".blend.ron")] {
            let held: BTreeSet<String> = held.iter().map(|(name, _)| (*name).to_owned()).collect();
            assert_eq!(
                held,
                on_disk(folder, ending),
                "library/clips.rs lists others than assets/{folder} has"
            );
        }
    }

    #[test]
    fn every_shipped_clip_fits_every_figure_and_the_tree_finds_its_clips() {
        for figure in ["mannequin", "child"] {
            let figure =
                crate::load::figure(Some(Path::new(&format!("library:{figure}.figure.ron")))).unwrap();
            for name in names() {
                let clip = crate::load::clip(Path::new(&name)).unwrap();
                assert_eq!(format!("{PREFIX}{}.clip.ron", clip.name), name);
                crate::load::fit(&clip, &figure).unwrap();
            }
            crate::load::tree(&figure, None).unwrap();
        }
    }

    #[test]
    fn a_wrong_name_is_told_with_the_nearest() {
        let wrong = text("library:wolk.clip.ron").unwrap().unwrap_err();
        assert!(wrong.contains("\"library:walk.clip.ron\""), "{wrong}");
        assert!(text("walk.clip.ron").is_none());
    }
}
