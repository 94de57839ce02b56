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

impl Steering {
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
}
