//! A pose as bits, for tests that nothing has changed at all.

use rig::{Contact, Pose};

/// Every number of a pose, bit for bit.
pub fn bits(pose: &Pose) -> Vec<u64> {
    let mut all: Vec<f64> = pose.angles.iter().flat_map(|a| [a.flexion, a.abduction, a.twist]).collect();
    all.extend(pose.hips.to_array());
    all.extend(pose.place.position.to_array());
    all.push(pose.place.turn);
    for limb in &pose.limbs {
        if let Some((_, target)) = limb.contact.target() {
            all.extend(target.to_array());
        }
        if let Contact::Planted { rotation, .. } = limb.contact {
            all.extend(rotation.to_array());
        }
    }
    all.into_iter().map(f64::to_bits).collect()
}
