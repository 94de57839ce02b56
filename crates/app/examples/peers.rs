//! One skinned figure in the scene that other programs are measured in, frame after frame, with what a frame costs:
//! `peers [--msaa 1|4] [--shadows 0|1] [--ao 0|1] [--capsules 0|1] [--frames N]`.
//!
//! The figure is the mannequin, or a body of capsules with about as many vertices and triangles as a game's character.
//! 1280x800, a lens of 35 degrees 3.9 m from (0, 0.9, 0), 35 degrees to the figure's left and 12 above; the left
//! upper arm and the chest turn in every frame. A frame is: pose, draw, wait until the device is done.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use std::time::Instant;

use glam::{DQuat, Vec3};
use render::{FigureView, Gpu, Look, Msaa, Renderer, Scene};
use rig::{Angles, Bone, Camera, Palette};

#[path = "../../render/tests/body/mod.rs"]
mod body;

fn main() {
    let start = Instant::now();
    let args: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str, default: usize| {
        let at = args.iter().position(|a| a == name);
        at.map_or(default, |i| args[i + 1].parse().unwrap())
    };
    let (msaa, shadow, ao) = (option("--msaa", 4), option("--shadows", 1) != 0, option("--ao", 0) != 0);
    let count = option("--frames", 20);
    let capsules = (option("--capsules", 0) != 0).then(body::mesh);
    let gpu = Gpu::headless().unwrap();
    let mut renderer = Renderer::new(&gpu);
    let figure = interchange::figure::mannequin().unwrap();
    let skin = capsules.as_ref().unwrap_or(figure.skin.as_ref().unwrap());
    renderer.set_mesh(0, skin).unwrap();
    let look = Look {
        msaa: if msaa == 1 { Msaa::One } else { Msaa::Four },
        shadow,
        ambient_occlusion: ao,
        ..Look::default()
    };
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let camera = Camera {
        target: Vec3::new(0.0, 0.9, 0.0),
        yaw_rad: 35.0_f32.to_radians(),
        pitch_rad: 12.0_f32.to_radians(),
        distance: 3.9,
        fov_y_rad: 35.0_f32.to_radians(),
        ..Camera::default()
    };
    let mut draw = |i: usize| {
        let mut pose = figure.rest_pose();
        let (arm, spine) = (0.4 * (i as f64 * 0.2).sin(), 0.2 * (i as f64 * 0.13).sin());
        pose.angles[Bone::LeftUpperArm.index()] = Angles { abduction: arm.to_degrees(), ..Angles::default() };
        pose.angles[Bone::Chest.index()] = Angles { twist: spine.to_degrees(), ..Angles::default() };
        let palette = match capsules {
            Some(_) => body::posed(&[
                (Bone::LeftUpperArm, DQuat::from_rotation_z(arm)),
                (Bone::Chest, DQuat::from_rotation_y(spine)),
            ]),
            None => Palette::new(&rig::frames(&figure, &pose), &rest),
        };
        let figures = [FigureView::new(&palette)];
        let scene = Scene { look, ..Scene::new(&figures, camera, [1280, 800]) };
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.draw(&mut encoder, &scene).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    };
    draw(0);
    let first_ms = start.elapsed().as_secs_f64() * 1e3;
    (1..8).for_each(&mut draw);
    let cpu = cpu_secs();
    let mut times: Vec<f64> = (8..8 + count)
        .map(|i| {
            let before = Instant::now();
            draw(i);
            before.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    let cpu_ms = (cpu_secs() - cpu) * 1e3 / count as f64;
    times.sort_by(f64::total_cmp);
    println!(
        "posewright msaa {msaa} shadows {} ao {} | {} triangles | frame median {:.1} ms, cpu {cpu_ms:.1} ms | first picture {first_ms:.0} ms | resident {:.0} MiB",
        u8::from(shadow),
        u8::from(ao),
        skin.indices.len() / 3,
        times[count / 2],
        resident_mib(),
    );
}

/// User and system time of this process so far; 0 where the system doesn't tell.
fn cpu_secs() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let ticks =
        |n: usize| after_name.split_whitespace().nth(n).and_then(|w| w.parse::<f64>().ok()).unwrap_or(0.0);
    (ticks(11) + ticks(12)) / 100.0
}

/// What this process holds in memory; 0 where the system doesn't tell.
fn resident_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with("VmRSS")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|w| w.parse::<f64>().ok()).unwrap_or(0.0) / 1024.0
}
