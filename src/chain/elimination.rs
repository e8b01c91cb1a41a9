//! The linear-time solve: elimination from tip to root, then one pass from root to tip (`docs/theory/mathematics.md`). It is
//! Featherstone's recursion for flexible segments (Bertails 2009).
//!
//! Every quantity of a segment is in the axes of its left end. Symbols: u = (ψ, ρ) is the rotation and displacement of the left
//! end, δκ the change of curvatures. The right end turns by ψ + Ψδκ and moves by ρ + ψ×a + Jδκ, where a is its position. What
//! lies downstream acts on the right end as a quadratic ½ uᵀPu − pᵀu, `P = [A B; Bᵀ C]`; F and M are the sum of the forces
//! downstream and their moment about the right end. A point with stiffness k and force f at x moves by ρ + ψ×x + J_x δκ. The
//! exact Hessian adds tension: the second variations of x and of the right end, weighted by −f, −F, −M.

use super::axes::{axes, for_axes};
use super::load::Load;
use super::pivot::factorise;
use super::system::{ChainSystem, Direction, LinearSolve};
use crate::math::lane::{Kernel, Lane};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;
use crate::rod::segment::{self, CurvatureForm};

/// What the second pass needs from an element with D free curvatures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Eliminated<T, const D: usize> {
    /// Cholesky factor of the pivot, diagonal inverted.
    pub factor: [[T; D]; D],
    /// Factor⁻¹ × coupling to u: rows are freedoms, columns ψ then ρ.
    pub coupling: [[T; 6]; D],
    /// Factor⁻¹ × reduced force.
    pub reduced: [T; D],
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

/// The upper triangle of a symmetric 3×3 matrix: 00, 01, 02, 11, 12, 22.
type Upper<T> = [T; 6];

#[inline(always)]
fn full<T: Lane>(m: &Upper<T>) -> Mat3<T> {
    Mat3([[m[0], m[1], m[2]], [m[1], m[3], m[4]], [m[2], m[4], m[5]]])
}

/// turn·m·turnᵀ.
#[inline(always)]
fn congruent<T: Lane>(turn: &Mat3<T>, m: &Upper<T>) -> Upper<T> {
    let (half, turn) = (turn.mul(&full(m)).0, &turn.0);
    let mut out = *m;
    for (slot, (i, j)) in PAIRS.into_iter().enumerate() {
        out[slot] = half[i][0] * turn[j][0] + half[i][1] * turn[j][1] + half[i][2] * turn[j][2];
    }
    out
}

/// The columns of the free curvatures, times a factor.
#[inline(always)]
fn columns<T: Lane, const D: usize>(m: &Mat3<T>, axes: [usize; D], factor: T) -> [Vec3<T>; D] {
    let mut out = [Vec3::zero(); D];
    for i in 0..D {
        out[i] = m.column(axes[i]).scale(factor);
    }
    out
}

/// Rows and columns of an upper triangle.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// What lies downstream of a point of the strand, in the current axes. A and C are symmetric by construction: otherwise rounding
/// errors grow like a geometric series along the strand.
#[derive(Clone, Copy)]
struct Downstream<T> {
    a: Upper<T>,
    b: Mat3<T>,
    c: Upper<T>,
    moment: Vec3<T>,
    force: Vec3<T>,
    whole_moment: Vec3<T>,
    whole_force: Vec3<T>,
    tension_moment: Vec3<T>,
    tension_force: Vec3<T>,
}

impl<T: Lane> Downstream<T> {
    #[inline(always)]
    fn nothing() -> Self {
        Self {
            a: [T::zero(); 6],
            b: Mat3::zero(),
            c: [T::zero(); 6],
            moment: Vec3::zero(),
            force: Vec3::zero(),
            whole_moment: Vec3::zero(),
            whole_force: Vec3::zero(),
            tension_moment: Vec3::zero(),
            tension_force: Vec3::zero(),
        }
    }

    /// The same in other axes: `turn` takes the new axes to the current ones.
    #[inline(always)]
    fn turned(&self, turn: &Mat3<T>) -> Self {
        Self {
            a: congruent(turn, &self.a),
            b: turn.mul(&self.b).mul_transposed(turn),
            c: congruent(turn, &self.c),
            moment: turn.apply(self.moment),
            force: turn.apply(self.force),
            whole_moment: turn.apply(self.whole_moment),
            whole_force: turn.apply(self.whole_force),
            tension_moment: turn.apply(self.tension_moment),
            tension_force: turn.apply(self.tension_force),
        }
    }

    /// The same as seen from a point at −x: A gains −BS + SBᵀ − SCS, B gains SC, moments gain x × force, with `S = [x]×`.
    #[inline(always)]
    fn moved(&self, x: Vec3<T>) -> Self {
        let sc = full(&self.c).crossed_from_left(x);
        let b = self.b.add(&sc);
        // M·S = ([S]ᵀMᵀ)ᵀ = −(S Mᵀ)ᵀ.
        let s_bt = self.b.transpose().crossed_from_left(x);
        let s_sct = sc.transpose().crossed_from_left(x);
        let mut a = self.a;
        let half = T::splat(0.5);
        for (slot, (i, j)) in PAIRS.into_iter().enumerate() {
            a[slot] += s_bt.0[i][j] + s_bt.0[j][i] + (s_sct.0[i][j] + s_sct.0[j][i]) * half;
        }
        Self {
            a,
            b,
            c: self.c,
            moment: self.moment + x.cross(self.force),
            force: self.force,
            whole_moment: self.whole_moment + x.cross(self.whole_force),
            whole_force: self.whole_force,
            tension_moment: self.tension_moment + x.cross(self.tension_force),
            tension_force: self.tension_force,
        }
    }

    /// Adds −sym(f xᵀ) + (f·x) I to A: the tension of force f at position x.
    #[inline(always)]
    fn add_tension(&mut self, f: Vec3<T>, x: Vec3<T>) {
        let half = T::splat(0.5);
        let dot = f.dot(x);
        let sym = |i: usize, j: usize| (f.0[i] * x.0[j] + f.0[j] * x.0[i]) * half;
        self.a[0] += dot - sym(0, 0);
        self.a[1] -= sym(0, 1);
        self.a[2] -= sym(0, 2);
        self.a[3] += dot - sym(1, 1);
        self.a[4] -= sym(1, 2);
        self.a[5] += dot - sym(2, 2);
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
    let (mut psi, mut rho) = (Vec3::<T>::zero(), Vec3::<T>::zero());
    let (mut descent, mut rotation_squared, mut rotation_sum) = (T::zero(), T::zero(), T::zero());
    for (index, element) in kinematics.elements.iter().enumerate() {
        let done = &scratch[count - 1 - index];
        let mut delta = [T::zero(); D];
        for i in (0..D).rev() {
            let mut value = done.reduced[i];
            for axis in 0..3 {
                value -= done.coupling[i][axis] * psi.0[axis] + done.coupling[i][axis + 3] * rho.0[axis];
            }
            for k in i + 1..D {
                value -= done.factor[k][i] * delta[k];
            }
            delta[i] = value * done.factor[i][i];
            descent += delta[i] * done.force[i];
            change[index][axes[i]] = delta[i];
        }
        let (mut next_psi, mut next_rho) = (psi, rho + psi.cross(element.end));
        for i in 0..D {
            next_psi += done.psi[i].scale(delta[i]);
            next_rho += done.jacobian[i].scale(delta[i]);
        }
        let turned = next_psi.norm_squared();
        rotation_squared = rotation_squared.larger(turned);
        rotation_sum += turned;
        psi = element.turn.apply_transposed(next_psi);
        rho = element.turn.apply_transposed(next_rho);
    }
    Direction { descent, rotation_squared, rotation_sum, repaired, condition: 0.0 }
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
    let (kappa, length, end) = (element.kappa, element.length, element.end);
    let theta = kappa.scale(length);
    let z = element.kappa_squared * (length * length);
    let psi = columns(&segment::mean_frame(theta, z, &element.c), axes, length);
    let jacobian = columns(&segment::chord_gradient(theta, z, &element.c), axes, length * length);

    // Everything downstream, through δκ: Y = P (Ψ; J), and its couplings, column by column of the free curvatures.
    let (whole_a, whole_c) = (full(&right.a), full(&right.c));
    let mut left = right.moved(end);
    let mut kk = [[T::zero(); D]; D];
    let mut psi_k = [Vec3::zero(); D];
    let mut rho_k = [Vec3::zero(); D];
    let mut reduced = [T::zero(); D];
    let mut force = [T::zero(); D];
    for i in 0..D {
        let y_psi = whole_a.apply(psi[i]) + right.b.apply(jacobian[i]);
        let y_rho = right.b.apply_transposed(psi[i]) + whole_c.apply(jacobian[i]);
        for k in 0..=i {
            kk[i][k] = psi[k].dot(y_psi) + jacobian[k].dot(y_rho);
        }
        psi_k[i] = y_psi + end.cross(y_rho);
        rho_k[i] = y_rho;
        reduced[i] = psi[i].dot(right.moment) + jacobian[i].dot(right.force);
        force[i] = psi[i].dot(right.whole_moment) + jacobian[i].dot(right.whole_force);
    }
    let mut form = CurvatureForm::zero();
    if system.exact {
        let (f, m) = (right.tension_force, right.tension_moment);
        left.add_tension(f, end);
        let half_moment = m.scale(T::splat(0.5));
        for i in 0..D {
            psi_k[i] += f.cross(jacobian[i]) + half_moment.cross(psi[i]);
        }
        form.subtract_force(f, kappa, length, element.kappa_squared, &element.c);
        form.subtract_moment(m, kappa, length, element.kappa_squared, &element.c);
    }

    // The element's own points.
    let per_element = kinematics.points_per_element;
    let first = index * per_element;
    let mut stiffness_sum = T::zero();
    let mut first_moment = Vec3::zero();
    let mut own = [T::zero(); 6];
    for p in first..first + per_element {
        let point = &kinematics.points[p];
        let stiffness = system.point_stiffness[p];
        let x = point.local;
        let s = point.s;
        let j = segment::chord_gradient(kappa.scale(s), element.kappa_squared * (s * s), &point.c);
        let j = columns(&j, axes, s * s);
        let f = element.frame_left.apply_transposed(system.point_force[p]);
        stiffness_sum += stiffness;
        let kx = x.scale(stiffness);
        first_moment += kx;
        let k_xx = kx.dot(x);
        own[0] += k_xx - kx.0[0] * x.0[0];
        own[1] -= kx.0[0] * x.0[1];
        own[2] -= kx.0[0] * x.0[2];
        own[3] += k_xx - kx.0[1] * x.0[1];
        own[4] -= kx.0[1] * x.0[2];
        own[5] += k_xx - kx.0[2] * x.0[2];
        // What resists a rotation of the left end: the spring's pull, k x × J, and the tension's, f × J.
        let mut meets = kx;
        if system.exact {
            let f = element.frame_left.apply_transposed(system.tension(p));
            left.add_tension(f, x);
            meets += f;
            form.subtract_force(f, kappa, s, element.kappa_squared, &point.c);
            left.tension_moment += x.cross(f);
            left.tension_force += f;
        }
        for i in 0..D {
            let kj = j[i].scale(stiffness);
            rho_k[i] += kj;
            for k in 0..=i {
                kk[i][k] += j[k].dot(kj);
            }
            psi_k[i] += meets.cross(j[i]);
            let jf = j[i].dot(f);
            reduced[i] += jf;
            force[i] += jf;
        }
        let xf = x.cross(f);
        left.moment += xf;
        left.force += f;
        left.whole_moment += xf;
        left.whole_force += f;
    }
    for slot in 0..6 {
        left.a[slot] += own[slot];
    }
    if LOADED && system.exact {
        for load in loads {
            // Like a point without stiffness. A lever is a rigid piece downstream of its material point; the force has a moment
            // about that point.
            let (f, x) = (load.tension, load.local);
            let j = columns(&load.jacobian, axes, T::one());
            left.add_tension(f, x);
            left.tension_moment += x.cross(f);
            left.tension_force += f;
            form.subtract_force(f, kappa, load.s, element.kappa_squared, &load.c);
            for i in 0..D {
                psi_k[i] += f.cross(j[i]);
            }
            if let Some(turning) = &load.turning {
                let (turning, l) = (columns(turning, axes, T::one()), load.lever);
                let (half, along) = (T::splat(0.5), f.dot(l));
                for i in 0..D {
                    for k in 0..=i {
                        let swing = f.dot(turning[i]) * l.dot(turning[k]) + f.dot(turning[k]) * l.dot(turning[i]);
                        kk[i][k] += along * turning[i].dot(turning[k]) - half * swing;
                    }
                }
                form.subtract_moment(l.cross(f), kappa, load.s, element.kappa_squared, &load.c);
            }
        }
    }
    if LOADED {
        for load in loads {
            let Some(k) = &load.stiffness else { continue };
            // δr = ρ + Sᵀψ + J δκ, S = [x]×: A gains S K Sᵀ, B gains S K.
            let (x, j) = (load.local, columns(&load.jacobian, axes, T::one()));
            let sk = k.crossed_from_left(x);
            let sks = sk.transpose().crossed_from_left(x);
            for (slot, (row, column)) in PAIRS.into_iter().enumerate() {
                left.a[slot] += (sks.0[row][column] + sks.0[column][row]) * T::splat(0.5);
                left.c[slot] += k.0[row][column];
            }
            left.b = left.b.add(&sk);
            for i in 0..D {
                let kj = k.apply(j[i]);
                rho_k[i] += kj;
                psi_k[i] += x.cross(kj);
                for l in 0..=i {
                    kk[i][l] += j[l].dot(kj);
                }
            }
        }
    }
    left.b = left.b.add(&Mat3::cross(first_moment));
    left.c[0] += stiffness_sum;
    left.c[3] += stiffness_sum;
    left.c[5] += stiffness_sum;

    // The pivot of the free curvatures.
    let own_stiffness = &system.curvature_stiffness[index];
    let own_force = &system.curvature_force[index];
    let mut pivot = kk;
    if system.exact {
        let form = form.matrix(kappa).0;
        for i in 0..D {
            for k in 0..=i {
                pivot[i][k] += form[axes[i]][axes[k]];
            }
        }
    }
    let mut smallest = own_stiffness[axes[0]];
    for i in 0..D {
        let stiffness = own_stiffness[axes[i]];
        pivot[i][i] += stiffness;
        for k in 0..i {
            pivot[k][i] = pivot[i][k];
        }
        smallest = T::select(stiffness.less(smallest), stiffness, smallest);
    }
    let (factor, repair) = factorise(&pivot, smallest);

    let mut done = Eliminated { factor, coupling: [[T::zero(); 6]; D], reduced: [T::zero(); D], force, psi, jacobian };
    for i in 0..D {
        done.force[i] += own_force[axes[i]];
        let ([a, b, c], [d, e, f]) = (psi_k[i].0, rho_k[i].0);
        let mut row = [a, b, c, d, e, f];
        let mut value = reduced[i] + own_force[axes[i]];
        for k in 0..i {
            for column in 0..6 {
                row[column] -= factor[i][k] * done.coupling[k][column];
            }
            value -= factor[i][k] * done.reduced[k];
        }
        for column in 0..6 {
            done.coupling[i][column] = row[column] * factor[i][i];
        }
        done.reduced[i] = value * factor[i][i];
    }
    // Schur's complement on the left end.
    for i in 0..D {
        let w = &done.coupling[i];
        let y = done.reduced[i];
        left.a[0] -= w[0] * w[0];
        left.a[1] -= w[0] * w[1];
        left.a[2] -= w[0] * w[2];
        left.a[3] -= w[1] * w[1];
        left.a[4] -= w[1] * w[2];
        left.a[5] -= w[2] * w[2];
        left.c[0] -= w[3] * w[3];
        left.c[1] -= w[3] * w[4];
        left.c[2] -= w[3] * w[5];
        left.c[3] -= w[4] * w[4];
        left.c[4] -= w[4] * w[5];
        left.c[5] -= w[5] * w[5];
        for row in 0..3 {
            for column in 0..3 {
                left.b.0[row][column] -= w[row] * w[column + 3];
            }
            left.moment.0[row] -= w[row] * y;
            left.force.0[row] -= w[row + 3] * y;
        }
    }
    (done, left, repair)
}
