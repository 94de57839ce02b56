//! What is edited of a chain, and what is told of a change.

use std::sync::Arc;

use glam::DVec3;
use rig::{Frame, Robot, RobotPose, RobotSkin, RootMoves};

use super::command::ChainSolver;

/// What is edited: the chain itself, the values of its joints, and where it stands.
#[derive(Clone, Debug)]
pub struct ChainDocument {
    /// Links, joints, ranges, looks.
    pub robot: Arc<Robot>,
    /// The joints' values.
    pub pose: RobotPose,
    /// Where its root link is.
    pub world_from_root: Frame,
    /// Whether joints stop at their ranges.
    pub ranges: bool,
    /// How its root may be moved.
    pub root: RootMoves,
    /// Whether it moves in one plane, which a flat view from the side shows.
    pub planar: bool,
    /// The URDF file that the links are of, as the chain's file names it; `None` once its structure was changed.
    pub urdf: Option<String>,
}

impl ChainDocument {
    /// A chain in a pose, its z standing up at the world's origin, ranges on.
    pub fn of(robot: Arc<Robot>, pose: &RobotPose) -> ChainDocument {
        let pose = robot.followed(pose);
        ChainDocument {
            robot,
            pose,
            world_from_root: Robot::WORLD_FROM_ROOT,
            ranges: true,
            root: RootMoves::Free,
            planar: false,
            urdf: None,
        }
    }

    /// Raised, if something of it is below the ground, until all of it stands there.
    #[must_use]
    pub fn on_the_ground(mut self) -> ChainDocument {
        let lowest = f64::from(RobotSkin::of(&self.robot).bounds(&self.frames()).min.y);
        if lowest.is_finite() && lowest < 0.0 {
            self.world_from_root.position.y -= lowest;
        }
        self
    }

    /// Where each link is in the world.
    pub fn frames(&self) -> Vec<Frame> {
        let frames = self.robot.frames(&self.pose);
        frames.into_iter().map(|root_from_link| self.world_from_root.then(root_from_link)).collect()
    }

    /// Where a link ends in the world; its origin for a link that isn't there.
    pub fn end_in_world(&self, link: usize) -> DVec3 {
        let frame = self.frames().get(link).copied().unwrap_or(self.world_from_root);
        frame.point(self.robot.tip(link))
    }
}

impl PartialEq for ChainDocument {
    fn eq(&self, other: &ChainDocument) -> bool {
        let ChainDocument { robot, pose, world_from_root, ranges, root, planar, urdf } = self;
        // Meshes are large, and most documents of a history share one robot.
        let same = Arc::ptr_eq(robot, &other.robot) || *robot == other.robot;
        let stands = (*pose == other.pose) && (*world_from_root == other.world_from_root);
        let how = (ranges, root, planar, urdf) == (&other.ranges, &other.root, &other.planar, &other.urdf);
        stands && how && same
    }
}

/// How an inverse gesture went.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainReach {
    /// The link, by name.
    pub link: String,
    /// Where its point was to go, world, metres.
    pub target: DVec3,
    /// With which solver.
    pub solver: ChainSolver,
    /// Whether it is within a ten-thousandth of the chain's length.
    pub reached: bool,
    /// How far off the point is, metres.
    pub residual_m: f64,
    /// How far the link is turned from the rotation asked for, degrees; 0 if none was.
    pub residual_deg: f64,
    /// Sweeps and steps taken.
    pub iterations: usize,
}

/// What came of a request.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct ChainOutcome {
    /// One sentence for the status line; empty if there is nothing to say.
    pub message: String,
    /// Whether a range stopped something short, or a point did not get to its target.
    pub clamped: bool,
    /// How a reach went.
    pub reach: Option<ChainReach>,
}
