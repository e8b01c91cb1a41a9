//! The contact-space problem: its solver against the laws, on strands that respond to forces like cantilevers (Euler and Bernoulli's
//! G(s, t) = s² (3 t − s)/6 for s ≤ t), and bilateral constraints against what they must hold.

use crate::numbers::Numbers;
use nalgebra::{Matrix3, Vector3};
use superhelix::internals::contact::constraint::law::Law;
use superhelix::internals::contact::constraint::law::bilateral::{BilateralLaw, ConstrainedAxes};
use superhelix::internals::contact::constraint::law::coefficient::Coefficient;
use superhelix::internals::contact::constraint::law::contact::{Contact, Friction};
use superhelix::internals::contact::constraint::law::response::Response;
use superhelix::internals::contact::constraint::law::ring::Ring;
use superhelix::internals::contact::solver::contact_space::{ContactSpace, End, SpaceConstraint};
use superhelix::internals::contact::solver::gauss_seidel::{GaussSeidel, Report, Settings};

const STEP: f64 = 1.0 / 60.0;

/// Adds a strand along x, touched at the given places (m): it gives a thousandth along itself of what it gives across.
fn cantilever(space: &mut ContactSpace, places: &[f64]) {
    let size = 3 * places.len();
    let matrix = space.add_strand(places.len());
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate() {
            let (s, t) = (a.min(*b), a.max(*b));
            for (axis, softness) in [1e4, 1e7, 0.7e7].into_iter().enumerate() {
                matrix[(3 * j + axis) * size + 3 * i + axis] = softness * s * s * (3.0 * t - s) / 6.0;
            }
        }
    }
}

fn end(strand: u32, point: u32) -> End {
    End { strand, point }
}

fn solve(space: &ContactSpace, tolerance: f64) -> (Vec<Vector3<f64>>, Report) {
    let mut forces = vec![Vector3::zeros(); space.constraints().len()];
    let report =
        GaussSeidel::default().solve(space, &Settings { tolerance, max_sweeps: 5000, ..Settings::default() }, &mut forces);
    (forces, report)
}

/// The largest residual of the laws, from the matrices themselves.
fn residual(space: &ContactSpace, forces: &[Vector3<f64>], report: &Report) -> f64 {
    let mut displacements = Vec::new();
    space.displacements(forces, &mut displacements);
    let residual = |(k, constraint): (usize, &SpaceConstraint)| {
        constraint.law.residual(space.relative(k, &displacements), forces[k], STEP, report.length, report.force)
    };
    space.constraints().iter().enumerate().map(residual).fold(0.0, f64::max)
}

fn contact(normal: Vector3<f64>, response: Response, friction: Friction) -> Law {
    Law::Contact(Contact { normal, response, friction })
}

const MU: Friction = Friction::Coulomb(Coefficient { mean: 0.3, lean: Vector3::new(0.06, 0.0, 0.0) });
const SPRING: Response = Response::Penalty { stiffness: 10.0, damping: 0.01, depth_at_start: 1e-5 };

#[test]
fn the_derivatives_of_the_laws_agree_with_finite_differences() {
    let mut numbers = Numbers(5);
    let mut tried = 0;
    for case in 0..4000 {
        let d = numbers.direction();
        let lean = d.cross(&numbers.direction()) * 0.2;
        let c = Coefficient { mean: 0.4, lean };
        let response = [Response::Hard, SPRING, Response::Regularised { stiffness: 2.0, depth: 0.3 }][case % 3];
        let friction = [Friction::None, Friction::Coulomb(c), Friction::Viscous(Coefficient { mean: 0.01, lean: lean * 0.02 })];
        let law = if case % 7 == 0 {
            Law::Ring(Ring { tangent: d, friction: c })
        } else {
            contact(d, response, friction[case / 3 % 3])
        };
        let w = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 0.5));
        let (u, lambda) = (numbers.direction() * 0.5, numbers.direction() + d * numbers.within(0.0, 2.0));
        // Below zero the radius of the cone is taken to go on as above.
        if lambda.dot(&d) < 1e-3 {
            continue;
        }
        let at = |u: &Vector3<f64>, lambda: &Vector3<f64>| law.linearise(u, lambda, &w, STEP);
        let here = at(&u, &lambda);
        let h = 1e-6;
        for axis in 0..3 {
            let e = Vector3::ith(axis, h);
            for (slope, plus, minus) in [
                (here.by_displacement, at(&(u + e), &lambda), at(&(u - e), &lambda)),
                (here.by_force, at(&u, &(lambda + e)), at(&u, &(lambda - e))),
            ] {
                // A kink between the two is no derivative.
                if (plus.by_force - minus.by_force).norm() + (plus.by_displacement - minus.by_displacement).norm() > 1e-3 {
                    continue;
                }
                tried += 1;
                let difference = (plus.residual - minus.residual) / (2.0 * h);
                let off = (slope.column(axis) - difference).norm();
                // Central differences: h² times third derivatives, and a rounding over h.
                assert!(off < 1e-6, "case {case}: {off:e} {law:?}");
            }
        }
    }
    assert!(tried > 20_000, "{tried}");
}

#[test]
fn contacts_of_one_strand_are_solved_together_however_close_they_are() {
    // Twins a hundredth of a millimetre apart: what they give differently is 1e-10 of what they give alike.
    let places = [0.05, 0.08, 0.080_01, 0.12, 0.16, 0.160_01, 0.2];
    for (name, response, friction, tolerance) in [
        ("hard", Response::Hard, Friction::None, 1e-10),
        ("Coulomb", Response::Hard, MU, 1e-8),
        ("penalty", SPRING, Friction::Viscous(Coefficient { mean: 1e-4, lean: Vector3::new(2e-5, 0.0, 0.0) }), 1e-10),
        (
            "regularised",
            Response::Regularised { stiffness: 10.0, depth: 1e-4 },
            Friction::Viscous(Coefficient::uniform(1e-4)),
            1e-10,
        ),
    ] {
        let mut numbers = Numbers(6);
        for case in 0..40 {
            let mut space = ContactSpace::default();
            space.reset(STEP).unwrap();
            cantilever(&mut space, &places);
            for (point, place) in places.iter().enumerate() {
                let unconstrained =
                    Vector3::new(1e-4 * numbers.within(-1.0, 1.0), 2e-3 * place, -0.02 * place * numbers.within(0.2, 1.0));
                let law = contact(Vector3::z(), response, friction);
                space.add_constraint(SpaceConstraint { first: end(0, point as u32), second: None, law, unconstrained }).unwrap();
            }
            let (forces, report) = solve(&space, tolerance);
            assert!(report.residual <= tolerance && report.sweeps <= 200, "{name} {case}: {report:?}");
            let check = residual(&space, &forces, &report);
            assert!(check <= 1.01 * tolerance + 1e-12, "{name} {case}: {check:e}");
            assert!(forces.iter().any(|f| f.z > 0.0));
        }
    }
}

#[test]
fn strands_on_each_other_obey_the_laws() {
    // A pile: each lies on the one before at places of its own.
    for (strands, friction) in [(3, MU), (30, Friction::None), (30, MU), (50, MU)] {
        let mut numbers = Numbers(8);
        let mut space = ContactSpace::default();
        space.reset(STEP).unwrap();
        let mut places: Vec<Vec<f64>> = (0..strands).map(|_| (0..6).map(|_| numbers.within(0.02, 0.2)).collect()).collect();
        for list in &mut places {
            list.sort_by(f64::total_cmp);
            cantilever(&mut space, list);
        }
        for strand in 0..strands {
            for point in 0..3 {
                let (first, second) =
                    (end(strand as u32, 2 * point), (strand > 0).then(|| end(strand as u32 - 1, 2 * point + 1)));
                let unconstrained = Vector3::new(1e-4 * numbers.next(), 4e-4 * numbers.next(), -1e-3 * numbers.next());
                space
                    .add_constraint(SpaceConstraint {
                        first,
                        second,
                        law: contact(Vector3::z(), Response::Hard, friction),
                        unconstrained,
                    })
                    .unwrap();
            }
        }
        let (forces, report) = solve(&space, 1e-6);
        assert!(report.residual <= 1e-6, "{strands}: {report:?}");
        let check = residual(&space, &forces, &report);
        assert!(check <= 1.01e-6, "{check:e}");
        // The same again, to the bit.
        assert_eq!(forces, solve(&space, 1e-6).0);
    }
}

#[test]
fn viscous_friction_needs_no_normal_force() {
    // λ_T = −c u_T/h with u_T = b_T + W_TT λ_T: λ_T = −b_T/(h/c + W_TT), also where the surfaces are apart.
    let (c, w) = (0.05, 3.0);
    let mut space = ContactSpace::default();
    space.reset(STEP).unwrap();
    let matrix = space.add_strand(1);
    (matrix[0], matrix[4], matrix[8]) = (w, w, w);
    let law = contact(Vector3::z(), SPRING, Friction::Viscous(Coefficient::uniform(c)));
    space
        .add_constraint(SpaceConstraint { first: end(0, 0), second: None, law, unconstrained: Vector3::new(0.2, -0.1, 0.3) })
        .unwrap();
    let (forces, _) = solve(&space, 1e-12);
    let expected = Vector3::new(-0.2, 0.1, 0.0) / (STEP / c + w);
    assert!((forces[0] - expected).norm() <= 1e-12 * expected.norm(), "{}", forces[0]);
}

const PIN: Law = Law::Bilateral(BilateralLaw { axes: ConstrainedAxes::All, compliance: 0.0 });

/// Two strands of three points each, and contacts on them.
fn solved(constraints: &[(End, Option<End>, Law, Vector3<f64>)]) -> (ContactSpace, Vec<Vector3<f64>>, Report) {
    let mut space = ContactSpace::default();
    space.reset(STEP).unwrap();
    cantilever(&mut space, &[0.05, 0.1, 0.2]);
    cantilever(&mut space, &[0.07, 0.11, 0.18]);
    for (first, second, law, unconstrained) in constraints {
        space
            .add_constraint(SpaceConstraint { first: *first, second: *second, law: *law, unconstrained: *unconstrained })
            .unwrap();
    }
    let (forces, report) = solve(&space, 1e-12);
    (space, forces, report)
}

/// How far each contact is from where it began, m.
fn relative(space: &ContactSpace, forces: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut displacements = Vec::new();
    space.displacements(forces, &mut displacements);
    (0..forces.len()).map(|k| space.relative(k, &displacements)).collect()
}

#[test]
fn bilateral_constraints_hold_across_several_contacts() {
    let off = Vector3::new(1e-3, -2e-3, 3e-3);
    // A pin, pins of two points, a tie, a closed loop (a strand's tip on its own middle), a tie and pins of both strands.
    type Row = (End, Option<End>, Law, Vector3<f64>);
    let cases: [Vec<Row>; 5] = [
        vec![(end(0, 2), None, PIN, off)],
        vec![(end(0, 1), None, PIN, off), (end(0, 2), None, PIN, -off)],
        vec![(end(0, 1), Some(end(1, 2)), PIN, off)],
        vec![(end(0, 2), Some(end(0, 1)), PIN, off)],
        vec![(end(0, 1), Some(end(1, 2)), PIN, off), (end(0, 2), None, PIN, -off), (end(1, 0), None, PIN, off * 0.1)],
    ];
    for (case, constraints) in cases.iter().enumerate() {
        let (space, forces, report) = solved(constraints);
        assert!(report.dependent.is_empty(), "case {case}");
        for u in relative(&space, &forces) {
            assert!(u.norm() <= 1e-12, "case {case}: {:e}", u.norm());
        }
    }
}

#[test]
fn dependent_constraints_are_reported() {
    let off = Vector3::new(1e-3, -2e-3, 3e-3);
    // Twice the same: consistent, and reported without residual.
    let (space, forces, report) = solved(&[(end(0, 2), None, PIN, off), (end(0, 2), None, PIN, off)]);
    assert_eq!(report.dependent.len(), 3);
    assert!(
        report
            .dependent
            .iter()
            .all(|dependent| dependent.residual <= 1e-12 && dependent.decided_by == [1 - dependent.constraint]),
        "{:?}",
        report.dependent
    );
    assert!(relative(&space, &forces).iter().all(|u| u.norm() <= 1e-12));
    // A contradiction of a millimetre along z.
    let (space, forces, report) = solved(&[(end(0, 2), None, PIN, off), (end(0, 2), None, PIN, off + Vector3::z() * 1e-3)]);
    let worst = report.dependent.iter().map(|dependent| dependent.residual).fold(0.0, f64::max);
    assert!((worst - 1e-3).abs() <= 1e-12, "{worst:e}");
    // One of the two holds.
    assert!(relative(&space, &forces).iter().any(|u| u.norm() <= 1e-12));
}

#[test]
fn bilateral_constraints_hold_beside_contacts() {
    let off = Vector3::new(2e-4, -3e-4, 1e-3);
    let floor = contact(Vector3::z(), Response::Hard, MU);
    let (space, forces, report) = solved(&[
        (end(0, 2), None, PIN, off),
        (end(0, 1), None, floor, Vector3::new(1e-4, 2e-4, -1e-3)),
        (end(0, 0), Some(end(1, 0)), floor, Vector3::new(1e-4, 0.0, -2e-4)),
        (end(1, 2), Some(end(0, 2)), PIN, -off),
        (end(1, 1), None, floor, Vector3::new(0.0, 2e-4, -5e-4)),
    ]);
    let u = relative(&space, &forces);
    assert!(u[0].norm() <= 1e-12 && u[3].norm() <= 1e-12, "{:e} {:e}", u[0].norm(), u[3].norm());
    assert!(report.residual <= 1e-12 && residual(&space, &forces, &report) <= 1e-11, "{report:?}");
    assert!([1, 2, 4].iter().any(|k| forces[*k].z > 0.0));
}

#[test]
fn pins_of_many_strands_cost_the_sum_of_each() {
    // Counted, not timed: a strand's pin moves its own points only, so that no strand's forces depend on the number of others.
    let alone = solved(&[(end(0, 2), None, PIN, Vector3::x())]).1[0];
    let mut space = ContactSpace::default();
    space.reset(STEP).unwrap();
    for strand in 0..1000 {
        cantilever(&mut space, &[0.05, 0.1, 0.2]);
        space
            .add_constraint(SpaceConstraint { first: end(strand, 2), second: None, law: PIN, unconstrained: Vector3::x() })
            .unwrap();
    }
    let (forces, report) = solve(&space, 1e-9);
    assert!(forces.iter().all(|force| *force == alone) && report.dependent.is_empty());
}
