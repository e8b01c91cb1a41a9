//! Snapshots that refer to shapes: they continue with the same bits, in the same solver and in another that has the shapes; what is missing or
//! damaged is named; sizes are known before anything is written.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::reading::{Restoring, SnapshotShapes};
use superhelix::shapes::{DistanceGrid, Sides};
use superhelix::{BodyDef, BodyId, Error, Shape, Solver, SolverOptions, StrandContact, StrandDef};

const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.05, 0.0, 0.0], [0.0, 0.05, 0.0], [0.0, 0.0, 0.05]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn mesh() -> Shape {
    Shape::new_mesh(CORNERS.map(Vector3::from).to_vec(), TRIANGLES.to_vec(), Sides::Solid).unwrap()
}

/// Strands over a grid that two bodies share, a mesh, a hull and a sphere.
fn scene() -> (Solver, Vec<BodyId>) {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let defs: Vec<StrandDef> = (0..6).map(|k| StrandDef::straight(0.1 + 0.01 * f64::from(k), 5)).collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
    let grid = DistanceGrid::bake(mesh().mesh().unwrap(), 2e-3, 0.01).unwrap();
    let grid = Arc::new(Shape::new_grid(grid));
    let shapes = [grid.clone(), grid, Arc::new(mesh()), Arc::new(Shape::new_hull(&CORNERS.map(Vector3::from)).unwrap())];
    let mut bodies: Vec<BodyDef> = shapes.into_iter().map(BodyDef::new).collect();
    bodies.push(BodyDef::new(Arc::new(Shape::new_sphere(0.03).unwrap())));
    for (k, body) in bodies.iter_mut().enumerate() {
        body.pose.origin = Vector3::new(0.02 * k as f64, 0.0, -0.06);
    }
    let bodies = solver.add_bodies(bodies).unwrap();
    run(&mut solver, 4);
    (solver, bodies)
}

fn run(solver: &mut Solver, steps: usize) {
    for _ in 0..steps {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
}

#[test]
fn snapshots_that_refer_to_shapes_go_on_to_the_same_bits() {
    let (mut solver, _) = scene();
    let (whole, small) = (solver.snapshot(), solver.snapshot_with(SnapshotShapes::Referenced).unwrap());
    let shapes = solver.snapshot_shapes().unwrap();
    // The omitted parts are in the shapes: a grid once, a mesh and a hull.
    assert!(small.len() + shapes.len() < whole.len() + 200 && small.len() < whole.len() / 10, "{} {}", small.len(), whole.len());
    let hash = solver.state_hash();
    run(&mut solver, 5);
    let after = solver.state_hash();
    solver.restore(&small).unwrap();
    assert_eq!(solver.state_hash(), hash);
    run(&mut solver, 5);
    assert_eq!(solver.state_hash(), after);

    let mut other = Solver::new(SolverOptions::default()).unwrap();
    other.restore_with(&small, &Restoring { shapes: Some(&shapes), ..Restoring::default() }).unwrap();
    assert_eq!((other.state_hash(), other.snapshot()), (hash, whole), "and is whole again");
    run(&mut other, 5);
    assert_eq!(other.state_hash(), after);
    // Bodies that shared a shape still do.
    let ids = other.body_ids();
    let shape = |id| &other.body(id).unwrap().shape;
    assert!(Arc::ptr_eq(shape(ids[0]), shape(ids[1])) && !Arc::ptr_eq(shape(ids[0]), shape(ids[2])));
}

#[test]
fn sizes_are_known_without_writing() {
    let (mut solver, bodies) = scene();
    for step in 0..3 {
        for shapes in [SnapshotShapes::Included, SnapshotShapes::Referenced] {
            assert_eq!(solver.snapshot_size(shapes), solver.snapshot_with(shapes).unwrap().len(), "{shapes:?}, {step}");
        }
        assert_eq!(solver.snapshot_shapes_size(), solver.snapshot_shapes().unwrap().len());
        solver.set_body_vertices(bodies[2], &CORNERS.map(|corner| 1.1 * Vector3::from(corner)), 0.1).unwrap();
        run(&mut solver, 1);
    }
    let empty = Solver::new(SolverOptions::default()).unwrap();
    assert_eq!(empty.snapshot_size(SnapshotShapes::Referenced), empty.snapshot().len());
}

/// A mesh that was deformed is in every snapshot: its shape is another tomorrow.
#[test]
fn a_mesh_that_deforms_is_not_referred_to() {
    let (mut solver, bodies) = scene();
    let before = solver.snapshot_shapes().unwrap();
    solver.set_body_vertices(bodies[2], &CORNERS.map(|corner| 1.2 * Vector3::from(corner)), 0.02).unwrap();
    run(&mut solver, 4);
    assert!(solver.snapshot_shapes().unwrap().len() < before.len());
    let small = solver.snapshot_with(SnapshotShapes::Referenced).unwrap();
    let mut other = Solver::new(SolverOptions::default()).unwrap();
    // The shapes of an earlier moment are enough.
    other.restore_with(&small, &Restoring { shapes: Some(&before), ..Restoring::default() }).unwrap();
    assert_eq!(other.state_hash(), solver.state_hash());
    run(&mut other, 3);
    run(&mut solver, 3);
    assert_eq!(other.state_hash(), solver.state_hash());
    assert_eq!(other.snapshot_shapes().unwrap(), solver.snapshot_shapes().unwrap(), "it still is one that deforms");
}

#[test]
fn shapes_that_are_missing_or_damaged_are_refused_and_change_nothing() {
    let (solver, _) = scene();
    let small = solver.snapshot_with(SnapshotShapes::Referenced).unwrap();
    let shapes = solver.snapshot_shapes().unwrap();
    let mut other = Solver::new(SolverOptions::default()).unwrap();
    let hash = other.state_hash();
    let mut refused = |shapes: Option<&[u8]>| match other.restore_with(&small, &Restoring { shapes, ..Restoring::default() }) {
        Err(Error::Snapshot { reason }) => reason,
        otherwise => panic!("{otherwise:?}"),
    };
    assert!(refused(None).contains("neither in the solver nor in the shapes"));
    assert!(refused(Some(b"nonsense, more than eight bytes")).contains("SHXSHAP"));
    for length in (0..shapes.len()).step_by(97) {
        refused(Some(&shapes[..length]));
    }
    // Any byte of a hash, a size or a shape.
    let stride = (shapes.len() / 300).max(1);
    for at in (24..shapes.len()).step_by(stride) {
        let mut bad = shapes.clone();
        bad[at] ^= 0x20;
        refused(Some(&bad));
    }
    assert_eq!(other.state_hash(), hash);
    assert!(other.body_ids().is_empty());
}
