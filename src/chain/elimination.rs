//! The linear-time solve: elimination from tip to root, then one pass from root to tip (`docs/theory/mathematics.md`). It is
//! Featherstone's recursion for flexible segments (Bertails 2009).
//!
//! Every quantity of a segment is in the axes of its left end. Symbols: u = (ψ, ρ) is the rotation and displacement of the left
//! end, δκ the change of curvatures. The right end turns by ψ + Ψδκ and moves by ρ + ψ×a + Jδκ, where a is its position. What
//! lies downstream acts on the right end as a quadratic ½ uᵀPu − pᵀu, `P = [A B; Bᵀ C]`; F and M are the sum of the forces
//! downstream and their moment about the right end. A point with stiffness k and force f at x moves by ρ + ψ×x + J_x δκ. The
//! exact Hessian adds tension: the second variations of x and of the right end, weighted by −f, −F, −M.
//!
//! Files:
//!
//! - `assembly.rs`: What an element is to its left end: everything downstream, its own points and its loads, and what its free curvatures meet.
//! - `pivot.rs`: The small symmetric pivots of the elimination: Cholesky's factorisation, and a repair for one that is not positive definite.
//! - `reduced.rs`: An element's freedoms once they are eliminated, and their changes from the left end's: the forward and the back substitution of the solves.

pub(super) mod assembly;
pub mod pivot;
pub(crate) mod reduced;

use super::axes::{axes, for_axes};
use super::load::Load;
use super::system::{ChainSystem, Direction, LinearSolve};
use crate::math::lane::{Kernel, Lane};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, Kinematics};
use crate::rod::segment;
use assembly::{Downstream, columns};
use reduced::Reduced;

/// What the second pass needs from an element with D free curvatures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Eliminated<T, const D: usize> {
    /// The free curvatures, eliminated.
    pub reduced: Reduced<T, D>,
    /// Force on the free curvatures before any elimination: minus the slope of the potential.
    pub force: [T; D],
    /// Ψ and J at the right end, free columns.
    pub psi: [Vec3<T>; D],
    pub jacobian: [Vec3<T>; D],
}

/// Scratch memory of the elimination, kept between calls so that a solve allocates nothing.
#[derive(Debug, Clone)]
pub struct Elimination<T> {
    pub(super) one: Vec<Eliminated<T, 1>>,
    pub(super) two: Vec<Eliminated<T, 2>>,
    pub(super) three: Vec<Eliminated<T, 3>>,
}

impl<T> Default for Elimination<T> {
    fn default() -> Self {
        Self { one: Vec::new(), two: Vec::new(), three: Vec::new() }
    }
}

impl<T: Lane> LinearSolve<T> for Elimination<T> {
    const DAMPED: bool = true;
    const ROTATION_LIMIT: f64 = 2.0;

    #[inline(always)]
    fn solve(
        &mut self,
        kinematics: &Kinematics<T>,
        system: &ChainSystem<T>,
        axes: &[usize],
        change: &mut Vec<[T; 3]>,
    ) -> Direction<T> {
        self.call::<false>(kinematics, system, &[], axes, change)
    }
}

/// The solve for the D free curvatures of MASK, compiled as a function of its own.
struct SolveFor<'a, T, const D: usize, const MASK: u32, const LOADED: bool> {
    scratch: &'a mut Vec<Eliminated<T, D>>,
    kinematics: &'a Kinematics<T>,
    system: &'a ChainSystem<T>,
    loads: &'a [Load<T>],
    change: &'a mut Vec<[T; 3]>,
}

impl<T: Lane, const D: usize, const MASK: u32, const LOADED: bool> Kernel for SolveFor<'_, T, D, MASK, LOADED> {
    type Output = Direction<T>;
    #[inline(always)]
    fn run(self) -> Direction<T> {
        let axes = const { axes::<D>(MASK) };
        solve_for::<T, D, LOADED>(self.scratch, self.kinematics, self.system, self.loads, axes, self.change)
    }
}

impl<T: Lane> Elimination<T> {
    /// [`LinearSolve::solve`] for a strand with forces at material points (`loads`, ordered from root to tip). Their geometric
    /// terms and springs enter the matrix. Their forces do not enter the direction: see [`super::response`].
    pub fn solve_loaded(
        &mut self,
        kinematics: &Kinematics<T>,
        system: &ChainSystem<T>,
        loads: &[Load<T>],
        axes: &[usize],
        change: &mut Vec<[T; 3]>,
    ) -> Direction<T> {
        self.call::<true>(kinematics, system, loads, axes, change)
    }

    #[inline(always)]
    fn call<const LOADED: bool>(
        &mut self,
        kinematics: &Kinematics<T>,
        system: &ChainSystem<T>,
        loads: &[Load<T>],
        axes: &[usize],
        change: &mut Vec<[T; 3]>,
    ) -> Direction<T> {
        macro_rules! call {
            ($list:ident, $count:literal, $mask:literal) => {
                T::call(SolveFor::<_, $count, $mask, LOADED> { scratch: &mut self.$list, kinematics, system, loads, change })
            };
        }
        for_axes!(axes, call)
    }
}

#[inline(always)]
fn solve_for<T: Lane, const D: usize, const LOADED: bool>(
    scratch: &mut Vec<Eliminated<T, D>>,
    kinematics: &Kinematics<T>,
    system: &ChainSystem<T>,
    mut loads: &[Load<T>],
    axes: [usize; D],
    change: &mut Vec<[T; 3]>,
) -> Direction<T> {
    let count = kinematics.elements.len();
    scratch.clear();
    let mut repaired = T::zero();
    let mut down = Downstream::nothing();
    for index in (0..count).rev() {
        let mut own = loads;
        if LOADED {
            (loads, own) = loads.split_at(loads.partition_point(|load| load.element < index));
        }
        let (eliminated, left, repair) = eliminate::<T, D, LOADED>(&down, kinematics, system, own, axes, index);
        repaired += repair;
        scratch.push(eliminated);
        down = if index > 0 { left.turned(&kinematics.elements[index - 1].turn) } else { left };
    }
    // From root to tip: the root does not move.
    change.clear();
    change.resize(count, [T::zero(); 3]);
    let mut walk = Walk::from_root();
    let mut descent = T::zero();
    for (index, element) in kinematics.elements.iter().enumerate() {
        let done = &scratch[count - 1 - index];
        let delta = done.reduced.change(walk.psi, walk.rho);
        for i in (0..D).rev() {
            descent += delta[i] * done.force[i];
            change[index][axes[i]] = delta[i];
        }
        walk.pass(element, done, &delta);
    }
    walk.direction(descent, repaired)
}

/// The left end of an element on the pass from root to tip, and the largest rotation so far.
pub(super) struct Walk<T> {
    pub psi: Vec3<T>,
    pub rho: Vec3<T>,
    rotation_squared: T,
    rotation_sum: T,
}

impl<T: Lane> Walk<T> {
    /// At a root that stays.
    #[inline(always)]
    pub fn from_root() -> Self {
        Self { psi: Vec3::zero(), rho: Vec3::zero(), rotation_squared: T::zero(), rotation_sum: T::zero() }
    }

    /// Goes on to the next element, past one whose free curvatures change by `delta`.
    #[inline(always)]
    pub fn pass<const D: usize>(&mut self, element: &ElementState<T>, done: &Eliminated<T, D>, delta: &[T; D]) {
        let (mut next_psi, mut next_rho) = (self.psi, self.rho + self.psi.cross(element.end));
        for i in 0..D {
            next_psi += done.psi[i].scale(delta[i]);
            next_rho += done.jacobian[i].scale(delta[i]);
        }
        let turned = next_psi.norm_squared();
        self.rotation_squared = self.rotation_squared.larger(turned);
        self.rotation_sum += turned;
        self.psi = element.turn.apply_transposed(next_psi);
        self.rho = element.turn.apply_transposed(next_rho);
    }

    /// The direction that the changes are.
    #[inline(always)]
    pub fn direction(&self, descent: T, repaired: T) -> Direction<T> {
        let Self { rotation_squared, rotation_sum, .. } = *self;
        Direction { descent, rotation_squared, rotation_sum, repaired, condition: 0.0 }
    }
}

/// Eliminates one element's curvatures. Leaves what the element and everything downstream are to its left end, and what the
/// second pass needs.
#[inline(always)]
fn eliminate<T: Lane, const D: usize, const LOADED: bool>(
    right: &Downstream<T>,
    kinematics: &Kinematics<T>,
    system: &ChainSystem<T>,
    loads: &[Load<T>],
    axes: [usize; D],
    index: usize,
) -> (Eliminated<T, D>, Downstream<T>, T) {
    let mut right = *right;
    right.a[0] += system.rotation_stiffness;
    right.a[3] += system.rotation_stiffness;
    right.a[5] += system.rotation_stiffness;
    let element = &kinematics.elements[index];
    let (kappa, length) = (element.kappa, element.length);
    let theta = kappa.scale(length);
    let z = element.kappa_squared * (length * length);
    let psi = columns(&segment::mean_frame(theta, z, &element.c), axes, length);
    let jacobian = columns(&segment::chord_gradient(theta, z, &element.c), axes, length * length);

    let (mut left, mut meets) = right.through(element, &psi, &jacobian, system.exact);
    let sums = meets.add_points(&mut left, kinematics, system, axes, index);
    if LOADED && system.exact {
        meets.add_tension_of_loads(&mut left, loads, kappa, element.kappa_squared, axes);
    }
    if LOADED {
        meets.add_springs_of_loads(&mut left, loads, axes);
    }
    left.b = left.b.add(&Mat3::cross(sums.first_moment));
    left.c[0] += sums.stiffness;
    left.c[3] += sums.stiffness;
    left.c[5] += sums.stiffness;

    let (factor, repair) = meets.factorised(system, kappa, axes, index);
    let own_force = &system.curvature_force[index];
    let mut force = meets.force;
    for i in 0..D {
        force[i] += own_force[axes[i]];
    }
    let reduced = left.reduce(factor, &meets, own_force, axes);
    (Eliminated { reduced, force, psi, jacobian }, left, repair)
}
