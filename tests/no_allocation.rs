//! A step allocates nothing once its scratch memory has grown: not alone, not on threads, not when subdivided, with no instruction set and in
//! no precision. (It grows again when a strand is bent further than ever before, and needs more quadrature points.)

mod allocations;

use allocations::allocations_so_far;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, InstructionSet, Integrator, Material, Precision, Solver, SolverOptions, StrandDef, Workers};

/// A root from which strands hang, swayed.
fn swayed(t: f64) -> Frame {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.2 * (6.0 * t).sin());
    Frame {
        origin: turn * Vector3::new(0.09, 0.0, 0.0),
        rotation: turn * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.5),
    }
}

/// Allocations in the steps after the first few.
fn allocations(integrator: Integrator, workers: Workers, error_tolerance: f64, set: InstructionSet, precision: Precision) -> u64 {
    let mut options = SolverOptions { workers, instruction_set: Some(set), ..SolverOptions::default() };
    (options.step.integrator, options.step.error_tolerance) = (integrator, error_tolerance);
    options.step.precision = precision;
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..64)
        .map(|k| {
            let count = 3 + k % 9;
            let mut def = StrandDef::straight(0.1 + 0.002 * k as f64, count);
            def.natural = vec![[1.0, 4.0 * (k % 4) as f64, 0.0]; count];
            def.material = Material { viscosity: 5e-3, air_drag: 5e-6, ..Material::default() };
            def.root = swayed(0.0);
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    let h = 1.0 / 60.0;
    let mut counted = 0;
    for step in 1..=90 {
        let frame = swayed(h * f64::from(step));
        let frames = vec![frame; ids.len()];
        solver.set_root_frames(&ids, &frames, h).unwrap();
        let before = allocations_so_far();
        let report = solver.step(h, 2).unwrap();
        if step > 30 {
            counted += allocations_so_far() - before;
        }
        assert!(error_tolerance == 0.0 || report.subdivided > 0);
    }
    counted
}

// One test: the counter is the process's.
#[test]
fn steps_do_not_allocate() {
    let best = InstructionSet::detected();
    for integrator in [Integrator::LinearlyImplicit, Integrator::ImplicitEuler, Integrator::SecondOrder] {
        let serial = allocations(integrator, Workers::Serial, 0.0, best, Precision::F64);
        let threads = allocations(integrator, Workers::Pool(3), 0.0, best, Precision::F64);
        println!("{integrator:?}: {serial} in 60 calls, {threads} on three threads");
        assert_eq!(serial, 0, "{integrator:?}");
        // rayon's queue takes a block now and then, and a thread that comes late grows its scratch memory; 7680 strand-steps do not (each memory once: some hundred pieces).
        assert!(threads <= 400, "{integrator:?}: {threads} on threads");
    }
    for precision in [Precision::F64, Precision::F32] {
        let parts = allocations(Integrator::SecondOrder, Workers::Serial, 1e-5, best, precision);
        println!("{precision:?} in substeps: {parts}");
        assert_eq!(parts, 0);
        for set in [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512] {
            if set <= best {
                let packs = allocations(Integrator::SecondOrder, Workers::Serial, 0.0, set, precision);
                assert_eq!(packs, 0, "{set:?} {precision:?}");
            }
        }
    }
}
