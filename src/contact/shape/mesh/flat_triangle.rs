//! A triangle in axes of its own, for many queries of how far points are from it.

use nalgebra::Vector3;

use super::triangle;

/// A triangle as seen along its normal: its first corner at the origin, the second on the x axis, the third above it.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct FlatTriangle {
    /// Its corners, m.
    pub corners: [Vector3<f64>; 3],
    axes: [Vector3<f64>; 3],
    second: f64,
    third: [f64; 2],
    /// One over the edges' squared lengths.
    inverse_squares: [f64; 3],
}

impl FlatTriangle {
    /// A triangle with its unit normal, zero where it has lost its area.
    pub fn new(corners: &[Vector3<f64>; 3], normal: &Vector3<f64>) -> Self {
        let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
        let length = ab.norm();
        let x = if length > 0.0 { ab / length } else { Vector3::zeros() };
        let y = normal.cross(&x);
        let third = [x.dot(&ac), y.dot(&ac)];
        let (p, q) = (third[0] - length, third[1]);
        Self {
            corners: *corners,
            axes: [x, y, *normal],
            second: length,
            third,
            inverse_squares: [length * length, p * p + q * q, ac.norm_squared()].map(|square| 1.0 / square),
        }
    }

    /// Its unit normal; zero where it has lost its area.
    #[inline]
    pub fn normal(&self) -> &Vector3<f64> {
        &self.axes[2]
    }

    /// Height of a point over its plane, m.
    #[inline]
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        self.axes[2].dot(&(point - self.corners[0]))
    }

    /// Whether the straight path between two points goes through it; through an edge of two triangles it goes through one of them.
    pub fn is_pierced(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        if (self.height(from) < 0.0) == (self.height(to) < 0.0) {
            return false;
        }
        let [a, b, c] = &self.corners;
        let offset = to - from;
        // The signed volumes of the path with the edges: all of one sign when it passes between them.
        let volume = |p: &Vector3<f64>, q: &Vector3<f64>| offset.dot(&(p - from).cross(&(q - from)));
        let volumes = [volume(a, b), volume(b, c), volume(c, a)];
        volumes.iter().all(|volume| *volume >= 0.0) || volumes.iter().all(|volume| *volume < 0.0)
    }

    /// The offset from its nearest point to `point`, m.
    #[inline]
    pub fn offset_to(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let to = point - self.corners[0];
        let [x, y] = self.beside(self.axes[0].dot(&to), self.axes[1].dot(&to));
        if self.third[1] > 0.0 {
            self.axes[0] * x + self.axes[1] * y + self.axes[2] * self.axes[2].dot(&to)
        } else {
            self.offset_without_area(point)
        }
    }

    /// The square of its distance from `point`, m².
    #[inline]
    pub fn distance_squared(&self, point: &Vector3<f64>) -> f64 {
        let to = point - self.corners[0];
        let [x, y] = self.beside(self.axes[0].dot(&to), self.axes[1].dot(&to));
        let z = self.axes[2].dot(&to);
        if self.third[1] > 0.0 { x * x + y * y + z * z } else { self.offset_without_area(point).norm_squared() }
    }

    /// Whether points all lie farther than `level` (m) on one side of its plane, or beyond one of its edges; then so does their hull.
    #[inline]
    pub fn is_beside(&self, points: &[Vector3<f64>; 4], level: f64) -> bool {
        let (b, [c, d]) = (self.second, self.third);
        if d <= 0.0 {
            return false;
        }
        let sides = [self.inverse_squares[1].sqrt(), self.inverse_squares[2].sqrt()];
        let mut most = [f64::NEG_INFINITY; 4];
        let mut least = [f64::INFINITY; 4];
        for point in points {
            let to = point - self.corners[0];
            let (x, y) = (self.axes[0].dot(&to), self.axes[1].dot(&to));
            // Heights over the plane, and inward of the edges.
            let heights = [self.axes[2].dot(&to), y, ((c - b) * y - d * (x - b)) * sides[0], (d * x - c * y) * sides[1]];
            for k in 0..4 {
                most[k] = most[k].max(heights[k]);
                least[k] = least[k].min(heights[k]);
            }
        }
        least[0] > level || most.iter().any(|most| *most < -level)
    }

    /// How far a point of the plane lies beside it. The nearest place is on an edge that the point lies outside of.
    #[inline]
    fn beside(&self, x: f64, y: f64) -> [f64; 2] {
        let (b, [c, d]) = (self.second, self.third);
        let mut best = [0.0; 2];
        let mut least = f64::INFINITY;
        let mut try_edge = |px: f64, py: f64, ex: f64, ey: f64, inverse: f64| {
            let u = ((px * ex + py * ey) * inverse).clamp(0.0, 1.0);
            let off = [px - u * ex, py - u * ey];
            let square = off[0] * off[0] + off[1] * off[1];
            if square < least {
                (best, least) = (off, square);
            }
        };
        if y < 0.0 {
            try_edge(x, y, b, 0.0, self.inverse_squares[0]);
        }
        if (c - b) * y < d * (x - b) {
            try_edge(x - b, y, c - b, d, self.inverse_squares[1]);
        }
        if d * x < c * y {
            try_edge(x, y, c, d, self.inverse_squares[2]);
        }
        best
    }

    #[cold]
    fn offset_without_area(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let [a, b, c] = &self.corners;
        let (weights, _) = triangle::closest(a, b, c, point);
        point - (a * weights[0] + b * weights[1] + c * weights[2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_triangle() {
        let mut state = 1_u64;
        let mut unit = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for case in 0..2000 {
            let mut corners: [Vector3<f64>; 3] = std::array::from_fn(|_| Vector3::from_fn(|_, _| unit()));
            if case % 50 == 0 {
                // Without area: all on a line, or in one place.
                corners[2] = corners[0] + (corners[1] - corners[0]) * (unit() * f64::from(case % 100 / 50));
            }
            let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            let normal = if area.norm() > 1e-12 { area.normalize() } else { Vector3::zeros() };
            let flat = FlatTriangle::new(&corners, &normal);
            let point = Vector3::from_fn(|_, _| 3.0 * unit() - 1.0);
            let [a, b, c] = &corners;
            let (weights, _) = triangle::closest(a, b, c, &point);
            let offset = point - (a * weights[0] + b * weights[1] + c * weights[2]);
            assert!((flat.offset_to(&point) - offset).norm() < 1e-12, "{corners:?} {point}");
            assert!((flat.distance_squared(&point) - offset.norm_squared()).abs() < 1e-12);
        }
    }
}
