//! What the rings of a joint turn: its axes in the world, how far each may turn, and the commands of a turn.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use rig::{Articulation, Bone, Dof, Figure, Frames, Joint, Pose, live_range};

use crate::{By, Command};

/// One degree of freedom of a joint as a turn about an axis, read off a pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Ring {
    /// The joint.
    pub bone: Bone,
    /// The degree of freedom that gives the axis.
    pub dof: Dof,
    /// Unit axis of positive turns, world.
    pub axis_in_world: DVec3,
    /// The angle at which the turn begins, degrees.
    pub start_deg: f64,
    /// How far it may turn from there, radians: down to the first, up to the second.
    pub range_rad: [f64; 2],
    turn: Turn,
}

/// How a turn about the axis becomes angles.
#[derive(Clone, PartialEq, Debug)]
enum Turn {
    /// The angle itself.
    Angle,
    /// All angles of a ball joint.
    Swing(Box<Swing>),
}

/// A ball joint as it was when a turn began.
#[derive(Clone, PartialEq, Debug)]
pub struct Swing {
    joint: Joint,
    world_from_carrier: DQuat,
    world_from_joint: DQuat,
}

impl Swing {
    /// `None` for a joint that is no ball.
    pub fn of(figure: &Figure, pose: &Pose, frames: &Frames, bone: Bone) -> Option<Swing> {
        let joint = figure.skeleton.joint(bone)?;
        matches!(joint.articulation, Articulation::Ball { .. }).then(|| Swing {
            joint: joint.clone(),
            world_from_carrier: world_from_carrier(pose, frames, joint),
            world_from_joint: frames[bone].rotation,
        })
    }

    /// The commands that bring the joint to where a rotation of the world takes it from its start.
    pub fn commands(&self, turned: DQuat) -> Vec<Command> {
        let Articulation::Ball { cone, .. } = &self.joint.articulation else { return Vec::new() };
        let angles = self.angles(turned);
        let turn = |dof: Dof| Command::Turn {
            joint: self.joint.bone,
            dof,
            degrees: angles[dof as usize].to_degrees(),
            by: By::To,
        };
        let once = Dof::ALL.map(turn).to_vec();
        // Inside a cone one angle may have to wait for the other.
        let again = cone.map(|_| [Dof::Flexion, Dof::Abduction].map(turn).to_vec());
        once.into_iter().chain(again.into_iter().flatten()).collect()
    }

    /// The angles there, radians.
    fn angles(&self, turned: DQuat) -> [f64; 3] {
        let Articulation::Ball { ball, .. } = &self.joint.articulation else { return [0.0; 3] };
        ball.angles(self.world_from_carrier.conjugate() * turned * self.world_from_joint)
    }

    /// The interval around 0 of turns about a world axis that keep the joint's ranges, radians. What is outside of
    /// its range may stay there.
    fn interval(&self, axis: DVec3) -> [f64; 2] {
        let Articulation::Ball { ball, ranges, cone } = &self.joint.articulation else { return [-PI, PI] };
        let carrier = self.world_from_carrier.conjugate();
        let local = |angle: f64| carrier * DQuat::from_axis_angle(axis, angle) * self.world_from_joint;
        let bone = self.joint.bone_direction().unwrap_or(ball.twist);
        let begun = ball.angles(local(0.0)).map(f64::to_degrees);
        let cone = cone.map(|cone| cone.reaching((local(0.0) * bone).normalize_or(bone)));
        let inside = |angle: f64| {
            let rotation = local(angle);
            let angles = ball.angles(rotation).map(f64::to_degrees);
            let kept = |i: usize| ranges[i].reaching(begun[i]).excess(angles[i]) <= 1e-9;
            (0..3).all(kept) && cone.is_none_or(|cone| cone.contains(rotation * bone, 1e-12))
        };
        [walk(-PI, &inside), walk(PI, &inside)]
    }
}

impl Ring {
    /// The ring of a degree of freedom in a pose; `None` if the figure's joint lacks it. With `ranges` off it turns
    /// half a turn either way.
    pub fn of(
        figure: &Figure,
        pose: &Pose,
        frames: &Frames,
        bone: Bone,
        dof: Dof,
        ranges: bool,
    ) -> Option<Ring> {
        let joint = figure.skeleton.joint(bone).filter(|joint| joint.has(dof))?;
        let axis_in_world = axis(figure, pose, frames, bone, dof)?;
        let start_deg = pose.angles(bone).get(dof);
        let swing = Swing::of(figure, pose, frames, bone).filter(|_| dof != Dof::Twist);
        let range_rad = match &swing {
            _ if !ranges => [-PI, PI],
            Some(swing) => swing.interval(axis_in_world),
            None => {
                let live = live_range(joint, pose.angles(bone), dof, true);
                [live.min, live.max].map(|end| (end - start_deg).to_radians())
            }
        };
        let turn = swing.map_or(Turn::Angle, |swing| Turn::Swing(Box::new(swing)));
        Some(Ring { bone, dof, axis_in_world, start_deg, range_rad, turn })
    }

    /// What a turn by some radians makes of the angle, degrees.
    pub fn angle_deg(&self, turned_rad: f64) -> f64 {
        match &self.turn {
            Turn::Angle => self.start_deg + turned_rad.to_degrees(),
            Turn::Swing(swing) => {
                let angles = swing.angles(DQuat::from_axis_angle(self.axis_in_world, turned_rad));
                angles[self.dof as usize].to_degrees()
            }
        }
    }

    /// The commands of a turn by some radians, from the pose that the ring was read off.
    pub fn commands(&self, turned_rad: f64) -> Vec<Command> {
        let turned_rad = turned_rad.clamp(self.range_rad[0].min(0.0), self.range_rad[1].max(0.0));
        match &self.turn {
            Turn::Angle => vec![Command::Turn {
                joint: self.bone,
                dof: self.dof,
                degrees: self.start_deg + turned_rad.to_degrees(),
                by: By::To,
            }],
            Turn::Swing(swing) => swing.commands(DQuat::from_axis_angle(self.axis_in_world, turned_rad)),
        }
    }
}

/// The axis of positive turns of a degree of freedom, world: the flexion and abduction of a ball joint in its
/// carrier's frame, its twist about the bone; a hinge where the hinges before it have taken it. `None` if the
/// figure's joint lacks it.
pub fn axis(figure: &Figure, pose: &Pose, frames: &Frames, bone: Bone, dof: Dof) -> Option<DVec3> {
    let joint = figure.skeleton.joint(bone)?;
    let carrier = world_from_carrier(pose, frames, joint);
    match &joint.articulation {
        Articulation::Ball { ball, .. } => Some(match dof {
            Dof::Flexion => carrier * ball.flexion,
            Dof::Abduction => carrier * ball.abduction,
            Dof::Twist => frames[bone].rotation * ball.twist,
        }),
        Articulation::Hinges(hinges) => {
            let mut frame = carrier;
            for hinge in hinges {
                if hinge.dof == dof {
                    return Some(frame * hinge.axis);
                }
                let angle = pose.angles(bone).get(hinge.dof).to_radians();
                frame *= DQuat::from_axis_angle(hinge.axis, angle);
            }
            None
        }
    }
}

fn world_from_carrier(pose: &Pose, frames: &Frames, joint: &Joint) -> DQuat {
    match joint.carrier {
        Some(carrier) => frames[carrier].rotation,
        None => pose.place.world_from_figure().rotation,
    }
}

/// The last angle on the way from 0 to an end that is inside: a degree at a time, then by bisection.
fn walk(end: f64, inside: &dyn Fn(f64) -> bool) -> f64 {
    const DEGREES: u32 = 180;
    let at = |degree: u32| end * f64::from(degree) / f64::from(DEGREES);
    let Some(first) = (1..=DEGREES).find(|degree| !inside(at(*degree))) else { return end };
    let (mut good, mut bad) = (at(first - 1), at(first));
    for _ in 0..40 {
        let middle = 0.5 * (good + bad);
        if inside(middle) { good = middle } else { bad = middle }
    }
    good
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Editor, NoFiles, Request};

    const BENT: &str = r#"(version: 1, place: (position: (0.3, 0.0, -0.2), turn: 40.0), joints: {
        "hips": (twist: 20.0), "chest": (flexion: 10.0, twist: 12.0), "leftShoulder": (abduction: 10.0),
        "leftUpperArm": (flexion: 35.0, abduction: -50.0, twist: 15.0),
        "leftLowerArm": (flexion: 80.0, twist: -70.0), "leftHand": (flexion: 20.0, abduction: 5.0),
        "leftUpperLeg": (flexion: 25.0), "leftLowerLeg": (flexion: 30.0), "leftFoot": (flexion: 5.0),
    })"#;

    fn figure() -> Arc<Figure> {
        Arc::new(interchange::figure::bare_mannequin().unwrap())
    }

    fn editor(figure: &Arc<Figure>) -> Editor {
        let figure = figure.clone();
        let pose = rig::parse_pose(BENT).unwrap().onto(&figure.rest_pose());
        Editor::in_pose(figure, pose)
    }

    fn ring(editor: &Editor, bone: Bone, dof: Dof) -> Option<Ring> {
        Ring::of(editor.figure(), editor.pose(), &editor.evaluation().frames, bone, dof, true)
    }

    #[test]
    fn a_turn_turns_the_bone_about_the_ring_s_axis() {
        let (figure, mut tried) = (figure(), 0);
        for bone in Bone::ALL {
            for (dof, turned) in Dof::ALL.into_iter().flat_map(|dof| [(dof, 0.06), (dof, -0.06)]) {
                let mut editor = editor(&figure);
                let Some(ring) = ring(&editor, bone, dof) else { continue };
                if turned < ring.range_rad[0] || turned > ring.range_rad[1] {
                    continue;
                }
                let before = editor.evaluation().frames[bone].rotation;
                editor.submit(Request::PreviewAll(ring.commands(turned)), &mut NoFiles).unwrap();
                let after = editor.evaluation().frames[bone].rotation;
                let wanted = DQuat::from_axis_angle(ring.axis_in_world, turned) * before;
                assert!(after.angle_between(wanted) < 1e-6, "{bone} {dof:?} {turned}");
                tried += 1;
            }
        }
        assert!(tried > 120, "{tried}");
    }

    #[test]
    fn a_turn_stops_where_the_range_ends_and_the_joint_gets_there() {
        let figure = figure();
        for (bone, dof) in [
            (Bone::LeftLowerArm, Dof::Flexion),
            (Bone::LeftUpperArm, Dof::Flexion),
            (Bone::LeftUpperLeg, Dof::Abduction),
            (Bone::LeftUpperLeg, Dof::Flexion),
            (Bone::Chest, Dof::Twist),
        ] {
            for end in [0, 1] {
                let mut editor = editor(&figure);
                let ring = ring(&editor, bone, dof).unwrap();
                let limit = ring.range_rad[end];
                assert!(limit.abs() < PI, "{bone} {dof:?}");
                let before = editor.evaluation().frames[bone].rotation;
                let far = limit + limit.signum();
                editor.submit(Request::PreviewAll(ring.commands(far)), &mut NoFiles).unwrap();
                let wanted = DQuat::from_axis_angle(ring.axis_in_world, limit) * before;
                let off = editor.evaluation().frames[bone].rotation.angle_between(wanted);
                assert!(off < 2e-5, "{bone} {dof:?}: {off} off at {limit}");
            }
        }
    }

    #[test]
    fn what_a_joint_lacks_has_no_ring() {
        let editor = editor(&figure());
        assert!(ring(&editor, Bone::LeftLowerLeg, Dof::Twist).is_none());
        assert!(ring(&editor, Bone::LeftHand, Dof::Twist).is_none());
        assert!(
            Swing::of(editor.figure(), editor.pose(), &editor.evaluation().frames, Bone::LeftHand).is_none()
        );
    }
}
