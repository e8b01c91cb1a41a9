//! Cholesky's factorisation of a positive semidefinite matrix with pivoting: rows that depend on others are left out.

/// A pivot below this fraction of its row's diagonal is rounding: the row depends on those before.
const DEPENDENT: f64 = 1e-11;
/// A diagonal below this fraction of its expected size is rounding.
const IMMOVABLE: f64 = 1e-13;

/// The factor L of P S W S Pᵀ, S the scaling to a diagonal of one, P the order of the pivots.
#[derive(Debug, Clone)]
pub(in crate::contact) struct RankFactor {
    count: usize,
    rank: usize,
    /// Rows in the order of the pivots, dependent ones last.
    order: Vec<usize>,
    scale: Vec<f64>,
    /// `lower[i * count + k]`: row i of the order, column k below the rank.
    lower: Vec<f64>,
}

impl RankFactor {
    /// Factorises a symmetric `count`² matrix. `expected`: the expected size of the diagonals; one that is negligible beside it
    /// is no pivot.
    pub(in crate::contact) fn new(w: &[f64], count: usize, expected: &[f64]) -> Self {
        let scale: Vec<f64> = (0..count)
            .map(|i| {
                let d = w[i * count + i];
                if d > IMMOVABLE * expected[i] { 1.0 / d.sqrt() } else { 0.0 }
            })
            .collect();
        let mut order: Vec<usize> = (0..count).collect();
        let mut left: Vec<f64> = scale.iter().map(|s| if *s > 0.0 { 1.0 } else { 0.0 }).collect();
        let mut lower = vec![0.0; count * count];
        let mut rank = 0;
        for k in 0..count {
            // The largest pivot left; among equals the first of the problem.
            let mut best = k;
            for i in k + 1..count {
                let (a, b) = (left[order[i]], left[order[best]]);
                if a > b || (a == b && order[i] < order[best]) {
                    best = i;
                }
            }
            let pivot = left[order[best]];
            if pivot <= DEPENDENT {
                break;
            }
            order.swap(k, best);
            for c in 0..k {
                lower.swap(k * count + c, best * count + c);
            }
            let diagonal = pivot.sqrt();
            lower[k * count + k] = diagonal;
            for i in k + 1..count {
                let mut value = w[order[i] * count + order[k]] * scale[order[i]] * scale[order[k]];
                for c in 0..k {
                    value -= lower[i * count + c] * lower[k * count + c];
                }
                lower[i * count + k] = value / diagonal;
                left[order[i]] -= lower[i * count + k] * lower[i * count + k];
            }
            rank += 1;
        }
        Self { count, rank, order, scale, lower }
    }

    /// The number of independent rows.
    pub(in crate::contact) fn rank(&self) -> usize {
        self.rank
    }

    /// L⁻¹ of the independent rows, in the order of the pivots.
    pub(in crate::contact) fn forward(&self, rhs: &[f64]) -> Vec<f64> {
        let mut y = Vec::with_capacity(self.rank);
        for k in 0..self.rank {
            let row = self.order[k];
            let mut value = rhs[row] * self.scale[row];
            for (c, before) in y.iter().enumerate() {
                value -= self.lower[k * self.count + c] * before;
            }
            y.push(value / self.lower[k * self.count + k]);
        }
        y
    }

    /// W⁻¹ of the independent rows; the others get zero.
    pub(in crate::contact) fn solve(&self, rhs: &[f64]) -> Vec<f64> {
        let y = self.backward(self.forward(rhs));
        let mut out = vec![0.0; self.count];
        for (k, value) in y.iter().enumerate() {
            out[self.order[k]] = value * self.scale[self.order[k]];
        }
        out
    }

    fn backward(&self, mut y: Vec<f64>) -> Vec<f64> {
        for k in (0..self.rank).rev() {
            for i in k + 1..self.rank {
                y[k] -= self.lower[i * self.count + k] * y[i];
            }
            y[k] /= self.lower[k * self.count + k];
        }
        y
    }
}

/// The rows that depend on others, ascending, each with the rows that it depends on.
pub(in crate::contact) fn dependence(factor: &RankFactor) -> Vec<(usize, Vec<usize>)> {
    let mut out: Vec<(usize, Vec<usize>)> = (factor.rank..factor.count)
        .map(|i| {
            let y = factor.lower[i * factor.count..i * factor.count + factor.rank].to_vec();
            let on =
                factor.backward(y).iter().enumerate().filter(|(_, c)| c.abs() > 1e-6).map(|(k, _)| factor.order[k]).collect();
            (factor.order[i], on)
        })
        .collect();
    out.sort_by_key(|(row, _)| *row);
    out
}
