//! Animation: clips, blend trees, ground, and feet placed on it. No disk, no clock: time is handed in.

mod clip;
mod clip_file;
mod fitted;
mod ground;
mod leg;
mod placement;
mod sample;
mod soles;
mod steering;
mod track;
mod travel;
mod walker;

pub use clip::Clip;
pub use clip_file::{CLIP_VERSION, parse_clip, write_clip};
pub use fitted::{FitError, FittedClip};
pub use ground::{
    Ground, GroundKind, GroundPoint, Hills, HillsShape, Rise, Sheet, SheetError, Slope, Stairs, Stones,
};
pub use leg::{Bend, FootGoal, Leg, LegMiss, Legs};
pub use placement::{FeetState, FootView, PlacementSettings};
pub use sample::{Bearing, Sample};
pub use soles::{Sole, Soles};
pub use steering::{Parameter, Steering};
pub use track::{Key, Keyed, Mode, Track};
pub use travel::Travel;
pub use walker::Walker;
