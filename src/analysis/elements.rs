//! How many elements a strand needs for a tolerance in metres.
//!
//! The error of N elements falls as 1/N² (`docs/theory/validation_physics.md`). It is measured, not bounded: the strand is settled under gravity on N
//! elements and on at least four times as many, which also hold every element that its natural shape was given with and a quarter of the
//! boundary layer L/√Γ at the clamp; the largest distance of the two curves at equal arclength is the error at rest. With a motion of the
//! root the strand is also simulated on N and 2N elements, and the distance of the paths counts. Elements that turn by more than a quarter
//! turn are not considered: a helix cannot bend its own axis.

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::frame::Frame;
use crate::rod::definition::StrandDef;
use crate::rod::turning::{LARGEST_TURN, largest_turn};
use crate::solver::Solver;
use crate::solver::definition::SolverOptions;
use crate::solver::id::StrandId;
use crate::step::equilibrium::EquilibriumOptions;
use crate::step::regrid::{borders, graded, means};

/// What is asked for.
///
/// ```
/// use superhelix::StrandDef;
/// use superhelix::nalgebra::Vector3;
/// use superhelix::settings::{Demand, suggest_elements};
///
/// let strand = StrandDef { natural: vec![[0.0, 60.0, 0.0]; 4], ..StrandDef::straight(0.2, 4) };
/// let demand = Demand { tolerance: 2e-3, max_elements: 40, gravity: Vector3::new(0.0, 0.0, -9.81), motion: None };
/// let suggestion = suggest_elements(&strand, &demand)?;
/// assert!(suggestion.met && suggestion.rest_error <= 2e-3);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Demand {
    /// The error allowed, m; above zero. At rest: of the point that is farthest off. In motion: root mean square over time and arclength.
    pub tolerance: f64,
    /// Elements at most, 1 to 1000.
    pub max_elements: usize,
    /// Gravity, m/s².
    pub gravity: Vector3<f64>,
    /// A motion of the root to be judged by; `None`: only at rest.
    pub motion: Option<RootMotion>,
}

/// Poses of the root at equal times; the strand starts at rest in the first, and a step is taken to each of the others.
#[derive(Debug, Clone)]
pub struct RootMotion {
    /// Two poses or more.
    pub frames: Vec<Frame>,
    /// Seconds from one to the next, at least [`SHORTEST_STEP`](crate::solver::SHORTEST_STEP).
    pub interval: f64,
}

/// What N elements come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Suggestion {
    /// N: the least that meets the tolerance, or the most allowed.
    pub elements: usize,
    /// Whether it meets the tolerance, and no element turns by more than a quarter turn.
    pub met: bool,
    /// Estimated error at rest of the point that is farthest off, m.
    pub rest_error: f64,
    /// Estimated root mean square error over the motion, m; `None` without one, or where the error at rest already was too large.
    pub motion_error: Option<f64>,
    /// The largest turn Ωℓ of an element in the natural shape or at rest, rad. Above π/2 the strand moves too stiffly.
    pub turn: f64,
}

impl Default for Demand {
    fn default() -> Self {
        Self { tolerance: 1e-3, max_elements: 100, gravity: Vector3::new(0.0, 0.0, -9.81), motion: None }
    }
}

impl Demand {
    fn check(&self) -> Result<()> {
        check_positive(|| "demand.tolerance".into(), self.tolerance)?;
        if !(1..=1000).contains(&self.max_elements) {
            return Err(Error::invalid("demand.max_elements", self.max_elements, "1 to 1000"));
        }
        for axis in 0..3 {
            check_finite(|| format!("demand.gravity[{axis}]"), self.gravity[axis])?;
        }
        if let Some(motion) = &self.motion {
            if motion.frames.len() < 2 {
                return Err(Error::invalid("demand.motion.frames (count)", motion.frames.len(), "2 or more"));
            }
            if !(motion.interval.is_finite() && motion.interval >= crate::solver::SHORTEST_STEP) {
                let expected = format!("{} s or more", crate::solver::SHORTEST_STEP);
                return Err(Error::invalid("demand.motion.interval", motion.interval, expected));
            }
        }
        Ok(())
    }
}

/// The reference has at least this many times the elements; its own error is then a sixteenth.
const FINER: usize = 4;
/// Elements of the first search for the rest shape, with its stability.
const FIRST: usize = 12;
/// Places at which curves are compared.
const SAMPLES: usize = 101;

/// The least number of elements for which a strand meets a demand. Its natural curvatures, given on any number of elements, stand for a
/// continuous shape; on N elements they are its means, as [`Solver::set_element_count`] makes them. Searches by doubling and halving, since
/// the error falls with N; costs some tens of milliseconds at rest, and twice a simulation for each N tried in motion.
///
/// # Errors
/// [`Error::InvalidArgument`] for a definition or a demand that cannot be used, or a strand that finds no rest.
pub fn suggest_elements(strand: &StrandDef, demand: &Demand) -> Result<Suggestion> {
    strand.check("strand")?;
    demand.check()?;
    let study = Study::new(strand, demand)?;
    let most = demand.max_elements;
    let mut below = 0;
    let mut here = study.fewest().min(most);
    let mut passed = study.judge(here)?;
    // Upwards by doubling, until it passes.
    while !passed.met {
        if here == most {
            return Ok(passed);
        }
        below = here;
        here = (2 * here).min(most);
        passed = study.judge(here)?;
    }
    // `below` fails, or was not tried since it turns too far.
    let mut low = below.max(study.fewest().min(most).saturating_sub(1));
    let mut high = here;
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        let there = study.judge(middle)?;
        if there.met {
            (high, passed) = (middle, there);
        } else {
            low = middle;
        }
    }
    Ok(passed)
}

/// A strand and the stable rest that all its versions are near to.
struct Study<'a> {
    strand: &'a StrandDef,
    demand: &'a Demand,
    /// The first rest: lengths, and strain from the natural shape.
    lengths: Vec<f64>,
    strain: Vec<[f64; 3]>,
    /// ∫ Ω ds of the natural shape, rad.
    turning: f64,
}

impl<'a> Study<'a> {
    fn new(strand: &'a StrandDef, demand: &'a Demand) -> Result<Self> {
        let turning = strand.element_lengths.iter().zip(&strand.natural).map(|(l, row)| l * Vector3::from(*row).norm()).sum();
        let mut study = Self { strand, demand, lengths: Vec::new(), strain: Vec::new(), turning };
        let count = FIRST.max(study.fewest().min(demand.max_elements));
        let (solver, id) = study.solver(count)?;
        let mut solver = solver;
        let found = solver.settle(&[id], &EquilibriumOptions::default())?[0];
        if !found.converged {
            let value = format!("one whose search for a rest ends at residual {:e}", found.residual);
            return Err(Error::invalid("strand", value, "one that finds a stable rest"));
        }
        study.lengths = solver.element_lengths(id)?.to_vec();
        let rows = solver.curvatures(id)?.iter().zip(solver.natural_curvatures(id)?);
        study.strain = rows.map(|(now, natural)| std::array::from_fn(|axis| now[axis] - natural[axis])).collect();
        Ok(study)
    }

    /// The fewest elements that can turn by no more than a quarter turn.
    fn fewest(&self) -> usize {
        ((self.turning / LARGEST_TURN * (1.0 - 1e-9)).ceil() as usize).max(1)
    }

    /// A solver with the strand on `count` elements, in the shape of the first rest (natural before there is one).
    fn solver(&self, count: usize) -> Result<(Solver, StrandId)> {
        let strand = self.strand;
        let element_lengths = graded(&strand.element_lengths, count);
        let here = borders(&element_lengths);
        let natural = means(&borders(&strand.element_lengths), &strand.natural, &here);
        let initial = if self.strain.is_empty() {
            natural.clone()
        } else {
            let strain = means(&borders(&self.lengths), &self.strain, &here);
            let free = |axis: usize| if strand.freedoms.contains(axis) { 1.0 } else { 0.0 };
            let rows = natural.iter().zip(&strain);
            rows.map(|(n, s)| std::array::from_fn(|axis| n[axis] + free(axis) * s[axis])).collect()
        };
        let root = self.demand.motion.as_ref().map_or(strand.root, |motion| motion.frames[0]);
        let def = StrandDef {
            element_lengths,
            natural,
            initial: Some(initial),
            initial_rates: None,
            root,
            root_velocity: Vector3::zeros(),
            root_angular_velocity: Vector3::zeros(),
            ..strand.clone()
        };
        let mut solver = Solver::new(SolverOptions { gravity: self.demand.gravity, ..SolverOptions::default() })?;
        let id = solver.add_strands(&[def])?[0];
        Ok((solver, id))
    }

    /// The strand at rest near the first rest.
    fn rest(&self, count: usize) -> Result<(Solver, StrandId)> {
        let (mut solver, id) = self.solver(count)?;
        // Its stability is that of the first: it is in the same valley, and settling goes downhill.
        let options = EquilibriumOptions { check_stability: false, tolerance: 1e-9, ..EquilibriumOptions::default() };
        let found = solver.settle(&[id], &options)?[0];
        if !found.converged {
            let value = format!("one whose search for a rest on {count} elements ends at residual {:e}", found.residual);
            return Err(Error::invalid("strand", value, "one that finds a rest"));
        }
        Ok((solver, id))
    }

    /// Elements of the reference for `count`.
    fn finer(&self, count: usize) -> usize {
        let strand = self.strand;
        let softest = strand.material.stiffness()[1..].iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let gamma = strand.material.linear_density() * self.demand.gravity.norm() * strand.length().powi(3) / softest;
        // A quarter of the boundary layer, but not beyond what the most elements allowed would be compared with.
        let layer = (4.0 * gamma.sqrt()).min((FINER * self.demand.max_elements) as f64) as usize;
        let given = strand.element_lengths.len();
        (FINER * count).max(layer).div_ceil(given) * given
    }

    fn judge(&self, count: usize) -> Result<Suggestion> {
        let (coarse, id) = self.rest(count)?;
        let finer = self.finer(count);
        let (fine, fine_id) = self.rest(finer)?;
        let (largest, _) = apart(&coarse, id, &fine, fine_id)?;
        // Both errors fall as 1/N²: what is left is theirs at infinity.
        let rest_error = largest / (1.0 - (count as f64 / finer as f64).powi(2));
        let lengths = coarse.element_lengths(id)?;
        let turn = largest_turn(lengths, coarse.natural_curvatures(id)?).max(largest_turn(lengths, coarse.curvatures(id)?));
        let mut met = rest_error <= self.demand.tolerance && turn <= LARGEST_TURN * (1.0 + 1e-9);
        let mut motion_error = None;
        if let (Some(motion), true) = (&self.demand.motion, met) {
            let error = self.in_motion(motion, (coarse, id), count)?;
            met = error <= self.demand.tolerance;
            motion_error = Some(error);
        }
        Ok(Suggestion { elements: count, met, rest_error, motion_error, turn })
    }

    /// Root mean square distance over the motion between the strand on `count` elements and on twice as many, made an error by 1/N².
    fn in_motion(&self, motion: &RootMotion, (mut coarse, id): (Solver, StrandId), count: usize) -> Result<f64> {
        let (mut fine, fine_id) = self.rest(2 * count)?;
        let mut sum = 0.0;
        for frame in &motion.frames[1..] {
            for (solver, id) in [(&mut coarse, id), (&mut fine, fine_id)] {
                solver.set_root_frames(&[id], &[*frame], motion.interval)?;
                solver.step(motion.interval, 1)?;
            }
            let (_, mean) = apart(&coarse, id, &fine, fine_id)?;
            sum += mean * mean;
        }
        Ok((sum / (motion.frames.len() - 1) as f64).sqrt() * 4.0 / 3.0)
    }
}

/// Largest and root mean square distance of two strands at equal arclength, m.
fn apart(a: &Solver, a_id: StrandId, b: &Solver, b_id: StrandId) -> Result<(f64, f64)> {
    let mut points = Vec::with_capacity(SAMPLES);
    a.sample_strands(&[a_id], SAMPLES, |_, _, sample| points.push(sample.position))?;
    let (mut largest, mut sum) = (0.0_f64, 0.0);
    b.sample_strands(&[b_id], SAMPLES, |_, point, sample| {
        let off = (points[point] - sample.position).norm_squared();
        largest = largest.max(off);
        sum += off;
    })?;
    Ok((largest.sqrt(), (sum / SAMPLES as f64).sqrt()))
}
