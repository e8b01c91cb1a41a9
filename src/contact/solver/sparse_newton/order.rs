//! The order of elimination: which strands' contacts come together in one front, and where each contact is eliminated.
//!
//! Blocks (strands) are the vertices of a graph and contacts its edges: all contacts of one block move each other. To eliminate
//! those between two blocks contracts their edges: the two become one vertex, at which all their other contacts move each other.
//! Those two whose union has the fewest contacts left come next: minimum degree (Tinney and Walker 1967), with a front (Duff and
//! Reid 1983) at every vertex.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::contact::solver::system::System;

/// Costs in nanoseconds or so: of a row in a front, of each pair of rows in it, of a pair's response where the front is a
/// block's; and the number of multiplications of an elimination per nanosecond.
const WORK_A_ROW: u64 = 150;
const WORK_A_PAIR: u64 = 10;
const WORK_A_RESPONSE: u64 = 20;
const MULTIPLICATIONS: u64 = 4;

/// What a front is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// A block, by its index.
    Block(usize),
    /// Two other fronts, by their indices.
    Joined([usize; 2]),
}

/// A vertex of the graph, of one block or of several.
#[derive(Debug, Clone)]
pub(super) struct Front {
    pub(super) origin: Origin,
    /// The rows that are eliminated in it, ascending: those of no other vertex.
    pub(super) pivots: Vec<u32>,
    /// Its other rows, ascending.
    pub(super) others: Vec<u32>,
}

impl Front {
    /// The number of its rows.
    pub(super) fn rows(&self) -> usize {
        self.pivots.len() + self.others.len()
    }

    /// The cost of its elimination, nanoseconds or so.
    pub(super) fn work(&self) -> u64 {
        let (rows, pivots) = (self.rows() as u64, self.pivots.len() as u64);
        let pair = match self.origin {
            Origin::Block(_) => WORK_A_PAIR + WORK_A_RESPONSE,
            Origin::Joined(_) => WORK_A_PAIR,
        };
        WORK_A_ROW * rows + pair * rows * rows + 27 * rows * rows * pivots / MULTIPLICATIONS
    }
}

/// The order. Its memory is kept.
#[derive(Debug, Clone, Default)]
pub(super) struct Order {
    /// Those in use first.
    fronts: Vec<Front>,
    /// The number in use.
    count: usize,
    /// Their indices in the order of elimination.
    sequence: Vec<u32>,
    /// The front that a front has become part of, or itself.
    part_of: Vec<usize>,
    /// Of every row: the fronts of its blocks, twice the same where both are one.
    ends: Vec<[usize; 2]>,
    /// Pairs of fronts with common rows: how many rows they would leave, and their indices.
    pairs: BinaryHeap<Reverse<(usize, usize, usize)>>,
    neighbours: Vec<usize>,
    stack: Vec<(usize, bool)>,
}

/// No front.
const NONE: usize = usize::MAX;

impl Order {
    /// The number of fronts.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// The fronts in the order of elimination: before a front come the two that it is made of, the second right before it, each
    /// after all that it is made of.
    pub(super) fn fronts(&self) -> impl DoubleEndedIterator<Item = &Front> + ExactSizeIterator {
        self.sequence.iter().map(|front| &self.fronts[*front as usize])
    }

    /// The front at a place in that order.
    pub(super) fn front(&self, place: usize) -> &Front {
        self.part(self.sequence[place] as usize)
    }

    /// One of the fronts that another is made of, by its index.
    pub(super) fn part(&self, index: usize) -> &Front {
        &self.fronts[index]
    }

    /// Finds the order of the rows that are `active`. None if all fronts together cost more than `most` ([`Front::work`]).
    pub(super) fn find(&mut self, system: &System, active: &[bool], most: u64) -> Option<u64> {
        self.count = 0;
        self.part_of.clear();
        self.ends.clear();
        self.ends.resize(system.rows.len(), [NONE; 2]);
        self.pairs.clear();
        for block in 0..system.blocks() {
            let mut rows = system.rows_of(block).iter().filter(|row| active[**row as usize]).peekable();
            if rows.peek().is_some() {
                for row in rows {
                    let ends = &mut self.ends[*row as usize];
                    *ends = if ends[0] == NONE { [self.count; 2] } else { [ends[0], self.count] };
                }
                self.begin(Origin::Block(block));
            }
        }
        let blocks = self.count;
        for front in &mut self.fronts[..blocks] {
            let Origin::Block(block) = front.origin else { continue };
            for row in system.rows_of(block).iter().filter(|row| active[**row as usize]) {
                let [first, second] = self.ends[*row as usize];
                if first == second { front.pivots.push(*row) } else { front.others.push(*row) }
            }
        }
        let mut work: u64 = self.fronts[..blocks].iter().map(Front::work).sum();
        for front in 0..blocks {
            self.offer(front);
        }
        while let Some(Reverse((_, a, b))) = self.pairs.pop() {
            if self.part_of[a] == a && self.part_of[b] == b {
                self.join(a, b);
                work += self.fronts[self.count - 1].work();
            }
            if work > most {
                return None;
            }
        }
        self.put_in_sequence();
        (work <= most).then_some(work)
    }

    fn begin(&mut self, origin: Origin) {
        if self.fronts.len() == self.count {
            self.fronts.push(Front { origin, pivots: Vec::new(), others: Vec::new() });
        }
        let front = &mut self.fronts[self.count];
        front.origin = origin;
        front.pivots.clear();
        front.others.clear();
        self.part_of.push(self.count);
        self.count += 1;
    }

    /// Joins two fronts: the rows of both are eliminated.
    fn join(&mut self, a: usize, b: usize) {
        let joint = self.count;
        self.begin(Origin::Joined([a, b]));
        let (before, front) = self.fronts.split_at_mut(joint);
        let (first, second, front) = (&before[a].others, &before[b].others, &mut front[0]);
        let (mut i, mut j) = (0, 0);
        while i < first.len() && j < second.len() {
            let (row, other) = (first[i], second[j]);
            if row == other {
                front.pivots.push(row)
            } else {
                front.others.push(row.min(other))
            }
            i += usize::from(row <= other);
            j += usize::from(other <= row);
        }
        front.others.extend_from_slice(&first[i..]);
        front.others.extend_from_slice(&second[j..]);
        (self.part_of[a], self.part_of[b]) = (joint, joint);
        self.offer(joint);
    }

    /// Adds the pairs that a front makes with others.
    fn offer(&mut self, front: usize) {
        self.neighbours.clear();
        for row in &self.fronts[front].others {
            let ends = &mut self.ends[*row as usize];
            for end in &mut *ends {
                while self.part_of[*end] != *end {
                    *end = self.part_of[*end];
                }
            }
            self.neighbours.push(if ends[0] == front { ends[1] } else { ends[0] });
        }
        self.neighbours.sort_unstable();
        let own = self.fronts[front].others.len();
        for common in self.neighbours.chunk_by(|a, b| a == b) {
            let other = common[0];
            let left = own + self.fronts[other].others.len() - 2 * common.len();
            self.pairs.push(Reverse((left, front.min(other), front.max(other))));
        }
    }

    fn put_in_sequence(&mut self) {
        self.sequence.clear();
        self.stack.clear();
        self.stack.extend((0..self.count).rev().filter(|front| self.part_of[*front] == *front).map(|front| (front, false)));
        while let Some((front, is_next)) = self.stack.pop() {
            match self.fronts[front].origin {
                Origin::Joined(two) if !is_next => {
                    self.stack.push((front, true));
                    self.stack.extend(two.into_iter().rev().map(|front| (front, false)));
                }
                _ => self.sequence.push(front as u32),
            }
        }
    }
}
