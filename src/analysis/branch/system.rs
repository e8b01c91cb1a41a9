//! The equations that `analysis::branch` follows: gradient, Hessian and load of a strand's static potential in scaled unknowns.
//!
//! Unknowns: yᵢ = κᵢ √(L ℓ) of every free curvature, rad, and the parameter over its range. Equations: the gradient over √(L ℓ) and over
//! the largest EI/L. Linear systems are solved by singular values, those that are zero to rounding left out: at a bifurcation, and all
//! along a branch with a mode that a symmetry leaves neutral, the solution of least length is the one that is wanted.

use faer::Mat;
use nalgebra::Vector3;

use super::Load;
use crate::chain::dense;
use crate::chain::force::generalised;
use crate::chain::system::ChainSystem;
use crate::error::{Error, Result, check_finite};
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::rod::definition::{StrandDef, check_frozen, check_rows};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::step::equilibrium::{self, EquilibriumOptions};
use crate::step::scratch::Bench;
use crate::step::state::rotation_matrix;

/// An equilibrium, or a guess of one.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub curvatures: Vec<[f64; 3]>,
    pub parameter: f64,
}

/// A state that Newton's method brought home.
pub(super) struct Corrected {
    pub state: State,
    pub iterations: u32,
}

/// Newton's iterations at most.
const MAX_ITERATIONS: u32 = 12;
/// The longest step of Newton's, in the curve's metric.
const LONGEST_CORRECTION: f64 = 1.0;
/// Newton stops early when an iteration moves by less than this: the residual is as small as rounding lets it be.
const STILL: f64 = 1e-14;
/// A singular value below this share of the largest is zero.
const SINGULAR: f64 = 1e-12;
/// What the integrals along an element may err by: critical loads are located to 1e-8.
const QUADRATURE: f64 = 1e-10;
/// The difference quotient of the load, of the range.
const DIFFERENCE: f64 = 1e-4;

pub(super) struct System<'a> {
    model: StrandModel,
    load: &'a dyn Fn(f64) -> Load,
    range: f64,
    tolerance: f64,
    rules: Rules,
    rule: usize,
    kinematics: Kinematics<f64>,
    chain: ChainSystem<f64>,
    /// √(L ℓ) of each element.
    scale: Vec<f64>,
    /// The largest EI/L.
    unit: f64,
}

impl<'a> System<'a> {
    pub fn new(strand: &StrandDef, load: &'a dyn Fn(f64) -> Load, range: f64, tolerance: f64) -> Result<Self> {
        strand.check("strand")?;
        let model = StrandModel::new(strand.element_lengths.clone(), strand.natural.clone(), strand.material, strand.freedoms);
        let length = model.length();
        let scale = model.lengths.iter().map(|element| (length * element).sqrt()).collect();
        let unit = model.stiffness.iter().fold(0.0_f64, |a, b| a.max(*b)) / length;
        let (kinematics, chain) = (Kinematics::default(), ChainSystem::default());
        Ok(Self { model, load, range, tolerance, rules: Rules::new(QUADRATURE), rule: 0, kinematics, chain, scale, unit })
    }

    /// Number of free curvatures.
    pub fn size(&self) -> usize {
        self.model.element_count() * self.model.freedoms.count()
    }

    /// Element and axis of unknown `i`.
    fn place(&self, i: usize) -> (usize, usize) {
        let free = self.model.freedoms.count();
        (i / free, self.model.freedoms.axes()[i % free])
    }

    pub fn check_shape(&self, argument: &str, rows: &[[f64; 3]]) -> Result<()> {
        check_rows(argument, rows, self.model.element_count())
    }

    /// Rows of curvatures as unknowns.
    pub fn scaled(&self, rows: &[[f64; 3]]) -> Vec<f64> {
        (0..self.size())
            .map(|i| {
                let (element, axis) = self.place(i);
                rows[element][axis] * self.scale[element]
            })
            .collect()
    }

    /// Unknowns between two states, the parameter last.
    pub fn difference(&self, to: &State, from: &State) -> Vec<f64> {
        let (a, b) = (self.scaled(&to.curvatures), self.scaled(&from.curvatures));
        let mut out: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
        out.push((to.parameter - from.parameter) / self.range);
        out
    }

    fn moved(&self, state: &State, way: &[f64], factor: f64) -> State {
        let mut out = state.clone();
        for i in 0..self.size() {
            let (element, axis) = self.place(i);
            out.curvatures[element][axis] += factor * way[i] / self.scale[element];
        }
        out.parameter += factor * way[self.size()] * self.range;
        out
    }

    /// Brings the kinematics and the forces to a state; gives the gradient and the residual.
    fn evaluate(&mut self, state: &State, load: &Load) -> (Vec<f64>, f64) {
        self.rule = self.rules.next_for_angle(self.rule, self.model.largest_angle(&state.curvatures));
        let rule = self.rules.rule(self.rule);
        let root = Frame { origin: Vector3::zeros(), rotation: load.rotation };
        self.kinematics.update(&rotation_matrix(&root), &self.model.lengths, &state.curvatures, rule);
        let weight = equilibrium::weights(&self.model, &rule.weights, load.gravity);
        let pull = generalised(&self.kinematics, |p| weight[p]);
        let residual = equilibrium::imbalance(&self.model, &self.kinematics, &state.curvatures, &weight, load.gravity);
        self.chain.resize(self.model.element_count(), weight.len());
        self.chain.point_force.copy_from_slice(&weight);
        for (element, length) in self.model.lengths.iter().enumerate() {
            self.chain.curvature_stiffness[element] = self.model.stiffness.map(|stiffness| stiffness * length);
        }
        let gradient = (0..self.size())
            .map(|i| {
                let (element, axis) = self.place(i);
                let strain = state.curvatures[element][axis] - self.model.natural[element][axis];
                let moment = self.chain.curvature_stiffness[element][axis] * strain - pull[element][axis];
                moment / (self.scale[element] * self.unit)
            })
            .collect();
        (gradient, residual)
    }

    /// The change of the gradient over the range of the parameter.
    fn load_gradient(&mut self, state: &State) -> Vec<f64> {
        let step = DIFFERENCE * self.range;
        let (after, before) = ((self.load)(state.parameter + step), (self.load)(state.parameter - step));
        let (a, _) = self.evaluate(state, &after);
        let (b, _) = self.evaluate(state, &before);
        a.iter().zip(&b).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
    }

    /// The Hessian of the state evaluated last, with room for `border` more rows and columns.
    fn hessian(&self, border: usize) -> Mat<f64> {
        let (axes, free) = (self.model.freedoms.axes(), self.model.freedoms.count());
        let matrix = dense::assemble(&self.kinematics, &self.chain, &axes[..free]).matrix;
        let size = self.size();
        Mat::from_fn(size + border, size + border, |i, j| {
            if i < size && j < size { matrix[(i, j)] / (self.scale[i / free] * self.scale[j / free] * self.unit) } else { 0.0 }
        })
    }

    /// Hessian and load's change, bordered by a row.
    fn bordered(&mut self, state: &State, load: &Load, row: &[f64]) -> Mat<f64> {
        let change = self.load_gradient(state);
        self.evaluate(state, load);
        let size = self.size();
        let mut matrix = self.hessian(1);
        for i in 0..size {
            matrix[(i, size)] = change[i];
        }
        for (j, x) in row.iter().enumerate() {
            matrix[(size, j)] = *x;
        }
        matrix
    }

    /// The unit tangent of the curve at a state, of which `towards` says the direction.
    pub fn tangent(&mut self, state: &State, towards: &[f64]) -> Option<Vec<f64>> {
        let load = (self.load)(state.parameter);
        let matrix = self.bordered(state, &load, towards);
        let mut rhs = vec![0.0; self.size() + 1];
        rhs[self.size()] = 1.0;
        let mut tangent = least_solution(&matrix, &rhs)?;
        let size = tangent.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along: f64 = tangent.iter().zip(towards).map(|(a, b)| a * b).sum();
        if !(size.is_finite() && size > 0.0 && along > 0.0) {
            return None;
        }
        tangent.iter_mut().for_each(|x| *x /= size);
        Some(tangent)
    }

    /// The state at `length` along the unit vector `tangent` from a state: predicted on it, corrected at right angles to it.
    pub fn step(&mut self, from: &State, tangent: &[f64], length: f64) -> Option<Corrected> {
        let mut state = self.moved(from, tangent, length);
        for iterations in 0..=MAX_ITERATIONS {
            let load = (self.load)(state.parameter);
            let (gradient, residual) = self.evaluate(&state, &load);
            let way = self.difference(&state, from);
            let missing = length - way.iter().zip(tangent).map(|(a, b)| a * b).sum::<f64>();
            if !residual.is_finite() {
                return None;
            }
            if residual <= self.tolerance && missing.abs() <= 1e-9 * length.abs().max(1e-6) {
                return Some(Corrected { state, iterations });
            }
            if iterations == MAX_ITERATIONS {
                break;
            }
            let matrix = self.bordered(&state, &load, tangent);
            let mut rhs: Vec<f64> = gradient.iter().map(|g| -g).collect();
            rhs.push(missing);
            let change = least_solution(&matrix, &rhs)?;
            let size = change.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size.is_nan() || size > LONGEST_CORRECTION {
                return None;
            }
            state = self.moved(&state, &change, 1.0);
            if size < STILL {
                break;
            }
        }
        None
    }

    /// The state at a given parameter, from the chord between two states.
    pub fn at_parameter(&mut self, from: &State, to: &State, share: f64, parameter: f64) -> Option<State> {
        let way = self.difference(to, from);
        let mut state = self.moved(from, &way, share);
        state.parameter = parameter;
        self.newton(state)
    }

    /// Newton's method at a fixed parameter.
    fn newton(&mut self, mut state: State) -> Option<State> {
        let load = (self.load)(state.parameter);
        for _ in 0..=MAX_ITERATIONS {
            let (gradient, residual) = self.evaluate(&state, &load);
            if residual <= self.tolerance {
                return Some(state);
            }
            let rhs: Vec<f64> = gradient.iter().map(|g| -g).collect();
            let mut change = least_solution(&self.hessian(0), &rhs)?;
            let size = change.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size.is_nan() || size > LONGEST_CORRECTION {
                return None;
            }
            change.push(0.0);
            state = self.moved(&state, &change, 1.0);
        }
        None
    }

    /// The equilibrium near a shape.
    pub fn start(&mut self, mut curvatures: Vec<[f64; 3]>, parameter: f64) -> Result<State> {
        let load = (self.load)(parameter);
        for axis in 0..3 {
            check_finite(|| format!("load(from).gravity[{axis}]"), load.gravity[axis])?;
        }
        check_frozen("strand.initial", &curvatures, &self.model.natural, self.model.freedoms)?;
        if let Some(state) = self.newton(State { curvatures: curvatures.clone(), parameter }) {
            return Ok(state);
        }
        let root = Frame { origin: Vector3::zeros(), rotation: load.rotation };
        let options = EquilibriumOptions { check_stability: false, ..EquilibriumOptions::default() };
        let mut workspace = Bench::default();
        let found;
        (curvatures, found) =
            equilibrium::search(&self.model, curvatures, &root, load.gravity, &options, &self.rules, &mut workspace);
        self.newton(State { curvatures, parameter }).ok_or_else(|| {
            Error::invalid(
                "strand.initial",
                format!("a shape whose search ends at residual {}", found.residual),
                "one near an equilibrium",
            )
        })
    }

    /// The smallest eigenvalue and its mode as curvatures.
    pub fn softest(&mut self, state: &State) -> (f64, Vec<[f64; 3]>) {
        let load = (self.load)(state.parameter);
        self.evaluate(state, &load);
        let weight = std::mem::take(&mut self.chain.point_force);
        let found = equilibrium::softest(&self.model, &self.kinematics, &weight);
        self.chain.point_force = weight;
        found
    }

    /// How much of the load's change acts on a mode (unknowns): the cosine between the two.
    pub fn share_of_load(&mut self, state: &State, mode: &[f64]) -> f64 {
        let change = self.load_gradient(state);
        let product: f64 = change.iter().zip(mode).map(|(a, b)| a * b).sum();
        let sizes = change.iter().map(|x| x * x).sum::<f64>().sqrt() * mode.iter().map(|x| x * x).sum::<f64>().sqrt();
        if sizes > 0.0 { (product / sizes).abs() } else { 0.0 }
    }

    /// The tip relative to the root, world axes.
    pub fn tip(&mut self, state: &State) -> Vector3<f64> {
        let load = (self.load)(state.parameter);
        self.evaluate(state, &load);
        self.kinematics.elements.last().map_or_else(Vector3::zeros, |element| element.origin_right().into())
    }
}

/// The solution of least length, singular values that are zero to rounding left out; `None` if a number is not finite.
fn least_solution(matrix: &Mat<f64>, rhs: &[f64]) -> Option<Vec<f64>> {
    let size = rhs.len();
    if !rhs.iter().all(|x| x.is_finite()) || !(0..size).all(|j| (0..size).all(|i| matrix[(i, j)].is_finite())) {
        return None;
    }
    let svd = matrix.svd().ok()?;
    let values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
    let floor = SINGULAR * values.first().copied().unwrap_or(0.0);
    let along = svd.U().transpose() * Mat::from_fn(size, 1, |i, _| rhs[i]);
    let scaled = Mat::from_fn(size, 1, |i, _| if values[i] > floor { along[(i, 0)] / values[i] } else { 0.0 });
    let solution = svd.V() * scaled;
    Some((0..size).map(|i| solution[(i, 0)]).collect())
}
