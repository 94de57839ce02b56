//! A posable figure: skeleton, pose, contacts, controls, skin palette and their files.

mod bone;
mod bounds;
mod camera;
mod figure;
mod frames;
mod joint;
mod limb;
mod mesh;
mod pose;
mod skeleton;
mod skin;

pub use bone::{Bone, Part, Side, nearest};
pub use bounds::Bounds;
pub use camera::{Camera, Projection, Ray, View};
pub use figure::{Articulator, Figure, Handshape};
pub use frames::Frames;
pub use joint::{Angles, Articulation, Dof, Hinge, Joint};
pub use kin::Frame;
pub use limb::{Limb, LimbParts};
pub use mesh::Mesh;
pub use pose::{Contact, LimbState, Place, Pose, Reacher, Space};
pub use skeleton::{Skeleton, SkeletonError};
pub use skin::{PALETTE_LEN, Palette, SkinBounds, skin_normals, skin_positions};
