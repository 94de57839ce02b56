//! The pictures of the README and the guide: one table, and how a row of it becomes pixels.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, RgbImage, imageops};

/// Where the pictures are, from the top of the project.
pub const FOLDER: &str = "docs/pictures";

/// Green, and what red and blue have more than it, are rounded to multiples of this: packed, a picture is half as large,
/// and no grey gets a tint.
const STEP: i16 = 3;

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

const STANDING: &str = "assets/poses/standing.pose.ron";
const ON_THE_NOSE: &str = "docs/guide/scripts/elbow-between.script.ron";

const fn sample(file: &'static str) -> Tile {
    tile(file, "--size 230x230", [42, 6, 146, 218])
}

const fn by_hand(file: &'static str) -> Tile {
    tile(file, "--size 400x400", [91, 8, 218, 384])
}

const fn pass(options: &'static str) -> Tile {
    tile("assets/poses/running.pose.ron", options, [72, 16, 154, 272])
}

const fn half(file: &'static str) -> Tile {
    tile(file, "--size 400x400", [70, 8, 260, 386])
}

const fn elbow(file: &'static str) -> Tile {
    tile(file, "--size 800x800 --view front", [265, 36, 285, 285])
}

const fn wrist(file: &'static str) -> Tile {
    tile(file, "--size 800x800 --view left", [252, 40, 300, 320])
}

const fn contact(file: &'static str) -> Tile {
    tile(file, "--size 400x400", [100, 12, 200, 376])
}

const fn guide(options: &'static str) -> Tile {
    tile(ON_THE_NOSE, options, [100, 82, 284, 296])
}

const fn chain(file: &'static str) -> Tile {
    tile(file, "--size 300x260", [10, 10, 280, 240])
}

/// The walk without foot placement and with it, from the left.
macro_rules! beside {
    ($options:literal) => {
        tile(
            STANDING,
            concat!("--ui --size 600x450 --walk-marks solepoints --do WalkBeside,Panel,Left ", $options),
            [0, 60, 600, 358],
        )
    };
}

/// Every picture.
pub const TABLE: &[Picture] = &[
    Picture {
        name: "hero.png",
        columns: 1,
        tiles: &[tile("docs/guide/scripts/hero.script.ron", "--size 1035x691", [85, 58, 864, 576])],
    },
    Picture {
        name: "window.png",
        columns: 1,
        tiles: &[tile(ON_THE_NOSE, "--ui --size 1120x700 --select leftUpperArm", [0, 0, 1120, 700])],
    },
    Picture {
        name: "chains.png",
        columns: 4,
        tiles: &[
            chain("assets/chains/excavator.chain.ron"),
            chain("assets/chains/snake.chain.ron"),
            chain("assets/chains/limb-lab.chain.ron"),
            chain("assets/chains/desk-lamp.chain.ron"),
        ],
    },
    Picture {
        name: "chain-window.png",
        columns: 1,
        tiles: &[tile("assets/scripts/excavator-dig.script.ron", "--ui --size 960x600", [0, 0, 960, 600])],
    },
    Picture {
        name: "walk-window.png",
        columns: 1,
        tiles: &[tile(
            STANDING,
            "--ui --size 960x600 --walked 3.2 --walk-on hills --walk-marks hiptofoot,hipsdrop,footprints",
            [0, 0, 960, 600],
        )],
    },
    Picture {
        name: "walk-beside.png",
        columns: 2,
        tiles: &[beside!("--walked 7.7 --walk-on hills"), beside!("--walked 2.5 --walk-on stairs")],
    },
    Picture {
        name: "light.png",
        columns: 1,
        tiles: &[tile(
            "assets/poses/sitting.pose.ron",
            "--ui --size 840x525 --select head --do Theme",
            [0, 0, 840, 525],
        )],
    },
    Picture {
        name: "grab.png",
        columns: 4,
        tiles: &[
            tile(
                STANDING,
                "--ui --size 640x640 --select leftUpperArm --pointer 325,430 \
                 --do Panel,FrameSelection,ZoomOut,ZoomOut,ZoomOut,SelectNone",
                [140, 104, 220, 410],
            ),
            tile(
                STANDING,
                "--ui --size 640x640 --select leftUpperArm --pointer 325,430 --drag-to 262,385 \
                 --do Panel,FrameSelection,ZoomOut,ZoomOut,ZoomOut,SelectNone",
                [140, 104, 220, 410],
            ),
            tile(
                STANDING,
                "--ui --size 640x640 --select leftUpperArm --pointer 310,527 --drag-to 225,300 \
                 --do Panel,FrameSelection,ZoomOut,ZoomOut,ZoomOut,SelectNone",
                [140, 104, 220, 410],
            ),
            tile(
                STANDING,
                "--ui --size 640x640 --pointer 313,310 --drag-to 280,350 --do Panel",
                [190, 146, 220, 410],
            ),
        ],
    },
    Picture {
        name: "rings.png",
        columns: 4,
        tiles: &[
            tile(
                STANDING,
                "--ui --size 640x640 --select leftUpperArm --do Panel,FrameSelection,ZoomOut,ZoomOut",
                [150, 90, 280, 300],
            ),
            tile(
                STANDING,
                "--ui --size 640x640 --select leftLowerArm --do Panel,FrameSelection,ZoomOut,ZoomOut \
                 --pointer 285,335 --drag-to 280,220",
                [130, 120, 280, 300],
            ),
            tile(
                ON_THE_NOSE,
                "--ui --size 640x640 --select leftHand --do Panel,TurnInContact,FrameSelection,ZoomOut,Front",
                [150, 130, 280, 300],
            ),
            tile(
                ON_THE_NOSE,
                "--ui --size 640x640 --select leftLowerArm --do Panel,Front,FrameSelection,ZoomOut,ZoomOut \
                 --pointer 357,373 --drag-to 385,300",
                [195, 160, 280, 300],
            ),
        ],
    },
    Picture {
        name: "by-hand.png",
        columns: 4,
        tiles: &[
            by_hand("docs/guide/poses/thinker.pose.ron"),
            by_hand("docs/guide/poses/hands-on-hips.pose.ron"),
            by_hand("docs/guide/poses/phone-at-the-ear.pose.ron"),
            by_hand("docs/guide/poses/arms-crossed.pose.ron"),
        ],
    },
    Picture {
        name: "marks.png",
        columns: 1,
        tiles: &[tile(
            "docs/guide/scripts/marks.script.ron",
            "--ui --size 900x900 --do Panel,Front",
            [245, 195, 440, 500],
        )],
    },
    Picture {
        name: "guides.png",
        columns: 4,
        tiles: &[
            guide(
                "--ui --size 480x480 --select leftUpperArm --guides leftArm:target,leftArm:line \
                   --do Panel,FrameSelection,ZoomOut,SelectNone",
            ),
            guide(
                "--ui --size 480x480 --select leftUpperArm --guides leftArm:outer,leftArm:inner \
                   --do Panel,FrameSelection,ZoomOut,ZoomOut,ZoomOut,SelectNone",
            ),
            guide(
                "--ui --size 480x480 --select leftUpperArm --guides leftArm:circle,leftArm:axes \
                   --do Panel,FrameSelection,ZoomOut,SelectNone",
            ),
            guide(
                "--ui --size 480x480 --select leftUpperArm --guides leftArm:grids \
                   --do Panel,FrameSelection,ZoomOut,ZoomOut,ZoomOut,SelectNone",
            ),
        ],
    },
    Picture {
        name: "views.png",
        columns: 1,
        tiles: &[tile(
            "assets/poses/pointing.pose.ron",
            "--ui --size 760x600 --do Panel,SecondView",
            [180, 34, 580, 540],
        )],
    },
    Picture {
        name: "library.png",
        columns: 1,
        tiles: &[tile(
            STANDING,
            "--ui --size 1060x660 --do Library --pointer 980,440 --drag-to 1230,440",
            [396, 34, 664, 600],
        )],
    },
    Picture {
        name: "poses.png",
        columns: 6,
        tiles: &[
            sample("assets/poses/contrapposto.pose.ron"),
            sample("assets/poses/walking.pose.ron"),
            sample("assets/poses/reading.pose.ron"),
            sample("assets/poses/shrug.pose.ron"),
            sample("assets/poses/cheering.pose.ron"),
            sample("assets/poses/sitting.pose.ron"),
            sample("assets/poses/hugging-knees.pose.ron"),
            sample("assets/poses/kneeling.pose.ron"),
            sample("assets/poses/running.pose.ron"),
            sample("assets/poses/throwing.pose.ron"),
            sample("assets/poses/lunge.pose.ron"),
            sample("assets/poses/sign-i-love-you.pose.ron"),
        ],
    },
    Picture {
        name: "passes.png",
        columns: 6,
        tiles: &[
            pass("--size 320x320 --pass color"),
            pass("--size 320x320 --pass depth"),
            pass("--size 320x320 --pass normal"),
            pass("--size 320x320 --pass silhouette"),
            pass("--size 320x320 --pass parts"),
            pass("--size 320x320 --pass openpose"),
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
        name: "partial.png",
        columns: 2,
        tiles: &[half(STANDING), half("docs/guide/scripts/partial.script.ron")],
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
        Ok(rounded(imageops::crop_imm(&rendered, left, top, width, height).to_image()))
    }
}

/// With colours of which there are fewer; once more changes nothing.
pub fn rounded(mut picture: RgbImage) -> RgbImage {
    picture.pixels_mut().for_each(|pixel| pixel.0 = rounded_pixel(pixel.0));
    picture
}

fn rounded_pixel([red, green, blue]: [u8; 3]) -> [u8; 3] {
    let round = |value: i16| (value + STEP / 2).div_euclid(STEP) * STEP;
    let channel = |value: i16| value.clamp(0, 255) as u8;
    let [red, green, blue] = [red, green, blue].map(i16::from);
    let grey = round(green);
    [channel(grey + round(red - green)), channel(grey), channel(grey + round(blue - green))]
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
