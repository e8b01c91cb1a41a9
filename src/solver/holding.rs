//! The substep of strands that touches or constraints hold: found, tied into islands, and taken together, Newton iteration by Newton
//! iteration. Strands do the two halves of an iteration on any thread, islands solve their contact problems between them; who runs
//! which changes no result.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::constraints::{Constraint, ConstraintStatus};
use super::id::{SlotMap, StrandId};
use super::strand::{self, Strand, Tally};
use super::workers::Crew;
use crate::contact::held_strand::{Attachment, HeldStrand};
use crate::contact::island::Island;
use crate::contact::joint::Joint;
use crate::contact::options::ContactOptions;
use crate::step::Setting;
use crate::step::members::One;

/// What the solver keeps for held strands between substeps.
#[derive(Debug, Default)]
pub(super) struct Holding {
    /// The strands held in the last substep; more may be kept for their memory.
    strands: Vec<HeldStrand>,
    count: usize,
    islands: Vec<Island>,
    island_count: usize,
    joints: Vec<Joint>,
    parents: Vec<u32>,
}

/// What contact came to in a call.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactTally {
    /// Touches that carried a force at the end of the last substep.
    pub touches: u32,
    /// Newton iterations of the island that took most.
    pub iterations: u32,
    /// Sweeps of the contact problem's solver, all islands and substeps together.
    pub sweeps: u64,
    /// Islands whose iteration ended elsewhere than it should.
    pub unconverged: u32,
    /// Largest residual of the laws, relative, see `docs/contact.md`.
    pub residual: f64,
    /// How deep surfaces were in each other at the end of a substep at most, m.
    pub penetration: f64,
    /// The largest distance of a constraint from holding at the end of a substep, m.
    pub constraint_error: f64,
}

/// What a held substep works on.
pub(super) struct Scene<'a> {
    pub strands: &'a mut [Strand],
    pub slots: &'a SlotMap<StrandId>,
    pub constraints: &'a mut [Constraint],
    pub options: &'a ContactOptions,
    pub setting: &'a Setting<'a>,
    pub crew: &'a Crew,
}

impl Holding {
    /// Marks the strands that this substep holds.
    pub fn mark(scene: &mut Scene) {
        for strand in scene.strands.iter_mut() {
            strand.held = false;
        }
        for constraint in scene.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            let ends = [Some(constraint.def.strand), constraint.other()];
            for index in ends.into_iter().flatten().filter_map(|id| scene.slots.index(id)) {
                scene.strands[index].held = true;
            }
        }
    }

    /// Takes the marked strands through a substep of `h` seconds.
    pub fn take(&mut self, scene: &mut Scene, h: f64, tally: &mut Tally, contact: &mut ContactTally) {
        let held: Vec<usize> = (0..scene.strands.len()).filter(|index| scene.strands[*index].held).collect();
        if held.is_empty() {
            return;
        }
        self.count = held.len();
        self.strands.resize_with(self.strands.len().max(held.len()), HeldStrand::default);
        for constraint in scene.constraints.iter_mut() {
            constraint.way.begin(h);
        }
        self.begin(scene, h);
        self.joints.clear();
        self.hold_constraints(scene, &held, h);
        self.tie();
        self.iterate(scene, h);
        self.end(scene, h, tally, contact);
    }

    /// The marked strands, each with its place in `strands`.
    fn pairs<'a>(strands: &'a mut [Strand], held: &'a mut [HeldStrand]) -> Vec<(&'a mut Strand, &'a mut HeldStrand)> {
        strands.iter_mut().filter(|strand| strand.held).zip(held).collect()
    }

    fn begin(&mut self, scene: &mut Scene, h: f64) {
        let mut index = 0;
        for (k, strand) in scene.strands.iter().enumerate().filter(|(_, strand)| strand.held) {
            let held = &mut self.strands[index];
            held.index = k as u32;
            held.contact = strand.contact.as_deref().copied().unwrap_or_default();
            index += 1;
        }
        let mut pairs = Self::pairs(scene.strands, &mut self.strands[..self.count]);
        scene.crew.for_each(&mut pairs, |(strand, held), _| {
            strand.begin_root_way(h);
            with_one(strand, |one| held.held.begin(one, scene.setting, h, false));
        });
    }

    /// The constraints' joints.
    fn hold_constraints(&mut self, scene: &mut Scene, held: &[usize], h: f64) {
        let place: HashMap<usize, u32> = held.iter().enumerate().map(|(k, index)| (*index, k as u32)).collect();
        let joints = &mut self.joints;
        for (k, constraint) in scene.constraints.iter_mut().enumerate() {
            let find = |id| scene.slots.index(id).map(|index| (place[&index], &scene.strands[index].model));
            if constraint.state.status == ConstraintStatus::Released {
                continue;
            }
            let Some(first) = find(constraint.def.strand) else { continue };
            let second = constraint.other().and_then(find);
            constraint.joints(k as u32, h, first, second, |joint| joints.push(joint));
        }
    }

    /// Ties the joints' strands into islands.
    fn tie(&mut self) {
        self.parents.clear();
        self.parents.extend(0..self.count as u32);
        for joint in &self.joints {
            if let Some(second) = joint.second {
                let (a, b) = (root(&mut self.parents, joint.first.held), root(&mut self.parents, second.held));
                let (low, high) = (a.min(b), a.max(b));
                self.parents[high as usize] = low;
            }
        }
        for held in &mut self.strands[..self.count] {
            held.attachments.clear();
            held.done = false;
            held.residual = f64::INFINITY;
        }
        self.island_count = 0;
        for k in 0..self.count {
            let lowest = root(&mut self.parents, k as u32) as usize;
            let island = if lowest == k {
                self.island_count += 1;
                self.islands.resize_with(self.islands.len().max(self.island_count), Island::default);
                self.islands[self.island_count - 1].clear();
                self.island_count - 1
            } else {
                self.strands[lowest].island as usize
            };
            self.strands[k].island = island as u32;
            self.islands[island].strands.push(k as u32);
        }
        for joint in self.joints.drain(..) {
            let island = &mut self.islands[self.strands[joint.first.held as usize].island as usize];
            let number = island.joints.len() as u32;
            island.joints.push(joint);
            let ends = [Some(joint.first), joint.second];
            for (second, end) in ends.into_iter().enumerate().filter_map(|(k, end)| end.map(|end| (k == 1, end))) {
                let attachment = Attachment { joint: number, second, station: end.station };
                self.strands[end.held as usize].attachments.push(attachment);
            }
        }
    }

    /// Newton's iterations of all islands.
    fn iterate(&mut self, scene: &mut Scene, h: f64) {
        let (setting, options) = (scene.setting, scene.options);
        let Self { strands, islands, count, island_count, .. } = self;
        let (strands, islands) = (&mut strands[..*count], &mut islands[..*island_count]);
        loop {
            if islands.iter().all(|island| island.done) {
                break;
            }
            scene.crew.for_each(islands, |island, _| {
                if !island.done {
                    island.refresh(strands);
                }
            });
            scene.crew.for_each(strands, |held, _| {
                let island = &islands[held.island as usize];
                if !island.done {
                    held.linearise(island);
                }
            });
            scene.crew.for_each(islands, |island, _| {
                if !island.done {
                    island.find_ends(strands);
                    // A number that is not finite: the strand that it comes from is told apart at the end.
                    if island.solve(strands, options, h).is_err() {
                        island.done = true;
                    }
                }
            });
            scene.crew.for_each(strands, |held, _| {
                let island = &islands[held.island as usize];
                if !island.done {
                    held.advance(setting, island);
                }
            });
            scene.crew.for_each(islands, |island, _| {
                if !island.done {
                    island.check(strands, options, setting.options.tolerance, h);
                }
            });
        }
    }

    /// Makes the ends the strands' states, and writes down what the joints came to.
    fn end(&mut self, scene: &mut Scene, h: f64, tally: &mut Tally, contact: &mut ContactTally) {
        let islands = &self.islands[..self.island_count];
        let mut pairs = Self::pairs(scene.strands, &mut self.strands[..self.count]);
        let setting = scene.setting;
        scene.crew.for_each(&mut pairs, |(strand, held), scratch| {
            held.held.outcome.converged = islands[held.island as usize].converged;
            with_one(strand, |one| held.held.end(one, setting, h, &mut scratch.rule));
            let outcome = held.held.outcome;
            strand.ended(outcome, setting, h, scratch);
        });
        for held in &self.strands[..self.count] {
            tally.add(&held.held.outcome);
        }
        contact.touches = 0;
        for constraint in scene.constraints.iter_mut() {
            constraint.begin_report();
        }
        for island in islands {
            contact.iterations = contact.iterations.max(island.iterations);
            contact.sweeps += u64::from(island.sweeps);
            contact.unconverged += u32::from(!island.converged);
            contact.residual = contact.residual.max(island.residual);
            for joint in &island.joints {
                match joint.constraint() {
                    Some(index) => {
                        contact.constraint_error = contact.constraint_error.max(joint.gap);
                        let strand = &self.strands[joint.first.held as usize];
                        scene.constraints[index as usize].add_report(joint, &strand.path().now);
                    }
                    None => {
                        contact.touches += u32::from(joint.force != Vector3::zeros());
                        contact.penetration = contact.penetration.max(-joint.gap);
                    }
                }
            }
        }
        for island in islands {
            for dependent in &island.report.dependent {
                if let Some(index) = island.joints[dependent.touch].constraint() {
                    scene.constraints[index as usize].depends();
                }
            }
        }
        for constraint in scene.constraints.iter_mut() {
            constraint.way.advance(h);
        }
    }
}

/// The lowest strand of a strand's island so far.
fn root(parents: &mut [u32], mut k: u32) -> u32 {
    while parents[k as usize] != k {
        parents[k as usize] = parents[parents[k as usize] as usize];
        k = parents[k as usize];
    }
    k
}

fn with_one<R>(strand: &mut Strand, work: impl FnOnce(&mut One) -> R) -> R {
    let Strand { model, state, root_move, .. } = strand;
    let start = state.root;
    let root_at = |elapsed: f64| strand::root_after(root_move, &start, elapsed);
    work(&mut One { model, state, root_at: &root_at })
}
