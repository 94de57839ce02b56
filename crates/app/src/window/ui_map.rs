//! Writes where every labelled control is, so that a test can move a real pointer to it.

use std::path::Path;

use egui::accesskit::TreeUpdate;
use rig::{Camera, Projection};
use serde_json::{Map, Value, json};

use super::desk::Desk;
use crate::chains::ChainSession;
use crate::disk;
use crate::session::Session;

/// What a test needs to tell where any point of the world is seen; angles in radians, lengths in metres.
fn camera(camera: &Camera) -> Value {
    json!({
        "target": camera.target.to_array(),
        "yaw": camera.yaw_rad,
        "pitch": camera.pitch_rad,
        "distance": camera.distance,
        "fov": camera.fov_y_rad,
        "perspective": camera.projection == Projection::Perspective,
    })
}

/// Writes the map of a frame; rectangles are `[left, top, right, bottom]` in pixels of the window.
pub fn write(path: &Path, frame: u64, desk: &Desk, tree: &TreeUpdate, pixels_per_point: f32) {
    let scale = f64::from(pixels_per_point);
    let mut map = match desk {
        Desk::Figure(session) => of_figure(session, scale),
        Desk::Chain(session) => of_chain(session, scale),
    };
    map.insert("frame".to_owned(), json!(frame));
    map.insert("title".to_owned(), json!(desk.title()));
    map.insert("status".to_owned(), json!(desk.status()));
    map.insert("controls".to_owned(), controls(tree, scale));
    if let Err(failure) = disk::write_atomic(path, Value::Object(map).to_string().as_bytes()) {
        log::error!("{failure}");
    }
}

/// Every labelled control: its role, label, place and value.
fn controls(tree: &TreeUpdate, scale: f64) -> Value {
    let control = |(_, node): &(_, egui::accesskit::Node)| {
        let (label, at) = (node.label()?, node.bounds()?);
        let rect = [at.x0, at.y0, at.x1, at.y1].map(|v| v * scale);
        let role = format!("{:?}", node.role());
        Some(json!({ "role": role, "label": label, "rect": rect, "value": node.numeric_value() }))
    };
    tree.nodes.iter().filter_map(control).collect()
}

fn place(at: egui::Pos2, scale: f64) -> Value {
    json!([f64::from(at.x) * scale, f64::from(at.y) * scale])
}

fn picture(rect: egui::Rect, scale: f64) -> Value {
    json!({ "from": place(rect.min, scale), "to": place(rect.max, scale) })
}

fn named(places: impl IntoIterator<Item = (String, egui::Pos2)>, scale: f64) -> Value {
    Value::Object(places.into_iter().map(|(name, at)| (name, place(at, scale))).collect())
}

/// The pose, and where joints, targets and handles are.
fn of_figure(session: &Session, scale: f64) -> Map<String, Value> {
    let editor = session.editor();
    let seen = |name: &str, at| Some((name.to_owned(), session.viewport.window_of(at)?));
    let frames = &editor.evaluation().frames;
    let joints = editor.figure().skeleton.joints();
    let joints = joints.filter_map(|joint| seen(joint.bone.name(), frames[joint.bone].position));
    let limbs = rig::Limb::ALL.into_iter();
    let targets = limbs.filter_map(|limb| seen(limb.name(), editor.evaluation().limbs[limb.index()].target));
    let handles = session.viewport.handle_places(editor, session.panels.selected());
    let map = [
        ("pose", json!(rig::write_pose(editor.figure(), editor.pose()))),
        ("joints", named(joints, scale)),
        ("targets", named(targets, scale)),
        ("handles", named(handles, scale)),
        ("camera", camera(&session.viewport.camera)),
        ("picture", picture(session.viewport.rect(), scale)),
        ("walk", walk(session)),
    ];
    map.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()
}

/// What the figure's walk has come to; nothing while the window poses.
fn walk(session: &Session) -> Value {
    let walk = session.walk();
    let Some(place) = walk.place().filter(|_| walk.is_open()) else { return Value::Null };
    json!({
        "place": place.position.to_array(),
        "turn": place.turn,
        "playing": walk.clock.playing,
        "steps": walk.clock.steps(),
    })
}

/// The joints' values in degrees and metres, what is chosen, and where links and handles are.
fn of_chain(session: &ChainSession, scale: f64) -> Map<String, Value> {
    let (editor, robot) = (session.editor(), session.editor().robot());
    let chosen = session.node().joint(robot).map_or("root", |joint| &robot.joints()[joint].name);
    let pose = &editor.document().pose.0;
    let values = robot.dofs().zip(pose).map(|(dof, value)| {
        let name = format!("{} {}", robot.joints()[dof.joint].name, dof.part.name());
        (name, json!(if dof.part.is_angle() { value.to_degrees() } else { *value }))
    });
    let links = robot.links().iter().zip(editor.frames());
    let links = links
        .filter_map(|(link, frame)| Some((link.name.clone(), session.picture.window_of(frame.position)?)));
    let handles = session.picture.handle_places(editor, session.node());
    let map = [
        ("chosen", json!(chosen)),
        ("values", Value::Object(values.collect())),
        ("root", json!(editor.document().world_from_root.position.to_array())),
        ("steps", json!(editor.undo_depth())),
        ("links", named(links, scale)),
        ("handles", named(handles, scale)),
        ("camera", camera(&session.picture.camera)),
        ("picture", picture(session.picture.rect(), scale)),
    ];
    map.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()
}
