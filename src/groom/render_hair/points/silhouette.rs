//! Moves strands of mixed curvatures to where mixed positions lead.
//!
//! A strand that is integrated from its root by its bends need not stay between its guides: hair of a crown would stand up where
//! bends to all sides cancel. The strand keeps its curls. Its course, the best-fitting cubic through its root, is replaced by
//! that of the strand that the guides' positions make.

use nalgebra::DMatrix;

/// Terms of the course: s, s², s³.
const TERMS: usize = 3;
/// Points that go side by side.
const STEP: usize = 8;

/// What depends only on the number of points: rows of `stride` floats.
#[derive(Debug, Default)]
pub(in crate::groom::render_hair) struct Silhouette {
    /// The terms at the points.
    powers: Vec<f32>,
    /// The contribution of each point to the factor of a term.
    fit: Vec<f32>,
}

impl Silhouette {
    pub fn new(points: usize, stride: usize) -> Self {
        let terms = TERMS.min(points - 1);
        let place = |k: usize| k as f64 / (points - 1) as f64;
        let basis = DMatrix::from_fn(points, terms, |k, term| place(k).powi(term as i32 + 1));
        let normal = basis.transpose() * &basis;
        let fit = normal.try_inverse().map_or_else(|| DMatrix::zeros(terms, points), |inverse| inverse * basis.transpose());
        let row = |of: &dyn Fn(usize, usize) -> f64| -> Vec<f32> {
            let value = |term: usize, k: usize| if term < terms && k < points { of(term, k) as f32 } else { 0.0 };
            (0..TERMS).flat_map(|term| (0..stride).map(move |k| (term, k))).map(|(term, k)| value(term, k)).collect()
        };
        Self { powers: row(&|term, k| basis[(k, term)]), fit: row(&|term, k| fit[(term, k)]) }
    }

    /// Replaces the course of a row of positions relative to the root by that of another.
    #[inline(always)]
    pub fn bring(&self, stride: usize, bent: &mut [f32], mixed: &[f32]) {
        let (bent, mixed) = (&mut bent[..stride], &mixed[..stride]);
        let mut factors = [0.0_f32; TERMS];
        for (term, factor) in factors.iter_mut().enumerate() {
            let fit = &self.fit[term * stride..][..stride];
            let mut sums = [0.0_f32; STEP];
            for at in (0..stride).step_by(STEP) {
                for k in 0..STEP {
                    sums[k] += fit[at + k] * (mixed[at + k] - bent[at + k]);
                }
            }
            *factor = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
        }
        let [a, b, c] = [0, 1, 2].map(|term| &self.powers[term * stride..][..stride]);
        for k in 0..stride {
            bent[k] += factors[0] * a[k] + (factors[1] * b[k] + factors[2] * c[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_course_changes_and_its_details_stay() {
        for points in [2, 3, 4, 24] {
            let stride = usize::next_multiple_of(points, 8);
            let s = |k: usize| k as f32 / (points - 1) as f32;
            let row =
                |of: &dyn Fn(f32) -> f32| (0..stride).map(|k| if k < points { of(s(k)) } else { 0.0 }).collect::<Vec<f32>>();
            let silhouette = Silhouette::new(points, stride);
            let (mut bent, mixed) = (row(&|s| 0.1 * s), row(&|s| 0.3 * s - 0.2 * s * s * s));
            silhouette.bring(stride, &mut bent, &mixed);
            for k in 0..points {
                assert!((bent[k] - mixed[k]).abs() < 1e-5, "{points} {k}: {} {}", bent[k], mixed[k]);
            }
        }
        // A wave is no course: of eight along the strand the best cubic takes a quarter of one at the tip, where nothing
        // constrains it, and less before.
        let silhouette = Silhouette::new(64, 64);
        let wave: Vec<f32> = (0..64).map(|k| 0.01 * (0.8 * k as f32).sin()).collect();
        let mut bent = wave.clone();
        silhouette.bring(64, &mut bent, &[0.0; 64]);
        let most = bent.iter().zip(&wave).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(most < 2.5e-3, "{most}");
    }
}
