//! Mends weights: poses the half mesh at the ends of its ranges and evens the weights out wherever a triangle is turned
//! inside out or nearly so, until none is left.

use glam::DVec3;
use rig::{Angles, Bone, Mesh, Palette, Skeleton, bone_of_place, spread_twist};

use super::buried::Depths;
use super::faults::{askew, squeezed};
use super::nets::Surface;
use super::rings::Rings;
use super::stances::{Stance, extremes, relaxed};
use super::weights::{Shares, rounded};

/// Rounds after which the rest stays as it is.
const ROUNDS: usize = 260;
/// Rings of neighbours around a turned triangle over which weights are evened out.
const REACH: usize = 3;
/// Rounds after which that is one ring more: what does not come right within some border needs a wider one.
const WIDER: usize = 12;
/// A triangle that keeps less than this part of its area counts as turned.
const LEAST: f32 = 0.015;

/// What mending could not mend.
#[derive(Clone, Debug, Default)]
pub struct Remains {
    /// Rounds that it took.
    pub rounds: usize,
    /// Poses, how many triangles each still turns, and where one of them is at rest.
    pub turned: Vec<(String, usize, DVec3)>,
}

impl Remains {
    /// Tells on the console what is left, if anything.
    pub fn tell(&self) {
        for (pose, count, place) in &self.turned {
            println!("after {} rounds {pose} turns {count} triangles, one at {place:.3}", self.rounds);
        }
    }
}

/// Evens out the shares of a half mesh where poses ask for it.
pub fn relax(half: &Surface, normals: &[DVec3], skeleton: &Skeleton, shares: &mut [Shares]) -> Remains {
    let rings = Rings::new(half);
    let held = middles(half, skeleton, shares);
    let mut mesh = bare(half, normals);
    dress(&mut mesh, half, skeleton, shares);
    let depths = Depths::new(&whole(&mesh));
    let poses: Vec<(Stance, Palette)> =
        training(skeleton).into_iter().filter_map(|stance| depths.freed(skeleton, stance)).collect();
    // A triangle of a crease that lies askew at rest is none of a weight's business.
    let mut upright = vec![true; half.triangles.len()];
    askew(&mesh).into_iter().for_each(|t| upright[t] = false);
    let mut open: Vec<usize> = (0..poses.len()).collect();
    let mut remains = Remains::default();
    for round in 0..ROUNDS {
        remains.rounds = round;
        dress(&mut mesh, half, skeleton, shares);
        let all = open.len() == poses.len();
        let turned: Vec<(usize, Vec<usize>)> = open
            .iter()
            .map(|&i| (i, squeezed(&mesh, &poses[i].1, LEAST)))
            .map(|(i, turned)| (i, turned.into_iter().filter(|t| upright[*t]).collect()))
            .filter(|(_, turned): &(usize, Vec<usize>)| !turned.is_empty())
            .collect();
        if turned.is_empty() && all {
            return remains;
        }
        // Now and then all poses are tried again: mending one may have harmed another.
        open = if round % 8 == 7 || turned.is_empty() {
            (0..poses.len()).collect()
        } else {
            turned.iter().map(|t| t.0).collect()
        };
        let mut marked = vec![false; half.points.len()];
        for triangle in turned.iter().flat_map(|t| &t.1) {
            half.triangles[*triangle].iter().for_each(|v| marked[*v as usize] = true);
        }
        let strength = rings.spread(&marked, REACH + round / WIDER);
        for _ in 0..3 {
            rings.even(shares, |v| if held[v] { 0.0 } else { 0.7 * strength[v] });
        }
        if round + 1 == ROUNDS {
            let place = |t: &Vec<usize>| half.points[half.triangles[t[0]][0] as usize];
            remains.turned =
                turned.iter().map(|(i, t)| (poses[*i].0.name.clone(), t.len(), place(t))).collect();
        }
    }
    remains
}

/// The poses to try: the left half's extremes from rest; around the shoulder from hanging arms, too; legs together and
/// the right one alone, which pulls at the skin between them.
fn training(skeleton: &Skeleton) -> Vec<Stance> {
    // Cones stand in the figure file; without it, nothing but single extremes is known.
    let ranges = interchange::figure::bare_mannequin().map_or_else(|_| skeleton.clone(), |f| f.skeleton);
    let mut all = extremes(&ranges, &[Angles::REST; Bone::COUNT], 1);
    let moves = |s: &Stance, bones: &[Bone]| bones.iter().any(|b| s.name.starts_with(b.name()));
    let collar = [Bone::LeftShoulder, Bone::UpperChest, Bone::Neck];
    all.extend(extremes(&ranges, &relaxed(), 1).into_iter().filter(|s| moves(s, &collar)));
    let twins = [Bone::LeftUpperLeg, Bone::LeftShoulder];
    for stance in all.clone().into_iter().filter(|s| moves(s, &twins)) {
        for both in [false, true] {
            let mut other = stance.clone();
            for bone in twins {
                other.angles[bone.mirrored().index()] = stance.angles[bone.index()];
                if !both {
                    other.angles[bone.index()] = Angles::REST;
                }
            }
            other.name = format!("{} {}", if both { "both" } else { "right" }, stance.name);
            all.push(other);
        }
    }
    all
}

/// The vertices that follow nothing but the middle of a limb's segment: they stay as they are, so that no joint's blend
/// runs into the next one's.
fn middles(half: &Surface, skeleton: &Skeleton, shares: &[Shares]) -> Vec<bool> {
    let segments = [
        (Bone::LeftUpperArm, Bone::LeftLowerArm),
        (Bone::LeftLowerArm, Bone::LeftHand),
        (Bone::LeftUpperLeg, Bone::LeftLowerLeg),
        (Bone::LeftLowerLeg, Bone::LeftFoot),
    ];
    let held = |v: usize| {
        segments.iter().any(|&(bone, next)| {
            let [from, to] = [bone, next].map(|b| skeleton.rest_position(b));
            let along = (half.points[v] - from).dot(to - from) / (to - from).length_squared();
            shares[v][bone.index()] > 0.9 && (0.38..0.68).contains(&along)
        })
    };
    (0..half.points.len()).map(held).collect()
}

/// The half mesh without weights.
fn bare(half: &Surface, normals: &[DVec3]) -> Mesh {
    Mesh {
        positions: half.points.iter().map(|p| p.as_vec3().to_array()).collect(),
        normals: normals.iter().map(|n| n.as_vec3().to_array()).collect(),
        indices: half.triangles.iter().flatten().copied().collect(),
        ..Mesh::default()
    }
}

/// The half and its mirror image, not joined.
fn whole(half: &Mesh) -> Mesh {
    let first = half.positions.len() as u32;
    let mut whole = half.clone();
    let twin = |place: u8| bone_of_place(usize::from(place)).mirrored().index() as u8;
    whole.positions.extend(half.positions.iter().map(|[x, y, z]| [-x, *y, *z]));
    whole.joints.extend(half.joints.iter().map(|j| j.map(twin)));
    whole.weights.extend_from_slice(&half.weights);
    whole.indices.extend(half.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]].map(|v| first + v)));
    whole
}

/// Gives the mesh those shares, as they will be shipped and loaded.
fn dress(mesh: &mut Mesh, half: &Surface, skeleton: &Skeleton, shares: &[Shares]) {
    let rows = shares.iter().zip(&half.points);
    (mesh.joints, mesh.weights) = rows.map(|(shares, p)| rounded(shares, skeleton, *p)).unzip();
    spread_twist(mesh, skeleton);
}
