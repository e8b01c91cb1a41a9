//! Nearest points of the shapes.

use nalgebra::Vector3;
use superhelix::shapes::Sides;
use superhelix::{Error, Shape};

use super::random_bodies::{Dice, ball, bumpy, sheet};

/// Whether a point is inside.
type Inside = Box<dyn Fn(&Vector3<f64>) -> bool>;

/// Points of a shape's surface, so dense that none of the surface is farther than `spacing` from one, and whether a point is inside.
struct Sampled {
    shape: Shape,
    points: Vec<Vector3<f64>>,
    spacing: f64,
    inside: Inside,
}

const STEPS: usize = 70;

/// Points on the unit cube's surface.
fn cube_points() -> Vec<Vector3<f64>> {
    let mut points = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            for i in 0..=STEPS {
                for j in 0..=STEPS {
                    let place = |k: usize| 2.0 * k as f64 / STEPS as f64 - 1.0;
                    let mut point = Vector3::zeros();
                    (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (side, place(i), place(j));
                    points.push(point);
                }
            }
        }
    }
    points
}

fn triangle_points(vertices: &[Vector3<f64>], triangles: &[[u32; 3]]) -> (Vec<Vector3<f64>>, f64) {
    const CUTS: usize = 12;
    let (mut points, mut spacing) = (Vec::new(), 0.0_f64);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
        spacing = spacing.max((b - a).norm().max((c - a).norm()).max((c - b).norm()) / CUTS as f64);
        for i in 0..=CUTS {
            for j in 0..=CUTS - i {
                points.push(a + ((b - a) * i as f64 + (c - a) * j as f64) / CUTS as f64);
            }
        }
    }
    (points, spacing)
}

fn sampled() -> Vec<(&'static str, Sampled)> {
    let cube = cube_points();
    let cube_spacing = 2.0 / STEPS as f64;
    let sphere: Vec<Vector3<f64>> = cube.iter().map(|point| point.normalize()).collect();
    let half = Vector3::new(0.05, 0.02, 0.08);
    let axes = Vector3::new(0.03, 0.1, 0.06);
    let (a, b) = (Vector3::new(-0.03, 0.01, 0.0), Vector3::new(0.05, 0.02, -0.04));
    let to_axis = move |p: &Vector3<f64>| {
        let u = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        (p - a - (b - a) * u).norm()
    };
    let mut capsule: Vec<Vector3<f64>> = Vec::new();
    let across = (b - a).cross(&Vector3::z()).normalize();
    let other = (b - a).normalize().cross(&across);
    for u in 0..=100 {
        let centre = a + (b - a) * (f64::from(u) / 100.0);
        for turn in 0..200 {
            let angle = std::f64::consts::TAU * f64::from(turn) / 200.0;
            capsule.push(centre + (across * angle.cos() + other * angle.sin()) * 0.02);
        }
    }
    for end in [a, b] {
        capsule.extend(sphere.iter().map(|out| end + out * 0.02).filter(|p| (to_axis(p) - 0.02).abs() < 1e-12));
    }
    let (vertices, triangles) = bumpy(0.1, 3);
    let (mesh_points, mesh_spacing) = triangle_points(&vertices, &triangles);
    let solid = (vertices.clone(), triangles.clone());
    // Inside a surface that is seen whole from the middle: below the triangle in that direction.
    let inside_mesh = move |p: &Vector3<f64>| {
        let mut crossings = 0;
        let way = Vector3::new(0.917, 0.311, 0.253);
        for triangle in &solid.1 {
            let [a, b, c] = triangle.map(|vertex| solid.0[vertex as usize] - p);
            let volumes = [way.dot(&a.cross(&b)), way.dot(&b.cross(&c)), way.dot(&c.cross(&a))];
            let through = volumes.iter().all(|v| *v > 0.0) || volumes.iter().all(|v| *v < 0.0);
            let normal = (b - a).cross(&(c - a));
            crossings += usize::from(through && normal.dot(&a) / normal.dot(&way) > 0.0);
        }
        crossings % 2 == 1
    };
    let (corners, faces) = ball(0.07, 1);
    let (hull_points, hull_spacing) = triangle_points(&corners, &faces);
    let planes: Vec<(Vector3<f64>, Vector3<f64>)> = faces
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| corners[vertex as usize]);
            ((b - a).cross(&(c - a)).normalize(), a)
        })
        .collect();
    vec![
        (
            "sphere",
            Sampled {
                shape: Shape::new_sphere(0.05).unwrap(),
                points: sphere.iter().map(|p| p * 0.05).collect(),
                spacing: cube_spacing * 0.05,
                inside: Box::new(|p| p.norm() < 0.05),
            },
        ),
        (
            "capsule",
            Sampled {
                shape: Shape::new_capsule(a, b, 0.02).unwrap(),
                points: capsule,
                // Along the axis, and a little around it.
                spacing: (b - a).norm() / 100.0 + 0.0007,
                inside: Box::new(move |p| to_axis(p) < 0.02),
            },
        ),
        (
            "ellipsoid",
            Sampled {
                shape: Shape::new_ellipsoid(axes).unwrap(),
                points: sphere.iter().map(|p| p.component_mul(&axes)).collect(),
                spacing: cube_spacing * 0.1,
                inside: Box::new(move |p| p.component_div(&axes).norm() < 1.0),
            },
        ),
        (
            "box",
            Sampled {
                shape: Shape::new_box(half).unwrap(),
                points: cube.iter().map(|p| p.component_mul(&half)).collect(),
                spacing: cube_spacing * 0.08,
                inside: Box::new(move |p| (0..3).all(|axis| p[axis].abs() < half[axis])),
            },
        ),
        (
            "hull",
            Sampled {
                // Points within, which the hull leaves out.
                shape: Shape::new_hull(&corners.iter().flat_map(|p| [*p, p * 0.3]).collect::<Vec<_>>()).unwrap(),
                points: hull_points,
                spacing: hull_spacing,
                inside: Box::new(move |p| planes.iter().all(|(normal, on)| normal.dot(&(p - on)) < 0.0)),
            },
        ),
        (
            "mesh",
            Sampled {
                shape: Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap(),
                points: mesh_points,
                spacing: mesh_spacing,
                inside: Box::new(inside_mesh),
            },
        ),
    ]
}

#[test]
fn nearest_points_are_those_of_dense_sampling() {
    let mut dice = Dice(11);
    for (name, Sampled { shape, points, spacing, inside }) in sampled() {
        let (mut insides, mut outsides) = (0, 0);
        let bounds = shape.bounds().grown(0.03);
        for _ in 0..150 {
            let point = Vector3::from_fn(|axis, _| dice.between(bounds.low[axis], bounds.high[axis]));
            let surface = shape.closest(point, f64::INFINITY).unwrap();
            let sampled = points.iter().map(|p| (p - point).norm()).fold(f64::INFINITY, f64::min);
            let distance = surface.distance.abs();
            // The surface lies within the spacing of a sample: the nearest sample is no farther than that from the nearest point.
            assert!(distance <= sampled * (1.0 + 1e-9), "{name} {point}: {distance} {sampled}");
            assert!(sampled <= distance + spacing, "{name} {point}: {distance} {sampled}");
            assert_eq!(surface.distance < 0.0, inside(&point), "{name} {point}: {surface:?}");
            // The parts fit together.
            assert!((surface.point + surface.normal * surface.distance - point).norm() < 1e-12, "{name} {surface:?}");
            assert!((surface.normal.norm() - 1.0).abs() < 1e-12);
            let on = shape.closest(surface.point, f64::INFINITY).unwrap();
            assert!(on.distance.abs() < 1e-12, "{name} {on:?}");
            if inside(&point) {
                insides += 1
            } else {
                outsides += 1
            }
            // Nearness decides whether it is reported.
            assert!(shape.closest(point, surface.distance - 1e-9).is_none() || surface.distance < 0.0);
            assert!(shape.closest(point, surface.distance + 1e-9).is_some());
        }
        assert!(insides > 8 && outsides > 50, "{name}: {insides} inside, {outsides} outside");
    }
}

#[test]
fn an_ellipsoid_is_exact_where_iterations_are_hard() {
    // Flat, thin, and round ones; points in its planes of symmetry, on its axes, within its focal curve, far off.
    let mut dice = Dice(5);
    let mut worst: f64 = 0.0;
    for semi_axes in [[0.1, 0.1, 0.1], [0.1, 0.001, 0.05], [0.2, 0.2, 0.0005], [0.01, 0.3, 0.3], [0.1, 0.09999999, 0.1]] {
        let semi_axes = Vector3::from(semi_axes);
        let shape = Shape::new_ellipsoid(semi_axes).unwrap();
        for case in 0..600 {
            let mut point = dice.cube().component_mul(&semi_axes) * [1.2, 0.9, 0.01, 30.0][case % 4];
            for axis in 0..3 {
                match (case / 4 + axis) % 5 {
                    0 => point[axis] = 0.0,
                    1 => point[axis] *= 1e-14,
                    _ => {}
                }
            }
            let surface = shape.closest(point, f64::INFINITY).unwrap();
            let on = surface.point.component_div(&semi_axes).norm();
            assert!((on - 1.0).abs() < 1e-14, "{semi_axes} {point} {on}");
            // The offset from it is along the normal: nearest or farthest; and no point beside it is nearer.
            let out = point - surface.point;
            let across = out - surface.normal * surface.normal.dot(&out);
            worst = worst.max(across.norm() / (1e-3 * semi_axes.max() + out.norm()));
            for _ in 0..20 {
                let other = (surface.point.component_div(&semi_axes) + dice.cube() * 10f64.powf(-4.0 * dice.unit())).normalize();
                let other = (other.component_mul(&semi_axes) - point).norm();
                assert!(other >= out.norm() * (1.0 - 1e-9) - 1e-15, "{semi_axes} {point}: {other} {}", out.norm());
            }
        }
    }
    // Rounding of the point, against the distance to it.
    assert!(worst < 1e-9, "{worst}");
}

#[test]
fn a_half_space_is_a_plane() {
    let shape = Shape::new_half_space(Vector3::new(0.0, 0.0, 3e-200)).unwrap();
    let surface = shape.closest(Vector3::new(1.0, 2.0, -0.5), 0.0).unwrap();
    assert_eq!((surface.point, surface.normal, surface.distance), (Vector3::new(1.0, 2.0, 0.0), Vector3::z(), -0.5));
}

#[test]
fn sheets_have_sides() {
    let (vertices, triangles) = sheet(0.1, 3);
    let front = Shape::new_mesh(vertices.clone(), triangles.clone(), Sides::Front { depth: 0.01 }).unwrap();
    let both = Shape::new_mesh(vertices, triangles, Sides::Both).unwrap();
    let near = |shape: &Shape, z: f64, expected: Option<(f64, Vector3<f64>)>| {
        let found = shape.closest(Vector3::new(0.02, 0.03, z), 0.05).map(|surface| (surface.distance, surface.normal));
        assert_eq!(found, expected);
    };
    near(&front, 0.02, Some((0.02, Vector3::z())));
    near(&front, -0.005, Some((-0.005, Vector3::z())));
    near(&front, -0.02, None);
    near(&both, 0.02, Some((0.02, Vector3::z())));
    near(&both, -0.02, Some((0.02, -Vector3::z())));
    // Beyond the rim a point is beside the sheet.
    let beside = front.closest(Vector3::new(0.103, 0.0, -0.004), 0.05).unwrap();
    assert!((beside.distance - 0.005).abs() < 1e-15 && (beside.normal - Vector3::new(0.6, 0.0, -0.8)).norm() < 1e-12);
}

#[test]
fn bad_shapes_are_refused_by_name() {
    let says = |error: Error, argument: &str, value: &str| {
        let text = error.to_string();
        assert!(text.starts_with(argument) && text.contains(value), "{text}");
    };
    says(Shape::new_sphere(-1.0).unwrap_err(), "radius", "-1");
    says(Shape::new_sphere(f64::NAN).unwrap_err(), "radius", "NaN");
    says(Shape::new_capsule(Vector3::x(), Vector3::x(), 1.0).unwrap_err(), "b", "[1.0, 0.0, 0.0]");
    says(Shape::new_capsule(Vector3::x(), Vector3::new(0.0, f64::INFINITY, 0.0), 1.0).unwrap_err(), "b[1]", "inf");
    says(Shape::new_ellipsoid(Vector3::new(1.0, 0.0, 1.0)).unwrap_err(), "semi_axes[1]", "0");
    says(Shape::new_box(Vector3::new(1.0, 1.0, -2.0)).unwrap_err(), "half_edges[2]", "-2");
    says(Shape::new_half_space(Vector3::zeros()).unwrap_err(), "normal", "[0.0, 0.0, 0.0]");
    says(Shape::new_half_space(Vector3::new(f64::NAN, 0.0, 0.0)).unwrap_err(), "normal[0]", "NaN");
    says(Shape::new_hull(&[Vector3::x(); 3]).unwrap_err(), "points", "3");
    says(Shape::new_hull(&[Vector3::x(); 9]).unwrap_err(), "points", "9");
    let flat: Vec<_> = (0..9).map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), 0.5 * f64::from(k % 3))).collect();
    says(Shape::new_hull(&flat).unwrap_err(), "points", "without a volume");
    let (vertices, triangles) = ball(0.1, 0);
    let mesh =
        |vertices: &[Vector3<f64>], triangles: &[[u32; 3]], sides| Shape::new_mesh(vertices.into(), triangles.into(), sides);
    says(mesh(&vertices, &[], Sides::Solid).unwrap_err(), "triangles", "0 long");
    says(mesh(&vertices, &triangles[1..], Sides::Solid).unwrap_err(), "triangles[", "on 1 triangles");
    says(mesh(&vertices, &[[0, 1, 6]], Sides::Both).unwrap_err(), "triangles[0][2]", "6");
    says(mesh(&vertices, &[[0, 2, 4], [0, 0, 1]], Sides::Both).unwrap_err(), "triangles[1]", "[0, 0, 1]");
    says(mesh(&vertices, &[[0, 2, 4], [0, 2, 5]], Sides::Front { depth: 1.0 }).unwrap_err(), "triangles[0]", "wound alike");
    says(mesh(&vertices, &triangles, Sides::Front { depth: 0.0 }).unwrap_err(), "sides.depth", "0");
    let inward: Vec<_> = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    says(mesh(&vertices, &inward, Sides::Solid).unwrap_err(), "triangles", "holds -");
    let mut bad = vertices.clone();
    bad[2].y = f64::NAN;
    says(mesh(&bad, &triangles, Sides::Solid).unwrap_err(), "vertices[2][1]", "NaN");
}
