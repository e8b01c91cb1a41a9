//! Follows a static equilibrium of one strand while its load changes: a stronger weight, a turning clamp.
//!
//! An equilibrium is a zero of the gradient g(q, λ) = K (q − qⁿ) − f(q, λ) of the static potential, λ the load's parameter. Zeros form
//! curves. One is followed by predictor and corrector in its own arclength (Keller 1977): a step along the tangent, then Newton's method
//! on g = 0 and the step's length, with the exact dense Hessian and no descent, so that unstable states are followed as well as stable
//! ones and the curve may turn back in λ. Where the smallest eigenvalue of the Hessian against the elastic stiffness changes its sign the
//! parameter is critical: at a fold the curve turns back, at a bifurcation it meets another one, which [`switch`] goes over to.
//!
//! Lengths along the curve: (ds)² = L ∫ |dκ|² ds (rad², of the order of the strand's turning) + (dλ/range)².
//!
//! Files:
//!
//! - `system.rs`: The equations that `analysis::branch` follows: gradient, Hessian and load of a strand's static potential in scaled unknowns.

pub(super) mod system;

use nalgebra::{UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};
use crate::rod::definition::StrandDef;
use system::{Corrected, State, System};

/// What a strand bears: gravity, and how its root is turned.
///
/// ```
/// use superhelix::experiments::{BranchOptions, Load, follow};
/// use superhelix::nalgebra::{UnitQuaternion, Vector3};
/// use superhelix::{Frame, StrandDef};
///
/// // A strand that leaves sideways, under a weight that grows to that of the earth.
/// let strand = StrandDef { root: Frame::default(), ..StrandDef::straight(0.03, 4) };
/// let load = |weight: f64| Load { gravity: Vector3::new(0.0, 0.0, -9.81 * weight), rotation: UnitQuaternion::identity() };
/// let branch = follow(&strand, &load, 0.0, 1.0, &BranchOptions::default())?;
/// let last = branch.points.last().expect("a point");
/// assert!(last.tip.z < 0.0 && last.smallest_eigenvalue > 0.0);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Gravity, m/s².
    pub gravity: Vector3<f64>,
    /// The root's rotation; its position has no bearing on the shape.
    pub rotation: UnitQuaternion<f64>,
}

/// How to follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchOptions {
    /// In equilibrium when no moment is out of balance by more than this, relative as
    /// [`EquilibriumOptions::tolerance`](crate::step::equilibrium::EquilibriumOptions::tolerance) says; above zero.
    pub tolerance: f64,
    /// Longest step along the curve, above zero: 0.1 is a tenth of the parameter's range or a change of shape of about 0.1 rad.
    pub longest_step: f64,
    /// Points at most, 2 to 1 000 000.
    pub max_points: usize,
    /// Go on where the state is unstable. False: end at the first critical parameter beyond which it is.
    pub follow_unstable: bool,
}

impl Default for BranchOptions {
    fn default() -> Self {
        Self { tolerance: 1e-10, longest_step: 0.1, max_points: 10_000, follow_unstable: true }
    }
}

impl BranchOptions {
    fn check(&self) -> Result<()> {
        for (name, value) in [("options.tolerance", self.tolerance), ("options.longest_step", self.longest_step)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(name, value, "a finite number above zero"));
            }
        }
        if !(2..=1_000_000).contains(&self.max_points) {
            return Err(Error::invalid("options.max_points", self.max_points, "2 to 1000000"));
        }
        Ok(())
    }
}

/// One equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPoint {
    /// λ.
    pub parameter: f64,
    /// Curvatures, a row an element, rad/m.
    pub curvatures: Vec<[f64; 3]>,
    /// Smallest eigenvalue of the static Hessian against the elastic stiffness: stable if above zero (a mode that a symmetry leaves
    /// neutral has 0 within 1e-9).
    pub smallest_eigenvalue: f64,
    /// Tip relative to the root, m, world axes.
    pub tip: Vector3<f64>,
}

/// What happens at a critical parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CriticalKind {
    /// The curve turns back: no such equilibrium beyond, and the strand snaps.
    Fold,
    /// The curve meets another one.
    Bifurcation,
}

/// Where the smallest eigenvalue changes its sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Critical {
    /// λ there.
    pub parameter: f64,
    /// The equilibrium there.
    pub curvatures: Vec<[f64; 3]>,
    /// The eigenvector whose eigenvalue vanishes, a row an element; its length in the curve's metric is 1.
    pub mode: Vec<[f64; 3]>,
    /// What is left of the eigenvalue: within 1e-9 of zero, unless Newton's method failed near it.
    pub eigenvalue: f64,
    /// What happens.
    pub kind: CriticalKind,
    /// Whether the strand is stable before and unstable after it (in the direction of following), rather than the other way.
    pub loses_stability: bool,
}

/// Why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BranchEnd {
    /// The parameter reached the range's far end.
    Reached,
    /// The curve turned and left the range where it had come in.
    TurnedBack,
    /// It became unstable, and [`BranchOptions::follow_unstable`] is false.
    Unstable,
    /// As many points as allowed.
    MaxPoints,
    /// Newton's method failed down to the shortest step.
    Lost,
}

/// A followed branch.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// From the start on; the last lies at the range's end if it was reached.
    pub points: Vec<BranchPoint>,
    /// In the order in which they were passed.
    pub criticals: Vec<Critical>,
    /// Why it ends.
    pub end: BranchEnd,
}

/// The first step, of the longest.
const FIRST_STEP: f64 = 0.1;
/// The shortest step, of the longest.
const SHORTEST_STEP: f64 = 1e-7;
/// Newton's iterations after which the next step is longer, and those after which it is shorter.
const EASY: u32 = 3;
const HARD: u32 = 6;
/// An eigenvalue within this of zero has no sign: a mode that a symmetry leaves neutral.
const NEUTRAL: f64 = 1e-9;
/// Trials to find a critical parameter.
const TRIALS: u32 = 60;
/// Below this share of the mode in the load's change the branch does not fold: the mode does not feel the load.
const FOLD_SHARE: f64 = 1e-4;
/// How far from the critical state the other branch is looked for, of the longest step; tried down to a hundredth of it.
const SWITCH: f64 = 0.5;

/// Follows the equilibrium of a strand near its initial shape (natural, if it has none) from λ = `from` to λ = `to`; `load` gives the load
/// for each parameter, smooth, and defined a thousandth of the range beyond both ends too.
///
/// The start is found by Newton's method, or, if that fails, by the search of
/// [`Solver::settle`](crate::solver::Solver::settle) without leaving saddles. Costs the cube of the number of elements a point.
///
/// # Errors
/// [`Error::InvalidArgument`] for a definition, options, parameters or a load that cannot be used, or a start that is in no equilibrium.
pub fn follow(strand: &StrandDef, load: &dyn Fn(f64) -> Load, from: f64, to: f64, options: &BranchOptions) -> Result<Branch> {
    options.check()?;
    check_range(from, to)?;
    let mut system = System::new(strand, load, (to - from).abs(), options.tolerance)?;
    let start = strand.initial.clone().unwrap_or_else(|| strand.natural.clone());
    let start = system.start(start, from)?;
    // Along the tangent that goes towards `to`.
    let mut tangent = vec![0.0; system.size() + 1];
    tangent[system.size()] = (to - from).signum();
    let Some(tangent) = system.tangent(&start, &tangent) else {
        return Err(Error::invalid("from", from, "a parameter at which the strand is not at a critical state"));
    };
    Ok(walk(&mut system, start, tangent, (from, to), options))
}

/// Follows the other branch that meets at a bifurcation, on the side of its mode (`side` above zero) or the other one, within the
/// range of parameters `near` to `far`: it ends as [`BranchEnd::Reached`] at `far`, as [`BranchEnd::TurnedBack`] at `near`.
///
/// # Errors
/// [`Error::InvalidArgument`] as [`follow`], for a fold in place of a bifurcation, or where no other branch was found.
pub fn switch(
    strand: &StrandDef,
    load: &dyn Fn(f64) -> Load,
    critical: &Critical,
    side: f64,
    (near, far): (f64, f64),
    options: &BranchOptions,
) -> Result<Branch> {
    options.check()?;
    check_range(near, far)?;
    check_finite(|| "side".into(), side)?;
    if critical.kind == CriticalKind::Fold {
        return Err(Error::invalid("critical.kind", "a fold", "a bifurcation: at a fold there is no other branch"));
    }
    let mut system = System::new(strand, load, (far - near).abs(), options.tolerance)?;
    system.check_shape("critical.curvatures", &critical.curvatures)?;
    system.check_shape("critical.mode", &critical.mode)?;
    let corner = State { curvatures: critical.curvatures.clone(), parameter: critical.parameter };
    let mut away = system.scaled(&critical.mode);
    let size = norm(&away);
    if !(size.is_finite() && size > 0.0) {
        return Err(Error::invalid("critical.mode", size, "a mode whose length is finite and above zero"));
    }
    let turned = if side < 0.0 { -1.0 / size } else { 1.0 / size };
    away.iter_mut().for_each(|x| *x *= turned);
    away.push(0.0);
    let mut distance = SWITCH * options.longest_step;
    for _ in 0..8 {
        if let Some(Corrected { state, .. }) = system.step(&corner, &away, distance) {
            // The step's length is along the mode: a state that has it is on the other branch.
            let way = system.difference(&state, &corner);
            if let Some(tangent) = system.tangent(&state, &way) {
                let inside = (state.parameter - near) * (state.parameter - far) <= 0.0;
                if inside {
                    return Ok(walk(&mut system, state, tangent, (near, far), options));
                }
            }
        }
        distance *= 0.5;
    }
    Err(Error::invalid("critical", critical.parameter, "a bifurcation from which another branch leads into the range"))
}

fn check_range(from: f64, to: f64) -> Result<()> {
    check_finite(|| "from".into(), from)?;
    check_finite(|| "to".into(), to)?;
    if from == to {
        return Err(Error::invalid("to", to, format!("a parameter other than from, {from}")));
    }
    Ok(())
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// From a state along its tangent until the range ends.
fn walk(system: &mut System, start: State, tangent: Vec<f64>, (near, far): (f64, f64), options: &BranchOptions) -> Branch {
    let direction = (far - near).signum();
    let mut branch = Branch { points: Vec::new(), criticals: Vec::new(), end: BranchEnd::MaxPoints };
    let (mut here, mut tangent) = (start, tangent);
    let mut eigenvalue = system.softest(&here).0;
    branch.points.push(point(system, &here, eigenvalue));
    let shortest = SHORTEST_STEP * options.longest_step;
    let mut length = FIRST_STEP * options.longest_step;
    while branch.points.len() < options.max_points {
        let Some(Corrected { state, iterations }) = system.step(&here, &tangent, length) else {
            length *= 0.5;
            if length < shortest {
                branch.end = BranchEnd::Lost;
                return branch;
            }
            continue;
        };
        let mut next = state;
        let mut taken = length;
        // Beyond an end of the range: a step that ends there.
        let beyond = |parameter: f64| {
            if (parameter - far) * direction >= 0.0 {
                Some((far, BranchEnd::Reached))
            } else if (parameter - near) * direction < 0.0 {
                Some((near, BranchEnd::TurnedBack))
            } else {
                None
            }
        };
        let mut end = None;
        if let Some((bound, why)) = beyond(next.parameter) {
            let share = ((bound - here.parameter) / (next.parameter - here.parameter)).clamp(0.0, 1.0);
            let Some(last) = system.at_parameter(&here, &next, share, bound) else {
                length *= 0.5;
                if length < shortest {
                    branch.end = BranchEnd::Lost;
                    return branch;
                }
                continue;
            };
            let way = system.difference(&last, &here);
            taken = way.iter().zip(&tangent).map(|(a, b)| a * b).sum();
            (next, end) = (last, Some(why));
        }
        let (next_eigenvalue, _) = system.softest(&next);
        if (eigenvalue < -NEUTRAL) != (next_eigenvalue < -NEUTRAL) {
            let critical = locate(system, &here, &tangent, taken, eigenvalue, next_eigenvalue);
            let unstable = critical.loses_stability;
            branch.criticals.push(critical);
            if unstable && !options.follow_unstable {
                branch.end = BranchEnd::Unstable;
                return branch;
            }
        }
        branch.points.push(point(system, &next, next_eigenvalue));
        if let Some(end) = end {
            branch.end = end;
            return branch;
        }
        let Some(turned) = system.tangent(&next, &tangent) else {
            branch.end = BranchEnd::Lost;
            return branch;
        };
        (here, tangent, eigenvalue) = (next, turned, next_eigenvalue);
        if iterations <= EASY {
            length = (length * 1.5).min(options.longest_step);
        } else if iterations >= HARD {
            length = (length * 0.5).max(shortest);
        }
    }
    branch
}

fn point(system: &mut System, state: &State, smallest_eigenvalue: f64) -> BranchPoint {
    let tip = system.tip(state);
    BranchPoint { parameter: state.parameter, curvatures: state.curvatures.clone(), smallest_eigenvalue, tip }
}

/// The critical state between `here` and the one `length` along the tangent, by regula falsi (Illinois) on the eigenvalue; by
/// bisection on its sign where a neutral mode hides its size.
fn locate(system: &mut System, here: &State, tangent: &[f64], length: f64, first: f64, last: f64) -> Critical {
    let unstable = |eigenvalue: f64| eigenvalue < -NEUTRAL;
    let (mut a, mut b, mut f_a, mut f_b) = (0.0, length, first, last);
    let mut best = (here.clone(), first, None);
    for _ in 0..TRIALS {
        let hidden = f_a.abs() <= NEUTRAL || f_b.abs() <= NEUTRAL || (f_a > 0.0) == (f_b > 0.0);
        let at = if hidden { 0.5 * (a + b) } else { (a * f_b - b * f_a) / (f_b - f_a) };
        let Some(Corrected { state, .. }) = system.step(here, tangent, at) else { break };
        let (eigenvalue, mode) = system.softest(&state);
        best = (state, eigenvalue, Some(mode));
        if eigenvalue.abs() < 0.1 * NEUTRAL && !hidden || (b - a).abs() < 1e-12 * length {
            break;
        }
        if unstable(eigenvalue) == unstable(last) {
            if !hidden && unstable(f_b) == unstable(eigenvalue) {
                f_a *= 0.5;
            }
            (b, f_b) = (at, eigenvalue);
        } else {
            if !hidden && unstable(f_a) == unstable(eigenvalue) {
                f_b *= 0.5;
            }
            (a, f_a) = (at, eigenvalue);
        }
    }
    let (state, eigenvalue, mode) = best;
    let mode = mode.unwrap_or_else(|| system.softest(&state).1);
    let scaled = system.scaled(&mode);
    let size = norm(&scaled);
    let mode: Vec<[f64; 3]> = mode.iter().map(|row| row.map(|x| x / size)).collect();
    let kind = if system.share_of_load(&state, &scaled) > FOLD_SHARE { CriticalKind::Fold } else { CriticalKind::Bifurcation };
    Critical { parameter: state.parameter, curvatures: state.curvatures, mode, eigenvalue, kind, loses_stability: unstable(last) }
}
