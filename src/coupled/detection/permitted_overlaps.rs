//! Contacts with bodies of strands with permitted overlaps: their surfaces are nearer to their centrelines there.

use crate::chain::load::MaterialPoint;
use crate::coupled::constrained_strand::ConstrainedStrand;

/// Reduces a strand's surface in its contacts with bodies, and removes contacts that are then further away than `within` (m).
pub fn reduce_body_contacts(constrained: &mut ConstrainedStrand, within: f64) {
    let Some(permitted_overlap) = constrained.permitted_overlap.clone() else { return };
    let mut found = std::mem::take(&mut constrained.found);
    let path = constrained.path();
    found.retain_mut(|contact| {
        contact.gap += permitted_overlap.sunk(path.now.along(contact.point.element as usize, contact.point.s));
        contact.gap <= within
    });
    constrained.found = found;
    constrained.root_gap += permitted_overlap.sunk(0.0);
}

/// The distance of a strand's surface from the centreline for bodies, m; negative where the permitted overlap exceeds its
/// radius.
pub fn radius(constrained: &ConstrainedStrand, material_point: &MaterialPoint) -> f64 {
    let permitted_overlap = constrained.permitted_overlap.as_deref();
    constrained.contact.radius
        - permitted_overlap.map_or(0.0, |permitted_overlap| permitted_overlap.sunk(constrained.along(material_point)))
}
