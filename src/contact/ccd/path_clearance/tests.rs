//! Tests of strands that stay clear of a body, or do not.

use nalgebra::UnitQuaternion;

use super::*;
use crate::contact::shape::{DistanceGrid, Shape};
use crate::math::random::signed_numbers;

const LENGTH: f64 = 0.1;
const RADIUS: f64 = 5e-5;

/// Whether a straight strand along x that moves between these positions stays clear of a body that moves between these
/// poses.
fn is_clear(
    shape: &Shape,
    path: [Vector3<f64>; 2],
    radius: f64,
    permitted_overlap: Option<&PermittedOverlap>,
    poses: [Frame; 2],
) -> bool {
    let rows = [[0.0; 3]; 4];
    let root = path.map(|origin| Frame { origin, ..Frame::default() });
    let path =
        FreePath { lengths: &[LENGTH / 4.0; 4], root, curvatures: [&rows, &rows], exempt: 0.01, radius, permitted_overlap };
    path.is_clear_of([&BodyAt::new(0, shape, poses[0], poses[1], 0.0)], 1e-5, &mut ClearanceScratch::default())
}

fn still(shape: &Shape, path: [Vector3<f64>; 2]) -> bool {
    is_clear(shape, path, RADIUS, None, [Frame::default(); 2])
}

fn at(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// A square of 0.4 m in the plane z = 0.
fn square(sides: Sides) -> Shape {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| at(0.2 * x, 0.2 * y, 0.0));
    Shape::new_mesh(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], sides).unwrap()
}

/// A ball of 3 cm about (0.05, 0, 0), as it is and as a grid.
fn balls() -> [Shape; 2] {
    [Shape::new_sphere(0.03).unwrap(), field_of(|at| at.norm() - 0.03)]
}

/// A grid with cells of 4 mm.
fn field_of(distance: impl Fn(Vector3<f64>) -> f64) -> Shape {
    let (count, cell) = (40_u32, 4e-3);
    let low = Vector3::repeat(-0.5 * cell * f64::from(count - 1));
    let node = |k: u32| low + at(f64::from(k % count), f64::from(k / count % count), f64::from(k / (count * count))) * cell;
    let values: Vec<f32> = (0..count.pow(3)).map(|k| distance(node(k)) as f32).collect();
    Shape::new_grid(DistanceGrid::from_parts(low, cell, 0.03, [count; 3], values.into()).unwrap())
}

#[test]
fn a_ball_is_passed_by_and_met() {
    for ball in balls() {
        let pose = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }; 2];
        let meets = |from: Vector3<f64>, to: Vector3<f64>| !is_clear(&ball, [from, to], RADIUS, None, pose);
        assert!(!meets(at(0.0, 0.0, 0.033), at(0.0, 0.01, 0.033)));
        assert!(!meets(at(0.0, -0.05, 0.038), at(0.0, 0.05, 0.038)));
        assert!(meets(at(0.0, 0.0, 0.031), at(0.0, 0.0, 0.0299)));
        assert!(meets(at(0.0, 0.0, 0.0299), at(0.0, 0.0, 0.031)));
        // All the way through, and clear of it before and after.
        assert!(meets(at(0.0, -0.05, 0.01), at(0.0, 0.05, 0.01)));
        // What is exempt meets nothing.
        assert!(!meets(at(0.0705, 0.0, 0.0), at(0.0705, 0.0, 0.0)) && meets(at(0.0685, 0.0, 0.0), at(0.0685, 0.0, 0.0)));
    }
}

#[test]
fn an_approaching_body_hits_the_strand() {
    for ball in balls() {
        let strand = [at(0.0, 0.0, 0.05); 2];
        let goes = |to: Vector3<f64>, angle: f64| {
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
            let poses = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }, Frame { origin: to, rotation }];
            is_clear(&ball, strand, RADIUS, None, poses)
        };
        assert!(goes(at(0.05, 0.0, 0.0197), 0.2) && !goes(at(0.05, 0.0, 0.0203), 0.2));
        assert!(!goes(at(0.05, 0.0, 0.12), 0.0));
    }
}

#[test]
fn a_permitted_overlap_with_a_body_may_stay() {
    let permitted_overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![1.0], sunk: vec![0.002] };
    for ball in balls() {
        let pose = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }; 2];
        let is_clear = |z: f64| is_clear(&ball, [at(0.0, 0.0, z); 2], RADIUS, Some(&permitted_overlap), pose);
        assert!(is_clear(0.0282) && !is_clear(0.0279));
    }
}

/// Curved strands on straight paths past a ball with dents, as a grid that stands still or turns, as thick as what a dense sample of places and
/// times leaves free: a micrometre thicker, none is found clear; a fiftieth of a millimetre thinner, nineteen in twenty are.
#[test]
fn in_a_field_strands_are_found_clear_up_to_their_gap() {
    let ball = field_of(|at| at.norm() - 0.03 + 1e-3 * (250.0 * at.x).sin() * (250.0 * at.y).cos() * (250.0 * at.z).cos());
    let grid = ball.grid().unwrap();
    let mut number = signed_numbers(17);
    let (lengths, exempt) = ([0.02; 3], 0.003);
    let permitted_overlap =
        PermittedOverlap { along: vec![0.0, 0.013, 0.05], wisp_fractions: vec![1.0; 3], sunk: vec![0.004, 0.001, 0.0] };
    let (mut cases, mut found) = (0, 0);
    for case in 0..3000 {
        let mut vector = |size: f64| size * at(number(), number(), number());
        let toward = vector(1.0).normalize();
        let start = Frame { origin: toward * 0.034 + vector(0.003), rotation: UnitQuaternion::from_scaled_axis(vector(3.0)) };
        let moved = [0.0, 1e-3, 1e-2][case % 3];
        let end = Frame {
            origin: start.origin + vector(moved),
            rotation: UnitQuaternion::from_scaled_axis(vector(20.0 * moved)) * start.rotation,
        };
        let rows: [[f64; 3]; 3] = std::array::from_fn(|_| vector(25.0).into());
        let rows_after = rows.map(|row| (Vector3::from(row) + vector(500.0 * moved)).into());
        let poses =
            [Frame::default(), Frame { rotation: UnitQuaternion::from_scaled_axis(vector(10.0 * moved)), ..Frame::default() }];
        let sunk = (case % 2 == 0).then_some(&permitted_overlap);
        let is_clear = |radius: f64| {
            let path = FreePath {
                lengths: &lengths,
                root: [start, end],
                curvatures: [&rows, &rows_after],
                exempt,
                radius,
                permitted_overlap: sunk,
            };
            let body = BodyAt::new(0, &ball, poses[0], poses[1], 0.0);
            path.is_clear_of([&body], 0.0, &mut ClearanceScratch::default())
        };
        let mut ends = [Vec::new(), Vec::new()];
        for (k, rows) in [rows, rows_after].iter().enumerate() {
            let root = poses[k].inverse().compose(&[start, end][k]);
            element_states(rotation_matrix(&root), lengths, rows, &mut ends[k]);
            ends[k].iter_mut().for_each(|state| state.origin_left += Vec3(root.origin.into()));
        }
        let mut gap = f64::INFINITY;
        for (k, length) in lengths.iter().enumerate() {
            for step in 0..=60 {
                let s = length * f64::from(step) / 60.0;
                let along = s + 0.02 * k as f64;
                if along < exempt {
                    continue;
                }
                let [from, to] = [0, 1].map(|end: usize| Vector3::from(ends[end][k].point(s).position));
                for time in 0..=20 {
                    let distance = grid.closest(from.lerp(&to, f64::from(time) / 20.0)).map_or(1.0, |surface| surface.distance);
                    gap = gap.min(distance + sunk.map_or(0.0, |overlap| overlap.sunk(along)));
                }
            }
        }
        if gap > 2e-5 {
            assert!(!is_clear(gap + 1e-6), "case {case}: {gap:e} m");
            (cases, found) = (cases + 1, found + usize::from(is_clear(gap - 2e-5)));
        }
    }
    assert!(cases > 1000 && found * 100 >= 95 * cases, "{found} of {cases}");
}

/// A strand that lies on a ball along a great circle, from its root in the surface to its tip, a micrometre off or a micrometre in it.
#[test]
fn what_lies_on_a_field_all_along_is_found_clear() {
    let [_, ball] = balls();
    let lies = |gap: f64| {
        let radius = 0.03 + RADIUS + gap;
        let root = [Frame { origin: at(0.0, 0.0, radius), ..Frame::default() }; 2];
        let rows = [[0.0, 1.0 / radius, 0.0]; 4];
        let path = FreePath {
            lengths: &[0.01; 4],
            root,
            curvatures: [&rows, &rows],
            exempt: 0.0,
            radius: RADIUS,
            permitted_overlap: None,
        };
        path.is_clear_of([&BodyAt::new(0, &ball, Frame::default(), Frame::default(), 0.0)], 0.0, &mut ClearanceScratch::default())
    };
    // (Interpolated, the ball is off by some micrometres.)
    assert!(lies(2e-5) && !lies(-2e-5));
}

/// What glides past a tooth of a comb, a micrometre off it, is clear of it; what grazes it is not.
#[test]
fn a_tooth_is_passed_closely() {
    let axis = at(0.06, 0.0, -0.004);
    for curvature in [0.0, 8.0] {
        let rows = [[0.0, curvature, 0.0]; 4];
        let mut elements = Vec::new();
        element_states(rotation_matrix(&Frame::default()), [LENGTH / 4.0; 4], &rows, &mut elements);
        let places =
            elements.iter().flat_map(|element| (0..=1000).map(|k| element.point(f64::from(k) * LENGTH / 4000.0).position));
        let nearest = places.map(|place| (axis.xz() - Vector3::from(place).xz()).norm()).fold(f64::INFINITY, f64::min);
        let passes = |gap: f64| {
            let along = Vector3::y() * 0.05;
            let tooth = Shape::new_capsule(axis - along, axis + along, nearest - RADIUS - gap).unwrap();
            let root = [0.0, 3e-4].map(|y| Frame { origin: at(0.0, y, 0.0), ..Frame::default() });
            let lengths = &[LENGTH / 4.0; 4];
            let path =
                FreePath { lengths, root, curvatures: [&rows, &rows], exempt: 0.01, radius: RADIUS, permitted_overlap: None };
            let body = BodyAt::new(0, &tooth, Frame::default(), Frame::default(), 0.0);
            path.is_clear_of([&body], 0.0, &mut ClearanceScratch::default())
        };
        assert!(passes(1e-6) && !passes(-1e-6), "{curvature}");
    }
}

/// There is room on both sides of a sheet, and no path from one to the other, whatever the strand's permitted overlap with
/// bodies that have an inside.
#[test]
fn a_sheet_is_not_passed_through() {
    let (sheet, front) = (square(Sides::Both), square(Sides::Front { depth: 0.01 }));
    let permitted_overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![1.0], sunk: vec![0.002] };
    for (radius, permitted_overlap) in [(RADIUS, None), (0.0, None), (RADIUS, Some(&permitted_overlap))] {
        let is_clear = |from: f64, to: f64| {
            is_clear(&sheet, [at(-0.05, 0.0, from), at(-0.05, 0.01, to)], radius, permitted_overlap, [Frame::default(); 2])
        };
        assert!(is_clear(0.001, 0.02) && is_clear(-0.001, -0.02));
        for depth in [1e-4, 1e-3, 0.05] {
            assert!(!is_clear(0.001, -depth) && !is_clear(-depth, 0.001), "{radius} {depth}");
        }
    }
    // Behind a mesh that acts on one side distances jump.
    assert!(
        !still(&front, [at(-0.05, 0.0, 0.01), at(-0.05, 0.0, -0.1)])
            && !can_decide(&BodyAt::new(0, &front, Frame::default(), Frame::default(), 0.0))
    );
}
