//! Nothing lost: the last committed pose is kept on disk while the window is open, and offered again after a crash.
//!
//! Each window has a pose file and a lock in the user's data folder. The lock goes with the program, however it
//! ends; a pose file whose lock is free was left by a program that did not end by itself.

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
    file: PathBuf,
}

impl Lost {
    /// Forgets it: it was taken up, or is not wanted.
    pub fn forget(&self) {
        // If the file can't be removed it is offered once more.
        let _ = fs::remove_file(&self.file);
    }
}

/// Keeps this window's pose. Dropped without [`Keepsafe::done`], it leaves the pose to be offered again.
pub struct Keepsafe {
    file: PathBuf,
    lock: PathBuf,
    // Held, not read: it is free again when the program is gone.
    _held: File,
    texts: Option<Sender<String>>,
    writer: Option<JoinHandle<()>>,
}

const POSE: &str = "pose.ron";
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
        Ok((Keepsafe { file, lock, _held: held, texts: Some(texts), writer: Some(writer) }, lost))
    }

    /// Keeps the text of a pose in place of the former; another thread writes it.
    pub fn keep(&self, text: String) {
        if let Some(texts) = &self.texts {
            // The writer ends only with the window.
            let _ = texts.send(text);
        }
    }

    /// Nothing is to be offered again: the window was closed.
    pub fn done(mut self) {
        self.stop();
        let _ = fs::remove_file(&self.file);
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
        if !self.file.exists() {
            let _ = fs::remove_file(&self.lock);
        }
    }
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
            Ok(()) if !file.exists() => return Ok((file, lock, held)),
            // Taken by a running program, or by a pose that is still to be offered.
            Ok(()) | Err(TryLockError::WouldBlock) => number += 1,
            Err(TryLockError::Error(error)) => return Err(error),
        }
    }
}

/// The poses whose programs are gone, newest first.
fn lost(folder: &Path) -> Vec<Lost> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut found: Vec<(std::time::SystemTime, Lost)> = entries
        .filter(|path| path.to_string_lossy().ends_with(POSE))
        .filter(|path| is_free(&lock_of(path)))
        .filter_map(|file| {
            let written = fs::metadata(&file).and_then(|m| m.modified()).ok()?;
            Some((written, Lost { text: read_text(&file).ok()?, file }))
        })
        .collect();
    found.sort_by_key(|(written, _)| std::cmp::Reverse(*written));
    found.into_iter().map(|(_, lost)| lost).collect()
}

fn lock_of(pose: &Path) -> PathBuf {
    let name = pose.to_string_lossy();
    PathBuf::from(format!("{}{LOCK}", name.strip_suffix(POSE).unwrap_or(&name)))
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

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    #[test]
    fn a_window_that_was_closed_leaves_nothing() {
        let folder = folder();
        let (keepsafe, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert!(lost.is_empty());
        keepsafe.keep("a".to_owned());
        keepsafe.done();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_program_that_was_killed_leaves_its_last_pose() {
        let folder = folder();
        let (keepsafe, _) = Keepsafe::begin(folder.path()).unwrap();
        for text in ["a", "b", "c"] {
            keepsafe.keep(text.to_owned());
        }
        drop(keepsafe);
        let (next, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert_eq!(lost.iter().map(|l| l.text.as_str()).collect::<Vec<_>>(), ["c"]);
        lost[0].forget();
        next.done();
        assert!(Keepsafe::begin(folder.path()).unwrap().1.is_empty());
    }

    #[test]
    fn windows_beside_each_other_keep_their_own() {
        let folder = folder();
        let (first, _) = Keepsafe::begin(folder.path()).unwrap();
        first.keep("first".to_owned());
        let (second, lost) = Keepsafe::begin(folder.path()).unwrap();
        assert!(lost.is_empty(), "a running window's pose is not lost");
        second.keep("second".to_owned());
        drop((first, second));
        let lost = Keepsafe::begin(folder.path()).unwrap().1;
        assert_eq!(lost.len(), 2);
    }

    #[test]
    fn what_was_not_taken_up_is_offered_again() {
        let folder = folder();
        let (killed, _) = Keepsafe::begin(folder.path()).unwrap();
        killed.keep("kept".to_owned());
        drop(killed);
        for _ in 0..3 {
            let (keepsafe, lost) = Keepsafe::begin(folder.path()).unwrap();
            assert_eq!(lost[0].text, "kept");
            keepsafe.keep("newer".to_owned());
            keepsafe.done();
        }
    }
}
