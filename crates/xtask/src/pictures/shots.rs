//! The pictures of the README and the guide: one table, and how a row of it becomes pixels.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, RgbImage, imageops};

/// Where the pictures are, from the top of the project.
pub const FOLDER: &str = "docs/pictures";

/// A picture: one or several tiles of the same size, in rows.
#[derive(Debug)]
pub struct Picture {
    /// Its file's name in [`FOLDER`].
    pub name: &'static str,
    /// How many tiles stand side by side.
    columns: u32,
    /// From left to right, then down.
    tiles: &'static [Tile],
}

/// What `posewright render` draws, and which part of that is shown.
#[derive(Debug)]
struct Tile {
    /// The pose or script, from the top of the project.
    file: &'static str,
    /// Options of `render`, with blanks between them.
    options: &'static str,
    /// Left, top, width and height in pixels of the rendered picture.
    crop: [u32; 4],
}

const fn tile(file: &'static str, options: &'static str, crop: [u32; 4]) -> Tile {
    Tile { file, options, crop }
}

const fn sample(file: &'static str) -> Tile {
    tile(file, "--size 360x360", [70, 10, 220, 342])
}

const fn pass(options: &'static str) -> Tile {
    tile("assets/poses/running.pose.ron", options, [90, 20, 192, 340])
}

const fn half(file: &'static str) -> Tile {
    tile(file, "--size 480x480", [80, 8, 320, 464])
}

const fn elbow(file: &'static str) -> Tile {
    tile(file, "--size 900x900 --view front", [300, 40, 320, 320])
}

const fn wrist(file: &'static str) -> Tile {
    tile(file, "--size 900x900 --view left", [265, 50, 320, 360])
}

const fn contact(file: &'static str) -> Tile {
    tile(file, "--size 640x640", [160, 40, 320, 560])
}

/// Every picture.
pub const TABLE: &[Picture] = &[
    Picture {
        name: "hero.png",
        columns: 1,
        tiles: &[tile("docs/guide/scripts/hero.script.ron", "--size 1440x960", [120, 80, 1200, 800])],
    },
    Picture {
        name: "window.png",
        columns: 1,
        tiles: &[tile(
            "docs/guide/scripts/elbow-between.script.ron",
            "--ui --size 1280x800",
            [0, 0, 1280, 800],
        )],
    },
    Picture {
        name: "poses.png",
        columns: 4,
        tiles: &[
            sample("assets/poses/standing.pose.ron"),
            sample("assets/poses/contrapposto.pose.ron"),
            sample("assets/poses/thinker.pose.ron"),
            sample("assets/poses/reaching-up.pose.ron"),
            sample("assets/poses/running.pose.ron"),
            sample("assets/poses/kneeling.pose.ron"),
            sample("assets/poses/waving.pose.ron"),
            sample("assets/poses/idea.pose.ron"),
        ],
    },
    Picture {
        name: "passes.png",
        columns: 5,
        tiles: &[
            pass("--size 400x400 --pass color"),
            pass("--size 400x400 --pass depth"),
            pass("--size 400x400 --pass normal"),
            pass("--size 400x400 --pass silhouette"),
            pass("--size 400x400 --pass openpose"),
        ],
    },
    Picture {
        name: "elbow.png",
        columns: 3,
        tiles: &[
            elbow("docs/guide/scripts/elbow-down.script.ron"),
            elbow("docs/guide/scripts/elbow-between.script.ron"),
            elbow("docs/guide/scripts/elbow-up.script.ron"),
        ],
    },
    Picture {
        name: "wrist.png",
        columns: 3,
        tiles: &[
            wrist("docs/guide/scripts/wrist-back.script.ron"),
            wrist("docs/guide/scripts/wrist-straight.script.ron"),
            wrist("docs/guide/scripts/wrist-bent.script.ron"),
        ],
    },
    Picture {
        name: "contacts.png",
        columns: 3,
        tiles: &[
            contact("assets/scripts/palms-together.script.ron"),
            contact("assets/scripts/hand-on-hip.script.ron"),
            contact("assets/scripts/hand-on-table.script.ron"),
        ],
    },
    Picture {
        name: "mirrored.png",
        columns: 2,
        tiles: &[half("assets/poses/waving.pose.ron"), half("docs/guide/scripts/mirrored.script.ron")],
    },
    Picture {
        name: "partial.png",
        columns: 2,
        tiles: &[half("assets/poses/standing.pose.ron"), half("docs/guide/scripts/partial.script.ron")],
    },
];

impl Picture {
    /// Renders the tiles with the program and puts them together.
    ///
    /// # Errors
    /// The program fails, for want of a graphics adapter for example; a crop exceeds what was rendered.
    pub fn make(&self, program: &Path, root: &Path) -> Result<RgbImage> {
        let parts: Vec<RgbImage> =
            self.tiles.iter().map(|tile| tile.make(program, root)).collect::<Result<_>>()?;
        let (width, height) = parts.first().context("a picture without tiles")?.dimensions();
        let rows = (parts.len() as u32).div_ceil(self.columns);
        let mut whole = RgbImage::new(width * self.columns, height * rows);
        for (i, part) in (0..).zip(&parts) {
            let (column, row) = (i % self.columns, i / self.columns);
            imageops::replace(&mut whole, part, i64::from(column * width), i64::from(row * height));
        }
        Ok(whole)
    }
}

impl Tile {
    fn make(&self, program: &Path, root: &Path) -> Result<RgbImage> {
        let file = std::env::temp_dir().join(format!("posewright-picture-{}.png", std::process::id()));
        let mut command = Command::new(program);
        command.arg("render").arg(root.join(self.file)).args(self.options.split_whitespace());
        let output = command.arg("--output").arg(&file).output().context("starting posewright")?;
        let said = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{} {}: {said}", self.file, self.options);
        let rendered = image::open(&file)?.into_rgb8();
        std::fs::remove_file(&file)?;
        let [left, top, width, height] = self.crop;
        let fits = left + width <= rendered.width() && top + height <= rendered.height();
        ensure!(fits, "{}: the crop is larger than the picture", self.file);
        Ok(imageops::crop_imm(&rendered, left, top, width, height).to_image())
    }
}

/// A picture as a PNG, packed as small as goes.
///
/// # Errors
/// The encoder fails.
pub fn png(picture: &RgbImage) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive).write_image(
        picture,
        picture.width(),
        picture.height(),
        ExtendedColorType::Rgb8,
    )?;
    Ok(bytes)
}
