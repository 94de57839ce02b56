//! Portraits on disk, so that a library is drawn once and not each time that the program starts.
//!
//! A portrait's file is named for everything that it shows: figure, pose and manner of drawing. So a file is never
//! out of date, only unused; the longest unused go when there are too many.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use render::Image;
use rig::Figure;

use super::portrait::SIZE;
use crate::disk;

/// Goes up when portraits are drawn in another manner.
const MANNER: u64 = 2;
/// As many portraits are kept on disk, some tens of kilobytes each.
const MOST: usize = 4000;
/// The largest file that is taken for a portrait, bytes.
const LIMIT: u64 = 4 << 20;

/// Where portraits are kept: `portraits` in the user's cache folder for Posewright.
pub fn of_user() -> Option<PathBuf> {
    directories::ProjectDirs::from("", "", "posewright").map(|dirs| dirs.cache_dir().join("portraits"))
}

/// A folder of portraits.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// A folder, made when the first portrait is kept.
    pub fn new(folder: PathBuf) -> Cache {
        Cache { folder }
    }

    fn file(&self, key: u64) -> PathBuf {
        self.folder.join(format!("{key:016x}.png"))
    }

    /// The portrait of that key, if there is a whole one.
    pub fn get(&self, key: u64) -> Option<Image> {
        let bytes = disk::read_bytes(&self.file(key), LIMIT).ok()?;
        let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png).ok()?.into_rgba8();
        let (width, height) = read.dimensions();
        ([width, height] == SIZE).then(|| Image { width, height, rgba: read.into_raw() })
    }

    /// Keeps a portrait. Where that fails it is drawn again the next time, which is all that is lost.
    pub fn put(&self, key: u64, portrait: &Image) {
        let buffer = image::RgbaImage::from_raw(portrait.width, portrait.height, portrait.rgba.clone());
        let mut bytes = Cursor::new(Vec::new());
        let encoded = buffer.is_some_and(|b| b.write_to(&mut bytes, image::ImageFormat::Png).is_ok());
        let made = encoded && fs::create_dir_all(&self.folder).is_ok();
        if made && let Err(error) = disk::write_atomic(&self.file(key), &bytes.into_inner()) {
            log::warn!("a portrait can't be kept: {error}");
        }
    }

    /// Removes the oldest portraits beyond those that are kept.
    pub fn prune(&self) {
        prune(&self.folder, MOST);
    }
}

fn prune(folder: &Path, most: usize) {
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<_> = files
        .filter(|entry| entry.path().extension().is_some_and(|end| end == "png"))
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    if files.len() > most {
        files.sort();
        for (_, file) in &files[..files.len() - most] {
            // One that stays is removed the next time.
            let _ = fs::remove_file(file);
        }
    }
}

/// A number for all that a figure's portraits depend on, but the pose. Takes some milliseconds.
pub fn figure_key(figure: &Figure) -> u64 {
    let mut hash = Fnv::default();
    hash.number(MANNER);
    SIZE.iter().for_each(|edge| hash.number(u64::from(*edge)));
    hash.bytes(format!("{:?}", figure.skeleton).as_bytes());
    if let Some(mesh) = &figure.skin {
        for corner in mesh.positions.iter().chain(&mesh.normals).chain(&mesh.colors).flatten() {
            hash.bytes(&corner.to_le_bytes());
        }
        mesh.joints.iter().for_each(|joints| hash.bytes(joints));
        mesh.weights.iter().flatten().for_each(|weight| hash.bytes(&weight.to_le_bytes()));
        mesh.indices.iter().for_each(|index| hash.bytes(&index.to_le_bytes()));
    }
    hash.0
}

/// The number of a pose's portrait: that of the figure, and the text of the pose.
pub fn key(figure_key: u64, text: &str) -> u64 {
    let mut hash = Fnv::default();
    hash.number(figure_key);
    hash.bytes(text.as_bytes());
    hash.0
}

/// FNV-1a: unlike the standard library's hash it is the same in every version.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Fnv {
        Fnv(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn number(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(shade: u8) -> Image {
        let [width, height] = SIZE;
        Image { width, height, rgba: vec![shade; 4 * (width * height) as usize] }
    }

    #[test]
    fn a_portrait_comes_back_and_damage_is_no_portrait() {
        let home = tempfile::tempdir().unwrap();
        let cache = Cache::new(home.path().join("portraits"));
        assert!(cache.get(7).is_none());
        cache.put(7, &grey(90));
        assert_eq!(cache.get(7).unwrap(), grey(90));
        assert!(cache.get(8).is_none());
        fs::write(cache.file(7), b"not a picture").unwrap();
        assert!(cache.get(7).is_none());
    }

    #[test]
    fn another_pose_or_figure_has_another_key() {
        let figure = crate::load::figure(None).unwrap();
        let mut taller = (*figure).clone();
        if let Some(skin) = &mut taller.skin {
            skin.positions[0][1] += 0.001;
        }
        let (a, b) = (figure_key(&figure), figure_key(&taller));
        assert_ne!(a, b);
        assert_eq!(a, figure_key(&figure));
        assert_ne!(key(a, "x"), key(a, "y"));
        assert_ne!(key(a, "x"), key(b, "x"));
        let mut hash = Fnv::default();
        hash.bytes(b"foobar");
        assert_eq!(hash.0, 0x8594_4171_f739_67e8, "the value that FNV's authors give");
    }

    #[test]
    fn the_oldest_portraits_go_when_there_are_too_many() {
        let home = tempfile::tempdir().unwrap();
        let cache = Cache::new(home.path().to_owned());
        for key in 0..4 {
            fs::write(cache.file(key), b"").unwrap();
            let written = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1000 + key);
            fs::File::options().write(true).open(cache.file(key)).unwrap().set_modified(written).unwrap();
        }
        prune(home.path(), 2);
        assert_eq!([0, 1, 2, 3].map(|key| cache.file(key).exists()), [false, false, true, true]);
    }
}
