//! Ellipsoid about the origin, along the axes: its exact nearest point.
//!
//! The nearest point x to y solves x_i = e_i² y_i / (t + e_i²) with the one t above −e_min² at which x lies on the surface, Σ (x_i/e_i)² = 1
//! (Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", 2013). With w = t + e_min² nothing cancels near the
//! pole at w = 0, and Newton's iteration on 1/‖x/e‖ − 1, which is nearly straight in w, converges from the left without leaving it (the
//! secular equation of trust regions: Moré and Sorensen, 1983).

use nalgebra::Vector3;

use crate::contact::shape::Surface;

/// Nearest point of the ellipsoid of semi-axes `e`. Where several are nearest (from the middle), one of them.
pub(in crate::contact::shape) fn closest(e: &Vector3<f64>, point: Vector3<f64>) -> Surface {
    let y = point.abs();
    let shortest = e.imin();
    let squares = e.component_mul(e);
    let apart = Vector3::from_fn(|axis, _| squares[axis] - squares[shortest]);
    let mut x = on_surface(e, &y, &squares, &apart, shortest);
    for axis in 0..3 {
        x[axis] = x[axis].copysign(point[axis]);
    }
    let normal = Vector3::from_fn(|axis, _| x[axis] / squares[axis]).normalize();
    Surface::smooth(x, normal, (point - x).dot(&normal))
}

/// The nearest point, for a point in the first octant.
fn on_surface(e: &Vector3<f64>, y: &Vector3<f64>, squares: &Vector3<f64>, apart: &Vector3<f64>, shortest: usize) -> Vector3<f64> {
    if y[shortest] == 0.0 {
        // In the plane across the shortest axis the pole may have no residue: then w = 0, and the surface is left along that axis.
        let mut x = Vector3::zeros();
        let mut sum = 0.0;
        for axis in 0..3 {
            if y[axis] > 0.0 {
                x[axis] = if apart[axis] > 0.0 { squares[axis] * y[axis] / apart[axis] } else { f64::INFINITY };
                sum += (x[axis] / e[axis]).powi(2);
            }
        }
        if sum < 1.0 {
            x[shortest] = e[shortest] * (1.0 - sum).sqrt();
            return x;
        }
    }
    // ‖x/e‖ at w, and half the derivative of its square.
    let norm = |w: f64| {
        let (mut square, mut slope) = (0.0, 0.0);
        for axis in 0..3 {
            if y[axis] > 0.0 {
                let below = w + apart[axis];
                let part = (e[axis] * y[axis] / below).powi(2);
                square += part;
                slope -= part / below;
            }
        }
        (square.sqrt(), slope)
    };
    // Each term alone is at most 1 at the root, so the root is right of the largest of these; and left of ‖e y‖.
    let mut low = (0..3).fold(0.0, |low: f64, axis| low.max(e[axis] * y[axis] - apart[axis]));
    let mut high = e.component_mul(y).norm();
    let mut w = low;
    for _ in 0..60 {
        let (length, slope) = norm(w);
        if length >= 1.0 {
            low = w
        } else {
            high = w
        }
        // Newton on 1/‖x/e‖ − 1, whose derivative is −slope/‖x/e‖³.
        let mut next = w + (1.0 - 1.0 / length) * length.powi(3) / -slope;
        if !(next >= low && next <= high) {
            next = 0.5 * (low + high);
        }
        let done = (next - w).abs() <= 2e-16 * next;
        w = next;
        if done {
            break;
        }
    }
    let x = Vector3::from_fn(|axis, _| if y[axis] > 0.0 { squares[axis] * y[axis] / (w + apart[axis]) } else { 0.0 });
    // Onto the surface to rounding.
    x / x.component_div(e).norm()
}
