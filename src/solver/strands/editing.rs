//! Edits strands: motions of roots, natural and current shapes, rest.

use super::strand::{Strand, SubstepResult};
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_not_negative};
use crate::math::frame::Frame;
use crate::rod::definition::{check_frozen, check_rows};
use crate::rod::kinematics::Kinematics;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::step::equilibrium::{self, Equilibrium, EquilibriumOptions};

/// Most strands that a task settles at a time.
const SETTLED_AT_A_TIME: usize = 8;

/// Runs a piece of work, on whatever thread.
pub(crate) type RunPiece<'a> = &'a (dyn Fn(&mut (dyn FnMut() + Send)) + Sync);

impl Solver {
    /// Sends roots to `frames` over the next `over_seconds` of simulated time; 0: within the next substep. The motion is smooth:
    /// it starts with the root's current velocity and passes exactly through the frame.
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

    /// Moves roots to `frames` at once: the strands keep their shape and their velocities in the root's axes, without a kick; their
    /// targets ([`Solver::set_targets`]) move along.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ; [`Error::InvalidId`].
    pub fn teleport_roots(&mut self, ids: &[StrandId], frames: &[Frame]) -> Result<()> {
        let indices = self.indices_with(ids, frames.len())?;
        let mut kinematics = Kinematics::default();
        for (index, frame) in indices.into_iter().zip(frames) {
            let strand = &mut self.strands[index];
            strand.root_move = None;
            if let Some(target) = &mut strand.target {
                target.carry(&strand.state.root, frame);
            }
            strand.state.teleport(*frame);
            strand.update_energies(self.options.gravity, &self.rules, &mut kinematics);
        }
        Ok(())
    }

    /// Changes a strand's natural curvatures; a frozen freedom moves to its new value in the next step. Discards the earlier
    /// shape that [`Solver::set_element_count`] keeps.
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for a wrong count or a number that is not finite.
    pub fn set_natural_curvatures(&mut self, id: StrandId, rows: &[[f64; 3]]) -> Result<()> {
        let index = self.index("id", id)?;
        let strand = &mut self.strands[index];
        check_rows("curvatures", rows, strand.model.element_count())?;
        strand.model.natural.copy_from_slice(rows);
        strand.authored = None;
        strand.energies.elastic = strand.model.elastic_energy(&strand.state.curvatures);
        Ok(())
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

    /// Resets strands to their natural curvatures, at rest relative to their roots, and clears a quarantine.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn reset_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        for index in self.indices(ids)? {
            self.put(index, self.strands[index].model.natural.to_vec(), None);
        }
        Ok(())
    }

    /// Puts strands at rest in their static equilibrium under the solver's gravity, each searched from its current shape with its
    /// root fixed, without wind. Clears a quarantine. Each strand's report comes in the order of `ids`: one that did not converge
    /// stays at rest in the best shape found.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for options out of range.
    pub fn settle(&mut self, ids: &[StrandId], options: &EquilibriumOptions) -> Result<Vec<Equilibrium>> {
        self.settle_by(ids, options, &|piece| piece())
    }

    /// The same; `run` runs pieces of the work. The dense eigenvalue kernels leave memory behind on the threads that run them, which not every host
    /// can have on its own.
    pub(crate) fn settle_by(
        &mut self,
        ids: &[StrandId],
        options: &EquilibriumOptions,
        run: RunPiece,
    ) -> Result<Vec<Equilibrium>> {
        options.check("options")?;
        let indices = self.indices(ids)?;
        let mut settled: Vec<_> = indices.iter().map(|index| (*index, Vec::new(), Equilibrium::default())).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.workers.for_each_task(&mut settled, 1, SETTLED_AT_A_TIME, |piece, workspace| {
            let scratch = &mut workspace.step.one;
            run(&mut || {
                for (index, curvatures, found) in piece.iter_mut() {
                    let Strand { model, state, .. } = &strands[*index];
                    let start = state.curvatures.clone();
                    (*curvatures, *found) = equilibrium::search(model, start, &state.root, gravity, options, rules, scratch);
                }
            });
        });
        let mut found = Vec::with_capacity(settled.len());
        for (index, curvatures, equilibrium) in settled {
            self.strands[index].stop_root();
            self.put(index, curvatures, None);
            self.strands[index].last.converged = equilibrium.converged;
            found.push(equilibrium);
        }
        Ok(found)
    }

    /// Puts a strand into a shape, with rates (`None`: at rest relative to its root), and wakes it.
    pub(in crate::solver) fn put(&mut self, index: usize, curvatures: Vec<[f64; 3]>, rates: Option<Vec<[f64; 3]>>) {
        self.put_with(index, curvatures, rates, &mut Kinematics::default());
    }

    /// The same; `kinematics` is scratch memory.
    pub(in crate::solver) fn put_with(
        &mut self,
        index: usize,
        curvatures: Vec<[f64; 3]>,
        rates: Option<Vec<[f64; 3]>>,
        kinematics: &mut Kinematics<f64>,
    ) {
        let strand = &mut self.strands[index];
        strand.state.rates = rates.unwrap_or_else(|| vec![[0.0; 3]; curvatures.len()]);
        strand.state.curvatures = curvatures;
        strand.frozen = None;
        strand.state.velocities_from_rates(&strand.model, &self.rules);
        strand.last = SubstepResult::default();
        strand.update_energies(self.options.gravity, &self.rules, kinematics);
    }
}
