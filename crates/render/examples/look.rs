//! Writes a picture of the mannequin to standard output, as PAM:
//! `look VIEW [depth|normal|silhouette|parts] [clay|matcap|flat|line] [planes] [light] [plain] [ghost] [near] [face]
//! [high] [lean] [bare] [twice] [large] [transparent] > out.pam`.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use std::io::Write;

use glam::{Mat4, Vec3};
use render::{
    Ball, FigureView, Gpu, Layer, Line, Look, Marker, Overlay, Pass, Renderer, Scene, Shape, Style,
};
use rig::{Bone, Camera, View};

#[path = "../tests/body/mod.rs"]
mod body;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| args.iter().any(|a| a == word);
    let view: View = args.first().map_or(View::ThreeQuarter, |v| v.parse().unwrap());
    let passes = [
        ("depth", Pass::Depth),
        ("normal", Pass::Normal),
        ("silhouette", Pass::Silhouette),
        ("parts", Pass::Parts),
    ];
    let styles =
        [("clay", Style::Clay), ("matcap", Style::Matcap), ("flat", Style::Flat), ("line", Style::Line)];
    let style = styles.into_iter().find(|(word, _)| has(word)).map_or(Style::Studio, |(_, style)| style);
    let pass = passes.into_iter().find(|(word, _)| has(word)).map_or(Pass::Color, |(_, pass)| pass);
    let size = if has("large") { [2560, 1600] } else { [1280, 800] };
    let mut renderer = Renderer::new(&Gpu::headless().unwrap());
    let (mesh, palette) = body::mannequin(&body::relaxed());
    renderer.set_mesh(0, &mesh).unwrap();
    let plain = FigureView::new(&palette);
    let marked = FigureView { selected: &[Bone::LeftLowerArm], hovered: &[Bone::RightUpperLeg], ..plain };
    let ghost = FigureView {
        opacity: 0.35,
        world_from_figure: Mat4::from_translation(Vec3::new(0.5, 0.0, -0.4)),
        ..plain
    };
    let figures = [if has("plain") { plain } else { marked }, ghost];
    let figures = if has("ghost") { &figures[..] } else { &figures[..1] };
    let mut camera = Camera::view(view, renderer.bounds(figures), size[0] as f32 / size[1] as f32);
    if has("near") {
        camera.zoom(0.35, Vec3::new(0.1, 1.4, 0.1));
    }
    if has("high") {
        camera.pitch_rad = 0.9;
    }
    if has("face") {
        camera.zoom(0.14, Vec3::new(0.0, 1.62, 0.05));
    }
    let look = Look {
        transparent: has("transparent"),
        style,
        joint_planes: has("planes"),
        grid: !has("bare"),
        supersampling: if has("twice") { 2 } else { 1 },
        ..if has("light") { Look::light() } else { Look::default() }
    };
    let look = if has("lean") { look.lean() } else { look };
    let overlay = if has("plain") { Overlay::default() } else { marks() };
    let scene = Scene { look, pass, overlay: &overlay, ..Scene::new(figures, camera, size) };
    let image = renderer.image(&scene).unwrap();
    eprintln!("{:?}", renderer.stats());
    let mut out = std::io::stdout().lock();
    let [width, height] = size;
    let head =
        format!("P7\nWIDTH {width}\nHEIGHT {height}\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n");
    out.write_all(head.as_bytes()).unwrap();
    out.write_all(&image.rgba).unwrap();
}

/// One of each mark.
fn marks() -> Overlay {
    let shoulder = Vec3::new(0.18, 1.41, 0.0);
    let color = [255, 190, 80, 255];
    let to = Vec3::new(0.45, 1.2, 0.35);
    let line = Line { from: shoulder, to, color, width_px: 3.0, dash_px: 0.0, layer: Layer::OnTop };
    let mut overlay = Overlay::default();
    overlay.lines.extend([line, Line { dash_px: 14.0, to: Vec3::new(-0.3, 1.9, 0.2), ..line }]);
    let rings = [
        (Vec3::X, [240, 80, 80, 255], Layer::Ghosted),
        (Vec3::Y, [90, 220, 120, 255], Layer::Ghosted),
        (Vec3::Z, [80, 140, 255, 255], Layer::Tested),
    ];
    for (axis, color, layer) in rings {
        overlay.ring(shoulder, axis, 0.2, Line { layer, color, ..line });
    }
    let shapes = [
        (Shape::Disc, Layer::OnTop),
        (Shape::Ring, Layer::Tested),
        (Shape::Diamond, Layer::Ghosted),
        (Shape::Square, Layer::OnTop),
        (Shape::Cross, Layer::OnTop),
    ];
    for (i, (shape, layer)) in shapes.into_iter().enumerate() {
        overlay.markers.push(Marker {
            at: Vec3::new(0.1 * i as f32, 1.0, 0.1),
            radius_px: 6.0,
            color: [255; 4],
            outline: [20, 20, 24, 255],
            outline_px: 2.0,
            layer,
            shape,
        });
    }
    let ball = |radius_m, color| Ball { center: shoulder, radius_m, color, layer: Layer::Ghosted };
    overlay.balls.extend([ball(0.2, [255, 140, 80, 200]), ball(0.56, [90, 200, 255, 200])]);
    overlay.sector(shoulder, Vec3::Z, Vec3::X * 0.3, -1.4, [120, 230, 140, 150], Layer::Ghosted);
    let feet = [[-0.18, -0.1], [-0.18, 0.18], [0.18, 0.18], [0.18, -0.1]];
    overlay.polygon(&feet.map(|[x, z]| Vec3::new(x, 0.0, z)), [255, 220, 90, 120], Layer::Tested);
    overlay
}
