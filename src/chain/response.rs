//! How a strand whose system is eliminated answers to forces at its stations: the blocks of its Delassus operator, J H⁻¹ Jᵀ, and the
//! direction that forces lead to, each by one pass from the stations to the root and one back, in linear time.
//!
//! Symbols as in `elimination`: u = (ψ, ρ); y what is left of the forces on an element's free curvatures once all downstream of it is
//! eliminated, L y = JᵀF + ΨᵀM − …; δκ = L⁻ᵀ(y − W u).

use super::elimination::{Eliminated, Elimination};
use super::load::Load;
use super::system::Direction;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;

/// The Delassus operator of one strand over its stations, world axes: the block at (i, j) is how far station i moves for a unit force
/// along each axis at station j, m/N, in Newton's linear model of the step.
#[derive(Debug, Clone, Default)]
pub struct Delassus {
    /// How many stations.
    pub stations: usize,
    /// Blocks, row by row: `blocks[i * stations + j]`, `[row][column]`; symmetric as a whole.
    pub blocks: Vec<[[f64; 3]; 3]>,
}

/// Scratch of the passes; kept between calls.
#[derive(Debug, Clone, Default)]
pub struct ResponseScratch {
    one: Vec<[Vec3<f64>; 1]>,
    two: Vec<[Vec3<f64>; 2]>,
    three: Vec<[Vec3<f64>; 3]>,
    single: Vec<[f64; 3]>,
}

impl Elimination<f64> {
    /// The operator over `loads` (from root to tip), after [`Elimination::solve_loaded`] over the curvatures `axes` of the same
    /// kinematics.
    pub fn delassus(
        &self,
        kinematics: &Kinematics<f64>,
        loads: &[Load<f64>],
        axes: &[usize],
        scratch: &mut ResponseScratch,
        out: &mut Delassus,
    ) {
        out.stations = loads.len();
        out.blocks.resize(loads.len() * loads.len(), [[0.0; 3]; 3]);
        match *axes {
            [a] => delassus(&self.one, kinematics, loads, [a], &mut scratch.one, out),
            [a, b] => delassus(&self.two, kinematics, loads, [a, b], &mut scratch.two, out),
            _ => delassus(&self.three, kinematics, loads, [0, 1, 2], &mut scratch.three, out),
        }
    }

    /// Newton's direction with the forces `forces` (world axes, N) on the stations `loads`, after [`Elimination::solve_loaded`]. Gives
    /// how far each station moves along it too.
    #[allow(clippy::too_many_arguments, reason = "a kernel's operands")]
    pub fn direction(
        &self,
        kinematics: &Kinematics<f64>,
        loads: &[Load<f64>],
        forces: &[Vec3<f64>],
        axes: &[usize],
        scratch: &mut ResponseScratch,
        change: &mut Vec<[f64; 3]>,
        moved: &mut Vec<Vec3<f64>>,
    ) -> Direction<f64> {
        let out = (change, moved);
        match *axes {
            [a] => direction(&self.one, kinematics, loads, forces, [a], &mut scratch.single, out),
            [a, b] => direction(&self.two, kinematics, loads, forces, [a, b], &mut scratch.single, out),
            _ => direction(&self.three, kinematics, loads, forces, [0, 1, 2], &mut scratch.single, out),
        }
    }
}

/// Three vectors at once, a column each: rows of numbers, so that a row times a number is three products side by side.
type Columns = Mat3<f64>;

/// aᵀ m: one number a column.
#[inline(always)]
fn row(a: Vec3<f64>, m: &Columns) -> Vec3<f64> {
    m.apply_transposed(a)
}

/// m − a yᵀ.
#[inline(always)]
fn less_outer(m: &Columns, a: [f64; 3], y: Vec3<f64>) -> Columns {
    let mut out = *m;
    for i in 0..3 {
        for j in 0..3 {
            out.0[i][j] -= a[i] * y.0[j];
        }
    }
    out
}

/// The free columns of a station's J.
#[inline(always)]
fn free_columns<const D: usize>(load: &Load<f64>, axes: [usize; D]) -> [Vec3<f64>; D] {
    let mut out = [Vec3::zero(); D];
    for i in 0..D {
        out[i] = load.jacobian.column(axes[i]);
    }
    out
}

fn delassus<const D: usize>(
    eliminated: &[Eliminated<f64, D>],
    kinematics: &Kinematics<f64>,
    loads: &[Load<f64>],
    axes: [usize; D],
    left_over: &mut Vec<[Vec3<f64>; D]>,
    out: &mut Delassus,
) {
    let count = kinematics.elements.len();
    left_over.resize(count, [Vec3::zero(); D]);
    for (j, load) in loads.iter().enumerate() {
        // From the station to the root: moment about, and force at, the left end of each element.
        let unit = kinematics.elements[load.element].frame_left.transpose();
        let (mut moment, mut force) = (Mat3::zero(), Mat3::zero());
        for index in (0..=load.element).rev() {
            let element = &kinematics.elements[index];
            let done = &eliminated[count - 1 - index];
            let y = &mut left_over[index];
            let (at_left, columns);
            if index == load.element {
                columns = free_columns(load, axes);
                for i in 0..D {
                    y[i] = row(columns[i], &unit);
                }
                force = unit;
                at_left = unit.crossed_from_left(load.local);
            } else {
                for i in 0..D {
                    y[i] = row(done.psi[i], &moment) + row(done.jacobian[i], &force);
                }
                at_left = moment.add(&force.crossed_from_left(element.end));
            }
            moment = at_left;
            for i in 0..D {
                for k in 0..i {
                    y[i] -= y[k].scale(done.factor[i][k]);
                }
                y[i] = y[i].scale(done.factor[i][i]);
                let w = &done.coupling[i];
                moment = less_outer(&moment, [w[0], w[1], w[2]], y[i]);
                force = less_outer(&force, [w[3], w[4], w[5]], y[i]);
            }
            if index > 0 {
                let turn = &kinematics.elements[index - 1].turn;
                (moment, force) = (turn.mul(&moment), turn.mul(&force));
            }
        }
        // Back from the root, to the stations up to this one.
        let (mut psi, mut rho) = (Mat3::zero(), Mat3::zero());
        let mut i = 0;
        for index in 0..=load.element {
            let element = &kinematics.elements[index];
            let done = &eliminated[count - 1 - index];
            let mut delta = left_over[index];
            for k in (0..D).rev() {
                let w = &done.coupling[k];
                let mut value = delta[k] - row(Vec3([w[0], w[1], w[2]]), &psi) - row(Vec3([w[3], w[4], w[5]]), &rho);
                for later in k + 1..D {
                    value -= delta[later].scale(done.factor[later][k]);
                }
                delta[k] = value.scale(done.factor[k][k]);
            }
            while i <= j && loads[i].element == index {
                let station = &loads[i];
                let columns = free_columns(station, axes);
                // ψ×x = −[x]× ψ.
                let mut moved = rho.sub(&psi.crossed_from_left(station.local));
                for k in 0..D {
                    moved = less_outer(&moved, columns[k].scale(-1.0).0, delta[k]);
                }
                let block = element.frame_left.mul(&moved);
                out.blocks[i * loads.len() + j] = block.0;
                out.blocks[j * loads.len() + i] = block.transpose().0;
                i += 1;
            }
            let (mut next_psi, mut next_rho) = (psi, rho.sub(&psi.crossed_from_left(element.end)));
            for k in 0..D {
                next_psi = less_outer(&next_psi, done.psi[k].scale(-1.0).0, delta[k]);
                next_rho = less_outer(&next_rho, done.jacobian[k].scale(-1.0).0, delta[k]);
            }
            psi = element.turn.transposed_mul(&next_psi);
            rho = element.turn.transposed_mul(&next_rho);
        }
        // Symmetric to rounding only: made so.
        let own = &mut out.blocks[j * loads.len() + j];
        for a in 0..3 {
            for b in 0..a {
                let mean = 0.5 * (own[a][b] + own[b][a]);
                (own[a][b], own[b][a]) = (mean, mean);
            }
        }
    }
}

fn direction<const D: usize>(
    eliminated: &[Eliminated<f64, D>],
    kinematics: &Kinematics<f64>,
    loads: &[Load<f64>],
    forces: &[Vec3<f64>],
    axes: [usize; D],
    left_over: &mut Vec<[f64; 3]>,
    (change, moved): (&mut Vec<[f64; 3]>, &mut Vec<Vec3<f64>>),
) -> Direction<f64> {
    let count = kinematics.elements.len();
    left_over.clear();
    left_over.resize(count, [0.0; 3]);
    let (mut moment, mut force) = (Vec3::<f64>::zero(), Vec3::<f64>::zero());
    let mut next = loads.len();
    for index in (0..count).rev() {
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
                y[i] -= y[k] * done.factor[i][k];
            }
            y[i] *= done.factor[i][i];
            let w = &done.coupling[i];
            moment -= Vec3([w[0], w[1], w[2]]).scale(y[i]);
            force -= Vec3([w[3], w[4], w[5]]).scale(y[i]);
        }
        if index > 0 {
            let turn = &kinematics.elements[index - 1].turn;
            (moment, force) = (turn.apply(moment), turn.apply(force));
        }
    }
    change.clear();
    change.resize(count, [0.0; 3]);
    moved.clear();
    let (mut psi, mut rho) = (Vec3::<f64>::zero(), Vec3::<f64>::zero());
    let (mut descent, mut rotation_squared, mut rotation_sum) = (0.0, 0.0_f64, 0.0);
    for index in 0..count {
        let element = &kinematics.elements[index];
        let done = &eliminated[count - 1 - index];
        let mut delta = [0.0; D];
        for i in (0..D).rev() {
            let w = &done.coupling[i];
            let mut value =
                done.reduced[i] + left_over[index][i] - Vec3([w[0], w[1], w[2]]).dot(psi) - Vec3([w[3], w[4], w[5]]).dot(rho);
            for k in i + 1..D {
                value -= done.factor[k][i] * delta[k];
            }
            delta[i] = value * done.factor[i][i];
            descent += delta[i] * done.force[i];
            change[index][axes[i]] = delta[i];
        }
        while let Some(load) = loads.get(moved.len()).filter(|load| load.element == index) {
            let way = element.frame_left.apply(load.moved(psi, rho, Vec3(change[index])));
            descent += way.dot(forces[moved.len()]);
            moved.push(way);
        }
        let (mut next_psi, mut next_rho) = (psi, rho + psi.cross(element.end));
        for i in 0..D {
            next_psi += done.psi[i].scale(delta[i]);
            next_rho += done.jacobian[i].scale(delta[i]);
        }
        let turned = next_psi.norm_squared();
        rotation_squared = rotation_squared.max(turned);
        rotation_sum += turned;
        psi = element.turn.apply_transposed(next_psi);
        rho = element.turn.apply_transposed(next_rho);
    }
    Direction { descent, rotation_squared, rotation_sum, repaired: 0.0, condition: 0.0 }
}
