//! The time for posing strands: `cargo bench --bench posing --profile demo`. Prints the rows of a table in
//! `docs/theory/posing.md`.

use std::time::Instant;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{Brush, DragTarget, PoseOptions};
use superhelix::{BodyDef, Frame, Shape, Solver, SolverOptions, StrandDef, Workers};

const STRANDS: usize = 1000;
const ELEMENTS: usize = 10;
const LENGTH: f64 = 0.25;
/// Moves of a stroke.
const MOVES: usize = 30;
/// Strokes; the fastest counts.
const STROKES: usize = 7;

/// Wavy strands that fall down a head of 9 cm.
fn groom() -> Vec<StrandDef> {
    (0..STRANDS)
        .map(|k| {
            // Evenly on the upper half: a spiral of the golden angle.
            let height = 1.0 - (k as f64 + 0.5) / STRANDS as f64;
            let (around, across) = (2.399_963 * k as f64, (1.0 - height * height).sqrt());
            let out = Vector3::new(across * around.cos(), across * around.sin(), height);
            let rotation = UnitQuaternion::rotation_between(&Vector3::x(), &out).unwrap_or_default();
            let wave = |element: usize| 25.0 * (1.3 * element as f64 + k as f64).sin();
            StrandDef {
                natural: (0..ELEMENTS).map(|element| [5.0, 8.0 + wave(element), wave(element + 1)]).collect(),
                root: Frame { origin: 0.09 * out, rotation },
                ..StrandDef::straight(LENGTH, ELEMENTS)
            }
        })
        .collect()
}

fn main() {
    println!("1000 strands of 10 elements, ms a move (the quickest of {STROKES} strokes of {MOVES} moves)");
    for threads in [1, 2] {
        for (name, head) in [("in the air", false), ("on a head", true)] {
            let workers = if threads == 1 { Workers::Serial } else { Workers::Pool(threads) };
            let mut solver = Solver::new(SolverOptions { workers, ..SolverOptions::default() }).expect("a solver");
            let ids = solver.add_strands(&groom()).expect("strands");
            if head {
                let sphere = Shape::new_sphere(0.089).expect("a sphere");
                solver.add_bodies(vec![BodyDef::new(std::sync::Arc::new(sphere))]).expect("a body");
            }
            let options = PoseOptions::default();
            let before = solver.shapes(&ids).expect("shapes");

            let mut brushed = (f64::INFINITY, 0, 0);
            for _ in 0..STROKES {
                solver.set_shapes(&ids, &before).expect("shapes");
                let begun = Instant::now();
                let (mut touched, mut iterations) = (0, 0);
                for step in 0..MOVES {
                    let centre = Vector3::new(0.0, -0.1 + 0.006 * step as f64, 0.18);
                    let brush = Brush { centre, radius: 10.0, falloff: 1.0, movement: Vector3::new(0.0, 0.006, -0.001) };
                    let found = solver.brush(&ids, &brush, &options).expect("a brush");
                    touched += found.iter().filter(|found| found.touched).count();
                    iterations += found.iter().map(|found| found.iterations).sum::<u32>();
                }
                let took = begun.elapsed().as_secs_f64() / MOVES as f64;
                brushed = (brushed.0.min(took), touched / MOVES, iterations);
            }
            let (took, touched, iterations) = brushed;
            let each = f64::from(iterations) / (touched * MOVES) as f64;
            println!("brush, {name}, {threads} threads: {:.2} ms, {touched} strands touched, {each:.1} iterations", 1e3 * took);

            let mut dragged = (f64::INFINITY, 0);
            for _ in 0..STROKES {
                solver.set_shapes(&ids, &before).expect("shapes");
                let mut targets = Vec::new();
                for id in &ids {
                    let push = |_: usize, sample: &superhelix::Sample| {
                        targets.push(DragTarget { arclength: LENGTH, position: sample.position });
                    };
                    solver.sample_at(*id, &[LENGTH], push).expect("a tip");
                }
                let begun = Instant::now();
                let mut iterations = 0;
                for _ in 0..MOVES {
                    targets.iter_mut().for_each(|target| target.position += Vector3::new(0.0, 0.003, -0.002));
                    let found = solver.drag(&ids, &targets, &options).expect("a drag");
                    iterations += found.iter().map(|found| found.iterations).sum::<u32>();
                }
                dragged = (dragged.0.min(begun.elapsed().as_secs_f64() / MOVES as f64), iterations);
            }
            let each = f64::from(dragged.1) / (STRANDS * MOVES) as f64;
            println!("drag, {name}, {threads} threads: {:.2} ms, {each:.1} iterations", 1e3 * dragged.0);
        }
    }
}
