//! Strands that are near a body and out of its reach, as most of a groom on a head are: they step side by side with those that nothing is near.
//!
//! Before a substep the distance of a strand from each body is measured, place by place, until it is known to exceed the strand's displacement in the
//! substep: a bound from its present rates, with something to spare. Near the root that is little, at the tip much. After the substep the change of
//! curvature bounds the displacement that there was: at arclength s it is no more than the integral, up to s, of the angle by which tangents turned. A
//! strand that exceeds what was assumed is rolled back, and steps as one that may touch.
//!
//! The state alone decides, not what earlier substeps measured: a snapshot goes on to the same bits.

use super::report::Energies;
use super::strand::{Fared, Holds, Strand, Tally};
use crate::contact::body::BodyAt;
use crate::contact::options::StrandContact;
use crate::contact::touch::StrandCurve;
use crate::math::frame::Frame;
use crate::math::rotation::{PoseMove, rotation_vector};
use crate::meter::Meter;
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::state::{StrandState, rotation_matrix};

/// What elements are assumed to turn by: their present rates times this, and over the whole length so much more, rad, for what weight and a head
/// that starts or stops add within a usual substep.
const TURNING: f64 = 1.5;
const SPARE_TURN: f64 = 0.005;
/// A strand that a body cannot drive in by more than this part of what contact tolerates is out of its reach: where it grows out of a head, or lies
/// on it as it was drawn, its distance is zero, and its displacement nearly so.
const SLACK: f64 = 0.2;
/// Most places of a strand at which the distance from a body is measured.
const MOST_PLACES: u32 = 128;
/// Most pieces of an element that wait to be measured: halves of halves.
const MOST_PIECES: usize = 12;

/// The strands of one task that step as if nothing were near them.
#[derive(Debug, Default)]
pub(super) struct OutOfReach {
    saved: Vec<Saved>,
    count: usize,
    elements: Vec<ElementState<f64>>,
    /// Assumed bounds of the displacement of each element's end relative to the root, m; strand after strand.
    displacements: Vec<f64>,
}

/// A strand as it was before the substep.
#[derive(Debug, Default)]
struct Saved {
    /// Among the task's strands.
    index: usize,
    state: StrandState,
    energies: Energies,
    fared: Fared,
    root_move: Option<(PoseMove, f64)>,
    /// Where its bounds begin.
    first: usize,
}

/// Bounds of the displacement of the elements' ends, m, when the elements turn by no more than so many radians each.
fn displacements(lengths: &[f64], turns: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    lengths.iter().zip(turns).scan((0.0, 0.0), |(angle, displacement), (length, turn)| {
        *displacement += (*angle + 0.5 * turn) * length;
        *angle += turn;
        Some(*displacement)
    })
}

fn norm([a, b, c]: [f64; 3]) -> f64 {
    (a * a + b * b + c * c).sqrt()
}

impl OutOfReach {
    /// Before a substep of `h` seconds: those of a task's strands that only a near body may hold, and that it cannot reach, are free.
    /// `tolerance`: how deep contact may be, m. When the meter has halted the substep the rest stay as they are.
    pub fn release(&mut self, strands: &mut [Strand], bodies: &[BodyAt], tolerance: f64, h: f64, meter: &Meter) {
        self.count = 0;
        self.displacements.clear();
        for (index, strand) in strands.iter_mut().enumerate().filter(|(_, strand)| strand.holds == Holds::Perhaps) {
            if meter.is_halted() {
                return;
            }
            let first = self.displacements.len();
            if !self.cannot_touch(strand, bodies, tolerance, h) {
                self.displacements.truncate(first);
                continue;
            }
            strand.holds = Holds::No;
            if self.count == self.saved.len() {
                self.saved.push(Saved::default());
            }
            let saved = &mut self.saved[self.count];
            saved.state.clone_from(&strand.state);
            (saved.index, saved.first, saved.energies, saved.fared) = (index, first, strand.energies, strand.fared);
            saved.root_move = strand.root_move.as_deref().cloned();
            self.count += 1;
        }
    }

    /// After it: rolls those back that were displaced further than was assumed; they may be held again.
    pub fn roll_back(&mut self, strands: &mut [Strand], tally: &mut Tally) {
        let Self { saved, displacements, count, .. } = self;
        for saved in &mut saved[..*count] {
            let strand = &mut strands[saved.index];
            if !strand.fared.quarantined && saved.is_within(strand, &displacements[saved.first..]) {
                continue;
            }
            tally.take_back(&strand.fared);
            std::mem::swap(&mut strand.state, &mut saved.state);
            (strand.energies, strand.fared, strand.astray) = (saved.energies, saved.fared, None);
            strand.root_move = saved.root_move.take().map(Box::new);
            strand.holds = Holds::Perhaps;
        }
    }

    /// Whether none of the bodies that it meets can touch a strand. Writes the bounds that this assumes.
    fn cannot_touch(&mut self, strand: &Strand, bodies: &[BodyAt], tolerance: f64, h: f64) -> bool {
        // (The step after one that touched is taken by another formula than the free one.)
        let Some(contact) = strand.contact.as_deref().filter(|_| !strand.touched && strand.astray.is_none()) else {
            return false;
        };
        let Strand { model, state, .. } = strand;
        let (first, length) = (self.displacements.len(), model.length());
        let turns = state.rates.iter().zip(&model.lengths[..]);
        let turns = turns.map(|(rate, element)| element * (TURNING * h * norm(*rate) + SPARE_TURN / length));
        self.displacements.extend(displacements(&model.lengths, turns));
        element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut self.elements);
        let curve = StrandCurve { origin: state.root.origin, elements: &self.elements };
        let root = strand.root_during(h);
        let around = strand.reach(contact, &root);
        let mut near = bodies.iter().filter(|body| body.meets(contact.groups, contact.mask) && body.is_near(&around));
        near.all(|body| {
            let assumed = &self.displacements[first..];
            !body.deforms() && Clearance { strand, contact, curve, body, assumed, tolerance }.is_enough(&root)
        })
    }
}

impl Saved {
    /// Whether the strand was displaced by no more than was assumed.
    fn is_within(&self, strand: &Strand, assumed: &[f64]) -> bool {
        let rows = strand.state.curvatures.iter().zip(&self.state.curvatures).zip(&strand.model.lengths[..]);
        let turns = rows.map(|((now, before), length)| length * norm(std::array::from_fn(|axis| now[axis] - before[axis])));
        displacements(&strand.model.lengths, turns).zip(assumed).all(|(displacement, assumed)| displacement <= *assumed)
    }
}

/// A strand beside a body before a substep.
struct Clearance<'a> {
    strand: &'a Strand,
    contact: &'a StrandContact,
    curve: StrandCurve<'a>,
    body: &'a BodyAt<'a>,
    assumed: &'a [f64],
    tolerance: f64,
}

impl Clearance<'_> {
    /// Whether the distance exceeds the displacement relative to the body everywhere. `root`: where the root begins and ends.
    fn is_enough(&self, root: &[Frame; 2]) -> bool {
        let body = self.body;
        let [from, to] = [body.start.inverse().compose(&root[0]), body.end.inverse().compose(&root[1])];
        let (shift, turn) = ((to.origin - from.origin).norm(), rotation_vector(&(to.rotation * from.rotation.inverse())).norm());
        let (mut along, mut places) = (0.0, MOST_PLACES);
        for (element, (length, displacement)) in self.strand.model.lengths.iter().zip(self.assumed).enumerate() {
            let displacement = displacement + shift + turn * (along + length);
            if !self.is_enough_along(element, along, displacement, &mut places) {
                return false;
            }
            along += length;
        }
        true
    }

    /// The same of one element, which begins at arclength `start`. Takes what it measures from `places`.
    fn is_enough_along(&self, element: usize, start: f64, displacement: f64, places: &mut u32) -> bool {
        let (length, slope) = (self.strand.model.lengths[element], self.body.shape.distance_slope());
        let exempt = (self.contact.exempt_length - start).max(0.0);
        let needed = self.contact.radius + slope * displacement - SLACK * self.tolerance;
        let (mut pieces, mut count) = ([[0.0; 2]; MOST_PIECES], usize::from(exempt < length));
        pieces[0] = [exempt, length];
        while count > 0 {
            count -= 1;
            let [from, to] = pieces[count];
            if *places == 0 {
                return false;
            }
            *places -= 1;
            let allowance = self.strand.allowance.as_deref();
            let needed = needed - allowance.map_or(0.0, |allowance| allowance.least_sunk(start + from, start + to));
            let (middle, half) = (0.5 * (from + to), slope * 0.5 * (to - from));
            let distance = self.body.distance_at_start(self.curve.position(element, middle), needed + half);
            if distance >= needed + half {
                continue;
            }
            if distance < needed || count + 2 > MOST_PIECES {
                return false;
            }
            (pieces[count], pieces[count + 1]) = ([middle, to], [from, middle]);
            count += 2;
        }
        true
    }
}
