//! The excavator: x forward, z up, y to its left; each part in the frame of its joint.

use glam::{DVec2, DVec3};

use super::lathe::turned;
use super::outline::Outline;
use super::plate::plate;
use super::solid::Solid;

pub fn meshes() -> Vec<(&'static str, Solid)> {
    vec![
        ("excavator-tracks", tracks()),
        ("excavator-wheels", wheels()),
        ("excavator-house", house()),
        ("excavator-weight", weight()),
        ("excavator-cab", cab()),
        ("excavator-glass", glass()),
        ("excavator-boom", boom()),
        ("excavator-pins", pins()),
        ("excavator-stick", stick()),
        ("excavator-bucket", bucket()),
        ("excavator-teeth", teeth()),
    ]
}

fn y(by: f64) -> DVec3 {
    DVec3::Y * by
}

fn tracks() -> Solid {
    let track = plate(&Outline::bar(DVec2::new(-1.05, 0.31), DVec2::new(1.05, 0.31), 0.31), 0.23, 0.03);
    let axle = plate(
        &Outline::rounded(&[[-0.75, 0.2, 0.05], [0.75, 0.2, 0.05], [0.6, 0.56, 0.1], [-0.6, 0.56, 0.1]]),
        0.6,
        0.03,
    );
    track.clone().at(y(0.78)).and(track.at(y(-0.78))).and(axle)
}

fn wheels() -> Solid {
    let wheel = |x: f64, z: f64, radius: f64| {
        let rim = [[0.0, -0.25, 0.0], [radius, -0.25, 0.02], [radius, 0.25, 0.02], [0.0, 0.25, 0.0]];
        turned(&Outline::rounded(&rim)).lying().at(DVec3::new(x, 0.0, z))
    };
    let ends = [-1.05, 1.05].map(|x| wheel(x, 0.31, 0.2));
    let rollers = [-0.6, -0.2, 0.2, 0.6].map(|x| wheel(x, 0.16, 0.09));
    let side = ends.into_iter().chain(rollers).fold(Solid::default(), Solid::and);
    side.clone().at(y(0.78)).and(side.at(y(-0.78)))
}

fn house() -> Solid {
    let deck = Outline::rounded(&[
        [-1.15, 0.76, 0.05],
        [0.62, 0.76, 0.08],
        [0.62, 0.98, 0.08],
        [0.3, 1.05, 0.1],
        [0.16, 1.5, 0.1],
        [-1.15, 1.5, 0.08],
    ]);
    let ring = [[0.0, 0.55, 0.0], [0.52, 0.55, 0.02], [0.52, 0.78, 0.02], [0.0, 0.78, 0.0]];
    // Two cheeks between which the boom turns.
    let cheek = plate(
        &Outline::rounded(&[[0.1, 0.9, 0.05], [0.66, 0.9, 0.1], [0.66, 1.36, 0.13], [0.38, 1.36, 0.1]]),
        0.03,
        0.01,
    );
    plate(&deck, 0.84, 0.05)
        .and(turned(&Outline::rounded(&ring)))
        .and(cheek.clone().at(y(0.19)))
        .and(cheek.at(y(-0.19)))
}

fn weight() -> Solid {
    let outline =
        Outline::rounded(&[[-1.5, 0.9, 0.2], [-1.1, 0.8, 0.05], [-1.1, 1.46, 0.05], [-1.5, 1.4, 0.25]]);
    plate(&outline, 0.82, 0.07)
}

/// The cab's outline, smaller by some distance.
fn cab_outline(by: f64) -> Outline {
    let corners =
        [[-0.42, 0.8, 0.06], [0.6, 0.8, 0.1], [0.72, 1.35, 0.2], [0.42, 2.2, 0.14], [-0.42, 2.2, 0.14]];
    Outline::rounded(&corners).inset(by)
}

fn cab() -> Solid {
    plate(&cab_outline(0.0), 0.3, 0.04).at(y(0.53))
}

fn glass() -> Solid {
    let corners = [[-0.3, 1.42, 0.06], [0.6, 1.42, 0.1], [0.36, 2.1, 0.1], [-0.3, 2.1, 0.08]];
    let side = plate(&Outline::rounded(&corners), 0.306, 0.004);
    let front =
        Outline::rounded(&[[0.6, 1.42, 0.02], [0.72, 1.42, 0.02], [0.47, 2.1, 0.02], [0.35, 2.1, 0.02]]);
    side.and(plate(&front, 0.24, 0.004)).at(y(0.53))
}

fn boom() -> Solid {
    let outline = Outline::rounded(&[
        [-0.15, -0.13, 0.14],
        [0.1, -0.15, 0.1],
        [1.15, 0.2, 0.6],
        [2.72, -0.11, 0.1],
        [2.72, 0.1, 0.1],
        [1.3, 0.6, 0.5],
        [-0.1, 0.17, 0.14],
    ]);
    plate(&outline, 0.13, 0.02)
}

fn pins() -> Solid {
    let pin = |x: f64, radius: f64, half: f64| {
        let disc = [[0.0, -half, 0.0], [radius, -half, 0.01], [radius, half, 0.01], [0.0, half, 0.0]];
        turned(&Outline::rounded(&disc)).lying().at(DVec3::new(x, 0.0, 0.0))
    };
    pin(0.0, 0.075, 0.245).and(pin(2.6, 0.055, 0.16))
}

fn stick() -> Solid {
    let outline = Outline::rounded(&[
        [-0.34, 0.05, 0.05],
        [-0.05, -0.12, 0.08],
        [0.25, -0.11, 0.2],
        [1.08, -0.07, 0.07],
        [1.08, 0.07, 0.07],
        [0.12, 0.2, 0.2],
        [-0.34, 0.2, 0.06],
    ]);
    plate(&outline, 0.095, 0.015)
}

/// The bucket opens toward -z; its teeth end at 0.6 m along x.
fn bucket() -> Solid {
    let shell = Outline::rounded(&[
        [-0.07, -0.03, 0.05],
        [0.07, -0.05, 0.04],
        [0.14, 0.14, 0.1],
        [0.26, 0.3, 0.14],
        [0.42, 0.28, 0.12],
        [0.5, 0.02, 0.01],
        [0.56, 0.02, 0.01],
        [0.5, 0.34, 0.15],
        [0.24, 0.38, 0.18],
        [-0.02, 0.2, 0.12],
    ]);
    let side = Outline::rounded(&[
        [-0.03, -0.03, 0.03],
        [0.08, -0.05, 0.03],
        [0.3, 0.04, 0.3],
        [0.53, 0.02, 0.02],
        [0.49, 0.33, 0.14],
        [0.24, 0.37, 0.18],
        [0.0, 0.2, 0.12],
    ]);
    let side = plate(&side, 0.012, 0.003);
    plate(&shell, 0.3, 0.01).and(side.clone().at(y(0.3))).and(side.at(y(-0.3)))
}

fn teeth() -> Solid {
    let tooth =
        Outline::rounded(&[[0.48, 0.0, 0.0], [0.6, -0.005, 0.004], [0.6, 0.005, 0.004], [0.48, 0.06, 0.0]]);
    let tooth = plate(&tooth, 0.035, 0.005);
    [-0.25, -0.085, 0.085, 0.25].iter().fold(Solid::default(), |all, at| all.and(tooth.clone().at(y(*at))))
}
