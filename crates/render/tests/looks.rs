//! Every style and pass: stored pictures with numbers beside them, and what all styles have in common.
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::sync::{LazyLock, Mutex, PoisonError};

use glam::{DVec3, Vec2, Vec3};
use render::{
    FigureView, Gpu, Image, Keypoints, Look, Pass, Renderer, Scene, Style, part_color, part_of_color,
};
use rig::{Bone, Camera, Palette, View};

mod body;

static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::headless().expect("a graphics adapter"));
/// One picture at a time: software drivers gain nothing from more, and take the memory.
static TURN: Mutex<()> = Mutex::new(());

const SIZE: [u32; 2] = [200, 240];

fn renderer(gpu: &Gpu) -> Renderer {
    let mut renderer = Renderer::new(gpu);
    renderer.set_mesh(0, &body::mesh()).unwrap();
    renderer
}

fn draw(renderer: &mut Renderer, scene: &Scene<'_>) -> Image {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    renderer.image(scene).unwrap()
}

fn camera(renderer: &Renderer, figures: &[FigureView<'_>], view: View) -> Camera {
    Camera::view(view, renderer.bounds(figures), SIZE[0] as f32 / SIZE[1] as f32)
}

fn plain(style: Style) -> Look {
    Look { style, grid: false, ..Look::default() }
}

fn keypoints() -> Keypoints {
    let mut points = Keypoints::default();
    let rest = body::rest();
    let body = [
        (0, Bone::Head),
        (1, Bone::Neck),
        (2, Bone::RightUpperArm),
        (3, Bone::RightLowerArm),
        (4, Bone::RightHand),
        (5, Bone::LeftUpperArm),
        (6, Bone::LeftLowerArm),
        (7, Bone::LeftHand),
        (8, Bone::RightUpperLeg),
        (9, Bone::RightLowerLeg),
        (10, Bone::RightFoot),
        (11, Bone::LeftUpperLeg),
        (12, Bone::LeftLowerLeg),
        (13, Bone::LeftFoot),
    ];
    for (place, bone) in body {
        points.body[place] = Some(rest[bone.index()]);
    }
    points
}

/// A picture's numbers: how much is not the corner's colour, how bright that is on average, how much is clearly darker
/// than the corner. In percent, percent of white, percent.
fn numbers(image: &Image) -> [f64; 3] {
    let corner = luminance(image.pixel(0, 0).unwrap());
    let all: Vec<f64> = image.rgba.chunks_exact(4).map(|p| luminance(p.try_into().unwrap())).collect();
    let drawn: Vec<f64> = all.iter().copied().filter(|l| (l - corner).abs() > 0.12).collect();
    let dark = all.iter().filter(|l| **l < corner - 0.12).count();
    let percent = |n: usize| 100.0 * n as f64 / all.len() as f64;
    let mean = drawn.iter().sum::<f64>() / drawn.len().max(1) as f64;
    [percent(drawn.len()), 100.0 * mean, percent(dark)]
}

fn luminance(p: [u8; 4]) -> f64 {
    (0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2])) / 255.0
}

/// Compares with the stored picture, or stores it if UPDATE_SNAPSHOTS is set. A driver may move an edge by a hair.
fn compare(name: &str, image: &Image) -> Option<String> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots").join(format!("{name}.png"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        image::save_buffer(&path, &image.rgba, image.width, image.height, image::ColorType::Rgba8).unwrap();
        return None;
    }
    let stored = match image::open(&path) {
        Ok(stored) => stored.to_rgba8(),
        Err(error) => return Some(format!("{name}: {error}")),
    };
    if (stored.width(), stored.height()) != (image.width, image.height) {
        return Some(format!("{name}: another size"));
    }
    let pixels = stored.chunks_exact(4).zip(image.rgba.chunks_exact(4));
    let off = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 4)).count();
    (off > 20).then(|| format!("{name}: {off} pixels differ from the stored picture"))
}

#[test]
fn every_style_and_pass_is_as_stored_and_its_numbers_are_right() {
    let palette = body::standing();
    let figures = [FigureView::new(&palette)];
    let mut renderer = renderer(&GPU);
    let camera = camera(&renderer, &figures, View::ThreeQuarter);
    let keypoints = [keypoints()];
    let wood = Look { joint_planes: true, ..plain(Style::Studio) };
    let light = Look { grid: true, ..Look::light() };
    // Name, look, pass; percent drawn, mean brightness of that, percent darker than the background.
    let shots = [
        ("studio", plain(Style::Studio), Pass::Color, [10.3, 49.6, 4.1]),
        ("clay", plain(Style::Clay), Pass::Color, [9.4, 41.1, 4.9]),
        ("matcap", plain(Style::Matcap), Pass::Color, [13.8, 54.7, 4.0]),
        ("flat", plain(Style::Flat), Pass::Color, [11.9, 49.8, 4.0]),
        ("line", plain(Style::Line), Pass::Color, [5.1, 37.7, 5.1]),
        ("wood", wood, Pass::Color, [9.3, 37.9, 5.4]),
        ("light", light, Pass::Color, [20.6, 70.3, 9.2]),
        ("lean", plain(Style::Studio).lean(), Pass::Color, [8.2, 60.8, 1.6]),
        ("depth", plain(Style::Studio), Pass::Depth, [10.5, 42.9, 0.0]),
        ("normal", plain(Style::Studio), Pass::Normal, [4.9, 47.7, 3.1]),
        ("silhouette", plain(Style::Studio), Pass::Silhouette, [11.1, 94.7, 0.0]),
        ("parts", plain(Style::Studio), Pass::Parts, [9.0, 37.7, 0.0]),
        ("openpose", plain(Style::Studio), Pass::OpenPose, [2.5, 35.9, 0.0]),
    ];
    let mut faults = Vec::new();
    for (name, look, pass, expected) in shots {
        let scene = Scene { look, pass, keypoints: &keypoints, ..Scene::new(&figures, camera, SIZE) };
        let image = draw(&mut renderer, &scene);
        let found = numbers(&image);
        if found.iter().zip(expected).any(|(f, e)| (f - e).abs() > 1.5) {
            faults.push(format!("{name}: {found:.1?}, expected {expected:.1?}"));
        }
        faults.extend(compare(name, &image));
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn the_same_scene_gives_the_same_bytes_in_every_style_and_pass() {
    let palette = body::standing();
    let figures = [FigureView { hovered: &[Bone::Head], ..FigureView::new(&palette) }];
    let (mut one, mut two) = (renderer(&GPU), renderer(&Gpu::headless().unwrap()));
    let camera = camera(&one, &figures, View::ThreeQuarter);
    let looks = Style::ALL.map(|style| (Look { joint_planes: true, ..plain(style) }, Pass::Color));
    for (look, pass) in looks.into_iter().chain(Pass::ALL.map(|pass| (Look::default(), pass))) {
        let scene = Scene { look, pass, ..Scene::new(&figures, camera, [80, 96]) };
        let first = draw(&mut one, &scene);
        assert!(first == draw(&mut two, &scene), "{:?} {pass:?}: another device's differs", look.style);
        assert!(first == draw(&mut one, &scene), "{:?} {pass:?}: a second one differs", look.style);
    }
}

#[test]
fn every_style_tints_what_is_marked_and_lets_ghosts_shine_through() {
    let mut renderer = renderer(&GPU);
    let rest = FigureView::new(&Palette::REST);
    let camera = camera(&renderer, &[rest], View::Front);
    let size = Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
    let shin = camera.pixel_of(Vec3::new(-0.095, 0.3, 0.0), size).unwrap();
    let at = |image: &Image, p: Vec2| image.pixel(p.x as u32, p.y as u32).unwrap();
    let belly = camera.pixel_of(Vec3::new(0.0, 1.1, 0.0), size).unwrap();
    for style in Style::ALL {
        for look in [plain(style), plain(style).lean(), plain(style).in_surroundings(true)] {
            let look = Look { transparent: true, ..look };
            let mut shot = |view: FigureView<'_>| {
                draw(&mut renderer, &Scene { look, ..Scene::new(&[view], camera, SIZE) })
            };
            let bare = shot(rest);
            let warmth = |p: [u8; 4]| i32::from(p[0]) - i32::from(p[2]);
            for marked in [
                shot(FigureView { selected: &[Bone::RightLowerLeg], ..rest }),
                shot(FigureView { hovered: &[Bone::RightLowerLeg], ..rest }),
            ] {
                let (was, is) = (at(&bare, shin), at(&marked, shin));
                assert!(warmth(is) > warmth(was) + 12, "{style:?}: {was:?} {is:?}");
                assert_eq!(at(&bare, belly), at(&marked, belly), "{style:?}");
            }
            assert_eq!(at(&bare, belly)[3], 255, "{style:?}");
            assert_eq!(bare.pixel(1, 1).unwrap()[3], 0, "{style:?}: clear beside the figure");
            let ghost = shot(FigureView { opacity: 0.5, ..rest });
            assert!((120..136).contains(&at(&ghost, belly)[3]), "{style:?}: {:?}", at(&ghost, belly));
        }
    }
}

#[test]
fn clay_has_one_colour_and_studio_the_skin_s() {
    let mut renderer = Renderer::new(&GPU);
    let figures = [FigureView::new(&Palette::REST)];
    let mut shot = |style: Style, color: [f32; 3]| {
        let mut mesh = body::ball(Vec3::Y, 0.4);
        mesh.colors.fill(color);
        renderer.set_mesh(0, &mesh).unwrap();
        let camera = Camera { target: Vec3::Y, distance: 3.0, ..Camera::default() };
        let look = Look { shadow: false, ..plain(style) };
        draw(&mut renderer, &Scene { look, ..Scene::new(&figures, camera, [40, 40]) })
    };
    let (red, blue) = ([0.6, 0.1, 0.1], [0.1, 0.1, 0.6]);
    for style in [Style::Clay, Style::Matcap, Style::Line] {
        assert!(shot(style, red) == shot(style, blue), "{style:?} ignores the skin's colour");
    }
    let (red, blue) = (shot(Style::Studio, red), shot(Style::Studio, blue));
    let [r, _, b, _] = red.pixel(20, 20).unwrap();
    assert!(r > b + 40, "red {r}, blue {b}");
    let [r, _, b, _] = blue.pixel(20, 20).unwrap();
    assert!(b > r + 40, "red {r}, blue {b}");
}

#[test]
fn parts_are_exact_and_nothing_is_mixed() {
    let mut renderer = renderer(&GPU);
    let figures = [FigureView::new(&Palette::REST)];
    let camera = camera(&renderer, &figures, View::Front);
    let look = Look { supersampling: 3, ..Look::default() };
    let parts = draw(&mut renderer, &Scene { look, pass: Pass::Parts, ..Scene::new(&figures, camera, SIZE) });
    let mut found = [0; Bone::COUNT];
    for p in parts.rgba.chunks_exact(4) {
        let color = [p[0], p[1], p[2]];
        assert_eq!(p[3], 255);
        match part_of_color(color) {
            Some(bone) => found[bone.index()] += 1,
            None => assert_eq!(color, [0; 3], "a mixed colour"),
        }
    }
    let size = Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
    // Middles of capsules.
    let spots = [
        (Bone::Head, [0.0, 1.65, 0.02]),
        (Bone::LeftLowerArm, [0.6, 1.41, 0.0]),
        (Bone::RightLowerArm, [-0.6, 1.41, 0.0]),
        (Bone::RightLowerLeg, [-0.095, 0.3, 0.0]),
        (Bone::LeftUpperLeg, [0.093, 0.65, 0.0]),
    ];
    for (bone, spot) in spots {
        let p = camera.pixel_of(Vec3::from(spot), size).unwrap();
        let [r, g, b, _] = parts.pixel(p.x as u32, p.y as u32).unwrap();
        assert_eq!([r, g, b], part_color(bone), "{bone}");
        assert!(found[bone.index()] > 20, "{bone}: {}", found[bone.index()]);
    }
}

#[test]
fn the_ground_catches_the_shadow_alone_when_the_rest_is_clear() {
    let mut renderer = Renderer::new(&GPU);
    let center = Vec3::new(0.0, 1.0, 0.0);
    renderer.set_mesh(0, &body::ball(center, 0.3)).unwrap();
    let figures = [FigureView::new(&Palette::REST)];
    let camera =
        Camera { target: Vec3::new(0.0, 0.4, 0.0), pitch_rad: 0.5, distance: 6.0, ..Camera::default() };
    let key = Vec3::new(0.6, 1.0, -0.4);
    let size = Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
    // The middle of the shadow, and where the ground is in the light.
    let middle = camera.pixel_of(center - key, size).unwrap();
    let beside = camera.pixel_of(Vec3::new(0.9, 0.0, 0.3), size).unwrap();
    let mut shot = |look: Look, camera: Camera| {
        let look = Look { transparent: true, key_light: key, ..look };
        let image = draw(&mut renderer, &Scene { look, ..Scene::new(&figures, camera, SIZE) });
        [middle, beside].map(|p| image.pixel(p.x as u32, p.y as u32).unwrap())
    };
    for ambient_occlusion in [false, true] {
        let look = Look { ambient_occlusion, ..Look::default() };
        let [dark, clear] = shot(look, camera);
        assert_eq!(dark[..3], [0, 0, 0], "the shadow is black");
        assert!((60..170).contains(&dark[3]), "its strength is the alpha: {dark:?}");
        assert_eq!(clear, [0; 4], "the ground itself isn't there");
        for none in [Look { ground_shadow: false, ..look }, Look { shadow: false, ..look }] {
            assert_eq!(shot(none, camera)[0], [0; 4]);
        }
        let below = Camera { pitch_rad: -0.5, ..camera };
        assert_eq!(shot(look, below)[0], [0; 4], "from below the ground nothing is on it");
    }
}

#[test]
fn a_lean_look_draws_two_passes_and_only_what_changed_is_drawn_and_uploaded_again() {
    let mut renderer = renderer(&GPU);
    let (standing, rest) = (body::standing(), Palette::REST);
    let view = FigureView::new(&standing);
    let camera = camera(&renderer, &[view], View::ThreeQuarter);
    let mut stats = |view: FigureView<'_>, camera: Camera, look: Look| {
        draw(&mut renderer, &Scene { look, ..Scene::new(&[view], camera, SIZE) });
        renderer.stats()
    };
    let look = Look::default();
    let first = stats(view, camera, look);
    assert_eq!(
        (first.passes, first.kept_passes),
        (7, 0),
        "shadow, soft shadow, survey in three, figures, surroundings"
    );
    let again = stats(view, camera, look);
    assert_eq!((again.passes, again.kept_passes, again.uploaded_bytes), (2, 5, 0), "the same again");
    let hover = stats(FigureView { hovered: &[Bone::Head], ..view }, camera, look);
    assert_eq!((hover.passes, hover.kept_passes), (2, 5), "a tint moves no shadow");
    assert!(hover.uploaded_bytes > 0);
    let orbit = stats(view, Camera { yaw_rad: 1.0, ..camera }, look);
    assert_eq!((orbit.passes, orbit.kept_passes), (5, 2), "the light sees the same when the camera moves");
    let moved = stats(FigureView { palette: &rest, ..view }, camera, look);
    assert_eq!((moved.passes, moved.kept_passes), (7, 0));
    let lean = stats(view, camera, look.lean());
    assert_eq!((lean.passes, lean.kept_passes, lean.draw_calls), (2, 0, 3), "figure, grid, background");
}

#[test]
fn hands_and_feet_are_drawn_where_they_project_in_their_colours() {
    let mut renderer = Renderer::new(&GPU);
    let camera = Camera { target: Vec3::ZERO, distance: 1.0, ..Camera::default() };
    let size = [400, 400];
    let spot = |p: DVec3| camera.pixel_of(p.as_vec3(), Vec2::splat(400.0)).unwrap();
    let mut person = Keypoints::default();
    // A hand as a fan: fingers at angles, joints at even steps.
    let wrist = DVec3::new(0.0, -0.2, 0.0);
    let joint = |finger: usize, along: usize| {
        let angle = (finger as f64 - 2.0) * 0.4;
        wrist + DVec3::new(angle.sin(), angle.cos(), 0.0) * (0.07 + 0.06 * along as f64)
    };
    person.left_hand[0] = Some(wrist);
    for finger in 0..5 {
        for along in 0..4 {
            person.left_hand[1 + 4 * finger + along] = Some(joint(finger, along));
        }
    }
    let (ankle, big, heel) =
        (DVec3::new(0.18, -0.1, 0.0), DVec3::new(0.22, -0.18, 0.0), DVec3::new(0.14, -0.18, 0.0));
    person.body[13] = Some(ankle);
    person.feet[0] = Some(big);
    person.feet[2] = Some(heel);
    let keypoints = [person];
    let scene = Scene { pass: Pass::OpenPose, keypoints: &keypoints, ..Scene::new(&[], camera, size) };
    let image = draw(&mut renderer, &scene);
    let at = |p: DVec3| {
        let p = spot(p);
        let [r, g, b, _] = image.pixel(p.x as u32, p.y as u32).unwrap();
        [r, g, b]
    };
    for p in person.left_hand.into_iter().flatten() {
        assert_eq!(at(p), [0, 0, 255], "points of a hand are blue");
    }
    // Bones 0, 4, 8, 12, 16 of twenty are the fingers' first: hues 0, 72, 144, 216, 288 degrees.
    let first = [[255, 0, 0], [204, 255, 0], [0, 255, 102], [0, 102, 255], [203, 0, 255]];
    for (finger, color) in first.into_iter().enumerate() {
        let found = at((wrist + joint(finger, 0)) * 0.5);
        let strongest = f32::from(*found.iter().max().unwrap()).max(1.0);
        // A thin line may cover a pixel in part.
        let full = found.map(|c| (f32::from(c) * 255.0 / strongest) as u8);
        assert!(strongest > 100.0, "finger {finger}: {found:?}");
        assert!(full.iter().zip(color).all(|(a, b)| a.abs_diff(b) <= 4), "finger {finger}: {found:?}");
    }
    assert_eq!(at(big), [0, 0, 255], "left toes and heel are blue");
    assert_eq!(at(heel), [0, 0, 255]);
    assert_eq!(at((ankle + big) * 0.5), [0, 0, 153], "and the lines to them darker");
    assert_eq!(at(ankle), [85, 0, 255], "the ankle has the body's colour");
}
