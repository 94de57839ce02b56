//! Writes where every labelled control is, so that a test can move a real pointer to it.

use std::path::Path;

use egui::accesskit::TreeUpdate;
use rig::{Camera, Projection};
use serde_json::{Value, json};

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
pub fn write(path: &Path, frame: u64, session: &Session, tree: &TreeUpdate, pixels_per_point: f32) {
    let scale = f64::from(pixels_per_point);
    let controls: Vec<Value> = tree
        .nodes
        .iter()
        .filter_map(|(_, node)| {
            let (label, at) = (node.label()?, node.bounds()?);
            let rect = [at.x0, at.y0, at.x1, at.y1].map(|v| v * scale);
            let role = format!("{:?}", node.role());
            Some(json!({ "role": role, "label": label, "rect": rect, "value": node.numeric_value() }))
        })
        .collect();
    let place = |at: egui::Pos2| [f64::from(at.x) * scale, f64::from(at.y) * scale];
    let editor = session.editor();
    let joints: serde_json::Map<String, Value> = editor
        .figure()
        .skeleton
        .joints()
        .filter_map(|joint| {
            let at = session.viewport.window_of(editor.evaluation().frames[joint.bone].position)?;
            Some((joint.bone.name().to_owned(), json!(place(at))))
        })
        .collect();
    let targets: serde_json::Map<String, Value> = rig::Limb::ALL
        .into_iter()
        .filter_map(|limb| {
            let at = session.viewport.window_of(editor.evaluation().limbs[limb.index()].target)?;
            Some((limb.name().to_owned(), json!(place(at))))
        })
        .collect();
    let handles: serde_json::Map<String, Value> = session
        .viewport
        .handle_places(editor, session.panels.selected())
        .into_iter()
        .map(|(name, at)| (name, json!(place(at))))
        .collect();
    let rect = session.viewport.rect();
    let map = json!({
        "frame": frame,
        "handles": handles,
        "camera": camera(&session.viewport.camera),
        "picture": { "from": place(rect.min), "to": place(rect.max) },
        "pose": rig::write_pose(editor.figure(), editor.pose()),
        "title": session.title(),
        "status": session.status().message,
        "controls": controls,
        "joints": joints,
        "targets": targets,
    });
    if let Err(failure) = disk::write_atomic(path, map.to_string().as_bytes()) {
        log::error!("{failure}");
    }
}
