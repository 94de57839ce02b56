//! Where a walker is to go: the parameters of a blend tree.

use serde::{Deserialize, Serialize};

/// What steers a walker. A plain struct: panels, keys, pads and flags fill it in.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Steering {
    /// Metres a second, in any direction; never negative.
    pub speed: f64,
    /// Metres a second ahead; negative is backward.
    pub forward: f64,
    /// Metres a second to the figure's left.
    pub sideways: f64,
    /// Degrees a second to the figure's left.
    pub turn: f64,
    /// The ground's rise ahead, degrees; positive is uphill. Filled in by the walker.
    pub slope: f64,
    /// Whether the figure is asked to sit down.
    pub sit: bool,
}

/// A parameter by name, as trees name them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Parameter {
    Speed,
    Forward,
    Sideways,
    Turn,
    Slope,
}

impl Parameter {
    /// Every parameter.
    pub const ALL: [Parameter; 5] =
        [Parameter::Speed, Parameter::Forward, Parameter::Sideways, Parameter::Turn, Parameter::Slope];

    /// The name on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Parameter::Speed => "speed",
            Parameter::Forward => "forward",
            Parameter::Sideways => "sideways",
            Parameter::Turn => "turn",
            Parameter::Slope => "slope",
        }
    }

    /// The value that a figure of another size has where the reference figure has 1. `pace` is the ratio of
    /// their speeds: the square root of that of their legs, so times have the same ratio and rates of turning
    /// the inverse.
    pub fn of_pace(self, pace: f64) -> f64 {
        match self {
            Parameter::Speed | Parameter::Forward | Parameter::Sideways => pace,
            Parameter::Turn => pace.recip(),
            Parameter::Slope => 1.0,
        }
    }
}

/// Parameters beyond are taken as this, so that what follows stays finite.
const FARTHEST: f64 = 1e6;

impl Steering {
    /// Steering straight ahead, metres a second; negative is backward.
    pub fn ahead(speed: f64) -> Steering {
        Steering { speed: speed.abs(), forward: speed, ..Steering::default() }
    }

    /// The value of a parameter, in its own unit.
    pub fn get(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::Speed => self.speed,
            Parameter::Forward => self.forward,
            Parameter::Sideways => self.sideways,
            Parameter::Turn => self.turn,
            Parameter::Slope => self.slope,
        }
    }

    /// The same with numbers to reckon with: NaN as 0, what is beyond a million as a million. Trees do this
    /// themselves.
    pub fn tidied(&self) -> Steering {
        let tidy = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(-FARTHEST, FARTHEST) };
        Steering {
            speed: tidy(self.speed).max(0.0),
            forward: tidy(self.forward),
            sideways: tidy(self.sideways),
            turn: tidy(self.turn),
            slope: tidy(self.slope),
            sit: self.sit,
        }
    }
}
