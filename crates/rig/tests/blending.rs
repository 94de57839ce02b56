//! Blending toward a pose: short of it, all of it and beyond, without a jump, inside the ranges, and always finite.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::path::Path;

use rig::{Articulation, Bone, Figure, Pose, PosePatch, apply_patch, parse_pose};

fn figure() -> Figure {
    interchange::figure::bare_mannequin().expect("the shipped figure loads")
}

/// The shipped poses by name.
fn shipped() -> Vec<(String, PosePatch)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/poses");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut poses: Vec<_> = files
        .filter(|file| file.to_string_lossy().ends_with(".pose.ron"))
        .map(|file| {
            let name = file.file_name().unwrap().to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&file).unwrap();
            (name, parse_pose(&text).unwrap())
        })
        .collect();
    poses.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(poses.len() >= 8);
    poses
}

fn blend(figure: &Figure, from: &Pose, patch: &PosePatch, amount: f64) -> Pose {
    apply_patch(figure, from, patch, &[], amount, true).unwrap().pose
}

/// The joint that turns most from one pose to the other, and by how many degrees.
fn farthest(figure: &Figure, a: &Pose, b: &Pose) -> (Bone, f64) {
    let turned = figure.skeleton.joints().map(|joint| {
        let turn = joint.rotation(a.angles(joint.bone)).conjugate() * joint.rotation(b.angles(joint.bone));
        (joint.bone, turn.to_scaled_axis().length().to_degrees().min(360.0))
    });
    turned.fold((Bone::Hips, 0.0), |most, each| if each.1 > most.1 { each } else { most })
}

/// From each pose to each other, in steps of a hundredth from −50 % to 150 %.
#[test]
fn a_blend_never_jumps_and_stays_in_range_beyond_its_ends() {
    let figure = figure();
    let poses = shipped();
    let mut worst = (0.0, String::new());
    for (first, from) in &poses {
        let from = from.onto(&figure.rest_pose());
        for (second, patch) in &poses {
            let mut before: Option<Pose> = None;
            for percent in -50..=150 {
                let pose = blend(&figure, &from, patch, f64::from(percent) / 100.0);
                let at = || format!("{first} to {second} at {percent} %");
                inside(&figure, &from, patch, &pose, &at);
                if let Some(before) = &before {
                    let (bone, turned) = farthest(&figure, before, &pose);
                    if turned > worst.0 {
                        worst = (turned, format!("{} {bone:?}", at()));
                    }
                }
                before = Some(pose);
            }
        }
    }
    // The longest way of a joint is half a turn, of which this is a hundredth, with room for what ranges bend.
    assert!(worst.0 < 4.0, "{} turns by {:.1}° in one step", worst.1, worst.0);
}

/// Ranges stretch to hold the pose that a blend starts from, and a blend's goal counts when it is reached.
fn inside(figure: &Figure, from: &Pose, patch: &PosePatch, pose: &Pose, at: &dyn Fn() -> String) {
    assert!(pose.hips.is_finite(), "{}", at());
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            let value = pose.angles(joint.bone).get(dof);
            assert!(value.is_finite(), "{}: {:?} {dof:?} {value}", at(), joint.bone);
            let Some(range) = joint.range(dof) else { continue };
            let held = range.reaching(from.angles(joint.bone).get(dof));
            // A cone may move what an interval holds by as much as it bends.
            let cone = matches!(&joint.articulation, Articulation::Ball { cone: Some(_), .. });
            let slack = if cone { 45.0 } else { 1e-6 };
            assert!(
                held.excess(value) <= slack || !patch.joints.contains_key(&joint.bone),
                "{}: {:?} {dof:?} {value} is outside {held:?}",
                at(),
                joint.bone
            );
        }
    }
}

#[test]
fn nothing_is_the_pose_itself_and_all_of_it_is_the_goal() {
    let figure = figure();
    for (name, patch) in shipped() {
        let rest = figure.rest_pose();
        assert!(farthest(&figure, &blend(&figure, &rest, &patch, 0.0), &rest).1 < 1e-6, "{name}");
        let goal = patch.onto(&rest);
        assert!(farthest(&figure, &blend(&figure, &rest, &patch, 1.0), &goal).1 < 1e-4, "{name}");
        // From both sides the blend comes to its goal.
        for near in [0.999, 1.001] {
            let turned = farthest(&figure, &blend(&figure, &rest, &patch, near), &goal);
            assert!(turned.1 < 0.4, "{name} at {near}: {turned:?}");
        }
    }
}

#[test]
fn an_amount_that_is_no_number_is_turned_down() {
    let figure = figure();
    let rest = figure.rest_pose();
    for amount in [f64::NAN, f64::INFINITY, 1e9] {
        assert!(apply_patch(&figure, &rest, &PosePatch::default(), &[], amount, true).is_err());
    }
}
