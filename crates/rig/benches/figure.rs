//! The whole figure: forward kinematics, evaluation, skin and gestures, beside the plain two-bone solve.

#[path = "../../kin/benches/sampling/mod.rs"]
mod sampling;
#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;
#[path = "../../kin/benches/yardstick/mod.rs"]
mod yardstick;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use interchange::figure::{bare_mannequin, mannequin};
use rig::{Bone, Contact, Dof, Figure, Limb, Palette, Pose, SkinBounds, Space, Target};
use sampling::each;
use seeded::Seeded;
use yardstick::TwoBone;

fn figure() -> Figure {
    bare_mannequin().expect("the mannequin is whole")
}

/// A pose with every joint turned to somewhere in its range.
fn pose(figure: &Figure, seeded: &mut Seeded) -> Pose {
    let mut pose = figure.rest_pose();
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            let range = rig::live_range(joint, pose.angles(joint.bone), dof, true);
            pose.angles[joint.bone.index()].set(dof, seeded.between(range.min, range.max));
        }
    }
    pose
}

/// A standing pose with loose arms: the limbs a little bent, the fingers and the torso as at rest.
fn standing(figure: &Figure, seeded: &mut Seeded) -> Pose {
    let mut pose = figure.rest_pose();
    for limb in Limb::ALL {
        let parts = limb.parts();
        let mut turn = |bone: Bone, dof, from, to| {
            pose.angles[bone.index()].set(dof, seeded.between(from, to));
        };
        if limb.is_arm() {
            turn(parts.root, Dof::Abduction, -75.0, -40.0);
            turn(parts.root, Dof::Flexion, 0.0, 40.0);
            turn(parts.hinge, Dof::Flexion, 30.0, 80.0);
        } else {
            turn(parts.root, Dof::Flexion, 5.0, 25.0);
            turn(parts.hinge, Dof::Flexion, 15.0, 40.0);
            turn(parts.end, Dof::Flexion, -5.0, 10.0);
        }
    }
    pose
}

/// The same with hands held to points of the world and the feet planted.
fn in_contact(figure: &Figure, seeded: &mut Seeded) -> Pose {
    let mut pose = standing(figure, seeded);
    for limb in Limb::ALL {
        let nowhere = (Space::World, DVec3::ZERO);
        let contact = match limb.is_arm() {
            true => Contact::Point { space: nowhere.0, target: nowhere.1 },
            false => {
                Contact::Planted { space: nowhere.0, target: nowhere.1, rotation: glam::DQuat::IDENTITY }
            }
        };
        pose = rig::keep(figure, &pose, limb, contact).expect("a limb of the mannequin");
    }
    pose
}

fn plain(c: &mut Criterion) {
    let (figure, mut seeded) = (figure(), Seeded(1));
    let two_bone = || {
        let (now, then) = (pose(&figure, &mut seeded), pose(&figure, &mut seeded));
        let (now, then) = (rig::frames(&figure, &now), rig::frames(&figure, &then));
        let [root, middle, end] =
            [Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand].map(|bone| now[bone].position);
        let shift = root - then[Bone::LeftUpperArm].position;
        let [target, pole] = [Bone::LeftHand, Bone::LeftLowerArm].map(|bone| then[bone].position + shift);
        let case = TwoBone { root, middle, end, target, pole };
        assert!(case.missed() < 1e-9, "the yardstick misses by {} m", case.missed());
        case
    };
    each(c, "plain two-bone solve", two_bone, TwoBone::solve);
}

fn derived(c: &mut Criterion) {
    let (figure, mut seeded) = (figure(), Seeded(2));
    let mut turned = || pose(&figure, &mut seeded);
    each(c, "frames, every joint turned", &mut turned, |pose| rig::frames(&figure, pose));
    each(c, "evaluate, every joint turned", &mut turned, |pose| rig::evaluate(&figure, pose, true));
    let frames = || rig::frames(&figure, &turned());
    each(c, "centre of mass", frames, |frames| rig::center_of_mass(&figure, frames));
    let mut seeded = Seeded(3);
    let mut standing = || standing(&figure, &mut seeded);
    each(c, "frames, standing", &mut standing, |pose| rig::frames(&figure, pose));
    each(c, "evaluate, standing", &mut standing, |pose| rig::evaluate(&figure, pose, true));
}

fn skin(c: &mut Criterion) {
    let (figure, mut seeded) = (mannequin().expect("the mannequin is whole"), Seeded(4));
    let rest: [DVec3; Bone::COUNT] = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let mesh = figure.skin.as_ref().expect("the mannequin has a skin");
    let mut frames = || rig::frames(&figure, &pose(&figure, &mut seeded));
    each(c, "palette", &mut frames, |frames| Palette::new(frames, &rest));
    let palette = || Palette::new(&frames(), &rest);
    each(c, &format!("skin positions, {} vertices", mesh.vertex_count()), palette, |palette| {
        rig::skin_positions(mesh, palette)
    });
    let palette = || Palette::new(&frames(), &rest);
    each(c, &format!("skin normals, {} vertices", mesh.vertex_count()), palette, |palette| {
        rig::skin_normals(mesh, palette)
    });
    let (bounds, palette) = (SkinBounds::new(mesh), || Palette::new(&frames(), &rest));
    each(c, "bounds of the posed skin", palette, |palette| bounds.posed(palette));
}

fn gestures(c: &mut Criterion) {
    let (figure, mut seeded) = (figure(), Seeded(6));
    let drag = || {
        let pose = standing(&figure, &mut seeded);
        let palm = rig::evaluate(&figure, &pose, true).limbs[Limb::LeftArm.index()].articulator;
        let point = palm + seeded.direction() * seeded.between(0.0, 0.05);
        (pose, Target { space: Space::World, point })
    };
    each(c, "reach", drag, |(pose, target)| rig::reach(&figure, pose, Limb::LeftArm, *target, true));
    let mut seeded = Seeded(7);
    let lean = || (in_contact(&figure, &mut seeded), seeded.between(-5.0, 5.0));
    each(c, "turn of the hips, hands and feet in contact", lean, |(pose, degrees)| {
        rig::turn(&figure, pose, Bone::Hips, Dof::Twist, *degrees, true)
    });
    let mut seeded = Seeded(8);
    let lean = || (in_contact(&figure, &mut seeded), seeded.between(-5.0, 5.0));
    each(c, "turn of the chest, hands and feet in contact", lean, |(pose, degrees)| {
        rig::turn(&figure, pose, Bone::Chest, Dof::Flexion, *degrees, true)
    });
}

criterion_group! {
    name = whole_figure;
    config = sampling::many_short();
    targets = plain, derived, skin, gestures
}
criterion_main!(whole_figure);
