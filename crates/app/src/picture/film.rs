//! Several frames: files of their own, or one that moves.

use render::Image;

use super::facts::Facts;
use super::gif::Gif;
use super::mp4::Mp4;
use super::naming::{Format, Naming};
use super::png::{Shape, write_rows};
use super::webp::WebP;
use super::work::Work;
use crate::failure::Failure;

/// So many frames are looked at for a GIF's palette.
const SAMPLES: usize = 6;

/// What is to be written.
#[derive(Clone, Debug)]
pub struct Film<'a> {
    /// Which file, or files.
    pub naming: &'a Naming,
    /// The pass's name.
    pub pass: &'a str,
    /// Pixels, and whether they can be clear.
    pub shape: Shape,
    /// How many.
    pub frames: usize,
    /// Frames a second.
    pub fps: u32,
    /// What the files say.
    pub facts: &'a Facts,
}

impl Film<'_> {
    /// Draws and writes all frames, `draw` being asked for one by its number. A file is whole or isn't there; of files
    /// for each frame, those that were finished stay.
    ///
    /// # Errors
    /// What `draw` finds wrong; a file that can't be written; the user has stopped it.
    pub fn write(
        &self,
        work: &Work,
        draw: impl FnMut(usize) -> Result<Image, Failure>,
    ) -> Result<(), Failure> {
        match self.naming.format {
            Format::Png => self.stills(work, draw),
            Format::WebP => self.webp(work, draw),
            Format::Gif => self.gif(work, draw),
            Format::Mp4 => self.mp4(work, draw),
        }
    }

    fn stills(
        &self,
        work: &Work,
        mut draw: impl FnMut(usize) -> Result<Image, Failure>,
    ) -> Result<(), Failure> {
        for i in 0..self.frames {
            let image = draw(i)?;
            let file = self.naming.file(self.pass, i);
            write_rows(&file, self.shape, self.facts, |rows| rows.take(&image.rgba))?;
            work.step()?;
        }
        Ok(())
    }

    fn webp(
        &self,
        work: &Work,
        mut draw: impl FnMut(usize) -> Result<Image, Failure>,
    ) -> Result<(), Failure> {
        let file = self.naming.file(self.pass, 0);
        let mut webp = WebP::begin(&file, self.shape.size, self.shape.alpha, self.facts, true)?;
        for i in 0..self.frames {
            let image = draw(i)?;
            webp.frame(&image, self.begins_ms(i + 1) - self.begins_ms(i))?;
            work.step()?;
        }
        webp.finish()
    }

    fn gif(&self, work: &Work, mut draw: impl FnMut(usize) -> Result<Image, Failure>) -> Result<(), Failure> {
        let file = self.naming.file(self.pass, 0);
        let looked_at = SAMPLES.min(self.frames);
        let mut samples = Vec::new();
        for i in 0..looked_at {
            samples.push(draw(i * self.frames / looked_at)?);
            work.check()?;
        }
        let mut gif = Gif::begin(&file, self.shape.size, self.shape.alpha, self.facts, &samples)?;
        for i in 0..self.frames {
            gif.frame(&draw(i)?, self.begins_ms(i + 1))?;
            work.step()?;
        }
        gif.finish()
    }

    fn mp4(&self, work: &Work, mut draw: impl FnMut(usize) -> Result<Image, Failure>) -> Result<(), Failure> {
        let file = self.naming.file(self.pass, 0);
        let mut mp4 = Mp4::begin(&file, self.shape.size, self.fps, self.facts)?;
        for i in 0..self.frames {
            let image = draw(i)?;
            // Ctrl+C stops ffmpeg as well; then the pipe is closed.
            work.check()?;
            mp4.frame(&image).or_else(|fault| work.check().and(Err(fault)))?;
            work.step()?;
        }
        mp4.finish()
    }

    /// When a frame begins, whole milliseconds from the first.
    fn begins_ms(&self, frame: usize) -> u32 {
        let ms = frame as u64 * 1000 / u64::from(self.fps.max(1));
        u32::try_from(ms).unwrap_or(u32::MAX)
    }
}
