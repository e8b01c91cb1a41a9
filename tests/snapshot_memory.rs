//! The memory for scrubbing: a snapshot of each of a hundred frames of a real groom on its bust, the bust's grid kept once.

mod held_bytes;

use std::sync::Arc;

use held_bytes::held_bytes;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{FitOptions, fit_polyline};
use superhelix::io::{Curves, obj_mesh};
use superhelix::reading::SnapshotShapes;
use superhelix::shapes::{DistanceGrid, Sides};
use superhelix::{BodyDef, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, UsualLimits};

const FRAMES: usize = 100;
/// The header's advice for such hair.
const ELEMENTS: usize = 5;
/// Metres per unit of the groom and the bust.
const SCALE: f64 = 0.01;

fn at(point: [f32; 3]) -> Vector3<f64> {
    Vector3::from(point.map(f64::from)) * SCALE
}

/// The 228 guides as they are drawn, which rest so, and touch the bust.
fn groom() -> Solver {
    let curves = Curves::read("tests/data/grooms/sintel_hair_001.tfx").unwrap();
    let bust = obj_mesh::read("tests/data/grooms/sintel_bust.obj").unwrap();
    let vertices = bust.vertices.iter().map(|v| Vector3::from(*v) * SCALE).collect();
    let mesh = Shape::new_mesh(vertices, bust.triangles, Sides::Front { depth: 0.02 }).unwrap();
    let grid = DistanceGrid::bake(mesh.mesh().unwrap(), 3e-3, 0.02).unwrap();
    // Snapshots do not depend on the number of iterations.
    let limits = UsualLimits { work: Some(20_000), seconds: None };
    let options = SolverOptions { gravity: Vector3::new(0.0, -9.81, 0.0), limits, ..SolverOptions::default() };
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..curves.strand_count())
        .map(|k| {
            let points: Vec<Vector3<f64>> = curves.strand(k).iter().map(|point| at(*point)).collect();
            let fit = fit_polyline(&points, &FitOptions::elements(ELEMENTS)).unwrap();
            let mut def = StrandDef::straight(1.0, ELEMENTS);
            (def.element_lengths, def.natural, def.root) = (fit.element_lengths, fit.curvatures, fit.root);
            def.material.internal_friction = 1e-10;
            def.material.air_drag = 5e-6;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    let contact = StrandContact { exempt_length: 0.015, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&contact)).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_grid(grid)))]).unwrap();
    solver
}

// One test: the counter is the process's.
#[test]
fn a_hundred_frames_of_a_groom_take_less_than_70_megabytes() {
    let mut solver = groom();
    assert_eq!(solver.strand_count(), 228);
    let (strands, bodies) = (solver.strand_ids(), solver.body_ids());
    let frames: Vec<Frame> = strands.iter().map(|id| solver.root_frame(*id).unwrap()).collect();
    let before = held_bytes();
    let shapes = solver.snapshot_shapes().unwrap();
    let (mut images, mut hashes, mut working) = (Vec::new(), Vec::new(), 0);
    for frame in 0..FRAMES {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.3 * (0.1 * frame as f64).sin());
        let turned = |at: &Frame| Frame { origin: turn * at.origin, rotation: turn * at.rotation };
        solver.set_root_frames(&strands, &frames.iter().map(turned).collect::<Vec<_>>(), 1.0 / 30.0).unwrap();
        solver.set_body_frames(&bodies, &[turned(&Frame::default())], 1.0 / 30.0).unwrap();
        let held = held_bytes();
        solver.step(1.0 / 30.0, 1).unwrap();
        // A step's own memory belongs to the solver, with or without snapshots.
        working += held_bytes() as isize - held as isize;
        images.push(solver.snapshot_with(SnapshotShapes::Referenced).unwrap());
        hashes.push(solver.state_hash());
    }
    let held = held_bytes() as isize - before as isize - working;
    let whole = solver.snapshot_size(SnapshotShapes::Included);
    let megabytes = held as f64 / 1e6;
    let last = images[FRAMES - 1].len();
    println!(
        "{FRAMES} frames: {megabytes:.1} MB; {last} bytes a frame, {} of shapes, {whole} bytes a snapshot that has all",
        shapes.len()
    );
    assert!(megabytes < 70.0, "{megabytes} MB");
    assert!(shapes.len() > last, "the bust is worth keeping once: {} {last}", shapes.len());
    // Back and forth, without a copy of the bust for each.
    let scrubbing = held_bytes();
    for frame in (0..FRAMES).rev().chain([50, 3, 99]) {
        solver.restore(&images[frame]).unwrap();
        assert_eq!(solver.state_hash(), hashes[frame], "frame {frame}");
    }
    let grown = held_bytes() as isize - scrubbing as isize;
    assert!(grown < 200_000, "{grown} bytes");
}
