//! Contact sheets of joints at the ends of their ranges, close up: where a skin shows first that its weights are wrong.

use std::path::Path;

use anyhow::Context;
use glam::{DVec3, Vec3};
use rig::{Angles, Bone, Mesh, Skeleton, skin_normals, skin_positions};

use super::preview::{Light, Model, Shot, draw, tiled};
use super::stances::{palette, relaxed};

/// Bones with flexion, abduction and twist in degrees.
type Turns = &'static [(Bone, [f64; 3])];

/// One sheet: a row of views for each of its stances, about a point that goes along with a bone.
struct Sheet {
    name: &'static str,
    /// Whether arms hang at first.
    hanging: bool,
    focus: Bone,
    /// From that bone's joint at rest, metres.
    off: [f64; 3],
    height: f64,
    stances: &'static [Turns],
    views: [(f64, f64); 8],
}

const TILE: u32 = 260;
/// Yaw and pitch of the eight views: all around, from above and from below in turn.
const ROUND: [(f64, f64); 8] = [
    (0.0, 0.0),
    (45.0, 20.0),
    (90.0, 0.0),
    (135.0, -25.0),
    (180.0, 0.0),
    (-135.0, 25.0),
    (-90.0, -10.0),
    (-45.0, -35.0),
];
/// The same about an arm that is stretched out aside.
const ROLL: [(f64, f64); 8] = [
    (0.0, 0.0),
    (30.0, 30.0),
    (0.0, 89.0),
    (150.0, 30.0),
    (180.0, 0.0),
    (150.0, -30.0),
    (0.0, -89.0),
    (30.0, -30.0),
];

/// Writes the sheets whose names begin with `only` into a folder.
///
/// # Errors
/// A file cannot be written.
pub fn write(mesh: &Mesh, skeleton: &Skeleton, folder: &Path, only: &str) -> anyhow::Result<()> {
    for sheet in SHEETS.iter().filter(|s| s.name.starts_with(only)) {
        let mut pictures = Vec::new();
        for turns in sheet.stances {
            let mut angles = if sheet.hanging { relaxed() } else { [Angles::REST; Bone::COUNT] };
            for &(bone, [flexion, abduction, twist]) in *turns {
                for bone in [bone, bone.mirrored()] {
                    angles[bone.index()] = Angles { flexion, abduction, twist };
                }
            }
            let palette = palette(skeleton, &angles);
            let at = (skeleton.rest_position(sheet.focus) + DVec3::from(sheet.off)).as_vec3();
            let center = palette.point(sheet.focus, at).as_dvec3();
            let model = posed(mesh, &palette);
            pictures.extend(sheet.views.map(|(yaw, pitch)| {
                let (height, size, light) = (sheet.height, (TILE, TILE), Light::Studio);
                draw(&model, &Shot { yaw, pitch, center, height, size, light }, false)
            }));
        }
        let path = folder.join(format!("extremes-{}.png", sheet.name));
        tiled(&pictures, sheet.views.len() as u32)
            .save(&path)
            .with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

fn posed(mesh: &Mesh, palette: &rig::Palette) -> Model {
    let wide = |all: Vec<Vec3>| all.iter().map(|v| v.as_dvec3()).collect();
    Model {
        points: wide(skin_positions(mesh, palette)),
        normals: wide(skin_normals(mesh, palette)),
        colors: mesh.colors.iter().map(|c| DVec3::from(c.map(f64::from))).collect(),
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}

use Bone::{
    Chest, Head, Jaw, LeftEye, LeftFoot, LeftHand, LeftIndexDistal, LeftIndexIntermediate, LeftIndexProximal,
    LeftLittleDistal, LeftLittleIntermediate, LeftLittleProximal, LeftLowerArm, LeftLowerLeg,
    LeftMiddleDistal, LeftMiddleIntermediate, LeftMiddleProximal, LeftRingDistal, LeftRingIntermediate,
    LeftRingProximal, LeftShoulder, LeftThumbDistal, LeftThumbMetacarpal, LeftThumbProximal, LeftToes,
    LeftUpperArm, LeftUpperLeg, Neck, Spine, UpperChest,
};

const FIST: Turns = &[
    (LeftThumbMetacarpal, [6.0, 31.0, 0.0]),
    (LeftThumbProximal, [52.0, 0.0, 0.0]),
    (LeftThumbDistal, [60.0, 0.0, 0.0]),
    (LeftIndexProximal, [88.0, 0.0, 0.0]),
    (LeftIndexIntermediate, [100.0, 0.0, 0.0]),
    (LeftIndexDistal, [65.0, 0.0, 0.0]),
    (LeftMiddleProximal, [88.0, 0.0, 0.0]),
    (LeftMiddleIntermediate, [100.0, 0.0, 0.0]),
    (LeftMiddleDistal, [65.0, 0.0, 0.0]),
    (LeftRingProximal, [88.0, 0.0, 0.0]),
    (LeftRingIntermediate, [100.0, 0.0, 0.0]),
    (LeftRingDistal, [65.0, 0.0, 0.0]),
    (LeftLittleProximal, [88.0, 0.0, 0.0]),
    (LeftLittleIntermediate, [100.0, 0.0, 0.0]),
    (LeftLittleDistal, [65.0, 0.0, 0.0]),
];

const SHEETS: &[Sheet] = &[
    Sheet {
        name: "shoulder",
        hanging: true,
        focus: LeftShoulder,
        off: [0.10, -0.05, -0.02],
        height: 0.62,
        stances: &[
            &[],
            &[(LeftUpperArm, [0.0, -60.0, 0.0])],
            &[(LeftUpperArm, [90.0, 0.0, 0.0])],
            &[(LeftUpperArm, [125.0, -20.0, 0.0])],
            &[(LeftUpperArm, [0.0, 75.0, 0.0]), (LeftShoulder, [0.0, 25.0, 20.0])],
            &[(LeftUpperArm, [60.0, 90.0, 0.0]), (LeftShoulder, [5.0, 30.0, 20.0])],
            &[(LeftUpperArm, [-60.0, -60.0, 0.0])],
            &[(LeftUpperArm, [4.0, -82.0, 90.0])],
            &[(LeftUpperArm, [4.0, -82.0, -90.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "collar",
        hanging: true,
        focus: UpperChest,
        off: [0.0, 0.08, 0.0],
        height: 0.62,
        stances: &[
            &[(LeftShoulder, [0.0, 45.0, 0.0])],
            &[(LeftShoulder, [0.0, -8.0, 0.0])],
            &[(LeftShoulder, [25.0, 0.0, 0.0])],
            &[(LeftShoulder, [-15.0, 0.0, 0.0])],
            &[(LeftShoulder, [0.0, 45.0, 45.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "elbow",
        hanging: false,
        focus: LeftLowerArm,
        off: [0.0, 0.0, 0.02],
        height: 0.34,
        stances: &[
            &[(LeftLowerArm, [90.0, 0.0, 0.0])],
            &[(LeftLowerArm, [130.0, 0.0, -80.0])],
            &[(LeftLowerArm, [150.0, 0.0, 0.0])],
            &[(LeftLowerArm, [0.0, 0.0, -160.0])],
        ],
        views: ROLL,
    },
    Sheet {
        name: "wrist",
        hanging: false,
        focus: LeftHand,
        off: [0.02, 0.0, 0.0],
        height: 0.24,
        stances: &[
            &[(LeftHand, [80.0, 0.0, 0.0])],
            &[(LeftHand, [-70.0, 0.0, 0.0])],
            &[(LeftHand, [0.0, -30.0, 0.0])],
            &[(LeftHand, [0.0, 20.0, 0.0])],
            &[(LeftHand, [80.0, 20.0, 0.0]), (LeftLowerArm, [0.0, 0.0, -160.0])],
        ],
        views: ROLL,
    },
    Sheet {
        name: "fingers",
        hanging: false,
        focus: LeftHand,
        off: [0.075, -0.02, 0.01],
        height: 0.20,
        stances: &[
            FIST,
            &[
                (LeftIndexProximal, [90.0, 0.0, 0.0]),
                (LeftMiddleProximal, [90.0, 0.0, 0.0]),
                (LeftRingProximal, [90.0, 0.0, 0.0]),
                (LeftLittleProximal, [90.0, 0.0, 0.0]),
            ],
            &[
                (LeftIndexProximal, [-35.0, 20.0, 0.0]),
                (LeftMiddleProximal, [-35.0, 0.0, 0.0]),
                (LeftRingProximal, [-35.0, 20.0, 0.0]),
                (LeftLittleProximal, [-35.0, 20.0, 0.0]),
            ],
            &[(LeftThumbMetacarpal, [50.0, 0.0, 0.0])],
            &[(LeftThumbMetacarpal, [-25.0, -30.0, 0.0])],
            &[
                (LeftThumbMetacarpal, [20.0, 45.0, 0.0]),
                (LeftThumbProximal, [60.0, 0.0, 0.0]),
                (LeftThumbDistal, [85.0, 0.0, 0.0]),
            ],
        ],
        views: ROLL,
    },
    Sheet {
        name: "hip",
        hanging: true,
        focus: Bone::Hips,
        off: [0.0, -0.08, 0.02],
        height: 0.62,
        stances: &[
            &[(LeftUpperLeg, [90.0, 0.0, 0.0]), (LeftLowerLeg, [90.0, 0.0, 0.0])],
            &[(LeftUpperLeg, [118.0, 10.0, 0.0]), (LeftLowerLeg, [120.0, 0.0, 0.0])],
            &[(LeftUpperLeg, [90.0, 40.0, 20.0]), (LeftLowerLeg, [110.0, 0.0, 0.0])],
            &[(LeftUpperLeg, [0.0, 45.0, 0.0])],
            &[(LeftUpperLeg, [38.0, 90.0, 0.0])],
            &[(LeftUpperLeg, [-19.0, 0.0, 0.0])],
            &[(LeftUpperLeg, [104.0, -43.0, 0.0])],
            &[(LeftUpperLeg, [0.0, -12.0, 45.0])],
            &[(LeftUpperLeg, [0.0, 0.0, -45.0])],
            &[(LeftUpperLeg, [81.0, 81.0, 0.0]), (LeftLowerLeg, [90.0, 0.0, 0.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "knee",
        hanging: true,
        focus: LeftLowerLeg,
        off: [0.0, 0.0, -0.02],
        height: 0.40,
        stances: &[
            &[(LeftLowerLeg, [90.0, 0.0, 0.0])],
            &[(LeftLowerLeg, [135.0, 0.0, 0.0])],
            &[(LeftLowerLeg, [155.0, 0.0, 0.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "foot",
        hanging: true,
        focus: LeftFoot,
        off: [0.0, -0.02, 0.05],
        height: 0.32,
        stances: &[
            &[(LeftFoot, [25.0, 0.0, 0.0])],
            &[(LeftFoot, [-50.0, 0.0, 0.0])],
            &[(LeftFoot, [0.0, 20.0, 20.0])],
            &[(LeftFoot, [-50.0, -20.0, -30.0])],
            &[(LeftToes, [-65.0, 0.0, 0.0])],
            &[(LeftToes, [40.0, 0.0, 0.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "neck",
        hanging: true,
        focus: Neck,
        off: [0.0, 0.07, 0.01],
        height: 0.48,
        stances: &[
            &[(Neck, [0.0, 0.0, 30.0]), (Head, [0.0, 0.0, 37.0])],
            &[(Neck, [30.0, 0.0, 0.0]), (Head, [30.0, 0.0, 0.0])],
            &[(Neck, [-30.0, 0.0, 0.0]), (Head, [-30.0, 0.0, 0.0])],
            &[(Neck, [0.0, 22.0, 0.0]), (Head, [0.0, 22.0, 0.0])],
            &[(Jaw, [25.0, 0.0, 0.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "eyes",
        hanging: true,
        focus: Head,
        off: [0.0, 0.065, 0.08],
        height: 0.14,
        stances: &[
            &[(LeftEye, [30.0, 0.0, 0.0])],
            &[(LeftEye, [-30.0, 0.0, 0.0])],
            &[(LeftEye, [0.0, 40.0, 0.0])],
            &[(LeftEye, [0.0, -40.0, 0.0])],
        ],
        views: ROUND,
    },
    Sheet {
        name: "spine",
        hanging: true,
        focus: Chest,
        off: [0.0, 0.0, 0.0],
        height: 0.80,
        stances: &[
            &[(Spine, [0.0, 0.0, 15.0]), (Chest, [0.0, 0.0, 15.0]), (UpperChest, [0.0, 0.0, 15.0])],
            &[(Spine, [27.0, 0.0, 0.0]), (Chest, [27.0, 0.0, 0.0]), (UpperChest, [27.0, 0.0, 0.0])],
            &[(Spine, [-9.0, 0.0, 0.0]), (Chest, [-9.0, 0.0, 0.0]), (UpperChest, [-9.0, 0.0, 0.0])],
            &[(Spine, [0.0, 12.0, 0.0]), (Chest, [0.0, 12.0, 0.0]), (UpperChest, [0.0, 12.0, 0.0])],
        ],
        views: ROUND,
    },
];
