//! The largest number of contacts of a strand. The cost and memory of a strand's model grow with the square of that number:
//! hair left in a heap of itself would have thousands. The deepest are kept.

use super::constrained_strand::ConstrainedStrand;
use super::island::Island;
use crate::contact::constraint::step_constraint::StepConstraint;

/// The largest mean number of contacts per element of a strand.
const MAX_PER_ELEMENT: usize = 12;
/// The number to which it is reduced if time is short.
const MIN_PER_ELEMENT: usize = 2;
/// The budget has to last for this many iterations.
const ITERATIONS: u64 = 6;

/// Removes the least deep contacts of strands that have too many, and marks these strands as having undetected contacts.
/// Islands that have constraints are dissolved before any is removed. `left`: the work that is left.
pub fn thin_out(constraints: &mut Vec<StepConstraint>, strands: &mut [ConstrainedStrand], islands: &mut [Island], left: u64) {
    strands.iter_mut().for_each(|constrained| constrained.constraint_count = constrained.attachments.len());
    for end in constraints.iter().flat_map(StepConstraint::ends) {
        strands[end.strand as usize].constraint_count += 1;
    }
    let room = |constrained: &ConstrainedStrand, most: usize| most * constrained.elements();
    let work = |most: usize| -> u64 {
        strands
            .iter()
            .map(|constrained| 2 * constrained.half_work_with(constrained.constraint_count.min(room(constrained, most))))
            .sum()
    };
    let mut most = MAX_PER_ELEMENT;
    while most > MIN_PER_ELEMENT && work(most) > left / ITERATIONS {
        most -= 1;
    }
    if strands.iter().all(|constrained| constrained.constraint_count <= room(constrained, most)) {
        return;
    }
    islands.iter_mut().for_each(|island| island.dissolve(strands, constraints));
    // Bilateral constraints first.
    let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
    let key = |index: &u32| (constraints[*index as usize].is_contact(), constraints[*index as usize].gap);
    order.sort_by(|a, b| {
        let (a, b) = ((key(a), a), (key(b), b));
        a.0.0.cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1)).then(a.1.cmp(b.1))
    });
    strands.iter_mut().for_each(|constrained| constrained.constraint_count = 0);
    let mut stays = vec![false; constraints.len()];
    for index in order {
        let constraint = &constraints[index as usize];
        let has_room = |constrained: &ConstrainedStrand| constrained.constraint_count < room(constrained, most);
        if !constraint.is_contact() || constraint.ends().all(|end| has_room(&strands[end.strand as usize])) {
            constraint.ends().for_each(|end| strands[end.strand as usize].constraint_count += 1);
            stays[index as usize] = true;
        } else {
            constraint.ends().for_each(|end| strands[end.strand as usize].has_undetected = true);
        }
    }
    let mut index = 0;
    constraints.retain(|_| {
        index += 1;
        stays[index - 1]
    });
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::chain::load::MaterialPoint;
    use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind};
    use crate::coupled::constrained_strand::Attachment;

    /// A strand without elements has room for no contact: neither for a new one nor for that of its island.
    #[test]
    fn contacts_of_islands_are_among_those_that_are_too_many() {
        let first = ConstraintEnd { strand: 0, material_point: MaterialPoint { element: 0, s: 0.0, lever: [0.0; 3] } };
        let kind = ConstraintKind::Body {
            body: 0,
            feature: 0,
            normal: Vector3::z(),
            side: Vector3::z(),
            point: Vector3::zeros(),
            carried: Vector3::zeros(),
            margin: 1e-4,
            friction: [1.0; 2],
        };
        let contact = StepConstraint::new(first, None, kind, Vector3::zeros());
        let mut strands = [ConstrainedStrand::default()];
        let attachment = Attachment { constraint: 0, second: false, material_point: first.material_point, modelled: true };
        strands[0].attachments.push(attachment);
        let mut islands = [Island { strands: vec![0], constraints: vec![contact], ..Island::default() }];
        let mut constraints = vec![contact];
        thin_out(&mut constraints, &mut strands, &mut islands, u64::MAX);
        assert!(constraints.is_empty() && islands[0].constraints.is_empty());
        assert!(islands[0].strands.is_empty() && strands[0].attachments.is_empty() && strands[0].has_undetected);
    }
}
