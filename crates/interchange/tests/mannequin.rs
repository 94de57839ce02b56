//! The shipped figure: whole, symmetric and as heavy and tall as it says.

use glam::DVec3;
use interchange::figure;
use rig::{Articulation, Bone, Figure, Joint, Limb, Side};

fn mannequin() -> Figure {
    figure::mannequin().expect("the shipped figure is whole")
}

fn joint(figure: &Figure, bone: Bone) -> &Joint {
    figure.skeleton.joint(bone).expect("the mannequin has every bone")
}

#[test]
fn has_every_bone() {
    let figure = mannequin();
    for bone in Bone::ALL {
        let joint = joint(&figure, bone);
        assert_eq!(joint.carrier, (bone != Bone::Hips).then(|| bone.carrier()), "{bone}");
    }
}
