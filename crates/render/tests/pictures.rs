//! Pictures checked by numbers: against shapes that are known exactly, and against the words of the API.
#![allow(clippy::unwrap_used)]

use std::sync::{LazyLock, Mutex};

use glam::{DVec3, Mat4, Vec2, Vec3};
use render::{
    Ball, Blit, DrawError, Fan, FigureView, Gpu, Image, Keypoints, Layer, Line, Look, Marker, Msaa, Overlay,
    Pass, Renderer, Scene, Shape, Style,
};
use rig::{Bone, Camera, Palette, Projection, View};

mod body;

/// One device for all tests; those that need their own open it.
static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::headless().expect("a graphics adapter"));
/// One picture at a time: software drivers gain nothing from more, and take the memory.
static TURN: Mutex<()> = Mutex::new(());

const SIZE: [u32; 2] = [320, 240];

fn pixels() -> Vec2 {
    Vec2::new(SIZE[0] as f32, SIZE[1] as f32)
}

fn renderer_of(mesh: &rig::Mesh) -> Renderer {
    let mut renderer = Renderer::new(&GPU);
    renderer.set_mesh(0, mesh).unwrap();
    renderer
}

fn draw(renderer: &mut Renderer, scene: &Scene<'_>) -> Image {
    let _turn = TURN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    renderer.image(scene).unwrap()
}

fn at(image: &Image, p: Vec2) -> [u8; 4] {
    image.pixel(p.x as u32, p.y as u32).unwrap()
}

const CENTER: Vec3 = Vec3::new(0.1, 1.0, 0.2);
const RADIUS: f32 = 0.4;

/// Where a ray first meets the ball, and how far it passes outside it (negative: inside), metres.
fn meet(camera: &Camera, pixel: Vec2) -> (Option<Vec3>, f32) {
    let ray = camera.ray(pixel, pixels());
    let along = (CENTER - ray.origin).dot(ray.direction);
    let off = (ray.origin + ray.direction * along - CENTER).length();
    let half = (RADIUS * RADIUS - off * off).max(0.0).sqrt();
    let hit = (off < RADIUS).then(|| ray.origin + ray.direction * (along - half));
    (hit, off - RADIUS)
}

fn each_pixel() -> impl Iterator<Item = Vec2> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)))
}

#[test]
fn a_ball_s_depth_normals_and_silhouette_are_the_analytic_ones() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let mut camera = Camera { projection, ..Camera::default() };
        camera.frame(renderer.bounds(&figures), 4.0 / 3.0);
        let scene = |pass| Scene { pass, ..Scene::new(&figures, camera, SIZE) };
        let depth = draw(&mut renderer, &scene(Pass::Depth));
        let normal = draw(&mut renderer, &scene(Pass::Normal));
        let silhouette = draw(&mut renderer, &scene(Pass::Silhouette));
        let pixel_m = camera.metres_per_pixel(CENTER, pixels().y);
        let mut inside = 0;
        for p in each_pixel() {
            let (hit, outside_m) = meet(&camera, p);
            if outside_m.abs() < 2.0 * pixel_m {
                continue;
            }
            let Some(hit) = hit else {
                assert_eq!(at(&depth, p), [0, 0, 0, 255], "{p}");
                assert_eq!(at(&normal, p), [128, 128, 255, 255], "{p}");
                assert_eq!(at(&silhouette, p), [0, 0, 0, 255], "{p}");
                continue;
            };
            inside += 1;
            assert_eq!(at(&silhouette, p), [255; 4], "{p}");
            let nearness = (hit.z - (CENTER.z - RADIUS)) / (2.0 * RADIUS);
            assert!((f32::from(at(&depth, p)[0]) - 255.0 * nearness).abs() < 2.5, "{p}: depth {nearness}");
            let n = (hit - CENTER) / RADIUS;
            for (byte, n) in at(&normal, p).into_iter().zip(n.to_array()) {
                assert!((f32::from(byte) - (n * 0.5 + 0.5) * 255.0).abs() < 3.0, "{p}: normal {n}, {byte}");
            }
        }
        assert!(inside > 20_000, "the ball fills the picture: {inside}");
    }
}

/// A flat wall as a mesh: a corner and two edges.
fn flat_wall(corner: Vec3, across: Vec3, up: Vec3) -> rig::Mesh {
    let normal = across.cross(up).normalize();
    let corners = [corner, corner + across, corner + across + up, corner + up];
    rig::Mesh {
        positions: corners.map(|c| c.to_array()).to_vec(),
        normals: vec![normal.to_array(); 4],
        colors: vec![[0.5; 3]; 4],
        joints: vec![[0; 4]; 4],
        weights: vec![[65535, 0, 0, 0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
    }
}

#[test]
fn a_plane_s_depth_and_normals_are_the_analytic_ones() {
    let corner = Vec3::new(-0.8, 0.7, 0.6);
    // A floor seen from above and a wall seen aslant: boxes without thickness, so that the range is the corners'.
    let floor = (Vec3::X * 1.6, Vec3::NEG_Z * 1.2, Camera { pitch_rad: 0.7, ..Camera::default() });
    let wall =
        (Vec3::NEG_Z * 1.2, Vec3::Y * 0.8, Camera { yaw_rad: -1.0, pitch_rad: 0.2, ..Camera::default() });
    for (across, up, camera) in [floor, wall] {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let mut renderer = renderer_of(&flat_wall(corner, across, up));
            let figures = [FigureView { two_sided: true, ..FigureView::new(&Palette::REST) }];
            let mut camera = Camera { projection, ..camera };
            camera.frame(renderer.bounds(&figures), 4.0 / 3.0);
            let scene = |pass| Scene { pass, ..Scene::new(&figures, camera, SIZE) };
            let depth = draw(&mut renderer, &scene(Pass::Depth));
            let normal = draw(&mut renderer, &scene(Pass::Normal));
            let view = camera.view_from_world();
            let deep = |p: Vec3| -view.transform_point3(p).z;
            let corners = [corner, corner + across, corner + up, corner + across + up].map(deep);
            let (near, far) =
                corners.into_iter().fold((f32::MAX, f32::MIN), |(n, f), d| (n.min(d), f.max(d)));
            let out = across.cross(up).normalize();
            let out = if out.dot(camera.eye() - corner) < 0.0 { -out } else { out };
            let seen = view.transform_vector3(out);
            let mut inside = 0;
            for p in each_pixel() {
                let ray = camera.ray(p, pixels());
                let hit =
                    ray.origin + ray.direction * ((corner - ray.origin).dot(out) / ray.direction.dot(out));
                let [x, y] = [across, up].map(|edge| (hit - corner).dot(edge) / edge.length_squared());
                if !((0.02..0.98).contains(&x) && (0.02..0.98).contains(&y)) {
                    continue;
                }
                inside += 1;
                let nearness = (far - deep(hit)) / (far - near);
                let found = f32::from(at(&depth, p)[0]);
                assert!((found - 255.0 * nearness).abs() < 1.5, "{projection:?} {p}: {found}, {nearness}");
                for (byte, n) in at(&normal, p).into_iter().zip(seen.to_array()) {
                    assert!((f32::from(byte) - (n * 0.5 + 0.5) * 255.0).abs() < 1.0, "{p}: {byte} for {n}");
                }
            }
            assert!(inside > 10_000, "the plane fills the picture: {inside}");
        }
    }
}

#[test]
fn left_shows_the_left_hand_toward_the_viewer() {
    let mut renderer = renderer_of(&body::mesh());
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera::view(View::Left, renderer.bounds(&figures), 4.0 / 3.0);
    let image = draw(&mut renderer, &Scene { pass: Pass::Depth, ..Scene::new(&figures, camera, SIZE) });
    let hand = body::rest()[Bone::LeftHand.index()].as_vec3();
    let hand = at(&image, camera.pixel_of(hand, pixels()).unwrap())[0];
    let hips = at(&image, camera.pixel_of(Vec3::new(0.0, 1.0, 0.0), pixels()).unwrap())[0];
    assert!(hand > 230 && (90..160).contains(&hips), "hand {hand}, hips {hips}");
    let camera = Camera::view(View::Right, renderer.bounds(&figures), 4.0 / 3.0);
    let image = draw(&mut renderer, &Scene { pass: Pass::Depth, ..Scene::new(&figures, camera, SIZE) });
    let hand = body::rest()[Bone::RightHand.index()].as_vec3();
    assert!(at(&image, camera.pixel_of(hand, pixels()).unwrap())[0] > 230);
}

#[test]
fn the_same_scene_gives_the_same_bytes_on_another_device() {
    let palette = body::standing();
    let figures = [FigureView { selected: &[Bone::Head], ..FigureView::new(&palette) }];
    let overlay = Overlay {
        lines: vec![line(Layer::Ghosted)],
        markers: vec![marker(Layer::Tested)],
        balls: vec![ball(Layer::Ghosted)],
        fans: vec![Fan { rim: vec![Vec3::X, Vec3::Y, Vec3::Z], ..fan(Layer::Ghosted) }],
    };
    let picture = |gpu: &Gpu| {
        let mut renderer = Renderer::new(gpu);
        renderer.set_mesh(0, &body::mesh()).unwrap();
        let camera = Camera::view(View::ThreeQuarter, renderer.bounds(&figures), 4.0 / 3.0);
        let scene = Scene { overlay: &overlay, ..Scene::new(&figures, camera, SIZE) };
        (draw(&mut renderer, &scene), draw(&mut renderer, &scene))
    };
    let (first, again) = picture(&GPU);
    let (other, _) = picture(&Gpu::headless().unwrap());
    assert!(first == again, "a second picture differs");
    assert!(first == other, "another device's picture differs");
}

#[test]
fn a_transparent_picture_is_clear_around_the_figure() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 4.0 / 3.0);
    let mut scene = Scene::new(&figures, camera, SIZE);
    let opaque = draw(&mut renderer, &scene);
    assert!(opaque.rgba.chunks_exact(4).all(|p| p[3] == 255));
    scene.look.transparent = true;
    scene.look.shadow = false;
    let clear = draw(&mut renderer, &scene);
    assert_eq!(clear.pixel(0, 0), Some([0, 0, 0, 0]));
    assert_eq!(clear.pixel(SIZE[0] - 1, SIZE[1] - 1), Some([0, 0, 0, 0]));
    let middle = camera.pixel_of(CENTER, pixels()).unwrap();
    assert_eq!(at(&clear, middle)[3], 255);
    // Straight alpha: where the edge is half covered, its colour is the ball's own, not half of it.
    let row = middle.y as u32;
    let edge = (0..SIZE[0]).filter_map(|x| clear.pixel(x, row)).find(|p| (60..200).contains(&p[3])).unwrap();
    let beside = (0..SIZE[0]).filter_map(|x| clear.pixel(x, row)).find(|p| p[3] == 255).unwrap();
    assert!(edge[0].abs_diff(beside[0]) < 40, "{edge:?} beside {beside:?}");
}

fn line(layer: Layer) -> Line {
    let [from, to] = [-1.0, 1.0].map(|x| CENTER + Vec3::new(x, 0.0, -1.0));
    Line { from, to, color: [0, 255, 0, 255], width_px: 6.0, dash_px: 0.0, layer }
}

fn marker(layer: Layer) -> Marker {
    let black = [0, 0, 0, 255];
    Marker {
        at: CENTER,
        radius_px: 5.0,
        color: [255, 0, 0, 255],
        outline: black,
        outline_px: 3.0,
        layer,
        shape: Shape::Disc,
    }
}

/// A ball half as large again as the one that is the figure, around it.
fn ball(layer: Layer) -> Ball {
    Ball { center: CENTER, radius_m: 1.5 * RADIUS, color: [0, 255, 0, 255], layer }
}

/// A square a little behind the figure's middle, upright, as wide as the figure's ball and half as much again.
fn fan(layer: Layer) -> Fan {
    let mut overlay = Overlay::EMPTY;
    let half = 1.5 * RADIUS;
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    overlay.polygon(&corners.map(|[x, y]| CENTER + Vec3::new(x, y, 0.0)), [0, 255, 0, 128], layer);
    overlay.fans.remove(0)
}

/// How much greener than red a colour is.
fn green(pixel: [u8; 4]) -> i32 {
    i32::from(pixel[1]) - i32::from(pixel[0])
}

#[test]
fn a_ball_is_clear_in_the_middle_dense_at_the_rim_and_nowhere_else() {
    let mut renderer = renderer_of(&body::ball(CENTER, 0.01));
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let camera = Camera { target: CENTER, projection, ..Camera::default() };
        let look = Look { grid: false, ..Look::default() };
        let overlay = Overlay { balls: vec![ball(Layer::Tested)], ..Overlay::EMPTY };
        let shot = |overlay| Scene { overlay, look, ..Scene::new(&[], camera, SIZE) };
        let empty = Overlay::EMPTY;
        let bare = draw(&mut renderer, &shot(&empty));
        let image = draw(&mut renderer, &shot(&overlay));
        let middle = pixels() * 0.5;
        let radius_px = match projection {
            Projection::Perspective => {
                let sine = ball(Layer::Tested).radius_m / camera.distance;
                sine / (1.0 - sine * sine).sqrt() * camera.distance
            }
            Projection::Orthographic => ball(Layer::Tested).radius_m,
        } / camera.metres_per_pixel(CENTER, pixels().y);
        // Between two lines of the net.
        let aside = Vec2::new(0.7, -0.7).normalize();
        let tint = |share: f32| green(at(&image, middle + aside * radius_px * share));
        let plain = green(at(&bare, middle));
        assert!((10..80).contains(&(tint(0.3) - plain)), "{projection:?}: middle {}", tint(0.3));
        assert!(tint(0.985) > tint(0.3) + 80, "{projection:?}: rim {}", tint(0.985));
        for outside in [1.03, 1.2] {
            let p = middle + aside * radius_px * outside;
            assert_eq!(at(&image, p), at(&bare, p), "{projection:?}");
        }
    }
}

#[test]
fn a_ball_is_seen_from_within() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera { target: CENTER, distance: 0.5, ..Camera::default() };
    let overlay = Overlay { balls: vec![Ball { radius_m: 2.0, ..ball(Layer::Tested) }], ..Overlay::EMPTY };
    let bare = draw(&mut renderer, &Scene::new(&[], camera, SIZE));
    let image = draw(&mut renderer, &Scene { overlay: &overlay, ..Scene::new(&[], camera, SIZE) });
    assert!(each_pixel().all(|p| green(at(&image, p)) > green(at(&bare, p))), "all of it is tinted");
    let line = each_pixel().map(|p| green(at(&image, p)) - green(at(&bare, p))).max().unwrap();
    assert!(line > 30, "and the net shows: {line}");
}

#[test]
fn surfaces_behind_the_figure_are_hidden_faint_or_whole_as_asked() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera { target: CENTER, ..Camera::default() };
    let mut tints = |overlay: &Overlay| {
        let image = draw(&mut renderer, &Scene { overlay, ..Scene::new(&figures, camera, SIZE) });
        let beside = Vec2::new(1.3 * RADIUS, 0.13 * RADIUS) / camera.metres_per_pixel(CENTER, pixels().y);
        let within = Vec2::new(0.4, 0.13) * beside.x;
        [within, beside].map(|off| green(at(&image, pixels() * 0.5 + off)))
    };
    let bare = tints(&Overlay::EMPTY);
    let mut of = |layer| tints(&Overlay { fans: vec![fan(layer)], ..Overlay::EMPTY });
    let [tested, ghosted, on_top] = [of(Layer::Tested), of(Layer::Ghosted), of(Layer::OnTop)];
    assert_eq!(tested[0], bare[0], "the sheet is behind the figure's front");
    assert!(ghosted[0] > bare[0] + 15 && on_top[0] > ghosted[0] + 40, "{ghosted:?} {on_top:?}");
    for tints in [tested, ghosted, on_top] {
        assert!(tints[1] > bare[1] + 90, "beside the figure it is whole: {tints:?}");
    }
    let mut of = |layer| tints(&Overlay { balls: vec![ball(layer)], ..Overlay::EMPTY });
    let [tested, ghosted, on_top] = [of(Layer::Tested), of(Layer::Ghosted), of(Layer::OnTop)];
    assert!(bare[0] + 5 < tested[0], "the near half lies before the figure: {tested:?}");
    assert!(tested[0] < ghosted[0] && ghosted[0] < on_top[0], "{tested:?} {ghosted:?} {on_top:?}");
    assert_eq!([tested[1], ghosted[1]], [on_top[1]; 2], "beside the figure nothing hides it");
}

#[test]
fn marks_of_each_shape_differ() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera { target: CENTER, ..Camera::default() };
    let mut red_at = |shape, off: [f32; 2]| {
        let mark = Marker { radius_px: 20.0, shape, outline_px: 0.0, ..marker(Layer::OnTop) };
        let overlay = Overlay { markers: vec![mark], ..Overlay::EMPTY };
        let image = draw(&mut renderer, &Scene { overlay: &overlay, ..Scene::new(&[], camera, SIZE) });
        at(&image, pixels() * 0.5 + Vec2::from(off)) == [255, 0, 0, 255]
    };
    // Places: the middle, near the edge to the right, near the edge diagonally, beyond the disc to the right and
    // diagonally beyond it.
    let places = [[0.0, 0.0], [18.0, 0.0], [13.5, 13.5], [23.0, 0.0], [16.0, 16.0]];
    let expected = [
        (Shape::Disc, [true, true, true, false, false]),
        (Shape::Ring, [false, true, true, false, false]),
        (Shape::Diamond, [true, true, false, true, false]),
        (Shape::Square, [true, false, true, false, true]),
        (Shape::Cross, [true, false, true, false, true]),
    ];
    for (shape, inside) in expected {
        assert_eq!(places.map(|p| red_at(shape, p)), inside, "{shape:?}");
    }
    assert!(!red_at(Shape::Cross, [12.0, 0.0]) && red_at(Shape::Square, [12.0, 0.0]));
}

#[test]
fn marks_are_hidden_faint_or_on_top_as_asked() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 4.0 / 3.0);
    let middle = camera.pixel_of(CENTER, pixels()).unwrap();
    let mut seen = |overlay: &Overlay| {
        let scene = Scene { overlay, ..Scene::new(&figures, camera, SIZE) };
        draw(&mut renderer, &scene)
    };
    let bare = at(&seen(&Overlay::default()), middle);
    let mut with = |layer| seen(&Overlay { lines: vec![line(layer)], ..Overlay::EMPTY });
    assert_eq!(at(&with(Layer::Tested), middle), bare, "behind the ball");
    assert_eq!(at(&with(Layer::OnTop), middle), [0, 255, 0, 255]);
    let faint = at(&with(Layer::Ghosted), middle);
    assert!(faint != bare && faint[0] > 60, "{faint:?} over {bare:?}");
    let free = Vec2::new(12.0, middle.y);
    assert_eq!(at(&with(Layer::Tested), free), [0, 255, 0, 255], "beside the ball");
    let dot = seen(&Overlay { markers: vec![marker(Layer::OnTop)], ..Overlay::EMPTY });
    assert_eq!(at(&dot, middle), [255, 0, 0, 255]);
    assert_eq!(at(&dot, middle + Vec2::new(6.5, 0.0)), [0, 0, 0, 255]);
    assert_eq!(at(&dot, middle + Vec2::new(12.0, 0.0))[0].abs_diff(bare[0]) / 16, 0);
}

#[test]
fn a_dashed_line_has_gaps_and_a_line_into_the_eye_is_cut() {
    let mut renderer = renderer_of(&body::ball(CENTER, 0.01));
    let camera = Camera::default();
    let eye = camera.eye();
    let dashed = Line {
        from: Vec3::new(-0.5, 0.9, 0.0),
        to: Vec3::new(0.5, 0.9, 0.0),
        dash_px: 12.0,
        ..line(Layer::OnTop)
    };
    let behind =
        Line { from: Vec3::new(0.0, 0.2, 0.0), to: eye + Vec3::new(0.0, 0.3, 1.0), dash_px: 0.0, ..dashed };
    let overlay = Overlay { lines: vec![dashed, behind], ..Overlay::EMPTY };
    let image = draw(&mut renderer, &Scene { overlay: &overlay, ..Scene::new(&[], camera, SIZE) });
    let green = |p: [u8; 4]| p[1] > 200 && p[0] < 60;
    let row: Vec<bool> = (110..210).map(|x| green(image.pixel(x, 120).unwrap())).collect();
    let changes = row.windows(2).filter(|w| w[0] != w[1]).count();
    assert!((12..=20).contains(&changes), "{changes} ends of dashes");
    let start = camera.pixel_of(behind.from, pixels()).unwrap();
    assert!(green(at(&image, start)), "the part before the eye is drawn");
}

#[test]
fn marked_bones_are_tinted_and_others_are_not() {
    let mut renderer = renderer_of(&body::mesh());
    let camera = Camera::view(
        View::Front,
        rig::Bounds { min: Vec3::new(-0.8, 0.0, 0.0), max: Vec3::new(0.8, 1.8, 0.0) },
        1.3,
    );
    let mut shot = |selected: &[Bone], hovered: &[Bone]| {
        let figures = [FigureView { selected, hovered, ..FigureView::new(&Palette::REST) }];
        draw(&mut renderer, &Scene::new(&figures, camera, SIZE))
    };
    let plain = shot(&[], &[]);
    let shin = camera.pixel_of(Vec3::new(-0.095, 0.3, 0.0), pixels()).unwrap();
    let arm = camera.pixel_of(Vec3::new(0.3, 1.41, 0.0), pixels()).unwrap();
    for marked in [shot(&[Bone::RightLowerLeg], &[]), shot(&[], &[Bone::RightLowerLeg])] {
        let (was, is) = (at(&plain, shin), at(&marked, shin));
        assert!(
            i32::from(is[0]) - i32::from(is[2]) > i32::from(was[0]) - i32::from(was[2]) + 15,
            "{was:?} {is:?}"
        );
        assert_eq!(at(&plain, arm), at(&marked, arm));
    }
}

#[test]
fn the_figure_casts_a_shadow_and_a_ghost_does_not() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let mut camera = Camera { pitch_rad: 0.5, distance: 6.0, ..Camera::default() };
    camera.target = CENTER;
    let look = Look { key_light: Vec3::new(0.6, 1.0, -0.4), grid: false, ..Look::default() };
    let on_ground = Vec3::new(CENTER.x - 0.6, 0.0, CENTER.z + 0.4);
    let spot = camera.pixel_of(on_ground, pixels()).unwrap();
    let mut shot = |opacity, shadow| {
        let figures = [FigureView { opacity, ..FigureView::new(&Palette::REST) }];
        let look = Look { shadow, ..look };
        draw(&mut renderer, &Scene { look, ..Scene::new(&figures, camera, SIZE) })
    };
    let (with, without, ghost) = (shot(1.0, true), shot(1.0, false), shot(0.4, true));
    assert!(
        at(&with, spot)[0] + 20 < at(&without, spot)[0],
        "{:?} {:?}",
        at(&with, spot),
        at(&without, spot)
    );
    assert_eq!(at(&ghost, spot), at(&without, spot));
    let middle = camera.pixel_of(CENTER, pixels()).unwrap();
    let (solid, ghost) = (at(&with, middle)[0], at(&ghost, middle)[0]);
    assert!(solid > ghost + 10, "a ghost lets the background through: {solid} {ghost}");
}

#[test]
fn ground_takes_the_plane_s_place_and_catches_the_shadow_where_it_lies() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let below = 0.7_f32;
    let [corner, across, along] =
        [Vec3::new(-8.0, -below, -8.0), Vec3::new(0.0, 0.0, 16.0), Vec3::new(16.0, 0.0, 0.0)];
    renderer.set_mesh(1, &flat_wall(corner, across, along)).unwrap();
    let key_light = Vec3::new(0.6, 1.0, -0.4);
    let camera = Camera { pitch_rad: 0.5, distance: 7.0, target: CENTER, ..Camera::default() };
    let look = Look { key_light, grid: false, ..Look::default() };
    // Straight away from the light: on the ground, and where the plane y = 0 would be.
    let falls = |height: f32| CENTER - key_light * (CENTER.y - height);
    let mut shot = |style, ambient_occlusion, grounded, pass| {
        let ground = FigureView { skin: 1, ground: true, ..FigureView::new(&Palette::REST) };
        let figures = [FigureView::new(&Palette::REST), ground];
        let figures = if grounded { &figures[..] } else { &figures[..1] };
        let look = Look { style, ambient_occlusion, ..look };
        draw(&mut renderer, &Scene { look, pass, ..Scene::new(figures, camera, SIZE) })
    };
    let light = |image: &Image, place| i32::from(at(image, camera.pixel_of(place, pixels()).unwrap())[1]);
    let beside = falls(-below) + Vec3::new(1.6, 0.0, 0.0);
    for style in [Style::Studio, Style::Clay, Style::Matcap, Style::Flat] {
        for ambient_occlusion in [true, false] {
            let image = shot(style, ambient_occlusion, true, Pass::Color);
            let (dark, bright) = (light(&image, falls(-below)), light(&image, beside));
            assert!(dark + 25 < bright, "{style:?} {ambient_occlusion}: {dark} {bright}");
            let plane = light(&image, falls(0.0));
            assert!((plane - bright).abs() < 12, "no second shadow: {plane} {bright}");
        }
    }
    for pass in [Pass::Silhouette, Pass::Parts, Pass::Depth] {
        let with = shot(Style::Studio, true, true, pass);
        let alone = shot(Style::Studio, true, false, pass);
        let middle = camera.pixel_of(CENTER, pixels()).unwrap();
        assert_eq!(at(&with, middle), at(&alone, middle), "{pass:?}");
        assert!(pass == Pass::Depth || with == alone, "{pass:?} is of figures alone");
    }
}

#[test]
fn openpose_draws_keypoints_in_their_colours() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera::default();
    let [nose, neck, shoulder] = [[0.0, 1.5], [0.0, 1.2], [-0.3, 1.2]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let other = DVec3::new(0.5, 0.5, 0.0);
    let mut keypoints = [Keypoints::default(); 2];
    keypoints[0].body[..4].copy_from_slice(&[Some(nose), Some(neck), Some(shoulder), Some(DVec3::NAN)]);
    keypoints[1].body[1] = Some(other);
    let scene = Scene { pass: Pass::OpenPose, keypoints: &keypoints, ..Scene::new(&[], camera, SIZE) };
    let image = draw(&mut renderer, &scene);
    let spot = |p: DVec3| at(&image, camera.pixel_of(p.as_vec3(), pixels()).unwrap());
    assert_eq!(spot(nose), [255, 0, 0, 255]);
    assert_eq!(spot(neck), [255, 85, 0, 255]);
    assert_eq!(spot(shoulder), [255, 170, 0, 255]);
    assert_eq!(spot(other), [255, 85, 0, 255], "a second person");
    assert_eq!(spot(DVec3::new(-0.15, 1.2, 0.0)), [153, 0, 0, 255], "neck to right shoulder, darkened");
    assert_eq!(spot(DVec3::new(0.25, 0.85, 0.0)), [0, 0, 0, 255], "persons are not joined");
    assert_eq!(image.pixel(0, 0), Some([0, 0, 0, 255]));
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera::default();
    for size in [[0, 10], [10, 0], [1_000_000, 10]] {
        let error = renderer.image(&Scene::new(&[], camera, size)).unwrap_err();
        assert!(matches!(error, DrawError::Size { limit, .. } if limit >= 2048), "{error}");
    }
    let figures = [FigureView { skin: 3, ..FigureView::new(&Palette::REST) }];
    let error = renderer.image(&Scene::new(&figures, camera, SIZE)).unwrap_err();
    assert_eq!(error, DrawError::NoSkin { figure: 0, skin: 3 });
    let mut mesh = body::ball(CENTER, RADIUS);
    mesh.indices[5] = u32::MAX;
    assert!(matches!(renderer.set_mesh(0, &mesh), Err(DrawError::Mesh(_))));
    assert!(renderer.set_mesh(0, &rig::Mesh::default()).is_ok(), "an empty skin is no fault");
    let figures = [FigureView::new(&Palette::REST)];
    assert!(draw(&mut renderer, &Scene::new(&figures, camera, SIZE)).rgba.iter().any(|&b| b > 0));
}

#[test]
fn bad_numbers_draw_something_and_break_nothing() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let mut palette = Palette::REST;
    palette.0[0][0][0] = f32::NAN;
    let figures = [
        FigureView { world_from_figure: Mat4::from_scale(Vec3::ZERO), ..FigureView::new(&palette) },
        FigureView { opacity: f32::NAN, ..FigureView::new(&Palette::REST) },
    ];
    let look = Look { key_light: Vec3::NAN, scale: f32::NAN, ..Look::default() };
    let camera = Camera { target: Vec3::NAN, ..Camera::default() };
    for camera in [camera, Camera::default()] {
        for pass in [Pass::Color, Pass::Depth, Pass::Normal] {
            draw(&mut renderer, &Scene { look, pass, ..Scene::new(&figures, camera, [40, 30]) });
        }
    }
}

#[test]
fn a_blit_paints_the_picture_in_gamma_space() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera::view(View::Front, renderer.bounds(&figures), 4.0 / 3.0);
    let look = Look { msaa: Msaa::One, ..Look::default() };
    let scene = Scene { look, ..Scene::new(&figures, camera, SIZE) };
    let direct = draw(&mut renderer, &scene);
    let _turn = TURN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let painted = blit(&mut renderer, &scene);
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let (a, b) = (direct.pixel(x, y).unwrap(), painted.pixel(x + 16, y + 8).unwrap());
            assert!(a.into_iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1), "{x} {y}: {a:?} painted as {b:?}");
        }
    }
    assert_eq!(painted.pixel(4, 4), Some([0, 0, 255, 255]), "nothing outside the rectangle");
}

/// The scene painted at (16, 8) of a blue target with gamma-space numbers.
fn blit(renderer: &mut Renderer, scene: &Scene<'_>) -> Image {
    let gpu = renderer.gpu().clone();
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let [width, height] = [384, 256];
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut blit = Blit::new(&gpu, format);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.draw(&mut encoder, scene).unwrap();
    blit.prepare(renderer);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLUE),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..wgpu::RenderPassDescriptor::default()
    });
    blit.paint(&mut pass, [16.0, 8.0, SIZE[0] as f32, SIZE[1] as f32]);
    drop(pass);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(width * height * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 4), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        target.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        target.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    assert_eq!(gpu.take_fault(), None);
    let rgba = buffer.get_mapped_range(..).unwrap().to_vec();
    Image { width, height, rgba }
}

#[test]
fn a_picture_for_reference_is_seen_behind_the_figure_and_not_on_it() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let camera = Camera { target: CENTER, ..Camera::default() };
    // Red above, blue below, half as wide as high.
    let rows = [[220, 30, 20, 255], [20, 30, 220, 255]].map(|row: [u8; 4]| row.repeat(32 * 32));
    let reference = Image { width: 32, height: 64, rgba: rows.concat() };
    renderer.set_backdrop(Some(&reference)).unwrap();
    let mut shot = |backdrop_opacity| {
        let look = Look { grid: false, shadow: false, backdrop_opacity, ..Look::default() };
        draw(&mut renderer, &Scene { look, ..Scene::new(&figures, camera, SIZE) })
    };
    let (none, half, whole) = (shot(0.0), shot(0.5), shot(1.0));
    let middle = pixels() * 0.5;
    let (above, below) = (Vec2::new(middle.x, 8.0), Vec2::new(middle.x, pixels().y - 8.0));
    assert_eq!(at(&whole, above), [220, 30, 20, 255]);
    assert_eq!(at(&whole, below), [20, 30, 220, 255], "as high as the view");
    assert_eq!(at(&whole, middle), at(&none, middle), "the figure is before it");
    let blend = (u16::from(at(&none, above)[0]) + 220) / 2;
    assert!(u16::from(at(&half, above)[0]).abs_diff(blend) <= 2);
    for beside in [middle.x - 70.0, middle.x + 70.0] {
        let beside = Vec2::new(beside, 8.0);
        assert_eq!(at(&whole, beside), at(&none, beside), "it keeps its shape");
    }
    let short = Image { rgba: vec![0; 4], ..reference };
    assert!(matches!(renderer.set_backdrop(Some(&short)), Err(DrawError::Size { .. })));
    assert!(renderer.set_backdrop(None).is_ok());
}

#[test]
fn the_grid_is_legible_on_dark_and_on_light_ground() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera { pitch_rad: 0.9, target: Vec3::ZERO, ..Camera::default() };
    for (look, lines_are_lighter) in [(Look::default(), true), (Look::light(), false)] {
        let mut shot = |grid| {
            let look = Look { grid, ..look };
            draw(&mut renderer, &Scene { look, ..Scene::new(&[], camera, SIZE) })
        };
        let (with, without) = (shot(true), shot(false));
        let differ = |p: Vec2| i32::from(at(&with, p)[1]) - i32::from(at(&without, p)[1]);
        let strongest = each_pixel().map(differ).max_by_key(|d| d.abs()).unwrap();
        assert!(strongest.abs() > 15 && (strongest > 0) == lines_are_lighter, "{strongest}");
    }
}

#[test]
fn a_smaller_scale_draws_a_smaller_texture() {
    let mut renderer = renderer_of(&body::ball(CENTER, RADIUS));
    let figures = [FigureView::new(&Palette::REST)];
    let look = Look { scale: 0.5, ..Look::default().lean() };
    let scene = Scene { look, ..Scene::new(&figures, Camera::default(), SIZE) };
    let gpu = renderer.gpu().clone();
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.draw(&mut encoder, &scene).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let picture = renderer.picture().unwrap();
    assert_eq!((picture.width(), picture.height()), (SIZE[0] / 2, SIZE[1] / 2));
    let image = draw(&mut renderer, &scene);
    assert_eq!((image.width, image.height), (SIZE[0], SIZE[1]));
}
