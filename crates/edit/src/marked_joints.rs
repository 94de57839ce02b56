//! Which joints are marked: those of hands and face only where they are far enough apart to be told from each other.

use rig::{Bone, Figure, Part};

use crate::{Editor, Sight};

/// Discs of neighbouring joints must be this far apart.
const APART_PX: f64 = 14.0;

/// The joints whose discs are shown and can be picked. Fingers, thumbs, eyes and jaw are among them where the picture
/// has them far enough apart, or where they belong to the part of one of the `lit` bones: what is chosen or under the
/// pointer.
pub fn marked_joints(editor: &Editor, sight: &Sight, lit: &[Bone]) -> Vec<Bone> {
    let figure = editor.figure();
    let frames = &editor.evaluation().frames;
    let apart = Part::ALL.map(|part| spacing_m(figure, part));
    let shown = |bone: &Bone| {
        if !is_fine(*bone) || lit.iter().any(|other| is_fine(*other) && other.part() == bone.part()) {
            return true;
        }
        let spacing = Part::ALL.iter().zip(apart).find(|(part, _)| **part == bone.part());
        spacing.is_some_and(|(_, m)| m >= APART_PX * sight.metres_per_px(frames[*bone].position))
    };
    figure.skeleton.joints().map(|joint| joint.bone).filter(shown).collect()
}

/// Whether a joint is one of many in little room.
fn is_fine(bone: Bone) -> bool {
    matches!(bone.part(), Part::LeftHand | Part::RightHand)
        || matches!(bone, Bone::LeftEye | Bone::RightEye | Bone::Jaw)
}

/// The least length between fine joints of a part that follow each other, metres.
fn spacing_m(figure: &Figure, part: Part) -> f64 {
    let fine = figure.skeleton.joints().filter(|joint| is_fine(joint.bone) && joint.bone.part() == part);
    fine.map(|joint| joint.offset.length()).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::Arc;

    use glam::Vec2;
    use rig::{Bounds, Camera, View};

    use super::*;

    fn fine_ones(editor: &Editor, camera: Camera, lit: &[Bone]) -> Vec<Bone> {
        let sight = Sight { camera, size_px: Vec2::new(1000.0, 800.0) };
        let all = marked_joints(editor, &sight, lit);
        assert!(all.contains(&Bone::Hips) && all.contains(&Bone::LeftLowerArm));
        all.into_iter().filter(|bone| is_fine(*bone)).collect()
    }

    #[test]
    fn fingers_show_near_by_or_where_they_are_chosen() {
        let editor = Editor::new(Arc::new(interchange::figure::bare_mannequin().unwrap()));
        let frames = &editor.evaluation().frames;
        let figure = Bounds::of(frames.0.iter().map(|frame| frame.position.as_vec3()));
        let far = Camera::view(View::Front, figure, 1.25);
        assert_eq!(fine_ones(&editor, far, &[Bone::LeftLowerArm]), []);
        let chosen = fine_ones(&editor, far, &[Bone::LeftIndexDistal]);
        assert!(chosen.len() == 15 && chosen.iter().all(|bone| bone.part() == Part::LeftHand), "{chosen:?}");
        let hand = frames[Bone::RightMiddleProximal].position.as_vec3();
        let near = Camera::view(View::Front, Bounds::of([hand - 0.08, hand + 0.08]), 1.25);
        let seen = fine_ones(&editor, near, &[]);
        assert!(seen.contains(&Bone::RightLittleDistal) && seen.contains(&Bone::RightThumbProximal));
    }
}
