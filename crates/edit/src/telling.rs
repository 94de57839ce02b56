//! Commands in words, for history and the status line, and as the text of scripts and reports.

use crate::{By, Command, Goal, Hold};

impl Command {
    /// A short name: "Turn", "Reach" and so on.
    pub fn name(&self) -> &'static str {
        match self {
            Command::Turn { .. } => "Turn",
            Command::Reach { .. } => "Reach",
            Command::Elevate { .. } => "Elevate",
            Command::TurnInContact { .. } => "Turn in contact",
            Command::Flip { .. } => "Flip",
            Command::Articulate { .. } => "Choose articulator",
            Command::Keep { .. } => "Contact",
            Command::MoveHips { .. } => "Move hips",
            Command::Place { .. } => "Place",
            Command::AimSpine { .. } => "Aim spine",
            Command::LookAt { .. } => "Look at",
            Command::Handshape { .. } => "Handshape",
            Command::ApplyPose { .. } => "Apply pose",
            Command::Mirror { .. } => "Mirror",
            Command::Reset { .. } => "Reset",
            Command::Ranges { .. } => "Ranges",
            Command::Balance { .. } => "Balance",
        }
    }

    /// What the command did, in the past tense, for the status line.
    pub(crate) fn told(&self) -> String {
        let angle = |degrees: f64, by: By| match by {
            By::Delta => format!("by {degrees:.1}°"),
            By::To => format!("to {degrees:.1}°"),
        };
        match self {
            Command::Turn { joint, dof, degrees, by } => {
                format!("Turned {} {} {}", words(joint.name()), dof.name(), angle(*degrees, *by))
            }
            Command::Reach { limb, to: Goal::Here } => format!("{} stays", words(limb.name())),
            Command::Reach { limb, .. } => format!("{} reached", words(limb.name())),
            Command::Elevate { limb, degrees, by } => {
                format!("Elevated {} {}", words(limb.name()), angle(*degrees, *by))
            }
            Command::TurnInContact { limb, dof, degrees, by } => {
                format!("Turned {} in contact, {} {}", words(limb.name()), dof.name(), angle(*degrees, *by))
            }
            Command::Flip { limb } => format!("Flipped {}", words(limb.name())),
            Command::Articulate { limb, .. } => {
                format!("Chose another articulator for {}", words(limb.name()))
            }
            Command::Keep { limb, contact: Hold::Free, .. } => format!("{} let go", words(limb.name())),
            Command::Keep { limb, contact: Hold::Point, .. } => {
                format!("{} holds its point", words(limb.name()))
            }
            Command::Keep { limb, contact: Hold::Planted, .. } => {
                format!("{} is planted", words(limb.name()))
            }
            Command::MoveHips { .. } => "Moved the hips".to_owned(),
            Command::Place { .. } => "Placed the figure".to_owned(),
            Command::AimSpine { .. } => "Aimed the spine".to_owned(),
            Command::LookAt { .. } => "Looked".to_owned(),
            Command::Handshape { side, name, .. } => format!("{side:?} hand: {name}"),
            Command::ApplyPose { path, amount, .. } if *amount == 1.0 => {
                format!("Applied {}", pose_name(path))
            }
            Command::ApplyPose { path, amount, .. } => {
                format!("Blended {:.0} % of {}", amount * 100.0, pose_name(path))
            }
            Command::Mirror { .. } => "Mirrored".to_owned(),
            Command::Reset { .. } => "Reset to rest".to_owned(),
            Command::Ranges { on } => format!("Ranges {}", if *on { "on" } else { "off" }),
            Command::Balance { .. } => "Balanced over the feet".to_owned(),
        }
    }

    /// The command as a script would write it, on one line.
    pub fn text(&self) -> String {
        ron::to_string(self).unwrap_or_default()
    }
}

/// A pose file without its folder and its ending: "thinker".
fn pose_name(path: &str) -> &str {
    let file = path.rsplit(['/', '\\', ':']).next().unwrap_or(path);
    file.strip_suffix(".pose.ron").unwrap_or(file)
}

/// A bone's or limb's name as words: "leftUpperArm" is "left upper arm".
pub(crate) fn words(name: &str) -> String {
    let mut words = String::with_capacity(name.len() + 4);
    for letter in name.chars() {
        if letter.is_uppercase() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}
