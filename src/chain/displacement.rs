//! How the points move, to first order, when the curvatures change: J δκ, in one pass from root to tip.

use crate::math::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, Kinematics};
use crate::rod::segment;

/// J δκ of a segment's own curvatures at arclength s, in its axes.
#[inline(always)]
fn own<T: Lane>(element: &ElementState<T>, delta: Vec3<T>, s: T, c: &Stumpff<T>) -> Vec3<T> {
    segment::chord_gradient(element.kappa.scale(s), element.kappa_squared * (s * s), c).apply(delta).scale(s * s)
}

/// Calls `emit(point index, displacement)` for every quadrature point, world axes; the root does not move.
#[inline(always)]
pub fn for_each_point<T: Lane>(kinematics: &Kinematics<T>, change: &[[T; 3]], mut emit: impl FnMut(usize, Vec3<T>)) {
    // Rotation and displacement of the element's left end, in the axes of that end.
    let (mut psi, mut rho) = (Vec3::<T>::zero(), Vec3::<T>::zero());
    for (index, element) in kinematics.elements.iter().enumerate() {
        let delta = Vec3(change[index]);
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let moved = rho + psi.cross(point.local) + own(element, delta, point.s, &point.c);
            emit(p, element.frame_left.apply(moved));
        }
        let (theta, z) = (element.kappa.scale(element.length), element.kappa_squared * (element.length * element.length));
        let turned = psi + segment::mean_frame(theta, z, &element.c).apply(delta).scale(element.length);
        let moved = rho + psi.cross(element.end) + own(element, delta, element.length, &element.c);
        psi = element.turn.apply_transposed(turned);
        rho = element.turn.apply_transposed(moved);
    }
}
