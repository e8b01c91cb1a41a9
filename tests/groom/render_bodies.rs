//! Render hair kept out of bodies: hardly any point stays inside, strands keep their lengths and wisps their shapes, what moves with the head
//! keeps its velocity, and what is far from bodies is left alone.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::render::{GuideSamples, Motion, RenderBody, RenderSettings, VELOCITY_STEP, View};
use superhelix::shapes::{DistanceGrid, Mesh};
use superhelix::{BodyDef, Frame, InstructionSet, Shape, Solver, SolverOptions, Workers};

use crate::render_hair::{Taken, bind, evaluate, length, plain, roots_among, sintel, whole};
use crate::render_looks::{POINTS, bust, roots_on_bust, wisps};

fn head() -> Shape {
    let mesh = bust();
    let mesh = Mesh::for_baking(mesh.vertices, mesh.triangles).expect("a mesh");
    Shape::new_grid(DistanceGrid::bake(&mesh, 0.005, 0.02).expect("a grid"))
}

/// The fraction of points, without roots, deeper than a limit, and the largest depth, m.
fn inside(shape: &Shape, strands: &[Taken], deeper: f64) -> (f64, f64) {
    let depth = |point: &Vector3<f64>| shape.closest(*point, 0.0).map_or(0.0, |surface| -surface.distance);
    let depths: Vec<f64> = strands.iter().flat_map(|strand| &strand.points[1..]).map(depth).collect();
    let deep = depths.iter().filter(|depth| **depth > deeper).count();
    (deep as f64 / depths.len() as f64, depths.iter().copied().fold(0.0, f64::max))
}

#[test]
fn strands_stay_out_of_a_head_and_wisps_stay_wisps() {
    let (guides, shape) = (sintel(), head());
    let roots = roots_on_bust(&guides, 4000);
    for curliness in [0.0, 0.5, 1.0] {
        let settings = RenderSettings { curliness, length_variation: 0.0, flyaways: 0.0, ..RenderSettings::default() };
        let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
        let bodies = [RenderBody::new(&shape, Frame::default())];
        let (free, kept) = (evaluate(&pose, &whole(&pose)), evaluate(&pose, &View { bodies: &bodies, ..whole(&pose) }));
        let ((share_before, deepest_before), (share, deepest)) = (inside(&shape, &free, 1e-3), inside(&shape, &kept, 1e-3));
        println!(
            "curliness {curliness}: deeper than 1 mm {share_before:.3} (deepest {deepest_before:.4}) to {share:.5} ({deepest:.4})"
        );
        // (In creases, where the shortest paths out cross, and where splines cut corners, a point may stay inside by some millimetres.)
        assert!(deepest < 7e-3, "{deepest_before} {deepest}");
        assert!(share_before > 0.005 && share < 0.005 && share < 0.4 * share_before, "{share_before} {share}");
        // Segments keep their lengths but for the corners that splines cut.
        let mut changed: Vec<f64> = free
            .iter()
            .zip(&kept)
            .flat_map(|(free, kept)| {
                let edges = |strand: &Taken| strand.points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).collect::<Vec<_>>();
                edges(free).into_iter().zip(edges(kept)).map(|(before, after)| (after / before - 1.0).abs()).collect::<Vec<_>>()
            })
            .collect();
        changed.sort_by(f64::total_cmp);
        let ninety = changed[changed.len() * 9 / 10];
        println!("  edges changed by {ninety:.4} (nine tenths), {:.4} (99 of 100)", changed[changed.len() * 99 / 100]);
        assert!(ninety < 0.03, "{ninety}");
        let whole_change = free.iter().zip(&kept).map(|(free, kept)| (length(&kept.points) / length(&free.points) - 1.0).abs());
        let worst = whole_change.fold(0.0, f64::max);
        assert!(worst < 0.25, "{worst}");
        // Wisps are no wider at the tip than they were, or by little.
        if curliness > 0.0 {
            let radius = |strands: &[Taken], members: &[usize]| {
                let middle = members.iter().map(|index| strands[*index].points[15]).sum::<Vector3<f64>>() / members.len() as f64;
                (members.iter().map(|index| (strands[*index].points[15] - middle).norm_squared()).sum::<f64>()
                    / members.len() as f64)
                    .sqrt()
            };
            let mut wider: Vec<f64> =
                wisps(pose.hair(), 5).iter().map(|members| radius(&kept, members) - radius(&free, members)).collect();
            wider.sort_by(f64::total_cmp);
            println!(
                "  tips of wisps wider by {:.5} (median), {:.5} (nine tenths) m",
                wider[wider.len() / 2],
                wider[wider.len() * 9 / 10]
            );
            assert!(wider[wider.len() * 9 / 10] < 3e-3, "{}", wider[wider.len() * 9 / 10]);
        }
    }
}

#[test]
fn the_order_of_depth_is_kept_and_what_is_far_is_left_alone() {
    // Straight strands along z at heights about a half-space's surface: lifted into the clearance, the deeper the lower.
    let shape = Shape::new_half_space(Vector3::y()).expect("a shape");
    let heights = [-0.01, -0.003, -0.001, 0.0, 0.001, 0.0019, 0.0021, 0.05];
    let guides: Vec<_> = heights
        .iter()
        .enumerate()
        .flat_map(|(k, y)| (0..POINTS).map(move |j| Vector3::new(0.1 * k as f64, *y, 0.02 * j as f64)))
        .collect();
    let roots: Vec<_> = guides.iter().step_by(POINTS).copied().collect();
    let settings = RenderSettings { guides_per_strand: 1, preserve_length: true, ..plain() };
    let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
    let raised = |thickness: f64| -> Vec<f64> {
        let bodies = [RenderBody { thickness, ..RenderBody::new(&shape, Frame::default()) }];
        evaluate(&pose, &View { bodies: &bodies, ..whole(&pose) }).iter().map(|strand| strand.points[10].y).collect()
    };
    for (y, now) in heights.iter().zip(raised(0.0)) {
        // c²/(2c − d) for d below c = 2 mm.
        let expected = if *y < 2e-3 { 4e-6 / (4e-3 - y) } else { *y };
        assert!((now - expected).abs() < 2.5e-4, "{y}: {now} for {expected}");
    }
    let thick = raised(0.01);
    assert!((thick[3] - (0.01 + 4e-6 / (4e-3 + 0.01))).abs() < 2.5e-4 && thick[7] == heights[7] as f32 as f64, "{thick:?}");
}

#[test]
fn the_bits_depend_neither_on_threads_nor_on_batches() {
    let (guides, shape) = (sintel(), head());
    let roots = roots_among(&guides, 16, 700);
    let bodies = [RenderBody::new(&shape, Frame::default())];
    let all = |settings: &RenderSettings| {
        let pose = bind(settings, &GuideSamples::at_rest(&guides), &roots);
        evaluate(&pose, &View { bodies: &bodies, ..whole(&pose) })
    };
    let settings = RenderSettings::default();
    let one = all(&settings);
    assert!(all(&RenderSettings { workers: Workers::Pool(2), ..settings.clone() }) == one);
    for set in [InstructionSet::Scalar, InstructionSet::Avx2, InstructionSet::Avx512] {
        if set <= InstructionSet::detected() {
            assert!(all(&RenderSettings { instruction_set: Some(set), ..settings.clone() }) == one, "{set:?}");
        }
    }
    let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
    for (first, count) in [(0, 1), (7, 45), (699, 1)] {
        assert!(evaluate(&pose, &View { first, count, bodies: &bodies, ..whole(&pose) }) == one[first..first + count]);
    }
}

#[test]
fn hair_that_goes_with_a_head_has_the_heads_velocity() {
    let (guides, shape) = (sintel(), head());
    let roots = roots_among(&guides, 16, 500);
    let (linear, angular) = (Vector3::new(0.5, -0.2, 0.3), Vector3::new(0.4, 2.0, -0.3));
    let field = |p: &Vector3<f64>| linear + angular.cross(p);
    let velocities: Vec<_> = guides.iter().map(field).collect();
    let mut pose = bind(&RenderSettings::default(), &GuideSamples::at_rest(&guides), &roots);
    pose.set(&GuideSamples { velocities: Some(&velocities), ..GuideSamples::at_rest(&guides) }).expect("a pose");
    let back = |seconds: f64| Frame { origin: -linear * seconds, rotation: UnitQuaternion::from_scaled_axis(angular * -seconds) };
    let bodies = [RenderBody { pose_before: back(VELOCITY_STEP), ..RenderBody::new(&shape, Frame::default()) }];
    let mut off: Vec<f64> = evaluate(&pose, &View { bodies: &bodies, motion: Motion::Guides, ..whole(&pose) })
        .iter()
        .flat_map(|strand| strand.points.iter().zip(&strand.velocities).map(|(p, v)| (v - field(p)).norm()).collect::<Vec<_>>())
        .collect();
    off.sort_by(f64::total_cmp);
    // Rounding of f32 over a millisecond; a point that looks at another node then than now moves by up to a few tenths of a millimetre.
    assert!(off[off.len() * 98 / 100] < 0.1, "{}", off[off.len() * 98 / 100]);
    // The roots determine the head's motion.
    let moved: Vec<_> = guides.iter().map(|p| back(0.1).origin + back(0.1).rotation * p).collect();
    pose.set(&GuideSamples::at_rest(&moved)).expect("a pose");
    assert!((pose.head().origin - back(0.1).origin).norm() < 1e-9 && pose.head().rotation.angle_to(&back(0.1).rotation) < 1e-9);
}

#[test]
fn a_solvers_bodies_are_where_they_are_now() {
    let mut solver = Solver::new(SolverOptions::default()).expect("a solver");
    let shape = Arc::new(Shape::new_sphere(0.1).expect("a sphere"));
    let ids = solver
        .add_bodies(vec![
            BodyDef { thickness: 0.01, ..BodyDef::new(Arc::clone(&shape)) },
            BodyDef { mask: 0, ..BodyDef::new(Arc::clone(&shape)) },
        ])
        .expect("bodies");
    solver
        .set_body_frames(&ids[..1], &[Frame { origin: Vector3::new(0.02, 0.0, 0.0), ..Frame::default() }], 0.1)
        .expect("a pose");
    solver.step(0.05, 5).expect("a step");
    let bodies = solver.render_bodies(1e-3);
    assert_eq!(bodies.len(), 1);
    let pose = solver.body(ids[0]).expect("a body").pose;
    assert!(pose.origin.x > 0.001 && bodies[0].pose == pose && bodies[0].thickness == 0.01);
    let speed = (bodies[0].pose.origin.x - bodies[0].pose_before.origin.x) / 1e-3;
    assert!((0.05..1.0).contains(&speed), "{speed}");
}
