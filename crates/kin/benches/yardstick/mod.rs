//! The yardstick: the plain two-bone solve that most engines have. Positions in, two rotations out, no ranges.

use glam::{DQuat, DVec3};

/// The three joints of a limb where they are now, where the end should go and toward what the middle one points.
#[derive(Clone, Copy, Debug)]
pub struct TwoBone {
    pub root: DVec3,
    pub middle: DVec3,
    pub end: DVec3,
    pub target: DVec3,
    pub pole: DVec3,
}

impl TwoBone {
    /// The turns, in world axes, of the whole limb about the root and, before it, of the lower segment
    /// about the middle joint. Law of cosines; nothing that is degenerate is looked at.
    pub fn solve(&self) -> (DQuat, DQuat) {
        let (upper, lower) = (self.middle - self.root, self.end - self.middle);
        let (u, l) = (upper.length(), lower.length());
        let goal = self.target - self.root;
        let distance = goal.length();
        let toward = goal / distance;
        let d = distance.clamp((u - l).abs(), u + l);
        let now = (upper.dot(lower) / (u * l)).clamp(-1.0, 1.0).acos();
        let then = ((d * d - u * u - l * l) / (2.0 * u * l)).clamp(-1.0, 1.0).acos();
        let bend = DQuat::from_axis_angle(upper.cross(lower).normalize(), then - now);
        let end = upper + bend * lower;
        let swing = DQuat::from_rotation_arc(end.normalize(), toward);
        let (knee, pole) = (swing * upper, self.pole - self.root);
        let side = toward.cross(knee);
        let angle = side.dot(pole).atan2((knee - toward * knee.dot(toward)).dot(pole));
        (DQuat::from_axis_angle(toward, angle) * swing, bend)
    }

    /// Distance of the end from its target after the turns of [`TwoBone::solve`].
    pub fn missed(&self) -> f64 {
        let (root, middle) = self.solve();
        let end = self.middle - self.root + middle * (self.end - self.middle);
        (self.root + root * end).distance(self.target)
    }
}
