//! The sheets of pictures that `--preview` writes.

use std::path::Path;

use anyhow::{Context, bail};
use glam::DVec3;
use rig::{Bone, Mesh, Skeleton};

use super::physique::Physique;
use super::posing::{FIST, FISTS, JAW, RELAXED, REST, SEATED, Stance, posed};
use super::preview::{Light, Model, Shot, draw, tiled};
use super::shape::Bounds;
use super::{assemble, body, extremes};

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
const EIGHT: Angles<'_> = &[
    (0.0, 0.0),
    (40.0, 0.0),
    (90.0, 0.0),
    (140.0, 5.0),
    (180.0, 0.0),
    (0.0, 50.0),
    (0.0, -40.0),
    (60.0, 25.0),
];

/// One sheet: its file's name, the stance, the middle and height of its pictures, and from where they look.
struct Sheet {
    name: &'static str,
    stance: &'static Stance,
    center: DVec3,
    height: f64,
    angles: Angles<'static>,
    light: Light,
}

/// What is sculpted and drawn: everything, or the box around one part.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Only {
    Everything,
    Head,
    Hand,
    Foot,
    Torso,
    Arm,
    Leg,
}

impl Only {
    fn named(name: &str) -> anyhow::Result<Only> {
        Ok(match name {
            "head" => Only::Head,
            "hand" => Only::Hand,
            "foot" => Only::Foot,
            "torso" => Only::Torso,
            "arm" => Only::Arm,
            "leg" => Only::Leg,
            _ => bail!("--only takes head, hand, foot, torso, arm or leg, not `{name}`"),
        })
    }

    fn bounds(self, skeleton: &Skeleton) -> Option<Bounds> {
        let at = |bone: Bone| skeleton.rest_position(bone);
        let wide = |low: DVec3, high: DVec3| Some(Bounds { low: low - 0.14, high: high + 0.14 });
        let (neck, hips) = (at(Bone::Neck), at(Bone::Hips));
        match self {
            Only::Everything => None,
            Only::Head => wide(neck + DVec3::Y * 0.08, neck + DVec3::Y * 0.3),
            Only::Hand => {
                let wrist = at(Bone::LeftHand);
                wide(wrist + DVec3::X * 0.09, wrist + DVec3::X * 0.3)
            }
            Only::Foot => wide(DVec3::ZERO, at(Bone::LeftFoot) + DVec3::new(0.0, -0.06, 0.1)),
            Only::Torso => wide(hips - DVec3::Y * 0.1, at(Bone::LeftUpperArm) + DVec3::Y * 0.1),
            Only::Arm => wide(at(Bone::LeftUpperArm) - DVec3::X * 0.02, at(Bone::LeftHand)),
            Only::Leg => wide(at(Bone::LeftFoot), at(Bone::LeftUpperLeg) + DVec3::Y * 0.02),
        }
    }
}

/// Draws previews: `DIR [--only head|hand|foot|torso|arm|leg] [--physique sex=1,age=-0.5,…] [--handshape NAME]`. With
/// `--only`, nothing else than that part is sculpted, which takes a few seconds. A handshape of the shipped figure
/// takes the place of the preview's fist.
///
/// # Errors
/// Unknown options or handshapes; the folder or a file cannot be written.
pub fn run(order: &[String], skeleton: &Skeleton) -> anyhow::Result<()> {
    let Some((folder, mut rest)) = order.split_first() else { bail!("--preview needs a folder") };
    let (mut only, mut physique) = (Only::Everything, Physique::NEUTRAL);
    let mut fist = FIST.to_vec();
    while let [flag, value, more @ ..] = rest {
        match flag.as_str() {
            "--only" => only = Only::named(value)?,
            "--physique" => physique = parsed(value)?,
            "--handshape" => fist = handshape(value)?,
            _ => bail!("--preview doesn't know `{flag}`"),
        }
        rest = more;
    }
    if let [left] = rest {
        bail!("`{left}` needs a value");
    }
    let field = body::field(skeleton, &physique);
    let size = |p: DVec3, bend: f64| body::edge_length(skeleton, p, bend);
    let mut mesh = assemble::mesh(&field, skeleton, only.bounds(skeleton).as_ref(), size)?;
    rig::spread_twist(&mut mesh, skeleton);
    println!("{} vertices, {} triangles", mesh.vertex_count(), mesh.indices.len() / 3);
    write(&mesh, skeleton, Path::new(folder), only, &fist)?;
    if only == Only::Everything { extremes::write(&mesh, skeleton, Path::new(folder), "") } else { Ok(()) }
}

/// The angles of a handshape of the shipped figure.
fn handshape(name: &str) -> anyhow::Result<Vec<(Bone, [f64; 3])>> {
    let figure = interchange::figure::bare_mannequin().context("the shipped figure is damaged")?;
    let shape = figure.handshapes.get(name).with_context(|| format!("there is no handshape `{name}`"))?;
    Ok(shape.iter().map(|(bone, a)| (*bone, [a.flexion, a.abduction, a.twist])).collect())
}

/// A physique from `name=number` pairs with commas between.
fn parsed(text: &str) -> anyhow::Result<Physique> {
    let mut physique = Physique::NEUTRAL;
    for pair in text.split(',') {
        let (name, number) = pair.split_once('=').with_context(|| format!("`{pair}` is no name=number"))?;
        let number: f64 = number.parse().with_context(|| format!("`{number}` is no number"))?;
        match name {
            "sex" => physique.sex = number,
            "build" => physique.build = number,
            "muscle" => physique.muscle = number,
            "age" => physique.age = number,
            _ => bail!("a physique has sex, build, muscle and age, not `{name}`"),
        }
    }
    Ok(physique)
}

fn write(mesh: &Mesh, skeleton: &Skeleton, folder: &Path, only: Only, fist: &Stance) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for sheet in sheets(skeleton, only) {
        let stance = if sheet.name == "fist" { fist } else { sheet.stance };
        let model = if stance.is_empty() { model(mesh) } else { model(&posed(mesh, skeleton, stance)) };
        let Sheet { center, height, light, .. } = sheet;
        let shot = |&(yaw, pitch): &(f64, f64)| Shot { yaw, pitch, center, height, size: TILE, light };
        let pictures: Vec<_> = sheet.angles.iter().map(|a| draw(&model, &shot(a), false)).collect();
        save(&tiled(&pictures, if pictures.len() > 4 { 4 } else { 2 }), folder, sheet.name)?;
    }
    if only != Only::Everything {
        return Ok(());
    }
    let [middle, face, hand, shoulder] = centers(skeleton);
    let wires = [(middle, 1.86), (face, 0.30), (hand, 0.24), (shoulder, 0.4)];
    let shot =
        |(center, height)| Shot { yaw: 30.0, pitch: 20.0, center, height, size: TILE, light: Light::Studio };
    save(&tiled(&wires.map(|w| draw(&model(mesh), &shot(w), true)), 2), folder, "wires")
}

/// Middle of the body, the face, the hand and below the shoulder.
fn centers(skeleton: &Skeleton) -> [DVec3; 4] {
    let at = |bone: Bone, x: f64, y: f64, z: f64| skeleton.rest_position(bone) + DVec3::new(x, y, z);
    [
        at(Bone::Hips, 0.0, -0.07, 0.0),
        at(Bone::Head, 0.0, 0.035, 0.02),
        at(Bone::LeftHand, 0.080, -0.013, 0.022),
        at(Bone::LeftUpperArm, 0.0, -0.05, 0.0),
    ]
}

fn sheets(skeleton: &Skeleton, only: Only) -> Vec<Sheet> {
    let at = |bone: Bone, x: f64, y: f64, z: f64| skeleton.rest_position(bone) + DVec3::new(x, y, z);
    let [middle, face, hand, _] = centers(skeleton);
    let foot = at(Bone::LeftFoot, 0.0, 0.01, 0.06);
    let trunk = at(Bone::Hips, 0.0, 0.24, 0.0);
    let features = at(Bone::LeftEye, -0.02, -0.03, 0.02);
    let ear = at(Bone::LeftEye, 0.04, -0.02, -0.09);
    let arm = at(Bone::LeftLowerArm, 0.0, 0.0, 0.0);
    let leg = at(Bone::LeftLowerLeg, 0.0, 0.05, 0.0);
    let close: Angles<'_> = &[(0.0, 0.0), (30.0, 0.0), (60.0, 10.0), (0.0, -35.0)];
    let lateral: Angles<'_> = &[(90.0, 0.0), (50.0, 10.0), (135.0, 0.0), (0.0, 0.0)];
    let palm: Angles<'_> = &[
        (0.0, 89.0),
        (0.0, -89.0),
        (0.0, 10.0),
        (60.0, 30.0),
        (150.0, 25.0),
        (90.0, 0.0),
        (30.0, -40.0),
        (180.0, -5.0),
    ];
    let sole: Angles<'_> = &[
        (0.0, 20.0),
        (90.0, 0.0),
        (-90.0, 0.0),
        (30.0, 60.0),
        (180.0, 0.0),
        (0.0, 89.0),
        (0.0, -89.0),
        (45.0, 15.0),
    ];
    let new = |name, stance, center, height, angles| Sheet {
        name,
        stance,
        center,
        height,
        angles,
        light: Light::Studio,
    };
    let part = match only {
        Only::Everything => Vec::new(),
        Only::Head => vec![
            new("head", REST, face, 0.32, EIGHT),
            new("features", REST, features, 0.13, close),
            new("ear", REST, ear, 0.10, lateral),
        ],
        Only::Hand => {
            vec![new("hand", REST, hand, 0.20, palm), new("fist", FIST, hand, 0.20, palm)]
        }
        Only::Foot => vec![new("foot", REST, foot, 0.32, sole)],
        Only::Torso => {
            vec![new("torso", REST, trunk, 0.80, EIGHT), new("shoulders", RELAXED, trunk, 0.80, EIGHT)]
        }
        Only::Arm => vec![new("arm", REST, arm, 0.70, EIGHT)],
        Only::Leg => vec![new("leg", REST, leg, 1.05, EIGHT)],
    };
    if only != Only::Everything {
        let raking = part.iter().filter(|s| s.stance.is_empty()).map(|s| Sheet {
            name: raked(s.name),
            light: Light::Raking,
            ..*s
        });
        let raking: Vec<Sheet> = raking.collect();
        return part.into_iter().chain(raking).collect();
    }
    let seat = at(Bone::Hips, 0.0, -0.10, 0.05);
    let elbow = at(Bone::LeftUpperArm, 0.05, -0.2, 0.1);
    vec![
        new("body", REST, middle, 1.86, AROUND),
        new("head", REST, face, 0.32, EIGHT),
        new("features", REST, features, 0.13, close),
        new("hand", REST, hand, 0.20, palm),
        new("foot", REST, foot, 0.32, sole),
        new("relaxed", RELAXED, middle, 1.86, AROUND),
        new(
            "shoulders",
            RELAXED,
            at(Bone::UpperChest, 0.0, -0.01, 0.0),
            0.62,
            &[(0.0, 0.0), (45.0, 10.0), (90.0, 0.0), (180.0, 0.0)],
        ),
        new("seated", SEATED, middle, 1.4, &[(0.0, 0.0), (40.0, 15.0), (90.0, 0.0), (150.0, 10.0)]),
        new("fists", FISTS, middle, 2.3, AROUND),
        new("fist", FIST, hand, 0.20, palm),
        new("seat", SEATED, seat, 0.5, &[(0.0, 0.0), (0.0, -50.0), (90.0, 0.0), (180.0, -20.0)]),
        new("elbow", SEATED, elbow, 0.5, &[(0.0, 0.0), (60.0, 10.0), (90.0, 0.0), (150.0, 10.0)]),
        new("jaw", JAW, face, 0.34, &[(0.0, 0.0), (35.0, 0.0), (90.0, 0.0), (150.0, 10.0)]),
    ]
}

/// The name of a sheet under raking light.
fn raked(name: &'static str) -> &'static str {
    match name {
        "head" => "head-raking",
        "features" => "features-raking",
        "ear" => "ear-raking",
        "hand" => "hand-raking",
        "foot" => "foot-raking",
        "torso" => "torso-raking",
        "arm" => "arm-raking",
        _ => "leg-raking",
    }
}

fn save(picture: &image::RgbImage, folder: &Path, name: &str) -> anyhow::Result<()> {
    let path = folder.join(format!("{name}.png"));
    picture.save(&path).with_context(|| format!("cannot write {}", path.display()))
}
