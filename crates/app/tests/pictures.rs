//! The sample poses, seen and measured: pictures against stored ones, and where hands, feet and head are.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p app --test pictures` writes both anew. The pictures have a clear background: they
//! hold the figure, and a fifth of the bytes that a dithered backdrop takes.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use app::load;
use app::picture::{Darkroom, Facts, Shot, Subject, Viewpoint, write_png};
use render::{Image, Look};
use rig::{Bone, View};

/// How far a channel may be off before a pixel counts as different: drivers round differently.
const TOLERANCE: u8 = 6;
/// How many pixels of a picture may differ.
const MOST_DIFFERENT: usize = 20;
/// Pictures are square.
const EDGE: u32 = 480;
/// What the numbers hold, metres.
const CLOSE_M: f64 = 1e-6;

const POSES: [&str; 8] =
    ["standing", "contrapposto", "thinker", "reaching-up", "running", "kneeling", "waving", "idea"];
const MEASURED: [Bone; 5] = [Bone::Head, Bone::LeftHand, Bone::RightHand, Bone::LeftFoot, Bone::RightFoot];

/// World positions in metres by bone, by pose.
type Places = BTreeMap<String, BTreeMap<String, [f64; 3]>>;

fn pose_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/poses/{name}.pose.ron"))
}

fn stored(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots/poses").join(name)
}

fn updating() -> bool {
    std::env::var_os("UPDATE_SNAPSHOTS").is_some_and(|v| v != "0")
}

fn places() -> Places {
    let figure = load::figure(None).unwrap();
    let of = |name: &str| {
        let editor = load::editor(&figure, &pose_file(name)).unwrap();
        let frames = &editor.evaluation().frames;
        MEASURED.map(|bone| (bone.name().to_owned(), frames[bone].position.to_array())).into()
    };
    POSES.map(|name| (name.to_owned(), of(name))).into()
}

/// A pixel as it looks on black, and its alpha: what is hardly there can hardly differ.
fn seen(pixel: &[u8]) -> [u8; 4] {
    let [r, g, b, a] = [0, 1, 2, 3].map(|i| u16::from(pixel[i]));
    [r * a / 255, g * a / 255, b * a / 255, a].map(|channel| channel as u8)
}

/// How many pixels are off by more than the tolerance; all of them if the sizes differ.
fn different(drawn: &Image, wanted: &image::RgbaImage) -> usize {
    if (drawn.width, drawn.height) != wanted.dimensions() {
        return drawn.rgba.len() / 4;
    }
    let off = |(a, b): (&[u8], &[u8])| seen(a).iter().zip(seen(b)).any(|(a, b)| a.abs_diff(b) > TOLERANCE);
    drawn.rgba.chunks_exact(4).zip(wanted.as_raw().chunks_exact(4)).filter(|pair| off(*pair)).count()
}

/// Draws a pose and says what is wrong with the picture; the drawn one is left in the temporary folder.
fn compare(darkroom: &mut Darkroom, name: &str, view: View) -> Result<(), String> {
    let figure = load::figure(None).unwrap();
    let editor = load::editor(&figure, &pose_file(name)).unwrap();
    let look = Look { transparent: true, ..Look::default() };
    let shot = Shot { look, ..Shot::new([EDGE, EDGE]) };
    let subject = Subject::of(&editor);
    let camera = Viewpoint::from(view).camera(subject.bounds(), shot.aspect());
    let drawn = darkroom.image(&subject, camera, &shot).map_err(|e| format!("{name}: {e}"))?;
    let file = format!("{name}-{view}.png");
    if updating() {
        return write_png(&drawn, &Facts::default(), &stored(&file)).map_err(|e| e.to_string());
    }
    let wanted = image::open(stored(&file)).map_err(|e| format!("{file}: {e}"))?.into_rgba8();
    let count = different(&drawn, &wanted);
    if count <= MOST_DIFFERENT {
        return Ok(());
    }
    let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join(&file);
    write_png(&drawn, &Facts::default(), &left).map_err(|e| e.to_string())?;
    Err(format!("{file}: {count} pixels differ, at most {MOST_DIFFERENT} may; drawn: {}", left.display()))
}

fn compare_all(view: View) {
    let mut darkroom = Darkroom::open().unwrap();
    let faults: Vec<String> =
        POSES.iter().filter_map(|name| compare(&mut darkroom, name, view).err()).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn poses_look_the_same_from_the_front() {
    compare_all(View::Front);
}

#[test]
fn poses_look_the_same_from_three_quarters() {
    compare_all(View::ThreeQuarter);
}

#[test]
fn hands_feet_and_head_are_where_they_were() {
    let now = places();
    let file = stored("places.json");
    if updating() {
        std::fs::write(&file, serde_json::to_string_pretty(&now).unwrap() + "\n").unwrap();
    }
    let wanted: Places = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(now.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>());
    for (pose, bones) in &wanted {
        for (bone, place) in bones {
            let found = now[pose][bone];
            let off = place.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= CLOSE_M, "{pose}: {bone} at {found:?}, expected {place:?}");
        }
    }
}

#[test]
fn contacts_of_the_sample_poses_are_met() {
    let figure = load::figure(None).unwrap();
    for name in POSES {
        let editor = load::editor(&figure, &pose_file(name)).unwrap();
        let report = edit::Report::of(&editor, "look", None);
        for (limb, state) in &report.limbs {
            let (off, turned) = (state.residual, state.rotation_residual);
            assert!(off < CLOSE_M && turned < 1e-3, "{name}: {limb} is off by {off} m and {turned} degrees");
        }
    }
}

#[test]
fn standing_is_even_and_on_the_ground() {
    let standing = &places()["standing"];
    for (left, right) in [("leftHand", "rightHand"), ("leftFoot", "rightFoot")] {
        let ([lx, ly, lz], [rx, ry, rz]) = (standing[left], standing[right]);
        let off = (lx + rx).abs() + (ly - ry).abs() + (lz - rz).abs();
        assert!(off < CLOSE_M, "{left} and {right} are no mirror images: {off} m");
    }
    let ankle_over_sole_m = 0.067;
    assert!((standing["leftFoot"][1] - ankle_over_sole_m).abs() < CLOSE_M);
}
