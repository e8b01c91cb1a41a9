//! Reads strands back: shapes, status, energies, samples.
//!
//! Files:
//!
//! - `bulk_sampling.rs`: Samples many strands at uniform arclengths: in packs side by side, on all of the solver's workers.
//! - `contact_events.rs`: Contact begin and end events, queued until the host drains them.
//! - `debug_draw.rs`: Debug drawing: what a solver knows, as coloured lines and points in batches.
//! - `render_guides.rs`: A solver's strands as guides of render hair, and its bodies as obstacles.
//! - `sampling.rs`: Samples a strand's material points at any arclengths.

pub(super) mod bulk_sampling;
pub mod contact_events;
pub mod debug_draw;
pub(super) mod render_guides;
pub(super) mod sampling;

use super::Solver;
use super::id::StrandId;
use super::report::{Energies, Quadrature, StrandStatus, Wrench};
use super::strands::strand::Strand;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use sampling::{Sample, Sampler};

impl Solver {
    /// Lengths of a strand's elements from root to tip, m.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn element_lengths(&self, id: StrandId) -> Result<&[f64]> {
        Ok(&self.strand("id", id)?.model.lengths)
    }

    /// The largest angle Ωℓ by which an element turns, in the natural or the current shape, rad. Above π/2 a strand is too stiff:
    /// a helix cannot bend its own axis.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn largest_turn(&self, id: StrandId) -> Result<f64> {
        let Strand { model, state, .. } = self.strand("id", id)?;
        Ok(model.largest_angle(&model.natural).max(model.largest_angle(&state.curvatures)))
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
        Ok(self.strand("id", id)?.model.material.mean_radius())
    }

    /// Length of a strand, m.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn length(&self, id: StrandId) -> Result<f64> {
        Ok(self.strand("id", id)?.model.length())
    }

    /// Mass of a strand, kg.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn mass(&self, id: StrandId) -> Result<f64> {
        Ok(self.strand("id", id)?.model.mass())
    }

    /// See [`StrandModel::cantilever`](crate::rod::strand::StrandModel::cantilever).
    pub(crate) fn cantilever(&self, id: StrandId) -> Result<[f64; 2]> {
        Ok(self.strand("id", id)?.model.cantilever())
    }

    /// The current pose of a strand's root.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn root_frame(&self, id: StrandId) -> Result<Frame> {
        Ok(self.strand("id", id)?.state.root)
    }

    /// Natural curvatures (twist, κ1, κ2) in rad/m, one row per element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn natural_curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.model.natural)
    }

    /// Current curvatures, rad/m, one row per element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.state.curvatures)
    }

    /// Current rates of the curvatures, rad/(m·s), one row per element.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn rates(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        Ok(&self.strand("id", id)?.state.rates)
    }

    /// The status of a strand after the last substep.
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
        Ok(self.strand("id", id)?.last.iterations)
    }

    /// The number of quadrature points per element of a strand, and the quadrature error in its current shape: at most
    /// [`StepOptions::quadrature_tolerance`](crate::step::options::StepOptions::quadrature_tolerance), unless an element has
    /// turned farther than any rule covers, or since the start of the last step.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn quadrature(&self, id: StrandId) -> Result<Quadrature> {
        let Strand { model, state, .. } = self.strand("id", id)?;
        let error = self.rules.error(state.rule, model.largest_angle(&state.curvatures));
        Ok(Quadrature { points: self.rules.rule(state.rule).len() as u32, error })
    }

    /// A strand's energies, J.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn energies(&self, id: StrandId) -> Result<Energies> {
        Ok(self.strand("id", id)?.energies)
    }

    /// The action of a strand on its follicle in the last substep: the sum of weight, drag and inertia of all its points, and
    /// their moment about the root's origin, world axes. Zero before the first step.
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
            // The elements' lengths sum to the strand's with rounding: a host that passes its length means the tip.
            if !(*arclength >= 0.0 && *arclength <= length * (1.0 + 1e-9)) {
                return Err(Error::invalid(format!("arclengths[{k}]"), arclength, format!("0 to the strand's length {length}")));
            }
        }
        self.timed_sampling(|| {
            let mut sampler = Sampler::new(strand, &self.rules);
            for (k, arclength) in arclengths.iter().enumerate() {
                emit(k, &sampler.at(*arclength));
            }
        });
        Ok(())
    }
}
