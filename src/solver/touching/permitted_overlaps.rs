//! Touches of strands that may overlap what they touch: their surfaces are nearer to their centrelines there.

use crate::chain::load::MaterialPoint;
use crate::contact::held_strand::HeldStrand;
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::contact::touch::{Partner, Touch};
use crate::solver::strand::Strand;

/// Takes back the surface of a strand in its touches with bodies; those that are farther than `within` (m) then are none.
pub fn give_way_to_bodies(held: &mut HeldStrand, permitted_overlap: &PermittedOverlap, within: f64) {
    let mut found = std::mem::take(&mut held.found);
    let path = held.path();
    found.retain_mut(|touch| {
        touch.gap += permitted_overlap.sunk(path.now.along(touch.place.element as usize, touch.place.s));
        touch.gap <= within
    });
    held.found = found;
    held.root_gap += permitted_overlap.sunk(0.0);
}

/// The same for touches between strands.
pub fn give_way_to_hair(all: &[Strand], strands: &[HeldStrand], activation: f64, touches: &mut Vec<Touch>) {
    touches.retain_mut(|touch| {
        let Partner::Strand(other) = touch.partner else { return true };
        let ends = [touch.place, other].map(|place| (&strands[place.strand as usize], place));
        let permitted_overlaps = ends.map(|(held, _)| all[held.index as usize].permitted_overlap.as_deref());
        if permitted_overlaps == [None, None] {
            return true;
        }
        let radius = |end: usize| {
            let (held, place) = ends[end];
            let share = |permitted_overlap: &PermittedOverlap| {
                permitted_overlap.wisp_share(held.path().now.along(place.element as usize, place.s))
            };
            permitted_overlaps[end].map_or(1.0, share) * held.contact.wisp_radius
        };
        let [a, b] = ends.map(|(held, place)| held.path().now.position(place.element as usize, place.s));
        // A knot may have left less of the radii.
        touch.gap = touch.gap.max(touch.normal.dot(&(a - b)) - (radius(0) + radius(1)));
        touch.gap <= activation
    });
}

/// How far from the centreline a strand begins for bodies at a station, m; below zero where it may be in one by more than its radius.
pub fn radius(all: &[Strand], held: &HeldStrand, material_point: &MaterialPoint) -> f64 {
    let permitted_overlap = all[held.index as usize].permitted_overlap.as_deref();
    held.contact.radius - permitted_overlap.map_or(0.0, |permitted_overlap| permitted_overlap.sunk(held.along(material_point)))
}
