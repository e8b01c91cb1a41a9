//! Strands that rest while others of their island go on.

use nalgebra::Vector3;

use super::{Attachment, ConstrainedStrand};
use crate::coupled::island::Island;

impl ConstrainedStrand {
    /// Before an iteration: decides whether this strand rests.
    pub(super) fn choose_rest(&mut self, island: &Island) {
        let constraint = |end: &Attachment| &island.constraints[end.constraint as usize];
        // A contact that is no longer dormant must be in its model.
        let lacks = |end: &Attachment| !end.modelled && !constraint(end).is_dormant();
        if !island.may_rest() {
            self.rest.stir();
        } else if self.rest.is_resting() {
            if self.attachments.iter().any(|end| lacks(end) || constraint(end).standing.wakes[usize::from(end.second)]) {
                self.rest.wake();
            }
        } else if self.rest.may_rest() && island.progress.iterations > 0 && self.residual <= island.progress.rest {
            let is_settled = |end: &Attachment| {
                let standing = &constraint(end).standing;
                !lacks(end) && standing.holds && standing.law_residual <= island.rest_residual
            };
            if self.attachments.iter().all(is_settled) {
                self.rest.settle();
            }
        }
    }

    /// Whether it is at equilibrium under the last forces, whatever others of its island do: it rests, or is within the strands' `tolerance` (rad)
    /// of it, and the laws at its contacts are within the contacts' `residual`: rough forces do not count.
    pub fn is_at_equilibrium(&self, island: &Island, tolerance: f64, residual: f64) -> bool {
        let obeys = |end: &Attachment| island.constraints[end.constraint as usize].standing.law_residual <= residual;
        self.rest.is_resting() || self.residual <= tolerance && self.attachments.iter().all(obeys)
    }

    /// Displacement of an attached point of a resting strand from where it is if the constraints marked in `is_included` have
    /// the forces `of_constraint` (on their first ends), by the linear model of its last iteration.
    pub fn resting_displacement(
        &self,
        point: u32,
        is_included: &[bool],
        of_constraint: impl Fn(usize) -> Vector3<f64>,
    ) -> Vector3<f64> {
        // Symmetric: three columns are three rows.
        let size = 3 * self.modelled;
        let rows = &self.step.delassus.columns[3 * point as usize * size..][..3 * size];
        let mut sum = Vector3::zeros();
        for (k, (end, taken)) in self.attachments.iter().zip(&self.forces).enumerate() {
            let constraint = end.constraint as usize;
            if is_included[constraint] {
                let force = of_constraint(constraint);
                let change = if end.second { -force } else { force } - Vector3::from(*taken);
                for (axis, row) in rows.chunks_exact(size).enumerate() {
                    sum[axis] += row[3 * k] * change.x + row[3 * k + 1] * change.y + row[3 * k + 2] * change.z;
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::load::MaterialPoint;
    use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, StepConstraint};
    use crate::coupled::constrained_strand::Rest;

    const TOLERANCE: f64 = 1e-6;
    const RESIDUAL: f64 = 1e-4;

    /// A strand of this state that has a contact of this residual of the law.
    fn is_at_equilibrium(rest: Rest, residual: f64, law_residual: f64) -> bool {
        let material_point = MaterialPoint::on(0, 0.01);
        let [first, second] = [0, 1].map(|strand| ConstraintEnd { strand, material_point });
        let kind = ConstraintKind::Hair { normal: Vector3::x(), margin: 1e-3, compliance: 0.0 };
        let mut contact = StepConstraint::new(first, Some(second), kind, Vector3::zeros());
        contact.standing.law_residual = law_residual;
        let island = Island { constraints: vec![contact], ..Island::default() };
        let attachment = Attachment { constraint: 0, second: false, material_point, modelled: true };
        let strand = ConstrainedStrand { rest, residual, attachments: vec![attachment], ..ConstrainedStrand::default() };
        strand.is_at_equilibrium(&island, TOLERANCE, RESIDUAL)
    }

    #[test]
    fn a_strand_is_at_equilibrium_by_itself_if_it_and_its_contacts_are_within_the_tolerances_or_it_rests() {
        assert!(is_at_equilibrium(Rest::Active, 9e-7, 9e-5));
        for residual in [2e-6, f64::NAN, f64::INFINITY] {
            assert!(!is_at_equilibrium(Rest::Active, residual, 9e-5), "{residual}");
        }
        assert!(is_at_equilibrium(Rest::Resting, 2e-6, 9e-5));
        // Its forces are rough ones.
        assert!(!is_at_equilibrium(Rest::Active, 9e-7, 1e-3));
    }
}
