//! Frames compose, and forward kinematics agrees with matrices.

use glam::{DMat4, DQuat, DVec3};
use kin::{FkError, Frame, Link, fk};
use proptest::prelude::*;

fn frame() -> impl Strategy<Value = Frame> {
    (prop::array::uniform3(-4.0..4.0_f64), prop::array::uniform3(-2.0..2.0_f64))
        .prop_map(|(r, p)| Frame::new(DQuat::from_scaled_axis(DVec3::from(r)), DVec3::from(p)))
}

/// A tree whose joint `i` hangs on an earlier one or, one time in five, on the root.
fn tree() -> impl Strategy<Value = Vec<Link>> {
    let one = (frame(), any::<prop::sample::Index>(), 0..5_u8);
    prop::collection::vec(one, 1..40).prop_map(|list| {
        let link = |(i, (f, at, lot)): (usize, (Frame, prop::sample::Index, u8))| Link {
            carrier: (i > 0 && lot > 0).then(|| at.index(i)),
            offset: f.position,
            rotation: f.rotation,
        };
        list.into_iter().enumerate().map(link).collect()
    })
}

fn matrix(f: Frame) -> DMat4 {
    DMat4::from_rotation_translation(f.rotation, f.position)
}

proptest! {
    #[test]
    fn composition_inverse_and_points_agree_with_matrices(a in frame(), b in frame()) {
        let product = matrix(a) * matrix(b);
        prop_assert!(matrix(a.then(b)).abs_diff_eq(product, 1e-14));
        let p = DVec3::new(0.3, -1.2, 0.7);
        prop_assert!(a.point(p).abs_diff_eq(matrix(a).transform_point3(p), 1e-14));
        prop_assert!(a.vector(p).abs_diff_eq(a.point(p) - a.position, 1e-14));
        prop_assert!(a.inverse().point(a.point(p)).abs_diff_eq(p, 1e-14));
        prop_assert!(matrix(a.then(a.inverse())).abs_diff_eq(DMat4::IDENTITY, 1e-14));
    }

    #[test]
    fn frames_of_a_tree_agree_with_products_of_matrices(root in frame(), links in tree()) {
        let mut out = [Frame::IDENTITY; 40];
        prop_assert_eq!(fk(root, links.iter().copied(), &mut out), Ok(links.len()));
        for (i, link) in links.iter().enumerate() {
            let mut expected = DMat4::IDENTITY;
            let mut at = Some(i);
            while let Some(j) = at {
                expected = matrix(Frame::new(links[j].rotation, links[j].offset)) * expected;
                at = links[j].carrier;
            }
            prop_assert!(matrix(out[i]).abs_diff_eq(matrix(root) * expected, 1e-12), "{} {:?}", i, link);
        }
    }
}

const STEP: Link = Link { carrier: None, offset: DVec3::Y, rotation: DQuat::IDENTITY };

#[test]
fn a_carrier_that_comes_later_is_an_error_that_names_both() {
    let mut out = [Frame::IDENTITY; 3];
    for carrier in [1, 2, usize::MAX] {
        let links = [STEP, Link { carrier: Some(carrier), ..STEP }];
        assert_eq!(fk(Frame::IDENTITY, links, &mut out), Err(FkError::Carrier { link: 1, carrier }));
    }
    let itself = Link { carrier: Some(0), ..STEP };
    assert_eq!(fk(Frame::IDENTITY, [itself], &mut out), Err(FkError::Carrier { link: 0, carrier: 0 }));
}

#[test]
fn too_short_an_output_is_an_error_and_a_longer_one_keeps_its_rest() {
    let mut out = [Frame::IDENTITY; 2];
    assert_eq!(fk(Frame::IDENTITY, [STEP; 3], &mut out), Err(FkError::Short { frames: 2 }));
    let mark = Frame::new(DQuat::IDENTITY, DVec3::splat(9.0));
    let mut out = [mark; 3];
    assert_eq!(fk(Frame::IDENTITY, [STEP; 2], &mut out), Ok(2));
    assert_eq!(out[2], mark);
    assert_eq!(fk(mark, [], &mut []), Ok(0));
}
