use nalgebra::Vector3;
use superhelix::editing::ClipDef;
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::{Error, Frame, Hold};

use crate::scene::{STEP, apart, points, row};

const WAVY: [[f64; 3]; 8] = [[3.0, 25.0, 5.0]; 8];

fn clip(z: f64, hold: Hold) -> ClipDef {
    let frame = Frame { origin: Vector3::new(0.0, 0.0, z), ..Frame::default() };
    ClipDef { frame, half_edges: Vector3::new(0.1, 0.1, 4e-3), hold, compliance: 0.0 }
}

/// A closed clip moves nothing; moved, it takes the hair in it along; opened, hair goes back to where it hung.
#[test]
fn a_clip_holds_and_lets_go() {
    for hold in [Hold::Point, Hold::Direction, Hold::Frame] {
        let (mut solver, ids) = row(5, 0.12, &WAVY);
        let before: Vec<_> = ids.iter().map(|id| points(&solver, *id, 30)).collect();
        let def = clip(-0.06, hold);
        let held = solver.clip_strands(&ids, &def).unwrap();
        assert!(held.len() >= ids.len(), "{}", held.len());
        for _ in 0..30 {
            solver.step(STEP, 1).unwrap();
        }
        for (id, before) in ids.iter().zip(&before) {
            let moved = apart(&points(&solver, *id, 30), before);
            assert!(moved < 1e-6, "{hold:?} {moved}");
        }
        let to = Frame { origin: Vector3::new(0.0, 0.0, -0.055), rotation: from_rotation_vector(Vector3::new(0.0, 0.1, 0.1)) };
        solver.move_constraints(&held, &def.frame, &to, 0.25).unwrap();
        for _ in 0..60 {
            solver.step(STEP, 1).unwrap();
        }
        for constraint in &held {
            let (state, def_now) = (solver.constraint_state(*constraint).unwrap(), solver.constraint(*constraint).unwrap());
            assert!(state.error < 1e-6, "{state:?}");
            // In the clip, the held points are where they were.
            let local = to.rotation.inverse() * (def_now.target.origin - to.origin);
            assert!(local.z.abs() <= 4e-3 + 1e-9, "{local}");
        }
        solver.remove_constraints(&held).unwrap();
        for _ in 0..1200 {
            solver.step(STEP, 1).unwrap();
        }
        for (id, before) in ids.iter().zip(&before) {
            let left = apart(&points(&solver, *id, 30), before);
            assert!(left < 0.01 * 0.12, "{hold:?} {left}");
        }
    }
}

/// A blade cuts what crosses it, there, and nothing else moves, by a bit.
#[test]
fn scissors_cut_where_the_blade_crosses() {
    let (mut solver, ids) = row(5, 0.12, &WAVY);
    let held = solver.clip_strands(&ids[1..2], &clip(-0.085, Hold::Point)).unwrap();
    let before: Vec<_> = ids.iter().map(|id| solver.curvatures(*id).unwrap().to_vec()).collect();
    // A blade in the plane z = −0.07 that reaches the first three.
    let (a, b) = (Vector3::new(-0.1, -0.1, -0.07), Vector3::new(0.002, 0.1, -0.07));
    let blade = [a, Vector3::new(b.x, a.y, a.z), b, Vector3::new(a.x, b.y, a.z)];
    let positions: Vec<_> = ids.iter().map(|id| points(&solver, *id, 2001)).collect();
    let crosses = |points: &[Vector3<f64>]| {
        points.windows(2).any(|pair| pair[0].z >= -0.07 && pair[1].z < -0.07 && pair[0].x < 0.002 && pair[0].y.abs() < 0.1)
    };
    let expected: Vec<_> = ids.iter().zip(&positions).filter(|(_, points)| crosses(points)).map(|(id, _)| *id).collect();
    assert!((1..5).contains(&expected.len()), "{}", expected.len());
    let cuts = solver.cut_across(&ids, &blade, 1e-3).unwrap();
    assert_eq!(cuts.iter().map(|cut| cut.strand).collect::<Vec<_>>(), expected);
    for cut in &cuts {
        let length: f64 = solver.element_lengths(cut.strand).unwrap().iter().sum();
        assert!((length - cut.arclength).abs() < 1e-15 && (cut.arclength + cut.removed - 0.12).abs() < 1e-12);
        let tip = *points(&solver, cut.strand, 2).last().unwrap();
        assert!((tip.z + 0.07).abs() < 1e-9 && (tip - cut.position).norm() < 1e-9, "{tip}");
        assert_eq!(cut.constraints.is_empty(), cut.strand != ids[1]);
    }
    assert_eq!(solver.constraint_state(held[0]).is_err(), expected.contains(&ids[1]));
    for (id, before) in ids.iter().zip(&before) {
        let now = solver.curvatures(*id).unwrap();
        assert_eq!(now, &before[..now.len()]);
    }
    // Nothing is left to cut there; and no strand becomes shorter than asked.
    assert!(solver.cut_across(&ids, &blade, 1e-3).unwrap().is_empty());
    let high = blade.map(|corner| Vector3::new(10.0 * corner.x, corner.y, -0.01));
    for cut in solver.cut_across(&ids, &high, 0.03).unwrap() {
        assert!((cut.arclength - 0.03).abs() < 1e-15);
    }
}

#[test]
fn bad_input_changes_nothing() {
    let (mut solver, ids) = row(2, 0.12, &WAVY);
    let name = |result: Result<(), Error>| match result {
        Err(Error::InvalidArgument { argument, .. } | Error::InvalidId { argument, .. }) => argument,
        other => panic!("{other:?}"),
    };
    let def = clip(-0.06, Hold::Point);
    let flat = ClipDef { half_edges: Vector3::new(0.1, 0.0, 0.1), ..def };
    assert_eq!(name(solver.clip_strands(&ids, &flat).map(drop)), "clip.half_edges[1]");
    assert_eq!(name(solver.clip_strands(&[ids[0], ids[0]], &def).map(drop)), "ids[1]");
    let blade = [Vector3::zeros(); 4];
    assert_eq!(name(solver.cut_across(&ids, &blade, 0.0).map(drop)), "min_length");
    assert_eq!(name(solver.cut_across(&ids, &[Vector3::repeat(f64::NAN); 4], 1e-3).map(drop)), "corners[0][0]");
    assert!(solver.constraint_ids().is_empty());
}
