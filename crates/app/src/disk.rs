//! The disk: bounded reading, and writing that never leaves half a file.

use std::fs::{self, File};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};

use edit::Files;

use crate::failure::Failure;
use crate::library::shipped;

/// The largest text that is read, bytes: a pose takes some ten thousand.
pub const TEXT_LIMIT: u64 = 16 << 20;
/// The largest model or mesh that is read, bytes.
pub const MODEL_LIMIT: u64 = 512 << 20;

/// Reads a whole file of at most `limit` bytes.
///
/// # Errors
/// A file that is missing, unreadable or larger; the message names it.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    let fault = |e: std::io::Error| Failure::Input(format!("{}: {}", path.display(), plain(&e)));
    let file = File::open(path).map_err(fault)?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(fault)?;
    if bytes.len() as u64 > limit {
        let message =
            format!("{}:1:1: larger than {} MB, the most that is read", path.display(), limit >> 20);
        return Err(Failure::Input(message));
    }
    Ok(bytes)
}

/// Reads a whole text file.
///
/// # Errors
/// As [`read_bytes`], and text that is not UTF-8, with its place.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(read_bytes(path, TEXT_LIMIT)?).map_err(|e| {
        let good = e.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&e.as_bytes()[..good]).into_owned();
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        Failure::Input(format!("{}:{line}:{column}: not UTF-8 text", path.display()))
    })
}

/// Writes a file whole: beside it first, then in its place. If that is interrupted the former file stays.
///
/// # Errors
/// A folder that is missing or can't be written; the message names the file.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    // A link is followed, so that the file it names is replaced and not the link.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    beside(&path, bytes)?.persist(&path).map_err(|e| named(&path, &e.error))?;
    Ok(())
}

/// Writes a new file whole; a file that is there already stays as it is.
///
/// # Errors
/// A file of that name; a folder that is missing or can't be written. The message names the file.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    beside(path, bytes)?.persist_noclobber(path).map_err(|e| named(path, &e.error))?;
    Ok(())
}

/// Gives a file another name in its file system; a file that is there already stays as it is.
///
/// # Errors
/// A file of that name, no such file, or one that can't be moved. The message names the file at fault.
pub fn move_new(from: &Path, to: &Path) -> Result<(), Failure> {
    // Where case doesn't matter, a name that differs in case alone is that of the file itself.
    let same = fs::canonicalize(to).is_ok_and(|there| fs::canonicalize(from).is_ok_and(|here| here == there));
    if to.exists() && !same {
        return Err(Failure::Input(format!("{}: there is such a file", to.display())));
    }
    fs::rename(from, to).map_err(|e| named(from, &e))
}

fn named(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Input(format!("{}: {}", path.display(), plain(error)))
}

/// A whole file beside its future place.
fn beside(path: &Path, bytes: &[u8]) -> Result<tempfile::NamedTempFile, Failure> {
    let mut temporary = begun(path)?;
    temporary.write_all(bytes).map_err(|e| named(path, &e))?;
    finished(temporary, path)
}

/// An empty file beside its future place, of the same ending.
fn begun(path: &Path) -> Result<tempfile::NamedTempFile, Failure> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let ending = path.extension().map_or_else(String::new, |ending| format!(".{}", ending.to_string_lossy()));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".posewright-").suffix(&ending).tempfile_in(folder).map_err(|e| named(path, &e))
}

/// The same file, on the disk and with the permissions of what it takes the place of.
fn finished(temporary: tempfile::NamedTempFile, path: &Path) -> Result<tempfile::NamedTempFile, Failure> {
    let fault = |e: std::io::Error| named(path, &e);
    temporary.as_file().sync_all().map_err(fault)?;
    let permissions = fs::metadata(path).map(|m| m.permissions()).ok().or_else(ordinary);
    if let Some(permissions) = permissions {
        temporary.as_file().set_permissions(permissions).map_err(fault)?;
    }
    Ok(temporary)
}

/// A file that is written piece by piece beside its place and takes it when it is whole. Dropped before, it leaves nothing.
#[derive(Debug)]
pub struct Draft {
    temporary: tempfile::NamedTempFile,
    place: PathBuf,
}

impl Draft {
    /// Begins a file.
    ///
    /// # Errors
    /// A folder that is missing or can't be written; the message names the file.
    pub fn begin(place: &Path) -> Result<Draft, Failure> {
        // A link is followed, so that the file it names is replaced and not the link.
        let place = fs::canonicalize(place).unwrap_or_else(|_| place.to_owned());
        Ok(Draft { temporary: begun(&place)?, place })
    }

    /// Where the unfinished file is, for another program that writes it.
    pub fn path(&self) -> &Path {
        self.temporary.path()
    }

    /// The whole file takes its place.
    ///
    /// # Errors
    /// The disk fails; the message names the file.
    pub fn finish(self) -> Result<(), Failure> {
        let Draft { temporary, place } = self;
        finished(temporary, &place)?.persist(&place).map_err(|e| named(&place, &e.error))?;
        Ok(())
    }

    /// A fault of writing, with the file's name.
    pub fn fault(place: &Path, error: &std::io::Error) -> Failure {
        named(place, error)
    }
}

impl std::io::Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.temporary.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.temporary.as_file_mut().flush()
    }
}

impl std::io::Seek for Draft {
    fn seek(&mut self, to: std::io::SeekFrom) -> std::io::Result<u64> {
        self.temporary.as_file_mut().seek(to)
    }
}

/// What a new file may be: temporary ones are readable by their owner only.
#[cfg(unix)]
fn ordinary() -> Option<fs::Permissions> {
    use std::os::unix::fs::PermissionsExt as _;
    Some(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn ordinary() -> Option<fs::Permissions> {
    None
}

fn plain(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        std::io::ErrorKind::PermissionDenied => "not allowed".to_owned(),
        std::io::ErrorKind::AlreadyExists => "there is such a file".to_owned(),
        _ => error.to_string(),
    }
}

/// The disk as commands see it: paths are taken from a folder, that of the script or the present one, and
/// `library:NAME` is a pose that comes with the program.
#[derive(Clone, Debug, Default)]
pub struct Disk {
    /// Where relative paths start.
    pub folder: PathBuf,
}

impl Disk {
    /// Paths start beside a file.
    pub fn beside(file: &Path) -> Disk {
        Disk { folder: file.parent().unwrap_or(Path::new("")).to_owned() }
    }
}

impl Files for Disk {
    fn read(&mut self, path: &str) -> Result<String, String> {
        match shipped::by_path(path) {
            Some(text) => text.map(str::to_owned),
            None => read_text(&self.folder.join(path)).map_err(|e| e.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interrupted_save_leaves_the_former_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pose.ron");
        write_atomic(&path, b"former").unwrap();
        // The disk fills or the program dies before the new file is whole: its folder takes no more files.
        let blocked = folder.path().join("missing").join("a.pose.ron");
        assert!(write_atomic(&blocked, b"new").is_err());
        let half = tempfile::Builder::new().prefix(".posewright-").tempfile_in(folder.path()).unwrap();
        fs::write(half.path(), b"ha").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"former");
        write_atomic(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn a_draft_that_is_dropped_leaves_the_former_file_and_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        fs::write(&path, b"former").unwrap();
        let mut draft = Draft::begin(&path).unwrap();
        assert!(draft.path().extension().is_some_and(|ending| ending == "gif"));
        draft.write_all(b"half").unwrap();
        drop(draft);
        assert_eq!(fs::read(&path).unwrap(), b"former");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let mut draft = Draft::begin(&path).unwrap();
        draft.write_all(b"whole").unwrap();
        draft.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"whole");
        assert!(Draft::begin(&folder.path().join("missing").join("a.gif")).is_err());
    }

    #[test]
    fn a_file_that_is_too_large_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("big.pose.ron");
        fs::write(&path, vec![b'('; 100]).unwrap();
        let message = read_bytes(&path, 99).unwrap_err().to_string();
        assert!(message.contains("big.pose.ron:1:1: larger"), "{message}");
    }

    #[test]
    fn a_new_file_takes_no_other_s_place() {
        let folder = tempfile::tempdir().unwrap();
        let (there, new) = (folder.path().join("there"), folder.path().join("new"));
        fs::write(&there, b"former").unwrap();
        assert!(write_new(&there, b"new").unwrap_err().to_string().contains("there: there is such a file"));
        write_new(&new, b"new").unwrap();
        assert!(move_new(&new, &there).is_err());
        assert_eq!(
            (fs::read(&there).unwrap(), fs::read(&new).unwrap()),
            (b"former".to_vec(), b"new".to_vec())
        );
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing half is left");
    }

    #[test]
    fn commands_read_shipped_poses() {
        let mut disk = Disk::default();
        assert!(disk.read("library:standing.pose.ron").unwrap().contains("version: 1"));
        assert!(disk.read("library:nobody.pose.ron").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_written_through() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&file, b"former").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_atomic(&link, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
