//! Forward kinematics: where every joint of a carrier-ordered skeleton is.

use glam::{DQuat, DVec3};

use crate::Frame;

/// One joint for [`fk`]: what carries it, where it sits, how it is turned now.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Link {
    /// Index of the joint that carries this one, which comes before it; `None` for one that the root carries.
    pub carrier: Option<usize>,
    /// The joint's place in its carrier's frame, metres.
    pub offset: DVec3,
    /// The joint's local turn: `carrier_from_joint`.
    pub rotation: DQuat,
}

/// Why links do not make a skeleton.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum FkError {
    /// A link names a carrier that doesn't come before it.
    #[error("link {link} is carried by {carrier}, which does not come before it")]
    Carrier {
        /// The faulty link.
        link: usize,
        /// The carrier that it names.
        carrier: usize,
    },
    /// There are more links than frames to write.
    #[error("there are more links than the {frames} frames of the output")]
    Short {
        /// Length of the output slice.
        frames: usize,
    },
}

/// Writes the frame of every joint, in the frame that `root` leads to, and returns how many it wrote.
///
/// With `root` = `world_from_figure` the output is `world_from_joint`. Links come carriers first, and link
/// `i` fills `out[i]`. One quaternion product and one rotated offset a joint, no allocation. Frames past
/// the last link are left as they were.
///
/// # Errors
/// A carrier that does not come before its link, or an output slice that is too short; the frames
/// before the fault are written.
pub fn fk(root: Frame, links: impl IntoIterator<Item = Link>, out: &mut [Frame]) -> Result<usize, FkError> {
    let mut count = 0;
    // Most joints are carried by the one before: kept at hand, it need not come back from memory.
    let mut last = root;
    for link in links {
        let (done, rest) = out.split_at_mut(count);
        let frames = done.len();
        let slot = rest.first_mut().ok_or(FkError::Short { frames })?;
        let carrier = match link.carrier {
            None => root,
            Some(carrier) if count.checked_sub(1) == Some(carrier) => last,
            Some(carrier) => *done.get(carrier).ok_or(FkError::Carrier { link: count, carrier })?,
        };
        last = carrier.then(Frame::new(link.rotation, link.offset));
        *slot = last;
        count += 1;
    }
    Ok(count)
}
