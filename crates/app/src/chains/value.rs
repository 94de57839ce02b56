//! A value of a joint as people read it: its name and its unit.

use rig::{DofPart, Robot, RobotDof};

/// What a value is shown in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unit {
    /// Angles.
    Degrees,
    /// Slides of a metre and more.
    Metres,
    /// Shorter ones.
    Millimetres,
}

/// Slides with a longer way are shown in metres.
const LONG_M: f64 = 1.0;

impl Unit {
    /// That of a joint's value.
    pub fn of(dof: &RobotDof) -> Unit {
        let length = dof.range.max - dof.range.min;
        match dof.part.is_angle() {
            true => Unit::Degrees,
            false if length <= LONG_M => Unit::Millimetres,
            false => Unit::Metres,
        }
    }

    /// Radians or metres in this unit.
    pub fn shown(self, natural: f64) -> f64 {
        match self {
            Unit::Degrees => natural.to_degrees(),
            Unit::Metres => natural,
            Unit::Millimetres => natural * 1e3,
        }
    }

    /// Degrees or metres, as commands have them, of a number in this unit.
    pub fn asked(self, shown: f64) -> f64 {
        if self == Unit::Millimetres { shown * 1e-3 } else { shown }
    }

    /// Behind the number.
    pub const fn suffix(self) -> &'static str {
        match self {
            Unit::Degrees => "°",
            Unit::Metres => " m",
            Unit::Millimetres => " mm",
        }
    }

    /// Decimals of the number.
    pub const fn decimals(self) -> usize {
        match self {
            Unit::Degrees | Unit::Millimetres => 1,
            Unit::Metres => 3,
        }
    }

    /// What an arrow key does.
    pub const fn step(self) -> f64 {
        match self {
            Unit::Degrees | Unit::Millimetres => 1.0,
            Unit::Metres => 0.01,
        }
    }

    /// A number with the unit.
    pub fn written(self, shown: f64) -> String {
        match shown.is_finite() {
            true => format!("{shown:.*}{}", self.decimals(), self.suffix()),
            false => "no end".to_owned(),
        }
    }
}

/// The name of a value, of which a robot has one: `boom angle`, `base position`, `neck yaw`.
pub fn name(robot: &Robot, dof: &RobotDof) -> String {
    let joint = robot.joints().get(dof.joint).map_or("", |joint| joint.name.as_str());
    format!("{joint} {}", word(dof.part))
}

/// The word of a part.
pub const fn word(part: DofPart) -> &'static str {
    match part {
        DofPart::Turn => "angle",
        DofPart::Slide => "position",
        other => other.name(),
    }
}
