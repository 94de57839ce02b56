//! `walk --crowd`: many figures on one ground, drawn at once.

use std::path::Path;
use std::sync::Arc;

use motion::Ground;
use render::{Pass, Renderer, Scene, Stats};
use rig::{Bounds, Camera, Figure};
use serde::Serialize;

use super::WalkArguments;
use crate::disk::write_atomic;
use crate::failure::Failure;
use crate::library::clips;
use crate::load;
use crate::picture::{Facts, Film, Order, Shape, Shot, Underfoot, Work, open_gpu, pass_name};
use crate::throng::Throng;

/// The bodies of a crowd, unless one is told.
const BODIES: [&str; 6] = ["man", "woman", "elderly", "child", "heroic", "mannequin"];
/// Where the camera stands, unless it is told: about the vertical and above the horizon.
const YAW_DEG: f32 = 24.0;
const PITCH_DEG: f32 = 13.0;
/// How far the camera is from the middle, over how far the crowd reaches from there.
const DISTANCE_SHARE: f32 = 1.15;

/// What a crowd comes to: nothing in it depends on the machine's speed.
#[derive(Serialize)]
struct Report {
    walkers: usize,
    bodies: Vec<BodyRecord>,
    seconds: f64,
    /// From the middle to the border, metres.
    reach: f32,
    /// Of the last picture; none if nothing was drawn.
    picture: Option<PictureRecord>,
}

#[derive(Serialize)]
struct BodyRecord {
    figure: String,
    walkers: usize,
    vertices: usize,
}

#[derive(Serialize)]
struct PictureRecord {
    passes: u64,
    draw_calls: u64,
    triangles: u64,
    uploaded_bytes: u64,
}

/// Walks, then writes what is asked for.
pub fn walk(told: &WalkArguments, count: u32) -> Result<(), Failure> {
    let order = told.output.as_deref().map(|output| order(told, output)).transpose()?;
    let ground = load::ground(&told.ground, told.seed)?;
    let clips = clips::names().map(|name| load::clip(Path::new(&name))).collect::<Result<Vec<_>, _>>()?;
    let start = Throng::new(&figures(told.figure.as_deref())?, &clips, &ground, count, told.seed)?;
    let picture = order.map(|order| draw(told, &order, &start, &ground)).transpose()?;
    let report = report(told, &start, picture);
    match &told.report {
        Some(to) if to != Path::new("-") => write_atomic(to, json(&report)?.as_bytes()),
        None if told.output.is_some() => Ok(()),
        _ => crate::cli::print(&json(&report)?),
    }
}

/// An order for the pictures; their moments are made while they are drawn.
fn order(told: &WalkArguments, output: &Path) -> Result<Order, Failure> {
    let order = told.shot.order(format!("crowd on {}", told.ground), Vec::new(), output, told.fps)?;
    order.check_for(told.frames().len())?;
    if order.passes.contains(&Pass::OpenPose) {
        return Err(Failure::Usage("--pass openpose: a crowd has no keypoints".to_owned()));
    }
    Ok(order)
}

fn figures(told: Option<&Path>) -> Result<Vec<Arc<Figure>>, Failure> {
    if told.is_some() {
        return Ok(vec![load::figure(told)?]);
    }
    let shipped =
        |name| load::figure(Some(Path::new(&format!("{}{name}.figure.ron", interchange::figure::LIBRARY))));
    BODIES.into_iter().map(shipped).collect()
}

/// Draws the frames one after the other; what the last one cost.
fn draw(told: &WalkArguments, order: &Order, start: &Throng, ground: &Ground) -> Result<Stats, Failure> {
    let mut renderer = Renderer::new(&open_gpu()?);
    // The ground is in the first slot, the bodies in those after it.
    let patch = Underfoot::square(ground, f64::from(start.half_m()) + 4.0, told.shot.is_bright());
    renderer.set_mesh(0, patch.mesh())?;
    start.seat(&mut renderer, 1)?;
    order.make_folder()?;
    let camera = camera(told, start);
    let (frames, work) = (told.frames(), Work::on_terminal());
    for pass in &order.passes {
        let shot = Shot { size: order.size, pass: *pass, look: order.look };
        let film = Film {
            naming: &order.naming,
            pass: pass_name(*pass),
            shape: Shape { size: order.size, alpha: shot.alpha() },
            frames: frames.len(),
            fps: order.fps,
            facts: &Facts::new(&order.title, "crowd").with("Pass", pass_name(*pass)),
        };
        let mut walked = (start.clone(), 0);
        work.begin(frames.len() as u64, "frames");
        film.write(&work, |i| {
            // A GIF's palette is made from frames here and there before the first is written.
            if walked.1 > frames[i] {
                walked = (start.clone(), 0);
            }
            while walked.1 < frames[i] {
                walked.0.step((1.0 / f64::from(told.rate)) as f32);
                walked.1 += 1;
            }
            let crowds = walked.0.views(1);
            let figures = [Underfoot::view(0)];
            let scene = Scene {
                crowds: &crowds,
                look: shot.look,
                pass: *pass,
                ..Scene::new(&figures, camera, shot.size)
            };
            Ok(renderer.image(&scene)?)
        })?;
    }
    work.end();
    Ok(renderer.stats())
}

/// Over the crowd, its nearest figures being large.
fn camera(told: &WalkArguments, throng: &Throng) -> Camera {
    let viewpoint = told.shot.viewpoint_or(YAW_DEG, PITCH_DEG);
    let around = Bounds { min: throng.middle() - 1.0, max: throng.middle() + 1.0 };
    let mut camera = viewpoint.camera(around, Shot::new(told.shot.size()).aspect());
    camera.target = throng.middle();
    camera.distance = (throng.half_m() * DISTANCE_SHARE).max(6.0) / viewpoint.zoom;
    camera
}

fn report(told: &WalkArguments, throng: &Throng, picture: Option<Stats>) -> Report {
    let body = |kind: &crate::throng::Kind| BodyRecord {
        figure: kind.figure.name.clone(),
        walkers: kind.count(),
        vertices: kind.mesh.vertex_count(),
    };
    let record = |stats: Stats| {
        let Stats { passes, draw_calls, triangles, uploaded_bytes, .. } = stats;
        PictureRecord { passes, draw_calls, triangles, uploaded_bytes }
    };
    Report {
        walkers: throng.kinds().iter().map(|kind| kind.count()).sum(),
        bodies: throng.kinds().iter().map(body).collect(),
        seconds: told.seconds,
        reach: throng.half_m(),
        picture: picture.map(record),
    }
}

fn json(report: &Report) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(report).map_err(|e| Failure::Input(e.to_string()))?;
    Ok(text + "\n")
}
