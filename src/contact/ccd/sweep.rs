//! Collisions of a moving piece of a strand.
//!
//! Conservative advancement (Mirtich 1996) against a convex piece (a convex shape, or one triangle of a mesh): a plane across
//! the shortest distance separates the two, and until an end of the piece of strand has come through the plane there is no
//! contact. Sliding costs nothing, and a passing piece of strand is followed in a few steps.

use nalgebra::Vector3;

use crate::contact::narrow_phase::descent::{self, Sample};
use crate::contact::shape::Surface;

/// A straight piece of a strand whose ends move straight from the start of the step to now.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct MovingChord {
    /// Its ends at the start.
    pub before: [Vector3<f64>; 2],
    /// Its ends now.
    pub after: [Vector3<f64>; 2],
}

/// A nearest point found during the motion.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Near<T> {
    /// Unit vector from the body to the strand.
    pub normal: Vector3<f64>,
    /// Distance, m.
    pub distance: f64,
    /// The largest speed of the body along the normal, m per step.
    pub coming: f64,
    /// What it is.
    pub what: T,
}

/// Where a moving piece of strand comes near.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Hit<T> {
    /// Fraction of the step.
    pub time: f64,
    /// Position along the piece, 0 to 1.
    pub place: f64,
    /// What was near.
    pub near: Near<T>,
}

/// The largest number of advances; a piece that is still advancing then grazes, which counts as a hit.
const ADVANCES: usize = 64;

/// The first time up to `latest` at which the piece comes within `level` of something convex. `ask(point, time)` returns its
/// nearest point. Distances may be negative inside; if the piece begins inside, that point is the hit. `None` if it never comes
/// near, or begins at distance zero, where no side is known.
pub(in crate::contact) fn first_hit<T: Copy>(
    chord: &MovingChord,
    level: f64,
    latest: f64,
    mut ask: impl FnMut(&Vector3<f64>, f64) -> Near<T>,
) -> Option<Hit<T>> {
    let mut time = 0.0;
    let velocity = [chord.after[0] - chord.before[0], chord.after[1] - chord.before[1]];
    for advance in 0..ADVANCES {
        let ends = [chord.before[0] + velocity[0] * time, chord.before[1] + velocity[1] * time];
        let mut nearest = nearest_along(&ends, 0.05 * level, |point| ask(point, time));
        if nearest.found.distance == 0.0 && time == 0.0 {
            return None;
        }
        if nearest.found.distance <= 1.1 * level || advance + 1 == ADVANCES {
            // The normal is kept, and its lever may be long: once more, with a finer tolerance.
            nearest = nearest_along(&ends, 1e-6 * level, |point| ask(point, time));
            return Some(Hit { time, place: nearest.s, near: nearest.found });
        }
        let near = nearest.found;
        // The ends' heights above the plane through the body's nearest point, and the time at which the first comes down to the
        // level.
        let foot = ends[0] + (ends[1] - ends[0]) * nearest.s - near.normal * near.distance;
        let mut next = f64::INFINITY;
        for (end, velocity) in ends.iter().zip(&velocity) {
            let height = near.normal.dot(&(end - foot));
            let approach = near.coming - near.normal.dot(velocity);
            if approach > 0.0 {
                // The nearest place is known to a twentieth of the level.
                next = next.min((height - 0.9 * level).max(0.0) / approach);
            }
        }
        time += next;
        if time > latest {
            return None;
        }
    }
    None
}

/// The point of a straight piece that is nearest to something convex, to `tolerance`.
fn nearest_along<T: Copy>(
    ends: &[Vector3<f64>; 2],
    tolerance: f64,
    mut ask: impl FnMut(&Vector3<f64>) -> Near<T>,
) -> Sample<Near<T>> {
    let along = ends[1] - ends[0];
    let mut sample = |u: f64| {
        let near = ask(&(ends[0] + along * u));
        Sample { s: u, value: near.distance, slope: near.normal.dot(&along), found: near }
    };
    let (low, high) = (sample(0.0), sample(1.0));
    if low.slope < 0.0 && high.slope > 0.0 {
        descent::lowest(low, high, tolerance, |u| Some(sample(u)))
    } else if low.value <= high.value {
        low
    } else {
        high
    }
}

/// For bodies known by their distance alone: collisions of a strand's nodes on their straight paths. Advances by the distance,
/// but at least by `least` metres, since nothing thinner is there. Each node has its arclength, its path, and the length of the path's
/// last part on which nothing is. `ask(point)` returns the surface, or a safe clearance. Appends arclength and surface.
pub(in crate::contact) fn along_nodes(
    nodes: impl Iterator<Item = (f64, Vector3<f64>, Vector3<f64>, f64)>,
    level: f64,
    least: f64,
    ask: impl Fn(Vector3<f64>) -> Result<Surface, f64>,
    hits: &mut Vec<(f64, Surface)>,
) {
    for (s, before, now, clear) in nodes {
        let distance = (now - before).norm();
        let mut gone = 0.0;
        while gone <= distance - clear {
            let point = if distance > 0.0 { before + (now - before) * (gone / distance) } else { before };
            let step = match ask(point) {
                Ok(surface) => {
                    if surface.distance <= level {
                        if gone > 0.0 || surface.distance > 0.0 {
                            hits.push((s, surface));
                        }
                        break;
                    }
                    surface.distance - level
                }
                Err(clearance) => clearance - level,
            };
            gone += step.max(least);
        }
    }
}
