//! What is dragged stays under the pointer: a grabbed point within a pixel, a hinge on its arc.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;
mod stage;

use edit::{Command, Event, Hold, Knob, Modifiers, Request};
use glam::{Vec2, vec2};
use rig::{Bone, Camera, Limb, Projection, Reacher, Space};
use seeded::Seeded;
use stage::{Table, figure};

fn table() -> Table {
    Table::new(figure())
}

/// Cameras from all sides, near and far, with and without perspective.
fn cameras(seeded: &mut Seeded) -> Camera {
    let mut camera = Camera { target: glam::Vec3::new(0.0, 1.0, 0.0), ..Camera::default() };
    camera.orbit(seeded.between(-3.1, 3.1) as f32, seeded.between(-1.2, 1.2) as f32);
    camera.distance = seeded.between(1.5, 5.0) as f32;
    if seeded.unit() < 0.3 {
        camera.projection = Projection::Orthographic;
    }
    camera
}

#[test]
fn a_dragged_articulator_stays_within_a_pixel_of_the_pointer_while_in_reach() {
    let mut seeded = Seeded(11);
    let mut table = table();
    let (mut compared, mut reachable) = (0, 0);
    let ends = [
        (Bone::LeftHand, Limb::LeftArm),
        (Bone::RightHand, Limb::RightArm),
        (Bone::LeftLowerArm, Limb::LeftArm),
        (Bone::RightLowerLeg, Limb::RightLeg),
        (Bone::LeftFoot, Limb::LeftLeg),
    ];
    let first = table.pose();
    for _ in 0..400 {
        table.sight.camera = cameras(&mut seeded);
        table.selected = None;
        let (bone, limb) = ends[(seeded.unit() * 5.0) as usize];
        let joint = table.pixel(table.editor.evaluation().frames[bone].position);
        let at = joint + Vec2::new(seeded.between(-30.0, 30.0) as f32, seeded.between(-30.0, 30.0) as f32);
        table.tell(Event::Moved(at));
        if table.hands.under().mark.is_some() || table.hands.hovered() != Some(bone) {
            continue;
        }
        table.tell(Event::Pressed(at));
        for _ in 0..5 {
            let by = Vec2::new(seeded.between(-90.0, 90.0) as f32, seeded.between(-90.0, 90.0) as f32);
            table.tell(Event::Moved(at + by));
            let Reacher::Point(on, point) = table.pose().limb(limb).reacher else { continue };
            if !table.editor.in_gesture() {
                continue;
            }
            let place = table.editor.evaluation().frames[on].point(point);
            // Where the pointer is at the depth of the first place; within both limits and the ranges it is met.
            compared += 1;
            let met = || {
                let (figure, sight) = (table.editor.figure(), table.sight);
                let frames = rig::frames(figure, &first);
                let mut grabbed = first.clone();
                grabbed.limbs[limb.index()].reacher = Reacher::Point(on, point);
                let from = frames[on].point(point);
                let mut drag = edit::Drag::begin(from, &sight.camera, sight.ray(at));
                let goal = drag.point(sight.ray(at + by), Modifiers::default());
                let goal = rig::Target { space: Space::World, point: goal };
                let pose = rig::reach(figure, &grabbed, limb, goal, true).unwrap().pose;
                rig::articulator_in(figure, &pose, limb, Space::World).distance(goal.point) < 1e-6
            };
            if met() {
                reachable += 1;
                let off = table.pixel(place).distance(at + by);
                assert!(off < 1.0, "{bone}: {off} pixels off");
            }
        }
        table.tell(Event::Cancel);
        table.tell(Event::Released);
    }
    assert!(reachable > 150 && compared >= reachable, "{reachable} of {compared}");
}

#[test]
fn the_hinge_goes_round_its_arc_with_the_pointer_however_the_limb_holds() {
    for limb in Limb::ALL {
        for contact in [Hold::Free, Hold::Point, Hold::Planted] {
            let mut table = table();
            table.sight.camera.pitch_rad = 0.6;
            let keep = Command::Keep { limb, contact, space: Space::World };
            assert!(table.submit(Request::Do(keep)));
            let hinge = limb.parts().hinge;
            table.selected = Some(hinge);
            let at = table.knob(Knob::Elevation(limb));
            table.hold(at, vec2(6.0, -7.0));
            let turned = table.hands.turned().unwrap();
            let [low, high] = turned.range_rad.unwrap();
            let angle = turned.angle_rad.clamp(low, high);
            let is = table.editor.evaluation().frames[hinge].position;
            let off = turned.circle.angle_of(is) - angle;
            assert!(angle.abs() > 0.01 && off.abs() < 1e-6, "{limb:?} {contact:?}: {off} off at {angle}");
        }
    }
}
