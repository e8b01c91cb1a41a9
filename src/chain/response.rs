//! The direction that forces at material points add to an eliminated system: one pass from the points to the root and one back,
//! in linear time.
//!
//! Symbols as in `elimination`: u = (ψ, ρ); y is the part of the forces that acts on an element's free curvatures once everything
//! downstream is eliminated, L y = JᵀF + ΨᵀM − …; δκ = L⁻ᵀ(y − W u).

use super::axes::{axes, for_axes};
use super::elimination::{Eliminated, Elimination, Walk};
use super::load::Load;
use super::system::Direction;
use crate::math::lane::{Kernel, Lane};
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;

/// Scratch memory of the passes, kept between calls.
#[derive(Debug, Clone)]
pub struct ResponseScratch<T> {
    left_over: Vec<[T; 3]>,
}

impl<T> Default for ResponseScratch<T> {
    fn default() -> Self {
        Self { left_over: Vec::new() }
    }
}

impl<T: Lane> Elimination<T> {
    /// Newton's direction with the forces `forces` (world axes, N) at the points of `loads`. Call it after
    /// [`Elimination::solve_loaded`]. Also gives how far each point moves along it.
    #[allow(clippy::too_many_arguments, reason = "a kernel's operands")]
    pub fn direction(
        &self,
        kinematics: &Kinematics<T>,
        loads: &[Load<T>],
        forces: &[Vec3<T>],
        axes: &[usize],
        scratch: &mut ResponseScratch<T>,
        change: &mut Vec<[T; 3]>,
        moved: &mut Vec<Vec3<T>>,
    ) -> Direction<T> {
        let (scratch, out) = (&mut scratch.left_over, (change, moved));
        macro_rules! call {
            ($list:ident, $count:literal, $mask:literal) => {
                T::call(Towards::<_, $count, $mask> { done: &self.$list, kinematics, loads, forces, scratch, out })
            };
        }
        for_axes!(axes, call)
    }
}

/// The free columns of a loaded point's J.
#[inline(always)]
fn free_columns<T: Lane, const D: usize>(load: &Load<T>, axes: [usize; D]) -> [Vec3<T>; D] {
    let mut out = [Vec3::zero(); D];
    for i in 0..D {
        out[i] = load.jacobian.column(axes[i]);
    }
    out
}

/// [`Elimination::direction`] for the D free curvatures of MASK.
struct Towards<'a, T, const D: usize, const MASK: u32> {
    done: &'a [Eliminated<T, D>],
    kinematics: &'a Kinematics<T>,
    loads: &'a [Load<T>],
    forces: &'a [Vec3<T>],
    scratch: &'a mut Vec<[T; 3]>,
    out: (&'a mut Vec<[T; 3]>, &'a mut Vec<Vec3<T>>),
}

impl<T: Lane, const D: usize, const MASK: u32> Kernel for Towards<'_, T, D, MASK> {
    type Output = Direction<T>;
    #[inline(always)]
    fn run(self) -> Direction<T> {
        direction(self.done, self.kinematics, self.loads, self.forces, const { axes::<D>(MASK) }, self.scratch, self.out)
    }
}

#[inline(always)]
fn direction<T: Lane, const D: usize>(
    eliminated: &[Eliminated<T, D>],
    kinematics: &Kinematics<T>,
    loads: &[Load<T>],
    forces: &[Vec3<T>],
    axes: [usize; D],
    left_over: &mut Vec<[T; 3]>,
    (change, moved): (&mut Vec<[T; 3]>, &mut Vec<Vec3<T>>),
) -> Direction<T> {
    let count = kinematics.elements.len();
    left_over.clear();
    left_over.resize(count, [T::zero(); 3]);
    let (mut moment, mut force) = (Vec3::<T>::zero(), Vec3::<T>::zero());
    let mut next = loads.len();
    // Beyond the last point with a force there is nothing to do.
    let acts = |force: &Vec3<T>| (0..T::LANES).any(|lane| force.0.iter().any(|part| part.lane(lane) != 0.0));
    let reach = forces.iter().rposition(acts).map_or(0, |last| loads[last].element + 1);
    while next > 0 && loads[next - 1].element >= reach {
        next -= 1;
    }
    for index in (0..reach).rev() {
        let element = &kinematics.elements[index];
        let done = &eliminated[count - 1 - index];
        let y = &mut left_over[index];
        for i in 0..D {
            y[i] = done.psi[i].dot(moment) + done.jacobian[i].dot(force);
        }
        moment += element.end.cross(force);
        while next > 0 && loads[next - 1].element == index {
            next -= 1;
            let f = element.frame_left.apply_transposed(forces[next]);
            let columns = free_columns(&loads[next], axes);
            for i in 0..D {
                y[i] += columns[i].dot(f);
            }
            moment += loads[next].local.cross(f);
            force += f;
        }
        for i in 0..D {
            for k in 0..i {
                y[i] -= y[k] * done.reduced.factor[i][k];
            }
            y[i] = y[i] * done.reduced.factor[i][i];
            let w = &done.reduced.coupling[i];
            moment -= Vec3([w[0], w[1], w[2]]).scale(y[i]);
            force -= Vec3([w[3], w[4], w[5]]).scale(y[i]);
        }
        if index > 0 {
            let turn = &kinematics.elements[index - 1].turn;
            (moment, force) = (turn.apply(moment), turn.apply(force));
        }
    }
    change.clear();
    change.resize(count, [T::zero(); 3]);
    moved.clear();
    let mut walk = Walk::from_root();
    let mut descent = T::zero();
    for index in 0..count {
        let element = &kinematics.elements[index];
        let done = &eliminated[count - 1 - index];
        let (psi, rho) = (walk.psi, walk.rho);
        let delta = done.reduced.substituted(|i| {
            let w = &done.reduced.coupling[i];
            done.reduced.force[i] + left_over[index][i] - Vec3([w[0], w[1], w[2]]).dot(psi) - Vec3([w[3], w[4], w[5]]).dot(rho)
        });
        for i in (0..D).rev() {
            descent += delta[i] * done.force[i];
            change[index][axes[i]] = delta[i];
        }
        while let Some(load) = loads.get(moved.len()).filter(|load| load.element == index) {
            let displacement = element.frame_left.apply(load.moved(psi, rho, Vec3(change[index])));
            descent += displacement.dot(forces[moved.len()]);
            moved.push(displacement);
        }
        walk.pass(element, done, &delta);
    }
    walk.direction(descent, T::zero())
}
