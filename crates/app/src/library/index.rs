//! `index.ron`: titles and tags of the poses in a folder.

use serde::Deserialize;

/// What a pose file's name ends with.
pub const SUFFIX: &str = ".pose.ron";

/// The newest version of the index.
const VERSION: u32 = 1;

/// The index of a folder. Poses that it doesn't name are called by their files.
#[derive(Clone, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Index {
    /// The version of the format.
    pub version: u32,
    /// The poses, in the order in which they are shown.
    pub poses: Vec<Titled>,
}

/// One pose by its file, with what people call it.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Titled {
    /// The file's name, without a folder.
    pub file: String,
    /// What it is called.
    pub title: String,
    /// Words that it is found by, such as `seated`.
    #[serde(default)]
    pub tags: Vec<String>,
}

impl Index {
    /// Reads an index.
    ///
    /// # Errors
    /// Malformed text, unknown fields, a newer version: what and where.
    pub fn parse(text: &str) -> Result<Index, rig::TextFault> {
        rig::check_version(text, VERSION)?;
        rig::from_ron(text)
    }
}

impl Titled {
    /// A pose that no index names: its title is the file's name without the ending.
    pub fn from_file(file: &str) -> Titled {
        let title = file.strip_suffix(SUFFIX).unwrap_or(file).to_owned();
        Titled { file: file.to_owned(), title, tags: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_read_and_a_fault_has_its_place() {
        let text = "(version: 1, poses: [(file: \"a.pose.ron\", title: \"A\", tags: [\"seated\"])])";
        assert_eq!(Index::parse(text).unwrap().poses[0].tags, ["seated"]);
        let fault = Index::parse("(version: 1,\n poses: [(fle: \"a\")])").unwrap_err();
        assert_eq!(fault.line, 2, "{fault}");
        assert!(Index::parse("(version: 2, poses: [])").is_err());
    }

    #[test]
    fn a_file_without_a_title_is_called_by_its_name() {
        assert_eq!(Titled::from_file("my pose.pose.ron").title, "my pose");
    }
}
