//! The warm start: the forces of the last substep's contacts, with which the next one begins.

use nalgebra::Vector3;

use super::ContactDetection;
use crate::contact::constraint::step_constraint::ConstraintKind;
use crate::coupled::constrained_strand::ConstrainedStrand;
use crate::coupled::island::Island;

/// A contact continues one of the last step if it is no further from it along the strand than this fraction of the strand's
/// length.
const SAME: f64 = 0.02;

/// The partner of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum With {
    Body(u32),
    Strand(u32),
}

/// The force of a contact in the last substep.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WarmStartForce {
    pub strand: u32,
    pub with: With,
    pub along: f64,
    pub force: Vector3<f64>,
}

impl ContactDetection {
    /// The force of this contact in the last substep.
    pub(super) fn warm_start_force(&self, strand: u32, with: With, along: f64, length: f64) -> Vector3<f64> {
        let from = self.warm_start.partition_point(|seen| (seen.strand, seen.with) < (strand, with));
        let mut best = (SAME * length, Vector3::zeros());
        for seen in self.warm_start[from..].iter().take_while(|seen| (seen.strand, seen.with) == (strand, with)) {
            let off = (seen.along - along).abs();
            if off <= best.0 {
                best = (off, seen.force);
            }
        }
        best.1
    }

    /// Stores the contacts' forces as the warm start of the next substep.
    pub fn store_warm_start<'a>(&mut self, islands: impl Iterator<Item = &'a Island>, strands: &[ConstrainedStrand]) {
        self.warm_start.clear();
        for constraint in islands.flat_map(|island| &island.constraints).filter(|constraint| constraint.force != Vector3::zeros())
        {
            let with = match (constraint.kind, constraint.second) {
                (ConstraintKind::Body { body, .. }, _) => With::Body(body),
                (ConstraintKind::Hair { .. }, Some(second)) => With::Strand(strands[second.strand as usize].index),
                _ => continue,
            };
            let strand = &strands[constraint.first.strand as usize];
            let along = strand.along(&constraint.first.material_point);
            self.warm_start.push(WarmStartForce { strand: strand.index, with, along, force: constraint.force });
        }
        self.sort_warm_start();
    }

    fn sort_warm_start(&mut self) {
        self.warm_start.sort_by(|a, b| (a.strand, a.with).cmp(&(b.strand, b.with)).then(a.along.total_cmp(&b.along)));
    }

    /// Adds the forces of strands that took the substep in substeps.
    pub fn keep_warm_start_of(&mut self, substeps: &Self) {
        self.warm_start.extend_from_slice(&substeps.warm_start);
        self.sort_warm_start();
    }
}
