//! How strands answer to the bodies that touch them: the touches that there are now and those near by, how far each touched point goes in the coming
//! seconds if all forces stay as they are, and how a force at one moves the others. It is the coming step's first contact problem, condensed onto the
//! bodies named: whoever knows where these go can solve it without the strands.
//!
//! Files:
//!
//! - `near_strand.rs`: A strand near a tool: where things hold it, and how it answers there.
//! - `search.rs`: Where a strand comes near a tool's bodies: a quick search, for places that may soon be touches.

mod near_strand;
mod search;

use std::ops::Range;

use nalgebra::Vector3;

use near_strand::{Answer, NearStrand};

use super::Solver;
use super::bodies::{Contact, ContactPartner};
use super::constraints::Constraint;
use super::id::BodyId;
use crate::contact::body::BodyAt;
use crate::contact::law::coefficient::Coefficient;
use crate::contact::shape::Bounds;
use crate::error::{Result, check_not_negative, check_positive};
use crate::step::{Setting, Surroundings};

/// What nothing presses and is deeper than so many tolerances is held apart by nothing: the strand may overlap the body there.
const OVERLAPS: f64 = 4.0;
/// Strands of a task.
const TASK: usize = 8;

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
    /// The stiffness of a cantilever of the strand's length, 3 EI/L³, N/m, about the axis that it bends about more easily, and its resistance by internal
    /// friction, 3 γ/L³, N·s/m.
    pub resistance: [f64; 2],
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
///
/// ```
/// use superhelix::reading::TouchCompliance;
/// use superhelix::{Solver, SolverOptions};
///
/// let solver = Solver::new(SolverOptions::default())?;
/// let mut found = TouchCompliance::default();
/// solver.touch_compliance(&[], 1.0 / 60.0, 1e-3, &mut found)?;
/// assert!(found.touches.is_empty());
/// # Ok::<(), superhelix::Error>(())
/// ```
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
    /// The first `near_count` are in use; the rest is kept for its memory.
    near: Vec<NearStrand>,
    near_count: usize,
    /// Memory for strands that have touches.
    answers: Vec<Box<Answer>>,
    /// The most places of a strand so far, rounded up: there is room for so many wherever a strand is listed.
    most_places: usize,
    contacts: Vec<(u32, f64, Contact)>,
}

/// What holds strands, beside places near the bodies.
struct Places<'a> {
    /// The bodies.
    bodies: &'a [BodyId],
    /// The last substep's contacts by strand and arclength.
    contacts: &'a [(u32, f64, Contact)],
    constraints: &'a [Constraint],
    /// What nothing presses and is deeper than this, m, is no touch.
    most_deep: f64,
}

impl TouchCompliance {
    /// Forgets the touches that `keep` does not want; it gets their numbers in [`TouchCompliance::touches`]. What presses there goes on with the force
    /// that it has.
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let mut number = 0;
        for near in &mut self.near[..self.near_count] {
            near.places.retain_mut(|place| {
                let Some(touch) = place.touch else { return true };
                number += 1;
                if keep(number - 1) {
                    return true;
                }
                place.touch = None;
                touch.force != Vector3::zeros()
            });
        }
        self.list();
    }

    /// Lists the touches of the strands near the bodies.
    fn list(&mut self) {
        self.touches.clear();
        self.counts.clear();
        for near in &self.near[..self.near_count] {
            let before = self.touches.len();
            self.touches.extend(near.places.iter().filter_map(|place| place.touch));
            if self.touches.len() > before {
                self.counts.push((self.touches.len() - before) as u32);
            }
        }
    }
}

impl Solver {
    /// How strands answer to `bodies` in the coming `seconds`: their touches, those places that are nearer than `within` (m) to them among
    /// these, and the compliance between a strand's touches. Whatever else holds a strand, other bodies, strands and constraints, goes on with the
    /// force that it has; strands are coupled through the bodies alone. Nothing is changed.
    ///
    /// # Errors
    /// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`; [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a
    /// time that is not finite and above zero, or a distance that is not finite and zero or above.
    pub fn touch_compliance(&self, bodies: &[BodyId], seconds: f64, within: f64, out: &mut TouchCompliance) -> Result<()> {
        check_positive(|| "seconds".into(), seconds)?;
        self.find_touches(bodies, within, out)?;
        self.condense_touches(seconds, out)
    }

    /// The first half of [`Solver::touch_compliance`]: the touches alone. Those that are not wanted may then be forgotten
    /// ([`TouchCompliance::retain`]), before [`Solver::condense_touches`] works out how the others answer.
    ///
    /// # Errors
    /// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`; [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a
    /// distance that is not finite and zero or above.
    pub fn find_touches(&self, bodies: &[BodyId], within: f64, out: &mut TouchCompliance) -> Result<()> {
        check_not_negative(|| "within".into(), within)?;
        let still = |(k, id): (usize, &BodyId)| -> Result<BodyAt> {
            let index = self.body_index(|| format!("bodies[{k}]"), *id)?;
            Ok(self.bodies[index].body.still(index as u32))
        };
        let still = bodies.iter().enumerate().map(still).collect::<Result<Vec<BodyAt>>>()?;
        out.response.clear();
        self.list_near(&still, within, out);
        self.contacts_by_strand(&mut out.contacts);
        let most_deep = OVERLAPS * self.options.contact.tolerance;
        let held = Places { bodies, contacts: &out.contacts, constraints: &self.constraints, most_deep };
        self.crew.for_each_task(&mut out.near[..out.near_count], TASK, usize::MAX, |strands, _| {
            for near in strands {
                near.find(&self.strands[near.index as usize], &still, within, &held);
            }
        });
        out.list();
        Ok(())
    }

    /// The second half: how the touches that were found answer in the coming `seconds`. No step may come between the two.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a time that is not finite and above zero.
    pub fn condense_touches(&self, seconds: f64, out: &mut TouchCompliance) -> Result<()> {
        check_positive(|| "seconds".into(), seconds)?;
        out.seconds = seconds;
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let near = &mut out.near[..out.near_count];
        let most = near.iter().map(|near| near.places.len()).max().unwrap_or(0);
        if most > out.most_places {
            out.most_places = most.next_power_of_two();
        }
        for near in near.iter_mut() {
            near.answer = if near.has_touches() { Some(out.answers.pop().unwrap_or_default()) } else { None };
            near.make_room(out.most_places);
        }
        self.crew.for_each_task(near, TASK, usize::MAX, |strands, _| {
            for near in strands.iter_mut().filter(|near| near.has_touches()) {
                near.condense(&self.strands[near.index as usize], &setting, seconds);
                if !near.is_finite() {
                    near.places.clear();
                }
            }
        });
        out.list();
        let TouchCompliance { near, near_count, response, answers, .. } = out;
        response.clear();
        for near in &mut near[..*near_count] {
            near.write(response);
            answers.extend(near.answer.take());
        }
        Ok(())
    }

    /// The strands that may come near some bodies, in their order.
    fn list_near(&self, bodies: &[BodyAt], within: f64, out: &mut TouchCompliance) {
        let all = bodies.iter().fold(Bounds::EMPTY, |all, body| all.union(&body.bounds.grown(body.thickness)));
        out.near_count = 0;
        for (index, strand) in self.strands.iter().enumerate() {
            let Some(contact) = strand.contact.as_deref().filter(|_| !strand.is_returning()) else { continue };
            let reach = strand.model.length() + contact.radius + within;
            let around = Bounds::around(strand.state.root.origin, Vector3::repeat(reach));
            if !all.meets(&around) {
                continue;
            }
            let meets = |body: &BodyAt| body.meets(contact.groups, contact.mask) && body.is_near(&around);
            if !bodies.iter().any(meets) {
                continue;
            }
            if out.near.len() == out.near_count {
                out.near.push(NearStrand::default());
            }
            out.near[out.near_count].index = index as u32;
            out.near_count += 1;
        }
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
        out.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    }
}
