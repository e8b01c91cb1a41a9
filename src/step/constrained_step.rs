//! The step of strands that forces from outside hold at stations, one Newton iteration at a time, so that between iterations somebody
//! else can say what the forces are: contact and constraints, which may tie many strands together. Strands of one kind go side by side in a
//! pack ([`ConstrainedPack`](super::constrained_pack::ConstrainedPack)), which has what is the same work for all; this is what each has of its own.
//!
//! Each iteration has two halves. The first, [`ConstrainedPack::linearise`](super::constrained_pack::ConstrainedPack::linearise), gives what the stations would do
//! without forces, and their Delassus operator; the second, [`ConstrainedPack::advance`](super::constrained_pack::ConstrainedPack::advance), goes the way that the
//! forces lead to, a descent of the Lagrangian Φ(q) − Σ λ·r(q) with the forces λ as they are then. The step ends where neither the forces
//! nor the shape change any more. It is of implicit Euler, or of second order where that is asked for and the strand has a past.

use nalgebra::Vector3;

use super::StrandOutcome;
use super::damping::Damping;
use super::iterate::Iterate;
use super::line_search::Merit;
use crate::chain::delassus::Delassus;
use crate::chain::load::{Load, MaterialPoint};
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::ElementState;

/// A bond between a station and the world: what it holds, and how far that is from holding at the present iterate.
#[derive(Debug, Clone, Copy)]
pub struct WorldConstraint {
    /// The projector on the directions that it holds, world axes.
    pub projector: Mat3<f64>,
    /// From where it holds to where the station is, along those directions, m.
    pub off: Vec3<f64>,
}

/// Springs on the bonds are made stiffer by that factor where they do not do, up to so many times what is tried first; then the rotations
/// are held back too.
const STIFFER: f64 = 16.0;
const STIFFEST: f64 = 256.0;

/// One strand in the course of its step.
#[derive(Debug)]
pub struct ConstrainedStep {
    /// The strand's elements as the step found them, from where the root was then.
    pub(super) start: Vec<ElementState<f64>>,
    pub(super) start_origin: Vector3<f64>,
    pub(super) origin: Vector3<f64>,
    /// The strand's elements at the present iterate, and on trial.
    pub(super) now: Vec<ElementState<f64>>,
    pub(super) trial: Vec<ElementState<f64>>,
    /// The potential and its rounding at the present iterate.
    pub(super) potential: Merit,
    /// The strand's elements as the iteration began, and the potential and its rounding there.
    pub(super) guess: Vec<ElementState<f64>>,
    pub(super) guessed: Merit,
    pub(super) damping: Damping,
    pub(super) before: Option<f64>,
    pub(super) material_points: Vec<MaterialPoint>,
    pub(super) loads: Vec<Load<f64>>,
    /// Which of its pack's loads each station is.
    pub(super) slots: Vec<u32>,
    pub(super) forces: Vec<Vec3<f64>>,
    /// The bonds with the world, one a station where there are any, where they hold their stations, and the stiffness of the springs on them,
    /// N/m; zero: none.
    world_constraints: Vec<Option<WorldConstraint>>,
    anchors: Vec<Vec3<f64>>,
    spring: f64,
    /// The stiffness of the springs to try first, N/m.
    usual_spring: f64,
    /// How far each station would go in this iteration without forces, world axes, m.
    pub unconstrained: Vec<Vec3<f64>>,
    /// What forces at the stations add to that.
    pub delassus: Delassus,
    /// How far some point of it has gone at most since this was set to zero, iteration by iteration, m; infinite at a step's begin.
    pub gone: f64,
    /// How far an element may still be from where the iteration would end with the forces that it was advanced with, rad; infinite where the
    /// strand is lost.
    pub residual: f64,
    /// Whether all that would become its state is finite.
    pub(super) finite: bool,
    /// How it goes.
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
            residual: f64::INFINITY,
            finite: false,
            outcome: StrandOutcome::default(),
        }
    }
}

impl ConstrainedStep {
    /// Makes room for so many stations.
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

    /// Its step has begun: it is where the iteration starts from.
    pub(super) fn begin(&mut self, potential: Merit, usual_damping: f64) {
        self.guess.clone_from(&self.now);
        (self.potential, self.guessed) = (potential, potential);
        self.damping = Damping::new(usual_damping);
        (self.before, self.gone, self.residual) = (None, f64::INFINITY, f64::INFINITY);
        self.outcome = StrandOutcome { converged: false, quarantined: !potential.value.is_finite(), ..StrandOutcome::default() };
        self.material_points.clear();
        self.loads.clear();
        self.slots.clear();
        self.forces.clear();
        self.world_constraints.clear();
        self.spring = 0.0;
    }

    /// The strand as the step found it: where its root was, and its elements from there.
    pub fn start(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.start_origin, &self.start)
    }

    /// The same at the present iterate for the step's end.
    pub fn now(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.origin, &self.now)
    }

    /// Where a station is in a strand whose root's origin and elements are given.
    pub fn place((origin, elements): (Vector3<f64>, &[ElementState<f64>]), material_point: &MaterialPoint) -> Vector3<f64> {
        origin + Vector3::from(position(elements, material_point))
    }

    /// Before the first half of an iteration: forces will act at `material_points` (from root to tip); `guess` are those that the iteration before came
    /// to, which bend the matrix. `world_constraints`: none, or one a station that a bond holds to the world.
    ///
    /// Where the strand's own matrix is not positive definite, as under pressure between clamps, springs on the bonds are added to it (an
    /// augmented Lagrangian): they cost the solution nothing, since what they pull with is taken off the bonds' forces again
    /// ([`ConstrainedStep::pulled`]), and unlike damping they hold nothing back that the bonds leave free.
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

    /// Makes its loads; `exact`: with the geometric terms of the forces. `iterate` has it in a lane.
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

    /// What the spring on a station's bond pulls at it with in the linear model beside what is told of it: to be added to the force that
    /// the model has there, N.
    pub fn pulled(&self, material_point: usize) -> Vec3<f64> {
        match self.world_constraints.get(material_point) {
            Some(Some(constraint)) if self.spring > 0.0 => constraint.off.scale(self.spring),
            _ => Vec3::zero(),
        }
    }

    /// Before the second half: the forces on the stations (with [`ConstrainedStep::pulled`]).
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

    /// The Lagrangian of the present forces and springs, and its rounding, where the potential and elements are given.
    pub(super) fn lagrangian(&self, potential: Merit, elements: &[ElementState<f64>]) -> Merit {
        let springs = if self.spring > 0.0 { &self.world_constraints[..] } else { &[] };
        lagrangian(self, potential, elements, springs)
    }

    /// By how much the Lagrangian with the present forces is higher at the present iterate than where the iteration began, beyond what rounding may
    /// do, J. Above zero, the iterate is not the minimum but another stationary point: a chain that is folded another way has one.
    pub fn rise(&self) -> f64 {
        let now = lagrangian(self, self.potential, &self.now, &[]);
        let began = lagrangian(self, self.guessed, &self.guess, &[]);
        (now.value - began.value - now.noise - began.noise).max(0.0)
    }

    /// What is on trial is accepted.
    pub(super) fn accept(&mut self) {
        self.gone += farthest(&self.now, &self.trial);
        std::mem::swap(&mut self.now, &mut self.trial);
    }

    /// The force on its root and the torque about it, with those of the forces at its stations.
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

/// What there is in some of the lanes, with the lanes.
#[inline(always)]
pub fn running<M>(lanes: &mut [Option<M>]) -> impl Iterator<Item = (usize, &mut M)> {
    lanes.iter_mut().enumerate().filter_map(|(lane, member)| Some((lane, member.as_mut()?)))
}

/// How far the elements' ends are from where they were, at most.
fn farthest(elements: &[ElementState<f64>], were: &[ElementState<f64>]) -> f64 {
    let tip = |elements: &[ElementState<f64>]| elements.last().map_or(Vec3::zero(), ElementState::origin_right);
    let ends = elements.iter().zip(were).map(|(now, then)| (now.origin_left - then.origin_left).norm_squared());
    ends.fold((tip(elements) - tip(were)).norm_squared(), f64::max).sqrt()
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

/// The stiffness of the springs to try first: of the order of the strand's own, with what its forces may take off it.
fn usual_spring(inertia: f64, elements: &[ElementState<f64>], forces: &[Vec3<f64>]) -> f64 {
    let shortest = elements.iter().map(|element| element.length).fold(f64::INFINITY, f64::min);
    forces.iter().map(|force| force.norm_squared().sqrt() / shortest).fold(inertia, f64::max)
}

/// A potential and its rounding, less the forces' work, and with the energy of the springs on `world_constraints`.
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
