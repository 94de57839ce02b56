//! Crowds against the same figures drawn one by one.
#![allow(clippy::unwrap_used)]

use std::sync::LazyLock;

use glam::{DQuat, Mat4, Quat, Vec3};
use render::{CrowdView, DrawError, FigureView, Gpu, Image, Look, Pass, Renderer, Scene, Stats, Style};
use rig::{Bone, Camera, PLACES, Palette};

mod body;

static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::headless().expect("a graphics adapter"));
const SIZE: [u32; 2] = [320, 200];
const LANES: usize = 4;
/// One matrix more than there are places, as crowds may have.
const ROWS: usize = PLACES + 1;

/// Walkers in mid-step, in rows.
fn walkers(count: usize) -> Vec<(Palette, Mat4)> {
    let walker = |i: usize| {
        let swing = DQuat::from_rotation_x(0.5 * (i as f64).sin());
        let palette = body::posed(&[
            (Bone::LeftUpperLeg, swing),
            (Bone::RightUpperLeg, swing.inverse()),
            (Bone::LeftLowerLeg, DQuat::from_rotation_x(0.4)),
            (Bone::LeftUpperArm, DQuat::from_rotation_z(-1.2)),
            (Bone::RightUpperArm, DQuat::from_rotation_z(1.2)),
        ]);
        let place = Vec3::new((i % 4) as f32 * 1.1 - 1.6, 0.0, (i / 4) as f32 * -1.2);
        (palette, Mat4::from_rotation_translation(Quat::from_rotation_y(i as f32), place))
    };
    (0..count).map(walker).collect()
}

/// The matrices as a crowd has them.
fn matrices(walkers: &[(Palette, Mat4)]) -> Vec<f32> {
    let mut out = vec![f32::NAN; walkers.len().next_multiple_of(LANES) * ROWS * 12];
    for (i, (palette, world)) in walkers.iter().enumerate() {
        for place in 0..PLACES {
            let [real, dual] = palette.0[place].map(Quat::from_array);
            let shift = (dual * real.conjugate()).xyz() * 2.0;
            let matrix = *world * Mat4::from_rotation_translation(real, shift);
            let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis, matrix.w_axis];
            for (k, value) in columns.iter().flat_map(|c| c.truncate().to_array()).enumerate() {
                out[(((i / LANES) * ROWS + place) * 12 + k) * LANES + i % LANES] = value;
            }
        }
    }
    out
}

fn camera() -> Camera {
    Camera { target: Vec3::new(0.0, 0.8, -1.5), distance: 8.0, pitch_rad: 0.35, ..Camera::default() }
}

fn renderer() -> Renderer {
    let mut renderer = Renderer::new(&GPU);
    renderer.set_mesh(0, &body::mesh()).unwrap();
    renderer
}

fn crowd_scene<'a>(crowds: &'a [CrowdView<'a>], pass: Pass, look: Look) -> Scene<'a> {
    Scene { crowds, pass, look, ..Scene::new(&[], camera(), SIZE) }
}

/// Pixels that differ by more than so much in some channel.
fn unlike(a: &Image, b: &Image, steps: u8) -> usize {
    let pairs = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > steps)).count()
}

#[test]
fn a_crowd_looks_like_its_figures_one_by_one() {
    let mut renderer = renderer();
    let walkers = walkers(15);
    let numbers = matrices(&walkers);
    let crowd = [CrowdView { variety: 0.0, ..CrowdView::new(&numbers, LANES, ROWS, walkers.len()) }];
    let figures: Vec<FigureView<'_>> = walkers
        .iter()
        .map(|(palette, world)| FigureView { world_from_figure: *world, ..FigureView::new(palette) })
        .collect();
    let passes = [Pass::Silhouette, Pass::Normal, Pass::Parts].map(|pass| (pass, Style::Studio));
    let styles = Style::ALL.map(|style| (Pass::Color, style));
    for (pass, style) in passes.into_iter().chain(styles) {
        let look = Look { style, ..Look::default() };
        let one = renderer.image(&crowd_scene(&crowd, pass, look)).unwrap();
        let each = Scene { pass, look, ..Scene::new(&figures, camera(), SIZE) };
        let each = renderer.image(&each).unwrap();
        let empty = renderer.image(&crowd_scene(&[], pass, look)).unwrap();
        let shown = unlike(&each, &empty, 12);
        let off = unlike(&one, &each, 24);
        assert!(shown > 5000, "{pass:?} {style:?}: {shown} pixels show them");
        // Linear blending makes joints a little thinner; and the box that the light is fitted to is larger.
        assert!(off * 50 < shown, "{pass:?} {style:?}: {off} of {shown} pixels differ");
    }
}

#[test]
fn a_crowd_of_any_number_is_one_draw_in_each_pass() {
    let mut renderer = renderer();
    let mut cost = |count: usize, look: Look| -> Stats {
        let numbers = matrices(&walkers(count));
        let crowd = [CrowdView::new(&numbers, LANES, ROWS, count)];
        renderer.image(&crowd_scene(&crowd, Pass::Color, look)).unwrap();
        renderer.stats()
    };
    // Shadow, survey and picture; the picture alone.
    for (look, passes) in [(Look::default(), 3), (Look::default().lean(), 1)] {
        let [few, many] = [4, 40].map(|count| cost(count, look));
        assert_eq!(few.draw_calls, many.draw_calls);
        let triangles = body::mesh().indices.len() as u64 / 3;
        assert_eq!(many.triangles, 40 * passes * triangles);
        let bytes = (40 - 4) * ROWS as u64 * 48;
        assert_eq!(many.uploaded_bytes - few.uploaded_bytes, bytes, "matrices alone grow with the crowd");
    }
}

#[test]
fn colours_go_by_number_and_are_the_same_each_time() {
    let mut renderer = renderer();
    let walkers: Vec<_> = (0..6)
        .map(|i| {
            let place = Vec3::X * (i as f32 - 2.5);
            (Palette::REST, Mat4::from_rotation_translation(Quat::from_rotation_y(1.57), place))
        })
        .collect();
    let numbers = matrices(&walkers);
    let look = Look::default().lean();
    let mut image = |variety: f32, seed: u32| {
        let view = CrowdView { variety, seed, ..CrowdView::new(&numbers, LANES, ROWS, 6) };
        renderer.image(&crowd_scene(&[view], Pass::Color, look)).unwrap()
    };
    let varied = image(0.5, 1);
    assert_eq!(varied, image(0.5, 1));
    assert_ne!(varied, image(0.5, 2));
    assert_eq!(image(f32::NAN, 1), image(0.0, 2), "without variety the seed doesn't matter");
    let chests: Vec<[u8; 4]> = walkers
        .iter()
        .map(|(_, world)| {
            let chest = world.transform_point3(Vec3::new(0.0, 1.3, 0.0));
            let at = camera().pixel_of(chest, glam::Vec2::new(SIZE[0] as f32, SIZE[1] as f32)).unwrap();
            varied.pixel(at.x as u32, at.y as u32).unwrap()
        })
        .collect();
    for (i, chest) in chests.iter().enumerate() {
        assert!(chests[..i].iter().all(|other| other != chest), "walker {i} has another's colour");
    }
}

#[test]
fn a_crowd_that_can_t_be_drawn_says_why() {
    let mut renderer = renderer();
    let numbers = matrices(&walkers(4));
    let sound = CrowdView::new(&numbers, LANES, ROWS, 4);
    let mut fault = |view: CrowdView<'_>| {
        renderer.image(&crowd_scene(&[view], Pass::Color, Look::default())).err().unwrap().to_string()
    };
    for bad in [
        CrowdView { count: 5, ..sound },
        CrowdView { lanes: 0, ..sound },
        CrowdView { rows: 3, ..sound },
        CrowdView { count: usize::MAX, ..sound },
    ] {
        assert!(fault(bad).contains("too few"), "{}", fault(bad));
    }
    assert_eq!(fault(CrowdView { skin: 7, ..sound }), "crowd 0 shows skin 7, which has not been set");
    let none = CrowdView { count: 0, matrices: &[], ..sound };
    renderer.image(&crowd_scene(&[none], Pass::Color, Look::default())).unwrap();
}

#[test]
fn a_device_without_storage_buffers_in_its_vertex_shaders_says_so() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap();
    let limits =
        wgpu::Limits { max_storage_buffers_per_shader_stage: 0, ..wgpu::Limits::downlevel_defaults() };
    let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).unwrap();
    let mut renderer = Renderer::new(&Gpu::of_device(device, queue, adapter.get_info()));
    renderer.set_mesh(0, &body::mesh()).unwrap();
    let numbers = matrices(&walkers(4));
    let crowd = [CrowdView::new(&numbers, LANES, ROWS, 4)];
    let error = renderer.image(&crowd_scene(&crowd, Pass::Color, Look::default())).err().unwrap();
    assert!(matches!(error, DrawError::CrowdDevice(_)), "{error}");
    assert!(error.to_string().ends_with("can't draw crowds: its vertex shaders read no storage buffers"));
    assert_eq!(renderer.gpu().take_fault(), None);
    renderer.image(&crowd_scene(&[], Pass::Color, Look::default())).unwrap();
}

#[test]
fn a_light_skin_keeps_the_silhouette() {
    let (whole, palette) = body::mannequin(&body::relaxed());
    let mut renderer = renderer();
    let figures = [FigureView::new(&palette)];
    renderer.set_mesh(0, &whole).unwrap();
    let mut camera = Camera { yaw_rad: 0.5, ..Camera::default() };
    camera.frame(renderer.bounds(&figures), 1.0);
    let mut image = |mesh: &rig::Mesh| {
        renderer.set_mesh(0, mesh).unwrap();
        let scene = Scene { pass: Pass::Silhouette, ..Scene::new(&figures, camera, [200, 200]) };
        renderer.image(&scene).unwrap()
    };
    let full = image(&whole);
    let shown = full.rgba.chunks_exact(4).filter(|pixel| pixel[0] > 127).count();
    // As large as a figure in a crowd is ever seen.
    for (vertices, thousandths) in [(6000, 2), (1500, 6), (700, 25)] {
        let off = unlike(&image(&rig::simplified(&whole, vertices)), &full, 127);
        assert!(off * 1000 <= shown * thousandths, "{vertices} vertices: {off} of {shown} pixels");
    }
}
