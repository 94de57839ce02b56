//! Mends weights: poses the half mesh at the ends of its ranges and as the shipped poses have it, and changes the
//! weights as little and as smoothly as will do wherever a triangle is turned inside out or nearly so,
//! or a limb swells.

use glam::DVec3;
use rig::{Bone, Mesh, Skeleton, bone_of_place, spread_twist};

use super::buried::Depths;
use super::faults::askew;
use super::least_change::{Row, least_change};
use super::nets::Surface;
use super::pinch::{Pinch, Pinches};
use super::rings::Rings;
use super::swelling::Swellings;
use super::trials::{Trial, trials};
use super::weights::{Shares, rounded};

/// Rounds after which the best so far is kept.
const ROUNDS: usize = 80;
/// After so many rounds all poses are tried, not only those that were bad: mending one may have harmed another.
const AGAIN: usize = 4;
/// A triangle that keeps less than this part of its area counts as turned.
const TURNED: f64 = 0.01;
/// As much of its area as it is to be given back.
const WANTED: f64 = 0.06;
/// As much of it as one round may give back: slopes hold only so far.
const AT_ONCE: f64 = 0.4;
/// Poses at most that a triangle is mended for in one round, the worst ones.
const WORST: usize = 3;
/// The least mean share around a vertex of a bone that it may come to follow.
const NEAR: f64 = 0.004;
/// How much a difference between what neighbours change weighs against what triangles ask.
const SMOOTH: f64 = 0.05;
/// How much a share may change in one round.
const CHANGE: f64 = 0.12;

/// How often shares are evened out between two fingers.
const WEB: usize = 4;

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

/// Changes the shares of a half mesh where poses ask for it.
///
/// # Errors
/// A shipped pose that cannot be read.
pub fn relax(
    half: &Surface,
    normals: &[DVec3],
    skeleton: &Skeleton,
    shares: &mut [Shares],
) -> anyhow::Result<Remains> {
    let mut rings = Rings::new(half);
    rings.settle_fingers(shares);
    // Where the skin passes from one finger to the next it follows the hand the more.
    for _ in 0..WEB {
        let web: Vec<bool> = shares.iter().enumerate().map(|(v, s)| rings.is_between_fingers(v, s)).collect();
        rings.even(shares, |v| if web[v] { 0.5 } else { 0.0 });
    }
    let held = middles(half, skeleton, shares);
    let mut mesh = bare(half, normals);
    let pinches = Pinches::new(half, normals, &mesh, skeleton);
    dress(&mut mesh, half, skeleton, shares);
    let trials = trials(skeleton, &Depths::new(&whole(&mesh)))?;
    // A triangle of a crease that lies askew at rest is none of a weight's business.
    let mut upright = vec![true; half.triangles.len()];
    askew(&mesh).into_iter().for_each(|t| upright[t] = false);
    let swellings = Swellings::new(&mesh, skeleton);
    let mut best = ((usize::MAX, f64::MAX), shares.to_vec(), Vec::new(), 0);
    let mut open: Vec<usize> = (0..trials.len()).collect();
    for round in 0..ROUNDS {
        dress(&mut mesh, half, skeleton, shares);
        let look = |i: &usize| pinches.find(&mesh, &trials[*i].palette, *i, WANTED);
        let mut found: Vec<Pinch> = open.iter().flat_map(look).collect();
        found.retain(|p| upright[p.triangle as usize]);
        let turned: Vec<Pinch> = found.iter().filter(|p| p.left < TURNED).copied().collect();
        let all = open.len() == trials.len();
        let swollen = swellings.find(&pinches, &mesh, &trials);
        let excess = swollen.iter().map(|s| s.excess.abs()).fold(0.0, f64::max);
        if all && (turned.len(), excess) < best.0 {
            best = ((turned.len(), excess), shares.to_vec(), turned.clone(), round);
        }
        if all && turned.is_empty() && swollen.is_empty() {
            break;
        }
        let again = round % AGAIN == AGAIN - 2 || turned.is_empty();
        open = if again { (0..trials.len()).collect() } else { with_pinches(&found) };
        let mut rows = rows(&pinches, &mesh, &trials, &worst(found), &rings, shares);
        rows.extend(swollen.iter().map(|swelling| {
            let palette = &trials[swelling.pose].palette;
            swellings.row(swelling, &pinches, &mesh, palette, |v| rings.bones_near(v, shares, NEAR))
        }));
        let change = least_change(&rows, &rings, &held, SMOOTH);
        apply(&rings, change, shares);
    }
    shares.copy_from_slice(&best.1);
    Ok(Remains { rounds: best.3, turned: told(half, &trials, &best.2) })
}

fn with_pinches(found: &[Pinch]) -> Vec<usize> {
    let mut poses: Vec<usize> = found.iter().map(|p| p.pose as usize).collect();
    poses.dedup();
    poses
}

/// What is left, by pose.
fn told(half: &Surface, trials: &[Trial], turned: &[Pinch]) -> Vec<(String, usize, DVec3)> {
    let place = |p: &Pinch| half.points[half.triangles[p.triangle as usize][0] as usize];
    turned
        .chunk_by(|a, b| a.pose == b.pose)
        .map(|of_pose| (trials[of_pose[0].pose as usize].name.clone(), of_pose.len(), place(&of_pose[0])))
        .collect()
}

/// For each triangle the few poses that squeeze it most.
fn worst(mut found: Vec<Pinch>) -> Vec<Pinch> {
    found.sort_by(|a, b| {
        a.triangle.cmp(&b.triangle).then(a.left.total_cmp(&b.left)).then(a.pose.cmp(&b.pose))
    });
    found
        .chunk_by(|a, b| a.triangle == b.triangle)
        .flat_map(|of| &of[..of.len().min(WORST)])
        .copied()
        .collect()
}

/// What each triangle asks of the shares.
fn rows(
    pinches: &Pinches<'_>,
    mesh: &Mesh,
    trials: &[Trial],
    found: &[Pinch],
    rings: &Rings,
    shares: &[Shares],
) -> Vec<Row> {
    let row = |pinch: &Pinch| {
        let palette = &trials[pinch.pose as usize].palette;
        let slopes = pinches.slopes(mesh, palette, *pinch, |v| rings.bones_near(v, shares, NEAR));
        let length = slopes.iter().map(|s| s.2 * s.2).sum::<f64>().sqrt();
        let short = (WANTED - pinch.left).min(AT_ONCE) / length.max(1e-9);
        let parts = slopes.into_iter().map(|(v, bone, slope)| (v, bone, slope / length.max(1e-9))).collect();
        (length > 1e-3).then_some(Row { parts, short })
    };
    found.iter().filter_map(row).collect()
}

/// Adds a change to the shares, as much of it as may be at once.
fn apply(rings: &Rings, change: Vec<(usize, Shares)>, shares: &mut [Shares]) {
    for (v, change) in change {
        let most = change.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        let part = (CHANGE / most.max(1e-12)).min(1.0);
        shares[v].iter_mut().zip(&change).for_each(|(s, c)| *s = (*s + part * c).max(0.0));
        let sum: f64 = shares[v].iter().sum();
        shares[v].iter_mut().for_each(|s| *s /= sum.max(1e-12));
        rings.tidy(v, &mut shares[v]);
    }
}

/// The vertices that follow nothing but the middle of a limb's segment: they stay as they are, so that no joint's blend
/// runs into the next one's.
fn middles(half: &Surface, skeleton: &Skeleton, shares: &[Shares]) -> Vec<bool> {
    let segments = [
        (Bone::LeftUpperArm, Bone::LeftLowerArm, 0.40),
        (Bone::LeftLowerArm, Bone::LeftHand, 0.40),
        (Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.54),
        (Bone::LeftLowerLeg, Bone::LeftFoot, 0.40),
    ];
    let held = |v: usize| {
        segments.iter().any(|&(bone, next, from_here)| {
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
