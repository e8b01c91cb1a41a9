//! Generalised forces of forces on the points, f = Σ Jᵀ f_p: one pass from tip to root.

use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::segment;

/// Σ Jᵀ f_p for every curvature of every element; `point_force` gives the force on each quadrature point, world axes.
pub fn generalised(kinematics: &Kinematics<f64>, point_force: impl Fn(usize) -> Vec3<f64>) -> Vec<[f64; 3]> {
    let mut out = vec![[0.0; 3]; kinematics.elements.len()];
    // Force and moment about the element's right end of everything downstream, in the axes of that end.
    let (mut force, mut moment) = (Vec3::<f64>::zero(), Vec3::<f64>::zero());
    for (index, element) in kinematics.elements.iter().enumerate().rev() {
        // Into the axes of the element's left end.
        let (f, m) = (element.turn.apply(force), element.turn.apply(moment));
        let theta = element.kappa.scale(element.length);
        let z = element.kappa_squared * element.length * element.length;
        let psi = segment::mean_frame(theta, z, &element.c).scale(element.length);
        let jacobian = segment::chord_gradient(theta, z, &element.c).scale(element.length * element.length);
        let mut sum = psi.apply_transposed(m) + jacobian.apply_transposed(f);
        (force, moment) = (f, m + element.end.cross(f));
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let f = element.frame_left.apply_transposed(point_force(p));
            let z = element.kappa_squared * point.s * point.s;
            let j = segment::chord_gradient(element.kappa.scale(point.s), z, &point.c).scale(point.s * point.s);
            sum += j.apply_transposed(f);
            force += f;
            moment += point.local.cross(f);
        }
        out[index] = sum.0;
    }
    out
}
