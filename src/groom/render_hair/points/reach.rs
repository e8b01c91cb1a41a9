//! The distance around a guide within which no body lies: it spares most of a groom's points further checks.

use std::sync::atomic::{AtomicU64, Ordering};

use super::bodies::Placed;
use super::position::{Lane, STEP, lane};
use crate::groom::render_hair::guides::shape::{PLACE, Shape};

/// The free distance around each guide's points, computed when a strand first follows it.
#[derive(Debug, Default)]
pub(super) struct Reach {
    /// The evaluation to which a guide's row belongs.
    evaluations: Vec<u64>,
    /// Rows of squares, m²; 0 where every strand needs a check, infinite where none does.
    squares: Vec<f32>,
}

/// What the rows are computed from.
#[derive(Clone, Copy)]
pub(super) struct About<'a> {
    /// The evaluation: rows of another one belong to other guides and bodies.
    pub evaluation: u64,
    pub shape: &'a Shape,
    pub bodies: &'a [Placed<'a>],
    pub clearance: f32,
    pub stride: usize,
    /// Points per strand.
    pub count: usize,
    /// Floats per guide.
    pub size: usize,
}

impl Reach {
    /// A fresh number for an evaluation.
    pub fn new_evaluation() -> u64 {
        static LAST: AtomicU64 = AtomicU64::new(0);
        LAST.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// A guide's row; its root is at `root`.
    #[inline(always)]
    pub fn of(&mut self, guide: usize, root: [f32; 3], about: &About) -> &[f32] {
        let stride = about.stride;
        if self.evaluations.len() <= guide || self.evaluations[guide] != about.evaluation {
            self.measure(guide, root, about);
        }
        &self.squares[guide * stride..][..stride]
    }

    #[cold]
    fn measure(&mut self, guide: usize, root: [f32; 3], about: &About) {
        let About { evaluation, shape, bodies, clearance, stride, count, size } = *about;
        if self.evaluations.len() <= guide {
            self.evaluations.resize(guide + 1, 0);
            self.squares.resize((guide + 1) * stride, 0.0);
        }
        self.evaluations[guide] = evaluation;
        let places = &shape.rows[guide * size + PLACE * stride..][..3 * stride];
        for (k, square) in self.squares[guide * stride..][..stride].iter_mut().enumerate() {
            // The root stays, and padding is no point.
            if k == 0 || k >= count {
                *square = f32::INFINITY;
                continue;
            }
            let point = [0, 1, 2].map(|axis| root[axis] + places[axis * stride + k]);
            let room = bodies.iter().map(|body| body.room(point, clearance)).fold(f32::INFINITY, f32::min).max(0.0);
            *square = room * room;
        }
    }
}

/// Which of points `at` to `at` + [`STEP`] − 1 of rows of x, y and z are not within a guide's reach, one bit each.
#[inline(always)]
pub(super) fn beyond(rows: &[f32], guide: &[f32], root: [f32; 3], stride: usize, reach: &[f32], at: usize) -> u32 {
    let mut away: Lane = [0.0; STEP];
    for axis in 0..3 {
        let (points, guide) = (lane(&rows[axis * stride..][..stride], at), lane(&guide[axis * stride..][..stride], at));
        for k in 0..STEP {
            let apart = points[k] - (root[axis] + guide[k]);
            away[k] += apart * apart;
        }
    }
    let reach = lane(reach, at);
    let mut bits = 0;
    for k in 0..STEP {
        bits |= u32::from(away[k] >= reach[k]) << k;
    }
    bits
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;
    use crate::contact::shape::{DistanceGrid, Shape as Body};
    use crate::groom::render_hair::points::bodies::RenderBody;
    use crate::math::frame::Frame;

    #[test]
    fn points_that_a_guide_spares_are_clear_of_a_turned_ball_and_most_that_are_clear_are_spared() {
        let (cell, low, radius, clearance, thickness) = (0.005, Vector3::repeat(-0.15), 0.1, 0.003, 0.001);
        let node = |k: usize| Vector3::new((k % 61) as f64, (k / 61 % 61) as f64, (k / 3721) as f64) * cell + low;
        let values = (0..226_981).map(|k| (node(k).norm() - radius) as f32).collect();
        let grid = DistanceGrid::from_parts(low, cell, 0.05, [61; 3], values).expect("a grid");
        let shapes = [Body::new_grid(grid), Body::new_sphere(radius).expect("a sphere")];
        let mut seed = 1_u64;
        let mut noise = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (count, stride, clear_by) = (13, 16, clearance + thickness);
        for shape in &shapes {
            let rotation = UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0);
            let pose = Frame { origin: Vector3::new(1.0, -2.0, 0.5), rotation };
            let origin = Vector3::new(0.9, -2.1, 0.4);
            let bodies = [Placed::new(&RenderBody { thickness, ..RenderBody::new(shape, pose) }, &pose, origin)];
            let (mut spared, mut clear) = (0, 0);
            for evaluation in 1..200 {
                // A guide through and around the ball, its root at the origin; a strand within 2 cm of it, and some points far
                // off.
                let mut shape = Shape { rows: vec![0.0; 3 * stride], ..Shape::default() };
                let mut rows = vec![0.0; 3 * stride];
                let root = [0.1, 0.1, 0.1];
                for k in 0..count {
                    let point = Vector3::from_fn(|_, _| 0.5 * noise());
                    let apart = Vector3::from_fn(|_, _| if k == 5 { 0.5 } else { 0.04 } * noise());
                    for axis in 0..3 {
                        shape.rows[axis * stride + k] = point[axis] as f32;
                        rows[axis * stride + k] = (point + apart)[axis] as f32 + root[axis];
                    }
                }
                let about = About {
                    evaluation,
                    shape: &shape,
                    bodies: &bodies,
                    clearance: clearance as f32,
                    stride,
                    count,
                    size: 3 * stride,
                };
                let mut reach = Reach::default();
                let reach = reach.of(0, root, &about);
                for at in [0, 8] {
                    let bits = beyond(&rows, &shape.rows, root, stride, reach, at);
                    for k in (0..8).map(|k| at + k) {
                        let is_spared = bits >> (k - at) & 1 == 0;
                        if k == 0 || k >= count {
                            assert!(is_spared);
                            continue;
                        }
                        let place = Vector3::from_fn(|axis, _| f64::from(rows[axis * stride + k])) + origin - pose.origin;
                        let is_clear = place.norm() - radius > clear_by;
                        assert!(is_clear || !is_spared, "{place}");
                        (spared, clear) = (spared + u32::from(is_spared), clear + u32::from(is_clear));
                    }
                }
            }
            assert!(clear > 1500 && spared > clear * 2 / 3, "{spared} of {clear}");
        }
    }
}
