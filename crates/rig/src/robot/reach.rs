//! Bringing a point of a robot somewhere.

use glam::{DQuat, DVec3};
use kin::chain::{Goal, Options, Root, Solver, Value};
use kin::{Frame, Interval};

use super::{Robot, RobotChain, RobotPose};

/// As often a solve is repeated from where following joints have gone.
const ROUNDS: usize = 12;
/// How far off a point may be, as a part of the robot's length.
const TOLERANCE: f64 = 1e-4;

/// Where a point of a link should go, and how.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RobotGoal {
    /// The link.
    pub link: usize,
    /// The point in the link's frame, metres.
    pub point: DVec3,
    /// Where it should go in the world, metres.
    pub target: DVec3,
    /// How the link should be turned in the world, if that matters.
    pub rotation: Option<DQuat>,
    /// Whether the root stays or is drawn along.
    pub root: Root,
    /// How to find the values.
    pub solver: Solver,
    /// Whether joints stop at their limits.
    pub ranges: bool,
    /// A joint that stays although it lies on the way, as a base does whose root is held. Turns of balls don't stay.
    pub held: Option<usize>,
}

/// What came of a reach.
#[derive(Clone, PartialEq, Debug)]
pub struct RobotReach {
    /// The values then.
    pub pose: RobotPose,
    /// Where the root is then; as before unless it was drawn along.
    pub world_from_root: Frame,
    /// Whether the point is within a ten-thousandth of the robot's length of its target, and the rotation within a
    /// thousandth of a radian.
    pub reached: bool,
    /// From the point to its target, metres.
    pub residual_m: f64,
    /// From the link's rotation to the one asked for, radians; 0 if none was.
    pub residual_rad: f64,
    /// Sweeps and steps taken.
    pub iterations: usize,
}

impl Robot {
    /// Brings a point of a link as near to its target as the joints between root and link let it. Joints that mimic another
    /// follow it. The residual is never larger than before.
    ///
    /// # Errors
    /// One sentence why the goal is none: no such link, numbers that aren't finite, a solver that knows no rotations.
    pub fn reach(
        &self,
        pose: &RobotPose,
        world_from_root: Frame,
        goal: &RobotGoal,
    ) -> Result<RobotReach, String> {
        let told = |e: kin::chain::ChainError| e.to_string();
        let mut best: Option<RobotReach> = None;
        let mut now = (self.followed(pose), world_from_root);
        let mut iterations = 0;
        for _ in 0..ROUNDS {
            let mut nodes = self.chain(&now.0).map_err(told)?;
            let node = *nodes.node_of_link.get(goal.link).ok_or("there is no such link")?;
            if !goal.ranges {
                (0..nodes.chain.len()).for_each(|i| free(&mut nodes.chain, i));
            }
            if let Some(joint) = goal.held {
                hold(&mut nodes, joint);
            }
            let asked = Goal {
                node,
                point: goal.point,
                target: goal.target,
                rotation: goal.rotation,
                root: goal.root,
            };
            let options = Options { solver: goal.solver, ..Options::of(&nodes.chain) };
            let solved = nodes.chain.solve(&nodes.values, now.1, &asked, &options).map_err(told)?;
            iterations += solved.iterations;
            let pose = self.pose_of(&nodes, &solved.values, &now.0);
            let found = self.judged(pose, solved.world_from_root, goal, iterations, &options);
            let better = best.as_ref().is_none_or(|b| found.residual() < b.residual());
            now = (found.pose.clone(), found.world_from_root);
            if better {
                best = Some(found);
            }
            if !better || best.as_ref().is_some_and(|b| b.reached) || self.follows_nothing() {
                break;
            }
        }
        best.ok_or_else(|| "nothing was tried".to_owned())
    }

    fn follows_nothing(&self) -> bool {
        self.followers.is_empty()
    }

    /// What a pose comes to, following joints included.
    fn judged(
        &self,
        pose: RobotPose,
        world_from_root: Frame,
        goal: &RobotGoal,
        iterations: usize,
        options: &Options<'_>,
    ) -> RobotReach {
        let world_from_link = world_from_root.then(self.frames(&pose)[goal.link]);
        let residual_m = world_from_link.point(goal.point).distance(goal.target);
        let residual_rad = goal.rotation.map_or(0.0, |wanted| world_from_link.rotation.angle_between(wanted));
        let reached = residual_m <= options.tolerance_m && residual_rad <= options.tolerance_rad;
        RobotReach { pose, world_from_root, reached, residual_m, residual_rad, iterations }
    }
}

impl RobotReach {
    fn residual(&self) -> f64 {
        self.residual_m + self.residual_rad * TOLERANCE
    }
}

/// Leaves a joint no way but where it is.
fn hold(nodes: &mut RobotChain, joint: usize) {
    for node in 0..nodes.chain.len() {
        if let (true, Value::Amount(value)) = (nodes.joint_of_node(node) == Some(joint), nodes.values[node]) {
            // What doesn't move has no range, and needs none.
            let _ = nodes.chain.set_range(node, Interval::new(value, value));
        }
    }
}

fn free(chain: &mut kin::chain::Chain, node: usize) {
    // What has no range of this kind has nothing to be freed of.
    let _ = chain.set_range(node, Interval::FREE);
}
