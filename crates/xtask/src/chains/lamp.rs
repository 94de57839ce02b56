//! The desk lamp: base, joint and shade, each standing along z.

use super::lathe::turned;
use super::outline::Outline;
use super::solid::Solid;

pub fn meshes() -> Vec<(&'static str, Solid)> {
    vec![("lamp-base", base()), ("lamp-shade", shade())]
}

fn base() -> Solid {
    turned(&Outline::rounded(&[
        [0.0, 0.0, 0.0],
        [0.1, 0.0, 0.004],
        [0.1, 0.014, 0.008],
        [0.03, 0.024, 0.02],
        [0.012, 0.05, 0.006],
        [0.0, 0.05, 0.0],
    ]))
}

/// A bell that opens toward -z; its joint is at the origin.
fn shade() -> Solid {
    turned(&Outline::rounded(&[
        [0.0, 0.012, 0.0],
        [0.0, -0.002, 0.0],
        [0.021, -0.006, 0.01],
        [0.028, -0.05, 0.02],
        [0.079, -0.13, 0.0],
        [0.083, -0.13, 0.0],
        [0.033, -0.048, 0.02],
        [0.024, 0.0, 0.01],
        [0.012, 0.012, 0.004],
    ]))
}
