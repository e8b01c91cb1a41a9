//! Wind as a field: a constant one against the uniform wind to the bit, a shear flow against beam theory, its order in the step, and whom it is
//! called for, when and where.

use std::f64::consts::PI;
use std::sync::{Arc, Mutex};

use nalgebra::Vector3;
use superhelix::{
    BodyDef, Frame, Integrator, Precision, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId, StrandStatus,
    WIND_BATCH, WindField, Workers,
};

const WIND: Vector3<f64> = Vector3::new(1.5, -0.7, 0.2);

/// Curls and straight strands of one to nine elements; every fourth has no drag.
fn made(options: SolverOptions) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..40)
        .map(|k| {
            let mut def = StrandDef::straight(0.1 + 0.002 * k as f64, 1 + k % 9);
            def.natural.iter_mut().for_each(|row| *row = [2.0, (k % 5) as f64 * 12.0, 1.0]);
            def.material.air_drag = if k % 4 == 0 { 0.0 } else { 1e-5 };
            def.material.internal_friction = 1e-10;
            def.root.origin.y = 0.004 * k as f64;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    (solver, ids)
}

fn constant(velocity: Vector3<f64>) -> Option<Arc<dyn WindField>> {
    Some(Arc::new(move |_: f64, _: Vector3<f64>| velocity))
}

/// Hash after a run; the wind among the options is none.
fn run(mut solver: Solver, ids: &[StrandId]) -> u64 {
    for frame in 1..=12 {
        let roots: Vec<Frame> = ids
            .iter()
            .enumerate()
            .map(|(k, _)| Frame { origin: Vector3::new(0.01 * f64::from(frame), 0.004 * k as f64, 0.0), ..Frame::default() })
            .collect();
        solver.set_root_frames(ids, &roots, 1.0 / 60.0).unwrap();
        solver.step(1.0 / 60.0, 3).unwrap();
    }
    solver.set_wind(Vector3::zeros()).unwrap();
    solver.state_hash()
}

fn with_ball(mut solver: Solver, ids: &[StrandId]) -> Solver {
    let ball = BodyDef {
        pose: Frame { origin: Vector3::new(0.05, 0.08, -0.06), ..Frame::default() },
        ..BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap()))
    };
    solver.add_bodies(vec![ball]).unwrap();
    solver.set_contact(ids, Some(&StrandContact { exempt_length: 0.01, ..StrandContact::default() })).unwrap();
    solver
}

#[test]
fn a_constant_field_is_the_uniform_wind_to_the_bit() {
    for integrator in [Integrator::SecondOrder, Integrator::ImplicitEuler, Integrator::LinearlyImplicit] {
        for precision in [Precision::F64, Precision::F32] {
            for (workers, touches) in [(Workers::Serial, false), (Workers::Serial, true), (Workers::Pool(3), false)] {
                let case = format!("{integrator:?}, {precision:?}, {workers:?}, contact {touches}");
                let mut options = SolverOptions { workers, ..SolverOptions::default() };
                (options.step.integrator, options.step.precision) = (integrator, precision);
                let scene = |wind: Vector3<f64>, field: Option<Arc<dyn WindField>>| {
                    let (mut solver, ids) = made(SolverOptions { wind, ..options.clone() });
                    if touches {
                        solver = with_ball(solver, &ids);
                    }
                    solver.set_wind_field(field);
                    run(solver, &ids)
                };
                let uniform = scene(WIND, None);
                assert_eq!(scene(Vector3::zeros(), constant(WIND)), uniform, "{case}");
                // They add up, and none is none.
                assert_eq!(scene(Vector3::new(1.5, 0.0, 0.0), constant(Vector3::new(0.0, -0.7, 0.2))), uniform, "{case}");
                let calm = scene(Vector3::zeros(), None);
                assert_ne!(calm, uniform, "{case}");
                assert_eq!(scene(Vector3::zeros(), constant(Vector3::zeros())), calm, "{case}");
            }
        }
    }
}

/// A cantilever in a flow that grows from its root: 11 q L⁴/120 EI at the tip for a load that grows to q there; half the load's sum and a third of its
/// moment at the root.
#[test]
fn shear_flow_bends_a_strand_as_beam_theory_says() {
    let (length, radius, youngs, drag, shear) = (0.1, 50e-6, 2e9, 5e-5, 0.02);
    let mut options = SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() };
    (options.step.integrator, options.step.tolerance) = (Integrator::ImplicitEuler, 1e-12);
    let mut solver = Solver::new(options).unwrap();
    let mut def = StrandDef::straight(length, 24);
    (def.material.radius, def.material.youngs_modulus, def.material.air_drag) = ([radius; 2], youngs, drag);
    let id = solver.add_strands(&[def]).unwrap()[0];
    solver.set_wind_field(Some(Arc::new(move |_: f64, position: Vector3<f64>| Vector3::new(0.0, shear * position.x, 0.0))));
    for _ in 0..600 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    let mut tip = Vector3::zeros();
    solver.sample_at(id, &[length], |_, sample| tip = sample.position).unwrap();
    let load = drag * shear * length;
    let stiffness = youngs * PI * radius.powi(4) / 4.0;
    let expected = 11.0 * load * length.powi(4) / (120.0 * stiffness);
    assert!((5e-4..2e-3).contains(&(expected / length)), "{expected}");
    // 24 elements are 1/24² off, about.
    assert!((tip.y / expected - 1.0).abs() < 2e-3 && tip.z.abs() < 1e-12, "{tip} {expected}");
    let wrench = solver.root_wrench(id).unwrap();
    assert!((wrench.force.y / (0.5 * load * length) - 1.0).abs() < 1e-5, "{wrench:?}");
    assert!((wrench.torque.z / (load * length * length / 3.0) - 1.0).abs() < 1e-5, "{wrench:?}");
}

/// A swinging strand in eddies: the error falls with the square of the step.
#[test]
fn the_order_in_the_step_remains_two() {
    let tip_after = |substeps: u32| {
        let mut options = SolverOptions::default();
        options.step.tolerance = 1e-11;
        let mut solver = Solver::new(options).unwrap();
        let mut def = StrandDef::straight(0.15, 4);
        def.material.air_drag = 5e-5;
        def.material.internal_friction = 2e-10;
        def.root.rotation = nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.9, 0.0);
        let id = solver.add_strands(&[def]).unwrap()[0];
        let eddies = |seconds: f64, position: Vector3<f64>| {
            Vector3::new(
                (25.0 * position.z + 6.0 * seconds).sin(),
                0.7 * (20.0 * position.x).cos(),
                0.3 * (30.0 * position.y).sin(),
            )
        };
        solver.set_wind_field(Some(Arc::new(eddies)));
        solver.step(0.5, substeps).unwrap();
        let mut tip = Vector3::zeros();
        solver.sample_at(id, &[0.15], |_, sample| tip = sample.position).unwrap();
        tip
    };
    let exact = tip_after(8192);
    let errors: Vec<f64> = [128, 256, 512].map(|substeps| (tip_after(substeps) - exact).norm()).to_vec();
    assert!(errors[0] < 5e-3 && errors.windows(2).all(|pair| pair[0] / pair[1] > 3.2), "{errors:?}");
}

/// Every call: seconds, and positions.
#[derive(Default)]
struct Recorded(Mutex<Vec<(f64, Vec<[f64; 3]>)>>);

impl WindField for Recorded {
    fn velocities(&self, seconds: f64, positions: &[[f64; 3]], velocities: &mut [[f64; 3]]) {
        assert!(!positions.is_empty() && positions.len() <= WIND_BATCH && positions.len() == velocities.len());
        assert!(velocities.iter().flatten().all(|x| *x == 0.0));
        self.0.lock().unwrap().push((seconds, positions.to_vec()));
        velocities.iter_mut().zip(positions).for_each(|(velocity, position)| velocity[0] = 3.0 * position[2]);
    }
}

#[test]
fn calls_come_in_one_order_for_the_strands_that_feel_them() {
    let recorded = |workers: Workers| {
        let (mut solver, ids) = made(SolverOptions { workers, ..SolverOptions::default() });
        solver.freeze_strands(&ids[5..6]).unwrap();
        let field = Arc::new(Recorded::default());
        solver.set_wind_field(Some(field.clone()));
        for _ in 0..2 {
            solver.step(0.02, 4).unwrap();
        }
        let points: u32 = ids
            .iter()
            .enumerate()
            .filter(|(k, _)| k % 4 != 0 && *k != 5)
            .map(|(k, id)| (1 + k % 9) as u32 * solver.quadrature(*id).unwrap().points)
            .sum();
        let calls = std::mem::take(&mut *field.0.lock().unwrap());
        (calls, points as usize, solver.state_hash())
    };
    let (calls, points, hash) = recorded(Workers::Serial);
    let sum =
        |second: f64| calls.iter().filter(|(seconds, _)| *seconds == second).map(|(_, positions)| positions.len()).sum::<usize>();
    let mut seconds: Vec<f64> = calls.iter().map(|(seconds, _)| *seconds).collect();
    seconds.dedup();
    assert!(
        seconds.iter().zip([0.005, 0.01, 0.015, 0.02, 0.005, 0.01, 0.015, 0.02]).all(|(a, b)| (a - b).abs() < 1e-12),
        "{seconds:?}"
    );
    assert_eq!(seconds.len(), 8);
    // Two steps; the rules are those of the end.
    assert_eq!(sum(seconds[3]), 2 * points);
    // From the root on: the first strand with drag is the second.
    assert!((calls[0].1[0][1] - 0.004).abs() < 5e-4 && calls[0].1[0][0] < 0.01);
    for workers in [Workers::Pool(2), Workers::Pool(5)] {
        assert_eq!(recorded(workers), (calls.clone(), points, hash));
    }
}

#[test]
fn a_velocity_that_is_no_number_costs_its_strand_alone() {
    let (mut solver, ids) = made(SolverOptions::default());
    let before = solver.curvatures(ids[1]).unwrap().to_vec();
    let at_second = |_: f64, position: Vector3<f64>| {
        let is_second = (position.y - 0.004).abs() < 5e-4 && position.x < 0.01;
        if is_second { Vector3::repeat(f64::NAN) } else { WIND }
    };
    solver.set_wind_field(Some(Arc::new(at_second)));
    let report = solver.step(1e-4, 1).unwrap();
    assert_eq!(report.quarantined, 1);
    assert_eq!(solver.status(ids[1]).unwrap(), StrandStatus::Quarantined);
    assert_eq!(solver.curvatures(ids[1]).unwrap(), before);
}

#[test]
fn the_reference_refuses_a_field_and_restoring_keeps_it() {
    let mut options = SolverOptions::default();
    options.step.integrator = Integrator::Reference;
    let (mut solver, _) = made(options);
    solver.set_wind_field(constant(WIND));
    let error = solver.step(0.01, 1).unwrap_err().to_string();
    assert!(error.contains("field of wind"), "{error}");
    solver.set_wind_field(None);
    solver.step(1e-4, 1).unwrap();

    let (mut solver, _) = made(SolverOptions::default());
    solver.set_wind_field(constant(WIND));
    solver.step(0.01, 2).unwrap();
    let image = solver.snapshot();
    solver.step(0.01, 2).unwrap();
    let hash = solver.state_hash();
    solver.restore(&image).unwrap();
    solver.step(0.01, 2).unwrap();
    assert_eq!(solver.state_hash(), hash);
    // Another solver has no field.
    let (mut other, _) = made(SolverOptions::default());
    other.restore(&image).unwrap();
    other.step(0.01, 2).unwrap();
    assert_ne!(other.state_hash(), hash);
}
