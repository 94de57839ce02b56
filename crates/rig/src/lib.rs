//! A posable figure: skeleton, pose, contacts, controls, skin palette and their files.

mod bone;
mod figure;
mod joint;
mod limb;
mod mesh;
mod pose;
mod skeleton;

pub use bone::{Bone, Part, Side, nearest};
pub use figure::{Articulator, Figure, Handshape};
pub use joint::{Angles, Articulation, Dof, Hinge, Joint};
pub use limb::{Limb, LimbParts};
pub use mesh::Mesh;
pub use pose::{Contact, LimbState, Place, Pose, Reacher, Space};
pub use skeleton::{Skeleton, SkeletonError};
