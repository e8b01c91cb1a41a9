//! The places between a strand's quadrature points at which surfaces are asked for (`probes.rs`): halfway from each point to the next, and
//! the tip. Each is interpolated by Lagrange's polynomial through the points around it.

use crate::math::quadrature::Rule;
use crate::math::vector::Vec3;

/// A place is interpolated from this many points.
const STENCIL: usize = 4;

/// The places of a strand, one about each point. Strands whose elements are in the same proportion have the same.
#[derive(Debug, Clone, Default)]
pub(super) struct HalfwayPlaces {
    /// What they were made for: the quadrature nodes, and the elements' lengths over the first one's.
    nodes: Vec<f64>,
    ratios: Vec<f64>,
    /// The points' arclengths in lengths of the first element.
    at: Vec<f64>,
    places: Vec<Halfway>,
}

/// A place about a point: halfway to the next, or the tip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Halfway {
    first: usize,
    count: usize,
    weights: [f64; STENCIL],
}

impl HalfwayPlaces {
    /// Makes them those of a strand with elements of these `lengths`.
    pub fn prepare(&mut self, rule: &Rule, lengths: &[f64]) {
        let ratio = |length: &f64| if *length == lengths[0] { 1.0 } else { length / lengths[0] };
        if self.nodes == *rule.nodes
            && self.ratios.len() == lengths.len()
            && self.ratios.iter().copied().eq(lengths.iter().map(ratio))
        {
            return;
        }
        self.nodes.clear();
        self.nodes.extend_from_slice(&rule.nodes);
        self.ratios.clear();
        self.ratios.extend(lengths.iter().map(ratio));
        self.at.clear();
        let mut length = 0.0;
        for ratio in &self.ratios {
            self.at.extend(self.nodes.iter().map(|node| length + node * ratio));
            length += ratio;
        }
        self.places.clear();
        for (p, here) in self.at.iter().enumerate() {
            let place = self.at.get(p + 1).map_or(length, |next| 0.5 * (here + next));
            self.places.push(Halfway::new(&self.at, p, place));
        }
    }

    /// The place about point `p`.
    pub fn about(&self, p: usize) -> &Halfway {
        &self.places[p]
    }
}

impl Halfway {
    /// The weights of points `at` these arclengths for a `place` about point `p`.
    fn new(at: &[f64], p: usize, place: f64) -> Self {
        let count = at.len().min(STENCIL);
        let first = p.saturating_sub(1).min(at.len() - count);
        let at = &at[first..first + count];
        let weight = |i: usize| {
            let others = at.iter().enumerate().filter(|(j, _)| *j != i);
            others.fold(1.0, |weight, (_, other)| weight * (place - other) / (at[i] - other))
        };
        Self { first, count, weights: std::array::from_fn(|i| if i < count { weight(i) } else { 0.0 }) }
    }

    /// Interpolates what the points have.
    #[inline]
    pub fn between(&self, of_point: impl Fn(usize) -> Vec3<f64>) -> Vec3<f64> {
        let mut place = Vec3::zero();
        for (i, weight) in self.weights[..self.count].iter().enumerate() {
            place += of_point(self.first + i).scale(*weight);
        }
        place
    }

    /// The most that the length of something interpolated can be, by its lengths at the points.
    #[inline]
    pub fn at_most(&self, of_point: impl Fn(usize) -> f64) -> f64 {
        self.weights[..self.count].iter().enumerate().map(|(i, weight)| weight.abs() * of_point(self.first + i)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The places of a strand, with the points' arclengths and those of the places, m.
    fn places(nodes: usize, lengths: &[f64]) -> (HalfwayPlaces, Vec<f64>, Vec<f64>) {
        let rule = Rule::gauss_legendre(nodes);
        let mut halfway = HalfwayPlaces::default();
        halfway.prepare(&rule, lengths);
        let mut at = Vec::new();
        for (e, length) in lengths.iter().enumerate() {
            at.extend(rule.nodes.iter().map(|node| lengths[..e].iter().sum::<f64>() + node * length));
        }
        let tip = lengths.iter().sum();
        let between = (0..at.len()).map(|p| at.get(p + 1).map_or(tip, |next| 0.5 * (at[p] + next))).collect();
        (halfway, at, between)
    }

    #[test]
    fn places_are_interpolated_to_as_high_a_degree_as_there_are_points() {
        for (nodes, lengths) in [(4, &[0.01, 0.03, 0.02][..]), (3, &[0.05]), (2, &[0.05]), (1, &[0.05]), (1, &[0.02, 0.03, 0.01])]
        {
            let (halfway, at, between) = places(nodes, lengths);
            let degree = at.len().min(STENCIL) - 1;
            let curve = |s: f64| Vec3([1.0, s.powi(degree as i32), 2.0 * s.powi(degree as i32 / 2)]);
            for (p, s) in between.iter().enumerate() {
                let off = halfway.about(p).between(|k| curve(at[k])) - curve(*s);
                assert!(off.norm_squared().sqrt() < 1e-14, "{nodes} nodes, place {p}: {off:?}");
            }
        }
    }

    #[test]
    fn what_is_interpolated_is_no_longer_than_the_most_it_can_be() {
        let (halfway, at, _) = places(4, &[0.01, 0.03, 0.02]);
        // The worst case: each point goes the way that its weight has.
        for p in 0..at.len() {
            let place = halfway.about(p);
            let way = |k: usize| Vec3([place.weights[k - place.first].signum() * (1.0 + k as f64), 0.0, 0.0]);
            let most = place.at_most(|k| 1.0 + k as f64);
            assert!((place.between(way).0[0] - most).abs() < 1e-12 * most);
        }
    }

    #[test]
    fn strands_in_other_proportions_have_other_places_whatever_came_before() {
        let (mut halfway, ..) = places(4, &[0.02, 0.02]);
        let even = halfway.about(3).weights;
        halfway.prepare(&Rule::gauss_legendre(4), &[0.01, 0.03]);
        assert_ne!(halfway.about(3).weights, even);
        halfway.prepare(&Rule::gauss_legendre(4), &[0.05, 0.05]);
        assert_eq!(halfway.about(3).weights, even);
        halfway.prepare(&Rule::gauss_legendre(3), &[0.05, 0.05]);
        assert_eq!(halfway.places.len(), 6);
    }
}
