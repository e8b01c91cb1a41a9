//! The scene: strands, their roots, the step, and everything a host reads back.

pub mod definition;
pub mod id;
pub mod report;

use nalgebra::{UnitQuaternion, Vector3};

use crate::error::Result;
use crate::math::frame::Frame;
use definition::{SolverOptions, StrandDef};
use id::StrandId;
use report::{Energies, StepReport, StrandStatus, Wrench};

/// One sampled material point of a strand, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Arclength from the root, m.
    pub arclength: f64,
    /// Position r, m.
    pub position: Vector3<f64>,
    /// Material frame (n0, n1, n2).
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the material point, m/s.
    pub velocity: Vector3<f64>,
}

/// Everything the engine knows: strands, gravity, wind, options. See the crate's documentation for the order of calls.
pub struct Solver {
    options: SolverOptions,
}

#[allow(unused_variables, clippy::todo, missing_docs, clippy::missing_errors_doc)]
impl Solver {
    pub fn new(options: SolverOptions) -> Result<Self> {
        todo!()
    }
    pub fn options(&self) -> &SolverOptions {
        &self.options
    }
    pub fn set_gravity(&mut self, gravity: Vector3<f64>) -> Result<()> {
        todo!()
    }
    pub fn set_wind(&mut self, wind: Vector3<f64>) -> Result<()> {
        todo!()
    }
    /// All or nothing; ids in the order of the definitions. Error arguments are `strands[i].field`.
    pub fn add_strands(&mut self, strands: &[StrandDef]) -> Result<Vec<StrandId>> {
        todo!()
    }
    pub fn remove_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        todo!()
    }
    pub fn has_strand(&self, id: StrandId) -> bool {
        todo!()
    }
    pub fn strand_count(&self) -> usize {
        todo!()
    }
    /// Ids in the order the strands were added.
    pub fn strand_ids(&self) -> Vec<StrandId> {
        todo!()
    }
    pub fn element_lengths(&self, id: StrandId) -> Result<&[f64]> {
        todo!()
    }
    pub fn user_data(&self, id: StrandId) -> Result<u64> {
        todo!()
    }
    /// Moves roots smoothly to `frames` over the next `over_seconds` of simulated time (0: within the next substep).
    pub fn set_root_frames(&mut self, ids: &[StrandId], frames: &[Frame], over_seconds: f64) -> Result<()> {
        todo!()
    }
    /// Puts roots at `frames` at once: the strands keep their shape and velocity in the root's frame and get no kick.
    pub fn teleport_roots(&mut self, ids: &[StrandId], frames: &[Frame]) -> Result<()> {
        todo!()
    }
    pub fn root_frame(&self, id: StrandId) -> Result<Frame> {
        todo!()
    }
    pub fn natural_curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        todo!()
    }
    pub fn set_natural_curvatures(&mut self, id: StrandId, rows: &[[f64; 3]]) -> Result<()> {
        todo!()
    }
    pub fn curvatures(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        todo!()
    }
    pub fn rates(&self, id: StrandId) -> Result<&[[f64; 3]]> {
        todo!()
    }
    pub fn set_curvatures(&mut self, id: StrandId, rows: &[[f64; 3]], rates: Option<&[[f64; 3]]>) -> Result<()> {
        todo!()
    }
    /// Back to the natural curvatures, at rest relative to the root; clears a quarantine.
    pub fn reset_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        todo!()
    }
    /// `dt` > 0 seconds in `substeps` >= 1 equal parts.
    pub fn step(&mut self, dt: f64, substeps: u32) -> Result<StepReport> {
        todo!()
    }
    pub fn status(&self, id: StrandId) -> Result<StrandStatus> {
        todo!()
    }
    /// Newton iterations of the last substep.
    pub fn iterations(&self, id: StrandId) -> Result<u32> {
        todo!()
    }
    pub fn energies(&self, id: StrandId) -> Result<Energies> {
        todo!()
    }
    pub fn root_wrench(&self, id: StrandId) -> Result<Wrench> {
        todo!()
    }
    /// `points_per_strand` >= 2 samples a strand, uniform in arclength, root and tip included; emit(strand index, point index, sample).
    pub fn sample_strands(
        &self,
        ids: &[StrandId],
        points_per_strand: usize,
        emit: impl FnMut(usize, usize, &Sample),
    ) -> Result<()> {
        todo!()
    }
    /// Samples at given arclengths (0 to length; order free).
    pub fn sample_at(&self, id: StrandId, arclengths: &[f64], emit: impl FnMut(usize, &Sample)) -> Result<()> {
        todo!()
    }
    /// Mean radius sqrt(a1 a2) of the section, m.
    pub fn radius(&self, id: StrandId) -> Result<f64> {
        todo!()
    }
    pub fn snapshot(&self) -> Vec<u8> {
        todo!()
    }
    pub fn restore(&mut self, image: &[u8]) -> Result<()> {
        todo!()
    }
    pub fn state_hash(&self) -> u64 {
        todo!()
    }
    pub fn memory_usage(&self) -> u64 {
        todo!()
    }
}
