//! The nearest place of a tool's body to a straight strand through a point: as the tool moves on, the strand slides along it and
//! around it.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::contact::shape::Shape;
use crate::math::frame::Frame;

/// A body of the tool.
#[derive(Debug, Clone)]
pub(super) struct Tooth {
    /// Its pose in the handle's frame.
    pub place: Frame,
    pub shape: Arc<Shape>,
}

/// A surface near a strand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Unit, world, towards the strand.
    pub normal: Vector3<f64>,
    /// The body's point, world.
    pub point: Vector3<f64>,
    /// From there to the strand's centreline, m.
    pub distance: f64,
}

/// Surfaces farther away than this are ignored, m.
const WITHIN: f64 = 0.02;
/// The strand counts as straight within this distance of the point, m.
const STRAIGHT: f64 = 0.01;
/// The first step along the strand for the steepest possible fall of the distance, m; the number of further steps; and the slope
/// that counts as level.
const FIRST: f64 = 5e-4;
const TRIES: usize = 12;
const LEVEL: f64 = 0.01;
/// At its ends the line is not nearest if the distance falls more steeply there.
const STEEP: f64 = 0.1;

impl Tooth {
    /// The surface nearest to the straight line through `at` along `tangent` (unit) with the handle at `handle`; the line reaches
    /// this far (m) back and ahead. `None` if it is far away, or nearest beyond the line's ends.
    pub fn nearest(&self, handle: &Frame, at: Vector3<f64>, tangent: Vector3<f64>, reach: [f64; 2]) -> Option<Near> {
        let frame = handle.compose(&self.place);
        let back = frame.rotation.inverse();
        let (at, tangent) = (back * (at - frame.origin), back * tangent);
        let mut best = self.shape.closest(at, WITHIN)?;
        let mut slope = best.normal.dot(&tangent);
        let (mut along, mut step) = (0.0, -slope * FIRST);
        for _ in 0..TRIES {
            let next = (along + step).clamp(-reach[0].min(STRAIGHT), reach[1].min(STRAIGHT));
            if slope.abs() <= LEVEL || next == along {
                break;
            }
            let Some(found) = self.shape.closest(at + tangent * next, WITHIN) else { break };
            let found_slope = found.normal.dot(&tangent);
            if found.distance > best.distance {
                // Far past it.
                step *= 0.25;
                continue;
            }
            let change = found_slope - slope;
            // Where the distance curves upward: step to where it is level, unless that is far.
            let bend = change * (next - along);
            step = if bend > 0.0 {
                (-found_slope * (next - along) / change).clamp(-3.0 * step.abs(), 3.0 * step.abs())
            } else {
                step
            };
            (best, slope, along) = (found, found_slope, next);
        }
        let end = if slope > 0.0 { -reach[0].min(STRAIGHT) } else { reach[1].min(STRAIGHT) };
        if slope.abs() > STEEP && along == end {
            return None;
        }
        let (normal, point) = (frame.rotation * best.normal, frame.origin + frame.rotation * best.point);
        Some(Near { normal, point, distance: best.distance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_past_a_tooth_is_nearest_where_it_crosses_it() {
        let shape = Arc::new(Shape::new_capsule(Vector3::zeros(), Vector3::x() * 0.05, 1e-3).unwrap());
        let tooth = Tooth { place: Frame { origin: Vector3::y() * 0.01, ..Frame::default() }, shape };
        let handle = Frame { origin: Vector3::z() * 0.3, ..Frame::default() };
        for off in [-4e-3, -1e-3, 0.0, 3e-4, 2e-3, 6e-3] {
            // Along z, 0.2 mm in front of the tooth in y.
            let at = Vector3::new(0.02, 0.01 - 1.2e-3, 0.3 + off);
            let near = tooth.nearest(&handle, at, Vector3::z(), [0.02; 2]).unwrap();
            assert!((near.distance - 2e-4).abs() < 2e-5, "{off}: {near:?}");
            assert!(near.normal.dot(&-Vector3::y()) > 0.999, "{off}: {near:?}");
        }
    }
}
