//! The step of one constrained strand, one Newton iteration at a time. Forces act on it at material points, and between
//! iterations they are found from outside: by contact and bilateral constraints, which may couple many strands. Strands with
//! one pack key go side by side in a pack ([`ConstrainedPack`](super::pack::ConstrainedPack)), which does the work
//! that is the same for all; here is what each strand has of its own.
//!
//! An iteration has two halves. The first, [`ConstrainedPack::linearise`](super::pack::ConstrainedPack::linearise),
//! gives the displacements of the material points without forces, and their Delassus operator. The second,
//! [`ConstrainedPack::advance`](super::pack::ConstrainedPack::advance), moves the strand with the forces, a descent
//! of the Lagrangian Φ(q) − Σ λ·r(q) at fixed forces λ. The step ends when neither the forces nor the shape change any more. It
//! is a step of implicit Euler, or of second order if that is set and the strand has a history.

use nalgebra::Vector3;

use super::stretch::Stretch;
use crate::chain::delassus::Delassus;
use crate::chain::load::{Load, MaterialPoint};
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::ElementState;
use crate::step::StrandOutcome;
use crate::step::newton::damping::Damping;
use crate::step::newton::iterate::Iterate;
use crate::step::newton::line_search::Merit;

/// A rigid constraint between a material point and the world, and its violation at the present iterate.
#[derive(Debug, Clone, Copy)]
pub struct WorldConstraint {
    /// Projector on the constrained directions, world axes.
    pub projector: Mat3<f64>,
    /// Displacement of the material point from its target along those directions, m.
    pub off: Vec3<f64>,
}

/// Springs on world constraints are made stiffer by this factor until they suffice, up to this many times the first stiffness;
/// then the rotations are damped too.
const STIFFER: f64 = 16.0;
const STIFFEST: f64 = 256.0;

/// One strand during its step.
#[derive(Debug)]
pub struct ConstrainedStep {
    /// The strand's elements at the start of the step, relative to where the root was then.
    pub(super) start: Vec<ElementState<f64>>,
    pub(super) start_origin: Vector3<f64>,
    pub(super) origin: Vector3<f64>,
    /// The strand's elements at the present iterate, and at the trial point.
    pub(super) now: Vec<ElementState<f64>>,
    pub(super) trial: Vec<ElementState<f64>>,
    /// The potential and its rounding at the present iterate.
    pub(super) potential: Merit,
    /// The elements at the first iterate, and the potential and its rounding there.
    pub(super) guess: Vec<ElementState<f64>>,
    pub(super) guessed: Merit,
    pub(super) damping: Damping,
    pub(super) stretch: Stretch,
    pub(super) before: Option<f64>,
    pub(super) material_points: Vec<MaterialPoint>,
    pub(super) loads: Vec<Load<f64>>,
    /// The index of each material point among its pack's loads.
    pub(super) slots: Vec<u32>,
    pub(super) forces: Vec<Vec3<f64>>,
    /// The world constraints, one entry per material point if there are any; their anchors; and the stiffness of the springs on
    /// them, N/m (zero: none).
    world_constraints: Vec<Option<WorldConstraint>>,
    anchors: Vec<Vec3<f64>>,
    spring: f64,
    /// The first stiffness of the springs to be tried, N/m.
    usual_spring: f64,
    /// Displacement of each material point in this iteration without forces, world axes, m.
    pub unconstrained: Vec<Vec3<f64>>,
    /// The displacements that forces at the material points add.
    pub delassus: Delassus,
    /// Sum of the iterations' largest displacements of any of its points since it was set to zero, m; infinite at the start of
    /// a step.
    pub gone: f64,
    /// The same for the points of each element.
    pub gone_by_element: Vec<f64>,
    /// Estimated distance of an element from convergence under the last forces, rad; infinite for a diverged strand.
    pub residual: f64,
    /// Whether all that would become its state is finite.
    pub(super) finite: bool,
    /// The outcome.
    pub outcome: StrandOutcome,
}

impl Default for ConstrainedStep {
    fn default() -> Self {
        Self {
            start: Vec::new(),
            start_origin: Vector3::zeros(),
            origin: Vector3::zeros(),
            now: Vec::new(),
            trial: Vec::new(),
            potential: Merit::default(),
            guess: Vec::new(),
            guessed: Merit::default(),
            damping: Damping::new(0.0),
            stretch: Stretch::default(),
            before: None,
            material_points: Vec::new(),
            loads: Vec::new(),
            slots: Vec::new(),
            forces: Vec::new(),
            world_constraints: Vec::new(),
            anchors: Vec::new(),
            spring: 0.0,
            usual_spring: 0.0,
            unconstrained: Vec::new(),
            delassus: Delassus::default(),
            gone: f64::INFINITY,
            gone_by_element: Vec::new(),
            residual: f64::INFINITY,
            finite: false,
            outcome: StrandOutcome::default(),
        }
    }
}

impl ConstrainedStep {
    /// Makes room for this many material points.
    pub fn make_room(&mut self, material_points: usize) {
        fn reserve<T>(list: &mut Vec<T>, count: usize) {
            list.reserve(count.saturating_sub(list.len()));
        }
        reserve(&mut self.material_points, material_points);
        reserve(&mut self.loads, material_points);
        reserve(&mut self.slots, material_points);
        reserve(&mut self.forces, material_points);
        reserve(&mut self.anchors, material_points);
        reserve(&mut self.unconstrained, material_points);
        reserve(&mut self.delassus.columns, 9 * material_points * material_points);
    }

    /// Its step has begun: sets the first iterate.
    pub(super) fn begin(&mut self, potential: Merit, usual_damping: f64) {
        self.guess.clone_from(&self.now);
        (self.potential, self.guessed) = (potential, potential);
        self.damping = Damping::new(usual_damping);
        self.stretch.forget();
        (self.before, self.gone, self.residual) = (None, f64::INFINITY, f64::INFINITY);
        self.gone_by_element.clear();
        self.gone_by_element.resize(self.now.len(), 0.0);
        self.outcome = StrandOutcome { converged: false, quarantined: !potential.value.is_finite(), ..StrandOutcome::default() };
        self.material_points.clear();
        self.loads.clear();
        self.slots.clear();
        self.forces.clear();
        self.world_constraints.clear();
        self.spring = 0.0;
    }

    /// The strand at the start of the step: the root's origin, and the elements relative to it.
    pub fn start(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.start_origin, &self.start)
    }

    /// The same at the present iterate.
    pub fn now(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.origin, &self.now)
    }

    /// Position of a material point of a strand with this root and these elements.
    pub fn place((origin, elements): (Vector3<f64>, &[ElementState<f64>]), material_point: &MaterialPoint) -> Vector3<f64> {
        origin + Vector3::from(position(elements, material_point))
    }

    /// Before the first half of an iteration: forces will act on `material_points` (from root to tip); `guess` are those of the
    /// last iteration, which enter the Hessian. `world_constraints`: empty, or one entry per material point.
    ///
    /// Where the strand's own matrix is not positive definite, as under compression between clamps, springs on the world
    /// constraints are added to it (an augmented Lagrangian). They do not change the solution, since the constraints' forces
    /// are reduced by theirs ([`ConstrainedStep::pulled`]), and unlike damping they do not impede unconstrained directions.
    pub fn hold(
        &mut self,
        material_points: &[MaterialPoint],
        guess: &[Vec3<f64>],
        world_constraints: &[Option<WorldConstraint>],
    ) {
        self.material_points.clear();
        self.material_points.extend_from_slice(material_points);
        self.forces.clear();
        self.forces.extend_from_slice(guess);
        self.world_constraints.clear();
        self.world_constraints.extend_from_slice(world_constraints);
        self.damping.begin();
    }

    /// Makes its loads; `exact`: with the geometric terms of the forces. The strand is in this lane of `iterate`.
    pub(super) fn load<T: Lane>(&mut self, iterate: &Iterate<T>, lane: usize, exact: bool) {
        self.loads.clear();
        let tension = |force: &Vec3<f64>| if exact { *force } else { Vec3::zero() };
        let loads = self
            .material_points
            .iter()
            .zip(&self.forces)
            .map(|(material_point, force)| Load::at(&self.now, material_point, tension(force)));
        self.loads.extend(loads);
        self.usual_spring = if self.world_constraints.is_empty() {
            0.0
        } else {
            let inertia: f64 = iterate.system.point_stiffness.iter().map(|stiffness| stiffness.lane(lane)).sum();
            usual_spring(inertia, &self.now, &self.forces)
        };
        self.spring = self.spring.min(STIFFEST * self.usual_spring);
        self.set_springs();
    }

    /// Its matrix is not positive definite: stiffer springs, or more damping.
    pub(super) fn stiffen(&mut self) {
        let most = STIFFEST * self.usual_spring;
        if self.spring < most {
            self.spring = (self.spring * STIFFER).clamp(self.usual_spring, most);
            self.set_springs();
        } else {
            self.damping.grow();
        }
    }

    fn set_springs(&mut self) {
        if self.spring > 0.0 {
            for (load, constraint) in self
                .loads
                .iter_mut()
                .zip(&self.world_constraints)
                .filter_map(|(load, constraint)| Some((load, constraint.as_ref()?)))
            {
                *load = load.with_stiffness(&self.now, &constraint.projector.scale(self.spring));
            }
        }
    }

    /// The force of the spring at a material point in the linear model: to be added to the constraint's force, N.
    pub fn pulled(&self, material_point: usize) -> Vec3<f64> {
        match self.world_constraints.get(material_point) {
            Some(Some(constraint)) if self.spring > 0.0 => constraint.off.scale(self.spring),
            _ => Vec3::zero(),
        }
    }

    /// Before the second half: the forces on the material points (including [`ConstrainedStep::pulled`]).
    pub fn pull(&mut self, forces: &[Vec3<f64>]) {
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        self.anchors.clear();
        if self.spring > 0.0 {
            let anchors = self.material_points.iter().zip(&self.world_constraints).map(|(material_point, constraint)| {
                position(&self.now, material_point) - constraint.as_ref().map_or(Vec3::zero(), |constraint| constraint.off)
            });
            self.anchors.extend(anchors);
        }
    }

    /// The Lagrangian of the present forces and springs, and its rounding, for this potential and these elements.
    pub(super) fn lagrangian(&self, potential: Merit, elements: &[ElementState<f64>]) -> Merit {
        let springs = if self.spring > 0.0 { &self.world_constraints[..] } else { &[] };
        lagrangian(self, potential, elements, springs)
    }

    /// By how much the Lagrangian of the present forces has risen since the first iterate, beyond rounding, J. Above zero the
    /// iterate is not the minimum but another stationary point, such as one where a chain is folded another way.
    pub fn rise(&self) -> f64 {
        let now = lagrangian(self, self.potential, &self.now, &[]);
        let began = lagrangian(self, self.guessed, &self.guess, &[]);
        (now.value - began.value - now.noise - began.noise).max(0.0)
    }

    /// Accepts the trial point.
    pub(super) fn accept(&mut self) {
        self.gone += go(&self.now, &self.trial, &mut self.gone_by_element);
        std::mem::swap(&mut self.now, &mut self.trial);
    }

    /// The force on its root and the torque about it, including those of the forces at its material points.
    pub(super) fn wrench(&self, mut force: Vec3<f64>, mut torque: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
        for (material_point, pull) in self.material_points.iter().zip(&self.forces) {
            force += *pull;
            torque += position(&self.now, material_point).cross(*pull);
        }
        (force, torque)
    }
}

/// The strands of a pack that take part in half an iteration, by their lanes.
pub type Lanes<'a, 'b> = &'a mut [Option<&'b mut ConstrainedStep>];

/// The occupied lanes.
#[inline(always)]
pub fn running<M>(lanes: &mut [Option<M>]) -> impl Iterator<Item = (usize, &mut M)> {
    lanes.iter_mut().enumerate().filter_map(|(lane, member)| Some((lane, member.as_mut()?)))
}

/// Adds the largest displacement of each element's points: of its ends, and what its change of curvature moves those between.
/// Returns the largest of all.
fn go(elements: &[ElementState<f64>], were: &[ElementState<f64>], gone: &mut [f64]) -> f64 {
    let mut farthest = 0.0_f64;
    let mut left = 0.0;
    for (k, (now, then)) in elements.iter().zip(were).enumerate() {
        let right = match elements.get(k + 1).zip(were.get(k + 1)) {
            Some((now, then)) => now.origin_left - then.origin_left,
            None => now.origin_right() - then.origin_right(),
        };
        let right = right.norm_squared().sqrt();
        let bulge = (now.kappa - then.kappa).norm_squared().sqrt() * (0.125 * now.length * now.length);
        gone[k] += f64::max(left, right) + bulge;
        farthest = farthest.max(right);
        left = right;
    }
    farthest
}

fn position(elements: &[ElementState<f64>], material_point: &MaterialPoint) -> Vec3<f64> {
    let element = &elements[material_point.element];
    let point = element.point(material_point.s);
    let mut local = point.local;
    if material_point.lever != [0.0; 3] {
        let (theta, z) = (element.kappa.scale(material_point.s), element.kappa_squared * (material_point.s * material_point.s));
        local += crate::rod::segment::frame(theta, z, &point.c).apply(Vec3(material_point.lever));
    }
    element.origin_left + element.frame_left.apply(local)
}

/// The first stiffness of the springs to be tried: of the order of the strand's own, with what its forces may take off it.
fn usual_spring(inertia: f64, elements: &[ElementState<f64>], forces: &[Vec3<f64>]) -> f64 {
    let shortest = elements.iter().map(|element| element.length).fold(f64::INFINITY, f64::min);
    forces.iter().map(|force| force.norm_squared().sqrt() / shortest).fold(inertia, f64::max)
}

/// A potential and its rounding minus the work of the forces, with the energy of the springs on `world_constraints`.
fn lagrangian(
    constrained: &ConstrainedStep,
    Merit { mut value, mut noise }: Merit,
    elements: &[ElementState<f64>],
    world_constraints: &[Option<WorldConstraint>],
) -> Merit {
    for (index, (material_point, force)) in constrained.material_points.iter().zip(&constrained.forces).enumerate() {
        let at = position(elements, material_point);
        value -= at.dot(*force);
        noise += 8.0 * f64::EPSILON * (at.norm_squared() * force.norm_squared()).sqrt();
        if let Some(Some(constraint)) = world_constraints.get(index) {
            let off = constraint.projector.apply(at - constrained.anchors[index]);
            value += 0.5 * constrained.spring * off.norm_squared();
            noise += 8.0 * f64::EPSILON * constrained.spring * (at.norm_squared() * off.norm_squared()).sqrt();
        }
    }
    Merit { value, noise }
}
