//! Nothing lost: the last committed pose is kept on disk while the window is open, and offered again after a crash.
//!
//! Each window has a lock in the user's data folder and its pose there twice: written before the frame ends that committed
//! it, which a killed program doesn't undo, and written through to the disk by another thread, which a loss of power
//! doesn't either. The lock goes with the program, however it ends; a pose whose lock is free was left by a program
//! that did not end by itself.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use crate::disk::{read_text, write_atomic};

/// A pose that a program left when it did not end by itself.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lost {
    /// The text of the pose file.
    pub text: String,
    files: [PathBuf; 2],
}

impl Lost {
    /// Forgets it: it was taken up, or is not wanted.
    pub fn forget(&self) {
        // A file that can't be removed is offered once more.
        for file in &self.files {
            let _ = fs::remove_file(file);
        }
    }
}

/// Keeps this window's pose. Dropped without [`Keepsafe::done`], it leaves the pose to be offered again.
pub struct Keepsafe {
    latest: PathBuf,
    file: PathBuf,
    lock: PathBuf,
    // Held, not read: it is free again when the program is gone.
    _held: File,
    texts: Option<Sender<String>>,
    writer: Option<JoinHandle<()>>,
}

const POSE: &str = "pose.ron";
const LATEST: &str = "latest.ron";
const LOCK: &str = "lock";

impl Keepsafe {
    /// The folder in which poses are kept: `recovery` in the user's data folder for Posewright.
    pub fn folder() -> Option<PathBuf> {
        directories::ProjectDirs::from("", "", "posewright")
            .map(|dirs| dirs.data_local_dir().join("recovery"))
    }

    /// Begins to keep in a folder, and finds what others lost there, newest first.
    ///
    /// # Errors
    /// A folder that can't be written.
    pub fn begin(folder: &Path) -> std::io::Result<(Keepsafe, Vec<Lost>)> {
        fs::create_dir_all(folder)?;
        let lost = lost(folder);
        let (file, lock, held) = own(folder)?;
        let (texts, received) = channel();
        let to = file.clone();
        let writer = std::thread::spawn(move || write(&received, &to));
        let latest = beside(&lock, LATEST);
        Ok((Keepsafe { latest, file, lock, _held: held, texts: Some(texts), writer: Some(writer) }, lost))
    }

    /// Keeps the text of a pose in place of the former: now, and on another thread through to the disk.
    pub fn keep(&self, text: String) {
        if let Err(error) = write_now(&self.latest, &text) {
            log::error!("the pose can't be kept at once: {error}");
            // An older pose must not be taken for the latest one.
            let _ = fs::remove_file(&self.latest);
        }
        if let Some(texts) = &self.texts {
            // The writer ends only with the window.
            let _ = texts.send(text);
        }
    }

    /// Nothing is to be offered again: the window was closed.
    pub fn done(mut self) {
        self.stop();
        let _ = fs::remove_file(&self.file);
        let _ = fs::remove_file(&self.latest);
    }

    fn stop(&mut self) {
        self.texts = None;
        if let Some(writer) = self.writer.take() {
            let _ = writer.join();
        }
    }
}

impl Drop for Keepsafe {
    fn drop(&mut self) {
        self.stop();
        if !self.file.exists() && !self.latest.exists() {
            let _ = fs::remove_file(&self.lock);
        }
    }
}

/// Writes whole or not at all, as far as a program that dies is concerned.
fn write_now(file: &Path, text: &str) -> std::io::Result<()> {
    let half = file.with_extension("half");
    fs::write(&half, text)?;
    fs::rename(half, file)
}

/// Writes each text that comes; of several that wait, the last.
fn write(received: &Receiver<String>, file: &Path) {
    while let Ok(first) = received.recv() {
        let text = received.try_iter().last().unwrap_or(first);
        if let Err(error) = write_atomic(file, text.as_bytes()) {
            log::error!("the pose can't be kept: {error}");
        }
    }
}

/// A name in the folder that no running program holds.
fn own(folder: &Path) -> std::io::Result<(PathBuf, PathBuf, File)> {
    let mut number = 0;
    loop {
        let named = |end: &str| folder.join(format!("window-{number}.{end}"));
        let (file, lock) = (named(POSE), named(LOCK));
        let held = File::create(&lock)?;
        match held.try_lock() {
            Ok(()) if !file.exists() && !named(LATEST).exists() => return Ok((file, lock, held)),
            // Taken by a running program, or by a pose that is still to be offered.
            Ok(()) | Err(TryLockError::WouldBlock) => number += 1,
            Err(TryLockError::Error(error)) => return Err(error),
        }
    }
}

/// The poses whose programs are gone, newest first.
fn lost(folder: &Path) -> Vec<Lost> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let locks = entries.filter(|path| path.to_string_lossy().ends_with(LOCK));
    let mut found: Vec<(std::time::SystemTime, Lost)> =
        locks.filter(|lock| is_free(lock)).filter_map(|lock| left_by(&lock)).collect();
    found.sort_by_key(|(written, _)| std::cmp::Reverse(*written));
    found.into_iter().map(|(_, lost)| lost).collect()
}

/// What the program of a lock left, and when. A loss of power may have spoilt the latest text; the other is whole then.
fn left_by(lock: &Path) -> Option<(std::time::SystemTime, Lost)> {
    let files = [beside(lock, LATEST), beside(lock, POSE)];
    let texts: Vec<(&PathBuf, String)> =
        files.iter().filter_map(|file| Some((file, read_text(file).ok()?))).collect();
    let whole = texts.iter().find(|(_, text)| rig::parse_pose(text).is_ok());
    let (file, text) = whole.or(texts.last())?;
    let written = fs::metadata(file).and_then(|m| m.modified()).ok()?;
    Some((written, Lost { text: text.clone(), files: files.clone() }))
}

fn beside(lock: &Path, end: &str) -> PathBuf {
    let name = lock.to_string_lossy();
    PathBuf::from(format!("{}{end}", name.strip_suffix(LOCK).unwrap_or(&name)))
}

fn is_free(lock: &Path) -> bool {
    match File::open(lock) {
        Ok(file) => file.try_lock().is_ok(),
        Err(_) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(figure: &str) -> String {
        format!("(version: 1, figure: \"{figure}\")")
    }

    #[test]
    fn what_power_spoilt_is_not_offered_in_place_of_what_is_whole() {
        let folder = folder();
        let (killed, _) = Keepsafe::begin(folder.path()).unwrap();
        killed.keep(pose("whole"));
        drop(killed);
        for spoilt in ["", "\0\0\0\0", "(version: 1, fig"] {
            fs::write(folder.path().join("window-0.latest.ron"), spoilt).unwrap();
            assert_eq!(lost(folder.path())[0].text, pose("whole"));
        }
        fs::remove_file(folder.path().join("window-0.latest.ron")).unwrap();
        assert_eq!(lost(folder.path())[0].text, pose("whole"));
    }

    #[test]
    fn a_pose_is_there_before_keeping_returns() {
        let folder = folder();
        let (keepsafe, _) = Keepsafe::begin(folder.path()).unwrap();
        for number in 0..100 {
            keepsafe.keep(pose(&number.to_string()));
            let latest = fs::read_to_string(folder.path().join("window-0.latest.ron")).unwrap();
            assert_eq!(latest, pose(&number.to_string()));
        }
    }

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    #[test]
    fn a_window_that_was_closed_leaves_nothing() {
        let folder = folder();
        let (keepsafe, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert!(lost.is_empty());
        keepsafe.keep(pose("a"));
        keepsafe.done();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_program_that_was_killed_leaves_its_last_pose() {
        let folder = folder();
        let (keepsafe, _) = Keepsafe::begin(folder.path()).unwrap();
        for text in ["a", "b", "c"] {
            keepsafe.keep(pose(text));
        }
        drop(keepsafe);
        let (next, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert_eq!(lost.iter().map(|l| l.text.as_str()).collect::<Vec<_>>(), [pose("c")]);
        lost[0].forget();
        next.done();
        assert!(Keepsafe::begin(folder.path()).unwrap().1.is_empty());
    }

    #[test]
    fn windows_beside_each_other_keep_their_own() {
        let folder = folder();
        let (first, _) = Keepsafe::begin(folder.path()).unwrap();
        first.keep(pose("first"));
        let (second, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert!(lost.is_empty(), "a running window's pose is not lost");
        second.keep(pose("second"));
        drop((first, second));
        let lost = Keepsafe::begin(folder.path()).unwrap().1;
        assert_eq!(lost.len(), 2);
    }

    #[test]
    fn what_was_not_taken_up_is_offered_again() {
        let folder = folder();
        let (killed, _) = Keepsafe::begin(folder.path()).unwrap();
        killed.keep(pose("kept"));
        drop(killed);
        for _ in 0..3 {
            let (keepsafe, lost) = Keepsafe::begin(folder.path()).unwrap();
            assert_eq!(lost[0].text, pose("kept"));
            keepsafe.keep(pose("newer"));
            keepsafe.done();
        }
    }
}
