//! A contact sheet: many poses, looks or figures side by side, with their names.

use std::path::Path;

use glam::Vec3;
use render::{Image, Look};
use rig::Camera;

use super::darkroom::Darkroom;
use super::facts::Facts;
use super::framing::fit;
use super::png::{Shape, write_rows};
use super::shot::{Shot, Viewpoint};
use super::subject::Subject;
use super::words::Writer;
use super::work::Work;
use crate::failure::Failure;

/// Pixels between tiles.
const GAP: u32 = 6;
/// A label's height as a share of the tile's width, and its letters' as a share of that.
const LABEL_SHARE: f32 = 0.1;
const LETTER_SHARE: f32 = 0.6;
/// A label is at least so high, so that it can be read, and at most.
const LABEL_PX: std::ops::RangeInclusive<f32> = 22.0..=96.0;

/// One picture of a sheet.
#[derive(Clone, Debug)]
pub struct Tile {
    /// What it shows.
    pub subject: Subject,
    /// How it is drawn.
    pub look: Look,
    /// What stands below it.
    pub title: String,
}

/// A sheet to be made.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// From left to right, then down; at least one.
    pub tiles: Vec<Tile>,
    /// How many stand side by side, at least one.
    pub columns: usize,
    /// Pixels of a picture without its label.
    pub tile_size: [u32; 2],
    /// From where; the zoom is over a figure that just fills its tile.
    pub viewpoint: Viewpoint,
    /// Whether names stand below the pictures.
    pub labels: bool,
    /// All at one scale, so that figures can be compared, instead of each as large as its tile.
    pub one_scale: bool,
}

/// A look on a plain ground, halfway between the colours of its own: tiles side by side are calmer so.
#[must_use]
pub fn on_plain(look: Look) -> Look {
    let [top, bottom] = [look.background_top, look.background_bottom];
    let plain = [0, 1, 2, 3].map(|i| top[i].midpoint(bottom[i]));
    Look { background_top: plain, background_bottom: plain, ..look }
}

impl Sheet {
    /// Draws the sheet into a PNG, a row of tiles at a time.
    ///
    /// # Errors
    /// A skin at fault, tiles larger than the device holds, a file that can't be written; the user has stopped it.
    pub fn write(
        &self,
        file: &Path,
        facts: &Facts,
        darkroom: &mut Darkroom,
        work: &Work,
    ) -> Result<(), Failure> {
        let [width, label] = [self.tile_size[0], self.label_height()];
        let limit = darkroom.gpu().max_edge();
        if self.labels && width > limit {
            return Err(Failure::Input(format!("a tile with a label is at most {limit} pixels wide here")));
        }
        let mut writer = self.labels.then(|| Writer::new(darkroom.gpu(), [width, label]));
        work.begin(self.tiles.len() as u64, "tiles");
        let cameras = self.cameras();
        let clear = self.tiles.iter().any(|tile| tile.look.transparent);
        let shape = Shape { size: self.size(), alpha: clear };
        write_rows(file, shape, facts, |rows| {
            let row_bytes = 4 * shape.size[0] as usize;
            let gap = ground(&self.tiles[0].look).repeat(row_bytes / 4 * GAP as usize);
            rows.take(&gap)?;
            for (row, tiles) in self.tiles.chunks(self.columns.max(1)).enumerate() {
                let mut band = ground(&self.tiles[0].look).repeat(row_bytes / 4 * self.row_height() as usize);
                for (column, tile) in tiles.iter().enumerate() {
                    let camera = cameras[row * self.columns.max(1) + column];
                    let shot = Shot { look: tile.look, ..Shot::new(self.tile_size) };
                    let left = GAP + column as u32 * (width + GAP);
                    put(&mut band, row_bytes, &darkroom.image(&tile.subject, camera, &shot)?, [left, 0]);
                    if let Some(writer) = &mut writer {
                        let words = self.label(writer, tile)?;
                        put(&mut band, row_bytes, &words, [left, self.tile_size[1]]);
                    }
                    work.step()?;
                }
                rows.take(&band)?;
                rows.take(&gap)?;
            }
            Ok(())
        })?;
        work.end();
        Ok(())
    }

    /// Width and height of the whole, pixels.
    pub fn size(&self) -> [u32; 2] {
        let columns = self.columns.clamp(1, self.tiles.len().max(1)) as u32;
        let rows = self.tiles.len().div_ceil(self.columns.max(1)) as u32;
        [GAP + columns * (self.tile_size[0] + GAP), GAP + rows * (self.row_height() + GAP)]
    }

    fn label_height(&self) -> u32 {
        let height = self.tile_size[0] as f32 * LABEL_SHARE;
        height.clamp(*LABEL_PX.start(), *LABEL_PX.end()).round() as u32
    }

    fn row_height(&self) -> u32 {
        self.tile_size[1] + if self.labels { self.label_height() } else { 0 }
    }

    fn label(&self, writer: &mut Writer, tile: &Tile) -> Result<Image, Failure> {
        let back = if tile.look.transparent { [0; 4] } else { tile.look.background_bottom };
        let dark = luminance(back) < 128 && !tile.look.transparent;
        let color = if dark { [232; 3] } else { [64; 3] };
        writer.line(&tile.title, self.label_height() as f32 * LETTER_SHARE, color, back)
    }

    /// Where each tile is seen from.
    fn cameras(&self) -> Vec<Camera> {
        let aspect = self.tile_size[0] as f32 / self.tile_size[1].max(1) as f32;
        let points: Vec<Vec<Vec3>> = self.tiles.iter().map(|tile| tile.subject.points()).collect();
        let all = if self.one_scale { points.concat() } else { Vec::new() };
        let of = |(tile, points): (&Tile, &Vec<Vec3>)| {
            let first = self.viewpoint.camera(tile.subject.bounds(), aspect);
            let mut camera = fit(first, if self.one_scale { &all } else { points }, aspect);
            camera.zoom(1.0 / self.viewpoint.zoom, camera.target);
            camera
        };
        self.tiles.iter().zip(&points).map(of).collect()
    }
}

/// A pixel between tiles: darker than their own ground, or clear.
fn ground(look: &Look) -> [u8; 4] {
    let [r, g, b, _] = look.background_bottom;
    let darker = |c: u8| (u16::from(c) * 7 / 10) as u8;
    if look.transparent { [0; 4] } else { [darker(r), darker(g), darker(b), 255] }
}

fn luminance([r, g, b, _]: [u8; 4]) -> u32 {
    (2 * u32::from(r) + 5 * u32::from(g) + u32::from(b)) / 8
}

/// Copies a picture into rows of so many bytes; what would be beyond them is left out.
fn put(rows: &mut [u8], row_bytes: usize, image: &Image, [left, top]: [u32; 2]) {
    let wide = 4 * image.width as usize;
    for (y, line) in image.rgba.chunks_exact(wide.max(4)).enumerate() {
        let at = (top as usize + y) * row_bytes + 4 * left as usize;
        if let Some(place) = rows.get_mut(at..at + wide) {
            place.copy_from_slice(line);
        }
    }
}
