//! Scissors: cut strands where a blade crosses them.

use nalgebra::Vector3;

use super::crossing::Curve;
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_finite, check_positive};
use crate::solver::Solver;
use crate::solver::id::{ConstraintId, StrandId};

/// A cut strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Which.
    pub strand: StrandId,
    /// Its new length, m.
    pub arclength: f64,
    /// The removed length, m.
    pub removed: f64,
    /// The place of the cut, world.
    pub position: Vector3<f64>,
    /// Constraints on the removed part: they are removed with it.
    pub constraints: Vec<ConstraintId>,
}

impl Solver {
    /// Cuts the strands that cross a blade, a quad with these corners in order, each at the crossing nearest to its root, but no
    /// shorter than `min_length` (m). The rest keeps its shape, its natural shape and its velocities exactly ([`Solver::cut`]);
    /// nothing else moves. Constraints on the removed parts are removed and reported. Returns the cuts in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a corner that is not finite, a length that is not
    /// above zero, an identifier given twice. Nothing has then changed.
    pub fn cut_across(&mut self, ids: &[StrandId], corners: &[Vector3<f64>; 4], min_length: f64) -> Result<Vec<Cut>> {
        for (k, corner) in corners.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("corners[{k}][{axis}]"), corner[axis])?;
            }
        }
        check_positive(|| "min_length".into(), min_length)?;
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let mut cuts = Vec::new();
        for (index, id) in indices.into_iter().zip(ids) {
            let length = self.strands[index].model.length();
            let curve = Curve::of(&self.strands[index]);
            let Some(place) = curve.first_crossing(corners, 0.0) else { continue };
            let arclength = place.along.max(min_length);
            if arclength >= length {
                continue;
            }
            let beyond = |constraint: &&crate::solver::constraints::Constraint| {
                let own = (constraint.def.strand == *id).then_some(constraint.state.arclength);
                own.into_iter().chain(constraint.tied(*id)).any(|held| held > arclength)
            };
            let constraints = self.constraints.iter().filter(beyond).map(|constraint| constraint.id).collect();
            let position = curve.position(curve.place(arclength));
            cuts.push(Cut { strand: *id, arclength, removed: length - arclength, position, constraints });
        }
        let mut gone: Vec<ConstraintId> = cuts.iter().flat_map(|cut| cut.constraints.iter().copied()).collect();
        gone.sort_unstable_by_key(|id| id.bits());
        gone.dedup();
        self.remove_constraints(&gone)?;
        let (cut, arclengths): (Vec<StrandId>, Vec<f64>) = cuts.iter().map(|cut| (cut.strand, cut.arclength)).unzip();
        self.cut(&cut, &arclengths)?;
        Ok(cuts)
    }
}
