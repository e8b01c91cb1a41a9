//! Gauss–Legendre rules on [0, 1], and how many points a segment needs.

/// Numbers of points that are kept ready. A strand uses one of these for all its elements.
const SIZES: [usize; 14] = [4, 6, 8, 10, 12, 14, 16, 20, 24, 32, 40, 64, 96, 128];

/// One rule: ∫₀¹ f ≈ Σ wᵢ f(xᵢ), exact for polynomials of degree 2n − 1.
#[derive(Debug, Clone)]
pub struct Rule {
    /// Nodes in (0, 1), ascending.
    pub nodes: Vec<f64>,
    /// Weights; their sum is 1.
    pub weights: Vec<f64>,
    /// Barycentric weights of Lagrange's interpolation through the nodes.
    barycentric: Vec<f64>,
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
            .collect();
        Self { nodes, weights, barycentric }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never: a rule has at least one point.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The coefficients with which values at the nodes give the interpolating polynomial's value at `x`.
    pub fn interpolation(&self, x: f64, coefficients: &mut Vec<f64>) {
        coefficients.clear();
        self.for_each_coefficient(x, |_, coefficient| coefficients.push(coefficient));
    }

    /// The same without memory: `take(node, coefficient)`, in the nodes' order.
    pub fn for_each_coefficient(&self, x: f64, mut take: impl FnMut(usize, f64)) {
        if let Some(hit) = self.nodes.iter().position(|node| *node == x) {
            (0..self.len()).for_each(|i| take(i, if i == hit { 1.0 } else { 0.0 }));
            return;
        }
        let shares = || self.barycentric.iter().zip(&self.nodes).map(|(weight, node)| weight / (x - node));
        let sum: f64 = shares().sum();
        shares().enumerate().for_each(|(i, share)| take(i, share / sum));
    }
}

/// The rules of one solver.
#[derive(Debug, Clone)]
pub struct Rules {
    rules: Vec<Rule>,
}

impl Default for Rules {
    fn default() -> Self {
        Self { rules: SIZES.iter().map(|count| Rule::gauss_legendre(*count)).collect() }
    }
}

impl Rules {
    /// The smallest rule that integrates a segment's inertia to 1e-10 of itself when the segment turns by `angle` = Ωℓ rad
    /// (measured: 7 + 0.6 Ωℓ points, six below a radian), as an index for [`Rules::rule`].
    pub fn for_angle(&self, angle: f64) -> usize {
        let needed = if angle <= 1.0 { 6.0 } else { 7.0 + 0.6 * angle };
        SIZES.iter().position(|count| *count as f64 >= needed).unwrap_or(SIZES.len() - 1)
    }

    /// The rule for a strand whose most turned element turns by `angle`, given the rule `current` that it uses: changes only when it
    /// must, or when a smaller one would do with a margin, so that a strand near a border does not flicker between two.
    pub fn next_for_angle(&self, current: usize, angle: f64) -> usize {
        let wanted = self.for_angle(1.1 * angle);
        if wanted >= current { wanted } else { self.for_angle(1.3 * angle + 0.3).min(current) }
    }

    /// A rule by index.
    pub fn rule(&self, index: usize) -> &Rule {
        &self.rules[index]
    }

    /// Bytes on the heap, of this value in a box.
    pub fn heap_bytes(&self) -> usize {
        let lists = |rule: &Rule| rule.nodes.capacity() + rule.weights.capacity() + rule.barycentric.capacity();
        let numbers: usize = self.rules.iter().map(lists).sum();
        size_of::<Self>() + self.rules.capacity() * size_of::<Rule>() + numbers * size_of::<f64>()
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
        for count in SIZES {
            let rule = Rule::gauss_legendre(count);
            assert_eq!(rule.len(), count);
            for degree in 0..2 * count {
                let sum: f64 = rule.nodes.iter().zip(&rule.weights).map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = 1.0 / (degree as f64 + 1.0);
                assert!((sum - exact).abs() < 4e-15, "{count} points, degree {degree}: {sum} against {exact}");
            }
        }
    }

    #[test]
    fn interpolates_smooth_functions() {
        let (from, to) = (Rule::gauss_legendre(20), Rule::gauss_legendre(32));
        let mut coefficients = Vec::new();
        for x in to.nodes.iter().chain(&[0.0, 1.0]).chain(&from.nodes) {
            from.interpolation(*x, &mut coefficients);
            let value: f64 = coefficients.iter().zip(&from.nodes).map(|(c, node)| c * (9.0 * node).cos()).sum();
            assert!((value - (9.0 * x).cos()).abs() < 1e-10);
        }
    }

    #[test]
    fn rules_grow_with_the_angle_and_do_not_flicker() {
        let rules = Rules::default();
        let mut last = 0;
        for step in 0..400 {
            let angle = f64::from(step) * 0.4;
            let index = rules.for_angle(angle);
            assert!(index >= last && rules.rule(index).len() as f64 >= if angle > 1.0 { 7.0 + 0.6 * angle } else { 6.0 });
            last = index;
            let chosen = rules.next_for_angle(0, angle);
            assert_eq!(rules.next_for_angle(chosen, angle * 0.99), chosen);
        }
    }
}
