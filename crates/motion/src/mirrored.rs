//! The mirror image of a clip, in the figure's own middle plane.

use glam::DVec3;
use rig::{Angles, Bone, Place};

use crate::{Clip, Track};

impl Clip {
    /// The mirror image: twins change sides, the root goes to the other side. Mirroring twice gives the same bits, but for
    /// zeros' signs. A stride then begins with the right heel's contact; see [`Clip::mirrored_in_step`].
    pub fn mirrored(&self) -> Clip {
        let joint = |(bone, track): (&Bone, &Track<Angles>)| {
            let own = bone.mirrored() != *bone;
            // Twins mirror their axes, so their angles agree; a middle joint bends and turns to the other side.
            let image = |a: Angles| Angles { abduction: 0.0 - a.abduction, twist: 0.0 - a.twist, ..a };
            (bone.mirrored(), track.map(|a| if own { a } else { image(a) }))
        };
        let place = |p: Place| Place { position: flipped(p.position), turn: 0.0 - p.turn };
        Clip {
            root: self.root.as_ref().map(|root| root.map(place)),
            hips: self.hips.as_ref().map(|hips| hips.map(flipped)),
            joints: self.joints.iter().map(joint).collect(),
            ..self.clone()
        }
    }

    /// The mirror image; of a stride so that it again begins with the left heel's contact, half a length later.
    pub fn mirrored_in_step(&self) -> Clip {
        let image = self.mirrored();
        if self.stride { image.shifted(self.length_secs * 0.5) } else { image }
    }
}

fn flipped(v: DVec3) -> DVec3 {
    DVec3::new(0.0 - v.x, v.y, v.z)
}
