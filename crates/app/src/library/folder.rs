//! The user's own poses: a folder of pose files, changed by adding, renaming and putting aside. Nothing is overwritten.

use std::fs;
use std::path::{Path, PathBuf};

use super::entry::{Entry, Stamp};
use super::index::{Index, SUFFIX, Titled};
use crate::disk;

/// Where removed poses go, inside the folder.
const TRASH: &str = "trash";
/// The longest name, characters: file systems take 255 bytes with the ending.
const LONGEST: usize = 60;

/// The user's own folder: `poses` in the user's data folder for Posewright. It is made when the first pose is added.
pub fn of_user() -> Option<PathBuf> {
    directories::ProjectDirs::from("", "", "posewright").map(|dirs| dirs.data_local_dir().join("poses"))
}

/// The poses in a folder by title, with what its `index.ron` says of them if it has one; none if there is no folder.
pub fn scan(folder: &Path) -> Vec<Entry> {
    let index = disk::read_text(&folder.join("index.ron")).ok();
    let index = index.and_then(|text| Index::parse(&text).ok()).unwrap_or_default();
    let titled = |file: &str| {
        index.poses.iter().find(|p| p.file == file).cloned().unwrap_or_else(|| Titled::from_file(file))
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<Entry> = entries
        .filter_map(|entry| Some((entry.file_name().into_string().ok()?, entry.metadata().ok()?)))
        .filter(|(name, data)| !data.is_dir() && name.ends_with(SUFFIX) && !name.starts_with('.'))
        .map(|(name, data)| {
            let stamp = Stamp { length: data.len(), written: data.modified().ok() };
            Entry::own(folder, &titled(&name), stamp)
        })
        .collect();
    found.sort_by_cached_key(|entry| (entry.title.to_lowercase(), entry.path.clone()));
    found
}

/// A name as typed, made ready to be a file's.
///
/// # Errors
/// Nothing typed, too much, a sign that some system doesn't allow in a file's name, or a title that another pose has.
pub fn checked<'a>(name: &str, mut taken: impl Iterator<Item = &'a str>) -> Result<String, String> {
    let name = name.trim();
    let name = name.strip_suffix(SUFFIX).unwrap_or(name).trim_end();
    if name.is_empty() {
        return Err("A pose needs a name".to_owned());
    }
    if name.chars().count() > LONGEST {
        return Err(format!("A name has at most {LONGEST} letters"));
    }
    if let Some(c) = name.chars().find(|c| c.is_control() || r#"/\:*?"<>|"#.contains(*c)) {
        return Err(format!("A name can't have {c:?} in it"));
    }
    if name.starts_with('.') || name.ends_with('.') {
        return Err("A name neither begins nor ends with a dot".to_owned());
    }
    let low = name.to_lowercase();
    if is_device(&low) {
        return Err(format!("\"{name}\" is a device on some systems"));
    }
    match taken.find(|other| other.to_lowercase() == low) {
        Some(other) => Err(format!("There is a pose called \"{other}\"")),
        None => Ok(name.to_owned()),
    }
}

/// Whether a file of that name in lower case is a device on some systems, whatever its ending.
fn is_device(low: &str) -> bool {
    let stem = low.split('.').next().unwrap_or(low).trim_end();
    let port = stem.strip_prefix("com").or(stem.strip_prefix("lpt"));
    ["con", "prn", "aux", "nul"].contains(&stem)
        || port.is_some_and(|number| number.len() == 1 && number.chars().all(|c| c.is_ascii_digit()))
}

/// Adds a pose under a checked name; returns its path.
///
/// # Errors
/// The folder can't be made or written; a file of that name.
pub fn add(folder: &Path, name: &str, text: &str) -> Result<PathBuf, String> {
    fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let file = folder.join(format!("{name}{SUFFIX}"));
    disk::write_new(&file, text.as_bytes()).map_err(|e| e.to_string())?;
    Ok(file)
}

/// Gives a pose another checked name; returns its path.
///
/// # Errors
/// The file can't be moved; a file of that name.
pub fn rename(file: &Path, name: &str) -> Result<PathBuf, String> {
    let to = file.with_file_name(format!("{name}{SUFFIX}"));
    disk::move_new(file, &to).map_err(|e| e.to_string())?;
    Ok(to)
}

/// Puts a pose into the trash beside it, under its own name or one with a number; returns where it is now.
///
/// # Errors
/// The trash can't be made; the file can't be moved.
pub fn put_aside(file: &Path) -> Result<PathBuf, String> {
    let trash = file.with_file_name(TRASH);
    fs::create_dir_all(&trash).map_err(|e| format!("{}: {e}", trash.display()))?;
    let name = file.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = name.strip_suffix(SUFFIX).unwrap_or(&name);
    let names = std::iter::once(name.clone()).chain((2..1000).map(|n| format!("{stem} {n}{SUFFIX}")));
    let free = names.map(|name| trash.join(name)).find(|to| !to.exists());
    let to = free.ok_or_else(|| format!("{}: too many poses of that name", trash.display()))?;
    disk::move_new(file, &to).map_err(|e| e.to_string())?;
    Ok(to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_are_added_renamed_and_put_aside_and_none_is_lost() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("poses");
        assert!(scan(&folder).is_empty());
        let file = add(&folder, "Bow", "one").unwrap();
        assert!(add(&folder, "Bow", "two").is_err());
        assert_eq!(fs::read_to_string(&file).unwrap(), "one");
        let other = add(&folder, "Arc", "three").unwrap();
        let titles: Vec<String> = scan(&folder).into_iter().map(|e| e.title).collect();
        assert_eq!(titles, ["Arc", "Bow"]);
        assert!(rename(&file, "Arc").is_err());
        assert_eq!(fs::read_to_string(&other).unwrap(), "three");
        let renamed = rename(&file, "Deep bow").unwrap();
        assert_eq!(fs::read_to_string(&renamed).unwrap(), "one");
        let gone = put_aside(&renamed).unwrap();
        assert_eq!(fs::read_to_string(&gone).unwrap(), "one");
        let again = add(&folder, "Deep bow", "four").unwrap();
        let beside = put_aside(&again).unwrap();
        assert_ne!(beside, gone);
        assert_eq!(fs::read_to_string(&beside).unwrap(), "four");
        assert_eq!(scan(&folder).len(), 1);
    }

    #[test]
    fn only_the_case_of_a_name_may_change() {
        let home = tempfile::tempdir().unwrap();
        let file = add(home.path(), "bow", "one").unwrap();
        let renamed = rename(&file, "Bow").unwrap();
        assert_eq!(fs::read_to_string(renamed).unwrap(), "one");
    }

    #[test]
    fn names_that_can_t_be_files_or_are_taken_are_told() {
        let taken = ["Thinker", "bow"];
        let check = |name: &str| checked(name, taken.into_iter());
        assert_eq!(check(" Deep bow ").unwrap(), "Deep bow");
        assert_eq!(check("deep bow.pose.ron").unwrap(), "deep bow");
        assert!(check("thinker").unwrap_err().contains("\"Thinker\""));
        let devices = ["nul", "COM1", "lpt9", "con.bow"];
        for bad in ["", "  ", "a/b", "..", ".hidden", "a\u{7}", &"x".repeat(61)].into_iter().chain(devices) {
            assert!(check(bad).is_err(), "{bad:?}");
        }
        for good in ["Comb", "come", "Contact", "comb2"] {
            assert_eq!(check(good).unwrap(), good);
        }
    }

    #[test]
    fn an_index_gives_titles_and_tags_and_a_broken_one_does_no_harm() {
        let home = tempfile::tempdir().unwrap();
        add(home.path(), "a", "").unwrap();
        let index = home.path().join("index.ron");
        fs::write(&index, "(version: 1, poses: [(file: \"a.pose.ron\", title: \"Arc\", tags: [\"x\"])])")
            .unwrap();
        let found = scan(home.path());
        assert_eq!(
            (found[0].title.as_str(), found[0].tags.as_slice()),
            ("Arc", &["x".to_owned(), "own".to_owned()][..])
        );
        fs::write(&index, "(").unwrap();
        assert_eq!(scan(home.path())[0].title, "a");
    }
}
