//! Ground: heights, normals, edges and what is drawn of it.

use glam::{DVec2, DVec3};
use motion::{Ground, GroundKind, Hills, HillsShape, Rise, Sheet, SheetError, Slope, Stairs};

fn places() -> impl Iterator<Item = (f64, f64)> {
    // Far and near, never on a grid line.
    (0..4000).map(|i| {
        let t = f64::from(i) * 0.731;
        (t.sin() * 90.0 + 0.013 * t, (1.7 * t).cos() * 90.0)
    })
}

#[test]
fn a_slope_rises_as_it_says() {
    let ground = Ground::Slope(Slope::new(25.0, 90.0));
    let point = ground.under(2.0, 7.0);
    assert!((point.height - 2.0 * 25.0f64.to_radians().tan()).abs() < 1e-12);
    assert!((point.normal.angle_between(DVec3::Y).to_degrees() - 25.0).abs() < 1e-9);
    assert!(point.normal.x < 0.0, "it leans back from where it rises to");
    assert_eq!(Ground::Slope(Slope::new(f64::NAN, 0.0)).under(1.0, 1.0).height, 0.0);
}

#[test]
fn the_steepest_facet_of_hills_is_25_degrees() {
    for seed in 1..4 {
        let hills = Hills::new(&HillsShape { seed, ..HillsShape::default() });
        assert!((hills.steepest_degrees() - 25.0).abs() < 1e-3, "{}", hills.steepest_degrees());
        let ground = GroundKind::Hills.ground(seed);
        let steepest =
            places().map(|(x, z)| ground.under(x, z).normal.angle_between(DVec3::Y)).fold(0.0, f64::max);
        assert!(steepest.to_degrees() < 25.001 && steepest.to_degrees() > 12.0, "{}", steepest.to_degrees());
    }
    let high = Hills::new(&HillsShape { rise: Rise::Amplitude(0.4), ..HillsShape::default() });
    assert!(high.steepest_degrees() > 1.0);
}

#[test]
fn hills_are_without_seams_and_their_normals_are_their_own() {
    let ground = GroundKind::Hills.ground(2);
    for (x, z) in places() {
        let (point, step) = (ground.under(x, z), 1e-7);
        for (dx, dz) in [(step, 0.0), (0.0, step)] {
            let there = ground.under(x + dx, z + dz);
            assert!((there.height - point.height).abs() < 0.5 * step + 1e-9, "a step at {x} {z}");
            if there.normal == point.normal {
                let rise = -(point.normal.x * dx + point.normal.z * dz) / point.normal.y;
                assert!((there.height - point.height - rise).abs() < 1e-10);
            }
        }
        assert_eq!(point.height, ground.height(x, z));
        // The tile of 64 m comes again.
        assert!((ground.height(x + 64.0, z - 64.0) - point.height).abs() < 1e-6);
    }
    assert_eq!(GroundKind::Hills.ground(2), ground);
    assert_ne!(GroundKind::Hills.ground(3), ground);
}

#[test]
fn stairs_go_up_stay_and_come_down() {
    let stairs = Ground::Stairs(Stairs::new(0.17, 0.29, 8, 3.0));
    let heights: Vec<f64> = (0..1200).map(|i| stairs.height(0.0, 0.01 * f64::from(i))).collect();
    assert_eq!(heights[0], 0.0);
    assert!((stairs.height(5.0, 1.51) - 0.17).abs() < 1e-12);
    assert!((stairs.height(5.0, 1.49) - 0.0).abs() < 1e-12);
    assert!((stairs.height(5.0, 1.5 + 7.0 * 0.29 + 0.01) - 8.0 * 0.17).abs() < 1e-12);
    for pair in heights.windows(2) {
        let step = (pair[1] - pair[0]).abs();
        assert!(step < 1e-12 || (step - 0.17).abs() < 1e-9);
    }
    let period = 2.0 * (3.0 + 7.0 * 0.29);
    assert!((stairs.height(0.0, period - 1e-3)).abs() < 1e-12);
    assert!((stairs.height(0.0, 3.0 + 0.5 * period) - stairs.height(0.0, 3.0 - 0.5 * period)).abs() < 1e-12);
}

#[test]
fn stones_have_tops_and_gaps() {
    let ground = GroundKind::Stones.ground(5);
    let (mut tops, mut gaps, mut tilted) = (0, 0, 0);
    for (x, z) in places() {
        let point = ground.under(x, z);
        let tilt = point.normal.angle_between(DVec3::Y).to_degrees();
        assert!(tilt < 6.5 && point.height > -0.15 && point.height < 0.15, "{point:?}");
        if point.height == -0.14 {
            gaps += 1;
        } else {
            tops += 1;
        }
        tilted += usize::from(tilt > 1.0);
    }
    assert!(tops > 3 * gaps && gaps > 200 && tilted > 500, "{tops} {gaps} {tilted}");
}

#[test]
fn a_mesh_answers_with_its_highest_sheet_or_the_one_below() {
    let square = |y: f64, slope: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, z)| DVec3::new(x, y + slope * x, z))
    };
    let positions = [square(0.0, 0.5), square(2.0, 0.0)].concat();
    let indices = [0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6];
    let ground = Ground::Mesh(Sheet::new(&positions, &indices).expect("a sheet").into());
    assert_eq!(ground.under(0.3, 0.7).height, 2.0);
    let low = ground.below(0.4, -0.7, 1.9);
    assert!((low.height - 0.2).abs() < 1e-12 && low.normal.y > 0.0 && low.normal.x < 0.0);
    // Beyond the edge it goes on level; below everything the lowest is it.
    assert!((ground.below(9.0, 0.0, 1.9).height - 0.5).abs() < 1e-12);
    assert!((ground.below(0.4, 0.0, -5.0).height - 0.2).abs() < 1e-12);
    assert_eq!(ground.under(f64::NAN, 0.0).height, 0.0);
}

#[test]
fn triangles_that_are_no_ground_say_why() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(Sheet::new(&points, &[0, 1]), Err(SheetError::Odd(2)));
    assert_eq!(
        Sheet::new(&points, &[0, 1, 7]),
        Err(SheetError::Index { triangle: 0, index: 7, vertices: 3 })
    );
    assert_eq!(Sheet::new(&points, &[0, 1, 2]), Err(SheetError::Empty(1)), "it stands upright");
    assert_eq!(Sheet::new(&[DVec3::NAN], &[]), Err(SheetError::NotFinite(0)));
}

#[test]
fn what_is_drawn_lies_on_the_ground() {
    for kind in GroundKind::ALL {
        let ground = kind.ground(3);
        assert_eq!(Ground::parse_kind(kind.name(), 3), Some(ground.clone()));
        let mesh = ground.patch(DVec2::new(3.3, 1.7), 4.0);
        assert_eq!(mesh.fault(), None, "{}", kind.name());
        assert!(mesh.vertex_count() > 60 && mesh.vertex_count() < 40_000, "{}", mesh.vertex_count());
        let mut upward = 0;
        for triangle in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|i| glam::Vec3::from(mesh.positions[i as usize]).as_dvec3());
            let face = (b - a).cross(c - a);
            let normal = glam::Vec3::from(mesh.normals[triangle[0] as usize]).as_dvec3();
            assert!(face.dot(normal) > 0.0, "{} shows its back", kind.name());
            let middle = (a + b + c) / 3.0;
            if normal.y > 0.5 {
                upward += 1;
                let off = (ground.height(middle.x, middle.z) - middle.y).abs();
                // The floor between stones lies under them, too.
                assert!(
                    off < 2e-3 || (kind == GroundKind::Stones && middle.y < -0.13),
                    "{} {off}",
                    kind.name()
                );
            }
        }
        assert!(upward > 30);
    }
    assert_eq!(Ground::parse_kind("moor", 1), None);
}
