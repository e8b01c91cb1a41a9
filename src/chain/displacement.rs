//! How the points move, to first order, when the curvatures change: J δκ, in one pass from root to tip.

use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::segment;

/// Calls `emit(point index, displacement)` for every quadrature point, world axes; the root does not move.
pub fn for_each_point(kinematics: &Kinematics<f64>, change: &[[f64; 3]], mut emit: impl FnMut(usize, Vec3<f64>)) {
    // Rotation and displacement of the element's left end, in the axes of that end.
    let (mut psi, mut rho) = (Vec3::<f64>::zero(), Vec3::<f64>::zero());
    for (index, element) in kinematics.elements.iter().enumerate() {
        let delta = Vec3(change[index]);
        let gradient = |s: f64, c: &crate::math::entire::Stumpff<f64>| {
            segment::chord_gradient(element.kappa.scale(s), element.kappa_squared * (s * s), c).apply(delta).scale(s * s)
        };
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let moved = rho + psi.cross(point.local) + gradient(point.s, &point.c);
            emit(p, element.frame_left.apply(moved));
        }
        let (theta, z) = (element.kappa.scale(element.length), element.kappa_squared * (element.length * element.length));
        let turned = psi + segment::mean_frame(theta, z, &element.c).apply(delta).scale(element.length);
        let moved = rho + psi.cross(element.end) + gradient(element.length, &element.c);
        psi = element.turn.apply_transposed(turned);
        rho = element.turn.apply_transposed(moved);
    }
}
