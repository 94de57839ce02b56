//! PNG files: rows from the top, as they come, with what the picture says of itself.

use std::io::{BufWriter, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};

use super::facts::Facts;
use crate::disk::Draft;
use crate::failure::Failure;

/// What a PNG holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shape {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Whether pixels can be clear; without, they take three bytes.
    pub alpha: bool,
}

/// Takes the rows of a PNG, from the top.
pub struct Rows<'a> {
    stream: &'a mut dyn Write,
    place: &'a Path,
    alpha: bool,
}

impl Rows<'_> {
    /// Takes whole rows of four bytes a pixel, straight alpha.
    ///
    /// # Errors
    /// A full disk.
    pub fn take(&mut self, rgba: &[u8]) -> Result<(), Failure> {
        let written = if self.alpha {
            self.stream.write_all(rgba)
        } else {
            // A part at a time: the whole picture may be larger than memory.
            rgba.chunks(1 << 16).try_for_each(|part| {
                let rgb: Vec<u8> =
                    part.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
                self.stream.write_all(&rgb)
            })
        };
        written.map_err(|e| Draft::fault(self.place, &e))
    }
}

/// Writes a PNG, whole or not at all: `fill` hands over all rows.
///
/// # Errors
/// A file that can't be written; what `fill` finds wrong.
pub fn write_rows(
    place: &Path,
    shape: Shape,
    facts: &Facts,
    fill: impl FnOnce(&mut Rows<'_>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let fault = |e: EncodingError| Failure::Input(format!("{}: {e}", place.display()));
    let mut draft = BufWriter::new(Draft::begin(place)?);
    {
        let mut encoder = Encoder::new(&mut draft, shape.size[0], shape.size[1]);
        encoder.set_color(if shape.alpha { ColorType::Rgba } else { ColorType::Rgb });
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        encoder.set_filter(Filter::Adaptive);
        for (keyword, words) in facts.pairs() {
            // Plain text chunks hold Latin letters only.
            let plain = words.chars().all(|c| c == '\n' || (' '..='~').contains(&c));
            let add = if plain { Encoder::add_text_chunk } else { Encoder::add_itxt_chunk };
            add(&mut encoder, keyword.to_owned(), words.replace('\0', "")).map_err(fault)?;
        }
        let mut writer = encoder.write_header().map_err(fault)?;
        let mut stream = writer.stream_writer().map_err(fault)?;
        fill(&mut Rows { stream: &mut stream, place, alpha: shape.alpha })?;
        stream.finish().map_err(fault)?;
        writer.finish().map_err(fault)?;
    }
    let draft = draft.into_inner().map_err(|e| Draft::fault(place, e.error()))?;
    draft.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: Shape = Shape { size: [3, 4], alpha: true };

    fn written(facts: &Facts, shape: Shape) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.png");
        let row: Vec<u8> = (0..12).collect();
        write_rows(&file, shape, facts, |rows| (0..4).try_for_each(|_| rows.take(&row))).unwrap();
        std::fs::read(&file).unwrap()
    }

    #[test]
    fn a_png_says_what_it_shows_and_is_the_same_each_time() {
        let facts = Facts::new("thinker", "Änne").with("Look", "clay");
        let bytes = written(&facts, SHAPE);
        assert_eq!(bytes, written(&facts, SHAPE));
        let reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let info = reader.info();
        let plain: Vec<_> =
            info.uncompressed_latin1_text.iter().map(|t| (t.keyword.as_str(), t.text.as_str())).collect();
        assert!(plain.contains(&("Title", "thinker")) && plain.contains(&("Look", "clay")), "{plain:?}");
        assert_eq!(info.utf8_text[0].get_text().unwrap(), "Änne");
    }

    #[test]
    fn opaque_pixels_take_three_bytes() {
        let bytes = written(&Facts::default(), Shape { alpha: false, ..SHAPE });
        let image = image::load_from_memory(&bytes).unwrap();
        assert_eq!(image.color(), image::ColorType::Rgb8);
        assert_eq!(image.to_rgb8().get_pixel(1, 2).0, [4, 5, 6]);
    }

    #[test]
    fn too_few_rows_leave_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.png");
        assert!(write_rows(&file, SHAPE, &Facts::default(), |rows| rows.take(&[0; 12])).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
