//! COLLADA: the triangles of its scene, in metres, with the colours of its materials.

mod primitives;

use std::collections::BTreeMap;
use std::str::FromStr;

use glam::{DMat4, DQuat, DVec3};
use rig::{Solid, UNPAINTED};
use roxmltree::{Document, Node, ParsingOptions};

use super::triangles::{Triangles, linear};
use primitives::Placed;

/// The most nodes of a scene that are visited: nodes may stand for others many times over.
const MAX_NODES: usize = 100_000;
/// The deepest nesting of elements that is read.
const MAX_DEPTH: usize = 256;

/// Reads the scene that the file shows, or all geometries of a file without one.
pub(super) fn read(bytes: &[u8]) -> Result<Solid, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())?;
    shallow(text)?;
    let options = ParsingOptions { nodes_limit: 1 << 22, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text.trim_start_matches('\u{feff}'), options)
        .map_err(|e| format!("not COLLADA: {e}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(format!("not COLLADA: the root element is <{}>", root.tag_name().name()));
    }
    let by_id = document.descendants().filter_map(|n| Some((n.attribute("id")?, n))).collect();
    let mut scene = Scene { document: &document, by_id, triangles: Triangles::default() };
    let unit = DMat4::from_scale(DVec3::splat(scene.metres_per_unit()?));
    let visual = child(root, "scene").and_then(|s| scene.link(child(s, "instance_visual_scene")?, "url"));
    let visual = visual.or_else(|| document.descendants().find(|n| n.has_tag_name_of("visual_scene")));
    match visual {
        Some(visual) => scene.nodes(visual, unit)?,
        None => {
            for geometry in document.descendants().filter(|n| n.has_tag_name_of("geometry")) {
                scene.geometry(geometry, unit, &BTreeMap::new())?;
            }
        }
    }
    Ok(scene.triangles.solid())
}

/// Refuses elements nested without end before the reader recurses into them.
fn shallow(text: &str) -> Result<(), String> {
    let mut depth = 0_usize;
    let bytes = text.as_bytes();
    for (i, byte) in bytes.iter().enumerate() {
        match (byte, bytes.get(i + 1)) {
            (b'<', Some(b'/')) => depth = depth.saturating_sub(1),
            (b'<', Some(b'!' | b'?')) => {}
            (b'<', _) => depth += 1,
            (b'/', Some(b'>')) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_DEPTH {
            return Err(format!("not COLLADA: elements are nested deeper than {MAX_DEPTH}"));
        }
    }
    Ok(())
}

/// Names without their namespaces, which files give in several ways.
trait Tagged {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl Tagged for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

fn children<'a, 'i: 'a>(node: Node<'a, 'i>, name: &'a str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |n| n.has_tag_name_of(name))
}

fn child<'a, 'i: 'a>(node: Node<'a, 'i>, name: &'a str) -> Option<Node<'a, 'i>> {
    children(node, name).next()
}

/// Colours by the names that primitives give their materials.
type Colors<'a> = BTreeMap<&'a str, [f32; 3]>;

/// A file on its way to triangles.
struct Scene<'a, 'i> {
    document: &'a Document<'i>,
    by_id: BTreeMap<&'a str, Node<'a, 'i>>,
    triangles: Triangles,
}

impl<'a, 'i> Scene<'a, 'i> {
    fn fault<T>(&self, node: Node<'_, '_>, message: impl std::fmt::Display) -> Result<T, String> {
        let spot = self.document.text_pos_at(node.range().start);
        Err(format!("{}:{}: <{}>: {message}", spot.row, spot.col, node.tag_name().name()))
    }

    /// What an attribute such as `url="#id"` names.
    fn link(&self, node: Node<'a, 'i>, attribute: &str) -> Option<Node<'a, 'i>> {
        self.by_id.get(node.attribute(attribute)?.strip_prefix('#')?).copied()
    }

    /// The numbers in the text of an element.
    fn numbers<T: FromStr>(&self, node: Node<'_, '_>) -> Result<Vec<T>, String> {
        let text = node.text().unwrap_or_default();
        let numbers: Result<Vec<T>, _> = text.split_ascii_whitespace().map(str::parse).collect();
        numbers.or_else(|_| self.fault(node, "expected numbers"))
    }

    fn metres_per_unit(&self) -> Result<f64, String> {
        let unit = child(self.document.root_element(), "asset").and_then(|asset| child(asset, "unit"));
        let Some((unit, metres)) = unit.and_then(|unit| Some((unit, unit.attribute("meter")?))) else {
            return Ok(1.0);
        };
        match metres.trim().parse::<f64>() {
            Ok(metres) if metres > 0.0 && metres.is_finite() => Ok(metres),
            _ => self.fault(unit, format!("meter=\"{metres}\", expected a number above 0")),
        }
    }

    /// Adds the geometries of a scene's nodes and of those that they stand for.
    fn nodes(&mut self, scene: Node<'a, 'i>, unit: DMat4) -> Result<(), String> {
        let mut open: Vec<(Node<'a, 'i>, DMat4)> = vec![(scene, unit)];
        let mut visited = 0;
        while let Some((node, outer)) = open.pop() {
            visited += 1;
            if visited > MAX_NODES {
                return self.fault(node, format!("the scene has more than {MAX_NODES} nodes"));
            }
            let here = outer * self.transform(node)?;
            for part in node.children().filter(Node::is_element) {
                match part.tag_name().name() {
                    "node" => open.push((part, here)),
                    "instance_node" => open.extend(self.link(part, "url").map(|n| (n, here))),
                    "instance_geometry" => {
                        if let Some(geometry) = self.link(part, "url") {
                            let colors = self.colors(part);
                            self.geometry(geometry, here, &colors)?;
                        }
                    }
                    "instance_controller" => self.controller(part, here)?,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// A skinned mesh as it is bound.
    fn controller(&mut self, instance: Node<'a, 'i>, here: DMat4) -> Result<(), String> {
        let skin = self.link(instance, "url").and_then(|c| child(c, "skin"));
        let Some((skin, geometry)) = skin.and_then(|skin| Some((skin, self.link(skin, "source")?))) else {
            return Ok(());
        };
        let bound = match child(skin, "bind_shape_matrix") {
            Some(matrix) => self.matrix(matrix)?,
            None => DMat4::IDENTITY,
        };
        let colors = self.colors(instance);
        self.geometry(geometry, here * bound, &colors)
    }

    fn matrix(&self, node: Node<'_, '_>) -> Result<DMat4, String> {
        let rows: Vec<f64> = self.numbers(node)?;
        match <[f64; 16]>::try_from(rows) {
            Ok(rows) => Ok(DMat4::from_cols_array(&rows).transpose()),
            Err(rows) => self.fault(node, format!("{} numbers, expected 16", rows.len())),
        }
    }

    /// A node's own transform: the product of its parts in their order.
    fn transform(&self, node: Node<'a, 'i>) -> Result<DMat4, String> {
        let mut product = DMat4::IDENTITY;
        for part in node.children().filter(Node::is_element) {
            let name = part.tag_name().name();
            let next = match name {
                "matrix" => self.matrix(part)?,
                "translate" | "scale" | "rotate" => match (name, self.numbers(part)?.as_slice()) {
                    ("translate", &[x, y, z]) => DMat4::from_translation(DVec3::new(x, y, z)),
                    ("scale", &[x, y, z]) => DMat4::from_scale(DVec3::new(x, y, z)),
                    ("rotate", &[x, y, z, degrees]) => {
                        let axis = DVec3::new(x, y, z).try_normalize();
                        let turn = |axis| DQuat::from_axis_angle(axis, f64::to_radians(degrees));
                        DMat4::from_quat(axis.map_or(DQuat::IDENTITY, turn))
                    }
                    (_, found) => {
                        return self.fault(part, format!("{} numbers, expected 3 or 4", found.len()));
                    }
                },
                _ => continue,
            };
            product *= next;
        }
        Ok(product)
    }

    /// The colours of the materials that an instance binds.
    fn colors(&self, instance: Node<'a, 'i>) -> Colors<'a> {
        let bound = instance.descendants().filter(|n| n.has_tag_name_of("instance_material"));
        let color = |n: Node<'a, 'i>| Some((n.attribute("symbol")?, self.color(self.link(n, "target")?)?));
        bound.filter_map(color).collect()
    }

    /// The diffuse colour of a material, if it has one and no texture.
    fn color(&self, material: Node<'a, 'i>) -> Option<[f32; 3]> {
        let effect = self.link(child(material, "instance_effect")?, "url")?;
        let diffuse = effect.descendants().find(|n| n.has_tag_name_of("diffuse"))?;
        let numbers = self.numbers::<f32>(child(diffuse, "color")?).ok()?;
        let rgb = <[f32; 3]>::try_from(numbers.get(..3)?).ok()?;
        Some(linear(rgb))
    }

    fn geometry(&mut self, geometry: Node<'a, 'i>, here: DMat4, colors: &Colors<'a>) -> Result<(), String> {
        let Some(mesh) = child(geometry, "mesh") else { return Ok(()) };
        for primitive in mesh.children().filter(Node::is_element) {
            let material = primitive.attribute("material");
            let color = material.and_then(|m| colors.get(m)).copied().unwrap_or(UNPAINTED);
            self.primitive(primitive, &Placed::new(here, color))?;
        }
        Ok(())
    }
}
