//! Cells between the points of axis blends: they fit together, and weights go along without jumps.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use motion::{Cells, CellsError, MOST_POINTS};
use seeded::Seeded;

type Point = [f64; 3];

/// Points on grids and circles, in a row, and anywhere: what triangulations stumble over.
fn layouts(dims: usize) -> Vec<Vec<Point>> {
    let mut seeded = Seeded(7);
    let mut all = Vec::new();
    for count in [dims + 1, 7, 12, MOST_POINTS] {
        let mut points: Vec<Point> = Vec::new();
        while points.len() < count {
            let mut point = [0.0; 3];
            point[..dims].fill_with(|| seeded.between(-3.0, 5.0));
            let far = |other: &Point| distance(*other, point) > 0.1;
            if points.iter().all(far) {
                points.push(point);
            }
        }
        all.push(points);
    }
    match dims {
        1 => all.push((0..MOST_POINTS).map(|i| [i as f64 * 0.1, 0.0, 0.0]).collect()),
        2 => {
            all.push((0..24).map(|i| [f64::from(i % 6) * 0.1, f64::from(i / 6) * 30.0, 0.0]).collect());
            let turn = |i: i32| f64::from(i) * std::f64::consts::TAU / 12.0;
            let mut circle: Vec<Point> = (0..12).map(|i| [turn(i).cos(), turn(i).sin(), 0.0]).collect();
            all.push(circle.clone());
            circle.push([0.0; 3]);
            all.push(circle);
        }
        _ => {
            let on_grid = |i: i32| [f64::from(i % 2), f64::from(i / 2 % 3) * 0.7, f64::from(i / 6) * 45.0];
            all.push((0..24).map(on_grid).collect());
            all.push((0..8).map(on_grid_of_two).collect());
            let mut octahedron = vec![[0.0; 3]];
            for axis in 0..3 {
                for sign in [-1.0, 1.0] {
                    let mut point = [0.0; 3];
                    point[axis] = sign;
                    octahedron.push(point);
                }
            }
            all.push(octahedron);
        }
    }
    all
}

fn on_grid_of_two(i: i32) -> Point {
    [f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)]
}

fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

fn weights(cells: &Cells, points: &[Point], place: Point) -> Vec<f64> {
    let mut weights = vec![f64::NAN; points.len()];
    cells.weights(place, &mut weights);
    weights
}

/// The place that the weights stand for.
fn place_of(weights: &[f64], points: &[Point]) -> Point {
    let mut place = [0.0; 3];
    for (weight, point) in weights.iter().zip(points) {
        (0..3).for_each(|i| place[i] += weight * point[i]);
    }
    place
}

/// The content of a cell, times a constant.
fn content(points: &[Point], corners: &[usize], dims: usize) -> f64 {
    let edge = |i: usize| {
        let mut edge = [0.0; 3];
        (0..3).for_each(|axis| edge[axis] = points[corners[i]][axis] - points[corners[0]][axis]);
        glam::DVec3::from(edge)
    };
    match dims {
        1 => edge(1).x.abs(),
        2 => edge(1).cross(edge(2)).z.abs(),
        _ => edge(1).cross(edge(2)).dot(edge(3)).abs(),
    }
}

#[test]
fn weights_are_parts_of_one_and_stand_for_the_place() {
    for dims in 1..=3 {
        for points in layouts(dims) {
            let cells = Cells::between(&points, dims).unwrap();
            let mut seeded = Seeded(3);
            for _ in 0..2000 {
                // A mean of all points with random weights is inside the hull.
                let parts: Vec<f64> = points.iter().map(|_| seeded.unit().powi(6)).collect();
                let sum: f64 = parts.iter().sum();
                let parts: Vec<f64> = parts.iter().map(|part| part / sum).collect();
                let place = place_of(&parts, &points);
                let weights = weights(&cells, &points, place);
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)));
                assert!(weights.iter().filter(|w| **w > 0.0).count() <= dims + 1);
                let back = place_of(&weights, &points);
                assert!(distance(back, place) < 1e-9 * 100.0, "{dims}: {place:?} became {back:?}");
            }
        }
    }
}

#[test]
fn cells_cover_the_hull_once() {
    for dims in 1..=3 {
        for points in layouts(dims) {
            let cells = Cells::between(&points, dims).unwrap();
            let corners: Vec<Vec<usize>> = cells.corners().map(<[usize]>::to_vec).collect();
            // What is made passes the checks of what is given: no overlap, no gap, no point on another cell's edge.
            let again = Cells::given(&points, dims, &corners);
            assert!(again.is_ok(), "{dims}, {points:?}: {again:?}");
        }
    }
    // Known contents: a box of 0.5 by 90, a cube.
    for (dims, points, whole) in
        [(2, layouts(2)[4].clone(), 0.5 * 90.0 * 2.0), (3, layouts(3)[5].clone(), 6.0)]
    {
        let cells = Cells::between(&points, dims).unwrap();
        let sum: f64 = cells.corners().map(|corners| content(&points, corners, dims)).sum();
        assert!((sum - whole).abs() < 1e-9, "{sum} of {whole}");
    }
}

#[test]
fn points_have_the_whole_weight_at_their_places() {
    for dims in 1..=3 {
        for points in layouts(dims) {
            let cells = Cells::between(&points, dims).unwrap();
            for (p, place) in points.iter().enumerate() {
                let weights = weights(&cells, &points, *place);
                for (other, weight) in weights.into_iter().enumerate() {
                    assert_eq!(weight, if other == p { 1.0 } else { 0.0 }, "{dims}: {points:?} at {p}");
                }
            }
        }
    }
}

#[test]
fn weights_go_along_without_jumps_inside_and_far_outside() {
    for dims in 1..=3 {
        for points in layouts(dims) {
            let cells = Cells::between(&points, dims).unwrap();
            let mut seeded = Seeded(11);
            for _ in 0..40 {
                let mut ends = [[0.0; 3]; 2];
                for end in &mut ends {
                    end[..dims].fill_with(|| seeded.between(-20.0, 20.0));
                }
                let at = |t: f64| std::array::from_fn(|i| ends[0][i] + (ends[1][i] - ends[0][i]) * t);
                let change = |a: f64, b: f64| {
                    let (a, b) = (weights(&cells, &points, at(a)), weights(&cells, &points, at(b)));
                    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                };
                // A jump stays as high in whichever half it is, a steep slope doesn't.
                let steps = (0..400).map(|i| (f64::from(i) / 400.0, f64::from(i + 1) / 400.0));
                let greatest = steps.max_by(|x, y| change(x.0, x.1).total_cmp(&change(y.0, y.1)));
                let (mut from, mut to) = greatest.unwrap();
                for _ in 0..28 {
                    let middle = (from + to) / 2.0;
                    if change(from, middle) > change(middle, to) { to = middle } else { from = middle }
                }
                assert!(change(from, to) < 1e-6, "{dims}: {points:?}: {:?}", at(from));
            }
        }
    }
}

#[test]
fn far_outside_the_nearest_place_of_the_hull_counts() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let cells = Cells::between(&square, 2).unwrap();
    assert_eq!(weights(&cells, &square, [9.0, 9.0, 0.0]), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(weights(&cells, &square, [0.25, -1e6, 0.0]), [0.75, 0.25, 0.0, 0.0]);
    let row = [[2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let cells = Cells::between(&row, 1).unwrap();
    assert_eq!(weights(&cells, &row, [1.25, 0.0, 0.0]), [0.25, 0.0, 0.75]);
    assert_eq!(weights(&cells, &row, [-1e6, 0.0, 0.0]), [0.0, 1.0, 0.0]);
}

#[test]
fn bad_points_and_cells_are_told() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let given = |cells: &[&[usize]]| {
        let cells: Vec<Vec<usize>> = cells.iter().map(|cell| cell.to_vec()).collect();
        Cells::given(&square, 2, &cells)
    };
    assert!(given(&[&[0, 1, 2], &[1, 3, 2]]).is_ok());
    assert_eq!(given(&[&[0, 1, 2], &[0, 1, 3]]), Err(CellsError::Overlap { cell: 1, other: 0 }));
    assert_eq!(given(&[&[0, 1, 2], &[1, 3]]), Err(CellsError::Corners { cell: 1, corners: 3, points: 4 }));
    assert_eq!(given(&[&[0, 1, 4]]), Err(CellsError::Corners { cell: 0, corners: 3, points: 4 }));
    assert_eq!(given(&[&[0, 1, 2]]), Err(CellsError::Gap { covered: 0.5 }));
    let with_middle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0]];
    assert_eq!(Cells::given(&with_middle, 2, &[vec![0, 1, 2]]), Err(CellsError::Holds { cell: 0, point: 3 }));
    assert_eq!(Cells::given(&with_middle, 2, &[vec![0, 3, 1]]), Err(CellsError::Flat { cell: 0 }));
    assert_eq!(Cells::between(&square[..2], 2), Err(CellsError::Count { found: 2, least: 3, dims: 2 }));
    assert_eq!(
        Cells::between(&[square[0], square[3], [0.5, 0.5, 0.0]], 2),
        Err(CellsError::Degenerate { dims: 2 })
    );
    assert_eq!(
        Cells::between(&[square[0], square[1], square[2], square[1]], 2),
        Err(CellsError::Doubled { point: 3, other: 1 })
    );
}
