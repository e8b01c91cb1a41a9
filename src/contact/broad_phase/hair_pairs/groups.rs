//! The candidates of two strands.

use std::ops::Range;

use super::HairPairs;

/// The candidates of two strands, a range of all candidates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Group {
    /// Index of the first strand.
    pub a: u32,
    /// Index of the second; not less than the first.
    pub b: u32,
    from: u32,
    to: u32,
}

impl Group {
    /// Where its pairs of chords are among all candidates.
    pub(super) fn range(&self) -> Range<usize> {
        self.from as usize..self.to as usize
    }

    /// The number of pairs of chords.
    pub fn candidates(&self) -> u32 {
        self.to - self.from
    }
}

impl HairPairs {
    /// Groups the candidates by their strands.
    pub(super) fn group(&mut self) {
        let Self { pieces, candidates, groups, counts, .. } = self;
        groups.clear();
        for (index, (i, j)) in candidates.iter().enumerate() {
            let [a, b] = [*i, *j].map(|chord| pieces.strand_of(chord as usize) as u32);
            match groups.last_mut() {
                Some(group) if (group.a, group.b) == (a, b) => group.to = index as u32 + 1,
                _ => groups.push(Group { a, b, from: index as u32, to: index as u32 + 1 }),
            }
        }
        (counts.pieces, counts.candidates, counts.groups) = (pieces.pieces.len(), candidates.len(), groups.len());
    }
}
