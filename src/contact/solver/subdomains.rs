//! The subdomains of a large problem, a binary tree: strands are in subdomains of the lowest level, two of these make one of
//! the level above, and the highest one is the whole. A contact is in the smallest subdomain that has all its strands, so that
//! subdomains of one level can be swept side by side after those below. They are numbered level by level, the lowest first.
//!
//! Files:
//!
//! - `partition.rs`: Divides a large problem into subdomains that threads sweep side by side.

pub mod partition;

use std::ops::Range;

/// The ends of subdomains in lists sorted by them. Empty: the problem is one subdomain.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Subdomains {
    coordinates: Vec<usize>,
    constraints: Vec<usize>,
}

impl Subdomains {
    /// Sets the ends of the coordinates of every lowest subdomain, a power of two of them, and of the contacts of every
    /// subdomain.
    pub(in crate::contact) fn set(&mut self, coordinate_ends: impl Iterator<Item = usize>, constraint_ends: &[usize]) {
        self.coordinates.clear();
        self.coordinates.extend(coordinate_ends);
        self.constraints.clear();
        self.constraints.extend_from_slice(constraint_ends);
        assert!(self.lowest().is_power_of_two() && self.constraints.len() == 2 * self.lowest() - 1, "{self:?}");
    }

    /// Makes the problem one subdomain.
    pub(in crate::contact) fn clear(&mut self) {
        self.coordinates.clear();
        self.constraints.clear();
    }

    /// The number of lowest subdomains.
    pub(in crate::contact) fn lowest(&self) -> usize {
        self.coordinates.len().max(1)
    }

    /// The ends of the coordinates of every lowest subdomain, of `all`.
    pub(in crate::contact) fn coordinate_ends(&self, all: usize) -> impl Iterator<Item = usize> {
        ends(&self.coordinates, all)
    }

    /// The ends of the contacts of every subdomain, of `all`.
    pub(in crate::contact) fn constraint_ends(&self, all: usize) -> impl Iterator<Item = usize> {
        ends(&self.constraints, all)
    }
}

fn ends(ends: &[usize], all: usize) -> impl Iterator<Item = usize> {
    ends.iter().copied().chain(ends.is_empty().then_some(all))
}

/// The levels for this number of lowest subdomains, the lowest first: the subdomains of each.
pub(in crate::contact) fn levels(lowest: usize) -> impl Iterator<Item = Range<usize>> {
    (0..=lowest.ilog2()).map(move |level| {
        let first = 2 * lowest - ((2 * lowest) >> level);
        first..first + (lowest >> level)
    })
}

/// The lowest subdomains in the `k`-th subdomain of a level.
pub(in crate::contact) fn lowest_of(level: usize, k: usize) -> Range<usize> {
    k << level..(k + 1) << level
}

/// The smallest subdomain above (or among) the `lowest` ones that includes both of these.
pub(in crate::contact) fn smallest(lowest: u32, ends: [Option<u32>; 2]) -> u32 {
    let (a, b) = match ends {
        [Some(a), Some(b)] => (a, b),
        [Some(a), None] | [None, Some(a)] => (a, a),
        [None, None] => (0, 0),
    };
    let level = u32::BITS - (a ^ b).leading_zeros();
    2 * lowest - ((2 * lowest) >> level) + (a >> level)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subdomains_are_numbered_level_by_level_and_the_smallest_with_both_strands_is_found() {
        assert!(levels(1).eq(std::iter::once(0..1)));
        assert_eq!(levels(4).collect::<Vec<_>>(), [0..4, 4..6, 6..7]);
        for a in 0..8 {
            for b in 0..8 {
                let part = smallest(8, [Some(a), Some(b)]) as usize;
                let has = |level: usize, k: usize| [a, b].iter().all(|end| lowest_of(level, k).contains(&(*end as usize)));
                let all = levels(8)
                    .enumerate()
                    .flat_map(|(level, subdomains)| subdomains.enumerate().map(move |(k, part)| (part, level, k)));
                let first = all.filter(|(_, level, k)| has(*level, *k)).map(|(part, ..)| part).min();
                assert_eq!(first, Some(part), "{a} and {b}");
            }
        }
        assert_eq!(smallest(4, [Some(2), None]), 2);
    }
}
