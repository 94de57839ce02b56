//! Random scripts of a thousand mixed commands: each moves what the gesture table says and keeps what it says.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod bits;
#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use std::sync::Arc;

use bits::bits;
use edit::{At, By, Command, Editor, Files, Goal, Hold, Outcome, Request};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Figure, Limb, Part, Pose, Side, Space, evaluate};
use seeded::Seeded;

struct Memory(String);

impl Files for Memory {
    fn read(&mut self, path: &str) -> Result<String, String> {
        if path == "library.pose.ron" { Ok(self.0.clone()) } else { Err(format!("{path}: no such file")) }
    }
}

fn figure() -> Arc<Figure> {
    Arc::new(interchange::figure::mannequin().unwrap())
}

fn pick<'a, T>(seeded: &mut Seeded, from: &'a [T]) -> &'a T {
    &from[(seeded.unit() * from.len() as f64) as usize]
}

fn random_command(seeded: &mut Seeded, figure: &Figure, pose: &Pose) -> Command {
    let limb = *pick(seeded, &Limb::ALL);
    let arm = *pick(seeded, &[Limb::LeftArm, Limb::RightArm]);
    let by = if seeded.unit() < 0.8 { By::Delta } else { By::To };
    let small = |s: &mut Seeded, d: f64| s.direction() * s.between(0.0, d);
    match (seeded.unit() * 24.0) as usize {
        0..=5 => {
            let joints: Vec<Bone> = figure.skeleton.joints().map(|j| j.bone).collect();
            let large = [
                Bone::Hips,
                Bone::Spine,
                Bone::Chest,
                Bone::LeftUpperArm,
                Bone::LeftLowerArm,
                Bone::LeftHand,
                Bone::RightUpperArm,
                Bone::RightLowerArm,
                Bone::LeftUpperLeg,
                Bone::LeftLowerLeg,
                Bone::LeftFoot,
                Bone::Head,
                Bone::LeftShoulder,
            ];
            let joint = if seeded.unit() < 0.6 { *pick(seeded, &large) } else { *pick(seeded, &joints) };
            let dofs: Vec<Dof> = figure.skeleton.joint(joint).unwrap().dofs().collect();
            Command::Turn { joint, dof: *pick(seeded, &dofs), degrees: seeded.between(-25.0, 25.0), by }
        }
        6..=9 => {
            let to = match (seeded.unit() * 8.0) as usize {
                0 => Goal::Here,
                1 => Goal::World(
                    evaluate(figure, pose, true).limbs[limb.index()].articulator + small(seeded, 0.2),
                ),
                2 => Goal::Body(Bone::Head, DVec3::new(0.0, 0.05, 0.12)),
                3 => Goal::World(seeded.direction() * 2.0),
                _ => Goal::Offset(small(seeded, 0.08)),
            };
            Command::Reach { limb, to }
        }
        10..=11 => Command::Elevate { limb, degrees: seeded.between(-40.0, 40.0), by },
        12..=13 => {
            let dof = *pick(seeded, &Dof::ALL);
            Command::TurnInContact { limb, dof, degrees: seeded.between(-30.0, 30.0), by }
        }
        14 => Command::Articulate {
            limb: arm,
            at: match (seeded.unit() * 4.0) as usize {
                0 => At::Named("indexTip".to_owned()),
                1 => At::Named("palm".to_owned()),
                2 => At::Named("wrist".to_owned()),
                _ if arm == Limb::LeftArm => At::Point(Bone::LeftLowerArm, DVec3::new(0.1, 0.03, 0.0)),
                _ => At::Point(Bone::RightHand, DVec3::new(-0.08, -0.02, 0.01)),
            },
        },
        15..=16 => Command::Keep {
            limb,
            contact: *pick(seeded, &[Hold::Free, Hold::Point, Hold::Planted]),
            space: *pick(
                seeded,
                &[
                    Space::World,
                    Space::Body(Bone::Head),
                    Space::Body(Bone::LeftHand),
                    Space::Body(Bone::Hips),
                ],
            ),
        },
        17 => Command::MoveHips { by: small(seeded, 0.05) },
        18 => Command::Place { by: small(seeded, 0.5), turn: seeded.between(-40.0, 40.0) },
        19 => Command::AimSpine {
            at: DVec3::new(seeded.between(-0.5, 0.5), 2.0, seeded.between(-0.5, 0.8)),
            twist: seeded.between(-20.0, 20.0),
        },
        20 => Command::LookAt { at: seeded.direction() * 3.0 },
        21 => Command::Handshape {
            side: *pick(seeded, &[Side::Left, Side::Right]),
            name: pick(seeded, &["fist", "flat", "point"]).to_string(),
            amount: seeded.unit(),
        },
        22 => match (seeded.unit() * 8.0) as usize {
            0 => Command::Mirror { parts: vec![] },
            1 => Command::Mirror { parts: vec![Part::LeftArm] },
            2 => Command::Reset { parts: vec![*pick(seeded, &Part::ALL)] },
            3 => Command::ApplyPose {
                path: "library.pose.ron".to_owned(),
                parts: vec![],
                amount: 1.0,
                mirrored: false,
            },
            4 => Command::ApplyPose {
                path: "library.pose.ron".to_owned(),
                parts: vec![Part::RightArm],
                amount: 0.5,
                mirrored: true,
            },
            _ => Command::Flip { limb },
        },
        _ => Command::Balance { amount: seeded.unit() },
    }
}

/// The bones whose angles differ.
fn moved(before: &Pose, after: &Pose) -> Vec<Bone> {
    Bone::ALL.into_iter().filter(|b| before.angles(*b) != after.angles(*b)).collect()
}

fn limb_bones(limb: Limb) -> Vec<Bone> {
    let p = limb.parts();
    vec![p.root, p.hinge, p.end]
}

fn in_contact(pose: &Pose, limb: Limb) -> bool {
    pose.limb(limb).contact != Contact::Free
}

/// What a command may move: its own bones, and the joints of limbs in contact.
fn may_move(command: &Command, before: &Pose) -> Option<Vec<Bone>> {
    let mut bones: Vec<Bone> = Vec::new();
    let own = match command {
        Command::Turn { joint, .. } => {
            bones.push(*joint);
            Limb::of(*joint).filter(|l| *joint <= l.parts().end)
        }
        Command::Reach { limb, .. } => {
            let p = limb.parts();
            bones.extend([p.root, p.hinge]);
            if matches!(before.limb(*limb).contact, Contact::Planted { .. }) {
                bones.push(p.end);
            }
            Some(*limb)
        }
        Command::Elevate { limb, .. } => {
            bones.push(limb.parts().root);
            if matches!(before.limb(*limb).contact, Contact::Planted { .. }) {
                bones.extend([limb.parts().end, limb.parts().hinge]);
            }
            Some(*limb)
        }
        Command::TurnInContact { limb, .. } | Command::Flip { limb } => {
            bones.extend(limb_bones(*limb));
            Some(*limb)
        }
        Command::Articulate { .. } | Command::Keep { .. } | Command::Place { .. } => return Some(bones),
        Command::MoveHips { .. } | Command::Balance { .. } => None,
        Command::AimSpine { .. } => {
            bones.extend([Bone::Spine, Bone::Chest, Bone::UpperChest]);
            None
        }
        Command::LookAt { .. } => {
            bones.extend([Bone::Neck, Bone::Head, Bone::LeftEye, Bone::RightEye]);
            None
        }
        Command::Handshape { side, .. } => {
            let part = if *side == Side::Left { Part::LeftHand } else { Part::RightHand };
            bones.extend(Bone::ALL.into_iter().filter(|b| b.part() == part));
            None
        }
        _ => return None,
    };
    for limb in Limb::ALL {
        if Some(limb) != own && in_contact(before, limb) {
            bones.extend(limb_bones(limb));
        }
    }
    Some(bones)
}

/// Whether every joint lies in its range.
fn out_of_range(figure: &Figure, pose: &Pose) -> Option<String> {
    for joint in figure.skeleton.joints() {
        let angles = pose.angles(joint.bone);
        let cone = match &joint.articulation {
            rig::Articulation::Ball { cone, .. } => *cone,
            rig::Articulation::Hinges(_) => None,
        };
        for dof in joint.dofs().filter(|dof| cone.is_none() || *dof == Dof::Twist) {
            let excess = joint.range(dof).unwrap().excess(angles.get(dof)).to_radians();
            if excess > 1e-9 {
                return Some(format!("{} {dof:?} {} is {excess} rad outside", joint.bone, angles.get(dof)));
            }
        }
        if let (Some(cone), Some(bone)) = (cone, joint.bone_direction())
            && !cone.contains(joint.rotation(angles) * bone, 1e-9)
        {
            return Some(format!("{} points outside its cone: {angles:?}", joint.bone));
        }
    }
    None
}

fn check(
    figure: &Figure,
    command: &Command,
    before: &Pose,
    after: &Pose,
    outcome: &Outcome,
) -> Result<(), String> {
    let (was, is) = (evaluate(figure, before, true), evaluate(figure, after, true));
    if is.frames.0.iter().any(|f| !f.position.is_finite() || !f.rotation.is_finite()) {
        return Err("a frame is not finite".to_owned());
    }
    if let Some(allowed) = may_move(command, before)
        && let Some(bone) = moved(before, after).into_iter().find(|b| !allowed.contains(b))
    {
        return Err(format!("{bone} moved: {:?} -> {:?}", before.angles(bone), after.angles(bone)));
    }
    if let Some(fault) = out_of_range(figure, after) {
        return Err(fault);
    }
    // A mirror gives each limb its twin's contact, with whatever that missed.
    let own_limbs: &[Limb] = if matches!(command, Command::Mirror { .. }) { &[] } else { &Limb::ALL };
    for &limb in own_limbs {
        let (w, i) = (&was.limbs[limb.index()], &is.limbs[limb.index()]);
        if in_contact(after, limb) && w.residual < 1e-9 && !outcome.clamped && i.residual > 1e-9 {
            return Err(format!("{} lost its contact by {} m", limb.name(), i.residual));
        }
        if i.rotation_residual > 1e-5 && w.rotation_residual < 1e-7 && !outcome.clamped {
            return Err(format!("{} planted end turned by {} deg", limb.name(), i.rotation_residual));
        }
    }
    let bent = |limb: Limb| {
        let [a, b] = [limb.parts().root, limb.parts().end].map(|bone| was.frames[bone].position);
        (was.frames[limb.parts().hinge].position - a).normalize().cross((b - a).normalize()).length() > 1e-2
    };
    match command {
        Command::Reach { limb, to: Goal::Here } if before != after => {
            Err(format!("{} moved on Here", limb.name()))
        }
        Command::Reach { limb, to: Goal::Offset(_) | Goal::World(_) } if !outcome.clamped => {
            let (w, i) = (&was.limbs[limb.index()], &is.limbs[limb.index()]);
            let kept = |e: f64, f: f64| ((e - f + 180.0).rem_euclid(360.0) - 180.0).abs() < 1e-5;
            match (w.elevation, i.elevation) {
                (Some(e), Some(f))
                    if bent(*limb) && w.residual < 1e-9 && w.rotation_residual < 1e-9 && !kept(e, f) =>
                {
                    Err(format!("{} reached with elevation {e} -> {f}", limb.name()))
                }
                _ => Ok(()),
            }
        }
        Command::Elevate { limb, .. } | Command::TurnInContact { limb, .. } => {
            let (w, i) = (&was.limbs[limb.index()], &is.limbs[limb.index()]);
            let slip = w.articulator.distance(i.articulator);
            let planted_stop = i.rotation_residual > 1e-9 || w.rotation_residual > 1e-9 || w.residual > 1e-9;
            if slip > 1e-9 && !planted_stop {
                return Err(format!("{} slipped {slip} m", limb.name()));
            }
            let planted = matches!(before.limb(*limb).contact, Contact::Planted { .. });
            if let (Command::TurnInContact { .. }, Some(e), Some(f), false) =
                (command, w.elevation, i.elevation, planted)
                && bent(*limb)
                && w.residual < 1e-9
                && ((e - f + 180.0).rem_euclid(360.0) - 180.0).abs() > 1e-5
            {
                return Err(format!("{} elevation {e} -> {f}", limb.name()));
            }
            Ok(())
        }
        Command::Articulate { .. } | Command::Keep { .. } if !moved(before, after).is_empty() => {
            Err("moved".to_owned())
        }
        _ => Ok(()),
    }
}

fn run(seed: u64, count: usize) -> (Vec<Command>, Pose) {
    let figure = figure();
    let mut seeded = Seeded(seed);
    let mut editor = Editor::new(figure.clone());
    let mut files = Memory(include_str!("fixtures/library.pose.ron").to_owned());
    let first = editor.pose().clone();
    let (mut commands, mut rejected) = (Vec::new(), 0);
    while commands.len() < count {
        let command = random_command(&mut seeded, &figure, editor.pose());
        let before = editor.pose().clone();
        match editor.submit(Request::Do(command.clone()), &mut files) {
            Ok(outcome) => {
                if let Err(fault) = check(&figure, &command, &before, editor.pose(), &outcome) {
                    panic!(
                        "seed {seed}, command {}: {}\n{fault}\nlimbs {:?}\n{}",
                        commands.len(),
                        command.text(),
                        before.limbs,
                        rig::write_pose(&figure, &before)
                    );
                }
                commands.push(command);
            }
            Err(_) => {
                assert_eq!(*editor.pose(), before, "a rejected command changed the pose");
                rejected += 1;
            }
        }
    }
    assert!(rejected < count, "{rejected} rejected");
    let last = editor.pose().clone();
    while editor.undo_depth() > 0 {
        editor.submit(Request::Undo, &mut files).unwrap();
    }
    assert_eq!(bits(editor.pose()), bits(&first), "undo of all returns the first state");
    while editor.redo_name().is_some() {
        editor.submit(Request::Redo, &mut files).unwrap();
    }
    assert_eq!(bits(editor.pose()), bits(&last), "redo of all returns the last state");
    (commands, last)
}

#[test]
fn a_thousand_mixed_commands_keep_their_promises() {
    for seed in 0..8 {
        run(seed, 1_000);
    }
}

#[test]
fn the_same_script_gives_the_same_bits() {
    let (commands, last) = run(99, 1_000);
    let (again, last_again) = run(99, 1_000);
    assert_eq!(commands, again);
    assert_eq!(bits(&last), bits(&last_again));
}
