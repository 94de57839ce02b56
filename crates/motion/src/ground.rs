//! Ground to stand on.

mod hills;
mod patch;
mod sheet;
mod stairs;
mod stones;

use std::sync::Arc;

use glam::{DVec2, DVec3};

pub use hills::{Hills, HillsShape, Rise};
pub use sheet::{Sheet, SheetError};
pub use stairs::Stairs;
pub use stones::Stones;

/// The ground under a point.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GroundPoint {
    /// World height, metres.
    pub height: f64,
    /// Unit normal, upward.
    pub normal: DVec3,
}

impl GroundPoint {
    /// Level ground at a height.
    pub const fn level(height: f64) -> GroundPoint {
        GroundPoint { height, normal: DVec3::Y }
    }
}

/// An even slope through the origin.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slope {
    /// Rise over run, along x and along z.
    gradient: DVec2,
}

impl Slope {
    /// How much it rises by default, degrees.
    pub const RISE_DEG: f64 = 10.0;

    /// A slope that rises by so many degrees (at most 80 either way) toward a direction: 0 is along +Z, 90 along +X.
    /// Numbers that are none make it level.
    pub fn new(degrees: f64, toward_degrees: f64) -> Slope {
        let (x, z) = toward_degrees.to_radians().sin_cos();
        let gradient = DVec2::new(x, z) * degrees.clamp(-80.0, 80.0).to_radians().tan();
        Slope { gradient: if gradient.is_finite() { gradient } else { DVec2::ZERO } }
    }

    fn under(&self, x: f64, z: f64) -> GroundPoint {
        let normal = DVec3::new(-self.gradient.x, 1.0, -self.gradient.y).normalize();
        GroundPoint { height: self.gradient.dot(DVec2::new(x, z)), normal }
    }
}

/// Ground to stand on: a height for every place. Cheap to clone.
#[derive(Clone, PartialEq, Debug, Default)]
pub enum Ground {
    /// Level, at height 0.
    #[default]
    Flat,
    /// Even, through the origin.
    Slope(Slope),
    /// Rolling, a grid of quads.
    Hills(Arc<Hills>),
    /// Up, a landing, down, and again.
    Stairs(Stairs),
    /// Flat or gently tilted tops with gaps of lower ground.
    Stones(Stones),
    /// Triangles of a file.
    Mesh(Arc<Sheet>),
}

/// The kinds of ground that need no file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum GroundKind {
    Flat,
    Slope,
    Hills,
    Stairs,
    Stones,
}

impl GroundKind {
    /// Every kind, in the order in which choosers show them.
    pub const ALL: [GroundKind; 5] =
        [GroundKind::Flat, GroundKind::Slope, GroundKind::Hills, GroundKind::Stairs, GroundKind::Stones];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            GroundKind::Flat => "flat",
            GroundKind::Slope => "slope",
            GroundKind::Hills => "hills",
            GroundKind::Stairs => "stairs",
            GroundKind::Stones => "stones",
        }
    }

    /// The kind of that name.
    pub fn from_name(name: &str) -> Option<GroundKind> {
        GroundKind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether another seed makes another ground.
    pub const fn has_seed(self) -> bool {
        matches!(self, GroundKind::Hills | GroundKind::Stones)
    }

    /// Ground of that kind as it is by default. The seed matters to hills and stones.
    pub fn ground(self, seed: u64) -> Ground {
        match self {
            GroundKind::Flat => Ground::Flat,
            GroundKind::Slope => Ground::Slope(Slope::new(Slope::RISE_DEG, 0.0)),
            GroundKind::Hills => {
                Ground::Hills(Arc::new(Hills::new(&HillsShape { seed, ..HillsShape::default() })))
            }
            GroundKind::Stairs => Ground::Stairs(Stairs::default()),
            GroundKind::Stones => Ground::Stones(Stones::new(seed)),
        }
    }
}

impl Ground {
    /// The ground of a kind's name with a seed; `None` for other words.
    pub fn parse_kind(name: &str, seed: u64) -> Option<Ground> {
        GroundKind::from_name(name).map(|kind| kind.ground(seed))
    }

    /// The ground under (or over) a place, `x` and `z` in metres, world: the highest where a mesh has several sheets.
    /// Off the edge of a mesh it is that of the nearest place within its bounds, and 0 where there is none. Numbers
    /// that are none, and places a million kilometres away, have level ground at 0.
    pub fn under(&self, x: f64, z: f64) -> GroundPoint {
        match self {
            Ground::Flat => GroundPoint::level(0.0),
            _ if !on_the_map(x, z) => GroundPoint::level(0.0),
            Ground::Slope(slope) => slope.under(x, z),
            Ground::Hills(hills) => hills.under(x, z),
            Ground::Stairs(stairs) => stairs.under(x, z),
            Ground::Stones(stones) => stones.under(x, z),
            Ground::Mesh(sheet) => sheet.under(x, z, f64::INFINITY),
        }
    }

    /// As [`Ground::under`], but of a mesh's sheets the highest that is not above a height, metres, world.
    pub fn below(&self, x: f64, z: f64, height: f64) -> GroundPoint {
        match self {
            Ground::Mesh(sheet) if on_the_map(x, z) => sheet.under(x, z, height),
            _ => self.under(x, z),
        }
    }

    /// Whether heights may jump from place to place.
    pub fn has_steps(&self) -> bool {
        matches!(self, Ground::Stairs(_) | Ground::Stones(_) | Ground::Mesh(_))
    }

    /// The height alone.
    pub fn height(&self, x: f64, z: f64) -> f64 {
        match self {
            Ground::Flat => 0.0,
            _ if !on_the_map(x, z) => 0.0,
            Ground::Slope(slope) => slope.under(x, z).height,
            Ground::Hills(hills) => hills.height(x, z),
            _ => self.under(x, z).height,
        }
    }

    /// The height, metres, and the rise over run along x and z.
    pub(crate) fn facet(&self, x: f64, z: f64) -> (f64, DVec2) {
        match self {
            Ground::Hills(hills) if on_the_map(x, z) => hills.facet(x, z),
            _ => {
                let GroundPoint { height, normal } = self.under(x, z);
                (height, -DVec2::new(normal.x, normal.z) / normal.y.max(0.1))
            }
        }
    }

    /// The ground around a place as triangles to draw, a square of twice the half extent: a light neutral checker of
    /// metres, smooth over hills and crisp at edges. Half extents are held within 0.5 and 60 m. Joints and weights of
    /// its vertices name the first place of a palette.
    pub fn patch(&self, center: DVec2, half_extent_m: f64) -> rig::Mesh {
        patch::patch(self, center, half_extent_m)
    }
}

/// Whether a place is near enough for numbers to tell it from the next.
fn on_the_map(x: f64, z: f64) -> bool {
    x.abs() < 1e9 && z.abs() < 1e9
}

/// A number in 0..1 that a seed and two whole numbers give, evenly spread.
fn hashed(seed: u64, i: i64, j: i64, which: u64) -> f64 {
    // splitmix64 over the four, one after the other.
    let mut state = seed ^ 0x9E37_79B9_7F4A_7C15;
    for value in [i as u64, j as u64, which] {
        state = mixed(state.wrapping_add(value).wrapping_add(0x9E37_79B9_7F4A_7C15));
    }
    (state >> 11) as f64 / (1u64 << 53) as f64
}

fn mixed(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
