//! A strand in the course of a step in which touches or constraints hold it: its stations, and what the joints of its island make of
//! them.

use std::sync::{Mutex, PoisonError};

use nalgebra::{Matrix3, Vector3};

use super::body::BodyAt;
use super::contact_point::{ContactPoint, StrandCurve, StrandPath};
use super::contact_space::read_block;
use super::ending::Ending;
use super::island::Island;
use super::options::StrandContact;
use super::step_constraint::EndState;
use super::strand_body::{self, PathBounds, Span};
use crate::chain::load::MaterialPoint;
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use crate::step::constrained_step::{ConstrainedStep, WorldConstraint};

/// A strand that was woken so often rests no more: two neighbours would go on waking each other in turn.
const MAX_WAKES: u32 = 2;

/// Touches that are nearer to each other along a strand than this, m, and have normals within this cosine, are one.
const ONE_PLACE: f64 = 1e-6;
const ONE_SIDE: f64 = 0.99;

/// A strand has strayed if its Lagrangian has risen by more than this part of the energy of going its own length in the step.
const RISEN: f64 = 1e-6;

/// What half an iteration takes for an element, for a point that is touched and an element, and for two points: nanoseconds or so.
const WORK_AN_ELEMENT: u64 = 700;
const WORK_A_COLUMN: u64 = 60;
const WORK_A_COUPLING: u64 = 10;

/// One end of a joint on a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attachment {
    /// Index of the joint in the strand's island.
    pub constraint: u32,
    /// Whether it is the joint's second end, on which −force acts.
    pub second: bool,
    /// Where.
    pub material_point: MaterialPoint,
    /// Whether the strand's linear model has it; those that it has not come last.
    pub modelled: bool,
}

/// What a strand's pack is to do in the first half of an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstHalf {
    /// Nothing: the strand rests, or its island is done.
    None,
    /// It was done ahead. If another strand of the pack has it to do, it is done again: a pack is eliminated as a whole.
    Done,
    /// It is to be done.
    ToDo,
}

/// A held strand.
#[derive(Debug, Default)]
pub struct ConstrainedStrand {
    /// Its index in the solver.
    pub index: u32,
    /// Its step.
    pub step: ConstrainedStep,
    /// The pack that it goes in, and its lane there.
    pub pack: u32,
    /// See `pack`.
    pub lane: u32,
    /// What it is to contact.
    pub contact: StrandContact,
    /// Its mass, kg.
    pub mass: f64,
    /// The force that bends its shortest element by about a radian, N.
    pub bending: f64,
    /// Its island.
    pub island: u32,
    /// From root to tip, those first that its linear model has; their places in this list are the points of the island's contact space.
    pub attachments: Vec<Attachment>,
    /// How many its linear model has.
    modelled: usize,
    /// Whether its step is implicit Euler's, whatever the setting says, and whether it is to begin once more for that: then it stays where it is
    /// until it does.
    pub first_order: bool,
    /// See `first_order`.
    pub begins_again: bool,
    /// Whether the first half of the first iteration is done already.
    pub looked_ahead: bool,
    /// How its island's iteration has ended, if nothing new holds it since.
    pub ended: Option<Ending>,
    /// Whether it is at its end under the joints' forces: it stays where it is, while others go on, until these have changed.
    pub resting: bool,
    /// Whether some of it was found, after the step's first search, in something that it was in when the step began.
    pub left_deep: bool,
    /// Whether the last search that there was to be found some of it in something, and no joint tells of that.
    pub has_undetected: bool,
    /// Whether it was found in a body that it was not in when the step began, or beyond it, at the step's end.
    pub behind: bool,
    /// Whether it goes along with its root after all, because of that.
    pub carried: bool,
    /// Whether an iteration has been done for it: it need not stay as the step found it.
    pub advanced: bool,
    /// How often it was woken since its island was tied.
    pub woken: u32,
    /// How far an element may be from where the iteration ends, rad.
    pub residual: f64,
    /// Whether it takes part in contact at all.
    pub contacts: bool,
    /// From where to where bodies go for it in the step, one a body; none: as they go.
    pub body_motions: Vec<[Frame; 2]>,
    /// Where they come to so, if one of them is still to come after it when the step ends; else none.
    pub final_poses: Vec<Frame>,
    /// Whether it meets bodies only: where bodies are still to come after it other strands would hold it back.
    pub alone: bool,
    /// How many joints hold it, as far as they were counted last.
    pub constraint_count: usize,
    /// Touches with bodies that were found last.
    pub found: Vec<ContactPoint>,
    /// The gap between its root and the nearest body, m; infinite where none is near, or the root touches nothing. The host puts the root
    /// where it is, and no force moves it: it is told, and is no touch.
    pub root_gap: f64,
    /// Where the attached points are, in the attachments' order, each with the station that it was found for.
    places: Vec<(MaterialPoint, EndState)>,
    material_points: Vec<MaterialPoint>,
    forces: Vec<Vec3<f64>>,
    bilateral: Vec<Option<WorldConstraint>>,
    bounds: PathBounds,
    /// Only ever taken by who may change the strand; the lock is there for those who look at it meanwhile.
    scratch: Mutex<strand_body::BodySearchScratch>,
}

impl ConstrainedStrand {
    /// Its curve as the step found it and at the present iterate.
    pub fn path(&self) -> StrandPath<'_> {
        path_of(self.index, &self.step)
    }

    /// Its step has begun.
    pub fn begun(&mut self) {
        self.places.clear();
    }

    /// Whether a body is still to come after it when the step ends.
    pub fn lags(&self) -> bool {
        !self.final_poses.is_empty()
    }

    /// Has bodies go to where they are after all, and meets the others: how deep it is in them is to be seen.
    pub fn look_around(&mut self, bodies: &[BodyAt]) {
        self.alone = false;
        for (motion, body) in self.body_motions.iter_mut().zip(bodies) {
            motion[1] = body.end;
        }
    }

    /// A body as it goes for this strand.
    pub fn met<'a>(&self, bodies: &[BodyAt<'a>], index: u32) -> BodyAt<'a> {
        let body = bodies[index as usize];
        self.body_motions.get(index as usize).map_or(body, |motion| body.with_motion(*motion))
    }

    /// Finds the touches with bodies that are nearer than `within` (m) at the present iterate.
    pub fn find_bodies(&mut self, bodies: &[BodyAt], within: f64) {
        if !self.contacts {
            return;
        }
        let path = path_of(self.index, &self.step);
        let scratch = self.scratch.get_mut().unwrap_or_else(PoisonError::into_inner);
        self.bounds.update(&path);
        let StrandContact { exempt_length: exempt, radius, groups, mask, .. } = self.contact;
        let mut other;
        for (index, mut body) in bodies.iter().enumerate().filter(|(_, body)| body.meets(groups, mask)) {
            if let Some(motion) = self.body_motions.get(index) {
                other = body.with_motion(*motion);
                body = &other;
            }
            strand_body::contacts(&path, &self.bounds, Span { exempt }, radius, body, within, scratch, &mut self.found);
        }
        self.root_gap = f64::INFINITY;
        let root_gap = &mut self.root_gap;
        self.found.retain(|contact| {
            let at_root = contact.point.element == 0 && contact.point.s == 0.0;
            *root_gap = if at_root { root_gap.min(contact.gap) } else { *root_gap };
            !at_root
        });
        // Where two elements meet both may tell of one place.
        let along = |contact: &ContactPoint| path.now.along(contact.point.element as usize, contact.point.s);
        self.found.dedup_by(|next, last| {
            next.partner == last.partner
                && (along(next) - along(last)).abs() <= ONE_PLACE
                && next.normal.dot(&last.normal) > ONE_SIDE
        });
    }

    /// Whether some point of it has gone further than `least` (m) since it was last searched for touches.
    pub fn has_gone(&self, least: f64) -> bool {
        self.step.gone > least
    }

    /// Arclength of a station from the root, m.
    pub fn along(&self, material_point: &MaterialPoint) -> f64 {
        self.path().start.along(material_point.element, material_point.s)
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.step.start().1.iter().map(|element| element.length).sum()
    }

    /// What takes it its own length in a step, N.
    pub fn usual_force(&self, step: f64) -> f64 {
        self.mass * self.length() / (step * step)
    }

    /// Whether it ends higher than its step began, which the forces at its end do not account for: touches that were found on the way threw it there.
    pub fn has_risen(&self, step: f64) -> bool {
        let speed = self.length() / step;
        self.step.rise() > RISEN * self.mass * speed * speed
    }

    /// Where a station is.
    pub fn end_state(&self, material_point: &MaterialPoint) -> EndState {
        self.end_now(material_point, ConstrainedStep::place(self.step.start(), material_point))
    }

    /// The same of one whose place at the step's start is known.
    fn end_now(&self, material_point: &MaterialPoint, start: Vector3<f64>) -> EndState {
        EndState {
            start,
            now: ConstrainedStep::place(self.step.now(), material_point),
            tangent: self.path().now.tangent(material_point.element, material_point.s),
        }
    }

    /// Where an attached point is.
    pub fn place(&self, point: u32) -> EndState {
        self.places[point as usize].1
    }

    /// It is elsewhere: so are its attached points.
    pub(super) fn moved(&mut self) {
        self.find_places(true);
    }

    /// How far an attached point is moved by a force at it, m/N, in the linear model of the last iteration; zero of one that is not in it.
    pub(super) fn response(&self, point: u32) -> Matrix3<f64> {
        let (point, points) = (point as usize, self.step.delassus.material_points);
        if point >= points {
            return Matrix3::zeros();
        }
        read_block(&self.step.delassus.columns, 3 * points, 3 * point, 3 * point)
    }

    /// Finds where the attached points are that have another station than before; once the strand has `moved`, all of them.
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

    /// Takes the stations that the joints have now, and brings the attachments into order: those of the linear model, which is a new one
    /// unless the strand rests, and the others, both from root to tip, those of a place by joint.
    fn sort(&mut self, island: &Island) {
        for attachment in &mut self.attachments {
            let constraint = &island.constraints[attachment.constraint as usize];
            let end = if attachment.second { constraint.second.unwrap_or(constraint.first) } else { constraint.first };
            attachment.material_point = end.material_point;
            attachment.modelled = if self.resting { attachment.modelled } else { !constraint.dormant };
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

    /// Before an iteration: whether this strand need not take part in it.
    fn choose_rest(&mut self, island: &Island) {
        let constraint = |end: &Attachment| &island.constraints[end.constraint as usize];
        // A touch that has a part again must be in its model.
        let lacks = |end: &Attachment| !end.modelled && !constraint(end).dormant;
        self.resting = if !island.may_rest {
            false
        } else if self.resting {
            let wakes = self.attachments.iter().any(|end| lacks(end) || constraint(end).standing.wakes[usize::from(end.second)]);
            self.woken += u32::from(wakes);
            !wakes
        } else {
            self.woken < MAX_WAKES
                && island.iterations > 0
                && self.residual <= island.rest
                && self.attachments.iter().all(|end| {
                    let standing = &constraint(end).standing;
                    !lacks(end) && standing.holds && standing.law_residual <= island.rest_residual
                })
        };
    }

    /// How far an attached point of a resting strand goes from where it is when the joints that `is_included` is true of have the forces
    /// `of_constraint` (on the joints' first ends), by the linear model of its last iteration.
    pub fn given_way(&self, point: u32, is_included: &[bool], of_constraint: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        // Symmetric: three columns are three rows.
        let size = 3 * self.modelled;
        let rows = &self.step.delassus.columns[3 * point as usize * size..][..3 * size];
        let mut sum = Vector3::zeros();
        for (k, (end, taken)) in self.attachments.iter().zip(&self.forces).enumerate() {
            let constraint = end.constraint as usize;
            if is_included[constraint] {
                let force = of_constraint(constraint);
                let change = if end.second { -force } else { force } - Vector3::from(*taken);
                for (axis, row) in rows.chunks_exact(size).enumerate() {
                    sum[axis] += row[3 * k] * change.x + row[3 * k + 1] * change.y + row[3 * k + 2] * change.z;
                }
            }
        }
        sum
    }

    fn pull(&mut self, island: &Island) {
        self.forces.clear();
        self.forces.extend(self.attachments[..self.modelled].iter().map(|attachment| {
            let force = island.constraints[attachment.constraint as usize].force;
            Vec3::from(if attachment.second { -force } else { force })
        }));
    }

    /// What half an iteration takes, nanoseconds or so.
    pub fn half_work(&self) -> u64 {
        if self.resting { 0 } else { self.half_work_with(self.modelled) }
    }

    /// How many elements it has.
    pub fn elements(&self) -> usize {
        self.step.now().1.len()
    }

    /// The same with so many points that are touched.
    pub fn half_work_with(&self, points: usize) -> u64 {
        let (elements, points) = (self.elements() as u64, points as u64);
        elements * (WORK_AN_ELEMENT + WORK_A_COLUMN * points) + WORK_A_COUPLING * points * points
    }

    /// Before the first half of a Newton iteration; the joints' forces are the last iteration's.
    pub fn hold(&mut self, island: &Island) -> FirstHalf {
        if std::mem::take(&mut self.looked_ahead) {
            return FirstHalf::Done;
        }
        self.choose_rest(island);
        self.sort(island);
        self.find_places(false);
        if self.resting {
            return FirstHalf::None;
        }
        self.material_points.clear();
        self.material_points.extend(self.attachments[..self.modelled].iter().map(|attachment| attachment.material_point));
        self.pull(island);
        self.bilateral.clear();
        if island.constrained_to_world {
            self.bilateral.extend(self.attachments[..self.modelled].iter().map(|end| {
                let constraint = &island.constraints[end.constraint as usize];
                constraint.world_constraint(&ConstrainedStep::place(self.step.now(), &end.material_point))
            }));
        }
        self.step.hold(&self.material_points, &self.forces, &self.bilateral);
        FirstHalf::ToDo
    }

    /// Before the second half, with the joints' new forces. False where its pack need not do it: a strand that begins again does not go on.
    pub fn advances(&mut self, island: &Island) -> bool {
        if self.begins_again {
            self.residual = f64::INFINITY;
            return false;
        }
        if self.resting {
            return false;
        }
        self.pull(island);
        self.step.pull(&self.forces);
        true
    }

    /// Its pack has done the second half.
    pub fn advanced(&mut self) {
        self.advanced = true;
        self.residual = self.step.residual;
        self.find_places(true);
    }

    /// How far an attached point would go in this iteration without forces.
    pub fn unconstrained(&self, point: u32) -> Vector3<f64> {
        self.step.unconstrained[point as usize].into()
    }
}

fn path_of(index: u32, step: &ConstrainedStep) -> StrandPath<'_> {
    let curve = |(origin, elements)| StrandCurve { origin, elements };
    StrandPath { index, start: curve(step.start()), now: curve(step.now()) }
}
