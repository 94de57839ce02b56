//! The triangles and polygons of one COLLADA geometry.

use glam::{DMat3, DMat4, Vec3};
use roxmltree::Node;

use super::{Scene, child, children};

/// Where a geometry stands and what it is painted with.
pub(super) struct Placed {
    here: DMat4,
    normals: DMat3,
    /// Whether the transform mirrors, so that triangles must turn round to face outward.
    mirrors: bool,
    color: [f32; 3],
}

impl Placed {
    pub fn new(here: DMat4, color: [f32; 3]) -> Placed {
        let linear = DMat3::from_mat4(here);
        let mirrors = linear.determinant() < 0.0;
        // The cofactors turn normals as the inverse transpose does, and exist for flattened meshes, too.
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        Placed { here, normals: if mirrors { -cofactors } else { cofactors }, mirrors, color }
    }
}

/// A list of vectors in the file.
struct Source {
    numbers: Vec<f32>,
    offset: usize,
    stride: usize,
}

impl Source {
    fn vector(&self, index: usize) -> Option<Vec3> {
        let start = index.checked_mul(self.stride)?.checked_add(self.offset)?;
        self.numbers.get(start..start.checked_add(3)?).map(Vec3::from_slice)
    }
}

/// What a primitive's index list is made of.
struct Inputs {
    positions: Source,
    normals: Option<Source>,
    position_at: usize,
    normal_at: usize,
    stride: usize,
}

impl<'a, 'i> Scene<'a, 'i> {
    /// Adds the triangles of a primitive; other elements of a mesh add nothing.
    pub(super) fn primitive(&mut self, node: Node<'a, 'i>, placed: &Placed) -> Result<(), String> {
        let name = node.tag_name().name();
        if !matches!(name, "triangles" | "polylist" | "polygons" | "tristrips" | "trifans") {
            return Ok(());
        }
        let Some(inputs) = self.inputs(node)? else { return Ok(()) };
        let counts: Option<Vec<usize>> = match child(node, "vcount").filter(|_| name == "polylist") {
            Some(vcount) => Some(self.numbers(vcount)?),
            None => None,
        };
        for list in children(node, "p") {
            let indices: Vec<usize> = self.numbers(list)?;
            let corners: Vec<&[usize]> = indices.chunks_exact(inputs.stride).collect();
            for [a, b, c] in faces(name, corners.len(), counts.as_deref()) {
                let (Some(a), Some(b), Some(c)) = (corners.get(a), corners.get(b), corners.get(c)) else {
                    return self.fault(node, "its counts are beyond its indices");
                };
                self.face(node, &inputs, [a, b, c], placed)?;
            }
        }
        Ok(())
    }

    fn face(
        &mut self,
        node: Node<'a, 'i>,
        inputs: &Inputs,
        mut corners: [&[usize]; 3],
        placed: &Placed,
    ) -> Result<(), String> {
        if placed.mirrors {
            corners.swap(1, 2);
        }
        let points = corners.map(|c| inputs.positions.vector(c[inputs.position_at]));
        let [Some(a), Some(b), Some(c)] = points else {
            return self.fault(node, "a corner names a vertex that is not there");
        };
        let points = [a, b, c].map(|p| placed.here.transform_point3(p.as_dvec3()).as_vec3());
        let normals = inputs.normals.as_ref().map(|n| corners.map(|c| n.vector(c[inputs.normal_at])));
        let normals = match normals {
            Some([Some(a), Some(b), Some(c)]) => {
                Some([a, b, c].map(|n| (placed.normals * n.as_dvec3()).normalize_or_zero().as_vec3()))
            }
            _ => None,
        };
        self.triangles.add(points, normals, placed.color)
    }

    /// The inputs of a primitive; `None` if it has no positions.
    fn inputs(&self, node: Node<'a, 'i>) -> Result<Option<Inputs>, String> {
        let (mut positions, mut normals, mut stride) = (None, None, 1);
        for input in children(node, "input") {
            let offset: usize = match input.attribute("offset").unwrap_or("0").trim().parse() {
                Ok(offset) if offset < 64 => offset,
                _ => return self.fault(input, "expected an offset of 0 to 63"),
            };
            stride = stride.max(offset + 1);
            let Some(source) = self.link(input, "source") else { continue };
            match input.attribute("semantic") {
                Some("VERTEX") => {
                    for part in children(source, "input") {
                        let Some(inner) = self.link(part, "source") else { continue };
                        match part.attribute("semantic") {
                            Some("POSITION") => positions = Some((self.source(inner)?, offset)),
                            Some("NORMAL") => normals = Some((self.source(inner)?, offset)),
                            _ => {}
                        }
                    }
                }
                Some("NORMAL") => normals = Some((self.source(source)?, offset)),
                _ => {}
            }
        }
        let Some((positions, position_at)) = positions else { return Ok(None) };
        let (normals, normal_at) = normals.map_or((None, 0), |(source, at)| (Some(source), at));
        Ok(Some(Inputs { positions, normals, position_at, normal_at, stride }))
    }

    fn source(&self, node: Node<'a, 'i>) -> Result<Source, String> {
        let Some(array) = child(node, "float_array") else {
            return self.fault(node, "it has no <float_array>");
        };
        let accessor = child(node, "technique_common").and_then(|t| child(t, "accessor"));
        let number = |name: &str, otherwise: usize| -> Result<usize, String> {
            let Some(text) = accessor.and_then(|a| a.attribute(name)) else { return Ok(otherwise) };
            text.trim().parse().or_else(|_| self.fault(node, format!("{name}=\"{text}\", expected a number")))
        };
        let (stride, offset) = (number("stride", 3)?, number("offset", 0)?);
        Ok(Source { numbers: self.numbers(array)?, offset, stride })
    }
}

/// The corners of the triangles of an index list.
fn faces(name: &str, corners: usize, counts: Option<&[usize]>) -> Vec<[usize; 3]> {
    let fan = |start: usize, count: usize| {
        (1..count.saturating_sub(1))
            .map(move |i| [start, start.saturating_add(i), start.saturating_add(i + 1)])
    };
    match (name, counts) {
        ("triangles", _) => (0..corners / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ("polylist", Some(counts)) => {
            let mut faces = Vec::new();
            let mut start = 0_usize;
            for &count in counts {
                // Beyond the indices one face is enough to say so.
                faces.extend(fan(start, count.min(corners.saturating_sub(start).saturating_add(3))));
                start = start.saturating_add(count);
                if start > corners {
                    break;
                }
            }
            faces
        }
        ("tristrips", _) => (0..corners.saturating_sub(2))
            .map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] })
            .collect(),
        // A polygon is a fan about its first corner.
        _ => fan(0, corners).collect(),
    }
}
