//! Friction coefficients from a recorded motion, as Bertails et al. 2006 choose them (section 4.2): the internal friction γ from the
//! span of a curl that is shaken up and down (their figure 6), the air drag ν from a pendulum that comes to rest. The paper compares
//! by eye; here the squared difference between the recorded and the simulated curve is minimised, and what the recording leaves open
//! is reported.
//!
//! The recording is simulated with the solver itself, all else about the strand being known. The search is over the logarithms of
//! the coefficients: a coarse grid over their ranges, then least squares from the best point of it. With residuals r (n of
//! them), their derivatives J by the p logarithms (and one more unknown if an offset is fitted), and s² = |r|²/(n − p): the relative
//! standard error of a coefficient is s √((JᵀJ)⁻¹)ₖₖ.

use nalgebra::DVector;

use super::least_squares::{self, Minimum};
use super::recording::{Recording, RootMotion};
use super::replay::{Curve, Replay};
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::rod::definition::StrandDef;
use crate::rod::material::Material;
use crate::solver::definition::SolverOptions;

/// A coefficient that can be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum Coefficient {
    /// γ, kg·m³/s (Bertails et al. 2006, eq. 5d): [`Material::internal_friction`].
    InternalFriction = 1,
    /// Kelvin–Voigt time μ, s: [`Material::viscosity`].
    Viscosity = 2,
    /// ν, kg/(m·s) (Bertails et al. 2006, eq. 5a): [`Material::air_drag`].
    AirDrag = 4,
}

impl Coefficient {
    /// All there are.
    pub const ALL: [Self; 3] = [Self::InternalFriction, Self::Viscosity, Self::AirDrag];

    /// Its name: the field of [`Material`].
    pub fn name(self) -> &'static str {
        match self {
            Self::InternalFriction => "internal_friction",
            Self::Viscosity => "viscosity",
            Self::AirDrag => "air_drag",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::InternalFriction => "kg m3/s",
            Self::Viscosity => "s",
            Self::AirDrag => "kg/(m s)",
        }
    }

    /// Four decades about what hair has: γ 1e-12 to 1e-8, μ 1e-4 to 1, ν 1e-7 to 1e-3.
    pub fn usual_range(self) -> [f64; 2] {
        match self {
            Self::InternalFriction => [1e-12, 1e-8],
            Self::Viscosity => [1e-4, 1.0],
            Self::AirDrag => [1e-7, 1e-3],
        }
    }

    /// The field of a material.
    pub fn of(self, material: &mut Material) -> &mut f64 {
        match self {
            Self::InternalFriction => &mut material.internal_friction,
            Self::Viscosity => &mut material.viscosity,
            Self::AirDrag => &mut material.air_drag,
        }
    }
}

/// A coefficient to be fitted, and where to look for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sought {
    /// Which.
    pub coefficient: Coefficient,
    /// Smallest and largest value, in the coefficient's unit: above zero, the second above the first.
    pub range: [f64; 2],
    /// A value within the range to begin from, beside the grid; `None`: the grid alone.
    pub guess: Option<f64>,
}

impl Sought {
    /// In its usual range, without a guess.
    pub fn usual(coefficient: Coefficient) -> Self {
        Self { coefficient, range: coefficient.usual_range(), guess: None }
    }
}

/// The strand's state where the simulation starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Start {
    /// At rest in its stable equilibrium under gravity (wind is not felt there), found from its initial shape; it moves rigidly with
    /// its root.
    #[default]
    Settled = 1,
    /// With the initial curvatures and rates of its definition. (The root's pose and velocity are those of its motion in either case.)
    AsDefined = 2,
}

/// How to fit.
///
/// ```
/// use superhelix::experiments::{Coefficient, FrictionFitOptions};
///
/// let options = FrictionFitOptions { time_step: 1.0 / 240.0, ..FrictionFitOptions::of(&[Coefficient::InternalFriction]) };
/// options.check("options")?;
/// assert_eq!(options.sought.len(), 1);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FrictionFitOptions {
    /// Gravity, wind, how a step is taken, and who runs the simulations (several at once, each a strand).
    pub solver: SolverOptions,
    /// What to fit: one to three, each once.
    pub sought: Vec<Sought>,
    /// The strand's state at the simulation's start.
    pub start: Start,
    /// The simulation starts this long before the first sample, s; zero or above. For an oscillation that has been going on.
    pub lead_in: f64,
    /// Samples in the first so many seconds of the recording are simulated but not compared; zero or above.
    pub discard: f64,
    /// The longest step, s; above zero. The steps between two samples are equal.
    pub time_step: f64,
    /// Points of the grid over each range, ends included: 2 to 64, or 0 for none (then every coefficient needs a guess).
    pub grid_points: u32,
    /// Whether a constant is added to the simulated values, fitted as well: for a marker that is not quite on the tip.
    pub fit_offset: bool,
    /// Iterations of the least squares at most, 1 to 1000.
    pub max_iterations: u32,
}

impl FrictionFitOptions {
    /// For one coefficient or several in their usual ranges, with a grid of two points a decade; everything else as is usual.
    pub fn of(coefficients: &[Coefficient]) -> Self {
        Self {
            solver: SolverOptions::default(),
            sought: coefficients.iter().copied().map(Sought::usual).collect(),
            start: Start::default(),
            lead_in: 0.0,
            discard: 0.0,
            time_step: 1.0 / 480.0,
            grid_points: 9,
            fit_offset: false,
            max_iterations: 50,
        }
    }

    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        self.solver.check(&format!("{argument}.solver"))?;
        if self.sought.is_empty() {
            return Err(Error::invalid(format!("{argument}.sought"), "empty", "one to three coefficients"));
        }
        for (index, sought) in self.sought.iter().enumerate() {
            let name = sought.coefficient.name();
            if self.sought[..index].iter().any(|earlier| earlier.coefficient == sought.coefficient) {
                return Err(Error::invalid(format!("{argument}.sought[{index}]"), name, "each coefficient once"));
            }
            let [low, high] = sought.range;
            check_positive(|| format!("{argument}.{name}_range[0]"), low)?;
            if !(high.is_finite() && high > low) {
                return Err(Error::invalid(format!("{argument}.{name}_range[1]"), high, format!("a finite number above {low}")));
            }
            match sought.guess {
                Some(guess) if !(guess >= low && guess <= high) => {
                    return Err(Error::invalid(format!("{argument}.{name}_guess"), guess, format!("{low} to {high}, the range")));
                }
                None if self.grid_points == 0 => {
                    return Err(Error::invalid(format!("{argument}.{name}_guess"), "none", "a guess, since there is no grid"));
                }
                _ => {}
            }
        }
        check_not_negative(|| format!("{argument}.lead_in"), self.lead_in)?;
        check_not_negative(|| format!("{argument}.discard"), self.discard)?;
        check_positive(|| format!("{argument}.time_step"), self.time_step)?;
        if self.grid_points == 1 || self.grid_points > 64 {
            return Err(Error::invalid(format!("{argument}.grid_points"), self.grid_points, "2 to 64, or 0 for no grid"));
        }
        if !(1..=1000).contains(&self.max_iterations) {
            return Err(Error::invalid(format!("{argument}.max_iterations"), self.max_iterations, "1 to 1000"));
        }
        Ok(())
    }
}

/// Whether the recording says what a coefficient is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Verdict {
    /// It does.
    Determined = 1,
    /// It does not: the curve changes too little with the coefficient (its standard error is above half of it, or no value of the
    /// range differs from the best by three standard deviations), or two of the coefficients cannot be told apart.
    Undetermined = 2,
    /// The best value is the lower end of the range, and the curve would still improve below.
    AtLowerEnd = 3,
    /// The best value is the upper end of the range, and the curve would still improve above.
    AtUpperEnd = 4,
}

/// A standard error above this share of the coefficient leaves it undetermined.
pub const LARGEST_RELATIVE_ERROR: f64 = 0.5;
/// Standard deviations by which some value of the range must differ from the best.
const DISTINCT: f64 = 3.0;
/// Standard deviations by which the curve excludes a value.
const EXCLUDED: f64 = 2.0;

/// What was found out about one coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedCoefficient {
    /// Which.
    pub coefficient: Coefficient,
    /// Whether the recording says what it is.
    pub verdict: Verdict,
    /// The best value, in its unit.
    pub value: f64,
    /// Its standard error, in its unit, from the size of the residual and its sensitivity; infinite where the curve does not depend
    /// on it. It takes the residuals for independent: see [`FrictionFit::residual_correlation`].
    pub standard_error: f64,
    /// By what share of itself the value would change (to first order) if the steps were half as long. NaN where
    /// `standard_error` is infinite.
    pub step_shift: f64,
    /// The nearest value of the grid below the best, and the nearest above, that the curve excludes by two standard deviations;
    /// 0 and infinity where there is none. Other coefficients are held at the best point of the grid.
    pub excluded: [f64; 2],
}

/// The outcome of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionFit {
    /// The coefficients, in the order in which they were sought.
    pub coefficients: Vec<FittedCoefficient>,
    /// Whether the search ended at a minimum. If not, the values are the best that were found.
    pub converged: bool,
    /// Root mean square of the compared residuals, in the unit of the values (m, or rad).
    pub rms_residual: f64,
    /// The recording's noise if the model is right: the residual's standard deviation, corrected for what was fitted.
    pub noise: f64,
    /// Correlation of one residual with the next, −1 to 1. Noise of a camera has about 0; a number near 1 says that the model misses
    /// something, and then the standard errors are too small.
    pub residual_correlation: f64,
    /// The constant that was added to the simulated values; 0 unless fitted.
    pub offset: f64,
    /// Curves that were simulated.
    pub simulations: u32,
    /// Steps of the best curve whose Newton iteration did not reach its tolerance.
    pub unconverged: u32,
    /// Index of the first sample that was compared.
    pub first_compared: usize,
    /// The best curve at the compared times, offset included.
    pub curve: Vec<f64>,
}

/// Fits friction coefficients of a strand to a recorded curve. The strand's own values of the coefficients sought make no difference.
///
/// Takes as long as some 20 simulations of the recording for one coefficient, and the grid makes it some 120 for two. Any thread.
///
/// # Errors
/// [`Error::InvalidArgument`] for a strand, recording, motion or options that cannot be used, fewer samples than can tell (two more
/// than unknowns), a strand that finds no rest to start from, or a range in which no simulation stayed finite.
pub fn fit_friction(
    strand: &StrandDef,
    recording: &Recording,
    motion: &RootMotion,
    options: &FrictionFitOptions,
) -> Result<FrictionFit> {
    options.check("options")?;
    let mut search = Search::new(strand, recording, motion, options)?;
    let unknowns = options.sought.len() + usize::from(options.fit_offset);
    if search.recorded.len() < unknowns + 2 {
        let expected = format!("{} or more beyond options.discard ({} s)", unknowns + 2, options.discard);
        return Err(Error::invalid("recording.times (count to compare)", search.recorded.len(), expected));
    }
    let grid = search.grid()?;
    let best = grid.iter().filter(|(_, residuals)| residuals.is_some()).min_by(|a, b| sum(a).total_cmp(&sum(b)));
    let Some((start, _)) = best else { return Err(nothing_finite(options)) };
    let bounds: Vec<_> = options.sought.iter().map(|sought| sought.range.map(f64::ln)).collect();
    let minimum = least_squares::minimise(start, &bounds, options.max_iterations, &mut |sets| search.residuals(sets))?;
    let Some(minimum) = minimum else { return Err(nothing_finite(options)) };
    search.report(&minimum, start, &grid, unknowns)
}

/// A point of the grid and what is left there.
type Point = (Vec<f64>, Option<DVector<f64>>);

/// The sum of squares at a point; infinite where there are no residuals.
fn sum((_, residuals): &Point) -> f64 {
    residuals.as_ref().map_or(f64::INFINITY, DVector::norm_squared)
}

fn nothing_finite(options: &FrictionFitOptions) -> Error {
    let ranges: Vec<_> =
        options.sought.iter().map(|sought| format!("{} {:?}", sought.coefficient.name(), sought.range)).collect();
    Error::invalid("options.sought", ranges.join(", "), "a range or guess with which simulations stay finite")
}

struct Search<'a> {
    replay: Replay<'a>,
    material: Material,
    options: &'a FrictionFitOptions,
    recorded: &'a [f64],
    simulations: u32,
}

impl<'a> Search<'a> {
    fn new(
        strand: &StrandDef,
        recording: &'a Recording,
        motion: &'a RootMotion,
        options: &'a FrictionFitOptions,
    ) -> Result<Self> {
        let replay = Replay::new(strand, recording, motion, options)?;
        let recorded = &recording.values[replay.first..];
        Ok(Self { replay, material: strand.material, options, recorded, simulations: 0 })
    }

    /// The strand's material with these logarithms of the coefficients.
    fn material(&self, logarithms: &[f64]) -> Material {
        let mut material = self.material;
        for (sought, logarithm) in self.options.sought.iter().zip(logarithms) {
            *sought.coefficient.of(&mut material) = logarithm.exp();
        }
        material
    }

    fn curves(&mut self, sets: &[Vec<f64>], time_step: f64) -> Result<Vec<Option<Curve>>> {
        let materials: Vec<_> = sets.iter().map(|set| self.material(set)).collect();
        self.simulations += sets.len() as u32;
        self.replay.curves(&materials, time_step)
    }

    /// Simulated minus recorded values, without their mean if an offset is fitted.
    fn residual(&self, curve: &Curve) -> DVector<f64> {
        let mut residual = DVector::from_fn(self.recorded.len(), |i, _| curve.values[i] - self.recorded[i]);
        if self.options.fit_offset {
            residual.add_scalar_mut(-residual.mean());
        }
        residual
    }

    fn residuals(&mut self, sets: &[Vec<f64>]) -> Result<Vec<Option<DVector<f64>>>> {
        let curves = self.curves(sets, self.options.time_step)?;
        Ok(curves.iter().map(|curve| curve.as_ref().map(|curve| self.residual(curve))).collect())
    }

    /// The grid over all ranges, and the guess.
    fn grid(&mut self) -> Result<Vec<Point>> {
        let mut sets = vec![Vec::new()];
        for sought in &self.options.sought {
            let [low, high] = sought.range.map(f64::ln);
            let last = self.options.grid_points.saturating_sub(1);
            let line = (0..self.options.grid_points).map(|k| low + (high - low) * (f64::from(k) / f64::from(last)));
            let points: Vec<f64> = line.collect();
            sets = sets.iter().flat_map(|set| points.iter().map(|point| [&set[..], &[*point]].concat())).collect();
        }
        if self.options.sought.iter().any(|sought| sought.guess.is_some()) {
            // A coefficient without a guess stands in the middle of its range.
            let middle = |[low, high]: [f64; 2]| 0.5 * (low.ln() + high.ln());
            sets.push(self.options.sought.iter().map(|sought| sought.guess.map_or(middle(sought.range), f64::ln)).collect());
        }
        let mut points = Vec::with_capacity(sets.len());
        // Not all at once: curves of a fine grid over three coefficients would fill the memory.
        for batch in sets.chunks(64) {
            points.extend(batch.iter().cloned().zip(self.residuals(batch)?));
        }
        Ok(points)
    }

    fn report(&mut self, minimum: &Minimum, start: &[f64], grid: &[Point], unknowns: usize) -> Result<FrictionFit> {
        let Minimum { parameters, residuals, .. } = minimum;
        let count = residuals.len();
        let square = residuals.norm_squared();
        let variance = square / (count - unknowns) as f64;
        let covariance = minimum.covariance();
        let mut finer = self.curves(std::slice::from_ref(parameters), 0.5 * self.options.time_step)?;
        let shift = match &finer.swap_remove(0) {
            Some(finer) => -&covariance * (minimum.jacobian.transpose() * (self.residual(finer) - residuals)),
            None => DVector::from_element(parameters.len(), f64::NAN),
        };
        let best = self.curves(std::slice::from_ref(parameters), self.options.time_step)?.swap_remove(0);
        let Some(mut best) = best else { return Err(nothing_finite(self.options)) };
        let offset = if self.options.fit_offset {
            self.recorded.iter().zip(&best.values).map(|(recorded, value)| recorded - value).sum::<f64>() / count as f64
        } else {
            0.0
        };
        best.values.iter_mut().for_each(|value| *value += offset);
        let slope = minimum.jacobian.transpose() * residuals;
        let fitted = |(k, sought): (usize, &Sought)| {
            let line = || grid.iter().filter(|(at, _)| (0..at.len()).all(|other| other == k || at[other] == start[other]));
            let relative_error = (variance * covariance[(k, k)]).sqrt();
            let [low, high] = sought.range.map(f64::ln);
            let farthest = line().filter(|point| point.1.is_some()).map(sum).fold(square, f64::max);
            let flat = self.options.grid_points > 0 && farthest - square < DISTINCT * DISTINCT * variance;
            let verdict = if flat || relative_error.is_nan() || relative_error == f64::INFINITY {
                Verdict::Undetermined
            } else if parameters[k] <= low && slope[k] > 0.0 {
                Verdict::AtLowerEnd
            } else if parameters[k] >= high && slope[k] < 0.0 {
                Verdict::AtUpperEnd
            } else if relative_error > LARGEST_RELATIVE_ERROR {
                Verdict::Undetermined
            } else {
                Verdict::Determined
            };
            let excluded = |at: &&Point| at.1.is_some() && sum(at) - square > EXCLUDED * EXCLUDED * variance;
            let below =
                line().filter(excluded).map(|(at, _)| at[k]).filter(|at| *at < parameters[k]).fold(f64::NEG_INFINITY, f64::max);
            let above =
                line().filter(excluded).map(|(at, _)| at[k]).filter(|at| *at > parameters[k]).fold(f64::INFINITY, f64::min);
            FittedCoefficient {
                coefficient: sought.coefficient,
                verdict,
                value: parameters[k].exp(),
                standard_error: parameters[k].exp() * relative_error,
                step_shift: if relative_error.is_finite() { shift[k] } else { f64::NAN },
                excluded: [below.exp(), above.exp()],
            }
        };
        Ok(FrictionFit {
            coefficients: self.options.sought.iter().enumerate().map(fitted).collect(),
            converged: minimum.converged,
            rms_residual: (square / count as f64).sqrt(),
            noise: variance.sqrt(),
            residual_correlation: correlation(residuals),
            offset,
            simulations: self.simulations,
            unconverged: best.unconverged,
            first_compared: self.replay.first,
            curve: best.values,
        })
    }
}

/// Correlation of each number with the next one; 0 if all are zero.
fn correlation(residuals: &DVector<f64>) -> f64 {
    let square = residuals.norm_squared();
    let products: f64 = residuals.as_slice().windows(2).map(|pair| pair[0] * pair[1]).sum();
    if square > 0.0 { products / square } else { 0.0 }
}
