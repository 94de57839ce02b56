//! Copying some of a pose as the text of a pose file; [`crate::Request::Paste`] takes it back.

use rig::{Bone, Figure, Part, Pose};

/// The text of a pose file that names only these bones' joints. A limb's articulator and contact go along with the
/// whole limb, root, hinge and end; the hips' place with the hips.
pub fn copy(figure: &Figure, pose: &Pose, bones: &[Bone]) -> String {
    rig::write_bones(figure, pose, bones)
}

/// As [`copy`] for all bones of some parts; no parts: the whole pose with its place, as a file would have it.
pub fn copy_parts(figure: &Figure, pose: &Pose, parts: &[Part]) -> String {
    rig::write_parts(figure, pose, parts)
}
