//! The poses that come with the program, each by itself: within the joints' ranges, its contacts met, on the ground and
//! not in it, standing where it stands. That index, folder and program name the same poses is held where they are read.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::path::{Path, PathBuf};

use app::load;
use edit::{Editor, Report};
use rig::{Articulation, Bone, Contact, Dof, Joint, Limb, Palette, Space, skin_positions, support};
use serde::Deserialize;

/// How far a contact may be missed.
const MET_M: f64 = 1e-3;
/// The same for the rotation that a planted hand or foot keeps.
const MET_DEGREES: f64 = 0.1;
/// What rounding may put a joint outside its range.
const SLACK_DEGREES: f64 = 1e-6;
/// How deep the skin may be in the ground: flesh gives way where a body rests on it.
const DEEPEST_M: f32 = -0.008;
/// How far above the ground the lowest skin may be in a pose that rests on it.
const HIGHEST_M: f32 = 0.005;
/// How far a sole that bears may be from the ground.
const SOLE_M: f64 = 0.003;

/// Poses in the air, or on holds above the ground: the lowest that their skin may be.
const OFF_THE_GROUND: [(&str, f32); 2] = [("jumping", 0.2), ("climbing", 0.2)];
/// Standing poses that something else holds up too.
const HELD_UP: [&str; 1] = ["leaning"];

/// What the name of a pose file ends with.
const SUFFIX: &str = ".pose.ron";

#[derive(Deserialize)]
struct Index {
    #[allow(dead_code)] // the library's reader checks it
    version: u32,
    poses: Vec<Titled>,
}

#[derive(Deserialize)]
struct Titled {
    file: String,
    #[allow(dead_code)] // the same
    title: String,
    tags: Vec<String>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/poses")
}

fn index() -> Index {
    rig::from_ron(&std::fs::read_to_string(folder().join("index.ron")).unwrap()).unwrap()
}

/// Every pose of the index by its file's name without the ending, on the mannequin; those with a tag if one is given.
fn poses(tag: Option<&str>) -> Vec<(String, Editor)> {
    let figure = load::figure(None).unwrap();
    let asked = index().poses.into_iter().filter(|p| tag.is_none_or(|t| p.tags.iter().any(|own| own == t)));
    let open = |file: String| {
        let editor = load::editor(&figure, &folder().join(&file)).unwrap();
        (file.strip_suffix(SUFFIX).unwrap().to_owned(), editor)
    };
    asked.map(|pose| open(pose.file)).collect()
}

/// What is wrong with the poses, one a line; nothing if all are well.
fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Where a joint is outside its range, in words.
fn outside(joint: &Joint, editor: &Editor) -> Vec<String> {
    let angles = editor.pose().angles(joint.bone);
    let mut faults = Vec::new();
    let mut free = &[][..];
    if let (Articulation::Ball { cone: Some(cone), .. }, Some(bone)) =
        (&joint.articulation, joint.bone_direction())
    {
        free = &[Dof::Flexion, Dof::Abduction];
        let over = (cone.angle(joint.rotation(angles) * bone) - cone.half_angle).to_degrees();
        if over > SLACK_DEGREES {
            faults.push(format!("{} is {over} degrees outside its cone", joint.bone.name()));
        }
    }
    for dof in joint.dofs().filter(|dof| !free.contains(dof)) {
        let over = joint.range(dof).unwrap().excess(angles.get(dof));
        if over > SLACK_DEGREES {
            faults.push(format!(
                "{} is {over} degrees outside its range of {}",
                joint.bone.name(),
                dof.name()
            ));
        }
    }
    faults
}

#[test]
fn there_are_poses_enough_of_every_kind() {
    assert!(poses(None).len() >= 34);
    for (tag, least) in
        [("everyday", 12), ("expressive", 8), ("seated", 4), ("lying", 3), ("action", 7), ("signing", 4)]
    {
        let found = poses(Some(tag)).len();
        assert!(found >= least, "{found} poses are tagged {tag}");
    }
}

#[test]
fn joints_are_within_their_ranges() {
    let faults = poses(None).into_iter().flat_map(|(name, editor)| {
        let of = |joint: &Joint| outside(joint, &editor);
        let all: Vec<String> = editor.figure().skeleton.joints().flat_map(of).collect();
        all.into_iter().map(move |fault| format!("{name}: {fault}"))
    });
    assert_none(&faults.collect::<Vec<_>>());
}

#[test]
fn contacts_are_met() {
    let mut faults = Vec::new();
    for (name, editor) in poses(None) {
        for (limb, state) in &Report::of(&editor, "look", None).limbs {
            let (off, turned) = (state.residual, state.rotation_residual);
            if off > MET_M || turned > MET_DEGREES {
                faults.push(format!("{name}: {limb} is off by {off} m and {turned} degrees"));
            }
        }
    }
    assert_none(&faults);
}

#[test]
fn the_skin_is_on_the_ground_and_not_in_it() {
    let mut faults = Vec::new();
    for (name, editor) in poses(None) {
        let figure = editor.figure();
        let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
        let palette = Palette::new(&editor.evaluation().frames, &rest);
        let skin = skin_positions(figure.skin.as_ref().unwrap(), &palette);
        let lowest = skin.into_iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        let off = OFF_THE_GROUND.iter().find(|(pose, _)| *pose == name);
        let well = match off {
            Some((_, least)) => lowest >= *least,
            None => (DEEPEST_M..=HIGHEST_M).contains(&lowest),
        };
        if !well {
            faults.push(format!("{name}: the lowest skin is at {lowest} m"));
        }
    }
    assert_none(&faults);
}

/// How far the lowest of heel, ball and toe tip of a foot is from the ground.
fn sole(editor: &Editor, leg: Limb) -> f64 {
    let named = |name: &str| editor.figure().articulators[leg.index()][name];
    let height = |name| editor.evaluation().frames[named(name).bone].point(named(name).at).y;
    ["heel", "ball", "toeTip"].map(height).into_iter().fold(f64::INFINITY, f64::min).abs()
}

#[test]
fn soles_that_hold_on_to_the_ground_are_on_it() {
    let mut faults = Vec::new();
    for (name, editor) in poses(None).into_iter().filter(|(n, _)| OFF_THE_GROUND.iter().all(|(o, _)| o != n))
    {
        for leg in [Limb::LeftLeg, Limb::RightLeg] {
            let Contact::Planted { space: Space::World, target, .. } = editor.pose().limb(leg).contact else {
                continue;
            };
            // A foot up on a wall is planted, too.
            if target.y < 0.2 && sole(&editor, leg) > SOLE_M {
                faults.push(format!(
                    "{name}: the sole of {} is {} m off the ground",
                    leg.name(),
                    sole(&editor, leg)
                ));
            }
        }
    }
    assert_none(&faults);
}

#[test]
fn standing_poses_stand() {
    let mut faults = Vec::new();
    for (name, editor) in poses(Some("standing")).into_iter().filter(|(n, _)| !HELD_UP.contains(&n.as_str()))
    {
        let evaluation = editor.evaluation();
        let stands = support(editor.figure(), &evaluation.frames, evaluation.center_of_mass);
        let margin = stands.map_or(f64::NEG_INFINITY, |s| s.margin_m);
        if margin < 0.0 {
            faults.push(format!("{name}: the centre of mass is {margin} m inside what it stands on"));
        }
    }
    assert_none(&faults);
}

#[test]
fn who_stands_can_crouch_and_only_heels_come_up() {
    let figure = load::figure(None).unwrap();
    for down in [0.05, 0.15, 0.25, 0.35] {
        let mut editor = Editor::in_pose(figure.clone(), load::standing(&figure));
        let crouch = edit::Command::MoveHips { by: glam::DVec3::new(0.0, -down, 0.0) };
        editor.submit(edit::Request::Do(crouch), &mut edit::NoFiles).unwrap();
        let soles = motion::Soles::of(&figure).unwrap();
        for sole in soles.feet {
            let heights = sole.points(&editor.evaluation().frames).map(|p| p.y);
            assert!(heights[motion::Sole::BALL].abs() < 0.01, "{down} m: {heights:?}");
        }
    }
}
