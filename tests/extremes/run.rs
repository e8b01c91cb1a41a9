//! Running one case: stretches of violence and stretches of quiet, and the checks after every call.

use std::time::Instant;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, Integrator, Solver, SolverOptions, StrandDef, StrandId};

use crate::checks::{Whole, honesty, whole};
use crate::draw::{Case, Draw, Stratum};

/// The result of a case.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    pub steps: u64,
    pub seconds: f64,
    pub unconverged: u64,
    pub subdivided: u64,
    pub quarantined: u64,
    /// The papers' step: a number that is not finite, or an element turned beyond all sense.
    pub blown_up: bool,
    /// A long run that ended because an element had wound itself up beyond what the quadrature sees.
    pub wound: bool,
    pub iterations: f64,
    /// Stretches without work done on the strand, and those in which its energy grew by more than a millionth.
    pub quiet: u64,
    pub grew: u64,
    /// The largest energy in a quiet stretch by that at its start.
    pub growth: f64,
    /// The same for stretches in which a step did not converge.
    pub grew_unconverged: u64,
    pub growth_unconverged: f64,
    pub whole: Whole,
    /// Comparisons of a converged step with a converged one of 300 iterations at 1e-10 rad, and the largest distance, in L.
    pub probes: u64,
    pub dishonesty: f64,
    /// The slowest call, s, and all calls.
    pub slowest: f64,
    pub time: f64,
    /// The solver's state at the end.
    pub hash: u64,
}

/// 100 g, m/s².
const MAX_ACCELERATION: f64 = 981.0;

/// An element that turns by this much, rad, has blown up: by Ωℓ = 100 rad it is curled, and by a quarter of an hour's spinning at most as
/// much as it is held back.
const BLOWN_UP: f64 = 1e4;
/// No quadrature rule of the engine sees through an element that turns by more than this, rad (the largest has 128 points). Natural curls
/// end at 100; a limp strand of few elements that is shaken at 100 g or whirled at 50 Hz may wind itself up to any angle.
const WOUND: f64 = 250.0;
/// The two-step method sees a root that has stopped still moving for two calls more.
const MEMORY: u32 = 2;

/// The largest angle that an element of a strand turns by, rad.
fn largest_angle(solver: &Solver, id: StrandId) -> f64 {
    let lengths = solver.element_lengths(id).unwrap();
    let curvatures = solver.curvatures(id).unwrap();
    curvatures.iter().zip(lengths).map(|(row, length)| Vector3::from(*row).norm() * length).fold(0.0, f64::max)
}

/// How the root moves and what blows in one stretch.
enum Stretch {
    /// Root at rest, no wind, unchanged gravity.
    Quiet,
    /// To and fro along a line.
    Shake { way: Vector3<f64>, angular_frequency: f64 },
    /// About an axis through the root, rad/s.
    Spin(Vector3<f64>),
    /// Elsewhere at every call, turned, with the root at rest or moving as before.
    Teleports,
    /// Gravity turned round, or changed, at every other call.
    Gravity,
    /// A new wind.
    Wind,
}

/// The reference is not jerked: a root that is, within a step and 100 g, has it resolve what rings then until its 10⁵ attempts a call are
/// used up, which takes minutes (`docs/theory/extremes.md`).
fn stretch(draw: &mut Draw, integrator: Integrator) -> Stretch {
    let drawn = draw.below(10);
    match drawn {
        4..=6 if integrator == Integrator::Reference => Stretch::Gravity,
        0..=3 => Stretch::Quiet,
        4 | 5 => {
            let angular_frequency = std::f64::consts::TAU * draw.over(0.1, 50.0);
            let amplitude = (draw.over(0.1, MAX_ACCELERATION) / angular_frequency.powi(2)).min(10.0);
            Stretch::Shake { way: draw.direction() * amplitude, angular_frequency }
        }
        6 => Stretch::Spin(draw.direction() * (std::f64::consts::TAU * draw.over(0.1, 50.0))),
        7 => Stretch::Teleports,
        8 => Stretch::Gravity,
        _ => Stretch::Wind,
    }
}

/// The energy error of Newton's tolerance: half of what turning every element by that much, in one
/// step, would store and carry.
fn slack(case: &Case) -> f64 {
    let material = &case.def.material;
    let stiffest = material.stiffness().iter().fold(0.0_f64, |a, b| a.max(*b));
    let springs: f64 = case.def.element_lengths.iter().map(|length| stiffest / length).sum();
    let mass = material.linear_density() * case.def.length();
    let shortest = case.h / f64::from(1_u32 << case.max_subdivisions);
    0.5 * case.tolerance.powi(2) * (springs + mass * (case.def.length() / shortest).powi(2))
}

/// The energy above that of the strand hanging straight down from its root, J: never below zero.
fn energy(solver: &Solver, id: StrandId, def: &StrandDef) -> f64 {
    let energies = solver.energies(id).unwrap();
    let gravity = solver.options().gravity;
    let (mass, root) = (def.material.linear_density() * def.length(), solver.root_frame(id).unwrap().origin);
    energies.kinetic + energies.elastic + energies.gravity + mass * (gravity.dot(&root) + 0.5 * gravity.norm() * def.length())
}

/// Runs a case to its end; stops at the first state that was rolled back.
pub fn run(case: &Case, draw: &mut Draw) -> Outcome {
    let mut outcome = Outcome { growth: 1.0, growth_unconverged: 1.0, ..Outcome::default() };
    let mut options = SolverOptions { gravity: draw.direction() * draw.or_zero(0.1, 50.0), ..SolverOptions::default() };
    options.step.integrator = case.integrator;
    options.step.tolerance = case.tolerance;
    options.step.max_iterations = case.max_iterations;
    options.step.max_subdivisions = case.max_subdivisions;
    options.step.error_tolerance = case.error_tolerance;
    options.step.reference_tolerance = draw.over(1e-6, 1e-2);
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&case.def)).unwrap()[0];
    let (stretches, calls) = match (case.stratum, case.integrator) {
        (_, Integrator::Reference) => (3, 3),
        (Stratum::Wide, _) if case.def.element_lengths.len() > 40 => (3, 5),
        (Stratum::Wide, _) => (6, 8),
        (Stratum::Long, _) => (u32::MAX, 60),
    };
    for _ in 0..stretches {
        let stretch = stretch(draw, case.integrator);
        let substeps = if draw.chance(0.2) { 1 + draw.below(4) } else { 1 };
        let calls = (draw.between(0.5, 1.5) * f64::from(calls)) as u32;
        let dt = case.h * f64::from(substeps);
        let home = solver.root_frame(id).unwrap();
        match stretch {
            Stretch::Quiet => solver.set_wind(Vector3::zeros()).unwrap(),
            Stretch::Wind => solver.set_wind(draw.direction() * draw.between(0.0, 100.0)).unwrap(),
            _ => {}
        }
        let quiet = matches!(stretch, Stretch::Quiet);
        let mut before = if case.integrator == Integrator::SecondOrder { 0.0 } else { energy(&solver, id, &case.def) };
        let mut most = 0.0_f64;
        let unconverged_before = outcome.unconverged;
        for call in 1..=calls {
            let time = dt * f64::from(call);
            match stretch {
                Stretch::Quiet | Stretch::Wind => {}
                Stretch::Shake { way, angular_frequency } => {
                    let origin = home.origin + way * (angular_frequency * time).sin();
                    solver.set_root_frames(&[id], &[Frame { origin, ..home }], dt).unwrap();
                }
                Stretch::Spin(rate) => {
                    let rotation = UnitQuaternion::from_scaled_axis(rate * dt) * solver.root_frame(id).unwrap().rotation;
                    solver.set_root_frames(&[id], &[Frame { rotation, ..home }], dt).unwrap();
                }
                Stretch::Teleports => {
                    let frame = Frame { origin: draw.direction() * draw.over(1e-3, 10.0), rotation: draw.rotation() };
                    solver.teleport_roots(&[id], &[frame]).unwrap();
                }
                Stretch::Gravity if call % 2 == 1 => {
                    let gravity =
                        if draw.chance(0.5) { -solver.options().gravity } else { draw.direction() * draw.over(0.1, 50.0) };
                    solver.set_gravity(gravity).unwrap();
                }
                Stretch::Gravity => {}
            }
            let started = Instant::now();
            let report = solver.step(dt, substeps).unwrap();
            let took = started.elapsed().as_secs_f64();
            outcome.time += took;
            outcome.slowest = outcome.slowest.max(took);
            outcome.steps += u64::from(substeps);
            outcome.seconds += dt;
            outcome.unconverged += u64::from(report.unconverged);
            outcome.subdivided += u64::from(report.subdivided);
            outcome.quarantined += u64::from(report.quarantined);
            outcome.iterations += report.mean_iterations * f64::from(substeps);
            let now = energy(&solver, id, &case.def);
            let turned = largest_angle(&solver, id);
            if case.integrator == Integrator::LinearlyImplicit {
                outcome.blown_up = report.quarantined > 0 || !now.is_finite() || turned > BLOWN_UP;
            } else {
                assert!(now.is_finite() || report.quarantined > 0, "an energy is not finite");
            }
            if report.quarantined > 0 || outcome.blown_up {
                outcome.hash = solver.state_hash();
                return outcome;
            }
            if case.integrator == Integrator::SecondOrder && call <= MEMORY {
                before = before.max(now);
            } else {
                most = most.max(now);
            }
            // In long runs the costlier checks are made now and then.
            if case.stratum == Stratum::Wide || call % 16 == 0 {
                outcome.whole.worsen(&whole(&solver, id));
            }
            if case.stratum == Stratum::Long && turned > WOUND {
                outcome.wound = true;
                outcome.hash = solver.state_hash();
                return outcome;
            }
            let probed = draw.chance(if case.stratum == Stratum::Wide { 0.01 } else { 0.002 });
            if probed
                && matches!(case.integrator, Integrator::ImplicitEuler | Integrator::SecondOrder)
                && let Some(distance) = honesty(&solver, id, case)
            {
                outcome.probes += 1;
                outcome.dishonesty = outcome.dishonesty.max(distance);
            }
            if case.stratum == Stratum::Long && outcome.seconds >= case.seconds {
                break;
            }
        }
        if quiet {
            let allowed = before + slack(case);
            let (grew, growth) = (u64::from(most > allowed * (1.0 + 1e-6)), most / allowed);
            outcome.quiet += 1;
            if outcome.unconverged == unconverged_before {
                outcome.grew += grew;
                outcome.growth = outcome.growth.max(growth);
            } else {
                outcome.grew_unconverged += grew;
                outcome.growth_unconverged = outcome.growth_unconverged.max(growth);
            }
        }
        if case.stratum == Stratum::Long && outcome.seconds >= case.seconds {
            break;
        }
    }
    outcome.hash = solver.state_hash();
    outcome
}
