//! `walk`: a figure walks over some ground; what it did as numbers, as pictures, or both.

mod crowd;
mod frames;
mod record;
mod stroll;

use std::path::PathBuf;

use clap::Args;
use motion::Steering;

use super::pictures::ShotArguments;
use crate::failure::Failure;
use crate::load;
use crate::throng::MOST;
use stroll::Stroll;

/// The fastest speed that can be asked for, metres a second: a sprinter's.
const FASTEST: f64 = 12.0;
/// The longest walk, seconds: all of it is in memory.
const LONGEST_SECS: f64 = 600.0;

/// What `walk` is told.
#[derive(Args, Debug)]
pub struct WalkArguments {
    /// On what: flat, hills, slope, stairs, stones, or a mesh of a file: .obj, .stl, .dae, .glb, in metres, +Y up.
    #[arg(long, default_value = "flat", value_name = "GROUND")]
    ground: String,
    /// Which hills, which stones: the same number gives the same ground.
    #[arg(long, default_value_t = 1, value_name = "N", allow_negative_numbers = true)]
    seed: u64,
    /// How fast, 0 to 12.
    #[arg(long, default_value = "1.4", value_name = "M/S", allow_negative_numbers = true, value_parser = speed)]
    speed: f64,
    /// How fast to the figure's left besides, -12 to 12.
    #[arg(long, default_value = "0", value_name = "M/S", allow_negative_numbers = true, value_parser = sideways)]
    sideways: f64,
    /// Turns to the figure's left so fast, -180 to 180.
    #[arg(long, default_value = "0", value_name = "DEGREES/S", allow_negative_numbers = true, value_parser = turn)]
    turn: f64,
    /// How long, at most 600.
    #[arg(long, default_value = "10", value_name = "N", allow_negative_numbers = true, value_parser = seconds)]
    seconds: f64,
    /// Steps of time a second.
    #[arg(long, default_value_t = 60, value_name = "N", value_parser = clap::value_parser!(u32).range(10..=1000))]
    rate: u32,
    /// Leaves the feet where the motion on flat ground has them.
    #[arg(long)]
    no_foot_placement: bool,
    /// So many figures walk together, each its own way; at most 20000. The report says what they are and what a picture costs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)),
        conflicts_with_all = ["speed", "sideways", "turn", "tree", "no_foot_placement"])]
    crowd: Option<u32>,
    /// Another figure, *.figure.ron.
    #[arg(long)]
    figure: Option<PathBuf>,
    /// Another blend tree, *.blend.ron; the clips that it names lie beside it or come with the program.
    #[arg(long, value_name = "TREE")]
    tree: Option<PathBuf>,
    /// Writes a JSON object: every step of time, and a summary. "-" is standard output. Without it and without -o the
    /// summary is printed.
    #[arg(long, value_name = "JSON")]
    report: Option<PathBuf>,
    /// Draws the walk: a folder or frame-%04d.png, or a .webp, .gif or .mp4 that moves.
    #[arg(short, long, value_name = "OUT", value_parser = output)]
    output: Option<PathBuf>,
    /// Pictures a second, at most as many as there are steps of time.
    #[arg(long, default_value_t = 30, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=120))]
    fps: u32,
    #[command(flatten)]
    shot: ShotArguments,
}

impl WalkArguments {
    fn steps(&self) -> usize {
        ((self.seconds * f64::from(self.rate)).round() as usize).max(1)
    }

    fn steering(&self) -> Steering {
        let (forward, sideways) = (self.speed, self.sideways);
        Steering { speed: forward.hypot(sideways), forward, sideways, turn: self.turn, ..Steering::default() }
    }

    /// The steps of time that are drawn.
    fn frames(&self) -> Vec<usize> {
        let at = |frame: u64| (frame * u64::from(self.rate) / u64::from(self.fps)) as usize;
        (0..).map(at).take_while(|step| *step < self.steps()).collect()
    }
}

fn within(text: &str, what: &str, least: f64, most: f64) -> Result<f64, String> {
    let number = text.parse().ok().filter(|v: &f64| (least..=most).contains(v));
    number.ok_or_else(|| format!("expected {what} from {least} to {most}"))
}

fn speed(text: &str) -> Result<f64, String> {
    within(text, "metres a second", 0.0, FASTEST)
}

fn sideways(text: &str) -> Result<f64, String> {
    within(text, "metres a second", -FASTEST, FASTEST)
}

fn turn(text: &str) -> Result<f64, String> {
    within(text, "degrees a second", -180.0, 180.0)
}

fn seconds(text: &str) -> Result<f64, String> {
    let positive = within(text, "seconds", 0.0, LONGEST_SECS).ok().filter(|secs| *secs > 0.0);
    positive.ok_or_else(|| format!("expected seconds, more than 0 and at most {LONGEST_SECS}"))
}

/// A name without an ending is that of a folder: a walk has many pictures.
fn output(text: &str) -> Result<PathBuf, std::convert::Infallible> {
    let path = PathBuf::from(text);
    Ok(if path.extension().is_none() { path.join("") } else { path })
}

/// Walks, then writes what is asked for.
pub fn walk(told: &WalkArguments) -> Result<(), Failure> {
    if told.fps > told.rate {
        let message = format!("--fps {}: there are only {} steps of time a second", told.fps, told.rate);
        return Err(Failure::Usage(message));
    }
    if let Some(count) = told.crowd {
        return crowd::walk(told, count);
    }
    // What can't be drawn or written is said before anything is walked.
    if let Some(output) = &told.output {
        frames::check(told, output)?;
    }
    if let Some(report) = &told.report {
        record::check(report)?;
    }
    let ground = load::ground(&told.ground, told.seed)?;
    let figure = load::figure(told.figure.as_deref())?;
    let stroll = Stroll {
        tree: load::tree(&figure, told.tree.as_deref())?,
        figure,
        ground,
        steering: told.steering(),
        steps: told.steps(),
        rate: told.rate,
        places_feet: !told.no_foot_placement,
    };
    let strolled = stroll.walk();
    if let Some(report) = &told.report {
        record::write(&stroll.figure, &strolled, report)?;
    }
    if let Some(output) = &told.output {
        frames::draw(told, &stroll, &strolled, output)?;
    }
    match (&told.report, &told.output) {
        (None, None) => super::print(&record::words(&strolled.summary)),
        _ => Ok(()),
    }
}
