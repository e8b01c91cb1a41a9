//! Where Newton's iteration is: a spring at every quadrature point and at every curvature, drawn to its target (`energy`), and the strand
//! between them, placed, evaluated, and pulled at.

use crate::chain::axes::{axes, for_axes};
use crate::chain::displacement;
use crate::chain::system::ChainSystem;
use crate::math::lane::{Kernel, Lane, MAX_LANES, Precision};
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;

/// What does not change during the iteration.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a, T> {
    /// The root's rotation at the step's end.
    pub root: &'a Mat3<T>,
    /// Element lengths.
    pub lengths: &'a [T],
    /// Free curvatures, ascending.
    pub axes: &'a [usize],
    /// Quadrature rule.
    pub rule: &'a Rule,
    /// Whether the springs' forces at the start are the tension to believe: so in a search for a rest, where they are the weight.
    pub tension_at_start: bool,
}

/// Where the iteration is.
#[derive(Debug, Clone)]
pub struct Iterate<T> {
    /// The accepted iterate.
    pub kinematics: Kinematics<T>,
    /// The iterate on trial.
    pub trial: Kinematics<T>,
    /// Stiffnesses and forces.
    pub system: ChainSystem<T>,
    /// Where each quadrature point was when the step began, relative to the root's origin then. What happens in a step is told as
    /// differences from here: they keep their digits however short the step is.
    pub point_base: Vec<Vec3<T>>,
    /// What each curvature was when the step began.
    pub curvature_base: Vec<[T; 3]>,
    /// Where each point is drawn to from its base, its position then being relative to the root's new origin, world axes.
    pub point_target: Vec<Vec3<T>>,
    /// Where each curvature is drawn to from its base.
    pub curvature_target: Vec<[T; 3]>,
    /// The accepted curvatures.
    pub curvatures: Vec<[T; 3]>,
    /// The curvatures on trial.
    pub trial_curvatures: Vec<[T; 3]>,
    /// What rounding left off the accepted curvatures (f32 only).
    pub rests: Vec<[T; 3]>,
    /// By how much each point is further on for it, to first order: J·rests (f32 only).
    pub point_rests: Vec<Vec3<T>>,
    /// The same of the curvatures on trial.
    pub trial_rests: Vec<[T; 3]>,
    /// Newton's direction.
    pub change: Vec<[T; 3]>,
    /// Tension that is laid aside.
    pub(super) spare_tension: Vec<Vec3<T>>,
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
            curvature_target: Vec::new(),
            curvatures: Vec::new(),
            trial_curvatures: Vec::new(),
            rests: Vec::new(),
            point_rests: Vec::new(),
            trial_rests: Vec::new(),
            change: Vec::new(),
            spare_tension: Vec::new(),
        }
    }
}

/// Of two starts, keeps the one with the lower potential: `curvatures` or `trial_curvatures`. Gives its potential and the rounding of
/// it.
#[inline(always)]
pub fn choose_start<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    let first = place_accepted(problem, it);
    let second = place_trial(problem, it);
    let better = second.0.less(first.0);
    if !T::any(better) {
        return first;
    }
    if T::all(better) {
        std::mem::swap(&mut it.kinematics, &mut it.trial);
        std::mem::swap(&mut it.curvatures, &mut it.trial_curvatures);
        std::mem::swap(&mut it.rests, &mut it.trial_rests);
        return second;
    }
    for (row, trial) in it.rests.iter_mut().zip(&it.trial_rests) {
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

/// The forces that the springs would have come to had the points gone `gone` of the direction along their tangents, from the
/// forces at hand and the kinematics of where they went from, which are those on trial now.
#[inline(always)]
pub(super) fn foresee<T: Lane>(it: &mut Iterate<T>, axes: &[usize], gone: &[f64; MAX_LANES]) {
    let Iterate { trial, system, change, .. } = it;
    system.point_tension.clone_from(&system.point_force);
    let gone = T::from_lanes(|lane| gone[lane]);
    let (tension, stiffness) = (&mut system.point_tension, &system.point_stiffness);
    macro_rules! call {
        ($_list:ident, $count:literal, $mask:literal) => {
            T::call(Foresee::<_, $count, $mask> { trial, tension, stiffness, change, gone })
        };
    }
    for_axes!(axes, call);
}

/// [`foresee`] for the D free curvatures of MASK.
struct Foresee<'a, T, const D: usize, const MASK: u32> {
    trial: &'a Kinematics<T>,
    tension: &'a mut [Vec3<T>],
    stiffness: &'a [T],
    change: &'a [[T; 3]],
    gone: T,
}

impl<T: Lane, const D: usize, const MASK: u32> Kernel for Foresee<'_, T, D, MASK> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (tension, stiffness, gone) = (self.tension, self.stiffness, self.gone);
        let axes = const { axes::<D>(MASK) };
        displacement::for_each_point_along(self.trial, self.change, axes, |p, moved| {
            tension[p] -= moved.scale(gone * stiffness[p]);
        });
    }
}

/// Places the accepted state; its potential and the rounding of it.
#[inline(always)]
pub fn place_accepted<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    let Iterate { kinematics, system, point_base, curvature_base, point_target, curvature_target, curvatures, .. } = it;
    T::call(Place { problem, kinematics, curvatures, system, point_base, curvature_base, point_target, curvature_target })
}

/// Places the state on trial.
#[inline(always)]
pub(super) fn place_trial<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>) -> (T, T) {
    let Iterate { trial, system, point_base, curvature_base, point_target, curvature_target, trial_curvatures, .. } = it;
    T::call(Place {
        problem,
        kinematics: trial,
        curvatures: trial_curvatures,
        system,
        point_base,
        curvature_base,
        point_target,
        curvature_target,
    })
}

/// Brings kinematics to curvatures, and evaluates the potential there.
struct Place<'a, T> {
    problem: &'a Problem<'a, T>,
    kinematics: &'a mut Kinematics<T>,
    curvatures: &'a [[T; 3]],
    system: &'a ChainSystem<T>,
    point_base: &'a [Vec3<T>],
    curvature_base: &'a [[T; 3]],
    point_target: &'a [Vec3<T>],
    curvature_target: &'a [[T; 3]],
}

impl<T: Lane> Kernel for Place<'_, T> {
    type Output = (T, T);
    #[inline(always)]
    fn run(self) -> (T, T) {
        self.kinematics.update(self.problem.root, self.problem.lengths, self.curvatures, self.problem.rule);
        let half = T::splat(0.5);
        let mut value = T::zero();
        let mut lever = T::zero();
        for (p, point) in self.kinematics.points.iter().enumerate() {
            let stiffness = self.system.point_stiffness[p];
            let off = (point.position - self.point_base[p]) - self.point_target[p];
            let square = off.norm_squared();
            value += half * stiffness * square;
            lever += stiffness * (square * point.position.norm_squared()).sqrt();
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

/// In f32: where what rounding left off the accepted curvatures puts the points. The potential does not see it: its own rounding is no
/// finer; the forces do, so that an iteration's direction is of the step's changes and not of what rounding makes anew each time.
#[inline(always)]
pub(super) fn place_rests<T: Lane>(it: &mut Iterate<T>) {
    if T::PRECISION == Precision::F32 {
        let Iterate { kinematics, rests, point_rests, .. } = it;
        point_rests.resize(kinematics.points.len(), Vec3::zero());
        T::call(PlaceRests { kinematics, rests, point_rests });
    }
}

struct PlaceRests<'a, T> {
    kinematics: &'a Kinematics<T>,
    rests: &'a [[T; 3]],
    point_rests: &'a mut [Vec3<T>],
}

impl<T: Lane> Kernel for PlaceRests<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let point_rests = self.point_rests;
        displacement::for_each_point(self.kinematics, self.rests, |p, moved| point_rests[p] = moved);
    }
}

/// The forces of the springs at the accepted state.
#[inline(always)]
pub fn forces<T: Lane>(it: &mut Iterate<T>) {
    let Iterate { kinematics, system, point_base, curvature_base, point_target, curvature_target, curvatures, .. } = it;
    let (rests, point_rests) = (&it.rests, &it.point_rests);
    T::call(Forces {
        kinematics,
        system,
        point_base,
        curvature_base,
        point_target,
        curvature_target,
        curvatures,
        rests,
        point_rests,
    });
}

struct Forces<'a, T> {
    kinematics: &'a Kinematics<T>,
    system: &'a mut ChainSystem<T>,
    point_base: &'a [Vec3<T>],
    curvature_base: &'a [[T; 3]],
    point_target: &'a [Vec3<T>],
    curvature_target: &'a [[T; 3]],
    curvatures: &'a [[T; 3]],
    rests: &'a [[T; 3]],
    point_rests: &'a [Vec3<T>],
}

impl<T: Lane> Kernel for Forces<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        for (p, point) in self.kinematics.points.iter().enumerate() {
            let mut moved = point.position - self.point_base[p];
            if T::PRECISION == Precision::F32 {
                moved += self.point_rests[p];
            }
            let off = self.point_target[p] - moved;
            self.system.point_force[p] = off.scale(self.system.point_stiffness[p]);
        }
        for (element, row) in self.curvatures.iter().enumerate() {
            for axis in 0..3 {
                let mut change = row[axis] - self.curvature_base[element][axis];
                if T::PRECISION == Precision::F32 {
                    change += self.rests[element][axis];
                }
                let off = self.curvature_target[element][axis] - change;
                self.system.curvature_force[element][axis] = self.system.curvature_stiffness[element][axis] * off;
            }
        }
    }
}

/// Sum of the forces on the points and of their moments about the root.
#[inline(always)]
pub fn wrench<T: Lane>(kinematics: &Kinematics<T>, forces: &[Vec3<T>]) -> (Vec3<T>, Vec3<T>) {
    let (mut force, mut torque) = (Vec3::zero(), Vec3::zero());
    for (point, f) in kinematics.points.iter().zip(forces) {
        force += *f;
        torque += point.position.cross(*f);
    }
    (force, torque)
}
