//! The command line: what is asked, done headless or in a window.

mod clip_frames;
mod pictures;
mod robots;
mod sheet;
mod walk;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use edit::{Editor, NoFiles, Report, Request, parse_script, run_script};

use crate::disk::{Disk, MODEL_LIMIT, read_bytes, read_text, write_atomic};
use crate::failure::Failure;
use crate::load::{self, Kind};
use pictures::RenderArguments;
use sheet::SheetArguments;
use walk::WalkArguments;

/// Poses a skinned figure: forward and inverse gestures in any mix.
#[derive(Parser, Debug)]
#[command(name = "posewright", version, args_conflicts_with_subcommands = true)]
struct Line {
    #[command(subcommand)]
    task: Option<Task>,
    /// What to open in the window: a pose, script or figure file.
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    window: WindowArguments,
}

/// Options of the window.
#[derive(clap::Args, Debug)]
struct WindowArguments {
    /// Writes where each labelled control is, as JSON, after every frame: for tests of the window.
    #[arg(long, value_name = "FILE", hide = true)]
    ui_map: Option<PathBuf>,
}

#[derive(Subcommand, Debug)]
enum Task {
    /// Runs a script of commands on a figure.
    Run {
        /// The script, *.script.ron.
        script: PathBuf,
        /// A pose to start from instead of rest.
        #[arg(long, value_name = "POSE")]
        on: Option<PathBuf>,
        /// Another figure, *.figure.ron.
        #[arg(long)]
        figure: Option<PathBuf>,
        /// Saves the pose at the end.
        #[arg(long, value_name = "POSE")]
        save: Option<PathBuf>,
        /// Writes a JSON array: the start, then a record for each command. "-" is standard output.
        #[arg(long, value_name = "JSON")]
        report: Option<PathBuf>,
    },
    /// Draws a pose, what a script makes of the figure, or a clip: stills, frames, turntables, passes, keypoints; needs no display.
    Render(Box<RenderArguments>),
    /// Draws many poses, looks or figures side by side, with their names; needs no display.
    Sheet(SheetArguments),
    /// Walks over some ground: a report of every step of time, pictures, or both; needs no display.
    Walk(Box<WalkArguments>),
    /// Tells what a pose comes to, or where the links of a robot are.
    Inspect {
        /// The pose, script, clip, figure, URDF or chain file.
        file: PathBuf,
        /// One record as JSON, as in the reports of `run`; of a robot its links and joints.
        #[arg(long)]
        json: bool,
        /// Values of a robot's joints in radians and metres, a JSON object by joint; others are 0.
        #[arg(long, value_name = "JSON")]
        joints: Option<String>,
        /// Another figure, *.figure.ron.
        #[arg(long)]
        figure: Option<PathBuf>,
    },
    /// Writes a figure's skeleton, a robot or a chain as a file of another kind.
    Convert {
        /// The figure, URDF or chain file; figures that come with the program as library:NAME.figure.ron.
        file: PathBuf,
        /// The URDF or chain file to write.
        to: PathBuf,
    },
    /// Checks files and says what is wrong where: file:line:column: message.
    Check {
        /// Poses, scripts, figures, clips, blend trees, chains, URDF and GLB files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// The figure that poses and scripts are for, *.figure.ron.
        #[arg(long)]
        figure: Option<PathBuf>,
    },
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let edge = |part: &str| part.parse::<u32>().ok().filter(|n| *n > 0);
    let pair = text.split_once('x').and_then(|(w, h)| Some([edge(w)?, edge(h)?]));
    pair.ok_or_else(|| "expected WIDTHxHEIGHT in pixels, such as 1280x800".to_owned())
}

/// Does what the command line asks.
pub fn main() -> ExitCode {
    let line = match Line::try_parse() {
        Ok(line) => line,
        // Help and version are not faults; clap knows its own exit codes.
        Err(e) => {
            let _ = e.print();
            return ExitCode::from(u8::try_from(e.exit_code()).unwrap_or(2));
        }
    };
    match act(line) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failures) => {
            for failure in &failures {
                say(&failure.to_string());
            }
            failures.first().map_or(ExitCode::FAILURE, Failure::code)
        }
    }
}

/// One line on standard error; a closed pipe is nobody's fault.
fn say(message: &str) {
    use std::io::Write as _;
    let _ = writeln!(std::io::stderr(), "{message}");
}

fn act(line: Line) -> Result<(), Vec<Failure>> {
    let one = |failure| vec![failure];
    known(&line).map_err(one)?;
    match line.task {
        None => crate::window::run(&line.files, line.window.ui_map.as_deref()).map_err(one),
        Some(Task::Run { script, on, figure, save, report }) => {
            run(&script, on.as_deref(), figure.as_deref(), save.as_deref(), report.as_deref()).map_err(one)
        }
        Some(Task::Render(told)) => pictures::render(&told).map_err(one),
        Some(Task::Walk(told)) => walk::walk(&told).map_err(one),
        Some(Task::Sheet(told)) => sheet::sheet(&told).map_err(one),
        Some(Task::Inspect { file, json, joints, figure }) => {
            inspect(&file, json, joints.as_deref(), figure.as_deref()).map_err(one)
        }
        Some(Task::Convert { file, to }) => robots::convert(&file, &to).map_err(one),
        Some(Task::Check { files, figure }) => check(&files, figure.as_deref()),
    }
}

/// A word that is no file and has no ending was meant as a command.
fn known(line: &Line) -> Result<(), Failure> {
    match line.files.iter().find(|file| file.extension().is_none() && !file.exists()) {
        Some(word) => {
            let message =
                format!("\"{}\" is neither a command nor a file; see `posewright --help`", word.display());
            Err(Failure::Usage(message))
        }
        None => Ok(()),
    }
}

fn run(
    path: &Path,
    on: Option<&Path>,
    figure: Option<&Path>,
    save: Option<&Path>,
    report: Option<&Path>,
) -> Result<(), Failure> {
    if load::shows_chain(path)? {
        return run_on_chain(path, on, save, report);
    }
    let figure = load::figure(figure)?;
    let script = parse_script(&read_text(path)?).map_err(|fault| load::at(path, &fault))?;
    let mut editor = Editor::new(figure.clone());
    if let Some(on) = on {
        let pose = Box::new(load::pose(&figure, on)?);
        editor.submit(Request::Open(pose), &mut NoFiles).map_err(|e| Failure::Input(e.to_string()))?;
    }
    let reports =
        run_script(&mut editor, &script, &mut Disk::beside(path)).map_err(|fault| load::at(path, &fault))?;
    if let Some(save) = save {
        write_atomic(save, rig::write_pose(&figure, editor.pose()).as_bytes())?;
    }
    match report {
        Some(to) => write_json(&reports, to),
        None => Ok(()),
    }
}

/// Runs a script on the chain that it names, or on another.
fn run_on_chain(
    path: &Path,
    on: Option<&Path>,
    save: Option<&Path>,
    report: Option<&Path>,
) -> Result<(), Failure> {
    let ran = load::chain_script(path, on)?;
    if let Some(save) = save {
        load::save_chain(ran.editor.document(), Some(&ran.chain), save)?;
    }
    match report {
        Some(to) => write_json(&ran.reports, to),
        None => Ok(()),
    }
}

fn write_json<T: serde::Serialize>(value: &T, to: &Path) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(value).map_err(|e| Failure::Input(e.to_string()))?;
    text.push('\n');
    if to == Path::new("-") { print(&text) } else { write_atomic(to, text.as_bytes()) }
}

fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write as _;
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Input(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

fn inspect(file: &Path, json: bool, joints: Option<&str>, figure: Option<&Path>) -> Result<(), Failure> {
    match (Kind::of(file)?, joints) {
        (Kind::Urdf | Kind::Chain, _) => return robots::inspect(file, json, joints),
        (_, Some(_)) => {
            return Err(Failure::Usage(
                "--joints: only robots have such joints, *.urdf and *.chain.ron".to_owned(),
            ));
        }
        _ => {}
    }
    let editor = load::editor(&load::figure(figure)?, file)?;
    let report = Report::of(&editor, "inspect", None);
    if json {
        return write_json(&report, Path::new("-"));
    }
    print(&table(&editor, &report))
}

/// The record for people: limbs, then every joint that is not at rest.
fn table(editor: &Editor, report: &Report) -> String {
    use std::fmt::Write as _;
    let mut text = format!("{}\n\n", editor.figure().name);
    for (name, limb) in &report.limbs {
        let [x, y, z] = limb.articulator;
        let elevation = limb.elevation.map_or("none".to_owned(), |e| format!("{e:.1}°"));
        let _ = writeln!(
            text,
            "{name:10} {:8} at {x:7.3} {y:7.3} {z:7.3} m   off {:6.1} mm   elevation {elevation}",
            limb.contact,
            limb.residual * 1000.0
        );
    }
    text.push('\n');
    for joint in editor.figure().skeleton.joints() {
        let angles = editor.pose().angles(joint.bone);
        let moved: Vec<String> = joint
            .dofs()
            .filter(|dof| angles.get(*dof) != 0.0)
            .map(|dof| format!("{} {:.1}°", dof.name(), angles.get(dof)))
            .collect();
        if !moved.is_empty() {
            let _ = writeln!(text, "{:24} {}", joint.bone.name(), moved.join("  "));
        }
    }
    text
}

fn check(files: &[PathBuf], figure: Option<&Path>) -> Result<(), Vec<Failure>> {
    let figure = load::figure(figure).map_err(|failure| vec![failure])?;
    let check_one = |path: &PathBuf| -> Result<(), Failure> {
        match Kind::of(path)? {
            Kind::Pose => load::patch(&figure, path).map(|_| ()),
            Kind::Script => {
                parse_script(&read_text(path)?).map(|_| ()).map_err(|fault| load::at(path, &fault))?;
                load::editor(&figure, path).map(|_| ())
            }
            Kind::Figure => load::figure(Some(path)).map(|_| ()),
            Kind::Clip => load::clip(path).map(|_| ()),
            Kind::Blend => load::tree(&figure, Some(path)).map(|_| ()),
            Kind::Urdf | Kind::Chain => robots::check(path),
            Kind::Glb => interchange::glb::read(&read_bytes(path, MODEL_LIMIT)?, &figure.skeleton)
                .map(|_| ())
                .map_err(|e| Failure::Input(format!("{}:1:1: {e}", path.display()))),
        }
    };
    let faults: Vec<Failure> = files.iter().filter_map(|path| check_one(path).err()).collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}
