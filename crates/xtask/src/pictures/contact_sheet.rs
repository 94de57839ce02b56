//! Pictures that `posewright sheet` makes: the contact sheet of the README, the looks, the bodies.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use image::{RgbImage, imageops};

/// A picture of one or several parts, one below the other, all equally wide.
#[derive(Debug)]
pub struct Sheet {
    /// Its file's name among the pictures.
    pub name: &'static str,
    parts: &'static [Part],
}

/// What one call of the program draws.
#[derive(Debug)]
struct Part {
    /// Poses of the library.
    poses: &'static [&'static str],
    /// Figures of the program's own, from the top of the project; none is the mannequin.
    figures: &'static [&'static str],
    /// Further options of `sheet`, with blanks between them.
    options: &'static str,
}

/// Every such picture.
pub const SHEETS: &[Sheet] = &[
    Sheet {
        name: "sheet.png",
        parts: &[
            Part {
                poses: &[
                    "standing",
                    "contrapposto",
                    "thinker",
                    "waving",
                    "walking",
                    "running",
                    "hands-on-hips",
                    "arms-crossed",
                    "reading",
                    "reaching-up",
                    "pointing",
                    "shrug",
                    "cheering",
                    "facepalm",
                    "bow",
                    "sitting",
                    "hugging-knees",
                    "kneeling",
                    "lying-side",
                    "jumping",
                    "throwing",
                    "lunge",
                    "kick",
                    "sign-i-love-you",
                ],
                figures: &[],
                options: "--columns 8 --size 111x138",
            },
            Part {
                poses: &["contrapposto"],
                figures: &[],
                options: "--look clay,matcap,flat,line --columns 4 --size 228x290",
            },
            Part {
                poses: &["standing"],
                figures: &[
                    "assets/figures/child.figure.ron",
                    "assets/figures/mannequin.figure.ron",
                    "assets/figures/heroic.figure.ron",
                    "assets/figures/elderly.figure.ron",
                ],
                options: "--one-scale --columns 4 --size 228x290",
            },
        ],
    },
    Sheet {
        name: "looks.png",
        parts: &[
            Part {
                poses: &["thinker"],
                figures: &[],
                options: "--look studio,clay,matcap --columns 3 --size 300x330",
            },
            Part {
                poses: &["thinker"],
                figures: &[],
                options: "--look flat,line,wood --columns 3 --size 300x330",
            },
        ],
    },
    Sheet {
        name: "figures.png",
        parts: &[Part {
            poses: &["standing"],
            figures: &[
                "assets/figures/child.figure.ron",
                "assets/figures/woman.figure.ron",
                "assets/figures/mannequin.figure.ron",
                "assets/figures/man.figure.ron",
                "assets/figures/heroic.figure.ron",
                "assets/figures/elderly.figure.ron",
            ],
            options: "--one-scale --columns 6 --size 150x290",
        }],
    },
];

impl Sheet {
    /// Renders the parts with the program and puts them together.
    ///
    /// # Errors
    /// The program fails, for want of a graphics adapter for example; parts that are not equally wide.
    pub fn make(&self, program: &Path, root: &Path) -> Result<RgbImage> {
        let parts: Vec<RgbImage> =
            self.parts.iter().map(|part| part.make(program, root)).collect::<Result<_>>()?;
        let width = parts.first().map_or(0, RgbImage::width);
        ensure!(parts.iter().all(|part| part.width() == width), "{}: parts are not equally wide", self.name);
        let mut whole = RgbImage::new(width, parts.iter().map(RgbImage::height).sum());
        let mut top = 0;
        for part in &parts {
            imageops::replace(&mut whole, part, 0, top);
            top += i64::from(part.height());
        }
        Ok(whole)
    }
}

impl Part {
    fn make(&self, program: &Path, root: &Path) -> Result<RgbImage> {
        let file = std::env::temp_dir().join(format!("posewright-sheet-{}.png", std::process::id()));
        let mut command = Command::new(program);
        command.arg("sheet").args(self.poses.iter().map(|pose| format!("library:{pose}.pose.ron")));
        for figure in self.figures {
            command.arg("--figure").arg(root.join(figure));
        }
        command.args(self.options.split_whitespace()).args(["--labels", "--ground", "shadow"]);
        let output = command.arg("--output").arg(&file).output().context("starting posewright")?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let drawn = image::open(&file)?.into_rgb8();
        std::fs::remove_file(&file)?;
        Ok(drawn)
    }
}
