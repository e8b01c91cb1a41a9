//! A path through points with continuous acceleration: the cubic spline.

use nalgebra::Vector3;

/// The cubic spline through points at given times, twice continuously differentiable, constant before the first and after the
/// last. At its second and its last but one point the third derivative is continuous as well ("not a knot"), so it reproduces
/// cubics; through three points it is a parabola, through two a line. Its error is of fourth order in the spacing, its velocity's
/// of third.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSpline {
    times: Vec<f64>,
    points: Vec<Vector3<f64>>,
    /// Second derivatives at the points.
    bends: Vec<Vector3<f64>>,
}

impl PointSpline {
    /// Through points at times that the caller has checked: at least one, as many times as points, finite, strictly increasing.
    pub(crate) fn through(times: Vec<f64>, points: Vec<Vector3<f64>>) -> Self {
        assert!(!times.is_empty() && times.len() == points.len());
        let bends = bends(&times, &points);
        Self { times, points, bends }
    }

    /// The point at a time, s.
    pub fn at(&self, time: f64) -> Vector3<f64> {
        match self.span(time) {
            Ok((index, step, u)) => {
                let (p, b, v) = (&self.points[index..], &self.bends[index..], 1.0 - u);
                let sixth = step * step / 6.0;
                p[0] * v + p[1] * u - b[0] * (sixth * v * (1.0 - v * v)) - b[1] * (sixth * u * (1.0 - u * u))
            }
            Err(held) => self.points[held],
        }
    }

    /// The velocity at a time; zero before the first point and after the last. At these two it is that of the path between them.
    pub fn velocity(&self, time: f64) -> Vector3<f64> {
        let last = self.times.len() - 1;
        let span = if last > 0 && time == self.times[last] {
            Ok((last - 1, self.times[last] - self.times[last - 1], 1.0))
        } else {
            self.span(time)
        };
        let Ok((index, step, u)) = span else { return Vector3::zeros() };
        let (p, b, v) = (&self.points[index..], &self.bends[index..], 1.0 - u);
        (p[1] - p[0]) / step + (b[0] * (1.0 - 3.0 * v * v) - b[1] * (1.0 - 3.0 * u * u)) * (step / 6.0)
    }

    /// The interval of a time, its length, and how far into it the time is; or the point at which the spline is constant.
    fn span(&self, time: f64) -> Result<(usize, f64, f64), usize> {
        let after = self.times.partition_point(|sample| *sample <= time);
        if after == 0 || after == self.times.len() {
            return Err(after.saturating_sub(1));
        }
        let step = self.times[after] - self.times[after - 1];
        Ok((after - 1, step, (time - self.times[after - 1]) / step))
    }
}

/// Second derivatives at the points: h₋ b₋ + 2 (h₋ + h₊) b + h₊ b₊ = 6 (d₊ − d₋) with the spacings h and the divided differences
/// d; the first and the last follow from the condition on the third derivative.
fn bends(times: &[f64], points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let count = times.len();
    let mut bends = vec![Vector3::zeros(); count];
    if count < 3 {
        return bends;
    }
    let h: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let d: Vec<Vector3<f64>> = points.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) / *h).collect();
    if count == 3 {
        bends.fill((d[1] - d[0]) * (2.0 / (h[0] + h[1])));
        return bends;
    }
    // Elimination over the inner points; the matrix is diagonally dominant.
    let inner = count - 2;
    let (mut upper, mut right) = (vec![0.0; inner], vec![Vector3::zeros(); inner]);
    for k in 0..inner {
        let (before, after) = (h[k], h[k + 1]);
        let (mut low, mut middle, mut high) = (before, 2.0 * (before + after), after);
        if k == 0 {
            (low, middle, high) = (0.0, middle + before * (1.0 + before / after), high - before * before / after);
        }
        if k == inner - 1 {
            (low, middle, high) = (low - after * after / before, middle + after * (1.0 + after / before), 0.0);
        }
        let (above, pull) = if k == 0 { (0.0, Vector3::zeros()) } else { (upper[k - 1], right[k - 1]) };
        let pivot = middle - low * above;
        upper[k] = high / pivot;
        right[k] = ((d[k + 1] - d[k]) * 6.0 - pull * low) / pivot;
    }
    for k in (0..inner).rev() {
        let next = if k + 1 < inner { bends[k + 2] * upper[k] } else { Vector3::zeros() };
        bends[k + 1] = right[k] - next;
    }
    bends[0] = bends[1] + (bends[1] - bends[2]) * (h[0] / h[1]);
    bends[count - 1] = bends[count - 2] + (bends[count - 2] - bends[count - 3]) * (h[count - 2] / h[count - 3]);
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_at_uneven_times_are_reproduced() {
        let point = |t: f64| Vector3::new(1.0 - 2.0 * t + t * t * t, 0.5 * t * t, 3.0 - t * t * t);
        let rate = |t: f64| Vector3::new(-2.0 + 3.0 * t * t, t, -3.0 * t * t);
        let times = vec![-1.0, -0.7, 0.1, 0.2, 0.9, 1.5];
        let spline = PointSpline::through(times.clone(), times.iter().map(|t| point(*t)).collect());
        for k in 0..=50 {
            let t = -1.0 + 0.05 * f64::from(k);
            assert!((spline.at(t) - point(t)).amax() < 1e-13 && (spline.velocity(t) - rate(t)).amax() < 1e-13, "{t}");
        }
        assert_eq!(spline.at(-3.0), point(-1.0));
        assert_eq!((spline.at(9.0), spline.velocity(9.0)), (point(1.5), Vector3::zeros()));
    }

    #[test]
    fn few_points_make_a_line_and_a_parabola() {
        let square = |t: f64| Vector3::new(t * t, 2.0 * t * t - t, 1.0);
        let spline = PointSpline::through(vec![0.0, 1.0, 3.0], [0.0, 1.0, 3.0].map(square).to_vec());
        assert!((spline.at(2.2) - square(2.2)).amax() < 1e-14 && (spline.velocity(0.0).y + 1.0).abs() < 1e-14);
        let line = PointSpline::through(vec![0.0, 2.0], vec![Vector3::zeros(), Vector3::x()]);
        assert_eq!((line.at(0.5), line.velocity(1.0)), (Vector3::x() * 0.25, Vector3::x() * 0.5));
        let held = PointSpline::through(vec![1.0], vec![Vector3::y()]);
        assert_eq!((held.at(0.0), held.at(1.0), held.velocity(1.0)), (Vector3::y(), Vector3::y(), Vector3::zeros()));
    }

    #[test]
    fn smooth_paths_are_approached_at_fourth_order() {
        let error = |count: usize| {
            let times: Vec<f64> = (0..=count).map(|k| k as f64 / count as f64).collect();
            let wave = |t: f64| Vector3::new((7.0 * t).sin(), (5.0 * t).cos(), 0.0);
            let spline = PointSpline::through(times.clone(), times.iter().map(|t| wave(*t)).collect());
            (0..1000).map(|k| (spline.at(1e-3 * f64::from(k)) - wave(1e-3 * f64::from(k))).amax()).fold(0.0, f64::max)
        };
        let order = (error(40) / error(80)).log2();
        assert!(order > 3.7 && error(80) < 1e-5, "order {order}, error {:e}", error(80));
    }
}
