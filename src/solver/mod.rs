//! The scene: strands, their roots, the step, and everything a host reads back.

pub mod definition;
pub mod id;
pub mod report;
mod sampling;
mod snapshot;
mod strand;
mod workers;

use std::time::Instant;

use nalgebra::Vector3;

pub use sampling::Sample;
pub use snapshot::SNAPSHOT_VERSION;

use crate::error::{Error, Result, check_finite, check_not_negative, check_positive};
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::rod::definition::{check_frozen, check_rows};
use crate::rod::kinematics::Kinematics;
use crate::step::equilibrium::{self, Equilibrium, EquilibriumOptions};
use crate::step::{self, Setting, Surroundings};
use definition::{SolverOptions, StrandDef};
use id::{SlotMap, StrandId};
use report::{Energies, StepReport, StrandStatus, Wrench};
use sampling::Sampler;
use strand::{Strand, Tally};
use workers::Crew;

/// Everything the engine knows: strands, gravity, wind, options.
///
/// Reading (`&self`) from several threads at once is fine; changing (`&mut self`) is exclusive. Every fallible call that fails has
/// changed nothing.
pub struct Solver {
    options: SolverOptions,
    rules: Box<Rules>,
    slots: SlotMap,
    strands: Vec<Strand>,
    crew: Crew,
}

impl std::fmt::Debug for Solver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solver").field("options", &self.options).field("strands", &self.strands.len()).finish_non_exhaustive()
    }
}

/// The shortest substep, s: below it rounding of the positions, divided by the step's square, drowns every acceleration.
pub const SHORTEST_STEP: f64 = 1e-9;

impl Solver {
    /// A solver without strands.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] or [`Error::Unsupported`] for an option that cannot be used, or threads that could not be started.
    pub fn new(options: SolverOptions) -> Result<Self> {
        options.check("options")?;
        let crew = Crew::new(&options.workers)?;
        let rules = Box::<Rules>::default();
        // Identifiers of two living solvers differ by where the solvers are: no counter is shared between them.
        let address = std::ptr::from_ref::<Rules>(&rules) as u64;
        let mark = (address >> 4).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 48;
        Ok(Self { options, rules, slots: SlotMap::new(mark as u16), strands: Vec::new(), crew })
    }

    /// What the solver was made from, with later changes.
    pub fn options(&self) -> &SolverOptions {
        &self.options
    }

    /// Changes gravity, m/s², from the next step on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number that is not finite.
    pub fn set_gravity(&mut self, gravity: Vector3<f64>) -> Result<()> {
        check_vector("gravity", gravity)?;
        self.options.gravity = gravity;
        let rules = &self.rules;
        self.crew.for_each(&mut self.strands, |strand, workspace| {
            strand.update_energies(gravity, rules, &mut workspace.kinematics);
        });
        Ok(())
    }

    /// Changes the uniform wind, m/s, from the next step on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number that is not finite.
    pub fn set_wind(&mut self, wind: Vector3<f64>) -> Result<()> {
        check_vector("wind", wind)?;
        self.options.wind = wind;
        Ok(())
    }

    /// Adds strands, all or none; their identifiers come in the order of the definitions.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `strands[i].field`; [`Error::OutOfMemory`] when all identifiers are in use.
    pub fn add_strands(&mut self, strands: &[StrandDef]) -> Result<Vec<StrandId>> {
        for (index, def) in strands.iter().enumerate() {
            def.check(&format!("strands[{index}]"))?;
        }
        if self.strands.len() + strands.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: strands.len().saturating_mul(size_of::<Strand>()) });
        }
        self.strands.reserve(strands.len());
        let mut ids = Vec::with_capacity(strands.len());
        let mut kinematics = Kinematics::default();
        for def in strands {
            let Some(id) = self.slots.insert(self.strands.len()) else {
                // Only retired slots can bring us here; what was added is taken back.
                self.remove_strands(&ids)?;
                return Err(Error::OutOfMemory { bytes: size_of::<Strand>() });
            };
            let mut strand = Strand::new(id, def, &self.rules);
            strand.update_energies(self.options.gravity, &self.rules, &mut kinematics);
            self.strands.push(strand);
            ids.push(id);
        }
        Ok(ids)
    }

    /// Removes strands, all or none. The others keep their identifiers and their order.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for an identifier given twice.
    pub fn remove_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        let indices = self.indices(ids)?;
        let mut gone = vec![false; self.strands.len()];
        for (k, index) in indices.iter().enumerate() {
            if std::mem::replace(&mut gone[*index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", ids[k].bits()), "each strand once"));
            }
        }
        for id in ids {
            self.slots.remove(*id);
        }
        let mut index = 0;
        self.strands.retain(|_| {
            index += 1;
            !gone[index - 1]
        });
        for (index, strand) in self.strands.iter().enumerate() {
            self.slots.moved(strand.id, index);
        }
        Ok(())
    }

    /// Whether an identifier names a living strand of this solver.
    pub fn has_strand(&self, id: StrandId) -> bool {
        self.slots.index(id).is_some()
    }

    /// Number of strands.
    pub fn strand_count(&self) -> usize {
        self.strands.len()
    }

    /// All identifiers, in the order in which the strands were added.
    pub fn strand_ids(&self) -> Vec<StrandId> {
        self.strands.iter().map(|strand| strand.id).collect()
    }

    /// Lengths of a strand's elements from root to tip, m.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn element_lengths(&self, id: StrandId) -> Result<&[f64]> {
        Ok(&self.strand("id", id)?.model.lengths)
    }

    /// The host's own number for a strand.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn user_data(&self, id: StrandId) -> Result<u64> {
        Ok(self.strand("id", id)?.user_data)
    }

    /// Mean radius √(a1 a2) of a strand's section, m.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn radius(&self, id: StrandId) -> Result<f64> {
        let [a1, a2] = self.strand("id", id)?.model.material.radius;
        Ok((a1 * a2).sqrt())
    }

    /// Sends roots to `frames` over the next `over_seconds` of simulated time; 0: within the next substep. The motion is smooth: it
    /// leaves with the velocity that the root has and passes exactly through the frame.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ or a time that is negative or not finite; [`Error::InvalidId`].
    pub fn set_root_frames(&mut self, ids: &[StrandId], frames: &[Frame], over_seconds: f64) -> Result<()> {
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        let indices = self.indices_with(ids, frames.len())?;
        for (index, frame) in indices.into_iter().zip(frames) {
            self.strands[index].move_root(*frame, over_seconds);
        }
        Ok(())
    }

    /// Puts roots at `frames` at once: the strands keep their shape and their velocities in the root's axes, and get no kick.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ; [`Error::InvalidId`].
    pub fn teleport_roots(&mut self, ids: &[StrandId], frames: &[Frame]) -> Result<()> {
        let indices = self.indices_with(ids, frames.len())?;
        let mut kinematics = Kinematics::default();
        for (index, frame) in indices.into_iter().zip(frames) {
            let strand = &mut self.strands[index];
            strand.root_move = None;
            strand.state.teleport(*frame);
            strand.update_energies(self.options.gravity, &self.rules, &mut kinematics);
        }
        Ok(())
    }

    /// Where a strand's root is now.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn root_frame(&self, id: StrandId) -> Result<Frame> {
        Ok(self.strand("id", id)?.state.root)
    }

    /// Natural curvatures (twist, κ1, κ2) in rad/m, a row an element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn natural_curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.model.natural)
    }

    /// Changes a strand's natural curvatures; a frozen freedom goes to its new value in the next step.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for a wrong count or a number that is not finite.
    pub fn set_natural_curvatures(&mut self, id: StrandId, rows: &[[f64; 3]]) -> Result<()> {
        let index = self.index("id", id)?;
        let strand = &mut self.strands[index];
        check_rows("curvatures", rows, strand.model.element_count())?;
        strand.model.natural.copy_from_slice(rows);
        strand.energies.elastic = strand.model.elastic_energy(&strand.state.curvatures);
        Ok(())
    }

    /// Present curvatures, rad/m, a row an element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.state.curvatures)
    }

    /// Present rates of the curvatures, rad/(m·s), a row an element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn rates(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.state.rates)
    }

    /// Puts a strand into a shape, with rates (`None`: at rest relative to its root). Clears a quarantine.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for a wrong count, a number that is not finite, or a frozen freedom that is not
    /// at its natural value (rate 0).
    pub fn set_curvatures(&mut self, id: StrandId, rows: &[[f64; 3]], rates: Option<&[[f64; 3]]>) -> Result<()> {
        let index = self.index("id", id)?;
        let model = &self.strands[index].model;
        let count = model.element_count();
        check_rows("curvatures", rows, count)?;
        check_frozen("curvatures", rows, &model.natural, model.freedoms)?;
        if let Some(rates) = rates {
            check_rows("rates", rates, count)?;
            check_frozen("rates", rates, &vec![[0.0; 3]; count], model.freedoms)?;
        }
        self.put(index, rows.to_vec(), rates.map(<[[f64; 3]]>::to_vec));
        Ok(())
    }

    /// Puts strands back to their natural curvatures, at rest relative to their roots, and clears a quarantine.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn reset_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        for index in self.indices(ids)? {
            self.put(index, self.strands[index].model.natural.clone(), None);
        }
        Ok(())
    }

    /// Puts strands at rest in their static equilibrium under the solver's gravity, each searched for from its present shape with its
    /// root held where it is; wind is not felt. Clears a quarantine. Each strand's report comes in the order of `ids`: one that did
    /// not converge is left, at rest, in the best shape that was found.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for options out of range.
    pub fn settle(&mut self, ids: &[StrandId], options: &EquilibriumOptions) -> Result<Vec<Equilibrium>> {
        options.check("options")?;
        let indices = self.indices(ids)?;
        let mut settled: Vec<_> = indices.iter().map(|index| (*index, Vec::new(), Equilibrium::default())).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.crew.for_each(&mut settled, |(index, curvatures, found), workspace| {
            let Strand { model, state, .. } = &strands[*index];
            (*curvatures, *found) =
                equilibrium::search(model, state.curvatures.clone(), &state.root, gravity, options, rules, workspace);
        });
        let mut found = Vec::with_capacity(settled.len());
        for (index, curvatures, equilibrium) in settled {
            self.strands[index].stop_root();
            self.put(index, curvatures, None);
            self.strands[index].outcome.converged = equilibrium.converged;
            found.push(equilibrium);
        }
        Ok(found)
    }

    fn put(&mut self, index: usize, curvatures: Vec<[f64; 3]>, rates: Option<Vec<[f64; 3]>>) {
        let strand = &mut self.strands[index];
        strand.state.rates = rates.unwrap_or_else(|| vec![[0.0; 3]; curvatures.len()]);
        strand.state.curvatures = curvatures;
        strand.state.velocities_from_rates(&strand.model, &self.rules);
        strand.outcome = step::StrandOutcome { converged: true, ..Default::default() };
        strand.update_energies(self.options.gravity, &self.rules, &mut Kinematics::default());
    }

    /// Takes all strands through `dt` seconds in `substeps` equal parts.
    ///
    /// A strand that does not converge keeps its best state and is counted; one whose numbers turn non-finite is rolled back to the
    /// substep's start and counted; the others go on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite and above zero, no substeps, or substeps below [`SHORTEST_STEP`].
    pub fn step(&mut self, dt: f64, substeps: u32) -> Result<StepReport> {
        let started = Instant::now();
        check_positive(|| "dt".into(), dt)?;
        if substeps == 0 {
            return Err(Error::invalid("substeps", substeps, "1 or more"));
        }
        let h = dt / f64::from(substeps);
        if h < SHORTEST_STEP {
            return Err(Error::invalid("dt / substeps", h, format!("{SHORTEST_STEP} s or more")));
        }
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let (options, rules) = (self.options.step, &*self.rules);
        let gravity = self.options.gravity;
        self.crew.for_each(&mut self.strands, |strand, workspace| {
            strand.tally = Tally::default();
            for _ in 0..substeps {
                strand.begin_root_way(h);
                let Strand { model, state, root_move, .. } = strand;
                let start = state.root;
                let root_at = |elapsed: f64| strand::root_after(root_move, &start, elapsed);
                let setting = Setting { model, surroundings: &surroundings, options: &options, rules };
                strand.outcome = step::take(&setting, state, &root_at, h, workspace);
                strand.advance_root(h);
                strand.tally.add(&strand.outcome);
            }
            if strand.outcome.quarantined {
                strand.update_energies(gravity, rules, &mut workspace.kinematics);
            } else {
                strand.energies = strand.energies_from(gravity, rules, &workspace.kinematics);
            }
        });
        Ok(self.report(substeps, started))
    }

    fn report(&self, substeps: u32, started: Instant) -> StepReport {
        let mut report = StepReport { substeps, ..StepReport::default() };
        let mut iterations = 0;
        for strand in &self.strands {
            let tally = &strand.tally;
            iterations += tally.iterations;
            report.max_iterations = report.max_iterations.max(tally.most_iterations);
            report.unconverged += tally.unconverged;
            report.quarantined += tally.quarantined;
            report.max_residual = report.max_residual.max(tally.residual);
            report.max_condition = report.max_condition.max(tally.condition);
            report.subdivided += tally.subdivided;
            report.max_error = report.max_error.max(tally.error);
            report.energies.kinetic += strand.energies.kinetic;
            report.energies.elastic += strand.energies.elastic;
            report.energies.gravity += strand.energies.gravity;
        }
        if !self.strands.is_empty() {
            report.mean_iterations = iterations as f64 / (self.strands.len() as f64 * f64::from(substeps));
        }
        report.seconds = started.elapsed().as_secs_f64();
        report
    }

    /// How a strand fared in the last substep.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn status(&self, id: StrandId) -> Result<StrandStatus> {
        Ok(self.strand("id", id)?.status())
    }

    /// Newton iterations of a strand's last substep.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn iterations(&self, id: StrandId) -> Result<u32> {
        Ok(self.strand("id", id)?.outcome.iterations)
    }

    /// A strand's energies, J.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn energies(&self, id: StrandId) -> Result<Energies> {
        Ok(self.strand("id", id)?.energies)
    }

    /// What a strand did to its follicle in the last substep: the sum of weight, drag and inertia of all its points, and their moment
    /// about the root's origin, world axes. Zero before the first step.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn root_wrench(&self, id: StrandId) -> Result<Wrench> {
        let state = &self.strand("id", id)?.state;
        Ok(Wrench { force: state.wrench_force.into(), torque: state.wrench_torque.into() })
    }

    /// Samples strands uniformly in arclength, root and tip included: `emit(strand, point, sample)`, in that order.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for fewer than two points; [`Error::InvalidId`].
    pub fn sample_strands(
        &self,
        ids: &[StrandId],
        points_per_strand: usize,
        mut emit: impl FnMut(usize, usize, &Sample),
    ) -> Result<()> {
        if points_per_strand < 2 {
            return Err(Error::invalid("points_per_strand", points_per_strand, "2 or more: root and tip"));
        }
        for (k, index) in self.indices(ids)?.into_iter().enumerate() {
            let strand = &self.strands[index];
            let mut sampler = Sampler::new(strand, &self.rules);
            let length = strand.model.length();
            for point in 0..points_per_strand {
                let arclength = length * (point as f64 / (points_per_strand - 1) as f64);
                emit(k, point, &sampler.at(arclength));
            }
        }
        Ok(())
    }

    /// Samples a strand at given arclengths (0 to its length, in any order; ascending is fastest): `emit(index, sample)`.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for an arclength off the strand.
    pub fn sample_at(&self, id: StrandId, arclengths: &[f64], mut emit: impl FnMut(usize, &Sample)) -> Result<()> {
        let strand = self.strand("id", id)?;
        let length = strand.model.length();
        for (k, arclength) in arclengths.iter().enumerate() {
            // The elements' lengths sum to the strand's with rounding: a host that asks for the length it gave means the tip.
            if !(*arclength >= 0.0 && *arclength <= length * (1.0 + 1e-9)) {
                return Err(Error::invalid(format!("arclengths[{k}]"), arclength, format!("0 to the strand's length {length}")));
            }
        }
        let mut sampler = Sampler::new(strand, &self.rules);
        for (k, arclength) in arclengths.iter().enumerate() {
            emit(k, &sampler.at(*arclength));
        }
        Ok(())
    }

    /// The whole state as bytes, to be given to [`Solver::restore`]: options that act on results, identifiers, strands.
    pub fn snapshot(&self) -> Vec<u8> {
        snapshot::write(self.options.gravity, self.options.wind, &self.options.step, &self.slots, &self.strands)
    }

    /// Goes back to a snapshot, of this solver or another: strands, identifiers and options become those of the image; the workers stay.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for an image that is truncated, damaged or of another version.
    pub fn restore(&mut self, image: &[u8]) -> Result<()> {
        let image = snapshot::read(image, &self.rules)?;
        self.options.gravity = image.gravity;
        self.options.wind = image.wind;
        self.options.step = image.step;
        let later = std::mem::replace(&mut self.slots, image.slots);
        self.slots.remember(&later);
        self.strands = image.strands;
        Ok(())
    }

    /// A number that differs when the state differs: options that act on results and every strand, not the identifiers. The same on
    /// every machine and for any number of workers.
    pub fn state_hash(&self) -> u64 {
        let mut writer = snapshot::Writer::default();
        writer.options(self.options.gravity, self.options.wind, &self.options.step);
        for strand in &self.strands {
            writer.strand(strand);
        }
        snapshot::fnv1a(&writer.0)
    }

    /// Bytes that the solver holds, its strands included; scratch memory of the workers and their stacks are not.
    pub fn memory_usage(&self) -> u64 {
        let strands: usize = self.strands.iter().map(Strand::heap_bytes).sum();
        (size_of::<Self>()
            + size_of::<Rules>()
            + self.strands.capacity() * size_of::<Strand>()
            + strands
            + self.slots.slots.capacity() * size_of::<id::Slot>()
            + self.slots.free.capacity() * size_of::<u32>()) as u64
    }

    fn index(&self, argument: &str, id: StrandId) -> Result<usize> {
        self.slots.index(id).ok_or_else(|| Error::InvalidId { argument: argument.into(), bits: id.bits() })
    }

    fn strand(&self, argument: &str, id: StrandId) -> Result<&Strand> {
        Ok(&self.strands[self.index(argument, id)?])
    }

    fn indices(&self, ids: &[StrandId]) -> Result<Vec<usize>> {
        ids.iter().enumerate().map(|(k, id)| self.index(&format!("ids[{k}]"), *id)).collect()
    }

    fn indices_with(&self, ids: &[StrandId], frames: usize) -> Result<Vec<usize>> {
        if frames != ids.len() {
            return Err(Error::invalid("frames (count)", frames, format!("{} frames, one a strand", ids.len())));
        }
        self.indices(ids)
    }
}

fn check_vector(argument: &str, vector: Vector3<f64>) -> Result<()> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}[{axis}]"), vector[axis])?;
    }
    Ok(())
}
