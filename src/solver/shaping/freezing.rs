//! Frozen strands: a fixed style. They keep their shape, move with their roots at almost no cost, and wake where a body
//! approaches.

use nalgebra::Vector3;

use super::crossing::Curve;
use crate::contact::body_at::BodyAt;
use crate::contact::shape::Bounds;
#[cfg(doc)]
use crate::error::Error;
use crate::error::Result;
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::rotation_vector;
use crate::rod::kinematics::Kinematics;
use crate::solver::Solver;
use crate::solver::constraints::ConstraintStatus;
use crate::solver::id::{BodyId, StrandId};
use crate::solver::strands::strand::{self, Strand};
use crate::step::StrandOutcome;
use crate::step::state::History;

/// A strand wakes when a body comes closer than this to its surface, m, checked at points at most this far apart.
const REACH: f64 = 1e-3;
/// A body that was already closer when the strand was frozen wakes it by coming closer by this, m.
const NEARER: f64 = 2e-5;
/// Something that moved relative to the strand's root by at most this, m and rad, has not moved.
const STILL: f64 = 1e-9;
/// The least step along a body's motion through a substep, as a fraction of it.
const LEAST_PART: f64 = 1.0 / 64.0;

/// The data of a frozen strand.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::solver) struct Frozen {
    /// Points of its centreline in the axes of its root, m, and a box around them.
    points: Vec<Vector3<f64>>,
    bounds: Bounds,
    /// Bodies that were examined.
    pub bodies: Vec<Known>,
}

/// An examined body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::solver) struct Known {
    pub body: BodyId,
    /// Its pose then, as seen from the strand's root.
    pub place: Frame,
    /// Distance of its surface when the strand was frozen, m; more than REACH if it was not near.
    pub gap: f64,
}

impl Frozen {
    pub fn new(strand: &Strand, bodies: Vec<Known>) -> Self {
        let inverse = strand.state.root.inverse();
        let points = Curve::of(strand).points().map(|point| inverse.origin + inverse.rotation * point).collect::<Vec<_>>();
        Self { bounds: Bounds::of_points(points.iter().copied()), points, bodies }
    }

    /// The distance between surfaces, if below `within`; the body's end pose is in the root's axes.
    fn gap(&self, body: &BodyAt, radius: f64, within: f64) -> f64 {
        let reach = within + radius + body.thickness;
        if !self.bounds.grown(reach).meets(&body.bounds) {
            return f64::INFINITY;
        }
        let surfaces = self.points.iter().filter_map(|point| body.closest_at_end(*point, reach.max(0.0)));
        surfaces.fold(f64::INFINITY, |least, surface| least.min(surface.distance - body.thickness - radius))
    }
}

/// Whether two poses are equal but for rounding.
fn is_still(one: &Frame, other: &Frame) -> bool {
    (one.origin - other.origin).norm() <= STILL && rotation_vector(&(one.rotation * other.rotation.inverse())).norm() <= STILL
}

impl Strand {
    /// Takes a frozen strand through a substep of `h` seconds with its root.
    pub fn stay(&mut self, gravity: Vector3<f64>, h: f64, rules: &Rules) -> StrandOutcome {
        let outcome = StrandOutcome { converged: true, energies: self.energies, ..StrandOutcome::default() };
        let zero = Vector3::zeros();
        if self.root_move.is_none() && self.state.root_velocity == zero && self.state.root_angular_velocity == zero {
            if let Some(target) = &mut self.target {
                target.begin(h);
                target.advance(h);
            }
            return outcome;
        }
        self.begin_moves(h);
        let [from, to] = self.root_during(h);
        self.state.teleport(to);
        self.set_rigid_velocities(&from, h, rules);
        self.advance_moves(h);
        self.update_energies(gravity, rules, &mut Kinematics::default());
        StrandOutcome { energies: self.energies, ..outcome }
    }

    /// Whether a body comes near a frozen strand in a substep of `h` seconds. Records examined bodies.
    fn is_approached(&mut self, h: f64, bodies: &[BodyAt], ids: &[BodyId]) -> bool {
        let Self { frozen: Some(frozen), contact: Some(contact), state, root_move, model, .. } = self else { return false };
        let start = state.root;
        let end = strand::root_after(root_move, &start, h);
        let reach = Vector3::repeat(model.length() + contact.radius + REACH);
        let around = Bounds::around(start.origin, reach).union(&Bounds::around(end.origin, reach));
        let near = |body: &&BodyAt| body.meets(contact.groups, contact.mask) && body.is_near(&around);
        for body in bodies.iter().filter(near) {
            let id = ids[body.index as usize];
            let places = [start.inverse().compose(&body.start), end.inverse().compose(&body.end)];
            let known = frozen.bodies.iter().position(|known| known.body == id);
            if let Some(known) = known.map(|known| &frozen.bodies[known]).filter(|_| !body.deforms())
                && places.iter().all(|place| is_still(place, &known.place))
            {
                continue;
            }
            let gap = known.map_or(f64::INFINITY, |known| frozen.bodies[known].gap);
            let threshold = REACH.min(gap - NEARER);
            let motion = body.with_motion(places);
            if frozen.bounds.grown(threshold.max(0.0) + contact.radius + body.thickness).meets(&motion.bounds)
                && comes_nearer(frozen, &motion, contact.radius, threshold)
            {
                return true;
            }
            let place = places[1];
            match known {
                Some(known) => frozen.bodies[known].place = place,
                None => frozen.bodies.push(Known { body: id, place, gap: f64::INFINITY }),
            }
        }
        false
    }
}

/// Whether a body comes closer than `threshold` (m) to a frozen strand during its motion, both in the root's axes. Checks again
/// each time it could have covered the remaining distance.
fn comes_nearer(frozen: &Frozen, motion: &BodyAt, radius: f64, threshold: f64) -> bool {
    let farthest = frozen.points.iter().map(|point| (point - motion.end.origin).norm()).fold(0.0, f64::max);
    let turn = rotation_vector(&(motion.end.rotation * motion.start.rotation.inverse()));
    let travel = (motion.end.origin - motion.start.origin).norm() + turn.norm() * farthest;
    let within = threshold + travel;
    let mut part = 0.0;
    loop {
        let at = Frame {
            origin: motion.start.origin.lerp(&motion.end.origin, part),
            rotation: crate::math::rotation::from_rotation_vector(turn * part) * motion.start.rotation,
        };
        let gap = frozen.gap(&motion.with_motion([at, at]), radius, within.max(0.0));
        if gap < threshold {
            return true;
        }
        if part == 1.0 {
            return false;
        }
        let step = if gap.is_finite() { ((gap - threshold) / travel).max(LEAST_PART) } else { 1.0 };
        part = if travel > 0.0 { (part + step).min(1.0) } else { 1.0 };
    }
}

impl Solver {
    /// Freezes the style of strands: their current shapes become rest shapes ([`Solver::take_rest_shapes`]), their velocities
    /// become zero, and from now on they keep their shape and move with their roots. A strand wakes in the substep in which a
    /// body that it collides with ([`Solver::set_contact`]) comes closer than 1 mm or, if it was already closer, closer than it
    /// was. A constraint wakes it too, and so does a new shape from the host. Other strands do not collide with it and do not
    /// wake it. Strands that are already frozen stay as they are.
    ///
    /// Awake and without contact it stays in place, since its shape is at rest under gravity. [`Solver::shape_stability`] says
    /// whether that rest is stable.
    ///
    /// # Errors
    /// As [`Solver::take_rest_shapes`]; [`Error::InvalidArgument`] for an identifier given twice. Nothing has then changed.
    pub fn freeze_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let awake: Vec<(usize, StrandId)> =
            indices.into_iter().zip(ids.iter().copied()).filter(|(index, _)| self.strands[*index].frozen.is_none()).collect();
        self.take_rest_shapes(&awake.iter().map(|(_, id)| *id).collect::<Vec<_>>())?;
        self.rest_bodies();
        let bodies = self.bodies_at_rest();
        let mut made = Vec::with_capacity(awake.len());
        for (index, _) in &awake {
            let strand = &self.strands[*index];
            let mut frozen = Frozen::new(strand, Vec::new());
            if let Some(contact) = strand.contact.as_deref() {
                let inverse = strand.state.root.inverse();
                for body in bodies.iter().filter(|body| body.meets(contact.groups, contact.mask)) {
                    let place = inverse.compose(&body.start);
                    let gap = frozen.gap(&body.with_motion([place, place]), contact.radius, 2.0 * REACH);
                    if gap.is_finite() {
                        frozen.bodies.push(Known { body: self.bodies[body.index as usize].id, place, gap });
                    }
                }
            }
            made.push(frozen);
        }
        let mut kinematics = Kinematics::default();
        for ((index, _), frozen) in awake.into_iter().zip(made) {
            let curvatures = std::mem::take(&mut self.strands[index].state.curvatures);
            self.put_with(index, curvatures, None, &mut kinematics);
            let strand = &mut self.strands[index];
            (strand.state.history, strand.state.subdivision) = (History::default(), 0);
            (strand.divergence, strand.touched) = (None, false);
            strand.frozen = Some(Box::new(frozen));
        }
        // The warm start of their contacts is void.
        self.constrained_substep.forget();
        Ok(())
    }

    /// Wakes strands: they move again from the next step on, from their current shape, at rest relative to their roots. Awake
    /// strands stay as they are.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn wake_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        for index in self.indices(ids)? {
            self.strands[index].frozen = None;
        }
        Ok(())
    }

    /// Which of these strands are frozen, in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn are_frozen(&self, ids: &[StrandId]) -> Result<Vec<bool>> {
        Ok(self.indices(ids)?.into_iter().map(|index| self.strands[index].frozen.is_some()).collect())
    }

    /// Wakes strands near bodies in a substep of `h` seconds, for which the bodies are prepared, and constrained strands.
    pub(in crate::solver) fn wake_near_bodies(&mut self, h: f64) {
        if self.strands.iter().all(|strand| strand.frozen.is_none()) {
            return;
        }
        for constraint in self.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            for index in
                [Some(constraint.def.strand), constraint.other()].into_iter().flatten().filter_map(|id| self.slots.index(id))
            {
                self.strands[index].frozen = None;
            }
        }
        let bodies: Vec<BodyAt> = self.bodies.iter().enumerate().map(|(k, body)| body.body.at(k as u32, h)).collect();
        let ids: Vec<BodyId> = self.bodies.iter().map(|body| body.id).collect();
        self.workers.for_each(&mut self.strands, |strand, _| {
            if strand.frozen.is_some() && strand.is_approached(h, &bodies, &ids) {
                strand.frozen = None;
            }
        });
    }
}
