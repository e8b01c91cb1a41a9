//! The contact laws and their exact solves for one contact: against the laws themselves, and against a search of all directions.

use crate::numbers::Numbers;
use nalgebra::{Matrix3, Vector3};
use superhelix::internals::contact::constraint::law::bilateral::{BilateralLaw, ConstrainedAxes};
use superhelix::internals::contact::constraint::law::coefficient::Coefficient;
use superhelix::internals::contact::constraint::law::contact::{Contact, Friction};
use superhelix::internals::contact::constraint::law::response::Response;
use superhelix::internals::contact::constraint::law::ring::Ring;
use superhelix::internals::contact::constraint::law::{Law, LawSolve};

const STEP: f64 = 1.0 / 60.0;

/// The other parameters of the laws.
trait Draws {
    fn response(&mut self, decades: f64) -> Matrix3<f64>;
    fn coefficient(&mut self, most: f64) -> Coefficient;
    fn friction(&mut self) -> Friction;
    fn normal_response(&mut self) -> Response;
}

impl Draws for Numbers {
    /// A response of condition up to 10^`decades`, some quite singular; m/N.
    fn response(&mut self, decades: f64) -> Matrix3<f64> {
        let a = self.direction();
        let b = a.cross(&self.direction()).normalize();
        let basis = Matrix3::from_columns(&[a, b, a.cross(&b)]);
        let size = 10_f64.powf(self.within(-3.0, 3.0));
        let values = Vector3::from_fn(|_, _| size * 10_f64.powf(-self.within(0.0, decades)));
        let w = basis * Matrix3::from_diagonal(&values) * basis.transpose();
        (w + w.transpose()) * 0.5
    }
    fn coefficient(&mut self, most: f64) -> Coefficient {
        let mean = self.within(0.0, most);
        let lean = if self.next() < 0.3 { 0.0 } else { self.within(0.0, mean) };
        Coefficient { mean, lean: self.direction() * lean }
    }
    fn friction(&mut self) -> Friction {
        match self.next() {
            x if x < 0.1 => Friction::None,
            x if x < 0.8 => Friction::Coulomb(self.coefficient(3.0)),
            _ => {
                let size = 10_f64.powf(self.within(-6.0, 2.0));
                Friction::Viscous(self.coefficient(size))
            }
        }
    }
    fn normal_response(&mut self) -> Response {
        let stiffness = 10_f64.powf(self.within(-3.0, 4.0));
        match self.next() {
            x if x < 0.5 => Response::Hard,
            x if x < 0.75 => {
                Response::Penalty { stiffness, damping: stiffness * self.within(0.0, 0.1), depth_at_start: self.within(0.0, 0.2) }
            }
            _ => Response::Regularised { stiffness, depth: 10_f64.powf(self.within(-4.0, 0.0)) },
        }
    }
}

/// Residual of a law's own solve, in the scale of what was added up for it.
fn own_residual(law: &Law, w: &Matrix3<f64>, unconstrained: &Vector3<f64>) -> (f64, Vector3<f64>) {
    law.check("law").unwrap();
    let lambda = LawSolve::new(law, w, STEP).solve(*unconstrained);
    let u = w * lambda + unconstrained;
    let length = unconstrained.norm().max(w.norm() * lambda.norm());
    let force = lambda.norm().max(f64::MIN_POSITIVE);
    (law.residual(u, lambda, STEP, length, force), lambda)
}

#[test]
fn a_contact_alone_obeys_its_law_to_rounding() {
    let mut numbers = Numbers(1);
    let mut worst = 0.0_f64;
    let (mut off, mut stuck, mut slid) = (0, 0, 0);
    for case in 0..40_000 {
        let w = numbers.response(8.0);
        let contact = Contact { normal: numbers.direction(), response: numbers.normal_response(), friction: numbers.friction() };
        let unconstrained = numbers.direction() * numbers.within(0.0, 2.0);
        let law = Law::Contact(contact);
        let (residual, lambda) = own_residual(&law, &w, &unconstrained);
        assert!(lambda.iter().all(|x| x.is_finite()), "case {case}");
        // Length is a sum of terms that may cancel and force a solution with condition 1e8: the error is a few roundings of either.
        assert!(residual < 1e-11, "case {case}: {residual:e} {contact:?} {w:?} {unconstrained:?}");
        worst = worst.max(residual);
        let normal = lambda.dot(&contact.normal);
        if let Friction::Coulomb(mu) = contact.friction {
            let t = lambda - contact.normal * normal;
            let u = w * lambda + unconstrained;
            let u_t = u - contact.normal * u.dot(&contact.normal);
            if normal <= 0.0 {
                off += 1;
            } else if u_t.norm() < 1e-12 * unconstrained.norm().max(w.norm() * lambda.norm()) {
                stuck += 1;
                assert!(t.norm() <= mu.at(&(-t.normalize())) * normal * (1.0 + 1e-9));
            } else {
                slid += 1;
                let bound = mu.at(&(-t.normalize())) * normal;
                assert!((t.norm() - bound).abs() <= 1e-12 * normal, "case {case}: {} {bound}", t.norm());
            }
        }
    }
    println!("worst {worst:e}; off {off}, stuck {stuck}, slid {slid}");
    assert!(off > 1000 && stuck > 1000 && slid > 1000, "every state is tried: {off} {stuck} {slid}");
}

/// All sliding solutions of a hard Coulomb contact, by a search over the directions of sliding d: λ = λ_N (n − μ(d) d) with u_N = 0, and
/// u_T must point along d.
fn sliding_solutions(n: &Vector3<f64>, mu: &Coefficient, w: &Matrix3<f64>, unconstrained: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let s = n.cross(&Vector3::new(0.3, 0.5, 0.8)).normalize();
    let t = n.cross(&s);
    let at = |angle: f64| {
        let d = s * angle.cos() + t * angle.sin();
        let way = n - d * mu.at(&d);
        let lambda = way * (-unconstrained.dot(n) / n.dot(&(w * way)));
        let u = w * lambda + unconstrained;
        // Across d, and along it.
        (u.dot(&n.cross(&d)), u.dot(&d), lambda)
    };
    let steps = 4000;
    let step = std::f64::consts::TAU / f64::from(steps);
    let mut found = Vec::new();
    for k in 0..steps {
        let (mut low, mut high) = (step * f64::from(k), step * f64::from(k + 1));
        if at(low).0.signum() == at(high).0.signum() {
            continue;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if at(low).0.signum() == at(middle).0.signum() { low = middle } else { high = middle }
        }
        let (across, along, lambda) = at(0.5 * (low + high));
        if lambda.dot(n) > 0.0 && along >= 0.0 && across.abs() < 1e-6 * unconstrained.norm() {
            found.push(lambda);
        }
    }
    found
}

#[test]
fn coulomb_slides_where_a_search_of_all_directions_finds_it() {
    let mut numbers = Numbers(2);
    let (mut slid, mut single) = (0, 0);
    for case in 0..1500 {
        let w = numbers.response(3.0);
        let (normal, mu) = (numbers.direction(), numbers.coefficient(3.0));
        let unconstrained = numbers.direction();
        if unconstrained.dot(&normal) >= 0.0 {
            continue;
        }
        let law = Law::Contact(Contact { normal, response: Response::Hard, friction: Friction::Coulomb(mu) });
        let (_, lambda) = own_residual(&law, &w, &unconstrained);
        let u = w * lambda + unconstrained;
        let found = sliding_solutions(&normal, &mu, &w, &unconstrained);
        if (u - normal * u.dot(&normal)).norm() < 1e-9 {
            // It sticks: the force that holds it is the one that makes u zero.
            let held = -w.try_inverse().unwrap() * unconstrained;
            assert!((lambda - held).norm() <= 1e-9 * held.norm(), "case {case}");
            continue;
        }
        slid += 1;
        single += usize::from(found.len() == 1);
        let nearest = found.iter().map(|f| (f - lambda).norm() / lambda.norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7, "case {case}: {nearest:e} of {} solutions", found.len());
    }
    println!("{slid} slide, {single} of them in one way only");
    assert!(slid > 200);
}

#[test]
fn a_contact_that_the_strand_cannot_move_along_one_axis_still_solves() {
    // A straight strand does not give along its tangent: W is singular there, exactly.
    let (t, n) = (Vector3::x(), Vector3::z());
    let w = Matrix3::from_diagonal(&Vector3::new(0.0, 2.0, 3.0));
    for (push, expected) in [(Vector3::new(0.0, 0.1, -1.0), None), (Vector3::new(0.4, 0.1, -1.0), Some(0.5))] {
        let law =
            Law::Contact(Contact { normal: n, response: Response::Hard, friction: Friction::Coulomb(Coefficient::uniform(0.5)) });
        let (residual, lambda) = own_residual(&law, &w, &push);
        assert!(residual < 1e-14, "{residual:e}");
        assert!((lambda.z - 1.0 / 3.0).abs() < 1e-14);
        // Drawn along the axis that does not give, all friction goes there but for what the slow slide across needs.
        if let Some(mu) = expected {
            let drawn = -lambda.dot(&t) / lambda.z;
            assert!(drawn > 0.99 * 0.4 && drawn <= mu, "{drawn}");
        }
    }
    let dead = LawSolve::new(
        &Law::Contact(Contact { normal: n, response: Response::Hard, friction: Friction::None }),
        &Matrix3::zeros(),
        STEP,
    )
    .solve(-n);
    assert_eq!(dead, Vector3::zeros(), "what nothing can move gets no force");
}

#[test]
fn penalties_give_the_papers_forces() {
    // The partner presses the point by 0.3 against W = 2 along n: closed forms of depth d = 0.3 − 2 F.
    let (n, w) = (Vector3::y(), Matrix3::identity() * 2.0);
    let force = |response: Response, unconstrained: f64| {
        let law = Law::Contact(Contact { normal: n, response, friction: Friction::None });
        own_residual(&law, &w, &(n * unconstrained)).1.y
    };
    let k = 5.0;
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
    near(force(Response::Penalty { stiffness: k, damping: 0.0, depth_at_start: 0.0 }, -0.3), 0.3 / (2.0 + 1.0 / k));
    // F = k d + c (d − d₀)/h.
    let (c, before) = (0.2, 0.01);
    let damped = force(Response::Penalty { stiffness: k, damping: c, depth_at_start: before }, -0.3);
    let d = 0.3 - 2.0 * damped;
    let asked = k * d + c * (d - before) / STEP;
    assert!((damped - asked).abs() < 1e-12 * damped, "{damped} {asked}");
    // Both branches of the regularised spring.
    for depth in [0.001, 0.5] {
        let f = force(Response::Regularised { stiffness: k, depth }, -0.3);
        let d = 0.3 - 2.0 * f;
        let expected = if d < depth { k * d * d / (2.0 * depth) } else { k * (d - 0.5 * depth) };
        assert!((f - expected).abs() < 1e-13 * f, "{f} {expected}");
        assert_eq!(depth == 0.5, d < depth, "each branch once");
    }
    assert_eq!(force(Response::Regularised { stiffness: k, depth: 0.1 }, 0.1), 0.0);
}

#[test]
fn going_over_a_hair_from_root_to_tip_meets_less_friction() {
    let tangent = Vector3::x();
    let mu = Coefficient::of_scales(0.1, 0.3, tangent);
    // The hair slides towards its root relative to the partner: the partner goes over it from root to tip.
    assert!((mu.at(&-tangent) - 0.1).abs() < 1e-15);
    assert!((mu.at(&tangent) - 0.3).abs() < 1e-15);
    assert!((mu.at(&Vector3::y()) - 0.2).abs() < 1e-15);
    // Two hairs side by side, the first sliding to its own root: along the first's scales; the second sees the first go to its own tip or root.
    let other = Coefficient::of_scales(0.2, 0.6, tangent);
    let both = Coefficient::of_two(mu, other);
    // The first goes towards −x over the second, whose tip is at +x: from tip to root over it, against its scales.
    assert!((both.at(&-tangent) - 0.5 * (0.1 + 0.6)).abs() < 1e-15);
    assert!((both.at(&tangent) - 0.5 * (0.3 + 0.2)).abs() < 1e-15);
    // In a solve: pressed with 1 N and drawn hard, friction is μ of its direction.
    for (pull, expected) in [(10.0, 0.3), (-10.0, 0.1)] {
        let law = Law::Contact(Contact { normal: Vector3::z(), response: Response::Hard, friction: Friction::Coulomb(mu) });
        let (_, lambda) = own_residual(&law, &Matrix3::identity(), &Vector3::new(pull, 0.0, -1.0));
        assert!((lambda.z - 1.0).abs() < 1e-14 && (lambda.x + expected * pull.signum()).abs() < 1e-14, "{lambda}");
    }
}

#[test]
fn constraints_hold_their_points() {
    let mut numbers = Numbers(3);
    for case in 0..3000 {
        let w = numbers.response(6.0);
        let d = numbers.direction();
        let axes = [ConstrainedAxes::All, ConstrainedAxes::Across(d), ConstrainedAxes::Along(d)][case % 3];
        let compliance = if case % 2 == 0 { 0.0 } else { numbers.within(0.0, 10.0) };
        let unconstrained = numbers.direction();
        let (residual, lambda) = own_residual(&Law::Bilateral(BilateralLaw { axes, compliance }), &w, &unconstrained);
        assert!(residual < 1e-12, "case {case}: {residual:e}");
        let along = lambda.dot(&d).abs();
        match axes {
            ConstrainedAxes::All => {}
            ConstrainedAxes::Across(_) => assert!(along <= 1e-12 * lambda.norm()),
            ConstrainedAxes::Along(_) => assert!((along - lambda.norm()).abs() <= 1e-12 * along),
        }
    }
}

#[test]
fn a_ring_holds_across_and_rubs_along() {
    let mut numbers = Numbers(4);
    let (mut held, mut slid) = (0, 0);
    for case in 0..20_000 {
        let w = numbers.response(6.0);
        let tangent = numbers.direction();
        let mean = numbers.within(0.0, 2.0);
        let friction = Coefficient { mean, lean: tangent * (mean * numbers.within(-1.0, 1.0)) };
        let unconstrained = numbers.direction();
        let (residual, lambda) = own_residual(&Law::Ring(Ring { tangent, friction }), &w, &unconstrained);
        assert!(residual < 1e-11, "case {case}: {residual:e}");
        let u_t = (w * lambda + unconstrained).dot(&tangent);
        let lambda_t = lambda.dot(&tangent);
        let across = (lambda - tangent * lambda_t).norm();
        if u_t.abs() < 1e-9 {
            held += 1;
        } else {
            slid += 1;
            assert!(u_t * lambda_t <= 0.0, "case {case}: friction goes against the sliding");
            let bound = friction.at(&(tangent * u_t.signum())) * across;
            assert!((lambda_t.abs() - bound).abs() <= 1e-9 * bound.max(1e-3 * across), "case {case}: {lambda_t} {bound}");
        }
    }
    assert!(held > 1000 && slid > 1000, "{held} {slid}");
}

#[test]
fn numbers_out_of_range_are_named() {
    let contact = Contact { normal: Vector3::z(), response: Response::Hard, friction: Friction::None };
    let says = |law: Law| law.check("constraints[2].law").unwrap_err().to_string();
    let bad = says(Law::Contact(Contact { normal: Vector3::new(0.0, 0.0, 1.1), ..contact }));
    assert!(bad.contains("constraints[2].law.normal") && bad.contains("1.1"), "{bad}");
    let bad = says(Law::Contact(Contact { response: Response::Regularised { stiffness: 1.0, depth: 0.0 }, ..contact }));
    assert!(bad.contains("constraints[2].law.response.depth is 0"), "{bad}");
    let mu = Coefficient { mean: 0.1, lean: Vector3::x() * 0.2 };
    let bad = says(Law::Contact(Contact { friction: Friction::Coulomb(mu), ..contact }));
    assert!(bad.contains("friction.lean is 0.2"), "{bad}");
    let bad = says(Law::Bilateral(BilateralLaw { axes: ConstrainedAxes::All, compliance: f64::NAN }));
    assert!(bad.contains("compliance is NaN"), "{bad}");
    let bad = says(Law::Ring(Ring { tangent: Vector3::zeros(), friction: Coefficient::uniform(0.1) }));
    assert!(bad.contains("tangent"), "{bad}");
}
