//! The circle on which an elbow or a knee swings while hand or foot hold.

use rig::{Contact, Figure, Frames, Limb, Pose, Side};

use crate::Circle;

/// The circle on which a limb's hinge swings, with the hinge at angle 0, and whether reported elevations, which rise
/// outward, rise with its angle (1) or fall (-1). `None` for a limb whose articulator is at its root.
pub fn elevation_circle(figure: &Figure, pose: &Pose, frames: &Frames, limb: Limb) -> Option<(Circle, f64)> {
    let parts = limb.parts();
    let at = figure.articulator(pose, limb);
    // A planted end elevates about the line to its own joint.
    let planted = matches!(pose.limb(limb).contact, Contact::Planted { .. }) && at.bone != parts.hinge;
    let about = if planted { frames[parts.end].position } else { frames[at.bone].point(at.at) };
    let (root, hinge) = (frames[parts.root].position, frames[parts.hinge].position);
    let axis = (about - root).try_normalize()?;
    let center = root + axis * (hinge - root).dot(axis);
    let circle = Circle::new(center, axis, hinge - center, hinge.distance(center));
    // Outward is about the axis for a left arm, against it for its twin; legs are the other way round.
    let sense = if limb.is_arm() == (limb.side() == Side::Left) { 1.0 } else { -1.0 };
    Some((circle, sense))
}
