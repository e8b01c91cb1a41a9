//! What an element is to its left end: everything downstream, its own points and its loads, and what its free curvatures meet. Symbols are those
//! of [`super`].

use super::pivot::factorise;
use super::reduced::Reduced;
use crate::chain::load::Load;
use crate::chain::system::{ChainSystem, springs_of};
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, Kinematics};
use crate::rod::segment::{self, CurvatureForm};

/// The upper triangle of a symmetric 3×3 matrix: 00, 01, 02, 11, 12, 22.
pub(super) type Upper<T> = [T; 6];

#[inline(always)]
pub(super) fn full<T: Lane>(m: &Upper<T>) -> Mat3<T> {
    Mat3([[m[0], m[1], m[2]], [m[1], m[3], m[4]], [m[2], m[4], m[5]]])
}

/// turn·m·turnᵀ.
#[inline(always)]
pub(super) fn congruent<T: Lane>(turn: &Mat3<T>, m: &Upper<T>) -> Upper<T> {
    let (half, turn) = (turn.mul(&full(m)).0, &turn.0);
    let mut out = *m;
    for (slot, (i, j)) in PAIRS.into_iter().enumerate() {
        out[slot] = half[i][0] * turn[j][0] + half[i][1] * turn[j][1] + half[i][2] * turn[j][2];
    }
    out
}

/// The columns of the free curvatures, times a factor.
#[inline(always)]
pub(super) fn columns<T: Lane, const D: usize>(m: &Mat3<T>, axes: [usize; D], factor: T) -> [Vec3<T>; D] {
    let mut out = [Vec3::zero(); D];
    for i in 0..D {
        out[i] = m.column(axes[i]).scale(factor);
    }
    out
}

/// Rows and columns of an upper triangle.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// What lies downstream of a point of the strand, in the current axes. A and C are symmetric by construction: otherwise rounding
/// errors grow like a geometric series along the strand.
#[derive(Clone, Copy)]
pub(super) struct Downstream<T> {
    pub a: Upper<T>,
    pub b: Mat3<T>,
    pub c: Upper<T>,
    moment: Vec3<T>,
    force: Vec3<T>,
    whole_moment: Vec3<T>,
    whole_force: Vec3<T>,
    tension_moment: Vec3<T>,
    tension_force: Vec3<T>,
}

impl<T: Lane> Downstream<T> {
    #[inline(always)]
    pub fn nothing() -> Self {
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
    pub fn turned(&self, turn: &Mat3<T>) -> Self {
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

/// What an element's free curvatures meet: their quadratic form with the left end, and what pulls at them.
pub(super) struct Meets<T, const D: usize> {
    /// The curvatures' own part, lower triangle.
    kk: [[T; D]; D],
    /// Their coupling to ψ and ρ of the left end.
    psi_k: [Vec3<T>; D],
    rho_k: [Vec3<T>; D],
    /// What pulls at them with all downstream eliminated, and without.
    reduced: [T; D],
    pub force: [T; D],
    /// The geometric part, of second derivatives.
    form: CurvatureForm<T>,
}

/// What the points of an element are to its left end and that is added after the loads.
pub(super) struct PointSums<T> {
    pub stiffness: T,
    pub first_moment: Vec3<T>,
}

impl<T: Lane> Downstream<T> {
    /// What is downstream of an element's right end, to its left end, and through its free curvatures: Y = P (Ψ; J), and its couplings.
    #[inline(always)]
    pub fn through<const D: usize>(
        &self,
        element: &ElementState<T>,
        psi: &[Vec3<T>; D],
        jacobian: &[Vec3<T>; D],
        exact: bool,
    ) -> (Self, Meets<T, D>) {
        let (kappa, length, end) = (element.kappa, element.length, element.end);
        let (whole_a, whole_c) = (full(&self.a), full(&self.c));
        let mut left = self.moved(end);
        let mut kk = [[T::zero(); D]; D];
        let mut psi_k = [Vec3::zero(); D];
        let mut rho_k = [Vec3::zero(); D];
        let mut reduced = [T::zero(); D];
        let mut force = [T::zero(); D];
        for i in 0..D {
            let y_psi = whole_a.apply(psi[i]) + self.b.apply(jacobian[i]);
            let y_rho = self.b.apply_transposed(psi[i]) + whole_c.apply(jacobian[i]);
            for k in 0..=i {
                kk[i][k] = psi[k].dot(y_psi) + jacobian[k].dot(y_rho);
            }
            psi_k[i] = y_psi + end.cross(y_rho);
            rho_k[i] = y_rho;
            reduced[i] = psi[i].dot(self.moment) + jacobian[i].dot(self.force);
            force[i] = psi[i].dot(self.whole_moment) + jacobian[i].dot(self.whole_force);
        }
        let mut form = CurvatureForm::zero();
        if exact {
            let (f, m) = (self.tension_force, self.tension_moment);
            left.add_tension(f, end);
            let half_moment = m.scale(T::splat(0.5));
            for i in 0..D {
                psi_k[i] += f.cross(jacobian[i]) + half_moment.cross(psi[i]);
            }
            form.subtract_force(f, kappa, length, element.kappa_squared, &element.c);
            form.subtract_moment(m, kappa, length, element.kappa_squared, &element.c);
        }
        (left, Meets { kk, psi_k, rho_k, reduced, force, form })
    }

    /// Takes an element's freedoms out: their reduced form, and Schur's complement on the left end.
    #[inline(always)]
    pub fn reduce<const D: usize>(
        &mut self,
        factor: [[T; D]; D],
        meets: &Meets<T, D>,
        own_force: &[T; 3],
        axes: [usize; D],
    ) -> Reduced<T, D> {
        let mut pull = meets.reduced;
        for i in 0..D {
            pull[i] += own_force[axes[i]];
        }
        let done = Reduced::new(factor, &meets.psi_k, &meets.rho_k, &pull, [true; D]);
        for i in 0..D {
            let w = &done.coupling[i];
            let y = done.force[i];
            self.a[0] -= w[0] * w[0];
            self.a[1] -= w[0] * w[1];
            self.a[2] -= w[0] * w[2];
            self.a[3] -= w[1] * w[1];
            self.a[4] -= w[1] * w[2];
            self.a[5] -= w[2] * w[2];
            self.c[0] -= w[3] * w[3];
            self.c[1] -= w[3] * w[4];
            self.c[2] -= w[3] * w[5];
            self.c[3] -= w[4] * w[4];
            self.c[4] -= w[4] * w[5];
            self.c[5] -= w[5] * w[5];
            for row in 0..3 {
                for column in 0..3 {
                    self.b.0[row][column] -= w[row] * w[column + 3];
                }
                self.moment.0[row] -= w[row] * y;
                self.force.0[row] -= w[row + 3] * y;
            }
        }
        done
    }
}

impl<T: Lane, const D: usize> Meets<T, D> {
    /// The element's own points: their springs, forces and tension.
    #[inline(always)]
    pub fn add_points(
        &mut self,
        left: &mut Downstream<T>,
        kinematics: &Kinematics<T>,
        system: &ChainSystem<T>,
        axes: [usize; D],
        index: usize,
    ) -> PointSums<T> {
        let element = &kinematics.elements[index];
        let kappa = element.kappa;
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
            // What a rotation of the left end meets: the spring's pull, k x × J, and the tension's, f × J.
            let mut meets = kx;
            if system.exact {
                let f = element.frame_left.apply_transposed(system.tension(p));
                left.add_tension(f, x);
                meets += f;
                self.form.subtract_force(f, kappa, s, element.kappa_squared, &point.c);
                left.tension_moment += x.cross(f);
                left.tension_force += f;
            }
            for spring in springs_of(p, system.point_stiffness.len(), system.normals.len()) {
                let stiffness = system.normal_stiffness[spring];
                if T::any(T::zero().less(stiffness * stiffness)) {
                    self.add_normal_spring(left, element.frame_left.apply_transposed(system.normals[spring]), stiffness, x, &j);
                }
            }
            for i in 0..D {
                let kj = j[i].scale(stiffness);
                self.rho_k[i] += kj;
                for k in 0..=i {
                    self.kk[i][k] += j[k].dot(kj);
                }
                self.psi_k[i] += meets.cross(j[i]);
                let jf = j[i].dot(f);
                self.reduced[i] += jf;
                self.force[i] += jf;
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
        PointSums { stiffness: stiffness_sum, first_moment }
    }

    /// A spring along the unit normal n on a point at x: n·δr = n·ρ + (x×n)·ψ + (Jᵀn)·δκ.
    #[inline(always)]
    fn add_normal_spring(&mut self, left: &mut Downstream<T>, n: Vec3<T>, stiffness: T, x: Vec3<T>, j: &[Vec3<T>; D]) {
        let m = x.cross(n);
        let (km, kn) = (m.scale(stiffness), n.scale(stiffness));
        for (slot, (row, column)) in PAIRS.into_iter().enumerate() {
            left.a[slot] += km.0[row] * m.0[column];
            left.c[slot] += kn.0[row] * n.0[column];
        }
        for row in 0..3 {
            for column in 0..3 {
                left.b.0[row][column] += km.0[row] * n.0[column];
            }
        }
        for i in 0..D {
            let along = j[i].dot(n);
            self.rho_k[i] += kn.scale(along);
            self.psi_k[i] += km.scale(along);
            for k in 0..=i {
                self.kk[i][k] += stiffness * along * j[k].dot(n);
            }
        }
    }

    /// The tension of loads, each as a point without stiffness; a lever is a rigid piece downstream of its place, whose force has a moment there.
    #[inline(always)]
    pub fn add_tension_of_loads(
        &mut self,
        left: &mut Downstream<T>,
        loads: &[Load<T>],
        kappa: Vec3<T>,
        kappa_squared: T,
        axes: [usize; D],
    ) {
        for load in loads {
            let (f, x) = (load.tension, load.local);
            let j = columns(&load.jacobian, axes, T::one());
            left.add_tension(f, x);
            left.tension_moment += x.cross(f);
            left.tension_force += f;
            self.form.subtract_force(f, kappa, load.s, kappa_squared, &load.c);
            for i in 0..D {
                self.psi_k[i] += f.cross(j[i]);
            }
            if let Some(turning) = &load.turning {
                let (turning, l) = (columns(turning, axes, T::one()), load.lever);
                let (half, along) = (T::splat(0.5), f.dot(l));
                for i in 0..D {
                    for k in 0..=i {
                        let swing = f.dot(turning[i]) * l.dot(turning[k]) + f.dot(turning[k]) * l.dot(turning[i]);
                        self.kk[i][k] += along * turning[i].dot(turning[k]) - half * swing;
                    }
                }
                self.form.subtract_moment(l.cross(f), kappa, load.s, kappa_squared, &load.c);
            }
        }
    }

    /// The springs of loads: δr = ρ + Sᵀψ + J δκ, S = `[x]×`; A gains S K Sᵀ, B gains S K.
    #[inline(always)]
    pub fn add_springs_of_loads(&mut self, left: &mut Downstream<T>, loads: &[Load<T>], axes: [usize; D]) {
        for load in loads {
            let Some(k) = &load.stiffness else { continue };
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
                self.rho_k[i] += kj;
                self.psi_k[i] += x.cross(kj);
                for l in 0..=i {
                    self.kk[i][l] += j[l].dot(kj);
                }
            }
        }
    }

    /// The factor of the free curvatures' pivot, and in which lanes it was repaired.
    #[inline(always)]
    pub fn factorised(&self, system: &ChainSystem<T>, kappa: Vec3<T>, axes: [usize; D], index: usize) -> ([[T; D]; D], T) {
        let own_stiffness = &system.curvature_stiffness[index];
        let mut pivot = self.kk;
        if system.exact {
            let form = self.form.matrix(kappa).0;
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
        factorise(&pivot, smallest)
    }
}
