//! Touches along strands at rest, against dense sampling of arclength.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::contact::body_at::BodyAt;
use superhelix::internals::contact::contact_point::{ContactPoint, Partner};
use superhelix::internals::contact::narrow_phase::path_bounds::PathBounds;
use superhelix::internals::contact::narrow_phase::strand_body::{BodySearchScratch, Span, contacts};
use superhelix::shapes::{DistanceGrid, Mesh, Sides};
use superhelix::{Frame, Shape};

use super::random_bodies::{Dice, Moving, at_rest, ball, bumpy, prism, strand};

const LENGTH: f64 = 0.02;

/// How thick the slab is under a ridge, m.
const SLAB: f64 = 0.02;

/// Down to this depth all minima are looked for, m: half the small sphere's radius, a twentieth of the others' half width.
const DEEP: f64 = 0.001;

/// The signed distance of a strand's point from a body, less thicknesses.
fn gap(moving: &Moving, element: usize, s: f64, thickness: f64, body: &BodyAt) -> f64 {
    let point = body.end.rotation.inverse() * (moving.path().now.position(element, s) - body.end.origin);
    body.shape.closest(point, f64::INFINITY).map_or(f64::INFINITY, |surface| surface.distance) - thickness
}

/// Checks a strand's touches against samples, and counts them.
fn check(name: &str, moving: &Moving, radius: f64, body: &BodyAt, within: f64) -> usize {
    const SAMPLES: usize = 160;
    // How much deeper than the contacts beside it a place may be that is found in a later iterate only: along facets the distance has
    // minima closer together than the pieces in which a strand is searched. All overlaps with triangles are detected to 5e-6 m.
    let facets = matches!(name, "mesh" | "hull");
    let missed_apart = if facets || name == "grid" { 1e-4 } else { 3e-6 };
    let found = moving.contacts(radius, body, within);
    let thickness = radius + body.thickness;
    for contact in &found {
        let exact = gap(moving, contact.point.element as usize, contact.point.s, thickness, body);
        // Deeper than the distance where it lies across an edge: there it is held off across itself.
        let tangent = moving.path().now.tangent(contact.point.element as usize, contact.point.s);
        let across_edge = exact < -thickness && contact.gap < exact && contact.normal.dot(&tangent).abs() < 0.1;
        assert!(across_edge || (contact.gap - exact).abs() < 1e-12, "{name}: {contact:?} {exact}");
        assert!(contact.gap < within && contact.carried == Vector3::zeros());
        assert!(matches!(contact.partner, Partner::Body { body: 7, .. }) && contact.point.strand == 3);
    }
    assert!(found.is_sorted_by(|a, b| (a.point.element, a.point.s) < (b.point.element, b.point.s)), "{name}: {found:?}");
    let along = |contact: &ContactPoint| f64::from(contact.point.element) * LENGTH + contact.point.s;
    let count = moving.now.1.len();
    let place = |index: usize| (index as f64) * LENGTH / SAMPLES as f64;
    let values: Vec<f64> = (0..=count * SAMPLES)
        .map(|index| {
            let element = (index / SAMPLES).min(count - 1);
            gap(moving, element, place(index - element * SAMPLES), thickness, body)
        })
        .collect();
    for (index, value) in values.iter().enumerate() {
        // Deep inside the distance has ridges where another side becomes the nearest; minima there come and go within fractions of a piece.
        if *value >= within - 1e-9 || *value < -DEEP {
            continue;
        }
        let left = if index == 0 { f64::INFINITY } else { values[index - 1] };
        let right = values.get(index + 1).copied().unwrap_or(f64::INFINITY);
        if *value <= left && *value <= right {
            // A minimum to one spacing: one contact there is as deep, or one next to it with no crest in between that counts.
            let (low, high) = (place(index) - 1e-9, place(index) + 1e-9);
            let overlap = facets && *value < 0.0;
            let missed = if overlap { 6e-6 } else { missed_apart };
            // Of overlaps the deepest within two millimetres.
            let reach = if overlap { 2.2e-3 } else { 1.01 * place(1) };
            let covered = found.iter().any(|contact| {
                let s = along(contact);
                let as_deep = contact.gap < value + missed;
                let near = s > low - reach && s < high + reach;
                let between = (s.min(place(index)), s.max(place(index)));
                let crest = values
                    .iter()
                    .enumerate()
                    .filter(|(other, _)| place(*other) >= between.0 && place(*other) <= between.1)
                    .map(|(_, value)| *value)
                    .fold(f64::NEG_INFINITY, f64::max);
                as_deep && (near || crest < value + missed)
            });
            let around = &values[index.saturating_sub(8)..(index + 8).min(values.len())];
            assert!(covered, "{name}: minimum {value} at {}, {around:?} of {found:#?}", place(index));
        }
    }
    found.len()
}

fn shapes() -> Vec<(&'static str, Shape)> {
    let (vertices, triangles) = bumpy(0.05, 3);
    let mesh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    vec![
        ("sphere", Shape::new_sphere(0.04).unwrap()),
        ("small sphere", Shape::new_sphere(0.002).unwrap()),
        ("capsule", Shape::new_capsule(-Vector3::x() * 0.03, Vector3::x() * 0.03, 0.01).unwrap()),
        ("ellipsoid", Shape::new_ellipsoid(Vector3::new(0.05, 0.02, 0.03)).unwrap()),
        ("box", Shape::new_box(Vector3::new(0.04, 0.02, 0.03)).unwrap()),
        ("half-space", Shape::new_half_space(Vector3::new(0.0, 1.0, 2.0)).unwrap()),
        ("hull", Shape::new_hull(&ball(0.04, 1).0).unwrap()),
        ("mesh", Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()),
        ("grid", Shape::new_grid(DistanceGrid::bake(&mesh, 0.004, 0.02).unwrap())),
    ]
}

#[test]
fn every_minimum_of_the_distance_is_a_contact() {
    let mut dice = Dice(77);
    for (name, shape) in shapes() {
        let mut contacts = 0;
        for _ in 0..40 {
            let curl = [4.0, 20.0, 80.0, 200.0][(dice.unit() * 4.0) as usize];
            let curvatures: Vec<[f64; 3]> =
                (0..5).map(|_| [dice.between(-20.0, 20.0), dice.between(-curl, curl), dice.between(-curl, curl)]).collect();
            // Some place of the strand lies about the surface.
            let surface = shape.closest(dice.cube() * 0.04, f64::INFINITY).unwrap();
            let on = surface.point + surface.normal * dice.between(-0.001, 0.003);
            let pose = Frame { origin: dice.cube() * 0.01, rotation: dice.rotation() };
            let mut moving = Moving::still(Vector3::zeros(), strand(&dice.rotation(), LENGTH, &curvatures));
            let place = moving.path().now.position((dice.unit() * 5.0) as usize, dice.unit() * LENGTH);
            moving.now.0 = pose.origin + pose.rotation * on - place;
            moving.start.0 = moving.now.0;
            let body = at_rest(&shape, pose, 0.001);
            contacts += check(name, &moving, 0.0005, &body, 0.002);
        }
        assert!(contacts > 30, "{name}: {contacts} contacts");
    }
}

/// Elements are searched whole, or in pieces that turn by a quarter of a radian. Nothing hides between their ends, also where they
/// come down steeply, go over an edge, and turn back to the surface.
#[test]
fn no_overlap_with_a_convex_shape_is_missed() {
    const SAMPLES: usize = 1000;
    let mut dice = Dice(592);
    for (name, shape) in shapes() {
        if matches!(name, "small sphere" | "mesh" | "grid") {
            continue;
        }
        let (mut overlaps, mut missed) = (0, 0.0_f64);
        for case in 0..4000 {
            // Few elements are long, and turn by up to a radian and a half.
            let element = [0.015, 0.06][case / 2000];
            let curl = [0.0, 3.0, 6.0, 12.0, 25.0][(dice.unit() * 5.0) as usize];
            let curvatures: Vec<[f64; 3]> = (0..3).map(|_| [0.0, dice.between(-curl, curl), dice.between(-curl, curl)]).collect();
            // A strand along the surface that bends to any side.
            let surface = shape.closest(dice.cube() * 0.04, f64::INFINITY).unwrap();
            let along = surface.normal.cross(&dice.direction()).normalize();
            let turn = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(along), dice.between(0.0, 6.0));
            let aim = UnitQuaternion::rotation_between(&Vector3::x(), &along).unwrap();
            let (radius, thickness) = (5e-5, [0.0, 5e-4][(dice.unit() * 2.0) as usize]);
            let mut moving = Moving::still(Vector3::zeros(), strand(&(turn * aim), element, &curvatures));
            moving.now.0 = surface.point + surface.normal * dice.between(0.0, 1e-3) - along * dice.between(0.0, 3.0 * element);
            moving.start.0 = moving.now.0;
            let body = at_rest(&shape, Frame::default(), thickness);
            let gap = |element: usize, s: f64| gap(&moving, element, s, radius + thickness, &body);
            let places = (0..3 * SAMPLES).map(|k| gap(k / SAMPLES, element * (k % SAMPLES) as f64 / SAMPLES as f64));
            let deepest = places.fold(gap(2, element), f64::min);
            if deepest > -1e-5 || deepest < -radius - thickness {
                continue;
            }
            overlaps += 1;
            let told = moving.contacts(radius, &body, 0.0).iter().fold(0.0, |told: f64, contact| told.min(contact.gap));
            missed = missed.max(told - deepest);
        }
        println!("{name}: of {overlaps} overlaps at most {missed:e} m is missed");
        assert!(missed < 6e-6 && overlaps > 100, "{name}: {missed:e} m of {overlaps} overlaps");
    }
}

#[test]
fn a_straight_strand_on_a_plane_has_contacts_at_its_elements_ends() {
    let shape = Shape::new_half_space(Vector3::z()).unwrap();
    let body = at_rest(&shape, Frame::default(), 0.0);
    let moving = Moving::still(Vector3::new(0.0, 0.0, 0.0001), strand(&UnitQuaternion::identity(), LENGTH, &[[0.0; 3]; 3]));
    let found = moving.contacts(0.0001, &body, 0.001);
    let places: Vec<(u32, f64)> = found.iter().map(|contact| (contact.point.element, contact.point.s)).collect();
    assert_eq!(places, [(0, 0.0), (0, LENGTH), (1, LENGTH), (2, LENGTH)]);
    assert!(found.iter().all(|contact| contact.gap.abs() < 1e-17 && contact.normal == Vector3::z()));
    // The exempt part ends in the second element: that place takes the root's part.
    let found = moving.contacts_from(0.025, 0.0001, &body, 0.001);
    let places: Vec<(u32, f64)> = found.iter().map(|contact| (contact.point.element, contact.point.s)).collect();
    assert_eq!(places.len(), 3);
    assert!(places[0].0 == 1 && (places[0].1 - 0.005).abs() < 1e-15 && places[1..] == [(1, LENGTH), (2, LENGTH)]);
}

#[test]
fn a_strand_deep_inside_has_contacts() {
    let (vertices, triangles) = bumpy(0.2, 3);
    for shape in [Shape::new_mesh(vertices.clone(), triangles, Sides::Solid).unwrap(), Shape::new_sphere(0.15).unwrap()] {
        let body = at_rest(&shape, Frame::default(), 0.0);
        let moving = Moving::still(Vector3::zeros(), strand(&UnitQuaternion::identity(), LENGTH, &[[0.0, 1.0, 0.0]; 3]));
        let found = moving.contacts(0.0001, &body, 0.001);
        // It leaves the middle straight outward: all that could be pushed out is pushed along itself, but for the root.
        assert!(!found.is_empty() && found.iter().all(|contact| contact.gap < -0.05), "{found:?}");
    }
}

/// A slab whose upper side rises by `slope` along y, with a ridge across it at y = 0 that is `height` high and goes down to the slab within `foot`.
fn ridged(slope: f64, height: f64, foot: f64) -> Shape {
    let top = |y: f64, above: f64| (y, SLAB + slope * y + above);
    let under = [(-0.06, 0.0), (0.0, 0.0), (0.06, 0.0)];
    let over = [top(0.06, 0.0), top(foot, 0.0), top(0.0, height), top(-foot, 0.0), top(-0.06, 0.0)];
    let (vertices, triangles) = prism(&[&under[..], &over].concat());
    Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()
}

/// A thin strand whose centre goes through a low ridge, where the distance falls and rises again between two places at which it is asked for, or from one
/// inside: what is found is the deepest point, not where the strand enters the ridge.
#[test]
fn a_ridge_is_not_missed_between_the_places_that_are_sampled() {
    let mut dice = Dice(5);
    let radius = 5e-5;
    let (mut cases, mut worst) = (0, 0.0_f64);
    for case in 0..12000 {
        let (height, foot) = (dice.between(1e-4, 4e-4), dice.between(5e-4, 4e-3));
        let slope = dice.between(-0.2, 0.2);
        let shape = ridged(slope, height, foot);
        let body = at_rest(&shape, Frame::default(), 0.0);
        // Through a point below the ridge's top, along a line that is a little steeper or less steep than the slab.
        let deep = dice.between(2e-5, 0.9 * height);
        let direction = Vector3::new(dice.between(-0.5, 0.5), 1.0, slope + dice.between(-0.05, 0.05)).normalize();
        let turn = UnitQuaternion::rotation_between(&Vector3::x(), &direction).unwrap();
        let bend = [0.0, dice.between(-1.0, 1.0), dice.between(-1.0, 1.0)];
        let mut moving = Moving::still(Vector3::zeros(), strand(&turn, LENGTH, &[bend; 3]));
        let place = moving.path().now.position(1, dice.unit() * LENGTH);
        let through = Vector3::new(dice.between(-0.005, 0.005), 0.0, SLAB + height - deep);
        (moving.now.0, moving.start.0) = (through - place, through - place);
        let found = moving.contacts(radius, &body, 1e-3);
        let known = found.iter().map(|contact| contact.gap).fold(0.0, f64::min);
        let (mut deepest, mut sunk) = (0.0_f64, false);
        for sample in 0..600 {
            let (element, s) = (sample / 200, (sample % 200) as f64 / 200.0 * LENGTH);
            let gap = gap(&moving, element, s, radius, &body);
            deepest = deepest.min(gap);
            sunk |= gap < -radius && moving.path().now.position(element, s).y.abs() > foot;
        }
        if sunk {
            // Its centre is in the slab, too.
            continue;
        }
        cases += 1;
        worst = worst.max(known - deepest);
        assert!(known < deepest + 1e-5, "case {case}: {deepest:.2e} m deep, found {known:.2e} m");
    }
    println!("{cases} cases, found at most {worst:.1e} m less than there is");
    assert!(cases > 1000);
}

/// A straight strand through an edge of a box: one contact, whose plane is across the strand and through the edge: the box lies behind it and
/// reaches up to it. The faces' own normals would push the strand along itself.
#[test]
fn a_strand_across_an_edge_is_pushed_across_itself() {
    let half = Vector3::new(0.03, 0.02, 0.01);
    let shape = Shape::new_box(half).unwrap();
    let body = at_rest(&shape, Frame::default(), 0.0);
    let mut dice = Dice(21);
    for _ in 0..200 {
        // Through a point a little below the edge between the faces x and z, from outside to outside.
        let edge = Vector3::new(half.x, dice.between(-0.01, 0.01), half.z);
        let below = edge - Vector3::new(1.0, 0.0, 1.0) * dice.between(1e-4, 1e-3);
        let direction = Vector3::new(dice.between(0.3, 1.0), dice.between(-0.5, 0.5), -dice.between(0.3, 1.0)).normalize();
        let turn = UnitQuaternion::rotation_between(&Vector3::x(), &direction).unwrap();
        let origin = below - direction * (1.5 * LENGTH);
        let moving = Moving::still(origin, strand(&turn, LENGTH, &[[0.0; 3]; 3]));
        let radius = 5e-5;
        let found: Vec<ContactPoint> = moving.contacts(radius, &body, 0.0);
        let deepest = found.iter().min_by(|a, b| a.gap.total_cmp(&b.gap)).unwrap();
        let normal = deepest.normal;
        assert!(normal.dot(&direction).abs() < 1e-6, "{deepest:?} {direction:?}");
        let at = moving.path().now.position(deepest.point.element as usize, deepest.point.s);
        let plane = normal.dot(&at) - (deepest.gap + radius);
        let reach = normal.abs().dot(&half);
        assert!((plane - reach).abs() < 2e-6, "{deepest:?}: {plane} {reach}");
        assert!(found.iter().all(|contact| contact.normal.dot(&direction).abs() < 0.5 + 1e-9), "{found:?}");
    }
}

#[test]
fn reused_lists_change_nothing() {
    // Many strands through one scratch give what each gives with its own, and count as much work.
    let (vertices, triangles) = bumpy(0.05, 3);
    let shape = Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap();
    let body = at_rest(&shape, Frame::default(), 0.0);
    let (mut dice, mut scratch, mut bounds, mut all) = (Dice(3), BodySearchScratch::default(), PathBounds::default(), Vec::new());
    let mut alone = Vec::new();
    for _ in 0..30 {
        let moving = Moving::still(dice.cube() * 0.06, strand(&dice.rotation(), LENGTH, &[[3.0, 10.0, 5.0]; 4]));
        let path = moving.path();
        bounds.update(&path);
        let work = contacts(&path, &bounds, Span::default(), 1e-4, &body, 0.001, &mut scratch, &mut all);
        let own = &mut BodySearchScratch::default();
        assert_eq!(work, contacts(&path, &bounds, Span::default(), 1e-4, &body, 0.001, own, &mut Vec::new()));
        alone.extend(moving.contacts(1e-4, &body, 0.001));
    }
    assert!(all.len() > 20);
    assert_eq!(all, alone);
}

/// What a search counts as its work goes by what it looks at: nothing but bounds where the body is far, and in a dense mesh every
/// triangle about the strand.
#[test]
fn the_work_of_a_search_grows_with_what_is_near() {
    let work = |levels: usize, away: f64| {
        let (vertices, triangles) = bumpy(0.05, levels);
        let shape = Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap();
        let body = at_rest(&shape, Frame::default(), 0.0);
        let across = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * std::f64::consts::PI);
        let moving = Moving::still(Vector3::new(0.05 + away, -0.04, 0.0), strand(&across, LENGTH, &[[0.0; 3]; 4]));
        let (path, mut bounds) = (moving.path(), PathBounds::default());
        bounds.update(&path);
        contacts(&path, &bounds, Span::default(), 1e-4, &body, 0.001, &mut BodySearchScratch::default(), &mut Vec::new())
    };
    let (far, coarse, dense) = (work(3, 0.5), work(3, 0.0), work(5, 0.0));
    println!("far {far}, coarse mesh {coarse}, dense mesh {dense}");
    assert!(coarse > 20 * far && 2 * dense > 3 * coarse, "{far} {coarse} {dense}");
}
