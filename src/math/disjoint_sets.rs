//! Disjoint sets of indices that are joined one by one (union and find, with paths halved).

/// Sets of the indices from 0 on, each named by its lowest index.
#[derive(Debug, Clone, Default)]
pub struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    /// Makes every index below `count` a set of its own.
    pub fn reset(&mut self, count: usize) {
        self.parents.clear();
        self.parents.extend(0..count as u32);
    }

    /// The lowest index of an index's set.
    pub fn lowest(&mut self, mut index: u32) -> u32 {
        let parents = &mut self.parents;
        while parents[index as usize] != index {
            parents[index as usize] = parents[parents[index as usize] as usize];
            index = parents[index as usize];
        }
        index
    }

    /// Joins the sets of two indices.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.lowest(a), self.lowest(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_sets_are_named_by_their_lowest_index() {
        let mut sets = DisjointSets::default();
        sets.reset(7);
        for (a, b) in [(5, 3), (6, 5), (1, 2), (3, 6)] {
            sets.join(a, b);
        }
        let lowest: Vec<u32> = (0..7).map(|index| sets.lowest(index)).collect();
        assert_eq!(lowest, [0, 1, 1, 3, 4, 3, 3]);
    }
}
