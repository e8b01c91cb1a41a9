//! The root of a function of one variable above zero that falls from positive to negative: Newton's iteration inside a bracket.

/// The largest number of evaluations of a search; bisection in the exponent alone halves any bracket of f64 to neighbours in
/// fewer.
const MAX_EVALUATIONS: u32 = 200;
/// Newton's step that changes x by less than this fraction is the last, since its error is the square of that: for a solution
/// to rounding,
pub(super) const EXACT: f64 = 1e-10;
/// or for a solve that is repeated from there, as in sweeps.
pub(super) const NEAR: f64 = 1e-3;

/// The root x of `f` above `least`. `f` gives value and slope; it must be positive at `least` (not evaluated there) and negative for all
/// x from some x on. Starts at `guess`. Ends after a step of Newton's by less than `last` of x, where neighbours in f64 are, where the value is
/// below a few roundings, or, if no x is negative enough, at the largest x tried.
#[inline(always)]
pub(super) fn root(least: f64, guess: f64, last: f64, mut f: impl FnMut(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high) = (least, f64::INFINITY);
    let mut x = if guess > least && guess.is_finite() { guess } else { 2.0 * least };
    for _ in 0..MAX_EVALUATIONS {
        let (value, slope) = f(x);
        if value.abs() <= 4.0 * f64::EPSILON {
            return x;
        }
        if value > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let mut next = x - value / slope;
        if next > low && next < high {
            if (next - x).abs() <= last * x {
                return next;
            }
        } else {
            next = match () {
                () if high == f64::INFINITY => 8.0 * x,
                () if low == least && high > 64.0 * least => (0.125 * high).max(2.0 * least),
                () => low.sqrt() * high.sqrt(),
            };
        }
        if high - low <= 4.0 * f64::EPSILON * low || (next - x).abs() <= f64::EPSILON * x || next > 1e250 {
            return if next.is_finite() { next } else { x };
        }
        x = next;
    }
    x
}
