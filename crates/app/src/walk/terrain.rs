//! Which ground the figure walks on: what was chosen of it, and the ground that this makes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion::{Ground, Hills, HillsShape, Rise, Slope, Stairs, Stones};

use crate::failure::Failure;
use crate::load;

/// A kind of ground.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Kind {
    /// Level.
    Flat,
    /// Rolling.
    #[default]
    Hills,
    /// Even, up along +Z.
    Slope,
    /// Up, a landing, down.
    Stairs,
    /// Tops with gaps of lower ground.
    Stones,
    /// Triangles of a file.
    File,
}

impl Kind {
    /// All, in the order of the chooser.
    pub const ALL: [Kind; 6] = [Kind::Flat, Kind::Hills, Kind::Slope, Kind::Stairs, Kind::Stones, Kind::File];

    /// As the chooser has it.
    pub const fn words(self) -> &'static str {
        match self {
            Kind::Flat => "Flat",
            Kind::Hills => "Hills",
            Kind::Slope => "Slope",
            Kind::Stairs => "Stairs",
            Kind::Stones => "Stepping stones",
            Kind::File => "From a file…",
        }
    }

    /// Whether another seed gives another ground.
    pub const fn has_seed(self) -> bool {
        matches!(self, Kind::Hills | Kind::Stones)
    }
}

/// What was chosen of the ground.
#[derive(Clone, PartialEq, Debug)]
pub struct Choice {
    /// Its kind.
    pub kind: Kind,
    /// Which of the grounds that chance makes.
    pub seed: u64,
    /// The steepest place of hills, degrees.
    pub steepest_deg: f64,
    /// From hill to hill, metres.
    pub wavelength_m: f64,
    /// The slope's rise, degrees; negative is downhill.
    pub slope_deg: f64,
    /// The height of a stair, metres.
    pub rise_m: f64,
    /// The depth of a stair, metres.
    pub going_m: f64,
    /// The file with the triangles.
    pub file: Option<PathBuf>,
}

impl Default for Choice {
    fn default() -> Choice {
        Choice {
            kind: Kind::default(),
            seed: 1,
            steepest_deg: 20.0,
            wavelength_m: 4.0,
            slope_deg: 10.0,
            rise_m: 0.15,
            going_m: 0.37,
            file: None,
        }
    }
}

/// Ground that is made of a choice, when it is first followed and whenever the choice changes; level before.
#[derive(Clone, Debug)]
pub struct Terrain {
    /// What is chosen.
    pub choice: Choice,
    made: Choice,
    ground: Ground,
    /// The ground of the file that was read last.
    read: Option<(PathBuf, Ground)>,
    /// Grows with every other ground.
    revision: u64,
}

impl Default for Terrain {
    fn default() -> Terrain {
        let made = Choice { kind: Kind::Flat, ..Choice::default() };
        Terrain { choice: Choice::default(), made, ground: Ground::Flat, read: None, revision: 0 }
    }
}

impl Terrain {
    /// The ground.
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// Another number for every other ground.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether it is level at height 0, as without any ground.
    pub fn is_flat(&self) -> bool {
        self.ground == Ground::Flat
    }

    /// Makes the ground that is chosen, if it is another one than before; whether it was.
    pub fn follow(&mut self) -> bool {
        if self.choice == self.made {
            return false;
        }
        let ground = match (self.choice.kind, &self.read) {
            (Kind::File, Some((path, ground))) if self.choice.file.as_ref() == Some(path) => ground.clone(),
            _ => made(&self.choice),
        };
        self.made = self.choice.clone();
        let other = ground != self.ground;
        self.revision += u64::from(other);
        self.ground = ground;
        other
    }

    /// Takes on the ground of a file.
    ///
    /// # Errors
    /// A file that can't be read, or whose triangles are no ground; the ground stays as it was.
    pub fn open(&mut self, path: &Path) -> Result<(), Failure> {
        let ground = load::ground(&path.to_string_lossy(), 0)?;
        self.read = Some((path.to_owned(), ground.clone()));
        (self.choice.kind, self.choice.file) = (Kind::File, Some(path.to_owned()));
        self.made = self.choice.clone();
        self.ground = ground;
        self.revision += 1;
        Ok(())
    }
}

/// Whether a file may be ground, by its name.
pub fn is_ground(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ["obj", "stl", "dae", "glb"].contains(&ending.as_str()))
}

fn made(choice: &Choice) -> Ground {
    match choice.kind {
        // Of a file that isn't there yet nothing is known.
        Kind::Flat | Kind::File => Ground::Flat,
        Kind::Slope => Ground::Slope(Slope::new(choice.slope_deg, 0.0)),
        Kind::Hills => Ground::Hills(Arc::new(Hills::new(&HillsShape {
            seed: choice.seed,
            rise: Rise::Steepest(choice.steepest_deg),
            wavelength_m: choice.wavelength_m,
            ..HillsShape::default()
        }))),
        Kind::Stairs => Ground::Stairs(Stairs::new(choice.rise_m, choice.going_m, 8, 3.0)),
        Kind::Stones => Ground::Stones(Stones::new(choice.seed)),
    }
}
