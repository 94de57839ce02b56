//! Animated GIF: one palette for all frames, an even dither that stands still, and only what changes from frame to frame.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use color_quant::NeuQuant;
use gif::{AnyExtension, DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use render::Image;

use super::changed::changed;
use super::facts::Facts;
use crate::disk::Draft;
use crate::failure::Failure;

/// The colours of the palette; the last place of 256 is for what is clear.
const COLORS: usize = 255;
const CLEAR: u8 = 255;
/// About so many pixels are looked at for the palette.
const SAMPLES: usize = 120_000;
/// One in so many of the looked-at pixels counts in each of the quantiser's steps; 1 is best and slowest.
const THRIFT: i32 = 3;
/// How far the dither moves a channel at most.
const DITHER: i16 = 5;
/// An ordered 8 by 8 dither (Bayer 1973): each number from 0 to 63 once.
const BAYER: [[i16; 8]; 8] = [
    [0, 32, 8, 40, 2, 34, 10, 42],
    [48, 16, 56, 24, 50, 18, 58, 26],
    [12, 44, 4, 36, 14, 46, 6, 38],
    [60, 28, 52, 20, 62, 30, 54, 22],
    [3, 35, 11, 43, 1, 33, 9, 41],
    [51, 19, 59, 27, 49, 17, 57, 25],
    [15, 47, 7, 39, 13, 45, 5, 37],
    [63, 31, 55, 23, 61, 29, 53, 21],
];

/// A GIF in the making.
pub struct Gif {
    encoder: Encoder<BufWriter<Draft>>,
    place: PathBuf,
    alpha: bool,
    quantiser: NeuQuant,
    /// Places in the palette that were looked up already.
    known: HashMap<[u8; 3], u8>,
    /// The former frame as it looks, with palette places as red.
    former: Option<Image>,
    /// Hundredths of a second shown so far, in thousandths.
    shown_ms: u32,
}

impl Gif {
    /// Begins a file whose palette suits some of its frames.
    ///
    /// # Errors
    /// A size that the format can't hold, a folder that can't be written.
    pub fn begin(
        place: &Path,
        size: [u32; 2],
        alpha: bool,
        facts: &Facts,
        samples: &[Image],
    ) -> Result<Gif, Failure> {
        let edge = |edge: u32| u16::try_from(edge).ok().filter(|edge| *edge > 0);
        let (Some(width), Some(height)) = (edge(size[0]), edge(size[1])) else {
            let [width, height] = size;
            let message = format!("a GIF of {width}x{height} pixels can't be: each edge must be 1 to 65535");
            return Err(Failure::Input(message));
        };
        let quantiser = NeuQuant::new(THRIFT, COLORS, &looked_at(samples));
        let mut palette = quantiser.color_map_rgb();
        palette.resize(3 * 256, 0);
        let draft = BufWriter::new(Draft::begin(place)?);
        let fault = |e: EncodingError| Failure::Input(format!("{}: {e}", place.display()));
        let mut encoder = Encoder::new(draft, width, height, &palette).map_err(fault)?;
        encoder.set_repeat(Repeat::Infinite).map_err(fault)?;
        const COMMENT: AnyExtension = AnyExtension(0xFE);
        encoder.write_raw_extension(COMMENT, &[facts.lines().as_bytes()]).map_err(fault)?;
        Ok(Gif {
            encoder,
            place: place.to_owned(),
            alpha,
            quantiser,
            known: HashMap::new(),
            former: None,
            shown_ms: 0,
        })
    }

    /// The next frame, shown until so many milliseconds from the beginning.
    ///
    /// # Errors
    /// A full disk.
    pub fn frame(&mut self, image: &Image, until_ms: u32) -> Result<(), Failure> {
        let places = self.places(image);
        // Clear pixels can't be laid over others: such frames begin anew.
        let former = self.former.as_ref().filter(|_| !self.alpha);
        let [left, top, width, height] = changed(former, &places);
        let mut buffer = Vec::with_capacity(width as usize * height as usize);
        for y in top..top + height {
            for x in left..left + width {
                let pixel = places.pixel(x, y).unwrap_or_default();
                let stays = former.and_then(|f| f.pixel(x, y)) == Some(pixel);
                buffer.push(if stays { CLEAR } else { pixel[0] });
            }
        }
        // Hundredths add up to the whole time.
        let delay = (until_ms + 5) / 10 - (self.shown_ms + 5) / 10;
        self.shown_ms = until_ms;
        let small = |number: u32| u16::try_from(number).unwrap_or(u16::MAX);
        let frame = Frame {
            delay: small(delay),
            dispose: if self.alpha { DisposalMethod::Background } else { DisposalMethod::Keep },
            transparent: Some(CLEAR),
            left: small(left),
            top: small(top),
            width: small(width),
            height: small(height),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        };
        let written = self.encoder.write_frame(&frame);
        written.map_err(|e| Failure::Input(format!("{}: {e}", self.place.display())))?;
        self.former = Some(places);
        Ok(())
    }

    /// The file is whole.
    ///
    /// # Errors
    /// A full disk.
    pub fn finish(self) -> Result<(), Failure> {
        let place = self.place;
        let buffered =
            self.encoder.into_inner().map_err(|e| Failure::Input(format!("{}: {e}", place.display())))?;
        buffered.into_inner().map_err(|e| Draft::fault(&place, e.error()))?.finish()
    }

    /// The palette's places of a picture's pixels, as its red.
    fn places(&mut self, image: &Image) -> Image {
        let width = image.width.max(1) as usize;
        let mut rgba = Vec::with_capacity(image.rgba.len());
        for (i, pixel) in image.rgba.chunks_exact(4).enumerate() {
            let place = if pixel[3] < 128 {
                CLEAR
            } else {
                let color = dithered([pixel[0], pixel[1], pixel[2]], i % width, i / width);
                let quantiser = &self.quantiser;
                let found = || quantiser.index_of(&[color[0], color[1], color[2], 255]).min(COLORS - 1) as u8;
                *self.known.entry(color).or_insert_with(found)
            };
            rgba.extend([place, 0, 0, 255]);
        }
        Image { width: image.width, height: image.height, rgba }
    }
}

fn dithered(color: [u8; 3], x: usize, y: usize) -> [u8; 3] {
    let shift = (2 * BAYER[y % 8][x % 8] - 63) * DITHER / 63;
    color.map(|channel| (i16::from(channel) + shift).clamp(0, 255) as u8)
}

/// Pixels spread over the samples.
fn looked_at(samples: &[Image]) -> Vec<u8> {
    let all: usize = samples.iter().map(|image| image.rgba.len() / 4).sum();
    // An odd step falls on every column in turn.
    let step = (all / SAMPLES).max(1) | 1;
    let pixels = samples.iter().flat_map(|image| image.rgba.chunks_exact(4));
    let solid = pixels.step_by(step).filter(|pixel| pixel[3] >= 128);
    let mut rgba: Vec<u8> = solid.flat_map(|p| [p[0], p[1], p[2], 255]).collect();
    // The quantiser needs some pixels even of an empty picture.
    let least = 4 * 1024;
    while rgba.len() < least {
        rgba.extend_from_within(..rgba.len().min(least - rgba.len()));
        if rgba.is_empty() {
            rgba.extend([0, 0, 0, 255]);
        }
    }
    rgba
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(at: u32, back: [u8; 4]) -> Image {
        let lit = |i: u32| (at..at + 8).contains(&(i % 40)) && (5..18).contains(&(i / 40));
        let rgba = (0..40 * 30).flat_map(|i| if lit(i) { [200, 30, 10, 255] } else { back }).collect();
        Image { width: 40, height: 30, rgba }
    }

    fn film(back: [u8; 4]) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.gif");
        let frames = [1, 10, 10, 20].map(|at| frame(at, back));
        let facts = Facts::new("walk", "doll");
        let mut gif = Gif::begin(&file, [40, 30], back[3] == 0, &facts, &frames).unwrap();
        for (i, frame) in (1..).zip(&frames) {
            gif.frame(frame, i * 1000 / 24).unwrap();
        }
        gif.finish().unwrap();
        std::fs::read(&file).unwrap()
    }

    #[test]
    fn frames_come_back_nearly_as_they_were_and_for_as_long() {
        for back in [[90, 100, 110, 255], [0, 0, 0, 0]] {
            let bytes = film(back);
            assert!(bytes.windows(4).any(|window| window == b"walk"));
            let mut options = gif::DecodeOptions::new();
            options.set_color_output(gif::ColorOutput::RGBA);
            let mut decoder = options.read_info(bytes.as_slice()).unwrap();
            let mut canvas = vec![[0; 4]; 40 * 30];
            let mut time = 0;
            for at in [1, 10, 10, 20] {
                let read = decoder.read_next_frame().unwrap().unwrap();
                if back[3] == 0 {
                    canvas.fill([0; 4]);
                }
                for (i, pixel) in read.buffer.chunks_exact(4).enumerate().filter(|(_, pixel)| pixel[3] == 255)
                {
                    let x = usize::from(read.left) + i % usize::from(read.width);
                    let y = usize::from(read.top) + i / usize::from(read.width);
                    canvas[40 * y + x] = pixel.try_into().unwrap();
                }
                time += read.delay;
                let wanted = frame(at, back);
                for (got, wanted) in canvas.iter().zip(wanted.rgba.chunks_exact(4)) {
                    let off = got.iter().zip(wanted).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
                    assert!(off <= 8, "{got:?} {wanted:?}");
                }
            }
            assert_eq!(time, 17, "4 frames of 1/24 s");
            assert_eq!(film(back), bytes, "the same bytes each time");
        }
    }

    #[test]
    fn an_empty_picture_has_a_palette() {
        assert_eq!(looked_at(&[]).len(), 4096);
        assert_eq!(&looked_at(&[frame(1, [0; 4])])[..4], [200, 30, 10, 255]);
    }
}
