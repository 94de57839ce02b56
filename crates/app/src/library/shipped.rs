//! The poses that come with the program. They are part of it, so an installed program has them, too.

use std::sync::OnceLock;

use super::index::{Index, Titled};

/// What stands before the name of a shipped pose where a command names a file: `library:thinker.pose.ron`.
pub const PREFIX: &str = "library:";

/// One text for each name; the folder itself is compared with this list by a test.
macro_rules! poses {
    ($($name:literal)*) => {
        &[$((
            concat!($name, ".pose.ron"),
            include_str!(concat!("../../../../assets/poses/", $name, ".pose.ron")),
        )),*]
    };
}

const TEXTS: &[(&str, &str)] = poses! {
    "arms-crossed"
    "bow"
    "boxing-guard"
    "carrying-box"
    "cheering"
    "climbing"
    "contrapposto"
    "cross-legged"
    "drinking"
    "facepalm"
    "hands-on-hips"
    "hugging-knees"
    "idea"
    "jumping"
    "kick"
    "kneeling"
    "leaning"
    "lunge"
    "lying-back"
    "lying-front"
    "lying-side"
    "phone-at-the-ear"
    "pointing"
    "pondering"
    "reaching-up"
    "reading"
    "relaxed"
    "running"
    "shrug"
    "sign-clothes"
    "sign-food"
    "sign-i-love-you"
    "sign-thank-you"
    "sitting"
    "standing"
    "surprise"
    "thinker"
    "throwing"
    "walking"
    "waving"
};

const INDEX: &str = include_str!("../../../../assets/poses/index.ron");

/// The text of a shipped pose by its file name.
pub fn text(file: &str) -> Option<&'static str> {
    TEXTS.iter().find(|(name, _)| *name == file).map(|(_, text)| *text)
}

/// The text of a path that names a shipped pose; `None` for every other path.
///
/// # Errors
/// The prefix with a name that isn't there: the sentence names the nearest.
pub fn by_path(path: &str) -> Option<Result<&'static str, String>> {
    let file = path.strip_prefix(PREFIX)?;
    Some(text(file).ok_or_else(|| {
        let near = rig::nearest(file, TEXTS.iter().map(|(name, _)| *name));
        format!("{path}: no shipped pose has that name (did you mean \"{PREFIX}{near}\"?)")
    }))
}

/// Titles and tags of the shipped poses, in the order in which they are shown.
pub fn titled() -> &'static [Titled] {
    static INDEX_OF_ALL: OnceLock<Vec<Titled>> = OnceLock::new();
    INDEX_OF_ALL.get_or_init(|| {
        // A test holds the embedded index; without it the poses would still be there by their file names.
        let index = Index::parse(INDEX).unwrap_or_default();
        let mut all: Vec<Titled> = index.poses.into_iter().filter(|p| text(&p.file).is_some()).collect();
        for (file, _) in TEXTS {
            if all.iter().all(|p| p.file != *file) {
                all.push(Titled::from_file(file));
            }
        }
        all
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;

    /// The names in the folder that ends with a pose file's ending.
    fn on_disk() -> BTreeSet<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/poses");
        let names = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.ends_with(".pose.ron")).collect()
    }

    #[test]
    fn every_pose_of_the_folder_is_part_of_the_program() {
        let embedded: BTreeSet<String> = TEXTS.iter().map(|(name, _)| (*name).to_owned()).collect();
        assert_eq!(embedded, on_disk(), "library/shipped.rs lists other poses than assets/poses has");
    }

    #[test]
    fn every_shipped_pose_has_a_title_and_a_tag() {
        let index = Index::parse(INDEX).unwrap();
        let named: Vec<String> = index.poses.iter().map(|p| p.file.clone()).collect();
        let all: BTreeSet<String> = named.iter().cloned().collect();
        assert_eq!(all.len(), named.len(), "a pose stands twice in the index");
        assert_eq!(all, on_disk(), "the index names other poses than the folder has");
        for pose in titled() {
            assert!(!pose.title.is_empty() && !pose.tags.is_empty(), "{pose:?}");
        }
        let titles: BTreeSet<&str> = titled().iter().map(|p| p.title.as_str()).collect();
        assert_eq!(titles.len(), named.len(), "two poses have one title");
    }

    #[test]
    fn every_shipped_pose_is_one_of_the_mannequin() {
        let figure = crate::load::figure(None).unwrap();
        for (name, text) in TEXTS {
            let patch = rig::parse_pose(text).unwrap_or_else(|fault| panic!("{name}:{fault}"));
            rig::check_patch(&figure, &patch).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        }
    }

    #[test]
    fn a_shipped_pose_is_found_by_its_path_and_a_wrong_name_is_told() {
        assert!(by_path("library:thinker.pose.ron").unwrap().unwrap().contains("version: 1"));
        let wrong = by_path("library:thinkr.pose.ron").unwrap().unwrap_err();
        assert!(wrong.contains("\"library:thinker.pose.ron\""), "{wrong}");
        assert!(by_path("thinker.pose.ron").is_none());
    }
}
