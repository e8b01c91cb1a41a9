//! Sample elimination: of many random candidates the most crowded are removed, one after the other (Yuksel, "Sample elimination
//! for generating Poisson disk sample sets", 2015).

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;

/// Pairs of neighbouring candidates: for each the other's index and their distance, relative to the largest that counts.
pub(super) struct Neighbours {
    /// The start of each candidate's list; the end of the last.
    starts: Vec<usize>,
    list: Vec<(u32, f32)>,
}

impl Neighbours {
    /// From all pairs, each once.
    pub fn new(candidates: usize, pairs: &[(u32, u32, f32)]) -> Self {
        let mut starts = vec![0; candidates + 1];
        for (a, b, _) in pairs {
            starts[*a as usize + 1] += 1;
            starts[*b as usize + 1] += 1;
        }
        for index in 0..candidates {
            starts[index + 1] += starts[index];
        }
        let mut next = starts.clone();
        let mut list = vec![(0, 0.0); 2 * pairs.len()];
        for (a, b, distance) in pairs {
            for (one, other) in [(*a, *b), (*b, *a)] {
                list[next[one as usize]] = (other, *distance);
                next[one as usize] += 1;
            }
        }
        Self { starts, list }
    }

    fn of(&self, index: usize) -> &[(u32, f32)] {
        &self.list[self.starts[index]..self.starts[index + 1]]
    }
}

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Until {
    /// When this many are left.
    Left(usize),
    /// When no two are neighbours; removed ones without a remaining neighbour come back.
    Apart,
}

#[derive(PartialEq)]
struct Crowded {
    weight: f64,
    index: u32,
}

impl Eq for Crowded {}

impl Ord for Crowded {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(other.index.cmp(&self.index))
    }
}

impl PartialOrd for Crowded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Which candidates stay. `least` is the fraction of the largest distance below which closer pairs count no more (Yuksel's weight
/// limiting).
pub(super) fn survivors(neighbours: &Neighbours, until: Until, least: f64) -> Vec<bool> {
    let count = neighbours.starts.len() - 1;
    let fraction = |distance: f32| {
        let free = (1.0 - f64::from(distance).max(least)).max(0.0);
        // The eighth power.
        let square = free * free;
        let eighth = (square * square) * (square * square);
        // If no neighbours may remain, the candidate with the most of them goes first: a tenth more stay than by distance.
        if until == Until::Apart { 1.0 + 1e-3 * eighth } else { eighth }
    };
    let mut weights: Vec<f64> = (0..count).map(|index| neighbours.of(index).iter().map(|(_, d)| fraction(*d)).sum()).collect();
    let mut crowding: Vec<u32> = (0..count).map(|index| neighbours.of(index).len() as u32).collect();
    let mut heap: BinaryHeap<Crowded> =
        weights.iter().enumerate().map(|(index, weight)| Crowded { weight: *weight, index: index as u32 }).collect();
    let mut stays = vec![true; count];
    let mut gone = Vec::new();
    let mut left = count;
    let wanted = match until {
        Until::Left(wanted) => wanted,
        Until::Apart => 0,
    };
    while left > wanted {
        let Some(mut most) = heap.peek_mut() else { break };
        let at = most.index as usize;
        // Weights only fall: an entry is at least its candidate's current weight, and is corrected when it comes to the top.
        if most.weight != weights[at] {
            most.weight = weights[at];
            continue;
        }
        PeekMut::pop(most);
        if until == Until::Apart && crowding[at] == 0 {
            continue;
        }
        stays[at] = false;
        left -= 1;
        gone.push(at);
        for (other, distance) in neighbours.of(at) {
            let other = *other as usize;
            crowding[other] -= 1;
            if stays[other] {
                let less = if crowding[other] == 0 { 0.0 } else { weights[other] - fraction(*distance) };
                weights[other] = less.min(weights[other]);
            }
        }
    }
    if until == Until::Apart {
        for at in gone.into_iter().rev() {
            stays[at] = neighbours.of(at).iter().all(|(other, _)| !stays[*other as usize]);
        }
    }
    stays
}
