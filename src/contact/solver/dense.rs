//! Small dense systems of equations.

use crate::math::lane::{Kernel, Lane};
use crate::meter::Meter;

/// This many columns are eliminated before the rest of the matrix is: each of its numbers is then read and written once for all
/// of them.
const PANEL: usize = 8;
/// A system of more rows than this takes a while.
const LARGE: usize = 200;

/// Solves A x = b by elimination with partial pivoting, in place: `a` is `b.len()`² numbers, row after row, and is used up; `b` becomes x.
/// False where A is singular to the last bit, or `meter` halts it; `b` is of no use then.
pub(in crate::contact) fn solve(a: &mut [f64], b: &mut [f64], meter: &Meter) -> bool {
    let n = b.len();
    let is_eliminated = eliminate_first(a, b, n, meter);
    if is_eliminated {
        substitute_first(a, b, n);
    }
    is_eliminated
}

/// The same for the first `pivots` columns only, with pivots from the first so many rows. What is left of the other rows and columns is
/// the system without these unknowns.
pub(in crate::contact) fn eliminate_first(a: &mut [f64], b: &mut [f64], pivots: usize, meter: &Meter) -> bool {
    f64::call(Eliminate { a, b, pivots, meter })
}

/// After [`eliminate_first`]: `a` is its first rows, and `b` their right-hand sides, followed by the other unknowns; the first ones
/// become the solution.
pub(in crate::contact) fn substitute_first(a: &[f64], b: &mut [f64], pivots: usize) {
    f64::call(Substitute { a, b, pivots });
}

struct Eliminate<'a> {
    a: &'a mut [f64],
    b: &'a mut [f64],
    pivots: usize,
    meter: &'a Meter<'a>,
}

impl Kernel for Eliminate<'_> {
    type Output = bool;
    #[inline(always)]
    fn run(self) -> bool {
        let Self { a, b, pivots, meter } = self;
        let n = b.len();
        for from in (0..pivots).step_by(PANEL) {
            let to = (from + PANEL).min(pivots);
            // (A panel of 1200 rows takes a millisecond.)
            if n > LARGE && meter.is_halted() || !eliminate(a, b, from, to, pivots) {
                return false;
            }
            let (done, below) = a.split_at_mut(to * n);
            for row in from + 1..to {
                let (above, row) = done[from * n..].split_at_mut((row - from) * n);
                subtract(&mut row[..n], above, from, to);
            }
            let panel = &done[from * n..];
            for row in below.chunks_exact_mut(n) {
                subtract(row, panel, from, to);
            }
        }
        true
    }
}

struct Substitute<'a> {
    a: &'a [f64],
    b: &'a mut [f64],
    pivots: usize,
}

impl Kernel for Substitute<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        substitute(self.a, self.b, self.pivots);
    }
}

/// The last of the first `pivots` unknowns, and back to the first.
#[inline(always)]
fn substitute(a: &[f64], b: &mut [f64], pivots: usize) {
    let n = b.len();
    for k in (0..pivots).rev() {
        let row = &a[k * n..(k + 1) * n];
        let known: f64 = row[k + 1..].iter().zip(&b[k + 1..]).map(|(x, y)| x * y).sum();
        b[k] = (b[k] - known) / row[k];
    }
}

/// Eliminates the columns `from..to` from the rows below each one's pivot, in these columns and in `b`; what of each pivot's row was
/// subtracted stays in its column. Pivots are among the first `pivots` rows. False where there is none.
#[inline(always)]
fn eliminate(a: &mut [f64], b: &mut [f64], from: usize, to: usize, pivots: usize) -> bool {
    let n = b.len();
    for k in from..to {
        let mut best = k;
        for i in k + 1..pivots {
            if a[i * n + k].abs() > a[best * n + k].abs() {
                best = i;
            }
        }
        if best != k {
            let (upper, lower) = a.split_at_mut(best * n);
            upper[k * n + from..(k + 1) * n].swap_with_slice(&mut lower[from..n]);
            b.swap(k, best);
        }
        let pivot = a[k * n + k];
        // Neither a number.
        if pivot.is_nan() || pivot == 0.0 {
            return false;
        }
        let (upper, lower) = a.split_at_mut((k + 1) * n);
        let row = &upper[k * n + k + 1..k * n + to];
        for (i, below) in lower.chunks_exact_mut(n).enumerate() {
            let factor = below[k] / pivot;
            below[k] = factor;
            if factor != 0.0 {
                for (x, y) in below[k + 1..to].iter_mut().zip(row) {
                    *x -= factor * y;
                }
                b[k + 1 + i] -= factor * b[k];
            }
        }
    }
    true
}

/// Subtracts the panel's rows (all above this one) from what is beyond the panel, by what stands in the row's columns `from..to`.
#[inline(always)]
fn subtract(row: &mut [f64], panel: &[f64], from: usize, to: usize) {
    let n = row.len();
    let (factors, rest) = row.split_at_mut(to);
    let factors = &factors[from..];
    let beyond = |k: usize| &panel[k * n + to..(k + 1) * n];
    if let (Ok(factors), PANEL) = (<&[f64; PANEL]>::try_from(factors), panel.len() / n) {
        if factors.iter().all(|factor| *factor == 0.0) {
            return;
        }
        // Four columns at a time in a register, which no pivot's row can be the same memory as.
        let (fours, ones) = rest.as_chunks_mut::<4>();
        let start = 4 * fours.len();
        let pivots: [&[[f64; 4]]; PANEL] = std::array::from_fn(|k| &beyond(k).as_chunks().0[..fours.len()]);
        for (j, four) in fours.iter_mut().enumerate() {
            let mut sum = *four;
            for (factor, pivot) in factors.iter().zip(&pivots) {
                let pivot = pivot[j];
                for lane in 0..4 {
                    sum[lane] -= factor * pivot[lane];
                }
            }
            *four = sum;
        }
        for (k, factor) in factors.iter().enumerate() {
            for (x, y) in ones.iter_mut().zip(&beyond(k)[start..]) {
                *x -= factor * y;
            }
        }
        return;
    }
    for (k, factor) in factors.iter().enumerate().take(panel.len() / n) {
        for (x, y) in rest.iter_mut().zip(beyond(k)) {
            *x -= factor * y;
        }
    }
}

/// A matrix factorised with partial pivoting, for several right-hand sides. Memory is kept.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Factors {
    /// Rows in the order of their pivots: the factors left of the diagonal, and what is left of the matrix.
    rows: Vec<f64>,
    /// For each pivot the row that was exchanged with its own.
    exchanged: Vec<usize>,
}

impl Factors {
    /// Factorises `n`² numbers, row after row. False where the matrix is singular to the last bit.
    pub fn factorise(&mut self, a: &[f64], n: usize) -> bool {
        self.rows.clear();
        self.rows.extend_from_slice(a);
        self.exchanged.clear();
        f64::call(Factorise { factors: self, n })
    }

    /// Solves A x = b: `b` becomes x.
    pub fn solve(&self, b: &mut [f64]) {
        f64::call(SolveFactorised { factors: self, b });
    }
}

struct Factorise<'a> {
    factors: &'a mut Factors,
    n: usize,
}

impl Kernel for Factorise<'_> {
    type Output = bool;
    #[inline(always)]
    fn run(self) -> bool {
        let Self { factors: Factors { rows, exchanged }, n } = self;
        for k in 0..n {
            let best = (k + 1..n).fold(k, |best, i| if rows[i * n + k].abs() > rows[best * n + k].abs() { i } else { best });
            exchanged.push(best);
            if best != k {
                let (upper, lower) = rows.split_at_mut(best * n);
                upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
            }
            let pivot = rows[k * n + k];
            if pivot.is_nan() || pivot == 0.0 {
                return false;
            }
            let (upper, lower) = rows.split_at_mut((k + 1) * n);
            let row = &upper[k * n + k + 1..];
            for below in lower.chunks_exact_mut(n) {
                let factor = below[k] / pivot;
                below[k] = factor;
                if factor != 0.0 {
                    for (x, y) in below[k + 1..].iter_mut().zip(row) {
                        *x -= factor * y;
                    }
                }
            }
        }
        true
    }
}

struct SolveFactorised<'a> {
    factors: &'a Factors,
    b: &'a mut [f64],
}

impl Kernel for SolveFactorised<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { factors: Factors { rows, exchanged }, b } = self;
        let n = b.len();
        for (k, other) in exchanged.iter().enumerate() {
            b.swap(k, *other);
        }
        for k in 0..n {
            let known: f64 = rows[k * n..k * n + k].iter().zip(&*b).map(|(x, y)| x * y).sum();
            b[k] -= known;
        }
        substitute(rows, b, n);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Seeded;

    /// The same without panels.
    fn plain(a: &mut [f64], b: &mut [f64]) {
        let n = b.len();
        for k in 0..n {
            let best = (k..n).fold(k, |best, i| if a[i * n + k].abs() > a[best * n + k].abs() { i } else { best });
            for j in 0..n {
                a.swap(k * n + j, best * n + j);
            }
            b.swap(k, best);
            for i in k + 1..n {
                let factor = a[i * n + k] / a[k * n + k];
                for j in k + 1..n {
                    a[i * n + j] -= factor * a[k * n + j];
                }
                b[i] -= factor * b[k];
            }
        }
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| a[k * n + j] * b[j]).sum();
            b[k] = (b[k] - known) / a[k * n + k];
        }
    }

    #[test]
    fn panels_give_the_bits_of_plain_elimination_and_the_solution() {
        let (numbers, mut index) = (Seeded::new(1, 0), 0);
        let mut random = || {
            index += 1;
            numbers.unit(index) - 0.5
        };
        for n in [1, 2, 3, 7, 8, 9, 16, 17, 40, 63, 120] {
            let a: Vec<f64> = (0..n * n).map(|_| if random() < -0.2 { 0.0 } else { random() }).collect();
            let a: Vec<f64> = a.iter().enumerate().map(|(k, x)| x + if k % (n + 1) == 0 { 0.1 } else { 0.0 }).collect();
            let b: Vec<f64> = (0..n).map(|_| random()).collect();
            let (mut left, mut x, mut other_left, mut other) = (a.clone(), b.clone(), a.clone(), b.clone());
            assert!(solve(&mut left, &mut x, &Meter::unlimited()));
            plain(&mut other_left, &mut other);
            assert_eq!(x, other, "{n}");
            let (mut factors, mut again) = (Factors::default(), b.clone());
            assert!(factors.factorise(&a, n));
            factors.solve(&mut again);
            for (x, again) in x.iter().zip(&again) {
                assert!((x - again).abs() < 1e-9 * (1.0 + x.abs()), "{n}: {x} {again}");
            }
            for (row, b) in a.chunks_exact(n).zip(&b) {
                let sum: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
                let scale: f64 = row.iter().zip(&x).map(|(a, x)| (a * x).abs()).sum::<f64>() + b.abs();
                assert!((sum - b).abs() < 1e-10 * scale, "{n}: {sum} {b}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        let n = 20;
        let mut a: Vec<f64> = (0..n * n).map(|k| ((k / n) % 5) as f64 + (k % n) as f64).collect();
        assert!(!solve(&mut a, &mut vec![1.0; n], &Meter::unlimited()));
        assert!(!solve(&mut [f64::NAN], &mut [1.0], &Meter::unlimited()));
        assert!(!Factors::default().factorise(&[1.0, 2.0, 2.0, 4.0], 2));
    }
}
