//! Strands, bodies and targets of constraints attached to one pose: a head with everything on it.

use super::Solver;
use super::id::{BodyId, ConstraintId, StrandId};
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_not_negative};
use crate::math::frame::Frame;

/// The poses of things in the axes of their carrier. An attachment belongs to the solver that made it; snapshots do not contain
/// it, and it is valid as long as the identifiers are.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Frame, Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let head = solver.attach(&Frame::default(), &ids, &[], &[])?;
/// let moved = Frame { origin: Vector3::new(0.0, 0.01, 0.0), ..Frame::default() };
/// solver.move_attached(&head, &moved, 0.1)?;
/// solver.step(0.1, 6)?;
/// assert!((solver.root_frame(ids[0])?.origin.y - 0.01).abs() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    strands: Vec<StrandId>,
    bodies: Vec<BodyId>,
    constraints: Vec<ConstraintId>,
    /// Of strands' roots, then bodies, then targets.
    local: Vec<Frame>,
}

impl Attachment {
    /// The world frames of strands, bodies and constraints at a pose.
    fn at(&self, pose: &Frame) -> [Vec<Frame>; 3] {
        let world: Vec<Frame> = self.local.iter().map(|local| pose.compose(local)).collect();
        let (strands, rest) = world.split_at(self.strands.len());
        let (bodies, constraints) = rest.split_at(self.bodies.len());
        [strands, bodies, constraints].map(<[Frame]>::to_vec)
    }
}

impl Solver {
    /// Attaches roots, bodies and targets of constraints at their current poses to something with the current pose `pose`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `strands[i]`, `bodies[i]` or `constraints[i]`.
    pub fn attach(
        &self,
        pose: &Frame,
        strands: &[StrandId],
        bodies: &[BodyId],
        constraints: &[ConstraintId],
    ) -> Result<Attachment> {
        let to_local = pose.inverse();
        let mut local = Vec::with_capacity(strands.len() + bodies.len() + constraints.len());
        for (k, id) in strands.iter().enumerate() {
            local.push(to_local.compose(&self.root_frame(*id).map_err(|error| error.renamed("id", &format!("strands[{k}]")))?));
        }
        for (k, id) in bodies.iter().enumerate() {
            local.push(to_local.compose(&self.body(*id).map_err(|error| error.renamed("id", &format!("bodies[{k}]")))?.pose));
        }
        for (k, id) in constraints.iter().enumerate() {
            let constraint = self.constraint(*id).map_err(|error| error.renamed("id", &format!("constraints[{k}]")))?;
            local.push(to_local.compose(&constraint.target));
        }
        let (strands, bodies, constraints) = (strands.to_vec(), bodies.to_vec(), constraints.to_vec());
        Ok(Attachment { strands, bodies, constraints, local })
    }

    fn check_attached(&self, attachment: &Attachment) -> Result<()> {
        for (k, id) in attachment.strands.iter().enumerate() {
            self.index("strand", *id).map_err(|error| error.renamed("strand", &format!("strands[{k}]")))?;
        }
        for (k, id) in attachment.bodies.iter().enumerate() {
            self.body_index(|| format!("bodies[{k}]"), *id)?;
        }
        for (k, id) in attachment.constraints.iter().enumerate() {
            self.constraint(*id).map_err(|error| error.renamed("id", &format!("constraints[{k}]")))?;
        }
        Ok(())
    }

    /// Sends everything attached to where it is when its carrier is at `pose`, in `over_seconds` (0: within the next substep),
    /// each along its own path, like [`Solver::set_root_frames`], [`Solver::set_body_frames`] and
    /// [`Solver::set_constraint_targets`].
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming what was removed in the meantime; [`Error::InvalidArgument`] for a time that is not finite and
    /// 0 or more. Nothing has then changed.
    pub fn move_attached(&mut self, attachment: &Attachment, pose: &Frame, over_seconds: f64) -> Result<()> {
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        self.check_attached(attachment)?;
        let [roots, bodies, targets] = attachment.at(pose);
        self.set_root_frames(&attachment.strands, &roots, over_seconds)?;
        self.set_body_frames(&attachment.bodies, &bodies, over_seconds)?;
        self.set_constraint_targets(&attachment.constraints, &targets, over_seconds)
    }

    /// Moves everything attached there at once: strands keep their shapes and their velocities relative to their roots, bodies
    /// sweep nothing, and targets arrive within the next substep.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming what was removed in the meantime. Nothing has then changed.
    pub fn teleport_attached(&mut self, attachment: &Attachment, pose: &Frame) -> Result<()> {
        self.check_attached(attachment)?;
        let [roots, bodies, targets] = attachment.at(pose);
        self.teleport_roots(&attachment.strands, &roots)?;
        self.teleport_bodies(&attachment.bodies, &bodies)?;
        self.set_constraint_targets(&attachment.constraints, &targets, 0.0)
    }
}
