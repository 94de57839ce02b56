//! Animation: clips, blend trees, ground, and feet placed on it. No disk, no clock: time is handed in.

mod additive;
mod bearing;
mod cells;
mod clip;
mod clip_file;
pub mod crowd;
mod feather;
mod fitted;
mod ground;
mod leg;
mod mirrored;
mod placement;
mod refit;
mod retimed;
mod sample;
mod soles;
mod steering;
mod survey;
mod track;
mod travel;
mod tree;
mod walker;

pub use cells::{Cells, CellsError, MOST_POINTS};
pub use clip::Clip;
pub use clip_file::{CLIP_VERSION, parse_clip, write_clip};
pub use feather::Feather;
pub use fitted::{FitError, FittedClip};
pub use ground::{
    Ground, GroundKind, GroundPoint, Hills, HillsShape, Rise, Sheet, SheetError, Slope, Stairs, Stones,
};
pub use leg::{Bend, FootGoal, Leg, LegMiss, Legs};
pub use placement::{
    FeetState, FootView, Footing, PlacedFoot, Placement, PlacementSettings, lift_feet, stand,
};
pub use sample::{Bearing, Sample};
pub use soles::{Sole, Soles};
pub use steering::{Parameter, Steering};
pub use survey::{Summary, Survey};
pub use track::{Key, Keyed, Mode, Track};
pub use travel::Travel;
pub use tree::{
    At, BLEND_VERSION, BlendView, Condition, OutlineNode, Plan, PlanFault, PlanNode, Step, Transition, Tree,
    TreeState, parse_plan, read_tree, write_plan,
};
pub use walker::Walker;
