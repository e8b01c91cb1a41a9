//! How strands answer to the bodies that touch them: the touches that there are now and those near by, how far each touched point goes in the coming
//! seconds if all forces stay as they are, and how a force at one moves the others. It is the coming step's first contact problem, condensed onto the
//! bodies named: whoever knows where these go can solve it without the strands.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use nalgebra::Vector3;

use super::Solver;
use super::bodies::{Contact, ContactPartner};
use super::constraints::{ConstraintStatus, station_at};
use super::id::BodyId;
use super::strand::Strand;
use crate::chain::load::Station;
use crate::contact::body::BodyAt;
use crate::contact::law::coefficient::Coefficient;
use crate::contact::options::StrandContact;
use crate::contact::strand_body::{self, PathBounds, Span};
use crate::contact::touch::{Partner, StrandCurve, StrandPath, Touch};
use crate::error::{Result, check_not_negative, check_positive};
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::held::Held;
use crate::step::state::rotation_matrix;
use crate::step::{Setting, Surroundings};

/// A place near a touch that presses is no touch of its own if it is no further from it along the strand than this, m, and faces the same way to
/// within this cosine.
const ONE_PLACE: f64 = 5e-4;
const ONE_SIDE: f64 = 0.9;
/// What nothing presses and is deeper than so many tolerances is held apart by nothing: the strand may overlap the body there.
const OVERLAPS: f64 = 4.0;
/// Iterations to where a strand goes, and how near to there, rad, is near enough.
const MOST_ITERATIONS: u32 = 2;
const NEAR_END: f64 = 1e-4;

/// A touch of a strand with one of the bodies, or a place where there soon may be one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyTouch {
    /// Which of the bodies that were named.
    pub body: u32,
    /// The body's point, world, m.
    pub point: Vector3<f64>,
    /// Unit normal, world, from the body to the strand.
    pub normal: Vector3<f64>,
    /// Distance of the surfaces, m.
    pub gap: f64,
    /// From the strand's centreline to where its surface and the body's meet, m, the body's thickness with it.
    pub margin: f64,
    /// The strand's tangent there, unit, from root to tip.
    pub tangent: Vector3<f64>,
    /// How much of the strand that may touch the body there is before and beyond the place, m, up to halfway to its next touch with it.
    pub reach: [f64; 2],
    /// Coulomb friction.
    pub friction: Coefficient,
    /// Force on the strand at the end of the last substep, N, world; zero where nothing presses.
    pub force: Vector3<f64>,
    /// The force that takes the strand its own length in [`TouchCompliance::seconds`] and bends its elements by a radian, N: more it does not press with.
    pub most_force: f64,
    /// How far the strand's point goes in [`TouchCompliance::seconds`] if all forces on the strand stay as they are, m, world.
    pub moved: Vector3<f64>,
}

impl BodyTouch {
    /// The point of the strand's centreline, world, m.
    pub fn strand_point(&self) -> Vector3<f64> {
        self.point + self.normal * (self.gap + self.margin)
    }
}

/// Which touches and which numbers of the response are those of each of the strands that have so many touches.
pub fn of_strands(counts: impl Iterator<Item = usize>) -> impl Iterator<Item = [Range<usize>; 2]> {
    counts.scan([0, 0], |[touch, number], count| {
        let ranges = [*touch..*touch + count, *number..*number + 9 * count * count];
        (*touch, *number) = (ranges[0].end, ranges[1].end);
        Some(ranges)
    })
}

/// The touches of some bodies, and the compliance of the strands between them. Its memory is kept from one use to the next.
#[derive(Debug, Default)]
pub struct TouchCompliance {
    /// The time that it is for, s.
    pub seconds: f64,
    /// Strand after strand, from root to tip.
    pub touches: Vec<BodyTouch>,
    /// How many touches each of the strands has.
    pub counts: Vec<u32>,
    /// Strand after strand a symmetric matrix of (3 touches)² numbers, m/N: how far its points are moved within the time by a force at one of them,
    /// laid out as [`crate::contact::contact_space::ContactSpace::add_strand`] says.
    pub response: Vec<f64>,
    near: Vec<NearStrand>,
    contacts: Vec<(u32, f64, Contact)>,
}

/// Where something holds a strand.
#[derive(Debug, Clone, Copy)]
struct HeldPlace {
    station: Station,
    along: f64,
    force: Vec3<f64>,
    /// With one of the bodies.
    touch: Option<BodyTouch>,
}

/// A strand near the bodies, and the memory for it.
#[derive(Debug, Default)]
struct NearStrand {
    /// Its index in the solver.
    index: u32,
    elements: Vec<ElementState<f64>>,
    bounds: PathBounds,
    search: Mutex<strand_body::Scratch>,
    found: Vec<Touch>,
    places: Vec<HeldPlace>,
    held: Held,
    stations: Vec<Station>,
    forces: Vec<Vec3<f64>>,
}

impl NearStrand {
    /// Finds the places that are nearer than `within` (m) to the bodies.
    fn find(&mut self, strand: &Strand, contact: &StrandContact, bodies: &[BodyAt], within: f64) {
        let Strand { model, state, .. } = strand;
        element_states(rotation_matrix(&state.root), model.lengths.iter().copied(), &state.curvatures, &mut self.elements);
        let curve = StrandCurve { origin: state.root.origin, elements: &self.elements };
        let path = StrandPath { index: self.index, start: curve, now: curve };
        self.bounds.update(&path);
        self.found.clear();
        let scratch = self.search.get_mut().unwrap_or_else(PoisonError::into_inner);
        let span = Span { exempt: contact.exempt_length };
        for body in bodies.iter().filter(|body| body.meets(contact.groups, contact.mask)) {
            strand_body::touches(&path, &self.bounds, span, contact.radius, body, within, scratch, &mut self.found);
        }
        self.found.retain(|touch| touch.place.element > 0 || touch.place.s > 0.0);
    }

    /// A place on it.
    fn place(&self, strand: &Strand, along: f64, force: Vector3<f64>) -> HeldPlace {
        HeldPlace { station: station_at(&strand.model, along), along, force: force.into(), touch: None }
    }

    /// What there is of the strand between two touches with one body belongs half to either.
    fn share_reach(&mut self) {
        for k in 0..self.places.len() {
            let Some(touch) = self.places[k].touch else { continue };
            let others = self.places.iter().filter(|place| place.touch.is_some_and(|other| other.body == touch.body));
            let off = |place: &HeldPlace| place.along - self.places[k].along;
            let [before, beyond] = others.fold(touch.reach, |[before, beyond], place| match off(place) {
                off if off < 0.0 => [before.min(-0.5 * off), beyond],
                off if off > 0.0 => [before, beyond.min(0.5 * off)],
                _ => [before, beyond],
            });
            self.places[k].touch = Some(BodyTouch { reach: [before, beyond], ..touch });
        }
    }

    /// Works out how its places answer.
    fn condense(&mut self, strand: &mut Strand, setting: &Setting, seconds: f64) {
        self.places.sort_by(|a, b| {
            let key = |place: &HeldPlace| (place.station.element, place.station.s);
            key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
        });
        let Self { held, stations, forces, places, elements, .. } = self;
        stations.clear();
        stations.extend(places.iter().map(|place| place.station));
        forces.clear();
        forces.extend(places.iter().map(|place| place.force));
        let before = (strand.state.root.origin, &elements[..]);
        strand.with_one(|one| held.begin(one, setting, seconds, true));
        // The first linear model has no tension in it.
        for _ in 0..MOST_ITERATIONS {
            held.linearise(stations, forces, &[]);
            if held.advance(setting, forces) <= NEAR_END {
                break;
            }
        }
        held.linearise(stations, forces, &[]);
        let model = &strand.model;
        let most_force = model.mass() * model.length() / (seconds * seconds) + model.bending_force();
        let size = 3 * places.len();
        for (k, place) in places.iter_mut().enumerate() {
            let Some(touch) = &mut place.touch else { continue };
            let mut moved = Held::place(held.now(), &place.station) - Held::place(before, &place.station);
            moved += Vector3::from(held.free[k]);
            for (j, force) in forces.iter().enumerate() {
                for (b, force) in force.0.iter().enumerate() {
                    let column = &held.delassus.columns[(3 * j + b) * size + 3 * k..][..3];
                    moved += Vector3::new(column[0], column[1], column[2]) * *force;
                }
            }
            (touch.moved, touch.most_force) = (moved, most_force);
        }
    }

    /// Whether all that it tells is finite.
    fn is_finite(&self) -> bool {
        let told = self.places.iter().filter_map(|place| place.touch.as_ref());
        let mut moved = told.map(|touch| touch.moved);
        moved.all(|moved| moved.iter().all(|x| x.is_finite())) && self.held.delassus.columns.iter().all(|x| x.is_finite())
    }

    /// The matrix's rows and columns of the touches alone.
    fn write(&self, out: &mut Vec<f64>) {
        let size = 3 * self.places.len();
        let rows =
            || self.places.iter().enumerate().filter(|(_, place)| place.touch.is_some()).flat_map(|(k, _)| 3 * k..3 * k + 3);
        for column in rows() {
            out.extend(rows().map(|row| self.held.delassus.columns[column * size + row]));
        }
    }
}

impl Solver {
    /// Tells how strands answer to `bodies` in the coming `seconds`: their touches, those places that are nearer than `within` (m) to them among
    /// these, and the compliance between a strand's touches. Whatever else holds a strand, other bodies, strands and constraints, goes on with the
    /// force that it has; strands are coupled through the bodies alone. Nothing is changed.
    ///
    /// # Errors
    /// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`; [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a
    /// time that is not finite and above zero, or a distance that is not finite and zero or above.
    pub fn touch_compliance(&mut self, bodies: &[BodyId], seconds: f64, within: f64, out: &mut TouchCompliance) -> Result<()> {
        check_positive(|| "seconds".into(), seconds)?;
        check_not_negative(|| "within".into(), within)?;
        let mut indices = Vec::with_capacity(bodies.len());
        for (k, id) in bodies.iter().enumerate() {
            indices.push(self.body_index(|| format!("bodies[{k}]"), *id)? as u32);
        }
        (out.seconds, out.touches, out.counts, out.response) =
            (seconds, cleared(&mut out.touches), cleared(&mut out.counts), cleared(&mut out.response));
        let still: Vec<BodyAt> = indices.iter().map(|index| self.bodies[*index as usize].body.still(*index)).collect();
        self.find_near(&still, within, &mut out.near);
        self.contacts_by_strand(&mut out.contacts);
        let most_deep = OVERLAPS * self.options.contact.tolerance;
        let mut near: Vec<&mut NearStrand> = out.near.iter_mut().filter(|near| !near.found.is_empty()).collect();
        for strand in &mut near {
            self.list_places(strand, bodies, &still, &out.contacts, most_deep);
        }
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let mut place = near.into_iter().peekable();
        let mut pairs = Vec::new();
        for (index, strand) in self.strands.iter_mut().enumerate() {
            if let Some(near) = place.next_if(|near| near.index as usize == index) {
                pairs.push((strand, near));
            }
        }
        self.crew.for_each(&mut pairs, |(strand, near), _| {
            near.condense(strand, &setting, seconds);
        });
        for (_, near) in pairs.into_iter().filter(|(_, near)| near.is_finite()) {
            let before = out.touches.len();
            out.touches.extend(near.places.iter().filter_map(|place| place.touch));
            if out.touches.len() > before {
                out.counts.push((out.touches.len() - before) as u32);
                near.write(&mut out.response);
            }
        }
        Ok(())
    }

    /// The strands that have places near some bodies, in their order, first in `near`; the rest is kept for its memory.
    fn find_near(&self, bodies: &[BodyAt], within: f64, near: &mut Vec<NearStrand>) {
        let mut count = 0;
        for (index, strand) in self.strands.iter().enumerate() {
            let Some(contact) = strand.contact.as_deref().filter(|_| !strand.is_returning()) else { continue };
            let reach = strand.model.length() + contact.radius + within;
            let around = crate::contact::shape::Bounds::around(strand.state.root.origin, Vector3::repeat(reach));
            let meets =
                |body: &BodyAt| body.meets(contact.groups, contact.mask) && body.bounds.grown(body.thickness).meets(&around);
            if !bodies.iter().any(meets) {
                continue;
            }
            if near.len() == count {
                near.push(NearStrand::default());
            }
            near[count].index = index as u32;
            near[count].find(strand, contact, bodies, within);
            count += usize::from(!near[count].found.is_empty());
        }
        near[count..].iter_mut().for_each(|near| near.found.clear());
    }

    /// The last substep's contacts, each with its strand's index and arclength; those between strands for both.
    fn contacts_by_strand(&self, out: &mut Vec<(u32, f64, Contact)>) {
        out.clear();
        for contact in self.holding.contacts() {
            if let Some(index) = self.slots.index(contact.strand) {
                out.push((index as u32, contact.arclength, *contact));
            }
            if let ContactPartner::Strand { strand, arclength } = contact.partner
                && let Some(index) = self.slots.index(strand)
            {
                out.push((index as u32, arclength, Contact { force: -contact.force, ..*contact }));
            }
        }
        out.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    }

    /// Where things hold a strand that is near the bodies.
    fn list_places(
        &self,
        near: &mut NearStrand,
        bodies: &[BodyId],
        still: &[BodyAt],
        contacts: &[(u32, f64, Contact)],
        most_deep: f64,
    ) {
        let strand = &self.strands[near.index as usize];
        let Some(contact) = strand.contact.as_deref() else { return };
        near.places.clear();
        let touch = |near: &NearStrand, body: usize, along: f64, normal: Vector3<f64>, gap: f64, force: Vector3<f64>| {
            let mut place = near.place(strand, along, force);
            let curve = StrandCurve { origin: strand.state.root.origin, elements: &near.elements };
            let (element, s) = (place.station.element, place.station.s);
            let friction = contact.friction;
            let scale = still[body].friction;
            let (tangent, margin) = (curve.tangent(element, s), contact.radius + still[body].thickness);
            place.touch = Some(BodyTouch {
                body: body as u32,
                point: curve.position(element, s) - normal * (gap + margin),
                normal,
                gap,
                margin,
                tangent,
                reach: [(along - contact.exempt_length).max(0.0), (strand.model.length() - along).max(0.0)],
                friction: Coefficient::of_scales(friction.along * scale, friction.against * scale, tangent),
                force,
                most_force: 0.0,
                moved: Vector3::zeros(),
            });
            place
        };
        let first = contacts.partition_point(|(index, ..)| *index < near.index);
        for (_, along, contact) in contacts[first..].iter().take_while(|(index, ..)| *index == near.index) {
            let body = match contact.partner {
                ContactPartner::Body { body, .. } => bodies.iter().position(|id| *id == body),
                ContactPartner::Strand { .. } => None,
            };
            let place = match body {
                Some(body) => touch(near, body, *along, contact.normal, contact.gap, contact.force),
                None => near.place(strand, *along, contact.force),
            };
            near.places.push(place);
        }
        for k in 0..near.found.len() {
            let found = near.found[k];
            let Partner::Body { body: index, .. } = found.partner else { continue };
            let Some(body) = still.iter().position(|at| at.index == index) else { continue };
            let curve = StrandCurve { origin: strand.state.root.origin, elements: &near.elements };
            let along = curve.along(found.place.element as usize, found.place.s);
            let is_known = near.places.iter().any(|place| {
                let same = |touch: &BodyTouch| touch.body as usize == body && touch.normal.dot(&found.normal) > ONE_SIDE;
                (place.along - along).abs() <= ONE_PLACE && place.touch.as_ref().is_some_and(same)
            });
            if !is_known && found.gap >= -most_deep {
                near.places.push(touch(near, body, along, found.normal, found.gap, Vector3::zeros()));
            }
        }
        near.share_reach();
        for constraint in self.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            if constraint.def.strand == strand.id {
                near.places.push(near.place(strand, constraint.state.arclength, constraint.state.force));
            }
            if let Some(along) = constraint.tied(strand.id) {
                near.places.push(near.place(strand, along, -constraint.state.force));
            }
        }
    }
}

fn cleared<T>(list: &mut Vec<T>) -> Vec<T> {
    list.clear();
    std::mem::take(list)
}
