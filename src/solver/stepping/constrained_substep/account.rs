//! The results of a constrained substep: the outcomes of strands, the list of contacts, the loads of bodies and bilateral
//! constraints.

use nalgebra::Vector3;

use super::{ConstrainedSubstep, Scene};
use crate::chain::load::MaterialPoint;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, StepConstraint};
use crate::coupled::constrained_strand::ConstrainedStrand;
use crate::coupled::iterations::IterationTally;
use crate::coupled::nearest_pair::depth;
use crate::solver::bodies::{Contact, ContactPartner};
use crate::solver::report::Wrench;
use crate::solver::strands::strand::Tally;

/// The results of contact in a call.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactTally {
    /// Contacts with a force at the end of the last substep.
    pub contacts: u32,
    /// Searches that found contacts undetected by the one at the start of their substep.
    pub searches: u32,
    /// The largest number of Newton iterations of an island.
    pub iterations: u32,
    /// Sweeps of the contact problem's solver, all islands and substeps together.
    pub sweeps: u64,
    /// Islands whose iteration ended without converging.
    pub unconverged: u32,
    /// Largest residual of the laws, relative, see `docs/theory/contact.md`.
    pub residual: f64,
    /// The largest depth of overlap at the end of a substep, m.
    pub penetration: f64,
    /// The largest distance of a bilateral constraint from being satisfied at the end of a substep, m.
    pub constraint_error: f64,
    /// Contacts at the end of the last substep whose force is reported as the largest that hair can exert: the force that moves
    /// the strand by its own length in the substep and bends its elements by a radian; twice that if the contact's island has
    /// converged. What the laws ask for where there is no room, as in a root inside a mesh, is no force.
    pub capped: u32,
    /// Strands whose root was in a body by more than
    /// [`ContactOptions::tolerance`](crate::contact::options::ContactOptions::tolerance) at the end of the last substep, and
    /// not exempt: the host put it there, and no force separates the two. (`penetration` includes its depth.)
    pub roots_inside: u32,
}

impl ContactTally {
    /// Adds what iterations have come to.
    pub(super) fn count(&mut self, tally: &IterationTally) {
        self.iterations = self.iterations.max(tally.iterations);
        self.sweeps += tally.sweeps;
        self.searches += tally.searches;
    }
}

/// Where all laws hold, forces may be this many times the force that moves a strand by its own length in a substep and bends
/// its elements by a radian.
const SOLVED: f64 = 2.0;

/// Where the results are written.
#[derive(Debug)]
pub(in crate::solver) struct Account<'a> {
    pub tally: &'a mut Tally,
    pub contact: &'a mut ContactTally,
    /// On the bodies.
    pub wrenches: &'a mut [Wrench],
}

/// The largest force that the strands of a contact can exert, N.
fn max_force(strands: &[ConstrainedStrand], constraint: &StepConstraint, h: f64) -> f64 {
    let of = |end: ConstraintEnd| strands[end.strand as usize].usual_force(h) + strands[end.strand as usize].bending;
    constraint.ends().map(of).fold(f64::INFINITY, f64::min)
}

impl ConstrainedSubstep {
    /// Writes down the results of strands and constraints, except those that have taken the substep in substeps; of these only
    /// the roots, which are where the host has put them.
    pub(super) fn report(&mut self, scene: &mut Scene, h: f64, account: &mut Account) {
        let (strands, islands) = (self.coupled.strands(), self.coupled.islands());
        let contact = &mut *account.contact;
        (contact.contacts, contact.roots_inside, contact.capped) = (0, 0, 0);
        for constrained in strands {
            if !islands[constrained.island as usize].is_subdivided() {
                account.tally.add(&constrained.step.outcome);
            }
            contact.penetration = contact.penetration.max(-constrained.root_gap);
            contact.roots_inside += u32::from(constrained.root_gap < -scene.options.deepest_root());
        }
        self.contacts.clear();
        for constraint in scene.constraints.iter_mut() {
            constraint.begin_report();
        }
        let place = |constrained: u32, material_point: &MaterialPoint| {
            let strand = &strands[constrained as usize];
            (scene.strands[strand.index as usize].id, strand.along(material_point))
        };
        for island in islands.iter().filter(|island| !island.is_subdivided()) {
            contact.unconverged += u32::from(!island.progress.ending.is_converged());
            contact.residual = contact.residual.max(island.progress.ending.residual);
            contact.penetration = contact.penetration.max(island.left.deep);
            let soft = scene.options.model.is_soft();
            let was_searched = if soft { scene.is_last } else { island.failed() };
            for constraint in &island.constraints {
                match constraint.bilateral() {
                    Some(index) => {
                        contact.constraint_error = contact.constraint_error.max(constraint.gap);
                        let strand = &strands[constraint.first.strand as usize];
                        scene.constraints[index as usize].add_report(constraint, &strand.path().now);
                    }
                    None => {
                        // (Soft models search for hair that is deeper than what is known, and for no other.)
                        let was_left_out = soft && constraint.second.is_some();
                        let was_measured = was_searched && !was_left_out && -constraint.gap > scene.options.tolerated_depth();
                        let deep = if was_measured { 0.0 } else { depth(constraint, strands, scene.options.tolerance) };
                        contact.penetration = contact.penetration.max(deep);
                        // (A contact with friction but no pressure is none, nor is one that pulls, as left by an iteration that
                        // was cut or given up.)
                        if constraint.force == Vector3::zeros() || constraint.draws() || soft && !constraint.presses() {
                            continue;
                        }
                        contact.contacts += 1;
                        let (strand, arclength) = place(constraint.first.strand, &constraint.first.material_point);
                        let position = strands[constraint.first.strand as usize].end_state(&constraint.first.material_point).now;
                        let most =
                            max_force(strands, constraint, h) * if island.progress.ending.is_converged() { SOLVED } else { 1.0 };
                        let size = constraint.force.norm();
                        let force = if size > most { constraint.force * (most / size) } else { constraint.force };
                        contact.capped += u32::from(size > most);
                        let (normal, partner) = match (constraint.kind, constraint.second) {
                            (ConstraintKind::Hair { normal, .. }, Some(end)) => {
                                let (strand, arclength) = place(end.strand, &end.material_point);
                                (normal, ContactPartner::Strand { strand, arclength })
                            }
                            (ConstraintKind::Body { body, feature, normal, point, .. }, _) => {
                                let origin = scene.bodies[body as usize].end.origin;
                                let wrench = &mut account.wrenches[body as usize];
                                wrench.force -= force;
                                wrench.torque -= (point - origin).cross(&force);
                                (normal, ContactPartner::Body { body: scene.body_ids[body as usize], feature })
                            }
                            _ => continue,
                        };
                        let slip = constraint.slip - normal * normal.dot(&constraint.slip);
                        // The gap at the place where a contact was found may be deeper than the search says.
                        let gap = match () {
                            () if was_measured => constraint.gap.max(-island.left.deep),
                            () if was_left_out => -deep,
                            () => constraint.gap,
                        };
                        self.contacts.push(Contact { strand, arclength, partner, position, normal, force, gap, slip });
                    }
                }
            }
        }
        for island in islands {
            for dependent in &island.progress.report.dependent {
                if let Some(index) = island.constraints[dependent.constraint].bilateral() {
                    scene.constraints[index as usize].depends();
                }
            }
        }
        self.coupled.store_warm_start();
        for constraint in scene.constraints.iter_mut() {
            constraint.motion.advance(h);
        }
    }
}
