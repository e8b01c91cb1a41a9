//! Displacements of the points to first order in a change of the curvatures, J δκ: one pass from root to tip.

use crate::math::functions::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, Kinematics};
use crate::rod::segment;

/// The sum of the columns `axes` of `matrix`, each times its entry of `delta`.
#[inline(always)]
fn combine<T: Lane, const D: usize>(matrix: &Mat3<T>, delta: &[T; 3], axes: [usize; D]) -> Vec3<T> {
    let mut sum = matrix.column(axes[0]).scale(delta[axes[0]]);
    for i in 1..D {
        sum += matrix.column(axes[i]).scale(delta[axes[i]]);
    }
    sum
}

/// J δκ of a segment's own curvatures at arclength s, in its axes.
#[inline(always)]
fn own<T: Lane, const D: usize>(element: &ElementState<T>, delta: &[T; 3], axes: [usize; D], s: T, c: &Stumpff<T>) -> Vec3<T> {
    let gradient = segment::chord_gradient(element.kappa.scale(s), element.kappa_squared * (s * s), c);
    combine(&gradient, delta, axes).scale(s * s)
}

/// Calls `emit(point index, displacement)` for every quadrature point, world axes; the root does not move.
#[inline(always)]
pub fn for_each_point<T: Lane>(kinematics: &Kinematics<T>, change: &[[T; 3]], emit: impl FnMut(usize, Vec3<T>)) {
    for_each_point_along(kinematics, change, [0, 1, 2], emit);
}

/// The same where only the curvatures `axes` change.
#[inline(always)]
pub fn for_each_point_along<T: Lane, const D: usize>(
    kinematics: &Kinematics<T>,
    change: &[[T; 3]],
    axes: [usize; D],
    mut emit: impl FnMut(usize, Vec3<T>),
) {
    // Rotation and displacement of the element's left end, in the axes of that end.
    let (mut psi, mut rho) = (Vec3::<T>::zero(), Vec3::<T>::zero());
    for (index, element) in kinematics.elements.iter().enumerate() {
        let delta = &change[index];
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let moved = rho + psi.cross(point.local) + own(element, delta, axes, point.s, &point.c);
            emit(p, element.frame_left.apply(moved));
        }
        let (theta, z) = (element.kappa.scale(element.length), element.kappa_squared * (element.length * element.length));
        let turned = psi + combine(&segment::mean_frame(theta, z, &element.c), delta, axes).scale(element.length);
        let moved = rho + psi.cross(element.end) + own(element, delta, axes, element.length, &element.c);
        psi = element.turn.apply_transposed(turned);
        rho = element.turn.apply_transposed(moved);
    }
}
