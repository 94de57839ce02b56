//! Writes a picture of the test body to standard output as PPM: `look VIEW PASS [WIDTHxHEIGHT] [flags]`.
#![allow(clippy::unwrap_used)]

use std::io::Write;

use glam::{DVec3, Vec3};
use render::{FigureView, Gpu, Layer, Line, Look, Marker, Msaa, Overlay, Pass, Renderer, Scene};
use rig::{Bone, Camera, View};

#[path = "../tests/body/mod.rs"]
mod body;

fn main() {
    env_logger_less();
    let args: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| args.iter().any(|a| a == word);
    let view: View = args.first().map_or(View::ThreeQuarter, |v| v.parse().unwrap());
    let pass = match args.get(1).map(String::as_str) {
        Some("depth") => Pass::Depth,
        Some("normal") => Pass::Normal,
        Some("silhouette") => Pass::Silhouette,
        Some("openpose") => Pass::OpenPose,
        _ => Pass::Color,
    };
    let size = [1280, 800];
    let gpu = Gpu::headless().unwrap();
    let mut renderer = Renderer::new(&gpu);
    renderer.set_mesh(0, &body::mesh()).unwrap();
    let palette = body::standing();
    let marked = [Bone::LeftLowerArm];
    let hovered = [Bone::RightUpperLeg];
    let mut figures = vec![FigureView { selected: &marked, hovered: &hovered, ..FigureView::new(&palette) }];
    if has("plain") {
        figures[0] = FigureView::new(&palette);
    }
    if has("ghost") {
        let world_from_figure = glam::Mat4::from_translation(Vec3::new(0.5, 0.0, -0.4));
        figures.push(FigureView { opacity: 0.35, world_from_figure, ..FigureView::new(&palette) });
    }
    let bounds = renderer.bounds(&figures);
    let mut camera = Camera::view(view, bounds, size[0] as f32 / size[1] as f32);
    if has("near") {
        camera.zoom(0.35, Vec3::new(0.1, 1.4, 0.1));
    }
    if has("high") {
        camera.pitch_rad = 0.9;
    }
    let mut overlay = Overlay::default();
    if has("marks") {
        marks(&mut overlay);
    }
    let keypoints: Vec<(usize, DVec3)> = [
        (0, [0.0, 1.62, 0.1]),
        (1, [0.0, 1.45, 0.0]),
        (2, [-0.18, 1.42, 0.0]),
        (3, [-0.3, 1.2, 0.0]),
        (4, [-0.35, 0.95, 0.05]),
        (5, [0.18, 1.42, 0.0]),
        (6, [0.4, 1.3, 0.0]),
        (7, [0.3, 1.3, 0.25]),
        (8, [-0.09, 0.93, 0.0]),
        (9, [-0.1, 0.5, 0.05]),
        (10, [-0.1, 0.1, 0.0]),
        (11, [0.09, 0.93, 0.0]),
        (12, [0.1, 0.5, 0.0]),
        (13, [0.1, 0.1, 0.0]),
        (14, [-0.03, 1.65, 0.09]),
        (15, [0.03, 1.65, 0.09]),
        (16, [-0.08, 1.63, 0.0]),
        (17, [0.08, 1.63, 0.0]),
    ]
    .map(|(i, p)| (i, DVec3::from(p)))
    .to_vec();
    let look = Look {
        msaa: if has("msaa1") { Msaa::One } else { Msaa::Four },
        shadow: !has("noshadow"),
        transparent: has("transparent"),
        ..Look::default()
    };
    let scene =
        Scene { look, pass, overlay: &overlay, keypoints: &keypoints, ..Scene::new(&figures, camera, size) };
    let image = renderer.image(&scene).unwrap();
    let mut out = std::io::stdout().lock();
    write!(
        out,
        "P7\nWIDTH {}\nHEIGHT {}\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n",
        image.width, image.height
    )
    .unwrap();
    out.write_all(&image.rgba).unwrap();
}

fn env_logger_less() {}

fn marks(overlay: &mut Overlay) {
    let line = Line {
        from: Vec3::new(0.18, 1.41, 0.0),
        to: Vec3::new(0.45, 1.2, 0.35),
        color: [255, 190, 80, 255],
        width_px: 3.0,
        dash_px: 0.0,
        layer: Layer::OnTop,
    };
    overlay.lines.push(line);
    overlay.lines.push(Line { dash_px: 14.0, to: Vec3::new(-0.3, 1.9, 0.2), ..line });
    overlay.ring(
        Vec3::new(0.2, 1.35, 0.0),
        Vec3::Y,
        0.2,
        Line { layer: Layer::Ghosted, color: [90, 220, 120, 255], ..line },
    );
    overlay.ring(
        Vec3::new(0.2, 1.35, 0.0),
        Vec3::X,
        0.2,
        Line { layer: Layer::Ghosted, color: [240, 80, 80, 255], ..line },
    );
    overlay.ring(
        Vec3::new(0.2, 1.35, 0.0),
        Vec3::Z,
        0.2,
        Line { layer: Layer::Tested, color: [80, 140, 255, 255], ..line },
    );
    for (x, layer) in [(0.0, Layer::OnTop), (0.1, Layer::Tested), (0.2, Layer::Ghosted)] {
        overlay.markers.push(Marker {
            at: Vec3::new(x, 1.0, 0.1),
            radius_px: 6.0,
            color: [255, 255, 255, 255],
            outline: [20, 20, 24, 255],
            outline_px: 2.0,
            layer,
        });
    }
}
