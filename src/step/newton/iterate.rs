//! The state of Newton's iteration: a spring to a target at every quadrature point and every curvature (`energy`), and the strand
//! between them.

use crate::chain::axes::{axes, for_axes};
use crate::chain::displacement;
use crate::chain::system::{ChainSystem, springs_of};
use crate::math::lane::{Kernel, Lane, MAX_LANES, Precision};
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;
use crate::step::at_points::springs::PointContacts;

/// What stays constant during the iteration.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a, T> {
    /// The root's rotation at the end of the step.
    pub root: &'a Mat3<T>,
    /// Element lengths.
    pub lengths: &'a [T],
    /// Free curvatures, ascending.
    pub axes: &'a [usize],
    /// Quadrature rule.
    pub rule: &'a Rule,
    /// Whether the springs' initial forces are the true tension: so in a search for equilibrium, where they are the weight.
    pub tension_at_start: bool,
}

/// The state of the iteration.
#[derive(Debug, Clone)]
pub struct Iterate<T> {
    /// The accepted iterate.
    pub kinematics: Kinematics<T>,
    /// The iterate on trial.
    pub trial: Kinematics<T>,
    /// Stiffnesses and forces.
    pub system: ChainSystem<T>,
    /// Position of each quadrature point at the start of the step, relative to the root's origin then. The iteration works on
    /// differences from here, which keep their digits however short the step is.
    pub point_base: Vec<Vec3<T>>,
    /// Each curvature at the start of the step.
    pub curvature_base: Vec<[T; 3]>,
    /// Displacement from its base to which each point is drawn, where its position is relative to the root's new origin, world
    /// axes.
    pub point_target: Vec<Vec3<T>>,
    /// Contact of the points, where bodies may touch the strands.
    pub contacts: PointContacts<T>,
    /// Change from its base to which each curvature is drawn.
    pub curvature_target: Vec<[T; 3]>,
    /// The accepted curvatures.
    pub curvatures: Vec<[T; 3]>,
    /// The curvatures on trial.
    pub trial_curvatures: Vec<[T; 3]>,
    /// Rounding errors of the accepted curvatures (f32 only).
    pub compensation: Vec<[T; 3]>,
    /// The displacement of each point that they cause, to first order: J·rests (f32 only).
    pub point_compensation: Vec<Vec3<T>>,
    /// Rounding errors of the trial curvatures.
    pub trial_compensation: Vec<[T; 3]>,
    /// Newton's direction.
    pub change: Vec<[T; 3]>,
    /// Tension that is set aside.
    pub(in crate::step) spare_tension: Vec<Vec3<T>>,
}

impl<T: Lane> Default for Iterate<T> {
    fn default() -> Self {
        Self {
            kinematics: Kinematics::default(),
            trial: Kinematics::default(),
            system: ChainSystem::default(),
            point_base: Vec::new(),
            curvature_base: Vec::new(),
            point_target: Vec::new(),
            contacts: PointContacts::default(),
            curvature_target: Vec::new(),
            curvatures: Vec::new(),
            trial_curvatures: Vec::new(),
            compensation: Vec::new(),
            point_compensation: Vec::new(),
            trial_compensation: Vec::new(),
            change: Vec::new(),
            spare_tension: Vec::new(),
        }
    }
}

/// Of two starts, `curvatures` and `trial_curvatures`, keeps the one with the lower potential. Returns that potential and its
/// rounding error. `root_before`: the root's rotation at the start of the step, if `curvatures` are those of then.
#[inline(always)]
pub fn choose_start<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, root_before: Option<&Mat3<T>>) -> (T, T) {
    let second = place_trial(problem, it);
    // The second is the better one as a rule. The first need not be placed where that is plain in all lanes.
    let carried = root_before.and_then(|before| carried_potential(problem, it, before));
    if carried.is_some_and(|first| T::all((second.0 + second.1).less(first.0 - first.1))) {
        take_second(it);
        return second;
    }
    let first = place_accepted(problem, it);
    let better = second.0.less(first.0);
    if !T::any(better) {
        return first;
    }
    if T::all(better) {
        take_second(it);
        return second;
    }
    for (row, trial) in it.compensation.iter_mut().zip(&it.trial_compensation) {
        for axis in 0..3 {
            row[axis] = T::select(better, trial[axis], row[axis]);
        }
    }
    for (row, trial) in it.curvatures.iter_mut().zip(&it.trial_curvatures) {
        for axis in 0..3 {
            row[axis] = T::select(better, trial[axis], row[axis]);
        }
    }
    place_accepted(problem, it)
}

#[inline(always)]
fn take_second<T: Lane>(it: &mut Iterate<T>) {
    std::mem::swap(&mut it.kinematics, &mut it.trial);
    std::mem::swap(&mut it.curvatures, &mut it.trial_curvatures);
    std::mem::swap(&mut it.compensation, &mut it.trial_compensation);
}

/// The potential of the shape at the start of the step, carried along by the root, whose rotation was `before`, and a bound on its rounding
/// error. `None` if `curvatures` are another shape: a host has changed frozen ones.
#[inline(always)]
fn carried_potential<T: Lane>(problem: &Problem<T>, it: &Iterate<T>, before: &Mat3<T>) -> Option<(T, T)> {
    let half = T::splat(0.5);
    let (mut bent, mut changed) = (T::zero(), T::zero());
    for (element, (row, base)) in it.curvatures.iter().zip(&it.curvature_base).enumerate() {
        for axis in 0..3 {
            changed += (row[axis] - base[axis]) * (row[axis] - base[axis]);
            let off = it.curvature_target[element][axis];
            bent += it.system.curvature_stiffness[element][axis] * off * off;
        }
    }
    if T::any(T::zero().less(changed)) {
        return None;
    }
    let turn = problem.root.mul_transposed(before);
    let (mut moved, mut lever) = (T::zero(), T::zero());
    for (p, base) in it.point_base.iter().enumerate() {
        let (stiffness, off) = (it.system.point_stiffness[p], (turn.apply(*base) - *base) - it.point_target[p]);
        moved += stiffness * off.norm_squared();
        lever += stiffness * base.norm_squared();
    }
    let value = half * (moved + bent);
    // Cauchy and Schwarz's bound on the sum of stiffness × offset × distance from the root.
    Some((value, T::splat(32.0 * T::PRECISION.constants().epsilon) * (value + (moved * lever).sqrt())))
}

/// The lagged tension: the forces that the springs would have reached had the points gone a fraction `gone` of the direction
/// along their tangents. Computed from the current forces and the kinematics at the start of that motion, which are now the trial
/// ones.
#[inline(always)]
pub(in crate::step) fn predict_tension<T: Lane>(it: &mut Iterate<T>, axes: &[usize], gone: &[f64; MAX_LANES]) {
    let Iterate { trial, system, change, .. } = it;
    system.point_tension.clone_from(&system.point_force);
    let gone = T::from_lanes(|lane| gone[lane]);
    let ChainSystem { point_tension: tension, point_stiffness: stiffness, normals, normal_stiffness, .. } = system;
    macro_rules! call {
        ($_list:ident, $count:literal, $mask:literal) => {
            T::call(PredictTension::<_, $count, $mask> { trial, tension, stiffness, normals, normal_stiffness, change, gone })
        };
    }
    for_axes!(axes, call);
}

/// [`predict_tension`] for the D free curvatures of MASK.
struct PredictTension<'a, T, const D: usize, const MASK: u32> {
    trial: &'a Kinematics<T>,
    tension: &'a mut [Vec3<T>],
    stiffness: &'a [T],
    normals: &'a [Vec3<T>],
    normal_stiffness: &'a [T],
    change: &'a [[T; 3]],
    gone: T,
}

impl<T: Lane, const D: usize, const MASK: u32> Kernel for PredictTension<'_, T, D, MASK> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { trial, tension, stiffness, normals, normal_stiffness, change, gone } = self;
        let axes = const { axes::<D>(MASK) };
        let points = stiffness.len();
        displacement::for_each_point_along(trial, change, axes, |p, moved| {
            tension[p] -= moved.scale(gone * stiffness[p]);
            for spring in springs_of(p, points, normals.len()) {
                let normal = normals[spring];
                tension[p] -= normal.scale(gone * normal_stiffness[spring] * normal.dot(moved));
            }
        });
    }
}

/// Evaluates the accepted state: its potential, and the rounding error of that.
#[inline(always)]
pub fn place_accepted<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    evaluate(problem, it, At::Accepted)
}

/// Evaluates the accepted state again, with other springs.
#[inline(always)]
pub(super) fn evaluate_accepted<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    evaluate(problem, it, At::AcceptedInPlace)
}

/// Evaluates the trial state.
#[inline(always)]
pub(in crate::step) fn place_trial<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    evaluate(problem, it, At::Trial)
}

/// Where the potential is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum At {
    Accepted,
    /// The same, where the kinematics are those of its curvatures already.
    AcceptedInPlace,
    Trial,
}

#[inline(always)]
fn evaluate<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, at: At) -> (T, T) {
    let (kinematics, curvatures) = match at {
        At::Accepted | At::AcceptedInPlace => (&mut it.kinematics, &it.curvatures),
        At::Trial => (&mut it.trial, &it.trial_curvatures),
    };
    let Iterate { system, contacts, point_base, curvature_base, point_target, curvature_target, .. } = it;
    T::call(Evaluate {
        problem,
        kinematics,
        curvatures,
        system,
        contacts,
        point_base,
        curvature_base,
        point_target,
        curvature_target,
        places: at != At::AcceptedInPlace,
    })
}

/// Evaluates the potential at curvatures; updates the kinematics to them where it `places` the strands.
struct Evaluate<'a, T> {
    problem: &'a Problem<'a, T>,
    kinematics: &'a mut Kinematics<T>,
    curvatures: &'a [[T; 3]],
    system: &'a ChainSystem<T>,
    contacts: &'a PointContacts<T>,
    point_base: &'a [Vec3<T>],
    curvature_base: &'a [[T; 3]],
    point_target: &'a [Vec3<T>],
    curvature_target: &'a [[T; 3]],
    places: bool,
}

impl<T: Lane> Kernel for Evaluate<'_, T> {
    type Output = (T, T);
    #[inline(always)]
    fn run(self) -> (T, T) {
        if self.places {
            self.kinematics.update(self.problem.root, self.problem.lengths, self.curvatures, self.problem.rule);
        }
        let half = T::splat(0.5);
        let mut value = T::zero();
        let mut lever = T::zero();
        for (p, point) in self.kinematics.points.iter().enumerate() {
            let stiffness = self.system.point_stiffness[p];
            let off = (point.position - self.point_base[p]) - self.point_target[p];
            let square = off.norm_squared();
            value += half * stiffness * square;
            lever += stiffness * (square * point.position.norm_squared()).sqrt();
            for spring in springs_of(p, self.point_base.len(), self.system.normals.len()) {
                let off = self.system.normals[spring].dot(point.position) - self.contacts.offsets[spring];
                value += half * self.contacts.along_normal(spring, off) * off * off;
                lever += self.contacts.planes[spring] * (off * off * point.position.norm_squared()).sqrt();
            }
        }
        for (element, row) in self.curvatures.iter().enumerate() {
            for axis in 0..3 {
                let off = (row[axis] - self.curvature_base[element][axis]) - self.curvature_target[element][axis];
                value += half * self.system.curvature_stiffness[element][axis] * off * off;
            }
        }
        (value, T::splat(4.0 * T::PRECISION.constants().epsilon) * (value + lever))
    }
}

/// In f32: the displacements of the points by the rounding errors of the accepted curvatures. The potential is no finer than its
/// own rounding and ignores them. The forces include them, so that an iteration's direction comes from the step's changes and not
/// from fresh rounding each time.
#[inline(always)]
pub(super) fn place_compensation<T: Lane>(it: &mut Iterate<T>) {
    if T::PRECISION == Precision::F32 {
        let Iterate { kinematics, compensation, point_compensation, .. } = it;
        point_compensation.resize(kinematics.points.len(), Vec3::zero());
        T::call(PlaceCompensation { kinematics, compensation, point_compensation });
    }
}

struct PlaceCompensation<'a, T> {
    kinematics: &'a Kinematics<T>,
    compensation: &'a [[T; 3]],
    point_compensation: &'a mut [Vec3<T>],
}

impl<T: Lane> Kernel for PlaceCompensation<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let point_compensation = self.point_compensation;
        displacement::for_each_point(self.kinematics, self.compensation, |p, moved| point_compensation[p] = moved);
    }
}

/// The springs' forces at the accepted state.
#[inline(always)]
pub fn forces<T: Lane>(it: &mut Iterate<T>) {
    let Iterate { kinematics, system, point_base, curvature_base, point_target, curvature_target, curvatures, .. } = it;
    let contacts = &it.contacts;
    let (compensation, point_compensation) = (&it.compensation, &it.point_compensation);
    T::call(Forces {
        kinematics,
        system,
        contacts,
        point_base,
        curvature_base,
        point_target,
        curvature_target,
        curvatures,
        compensation,
        point_compensation,
    });
}

struct Forces<'a, T> {
    kinematics: &'a Kinematics<T>,
    system: &'a mut ChainSystem<T>,
    contacts: &'a PointContacts<T>,
    point_base: &'a [Vec3<T>],
    curvature_base: &'a [[T; 3]],
    point_target: &'a [Vec3<T>],
    curvature_target: &'a [[T; 3]],
    curvatures: &'a [[T; 3]],
    compensation: &'a [[T; 3]],
    point_compensation: &'a [Vec3<T>],
}

impl<T: Lane> Kernel for Forces<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        for (p, point) in self.kinematics.points.iter().enumerate() {
            let mut moved = point.position - self.point_base[p];
            if T::PRECISION == Precision::F32 {
                moved += self.point_compensation[p];
            }
            let off = self.point_target[p] - moved;
            self.system.point_force[p] = off.scale(self.system.point_stiffness[p]);
            for spring in springs_of(p, self.point_base.len(), self.system.normals.len()) {
                let (normal, mut at) = (self.system.normals[spring], point.position);
                if T::PRECISION == Precision::F32 {
                    at += self.point_compensation[p];
                }
                let off = normal.dot(at) - self.contacts.offsets[spring];
                self.system.point_force[p] -= normal.scale(self.contacts.along_normal(spring, off) * off);
            }
        }
        for (element, row) in self.curvatures.iter().enumerate() {
            for axis in 0..3 {
                let mut change = row[axis] - self.curvature_base[element][axis];
                if T::PRECISION == Precision::F32 {
                    change += self.compensation[element][axis];
                }
                let off = self.curvature_target[element][axis] - change;
                self.system.curvature_force[element][axis] = self.system.curvature_stiffness[element][axis] * off;
            }
        }
    }
}

/// Sum of the forces on the points, and of their moments about the root.
#[inline(always)]
pub fn wrench<T: Lane>(kinematics: &Kinematics<T>, forces: &[Vec3<T>]) -> (Vec3<T>, Vec3<T>) {
    let (mut force, mut torque) = (Vec3::zero(), Vec3::zero());
    for (point, f) in kinematics.points.iter().zip(forces) {
        force += *f;
        torque += point.position.cross(*f);
    }
    (force, torque)
}
