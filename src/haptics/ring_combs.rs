//! Ring combs in the hand: their teeth hold the strands that they run into, and the hand feels what these pull with.

use nalgebra::Vector3;

use super::coupling::AddedMass;
use super::explicit_law::Resistance;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::report::Wrench;
use crate::styling::{RingComb, RingCombReport};

/// A ring comb that goes with a handle.
#[derive(Debug)]
pub(super) struct HeldComb {
    comb: RingComb,
    /// Its pose in the handle's frame.
    place: Frame,
    /// The strands that it may catch.
    strands: Vec<StrandId>,
    report: RingCombReport,
}

impl HeldComb {
    /// A comb at its pose, in the hand that holds a handle at `handle`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `strands[i]`.
    pub fn new(solver: &Solver, handle: &Frame, comb: RingComb, strands: &[StrandId]) -> Result<Self> {
        for (index, id) in strands.iter().enumerate() {
            let invalid = |_| Error::InvalidId { argument: format!("strands[{index}]"), bits: id.bits() };
            solver.contact(*id).map_err(invalid)?;
        }
        let place = handle.inverse().compose(&comb.pose());
        Ok(Self { comb, place, strands: strands.to_vec(), report: RingCombReport::default() })
    }

    /// The comb.
    pub fn comb(&self) -> &RingComb {
        &self.comb
    }

    /// The result of the last step.
    pub fn report(&self) -> &RingCombReport {
        &self.report
    }

    /// Before a step of `dt` seconds after which the handle is at `handle`; the `first` puts the comb there without sweeping what lies between.
    pub fn before_step(&mut self, solver: &mut Solver, handle: &Frame, dt: f64, first: bool) -> Result<()> {
        self.strands.retain(|id| solver.contact(*id).is_ok());
        let to = handle.compose(&self.place);
        if first {
            self.comb.place_at(&to);
        }
        self.comb.before_step(solver, &self.strands, &to, dt)
    }

    /// After the step: what the strands on its teeth do to the handle, force and torque about the handle's origin.
    pub fn after_step(&mut self, solver: &mut Solver, handle: &Frame) -> Result<Wrench> {
        self.report = self.comb.after_step(solver)?;
        let Wrench { force, torque } = self.report.wrench;
        Ok(Wrench { force, torque: torque + (self.comb.pose().origin - handle.origin).cross(&force) })
    }

    /// Adds the resistance of the strands on its teeth by the explicit formula, with its coefficients across and along.
    pub fn resist(&self, solver: &Solver, handle: &Frame, [across, along]: [f64; 2], sum: &mut Resistance) -> Result<()> {
        for (strand, constraint) in self.comb.held() {
            let along_strand = solver.constraint_state(constraint)?.arclength;
            let [stiffness, friction] = solver.cantilever(strand)?;
            solver.sample_at(strand, &[along_strand], |_, sample| {
                let tangent = sample.rotation * Vector3::x();
                sum.add(&tangent, &(sample.position - handle.origin), stiffness * across, friction * along);
            })?;
        }
        Ok(())
    }

    /// Adds the mass of the strands on its teeth.
    pub fn add_mass(&self, solver: &Solver, handle: &Frame, sum: &mut AddedMass) {
        for (strand, constraint) in self.comb.held() {
            let (Ok(mass), Ok(def)) = (solver.mass(strand), solver.constraint(constraint)) else { continue };
            sum.mass += mass;
            sum.moment += mass * (def.target.origin - handle.origin).norm_squared();
        }
    }

    /// Lets go of all strands.
    pub fn release(&mut self, solver: &mut Solver) -> Result<()> {
        self.comb.release(solver)
    }
}
