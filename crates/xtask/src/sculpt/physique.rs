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

    /// The same by its ends.
    pub fn ends(&self) -> Ends {
        let Physique { sex, build, muscle, age } = *self;
        Ends {
            male: (-sex).max(0.0),
            female: sex.max(0.0),
            heavy: build.max(0.0),
            slender: (-build).max(0.0),
            muscle,
            child: (-age).max(0.0),
            old: age.max(0.0),
        }
    }
}

/// A physique by its ends: each 0 in the neutral adult, 1 at that end; muscle has both signs.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Of sex, below 0.
    pub male: f64,
    /// Of sex, above 0.
    pub female: f64,
    /// Of build, above 0.
    pub heavy: f64,
    /// Of build, below 0.
    pub slender: f64,
    /// Muscle as it is.
    pub muscle: f64,
    /// Of age, below 0.
    pub child: f64,
    /// Of age, above 0.
    pub old: f64,
}
