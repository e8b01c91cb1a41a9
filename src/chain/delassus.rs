//! The Delassus operator of a strand, J H⁻¹ Jᵀ: how far its loaded material points move under forces at them.
//!
//! Columns go side by side in a vector register. Each takes one pass from its point to the root and one back, so a column costs
//! linear time.
//!
//! Symbols as in `elimination` and `response`: a unit force at a point leaves y on the free curvatures of the elements between it
//! and the root; ψ, ρ and δ are the motion that follows.

use super::axes::{axes, for_axes};
use super::elimination::{Eliminated, Elimination};
use super::load::Load;
use crate::math::lane::{Kernel, Lane};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
use crate::math::lanes::F64x2;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::{F64x4, F64x8, InstructionSet};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;

/// The Delassus operator of one strand over its loaded points, world axes, in Newton's linear model of the step.
#[derive(Debug, Clone, Default)]
pub struct Delassus {
    /// How many loaded points.
    pub material_points: usize,
    /// Column after column, three rows and three columns a point: entry `(3 j + b) * 3 * material_points + 3 i + a` is how far point i
    /// moves along axis a under a unit force along axis b at point j, m/N. Symmetric to the bit.
    pub columns: Vec<f64>,
    scratch: PassScratch,
}

/// y of every element, for each type of lanes.
#[derive(Debug, Clone, Default)]
struct PassScratch {
    #[cfg(target_arch = "x86_64")]
    eight: Vec<[F64x8; 3]>,
    #[cfg(target_arch = "x86_64")]
    four: Vec<[F64x4; 3]>,
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    two: Vec<[F64x2; 3]>,
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32")))]
    one: Vec<[f64; 3]>,
}

impl Delassus {
    /// Computes the operator over the `loads` (ordered from root to tip) of one lane's strand. Call it after
    /// [`Elimination::solve_loaded`] over the curvatures `axes` of the same kinematics.
    pub fn update<P: Lane>(
        &mut self,
        elimination: &Elimination<P>,
        kinematics: &Kinematics<P>,
        lane: usize,
        loads: &[Load<f64>],
        axes: &[usize],
    ) {
        self.material_points = loads.len();
        self.columns.resize(9 * loads.len() * loads.len(), 0.0);
        // Registers of any width give the same bits: columns do not depend on each other.
        #[cfg(target_arch = "x86_64")]
        {
            let set = InstructionSet::detected();
            if set >= InstructionSet::Avx512 && 3 * loads.len() > 4 {
                return update(&mut self.columns, elimination, kinematics, lane, loads, axes, &mut self.scratch.eight);
            }
            if set >= InstructionSet::Avx2 {
                return update(&mut self.columns, elimination, kinematics, lane, loads, axes, &mut self.scratch.four);
            }
        }
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
        update(&mut self.columns, elimination, kinematics, lane, loads, axes, &mut self.scratch.two);
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32")))]
        update(&mut self.columns, elimination, kinematics, lane, loads, axes, &mut self.scratch.one);
    }
}

fn update<P: Lane, T: Lane>(
    columns: &mut [f64],
    elimination: &Elimination<P>,
    kinematics: &Kinematics<P>,
    lane: usize,
    loads: &[Load<f64>],
    axes: &[usize],
    scratch: &mut Vec<[T; 3]>,
) {
    macro_rules! call {
        ($list:ident, $count:literal, $mask:literal) => {
            T::call(Columns::<_, _, $count, $mask> { done: &elimination.$list, kinematics, lane, loads, scratch, columns })
        };
    }
    for_axes!(axes, call);
    make_symmetric(columns, 3 * loads.len());
}

/// Makes the operator symmetric: an entry and its mirror image differ by rounding. Between two points the entry of the outer
/// point's force is kept; within one point's own block, the mean.
fn make_symmetric(columns: &mut [f64], size: usize) {
    for column in 0..size {
        let own = column - column % 3;
        for row in own..column {
            let mean = 0.5 * (columns[column * size + row] + columns[row * size + column]);
            (columns[column * size + row], columns[row * size + column]) = (mean, mean);
        }
        for row in 0..own {
            columns[column * size + row] = columns[row * size + column];
        }
    }
}

/// All columns, for the D free curvatures of MASK an element.
struct Columns<'a, P, T, const D: usize, const MASK: u32> {
    done: &'a [Eliminated<P, D>],
    kinematics: &'a Kinematics<P>,
    /// The strand's lane in the types P; the lanes of T are columns.
    lane: usize,
    loads: &'a [Load<f64>],
    scratch: &'a mut Vec<[T; 3]>,
    columns: &'a mut [f64],
}

#[inline(always)]
fn vector<P: Lane, T: Lane>(v: &Vec3<P>, lane: usize) -> Vec3<T> {
    Vec3::splat(v.lane(lane))
}

#[inline(always)]
fn matrix<P: Lane, T: Lane>(m: &Mat3<P>, lane: usize) -> Mat3<T> {
    let mut out = Mat3::zero();
    for i in 0..3 {
        for j in 0..3 {
            out.0[i][j] = T::splat(m.0[i][j].lane(lane));
        }
    }
    out
}

#[inline(always)]
fn select<T: Lane>(mask: T::Mask, yes: Vec3<T>, no: Vec3<T>) -> Vec3<T> {
    let mut out = no;
    for i in 0..3 {
        out.0[i] = T::select(mask, yes.0[i], no.0[i]);
    }
    out
}

impl<P: Lane, T: Lane, const D: usize, const MASK: u32> Kernel for Columns<'_, P, T, D, MASK> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { done, kinematics, lane: member, loads, scratch, columns } = self;
        let one = |value: &P| T::splat(value.lane(member));
        let axes = const { axes::<D>(MASK) };
        let (count, size) = (kinematics.elements.len(), 3 * loads.len());
        scratch.resize(count, [T::zero(); 3]);
        let mut first = 0;
        while first < size {
            // One column a lane; surplus lanes repeat the last column.
            let at = |lane: usize| (first + lane).min(size - 1);
            let load = |lane: usize| &loads[at(lane) / 3];
            let last = load(T::LANES - 1).element;
            // What a unit force does to its own element.
            let mut unit = Vec3::<T>::zero();
            let mut local = Vec3::<T>::zero();
            let mut own = [Vec3::<T>::zero(); D];
            for r in 0..3 {
                unit.0[r] =
                    T::from_lanes(|lane| kinematics.elements[load(lane).element].frame_left.0[at(lane) % 3][r].lane(member));
                local.0[r] = T::from_lanes(|lane| load(lane).local.0[r]);
                for i in 0..D {
                    own[i].0[r] = T::from_lanes(|lane| load(lane).jacobian.0[r][axes[i]]);
                }
            }
            // To the root: the moment about the left end of each element, and the force there.
            let (mut moment, mut force) = (Vec3::<T>::zero(), Vec3::<T>::zero());
            for index in (0..=last).rev() {
                let element = &kinematics.elements[index];
                let done = &done[count - 1 - index];
                let mut y = [T::zero(); 3];
                for i in 0..D {
                    y[i] =
                        vector::<P, T>(&done.psi[i], member).dot(moment) + vector::<P, T>(&done.jacobian[i], member).dot(force);
                }
                moment += vector::<P, T>(&element.end, member).cross(force);
                let mut begins = 0;
                for lane in 0..T::LANES {
                    begins |= u32::from(load(lane).element == index) << lane;
                }
                if begins != 0 {
                    let begins = T::mask(begins);
                    for i in 0..D {
                        y[i] = T::select(begins, own[i].dot(unit), y[i]);
                    }
                    moment = select(begins, local.cross(unit), moment);
                    force = select(begins, unit, force);
                }
                for i in 0..D {
                    for k in 0..i {
                        y[i] -= y[k] * one(&done.reduced.factor[i][k]);
                    }
                    y[i] = y[i] * one(&done.reduced.factor[i][i]);
                    let w: [T; 6] = std::array::from_fn(|column| one(&done.reduced.coupling[i][column]));
                    moment -= Vec3([w[0], w[1], w[2]]).scale(y[i]);
                    force -= Vec3([w[3], w[4], w[5]]).scale(y[i]);
                }
                scratch[index] = y;
                if index > 0 {
                    let turn = matrix::<P, T>(&kinematics.elements[index - 1].turn, member);
                    (moment, force) = (turn.apply(moment), turn.apply(force));
                }
            }
            // Back from the root, up to each column's own point: symmetry gives the entries farther out.
            let (mut psi, mut rho) = (Vec3::<T>::zero(), Vec3::<T>::zero());
            let mut material_point = 0;
            for index in 0..=last {
                let element = &kinematics.elements[index];
                let done = &done[count - 1 - index];
                let mut delta = scratch[index];
                for k in (0..D).rev() {
                    let w: [T; 6] = std::array::from_fn(|column| one(&done.reduced.coupling[k][column]));
                    let mut value = delta[k] - Vec3([w[0], w[1], w[2]]).dot(psi) - Vec3([w[3], w[4], w[5]]).dot(rho);
                    for later in k + 1..D {
                        value -= delta[later] * one(&done.reduced.factor[later][k]);
                    }
                    delta[k] = value * one(&done.reduced.factor[k][k]);
                }
                while 3 * material_point < first + T::LANES && loads.get(material_point).is_some_and(|load| load.element == index)
                {
                    let load = &loads[material_point];
                    let mut moved = rho - vector::<f64, T>(&load.local, 0).cross(psi);
                    for k in 0..D {
                        moved += vector::<f64, T>(&load.jacobian.column(axes[k]), 0).scale(delta[k]);
                    }
                    let moved = matrix::<P, T>(&element.frame_left, member).apply(moved);
                    for (a, moved) in moved.0.iter().enumerate() {
                        let column = &mut columns[(3 * material_point + a) * size..][..size];
                        for (lane, entry) in column[first..].iter_mut().take(T::LANES).enumerate() {
                            *entry = moved.lane(lane);
                        }
                    }
                    material_point += 1;
                }
                let (mut next_psi, mut next_rho) = (psi, rho - vector::<P, T>(&element.end, member).cross(psi));
                for k in 0..D {
                    next_psi += vector::<P, T>(&done.psi[k], member).scale(delta[k]);
                    next_rho += vector::<P, T>(&done.jacobian[k], member).scale(delta[k]);
                }
                let turn = matrix::<P, T>(&element.turn, member);
                psi = turn.apply_transposed(next_psi);
                rho = turn.apply_transposed(next_rho);
            }
            first += T::LANES;
        }
    }
}
