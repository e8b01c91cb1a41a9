//! The point of a strand that is nearest to a point, from one nearby.

use nalgebra::Vector3;

use crate::contact::contact_point::StrandCurve;

/// Newton steps at most.
const MAX_ITERATIONS: u32 = 50;

/// Where the distance to `target` is least near (`element`, `s`), across elements: element and arclength on it. The strand's ends count.
pub fn nearest(curve: &StrandCurve, mut element: usize, mut s: f64, target: Vector3<f64>) -> (usize, f64) {
    for _ in 0..MAX_ITERATIONS {
        let here = &curve.elements[element];
        let off = curve.position(element, s) - target;
        let tangent = curve.tangent(element, s);
        // d/ds of off·t is 1 + off·t′; where that is small or negative the nearest point is elsewhere, and half a step is safe.
        let bend = off.norm() * here.kappa_squared.sqrt();
        let shift = -off.dot(&tangent) / (1.0 + bend);
        let (next, last) = (s + shift, element + 1 == curve.elements.len());
        if next > here.length && !last {
            // No further than the next element's beginning at a time: its curve is another.
            (element, s) = (element + 1, 0.0);
        } else if next < 0.0 && element > 0 {
            element -= 1;
            s = curve.elements[element].length;
        } else {
            let clamped = next.clamp(0.0, here.length);
            let moved = (clamped - s).abs();
            s = clamped;
            if moved <= 1e-15 * here.length {
                break;
            }
        }
    }
    (element, s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::quadrature::Rule;
    use crate::math::vector::Mat3;
    use crate::rod::kinematics::Kinematics;

    #[test]
    fn the_nearest_point_is_across_the_strand_or_an_end() {
        let mut kinematics = Kinematics::default();
        let curvatures = [[3.0, 20.0, 0.0], [-5.0, 10.0, 8.0], [0.0, 0.0, 0.0], [2.0, -15.0, 4.0]];
        kinematics.update(&Mat3::identity(), &[0.02; 4], &curvatures, &Rule::gauss_legendre(4));
        let curve = StrandCurve { origin: Vector3::new(0.1, 0.2, 0.3), elements: &kinematics.elements };
        for (element, s) in [(0, 0.003), (1, 0.011), (2, 0.02), (3, 0.001), (3, 0.02)] {
            // A point off the curve across it, away from its centre of curvature by less than a radius.
            let across = curve.tangent(element, s).cross(&Vector3::z()).normalize();
            let target = curve.position(element, s) + across * 4e-3;
            let found = nearest(&curve, (element + 1) % 4, 0.01, target);
            let along = |(element, s): (usize, f64)| element as f64 * 0.02 + s;
            assert!((along(found) - along((element, s))).abs() < 1e-12, "{found:?} for {:?}", (element, s));
        }
        let beyond = curve.position(3, 0.02) + curve.tangent(3, 0.02) * 0.01;
        assert_eq!(nearest(&curve, 0, 0.0, beyond), (3, 0.02));
    }
}
