//! The depth of contacts between strands, and whether the strands are still there, from the points where the strands are nearest.

use super::constrained_strand::ConstrainedStrand;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, StepConstraint};
use crate::contact::contact_point::StrandCurve;
use crate::contact::narrow_phase::helix_distance::{Arc, closest};
use crate::step::constrained::step::ConstrainedStep;

/// The largest number of moves from element to element.
const MAX_HOPS: usize = 8;

/// Strands that have come through each other are as deep as this many tolerances at least, however thin they are.
const THROUGH: f64 = 4.0;

/// The depth of a contact, m; zero or below if the surfaces are apart. A contact between strands keeps the points and the
/// normal that the search found, which have slid apart by the end of a step: a depth of more than `tolerance` is therefore
/// measured between the nearest points of the strands near these. Points that have come to the other side are as deep as strands
/// can be: by the sum of their radii, less the overlap that they are permitted.
pub fn depth(constraint: &StepConstraint, strands: &[ConstrainedStrand], tolerance: f64) -> f64 {
    let depth = -constraint.gap;
    let (ConstraintKind::Hair { margin, .. }, Some(second)) = (constraint.kind, constraint.second) else { return depth };
    if depth <= tolerance {
        return depth;
    }
    if depth >= margin {
        return depth.min(deepest_possible(margin, tolerance));
    }
    margin - distance([constraint.first, second], strands)
}

/// How deep strands that keep a distance of `margin` (m) can be in each other, m.
pub fn deepest_possible(margin: f64, tolerance: f64) -> f64 {
    margin.max(THROUGH * tolerance)
}

/// Whether the strands of a contact that holds are no longer there: where they are nearest, near its points, their surfaces are further
/// apart than the sum of their radii and `tolerance`. What still presses them then is a plane that is not between them.
pub fn has_departed(constraint: &StepConstraint, strands: &[ConstrainedStrand], tolerance: f64) -> bool {
    let (ConstraintKind::Hair { margin, .. }, Some(second)) = (constraint.kind, constraint.second) else { return false };
    // Between the centrelines.
    let far = 2.0 * margin.max(0.0) + tolerance;
    let ends = [constraint.first, second];
    let [a, b] = ends.map(|end| ConstrainedStep::place(strands[end.strand as usize].step.now(), &end.material_point));
    constraint.gap >= -tolerance && (a - b).norm_squared() > far * far && distance(ends, strands) > far
}

/// The distance of two strands where they are nearest, near these points of them, m.
fn distance(ends: [ConstraintEnd; 2], strands: &[ConstrainedStrand]) -> f64 {
    let strands = ends.map(|end| &strands[end.strand as usize]);
    let curves = strands.map(|strand| strand.path().now);
    let [a, b] = strands.map(|strand| strand.contact.wisp());
    let held = a.held_length(&b, (curves[0].left_end(0) - curves[1].left_end(0)).norm());
    let without_contact = [a, b].map(|wisp| wisp.exempt.max(held));
    nearest_distance(curves, without_contact, ends.map(|end| (end.material_point.element, end.material_point.s)))
}

/// The least distance of two curves beyond the lengths `without_contact` at their roots (m), near these two points (element,
/// arclength in it, m). Ends count.
fn nearest_distance(curves: [StrandCurve; 2], without_contact: [f64; 2], mut places: [(usize, f64); 2]) -> f64 {
    let mut hops = 0;
    loop {
        let arcs = [0, 1].map(|k| {
            let (curve, element) = (curves[k], places[k].0);
            let length = curve.elements[element].length;
            let begin = without_contact[k] - curve.along(element, 0.0);
            Arc { curve, element, s: [begin.clamp(0.0, length), length] }
        });
        let pair = closest(&arcs[0], &arcs[1], places.map(|place| place.1), [false; 2]);
        let found = [0, 1].map(|k| (arcs[k].element, pair.s[k]));
        // Where the distance still falls at the end of an arc, the next arc follows.
        places = [0, 1].map(|k| {
            let (element, s) = found[k];
            let elements = curves[k].elements;
            if s >= arcs[k].s[1] && pair.slope[k] < 0.0 && element + 1 < elements.len() {
                (element + 1, 0.0)
            } else if s <= 0.0 && arcs[k].s[0] == 0.0 && pair.slope[k] > 0.0 && element > 0 {
                (element - 1, elements[element - 1].length)
            } else {
                (element, s)
            }
        });
        hops += 1;
        if places == found || hops == MAX_HOPS {
            return pair.apart.norm();
        }
    }
}
