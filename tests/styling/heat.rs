use nalgebra::Vector3;
use superhelix::editing::{HeatDef, HeatedShape};
use superhelix::tools::Tool;
use superhelix::{Frame, Freedoms};

use crate::scene::{STEP, hanging, points, row};

const CURLY: [[f64; 3]; 20] = [[5.0, 80.0, 0.0]; 20];

fn everywhere(shape: HeatedShape, rate: f64) -> HeatDef {
    HeatDef { frame: Frame::default(), half_edges: Vector3::repeat(1.0), shape, rate }
}

/// Heated to straight at a rate, natural curvature decays as e^-rate t, however the time is divided; only within the box.
#[test]
fn heat_works_at_its_rate_where_it_is() {
    for parts in [1, 7, 100] {
        let (mut solver, ids) = row(2, 0.12, &CURLY);
        for _ in 0..parts {
            let hot = solver.heat_strands(&ids, &everywhere(HeatedShape::Straight, 3.0), 0.5 / f64::from(parts)).unwrap();
            assert!(hot.iter().all(|hot| (hot - 0.12).abs() < 1e-12));
        }
        let left = (-1.5f64).exp();
        for (now, was) in solver.natural_curvatures(ids[0]).unwrap().iter().zip(&CURLY) {
            assert!((now[1] - was[1] * left).abs() < 1e-5 * was[1] && (now[0] - was[0] * left).abs() < 1e-5 * was[0]);
        }
    }
    let (mut solver, ids) = row(1, 0.12, &CURLY);
    let at = points(&solver, ids[0], 21)[10];
    let frame = Frame { origin: at, ..Frame::default() };
    let heat = HeatDef { frame, half_edges: Vector3::repeat(2e-3), shape: HeatedShape::Straight, rate: 1e6 };
    let hot = solver.heat_strands(&ids, &heat, 1.0).unwrap()[0];
    assert!(hot > 2e-3 && hot < 0.02, "{hot}");
    let natural = solver.natural_curvatures(ids[0]).unwrap();
    assert_eq!(natural[2], CURLY[2]);
    assert!(natural.iter().filter(|row| row[1] == 80.0).count() >= 14, "{natural:?}");
    assert!(natural.iter().any(|row| row[1] == 0.0));
}

/// Plates that go down a curl leave it straighter; what a barrel holds stays as it was held.
#[test]
fn a_straightener_and_a_curler() {
    let (mut solver, ids) = row(3, 0.12, &CURLY);
    let span = |solver: &superhelix::Solver| {
        ids.iter().map(|id| (points(solver, *id, 2)[1] - points(solver, *id, 2)[0]).norm()).fold(f64::INFINITY, f64::min)
    };
    let curled = span(&solver);
    let (local, half_edges) = Tool::PLATES.hot_box(2e-3).unwrap();
    for step in 0..360 {
        let z = 0.01 - 0.14 * f64::from(step) / 360.0;
        // The plates' depth goes along the hair.
        let frame = Frame { origin: Vector3::z() * z, ..Frame::default() }.compose(&local);
        let heat = HeatDef { frame, half_edges: half_edges + Vector3::y() * 0.05, shape: HeatedShape::Straight, rate: 8.0 };
        solver.heat_strands(&ids, &heat, STEP).unwrap();
        solver.step(STEP, 1).unwrap();
    }
    assert!(span(&solver) > 0.114 && curled < 0.1, "{curled} {}", span(&solver));

    // Straight hair put into curls, as wound on a barrel, and heated: it is then at rest there, but for its weight.
    let (mut solver, ids) = row(2, 0.12, &[[0.0; 3]; 20]);
    for id in &ids {
        solver.set_curvatures(*id, &CURLY, None).unwrap();
    }
    solver.heat_strands(&ids, &everywhere(HeatedShape::Present, 2.0), 3.0).unwrap();
    let natural = solver.natural_curvatures(ids[0]).unwrap();
    assert!(natural.iter().all(|row| (row[1] - 80.0 * (1.0 - (-6.0f64).exp())).abs() < 1e-3), "{natural:?}");
}

/// What cannot change is not changed.
#[test]
fn frozen_curvatures_keep_their_natural_value() {
    let (mut solver, _) = row(1, 0.12, &CURLY);
    let mut def = hanging(Vector3::zeros(), 0.0, 0.12, &CURLY);
    def.freedoms = Freedoms::BEND1;
    let id = solver.add_strands(&[def]).unwrap()[0];
    solver.heat_strands(&[id], &everywhere(HeatedShape::Straight, 1e6), 1.0).unwrap();
    assert_eq!(solver.natural_curvatures(id).unwrap()[3], [5.0, 0.0, 0.0]);
}
