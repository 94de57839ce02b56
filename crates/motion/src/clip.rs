//! A clip: keyed animation as its file says it, for flat ground.

use std::collections::BTreeMap;

use glam::DVec3;
use rig::{Angles, Bone, Place, Size};

use crate::Track;

/// Keyed animation of a figure on flat ground at height 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Clip {
    /// The name that trees and reports use.
    pub name: String,
    /// The name of the figure that it was made with.
    pub figure: Option<String>,
    /// The size of that figure.
    pub size: Option<Size>,
    /// Seconds, positive.
    pub length_secs: f64,
    /// Whether the end goes over into the start.
    pub loops: bool,
    /// Whether one length is one stride that begins with the left heel's contact, so that it keeps step with others.
    pub stride: bool,
    /// Where the whole figure is, against where it started: root motion. Empty keys: it stays.
    pub root: Option<Track<Place>>,
    /// The hips joint in figure space, metres.
    pub hips: Option<Track<DVec3>>,
    /// Joint angles, degrees; joints that are not named stay at rest.
    pub joints: BTreeMap<Bone, Track<Angles>>,
}
