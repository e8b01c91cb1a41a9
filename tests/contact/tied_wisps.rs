//! Ties and hair contact: strands that are tied together are drawn to one point, though their wisps have radii. The knot has no room for them;
//! beside it they lie as if gathered.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{
    ConstraintDef, ConstraintStatus, ContactModel, Frame, Hold, Solver, SolverOptions, StrandContact, StrandDef, StrandId,
};

const LENGTH: f64 = 0.1;

/// Strands that hang around a circle.
fn hanging(count: usize, circle: f64) -> Vec<StrandDef> {
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    (0..count)
        .map(|k| {
            let mut def = StrandDef::straight(LENGTH, 10);
            def.material.viscosity = 0.02;
            def.material.air_drag = 1e-4;
            let turn = 2.0 * PI * k as f64 / count as f64;
            def.root = Frame { origin: Vector3::new(turn.cos(), turn.sin(), 0.0) * circle, rotation: down };
            def
        })
        .collect()
}

fn tie(strand: StrandId, other: StrandId, arclength: f64) -> ConstraintDef {
    ConstraintDef { strand, arclength, hold: Hold::Tie { other, arclength }, target: Frame::default(), compliance: 0.0 }
}

struct Course {
    unconverged: u32,
    off: f64,
    force: f64,
    contacts: u32,
    points: Vec<Vector3<f64>>,
}

/// Two seconds of swaying, the first quarter of a second left out of account: the ties draw together what was drawn apart.
fn course(model: ContactModel, defs: &[StrandDef], wisp_radius: f64, ties: impl Fn(&[StrandId]) -> Vec<ConstraintDef>) -> Course {
    let mut options = SolverOptions::default();
    (options.contact.model, options.contact.hair) = (model, true);
    let mut solver = Solver::new(options).unwrap();
    let ids = solver.add_strands(defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { wisp_radius, ..StrandContact::default() })).unwrap();
    let ties = solver.add_constraints(&ties(&ids)).unwrap();
    let mut course = Course { unconverged: 0, off: 0.0, force: 0.0, contacts: 0, points: Vec::new() };
    for step in 1..=120 {
        let sway = 0.02 * (2.0 * PI * f64::from(step) / 60.0).sin() * Vector3::x();
        let frames: Vec<Frame> = defs.iter().map(|def| Frame { origin: def.root.origin + sway, ..def.root }).collect();
        solver.set_root_frames(&ids, &frames, 1.0 / 60.0).unwrap();
        let report = solver.step(1.0 / 60.0, 1).unwrap();
        assert_eq!(report.quarantined, 0);
        if step > 15 {
            course.unconverged += report.contact.unconverged;
            course.contacts += report.contact.contacts;
            for id in &ties {
                let state = solver.constraint_state(*id).unwrap();
                assert_eq!(state.status, ConstraintStatus::Holds, "{model:?} step {step}: {state:?}");
                course.off = course.off.max(state.error);
                course.force = course.force.max(state.force.norm());
            }
        }
    }
    solver.sample_strands(&ids, 21, |_, _, sample| course.points.push(sample.position)).unwrap();
    course
}

/// Strands tied in a row, at their tips and above: the knot holds to 1e-9 m by the forces that it takes without contact, a thousandth of
/// what it took while wisps were pushed apart in it.
#[test]
fn a_knot_of_wisps_holds_like_one_of_lines() {
    for model in [ContactModel::Penalty, ContactModel::Coulomb] {
        for (count, at, radius) in [(2, 0.1, 2e-3), (2, 0.07, 2e-3), (5, 0.08, 1e-3)] {
            let defs = hanging(count, 0.01);
            let ties = |ids: &[StrandId]| ids.windows(2).map(|pair| tie(pair[0], pair[1], at)).collect::<Vec<_>>();
            let (wisps, lines) = (course(model, &defs, radius, ties), course(model, &defs, 0.0, ties));
            println!(
                "{model:?} {count} at {at}: {} unconverged, off {:e}, {:e} N, {:e} N without wisps, {} contacts",
                wisps.unconverged, wisps.off, wisps.force, lines.force, wisps.contacts
            );
            assert!(wisps.off < 1e-9 && wisps.unconverged == 0, "{} {:e}", wisps.unconverged, wisps.off);
            assert!(wisps.force < 3.0 * lines.force, "{:e} {:e}", wisps.force, lines.force);
        }
    }
}

/// Away from the knot tied strands keep off each other: two that cross well above it, and are not tied there, do not pass.
#[test]
fn tied_strands_collide_away_from_their_knot() {
    let mut defs = hanging(2, 4e-3);
    // Bent towards each other: as lines they cross on their way down.
    defs[0].natural = vec![[0.0, 0.0, 0.0]; 10];
    for (def, side) in defs.iter_mut().zip([1.0, -1.0]) {
        for row in def.natural.iter_mut().take(5) {
            row[1] = 14.0 * side;
        }
        for row in def.natural.iter_mut().skip(5) {
            row[1] = -14.0 * side;
        }
    }
    let ties = |ids: &[StrandId]| vec![tie(ids[0], ids[1], 0.1)];
    let radius = 1e-3;
    let wisps = course(ContactModel::Coulomb, &defs, radius, ties);
    let lines = course(ContactModel::Coulomb, &defs, 0.0, ties);
    // The points down to 7 cm, three full reaches from the knot.
    let nearest = |points: &[Vector3<f64>]| {
        let (one, other) = (&points[..15], &points[21..36]);
        one.iter().flat_map(|a| other.iter().map(move |b| (a - b).norm())).fold(f64::INFINITY, f64::min)
    };
    println!("nearest {:e}, as lines {:e}; {} contacts", nearest(&wisps.points), nearest(&lines.points), wisps.contacts);
    assert!(nearest(&lines.points) < 1.5 * radius && wisps.contacts > 50, "{:e} {}", nearest(&lines.points), wisps.contacts);
    assert!(nearest(&wisps.points) > 2.0 * radius - 2e-5, "{:e}", nearest(&wisps.points));
}
