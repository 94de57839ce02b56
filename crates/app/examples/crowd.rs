//! A crowd of all shipped bodies on hills, frame after frame, with what a frame costs:
//! `crowd COUNT [--frames N] [--full 0|1]`; full is four samples a pixel, shadows and ambient occlusion, else the lean look.
//!
//! A frame is: step (ways, joints, feet, all matrices), upload and draw at 1280x800, wait until the device is done.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use std::path::Path;
use std::time::Instant;

use app::library::clips;
use app::load;
use app::picture::Underfoot;
use app::throng::Throng;
use render::{Gpu, Look, Renderer, Scene};
use rig::Camera;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str, default: usize| {
        let at = args.iter().position(|a| a == name);
        at.map_or(default, |i| args[i + 1].parse().unwrap())
    };
    let count = args.first().map_or(1000, |count| count.parse().unwrap());
    let bodies = ["man", "woman", "elderly", "child", "heroic", "mannequin"];
    let figures: Vec<_> = bodies
        .iter()
        .map(|name| load::figure(Some(Path::new(&format!("library:{name}.figure.ron")))).unwrap())
        .collect();
    let all: Vec<_> = clips::names().map(|name| load::clip(Path::new(&name)).unwrap()).collect();
    let ground = load::ground("hills", 1).unwrap();
    let mut throng = Throng::new(&figures, &all, &ground, count, 1).unwrap();
    let gpu = Gpu::headless().unwrap();
    let mut renderer = Renderer::new(&gpu);
    let patch = Underfoot::square(&ground, f64::from(throng.half_m()) + 4.0, false);
    renderer.set_mesh(0, patch.mesh()).unwrap();
    throng.seat(&mut renderer, 1).unwrap();
    let camera = Camera {
        target: throng.middle(),
        yaw_rad: 0.42,
        pitch_rad: 0.23,
        distance: throng.half_m() * 1.15,
        ..Camera::default()
    };
    let full = option("--full", 1) != 0;
    let look = if full { Look::default() } else { Look::default().lean() };
    let (mut steps, mut draws, mut cpus) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..option("--frames", 5) + 1 {
        let start = Instant::now();
        throng.step(1.0 / 60.0);
        steps.push(start.elapsed().as_secs_f64());
        let cpu = cpu_secs();
        let crowds = throng.views(1);
        let ground = [Underfoot::view(0)];
        let scene = Scene { look, crowds: &crowds, ..Scene::new(&ground, camera, [1280, 800]) };
        let start = Instant::now();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.draw(&mut encoder, &scene).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        draws.push(start.elapsed().as_secs_f64());
        cpus.push(cpu_secs() - cpu);
    }
    let [step, draw, cpu] = [steps, draws, cpus].map(|mut times| {
        // The first frame makes pipelines and buffers.
        times.remove(0);
        times.sort_by(f64::total_cmp);
        times[times.len() / 2] * 1e3
    });
    let stats = renderer.stats();
    println!("{count} walkers: step {step:.2} ms, upload and draw {draw:.0} ms, CPU {cpu:.0} ms; {stats:?}");
}

/// User and system time of this process so far; 0 where the system doesn't tell.
fn cpu_secs() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let ticks =
        |n: usize| after_name.split_whitespace().nth(n).and_then(|w| w.parse::<f64>().ok()).unwrap_or(0.0);
    (ticks(11) + ticks(12)) / 100.0
}
