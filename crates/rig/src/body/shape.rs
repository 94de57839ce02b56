//! A figure made over to a body: skeleton, ranges, masses, articulators and skin.

use std::collections::BTreeMap;

use glam::DVec3;

use super::masses::{share_by_sex, share_out, swept, total_factor};
use super::normals::turn_along;
use super::proportions::Marks;
use super::ranges::widen;
use super::warp::{Factors, Warp};
use super::{Body, BodySlider};
use crate::morph::add_targets;
use crate::{Articulator, Figure, Joint, Limb, LimbRigs, Mesh, MorphTargets, Skeleton, SkeletonError};

/// What the breadth of shoulders and hips gains and loses with sex characteristics. [DE-LEVA-1996]
const SHOULDERS_BY_SEX: f64 = -0.035;
const HIPS_BY_SEX: f64 = 0.025;
/// How near to an articulator a vertex must lie to take it along when the skin's shape changes, metres.
const ON_THE_SKIN: f64 = 0.010;

/// A figure made over.
#[derive(Clone, PartialEq, Debug)]
pub struct Shaped {
    /// The figure with the body.
    pub figure: Figure,
    /// Sole to crown, metres: of the skin or, without one, as the joints tell. `None` for a figure without a head.
    pub stature: Option<f64>,
    /// Stature over head height.
    pub heads: Option<f64>,
    /// The morph targets that the body asks for and the skin lacks.
    pub missing: Vec<&'static str>,
}

/// Makes a figure over to a body. `targets` are those of its skin at rest.
///
/// First the physique's targets move the skin. Then each bone's part is stretched about its joint, head and hands and
/// feet with the head count, limbs along their bones, trunk across; a vertex moves by its weights, so weights stay as
/// they are. Then all is brought to the stature, the soles at the height at which they were. Stature and head count
/// that are not given stay those of the figure. A body that [is as is](Body::is_as_is) gives the figure bit for bit.
///
/// # Errors
/// None for a figure of finite numbers; joints that come out not finite.
pub fn shaped(figure: &Figure, targets: &MorphTargets, body: &Body) -> Result<Shaped, SkeletonError> {
    let marks = Marks::new(&figure.skeleton, figure.skin.as_ref());
    let known = |marks: Marks| (Some(marks.stature()), Some(marks.heads()));
    let (stature, heads) = marks.map_or((None, None), known);
    if body.is_as_is() {
        return Ok(Shaped { figure: figure.clone(), stature, heads, missing: Vec::new() });
    }
    let shares = body.targets();
    let missing = shares.iter().map(|(name, _)| *name).filter(|name| !targets.contains_key(*name)).collect();
    let skin = figure.skin.as_ref().filter(|mesh| mesh.fault().is_none());
    let morphed = skin.map(|mesh| {
        let mut morphed = mesh.clone();
        add_targets(&mut morphed, targets, &shares);
        morphed
    });
    let (warp, marks) = warp(&figure.skeleton, morphed.as_ref(), body, stature);
    let gained = skin.zip(morphed.as_ref()).map_or([0.0; crate::Bone::COUNT], |(a, b)| swept(a, b));
    let skeleton = skeleton(&figure.skeleton, &warp, body, &gained, stature)?;
    let drift = |at: DVec3| skin.zip(morphed.as_ref()).map_or(DVec3::ZERO, |(a, b)| drift(a, b, at));
    let articulators = articulators(figure, &warp, drift);
    let bases = Limb::ALL.map(|limb| figure.limbs.swing_base(limb));
    let limbs = LimbRigs::new(&skeleton, bases);
    let skin = skin.zip(morphed).map(|(mesh, morphed)| warped(mesh, morphed, &warp));
    let skin = skin.or_else(|| figure.skin.clone());
    let figure = Figure { skeleton, articulators, limbs, skin, ..figure.clone() };
    let (stature, heads) = marks.map_or((None, None), known);
    Ok(Shaped { figure, stature, heads, missing })
}

/// The warp that gives head count, lengths and stature, and where it takes the points that are measured.
fn warp(
    skeleton: &Skeleton,
    skin: Option<&Mesh>,
    body: &Body,
    stature: Option<f64>,
) -> (Warp, Option<Marks>) {
    let sex = body.off(BodySlider::Sex);
    let mut factors = Factors {
        head: 1.0,
        arms: body.factor(BodySlider::Arms),
        legs: body.factor(BodySlider::Legs),
        shoulders: body.factor(BodySlider::Shoulders) * (1.0 + SHOULDERS_BY_SEX * sex),
        hips: body.factor(BodySlider::Hips) * (1.0 + HIPS_BY_SEX * sex),
    };
    let marks = Marks::new(skeleton, skin);
    if let (Some(marks), Some(heads)) = (&marks, body.given(BodySlider::Heads)) {
        factors.head = marks.head_factor(skeleton, &factors, heads);
    }
    let warp = Warp::new(skeleton, &factors);
    let Some(marks) = marks else { return (warp, None) };
    let moved = marks.after(&warp);
    let wanted = body.given(BodySlider::Stature).or(stature).unwrap_or(moved.stature());
    let scale = wanted / moved.stature();
    let warp = warp.then(scale, (marks.sole() - moved.sole()) * scale);
    (warp.clone(), Some(marks.after(&warp)))
}

fn skeleton(
    before: &Skeleton,
    warp: &Warp,
    body: &Body,
    gained: &[f64; crate::Bone::COUNT],
    stature: Option<f64>,
) -> Result<Skeleton, SkeletonError> {
    let mut joints: Vec<Joint> = before.joints().cloned().collect();
    for joint in &mut joints {
        let carrier = joint.carrier.map_or(DVec3::ZERO, |c| warp.joint(c));
        joint.offset = warp.joint(joint.bone) - carrier;
        joint.center_of_mass = warp.linear[joint.bone.index()] * joint.center_of_mass;
        widen(joint, body.factor(BodySlider::Flexibility));
    }
    let by_stature = body.given(BodySlider::Stature).zip(stature).map_or(1.0, |(new, old)| new / old);
    let sex = body.off(BodySlider::Sex);
    let factor = |bone: crate::Bone| share_by_sex(bone, sex) * warp.linear[bone.index()].determinant();
    share_out(&mut joints, factor, gained, total_factor(body, by_stature));
    Skeleton::new(joints)
}

/// By how much the skin at a point moves with its targets: as its nearest vertex does, nothing far from the skin.
fn drift(before: &Mesh, after: &Mesh, at: DVec3) -> DVec3 {
    let place = |mesh: &Mesh, v: usize| DVec3::from(mesh.positions[v].map(f64::from));
    let nearest = (0..before.vertex_count())
        .map(|v| (place(before, v).distance_squared(at), v))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    match nearest {
        Some((squared, v)) if squared <= ON_THE_SKIN * ON_THE_SKIN => place(after, v) - place(before, v),
        _ => DVec3::ZERO,
    }
}

fn articulators(
    figure: &Figure,
    warp: &Warp,
    drift: impl Fn(DVec3) -> DVec3,
) -> [BTreeMap<String, Articulator>; Limb::ALL.len()] {
    let moved = |a: &Articulator| {
        let rest = figure.skeleton.rest_position(a.bone) + a.at;
        let at = warp.linear[a.bone.index()] * (a.at + drift(rest));
        Articulator { bone: a.bone, at }
    };
    let each = |points: &BTreeMap<String, Articulator>| {
        points.iter().map(|(name, a)| (name.clone(), moved(a))).collect()
    };
    std::array::from_fn(|i| each(&figure.articulators[i]))
}

/// The skin after its targets and the warp.
fn warped(before: &Mesh, mut mesh: Mesh, warp: &Warp) -> Mesh {
    for (v, place) in mesh.positions.iter_mut().enumerate() {
        let p = DVec3::from(place.map(f64::from));
        *place = warp.vertex(p, mesh.joints[v], mesh.weights[v]).as_vec3().to_array();
    }
    turn_along(before, &mut mesh);
    mesh
}
