//! Draws a number of pictures of the moving mannequin, for timing from outside:
//! `time frames COUNT [ao] [msaa1] [noshadow] [half] [empty] [balls] [still] [clay|matcap|flat|line] [planes]`. The cost
//! of a picture is the slope over COUNT. With `still` only the camera moves. What the last picture asked of the device
//! goes to standard error.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use glam::Vec3;
use render::{Ball, FigureView, Gpu, Layer, Look, Msaa, Overlay, Renderer, Scene, Style};
use rig::{Camera, View};

#[path = "../tests/body/mod.rs"]
mod body;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| args.iter().any(|a| a == word);
    let count: u32 = args.first().map_or(10, |n| n.parse().unwrap());
    let gpu = Gpu::headless().unwrap();
    let mut renderer = Renderer::new(&gpu);
    let figure = interchange::figure::mannequin().unwrap();
    renderer.set_mesh(0, figure.skin.as_ref().unwrap()).unwrap();
    let styles =
        [("clay", Style::Clay), ("matcap", Style::Matcap), ("flat", Style::Flat), ("line", Style::Line)];
    let style = styles.into_iter().find(|(word, _)| has(word)).map_or(Style::Studio, |(_, style)| style);
    let look = Look {
        msaa: if has("msaa1") { Msaa::One } else { Msaa::Four },
        shadow: !has("noshadow"),
        ambient_occlusion: has("ao"),
        joint_planes: has("planes"),
        style,
        grid: !has("nogrid"),
        transparent: has("transparent"),
        scale: if has("half") { 0.5 } else { 1.0 },
        ..Look::default()
    };
    for i in 0..count {
        let flexion = 20.0 + if has("still") { 0.0 } else { f64::from(i % 40) };
        let mut angles = body::relaxed();
        angles[0].1.flexion = flexion;
        angles[5].1.twist = flexion * 0.2;
        let palette = body::palette_of(&figure, &angles);
        let figures = [FigureView::new(&palette)];
        let shown = if has("empty") { &figures[..0] } else { &figures[..] };
        let mut camera = Camera::view(View::ThreeQuarter, renderer.bounds(&figures), 1.6);
        if has("still") {
            camera.orbit(i as f32 * 0.01, 0.0);
        }
        let overlay = if has("balls") { reach() } else { Overlay::EMPTY };
        let scene = Scene { look, overlay: &overlay, ..Scene::new(shown, camera, [1280, 800]) };
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.draw(&mut encoder, &scene).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    }
    eprintln!("{:?}", renderer.stats());
}

/// An arm's limits of reach, as two balls.
fn reach() -> Overlay {
    let center = Vec3::new(0.18, 1.41, 0.0);
    let ball = |radius_m| Ball { center, radius_m, color: [90, 200, 255, 200], layer: Layer::Ghosted };
    Overlay { balls: vec![ball(0.2), ball(0.56)], ..Overlay::EMPTY }
}
