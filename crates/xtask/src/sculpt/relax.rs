//! Mends weights: poses the half mesh at the ends of its ranges and draws the weights together wherever a triangle is
//! turned inside out or nearly so, until none is left.

use glam::DVec3;
use rig::{Angles, Bone, Mesh, Palette, Skeleton, bone_of_place, spread_twist};

use super::blend::mix;
use super::buried::Depths;
use super::faults::{askew, squeezed};
use super::nets::Surface;
use super::rings::Rings;
use super::stances::{Stance, extremes, relaxed, together};
use super::weights::{Shares, rounded};

/// Rounds after which the best so far is kept.
const ROUNDS: usize = 200;
/// After so many rounds all poses are tried, not only those that were bad: mending one may have harmed another.
const AGAIN: usize = 8;
/// A triangle that keeps less than this part of its area counts as turned.
const LEAST: f32 = 0.015;
/// How far a turned triangle's corners are drawn to their mean each round.
const TOGETHER: f64 = 0.6;
/// How far they are then drawn to their neighbours, so that nothing stays ragged.
const EVEN: f64 = 0.12;

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

/// The triangles that each pose turns.
type Turned = Vec<(usize, Vec<usize>)>;

/// Draws the shares of a half mesh together where poses ask for it, as little as will do: a triangle that is turned
/// makes its corners more alike, which makes the next one steeper, until all between them share the burden.
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
    let mut best = (usize::MAX, shares.to_vec(), Turned::new(), 0);
    let mut open: Vec<usize> = (0..poses.len()).collect();
    for round in 0..ROUNDS {
        dress(&mut mesh, half, skeleton, shares);
        let look = |i: &usize| {
            let mut turned = squeezed(&mesh, &poses[*i].1, LEAST);
            turned.retain(|t| upright[*t]);
            (*i, turned)
        };
        let turned: Turned = open.iter().map(look).filter(|t| !t.1.is_empty()).collect();
        let count = turned.iter().map(|t| t.1.len()).sum();
        let all = open.len() == poses.len();
        if all && count < best.0 {
            best = (count, shares.to_vec(), turned.clone(), round);
        }
        if all && count == 0 {
            break;
        }
        let again = round % AGAIN == AGAIN - 2 || turned.is_empty();
        open = if again { (0..poses.len()).collect() } else { turned.iter().map(|t| t.0).collect() };
        draw_together(half, &rings, &held, &turned, shares);
    }
    shares.copy_from_slice(&best.1);
    let place = |t: &[usize]| half.points[half.triangles[t[0]][0] as usize];
    let told = |(i, t): &(usize, Vec<usize>)| (poses[*i].0.name.clone(), t.len(), place(t));
    Remains { rounds: best.3, turned: best.2.iter().map(told).collect() }
}

/// One round: corners of turned triangles toward their means, then a little toward their neighbours.
fn draw_together(half: &Surface, rings: &Rings, held: &[bool], turned: &Turned, shares: &mut [Shares]) {
    let mut triangles: Vec<usize> = turned.iter().flat_map(|t| &t.1).copied().collect();
    triangles.sort_unstable();
    triangles.dedup();
    let mut sums = vec![([0.0; Bone::COUNT], 0.0); half.points.len()];
    for t in triangles {
        let corners = half.triangles[t].map(|v| v as usize);
        let mean: Shares = std::array::from_fn(|b| corners.iter().map(|&v| shares[v][b]).sum::<f64>() / 3.0);
        for v in corners {
            sums[v].0.iter_mut().zip(&mean).for_each(|(sum, mean)| *sum += mean);
            sums[v].1 += 1.0;
        }
    }
    for (v, (sum, count)) in sums.iter().enumerate().filter(|(v, s)| s.1 > 0.0 && !held[*v]) {
        shares[v].iter_mut().zip(sum).for_each(|(share, sum)| *share = mix(*share, sum / count, TOGETHER));
        rings.tidy(v, &mut shares[v]);
    }
    rings.even(shares, |v| if sums[v].1 > 0.0 && !held[v] { EVEN } else { 0.0 });
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
    all.extend(together(&ranges));
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
/// runs into the next one's. So do those between the thighs.
fn middles(half: &Surface, skeleton: &Skeleton, shares: &[Shares]) -> Vec<bool> {
    let segments = [
        (Bone::LeftUpperArm, Bone::LeftLowerArm, 0.40),
        (Bone::LeftLowerArm, Bone::LeftHand, 0.40),
        (Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.54),
        (Bone::LeftLowerLeg, Bone::LeftFoot, 0.40),
    ];
    // Between the thighs there is no room to spread: what is drawn together there pulls at all of the inner thigh.
    let [hip, knee] = [Bone::LeftUpperLeg, Bone::LeftLowerLeg].map(|b| skeleton.rest_position(b));
    let between = |p: DVec3| {
        let along = (p - hip).dot(knee - hip) / (knee - hip).length_squared();
        p.x < 0.7 * hip.x && (0.12..0.62).contains(&along)
    };
    let held = |v: usize| {
        between(half.points[v])
            || segments.iter().any(|&(bone, next, from_here)| {
                let [from, to] = [bone, next].map(|b| skeleton.rest_position(b));
                let along = (half.points[v] - from).dot(to - from) / (to - from).length_squared();
                shares[v][bone.index()] > 0.9 && (from_here..0.68).contains(&along)
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
