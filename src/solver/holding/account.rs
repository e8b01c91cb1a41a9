//! What a held substep came to: how the strands fared, the list of touches, what bodies and constraints bear.

use nalgebra::Vector3;

use super::{Holding, Scene};
use crate::chain::load::MaterialPoint;
use crate::contact::joint::{Joint, JointEnd, JointKind};
use crate::contact::nearest_pair::depth;
use crate::solver::bodies::{Contact, ContactPartner};
use crate::solver::report::Wrench;
use crate::solver::strand::Tally;

/// What contact came to in a call.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactTally {
    /// Touches that carried a force at the end of the last substep.
    pub touches: u32,
    /// Searches that found touches which the one at a substep's start had not.
    pub searches: u32,
    /// Newton iterations of the island that took most.
    pub iterations: u32,
    /// Sweeps of the contact problem's solver, all islands and substeps together.
    pub sweeps: u64,
    /// Islands whose iteration ended elsewhere than it should.
    pub unconverged: u32,
    /// Largest residual of the laws, relative, see `docs/theory/contact.md`.
    pub residual: f64,
    /// How deep surfaces were in each other at the end of a substep at most, m.
    pub penetration: f64,
    /// The largest distance of a constraint from holding at the end of a substep, m.
    pub constraint_error: f64,
    /// Touches whose force is told as no more than hair can do, at the end of the last substep: what takes the strand its own length in the substep and
    /// bends its elements by a radian; twice that where the touch's island is solved. What the laws ask for where there is no room, as in a root that stands in a
    /// mesh, is no force.
    pub capped: u32,
    /// Strands whose root was in a body by more than [`ContactOptions::tolerance`](crate::contact::options::ContactOptions::tolerance) at the end of the last substep, and not exempt: it is where
    /// the host put it, and no force parts the two. (`penetration` has how deep.)
    pub roots_inside: u32,
}

/// Where all laws hold forces may be so many times what takes a strand its own length in a substep and bends its elements by a radian.
const SOLVED: f64 = 2.0;

/// Where it is told.
#[derive(Debug)]
pub(in crate::solver) struct Account<'a> {
    pub tally: &'a mut Tally,
    pub contact: &'a mut ContactTally,
    /// On the bodies.
    pub wrenches: &'a mut [Wrench],
}

impl Holding {
    /// What the strands at a touch can press with, N.
    fn most_force(&self, joint: &Joint, h: f64) -> f64 {
        let of = |end: JointEnd| self.strands[end.held as usize].usual_force(h) + self.strands[end.held as usize].bending;
        joint.ends().map(of).fold(f64::INFINITY, f64::min)
    }

    /// Writes down what the strands and their joints came to, but for those that have taken the substep in parts; of these only the roots, which are
    /// where the host has put them.
    pub(super) fn tell(&mut self, scene: &mut Scene, h: f64, account: &mut Account) {
        let islands = &self.islands[..self.island_count];
        let contact = &mut *account.contact;
        (contact.touches, contact.roots_inside, contact.capped) = (0, 0, 0);
        for held in &self.strands[..self.count] {
            if !islands[held.island as usize].takes_parts {
                account.tally.add(&held.held.outcome);
            }
            contact.penetration = contact.penetration.max(-held.root_gap);
            contact.roots_inside += u32::from(held.root_gap < -scene.options.tolerance);
        }
        self.contacts.clear();
        for constraint in scene.constraints.iter_mut() {
            constraint.begin_report();
        }
        let place = |held: u32, material_point: &MaterialPoint| {
            let strand = &self.strands[held as usize];
            (scene.strands[strand.index as usize].id, strand.along(material_point))
        };
        for island in islands.iter().filter(|island| !island.takes_parts) {
            contact.unconverged += u32::from(!island.ending.converged);
            contact.residual = contact.residual.max(island.ending.residual);
            contact.penetration = contact.penetration.max(island.left.deep);
            let was_searched = if scene.options.model.is_soft() { scene.is_last } else { island.failed() };
            for joint in &island.joints {
                match joint.constraint() {
                    Some(index) => {
                        contact.constraint_error = contact.constraint_error.max(joint.gap);
                        let strand = &self.strands[joint.first.held as usize];
                        scene.constraints[index as usize].add_report(joint, &strand.path().now);
                    }
                    None => {
                        if !was_searched {
                            contact.penetration = contact.penetration.max(depth(joint, &self.strands, scene.options.tolerance));
                        }
                        // (What rubs still, and does not press any more, is no contact, nor what an iteration that was cut or given up left drawing.)
                        if joint.force == Vector3::zeros() || joint.draws() || scene.options.model.is_soft() && !joint.presses() {
                            continue;
                        }
                        contact.touches += 1;
                        let (strand, arclength) = place(joint.first.held, &joint.first.material_point);
                        let position = self.strands[joint.first.held as usize].end_state(&joint.first.material_point).now;
                        let most = self.most_force(joint, h) * if island.ending.converged { SOLVED } else { 1.0 };
                        let size = joint.force.norm();
                        let force = if size > most { joint.force * (most / size) } else { joint.force };
                        contact.capped += u32::from(size > most);
                        let (normal, partner) = match (joint.kind, joint.second) {
                            (JointKind::Hair { normal, .. }, Some(end)) => {
                                let (strand, arclength) = place(end.held, &end.material_point);
                                (normal, ContactPartner::Strand { strand, arclength })
                            }
                            (JointKind::Body { body, feature, normal, point, .. }, _) => {
                                let origin = scene.bodies[body as usize].end.origin;
                                let wrench = &mut account.wrenches[body as usize];
                                wrench.force -= force;
                                wrench.torque -= (point - origin).cross(&force);
                                (normal, ContactPartner::Body { body: scene.body_ids[body as usize], feature })
                            }
                            _ => continue,
                        };
                        let slip = joint.slip - normal * normal.dot(&joint.slip);
                        // A touch that was found elsewhere may say more than the search did.
                        let gap = if was_searched { joint.gap.max(-island.left.deep) } else { joint.gap };
                        self.contacts.push(Contact { strand, arclength, partner, position, normal, force, gap, slip });
                    }
                }
            }
        }
        self.touching.remember(islands.iter().filter(|island| !island.takes_parts), &self.strands);
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
