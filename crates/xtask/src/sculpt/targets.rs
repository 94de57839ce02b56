//! Morph targets: where the neutral skin's vertices go for each end of the physique's sliders.
//!
//! A vertex goes down or up the slope of the other body's field until it stands as it stood in the neutral one; in
//! between the shifts are evened out along the surface, so that triangles keep their shape.

use std::collections::{BTreeMap, HashMap};

use glam::DVec3;
use rig::{Bone, Mesh, MorphTarget, MorphTargets, Skeleton};

use super::body;
use super::field::{Active, BLOCK, Field};
use super::physique::Physique;
use super::shape::Bounds;

/// The ends of the sliders by the names of their targets.
const ENDS: [(&str, Physique); 8] = [
    ("male", Physique { sex: -1.0, ..Physique::NEUTRAL }),
    ("female", Physique { sex: 1.0, ..Physique::NEUTRAL }),
    ("slender", Physique { build: -1.0, ..Physique::NEUTRAL }),
    ("heavy", Physique { build: 1.0, ..Physique::NEUTRAL }),
    ("slight", Physique { muscle: -1.0, ..Physique::NEUTRAL }),
    ("muscular", Physique { muscle: 1.0, ..Physique::NEUTRAL }),
    ("child", Physique { age: -1.0, ..Physique::NEUTRAL }),
    ("old", Physique { age: 1.0, ..Physique::NEUTRAL }),
];

/// Shifts that settle below this are none, metres.
const LEAST: f64 = 1e-4;
/// Rounds of settling, and the longest step of one, metres.
const ROUNDS: usize = 18;
const STEP: f64 = 0.005;
/// A step below this is none, and no shift is written that is, metres.
const ARRIVED: f64 = 1e-7;
/// Rounds of unfolding, and after how many the region that is evened out grows by a ring.
const UNFOLDING: usize = 300;
const WIDER: usize = 40;
/// How near to the middle plane a vertex beside it may come, metres.
const BESIDE: f64 = 2e-4;

/// The morph targets of the neutral skin, one thread each; the same skin gives the same bits.
pub fn targets(skin: &Mesh, skeleton: &Skeleton) -> MorphTargets {
    let half = &Half::new(skin);
    let neutral = &body::field(skeleton, &Physique::NEUTRAL);
    std::thread::scope(|scope| {
        let running = ENDS.map(|(name, physique)| {
            let make = move || half.between(neutral, &body::field(skeleton, &physique));
            (name, scope.spawn(make))
        });
        let made = running.into_iter().map(|(name, thread)| {
            (name.to_owned(), thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        });
        made.collect()
    })
}

/// The left half of a skin without the eyes, as numbers into the whole.
pub(super) struct Half {
    /// The vertices' numbers in the skin, and those of their mirror images.
    whole: Vec<(u32, u32)>,
    places: Vec<DVec3>,
    rings: Vec<Vec<u32>>,
    triangles: Vec<[u32; 3]>,
}

impl Half {
    /// The left half of a skin that mirrors itself bit for bit.
    pub(super) fn new(skin: &Mesh) -> Half {
        // -0 and 0 are one place.
        let key = |x: f32, p: &[f32; 3]| [(x + 0.0).to_bits(), p[1].to_bits(), p[2].to_bits()];
        let by_place: HashMap<[u32; 3], u32> =
            skin.positions.iter().enumerate().map(|(i, p)| (key(p[0], p), i as u32)).collect();
        let eye = |v: usize| {
            let bone = Bone::ALL.get(usize::from(skin.joints[v][0]));
            skin.weights[v][0] == u16::MAX && matches!(bone, Some(Bone::LeftEye | Bone::RightEye))
        };
        let mut half =
            Half { whole: Vec::new(), places: Vec::new(), rings: Vec::new(), triangles: Vec::new() };
        let mut own: BTreeMap<u32, u32> = BTreeMap::new();
        for (v, p) in skin.positions.iter().enumerate().filter(|(v, p)| p[0] >= 0.0 && !eye(*v)) {
            let twin = by_place.get(&key(-p[0], p)).copied().unwrap_or(v as u32);
            own.insert(v as u32, half.whole.len() as u32);
            half.whole.push((v as u32, twin));
            half.places.push(DVec3::from(p.map(f64::from)));
        }
        half.rings = vec![Vec::new(); half.whole.len()];
        for t in skin.indices.chunks_exact(3) {
            let [Some(a), Some(b), Some(c)] = [t[0], t[1], t[2]].map(|v| own.get(&v).copied()) else {
                continue;
            };
            half.triangles.push([a, b, c]);
            for (v, w) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
                if !half.rings[v as usize].contains(&w) {
                    half.rings[v as usize].push(w);
                }
            }
        }
        half
    }

    /// Where each vertex stands in a field: 0 but for what the mesh rounds off.
    fn levels(&self, field: &Field) -> Vec<f64> {
        let mut near = Near::new(field);
        self.places.iter().map(|p| near.slope(*p).0).collect()
    }

    /// What takes a skin that was made of one field to another.
    pub(super) fn between(&self, neutral: &Field, field: &Field) -> MorphTarget {
        let levels = self.levels(neutral);
        let mut near = Near::new(field);
        let mut shifts = vec![DVec3::ZERO; self.places.len()];
        // Most vertices have arrived at once and are asked again only when evening out moves them.
        let mut arrived = vec![false; shifts.len()];
        for round in 0..ROUNDS {
            for v in 0..shifts.len() {
                if !arrived[v] {
                    let step = self.step(&mut near, v, shifts[v], levels[v]);
                    shifts[v] += step;
                    arrived[v] = step.length() < ARRIVED;
                }
            }
            if arrived.iter().all(|a| *a) {
                break;
            }
            // The last rounds only settle.
            if round + 4 < ROUNDS {
                self.even_out(&mut shifts, &mut arrived);
            }
        }
        shifts.iter_mut().filter(|s| s.length() < LEAST).for_each(|s| *s = DVec3::ZERO);
        self.unfold(&mut shifts);
        self.written(&shifts)
    }

    /// One damped step toward the vertex's level in a field.
    fn step(&self, near: &mut Near<'_>, v: usize, shift: DVec3, level: f64) -> DVec3 {
        let start = self.places[v];
        let p = start + shift;
        let (value, mut slope) = near.slope(p);
        if start.x == 0.0 {
            slope.x = 0.0;
        }
        let steep = slope.length_squared();
        if steep < 0.04 {
            return DVec3::ZERO;
        }
        let mut step = (slope * ((level - value) / steep)).clamp_length_max(STEP);
        if start.x > 0.0 {
            let least = start.x.min(BESIDE);
            step.x = step.x.max(least - p.x);
        }
        step
    }

    /// Brings each shift half way to the mean of its neighbours', along the surface only.
    fn even_out(&self, shifts: &mut [DVec3], arrived: &mut [bool]) {
        let normals = self.normals(shifts);
        let before = shifts.to_vec();
        for (v, shift) in shifts.iter_mut().enumerate().filter(|(v, _)| !self.rings[*v].is_empty()) {
            let change = 0.5 * (self.mean(&before, v) - before[v]);
            let mut along = change - normals[v] * change.dot(normals[v]);
            if self.places[v].x == 0.0 {
                along.x = 0.0;
            }
            *shift += along;
            arrived[v] &= along.length() < ARRIVED;
        }
    }

    /// The mean shift around a vertex; on the middle plane what lies beyond mirrors what is here.
    fn mean(&self, shifts: &[DVec3], v: usize) -> DVec3 {
        let ring = &self.rings[v];
        let mut mean = ring.iter().map(|w| shifts[*w as usize]).sum::<DVec3>() / ring.len().max(1) as f64;
        if self.places[v].x == 0.0 {
            mean.x = 0.0;
        }
        mean
    }

    fn normals(&self, shifts: &[DVec3]) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.places.len()];
        for triangle in &self.triangles {
            let face = self.face(triangle, shifts);
            triangle.iter().for_each(|v| sums[*v as usize] += face);
        }
        for (sum, place) in sums.iter_mut().zip(&self.places) {
            if place.x == 0.0 {
                sum.x = 0.0;
            }
            *sum = sum.normalize_or_zero();
        }
        sums
    }

    fn face(&self, triangle: &[u32; 3], shifts: &[DVec3]) -> DVec3 {
        let [a, b, c] = triangle.map(|v| self.places[v as usize] + shifts[v as usize]);
        (b - a).cross(c - a)
    }

    /// Where triangles have turned over or leant far, brings the shifts around them together until none has.
    fn unfold(&self, shifts: &mut [DVec3]) {
        let rest = vec![DVec3::ZERO; shifts.len()];
        for round in 0..UNFOLDING {
            let folded = |t: &&[u32; 3]| {
                let (was, is) = (self.face(t, &rest), self.face(t, shifts));
                was.dot(is) < 0.3 * was.length() * is.length() || is.length() < 0.05 * was.length()
            };
            let mut around: Vec<u32> = self.triangles.iter().filter(folded).flatten().copied().collect();
            if around.is_empty() {
                return;
            }
            // What does not come right within some border needs a wider one.
            for _ in 0..=round / WIDER {
                let wider: Vec<u32> = around.iter().flat_map(|v| &self.rings[*v as usize]).copied().collect();
                around.extend(wider);
                around.sort_unstable();
                around.dedup();
            }
            let before = shifts.to_vec();
            for v in around {
                shifts[v as usize] = 0.5 * before[v as usize] + 0.5 * self.mean(&before, v as usize);
            }
        }
    }

    /// Both sides' shifts. All that unfolding left is written: leaving the smallest out would fold again.
    fn written(&self, shifts: &[DVec3]) -> MorphTarget {
        let mut target = MorphTarget::new();
        for (&(v, twin), shift) in self.whole.iter().zip(shifts).filter(|(_, s)| s.length() >= ARRIVED) {
            let [x, y, z] = shift.as_vec3().to_array();
            target.push((v, [x, y, z]));
            if twin != v {
                target.push((twin, [-x, y, z]));
            }
        }
        target.sort_unstable_by_key(|(v, _)| *v);
        target
    }
}

/// A field with the shapes that matter remembered where it was asked.
struct Near<'a> {
    field: &'a Field,
    everything: Active,
    blocks: HashMap<[i32; 3], Active>,
}

impl<'a> Near<'a> {
    fn new(field: &'a Field) -> Near<'a> {
        Near { field, everything: field.everything(), blocks: HashMap::new() }
    }

    fn active(&mut self, p: DVec3) -> &Active {
        let key = [p.x.abs(), p.y, p.z].map(|c| (c / BLOCK).floor() as i32);
        let (field, everything) = (self.field, &self.everything);
        self.blocks.entry(key).or_insert_with(|| {
            let low = DVec3::from(key.map(f64::from)) * BLOCK;
            field.near(everything, &Bounds { low, high: low + DVec3::splat(BLOCK) }.grown(0.1 * BLOCK))
        })
    }

    fn slope(&mut self, p: DVec3) -> (f64, DVec3) {
        let field = self.field;
        field.slope(self.active(p), p)
    }
}
