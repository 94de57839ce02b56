//! Bytes to a skin.

use glam::{DMat3, DMat4, DVec3};
use gltf::mesh::{Mode, Primitive, Semantic};
use rig::{Bone, Mesh, MorphTargets, Skeleton, nearest};

use super::accessor::{indices, rows};
use super::container::split;
use super::{GlbError, MAX_CORNERS, targets};

/// How far a joint may rest from the skeleton's, metres.
const REST_TOLERANCE: f64 = 1e-3;
/// Below this a change of place or shape is rounding, and the file's own numbers are kept bit for bit.
const ROUNDING: f64 = 1e-6;

/// Reads the skin of a skeleton: every triangle of the file, as it is at rest.
///
/// Joints are told by their nodes' names; a joint that is no bone moves with the bone above it. Meshes without a
/// skin move with the bone that their node hangs on, the hips if none. Colours are those of the vertices times the
/// material's; normals that are missing are made from the triangles. Weights are rounded to fractions of 65,535.
///
/// # Errors
/// Broken files, data outside of the file, numbers that are not finite, joints that hang on no bone or rest more
/// than 1 mm from the skeleton's, a file without triangles.
pub fn read(bytes: &[u8], skeleton: &Skeleton) -> Result<Mesh, GlbError> {
    read_with_targets(bytes, skeleton, &|_| false).map(|(mesh, _)| mesh)
}

/// Reads the skin of a skeleton as [`read`] does, and those of its morph targets that are wanted by name.
///
/// Only what targets do to places is read, in figure space at rest; a target without a name is called `target 0` and
/// so on. Targets of one name in several primitives are one.
///
/// # Errors
/// As [`read`], and the same faults of a wanted target's data.
pub fn read_with_targets(
    bytes: &[u8],
    skeleton: &Skeleton,
    wanted: &dyn Fn(&str) -> bool,
) -> Result<(Mesh, MorphTargets), GlbError> {
    let parts = split(bytes)?;
    let broken = |e: &dyn std::fmt::Display| GlbError::Document(e.to_string());
    let root = gltf::json::Root::from_slice(parts.json).map_err(|e| broken(&e))?;
    // The library's own validation looks these accessors up unchecked.
    let mut primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let attributes =
        primitives.any(|p| p.attributes.values().any(|accessor| accessor.value() >= root.accessors.len()));
    if attributes || !targets::accessors_exist(&root) {
        return Err(broken(&"an attribute names an accessor beyond the last"));
    }
    let document = gltf::Document::from_json(root).map_err(|e| broken(&e))?;
    let tree = Tree::new(&document)?;
    let names = targets::names(parts.json);
    let (mesh, targets) = (Mesh::default(), MorphTargets::new());
    let mut reader = Reader { data: parts.data, skeleton, tree, mesh, names, wanted, targets };
    for node in document.nodes() {
        let Some(mesh) = node.mesh() else { continue };
        let binding = reader.binding(&node)?;
        for primitive in mesh.primitives() {
            reader.primitive(&primitive, &binding, mesh.index())?;
        }
    }
    if reader.mesh.indices.is_empty() {
        return Err(GlbError::Empty);
    }
    Ok((reader.mesh, reader.targets))
}

/// The nodes: whose child each is, where it is, what it is called.
struct Tree {
    parents: Vec<Option<usize>>,
    world: Vec<DMat4>,
    names: Vec<String>,
}

impl Tree {
    fn new(document: &gltf::Document) -> Result<Tree, GlbError> {
        let count = document.nodes().len();
        let mut parents = vec![None; count];
        let mut local = Vec::with_capacity(count);
        let mut names = Vec::with_capacity(count);
        for node in document.nodes() {
            for child in node.children() {
                parents[child.index()] = Some(node.index());
            }
            local.push(DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from))));
            names.push(node.name().map_or_else(|| format!("#{}", node.index()), str::to_owned));
        }
        let mut world: Vec<Option<DMat4>> = vec![None; count];
        for start in 0..count {
            let mut path = Vec::new();
            let mut at = Some(start);
            while let Some(i) = at.filter(|&i| world[i].is_none()) {
                if path.len() > count {
                    return Err(GlbError::Cycle { node: names[start].clone() });
                }
                path.push(i);
                at = parents[i];
            }
            let mut above = at.and_then(|i| world[i]).unwrap_or(DMat4::IDENTITY);
            for i in path.into_iter().rev() {
                above *= local[i];
                if !above.is_finite() {
                    return Err(GlbError::NotFinite { what: format!("the place of node {}", names[i]) });
                }
                world[i] = Some(above);
            }
        }
        let world = world.into_iter().map(|w| w.unwrap_or(DMat4::IDENTITY)).collect();
        Ok(Tree { parents, world, names })
    }

    /// The bone that a node is, or hangs on.
    fn bone(&self, node: usize, skeleton: &Skeleton) -> Option<Bone> {
        let mut at = Some(node);
        // A tree without cycles, so this ends.
        while let Some(i) = at {
            let bone = Bone::from_name(&self.names[i]).filter(|&b| skeleton.joint(b).is_some());
            if bone.is_some() {
                return bone;
            }
            at = self.parents[i];
        }
        None
    }
}

/// A joint of a skin: its bone, or its name if it is and hangs on none, and where it holds vertices at rest.
type Held = (Result<Bone, String>, DMat4);

/// What moves the vertices of a node's mesh, and where it holds them at rest.
enum Binding {
    Skin(Vec<Held>),
    Rigid(Bone, DMat4),
}

struct Reader<'a> {
    data: &'a [u8],
    skeleton: &'a Skeleton,
    tree: Tree,
    mesh: Mesh,
    names: targets::Names,
    wanted: &'a dyn Fn(&str) -> bool,
    targets: MorphTargets,
}

impl Reader<'_> {
    fn binding(&self, node: &gltf::Node<'_>) -> Result<Binding, GlbError> {
        let Some(skin) = node.skin() else {
            let bone = self.tree.bone(node.index(), self.skeleton).unwrap_or(Bone::Hips);
            return Ok(Binding::Rigid(bone, self.tree.world[node.index()]));
        };
        let what = format!("inverse binds of skin {}", skin.index());
        let binds = skin.inverse_bind_matrices().map(|a| rows(&a, self.data, &what)).transpose()?;
        let mut joints = Vec::new();
        for (i, joint) in skin.joints().enumerate() {
            let name = &self.tree.names[joint.index()];
            let bone = self.tree.bone(joint.index(), self.skeleton).ok_or_else(|| name.clone());
            let world = self.tree.world[joint.index()];
            self.check_rest(name, world)?;
            let bind = match &binds {
                None => DMat4::IDENTITY,
                Some(rows) => {
                    let row = rows.get(i).ok_or_else(|| GlbError::OutOfRange {
                        what: format!("joint {i} in the {what}"),
                        len: self.data.len(),
                    })?;
                    DMat4::from_cols_array(&row.map(f64::from))
                }
            };
            let held = world * bind;
            if !held.is_finite() {
                return Err(GlbError::NotFinite { what });
            }
            joints.push((bone, held));
        }
        Ok(Binding::Skin(joints))
    }

    fn check_rest(&self, name: &str, world: DMat4) -> Result<(), GlbError> {
        let Some(bone) = Bone::from_name(name).filter(|&b| self.skeleton.joint(b).is_some()) else {
            return Ok(());
        };
        let (found, expected) = (world.w_axis.truncate(), self.skeleton.rest_position(bone));
        if found.distance(expected) > REST_TOLERANCE {
            let tidy = |v: DVec3| v.to_array().map(|c| (c * 1e5).round() / 1e5);
            return Err(GlbError::Rest { bone, found: tidy(found), expected: tidy(expected) });
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Primitive<'_>,
        binding: &Binding,
        mesh: usize,
    ) -> Result<(), GlbError> {
        let what = &format!("mesh {mesh} primitive {}", primitive.index());
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(());
        }
        let Some(places) = self.column(primitive, &Semantic::Positions, what)? else { return Ok(()) };
        let count = places.len();
        let first = self.mesh.positions.len();
        if first + count > MAX_CORNERS {
            return Err(GlbError::TooLarge { what: what.to_owned(), count: first + count });
        }
        let corners = self.corners(primitive, count, what)?;
        let normals = self.full_column(primitive, &Semantic::Normals, count, what)?;
        let influences = self.influences(primitive, binding, count, what)?;
        let colors = self.full_column(primitive, &Semantic::Colors(0), count, what)?;
        let base = primitive.material().pbr_metallic_roughness().base_color_factor();
        for (i, place) in places.iter().enumerate() {
            let (held, joints, weights) = &influences[i];
            let p = apply(held, xyz(place), 1.0);
            if !p.is_finite() {
                return Err(GlbError::NotFinite { what: format!("{what} position {i}") });
            }
            let n = normals.as_ref().map_or(DVec3::ZERO, |n| turned(held, xyz(&n[i])));
            let tint = colors.as_ref().map_or([1.0; 3], |c| [c[i][0], c[i][1], c[i][2]]);
            let shade = |c: usize| {
                let value = tint[c] * base[c];
                if value.is_finite() { value.clamp(0.0, 1.0) } else { 1.0 }
            };
            self.mesh.positions.push(kept(&place[..3], p));
            self.mesh.normals.push(normals.as_ref().map_or([0.0; 3], |m| kept(&m[i][..3], n)));
            self.mesh.colors.push(std::array::from_fn(shade));
            self.mesh.joints.push(*joints);
            self.mesh.weights.push(*weights);
        }
        let source = (self.data, what.as_str());
        for (name, moved) in targets::wanted(primitive, self.names.get(mesh), self.wanted, count, source)? {
            let target = self.targets.entry(name).or_default();
            for (i, delta) in moved.iter().enumerate().filter(|(_, delta)| **delta != DVec3::ZERO) {
                let own = delta.as_vec3().to_array();
                target.push(((first + i) as u32, kept(&own, apply(&influences[i].0, *delta, 0.0))));
            }
        }
        self.mesh.indices.extend(corners.iter().map(|c| c + first as u32));
        fill_normals(&mut self.mesh, first, &corners);
        Ok(())
    }

    fn column(
        &self,
        primitive: &Primitive<'_>,
        semantic: &Semantic,
        what: &str,
    ) -> Result<Option<Vec<[f32; 16]>>, GlbError> {
        let what = format!("{what} {}", semantic.to_string());
        primitive.get(semantic).map(|a| rows(&a, self.data, &what)).transpose()
    }

    /// A column that must be as long as the positions.
    fn full_column(
        &self,
        primitive: &Primitive<'_>,
        semantic: &Semantic,
        count: usize,
        what: &str,
    ) -> Result<Option<Vec<[f32; 16]>>, GlbError> {
        match self.column(primitive, semantic, what)? {
            Some(rows) if rows.len() != count => Err(GlbError::Unexpected {
                what: format!("the length of {what} {}", semantic.to_string()),
                found: rows.len().to_string(),
                expected: "as many as positions",
            }),
            rows => Ok(rows),
        }
    }

    /// Vertex numbers, three a triangle.
    fn corners(&self, primitive: &Primitive<'_>, count: usize, what: &str) -> Result<Vec<u32>, GlbError> {
        let list = match primitive.indices() {
            Some(accessor) => indices(&accessor, self.data, &format!("{what} indices"))?,
            None => (0..count as u32).collect(),
        };
        if let Some(bad) = list.iter().find(|&&i| i as usize >= count) {
            return Err(GlbError::Unexpected {
                what: format!("an index of {what}"),
                found: bad.to_string(),
                expected: "less than the number of positions",
            });
        }
        let whole = list.len() - list.len() % 3;
        Ok(match primitive.mode() {
            Mode::TriangleStrip => {
                let flip = |(i, w): (usize, &[u32])| {
                    if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] }
                };
                list.windows(3).enumerate().flat_map(flip).collect()
            }
            Mode::TriangleFan => {
                list[1.min(list.len())..].windows(2).flat_map(|w| [list[0], w[0], w[1]]).collect()
            }
            _ => list[..whole].to_vec(),
        })
    }

    /// For each vertex: what it is multiplied by at rest, its bones and their weights.
    fn influences(
        &self,
        primitive: &Primitive<'_>,
        binding: &Binding,
        count: usize,
        what: &str,
    ) -> Result<Vec<Influence>, GlbError> {
        let skin = match binding {
            Binding::Rigid(bone, world) => {
                let row = (*world, [bone.index() as u8, 0, 0, 0], [u16::MAX, 0, 0, 0]);
                return Ok(vec![row; count]);
            }
            Binding::Skin(skin) => skin,
        };
        let mut sets = Vec::new();
        for set in 0..4 {
            let joints = self.full_column(primitive, &Semantic::Joints(set), count, what)?;
            let weights = self.full_column(primitive, &Semantic::Weights(set), count, what)?;
            match joints.zip(weights) {
                Some(pair) => sets.push(pair),
                None => break,
            }
        }
        (0..count).map(|v| influence(&sets, v, skin, what)).collect()
    }
}

/// What holds a vertex at rest, the bones that move it and their weights.
type Influence = (DMat4, [u8; 4], [u16; 4]);

/// Rows of joints and of weights.
type Set = (Vec<[f32; 16]>, Vec<[f32; 16]>);

fn influence(sets: &[Set], v: usize, skin: &[Held], what: &str) -> Result<Influence, GlbError> {
    let mut held = DMat4::ZERO;
    let mut shares = [0.0f64; Bone::COUNT];
    let mut total = 0.0;
    for (joints, weights) in sets {
        for k in 0..4 {
            let weight = f64::from(weights[v][k]);
            if weight.is_nan() || weight <= 0.0 || weight.is_infinite() {
                continue;
            }
            let Some((bone, matrix)) = skin.get(joints[v][k] as usize) else {
                return Err(GlbError::Unexpected {
                    what: format!("a joint of vertex {v} of {what}"),
                    found: joints[v][k].to_string(),
                    expected: "less than the skin's number of joints",
                });
            };
            // A joint above the hips may be listed; only one that pulls must be known.
            let bone = bone.as_ref().map_err(|name| unknown(name))?;
            held += *matrix * weight;
            shares[bone.index()] += weight;
            total += weight;
        }
    }
    if total <= 0.0 {
        // A vertex without weights stays where it is, with the first joint.
        let first =
            skin.first().map(|(bone, matrix)| (bone.as_ref().copied().unwrap_or(Bone::Hips), *matrix));
        let (bone, matrix) = first.unwrap_or((Bone::Hips, DMat4::IDENTITY));
        return Ok((matrix, [bone.index() as u8, 0, 0, 0], [u16::MAX, 0, 0, 0]));
    }
    let (joints, weights) = rounded(&shares);
    Ok((held * (1.0 / total), joints, weights))
}

fn unknown(name: &str) -> GlbError {
    let near = nearest(name, Bone::ALL.iter().map(|b| b.name()));
    GlbError::UnknownJoint { name: name.to_owned(), nearest: near.to_owned() }
}

/// The four largest shares as fractions of 65,535 that sum to it; equal shares in the order of the bones.
fn rounded(shares: &[f64; Bone::COUNT]) -> ([u8; 4], [u16; 4]) {
    let mut order: Vec<usize> = (0..Bone::COUNT).filter(|&i| shares[i] > 0.0).collect();
    order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]).then(a.cmp(b)));
    order.truncate(4);
    let total: f64 = order.iter().map(|&i| shares[i]).sum();
    let (mut joints, mut weights) = ([0u8; 4], [0u16; 4]);
    for (slot, &i) in order.iter().enumerate() {
        joints[slot] = i as u8;
        weights[slot] = (shares[i] / total * 65535.0).round() as u16;
    }
    // The largest takes what rounding left over or took too much: at most 2 of 16,383 or more.
    let others: u32 = weights[1..].iter().map(|&w| u32::from(w)).sum();
    weights[0] = 65535u32.saturating_sub(others) as u16;
    (joints, weights)
}

fn xyz(row: &[f32; 16]) -> DVec3 {
    DVec3::new(f64::from(row[0]), f64::from(row[1]), f64::from(row[2]))
}

fn apply(matrix: &DMat4, v: DVec3, w: f64) -> DVec3 {
    (*matrix * v.extend(w)).truncate()
}

/// A normal through a change of shape: by the inverse transpose, so that it stays square to the surface.
fn turned(matrix: &DMat4, n: DVec3) -> DVec3 {
    let m = DMat3::from_mat4(*matrix);
    let cofactors =
        DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    (cofactors * n).normalize_or_zero()
}

/// The file's own numbers unless they really changed.
fn kept(original: &[f32], changed: DVec3) -> [f32; 3] {
    let old = [original[0], original[1], original[2]];
    let same = changed.to_array().iter().zip(old).all(|(c, o)| (c - f64::from(o)).abs() <= ROUNDING);
    if same { old } else { changed.as_vec3().to_array() }
}

/// Makes the normals that are missing or unusable from the triangles around each vertex, weighted by area.
fn fill_normals(mesh: &mut Mesh, first: usize, corners: &[u32]) {
    let sound = |n: &[f32; 3]| n.iter().all(|c| c.is_finite()) && n.iter().map(|c| c * c).sum::<f32>() > 0.25;
    if mesh.normals[first..].iter().all(sound) {
        return;
    }
    let mut sums = vec![DVec3::ZERO; mesh.positions.len() - first];
    let at = |i: u32| DVec3::from(mesh.positions[first + i as usize].map(f64::from));
    for t in corners.chunks_exact(3) {
        let face = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
        t.iter().for_each(|&i| sums[i as usize] += face);
    }
    for (normal, sum) in mesh.normals[first..].iter_mut().zip(sums) {
        if !sound(normal) {
            *normal = sum.normalize_or(DVec3::Y).as_vec3().to_array();
        }
    }
}
