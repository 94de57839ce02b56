//! Which ground the figure walks on: what was chosen of it, and the ground that this makes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion::{Ground, GroundKind, Hills, HillsShape, Rise, Slope, Stairs};

use crate::failure::Failure;
use crate::load;

/// What the ground is made from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Source {
    /// A kind that needs no file.
    Made(GroundKind),
    /// Triangles of a file.
    File,
}

impl Source {
    /// All, in the order of the chooser.
    pub fn all() -> impl Iterator<Item = Source> {
        GroundKind::ALL.into_iter().map(Source::Made).chain([Source::File])
    }

    /// As the chooser has it.
    pub const fn words(self) -> &'static str {
        match self {
            Source::Made(GroundKind::Flat) => "Flat",
            Source::Made(GroundKind::Hills) => "Hills",
            Source::Made(GroundKind::Slope) => "Slope",
            Source::Made(GroundKind::Stairs) => "Stairs",
            Source::Made(GroundKind::Stones) => "Stepping stones",
            Source::File => "From a file…",
        }
    }

    /// Whether another seed gives another ground.
    pub const fn has_seed(self) -> bool {
        matches!(self, Source::Made(kind) if kind.has_seed())
    }
}

impl From<GroundKind> for Source {
    fn from(kind: GroundKind) -> Source {
        Source::Made(kind)
    }
}

/// What was chosen of the ground.
#[derive(Clone, PartialEq, Debug)]
pub struct Choice {
    /// What it is made from.
    pub source: Source,
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
            source: GroundKind::Hills.into(),
            seed: 1,
            steepest_deg: HillsShape::STEEPEST_DEG,
            wavelength_m: HillsShape::WAVELENGTH_M,
            slope_deg: Slope::RISE_DEG,
            rise_m: Stairs::RISE_M,
            going_m: Stairs::GOING_M,
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
        let made = Choice { source: GroundKind::Flat.into(), ..Choice::default() };
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
        let ground = match (self.choice.source, &self.read) {
            (Source::File, Some((path, ground))) if self.choice.file.as_ref() == Some(path) => ground.clone(),
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
        (self.choice.source, self.choice.file) = (Source::File, Some(path.to_owned()));
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
    // Of a file that isn't there yet nothing is known.
    let Source::Made(kind) = choice.source else { return Ground::Flat };
    match kind {
        GroundKind::Slope => Ground::Slope(Slope::new(choice.slope_deg, 0.0)),
        GroundKind::Hills => Ground::Hills(Arc::new(Hills::new(&HillsShape {
            seed: choice.seed,
            rise: Rise::Steepest(choice.steepest_deg),
            wavelength_m: choice.wavelength_m,
            ..HillsShape::default()
        }))),
        GroundKind::Stairs => {
            Ground::Stairs(Stairs::new(choice.rise_m, choice.going_m, Stairs::RISERS, Stairs::LANDING_M))
        }
        GroundKind::Flat | GroundKind::Stones => kind.ground(choice.seed),
    }
}
