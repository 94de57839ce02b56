//! Pictures of any size: pieces, bands, averages.
#![allow(clippy::unwrap_used)]

use glam::{Mat4, Vec3};
use render::{
    Band, DrawError, FigureView, Gpu, Image, Keypoints, Line, Look, Overlay, Pass, Renderer, Scene, Style,
};
use rig::{Camera, View};

mod body;

const SIZE: [u32; 2] = [320, 240];

fn renderer() -> Renderer {
    let mut renderer = Renderer::new(&Gpu::headless().unwrap());
    renderer.set_mesh(0, &body::mesh()).unwrap();
    renderer
}

/// How many pixels differ by more than two levels.
fn differing(a: &Image, b: &Image) -> usize {
    assert_eq!((a.width, a.height), (b.width, b.height));
    let pixels = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2)).count()
}

#[test]
fn a_picture_in_pieces_is_that_drawn_at_once() {
    let palette = body::standing();
    let ghost = FigureView {
        opacity: 0.4,
        world_from_figure: Mat4::from_translation(Vec3::new(0.6, 0.0, -0.4)),
        ..FigureView::new(&palette)
    };
    let figures = [FigureView::new(&palette), ghost];
    let mut renderer = renderer();
    let camera = Camera::view(View::ThreeQuarter, renderer.bounds(&figures), 4.0 / 3.0);
    let line = Line {
        from: Vec3::new(-0.5, 0.2, 0.3),
        to: Vec3::new(0.7, 1.5, 0.0),
        color: [255, 200, 0, 255],
        width_px: 3.0,
        dash_px: 0.0,
        layer: render::Layer::OnTop,
    };
    let overlay = Overlay { lines: vec![line], ..Overlay::EMPTY };
    let mut person = Keypoints::default();
    person.body[0] = Some(line.from.as_dvec3());
    person.body[1] = Some(line.to.as_dvec3());
    let keypoints = [person];
    let looks = Style::ALL.map(|style| (Look { style, ..Look::default() }, Pass::Color));
    for (look, pass) in looks.into_iter().chain(Pass::ALL.map(|pass| (Look::default(), pass))) {
        let scene = Scene {
            look,
            pass,
            overlay: &overlay,
            keypoints: &keypoints,
            ..Scene::new(&figures, camera, SIZE)
        };
        renderer.set_piece_edge(4096);
        let whole = renderer.image(&scene).unwrap();
        renderer.set_piece_edge(100);
        let pieces = renderer.image(&scene).unwrap();
        let off = differing(&whole, &pieces);
        assert!(off <= 40, "{:?} {pass:?}: {off} of {} pixels differ", look.style, SIZE[0] * SIZE[1]);
    }
}

#[test]
fn bands_follow_each_other_and_make_the_picture() {
    let palette = body::standing();
    let figures = [FigureView::new(&palette)];
    let mut renderer = renderer();
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 4.0 / 3.0);
    let look = Look { transparent: true, supersampling: 2, ..Look::default() };
    let scene = Scene { look, ..Scene::new(&figures, camera, SIZE) };
    renderer.set_piece_edge(128);
    let whole = renderer.image(&scene).unwrap();
    let mut rows = Vec::new();
    renderer
        .bands(&scene, |Band { first_row, image }| {
            assert_eq!(first_row as usize * SIZE[0] as usize * 4, rows.len(), "bands come in order");
            assert!(image.width == SIZE[0] && image.height <= 64, "{}", image.height);
            rows.extend(image.rgba);
            Ok::<(), DrawError>(())
        })
        .unwrap();
    assert!(rows == whole.rgba);
    let mut taken = 0;
    let ended = renderer.bands(&scene, |_| {
        taken += 1;
        Err(DrawError::Driver("enough".to_owned()))
    });
    assert_eq!((ended, taken), (Err(DrawError::Driver("enough".to_owned())), 1), "the taker ends it");
}

#[test]
fn a_picture_wider_than_any_texture_is_drawn() {
    let palette = body::standing();
    let figures = [FigureView::new(&palette)];
    let mut renderer = renderer();
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 1.0);
    let size = [20_000, 60];
    let scene = Scene { pass: Pass::Silhouette, ..Scene::new(&figures, camera, size) };
    let image = renderer.image(&scene).unwrap();
    assert_eq!((image.width, image.height), (20_000, 60));
    let white = |x: u32| (0..60).filter(|&y| image.pixel(x, y).unwrap()[0] > 128).count();
    assert!(white(10_000) > 20, "the figure stands in the middle: {}", white(10_000));
    assert_eq!(white(500) + white(19_500), 0);
}

#[test]
fn supersampling_makes_edges_finer_and_nothing_else() {
    let palette = body::standing();
    let figures = [FigureView::new(&palette)];
    let mut renderer = renderer();
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 4.0 / 3.0);
    let mut shot = |supersampling| {
        let look = Look { supersampling, grid: false, ..Look::default() };
        let scene = Scene { look, pass: Pass::Silhouette, ..Scene::new(&figures, camera, SIZE) };
        renderer.image(&scene).unwrap()
    };
    let (one, three) = (shot(1), shot(3));
    let levels = |image: &Image| {
        let mut seen = [false; 256];
        image.rgba.chunks_exact(4).for_each(|p| seen[usize::from(p[0])] = true);
        seen.iter().filter(|&&s| s).count()
    };
    assert!(levels(&one) <= 5 && levels(&three) > 20, "{} {}", levels(&one), levels(&three));
    let mean =
        |image: &Image| image.rgba.iter().map(|&b| f64::from(b)).sum::<f64>() / image.rgba.len() as f64;
    assert!((mean(&one) - mean(&three)).abs() < 0.2);
}
