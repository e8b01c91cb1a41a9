//! Gauss–Legendre rules on [0, 1], and the choice of a rule for an element.
//!
//! Files:
//!
//! - `quadrature_limits.rs`: How far an element may turn for each Gauss–Legendre rule to integrate its inertia to a tolerance.

pub(super) mod quadrature_limits;

use std::borrow::Cow;
use std::sync::OnceLock;

use crate::error::{Error, Result};
use quadrature_limits::RULES;
pub use quadrature_limits::{LOOSEST, TIGHTEST};

/// Default relative tolerance of the integrals along an element (`docs/theory/mathematics.md`).
pub const DEFAULT_TOLERANCE: f64 = 1e-4;

/// Checks a quadrature tolerance; `argument` is its name in the message.
///
/// # Errors
/// [`Error::InvalidArgument`] for one outside [[`TIGHTEST`], [`LOOSEST`]].
pub fn check_tolerance(argument: &str, tolerance: f64) -> Result<()> {
    if (TIGHTEST..=LOOSEST).contains(&tolerance) {
        return Ok(());
    }
    Err(Error::invalid(argument, tolerance, format!("{TIGHTEST:e} to {LOOSEST:e} (relative)")))
}

/// One rule: ∫₀¹ f ≈ Σ wᵢ f(xᵢ), exact for polynomials of degree 2n − 1.
#[derive(Debug, Clone)]
pub struct Rule {
    /// Nodes in (0, 1), ascending.
    pub nodes: Cow<'static, [f64]>,
    /// Weights; their sum is 1.
    pub weights: Cow<'static, [f64]>,
    /// Barycentric weights of Lagrange's interpolation through the nodes.
    barycentric: Cow<'static, [f64]>,
}

/// Points of all rules of [`RULES`] together.
const POINTS: usize = {
    let (mut sum, mut index) = (0, 0);
    while index < RULES.len() {
        sum += RULES[index].0;
        index += 1;
    }
    sum
};

/// The rules of [`RULES`]: computed once in a process, half a millisecond that not every solver need take. In memory of the library's own and not on
/// the heap, where they would stay behind each time that a host unloads the library.
fn all_rules() -> &'static [Rule] {
    static NUMBERS: OnceLock<[[f64; POINTS]; 3]> = OnceLock::new();
    static ALL: OnceLock<[Rule; RULES.len()]> = OnceLock::new();
    ALL.get_or_init(|| {
        let [nodes, weights, barycentric] = NUMBERS.get_or_init(|| {
            let mut numbers = [[0.0; POINTS]; 3];
            let mut first = 0;
            for (count, _) in RULES {
                let rule = Rule::gauss_legendre(count);
                for (to, from) in numbers.iter_mut().zip([&rule.nodes, &rule.weights, &rule.barycentric]) {
                    to[first..first + count].copy_from_slice(from);
                }
                first += count;
            }
            numbers
        });
        let mut first = 0;
        RULES.map(|(count, _)| {
            let here = first..first + count;
            first += count;
            Rule {
                nodes: Cow::Borrowed(&nodes[here.clone()]),
                weights: Cow::Borrowed(&weights[here.clone()]),
                barycentric: Cow::Borrowed(&barycentric[here]),
            }
        })
    })
}

impl Rule {
    /// The rule of `count` ≥ 1 points: roots of Legendre's polynomial by Newton's iteration.
    pub fn gauss_legendre(count: usize) -> Self {
        let n = count as f64;
        let mut nodes = vec![0.0; count];
        let mut weights = vec![0.0; count];
        for i in 0..count {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut derivative = 1.0;
            for _ in 0..100 {
                let (mut previous, mut value) = (1.0, x);
                for degree in 2..=count {
                    let k = degree as f64;
                    (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
                }
                derivative = if count == 1 { 1.0 } else { n * (x * value - previous) / (x * x - 1.0) };
                let change = value / derivative;
                x -= change;
                if change.abs() < 1e-16 {
                    break;
                }
            }
            // cos() descends: store ascending on [0, 1].
            nodes[count - 1 - i] = 0.5 * (1.0 + x);
            weights[count - 1 - i] = if count == 1 { 1.0 } else { 1.0 / ((1.0 - x * x) * derivative * derivative) };
        }
        let barycentric = (0..count)
            .map(|i| {
                let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
                sign * (nodes[i] * (1.0 - nodes[i]) * weights[i]).sqrt()
            })
            .collect::<Vec<f64>>();
        Self { nodes: nodes.into(), weights: weights.into(), barycentric: barycentric.into() }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never: a rule has at least one point.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The coefficients that give the value at node `node` of the rule `to` from the values at this rule's nodes. Where `to` has
    /// at least as many points, this is the interpolating polynomial; else the polynomial with as many coefficients as `to` has
    /// points that is nearest in the mean square. Integrals stay the same, and those of squares do not grow.
    pub fn transfer(&self, to: &Self, node: usize, coefficients: &mut Vec<f64>) {
        if to.len() >= self.len() {
            return self.interpolation(to.nodes[node], coefficients);
        }
        // Lagrange's polynomials of Gauss' nodes are orthogonal, and the integrals of their squares are the weights. This rule
        // integrates their products with its own polynomials exactly.
        coefficients.clear();
        for (x, weight) in self.nodes.iter().zip(self.weights.iter()) {
            coefficients.push(weight * to.basis(node, *x) / to.weights[node]);
        }
    }

    /// Lagrange's polynomial that is one at node `node` and zero at the others.
    fn basis(&self, node: usize, x: f64) -> f64 {
        let here = self.nodes[node];
        self.nodes.iter().enumerate().filter(|(k, _)| *k != node).map(|(_, other)| (x - other) / (here - other)).product()
    }

    /// The coefficients that give the interpolating polynomial's value at `x` from the values at the nodes.
    pub fn interpolation(&self, x: f64, coefficients: &mut Vec<f64>) {
        coefficients.clear();
        self.for_each_coefficient(x, |_, coefficient| coefficients.push(coefficient));
    }

    /// The same without allocation: `take(node, coefficient)`, in the nodes' order.
    pub fn for_each_coefficient(&self, x: f64, mut take: impl FnMut(usize, f64)) {
        if let Some(hit) = self.nodes.iter().position(|node| *node == x) {
            (0..self.len()).for_each(|i| take(i, if i == hit { 1.0 } else { 0.0 }));
            return;
        }
        let fractions = || self.barycentric.iter().zip(self.nodes.iter()).map(|(weight, node)| weight / (x - node));
        let sum: f64 = fractions().sum();
        fractions().enumerate().for_each(|(i, fraction)| take(i, fraction / sum));
    }
}

/// The rules of one solver and their tolerance. A strand uses one rule for all its elements.
#[derive(Debug, Clone)]
pub struct Rules {
    rules: &'static [Rule],
    tolerance: f64,
    /// The largest turn, rad, that each rule covers.
    limits: Vec<f64>,
}

impl Default for Rules {
    fn default() -> Self {
        Self::new(DEFAULT_TOLERANCE)
    }
}

impl Rules {
    /// Rules that integrate an element's inertia, drag and weight to the relative `tolerance`.
    ///
    /// # Panics
    /// For a tolerance outside [[`TIGHTEST`], [`LOOSEST`]].
    pub fn new(tolerance: f64) -> Self {
        let mut out = Self { rules: all_rules(), tolerance, limits: Vec::new() };
        out.set_tolerance(tolerance);
        out
    }

    /// Chooses rules for another tolerance from now on; the rules and their indices stay the same.
    ///
    /// # Panics
    /// For a tolerance outside [[`TIGHTEST`], [`LOOSEST`]].
    pub fn set_tolerance(&mut self, tolerance: f64) {
        assert!((TIGHTEST..=LOOSEST).contains(&tolerance), "quadrature tolerance {tolerance}: {TIGHTEST} to {LOOSEST}");
        self.tolerance = tolerance;
        self.limits = (0..RULES.len()).map(|index| quadrature_limits::largest_turn(index, tolerance)).collect();
    }

    /// The relative tolerance of the integrals.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The smallest rule that integrates an element with turn `angle` = Ωℓ rad to the tolerance, as an index for [`Rules::rule`].
    /// Past the largest rule's range it is the largest rule; [`Rules::error`] then gives its error.
    pub fn for_angle(&self, angle: f64) -> usize {
        self.limits.iter().position(|limit| angle < *limit).unwrap_or(RULES.len() - 1)
    }

    /// The same for a given tolerance, within [`TIGHTEST`] and [`LOOSEST`].
    pub fn for_angle_within(&self, angle: f64, tolerance: f64) -> usize {
        let does = |index: &usize| angle < quadrature_limits::largest_turn(*index, tolerance);
        (0..RULES.len()).find(does).unwrap_or(RULES.len() - 1)
    }

    /// The rule for a strand whose most turned element turns by `angle`, given its current rule. It changes only when it must, or
    /// when a smaller one would do with a margin, so that a strand near a limit does not alternate between two.
    pub fn next_for_angle(&self, current: usize, angle: f64) -> usize {
        let wanted = self.for_angle(1.1 * angle);
        if wanted >= current { wanted } else { self.for_angle(1.3 * angle).min(current) }
    }

    /// The relative error of a rule where an element turns by `angle` rad: [`TIGHTEST`] means that or less, infinity more than
    /// [`LOOSEST`].
    pub fn error(&self, index: usize, angle: f64) -> f64 {
        quadrature_limits::error(index, angle)
    }

    /// A rule by index.
    pub fn rule(&self, index: usize) -> &Rule {
        &self.rules[index]
    }

    /// Bytes on the heap, of this value in a box; the rules themselves, 20 kB, belong to the process.
    pub fn heap_bytes(&self) -> usize {
        size_of::<Self>() + self.limits.capacity() * size_of::<f64>()
    }

    /// Number of rules.
    pub fn count(&self) -> usize {
        self.rules.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_exactly() {
        for (count, _) in RULES {
            let rule = Rule::gauss_legendre(count);
            assert_eq!(rule.len(), count);
            for degree in 0..2 * count {
                let sum: f64 = rule.nodes.iter().zip(rule.weights.iter()).map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = 1.0 / (degree as f64 + 1.0);
                assert!((sum - exact).abs() < 4e-15, "{count} points, degree {degree}: {sum} against {exact}");
            }
        }
    }

    #[test]
    fn interpolates_smooth_functions() {
        let (from, to) = (Rule::gauss_legendre(20), Rule::gauss_legendre(32));
        let mut coefficients = Vec::new();
        for x in to.nodes.iter().chain(&[0.0, 1.0]).chain(from.nodes.iter()) {
            from.interpolation(*x, &mut coefficients);
            let value: f64 = coefficients.iter().zip(from.nodes.iter()).map(|(c, node)| c * (9.0 * node).cos()).sum();
            assert!((value - (9.0 * x).cos()).abs() < 1e-10);
        }
    }

    #[test]
    fn transfer_keeps_integrals_and_does_not_add_to_squares() {
        for (from, to) in [(6, 3), (5, 4), (14, 3), (12, 10), (128, 96), (3, 5), (9, 9)] {
            let (from, to) = (Rule::gauss_legendre(from), Rule::gauss_legendre(to));
            let values: Vec<f64> = from.nodes.iter().map(|x| (2.5 * x).exp() + (7.0 * x).sin()).collect();
            let mut coefficients = Vec::new();
            let mut moved = Vec::new();
            for node in 0..to.len() {
                from.transfer(&to, node, &mut coefficients);
                moved.push(coefficients.iter().zip(&values).map(|(c, v)| c * v).sum::<f64>());
            }
            let moment = |rule: &Rule, values: &[f64], degree: i32| -> f64 {
                (0..rule.len()).map(|i| rule.weights[i] * values[i] * rule.nodes[i].powi(degree)).sum()
            };
            let square =
                |rule: &Rule, values: &[f64]| -> f64 { (0..rule.len()).map(|i| rule.weights[i] * values[i].powi(2)).sum() };
            let kept = from.len().min(to.len());
            // Moments up to the degree that fewer coefficients can represent are exact but for rounding.
            for degree in 0..kept as i32 {
                let (before, after) = (moment(&from, &values, degree), moment(&to, &moved, degree));
                assert!((before - after).abs() < 1e-12 * square(&from, &values), "{} to {}: {degree}", from.len(), to.len());
            }
            let (before, after) = (square(&from, &values), square(&to, &moved));
            if to.len() >= from.len() {
                assert!((after / before - 1.0).abs() < 1e-12, "{} to {}", from.len(), to.len());
            } else {
                assert!(after < before * (1.0 + 1e-14), "{} to {}: {before} {after}", from.len(), to.len());
            }
        }
    }

    #[test]
    fn rules_grow_with_the_angle_and_do_not_flicker() {
        for exponent in 4..=24 {
            let rules = Rules::new(10.0_f64.powf(-0.5 * f64::from(exponent)).clamp(TIGHTEST, LOOSEST));
            let largest = *rules.limits.last().unwrap();
            let (mut last, mut angle) = (0, 1e-6);
            while angle < 400.0 {
                let index = rules.for_angle(angle);
                assert!(index >= last && index == rules.for_angle_within(angle, rules.tolerance()));
                assert!(rules.error(index, angle) <= rules.tolerance() * (1.0 + 1e-9) || angle > largest);
                last = index;
                let chosen = rules.next_for_angle(0, angle);
                assert_eq!(rules.next_for_angle(chosen, angle * 0.99), chosen);
                angle *= 1.01;
            }
        }
    }
}
