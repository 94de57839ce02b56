//! A posable figure: skeleton, pose, contacts, controls, skin palette and their files.

mod balance;
mod blend;
mod body;
mod bone;
mod bounds;
mod camera;
mod contacts;
mod dual_quaternion;
mod end;
mod evaluation;
mod figure;
mod fitting;
mod frames;
mod gesture;
mod gesture_error;
mod joint;
mod limb;
mod limb_rig;
mod lock;
mod mechanics;
mod mesh;
mod morph;
mod palette;
mod pose;
mod pose_file;
mod reach;
mod reach_limits;
mod robot;
mod simplify;
mod size;
mod skeleton;
mod skin;
mod skin_bounds;
mod support;
mod text;
mod torso;
mod turn;
mod turn_in_contact;
mod twist;

pub use balance::balance;
pub use blend::{PosePatch, apply_patch, handshape, mirror, mirrored_patch, mirrored_pose, reset};
pub use body::{Body, BodySlider, Shaped, shaped};
pub use bone::{Bone, Part, Side, nearest};
pub use bounds::Bounds;
pub use camera::{Camera, Projection, Ray, View};
pub use contacts::contact_order;
pub use evaluation::{Evaluation, LimbView, center_of_mass, evaluate, frames};
pub use figure::{Articulator, Figure, Handshape};
pub use fitting::{carried_over, fitted, read_pose};
pub use frames::Frames;
pub use gesture::{
    Target, articulate, articulator_in, check_reacher, elevate, flip, keep, limb_parts_present, move_hips,
    place, reach,
};
pub use gesture_error::GestureError;
pub use joint::{Angles, Articulation, Dof, Hinge, Joint};
pub use kin::Frame;
pub use limb::{Limb, LimbParts};
pub use limb_rig::{LimbRig, LimbRigs};
pub use lock::Locks;
pub use mechanics::{MECHANICS_TOLERANCE_M, Mechanics, reach_with, turn_with};
pub use mesh::Mesh;
pub use morph::{MorphTarget, MorphTargets, add_targets};
pub use palette::{PALETTE_LEN, Palette};
pub use pose::{Contact, LimbState, Place, Pose, Reacher, Space};
pub use pose_file::{POSE_VERSION, check_patch, parse_pose, write_bones, write_parts, write_pose};
pub use reach_limits::{Miss, ReachLimits, Why, reach_limits};
pub use robot::{
    ChangeError, DofPart, Inertial, JointLimit, Mimic, NewLink, Paint, Robot, RobotChain, RobotDof,
    RobotError, RobotGoal, RobotJoint, RobotJointKind, RobotLink, RobotPose, RobotReach, RobotSkin,
    RootMoves, STAND_IN, STAND_IN_EDGE_M, Shape, Solid, UNPAINTED, Visual, rotation_of_rpy, rpy_of_rotation,
};
pub use simplify::simplified;
pub use size::Size;
pub use skeleton::{Skeleton, SkeletonError};
pub use skin::{skin_normals, skin_position, skin_positions};
pub use skin_bounds::SkinBounds;
pub use support::{Falls, Support, support};
pub use text::{AnglesText, Number, PlaceText, TextFault, Triple, check_version, from_ron, ron_options};
pub use torso::{aim_spine, look_at, spine_twist};
pub use turn::{Moved, Slider, live_range, sliders, turn};
pub use turn_in_contact::{contact_joint, turn_in_contact};
pub use twist::{PLACES, TwistPlace, bone_of_place, spread_twist, twist_places};
