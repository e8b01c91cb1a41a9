//! The Levenberg–Marquardt step on one strand's curvatures, in linear time.
//!
//! Elements are eliminated from tip to root as in [`crate::chain::elimination`], with its symbols. Springs may sit at any
//! arclength, act along one direction only (a body pushes along its normal), and hold a direction. Frozen curvatures keep their
//! values to the bit.

use crate::chain::downstream::Downstream;
use crate::chain::elimination::pivot::factorise;
use crate::chain::elimination::reduced::Reduced;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::ElementState;
use crate::rod::segment::{self, CurvatureForm};

use super::springs::Spring;

/// The quadratic model of everything that is minimised.
pub(super) struct Model<'a> {
    pub elements: &'a [ElementState<f64>],
    /// By element.
    pub springs: &'a [Spring],
    /// Stiffness of each curvature of each element.
    pub stiffness: &'a [[f64; 3]],
    /// Force on each curvature of each element.
    pub force: &'a [[f64; 3]],
    /// Curvatures that may change.
    pub free: &'a [[bool; 3]],
    /// Whether the springs' tension counts: Newton's method instead of Gauss–Newton.
    pub exact: bool,
}

/// What lies downstream of a node, and the force and moment there that make the tension.
#[derive(Clone, Copy)]
struct Tensed {
    down: Downstream,
    moment: Vec3<f64>,
    force: Vec3<f64>,
}

/// What the pass from root to tip needs of an element.
#[derive(Clone, Copy)]
struct Eliminated {
    reduced: Reduced<f64, 3>,
    psi: Mat3<f64>,
    jacobian: Mat3<f64>,
}

/// A step: the changes of the curvatures, and the resulting rotation and displacement of each element's left end, in its own
/// axes.
#[derive(Debug, Default)]
pub(super) struct Step {
    pub rows: Vec<[f64; 3]>,
    pub left: Vec<(Vec3<f64>, Vec3<f64>)>,
    /// The fall of the quadratic model.
    pub gain: f64,
    /// The largest rotation of an element's end, rad.
    pub turn: f64,
}

/// Memory of the elimination.
#[derive(Default)]
pub(super) struct PoseElimination {
    done: Vec<Eliminated>,
}

impl PoseElimination {
    /// The step from a state.
    pub fn solve(&mut self, model: &Model, step: &mut Step) {
        let mut down = Tensed { down: Downstream::nothing(), moment: Vec3::zero(), force: Vec3::zero() };
        self.done.clear();
        let mut springs = model.springs;
        for index in (0..model.elements.len()).rev() {
            let (before, own) = springs.split_at(springs.partition_point(|spring| spring.element < index));
            springs = before;
            let (done, left) = eliminate(&down, model, own, index);
            self.done.push(done);
            down = if index > 0 { left.turned(&model.elements[index - 1].turn) } else { left };
        }
        self.substitute(model, step);
    }

    /// From root to tip; the root does not move.
    fn substitute(&self, model: &Model, step: &mut Step) {
        step.rows.clear();
        step.left.clear();
        (step.gain, step.turn) = (0.0, 0.0);
        let (mut psi, mut rho) = (Vec3::<f64>::zero(), Vec3::<f64>::zero());
        for (element, done) in model.elements.iter().zip(self.done.iter().rev()) {
            step.left.push((psi, rho));
            let delta = done.reduced.change(psi, rho);
            for square in done.reduced.squares() {
                step.gain += 0.5 * square;
            }
            let change = Vec3(delta);
            let next_psi = psi + done.psi.apply(change);
            let next_rho = rho + psi.cross(element.end) + done.jacobian.apply(change);
            step.turn = step.turn.max(next_psi.norm_squared());
            step.rows.push(delta);
            psi = element.turn.apply_transposed(next_psi);
            rho = element.turn.apply_transposed(next_rho);
        }
        step.turn = step.turn.sqrt();
    }
}

impl Tensed {
    /// The same in other axes: those from which `turn` starts.
    fn turned(&self, turn: &Mat3<f64>) -> Self {
        Self { down: self.down.turned(turn), moment: turn.apply(self.moment), force: turn.apply(self.force) }
    }

    /// The same as seen from a point at −x.
    fn moved(&self, x: Vec3<f64>) -> Self {
        let Downstream { a, b, c, moment, force } = &self.down;
        let sc = c.crossed_from_left(x);
        let s_bt = b.transpose().crossed_from_left(x);
        Self {
            down: Downstream {
                // A + S Bᵀ + (S Bᵀ)ᵀ + S C Sᵀ, S = [x]×.
                a: a.add(&s_bt).add(&s_bt.transpose()).sub(&sc.mul(&Mat3::cross(x))),
                b: b.add(&sc),
                c: *c,
                moment: *moment + x.cross(*force),
                force: *force,
            },
            moment: self.moment + x.cross(self.force),
            force: self.force,
        }
    }

    /// Adds −sym(f xᵀ) + (f·x) I to A: the tension of force f at position x.
    fn add_tension(&mut self, f: Vec3<f64>, x: Vec3<f64>) {
        let along = f.dot(x);
        for i in 0..3 {
            for j in 0..3 {
                self.down.a.0[i][j] -= 0.5 * (f.0[i] * x.0[j] + f.0[j] * x.0[i]);
            }
            self.down.a.0[i][i] += along;
        }
    }
}

fn eliminate(right: &Tensed, model: &Model, springs: &[Spring], index: usize) -> (Eliminated, Tensed) {
    let element = &model.elements[index];
    let (kappa, length, end) = (element.kappa, element.length, element.end);
    let theta = kappa.scale(length);
    let z = element.kappa_squared * (length * length);
    let psi = segment::mean_frame(theta, z, &element.c).scale(length);
    let jacobian = segment::chord_gradient(theta, z, &element.c).scale(length * length);

    // Everything downstream, through δκ.
    let y_psi = right.down.a.mul(&psi).add(&right.down.b.mul(&jacobian));
    let y_rho = right.down.b.transposed_mul(&psi).add(&right.down.c.mul(&jacobian));
    let mut kk = psi.transposed_mul(&y_psi).add(&jacobian.transposed_mul(&y_rho));
    let mut psi_k = y_psi.add(&y_rho.crossed_from_left(end));
    let mut rho_k = y_rho;
    let mut pull = psi.apply_transposed(right.down.moment) + jacobian.apply_transposed(right.down.force);
    let mut left = right.moved(end);
    let mut form = CurvatureForm::zero();
    if model.exact {
        let (f, m) = (right.force, right.moment);
        left.add_tension(f, end);
        psi_k = psi_k.add(&jacobian.crossed_from_left(f)).add(&psi.crossed_from_left(m.scale(0.5)));
        form.subtract_force(f, kappa, length, element.kappa_squared, &element.c);
        form.subtract_moment(m, kappa, length, element.kappa_squared, &element.c);
    }

    for spring in springs {
        let (g, j, x, f) = (&spring.stiffness, &spring.jacobian, spring.local, spring.force);
        let gj = g.mul(j);
        let sg = g.crossed_from_left(x);
        left.down.a = left.down.a.sub(&sg.mul(&Mat3::cross(x)));
        left.down.b = left.down.b.add(&sg);
        left.down.c = left.down.c.add(g);
        psi_k = psi_k.add(&gj.crossed_from_left(x));
        rho_k = rho_k.add(&gj);
        kk = kk.add(&j.transposed_mul(&gj));
        pull += j.apply_transposed(f);
        left.down.moment += x.cross(f);
        left.down.force += f;
        if model.exact {
            left.add_tension(f, x);
            psi_k = psi_k.add(&j.crossed_from_left(f));
            form.subtract_force(f, kappa, spring.s, element.kappa_squared, &spring.c);
            left.moment += x.cross(f);
            left.force += f;
        }
        if let Some(turning) = &spring.turning {
            let qp = turning.stiffness.mul(&turning.psi);
            left.down.a = left.down.a.add(&turning.stiffness);
            psi_k = psi_k.add(&qp);
            kk = kk.add(&turning.psi.transposed_mul(&qp));
            pull += turning.psi.apply_transposed(turning.moment);
            left.down.moment += turning.moment;
        }
    }

    if model.exact {
        kk = kk.add(&form.matrix(kappa));
    }
    let (own, force, free) = (&model.stiffness[index], &model.force[index], &model.free[index]);
    let mut pivot = [[0.0; 3]; 3];
    let mut smallest = f64::INFINITY;
    for i in 0..3 {
        for k in 0..3 {
            if free[i] && free[k] {
                pivot[i][k] = 0.5 * (kk.0[i][k] + kk.0[k][i]);
            }
        }
        pivot[i][i] += if free[i] { own[i] } else { 1.0 };
        smallest = smallest.min(if free[i] { own[i] } else { 1.0 });
    }
    let (factor, _) = factorise(&pivot, smallest);
    let columns = |m: &Mat3<f64>| [0, 1, 2].map(|axis| m.column(axis));
    let pulls = [0, 1, 2].map(|axis| pull.0[axis] + force[axis]);
    let reduced = left.down.reduce(factor, &columns(&psi_k), &columns(&rho_k), &pulls, *free);
    (Eliminated { reduced, psi, jacobian }, left)
}
