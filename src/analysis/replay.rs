//! A recording taken again by the solver: the same root motion, the same times, for several materials at once.

use nalgebra::Vector3;

use super::friction_fit::{FrictionFitOptions, Start};
use super::recording::{Recording, RootMotion, RootWay};
use crate::error::{Error, Result};
use crate::rod::definition::StrandDef;
use crate::rod::material::Material;
use crate::solver::report::StrandStatus;
use crate::solver::{SHORTEST_STEP, Solver};
use crate::step::equilibrium::EquilibriumOptions;

/// More steps than this in one simulation are taken for a mistake.
const MAX_STEPS: f64 = 1e8;

/// A simulated curve.
pub(super) struct Curve {
    /// Values at the compared times.
    pub values: Vec<f64>,
    /// Steps whose Newton iteration did not reach its tolerance.
    pub unconverged: u32,
}

/// A recording made ready to be simulated.
pub(super) struct Replay<'a> {
    solver: Solver,
    strand: StrandDef,
    way: RootWay<'a>,
    measure: Box<dyn Fn(Vector3<f64>) -> f64>,
    start: f64,
    times: &'a [f64],
    /// The first time that is compared.
    pub first: usize,
    tip: f64,
}

impl<'a> Replay<'a> {
    /// Checks everything but the coefficients, and finds the shape that the strand starts in.
    pub fn new(
        strand: &StrandDef,
        recording: &'a Recording,
        motion: &'a RootMotion,
        options: &FrictionFitOptions,
    ) -> Result<Self> {
        strand.check("strand")?;
        recording.check("recording")?;
        let gravity = options.solver.gravity;
        let mut solver = Solver::new(options.solver.clone())?;
        let down = gravity.try_normalize(0.0);
        let way = motion.way(strand.root, down)?;
        let measure = Box::new(recording.observable.measure(down)?);
        let times = &recording.times[..];
        let (begin, end) = match times {
            [begin, .., end] => (*begin, *end),
            _ => return Err(Error::invalid("recording.times (count)", times.len(), "more samples")),
        };
        let first = times.partition_point(|time| *time < begin + options.discard);
        let start = begin - options.lead_in;
        let steps = (end - start) / options.time_step;
        if steps.is_nan() || steps > MAX_STEPS {
            let expected = format!("a step of which {MAX_STEPS} make up the recording ({} s with lead_in) at most", end - start);
            return Err(Error::invalid("options.time_step", options.time_step, expected));
        }
        for (index, pair) in times.windows(2).enumerate() {
            if pair[1] - pair[0] < SHORTEST_STEP {
                let expected = format!("{SHORTEST_STEP} s or more after the one before");
                return Err(Error::invalid(format!("recording.times[{}]", index + 1), pair[1], expected));
            }
        }
        let mut strand = StrandDef { root: way.at(start), ..strand.clone() };
        if options.start == Start::Settled {
            strand.initial_rates = None;
            let held = StrandDef { root_velocity: Vector3::zeros(), root_angular_velocity: Vector3::zeros(), ..strand.clone() };
            let ids = solver.add_strands(&[held])?;
            let rest = solver.settle(&ids, &EquilibriumOptions::default())?[0];
            if !rest.converged {
                let found = format!("a strand without rest (searched to a residual of {:.1e})", rest.residual);
                return Err(Error::invalid("strand", found, "one that hangs still under this gravity, or a start as defined"));
            }
            strand.initial = Some(solver.curvatures(ids[0])?.to_vec());
            solver.remove_strands(&ids)?;
        }
        (strand.root_velocity, strand.root_angular_velocity) = way.velocity(start);
        let tip = strand.length();
        Ok(Self { solver, strand, way, measure, start, times, first, tip })
    }

    /// The curve of each material, in steps of at most `time_step`; `None` where a state turned non-finite.
    pub fn curves(&mut self, materials: &[Material], time_step: f64) -> Result<Vec<Option<Curve>>> {
        let strands: Vec<_> = materials.iter().map(|material| StrandDef { material: *material, ..self.strand.clone() }).collect();
        let ids = self.solver.add_strands(&strands)?;
        let curve = || Some(Curve { values: Vec::with_capacity(self.times.len() - self.first), unconverged: 0 });
        let mut curves: Vec<Option<Curve>> = ids.iter().map(|_| curve()).collect();
        let mut alive: Vec<usize> = (0..ids.len()).collect();
        let mut time = self.start;
        for (sample, target) in self.times.iter().enumerate() {
            let steps = ((target - time) / time_step - 1e-9).ceil().max(0.0) as u64;
            for step in 1..=steps {
                let end = if step == steps { *target } else { time + (target - time) * (step as f64 / steps as f64) };
                let h = (target - time) / steps as f64;
                let moving: Vec<_> = alive.iter().map(|k| ids[*k]).collect();
                self.solver.set_root_frames(&moving, &vec![self.way.at(end); moving.len()], h)?;
                self.solver.step(h, 1)?;
                let mut failed = Vec::new();
                for k in &alive {
                    match self.solver.status(ids[*k])? {
                        StrandStatus::Quarantined => failed.push(*k),
                        StrandStatus::Unconverged => curves[*k].iter_mut().for_each(|curve| curve.unconverged += 1),
                        StrandStatus::Ok => {}
                    }
                }
                for k in failed {
                    curves[k] = None;
                    self.solver.remove_strands(&[ids[k]])?;
                    alive.retain(|other| *other != k);
                }
            }
            time = *target;
            if sample >= self.first {
                for k in &alive {
                    let root = self.solver.root_frame(ids[*k])?.origin;
                    let mut value = f64::NAN;
                    self.solver.sample_at(ids[*k], &[self.tip], |_, tip| value = (self.measure)(tip.position - root))?;
                    if let Some(curve) = &mut curves[*k] {
                        curve.values.push(value);
                    }
                }
            }
        }
        let left: Vec<_> = alive.iter().map(|k| ids[*k]).collect();
        self.solver.remove_strands(&left)?;
        Ok(curves)
    }
}
