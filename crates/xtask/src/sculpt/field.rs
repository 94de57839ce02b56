//! The body as one field: shapes in parts, parts joined softly, fingers and toes kept from each other.

use std::collections::HashMap;

use glam::DVec3;

use super::blend::{FAR, soft_max, soft_min};
use super::shape::{Bounds, Shape};

/// What a shape does to the part that it belongs to.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Op {
    /// Adds the solid.
    Add,
    /// Takes the solid away.
    Cut,
    /// Raises the skin within the solid by so many metres at its core, fading to none at its border; below 0 lowers it.
    Swell(f64),
}

/// One shape within a part.
#[derive(Clone, Debug)]
pub struct Blob {
    /// Adds or cuts.
    pub op: Op,
    /// Width of the blend with what came before, metres.
    pub blend: f64,
    /// Rounds the crease that a shape beside the middle plane makes with its twin, metres.
    pub crease: f64,
    /// The solid.
    pub shape: Shape,
}

/// The anatomical parts, which also say which bones may move them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Region {
    /// Pelvis to collar.
    Torso,
    /// Neck and head.
    Head,
    /// Ear.
    Ear,
    /// Shoulder to wrist.
    Arm,
    /// The palm.
    Palm,
    /// Thumb 0 to little finger 4.
    Finger(u8),
    /// Hip to ankle.
    Leg,
    /// The foot without its toes.
    Foot,
    /// Big toe 0 to little toe 4.
    Toe(u8),
}

/// Shapes that belong together.
#[derive(Clone, Debug)]
pub struct Part {
    /// Which part of the body.
    pub region: Region,
    /// Width of the blend with the rest of the body, metres.
    pub blend: f64,
    /// The shapes, in the order in which they apply.
    pub blobs: Vec<Blob>,
}

impl Region {
    /// Fingers and toes blend with what carries them, hardly with each other: their group and the web's width there.
    fn digits(self) -> Option<(usize, f64)> {
        match self {
            Region::Finger(0) => Some((0, 0.0)),
            Region::Finger(_) => Some((1, 0.0015)),
            Region::Toe(_) => Some((2, 0.004)),
            _ => None,
        }
    }
}

/// The whole figure; only its left half (x of 0 and more) is described, the right one is its mirror image.
#[derive(Debug)]
pub struct Field {
    parts: Vec<Part>,
    bounds: Vec<Vec<Bounds>>,
}

/// The shapes that matter within some box: part number and shape numbers.
pub type Active = Vec<(usize, Vec<usize>)>;

impl Field {
    /// A field of parts; digits must come after what carries them.
    pub fn new(parts: Vec<Part>) -> Field {
        // A swell ends at its solid's surface, a blend reaches further.
        let reach = |part: &Part, b: &Blob| match b.op {
            Op::Swell(_) => b.crease + 1e-4,
            Op::Add | Op::Cut => 2.0 * (b.blend.max(part.blend)) + b.crease + 0.004,
        };
        let bounds = parts
            .iter()
            .map(|part| part.blobs.iter().map(|b| b.shape.bounds().grown(reach(part, b))).collect())
            .collect();
        Field { parts, bounds }
    }

    /// The parts.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// A box around everything that is solid, blends included.
    pub fn extent(&self) -> Bounds {
        let all = self.bounds.iter().flatten().copied().reduce(|a, b| a.union(&b));
        all.unwrap_or(Bounds { low: DVec3::ZERO, high: DVec3::ZERO })
    }

    /// Every shape.
    pub fn everything(&self) -> Active {
        self.parts.iter().enumerate().map(|(i, p)| (i, (0..p.blobs.len()).collect())).collect()
    }

    /// Those of `among` that matter within a box.
    pub fn near(&self, among: &Active, within: &Bounds) -> Active {
        let touches = |part: usize, blob: usize| self.bounds[part][blob].gap(within) <= 0.0;
        let mut kept = Vec::new();
        for (part, blobs) in among {
            let blobs: Vec<usize> = blobs.iter().copied().filter(|&b| touches(*part, b)).collect();
            if !blobs.is_empty() {
                kept.push((*part, blobs));
            }
        }
        kept
    }

    fn part_distance(&self, part: usize, blobs: &[usize], p: DVec3) -> f64 {
        let mut d = FAR;
        for &i in blobs {
            let blob = &self.parts[part].blobs[i];
            let mut q = p;
            if blob.crease > 0.0 {
                q.x = (p.x * p.x + blob.crease * blob.crease).sqrt();
            }
            d = match blob.op {
                Op::Add => soft_min(d, blob.shape.distance(q), blob.blend),
                Op::Cut => soft_max(d, -blob.shape.distance(q), blob.blend),
                Op::Swell(height) => d - height * blob.shape.core(q),
            };
        }
        d
    }

    /// The field at a point by the shapes that matter there. The sign of x does not matter.
    pub fn value(&self, active: &Active, p: DVec3) -> f64 {
        let p = DVec3::new(p.x.abs(), p.y, p.z);
        let mut body = FAR;
        // Thumb, fingers, toes: distance and blend with what carries them.
        let mut digits = [(FAR, 0.0); 3];
        for (part, blobs) in active {
            let d = self.part_distance(*part, blobs, p);
            let Part { region, blend, .. } = self.parts[*part];
            match region.digits() {
                Some((group, web)) => digits[group] = (soft_min(digits[group].0, d, web), blend),
                None => body = soft_min(body, d, blend),
            }
        }
        digits.iter().fold(body, |all, (d, blend)| all.min(soft_min(body, *d, *blend)))
    }

    /// The distance to each part alone, in the order of [`Field::parts`].
    pub fn part_distances(&self, p: DVec3) -> Vec<f64> {
        let p = DVec3::new(p.x.abs(), p.y, p.z);
        let all = |i: usize| (0..self.parts[i].blobs.len()).collect::<Vec<_>>();
        (0..self.parts.len()).map(|i| self.part_distance(i, &all(i), p)).collect()
    }

    /// Value and gradient from four samples on a tetrahedron around the point.
    pub fn slope(&self, active: &Active, p: DVec3) -> (f64, DVec3) {
        const STEP: f64 = 0.0003;
        let mut value = 0.0;
        let mut slope = DVec3::ZERO;
        for corner in [
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, 1.0, 1.0),
        ] {
            let v = self.value(active, p + corner * STEP);
            value += 0.25 * v;
            slope += corner * (v * 0.25 / STEP);
        }
        (value, slope)
    }
}

/// Side of the boxes for which the shapes that matter are remembered, metres.
pub const BLOCK: f64 = 0.0128;

/// A field with the shapes that matter remembered box by box.
#[derive(Debug)]
pub struct Lookup<'a> {
    /// The field itself.
    pub field: &'a Field,
    blocks: HashMap<[i32; 3], Active>,
    everything: Active,
}

impl<'a> Lookup<'a> {
    /// Remembers the given blocks; elsewhere every shape is asked.
    pub fn new(field: &'a Field, blocks: HashMap<[i32; 3], Active>) -> Lookup<'a> {
        Lookup { field, blocks, everything: field.everything() }
    }

    fn active(&self, p: DVec3) -> &Active {
        let key = [p.x.abs(), p.y, p.z].map(|c| (c / BLOCK).floor() as i32);
        self.blocks.get(&key).unwrap_or(&self.everything)
    }

    /// The field at a point.
    pub fn value(&self, p: DVec3) -> f64 {
        self.field.value(self.active(p), p)
    }

    /// The outward unit normal at a point of the surface.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        let slope = self.field.slope(self.active(p), p).1;
        let flat = if p.x == 0.0 { DVec3::new(0.0, slope.y, slope.z) } else { slope };
        flat.try_normalize().unwrap_or(DVec3::Y)
    }

    /// The nearest place on the surface by Newton steps of at most 3 mm, and the unit normal where the last one began;
    /// a point on the middle plane stays on it.
    pub fn settle(&self, start: DVec3, steps: usize) -> (DVec3, DVec3) {
        let mut p = start;
        let mut normal = DVec3::Y;
        for _ in 0..steps {
            let (value, mut slope) = self.field.slope(self.active(p), p);
            if start.x == 0.0 {
                slope.x = 0.0;
            }
            let steep = slope.length_squared();
            if steep < 1e-4 {
                break;
            }
            normal = slope / steep.sqrt();
            p -= (slope * (value / steep)).clamp_length_max(0.003);
        }
        (p, normal)
    }
}
