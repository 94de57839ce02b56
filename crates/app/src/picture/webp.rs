//! WebP files, still and animated, without loss: each frame holds what differs from the one before.
//!
//! The `image-webp` crate packs the pixels; the container (RIFF with `VP8X`, `ANIM`, `ANMF`, `XMP `) is written here
//! after Google's "WebP Container Specification".

use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use image_webp::{ColorType, WebPEncoder};
use render::Image;

use super::changed::changed;
use super::facts::Facts;
use crate::disk::Draft;
use crate::failure::Failure;

const HAS_ANIMATION: u8 = 0x02;
const HAS_XMP: u8 = 0x04;
const HAS_ALPHA: u8 = 0x10;
/// The longest edge that the format holds, pixels.
const MOST_EDGE: u32 = 1 << 14;
/// The size of a file stands at this byte.
const SIZE_AT: u64 = 4;

/// A WebP in the making.
pub struct WebP {
    draft: Draft,
    place: PathBuf,
    alpha: bool,
    xmp: Vec<u8>,
    former: Option<Image>,
}

impl WebP {
    /// Begins a file; `moving` if it gets several frames.
    ///
    /// # Errors
    /// A size that the format can't hold, a folder that can't be written.
    pub fn begin(
        place: &Path,
        size: [u32; 2],
        alpha: bool,
        facts: &Facts,
        moving: bool,
    ) -> Result<WebP, Failure> {
        if size.iter().any(|edge| !(1..=MOST_EDGE).contains(edge)) {
            let [width, height] = size;
            let message =
                format!("a WebP of {width}x{height} pixels can't be: each edge must be 1 to {MOST_EDGE}");
            return Err(Failure::Input(message));
        }
        let mut webp = WebP {
            draft: Draft::begin(place)?,
            place: place.to_owned(),
            alpha,
            xmp: facts.xmp().into_bytes(),
            former: None,
        };
        let mut flags = HAS_XMP;
        flags |= if alpha { HAS_ALPHA } else { 0 };
        flags |= if moving { HAS_ANIMATION } else { 0 };
        let mut header = vec![flags, 0, 0, 0];
        header.extend(three(size[0] - 1));
        header.extend(three(size[1] - 1));
        webp.put(b"RIFF\0\0\0\0WEBP")?;
        webp.chunk(b"VP8X", &header)?;
        if moving {
            // A clear background, and without end.
            webp.chunk(b"ANIM", &[0; 6])?;
        }
        Ok(webp)
    }

    /// The only picture.
    ///
    /// # Errors
    /// A full disk.
    pub fn still(&mut self, image: &Image) -> Result<(), Failure> {
        let packed = self.packed(&image.rgba, image.width, image.height)?;
        self.put(&packed)
    }

    /// The next frame, shown for so many milliseconds.
    ///
    /// # Errors
    /// A full disk.
    pub fn frame(&mut self, image: &Image, milliseconds: u32) -> Result<(), Failure> {
        let [left, top, width, height] = changed(self.former.as_ref(), image);
        let mut pixels = Vec::with_capacity(4 * width as usize * height as usize);
        for y in top..top + height {
            let row = 4 * (y as usize * image.width as usize + left as usize);
            pixels.extend(image.rgba.iter().skip(row).take(4 * width as usize));
        }
        let mut frame: Vec<u8> = Vec::new();
        for number in [left / 2, top / 2, width - 1, height - 1, milliseconds] {
            frame.extend(three(number));
        }
        // It takes the place of what was there. Blending would save bytes, but decoders round it differently.
        const REPLACES: u8 = 0x02;
        frame.push(REPLACES);
        frame.extend(self.packed(&pixels, width, height)?);
        self.chunk(b"ANMF", &frame)?;
        self.former = Some(image.clone());
        Ok(())
    }

    /// The file is whole.
    ///
    /// # Errors
    /// A full disk; a file beyond 4 GB.
    pub fn finish(mut self) -> Result<(), Failure> {
        let xmp = std::mem::take(&mut self.xmp);
        self.chunk(b"XMP ", &xmp)?;
        let length = self.draft.stream_position().map_err(|e| Draft::fault(&self.place, &e))?;
        let size = u32::try_from(length - 8)
            .map_err(|_| Failure::Input(format!("{}: larger than 4 GB", self.place.display())))?;
        let sized = self.draft.seek(SeekFrom::Start(SIZE_AT));
        sized.map_err(|e| Draft::fault(&self.place, &e))?;
        self.put(&size.to_le_bytes())?;
        self.draft.finish()
    }

    /// Pixels as a chunk of their own.
    fn packed(&self, rgba: &[u8], width: u32, height: u32) -> Result<Vec<u8>, Failure> {
        let mut file = Vec::new();
        let encoder = WebPEncoder::new(&mut file);
        let packed = if self.alpha {
            encoder.encode(rgba, width, height, ColorType::Rgba8)
        } else {
            let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
            encoder.encode(&rgb, width, height, ColorType::Rgb8)
        };
        packed.map_err(|e| Failure::Input(format!("{}: {e}", self.place.display())))?;
        // Behind the header of a file stands the chunk that frames hold.
        Ok(file.split_off(12.min(file.len())))
    }

    fn chunk(&mut self, name: &[u8; 4], content: &[u8]) -> Result<(), Failure> {
        let size = u32::try_from(content.len())
            .map_err(|_| Failure::Input(format!("{}: larger than 4 GB", self.place.display())))?;
        self.put(name)?;
        self.put(&size.to_le_bytes())?;
        self.put(content)?;
        // Chunks begin at even bytes.
        if content.len() % 2 == 1 { self.put(&[0]) } else { Ok(()) }
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.draft.write_all(bytes).map_err(|e| Draft::fault(&self.place, &e))
    }
}

/// The lower three bytes.
fn three(number: u32) -> [u8; 3] {
    let [a, b, c, _] = number.to_le_bytes();
    [a, b, c]
}

#[cfg(test)]
mod tests {
    use image_webp::WebPDecoder;

    use super::*;

    /// A square of one colour that moves over another.
    fn frame(at: u32, back: [u8; 4]) -> Image {
        let lit = |i: u32| (at..at + 3).contains(&(i % 16)) && (5..8).contains(&(i / 16));
        let rgba =
            (0..16 * 12).flat_map(|i| if lit(i) { [200, 30, 10 + at as u8, 255] } else { back }).collect();
        Image { width: 16, height: 12, rgba }
    }

    fn film(back: [u8; 4]) -> (Vec<Image>, Vec<u8>) {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.webp");
        let alpha = back[3] < 255;
        let frames: Vec<Image> = [1, 4, 4, 9].map(|at| frame(at, back)).into();
        let mut webp = WebP::begin(&file, [16, 12], alpha, &Facts::new("walk", "doll"), true).unwrap();
        frames.iter().for_each(|frame| webp.frame(frame, 40).unwrap());
        webp.finish().unwrap();
        (frames, std::fs::read(&file).unwrap())
    }

    #[test]
    fn every_frame_comes_back_to_the_bit() {
        for back in [[90, 100, 110, 255], [0, 0, 0, 0]] {
            let (frames, bytes) = film(back);
            let mut decoder = WebPDecoder::new(std::io::Cursor::new(&bytes)).unwrap();
            assert!(decoder.is_animated() && decoder.num_frames() == 4);
            for frame in &frames {
                let channels = if decoder.has_alpha() { 4 } else { 3 };
                let mut read = vec![0; decoder.output_buffer_size().unwrap()];
                assert_eq!(decoder.read_frame(&mut read).unwrap(), 40);
                let wanted: Vec<&[u8]> = frame.rgba.chunks_exact(4).map(|p| &p[..channels]).collect();
                assert_eq!(read.chunks_exact(channels).collect::<Vec<_>>(), wanted);
            }
            let xmp = decoder.xmp_metadata().unwrap().unwrap();
            assert!(String::from_utf8(xmp).unwrap().contains("walk"));
            assert_eq!(film(back).1, bytes, "the same bytes each time");
        }
    }

    #[test]
    fn a_still_comes_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.webp");
        let mut webp = WebP::begin(&file, [16, 12], true, &Facts::default(), false).unwrap();
        let image = frame(2, [0, 0, 0, 0]);
        webp.still(&image).unwrap();
        webp.finish().unwrap();
        let bytes = std::fs::read(&file).unwrap();
        let mut decoder = WebPDecoder::new(std::io::Cursor::new(&bytes)).unwrap();
        let mut read = vec![0; decoder.output_buffer_size().unwrap()];
        decoder.read_image(&mut read).unwrap();
        assert_eq!(read, image.rgba);
        assert!(WebP::begin(&file, [16385, 1], true, &Facts::default(), false).is_err());
    }
}
