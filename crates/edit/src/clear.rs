//! Back to where a joint or a limb is by nature: what clears its angles, and what clears its place.

use rig::{Bone, Joint, Limb, Space};

use crate::{By, Command, Editor, Hold};

/// Every angle of a joint back to 0; locked joints stay.
pub fn to_rest(editor: &Editor, bone: Bone) -> Vec<Command> {
    let joint = editor.figure().skeleton.joint(bone).filter(|_| !editor.document().locks.contains(bone));
    let zero = |dof| Command::Turn { joint: bone, dof, degrees: 0.0, by: By::To };
    joint.into_iter().flat_map(Joint::dofs).map(zero).collect()
}

/// Clears the place that a bone has been given: of the hips, their shift; of a limb's bone, the limb's contact. Other bones
/// have none, and a bone whose place is clear already asks for nothing.
pub fn clear_place(editor: &Editor, bone: Bone) -> Vec<Command> {
    let pose = editor.pose();
    if bone == Bone::Hips {
        let shift = editor.figure().rest_pose().hips - pose.hips;
        let by = pose.place.world_from_figure().rotation * shift;
        return if by.length() > 1e-12 { vec![Command::MoveHips { by }] } else { Vec::new() };
    }
    let held = Limb::of(bone).filter(|limb| pose.limb(*limb).contact != rig::Contact::Free);
    let free = |limb| Command::Keep { limb, contact: Hold::Free, space: Space::World };
    held.map(free).into_iter().collect()
}
