//! Strands that a body is near step like free strands, at that cost; where this brings them to it, it stops them.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::shapes::DistanceGrid;
use superhelix::{BodyDef, BodyId, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId};

const RADIUS: f64 = 0.09;
const STEP: f64 = 1.0 / 60.0;
const STRANDS: usize = 60;
const EXEMPT: f64 = 0.004;
/// How deep contact may leave a centreline, and how far between samples it may lie deeper, m.
const DEEP: f64 = 1e-4;

/// A ball as a head, as a sphere or as a grid of distances.
fn head(grid: bool) -> Shape {
    if !grid {
        return Shape::new_sphere(RADIUS).unwrap();
    }
    let (count, cell, band) = (44_u32, 5e-3, 0.015);
    let low = Vector3::repeat(-0.5 * cell * f64::from(count - 1));
    let mut values = Vec::new();
    for z in 0..count {
        for y in 0..count {
            for x in 0..count {
                let at = low + Vector3::new(f64::from(x), f64::from(y), f64::from(z)) * cell;
                values.push((at.norm() - RADIUS).clamp(-band, band) as f32);
            }
        }
    }
    Shape::new_grid(DistanceGrid::from_parts(low, cell, band, [count; 3], values.into()).unwrap())
}

/// Strands that stand from a ball in all directions, wavy, of some stiffness (Pa).
fn scene(shape: Option<Shape>, stiffness: f64) -> (Solver, Vec<StrandId>, Option<BodyId>) {
    let options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), ..SolverOptions::default() };
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..STRANDS)
        .map(|k| {
            let mut def = StrandDef::straight(0.12, 8);
            def.material.youngs_modulus = stiffness;
            def.material.air_drag = 1e-5;
            def.natural = vec![[0.0, 3.0 * (k as f64).sin(), 3.0]; 8];
            def.root = root(k);
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    let body = shape.map(|shape| solver.add_bodies(vec![BodyDef::new(Arc::new(shape))]).unwrap()[0]);
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: EXEMPT, ..StrandContact::default() })).unwrap();
    (solver, ids, body)
}

/// Where a strand grows, straight out of the ball: spread evenly.
fn root(k: usize) -> Frame {
    let (z, turn) = (0.9 - 1.2 * (k as f64 + 0.5) / STRANDS as f64, k as f64 * 2.399_963);
    let across = (1.0 - z * z).sqrt();
    let normal = Vector3::new(across * turn.cos(), across * turn.sin(), z);
    let rotation = UnitQuaternion::rotation_between(&Vector3::x(), &normal).unwrap_or_default();
    Frame { origin: normal * RADIUS, rotation }
}

/// Takes ball and roots to a pose within a step.
fn carry(solver: &mut Solver, ids: &[StrandId], body: Option<BodyId>, pose: &Frame) {
    let roots: Vec<Frame> = (0..STRANDS).map(|k| pose.compose(&root(k))).collect();
    solver.set_root_frames(ids, &roots, STEP).unwrap();
    if let Some(body) = body {
        solver.set_body_frames(&[body], &[*pose], STEP).unwrap();
    }
}

/// A head that turns and walks, calmly.
fn calm(step: u32) -> Frame {
    let t = f64::from(step) * STEP;
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.1 * (1.0 - (2.0 * PI * 0.5 * t).cos()));
    Frame { origin: Vector3::new(0.3 * t * t, 0.0, 5e-3 * (1.0 - (2.0 * PI * t).cos())), rotation }
}

/// Stiff hair, which reaches no head while it is led about.
#[test]
fn strands_out_of_reach_move_as_if_there_were_nothing_and_cost_no_contact() {
    let (mut alone, ids, _) = scene(None, 2e11);
    let mut beside = [false, true].map(|grid| scene(Some(head(grid)), 2e11));
    // At rest under their weight first.
    for _ in 0..120 {
        alone.step(STEP, 1).unwrap();
        for (solver, ..) in &mut beside {
            solver.step(STEP, 1).unwrap();
        }
    }
    for step in 1..=90 {
        carry(&mut alone, &ids, None, &calm(step));
        alone.step(STEP, 1).unwrap();
        for (solver, ids, body) in &mut beside {
            carry(solver, ids, *body, &calm(step));
            let report = solver.step(STEP, 1).unwrap();
            assert_eq!((report.contact.contacts, report.work), (0, 0), "step {step}: something was held");
        }
    }
    let all = |solver: &Solver, ids: &[StrandId]| -> Vec<[f64; 3]> {
        ids.iter().flat_map(|id| solver.curvatures(*id).unwrap().to_vec()).collect()
    };
    for (solver, others, _) in &beside {
        // (In the first steps' fall they are held, whose iterations end elsewhere within the tolerance.)
        let rows = all(solver, others).into_iter().flatten().zip(all(&alone, &ids).into_iter().flatten());
        let off = rows.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{off:e} rad/m off");
    }
}

/// The deepest that a centreline is in the ball, m.
fn depth(solver: &Solver, ids: &[StrandId], pose: &Frame) -> f64 {
    let mut deepest = 0.0_f64;
    solver
        .sample_strands(ids, 201, |_, _, sample| {
            if sample.arclength > 2.0 * EXEMPT {
                deepest = deepest.max(RADIUS - (sample.position - pose.origin).norm());
            }
        })
        .unwrap();
    deepest
}

/// Limp hair at rest beside the head, which then moves off suddenly at any speed: nothing in the hair's own motion predicts it.
#[test]
fn a_sudden_start_takes_no_strand_into_the_body() {
    for grid in [false, true] {
        for (shift, stiffness) in [(0.004, 2e10), (0.04, 2e10), (0.02, 5e9), (0.04, 5e9), (0.04, 2e9)] {
            let (mut solver, ids, body) = scene(Some(head(grid)), stiffness);
            for _ in 0..120 {
                solver.step(STEP, 1).unwrap();
            }
            let mut free_steps = 0;
            for step in 0..20_u32 {
                let away = shift * f64::from(step.min(6));
                let pose = Frame { origin: Vector3::new(away, 0.5 * away, 0.0), ..Frame::default() };
                carry(&mut solver, &ids, body, &pose);
                let report = solver.step(STEP, 1).unwrap();
                free_steps += u32::from(report.work == 0);
                let depth = depth(&solver, &ids, &pose);
                assert!(depth < DEEP, "{grid} {shift} step {step}: {depth:e} m deep, {report:?}");
            }
            let is_reached = free_steps < 20;
            assert_eq!(is_reached, stiffness < 1e10, "{grid} {shift} {stiffness:e}: {free_steps} steps without contact");
        }
    }
}

/// Which strands are searched again has no effect: a run continues from any snapshot with the same bits.
#[test]
fn a_snapshot_goes_on_to_the_same_bits() {
    let (mut solver, ids, body) = scene(Some(head(true)), 1e10);
    let mut image = Vec::new();
    for step in 1..=80 {
        carry(&mut solver, &ids, body, &calm(3 * step));
        solver.step(STEP, 1).unwrap();
        if step == 37 {
            image = solver.snapshot();
        }
    }
    let (mut other, ..) = scene(Some(head(true)), 1e10);
    other.restore(&image).unwrap();
    for step in 38..=80 {
        carry(&mut other, &ids, body, &calm(3 * step));
        other.step(STEP, 1).unwrap();
    }
    assert_eq!(other.state_hash(), solver.state_hash());
}
