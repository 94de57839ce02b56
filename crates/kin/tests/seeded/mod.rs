//! Seeded numbers for tests that run over many cases: the same cases in every run.
#![allow(dead_code)]

use glam::{DQuat, DVec3};

pub struct Seeded(pub u64);

impl Seeded {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let turn = self.between(0.0, std::f64::consts::TAU);
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    }

    pub fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.between(-3.1, 3.1))
            * DQuat::from_axis_angle(self.direction(), self.between(-3.1, 3.1))
    }
}
