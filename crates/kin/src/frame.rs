//! Rigid frames: a rotation and a place.

use glam::{DQuat, DVec3};

/// A rigid frame `to_from`: takes points of the inner frame ("from") to the outer one ("to").
///
/// The rotation is a unit quaternion; the position is the inner origin in the outer frame, in metres.
/// Nothing here checks or normalises: products of a few hundred unit rotations stay unit to 1e-14.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// The inner axes in the outer frame; a unit quaternion.
    pub rotation: DQuat,
    /// The inner origin in the outer frame, metres.
    pub position: DVec3,
}

impl Frame {
    /// The frame that changes nothing.
    pub const IDENTITY: Frame = Frame { rotation: DQuat::IDENTITY, position: DVec3::ZERO };

    /// The frame of that rotation and place.
    #[inline]
    pub const fn new(rotation: DQuat, position: DVec3) -> Frame {
        Frame { rotation, position }
    }

    /// `a_from_b.then(b_from_c)` is `a_from_c`: one quaternion product and one rotated offset.
    #[must_use]
    #[inline]
    pub fn then(self, inner: Frame) -> Frame {
        Frame { rotation: self.rotation * inner.rotation, position: self.point(inner.position) }
    }

    /// A point of the inner frame, in the outer one.
    #[inline]
    pub fn point(self, point: DVec3) -> DVec3 {
        self.rotation * point + self.position
    }

    /// A direction or difference of points of the inner frame, in the outer one: turned, not shifted.
    #[inline]
    pub fn vector(self, vector: DVec3) -> DVec3 {
        self.rotation * vector
    }

    /// The frame the other way round: `a_from_b` becomes `b_from_a`.
    #[must_use]
    #[inline]
    pub fn inverse(self) -> Frame {
        let rotation = self.rotation.conjugate();
        Frame { rotation, position: -(rotation * self.position) }
    }
}

impl Default for Frame {
    fn default() -> Frame {
        Frame::IDENTITY
    }
}
