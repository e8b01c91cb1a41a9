//! The linearised least squares of one strand: residuals at the samples, and the Levenberg–Marquardt step in linear time.
//!
//! The unknowns are the curvatures and the right node of each element, and the root's tilt. Elements are eliminated from tip to
//! root as in [`crate::chain::elimination`], with its symbols. In addition there are the nodes: moving the node at b between
//! elements of curvatures κ and κ′ by δb, at fixed arclengths of everything else, turns everything beyond it by R(b)(κ − κ′)δb
//! about it, like a hinge.

use super::measure::{angle_to, frame_at};
use super::samples::Sample;
use super::shape::Shape;
use crate::chain::downstream::Downstream;
use crate::chain::elimination::pivot::cholesky;
use crate::chain::elimination::reduced::Reduced;
use crate::math::functions::entire::Stumpff;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, element_state};
use crate::rod::segment;

/// Weights against distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// ∫ (κ0 L)² ds against the mean squared distance over L².
    pub twist: f64,
    /// Squared angles between n1 and the samples' normals, rad², against the same.
    pub normal: f64,
    /// (ℓ − L/N)² (N/L)² per node, against the same.
    pub spacing: f64,
}

/// What may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Freedom {
    /// The root's direction.
    pub root: bool,
    /// The elements' twist.
    pub twist: bool,
    /// The nodes between elements.
    pub nodes: bool,
}

/// A sample and its material point.
#[derive(Debug, Clone, Copy)]
struct Placed {
    /// Arclength from the element's left end.
    s: f64,
    c: Stumpff<f64>,
    /// From the element's left end, its axes.
    local: Vec3<f64>,
    /// Target minus position, the element's axes.
    off: Vec3<f64>,
    weight: f64,
    /// Tangent (the element's axes), and the angle about it from n1 to the wanted normal.
    normal: Option<(Vec3<f64>, f64)>,
}

/// A strand at its samples.
#[derive(Debug, Default)]
pub(super) struct State {
    elements: Vec<ElementState<f64>>,
    placed: Vec<Placed>,
    /// First sample of each element, and the number of samples.
    first: Vec<usize>,
    /// Weighted mean of the squared distances.
    pub distance: f64,
    /// The other terms, without their weights.
    twist: f64,
    angles: f64,
    spacing: f64,
    /// The total cost.
    pub cost: f64,
}

impl State {
    /// Evaluates the strand at samples, which must ascend in arclength.
    pub fn place(&mut self, shape: &Shape, samples: &[Sample], weights: &Weights) {
        self.elements.clear();
        self.placed.clear();
        self.first.clear();
        let (mut frame, mut origin) = (shape.root.0, Vec3::<f64>::zero());
        let count = shape.rows.len();
        let (mut next, mut distance, mut angles, mut twist, mut spacing) = (0, 0.0, 0.0, 0.0, 0.0);
        for (index, row) in shape.rows.iter().enumerate() {
            let (left, right) = (shape.nodes[index], shape.nodes[index + 1]);
            let element = element_state(Vec3(*row), right - left, frame, origin);
            self.first.push(next);
            while next < samples.len() && (samples[next].arclength <= right || index + 1 == count) {
                let sample = &samples[next];
                let point = element.point(sample.arclength - left);
                let off = sample.target - point.position;
                distance += sample.weight * off.norm_squared();
                let normal = sample.normal.map(|wanted| {
                    let here = frame_at(&element, &point);
                    let angle = angle_to(wanted, &element, &here);
                    angles += sample.weight * angle * angle;
                    (here.column(0), angle)
                });
                self.placed.push(Placed {
                    s: point.s,
                    c: point.c,
                    local: point.local,
                    off: element.frame_left.apply_transposed(off),
                    weight: sample.weight,
                    normal,
                });
                next += 1;
            }
            twist += row[0] * row[0] * (right - left);
            let stretch = (right - left) * count as f64 - 1.0;
            spacing += stretch * stretch;
            (frame, origin) = (element.frame_right(), element.origin_right());
            self.elements.push(element);
        }
        self.first.push(next);
        (self.distance, self.twist, self.angles, self.spacing) = (distance, twist, angles, spacing);
        self.weigh(weights);
    }

    /// The squared distances of the samples.
    pub fn squared_distances(&self) -> impl Iterator<Item = f64> + '_ {
        self.placed.iter().map(|placed| placed.off.norm_squared())
    }

    /// Changes the weights.
    pub fn weigh(&mut self, weights: &Weights) {
        let others = weights.normal * self.angles + weights.twist * self.twist + weights.spacing * self.spacing;
        self.cost = self.distance + others;
    }
}

/// What the pass from root to tip needs of an element.
#[derive(Clone, Copy)]
struct Eliminated<const D: usize> {
    reduced: Reduced<f64, D>,
    psi: [Vec3<f64>; D],
    jacobian: [Vec3<f64>; D],
}

/// A step: the tilt of the root (rotation vector in its axes), and the changes of curvatures and inner nodes.
#[derive(Debug, Default)]
pub(super) struct Step {
    pub tilt: Vec3Default,
    pub rows: Vec<[f64; 3]>,
    /// One node per element, its right one; 0 for the tip.
    pub nodes: Vec<f64>,
    /// The fall of the quadratic model.
    pub gain: f64,
}

impl Step {
    /// Takes a fraction of the step. The gain is then at least that fraction.
    pub fn shorten(&mut self, fraction: f64) {
        self.tilt.0 = self.tilt.0.scale(fraction);
        self.rows.iter_mut().flatten().for_each(|change| *change *= fraction);
        self.nodes.iter_mut().for_each(|change| *change *= fraction);
        self.gain *= fraction;
    }
}

/// A vector that is zero by default.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vec3Default(pub Vec3<f64>);

impl Default for Vec3Default {
    fn default() -> Self {
        Self(Vec3::zero())
    }
}

/// Memory of the elimination.
#[derive(Default)]
pub(super) struct FitElimination {
    two: Vec<Eliminated<2>>,
    three: Vec<Eliminated<3>>,
    four: Vec<Eliminated<4>>,
}

/// Springs on the step itself, for what the samples do not determine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Damping {
    pub tilt: f64,
    pub curvature: f64,
    pub node: f64,
}

impl FitElimination {
    /// The step from a state. Without free twist there are no free nodes either.
    pub fn solve(
        &mut self,
        shape: &Shape,
        state: &State,
        weights: &Weights,
        freedom: Freedom,
        damping: &Damping,
        step: &mut Step,
    ) {
        match (freedom.twist, freedom.nodes) {
            (false, false) => solve_for::<2>(&mut self.two, [1, 2], shape, state, weights, freedom, damping, step),
            (true, false) => solve_for::<3>(&mut self.three, [0, 1, 2], shape, state, weights, freedom, damping, step),
            (false, true) => solve_for::<3>(&mut self.three, [1, 2, NODE], shape, state, weights, freedom, damping, step),
            (true, true) => solve_for::<4>(&mut self.four, [0, 1, 2, NODE], shape, state, weights, freedom, damping, step),
        }
    }
}

/// The freedom beyond the curvatures.
const NODE: usize = 3;

#[allow(clippy::too_many_arguments)]
fn solve_for<const D: usize>(
    done: &mut Vec<Eliminated<D>>,
    axes: [usize; D],
    shape: &Shape,
    state: &State,
    weights: &Weights,
    freedom: Freedom,
    damping: &Damping,
    step: &mut Step,
) {
    let count = state.elements.len();
    done.clear();
    let mut down = Downstream::nothing();
    for index in (0..count).rev() {
        let (eliminated, left) = eliminate(&down, axes, shape, state, weights, damping, index);
        done.push(eliminated);
        down = left;
        if index > 0 {
            down = down.turned(&state.elements[index - 1].turn);
        }
    }
    let tilt = if freedom.root { tilt_of_root(&down, damping.tilt) } else { Vec3::zero() };
    step.tilt = Vec3Default(tilt);
    step.gain = tilt.dot(down.moment);
    step.rows.clear();
    step.nodes.clear();
    let (mut psi, mut rho) = (tilt, Vec3::<f64>::zero());
    for (index, element) in state.elements.iter().enumerate() {
        let done = &done[count - 1 - index];
        let delta = done.reduced.change(psi, rho);
        for square in done.reduced.squares() {
            step.gain += square;
        }
        let (mut next_psi, mut next_rho) = (psi, rho + psi.cross(element.end));
        let (mut row, mut node) = ([0.0; 3], 0.0);
        for i in 0..D {
            next_psi += done.psi[i].scale(delta[i]);
            next_rho += done.jacobian[i].scale(delta[i]);
            if axes[i] == NODE {
                node = delta[i];
            } else {
                row[axes[i]] = delta[i];
            }
        }
        step.rows.push(row);
        step.nodes.push(if index + 1 == count { 0.0 } else { node });
        psi = element.turn.apply_transposed(next_psi);
        rho = element.turn.apply_transposed(next_rho);
    }
}

/// Solves (A + k I) ψ = moment for the tilt, except about the tangent, where a turn is equivalent to one of all curvatures.
fn tilt_of_root(root: &Downstream, stiffness: f64) -> Vec3<f64> {
    let a = &root.a.0;
    let (m11, m12, m22) = (a[1][1] + stiffness, 0.5 * (a[1][2] + a[2][1]), a[2][2] + stiffness);
    let determinant = m11 * m22 - m12 * m12;
    let [_, y, z] = root.moment.0;
    Vec3([0.0, (m22 * y - m12 * z) / determinant, (m11 * z - m12 * y) / determinant])
}

/// What an element's freedoms meet: their quadratic form with the left end, and what pulls at them.
struct Meets<const D: usize> {
    /// The freedoms' own part, lower triangle.
    kk: [[f64; D]; D],
    psi_k: [Vec3<f64>; D],
    rho_k: [Vec3<f64>; D],
    pull: [f64; D],
}

fn eliminate<const D: usize>(
    right: &Downstream,
    axes: [usize; D],
    shape: &Shape,
    state: &State,
    weights: &Weights,
    damping: &Damping,
    index: usize,
) -> (Eliminated<D>, Downstream) {
    let (psi, jacobian) = motions(axes, state, index);
    let (mut left, mut meets) = through(right, state.elements[index].end, &psi, &jacobian);
    for placed in &state.placed[state.first[index]..state.first[index + 1]] {
        meets.add_sample(&mut left, placed, &state.elements[index], weights, axes);
    }
    meets.add_springs(axes, shape, state, weights, damping, index);
    let mut pivot = meets.kk;
    for i in 0..D {
        for k in 0..i {
            pivot[k][i] = pivot[i][k];
        }
    }
    let (factor, _) = cholesky(&pivot, 0.0);
    let reduced = left.reduce(factor, &meets.psi_k, &meets.rho_k, &meets.pull, [true; D]);
    (Eliminated { reduced, psi, jacobian }, left)
}

/// Ψ and J: how an element's freedoms turn and move its right end. A node turns what lies beyond it.
fn motions<const D: usize>(axes: [usize; D], state: &State, index: usize) -> ([Vec3<f64>; D], [Vec3<f64>; D]) {
    let element = &state.elements[index];
    let (kappa, length) = (element.kappa, element.length);
    let theta = kappa.scale(length);
    let z = element.kappa_squared * (length * length);
    let mean = segment::mean_frame(theta, z, &element.c);
    let gradient = segment::chord_gradient(theta, z, &element.c);
    let (mut psi, mut jacobian) = ([Vec3::<f64>::zero(); D], [Vec3::<f64>::zero(); D]);
    for i in 0..D {
        if axes[i] != NODE {
            psi[i] = mean.column(axes[i]).scale(length);
            jacobian[i] = gradient.column(axes[i]).scale(length * length);
        } else if index + 1 < state.elements.len() {
            psi[i] = element.turn.apply(kappa - state.elements[index + 1].kappa);
        }
    }
    (psi, jacobian)
}

/// What is downstream, moved to the left end, `ρ_R = ρ + ψ×a = ρ − [a]×ψ`, and through the freedoms.
fn through<const D: usize>(
    right: &Downstream,
    end: Vec3<f64>,
    psi: &[Vec3<f64>; D],
    jacobian: &[Vec3<f64>; D],
) -> (Downstream, Meets<D>) {
    let b_moved = right.b.add(&right.c.crossed_from_left(end));
    let arm = right.b.mul(&Mat3::cross(end));
    let left = Downstream {
        // A + [a]×Bᵀ + B[a]×ᵀ + [a]× C [a]×ᵀ.
        a: right
            .a
            .add(&right.b.transpose().crossed_from_left(end))
            .sub(&arm)
            .sub(&right.c.crossed_from_left(end).mul(&Mat3::cross(end))),
        b: b_moved,
        c: right.c,
        moment: right.moment + end.cross(right.force),
        force: right.force,
    };
    let zero = Vec3::<f64>::zero();
    let mut meets = Meets { kk: [[0.0; D]; D], psi_k: [zero; D], rho_k: [zero; D], pull: [0.0; D] };
    for i in 0..D {
        let y_psi = right.a.apply(psi[i]) + right.b.apply(jacobian[i]);
        let y_rho = right.b.apply_transposed(psi[i]) + right.c.apply(jacobian[i]);
        for k in 0..=i {
            meets.kk[i][k] = psi[k].dot(y_psi) + jacobian[k].dot(y_rho);
        }
        meets.psi_k[i] = y_psi + end.cross(y_rho);
        meets.rho_k[i] = y_rho;
        meets.pull[i] = psi[i].dot(right.moment) + jacobian[i].dot(right.force);
    }
    (left, meets)
}

impl<const D: usize> Meets<D> {
    /// A sample of the element: it does not feel the node beyond it.
    fn add_sample(
        &mut self,
        left: &mut Downstream,
        placed: &Placed,
        element: &ElementState<f64>,
        weights: &Weights,
        axes: [usize; D],
    ) {
        let own = if axes[D - 1] == NODE { D - 1 } else { D };
        let (w, x, s) = (placed.weight, placed.local, placed.s);
        let theta = element.kappa.scale(s);
        let z = element.kappa_squared * (s * s);
        let gradient = segment::chord_gradient(theta, z, &placed.c);
        let f = placed.off.scale(w);
        let wx = x.scale(w);
        let xx = wx.dot(x);
        for i in 0..3 {
            for j in 0..3 {
                left.a.0[i][j] -= wx.0[i] * x.0[j];
            }
            left.a.0[i][i] += xx;
            left.c.0[i][i] += w;
        }
        left.b = left.b.add(&Mat3::cross(wx));
        left.moment += x.cross(f);
        left.force += f;
        let mut j = [Vec3::<f64>::zero(); D];
        for i in 0..own {
            j[i] = gradient.column(axes[i]).scale(s * s);
            let wj = j[i].scale(w);
            self.rho_k[i] += wj;
            self.psi_k[i] += wx.cross(j[i]);
            for k in 0..=i {
                self.kk[i][k] += j[k].dot(wj);
            }
            self.pull[i] += j[i].dot(f);
        }
        if let Some((tangent, angle)) = placed.normal {
            let w = w * weights.normal;
            let mean = segment::mean_frame(theta, z, &placed.c);
            let wt = tangent.scale(w);
            for i in 0..3 {
                for j in 0..3 {
                    left.a.0[i][j] += wt.0[i] * tangent.0[j];
                }
            }
            left.moment += wt.scale(angle);
            let mut turn = [0.0; D];
            for i in 0..own {
                turn[i] = tangent.dot(mean.column(axes[i])) * s;
                self.psi_k[i] += wt.scale(turn[i]);
                for k in 0..=i {
                    self.kk[i][k] += w * turn[i] * turn[k];
                }
                self.pull[i] += w * angle * turn[i];
            }
        }
    }

    /// The springs of the freedoms themselves: damping, and what twist and spacing are charged.
    fn add_springs(
        &mut self,
        axes: [usize; D],
        shape: &Shape,
        state: &State,
        weights: &Weights,
        damping: &Damping,
        index: usize,
    ) {
        let (length, last) = (state.elements[index].length, index + 1 == state.elements.len());
        for i in 0..D {
            match axes[i] {
                NODE => {
                    self.kk[i][i] += damping.node;
                    if last {
                        self.kk[i][i] += 1.0;
                    } else {
                        let count = state.elements.len() as f64;
                        // Half the second derivative of the squares of both elements' stretch; the neighbour node's part is left out.
                        self.kk[i][i] += 2.0 * weights.spacing * count * count;
                        self.pull[i] += weights.spacing * count * count * (shape.length(index + 1) - shape.length(index));
                    }
                }
                0 => {
                    self.kk[i][i] += (damping.curvature + weights.twist) * length;
                    self.pull[i] -= weights.twist * length * shape.rows[index][0];
                }
                _ => self.kk[i][i] += damping.curvature * length,
            }
        }
    }
}
