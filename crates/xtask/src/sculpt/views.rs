//! The sheets of pictures that `--preview` writes.

use std::path::Path;

use anyhow::Context;
use glam::DVec3;
use rig::{Bone, Mesh, Skeleton};

use super::posing::{FISTS, RELAXED, SEATED, posed};
use super::preview::{Model, Shot, draw, sheet};

const TILE: (u32, u32) = (560, 560);

fn model(mesh: &Mesh) -> Model {
    let triple = |v: &[f32; 3]| DVec3::from(v.map(f64::from));
    Model {
        points: mesh.positions.iter().map(triple).collect(),
        normals: mesh.normals.iter().map(triple).collect(),
        colors: mesh.colors.iter().map(triple).collect(),
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}

/// Yaw and pitch of each picture of a sheet.
type Angles<'a> = &'a [(f64, f64)];

const AROUND: Angles<'_> = &[(0.0, 0.0), (35.0, 0.0), (90.0, 0.0), (180.0, 0.0)];

/// Writes every sheet into a folder.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write(mesh: &Mesh, skeleton: &Skeleton, folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let at = |bone: Bone, x: f64, y: f64, z: f64| skeleton.rest_position(bone) + DVec3::new(x, y, z);
    let middle = at(Bone::Hips, 0.0, -0.07, 0.0);
    let rest = model(mesh);
    let relaxed = model(&posed(mesh, skeleton, RELAXED));
    let seated = model(&posed(mesh, skeleton, SEATED));
    let fists = posed(mesh, skeleton, FISTS);
    let mut fist_only = posed(mesh, skeleton, &FISTS[..15]);
    fist_only.colors.clone_from(&mesh.colors);
    let hand = at(Bone::LeftHand, 0.076, -0.013, 0.02);
    let face = at(Bone::Head, 0.0, 0.035, 0.02);
    let sheets: [(&str, &Model, DVec3, f64, Angles<'_>); 13] = [
        ("body", &rest, middle, 1.86, AROUND),
        ("face", &rest, face, 0.30, &[(0.0, 0.0), (35.0, 0.0), (90.0, 0.0), (150.0, 10.0)]),
        ("hand", &rest, hand, 0.24, &[(0.0, 89.0), (0.0, -89.0), (0.0, 10.0), (60.0, 30.0)]),
        (
            "foot",
            &rest,
            at(Bone::LeftFoot, 0.0, 0.01, 0.06),
            0.32,
            &[(0.0, 20.0), (90.0, 0.0), (-90.0, 0.0), (30.0, 60.0)],
        ),
        ("relaxed", &relaxed, middle, 1.86, AROUND),
        (
            "shoulders",
            &relaxed,
            at(Bone::UpperChest, 0.0, -0.01, 0.0),
            0.62,
            &[(0.0, 0.0), (45.0, 10.0), (90.0, 0.0), (180.0, 0.0)],
        ),
        ("seated", &seated, middle, 1.4, &[(0.0, 0.0), (40.0, 15.0), (90.0, 0.0), (150.0, 10.0)]),
        ("fists", &model(&fists), middle, 2.3, AROUND),
        ("fist", &model(&fist_only), hand, 0.24, &[(0.0, 89.0), (0.0, -89.0), (0.0, 10.0), (90.0, 10.0)]),
        (
            "seat",
            &seated,
            at(Bone::Hips, 0.0, -0.10, 0.05),
            0.5,
            &[(0.0, 0.0), (0.0, -50.0), (90.0, 0.0), (180.0, -20.0)],
        ),
        (
            "elbow",
            &seated,
            at(Bone::LeftUpperArm, 0.05, -0.2, 0.1),
            0.5,
            &[(0.0, 0.0), (60.0, 10.0), (90.0, 0.0), (150.0, 10.0)],
        ),
        (
            "features",
            &rest,
            at(Bone::LeftEye, -0.02, -0.03, 0.02),
            0.13,
            &[(0.0, 0.0), (30.0, 0.0), (60.0, 10.0), (0.0, -35.0)],
        ),
        (
            "jaw",
            &model(&posed(mesh, skeleton, &FISTS[17..])),
            face,
            0.34,
            &[(0.0, 0.0), (35.0, 0.0), (90.0, 0.0), (150.0, 10.0)],
        ),
    ];
    for (name, model, center, height, angles) in sheets {
        let shot = |&(yaw, pitch): &(f64, f64)| Shot { yaw, pitch, center, height, size: TILE };
        let pictures: Vec<_> = angles.iter().map(|a| draw(model, &shot(a), false)).collect();
        save(&sheet(&pictures, 2), folder, name)?;
    }
    let wires = [(middle, 1.86), (face, 0.30), (hand, 0.24), (at(Bone::LeftUpperArm, 0.0, -0.05, 0.0), 0.4)];
    let shot = |(center, height)| Shot { yaw: 30.0, pitch: 20.0, center, height, size: TILE };
    save(&sheet(&wires.map(|w| draw(&rest, &shot(w), true)), 2), folder, "wires")
}

fn save(picture: &image::RgbImage, folder: &Path, name: &str) -> anyhow::Result<()> {
    let path = folder.join(format!("{name}.png"));
    picture.save(&path).with_context(|| format!("cannot write {}", path.display()))
}
