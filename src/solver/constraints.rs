//! Bilateral constraints: pin, clamp, tie and ring strands, and report the forces.
//!
//! Files:
//!
//! - `ties.rs`: Which strands are tied together: their wisps give way to each other there.

pub(super) mod ties;

use nalgebra::Vector3;

use super::Solver;
use super::id::{self, ConstraintId, StrandId};
use crate::chain::load::MaterialPoint;
use crate::contact::constraint::law::bilateral::ConstrainedAxes;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, StepConstraint};
use crate::contact::contact_point::StrandCurve;
use crate::contact::narrow_phase::nearest::nearest;
use crate::contact::options::Friction;
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;
use crate::math::frame::pose_motion::PoseMotion;
use crate::memory;
use crate::rod::strand::StrandModel;

/// The type of a constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// The material point stays at the target's origin.
    Point,
    /// The point, and the strand's tangent stays along the target's first axis; the strand may turn about it.
    Direction,
    /// The point, and the material frame stays that of the target.
    Frame,
    /// The strand passes through a ring at the target's origin, with Coulomb friction, and is free once its tip has passed
    /// through it. The point's arclength changes as it slides.
    Ring {
        /// Friction of the ring on the strand.
        friction: Friction,
    },
    /// The point stays at a material point of another strand, or of the same one (a closed loop).
    Tie {
        /// The other strand.
        other: StrandId,
        /// Arclength on it, m; 0 to its length.
        arclength: f64,
    },
}

/// The definition of a constraint.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{ConstraintDef, Frame, Hold, Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let strand = solver.add_strands(&[StrandDef::straight(0.2, 8)])?[0];
/// // The tip is pinned, and drawn towards the root within half a second.
/// let at = |x: f64| Frame { origin: Vector3::new(x, 0.0, 0.0), ..Frame::default() };
/// let pin = ConstraintDef { strand, arclength: 0.2, hold: Hold::Point, target: at(0.2), compliance: 0.0 };
/// let pins = solver.add_constraints(&[pin])?;
/// solver.set_constraint_targets(&pins, &[at(0.15)], 0.5)?;
/// solver.step(0.5, 30)?;
/// let state = solver.constraint_state(pins[0])?;
/// assert!(state.error < 1e-5 && state.force.norm() > 0.0); // m, N
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstraintDef {
    /// The constrained strand.
    pub strand: StrandId,
    /// The constrained point's arclength from the root, m; 0 to its length. A ring starts at the local minimum of distance to the
    /// target that is closest to it.
    pub arclength: f64,
    /// The type.
    pub hold: Hold,
    /// The target, world; a tie ignores it.
    pub target: Frame,
    /// Displacement of the point per unit of force, m/N; zero or above; 0 for a rigid constraint. Not for rings.
    pub compliance: f64,
}

/// The state of a constraint in the last substep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ConstraintStatus {
    /// It is satisfied.
    #[default]
    Holds,
    /// Other constraints already determine it, and agree with it; its force is shared arbitrarily.
    Dependent,
    /// It is not satisfied: other constraints, or the strand's length, contradict it.
    Violated,
    /// A ring that the strand has slipped out of.
    Released,
}

/// The result of a constraint in the last substep.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ConstraintState {
    /// Force on the (first) strand, N, world.
    pub force: Vector3<f64>,
    /// Torque on the strand about the constrained point, N·m, world; zero except for directions and frames.
    pub torque: Vector3<f64>,
    /// Distance of the constrained point from its target, m.
    pub error: f64,
    /// The constrained arclength on the strand, m: a ring's changes.
    pub arclength: f64,
    /// Its status.
    pub status: ConstraintStatus,
}

/// Length of the levers that hold a direction or a frame, in units of the element's length: makes them as stiff as the point's
/// own constraint.
const LEVER: f64 = 1.0;
/// A constraint within this distance of its target counts as satisfied, m.
const HOLDS: f64 = 1e-8;

/// A constraint and the solver's data about it.
#[derive(Debug, Clone)]
pub(super) struct Constraint {
    pub id: ConstraintId,
    pub def: ConstraintDef,
    /// The target's motion; `def.target` is the original one.
    pub motion: PoseMotion,
    pub state: ConstraintState,
    /// Forces of its parts in the last substep, the warm start of the next.
    pub forces: [Vector3<f64>; 3],
    /// The number of parts in the report so far, and the constrained place of the strand.
    pub parts: usize,
    pub held_at: Vector3<f64>,
    /// The host's own number.
    pub user_data: u64,
}

impl Constraint {
    /// The other strand of a tie.
    pub fn other(&self) -> Option<StrandId> {
        match self.def.hold {
            Hold::Tie { other, .. } => Some(other),
            _ => None,
        }
    }

    /// The constrained arclength on a strand at the other end of a tie, m.
    pub fn tied(&self, strand: StrandId) -> Option<f64> {
        match self.def.hold {
            Hold::Tie { other, arclength } if other == strand => Some(arclength),
            _ => None,
        }
    }

    /// Clears the report of the last substep.
    pub fn begin_report(&mut self) {
        if self.state.status != ConstraintStatus::Released {
            let ConstraintState { arclength, .. } = self.state;
            self.state = ConstraintState { arclength, ..ConstraintState::default() };
        }
        self.parts = 0;
    }

    /// Marks it as determined by others.
    pub fn depends(&mut self) {
        if self.state.status == ConstraintStatus::Holds {
            self.state.status = ConstraintStatus::Dependent;
        }
    }

    /// Reports one of its constraint rows, in order; `curve` is the first strand's at the end of the substep.
    pub fn add_report(&mut self, constraint: &StepConstraint, curve: &StrandCurve) {
        let MaterialPoint { element, s, .. } = constraint.first.material_point;
        self.state.force += constraint.force;
        if self.parts == 0 {
            self.held_at = curve.position(element, s);
        } else if let ConstraintKind::Pin { target, .. } = constraint.kind {
            self.state.torque += (target - self.held_at).cross(&constraint.force);
        }
        if let ConstraintKind::Ring { target, .. } = constraint.kind {
            // The strand has slid on in the last iteration.
            let (element, s) = nearest(curve, element, s, target);
            self.state.arclength = curve.elements[..element].iter().map(|element| element.length).sum::<f64>() + s;
            let tip = element + 1 == curve.elements.len() && s >= curve.elements[element].length;
            if tip && (target - self.held_at).dot(&curve.tangent(element, s)) >= 0.0 {
                self.state = ConstraintState {
                    arclength: self.state.arclength,
                    status: ConstraintStatus::Released,
                    ..ConstraintState::default()
                };
                self.forces = [Vector3::zeros(); 3];
                return;
            }
        }
        self.state.error = self.state.error.max(constraint.gap);
        if constraint.gap > HOLDS && self.def.compliance == 0.0 {
            self.state.status = ConstraintStatus::Violated;
        }
        if let Some(force) = self.forces.get_mut(self.parts) {
            *force = constraint.force;
        }
        self.parts += 1;
    }

    /// Its constraint rows in a substep of `h` seconds: `first` and `second` are the constrained strands' indices and constants.
    pub fn step_constraints(
        &self,
        index: u32,
        h: f64,
        first: (u32, &StrandModel),
        second: Option<(u32, &StrandModel)>,
        mut emit: impl FnMut(StepConstraint),
    ) {
        let target = self.motion.after(h);
        let material_point = material_point_at(first.1, self.state.arclength);
        let mut part = 0;
        let mut constraint = |material_point: MaterialPoint, second: Option<ConstraintEnd>, kind: ConstraintKind| {
            emit(StepConstraint::new(ConstraintEnd { strand: first.0, material_point }, second, kind, self.forces[part]));
            part += 1;
        };
        let pin = |target: Vector3<f64>, axes: ConstrainedAxes| ConstraintKind::Pin {
            bilateral: index,
            target,
            axes,
            compliance: self.def.compliance,
        };
        match self.def.hold {
            Hold::Point | Hold::Direction | Hold::Frame => {
                constraint(material_point, None, pin(target.origin, ConstrainedAxes::All));
                let lever = LEVER * first.1.lengths[material_point.element];
                let axis = |k: usize| target.rotation * Vector3::ith(k, 1.0);
                if self.def.hold != Hold::Point {
                    let held = MaterialPoint { lever: [lever, 0.0, 0.0], ..material_point };
                    constraint(held, None, pin(target.origin + axis(0) * lever, ConstrainedAxes::Across(axis(0))));
                }
                if self.def.hold == Hold::Frame {
                    let held = MaterialPoint { lever: [0.0, lever, 0.0], ..material_point };
                    constraint(held, None, pin(target.origin + axis(1) * lever, ConstrainedAxes::Along(axis(2))));
                }
            }
            Hold::Ring { friction } => {
                let carried = target.origin - self.motion.pose.origin;
                constraint(
                    material_point,
                    None,
                    ConstraintKind::Ring { bilateral: index, target: target.origin, carried, friction },
                );
            }
            Hold::Tie { arclength, .. } => {
                if let Some((strand, model)) = second {
                    let end = ConstraintEnd { strand, material_point: material_point_at(model, arclength) };
                    constraint(
                        material_point,
                        Some(end),
                        ConstraintKind::Tie { bilateral: index, compliance: self.def.compliance },
                    );
                }
            }
        }
    }
}

/// The material point at an arclength.
pub(super) fn material_point_at(model: &StrandModel, arclength: f64) -> MaterialPoint {
    let (element, s) = model.place(arclength);
    MaterialPoint::on(element, s)
}

impl Solver {
    /// Adds constraints, all or none, and returns their identifiers in the order of the definitions. They hold from the end of
    /// the next substep on: a point far from its target is drawn there within that substep.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `constraints[i].field`; [`Error::InvalidId`] for a nonexistent strand.
    pub fn add_constraints(&mut self, constraints: &[ConstraintDef]) -> Result<Vec<ConstraintId>> {
        for (k, def) in constraints.iter().enumerate() {
            self.check_constraint(&format!("constraints[{k}]"), def)?;
        }
        if self.constraints.len() + constraints.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: constraints.len().saturating_mul(size_of::<Constraint>()) });
        }
        self.constraint_slots.reserve(constraints.len())?;
        memory::grow(&mut self.constraints, constraints.len())?;
        let mut ids = memory::list(constraints.len())?;
        for def in constraints {
            let Some(id) = self.constraint_slots.insert(self.constraints.len()) else {
                self.remove_constraints(&ids)?;
                return Err(Error::OutOfMemory { bytes: size_of::<Constraint>() });
            };
            let state = ConstraintState { arclength: def.arclength, ..ConstraintState::default() };
            self.constraints.push(Constraint {
                id,
                def: *def,
                motion: PoseMotion::at(def.target),
                state,
                forces: [Vector3::zeros(); 3],
                parts: 0,
                held_at: Vector3::zeros(),
                user_data: 0,
            });
            ids.push(id);
        }
        Ok(ids)
    }

    fn check_constraint(&self, argument: &str, def: &ConstraintDef) -> Result<()> {
        let on = |name: &str, id: StrandId, arclength: f64| {
            let strand = self.strand(&format!("{argument}.{name}"), id)?;
            let length = strand.model.length();
            if (0.0..=length * (1.0 + 1e-9)).contains(&arclength) {
                return Ok(());
            }
            let what = if name == "strand" { "arclength" } else { "other_arclength" };
            Err(Error::invalid(format!("{argument}.{what}"), arclength, format!("0 to the strand's length, {length} m")))
        };
        on("strand", def.strand, def.arclength)?;
        check_not_negative(|| format!("{argument}.compliance"), def.compliance)?;
        for axis in 0..3 {
            check_finite(|| format!("{argument}.target.origin[{axis}]"), def.target.origin[axis])?;
        }
        match def.hold {
            Hold::Tie { other, arclength } => {
                on("other", other, arclength)?;
                if other == def.strand && arclength == def.arclength {
                    return Err(Error::invalid(format!("{argument}.other_arclength"), arclength, "another point than the first"));
                }
            }
            Hold::Ring { friction } => {
                check_not_negative(|| format!("{argument}.friction.along"), friction.along)?;
                check_not_negative(|| format!("{argument}.friction.against"), friction.against)?;
                if def.compliance != 0.0 {
                    return Err(Error::invalid(format!("{argument}.compliance"), def.compliance, "0: rings are rigid"));
                }
            }
            Hold::Point | Hold::Direction | Hold::Frame => {}
        }
        Ok(())
    }

    fn constraint_index(&self, argument: impl FnOnce() -> String, id: ConstraintId) -> Result<usize> {
        self.constraint_slots.index(id).ok_or_else(|| Error::InvalidId { argument: argument(), bits: id.bits() })
    }

    /// Removes constraints, all or none.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`, also for an identifier given twice.
    pub fn remove_constraints(&mut self, ids: &[ConstraintId]) -> Result<()> {
        let mut gone = vec![false; self.constraints.len()];
        for (k, id) in ids.iter().enumerate() {
            let index = self.constraint_index(|| format!("ids[{k}]"), *id)?;
            if std::mem::replace(&mut gone[index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", id.bits()), "each constraint once"));
            }
        }
        self.drop_constraints(&gone);
        Ok(())
    }

    /// Removes the marked ones.
    pub(super) fn drop_constraints(&mut self, gone: &[bool]) {
        let mut index = 0;
        let slots = &mut self.constraint_slots;
        self.constraints.retain(|constraint| {
            index += 1;
            if gone[index - 1] {
                slots.remove(constraint.id);
            }
            !gone[index - 1]
        });
        for (index, constraint) in self.constraints.iter().enumerate() {
            self.constraint_slots.moved(constraint.id, index);
        }
    }

    /// Sends the targets of constraints to `frames` in `over_seconds` (0: within the next substep), as
    /// [`Solver::set_root_frames`] does roots. Ties have no target: theirs are ignored.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ or a time that is not finite and 0 or more; [`Error::InvalidId`].
    pub fn set_constraint_targets(&mut self, ids: &[ConstraintId], frames: &[Frame], over_seconds: f64) -> Result<()> {
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        if frames.len() != ids.len() {
            return Err(Error::invalid("frames (count)", frames.len(), format!("{} frames, one per constraint", ids.len())));
        }
        let mut indices = Vec::with_capacity(ids.len());
        for (k, id) in ids.iter().enumerate() {
            indices.push(self.constraint_index(|| format!("ids[{k}]"), *id)?);
        }
        for (index, frame) in indices.into_iter().zip(frames) {
            self.constraints[index].motion.send(*frame, over_seconds);
        }
        Ok(())
    }

    /// The result of a constraint in the last substep.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn constraint_state(&self, id: ConstraintId) -> Result<ConstraintState> {
        Ok(self.constraints[self.constraint_index(|| "id".into(), id)?].state)
    }

    /// The host's own number for a constraint; 0 until it is set.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn constraint_user_data(&self, id: ConstraintId) -> Result<u64> {
        Ok(self.constraints[self.constraint_index(|| "id".into(), id)?].user_data)
    }

    /// Sets the host's own number for a constraint. No step depends on it.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn set_constraint_user_data(&mut self, id: ConstraintId, user_data: u64) -> Result<()> {
        let index = self.constraint_index(|| "id".into(), id)?;
        self.constraints[index].user_data = user_data;
        Ok(())
    }

    /// A constraint's definition, with its current target.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn constraint(&self, id: ConstraintId) -> Result<ConstraintDef> {
        let Constraint { def, motion, .. } = &self.constraints[self.constraint_index(|| "id".into(), id)?];
        Ok(ConstraintDef { target: motion.pose, ..*def })
    }

    /// All constraints' identifiers, in the order in which they were added.
    pub fn constraint_ids(&self) -> Vec<ConstraintId> {
        self.constraints.iter().map(|constraint| constraint.id).collect()
    }
}
