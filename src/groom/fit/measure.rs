//! Distances between a strand and its samples.

use super::samples::Sample;
use super::shape::Shape;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, PointState, element_states};
use crate::rod::segment;

/// Distances relative to the length.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Errors {
    /// At equal arclength, over the samples.
    pub root_mean_square: f64,
    /// The largest at equal arclength.
    pub largest: f64,
    /// The largest distance from the centreline.
    pub farthest: f64,
    /// Root mean square of the angles to the wanted normals, rad.
    pub frames: f64,
}

/// Steps towards the nearest place of the centreline.
const STEPS: usize = 4;

/// Measures all of them.
pub(super) fn errors(shape: &Shape, samples: &[Sample]) -> Errors {
    let mut elements: Vec<ElementState<f64>> = Vec::with_capacity(shape.rows.len());
    element_states(shape.root.0, (0..shape.rows.len()).map(|index| shape.length(index)), &shape.rows, &mut elements);
    let (mut sum, mut largest, mut farthest, mut angles) = (0.0, 0.0_f64, 0.0_f64, 0.0);
    let mut index = 0;
    for sample in samples {
        index = element_at(shape, index, sample.arclength);
        let (left, element) = (shape.nodes[index], &elements[index]);
        let point = element.point(sample.arclength - left);
        let off = (sample.target - point.position).norm_squared();
        sum += off;
        largest = largest.max(off);
        if off > farthest {
            farthest = farthest.max(nearest(shape, &elements, sample, index));
        }
        if let Some(wanted) = sample.normal {
            angles += angle_to(wanted, element, &frame_at(element, &point)).powi(2);
        }
    }
    let count = samples.len() as f64;
    Errors {
        root_mean_square: (sum / count).sqrt(),
        largest: largest.sqrt(),
        farthest: farthest.sqrt(),
        frames: (angles / count).sqrt(),
    }
}

/// The material frame at a point of an element, in the axes of the element's left end.
pub(super) fn frame_at(element: &ElementState<f64>, point: &PointState<f64>) -> Mat3<f64> {
    segment::frame(element.kappa.scale(point.s), element.kappa_squared * point.s * point.s, &point.c)
}

/// The angle about the tangent from n1 of such a frame to a target normal, rad.
pub(super) fn angle_to(wanted: Vec3<f64>, element: &ElementState<f64>, here: &Mat3<f64>) -> f64 {
    let wanted = element.frame_left.apply_transposed(wanted);
    wanted.dot(here.column(2)).atan2(wanted.dot(here.column(1)))
}

/// The element that holds an arclength, searched from element `index`.
fn element_at(shape: &Shape, mut index: usize, arclength: f64) -> usize {
    while index + 1 < shape.rows.len() && arclength > shape.nodes[index + 1] {
        index += 1;
    }
    while index > 0 && arclength < shape.nodes[index] {
        index -= 1;
    }
    index
}

/// The squared distance of a sample from the centreline, downhill from its own arclength.
fn nearest(shape: &Shape, elements: &[ElementState<f64>], sample: &Sample, mut index: usize) -> f64 {
    let (mut arclength, mut least) = (sample.arclength, f64::INFINITY);
    for _ in 0..STEPS {
        index = element_at(shape, index, arclength);
        let element = &elements[index];
        let point = element.point(arclength - shape.nodes[index]);
        let off = sample.target - point.position;
        least = least.min(off.norm_squared());
        let tangent = element.frame_left.apply(frame_at(element, &point).column(0));
        arclength = (arclength + off.dot(tangent)).clamp(0.0, 1.0);
    }
    least
}
