//! Pictures of any size: drawn in pieces that the device can hold, and handed over a band of rows at a time.

use crate::image::read;
use crate::renderer::Renderer;
use crate::scene::{Look, Pass, Scene};
use crate::tile::Tile;
use crate::{DrawError, Image};

/// The longest edge of a picture of any kind, pixels.
pub(crate) const GREATEST_EDGE: u32 = 100_000;
/// The longest edge of a piece, drawn pixels.
pub(crate) const PIECE_EDGE: u32 = 2048;
/// Pixels drawn at once: textures of a piece take some forty bytes each.
const PIECE_PIXELS: u32 = 2048 * 1280;
/// Bytes of a band at most, unless a single row has more.
const BAND_BYTES: u64 = 64 << 20;

/// Rows of a picture, from one edge to the other.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Band {
    /// The topmost row's number in the whole picture.
    pub first_row: u32,
    /// The rows; as wide as the picture.
    pub image: Image,
}

/// How a picture is cut, in pixels of the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Cuts {
    /// Size of a piece; those at the right and lower edge may be smaller.
    piece: [u32; 2],
    /// Drawn pixels along a pixel's edge.
    samples: u32,
}

impl Cuts {
    fn of(scene: &Scene<'_>, edge: u32) -> Cuts {
        let mixes = matches!(scene.pass, Pass::Color | Pass::Silhouette | Pass::OpenPose);
        let samples = if mixes { scene.look.supersampling.clamp(1, 4) } else { 1 };
        let [width, height] = scene.size;
        let edge = (edge / samples).max(1);
        let across = width.min(edge);
        let by_pixels = (PIECE_PIXELS / (samples * samples) / across).max(1);
        let by_bytes = (BAND_BYTES / (4 * u64::from(width))).clamp(1, u64::from(u32::MAX)) as u32;
        Cuts { piece: [across, height.min(edge).min(by_pixels).min(by_bytes)], samples }
    }
}

impl Renderer {
    /// Draws a scene at full resolution and reads the picture back, in pieces if it is large.
    ///
    /// A picture in pieces is that drawn at once, but for rounding: a pixel at an edge may take one sample more or less.
    /// For pictures that are too large for memory there is [`Renderer::bands`].
    ///
    /// # Errors
    /// An edge of no pixels or more than 100,000, a figure whose slot is empty, more bytes than there is memory, and
    /// [`DrawError::Driver`] if the driver complains or the device is lost.
    pub fn image(&mut self, scene: &Scene<'_>) -> Result<Image, DrawError> {
        let [width, height] = scene.size;
        let mut rgba = Vec::new();
        self.bands(scene, |band| {
            if band.image.height == height {
                rgba = band.image.rgba;
                return Ok(());
            }
            if rgba.is_empty() {
                let bytes = 4 * width as usize * height as usize;
                rgba.try_reserve_exact(bytes).map_err(|_| DrawError::Memory { width, height })?;
            }
            rgba.extend_from_slice(&band.image.rgba);
            Ok::<(), DrawError>(())
        })?;
        Ok(Image { width, height, rgba })
    }

    /// Draws a scene at full resolution and hands it over in bands from the top, each of at most some 64 MB. What is
    /// held at once does not depend on the picture's height.
    ///
    /// # Errors
    /// As [`Renderer::image`], and what `take` returns, which ends it.
    pub fn bands<E: From<DrawError>>(
        &mut self,
        scene: &Scene<'_>,
        mut take: impl FnMut(Band) -> Result<(), E>,
    ) -> Result<(), E> {
        self.check(scene, GREATEST_EDGE)?;
        let cuts = Cuts::of(scene, self.piece_edge());
        let [width, height] = scene.size;
        let mut first_row = 0;
        while first_row < height {
            let rows = cuts.piece[1].min(height - first_row);
            let image = if cuts.piece[0] == width {
                self.piece(scene, cuts.samples, [0, first_row], [width, rows])?
            } else {
                self.row_of_pieces(scene, cuts, first_row, rows)?
            };
            take(Band { first_row, image })?;
            first_row += rows;
        }
        Ok(())
    }

    fn row_of_pieces(
        &mut self,
        scene: &Scene<'_>,
        cuts: Cuts,
        first_row: u32,
        rows: u32,
    ) -> Result<Image, DrawError> {
        let width = scene.size[0];
        let mut rgba = vec![0; 4 * width as usize * rows as usize];
        let mut first = 0;
        while first < width {
            let across = cuts.piece[0].min(width - first);
            let piece = self.piece(scene, cuts.samples, [first, first_row], [across, rows])?;
            let into = rgba.chunks_exact_mut(4 * width as usize);
            for (row, from) in into.zip(piece.rgba.chunks_exact(4 * across as usize)) {
                row[4 * first as usize..][..from.len()].copy_from_slice(from);
            }
            first += across;
        }
        Ok(Image { width, height: rows, rgba })
    }

    /// A part of the picture, given by its upper left pixel and its size.
    fn piece(
        &mut self,
        scene: &Scene<'_>,
        samples: u32,
        origin: [u32; 2],
        size: [u32; 2],
    ) -> Result<Image, DrawError> {
        let full = Scene { look: Look { scale: 1.0, ..scene.look }, ..scene.clone() };
        let drawn = |pixels: [u32; 2]| pixels.map(|p| p * samples);
        let tile = Tile { whole: drawn(scene.size), origin: drawn(origin), size: drawn(size) };
        let gpu = self.gpu().clone();
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("image") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        self.draw_tile(&mut encoder, &full, tile)?;
        let picture = self.picture().ok_or_else(|| DrawError::Driver("no picture".to_owned()))?;
        let mut image = averaged(read(&gpu, encoder, picture)?, samples);
        if scene.look.transparent && scene.pass == Pass::Color {
            image.rgba.chunks_exact_mut(4).for_each(straighten);
        }
        Ok(image)
    }
}

/// One pixel for each square of so many.
fn averaged(image: Image, samples: u32) -> Image {
    if samples <= 1 {
        return image;
    }
    let n = samples as usize;
    let (width, height) = (image.width / samples, image.height / samples);
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    let count = samples * samples;
    for rows in image.rgba.chunks_exact(4 * n * image.width as usize) {
        let rows: Vec<&[u8]> = rows.chunks_exact(4 * image.width as usize).collect();
        for x in 0..width as usize {
            for channel in 0..4 {
                let sum: u32 = rows
                    .iter()
                    .flat_map(|row| (0..n).map(move |k| u32::from(row[4 * (x * n + k) + channel])))
                    .sum();
                rgba.push(((sum + count / 2) / count) as u8);
            }
        }
    }
    Image { width, height, rgba }
}

/// From colour times alpha to the colour itself.
fn straighten(pixel: &mut [u8]) {
    let [r, g, b, a] = pixel else { return };
    if *a == 0 {
        return;
    }
    let alpha = u16::from(*a);
    for c in [r, g, b] {
        *c = ((u16::from(*c) * 255 + alpha / 2) / alpha).min(255) as u8;
    }
}

#[cfg(test)]
mod tests {
    use rig::Camera;

    use super::*;

    #[test]
    fn pieces_stay_within_what_the_device_and_memory_hold() {
        for size in [[1, 1], [1280, 800], [20_000, 20_000], [100_000, 3], [3, 100_000], [4096, 4096]] {
            for (supersampling, edge) in [(1, PIECE_EDGE), (2, PIECE_EDGE), (4, 64), (0, 1), (99, 7)] {
                let mut scene = Scene::new(&[], Camera::default(), size);
                scene.look.supersampling = supersampling;
                let Cuts { piece: [width, height], samples } = Cuts::of(&scene, edge);
                assert!((1..=4).contains(&samples) && width >= 1 && height >= 1);
                assert!(width <= size[0] && height <= size[1]);
                assert!(width * samples <= edge.max(samples) && height * samples <= edge.max(samples));
                assert!(u64::from(height) * u64::from(size[0]) * 4 <= BAND_BYTES || height == 1);
            }
        }
        let scene = Scene::new(&[], Camera::default(), [1920, 1200]);
        assert_eq!(Cuts::of(&scene, PIECE_EDGE).piece, [1920, 1200], "usual pictures are drawn at once");
    }

    #[test]
    fn squares_are_averaged() {
        let rgba = [[0_u8; 4], [4; 4], [8; 4], [255; 4], [2; 4], [6; 4], [9; 4], [255; 4]].concat();
        let image = averaged(Image { width: 4, height: 2, rgba }, 2);
        assert_eq!((image.width, image.height), (2, 1));
        assert_eq!(image.rgba, [[3; 4], [132; 4]].concat());
    }
}
