//! A solver's reported memory against its requests to the allocator, and the memory of a strand.

mod held_bytes;

use std::sync::Arc;

use held_bytes::held_bytes;
use nalgebra::Vector3;
use superhelix::shapes::Sides;
use superhelix::{
    BodyDef, ConstraintDef, Frame, Hold, Integrator, Material, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId,
};

/// Twice a number that fills tasks and packs of any width, also where there are two kinds.
const STRANDS: usize = 2048;

fn strands(count: usize, elements: impl Fn(usize) -> usize) -> Vec<StrandDef> {
    (0..count)
        .map(|k| {
            let elements = elements(k);
            let mut def = StrandDef::straight(0.1 + 1e-5 * k as f64, elements);
            def.material = Material { viscosity: 0.01, air_drag: 5e-6, ..Material::default() };
            // Every tenth strand of a material of its own.
            def.material.density += if k % 10 == 0 { k as f64 } else { 0.0 };
            def.natural.iter_mut().enumerate().for_each(|(e, row)| *row = [0.1, 2.0, 1e-3 * e as f64]);
            def
        })
        .collect()
}

/// The bytes in use, and the bytes reported: both minus those of a solver with half the strands, which cancels fixed costs and threads.
fn compare(what: &str, made: impl Fn(usize) -> Solver) -> f64 {
    let of = |count: usize| {
        let before = held_bytes();
        let solver = made(count);
        ((held_bytes() - before) as f64, solver.memory_usage() as f64, solver.strand_count() as f64)
    };
    let (few, many) = (of(STRANDS / 2), of(STRANDS));
    let strands = many.2 - few.2;
    let (held, told) = ((many.0 - few.0) / strands, (many.1 - few.1) / strands);
    println!("{what}: reported {told:.1}, allocated {held:.1} bytes per strand; besides {:.0} bytes", many.0 - many.1);
    // Scratch memory may differ by what one strand more or less of the longest made it grow.
    assert!((held - told).abs() < 0.01 * held, "{what}: reported {told}, allocated {held}");
    told
}

fn stepped(count: usize, integrator: Integrator, elements: impl Fn(usize) -> usize) -> (Solver, Vec<StrandId>) {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    let mut solver = Solver::new(options).unwrap();
    let ids = solver.add_strands(&strands(count, elements)).unwrap();
    for _ in 0..3 {
        solver.step(1e-3, 1).unwrap();
    }
    (solver, ids)
}

// One test: the counter is the process's.
#[test]
fn memory_is_reported_accurately() {
    // The quadrature rules are the process's: the first solver makes them.
    drop(Solver::new(SolverOptions::default()).unwrap());
    for elements in [5, 10, 50] {
        let [second, euler, linear] =
            [Integrator::SecondOrder, Integrator::ImplicitEuler, Integrator::LinearlyImplicit].map(|integrator| {
                compare(&format!("{integrator:?}, N = {elements}"), |count| stepped(count, integrator, |_| elements).0)
            });
        // A past is the curvatures, the velocities at the nodes (at least three an element), and a pose; who looks not back has none.
        let past = (24 * elements * 4) as f64;
        assert!(second - euler >= past && euler == linear, "{second} {euler} {linear}");
    }
    let small = compare("implicit Euler, N = 5", |count| stepped(count, Integrator::ImplicitEuler, |_| 5).0);
    assert!(small <= 1536.0, "{small}");
    compare("mixed", |count| stepped(count, Integrator::SecondOrder, |k| 3 + 27 * (k % 2)).0);
    compare("every other one removed", |count| {
        let (mut solver, ids) = stepped(count, Integrator::SecondOrder, |_| 5);
        solver.remove_strands(&ids.iter().step_by(2).copied().collect::<Vec<_>>()).unwrap();
        solver
    });
    compare("added one by one", |count| {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        for def in strands(count, |_| 5) {
            solver.add_strands(&[def]).unwrap();
        }
        solver
    });
    compare("from a snapshot", |count| {
        let image = stepped(count, Integrator::SecondOrder, |_| 5).0.snapshot();
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        solver.restore(&image).unwrap();
        solver
    });
    compare("with bodies and pins", |count| {
        let (mut solver, ids) = stepped(count, Integrator::SecondOrder, |_| 5);
        let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let mesh = || Arc::new(Shape::new_mesh(corners.to_vec(), triangles.clone(), Sides::Solid).unwrap());
        let (shared, mut bodies) = (mesh(), Vec::new());
        for k in 0..count {
            bodies.push(BodyDef::new(if k % 2 == 0 { mesh() } else { shared.clone() }));
        }
        drop(shared);
        let bodies = solver.add_bodies(bodies).unwrap();
        for body in bodies.iter().step_by(4) {
            solver.set_body_vertices(*body, &corners, 0.1).unwrap();
        }
        let pin = |strand: &StrandId| ConstraintDef {
            strand: *strand,
            arclength: 0.05,
            hold: Hold::Point,
            target: Frame::default(),
            compliance: 0.0,
        };
        solver.add_constraints(&ids.iter().map(pin).collect::<Vec<_>>()).unwrap();
        solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
        solver
    });
    compare("on other elements", |count| {
        let (mut solver, ids) = stepped(count, Integrator::SecondOrder, |_| 5);
        solver.set_element_count(&ids, 7).unwrap();
        solver
    });
    let resting = compare("at rest", |count| stepped(count, Integrator::SecondOrder, |_| 5).0);
    let moving = compare("roots on their way", |count| {
        let (mut solver, ids) = stepped(count, Integrator::SecondOrder, |_| 5);
        solver.set_root_frames(&ids, &vec![Frame::default(); ids.len()], 1.0).unwrap();
        solver
    });
    assert!(moving > resting);
}
