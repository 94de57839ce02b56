//! Keypoints as the JSON that the OpenPose program writes: version 1.3, BODY_25, 21 points a hand, no face.

use glam::{DVec3, Vec2};
use render::Keypoints;
use rig::Camera;
use serde::Serialize;

use crate::failure::Failure;

/// One file: what is seen in one picture.
#[derive(Serialize)]
struct File {
    version: f32,
    people: Vec<Person>,
    /// The picture's size, pixels: editors of such files look for it.
    canvas_width: u32,
    canvas_height: u32,
}

/// Triples of x, y and confidence in pixels; fours of x, y, z and confidence in metres.
#[derive(Serialize)]
struct Person {
    person_id: [i32; 1],
    pose_keypoints_2d: Vec<f64>,
    face_keypoints_2d: [f64; 0],
    hand_left_keypoints_2d: Vec<f64>,
    hand_right_keypoints_2d: Vec<f64>,
    pose_keypoints_3d: Vec<f64>,
    face_keypoints_3d: [f64; 0],
    hand_left_keypoints_3d: Vec<f64>,
    hand_right_keypoints_3d: Vec<f64>,
}

/// The file's text. A point outside the picture, or that the figure lacks, is 0 0 with confidence 0, as OpenPose writes
/// what it doesn't see; in three dimensions only what the figure lacks is.
///
/// # Errors
/// None in practice: the numbers are finite.
pub fn keypoints_text(people: &[Keypoints], camera: &Camera, size: [u32; 2]) -> Result<String, Failure> {
    let flat = |points: &[Option<DVec3>]| points.iter().flat_map(|p| in_picture(*p, camera, size)).collect();
    let deep = |points: &[Option<DVec3>]| points.iter().flat_map(|p| in_world(*p)).collect();
    let person = |points: &Keypoints| {
        let body = points.body_25();
        Person {
            person_id: [-1],
            pose_keypoints_2d: flat(&body),
            face_keypoints_2d: [],
            hand_left_keypoints_2d: flat(&points.left_hand),
            hand_right_keypoints_2d: flat(&points.right_hand),
            pose_keypoints_3d: deep(&body),
            face_keypoints_3d: [],
            hand_left_keypoints_3d: deep(&points.left_hand),
            hand_right_keypoints_3d: deep(&points.right_hand),
        }
    };
    let people = people.iter().map(person).collect();
    let file = File { version: 1.3, people, canvas_width: size[0], canvas_height: size[1] };
    let text = serde_json::to_string(&file).map_err(|e| Failure::Input(e.to_string()))?;
    Ok(text + "\n")
}

/// Pixels from the top left corner, y down, to a thousandth.
fn in_picture(point: Option<DVec3>, camera: &Camera, size: [u32; 2]) -> [f64; 3] {
    let room = Vec2::new(size[0] as f32, size[1] as f32);
    let seen = point.and_then(|p| camera.pixel_of(p.as_vec3(), room));
    let inside = |at: &Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(room).all();
    let round = |pixel: f32| (f64::from(pixel) * 1000.0).round() / 1000.0;
    seen.filter(inside).map_or([0.0; 3], |at| [round(at.x), round(at.y), 1.0])
}

/// Metres in the world, +Y up, to a micrometre.
fn in_world(point: Option<DVec3>) -> [f64; 4] {
    let round = |metres: f64| (metres * 1e6).round() / 1e6;
    point.map_or([0.0; 4], |p| [round(p.x), round(p.y), round(p.z), 1.0])
}

#[cfg(test)]
mod tests {
    use rig::{Bone, View};
    use serde_json::Value;

    use super::*;
    use crate::load;
    use crate::picture::keypoints::Landmarks;

    #[test]
    fn joints_are_where_the_camera_projects_them() {
        let figure = load::figure(None).unwrap();
        let pose = load::standing(&figure);
        let evaluation = rig::evaluate(&figure, &pose, true);
        let points = Landmarks::of(&figure).keypoints(&evaluation);
        let size = [640, 400];
        let camera = Camera { distance: 2.4, ..Camera::default().seen_from(View::ThreeQuarter) };
        let text = keypoints_text(&[points], &camera, size).unwrap();
        let file: Value = serde_json::from_str(&text).unwrap();
        assert!((file["version"].as_f64().unwrap() - 1.3).abs() < 1e-6 && file["canvas_width"] == 640);
        let person = &file["people"][0];
        let lengths =
            ["pose_keypoints_2d", "hand_left_keypoints_2d", "hand_right_keypoints_2d", "face_keypoints_2d"]
                .map(|key| person[key].as_array().unwrap().len());
        assert_eq!(lengths, [75, 63, 63, 0]);
        let mut outside = 0;
        for (place, bone) in [
            (3, Bone::RightLowerArm),
            (4, Bone::RightHand),
            (7, Bone::LeftHand),
            (9, Bone::RightUpperLeg),
            (13, Bone::LeftLowerLeg),
            (14, Bone::LeftFoot),
        ] {
            let at = evaluation.frames[bone].position;
            let seen = camera.pixel_of(at.as_vec3(), Vec2::new(640.0, 400.0)).unwrap();
            let number = |key: &str, i: usize| person[key][i].as_f64().unwrap();
            let [x, y, sure] = [0, 1, 2].map(|i| number("pose_keypoints_2d", 3 * place + i));
            if (0.0..=400.0).contains(&seen.y) {
                assert!(
                    (x - f64::from(seen.x)).hypot(y - f64::from(seen.y)) < 0.01 && sure == 1.0,
                    "{bone:?}"
                );
            } else {
                outside += 1;
                assert_eq!([x, y, sure], [0.0; 3], "{bone:?}");
            }
            let deep = DVec3::from([0, 1, 2].map(|i| number("pose_keypoints_3d", 4 * place + i)));
            assert!((deep - at).length() < 2e-6, "{bone:?}: outside the picture it is still in the world");
        }
        assert_eq!(outside, 1, "the camera leaves the feet out");
    }
}
