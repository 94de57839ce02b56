//! What a picture shows: a figure in a pose, or a chain.

use std::sync::Arc;

use edit::{ChainDocument, Editor};
use glam::Vec3;
use rig::{
    Bounds, Evaluation, Figure, Frame, Mesh, Palette, Pose, Robot, RobotSkin, evaluate, skin_positions,
};

use super::darkroom::{bounds, rest_positions};
use super::underfoot::Underfoot;

/// A figure in a pose.
#[derive(Clone, Debug)]
pub struct Posed {
    /// Who.
    pub figure: Arc<Figure>,
    /// How.
    pub evaluation: Evaluation,
    /// On what, in place of the level ground at height 0.
    pub underfoot: Option<Underfoot>,
}

/// A chain with its links where they are.
#[derive(Clone, Debug)]
pub struct Standing {
    /// Which.
    pub robot: Arc<Robot>,
    /// What it looks like.
    pub skin: Arc<RobotSkin>,
    /// Where each link is in the world.
    pub frames: Vec<Frame>,
}

/// What a picture shows.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A figure; in a box, as it is much the larger.
    Figure(Box<Posed>),
    /// A chain.
    Chain(Standing),
}

impl Subject {
    /// The figure as an editor shows it.
    pub fn of(editor: &Editor) -> Subject {
        let (figure, evaluation) = (editor.figure().clone(), editor.evaluation().clone());
        let posed = Posed { figure, evaluation, underfoot: None };
        Subject::Figure(Box::new(posed))
    }

    /// A figure in a pose, on ground if there is some.
    pub fn of_pose(figure: &Arc<Figure>, pose: &Pose, underfoot: Option<Underfoot>) -> Subject {
        let evaluation = evaluate(figure, pose, true);
        Subject::Figure(Box::new(Posed { figure: figure.clone(), evaluation, underfoot }))
    }

    /// A chain as its document says.
    pub fn of_chain(document: &ChainDocument) -> Subject {
        let robot = document.robot.clone();
        let skin = Arc::new(RobotSkin::of(&robot));
        Subject::Chain(Standing { robot, skin, frames: document.frames() })
    }

    /// The figure's or the chain's name.
    pub fn name(&self) -> &str {
        match self {
            Subject::Figure(posed) => &posed.figure.name,
            Subject::Chain(standing) => standing.robot.name(),
        }
    }

    /// The figure, if it is one.
    pub fn posed(&self) -> Option<&Posed> {
        match self {
            Subject::Figure(posed) => Some(posed),
            Subject::Chain(_) => None,
        }
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        match self {
            Subject::Figure(posed) => bounds(&posed.figure, &posed.evaluation),
            Subject::Chain(standing) => standing.skin.bounds(&standing.frames),
        }
    }

    /// Places of its vertices, or of its joints if it has none, world, metres.
    pub fn points(&self) -> Vec<Vec3> {
        let seen: Vec<Vec3> = self
            .meshes()
            .iter()
            .zip(&self.palettes())
            .flat_map(|(mesh, palette)| skin_positions(mesh, palette))
            .collect();
        let joints = || match self {
            Subject::Figure(posed) => posed.evaluation.frames.0.to_vec(),
            Subject::Chain(standing) => standing.frames.clone(),
        };
        if seen.is_empty() { joints().iter().map(|frame| frame.position.as_vec3()).collect() } else { seen }
    }

    /// What is drawn of it.
    pub(super) fn meshes(&self) -> &[Mesh] {
        match self {
            Subject::Figure(posed) => posed.figure.skin.as_slice(),
            Subject::Chain(standing) => &standing.skin.meshes,
        }
    }

    /// What moves each mesh.
    pub(super) fn palettes(&self) -> Vec<Palette> {
        match self {
            Subject::Figure(posed) => {
                vec![Palette::new(&posed.evaluation.frames, &rest_positions(&posed.figure))]
            }
            Subject::Chain(standing) => standing.skin.palettes(&standing.frames),
        }
    }

    /// The ground that it stands on, if it is one of its own.
    pub(super) fn underfoot(&self) -> Option<&Underfoot> {
        self.posed().and_then(|posed| posed.underfoot.as_ref())
    }
}
