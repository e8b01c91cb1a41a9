//! Render strands with shapes of their own: at rest they are these, whatever the settings; what moves rigidly takes them along; where guides bend,
//! what distinguishes a strand from its guide stays across the guide, and its length stays.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Workers;
use superhelix::internals::groom::render_hair::points::own_shapes::with_own_shapes;
use superhelix::render::{GuideSamples, Motion, RenderHair, RenderPose, RenderSettings, Space, View};

use super::render_hair::{Taken, evaluate, groom, whole};

const POINTS: usize = 32;

/// Curls of which every tenth is a guide; guides, and all curls.
fn curls() -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    let all = groom("blender_curly.hair", 1.0, 4, POINTS);
    (all.chunks(POINTS).step_by(10).flatten().copied().collect(), all)
}

fn settings(space: Space) -> RenderSettings {
    RenderSettings { points_per_strand: POINTS, space, length_variation: 0.0, frizz: 0.002, ..RenderSettings::default() }
}

fn bound(settings: &RenderSettings, guides: &[Vector3<f64>], shapes: &[Vector3<f64>]) -> RenderHair {
    let roots: Vec<_> = shapes.iter().step_by(POINTS).copied().collect();
    let hair = RenderHair::bind(settings, &GuideSamples::at_rest(guides), &roots).expect("a map");
    with_own_shapes(hair, shapes).expect("shapes")
}

fn posed(hair: RenderHair, guides: &[Vector3<f64>]) -> RenderPose {
    let mut pose = RenderPose::new(Arc::new(hair));
    pose.set(&GuideSamples::at_rest(guides)).expect("a pose");
    pose
}

/// The largest distance between points.
fn apart(strands: &[Taken], expected: &[Vector3<f64>]) -> f64 {
    let points = strands.iter().flat_map(|strand| &strand.points);
    points.zip(expected).map(|(point, expected)| (point - expected).norm()).fold(0.0, f64::max)
}

fn length(points: &[Vector3<f64>]) -> f64 {
    points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
}

#[test]
fn at_rest_strands_are_their_shapes_and_rigid_motion_takes_them_along() {
    let (guides, shapes) = curls();
    let size = guides.iter().map(Vector3::norm).fold(0.0, f64::max);
    for space in [Space::Position, Space::Curvature] {
        let pose = posed(bound(&settings(space), &guides, &shapes), &guides);
        let strands = evaluate(&pose, &whole(&pose));
        assert_eq!(strands.len() * POINTS, shapes.len());
        // Of floats, and of where points are on their own polyline.
        let error = apart(&strands, &shapes);
        assert!(error < 3e-6 * size, "{space:?}: {error} of {size}");
        // Without them, curls that are out of phase are far away.
        let roots: Vec<_> = shapes.iter().step_by(POINTS).copied().collect();
        let plain = RenderHair::bind(&settings(space), &GuideSamples::at_rest(&guides), &roots).expect("a map");
        let plain = posed(plain, &guides);
        assert!(apart(&evaluate(&plain, &whole(&plain)), &shapes) > 1e-2 * size);

        let turn = UnitQuaternion::from_euler_angles(0.3, -0.9, 2.0);
        let place = |point: &Vector3<f64>| turn * point + Vector3::new(0.1, -0.2, 0.3);
        let (moved, expected): (Vec<_>, Vec<_>) = (guides.iter().map(place).collect(), shapes.iter().map(place).collect());
        let after = posed_again(&pose, &moved);
        let error = apart(&evaluate(&after, &whole(&after)), &expected);
        assert!(error < 1e-5 * size, "{space:?}: {error} of {size}");
        // And with the velocity of that.
        let view = View { motion: Motion::Since { before: &pose, seconds: 0.5, roots: None }, ..whole(&after) };
        for (strand, (from, to)) in evaluate(&after, &view).iter().zip(shapes.chunks(POINTS).zip(expected.chunks(POINTS))) {
            for (velocity, (from, to)) in strand.velocities.iter().zip(from.iter().zip(to)) {
                assert!((velocity - (to - from) / 0.5).norm() < 4e-5 * size, "{velocity:?}");
            }
        }
    }
}

/// Another pose of the same map.
fn posed_again(pose: &RenderPose, guides: &[Vector3<f64>]) -> RenderPose {
    let mut other = RenderPose::new(pose.hair().clone());
    other.set(&GuideSamples::at_rest(guides)).expect("a pose");
    other
}

#[test]
fn where_a_guide_bends_what_is_across_it_stays_across_it() {
    // A guide that hangs, and a strand that winds about it.
    const RADIUS: f64 = 0.002;
    let at = |k: usize| k as f64 / (POINTS - 1) as f64;
    let guide: Vec<Vector3<f64>> = (0..POINTS).map(|k| Vector3::new(0.0, 0.0, -0.2 * at(k))).collect();
    let wound = |k: usize| RADIUS * (3.0 * at(k)).min(1.0) * Vector3::new((9.0 * at(k)).cos(), (9.0 * at(k)).sin(), 0.0);
    let shape: Vec<_> = (0..POINTS).map(|k| guide[k] + wound(k)).collect();
    let settings = RenderSettings { curliness: 0.0, wisps_per_guide: 1, flyaways: 0.0, frizz: 0.0, ..settings(Space::Position) };
    let pose = posed(bound(&settings, &guide, &shape), &guide);
    assert!(apart(&evaluate(&pose, &whole(&pose)), &shape) < 1e-7);
    // A quarter of a circle in the plane of x and z, whose frames at the root are as they were.
    let turned = std::f64::consts::FRAC_PI_2;
    let radius = 0.2 / turned;
    let bent: Vec<_> = (0..POINTS)
        .map(|k| Vector3::new(radius * (1.0 - (turned * at(k)).cos()), 0.0, -radius * (turned * at(k)).sin()))
        .collect();
    let after = posed_again(&pose, &bent);
    let strands = evaluate(&after, &whole(&after));
    let expected: Vec<_> = (0..POINTS)
        .map(|k| {
            let inwards = Vector3::new((turned * at(k)).cos(), 0.0, (turned * at(k)).sin());
            bent[k] + inwards * wound(k).x + Vector3::y() * wound(k).y
        })
        .collect();
    // Points move along the strand by what its length would change: up to a bend of a quarter turn times the radius.
    let off = apart(&strands, &expected);
    assert!(off < turned * RADIUS, "{off}");
    let nearest = |point: &Vector3<f64>| {
        let to = |edge: &[Vector3<f64>]| {
            let along = edge[1] - edge[0];
            let share = ((point - edge[0]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            (point - edge[0] - along * share).norm()
        };
        expected.windows(2).map(to).fold(f64::INFINITY, f64::min)
    };
    // On the way that is expected; but for a tail, which goes straight on.
    let points = &strands[0].points;
    let off = points[..POINTS - 1].iter().map(nearest).fold(0.0, f64::max);
    assert!(off < 0.05 * RADIUS, "{off}");
    assert!((length(points) / length(&shape) - 1.0).abs() < 2e-3, "{} {}", length(points), length(&shape));
}

#[test]
fn maps_that_are_saved_or_lose_guides_keep_the_shapes() {
    let (guides, shapes) = curls();
    let size = guides.iter().map(Vector3::norm).fold(0.0, f64::max);
    for space in [Space::Position, Space::Curvature] {
        let hair = bound(&settings(space), &guides, &shapes);
        let bytes = hair.to_bytes();
        let again = RenderHair::from_bytes(&bytes, Workers::Serial).expect("a map");
        assert!(bytes == again.to_bytes());
        let moved: Vec<_> = guides.iter().map(|point| Vector3::new(point.x, 0.9 * point.y, point.z + 0.1 * point.x)).collect();
        let fewer = hair.without_guides(&[3, 7]).expect("a map");
        let kept: Vec<_> = guides
            .chunks(POINTS)
            .enumerate()
            .filter(|(guide, _)| ![3, 7].contains(guide))
            .flat_map(|(_, points)| points.to_vec())
            .collect();
        let (pose, again) = (posed(hair, &moved), posed(again, &moved));
        assert!(evaluate(&pose, &whole(&pose)) == evaluate(&again, &whole(&again)));
        let fewer = posed(fewer, &kept);
        let error = apart(&evaluate(&fewer, &whole(&fewer)), &shapes);
        assert!(error < 1e-5 * size, "{space:?}: {error} of {size}");
        // Cut short at any place, it is none.
        for less in [1, 4, 4 * POINTS, 16 * POINTS] {
            let mut short = bytes.clone();
            short.truncate(bytes.len() - 8 - less);
            assert!(RenderHair::from_bytes(&short, Workers::Serial).is_err());
        }
    }
}

#[test]
fn shapes_of_another_number_of_points_are_refused() {
    let (guides, shapes) = curls();
    let bind = || {
        let roots: Vec<_> = shapes.iter().step_by(POINTS).copied().collect();
        RenderHair::bind(&settings(Space::Position), &GuideSamples::at_rest(&guides), &roots).expect("a map")
    };
    let text = with_own_shapes(bind(), &shapes[1..]).expect_err("too few").to_string();
    assert!(text.contains("shapes") && text.contains(&shapes.len().to_string()), "{text}");
    let mut bad = shapes.clone();
    bad[5].y = f64::NAN;
    let text = with_own_shapes(bind(), &bad).expect_err("not finite").to_string();
    assert!(text.contains("shapes[5][1]"), "{text}");
}
