//! What is edited, and what is told of a change.

use rig::{Body, Evaluation, Figure, Limb, Locks, Mechanics, Pose};

/// What is edited: the pose, and what gestures have to heed. Only the pose is saved.
#[derive(Clone, PartialEq, Debug)]
pub struct Document {
    /// The pose.
    pub pose: Pose,
    /// Whether joints stop at their ranges.
    pub ranges: bool,
    /// What gestures bring along that their names don't say: nothing, unless asked for.
    pub mechanics: Mechanics,
    /// Joints that keep their angles whatever the gesture.
    pub locks: Locks,
    /// Whether what is done on one side is done on the other, too.
    pub symmetry: bool,
    /// What is made of the figure.
    pub body: Body,
}

impl Document {
    /// A pose with ranges on; no mechanics, locks or symmetry, the figure as it is.
    pub fn of(pose: Pose) -> Document {
        Document {
            pose,
            ranges: true,
            mechanics: Mechanics::default(),
            locks: Locks::NONE,
            symmetry: false,
            body: Body::AS_IS,
        }
    }

    /// What it comes to. A limb whose root is locked has no elevation to go to.
    pub(crate) fn evaluated(&self, figure: &Figure) -> Evaluation {
        let mut evaluation = rig::evaluate(figure, &self.pose, self.ranges);
        for limb in Limb::ALL.into_iter().filter(|limb| self.locks.contains(limb.parts().root)) {
            let view = &mut evaluation.limbs[limb.index()];
            view.elevation_range = view.elevation.map(|now| [now, now]);
        }
        evaluation
    }
}

/// What a request did.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Outcome {
    /// One sentence for the status line.
    pub message: String,
    /// Whether a range, reach or contact stopped the command short.
    pub clamped: bool,
    /// Limbs whose goal was not met: how far their articulator is from it, metres.
    pub missed: Vec<(Limb, f64)>,
}
