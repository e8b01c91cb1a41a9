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

/// The place where the straight way between two points (m, the shape's axes) enters the shape, grown by `margin` (m), and the surface that is
/// nearest there. None if the way begins inside or leads past it, or if what is nearest to its end faces the same way.
pub(in crate::contact) fn entered(shape: &Shape, [from, to]: [Vector3<f64>; 2], margin: f64) -> Option<(Vector3<f64>, Surface)> {
    let along = to - from;
    let length = along.norm();
    let reach = shape.distance_slope() * length;
    let at = |place: Vector3<f64>| shape.closest_or_least(place, margin + reach);
    let gap =
        |found: &Result<Surface, f64>| found.as_ref().map_or_else(|at_least| *at_least, |surface| surface.distance) - margin;
    let faces =
        |one: &Surface, other: &Result<Surface, f64>| other.as_ref().is_ok_and(|other| one.normal.dot(&other.normal) > SAME_WAY);
    let (first, last) = (at(from), at(to));
    let (inside, least_step) = (INSIDE * length, length / STEPS as f64);
    if gap(&first) < -inside || gap(&first) + gap(&last) > reach || first.as_ref().is_ok_and(|first| faces(first, &last)) {
        return None;
    }
    let mut gone = (gap(&first) / shape.distance_slope()).max(least_step);
    while gone < length {
        let place = from + along * (gone / length);
        let here = at(place);
        if gap(&here) < -inside {
            return here.ok().filter(|surface| !faces(surface, &last)).map(|surface| (place, surface));
        }
        gone += (gap(&here) / shape.distance_slope()).max(least_step);
    }
    None
}
