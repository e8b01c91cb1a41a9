//! Contact at points: strands that only bodies may touch step side by side with others, and their contacts are taken down.

use std::ops::Range;

use nalgebra::Vector3;

use super::constrained_substep::{ConstrainedSubstep, ContactTally};
use crate::contact::body_at::BodyAt;
use crate::contact::options::{ContactModel, ContactOptions, StrandContact};
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::contact::point_surfaces::StrandSurfaces;
use crate::math::lane::MAX_LANES;
use crate::solver::bodies::{Contact, ContactPartner};
use crate::solver::id::{BodyId, SlotMap, StrandId};
use crate::solver::report::Wrench;
use crate::solver::strands::strand::{Constrained, Strand};
use crate::step::at_points::surfaces::{DepthAtPoints, PointContact, PointContactOptions};

/// What a task's strands may touch in a substep, and what they have touched.
pub(super) struct AtPoints<'a> {
    pub bodies: &'a [BodyAt<'a>],
    pub options: PointContactOptions,
    /// A root that is deeper than this counts as inside, m.
    pub deepest_root: f64,
    pub found: &'a mut Touched,
}

/// Contacts at the end of a substep.
#[derive(Debug, Default)]
pub(in crate::solver) struct Touched {
    /// Those of a strand follow each other, from root to tip.
    contacts: Vec<PointContact>,
    /// The strands that have some; those of a task follow each other, in order once it has ended.
    strands: Vec<TouchedStrand>,
    /// The tasks that have ended, by where their strands are.
    tasks: Vec<Range<usize>>,
    /// The deepest overlap, m; zero for none.
    pub depth: f64,
    /// Strands whose root is in a body.
    pub roots_inside: u32,
    /// Memory for the bodies near a pack's strands.
    near: Vec<u32>,
}

/// A strand that has contacts.
#[derive(Debug)]
struct TouchedStrand {
    /// Its place among those of its task.
    place: usize,
    strand: StrandId,
    /// Where its contacts are.
    contacts: Range<usize>,
}

/// The bodies near a pack's strands, by lane.
#[derive(Debug, Default)]
pub(super) struct NearBodies<'a> {
    all: Vec<u32>,
    ends: [usize; MAX_LANES],
    /// All bodies in the motions in which a lane's strand meets them, if those are not their own: bodies that jumped with its root
    /// have not passed it.
    own_motions: Vec<(usize, Vec<BodyAt<'a>>)>,
}

impl Touched {
    /// Whether nothing was touched.
    pub fn is_empty(&self) -> bool {
        self.contacts.is_empty() && self.depth == 0.0 && self.roots_inside == 0
    }

    /// A task has ended: puts its strands in order.
    pub fn end_task(&mut self) {
        self.strands.sort_unstable_by_key(|strand| strand.place);
    }

    /// Takes over those of a task that has ended.
    pub fn take(&mut self, task: &mut Self) {
        let (first, contacts) = (self.strands.len(), self.contacts.len());
        self.contacts.append(&mut task.contacts);
        self.strands.extend(task.strands.drain(..).map(|TouchedStrand { place, strand, contacts: Range { start, end } }| {
            TouchedStrand { place, strand, contacts: contacts + start..contacts + end }
        }));
        self.tasks.push(first..self.strands.len());
        self.depth = self.depth.max(std::mem::take(&mut task.depth));
        self.roots_inside += std::mem::take(&mut task.roots_inside);
    }
}

impl<'a> AtPoints<'a> {
    /// Finds the bodies near the strands of a pack.
    pub fn find_near<'s>(&mut self, strands: impl Iterator<Item = &'s Strand>, h: f64) -> NearBodies<'a> {
        let mut near = NearBodies { all: std::mem::take(&mut self.found.near), ..NearBodies::default() };
        near.all.clear();
        for (lane, strand) in strands.enumerate() {
            if let Some(contact) = strand.contact.as_deref() {
                let around = strand.reach(contact, &strand.root_during(h));
                let bodies = self.bodies.iter().filter(|body| body.meets(contact.groups, contact.mask) && body.is_near(&around));
                near.all.extend(bodies.map(|body| body.index));
                let from = strand.bodies_from();
                if from.len() == self.bodies.len() {
                    let moved = self.bodies.iter().zip(from).map(|(body, from)| body.with_motion([*from, body.end]));
                    near.own_motions.push((lane, moved.collect()));
                }
            }
            near.ends[lane] = near.all.len();
        }
        near
    }

    /// Keeps the list's memory.
    pub fn give_back(&mut self, near: NearBodies<'a>) {
        self.found.near = near.all;
    }

    /// What a strand of the pack may touch.
    pub fn surfaces_of<'s>(
        &self,
        near: &'s NearBodies<'a>,
        lane: usize,
        contact: Option<&'s StrandContact>,
        permitted_overlap: Option<&'s PermittedOverlap>,
    ) -> Option<StrandSurfaces<'s>>
    where
        Self: 's,
    {
        let from = if lane > 0 { near.ends[lane - 1] } else { 0 };
        let own = near.own_motions.iter().find(|(of, _)| *of == lane);
        let bodies = own.map_or(self.bodies, |(_, bodies)| bodies);
        Some(StrandSurfaces { bodies, near: &near.all[from..near.ends[lane]], contact: contact?, permitted_overlap })
    }

    /// Takes down how deep a strand is.
    pub fn take_depth(&mut self, depth: DepthAtPoints) {
        self.found.depth = self.found.depth.max(depth.deepest);
        self.found.roots_inside += u32::from(depth.root > self.deepest_root);
    }

    /// Takes down a contact of the strand at this place of the task, behind its others.
    pub fn take_contact(&mut self, place: usize, strand: &mut Strand, contact: &PointContact) {
        strand.touched = true;
        let Touched { contacts, strands, .. } = &mut *self.found;
        contacts.push(*contact);
        match strands.last_mut().filter(|last| last.place == place) {
            Some(last) => last.contacts.end = contacts.len(),
            None => strands.push(TouchedStrand { place, strand: strand.id, contacts: contacts.len() - 1..contacts.len() }),
        }
    }
}

/// How contact at points is answered in a substep of `h` seconds, if it is.
pub(super) fn options(options: &ContactOptions, h: f64) -> Option<PointContactOptions> {
    let ContactOptions { tolerance, separation_speed, max_iterations, .. } = *options;
    let (holding_depth, separation) = (2.0 * tolerance, separation_speed * h);
    let at_points = options.model == ContactModel::AtPoints;
    at_points.then_some(PointContactOptions { holding_depth, separation, max_iterations })
}

/// Before a substep: strands have touched nothing in it.
pub(super) fn begin(strands: &mut [Strand]) {
    for strand in strands.iter_mut().filter(|strand| strand.constrained == Constrained::AtPoints) {
        strand.touched = false;
    }
}

/// Where the results are written.
pub(in crate::solver) struct Results<'a> {
    pub contacts: &'a mut ConstrainedSubstep,
    pub wrenches: &'a mut [Wrench],
    pub tally: &'a mut ContactTally,
}

impl Touched {
    /// Adds the contacts of a substep to its results, in the order of the strands, and forgets them.
    pub fn report(&mut self, slots: &SlotMap<StrandId>, bodies: &[BodyAt], ids: &[BodyId], results: Results) {
        let Results { contacts, wrenches, tally } = results;
        tally.penetration = tally.penetration.max(std::mem::take(&mut self.depth));
        tally.contacts += self.contacts.len() as u32;
        tally.roots_inside += std::mem::take(&mut self.roots_inside);
        self.tasks.sort_unstable_by_key(|task| self.strands.get(task.start).and_then(|first| slots.index(first.strand)));
        for TouchedStrand { strand, contacts: of_strand, .. } in self.tasks.drain(..).flat_map(|task| &self.strands[task]) {
            for PointContact { arclength, position, surface, force, slip } in &self.contacts[of_strand.clone()] {
                let (position, force) = (Vector3::from(*position), Vector3::from(*force));
                let body = surface.body as usize;
                wrenches[body].force -= force;
                wrenches[body].torque -= (position - bodies[body].end.origin).cross(&force);
                contacts.add_contact(Contact {
                    strand: *strand,
                    arclength: *arclength,
                    partner: ContactPartner::Body { body: ids[body], feature: surface.feature },
                    position,
                    normal: surface.normal.into(),
                    force,
                    gap: surface.gap,
                    slip: (*slip).into(),
                });
            }
        }
        self.contacts.clear();
        self.strands.clear();
    }
}
