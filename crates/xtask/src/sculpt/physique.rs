//! What kind of body is sculpted, apart from its skeleton.

/// How a body differs from the neutral adult; every number is 0 for that one.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Physique {
    /// Sex characteristics: -1 male, 1 female.
    pub sex: f64,
    /// Fat: -1 slender, 1 heavy.
    pub build: f64,
    /// Muscle: -1 slight, 1 athletic.
    pub muscle: f64,
    /// Age: -1 a child's soft forms, 1 an old person's.
    pub age: f64,
}

impl Physique {
    /// The neutral adult.
    pub const NEUTRAL: Physique = Physique { sex: 0.0, build: 0.0, muscle: 0.0, age: 0.0 };
}
