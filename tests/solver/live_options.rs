//! Options of a solver: changed, they act as if the solver had been created with them; unchanged, nothing happens; what restoring does
//! with them.

use nalgebra::Vector3;
use superhelix::reading::{RestoredOptions, Restoring};
use superhelix::{
    Error, Integrator, LinearSolver, Precision, Solver, SolverOptions, StepLimits, Stopped, StrandDef, StrandId, UsualLimits,
    Workers,
};

const KEEP: Restoring = Restoring { options: RestoredOptions::Own, shapes: None };

fn made(options: SolverOptions) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..24)
        .map(|k| {
            let mut def = StrandDef::straight(0.1 + 0.002 * k as f64, 3 + k % 4);
            def.natural.iter_mut().for_each(|row| *row = [2.0, 20.0 + k as f64, 1.0]);
            def.material.air_drag = 1e-5;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    (solver, ids)
}

fn step(solver: &mut Solver, count: usize) {
    for _ in 0..count {
        solver.step(1.0 / 60.0, 2).unwrap();
    }
}

/// Every option that may change, each other than the default.
fn others() -> SolverOptions {
    let mut options =
        SolverOptions { gravity: Vector3::new(0.0, -9.81, 1.0), wind: Vector3::new(1.0, 0.0, 0.0), ..SolverOptions::default() };
    options.step.integrator = Integrator::ImplicitEuler;
    options.step.max_iterations = 20;
    options.step.tolerance = 1e-4;
    options.step.max_subdivisions = 1;
    options.step.error_tolerance = 1e-3;
    options.step.precision = Precision::F32;
    options.step.quadrature_tolerance = 1e-6;
    options.jump_acceleration = 50.0;
    options
}

#[test]
fn a_solver_with_changed_options_steps_like_one_made_with_them() {
    for options in [others(), SolverOptions { step: SolverOptions::default().step, ..others() }] {
        let (mut living, _) = made(SolverOptions::default());
        living.set_options(&options).unwrap();
        let (mut fresh, _) = made(options);
        step(&mut living, 10);
        step(&mut fresh, 10);
        assert_eq!(living.state_hash(), fresh.state_hash());
    }
}

/// At the change of the integrator in motion: the same as a solver of the other integrator that was given the state without a past.
#[test]
fn options_change_in_the_middle_of_a_motion() {
    let (mut solver, ids) = made(SolverOptions::default());
    step(&mut solver, 7);
    let before: Vec<_> = ids.iter().map(|id| solver.curvatures(*id).unwrap().to_vec()).collect();
    let hash = solver.state_hash();
    solver.set_options(&solver.options().clone()).unwrap();
    assert_eq!(solver.state_hash(), hash, "nothing changed, nothing happened");

    let reference = solver.snapshot();
    let mut kept = made(others()).0;
    kept.restore_with(&reference, &KEEP).unwrap();
    solver.set_options(&others()).unwrap();
    assert_eq!(before, ids.iter().map(|id| solver.curvatures(*id).unwrap().to_vec()).collect::<Vec<_>>(), "nothing jumps");
    assert_eq!(solver.state_hash(), kept.state_hash(), "a snapshot restored under own options is that state");
    step(&mut solver, 5);
    step(&mut kept, 5);
    assert_eq!(solver.state_hash(), kept.state_hash());
    // And back: a second-order step after implicit Euler starts without a past, as in a new solver.
    let mut options = solver.options().clone();
    options.step.integrator = Integrator::SecondOrder;
    solver.set_options(&options).unwrap();
    step(&mut solver, 5);
    assert!(ids.iter().all(|id| solver.curvatures(*id).unwrap().iter().flatten().all(|x| x.is_finite())));
}

#[test]
fn gravity_and_wind_through_options_are_those_of_their_own_functions() {
    let (mut by_options, _) = made(SolverOptions::default());
    let (mut by_functions, _) = made(SolverOptions::default());
    let (gravity, wind) = (Vector3::new(0.0, 9.81, 0.0), Vector3::new(0.0, 3.0, 0.0));
    by_options.set_options(&SolverOptions { gravity, wind, ..SolverOptions::default() }).unwrap();
    by_functions.set_gravity(gravity).unwrap();
    by_functions.set_wind(wind).unwrap();
    assert_eq!(by_options.state_hash(), by_functions.state_hash(), "energies included");
}

#[test]
fn what_cannot_change_is_refused_by_name_and_changes_nothing() {
    let (mut solver, _) = made(SolverOptions::default());
    let hash = solver.state_hash();
    let refused = |solver: &mut Solver, options: SolverOptions, name: &str| {
        let error = solver.set_options(&options).unwrap_err();
        assert!(error.to_string().contains(name), "{error}");
        error
    };
    let error = refused(&mut solver, SolverOptions { workers: Workers::Pool(2), ..others() }, "options.workers");
    assert!(matches!(error, Error::Unsupported { .. }), "{error}");
    let mut options = others();
    options.step.linear_solver = LinearSolver::DenseCholesky;
    refused(&mut solver, options, "options.precision");
    refused(&mut solver, SolverOptions { jump_acceleration: 0.0, ..others() }, "options.jump_acceleration");
    let limits = UsualLimits { work: None, seconds: Some(f64::NAN) };
    refused(&mut solver, SolverOptions { limits, ..others() }, "options.limits.seconds");
    assert_eq!(solver.state_hash(), hash);
    assert_eq!(solver.options().step, SolverOptions::default().step);
}

#[test]
fn a_restored_solver_has_the_options_that_the_host_chose() {
    let (mut source, _) = made(others());
    step(&mut source, 3);
    let image = source.snapshot();
    let own = SolverOptions { gravity: Vector3::new(1.0, 2.0, 3.0), ..SolverOptions::default() };
    let (mut target, _) = made(own.clone());
    target.restore(&image).unwrap();
    assert_eq!((target.options().step, target.options().gravity), (others().step, others().gravity));
    let (mut target, ids) = made(own.clone());
    target.restore_with(&image, &KEEP).unwrap();
    assert_eq!((target.options().step, target.options().gravity), (own.step, own.gravity));
    // Energies are those of the gravity that it has.
    let mut same = source;
    same.set_gravity(own.gravity).unwrap();
    let id = same.strand_ids()[3];
    let (own, expected) = (target.energies(id).unwrap().gravity, same.energies(id).unwrap().gravity);
    assert!((own - expected).abs() < 1e-6 * expected.abs(), "{own} {expected}: to what the two quadrature rules differ by");
    assert!(!target.has_strand(ids[0]) || target.strand_ids()[0] == ids[0]);
}

/// Limits of the solver act where the call has none, survive snapshots, and yield to the call's.
#[test]
fn steps_without_limits_have_those_of_the_solver() {
    let (mut solver, _) = made(SolverOptions::default());
    let limits = UsualLimits { work: Some(12), seconds: Some(1e-9) };
    solver.set_options(&SolverOptions { limits, ..SolverOptions::default() }).unwrap();
    let image = solver.snapshot();
    assert_eq!(solver.step(1.0 / 60.0, 2).unwrap().stopped, Stopped::Time);
    let generous = StepLimits { seconds: Some(100.0), ..StepLimits::default() };
    assert_eq!(solver.step_within(1.0 / 60.0, 2, &generous).unwrap().stopped, Stopped::No);
    let (mut other, _) = made(SolverOptions::default());
    other.restore(&image).unwrap();
    assert_eq!(other.options().limits, limits);
    assert_ne!(other.state_hash(), made(SolverOptions::default()).0.state_hash(), "limits act on results");
}
