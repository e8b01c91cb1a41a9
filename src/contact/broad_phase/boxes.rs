//! Which boxes of many overlap: a uniform grid, sorted by counting. Its cost grows with the number of boxes and of pairs found.
//!
//! Boxes go into every cell they meet; a pair that meets in several cells counts in one of them only: the one with the lower corner of what
//! the two have in common. Memory is kept from call to call.

use std::ops::Range;

use nalgebra::Vector3;

use crate::contact::shape::Bounds;

/// Cells along an axis, at most (their numbers are packed into one word).
const MAX_CELLS: f64 = 1_000_000.0;
/// A cell's side over the mean of the boxes' longest sides.
const CELL: f64 = 1.5;
/// Cells a box is in, on average, at most: few boxes of many sizes would fill memory with the small ones' cells.
const MAX_ENTRIES: f64 = 24.0;

#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    cell: u64,
    item: u32,
}

/// Memory of [`Grid::pairs`].
#[derive(Debug, Default)]
pub struct Grid {
    starts: Vec<u32>,
    entries: Vec<Entry>,
    cells: Vec<[[u32; 3]; 2]>,
    bucket: Bucket,
}

/// Boxes of a bucket that are held against one at a time.
const SIDE_BY_SIDE: usize = 16;

/// The boxes of a bucket's entries, in groups side by side.
#[derive(Debug, Default)]
pub struct Bucket {
    groups: Vec<Group>,
}

/// Boxes in single precision: to round keeps the order of two numbers, so that boxes that meet still do.
#[derive(Debug)]
struct Group {
    low: [[f32; SIDE_BY_SIDE]; 3],
    high: [[f32; SIDE_BY_SIDE]; 3],
    /// Which of them there are, and which are asked about, one bit each.
    present: u32,
    asked: u32,
}

impl Group {
    fn of(entries: &[Entry], boxes: &[Bounds], asked: &impl Fn(usize) -> bool) -> Self {
        let empty = [[f32::INFINITY; SIDE_BY_SIDE]; 3];
        let mut group = Self { low: empty, high: empty, present: (1 << entries.len()) - 1, asked: 0 };
        for (k, entry) in entries.iter().enumerate() {
            let Bounds { low, high } = &boxes[entry.item as usize];
            for axis in 0..3 {
                (group.low[axis][k], group.high[axis][k]) = (low[axis] as f32, high[axis] as f32);
            }
            group.asked |= u32::from(asked(entry.item as usize)) << k;
        }
        group
    }
}

impl Bucket {
    fn fill(&mut self, entries: &[Entry], boxes: &[Bounds], asked: &impl Fn(usize) -> bool) {
        self.groups.clear();
        self.groups.extend(entries.chunks(SIDE_BY_SIDE).map(|entries| Group::of(entries, boxes, asked)));
    }

    /// The later boxes of a group that may meet an entry's box and are asked about, or all if the entry is: one bit each.
    #[inline(always)]
    fn may_meet(&self, entry: usize, group: usize) -> u32 {
        let (own, lane) = (&self.groups[entry / SIDE_BY_SIDE], entry % SIDE_BY_SIDE);
        let other = &self.groups[group];
        let later = if group == entry / SIDE_BY_SIDE { u32::MAX << (lane + 1) } else { u32::MAX };
        let counts = later & if own.asked >> lane & 1 == 1 { other.present } else { other.asked };
        if counts == 0 {
            return 0;
        }
        let mut meets = [true; SIDE_BY_SIDE];
        for axis in 0..3 {
            let (low, high) = (own.low[axis][lane], own.high[axis][lane]);
            for k in 0..SIDE_BY_SIDE {
                meets[k] &= (low <= other.high[axis][k]) & (other.low[axis][k] <= high);
            }
        }
        let bits = meets.iter().enumerate().fold(0, |bits, (k, meets)| bits | u32::from(*meets) << k);
        bits & counts
    }
}

fn pack(cell: [u32; 3]) -> u64 {
    (u64::from(cell[0]) << 42) | (u64::from(cell[1]) << 21) | u64::from(cell[2])
}

impl Grid {
    /// Calls `found(i, j)` once for every pair of boxes that meet and of which one is `asked`, i < j, in an order that depends on the boxes alone.
    /// Boxes that are not finite meet nothing.
    pub fn pairs(&mut self, boxes: &[Bounds], asked: impl Fn(usize) -> bool, found: impl FnMut(u32, u32)) {
        let buckets = self.fill(boxes);
        let mut bucket = std::mem::take(&mut self.bucket);
        self.pairs_in(0..buckets, boxes, &mut bucket, asked, found);
        self.bucket = bucket;
    }

    /// Sorts the boxes into cells and these into buckets, and returns the number of buckets.
    pub fn fill(&mut self, boxes: &[Bounds]) -> usize {
        let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        let (mut sides, mut count) = (0.0, 0.0);
        for item in boxes.iter().filter(|item| item.is_finite()) {
            (low, high) = (low.inf(&item.low), high.sup(&item.high));
            sides += (item.high - item.low).max();
            count += 1.0;
        }
        if count < 2.0 {
            return 0;
        }
        let mut side = (CELL * sides / count).max((high - low).max() / MAX_CELLS).max(f64::MIN_POSITIVE);
        while self.number(boxes, &low, side) > MAX_ENTRIES * count {
            side *= 1.5;
        }

        // Twice as many buckets as entries, and entries counted into them.
        let total: usize = self.cells.iter().map(|span| Self::cells_of(span) as usize).sum();
        let bits = usize::BITS - (2 * total).leading_zeros();
        let bucket = |cell: u64| (cell.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (64 - bits)) as usize;
        self.starts.clear();
        self.starts.resize((1 << bits) + 1, 0);
        for span in &self.cells {
            Self::each_cell(span, |cell| self.starts[bucket(cell) + 1] += 1);
        }
        for index in 0..1 << bits {
            self.starts[index + 1] += self.starts[index];
        }
        self.entries.clear();
        self.entries.resize(total, Entry::default());
        // Filled from the back, so that the starts end where they belong.
        for (item, span) in self.cells.iter().enumerate().rev() {
            Self::each_cell(span, |cell| {
                let place = &mut self.starts[bucket(cell) + 1];
                *place -= 1;
                self.entries[*place as usize] = Entry { cell, item: item as u32 };
            });
        }
        // Now starts[k + 1] is where bucket k begins; where it ends is where the next one begins.
        1 << bits
    }

    /// The pairs of [`Grid::pairs`] in some of the buckets of the last [`Grid::fill`]: any number of threads may ask for
    /// theirs, each with a `bucket` for memory.
    pub fn pairs_in(
        &self,
        buckets: Range<usize>,
        boxes: &[Bounds],
        bucket: &mut Bucket,
        asked: impl Fn(usize) -> bool,
        mut found: impl FnMut(u32, u32),
    ) {
        for index in buckets {
            let from = self.starts[index + 1] as usize;
            let to = self.starts.get(index + 2).map_or(self.entries.len(), |next| *next as usize);
            let entries = &self.entries[from..to];
            if entries.len() < 2 || !entries.iter().any(|entry| asked(entry.item as usize)) {
                continue;
            }
            bucket.fill(entries, boxes, &asked);
            for (i, first) in entries.iter().enumerate() {
                for group in i / SIDE_BY_SIDE..bucket.groups.len() {
                    let mut meeting = bucket.may_meet(i, group);
                    while meeting != 0 {
                        let second = &entries[group * SIDE_BY_SIDE + meeting.trailing_zeros() as usize];
                        meeting &= meeting - 1;
                        if first.cell == second.cell && boxes[first.item as usize].meets(&boxes[second.item as usize]) {
                            let (of_a, of_b) = (self.cells[first.item as usize][0], self.cells[second.item as usize][0]);
                            let common = [of_a[0].max(of_b[0]), of_a[1].max(of_b[1]), of_a[2].max(of_b[2])];
                            if pack(common) == first.cell {
                                found(first.item.min(second.item), first.item.max(second.item));
                            }
                        }
                    }
                }
            }
        }
    }

    /// Finds the cells of every box for this side, and returns their total.
    fn number(&mut self, boxes: &[Bounds], low: &Vector3<f64>, side: f64) -> f64 {
        self.cells.clear();
        let mut number = 0.0;
        for item in boxes {
            if !item.is_finite() {
                self.cells.push([[1; 3], [0; 3]]);
                continue;
            }
            let of = |at: &Vector3<f64>| [0, 1, 2].map(|axis| ((at[axis] - low[axis]) / side) as u32);
            let span = [of(&item.low), of(&item.high)];
            number += Self::cells_of(&span);
            self.cells.push(span);
        }
        number
    }

    fn cells_of([from, to]: &[[u32; 3]; 2]) -> f64 {
        (0..3).map(|axis| (f64::from(to[axis]) - f64::from(from[axis]) + 1.0).max(0.0)).product()
    }

    #[inline(always)]
    fn each_cell([from, to]: &[[u32; 3]; 2], mut emit: impl FnMut(u64)) {
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    emit(pack([x, y, z]));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_boxes_is_found_once() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut grid = Grid::default();
        // The last round has boxes a thousand times larger than others.
        for (count, spread) in [(2, 1.0), (50, 1.0), (400, 1.0), (400, 3.0)] {
            let mut boxes: Vec<Bounds> = (0..count)
                .map(|_| {
                    let low = Vector3::new(random(), random(), random()) - Vector3::repeat(0.5);
                    let high = low + Vector3::new(random(), random(), random()) * 0.3 * 10.0_f64.powf(-spread * random());
                    Bounds { low, high }
                })
                .collect();
            boxes.push(Bounds { low: Vector3::repeat(f64::NAN), high: Vector3::repeat(0.0) });
            let mut expected = Vec::new();
            for i in 0..boxes.len() as u32 {
                for j in i + 1..boxes.len() as u32 {
                    if boxes[i as usize].meets(&boxes[j as usize]) {
                        expected.push((i, j));
                    }
                }
            }
            let mut pairs = Vec::new();
            grid.pairs(&boxes, |_| true, |i, j| pairs.push((i, j)));
            pairs.sort_unstable();
            assert_eq!(pairs, expected);
            let asked = |item: usize| item.is_multiple_of(7);
            pairs.clear();
            grid.pairs(&boxes, asked, |i, j| pairs.push((i, j)));
            pairs.sort_unstable();
            expected.retain(|(i, j)| asked(*i as usize) || asked(*j as usize));
            assert_eq!(pairs, expected);
        }
    }
}
