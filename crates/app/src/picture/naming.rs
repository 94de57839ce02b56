//! What files pictures become: the format by the ending, a file each by a pattern.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// A kind of picture file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// A still without loss, or one for each frame.
    Png,
    /// A still or a moving picture without loss.
    WebP,
    /// A moving picture in 255 colours.
    Gif,
    /// A film; needs ffmpeg.
    Mp4,
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 4] = [Format::Png, Format::WebP, Format::Gif, Format::Mp4];

    /// What its files' names end in.
    pub const fn ending(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::WebP => "webp",
            Format::Gif => "gif",
            Format::Mp4 => "mp4",
        }
    }

    /// The format of a file by its name; `None` if no picture has such an ending.
    pub fn of(path: &Path) -> Option<Format> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Format::ALL.into_iter().find(|format| format.ending() == ending)
    }

    /// Whether one file holds several frames.
    pub const fn moves(self) -> bool {
        !matches!(self, Format::Png)
    }
}

/// In a pattern, the name of the pass.
pub const PASS: &str = "{pass}";
/// The files of a folder.
const IN_FOLDER: &str = "frame-%04d.png";

/// The name of a file or of several: `{pass}` stands for the pass, `%d` or `%04d` for the frame, from 1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Naming {
    pattern: String,
    /// What all files are.
    pub format: Format,
}

impl Naming {
    /// Reads what stands behind `-o`. A folder that is there, or a name that ends in a slash, is one of PNG frames.
    ///
    /// # Errors
    /// An ending that no picture has.
    pub fn of(output: &Path) -> Result<Naming, Failure> {
        let words = output.to_string_lossy();
        if words.ends_with(['/', '\\']) || output.is_dir() {
            let pattern = output.join(IN_FOLDER).to_string_lossy().into_owned();
            return Ok(Naming { pattern, format: Format::Png });
        }
        let Some(format) = Format::of(output) else {
            let endings = Format::ALL.map(|format| format!(".{}", format.ending())).join(" ");
            let message = format!("{words}: no kind of picture ends so; there are {endings} and folders");
            return Err(Failure::Usage(message));
        };
        Ok(Naming { pattern: words.into_owned(), format })
    }

    /// A name like this for files beside the pictures, whatever their ending.
    pub fn beside(output: &Path) -> Naming {
        Naming { pattern: output.to_string_lossy().into_owned(), format: Format::Png }
    }

    /// Whether passes have files of their own.
    pub fn tells_passes(&self) -> bool {
        self.pattern.contains(PASS)
    }

    /// Whether frames have files of their own.
    pub fn tells_frames(&self) -> bool {
        self.counter().is_some()
    }

    /// The file of a pass and a frame.
    pub fn file(&self, pass: &str, frame: usize) -> PathBuf {
        let counted = match self.counter() {
            Some((from, to, width)) => {
                format!("{}{:0width$}{}", &self.pattern[..from], frame + 1, &self.pattern[to..])
            }
            None => self.pattern.clone(),
        };
        PathBuf::from(counted.replace(PASS, pass))
    }

    /// Where the number stands: from, to, and how many digits it has at least.
    fn counter(&self) -> Option<(usize, usize, usize)> {
        self.pattern.match_indices('%').find_map(|(from, _)| {
            let rest = &self.pattern[from + 1..];
            let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let width = if digits == 0 { 1 } else { rest[..digits].parse().ok().filter(|w| *w <= 12)? };
            rest[digits..].starts_with('d').then_some((from, from + digits + 2, width))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(pattern: &str, pass: &str, frame: usize) -> String {
        Naming::of(Path::new(pattern)).unwrap().file(pass, frame).to_string_lossy().into_owned()
    }

    #[test]
    fn patterns_become_names() {
        assert_eq!(named("a.png", "color", 7), "a.png");
        assert_eq!(named("a-%04d.png", "color", 7), "a-0008.png");
        assert_eq!(named("100% %d{pass}.webp", "depth", 11), "100% 12depth.webp");
        assert_eq!(named("out/", "color", 0), "out/frame-0001.png");
        assert_eq!(named("%99999d.png", "color", 0), "%99999d.png");
        let naming = |pattern: &str| Naming::of(Path::new(pattern)).unwrap();
        assert!(naming("%3d.PNG").tells_frames() && !naming("%3d.PNG").tells_passes());
        assert!(naming("{pass}.gif").tells_passes() && naming("{pass}.gif").format.moves());
    }

    #[test]
    fn an_ending_that_is_none_is_told_with_those_that_are() {
        let fault = Naming::of(Path::new("a.bmp")).unwrap_err().to_string();
        assert!(fault.contains("a.bmp") && fault.contains(".webp"), "{fault}");
        assert!(Naming::of(Path::new("a")).is_err());
    }
}
