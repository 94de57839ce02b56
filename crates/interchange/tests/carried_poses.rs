//! Every shipped pose on every shipped body: soles where they were over the ground, contacts held, ranges kept.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::path::Path;

use glam::DVec3;
use interchange::figure;
use rig::{Articulation, Bone, Contact, Figure, Limb, Pose, Space, evaluate, parse_pose, read_pose};

fn figure_of(name: &str) -> Figure {
    let text = std::str::from_utf8(figure::shipped(name).unwrap()).unwrap();
    let mut library = |file: &str| figure::shipped(file).map(<[u8]>::to_vec).ok_or_else(|| file.to_owned());
    figure::load(text, &mut library).unwrap_or_else(|e| panic!("{name}: {e}")).0
}

fn poses() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/poses");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut poses: Vec<(String, String)> = files
        .filter(|path| path.to_string_lossy().ends_with(".pose.ron"))
        .map(|path| {
            (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(path).unwrap())
        })
        .collect();
    poses.sort();
    poses
}

/// The lowest of a leg's named points, metres over the ground.
fn sole(figure: &Figure, pose: &Pose, limb: Limb) -> f64 {
    let frames = rig::frames(figure, pose);
    let points = figure.articulators[limb.index()].values();
    points.map(|a| frames[a.bone].point(a.at).y).fold(f64::MAX, f64::min)
}

/// How far a joint is out of its range, degrees.
fn excess(figure: &Figure, pose: &Pose, bone: Bone) -> f64 {
    let joint = figure.skeleton.joint(bone).unwrap();
    let angles = pose.angles(bone);
    let by_range = joint.dofs().filter_map(|dof| joint.range(dof).map(|r| r.excess(angles.get(dof))));
    let most = by_range.fold(0.0, f64::max);
    let Articulation::Ball { cone: Some(cone), .. } = &joint.articulation else { return most };
    let points = joint.rotation(angles) * joint.bone_direction().unwrap_or(DVec3::Y);
    most.max((cone.angle(points) - cone.half_angle).max(0.0).to_degrees())
}

#[test]
fn shipped_poses_fit_every_shipped_body() {
    let mannequin = figure_of("mannequin.figure.ron");
    let mut faults = Vec::new();
    for name in figure::shipped_figures().filter(|name| !name.starts_with("mannequin")) {
        let body = figure_of(name);
        let height = |figure: &Figure| figure.skeleton.rest_position(Bone::Hips).y;
        let ratio = height(&body) / height(&mannequin);
        for (file, text) in poses() {
            let was = parse_pose(&text).unwrap().onto(&mannequin.rest_pose());
            let is = read_pose(&body, &text).unwrap().onto(&body.rest_pose());
            let (before, after) = (evaluate(&mannequin, &was, true), evaluate(&body, &is, true));
            for limb in Limb::ALL {
                if !limb.is_arm() {
                    let (old, new) = (ratio * sole(&mannequin, &was, limb), sole(&body, &is, limb));
                    // In the air a twentieth of the height more.
                    if (new - old).abs() > 0.01 + 0.05 * old.max(0.0) {
                        faults.push(format!("{name} {file} {}: sole at {new:.4}, was {old:.4}", limb.name()));
                    }
                }
                let (old, new) = (before.limbs[limb.index()].residual, after.limbs[limb.index()].residual);
                if new - old > 0.02 {
                    let on = is.limb(limb).contact.target().map(|t| t.0);
                    faults.push(format!("{name} {file} {}: {:.1} mm off {on:?}", limb.name(), new * 1e3));
                }
                let holds = |pose: &Pose| std::mem::discriminant(&pose.limb(limb).contact);
                assert_eq!(holds(&was), holds(&is));
                if let Contact::Planted { space: Space::World, rotation, .. } = was.limb(limb).contact {
                    assert!(
                        matches!(is.limb(limb).contact, Contact::Planted { rotation: r, .. } if r == rotation)
                    );
                }
            }
            for joint in body.skeleton.joints() {
                let (old, new) = (excess(&mannequin, &was, joint.bone), excess(&body, &is, joint.bone));
                if new > old + 1e-6 {
                    faults.push(format!("{name} {file} {}: {new:.2} degrees out of range", joint.bone));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
