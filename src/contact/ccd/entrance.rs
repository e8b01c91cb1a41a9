//! Where a straight way enters a body, found by sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996): steps as long as the
//! distance from the surface allows.

use nalgebra::Vector3;

use crate::contact::shape::{Shape, Surface};

/// Two surfaces whose normals have a larger cosine face the same way.
const SAME_WAY: f64 = 0.5;

/// A place is inside that is deeper than this part of the way: one that slides along a surface is not.
const INSIDE: f64 = 0.02;

/// The most steps along a way.
const STEPS: usize = 40;

/// What is known of a way's end.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) enum WayEnd {
    /// How far the surface is, m, and its normal there.
    At(f64, Vector3<f64>),
    /// The surface is no nearer than this, m.
    NoNearer(f64),
}

/// What a straight way leads to.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::contact) struct Way {
    /// The surface's distance from where it begins, m, where that had to be known.
    pub start: Option<f64>,
    /// The place where it enters the shape, and the surface that is nearest there.
    pub entrance: Option<(Vector3<f64>, Surface)>,
}

/// The straight way between two points (m, the shape's axes), to a shape grown by `margin` (m). It enters nowhere if it begins inside or leads
/// past the shape, or if what is nearest to its `end` faces the same way.
pub(in crate::contact) fn way(shape: &Shape, [from, to]: [Vector3<f64>; 2], margin: f64, end: WayEnd) -> Way {
    let along = to - from;
    let length = along.norm();
    let reach = shape.distance_slope() * length;
    let at = |place: Vector3<f64>| shape.closest_or_least(place, margin + reach);
    let gap =
        |found: &Result<Surface, f64>| found.as_ref().map_or_else(|at_least| *at_least, |surface| surface.distance) - margin;
    let (WayEnd::At(least, _) | WayEnd::NoNearer(least)) = end;
    // From farther away than this no way of its length touches the shape and ends this near to it.
    let Ok(first) = shape.closest_or_least(from, 2.0 * margin + reach - least) else { return Way::default() };
    let outside = Way { start: Some(first.distance), entrance: None };
    let (inside, least_step) = (INSIDE * length, length / STEPS as f64);
    if first.distance - margin < -inside {
        return outside;
    }
    let (last_gap, last_normal) = match end {
        WayEnd::At(distance, normal) => (distance - margin, Some(normal)),
        WayEnd::NoNearer(_) => {
            let last = at(to);
            (gap(&last), last.ok().map(|surface| surface.normal))
        }
    };
    let faces_last = |surface: &Surface| last_normal.is_some_and(|last| surface.normal.dot(&last) > SAME_WAY);
    if first.distance - margin + last_gap > reach || faces_last(&first) {
        return outside;
    }
    let mut gone = ((first.distance - margin) / shape.distance_slope()).max(least_step);
    while gone < length {
        let place = from + along * (gone / length);
        let here = at(place);
        if gap(&here) < -inside {
            return Way { entrance: here.ok().filter(|surface| !faces_last(surface)).map(|surface| (place, surface)), ..outside };
        }
        gone += (gap(&here) / shape.distance_slope()).max(least_step);
    }
    outside
}
