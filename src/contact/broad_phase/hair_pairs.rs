//! Pairs of strands that may be in contact, kept from step to step, and their contacts.
//!
//! The search for pairs of pieces (`pieces.rs`, `broad_phase.rs`) finds all that come within a margin of contact. The result is
//! valid until a piece has moved by more than its margin, which is checked at every iterate, so that no pair goes undetected.
//! Motion common to all strands (a head that turns) does not count: motion is measured relative to that of the roots.
//!
//! Files:
//!
//! - `contacts.rs`: The contacts of a pair of strands, from the candidates of the last search.
//! - `groups.rs`: The candidates of two strands.
//! - `knots.rs`: Knots: where ties hold strands together their wisps give way to each other.
//! - `memory.rs`: What the search for pairs keeps from step to step, saved and restored for snapshots.
//! - `shared_motion.rs`: The motion that all strands share: that of their roots.

mod contacts;
mod groups;
mod knots;
mod memory;
mod shared_motion;

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

pub use groups::Group;
use knots::Knots;
pub use knots::Tie;
pub(crate) use memory::PairMemory;
use shared_motion::{RigidMotion, Root, roots_of};

use super::boxes::{Bucket, Grid};
use super::pieces::{Pieces, PlacedPieces, Wisp};
use crate::contact::contact_point::StrandPath;
use crate::contact::narrow_phase::segment_distance::closest_of_segments;
use crate::contact::narrow_phase::strand_contacts::relative_motion;
use crate::contact::shape::Bounds;
use crate::error::{Error, Result, check_not_negative};
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Search distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairOptions {
    /// Gaps up to this are contacts, m, zero or above: as far as strands may approach between two searches.
    pub activation: f64,
    /// How far a piece may move relative to the rest before pairs are searched for again, m, zero or above. A larger one means
    /// fewer searches and more candidates.
    pub margin: f64,
    /// Contacts next to roots that are held in each other.
    pub held_roots: HeldRoots,
}

/// What becomes of contacts next to roots that are closer to each other than the sum of their strands' radii, see
/// [`Wisp::held_length`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HeldRoots {
    /// They are left out: no force parts the strands there.
    #[default]
    Ignored,
    /// They are found, since all overlaps are asked for.
    Counted,
}

/// The results of searches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PairCounts {
    /// Calls of [`HairPairs::update`].
    pub updates: u64,
    /// Those that searched.
    pub searches: u64,
    /// Pieces of all strands.
    pub pieces: usize,
    /// Pairs of pieces' chords that may be in contact.
    pub candidates: usize,
    /// Pairs of strands with such chords.
    pub groups: usize,
}

/// Some buckets of the grid, and the candidates found in them.
#[derive(Debug, Default)]
struct SearchPart {
    buckets: Range<usize>,
    bucket: Bucket,
    found: Vec<u128>,
}

/// The number of tasks of a search, whatever the threads.
const PARTS: usize = 128;

/// Pairs of strands that may be in contact. Memory is kept: once it has grown, nothing is allocated.
#[derive(Debug, Default)]
pub struct HairPairs {
    wisps: Vec<Wisp>,
    activation: f64,
    margin: f64,
    held_roots: HeldRoots,
    pieces: Pieces,
    knots: Knots,
    grid: Grid,
    boxes: Vec<Bounds>,
    /// Pairs of chords, by strands, pieces, and chords.
    candidates: Vec<(u32, u32)>,
    /// The results of the present search, task by task.
    parts: Vec<SearchPart>,
    /// All of them, as numbers in the candidates' order.
    found: Vec<u128>,
    merged: Vec<(u32, u32)>,
    groups: Vec<Group>,
    start: PlacedPieces,
    /// Sagittas are the larger of then and now.
    now: PlacedPieces,
    placing: Vec<PlacedPieces>,
    /// The start carried along by the common motion of all strands; the rotation of that motion.
    carried: Vec<Vector3<f64>>,
    turned: Matrix3<f64>,
    /// The roots of the strands with a wisp radius, at the start of the step and now.
    roots: [Vec<Root>; 2],
    /// Nodes, roots and sagittas when the candidates were found.
    found_at: Vec<Vector3<f64>>,
    /// Whether a strand, by its index, has moved further than its candidates allow.
    left: Vec<bool>,
    found_roots: Vec<Root>,
    found_sagittas: Vec<f64>,
    counts: PairCounts,
    validity: Validity,
}

/// For which steps the candidates hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Validity {
    /// For none: there are none, or some are missing.
    #[default]
    None,
    /// They were found in an earlier step. This one has begun, and its start has not been placed yet.
    Before,
    /// They were found in an earlier step, and the start of this one is in place.
    Earlier,
    /// They were found in this step, for its start too.
    Present,
}

impl HairPairs {
    /// Sets the wisps. The next [`update`](Self::update) searches.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an option or a wisp that is out of range; nothing is changed then.
    pub fn set(&mut self, wisps: &[Wisp], options: &PairOptions) -> Result<()> {
        check_not_negative(|| "activation".into(), options.activation)?;
        check_not_negative(|| "margin".into(), options.margin)?;
        for (index, wisp) in wisps.iter().enumerate() {
            wisp.check(|| format!("wisps[{index}]"))?;
        }
        self.wisps.clear();
        self.wisps.extend_from_slice(wisps);
        (self.activation, self.margin, self.held_roots) = (options.activation, options.margin, options.held_roots);
        self.validity = Validity::None;
        // The ties were those of other strands.
        self.knots.set(&[], 0, |_| 0.0)
    }

    /// Sets the ties between strands, in place of earlier ones. Beside a knot their contacts have a smaller radius, and next to
    /// it there are none. Needs no new search.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a strand that is none of the wisps, or an arclength that is negative or not finite;
    /// nothing is changed then.
    pub fn set_ties(&mut self, ties: &[Tie]) -> Result<()> {
        let Self { knots, wisps, .. } = self;
        knots.set(ties, wisps.len(), |strand| wisps[strand as usize].radius)
    }

    /// A step begins: the next [`update`](Self::update) has another start. Within a step the starts of its paths are the same.
    pub fn begin_step(&mut self) {
        if self.validity != Validity::None {
            self.validity = Validity::Before;
        }
    }

    /// Updates the strands' positions, at every iterate, and searches if the candidates may be incomplete. True if it searched.
    /// Strands are paths in the order of the wisps; their numbers of elements and their lengths must be those of the last
    /// search (otherwise call [`set`](Self::set)). A strand that is not finite has no contacts until the next search.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for another number of strands than of wisps.
    pub fn update(&mut self, strands: &[StrandPath]) -> Result<bool> {
        self.update_by(strands, &WorkerSet::<()>::serial(), &Meter::unlimited())
    }

    /// [`HairPairs::update`] by workers. If `meter` halts it there are no pairs, and the next update searches.
    pub(crate) fn update_by<S: Default + Send>(
        &mut self,
        strands: &[StrandPath],
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) -> Result<bool> {
        if strands.len() != self.wisps.len() {
            return Err(Error::invalid("strands", strands.len(), format!("{}, the number of wisps", self.wisps.len())));
        }
        self.counts.updates += 1;
        if self.validity != Validity::None {
            if self.validity == Validity::Before {
                self.place_start(strands, workers);
                self.validity = Validity::Earlier;
            }
            self.place(strands, workers);
            if self.now.outgrown {
                self.validity = Validity::None;
            } else if self.are_within() {
                return Ok(false);
            }
        }
        // Within a step the strands that have not moved too far keep their candidates.
        if self.validity != Validity::Present {
            self.pieces.cut(&self.wisps, |strand| strands[strand].now);
            self.place_start(strands, workers);
            self.place(strands, workers);
            self.left.clear();
            self.left.resize(self.wisps.len(), true);
            self.candidates.clear();
            // The search takes over all positions.
            self.found_at.resize(self.now.nodes.len(), Vector3::zeros());
            self.found_sagittas.resize(self.pieces.pieces.len(), 0.0);
        }
        self.search(workers, meter);
        let whole = !meter.is_halted();
        if !whole {
            self.groups.clear();
        }
        self.validity = if whole { Validity::Present } else { Validity::None };
        Ok(true)
    }

    /// Places everything at the start of the step.
    fn place_start<S: Default + Send>(&mut self, strands: &[StrandPath], workers: &WorkerSet<S>) {
        self.pieces.place(&self.wisps, |strand| strands[strand].start, workers, &mut self.placing, &mut self.start);
        roots_of(strands, &self.wisps, |strand| strand.start, &mut self.roots[0]);
    }

    /// Places everything at the present iterate.
    fn place<S: Default + Send>(&mut self, strands: &[StrandPath], workers: &WorkerSet<S>) {
        self.pieces.place(&self.wisps, |strand| strands[strand].now, workers, &mut self.placing, &mut self.now);
        let Self { start, now, .. } = self;
        for (now, then) in [(&mut now.sagittas, &start.sagittas), (&mut now.bows, &start.bows)] {
            for (now, then) in now.iter_mut().zip(then) {
                *now = now.max(*then);
            }
        }
        roots_of(strands, &self.wisps, |strand| strand.now, &mut self.roots[1]);
        let shared = RigidMotion::shared(&self.roots[0], &self.roots[1]);
        self.carried.clear();
        self.carried.extend(self.start.nodes.iter().map(|node| shared.of(node)));
        self.turned = shared.turn;
    }

    /// Whether no piece has moved further than the candidates allow; `left` marks the strands of such pieces.
    fn are_within(&mut self) -> bool {
        let Self { left, found_at, found_sagittas, margin, .. } = self;
        left.clear();
        left.resize(self.wisps.len(), false);
        // The start is the one of the search, and was looked at then, or within the margin like everything else.
        let moments = if self.validity == Validity::Present { 1 } else { 2 };
        let whens: &[_] = &[(&self.now.nodes, &self.roots[1]), (&self.start.nodes, &self.roots[0])][..moments];
        for (nodes, roots) in whens {
            let moved = RigidMotion::shared(&self.found_roots, roots);
            for (index, piece) in self.pieces.pieces.iter().enumerate() {
                let off = |node: usize| (nodes[node] - moved.of(&found_at[node])).norm();
                let room = *margin + found_sagittas[index] - self.now.sagittas[index];
                let within = (piece.node as usize..=piece.last_node()).all(|node| off(node) <= room);
                left[piece.strand as usize] |= !within;
            }
        }
        !left.contains(&true)
    }

    /// Finds the candidates of the strands that have moved too far; all others keep theirs.
    fn search<S: Default + Send>(&mut self, workers: &WorkerSet<S>, meter: &Meter) {
        let Self {
            wisps, pieces, boxes, candidates, grid, parts, found, merged, carried, left, found_at, found_sagittas, ..
        } = self;
        for (index, piece) in pieces.pieces.iter().enumerate().filter(|(_, piece)| left[piece.strand as usize]) {
            let nodes = piece.node as usize..=piece.last_node();
            found_at[nodes.clone()].copy_from_slice(&self.now.nodes[nodes]);
            found_sagittas[index] = self.now.sagittas[index];
        }
        let (now, sagittas, pieces) = (&*found_at, &*found_sagittas, &*pieces);
        let sagitta = |chord: usize| sagittas[pieces.chords[chord].piece as usize];
        boxes.clear();
        boxes.extend(pieces.chords.iter().enumerate().map(|(index, chord)| {
            let node = chord.node as usize;
            let room = wisps[pieces.strand_of(index)].radius + self.margin + sagitta(index) + 0.5 * self.activation;
            let (mut low, mut high) = (now[node].inf(&now[node + 1]), now[node].sup(&now[node + 1]));
            for from in &carried[node..node + 2] {
                (low, high) = (low.inf(from), high.sup(from));
            }
            Bounds { low: low - Vector3::repeat(room), high: high + Vector3::repeat(room) }
        }));
        let has_left = |index: usize| left[pieces.strand_of(index)];
        candidates.retain(|(i, j)| !has_left(*i as usize) && !has_left(*j as usize));
        let order = |(i, j): &(u32, u32)| pieces.order_of(*i, *j);
        let pair = |order: u128| pieces.pair_of(order);
        found.clear();
        let ends = |index: usize| {
            let node = pieces.chords[index].node as usize;
            [now[node], now[node + 1]]
        };
        let moved = |index: usize| {
            let node = pieces.chords[index].node as usize;
            [now[node] - carried[node], now[node + 1] - carried[node + 1]]
        };
        let buckets = grid.fill(boxes);
        let (activation, margin) = (self.activation, self.margin);
        parts.resize_with(PARTS, SearchPart::default);
        for (k, part) in parts.iter_mut().enumerate() {
            part.buckets = buckets * k / PARTS..buckets * (k + 1) / PARTS;
            part.found.clear();
        }
        let (grid, boxes) = (&*grid, &*boxes);
        workers.for_each_task(parts, 1, 1, |parts, _| {
            for SearchPart { buckets, bucket, found } in parts {
                if meter.is_halted() {
                    continue;
                }
                grid.pairs_in(buckets.clone(), boxes, bucket, has_left, |i, j| {
                    let (a, b) = (i as usize, j as usize);
                    let [first, second] = [a, b].map(|chord| &pieces.pieces[pieces.chords[chord].piece as usize]);
                    let (wisp, other) = (&wisps[first.strand as usize], &wisps[second.strand as usize]);
                    let may = if first.strand == second.strand {
                        wisp.meets_itself && second.element > first.element + 1
                    } else {
                        wisp.meets(other)
                    };
                    if may {
                        let room = wisp.radius + other.radius + sagitta(a) + sagitta(b) + activation + 2.0 * margin;
                        let (at_a, at_b) = (ends(a), ends(b));
                        let distance = closest_of_segments([&at_a[0], &at_a[1]], [&at_b[0], &at_b[1]]).distance;
                        if distance <= room + relative_motion(moved(a), moved(b)) {
                            found.push(order(&(i, j)));
                        }
                    }
                });
            }
        });
        if meter.is_halted() {
            return;
        }
        for part in parts.iter() {
            found.extend_from_slice(&part.found);
        }
        found.sort_unstable();
        // Kept and new candidates, in their common order.
        merged.clear();
        let mut new = found.iter().peekable();
        for candidate in candidates.iter() {
            let here = order(candidate);
            while let Some(before) = new.next_if(|found| **found < here) {
                merged.push(pair(*before));
            }
            merged.push(*candidate);
        }
        merged.extend(new.map(|found| pair(*found)));
        candidates.clone_from(merged);
        self.found_roots.clone_from(&self.roots[1]);
        self.counts.searches += 1;
        self.group();
    }

    /// Pairs of strands that may be in contact, by first and second strand. Valid until the next search.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The counts so far.
    pub fn counts(&self) -> PairCounts {
        self.counts
    }
}
