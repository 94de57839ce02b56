//! Balance: the hips shifted so that the centre of mass comes over the feet.

use glam::DVec3;

use crate::{
    Bone, Contact, Figure, Frames, GestureError, Limb, Moved, Pose, center_of_mass, frames, move_hips,
};

/// Shifts the hips level until the centre of mass is over the middle of the feet in contact, or a part of the way
/// there; contacts are kept.
///
/// # Errors
/// No foot in contact, an amount that is not finite, limbs that can't be solved.
pub fn balance(figure: &Figure, before: &Pose, amount: f64, ranges: bool) -> Result<Moved, GestureError> {
    if !amount.is_finite() {
        return Err(GestureError::NotFinite { what: "the amount" });
    }
    let start = frames(figure, before);
    let feet: Vec<Limb> = [Limb::LeftLeg, Limb::RightLeg]
        .into_iter()
        .filter(|leg| before.limb(*leg).contact != Contact::Free)
        .collect();
    if feet.is_empty() {
        return Err(GestureError::NoSupport);
    }
    let middle = feet.iter().map(|leg| sole(figure, &start, *leg)).sum::<DVec3>() / feet.len() as f64;
    let from = center_of_mass(figure, &start);
    let goal = from + (level(middle) - level(from)) * amount;
    let mut moved = Moved { pose: before.clone(), clamped: false };
    let mut shift = DVec3::ZERO;
    // The legs stay behind, so each round brings the centre most of the way: seven times nearer or more.
    for _ in 0..ROUNDS {
        let off = level(goal - center_of_mass(figure, &frames(figure, &moved.pose)));
        if off.length() < 1e-7 {
            break;
        }
        shift += off;
        moved = move_hips(figure, before, shift, ranges)?;
    }
    Ok(moved)
}

const ROUNDS: usize = 16;

/// The middle of a foot's sole in the world, or its joint where the figure names no heel and ball.
fn sole(figure: &Figure, frames: &Frames, leg: Limb) -> DVec3 {
    let named = |name: &str| figure.articulators[leg.index()].get(name).map(|a| frames[a.bone].point(a.at));
    let joint: Bone = leg.parts().end;
    match (named("heel"), named("ball")) {
        (Some(heel), Some(ball)) => (heel + ball) * 0.5,
        _ => frames[joint].position,
    }
}

fn level(v: DVec3) -> DVec3 {
    DVec3::new(v.x, 0.0, v.z)
}
