//! One pose of the library: what it is called, and where its text is.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::index::Titled;
use super::shipped;
use crate::disk;

/// The tag that every pose of the user's own folder has.
pub const OWN: &str = "own";

/// A pose of the library.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Entry {
    /// What it is called.
    pub title: String,
    /// Words that it is found by.
    pub tags: Vec<String>,
    /// How a command names it: `library:thinker.pose.ron`, or the path of the user's own file.
    pub path: String,
    /// The file, if it is the user's own.
    pub file: Option<PathBuf>,
    /// Which version of the file this is.
    pub stamp: Stamp,
}

/// Tells a file from what it was before: its length and when it was written. The same for ever for a shipped pose.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Stamp {
    /// Bytes.
    pub length: u64,
    /// When it was last written, if the file system knows.
    pub written: Option<SystemTime>,
}

impl Entry {
    /// A pose that comes with the program.
    pub fn shipped(pose: &Titled) -> Entry {
        Entry {
            title: pose.title.clone(),
            tags: pose.tags.clone(),
            path: format!("{}{}", shipped::PREFIX, pose.file),
            file: None,
            stamp: Stamp::default(),
        }
    }

    /// A pose of the user's own folder.
    pub fn own(folder: &Path, pose: &Titled, stamp: Stamp) -> Entry {
        let file = folder.join(&pose.file);
        let mut tags = pose.tags.clone();
        if !tags.iter().any(|tag| tag == OWN) {
            tags.push(OWN.to_owned());
        }
        Entry {
            title: pose.title.clone(),
            tags,
            path: file.to_string_lossy().into_owned(),
            file: Some(file),
            stamp,
        }
    }

    /// The file's name without its folder, for messages.
    pub fn file_name(&self) -> &str {
        self.path.rsplit(['/', '\\', ':']).next().unwrap_or(&self.path)
    }

    /// The text of the pose.
    ///
    /// # Errors
    /// The file can't be read: its name and why.
    pub fn text(&self) -> Result<String, String> {
        match (&self.file, shipped::by_path(&self.path)) {
            (Some(file), _) => disk::read_text(file).map_err(|e| self.shortened(&e.to_string())),
            (None, Some(text)) => text.map(str::to_owned),
            (None, None) => Err(format!("{}: no such pose", self.path)),
        }
    }

    /// A message of the disk with the file's name in place of its long path.
    fn shortened(&self, message: &str) -> String {
        message.replacen(&self.path, self.file_name(), 1)
    }

    /// Whether every word of a search is somewhere in the title or a tag, in whatever case; a last e may have gone, as that of
    /// "wave" in "Waving".
    pub fn matches(&self, search: &str) -> bool {
        if search.trim().is_empty() {
            return true;
        }
        let title = self.title.to_lowercase();
        let tags: Vec<String> = self.tags.iter().map(|tag| tag.to_lowercase()).collect();
        search
            .to_lowercase()
            .split_whitespace()
            .map(|word| word.strip_suffix('e').filter(|stem| stem.len() > 2).unwrap_or(word))
            .all(|word| title.contains(word) || tags.iter().any(|tag| tag.contains(word)))
    }

    /// Whether it has any of the tags; also if none is asked for.
    pub fn has_any(&self, tags: &std::collections::BTreeSet<String>) -> bool {
        tags.is_empty() || self.tags.iter().any(|tag| tags.contains(tag))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_looks_for_every_word_in_title_and_tags() {
        let titled = Titled {
            file: "phone.pose.ron".to_owned(),
            title: "Phone at the ear".to_owned(),
            tags: vec!["everyday".to_owned(), "seated".to_owned()],
        };
        let entry = Entry::shipped(&titled);
        assert!(entry.matches("") && entry.matches("EAR") && entry.matches("pho seat"));
        assert!(!entry.matches("phone lying"));
        assert_eq!(entry.file_name(), "phone.pose.ron");
        assert!(entry.text().is_err(), "no such file is shipped");
    }
}
