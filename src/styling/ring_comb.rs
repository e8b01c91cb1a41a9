//! A ring comb: a strand sticks to the first tooth that it meets and slides along it as through a ring with friction, until the
//! tooth has combed its whole length or lets it go (Bonanni and Kmoch 2008, section 3.3).

use nalgebra::Vector3;

use super::tools::Tool;
use crate::contact::options::{Friction, StrandContact};
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::math::frame::Frame;
use crate::solver::Solver;
use crate::solver::constraints::{ConstraintDef, ConstraintStatus, Hold};
use crate::solver::id::{ConstraintId, StrandId};
use crate::solver::report::Wrench;

/// Options of a ring comb.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingCombOptions {
    /// A factor on the strands' friction against bodies ([`StrandContact::friction`]; the default for a strand without contact),
    /// zero or above.
    pub friction: f64,
    /// A tooth lets go of a strand when it pulls harder than this, N; above zero.
    pub max_force: f64,
    /// No strand is caught closer to its root than this, m; zero or above.
    pub exempt_length: f64,
}

impl Default for RingCombOptions {
    fn default() -> Self {
        Self { friction: 1.0, max_force: 0.05, exempt_length: 2e-3 }
    }
}

impl RingCombOptions {
    fn check(&self, argument: &str) -> Result<()> {
        check_not_negative(|| format!("{argument}.friction"), self.friction)?;
        check_positive(|| format!("{argument}.max_force"), self.max_force)?;
        check_not_negative(|| format!("{argument}.exempt_length"), self.exempt_length)
    }
}

/// The result of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingCombReport {
    /// Strands on teeth.
    pub held: u32,
    /// Caught in this step.
    pub caught: u32,
    /// Combed to the tip in this step.
    pub combed: u32,
    /// Let go in this step, because a tooth pulled too hard.
    pub let_go: u32,
    /// The action of strands on the comb: force, N, and torque about its frame's origin, N·m, world.
    pub wrench: Wrench,
}

/// A strand on a tooth.
#[derive(Debug, Clone, Copy)]
struct Ring {
    strand: StrandId,
    constraint: ConstraintId,
    /// The place on the tooth, in the comb's axes.
    place: Vector3<f64>,
}

/// A comb without bodies: rings hold the strands that its teeth run into. A strand is on at most one of its teeth; several combs
/// may hold it.
#[derive(Debug)]
pub struct RingComb {
    options: RingCombOptions,
    teeth: Vec<[Vector3<f64>; 2]>,
    radius: f64,
    pose: Frame,
    rings: Vec<Ring>,
    /// Let go and still among the teeth: not caught again.
    loose: Vec<StrandId>,
    caught: u32,
}

/// A strand that was let go may be caught again when the teeth are this many radii away.
const AWAY: f64 = 4.0;

impl RingComb {
    /// A comb or a brush at `pose`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming a field of `tool` or `options`; [`Error::Unsupported`] for a tool without teeth.
    pub fn new(tool: &Tool, pose: &Frame, options: &RingCombOptions) -> Result<Self> {
        tool.check("tool")?;
        options.check("options")?;
        let (teeth, radius) = tool.axes();
        if teeth.is_empty() {
            let hint = "plates have no teeth; take a comb, a brush, a finger or a barrel".into();
            return Err(Error::Unsupported { argument: "tool".into(), value: "plates".into(), hint });
        }
        Ok(Self { options: *options, teeth, radius, pose: *pose, rings: Vec::new(), loose: Vec::new(), caught: 0 })
    }

    /// Its pose.
    pub fn pose(&self) -> Frame {
        self.pose
    }

    /// Puts it elsewhere, without catching what lies between: strands on its teeth go there in the next step.
    pub fn place_at(&mut self, pose: &Frame) {
        self.pose = *pose;
    }

    /// The strands on its teeth, each with its constraint.
    pub fn held(&self) -> impl Iterator<Item = (StrandId, ConstraintId)> {
        self.rings.iter().map(|ring| (ring.strand, ring.constraint))
    }

    /// Call it before a step of `dt` seconds: the comb moves to `to` within it. Catches those of `ids` whose current shape a
    /// tooth runs into on the way; an id that is there twice counts once.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] (`dt`, `to`). Nothing has then changed.
    pub fn before_step(&mut self, solver: &mut Solver, ids: &[StrandId], to: &Frame, dt: f64) -> Result<()> {
        check_positive(|| "dt".into(), dt)?;
        for axis in 0..3 {
            crate::error::check_finite(|| format!("to.origin[{axis}]"), to.origin[axis])?;
        }
        self.forget_removed(solver);
        let place = |frame: &Frame, point: &Vector3<f64>| frame.origin + frame.rotation * point;
        let quads: Vec<[Vector3<f64>; 4]> =
            self.teeth.iter().map(|[a, b]| [place(&self.pose, a), place(&self.pose, b), place(to, b), place(to, a)]).collect();
        let free: Vec<StrandId> = ids.iter().copied().filter(|id| self.rings.iter().all(|ring| ring.strand != *id)).collect();
        let segments: Vec<[Vector3<f64>; 2]> = quads.iter().map(|quad| [quad[0], quad[1]]).collect();
        let distances = solver.distances_to_segments(&self.loose, &segments);
        let (radius, mut distance) = (self.radius, distances.into_iter());
        self.loose.retain(|_| distance.next().is_some_and(|distance| distance < AWAY * radius));
        let hits = solver.first_crossings(&free, &quads, self.options.exempt_length)?;
        let mut made: Vec<(StrandId, Vector3<f64>, ConstraintDef)> = Vec::new();
        for (id, hit) in free.into_iter().zip(hits) {
            let is_caught = made.iter().any(|(caught, ..)| *caught == id);
            let Some(hit) = hit.filter(|_| !is_caught && !self.loose.contains(&id)) else { continue };
            // The strand keeps its place along the tooth; the time at which it was met does not matter.
            let [a, b] = self.teeth[hit.quad];
            let [start, end] = [[quads[hit.quad][0], quads[hit.quad][1]], [quads[hit.quad][3], quads[hit.quad][2]]];
            let along = |[a, b]: [Vector3<f64>; 2]| ((hit.position - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            let near = |ends: [Vector3<f64>; 2]| (ends[0] + (ends[1] - ends[0]) * along(ends) - hit.position).norm();
            let fraction = if near(start) <= near(end) { along(start) } else { along(end) };
            let contact = solver.contact(id)?.copied().unwrap_or_default();
            let scaled = |friction: Friction| Friction {
                along: friction.along * self.options.friction,
                against: friction.against * self.options.friction,
            };
            let StrandContact { friction, .. } = contact;
            let target = Frame { origin: hit.position, ..Frame::default() };
            let hold = Hold::Ring { friction: scaled(friction) };
            made.push((
                id,
                a + (b - a) * fraction,
                ConstraintDef { strand: id, arclength: hit.arclength, hold, target, compliance: 0.0 },
            ));
        }
        let defs: Vec<ConstraintDef> = made.iter().map(|(_, _, def)| *def).collect();
        let constraints = solver.add_constraints(&defs)?;
        self.caught = constraints.len() as u32;
        let new = made.into_iter().zip(constraints);
        self.rings.extend(new.map(|((strand, place, _), constraint)| Ring { strand, constraint, place }));
        let targets: Vec<Frame> =
            self.rings.iter().map(|ring| Frame { origin: place(to, &ring.place), ..Frame::default() }).collect();
        let constraints: Vec<ConstraintId> = self.rings.iter().map(|ring| ring.constraint).collect();
        solver.set_constraint_targets(&constraints, &targets, dt)?;
        self.pose = *to;
        Ok(())
    }

    /// Call it after the step: lets go of strands that are combed to the tip, or that a tooth pulls too hard.
    ///
    /// # Errors
    /// None at present; removed strands and constraints are skipped.
    pub fn after_step(&mut self, solver: &mut Solver) -> Result<RingCombReport> {
        self.forget_removed(solver);
        let mut report = RingCombReport { caught: std::mem::take(&mut self.caught), ..RingCombReport::default() };
        let (mut kept, mut gone) = (Vec::with_capacity(self.rings.len()), Vec::new());
        for ring in &self.rings {
            let state = solver.constraint_state(ring.constraint)?;
            report.wrench.force -= state.force;
            report.wrench.torque -= (self.pose.rotation * ring.place).cross(&state.force);
            if state.status == ConstraintStatus::Released {
                report.combed += 1;
                gone.push(ring.constraint);
            } else if state.force.norm() > self.options.max_force {
                report.let_go += 1;
                gone.push(ring.constraint);
                self.loose.push(ring.strand);
            } else {
                kept.push(*ring);
            }
        }
        solver.remove_constraints(&gone)?;
        report.held = kept.len() as u32;
        self.rings = kept;
        Ok(report)
    }

    /// Lets go of all strands.
    ///
    /// # Errors
    /// None at present.
    pub fn release(&mut self, solver: &mut Solver) -> Result<()> {
        self.forget_removed(solver);
        let constraints: Vec<ConstraintId> = self.rings.drain(..).map(|ring| ring.constraint).collect();
        solver.remove_constraints(&constraints)
    }

    /// Drops strands and constraints that others have removed.
    fn forget_removed(&mut self, solver: &Solver) {
        self.rings.retain(|ring| solver.constraint_state(ring.constraint).is_ok());
        self.loose.retain(|id| solver.contact(*id).is_ok());
    }
}
