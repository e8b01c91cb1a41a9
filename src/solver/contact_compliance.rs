//! The response of strands to bodies in contact with them: contacts and near places, and the compliance between them.
//!
//! It has the contacts that exist and the places near by, the displacement of each point of contact in the next seconds if all
//! forces stay constant, and the displacement of the others by a force at one of them. It is the next step's first contact
//! problem, condensed onto the named bodies: whoever knows their motion can solve it without the strands.
//!
//! Files:
//!
//! - `near_strand.rs`: A strand near a tool: the places where forces act on it, and its response there.
//! - `search.rs`: A quick search for places where a strand is near a tool's bodies and may soon be in contact.

mod near_strand;
mod search;

use std::ops::Range;

use nalgebra::Vector3;

use near_strand::{NearStrand, Response};

use super::Solver;
use super::bodies::{Contact, ContactPartner};
use super::constraints::Constraint;
use super::id::BodyId;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::law::coefficient::Coefficient;
use crate::contact::shape::Bounds;
use crate::error::{Result, check_not_negative, check_positive};
use crate::step::{Setting, Surroundings};

/// Nothing separates an overlap without force that is deeper than this many tolerances: the strand may overlap the body there.
const OVERLAPS: f64 = 4.0;
/// Strands per task.
const TASK: usize = 8;

/// A contact of a strand with one of the bodies, or a place where there may soon be one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyContact {
    /// Index among the named bodies.
    pub body: u32,
    /// The body's point of contact, world, m.
    pub point: Vector3<f64>,
    /// Unit normal, world, from the body to the strand.
    pub normal: Vector3<f64>,
    /// Distance of the surfaces, m.
    pub gap: f64,
    /// From the strand's centreline to where its surface and the body's meet, m, including the body's thickness.
    pub margin: f64,
    /// The strand's tangent there, unit, from root to tip.
    pub tangent: Vector3<f64>,
    /// The length of the strand before and after the place that may be in contact with the body, m, up to halfway to its next
    /// contact with it.
    pub reach: [f64; 2],
    /// Coulomb friction.
    pub friction: Coefficient,
    /// Force on the strand at the end of the last substep, N, world; zero without pressure.
    pub force: Vector3<f64>,
    /// An upper bound on the force, N: it moves the strand by its own length in [`ContactCompliance::seconds`] and bends its
    /// elements by a radian.
    pub max_force: f64,
    /// The stiffness of a cantilever of the strand's length about its softer bending axis, 3 EI/L³, N/m, and its resistance by
    /// internal friction, 3 γ/L³, N·s/m.
    pub resistance: [f64; 2],
    /// Displacement of the strand's point in [`ContactCompliance::seconds`] if all forces on the strand stay constant, m, world.
    pub moved: Vector3<f64>,
}

impl BodyContact {
    /// The point of the strand's centreline, world, m.
    pub fn strand_point(&self) -> Vector3<f64> {
        self.point + self.normal * (self.gap + self.margin)
    }
}

/// The ranges of contacts and of response numbers for strands with these numbers of contacts.
pub fn of_strands(counts: impl Iterator<Item = usize>) -> impl Iterator<Item = [Range<usize>; 2]> {
    counts.scan([0, 0], |[contact, number], count| {
        let ranges = [*contact..*contact + count, *number..*number + 9 * count * count];
        (*contact, *number) = (ranges[0].end, ranges[1].end);
        Some(ranges)
    })
}

/// The contacts of some bodies, and the strands' compliance between them. Its memory is reused.
///
/// ```
/// use superhelix::reading::ContactCompliance;
/// use superhelix::{Solver, SolverOptions};
///
/// let solver = Solver::new(SolverOptions::default())?;
/// let mut found = ContactCompliance::default();
/// solver.contact_compliance(&[], 1.0 / 60.0, 1e-3, &mut found)?;
/// assert!(found.contacts.is_empty());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct ContactCompliance {
    /// The time span, s.
    pub seconds: f64,
    /// Strand after strand, from root to tip.
    pub contacts: Vec<BodyContact>,
    /// The number of contacts of each strand.
    pub counts: Vec<u32>,
    /// Per strand a symmetric matrix of (3 contacts)² numbers, m/N: displacements of its points within the time by a force at one
    /// of them, in the layout of [`crate::contact::solver::contact_space::ContactSpace::add_strand`].
    pub response: Vec<f64>,
    /// The first `near_count` are in use; the rest is spare memory.
    near: Vec<NearStrand>,
    near_count: usize,
    /// Memory for strands with contacts.
    responses: Vec<Box<Response>>,
    /// The largest number of places of a strand so far, rounded up: every listed strand has memory for it.
    max_places: usize,
    last_contacts: Vec<(u32, f64, Contact)>,
}

/// Everything that acts on strands, beside places near the bodies.
struct Places<'a> {
    /// The bodies.
    bodies: &'a [BodyId],
    /// The last substep's contacts by strand and arclength.
    contacts: &'a [(u32, f64, Contact)],
    constraints: &'a [Constraint],
    /// A place without force and deeper than this, m, is no contact.
    max_depth: f64,
}

impl ContactCompliance {
    /// Drops contacts that `keep` rejects; it receives their indices in [`ContactCompliance::contacts`]. Dropped contacts under
    /// pressure keep a constant force.
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let mut number = 0;
        for near in &mut self.near[..self.near_count] {
            near.places.retain_mut(|place| {
                let Some(contact) = place.contact else { return true };
                number += 1;
                if keep(number - 1) {
                    return true;
                }
                place.contact = None;
                contact.force != Vector3::zeros()
            });
        }
        self.list();
    }

    /// Lists the contacts of the strands near the bodies.
    fn list(&mut self) {
        self.contacts.clear();
        self.counts.clear();
        for near in &self.near[..self.near_count] {
            let before = self.contacts.len();
            self.contacts.extend(near.places.iter().filter_map(|place| place.contact));
            if self.contacts.len() > before {
                self.counts.push((self.contacts.len() - before) as u32);
            }
        }
    }
}

impl Solver {
    /// The response of strands to `bodies` in the next `seconds`: their contacts, including places closer than `within` (m), and
    /// the compliance between a strand's contacts. All other forces on a strand, from other bodies, strands and constraints, stay
    /// constant; strands are coupled through the bodies alone. Changes nothing.
    ///
    /// # Errors
    /// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`; [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a
    /// time that is not finite and above zero, or a distance that is not finite and zero or above.
    pub fn contact_compliance(&self, bodies: &[BodyId], seconds: f64, within: f64, out: &mut ContactCompliance) -> Result<()> {
        check_positive(|| "seconds".into(), seconds)?;
        self.find_contacts(bodies, within, out)?;
        self.condense_contacts(seconds, out)
    }

    /// The first half of [`Solver::contact_compliance`]: the contacts alone. Unwanted ones may then be dropped
    /// ([`ContactCompliance::retain`]), before [`Solver::condense_contacts`] computes the response of the others.
    ///
    /// # Errors
    /// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`; [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a
    /// distance that is not finite and zero or above.
    pub fn find_contacts(&self, bodies: &[BodyId], within: f64, out: &mut ContactCompliance) -> Result<()> {
        check_not_negative(|| "within".into(), within)?;
        let still = |(k, id): (usize, &BodyId)| -> Result<BodyAt> {
            let index = self.body_index(|| format!("bodies[{k}]"), *id)?;
            Ok(self.bodies[index].body.still(index as u32))
        };
        let still = bodies.iter().enumerate().map(still).collect::<Result<Vec<BodyAt>>>()?;
        out.response.clear();
        self.list_near(&still, within, out);
        self.contacts_by_strand(&mut out.last_contacts);
        let max_depth = OVERLAPS * self.options.contact.tolerance;
        let acting = Places { bodies, contacts: &out.last_contacts, constraints: &self.constraints, max_depth };
        self.workers.for_each_task(&mut out.near[..out.near_count], TASK, usize::MAX, |strands, _| {
            for near in strands {
                near.find(&self.strands[near.index as usize], &still, within, &acting);
            }
        });
        out.list();
        Ok(())
    }

    /// The second half: the response of the detected contacts in the next `seconds`. No step may come between the two.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for a time that is not finite and above zero.
    pub fn condense_contacts(&self, seconds: f64, out: &mut ContactCompliance) -> Result<()> {
        check_positive(|| "seconds".into(), seconds)?;
        out.seconds = seconds;
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let near = &mut out.near[..out.near_count];
        let most = near.iter().map(|near| near.places.len()).max().unwrap_or(0);
        if most > out.max_places {
            out.max_places = most.next_power_of_two();
        }
        for near in near.iter_mut() {
            near.response = if near.has_contacts() { Some(out.responses.pop().unwrap_or_default()) } else { None };
            near.make_room(out.max_places);
        }
        self.workers.for_each_task(near, TASK, usize::MAX, |strands, _| {
            for near in strands.iter_mut().filter(|near| near.has_contacts()) {
                near.condense(&self.strands[near.index as usize], &setting, seconds);
                if !near.is_finite() {
                    near.places.clear();
                }
            }
        });
        out.list();
        let ContactCompliance { near, near_count, response, responses, .. } = out;
        response.clear();
        for near in &mut near[..*near_count] {
            near.write(response);
            responses.extend(near.response.take());
        }
        Ok(())
    }

    /// The strands that may come near some bodies, in their order.
    fn list_near(&self, bodies: &[BodyAt], within: f64, out: &mut ContactCompliance) {
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

    /// The last substep's contacts with their strands' indices and arclengths; those between strands for both.
    fn contacts_by_strand(&self, out: &mut Vec<(u32, f64, Contact)>) {
        out.clear();
        for contact in self.constrained_substep.contacts() {
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
