//! Contacts of strands with permitted overlaps: their surfaces are nearer to their centrelines there.

use crate::chain::load::MaterialPoint;
use crate::contact::contact_point::{ContactPoint, Partner};
use crate::contact::permitted_overlap::PermittedOverlap;
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

/// The same for contacts between strands.
pub fn reduce_hair_contacts(strands: &[ConstrainedStrand], activation: f64, contacts: &mut Vec<ContactPoint>) {
    contacts.retain_mut(|contact| {
        let Partner::Strand(other) = contact.partner else { return true };
        let ends = [contact.point, other].map(|place| (&strands[place.strand as usize], place));
        let permitted_overlaps = ends.map(|(constrained, _)| constrained.permitted_overlap.as_deref());
        if permitted_overlaps == [None, None] {
            return true;
        }
        let radius = |end: usize| {
            let (constrained, place) = ends[end];
            let fraction = |permitted_overlap: &PermittedOverlap| {
                permitted_overlap.wisp_fraction(constrained.path().now.along(place.element as usize, place.s))
            };
            permitted_overlaps[end].map_or(1.0, fraction) * constrained.contact.wisp_radius
        };
        let [a, b] = ends.map(|(constrained, place)| constrained.path().now.position(place.element as usize, place.s));
        // A knot may leave less of the radii.
        contact.gap = contact.gap.max(contact.normal.dot(&(a - b)) - (radius(0) + radius(1)));
        contact.gap <= activation
    });
}

/// The distance of a strand's surface from the centreline for bodies, m; negative where the permitted overlap exceeds its
/// radius.
pub fn radius(constrained: &ConstrainedStrand, material_point: &MaterialPoint) -> f64 {
    let permitted_overlap = constrained.permitted_overlap.as_deref();
    constrained.contact.radius
        - permitted_overlap.map_or(0.0, |permitted_overlap| permitted_overlap.sunk(constrained.along(material_point)))
}
