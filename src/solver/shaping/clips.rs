//! Clips: hold strands where they are in a box, and move with the box.

use nalgebra::Vector3;

use super::crossing::Curve;
use crate::error::{Error, Result, check_positive};
use crate::math::frame::Frame;
use crate::solver::Solver;
use crate::solver::constraints::{ConstraintDef, Hold};
use crate::solver::id::{ConstraintId, StrandId};

/// A clip.
///
/// ```
/// use superhelix::editing::ClipDef;
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Frame, Hold, Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let clip = ClipDef {
///     frame: Frame { origin: Vector3::new(0.1, 0.0, 0.0), ..Frame::default() },
///     half_edges: Vector3::new(0.01, 0.02, 0.02),
///     hold: Hold::Frame,
///     compliance: 0.0,
/// };
/// assert!(!solver.clip_strands(&ids, &clip)?.is_empty());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClipDef {
    /// Its pose, world.
    pub frame: Frame,
    /// Half the edges of the box that holds hair, m, above zero, along the frame's axes.
    pub half_edges: Vector3<f64>,
    /// How it holds the material points: [`Hold::Point`], [`Hold::Direction`] or [`Hold::Frame`].
    pub hold: Hold,
    /// Displacement of a point per unit of force, m/N; zero or above.
    pub compliance: f64,
}

impl Solver {
    /// Closes a clip: holds each stretch of a strand inside its box at the stretch's middle, where it is. A clip is the
    /// constraints that it created: [`Solver::move_constraints`] moves it, [`Solver::remove_constraints`] opens it. Nothing moves
    /// at once.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a field of `clip`, or an identifier given twice.
    pub fn clip_strands(&mut self, ids: &[StrandId], clip: &ClipDef) -> Result<Vec<ConstraintId>> {
        let defs = self.clip_constraints(ids, clip)?;
        self.add_constraints(&defs)
    }

    /// The constraints that [`Solver::clip_strands`] would add.
    ///
    /// # Errors
    /// As [`Solver::clip_strands`].
    pub fn clip_constraints(&self, ids: &[StrandId], clip: &ClipDef) -> Result<Vec<ConstraintDef>> {
        for axis in 0..3 {
            check_positive(|| format!("clip.half_edges[{axis}]"), clip.half_edges[axis])?;
            crate::error::check_finite(|| format!("clip.frame.origin[{axis}]"), clip.frame.origin[axis])?;
        }
        crate::error::check_not_negative(|| "clip.compliance".into(), clip.compliance)?;
        if !matches!(clip.hold, Hold::Point | Hold::Direction | Hold::Frame) {
            return Err(Error::invalid("clip.hold", format!("{:?}", clip.hold), "a point, a direction or a frame"));
        }
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let mut defs = Vec::new();
        for (index, id) in indices.into_iter().zip(ids) {
            let curve = Curve::of(&self.strands[index]);
            for [from, to] in curve.stretches_in(&clip.frame, &clip.half_edges) {
                let arclength = (0.5 * (from.along + to.along)).min(self.strands[index].model.length());
                let target = curve.frame(curve.place(arclength));
                defs.push(ConstraintDef { strand: *id, arclength, hold: clip.hold, target, compliance: clip.compliance });
            }
        }
        Ok(defs)
    }

    /// Moves the targets of constraints rigidly with something that goes from `from` to `to` in `over_seconds` (0: within the
    /// next substep): the clip that holds them, or a comb.
    ///
    /// # Errors
    /// As [`Solver::set_constraint_targets`].
    pub fn move_constraints(&mut self, ids: &[ConstraintId], from: &Frame, to: &Frame, over_seconds: f64) -> Result<()> {
        let mut frames = Vec::with_capacity(ids.len());
        for (k, id) in ids.iter().enumerate() {
            let stale = |_| Error::InvalidId { argument: format!("ids[{k}]"), bits: id.bits() };
            frames.push(self.constraint(*id).map_err(stale)?.target.carried(from, to));
        }
        self.set_constraint_targets(ids, &frames, over_seconds)
    }
}
