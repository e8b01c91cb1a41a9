//! Bodies that go through strands within a step, and strands that go through bodies.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::contact::body_at::BodyAt;
use superhelix::shapes::{DistanceGrid, Mesh, Sides};
use superhelix::{Frame, Shape};

use super::random_bodies::{Dice, Moving, ball, sheet, strand};

const LENGTH: f64 = 0.02;
const RADIUS: f64 = 5e-5;

fn pose(origin: Vector3<f64>) -> Frame {
    Frame { origin, rotation: UnitQuaternion::identity() }
}

/// A closed tooth of triangles: a thin prism along y of half width `half`.
fn prism(half: f64) -> Shape {
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        Vector3::new(half * sign(0), 0.03 * sign(1), half * sign(2))
    };
    let vertices: Vec<_> = (0..8).map(corner).collect();
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()
}

#[test]
fn a_comb_tooth_does_not_pass() {
    // A tooth of 1 mm at 2 m/s against a strand across its way: the strand stays ahead of it.
    let tooth = Shape::new_capsule(-0.03 * Vector3::y(), 0.03 * Vector3::y(), 0.0005).unwrap();
    for shape in [tooth, prism(0.0005)] {
        for h in [1.0 / 60.0, 1.0 / 30.0] {
            for turn in 0..5 {
                // The strand along x, bent or straight; the tooth comes along directions in the plane across its own axis.
                let angle = 0.3 * (f64::from(turn) - 2.0);
                let way = UnitQuaternion::from_scaled_axis(Vector3::y() * angle) * Vector3::z() * (2.0 * h);
                let place = Vector3::new(0.037, 0.0, 0.0);
                for curl in [0.0, 8.0] {
                    let strand = strand(&UnitQuaternion::identity(), LENGTH, &[[0.0, curl, 0.0]; 4]);
                    let moving = Moving::still(Vector3::zeros(), strand);
                    let on = moving.path().now.position(1, place.x - LENGTH);
                    let body = BodyAt::new(7, &shape, pose(on - way * 0.6), pose(on + way * 0.4), 0.0);
                    let found = moving.contacts(RADIUS, &body, 1e-3);
                    let hit = found.iter().filter(|contact| contact.gap < 0.0).collect::<Vec<_>>();
                    assert!(!hit.is_empty(), "h {h}, turn {turn}, curl {curl}: {found:?}");
                    for contact in &hit {
                        assert!(contact.normal.dot(&way.normalize()) > 0.5, "{contact:?}");
                        assert!((contact.carried - way).norm() < 1e-15);
                    }
                    if turn == 2 && curl == 0.0 {
                        // Straight on: what the tooth went beyond the strand, and both thicknesses.
                        let deepest = hit.iter().map(|contact| contact.gap).fold(0.0, f64::min);
                        let expected = -(0.4 * 2.0 * h + 0.0005 + RADIUS);
                        assert!((deepest - expected).abs() < 1e-9, "{deepest} {expected}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_strand_does_not_pass_a_sheet() {
    let (vertices, triangles) = sheet(0.05, 7);
    let mut dice = Dice(8);
    let both = Shape::new_mesh(vertices.clone(), triangles.clone(), Sides::Both).unwrap();
    let front = Shape::new_mesh(vertices, triangles, Sides::Front { depth: 0.002 }).unwrap();
    for case in 0..60 {
        let below = case % 2 == 0;
        let shape = if case % 3 == 2 { &front } else { &both };
        let below = below && case % 3 != 2;
        // Towards the sheet at several metres per second, askew, turning slightly.
        let side = if below { -1.0 } else { 1.0 };
        let curvatures = [[dice.between(-9.0, 9.0), dice.between(-9.0, 9.0), dice.between(-9.0, 9.0)]; 3];
        let flat = UnitQuaternion::from_scaled_axis(Vector3::z() * dice.between(0.0, 6.0));
        let turned = UnitQuaternion::from_scaled_axis(dice.cube() * 0.2) * flat;
        let origin = Vector3::new(dice.between(-0.01, 0.01), dice.between(-0.01, 0.01), 0.0) - flat * Vector3::x() * 0.03;
        let start = (origin + Vector3::z() * side * 0.04, strand(&flat, LENGTH, &curvatures));
        let depth = dice.between(0.0205, 0.05);
        let now = (origin - Vector3::z() * side * depth, strand(&turned, LENGTH, &curvatures));
        let moving = Moving { start, now };
        let pose = Frame { origin: dice.cube(), rotation: dice.rotation() };
        let world = Moving {
            start: carry(&pose, &moving.start, &flat, &curvatures),
            now: carry(&pose, &moving.now, &turned, &curvatures),
        };
        let body = BodyAt::new(7, shape, pose, pose, 0.0);
        let found = world.contacts(RADIUS, &body, 1e-3);
        let normal = pose.rotation * Vector3::z() * side;
        // All that is through is held: the lowest point of each element that lies beyond the sheet.
        for element in 0..3 {
            let heights: Vec<f64> =
                (0..=20).map(|k| side * moving.path().now.position(element, LENGTH * f64::from(k) / 20.0).z).collect();
            if heights.iter().all(|height| *height < -0.001) {
                let deepest = found
                    .iter()
                    .filter(|contact| contact.point.element as usize == element && contact.normal.dot(&normal) > 0.9)
                    .map(|contact| contact.gap)
                    .fold(0.0, f64::min);
                assert!(deepest < -0.001, "case {case}, element {element}: {found:#?}");
            }
        }
        assert!(found.iter().all(|contact| contact.normal.dot(&normal) > -1e-9), "case {case}: {found:#?}");
    }
}

/// A strand of local axes in the world.
fn carry(
    pose: &Frame,
    (origin, _): &(Vector3<f64>, Vec<superhelix::internals::rod::kinematics::ElementState<f64>>),
    rotation: &UnitQuaternion<f64>,
    curvatures: &[[f64; 3]],
) -> (Vector3<f64>, Vec<superhelix::internals::rod::kinematics::ElementState<f64>>) {
    (pose.origin + pose.rotation * origin, strand(&(pose.rotation * rotation), LENGTH, curvatures))
}

#[test]
fn a_strand_may_pass_around_a_rim() {
    let (vertices, triangles) = sheet(0.05, 4);
    let shape = Shape::new_mesh(vertices, triangles, Sides::Both).unwrap();
    let body = BodyAt::new(7, &shape, Frame::default(), Frame::default(), 0.0);
    let moving = Moving::carried(
        Vector3::new(0.052, -0.03, 0.03),
        -0.06 * Vector3::z(),
        strand(&UnitQuaternion::from_scaled_axis(Vector3::z() * 1.57), LENGTH, &[[0.0; 3]; 3]),
    );
    assert_eq!(moving.contacts(RADIUS, &body, 1e-3), []);
}

/// What dense sampling of time finds: places of a strand that go through the body, coming from outside: element, s, normal on entry (local).
fn sampled_hits(moving: &Moving, body: &BodyAt, level: f64) -> Vec<(usize, f64, Vector3<f64>)> {
    const TIMES: usize = 400;
    let path = moving.path();
    let mut hits = Vec::new();
    for element in 0..path.now.elements.len() {
        for k in 0..=20 {
            let s = LENGTH * f64::from(k) / 20.0;
            let before = body.start.rotation.inverse() * (path.start.position(element, s) - body.start.origin);
            let now = body.end.rotation.inverse() * (path.now.position(element, s) - body.end.origin);
            let at = |time: usize| before + (now - before) * (time as f64 / TIMES as f64);
            let mut entry = None;
            for time in 0..=TIMES {
                let Some(surface) = body.shape.closest(at(time), f64::INFINITY) else { continue };
                if time == 0 && surface.distance < 2.0 * level {
                    break;
                }
                if surface.distance < level && entry.is_none() {
                    entry = Some(surface);
                }
                // Through the surface and, at the end, still behind the plane at which it came in.
                if let Some(entry) = entry
                    && surface.distance < -level
                    && entry.normal.dot(&(now - entry.point)) < -0.003
                {
                    hits.push((element, s, entry.normal));
                    break;
                }
            }
        }
    }
    hits
}

#[test]
fn sweeps_agree_with_dense_sampling_of_time() {
    let mut dice = Dice(31);
    let (vertices, triangles) = ball(0.004, 2);
    let mesh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    let shapes = [
        ("capsule", Shape::new_capsule(-0.03 * Vector3::y(), 0.03 * Vector3::y(), 0.0005).unwrap()),
        ("sphere", Shape::new_sphere(0.004).unwrap()),
        ("ellipsoid", Shape::new_ellipsoid(Vector3::new(0.03, 0.001, 0.02)).unwrap()),
        ("plate", Shape::new_box(Vector3::new(0.03, 0.03, 0.0005)).unwrap()),
        ("hull", Shape::new_hull(&vertices).unwrap()),
        ("mesh", Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()),
        ("tooth of triangles", prism(0.0005)),
        ("grid", Shape::new_grid(DistanceGrid::bake(&mesh, 0.0008, 0.003).unwrap())),
    ];
    for (name, shape) in shapes {
        let (mut expected, mut sideways) = (0, 0);
        for case in 0..40 {
            // The body flies and turns through strands that move and bend.
            let curvatures = |dice: &mut Dice| -> Vec<[f64; 3]> {
                (0..3).map(|_| [dice.between(-9.0, 9.0), dice.between(-9.0, 9.0), dice.between(-9.0, 9.0)]).collect()
            };
            let rotation = dice.rotation();
            let middle = rotation * Vector3::x() * 0.03;
            let (first, last) = (curvatures(&mut dice), curvatures(&mut dice));
            let moving = Moving {
                start: (-middle + dice.cube() * 0.004, strand(&rotation, LENGTH, &first)),
                now: (-middle + dice.cube() * 0.004, strand(&rotation, LENGTH, &last)),
            };
            let way = dice.direction() * dice.between(0.03, 0.07);
            let (turn, place) = (dice.rotation(), dice.cube() * 0.01);
            let twist = UnitQuaternion::from_scaled_axis(dice.cube() * 0.5);
            let start = Frame { origin: place - way * 0.5, rotation: turn };
            let end = Frame { origin: place + way * 0.5, rotation: twist * turn };
            let body = BodyAt::new(7, &shape, start, end, 0.0);
            let thickness = 2e-4;
            let found = moving.contacts(thickness, &body, 1e-3);
            for (element, s, normal) in sampled_hits(&moving, &body, 0.5 * thickness) {
                expected += 1;
                let normal = end.rotation * normal;
                // It is held nearby: pieces of strand are held at the place that is hit first, and from there.
                let near = found.iter().filter(|contact| {
                    let along = (f64::from(contact.point.element) - element as f64) * LENGTH + contact.point.s - s;
                    contact.gap < 0.0 && along.abs() < 0.51 * LENGTH
                });
                let agreement = near.map(|contact| contact.normal.dot(&normal)).fold(f64::NEG_INFINITY, f64::max);
                assert!(agreement.is_finite(), "{name} {case}: element {element} at {s}, normal {normal}: {found:#?}");
                sideways += usize::from(agreement < 0.0);
            }
        }
        // Where body and strand turn against each other, parts of one piece may come from two sides.
        assert!(sideways * 10 <= expected, "{name}: {sideways} of {expected} held from another side");
        assert!(expected > 30, "{name}: {expected} expected");
    }
}

#[test]
fn a_deforming_sheet_takes_the_strand_along() {
    let (vertices, triangles) = sheet(0.05, 6);
    let mut mesh = Mesh::new(vertices.clone(), triangles, Sides::Both).unwrap();
    // It bulges through the strand within the step.
    let bulged: Vec<_> = vertices.iter().map(|v| v + Vector3::z() * (0.03 - 8.0 * (v.x * v.x + v.y * v.y))).collect();
    mesh.set_vertices(&bulged).unwrap();
    let shape = Shape::from(mesh);
    let body = BodyAt::new(7, &shape, Frame::default(), Frame::default(), 0.0);
    let moving = Moving::still(Vector3::new(-0.03, 0.0, 0.01), strand(&UnitQuaternion::identity(), LENGTH, &[[0.0; 3]; 3]));
    let found = moving.contacts(RADIUS, &body, 1e-3);
    let middle = found.iter().find(|contact| contact.point.element == 1 && contact.gap < -0.015);
    let middle = middle.unwrap_or_else(|| panic!("{found:#?}"));
    assert!(middle.normal.z > 0.9 && middle.carried.z > 0.02 && middle.carried.z < 0.0301, "{middle:?}");
    assert!(found.iter().all(|contact| contact.normal.z > 0.0), "{found:#?}");
}

/// A strand drawn round something convex passes through it on the straight path of a step. If it comes out on its own side it is
/// not in it, and the plane at its entry must not push it out. If it comes out behind, it went through.
#[test]
fn a_strand_pulled_round_a_corner_does_not_enter_it() {
    const ROUND: f64 = 0.015;
    let (vertices, triangles) = ball(ROUND, 4);
    let mesh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    let grid = Shape::new_grid(DistanceGrid::bake(&mesh, 0.001, 0.01).unwrap());
    let smooth = Shape::new_sphere(ROUND).unwrap();
    let mesh = Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap();
    // Along y across the motion, which is along x: its elements' ends touch nothing.
    let across = UnitQuaternion::from_scaled_axis(Vector3::z() * std::f64::consts::FRAC_PI_2);
    let straight = strand(&across, LENGTH, &[[0.0; 3]; 1]);
    for (name, shape) in [("grid", &grid), ("sphere", &smooth), ("mesh", &mesh)] {
        let body = BodyAt::new(7, shape, Frame::default(), Frame::default(), 0.0);
        // A mesh's corners have normals of their own.
        let farthest = if name == "mesh" { 1.0 } else { 1.4 };
        for (turn, behind) in [(0.3, false), (0.6, false), (0.8, false), (farthest, false), (2.6, true), (3.0, true)] {
            let out = ROUND + RADIUS + 3e-4;
            let at = |angle: f64| out * Vector3::new(angle.sin(), 0.0, angle.cos()) - 0.5 * LENGTH * Vector3::y();
            let (from, to) = (at(-0.5 * turn), at(0.5 * turn));
            let found = Moving::carried(from, to - from, straight.clone()).contacts(RADIUS, &body, 1e-3);
            assert_eq!(found.iter().any(|contact| contact.gap < 0.0), behind, "{name}, {turn} rad: {found:?}");
            // Its distance is reported all the same.
            assert!(behind || found.iter().any(|contact| (contact.gap - 3e-4).abs() < 1e-4), "{name}, {turn} rad: {found:?}");
        }
    }
}

/// Wherever a fast body's corner, edge or face ran into a strand: what is deep in it at the step's end is touched there, and from the side that it came
/// from pushed out.
#[test]
fn no_piece_hit_by_a_body_is_left_in_it() {
    /// The spacing of sampled places, and the depth that counts as deep, m.
    const APART: f64 = 1e-4;
    const DEEP: f64 = 2e-4;
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(Vector3::from);
    let tetrahedron = |size: f64| {
        let vertices = corners.iter().map(|corner| corner * size).collect();
        Shape::new_mesh(vertices, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], Sides::Solid).unwrap()
    };
    let mut dice = Dice(23);
    let (mut runs, mut cases) = (0, 0);
    for case in 0..4000 {
        let size = dice.between(3e-3, 3e-2);
        let shape = match case % 4 {
            0 => Shape::new_box(Vector3::from_fn(|_, _| size * dice.between(0.3, 1.0))).unwrap(),
            1 => tetrahedron(size),
            2 => Shape::new_hull(&(0..12).map(|_| dice.cube() * size).collect::<Vec<_>>()).unwrap(),
            _ => Shape::new_ellipsoid(Vector3::from_fn(|_, _| size * dice.between(0.3, 1.0))).unwrap(),
        };
        let curvatures: Vec<[f64; 3]> = (0..3).map(|_| dice.cube().map(|k| 12.0 * k).into()).collect();
        let moving = Moving::still(Vector3::zeros(), strand(&dice.rotation(), LENGTH, &curvatures));
        // Past a place of the strand, from where it is clear of all of it.
        let aim = moving.path().now.position(1, 0.5 * LENGTH) + dice.cube() * size;
        let rotation = dice.rotation();
        let way = dice.direction() * dice.between(0.5, 4.0) * size;
        let spin = UnitQuaternion::from_scaled_axis(dice.cube() * 0.2);
        let (start, end) = (Frame { origin: aim - way, rotation }, Frame { origin: aim, rotation: spin * rotation });
        let places: Vec<(f64, Vector3<f64>)> = (0..(3.0 * LENGTH / APART) as usize)
            .map(|k| {
                (k as f64 * APART, moving.path().now.position((k as f64 * APART / LENGTH) as usize, k as f64 * APART % LENGTH))
            })
            .collect();
        let depth = |frame: &Frame, at: &Vector3<f64>| {
            let local = frame.rotation.inverse() * (at - frame.origin);
            shape.closest(local, 1e-3).map_or(0.0, |surface| -surface.distance)
        };
        if places.iter().any(|(_, at)| depth(&start, at) != 0.0) {
            continue;
        }
        cases += 1;
        let body = BodyAt::new(7, &shape, start, end, 0.0);
        let found: Vec<(f64, f64)> = moving
            .contacts(RADIUS, &body, 0.0)
            .iter()
            .map(|contact| (moving.path().now.along(contact.point.element as usize, contact.point.s), contact.gap))
            .collect();
        // Pieces of the strand that are in the body: where, and how deep.
        let mut pieces: Vec<[f64; 3]> = Vec::new();
        for (along, at) in &places {
            let deep = depth(&end, at);
            match pieces.last_mut() {
                Some([_, to, deepest]) if deep > 0.0 && along - *to < 1.5 * APART => {
                    (*to, *deepest) = (*along, deepest.max(deep))
                }
                _ if deep > 0.0 => pieces.push([*along, *along, deep]),
                _ => {}
            }
        }
        for [from, to, deepest] in pieces.into_iter().filter(|[.., deepest]| *deepest > DEEP) {
            runs += 1;
            // A step's next search finds the rest once this is pushed out.
            let near = found.iter().filter(|(along, _)| *along > from - LENGTH / 3.0 && *along < to + LENGTH / 3.0);
            let most = near.fold(0.0, |a: f64, (_, gap)| a.min(*gap));
            assert!(most < -0.3 * deepest, "case {case}: from {from} to {to}, {deepest} deep: {found:?}");
        }
    }
    println!("{runs} pieces in bodies, {cases} ways");
    assert!(runs > 500, "{runs}");
}
