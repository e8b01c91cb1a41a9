//! Combing removes a tangle: the lateral spread of a ruffled wisp falls stroke by stroke. Prints the numbers in docs/theory/styling_tools.md.

use nalgebra::Vector3;
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::tools::{RingComb, RingCombOptions, Tool};
use superhelix::{Frame, Solver, SolverOptions, StrandId};

use crate::scene::{STEP, hanging, points};

const LENGTH: f64 = 0.1;
const ELEMENTS: usize = 10;
/// A dryer that follows the comb sets what it straightens, 1/s.
const SET_RATE: f64 = 1.0;

/// Strands that hang from a spot, ruffled: each bent otherwise along its length.
fn ruffled(count: usize) -> (Solver, Vec<StrandId>) {
    let mut options = SolverOptions::default();
    options.step.tolerance = 1e-6;
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<_> = (0..count)
        .map(|k| {
            let wave = |i: usize, phase: f64| (1.7 * (i as f64) + 2.4 * (k as f64) + phase).sin();
            let natural: Vec<[f64; 3]> = (0..ELEMENTS).map(|i| [0.0, 60.0 * wave(i, 0.0), 60.0 * wave(i, 1.3)]).collect();
            let x = 2e-3 * (k as f64 - 0.5 * (count - 1) as f64);
            hanging(Vector3::x() * x, 0.9 * k as f64, LENGTH, &natural)
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&Default::default())).unwrap();
    solver.settle(&ids, &Default::default()).unwrap();
    (solver, ids)
}

/// How far the strands' points are from below their roots, rms, m.
fn spread(solver: &Solver, ids: &[StrandId]) -> f64 {
    let mut squares = Vec::new();
    for id in ids {
        let points = points(solver, *id, 40);
        squares.extend(points.iter().map(|point| (point.x - points[0].x).powi(2) + (point.y - points[0].y).powi(2)));
    }
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn the_spread_of_a_ruffled_wisp_falls_stroke_by_stroke() {
    let (mut solver, ids) = ruffled(8);
    let teeth_along_y = from_rotation_vector(Vector3::x() * -0.5 * std::f64::consts::PI);
    let tool = Tool::Comb { teeth: 9, spacing: 2e-3, length: 0.06, radius: 0.4e-3 };
    let mut spreads = vec![spread(&solver, &ids)];
    for _ in 0..4 {
        // In from the front, its teeth first, then down.
        let pose = |y: f64, z: f64| Frame { origin: Vector3::new(0.0, y, z), rotation: teeth_along_y };
        let mut comb = RingComb::new(&tool, &pose(-0.09, -0.012), &RingCombOptions::default()).unwrap();
        for step in 1..=240 {
            let t = f64::from(step) / 240.0;
            let to =
                if t < 0.25 { pose(-0.09 + 0.06 * t / 0.25, -0.012) } else { pose(-0.03, -0.012 - 0.11 * (t - 0.25) / 0.75) };
            comb.before_step(&mut solver, &ids, &to, STEP).unwrap();
            solver.step(STEP, 1).unwrap();
            comb.after_step(&mut solver).unwrap();
            // What hangs on the comb between root and teeth is drawn straight, and set so.
            let held: Vec<StrandId> = comb.held().map(|(strand, _)| strand).collect();
            let frame = Frame { origin: Vector3::new(0.0, 0.0, 0.5 * to.origin.z), ..Frame::default() };
            let half_edges = Vector3::new(0.05, 0.05, (-0.5 * to.origin.z).max(1e-4));
            let heat = superhelix::editing::HeatDef {
                frame,
                half_edges,
                shape: superhelix::editing::HeatedShape::Present,
                rate: SET_RATE,
            };
            solver.heat_strands(&held, &heat, STEP).unwrap();
        }
        comb.release(&mut solver).unwrap();
        for _ in 0..240 {
            solver.step(STEP, 1).unwrap();
        }
        spreads.push(spread(&solver, &ids));
    }
    for (stroke, spread) in spreads.iter().enumerate() {
        println!("stroke {stroke}: lateral spread {:.2} mm", 1e3 * spread);
    }
    for pair in spreads.windows(2) {
        assert!(pair[1] < pair[0], "{spreads:?}");
    }
    assert!(spreads[4] < 0.6 * spreads[0], "{spreads:?}");
}
