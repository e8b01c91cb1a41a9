//! Strands that are near a body and touch none, as most of a groom on a head are: they step side by side with those that nothing is near.
//!
//! Before a substep a strand's distance from each body is measured, place by place, as far as is needed to tell that it is larger than the strand can
//! go in the substep, as it moves now and with something to spare. Along the strand that is little near its root and much at its tip. After the substep
//! the curvatures tell how far it went at most: a point at arclength s by no more than the integral, up to it, of how far the tangents before it turned.
//! A strand that went further than was looked at is taken back and held, as one that may touch.
//!
//! What decides is the state alone, not what earlier substeps found.

use super::holding::Scene;
use super::report::Energies;
use super::strand::{self, Fared, Holds, Strand, Tally};
use crate::contact::body::BodyAt;
use crate::contact::options::StrandContact;
use crate::contact::shape::Bounds;
use crate::contact::touch::StrandCurve;
use crate::math::frame::Frame;
use crate::math::rotation::{PoseMove, rotation_vector};
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::state::{StrandState, rotation_matrix};

use nalgebra::Vector3;

/// A strand is given so many times the turning that it has now, and so much more over its whole length, rad: what weight and a head that
/// starts or stops add within a usual substep.
const TURNING: f64 = 1.5;
const SPARE_TURN: f64 = 0.02;
/// Places of a strand at which the distance from a body is measured, at most.
const MOST_PLACES: u32 = 64;
/// Pieces of an element that wait to be looked at, at most: halves of halves.
const MOST_HALVES: usize = 12;

/// The strands of one task that step as if nothing were near them.
#[derive(Debug, Default)]
pub(super) struct Watch {
    watched: Vec<Watched>,
    count: usize,
    elements: Vec<ElementState<f64>>,
    /// How far each element's end may go by turning, m; strand after strand.
    ways: Vec<f64>,
}

/// A strand as it was before the substep.
#[derive(Debug, Default)]
struct Watched {
    index: usize,
    state: StrandState,
    energies: Energies,
    fared: Option<Fared>,
    root_move: Option<(PoseMove, f64)>,
    /// Where its ways begin.
    first: usize,
}

/// How far points of a strand go at most when its elements turn by so many radians each: the ways of the elements' ends, m.
fn ways(lengths: &[f64], turns: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    lengths.iter().zip(turns).scan((0.0, 0.0), |(angle, way), (length, turn)| {
        *way += (*angle + 0.5 * turn) * length;
        *angle += turn;
        Some(*way)
    })
}

fn norm([a, b, c]: [f64; 3]) -> f64 {
    (a * a + b * b + c * c).sqrt()
}

impl Watch {
    /// Looks at those of a task's strands that only a body that is near may hold: those that it cannot reach in the coming `h` seconds are not held.
    pub fn look(&mut self, strands: &mut [Strand], scene: &View, h: f64) {
        self.count = 0;
        self.ways.clear();
        for (index, strand) in strands.iter_mut().enumerate().filter(|(_, strand)| strand.holds == Holds::Perhaps) {
            let first = self.ways.len();
            if !self.is_clear(strand, scene, h) {
                self.ways.truncate(first);
                continue;
            }
            strand.holds = Holds::No;
            if self.count == self.watched.len() {
                self.watched.push(Watched::default());
            }
            let watched = &mut self.watched[self.count];
            watched.state.clone_from(&strand.state);
            (watched.index, watched.first) = (index, first);
            (watched.energies, watched.fared) = (strand.energies, Some(strand.fared));
            watched.root_move = strand.root_move.as_deref().cloned();
            self.count += 1;
        }
    }

    /// After the substep: takes those back that went further than was looked at, to be held.
    pub fn look_back(&mut self, strands: &mut [Strand], tally: &mut Tally) {
        let Self { watched, ways, count, .. } = self;
        for watched in &mut watched[..*count] {
            let strand = &mut strands[watched.index];
            if !strand.fared.quarantined && watched.went_no_further(strand, &ways[watched.first..]) {
                continue;
            }
            tally.take_back(&strand.fared);
            std::mem::swap(&mut strand.state, &mut watched.state);
            strand.energies = watched.energies;
            strand.fared = watched.fared.unwrap_or(strand.fared);
            strand.astray = None;
            strand.root_move = watched.root_move.take().map(Box::new);
            strand.holds = Holds::Perhaps;
        }
    }

    /// Whether no body that it meets can be reached. Writes the ways that it may go.
    fn is_clear(&mut self, strand: &Strand, scene: &View, h: f64) -> bool {
        // (A step that touched ends by another formula than the free one, and so does the next.)
        let Some(contact) = strand.contact.as_deref().filter(|_| !strand.touched && strand.astray.is_none()) else {
            return false;
        };
        let Strand { model, state, .. } = strand;
        let (first, length) = (self.ways.len(), model.length());
        let turns = state.rates.iter().zip(&model.lengths[..]);
        let turns = turns.map(|(rate, element)| element * (TURNING * h * norm(*rate) + SPARE_TURN / length));
        self.ways.extend(ways(&model.lengths, turns));
        element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut self.elements);
        let curve = StrandCurve { origin: state.root.origin, elements: &self.elements };
        let root = [state.root, strand::root_after(&strand.root_move, &state.root, h)];
        let look = Look { strand, contact, curve, ways: &self.ways[first..], root, tolerance: scene.tolerance };
        scene.bodies.iter().filter(|body| body.meets(contact.groups, contact.mask)).all(|body| look.is_clear_of(body))
    }
}

impl Watched {
    /// Whether the strand went no further than it was given.
    fn went_no_further(&self, strand: &Strand, given: &[f64]) -> bool {
        let rows = strand.state.curvatures.iter().zip(&self.state.curvatures).zip(&strand.model.lengths[..]);
        let turns = rows.map(|((now, before), length)| length * norm(std::array::from_fn(|axis| now[axis] - before[axis])));
        ways(&strand.model.lengths, turns).zip(given).all(|(way, given)| way <= *given)
    }
}

/// What strands are looked at against.
pub(super) struct View<'a> {
    pub bodies: &'a [BodyAt<'a>],
    /// How deep contact may be, m.
    pub tolerance: f64,
}

impl<'a> View<'a> {
    pub fn of(scene: &Scene<'a>) -> Self {
        Self { bodies: scene.bodies, tolerance: scene.options.tolerance }
    }
}

/// A strand before a substep.
struct Look<'a> {
    strand: &'a Strand,
    contact: &'a StrandContact,
    curve: StrandCurve<'a>,
    ways: &'a [f64],
    root: [Frame; 2],
    tolerance: f64,
}

impl Look<'_> {
    /// Whether it stays away from a body.
    fn is_clear_of(&self, body: &BodyAt) -> bool {
        let Self { strand, contact, root, .. } = self;
        let reach = Vector3::repeat(strand.model.length() + contact.radius);
        let around = Bounds::around(root[0].origin, reach).union(&Bounds::around(root[1].origin, reach));
        if !body.bounds.grown(body.thickness).meets(&around) {
            return true;
        }
        if body.deforms() {
            return false;
        }
        // How the root goes as the body sees it.
        let seen = |root: &Frame, body: &Frame| body.inverse().compose(root);
        let [from, to] = [seen(&root[0], &body.start), seen(&root[1], &body.end)];
        let (shift, turn) = ((to.origin - from.origin).norm(), rotation_vector(&(to.rotation * from.rotation.inverse())).norm());
        let slope = body.shape.distance_slope();
        let (mut along, mut places) = (0.0, MOST_PLACES);
        for (element, (length, way)) in strand.model.lengths.iter().zip(self.ways).enumerate() {
            let end = along + length;
            let least = contact.radius + self.tolerance + slope * (way + shift + turn * end);
            let start = (contact.exempt_length - along).max(0.0);
            if start < *length && !self.element_is_clear(body, element, [start, *length], along, least, slope, &mut places) {
                return false;
            }
            along = end;
        }
        true
    }

    /// Whether all of an element between two of its arclengths is further than `least` (m) from a body, what it may overlap apart.
    #[expect(clippy::too_many_arguments, reason = "one place, looked at in one loop")]
    fn element_is_clear(
        &self,
        body: &BodyAt,
        element: usize,
        piece: [f64; 2],
        along: f64,
        least: f64,
        slope: f64,
        places: &mut u32,
    ) -> bool {
        let mut pieces = [[0.0; 2]; MOST_HALVES];
        let mut count = 1;
        pieces[0] = piece;
        while count > 0 {
            let [from, to] = pieces[count - 1];
            count -= 1;
            if *places == 0 {
                return false;
            }
            *places -= 1;
            let middle = 0.5 * (from + to);
            let sunk = |s: f64| self.strand.allowance.as_deref().map_or(0.0, |allowance| allowance.sunk(along + s));
            // (Linear between stations, of which few lie within a piece: what may be sunk least is taken at its ends and middle.)
            let least = least - sunk(from).min(sunk(middle)).min(sunk(to));
            let half = slope * 0.5 * (to - from);
            let distance = body.distance_at_start(self.curve.position(element, middle), least + half);
            if distance >= least + half {
                continue;
            }
            if distance < least || count + 2 > MOST_HALVES {
                return false;
            }
            pieces[count] = [middle, to];
            pieces[count + 1] = [from, middle];
            count += 2;
        }
        true
    }
}
