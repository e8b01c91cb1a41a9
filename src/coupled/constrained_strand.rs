//! A strand during a step in which contacts or bilateral constraints act on it: its attached material points, and its state of
//! motion in the island's iteration.
//!
//! Files:
//!
//! - `body_search.rs`: A strand's search for its contacts with bodies.
//! - `rest.rs`: Strands that rest while others of their island go on.
//! - `state.rs`: States of a strand while its step is solved: what its pack has to do, by which formula, whether it rests, what it may touch, where it ends.
//! - `strands.rs`: Constrained strands by their numbers, or one alone.

mod body_search;
mod rest;
mod state;
mod strands;

use std::sync::{Arc, Mutex};

use nalgebra::{Matrix3, Vector3};

pub use state::{FirstHalf, Formula, LookAhead, Meets, Rest, StrandEnd};
pub use strands::{Solitary, Strands};

use super::island::ending::Ending;
use super::island::{Bilateral, Island, Progress};
use crate::chain::load::MaterialPoint;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::step_constraint::EndState;
use crate::contact::contact_point::{ContactPoint, StrandCurve, StrandPath};
use crate::contact::narrow_phase::path_bounds::PathBounds;
use crate::contact::narrow_phase::strand_body;
use crate::contact::options::StrandContact;
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::contact::solver::contact_space::read_block;
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use crate::step::constrained::step::{ConstrainedStep, WorldConstraint};

/// A strand's end is rejected if its Lagrangian has risen by more than this fraction of the energy of moving by its own length
/// in the step.
const RISEN: f64 = 1e-6;

/// Cost of half an iteration: per element, per attached point and element, and per pair of attached points, in nanoseconds or
/// so.
const WORK_AN_ELEMENT: u64 = 450;
const WORK_A_COLUMN: u64 = 50;
const WORK_A_COUPLING: u64 = 10;

/// One end of a constraint on a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attachment {
    /// Index of the constraint in the strand's island.
    pub constraint: u32,
    /// Whether it is the constraint's second end, on which −force acts.
    pub second: bool,
    /// The attached material point.
    pub material_point: MaterialPoint,
    /// Whether the strand's linear model includes it; the others come last in the list.
    pub modelled: bool,
}

/// A constrained strand.
#[derive(Debug, Default)]
pub struct ConstrainedStrand {
    /// Its index in the solver.
    pub index: u32,
    /// Its step.
    pub step: ConstrainedStep,
    /// Index of its pack.
    pub pack: u32,
    /// Its lane in the pack.
    pub lane: u32,
    /// Its contact properties.
    pub contact: StrandContact,
    /// Its permitted overlap; `None` for none.
    pub permitted_overlap: Option<Arc<PermittedOverlap>>,
    /// Its mass, kg.
    pub mass: f64,
    /// The force that bends its shortest element by about a radian, N.
    pub bending: f64,
    /// Index of its island.
    pub island: u32,
    /// From root to tip, first those in its linear model; their indices are the points of the island's contact space.
    pub attachments: Vec<Attachment>,
    /// How many of them its linear model includes.
    modelled: usize,
    /// The formula of its step.
    pub formula: Formula,
    /// Whether the first half of the first iteration is already done.
    pub look_ahead: LookAhead,
    /// How its island's iteration has ended, if nothing new acts on the strand since.
    pub ended: Option<Ending>,
    /// How far its island's iteration has come, if it is alone in it and nothing new acts on it.
    pub progress: Option<Progress>,
    /// Whether it rests while others go on.
    pub rest: Rest,
    /// A later search found part of it still in something that it overlapped when the step began.
    pub left_deep: bool,
    /// The last search found an overlap that no constraint represents.
    pub has_undetected: bool,
    /// It was found in or beyond a body at the end of the step that it was outside of when the step began.
    pub behind: bool,
    /// Where it ends.
    pub end: StrandEnd,
    /// Estimated distance of an element from where the iteration would converge, rad.
    pub residual: f64,
    /// What it may touch.
    pub meets: Meets,
    /// The bodies' initial and final poses in the step as this strand meets them, one pair per body; empty: as they move in the
    /// scene.
    pub body_motions: Vec<[Frame; 2]>,
    /// Their final poses, if one of them still follows after the step; else empty.
    pub final_poses: Vec<Frame>,
    /// The number of its constraints at the last count.
    pub constraint_count: usize,
    /// Contacts with bodies found by the last search.
    pub found: Vec<ContactPoint>,
    /// The gap between its root and the nearest body, m; infinite if none is near or the root takes no part in contact. The
    /// host places the root and no force moves it: overlap there is reported and is no contact.
    pub root_gap: f64,
    /// The state of each attached point, in the attachments' order, with the material point for which it was found.
    places: Vec<(MaterialPoint, EndState)>,
    material_points: Vec<MaterialPoint>,
    forces: Vec<Vec3<f64>>,
    bilateral: Vec<Option<WorldConstraint>>,
    bounds: PathBounds,
    /// The elements that the present search passes over.
    unmoved: Vec<bool>,
    /// Taken only by the owner of the strand; the lock makes shared references safe.
    scratch: Mutex<strand_body::BodySearchScratch>,
}

impl ConstrainedStrand {
    /// Its curve at the start of the step and at the present iterate.
    pub fn path(&self) -> StrandPath<'_> {
        path_of(self.index, &self.step, self.permitted_overlap.as_deref())
    }

    /// Its step has begun.
    pub fn begun(&mut self) {
        self.places.clear();
    }

    /// Something presses it: its step begins again, unless it is one of implicit Euler already, or stays as it is.
    pub fn mark_pressed(&mut self) {
        if !self.formula.is_first_order() && self.rest != Rest::Held {
            self.formula = Formula::ToBeginAgain;
        }
    }

    /// Whether a body still follows after the step.
    pub fn lags(&self) -> bool {
        !self.final_poses.is_empty()
    }

    /// Puts the bodies where they are in the scene, at rest, and includes other strands: for the search for overlap that is left, in place. (A
    /// body that moved there from where it follows the strand would sweep through it, and the strand would count as deep by all of that way.)
    pub fn look_around(&mut self, bodies: &[BodyAt]) {
        if self.meets == Meets::Bodies {
            self.meets = Meets::All;
        }
        for (motion, body) in self.body_motions.iter_mut().zip(bodies) {
            *motion = [body.end; 2];
        }
    }

    /// A body as it moves for this strand.
    pub fn met<'a>(&self, bodies: &[BodyAt<'a>], index: u32) -> BodyAt<'a> {
        let body = bodies[index as usize];
        self.body_motions.get(index as usize).map_or(body, |motion| body.with_motion(*motion))
    }

    /// Whether some point of it has moved further than `least` (m) since it was last searched for contacts.
    pub fn has_gone(&self, least: f64) -> bool {
        self.step.gone > least
    }

    /// Has the next search for contacts look at all of it, wherever it has moved.
    pub fn search_all_of_it(&mut self) {
        self.step.gone = f64::INFINITY;
    }

    /// Arclength of a material point from the root, m.
    pub fn along(&self, material_point: &MaterialPoint) -> f64 {
        self.path().start.along(material_point.element, material_point.s)
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.step.start().1.iter().map(|element| element.length).sum()
    }

    /// The mean length of its elements, m.
    pub fn mean_element(&self) -> f64 {
        self.length() / self.elements() as f64
    }

    /// The force that moves it by its own length in a step, N.
    pub fn usual_force(&self, step: f64) -> f64 {
        self.mass * self.length() / (step * step)
    }

    /// Whether the Lagrangian has risen since the step began, which the final forces do not explain: contacts met on the way
    /// have thrown the strand there.
    pub fn has_risen(&self, step: f64) -> bool {
        let speed = self.length() / step;
        self.step.rise() > RISEN * self.mass * speed * speed
    }

    /// The state of a material point.
    pub fn end_state(&self, material_point: &MaterialPoint) -> EndState {
        self.end_now(material_point, ConstrainedStep::place(self.step.start(), material_point))
    }

    /// The same, with the initial position given.
    fn end_now(&self, material_point: &MaterialPoint, start: Vector3<f64>) -> EndState {
        EndState {
            start,
            now: ConstrainedStep::place(self.step.now(), material_point),
            tangent: self.path().now.tangent(material_point.element, material_point.s),
        }
    }

    /// The state of an attached point.
    pub fn place(&self, point: u32) -> EndState {
        self.places[point as usize].1
    }

    /// It has moved: updates its attached points.
    pub(super) fn moved(&mut self) {
        self.find_places(true);
    }

    /// Displacement of an attached point per force at it, m/N, in the linear model of the last iteration; zero for a point
    /// outside the model.
    pub(super) fn response(&self, point: u32) -> Matrix3<f64> {
        let (point, points) = (point as usize, self.step.delassus.material_points);
        if point >= points {
            return Matrix3::zeros();
        }
        read_block(&self.step.delassus.columns, 3 * points, 3 * point, 3 * point)
    }

    /// Updates the states of the attached points: those with a new material point, or all if the strand has `moved`.
    fn find_places(&mut self, moved: bool) {
        self.places.truncate(self.attachments.len());
        for index in 0..self.attachments.len() {
            let material_point = self.attachments[index].material_point;
            match self.places.get(index) {
                Some((known, state)) if *known == material_point => {
                    if moved {
                        let start = state.start;
                        self.places[index].1 = self.end_now(&material_point, start);
                    }
                }
                Some(_) => self.places[index] = (material_point, self.end_state(&material_point)),
                None => self.places.push((material_point, self.end_state(&material_point))),
            }
        }
    }

    /// Takes over the constraints' present material points and sorts the attachments: first those of the linear model, which is
    /// a new one unless the strand rests, then the others; both from root to tip, those of one point by constraint.
    fn sort(&mut self, island: &Island) {
        for attachment in &mut self.attachments {
            let constraint = &island.constraints[attachment.constraint as usize];
            let end = if attachment.second { constraint.second.unwrap_or(constraint.first) } else { constraint.first };
            attachment.material_point = end.material_point;
            attachment.modelled = if self.rest.is_resting() { attachment.modelled } else { !constraint.is_dormant() };
        }
        self.attachments.sort_by(|a, b| {
            let key = |x: &Attachment| (!x.modelled, x.material_point.element, x.material_point.s);
            key(a)
                .partial_cmp(&key(b))
                .unwrap_or(std::cmp::Ordering::Equal)
                .then((a.constraint, a.second).cmp(&(b.constraint, b.second)))
        });
        self.modelled = self.attachments.partition_point(|attachment| attachment.modelled);
    }

    fn pull(&mut self, island: &Island) {
        self.forces.clear();
        self.forces.extend(self.attachments[..self.modelled].iter().map(|attachment| {
            let force = island.constraints[attachment.constraint as usize].force;
            Vec3::from(if attachment.second { -force } else { force })
        }));
    }

    /// Cost of half an iteration, nanoseconds or so.
    pub fn half_work(&self) -> u64 {
        if self.rest.is_resting() { 0 } else { self.half_work_with(self.modelled) }
    }

    /// How many elements it has.
    pub fn elements(&self) -> usize {
        self.step.now().1.len()
    }

    /// The same with this many attached points.
    pub fn half_work_with(&self, points: usize) -> u64 {
        let (elements, points) = (self.elements() as u64, points as u64);
        elements * (WORK_AN_ELEMENT + WORK_A_COLUMN * points) + WORK_A_COUPLING * points * points
    }

    /// Before the first half of a Newton iteration; the constraints' forces are those of the last iteration.
    pub fn hold(&mut self, island: &Island) -> FirstHalf {
        if std::mem::take(&mut self.look_ahead) == LookAhead::Done {
            return FirstHalf::Done;
        }
        self.choose_rest(island);
        self.sort(island);
        self.find_places(false);
        if self.rest.is_resting() {
            return FirstHalf::None;
        }
        self.material_points.clear();
        self.material_points.extend(self.attachments[..self.modelled].iter().map(|attachment| attachment.material_point));
        self.pull(island);
        self.bilateral.clear();
        if island.bilateral == Bilateral::ToWorld {
            self.bilateral.extend(self.attachments[..self.modelled].iter().map(|end| {
                let constraint = &island.constraints[end.constraint as usize];
                constraint.world_constraint(&ConstrainedStep::place(self.step.now(), &end.material_point))
            }));
        }
        self.step.hold(&self.material_points, &self.forces, &self.bilateral);
        FirstHalf::ToDo
    }

    /// Before the second half, with the constraints' new forces. False if its pack need not advance it: it rests, or begins
    /// again.
    pub fn advances(&mut self, island: &Island) -> bool {
        if self.formula == Formula::ToBeginAgain {
            self.residual = f64::INFINITY;
            return false;
        }
        if self.rest.is_resting() {
            return false;
        }
        self.pull(island);
        self.step.pull(&self.forces);
        true
    }

    /// Its pack has done the second half.
    pub fn advanced(&mut self) {
        self.end = StrandEnd::Iterated;
        self.residual = self.step.residual;
        self.find_places(true);
    }

    /// Displacement of an attached point in this iteration without forces.
    pub fn unconstrained(&self, point: u32) -> Vector3<f64> {
        self.step.unconstrained[point as usize].into()
    }
}

fn path_of<'a>(index: u32, step: &'a ConstrainedStep, permitted_overlap: Option<&'a PermittedOverlap>) -> StrandPath<'a> {
    let curve = |(origin, elements)| StrandCurve { origin, elements };
    StrandPath { index, start: curve(step.start()), now: curve(step.now()), permitted_overlap }
}
