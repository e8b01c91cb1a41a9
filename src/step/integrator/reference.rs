//! The reference integrator: Radau IIA of order 5 in the curvatures, with step doubling.
//!
//! Every step is taken once whole and once in two halves. The difference estimates the error of the halves, which are kept, and
//! sets the size of the next step.
//!
//! The error is measured at the quadrature points relative to the strand's length: the error of positions, plus the displacement
//! that the error of velocities would cause in the strand's own time. A step of h seconds may err by `reference_tolerance`·h, and
//! by rounding.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::dynamics::{Dynamics, Rows};
use super::radau::{self, Motion, Step};
use crate::math::frame::Frame;
use crate::math::quadrature::{self, Rules};
use crate::math::vector::Vec3;
use crate::rod::strand::StrandModel;
use crate::rod::velocity::{self, RootMotion};
use crate::step::newton::iterate;
use crate::step::options::StepOptions;
use crate::step::pack::members::One;
use crate::step::pack::single::Single;
use crate::step::root_path::RootPath;
use crate::step::scratch::Bench;
use crate::step::state::{RuleScratch, StrandState};
use crate::step::{Setting, StrandOutcome, Surroundings, keep};

/// Attempts within one call before the strand is given up: implicit Euler takes the rest of the call, and the report says so.
const MAX_ATTEMPTS: u32 = 100_000;
/// Rejections in a row before the same: each at least halves the step.
const MAX_REJECTIONS: u32 = 60;
/// Rounding error of a point's position, relative to the length: no step needs to err by less.
const ROUNDING: f64 = 2e-15;
/// Newton's error as a fraction of the permitted error.
const NEWTON_FRACTION: f64 = 1e-2;
/// Safety factor on the next step's size.
const SAFETY: f64 = 0.8;
/// Bounds on the change of size from step to step.
const SHRINK: f64 = 0.2;
const GROW: f64 = 4.0;
/// The longest time, s, over which an error of velocity counts.
const LONGEST_TIME: f64 = 1.0;
/// Times to try, from the strand's own downwards: 4¹² spans the modes of any hair.
const TIMES_TRIED: u32 = 12;
/// An attempt's elements may turn by this factor more than at its start, plus as many radians.
const FINE_MARGIN: f64 = 1.3;
/// A root's velocity jumped if it differs by this fraction of the velocities involved.
const JUMP: f64 = 1e-8;

/// Takes one strand through `h` seconds: see [`crate::step::take`].
pub fn take(setting: &Setting, one: &mut One, h: f64, bench: &mut Bench<f64>, scratch: &mut RuleScratch) -> StrandOutcome {
    let Setting { surroundings, options, rules } = *setting;
    let One { model, root_at, .. } = *one;
    let state = &mut *one.state;
    let mut run = Run {
        model,
        surroundings,
        options,
        rules,
        outcome: StrandOutcome { converged: true, ..Default::default() },
        attempts: 0,
    };
    let mut motion = start(model, state);
    let mut observed = Observed {
        velocities: state.velocities.clone(),
        rule: state.rule,
        linear: state.root_velocity.into(),
        angular: state.root_angular_velocity.into(),
    };
    let Some(pieces) = RootPath::pieces(root_at, h) else {
        // No tolerance can follow a root whose path is nowhere smooth.
        let outcome = implicit_euler(setting, one, h, bench, scratch);
        return StrandOutcome { converged: false, ..outcome };
    };
    for path in &pieces {
        run.apply_jump(path, &mut motion, &observed);
        let end = run.along(path, &mut motion);
        if run.outcome.quarantined {
            return run.outcome;
        }
        let rule = rules.next_for_angle(observed.rule, model.largest_angle(&motion.curvatures));
        let dynamics = Dynamics { model, rule: rules.rule(rule), surroundings, path };
        observed = run.observe(&dynamics, rule, &motion, end);
        if end < path.end {
            // The best remaining choice: keep the strand as far as it came, and take a robust step over the rest.
            publish(state, &motion, &observed, root_at(end));
            let rest = |seconds: f64| root_at(end + seconds);
            let last = implicit_euler(
                setting,
                &mut One { model, state, root_at: &rest, target: None, touches: None },
                h - end,
                bench,
                scratch,
            );
            run.outcome.iterations += last.iterations;
            run.outcome.quarantined |= last.quarantined;
            return run.outcome;
        }
    }
    publish(state, &motion, &observed, root_at(h));
    if let Some(path) = pieces.last() {
        let dynamics = Dynamics { model, rule: rules.rule(state.rule), surroundings, path };
        let (kinematics, forces) = dynamics.point_forces(path.end, &motion.curvatures, &motion.rates, &motion.accelerations);
        (state.wrench_force, state.wrench_torque) = iterate::wrench(&kinematics, &forces);
    }
    run.outcome
}

/// A robust step; a state that is not finite is not kept.
fn implicit_euler(setting: &Setting, one: &mut One, h: f64, bench: &mut Bench<f64>, rule: &mut RuleScratch) -> StrandOutcome {
    let outcome = f64::attempt(one, setting, h, bench);
    if !outcome.quarantined {
        keep(one, 0, setting, h, &bench.workspace, rule);
    }
    outcome
}

/// What is known of the strand at the end of a piece.
struct Observed {
    velocities: Vec<Vec3<f64>>,
    rule: usize,
    linear: Vec3<f64>,
    angular: Vec3<f64>,
}

/// The strand at the start of the call; frozen curvatures are natural and do not move.
fn start(model: &StrandModel, state: &StrandState) -> Motion {
    let mut motion = Motion {
        curvatures: state.curvatures.clone(),
        rates: state.rates.clone(),
        accelerations: vec![[0.0; 3]; model.element_count()],
    };
    for element in 0..model.element_count() {
        for axis in (0..3).filter(|axis| !model.freedoms.contains(*axis)) {
            motion.curvatures[element][axis] = model.natural[element][axis];
            motion.rates[element][axis] = 0.0;
        }
    }
    motion
}

/// Writes a motion into the strand's state.
fn publish(state: &mut StrandState, motion: &Motion, observed: &Observed, root: Frame) {
    state.curvatures.clone_from(&motion.curvatures);
    state.rates.clone_from(&motion.rates);
    state.velocities.clone_from(&observed.velocities);
    state.rule = observed.rule;
    state.root = root;
    state.root_velocity = observed.linear.into();
    state.root_angular_velocity = observed.angular.into();
}

/// One call.
struct Run<'a> {
    model: &'a StrandModel,
    surroundings: &'a Surroundings,
    options: &'a StepOptions,
    rules: &'a Rules,
    outcome: StrandOutcome,
    attempts: u32,
}

impl Run<'_> {
    /// Advances along a smooth piece as far as the tolerance allows; returns how far that is.
    fn along(&mut self, path: &RootPath, motion: &mut Motion) -> f64 {
        let time_scale = self.time_scale();
        let mut t = path.start;
        let mut wanted = path.end - path.start;
        let mut rejections = 0;
        while t < path.end {
            let left = path.end - t;
            // Two even steps rather than a long and a tiny one.
            let last = wanted >= 0.99 * left;
            let h = if last { left } else { wanted.min(0.5 * left) };
            self.attempts += 1;
            let rule = self.fine_rule(&motion.curvatures);
            let dynamics = Dynamics { model: self.model, rule: self.rules.rule(rule), surroundings: self.surroundings, path };
            let allowed = self.options.reference_tolerance * h + ROUNDING;
            match self.doubled(&dynamics, motion, t, h, allowed, time_scale) {
                Some((next, error)) => {
                    let ratio = error / allowed;
                    let factor = (SAFETY * ratio.powf(-1.0 / f64::from(radau::ORDER))).clamp(SHRINK, GROW);
                    if ratio <= 1.0 {
                        *motion = next;
                        t = if last { path.end } else { t + h };
                        // Right after a rejection a larger step is likely to fail again.
                        wanted = h * if rejections > 0 { factor.min(1.0) } else { factor };
                        rejections = 0;
                        continue;
                    }
                    wanted = h * factor.min(0.5);
                }
                None => wanted = 0.25 * h,
            }
            rejections += 1;
            if rejections > MAX_REJECTIONS || self.attempts > MAX_ATTEMPTS || t + wanted == t {
                self.outcome.converged = false;
                return t;
            }
        }
        path.end
    }

    /// One step in two halves, and its error by the whole step, relative to the length.
    fn doubled(
        &mut self,
        dynamics: &Dynamics,
        from: &Motion,
        t: f64,
        h: f64,
        allowed: f64,
        time_scale: f64,
    ) -> Option<(Motion, f64)> {
        let derivatives = dynamics.derivatives(t, &from.curvatures, &from.rates, &from.accelerations);
        let newton_tolerance = NEWTON_FRACTION * allowed;
        let mut solve = |step: &Step, from: &Motion, t: f64| {
            let solved = step.solve(dynamics, from, t, newton_tolerance, time_scale, self.options.max_iterations);
            self.outcome.iterations += solved.iterations;
            self.outcome.residual = solved.residual;
            solved.motion
        };
        let whole = solve(&Step::new(&derivatives, h), from, t)?;
        let half = Step::new(&derivatives, 0.5 * h);
        let middle = solve(&half, from, t)?;
        let end = solve(&half, &middle, t + 0.5 * h)?;
        let distance = self.distance(dynamics, &derivatives.inertia, t + h, &whole, &end, time_scale);
        // The halves are 2⁵ times closer to the truth than the whole.
        let error = distance / (2.0_f64.powi(radau::ORDER) - 1.0);
        error.is_finite().then_some((end, error))
    }

    /// The distance of two motions relative to the length: that of their positions, and the displacement that the difference of
    /// their rates would cause.
    ///
    /// A mode of frequency Ω with a velocity error v goes off by v/Ω, one that friction holds by less. An implicit Euler step of
    /// τ gives this without a modal analysis: it turns v into vτ/(1 + Ω²τ²), whose largest value over τ is v/2Ω. The times tried
    /// go down from the strand's own by factors of 4.
    fn distance(&self, dynamics: &Dynamics, inertia: &Mat<f64>, t: f64, one: &Motion, other: &Motion, time_scale: f64) -> f64 {
        let (kinematics, _) = dynamics.kinematics(t, &one.curvatures);
        let (second, _) = dynamics.kinematics(t, &other.curvatures);
        let mut apart: Vec<f64> =
            kinematics.points.iter().zip(&second.points).map(|(a, b)| (a.position - b.position).norm_squared().sqrt()).collect();
        let size = dynamics.size();
        let lengths = &self.model.lengths;
        let off = Mat::from_fn(size, 1, |i, _| {
            let (element, axis) = dynamics.freedom(i);
            (one.rates[element][axis] - other.rates[element][axis]) * lengths[element]
        });
        let momenta = inertia * off;
        let mut carried = vec![0.0_f64; apart.len()];
        let mut time = time_scale;
        for _ in 0..TIMES_TRIED {
            let mut matrix = inertia.clone();
            for i in 0..size {
                let (element, axis) = dynamics.freedom(i);
                matrix[(i, i)] += time * (self.model.dissipation[axis] + time * self.model.stiffness[axis]) / lengths[element];
            }
            let Ok(factor) = matrix.llt(Side::Lower) else { return f64::NAN };
            let response = factor.solve(&momenta);
            let mut change = vec![[0.0; 3]; lengths.len()];
            for i in 0..size {
                let (element, axis) = dynamics.freedom(i);
                change[element][axis] = time * response[(i, 0)] / lengths[element];
            }
            velocity::for_each_point(&kinematics, &change, &RootMotion::still(), |p, moved, _| {
                carried[p] = carried[p].max(moved.norm_squared().sqrt());
            });
            time *= 0.25;
        }
        let mut worst = 0.0_f64;
        for (apart, carried) in apart.iter_mut().zip(&carried) {
            *apart += carried;
            // max() must not hide a NaN.
            worst = if *apart <= worst { worst } else { *apart };
        }
        worst / self.model.length()
    }

    /// The strand's own time: how long a wrong velocity persists before stiffness or weight reverses it.
    fn time_scale(&self) -> f64 {
        let length = self.model.length();
        let stiffness = self.model.stiffness[1].min(self.model.stiffness[2]);
        let gravity = self.surroundings.gravity.norm_squared().sqrt();
        let squared_frequency = 12.4 * stiffness / (self.model.linear_density * length.powi(4)) + 1.5 * gravity / length;
        (1.0 / squared_frequency.sqrt()).min(LONGEST_TIME)
    }

    /// A rule whose error stays below any tolerance, whatever the quadrature option.
    fn fine_rule(&self, curvatures: &Rows) -> usize {
        let angle = self.model.largest_angle(curvatures);
        self.rules.for_angle_within(FINE_MARGIN * angle + FINE_MARGIN - 1.0, quadrature::TIGHTEST)
    }

    /// Where the root's velocity jumps, the clamp strikes the strand: the rates change so that every generalised momentum stays.
    fn apply_jump(&self, path: &RootPath, motion: &mut Motion, observed: &Observed) {
        let dynamics =
            Dynamics { model: self.model, rule: self.rules.rule(observed.rule), surroundings: self.surroundings, path };
        let (kinematics, root) = dynamics.kinematics(path.start, &motion.curvatures);
        let length = self.model.length();
        let speed = |v: Vec3<f64>| v.norm_squared().sqrt();
        let jump = speed(root.velocity - observed.linear) + length * speed(root.angular_velocity - observed.angular);
        let fastest = observed.velocities.iter().map(|v| speed(*v)).fold(0.0, f64::max);
        let present = speed(root.velocity) + length * speed(root.angular_velocity) + speed(observed.linear);
        if jump <= JUMP * (present + fastest + length) {
            return;
        }
        let mut change = observed.velocities.clone();
        let unmoved = RootMotion { acceleration: Vec3::zero(), angular_acceleration: Vec3::zero(), ..root };
        velocity::for_each_point(&kinematics, &motion.rates, &unmoved, |p, v, _| change[p] -= v);
        let momenta = dynamics.point_momenta(change.into_iter());
        let rhs = dynamics.gather(&kinematics, &momenta);
        let mut matrix = dynamics.inertia(&kinematics);
        let size = dynamics.size();
        let trace: f64 = (0..size).map(|i| matrix[(i, i)]).sum();
        let stiffness = |i: usize| {
            let (element, axis) = dynamics.freedom(i);
            self.model.stiffness[axis] / self.model.lengths[element]
        };
        let stiffness_trace: f64 = (0..size).map(stiffness).sum();
        // A mode without inertia has no momentum: a trace of stiffness keeps its rate.
        for i in 0..size {
            matrix[(i, i)] += 1e-14 * trace * stiffness(i) / stiffness_trace;
        }
        let rhs = Mat::from_fn(size, 1, |i, _| rhs[i]);
        let found = match matrix.llt(Side::Lower) {
            Ok(factor) => factor.solve(&rhs),
            Err(_) => matrix.partial_piv_lu().solve(&rhs),
        };
        for i in 0..size {
            let (element, axis) = dynamics.freedom(i);
            motion.rates[element][axis] += found[(i, 0)] / self.model.lengths[element];
        }
        motion.accelerations.fill([0.0; 3]);
    }

    /// The observable state of the strand at the end of a piece.
    fn observe(&self, dynamics: &Dynamics, rule: usize, motion: &Motion, t: f64) -> Observed {
        let (kinematics, root) = dynamics.kinematics(t, &motion.curvatures);
        let mut velocities = vec![Vec3::zero(); kinematics.points.len()];
        velocity::for_each_point(&kinematics, &motion.rates, &root, |p, v, _| velocities[p] = v);
        Observed { velocities, rule, linear: root.velocity, angular: root.angular_velocity }
    }
}
