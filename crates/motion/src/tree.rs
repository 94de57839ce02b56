//! Blend trees: clips go in at the leaves, one sample of the figure comes out at the root.
//!
//! [`Plan`] is what a file says; a [`Tree`] is a plan with the clips of one figure; a [`TreeState`] is what
//! one walker has of its own. A step goes down the tree with weights first, and then takes samples, children
//! before their parents; what has no weight is never visited, and after the state is made nothing is
//! allocated.

mod bind;
mod check;
mod mix;
mod outline;
mod places;
mod plan;
mod state;
mod states;
mod step;

pub use bind::{Tree, read_tree};
pub use outline::{BlendView, OutlineNode};
pub use places::{PlanFault, Step};
pub use plan::{At, BLEND_VERSION, Condition, Plan, PlanNode, Transition, parse_plan, write_plan};
pub use state::TreeState;
