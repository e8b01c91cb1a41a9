//! Small dense systems of equations.

/// Solves A x = b by elimination with partial pivoting, in place: `a` is `b.len()`² numbers, row after row, and is used up; `b` becomes x.
/// False where A is singular to the last bit; `b` is of no use then.
pub(super) fn solve(a: &mut [f64], b: &mut [f64]) -> bool {
    let n = b.len();
    for k in 0..n {
        let mut best = k;
        for i in k + 1..n {
            if a[i * n + k].abs() > a[best * n + k].abs() {
                best = i;
            }
        }
        if best != k {
            let (upper, lower) = a.split_at_mut(best * n);
            upper[k * n + k..(k + 1) * n].swap_with_slice(&mut lower[k..n]);
            b.swap(k, best);
        }
        let pivot = a[k * n + k];
        // Not a number neither.
        if pivot.is_nan() || pivot == 0.0 {
            return false;
        }
        let (upper, lower) = a.split_at_mut((k + 1) * n);
        let row = &upper[k * n + k + 1..];
        for (i, below) in lower.chunks_exact_mut(n).enumerate() {
            let factor = below[k] / pivot;
            if factor != 0.0 {
                for (x, y) in below[k + 1..].iter_mut().zip(row) {
                    *x -= factor * y;
                }
                b[k + 1 + i] -= factor * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let row = &a[k * n..(k + 1) * n];
        let known: f64 = row[k + 1..].iter().zip(&b[k + 1..]).map(|(x, y)| x * y).sum();
        b[k] = (b[k] - known) / row[k];
    }
    true
}
