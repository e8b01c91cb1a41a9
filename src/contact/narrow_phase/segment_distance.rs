//! Closest points of two straight segments.

use nalgebra::Vector3;

/// Closest points of two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestOfSegments {
    /// Where on the first: 0 at its first end, 1 at its second.
    pub t: f64,
    /// Where on the second, likewise.
    pub u: f64,
    /// Their distance, m.
    pub distance: f64,
}

/// The closest points of the segments from `a[0]` to `a[1]` and from `b[0]` to `b[1]`; either may be a point. Of parallel ones, some of the
/// closest pairs. (Ericson, Real-Time Collision Detection, 2005, section 5.1.9.)
pub fn closest_of_segments(a: [&Vector3<f64>; 2], b: [&Vector3<f64>; 2]) -> ClosestOfSegments {
    let (along_a, along_b, apart) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (aa, bb, ab) = (along_a.norm_squared(), along_b.norm_squared(), along_a.dot(&along_b));
    let (c, f) = (along_a.dot(&apart), along_b.dot(&apart));
    // Where the lines are parallel to rounding the determinant is noise, and any t is as good as another.
    let determinant = aa * bb - ab * ab;
    let mut t = if determinant > 0.0 { ((ab * f - c * bb) / determinant).clamp(0.0, 1.0) } else { 0.0 };
    let mut u = if bb > 0.0 { (ab * t + f) / bb } else { 0.0 };
    if !(0.0..=1.0).contains(&u) || bb == 0.0 {
        u = u.clamp(0.0, 1.0);
        t = if aa > 0.0 { ((ab * u - c) / aa).clamp(0.0, 1.0) } else { 0.0 };
    }
    ClosestOfSegments { t, u, distance: (apart + along_a * t - along_b * u).norm() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_segments_and_points_have_their_distance() {
        let v = Vector3::new;
        let of = |a0, a1, b0, b1| closest_of_segments([&a0, &a1], [&b0, &b1]).distance;
        assert_eq!(of(v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.5, 2.0, 0.0), v(3.0, 2.0, 0.0)), 2.0);
        assert_eq!(of(v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(-4.0, 3.0, 0.0), v(-4.0, 3.0, 0.0)), 5.0);
        assert_eq!(of(v(0.0, 0.0, 0.0), v(0.0, 0.0, 0.0), v(-4.0, 3.0, 0.0), v(4.0, 3.0, 0.0)), 3.0);
        assert_eq!(of(v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(4.0, 4.0, 0.0), v(4.0, 8.0, 0.0)), 5.0);
        assert_eq!(of(v(0.0, 0.0, 0.0), v(2.0, 0.0, 0.0), v(1.0, -1.0, 0.5), v(1.0, 1.0, 0.5)), 0.5);
    }
}
