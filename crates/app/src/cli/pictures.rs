//! `render`: pictures of a pose, still or moving.

use std::path::{Path, PathBuf};

use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use render::{Look, Pass, Style};
use rig::{Projection, View};

use super::clip_frames::{self, FrameSpan};
use crate::failure::Failure;
use crate::finish::Finish;
use crate::load::{self, Kind};
use crate::picture::{
    Darkroom, Facts, Format, Moment, Naming, Order, Shot, Subject, Viewpoint, Work, title_of, turntable,
    write_png,
};
use crate::window::{Showing, chain_ui_picture, ui_picture};

/// As many frames a turntable has at most.
pub const MOST_FRAMES: u64 = 10_000;

/// What `render` is told.
#[derive(Args, Debug)]
pub struct RenderArguments {
    /// The pose, script, clip or figure file.
    file: PathBuf,
    /// What to write: .png, .webp, .gif or .mp4; several frames as PNG need a folder/ or frame-%04d.png, several passes
    /// {pass}.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Another figure, *.figure.ron.
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    shot: ShotArguments,
    #[command(flatten)]
    floor: FloorArguments,
    /// Turns the view once around the figure in so many frames.
    #[arg(long, value_name = "FRAMES", value_parser = RangedU64ValueParser::<u64>::new().range(1..=MOST_FRAMES))]
    turntable: Option<u64>,
    /// Frames a second; a GIF can hold at most 50.
    #[arg(long, default_value_t = 24, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=120))]
    fps: u32,
    /// Of a clip, the frames A to B, both included, or one; 0 is how it begins. Without it a still shows how the clip begins and
    /// what moves or is numbered all of it.
    #[arg(long, value_name = "A..B", conflicts_with_all = ["turntable", "ui"])]
    frames: Option<FrameSpan>,
    /// Writes the keypoints as well: the JSON of OpenPose, BODY_25 and hands, in pixels and in metres.
    #[arg(long, value_name = "JSON")]
    keypoints: Option<PathBuf>,
    /// Draws the whole window with its panels.
    #[arg(long, conflicts_with_all = ["turntable", "keypoints"])]
    ui: bool,
    #[command(flatten)]
    showing: Showing,
}

/// Which pictures, from where, and how they look.
#[derive(Args, Debug)]
pub struct ShotArguments {
    /// Pixels; stills may be larger than the graphics adapter's limit.
    #[arg(long, default_value = "1280x800", value_parser = super::size, value_name = "WxH")]
    size: [u32; 2],
    /// What each pixel says; several with commas between them.
    #[arg(long, default_value = "color", value_delimiter = ',')]
    pass: Vec<PassName>,
    #[command(flatten)]
    viewpoint: ViewArguments,
    /// What the figure is made of and drawn with.
    #[arg(long = "look", default_value = "studio", value_name = "LOOK")]
    style: StyleName,
    #[command(flatten)]
    look: LookArguments,
}

impl ShotArguments {
    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// From where.
    pub fn viewpoint(&self) -> Viewpoint {
        self.viewpoint.viewpoint()
    }

    /// From where, and if no direction is told, from there about the vertical and above the horizon, degrees.
    pub fn viewpoint_or(&self, yaw_deg: f32, pitch_deg: f32) -> Viewpoint {
        let told = self.viewpoint();
        match self.viewpoint.view {
            Some(_) => told,
            None => Viewpoint {
                yaw_deg: told.yaw_deg.or(Some(yaw_deg)),
                pitch_deg: told.pitch_deg.or(Some(pitch_deg)),
                ..told
            },
        }
    }

    /// How the colour picture looks.
    pub fn look(&self) -> Look {
        self.look.look(self.style)
    }

    /// Whether the surroundings are bright.
    pub fn is_bright(&self) -> bool {
        self.look.background == Background::Light
    }

    /// An order for these pictures.
    ///
    /// # Errors
    /// An output that no picture has.
    pub fn order(
        &self,
        title: String,
        moments: Vec<Moment>,
        output: &Path,
        fps: u32,
    ) -> Result<Order, Failure> {
        Ok(Order {
            title,
            moments,
            size: self.size,
            passes: self.pass.iter().map(|pass| Pass::from(*pass)).collect(),
            look: self.look(),
            naming: Naming::of(output)?,
            fps,
            keypoints: None,
        })
    }
}

/// From where.
#[derive(Args, Debug)]
struct ViewArguments {
    /// From where: front, back, left, right, top, bottom or three-quarter, which is what is seen if nothing else is told; a walk
    /// is then seen from its right, somewhat ahead.
    #[arg(long)]
    view: Option<View>,
    /// About the vertical in place of the view's: 0 before the figure, 90 at its left.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    yaw: Option<f32>,
    /// Above the horizon in place of the view's, -90 to 90.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite)]
    pitch: Option<f32>,
    /// Times nearer than where the whole figure is just inside.
    #[arg(long, default_value = "1", value_name = "TIMES", value_parser = zoom)]
    zoom: f32,
    /// Without perspective.
    #[arg(long)]
    orthographic: bool,
}

impl ViewArguments {
    fn viewpoint(&self) -> Viewpoint {
        let projection = if self.orthographic { Projection::Orthographic } else { Projection::Perspective };
        let view = self.view.unwrap_or(View::ThreeQuarter);
        Viewpoint { view, yaw_deg: self.yaw, pitch_deg: self.pitch, zoom: self.zoom, projection }
    }
}

/// How the colour picture looks.
#[derive(Args, Clone, Copy, Debug)]
pub struct LookArguments {
    /// In joint planes, as on a wooden lay figure.
    #[arg(long)]
    wood: bool,
    /// Leaves the background clear.
    #[arg(long)]
    transparent: bool,
    /// Dark or light surroundings.
    #[arg(long, default_value = "dark")]
    background: Background,
    /// Draws larger along each edge and averages: smoother, slower.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4))]
    supersampling: u32,
}

impl LookArguments {
    /// As told, in the look of that name.
    pub fn look(self, name: StyleName) -> Look {
        Look {
            style: name.into(),
            joint_planes: self.wood || name == StyleName::Wood,
            transparent: self.transparent,
            supersampling: self.supersampling,
            ..Look::default()
        }
        .in_surroundings(self.background == Background::Light)
    }
}

/// What is on the level ground.
#[derive(Args, Clone, Copy, Debug)]
pub struct FloorArguments {
    /// What is on the ground: the grid and the shadow, the shadow alone, or nothing.
    #[arg(long, default_value = "grid")]
    ground: Ground,
}

impl FloorArguments {
    /// The look with such ground.
    pub fn on(self, look: Look) -> Look {
        Look { grid: self.ground == Ground::Grid, ground_shadow: self.ground != Ground::None, ..look }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum, Debug)]
enum Ground {
    Grid,
    Shadow,
    None,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum, Debug)]
enum Background {
    Dark,
    Light,
}

#[derive(Clone, Copy, ValueEnum, Debug)]
enum PassName {
    Color,
    Depth,
    Normal,
    Silhouette,
    Parts,
    Openpose,
}

impl From<PassName> for Pass {
    fn from(name: PassName) -> Pass {
        match name {
            PassName::Color => Pass::Color,
            PassName::Depth => Pass::Depth,
            PassName::Normal => Pass::Normal,
            PassName::Silhouette => Pass::Silhouette,
            PassName::Parts => Pass::Parts,
            PassName::Openpose => Pass::OpenPose,
        }
    }
}

/// The word of a look.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum, Debug)]
pub enum StyleName {
    /// The skin's own colours under studio lights.
    Studio,
    /// Sculptor's clay.
    Clay,
    /// Wax in a light that goes with the camera.
    Matcap,
    /// Flat tones.
    Flat,
    /// A drawing with a pen.
    Line,
    /// Studio in joint planes, as with --wood.
    Wood,
}

impl From<StyleName> for Style {
    fn from(name: StyleName) -> Style {
        match name {
            StyleName::Studio | StyleName::Wood => Style::Studio,
            StyleName::Clay => Style::Clay,
            StyleName::Matcap => Style::Matcap,
            StyleName::Flat => Style::Flat,
            StyleName::Line => Style::Line,
        }
    }
}

fn finite(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|v: &f32| v.is_finite()).ok_or_else(|| "expected a number of degrees".to_owned())
}

fn zoom(text: &str) -> Result<f32, String> {
    let factor = text.parse().ok().filter(|v| (0.05..=50.0).contains(v));
    factor.ok_or_else(|| "expected a factor from 0.05 to 50".to_owned())
}

/// Makes the pictures.
pub fn render(told: &RenderArguments) -> Result<(), Failure> {
    if Kind::of(&told.file)? == Kind::Clip && !told.ui && told.turntable.is_none() {
        return clip(told);
    }
    if told.frames.is_some() {
        let message = "--frames is for clips; --turntable FRAMES goes around a pose";
        return Err(Failure::Usage(message.to_owned()));
    }
    let viewpoint = told.shot.viewpoint();
    let subject = if load::shows_chain(&told.file)? {
        if told.ui {
            return chain_window(told);
        }
        let (editor, _) = load::chain_editor(&told.file)?;
        Subject::of_chain(editor.document())
    } else {
        told.showing.check()?;
        let editor = load::editor(&load::figure(told.figure.as_deref())?, &told.file)?;
        if told.ui {
            return window(told, &editor, viewpoint.view);
        }
        Subject::of(&editor)
    };
    let aspect = Shot::new(told.shot.size).aspect();
    let first = viewpoint.camera(subject.bounds(), aspect);
    let cameras = match told.turntable {
        Some(frames) => {
            let frames = usize::try_from(frames).unwrap_or(1);
            turntable(first, subject.bounds(), aspect, frames, viewpoint.zoom)
        }
        None => vec![first],
    };
    draw(told, title(told, &subject)?, Moment::from_all(&subject, cameras))
}

/// Frames of a clip.
fn clip(told: &RenderArguments) -> Result<(), Failure> {
    let figure = load::figure(told.figure.as_deref())?;
    let clip = load::fit(&load::clip(&told.file)?, &figure)?;
    let naming = Naming::of(&told.output)?;
    let span = match &told.frames {
        Some(span) => span.clone(),
        None if naming.format.moves() || naming.tells_frames() => FrameSpan::whole(&clip, told.fps),
        None => FrameSpan::first(),
    };
    let aspect = Shot::new(told.shot.size).aspect();
    let viewpoint = told.shot.viewpoint();
    let moments = clip_frames::moments(&figure, &clip, &span, told.fps, &viewpoint, aspect);
    draw(told, title_of(&told.file), moments)
}

/// Carries out what is told for these moments.
fn draw(told: &RenderArguments, title: String, moments: Vec<Moment>) -> Result<(), Failure> {
    let order = told.shot.order(title, moments, &told.output, told.fps)?;
    let order = Order {
        look: told.floor.on(order.look),
        keypoints: told.keypoints.as_deref().map(Naming::beside),
        ..order
    };
    order.check()?;
    order.carry_out(&mut Darkroom::open()?, &Work::on_terminal())
}

/// The pose's name; a figure file shows the figure at rest.
fn title(told: &RenderArguments, subject: &Subject) -> Result<String, Failure> {
    Ok(match Kind::of(&told.file)? {
        Kind::Figure => format!("{} at rest", subject.name()),
        _ => title_of(&told.file),
    })
}

/// A picture of the whole window.
fn window(told: &RenderArguments, editor: &edit::Editor, view: View) -> Result<(), Failure> {
    if Naming::of(&told.output)?.format != Format::Png {
        return Err(Failure::Usage("a picture of the window is a .png".to_owned()));
    }
    let finish = Finish::of(&told.shot.look());
    let image = ui_picture(editor, &told.file, view, finish, told.shot.size, &told.showing)?;
    let facts = Facts::new(&title_of(&told.file), &editor.figure().name);
    write_png(&image, &facts, &told.output)
}

/// A picture of the whole window on a chain.
fn chain_window(told: &RenderArguments) -> Result<(), Failure> {
    if Naming::of(&told.output)?.format != Format::Png {
        return Err(Failure::Usage("a picture of the window is a .png".to_owned()));
    }
    let finish = Finish::of(&told.shot.look());
    let image = chain_ui_picture(&told.file, finish, told.shot.size, &told.showing)?;
    let title = title_of(&told.file);
    write_png(&image, &Facts::new(&title, &title), &told.output)
}
