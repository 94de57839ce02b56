//! A skin to bytes.

use rig::{Bone, Mesh, MorphTarget, MorphTargets, Skeleton, bone_of_place};
use serde_json::{Value, json};

use super::container::join;

/// A skin as a binary glTF file: joints as nodes of their VRM names, one mesh, one skin.
///
/// Colours are rounded to 16 bits, twist places give their weights back to their bones; everything else is kept bit for
/// bit. The mesh should have no [`Mesh::fault`]; of a faulty one whole vertices and triangles are written. A mesh without
/// triangles gives a file of joints alone.
pub fn write(mesh: &Mesh, skeleton: &Skeleton, name: &str) -> Vec<u8> {
    write_with_targets(mesh, &MorphTargets::new(), skeleton, name)
}

/// A skin as [`write()`] does, with morph targets in the order of their names: sparse, of places alone. Vertices that
/// the mesh lacks are left out.
pub fn write_with_targets(mesh: &Mesh, targets: &MorphTargets, skeleton: &Skeleton, name: &str) -> Vec<u8> {
    let mut file = File { bones: skeleton.joints().map(|j| j.bone).collect(), ..File::default() };
    let nodes = file.nodes(skeleton);
    let hips = json!(nodes.len() - file.bones.len());
    let mut root = json!({
        "asset": {"version": "2.0", "generator": "Posewright"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [hips]}],
    });
    let mut nodes = nodes;
    if let Some(mut primitive) = file.primitive(mesh) {
        if !targets.is_empty() {
            let list = targets.values().map(|t| json!({"POSITION": file.target(t, mesh.vertex_count())}));
            primitive["targets"] = list.collect();
        }
        let binds = file.inverse_binds(skeleton);
        let joints: Vec<usize> = (1..=file.bones.len()).collect();
        root["meshes"] = json!([{"name": name, "primitives": [primitive]}]);
        if !targets.is_empty() {
            root["meshes"][0]["weights"] = json!(vec![0; targets.len()]);
            root["meshes"][0]["extras"] = json!({"targetNames": targets.keys().collect::<Vec<_>>()});
        }
        root["skins"] =
            json!([{"name": name, "inverseBindMatrices": binds, "joints": joints, "skeleton": 1}]);
        root["materials"] = json!([{
            "name": "skin",
            "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.75},
        }]);
        root["scenes"][0]["nodes"] = json!([0, hips]);
        root["accessors"] = Value::Array(file.accessors);
        root["bufferViews"] = Value::Array(file.views);
        root["buffers"] = json!([{"byteLength": file.data.len()}]);
        nodes[0] = json!({"name": name, "mesh": 0, "skin": 0});
    } else {
        nodes[0] = json!({"name": name});
        root["scenes"][0]["nodes"] = json!([0, hips]);
    }
    root["nodes"] = Value::Array(nodes);
    join(root.to_string().as_bytes(), &file.data)
}

#[derive(Default)]
struct File {
    bones: Vec<Bone>,
    data: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

const ARRAY: u32 = 34962;
const ELEMENTS: u32 = 34963;
const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

impl File {
    /// The mesh's node (filled in later), then one a joint.
    fn nodes(&self, skeleton: &Skeleton) -> Vec<Value> {
        let place = |bone: Bone| self.bones.iter().position(|&b| b == bone).map(|i| i + 1);
        let mut nodes = vec![Value::Null];
        for joint in skeleton.joints() {
            let children: Vec<usize> = skeleton
                .joints()
                .filter(|j| j.carrier == Some(joint.bone))
                .filter_map(|j| place(j.bone))
                .collect();
            let offset = joint.offset.as_vec3().to_array();
            let mut node = json!({"name": joint.bone.name(), "translation": offset});
            if !children.is_empty() {
                node["children"] = json!(children);
            }
            nodes.push(node);
        }
        nodes
    }

    /// Appends rows as one view; returns its number.
    fn view<const N: usize>(&mut self, rows: impl ExactSizeIterator<Item = [u8; N]>) -> usize {
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        let start = self.data.len();
        rows.for_each(|row| self.data.extend(row));
        self.views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": self.data.len() - start}));
        self.views.len() - 1
    }

    /// Appends rows as one view and one accessor; returns the accessor's number.
    fn put<const N: usize>(
        &mut self,
        rows: impl ExactSizeIterator<Item = [u8; N]>,
        (component, kind): (u32, &str),
        target: Option<u32>,
    ) -> usize {
        let count = rows.len();
        let view = self.view(rows);
        if let Some(target) = target {
            self.views[view]["target"] = json!(target);
        }
        let accessor = json!({"bufferView": view, "componentType": component, "count": count, "type": kind});
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn primitive(&mut self, mesh: &Mesh) -> Option<Value> {
        let columns = [mesh.normals.len(), mesh.colors.len(), mesh.joints.len(), mesh.weights.len()];
        let n = columns.into_iter().fold(mesh.positions.len(), usize::min);
        let triangles: Vec<u32> = mesh
            .indices
            .chunks_exact(3)
            .filter(|t| t.iter().all(|&i| (i as usize) < n))
            .flatten()
            .copied()
            .collect();
        if triangles.is_empty() {
            return None;
        }
        let (low, high) = extent(&mesh.positions[..n]);
        let places = self.put(mesh.positions[..n].iter().map(floats), (F32, "VEC3"), Some(ARRAY));
        self.accessors[places]["min"] = json!(low);
        self.accessors[places]["max"] = json!(high);
        let normals = self.put(mesh.normals[..n].iter().map(floats), (F32, "VEC3"), Some(ARRAY));
        let colors = self.put(mesh.colors[..n].iter().map(color), (U16, "VEC4"), Some(ARRAY));
        self.accessors[colors]["normalized"] = json!(true);
        let places_of = self.joint_places();
        let rows: Vec<_> = (0..n).map(|i| by_joint(&places_of, mesh.joints[i], mesh.weights[i])).collect();
        let joints = self.put(rows.iter().map(|row| row.0), (U8, "VEC4"), Some(ARRAY));
        let weights = self.put(rows.iter().map(|row| shorts(&row.1)), (U16, "VEC4"), Some(ARRAY));
        self.accessors[weights]["normalized"] = json!(true);
        // The largest short means "start anew" to some hardware, so it isn't used.
        let indices = if n <= usize::from(u16::MAX) {
            let rows = triangles.iter().map(|&i| (i as u16).to_le_bytes());
            self.put(rows, (U16, "SCALAR"), Some(ELEMENTS))
        } else {
            self.put(triangles.iter().map(|i| i.to_le_bytes()), (U32, "SCALAR"), Some(ELEMENTS))
        };
        Some(json!({
            "attributes": {
                "POSITION": places, "NORMAL": normals, "COLOR_0": colors, "JOINTS_0": joints, "WEIGHTS_0": weights,
            },
            "indices": indices,
            "material": 0,
        }))
    }

    /// A morph target as a sparse accessor. One that moves nothing writes down that the first vertex stays: readers
    /// want either a view or a sparse part.
    fn target(&mut self, target: &MorphTarget, n: usize) -> usize {
        let mut moved: Vec<(u32, [f32; 3])> =
            target.iter().filter(|(v, _)| (*v as usize) < n).copied().collect();
        if moved.is_empty() {
            moved.push((0, [0.0; 3]));
        }
        // What is left out is zero, so zero belongs to the extent.
        let deltas: Vec<[f32; 3]> = moved.iter().map(|m| m.1).chain([[0.0; 3]]).collect();
        let (low, high) = extent(&deltas);
        let (at, kind) = if n <= usize::from(u16::MAX) {
            (self.view(moved.iter().map(|m| (m.0 as u16).to_le_bytes())), U16)
        } else {
            (self.view(moved.iter().map(|m| m.0.to_le_bytes())), U32)
        };
        let values = self.view(moved.iter().map(|m| floats(&m.1)));
        self.accessors.push(json!({
            "componentType": F32, "count": n, "type": "VEC3", "min": low, "max": high,
            "sparse": {
                "count": moved.len(),
                "indices": {"bufferView": at, "componentType": kind},
                "values": {"bufferView": values},
            },
        }));
        self.accessors.len() - 1
    }

    /// The skin's number for each bone; a bone that the skeleton lacks takes its carrier's.
    fn joint_places(&self) -> [u8; Bone::COUNT] {
        let mut places = [0; Bone::COUNT];
        for bone in Bone::ALL {
            let own = self.bones.iter().position(|&b| b == bone);
            places[bone.index()] = own.map_or(places[bone.carrier().index()], |i| i as u8);
        }
        places
    }

    fn inverse_binds(&mut self, skeleton: &Skeleton) -> usize {
        let bones = self.bones.clone();
        let rows = bones.iter().map(|&bone| {
            let t = -skeleton.rest_position(bone).as_vec3();
            let m = glam::Mat4::from_translation(t).to_cols_array();
            let mut row = [0; 64];
            row.chunks_exact_mut(4).zip(m).for_each(|(slot, x)| slot.copy_from_slice(&x.to_le_bytes()));
            row
        });
        self.put(rows, (F32, "MAT4"), None)
    }
}

/// A vertex's weights by the skin's joints: each joint once, though its bone may have a twist place beside it.
fn by_joint(places_of: &[u8; Bone::COUNT], joints: [u8; 4], weights: [u16; 4]) -> ([u8; 4], [u16; 4]) {
    let (mut out_joints, mut out_weights) = ([0; 4], [0_u16; 4]);
    for k in (0..4).filter(|&k| weights[k] > 0) {
        let joint = places_of[bone_of_place(usize::from(joints[k])).index()];
        let slot = (0..k).find(|&i| out_weights[i] > 0 && out_joints[i] == joint).unwrap_or(k);
        out_joints[slot] = joint;
        out_weights[slot] = out_weights[slot].saturating_add(weights[k]);
    }
    (out_joints, out_weights)
}

fn floats(v: &[f32; 3]) -> [u8; 12] {
    let [x, y, z] = v.map(f32::to_le_bytes);
    std::array::from_fn(|i| [x, y, z][i / 4][i % 4])
}

fn shorts(v: &[u16; 4]) -> [u8; 8] {
    let rows = v.map(u16::to_le_bytes);
    std::array::from_fn(|i| rows[i / 2][i % 2])
}

fn color(v: &[f32; 3]) -> [u8; 8] {
    let [r, g, b] = v.map(|c| (c.clamp(0.0, 1.0) * 65535.0).round() as u16);
    shorts(&[r, g, b, u16::MAX])
}

fn extent(points: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let fold = |pick: fn(f32, f32) -> f32, start: f32| {
        std::array::from_fn(|c| points.iter().fold(start, |m, p| pick(m, p[c])))
    };
    (fold(f32::min, f32::INFINITY), fold(f32::max, f32::NEG_INFINITY))
}
