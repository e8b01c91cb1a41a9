//! Static equilibrium of a strand under gravity: a minimum of ½ (q−qⁿ)ᵀK(q−qⁿ) − Σ w ρS g·r(q).
//!
//! The search takes proximal steps: an implicit Euler step of k seconds from rest is Newton's method on the static potential plus
//! Σ w ρS/(2k²) |r − r_t|². So every step goes downhill, and the machinery of a time step does the work. k starts at √(L/|g|),
//! near the time in which the strand would fall, and grows until inertia is negligible. Once the strand is at rest, the exact
//! static Hessian H gives its smallest eigenvalue against K (H x = λ K x): λ = 1 for a strand without gravity, λ ≤ 0 for an
//! unstable one. The search leaves a saddle (an upright strand, a planar curl that would leave its plane) along its eigenvector.

use faer::{Mat, Side};
use nalgebra::Vector3;

use super::newton;
use super::newton::iterate::{Iterate, Problem};
use super::options::StepOptions;
use super::scratch::Bench;
use super::state::rotation_matrix;
use crate::chain::dense;
use crate::chain::force::generalised;
use crate::chain::system::ChainSystem;
use crate::error::{Error, Result, check_finite};
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use crate::rod::definition::{StrandDef, check_frozen, check_rows};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;

/// Options of the search.
///
/// ```
/// use superhelix::editing::EquilibriumOptions;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let found = solver.settle(&ids, &EquilibriumOptions { check_stability: false, ..EquilibriumOptions::default() })?;
/// assert!(found[0].converged && found[0].smallest_eigenvalue.is_none());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EquilibriumOptions {
    /// At rest when no unbalanced moment exceeds this, relative to ρS|g|L² plus 1e-4 (1/L + the largest natural curvature) times
    /// the largest stiffness; above zero.
    pub tolerance: f64,
    /// Largest number of proximal steps, 1 to 100000.
    pub max_steps: u32,
    /// Find the smallest eigenvalue, and leave unstable states. Costs the cube of the number of elements. Without it the state
    /// may be a saddle on which symmetry holds the strand.
    pub check_stability: bool,
}

impl Default for EquilibriumOptions {
    fn default() -> Self {
        Self { tolerance: 1e-10, max_steps: 300, check_stability: true }
    }
}

impl EquilibriumOptions {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            return Err(Error::invalid(format!("{argument}.tolerance"), self.tolerance, "a finite number above zero"));
        }
        if !(1..=100_000).contains(&self.max_steps) {
            return Err(Error::invalid(format!("{argument}.max_steps"), self.max_steps, "1 to 100000"));
        }
        Ok(())
    }
}

/// How the search for a strand's equilibrium ended.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Equilibrium {
    /// The residual is within the tolerance and, if stability was checked, the state is not unstable.
    pub converged: bool,
    /// Largest unbalanced moment, relative as in [`EquilibriumOptions::tolerance`].
    pub residual: f64,
    /// Smallest eigenvalue of the static Hessian against the elastic stiffness: at most 1 (a little more for strands that gravity
    /// stiffens everywhere), 0 at the limit of stability, to within 1e-9 of rounding. `None` if not requested.
    pub smallest_eigenvalue: Option<f64>,
    /// Total Newton iterations.
    pub iterations: u32,
    /// Saddles left during the search.
    pub saddles: u32,
}

impl Equilibrium {
    /// Whether the smallest eigenvalue was computed and is negative beyond rounding.
    pub fn is_unstable(&self) -> bool {
        self.smallest_eigenvalue.is_some_and(|eigenvalue| eigenvalue < -NEUTRAL)
    }
}

/// An eigenvalue below minus this is truly negative: a mode that symmetry leaves neutral has 0 up to rounding.
const NEUTRAL: f64 = 1e-9;
/// How far to leave a saddle along its eigenvector: the sum of the elements' rotations, rad.
const KICK: f64 = 0.2;
/// Largest number of saddles to leave.
const MAX_SADDLES: u32 = 32;
/// A step that does not converge but has a residual below this is near a saddle, if the state is unstable.
const NEAR_SADDLE: f64 = 1e-2;
/// How much k grows after a converged step, and shrinks after another.
const GROWTH: f64 = 3.0;
/// The largest k, in units of the first: beyond it the pull ρS g k² swamps the digits of the positions.
const LARGEST_STEP: f64 = 1e3;
/// Newton's tolerance within a proximal step, rad. It must be tight: a step within its tolerance from the start leaves a strand
/// on a saddle slightly unbalanced for good.
const NEWTON_TOLERANCE: f64 = 1e-10;

/// The shape in which a strand of this definition rests under gravity (m/s²), one row of curvatures per element. The search
/// starts from the initial shape, with the root fixed at the definition's pose.
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid definition, gravity or options.
pub fn of_strand(
    strand: &StrandDef,
    gravity: Vector3<f64>,
    options: &EquilibriumOptions,
) -> Result<(Vec<[f64; 3]>, Equilibrium)> {
    options.check("options")?;
    let model = checked_model(strand, gravity)?;
    let start = strand.initial.clone().unwrap_or_else(|| strand.natural.clone());
    Ok(search(&model, start, &strand.root, gravity, options, &Rules::default(), &mut Bench::default()))
}

/// The smallest eigenvalue λ of H x = λ K x for a strand of this definition in the shape `curvatures` (one row per element;
/// frozen freedoms at their natural values), where H is the Hessian of its elastic energy and weight over its free curvatures. An
/// equilibrium is stable if it is above zero. Costs the cube of the number of elements.
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid definition, rows or gravity.
pub fn smallest_eigenvalue(strand: &StrandDef, curvatures: &[[f64; 3]], gravity: Vector3<f64>) -> Result<f64> {
    let model = checked_model(strand, gravity)?;
    check_rows("curvatures", curvatures, model.element_count())?;
    check_frozen("curvatures", curvatures, &model.natural, model.freedoms)?;
    let rules = Rules::default();
    let mut kinematics = Kinematics::default();
    let rule = rules.rule(rules.next_for_angle(0, model.largest_angle(curvatures)));
    kinematics.update(&rotation_matrix(&strand.root), &model.lengths, curvatures, rule);
    Ok(softest(&model, &kinematics, &weights(&model, &rule.weights, gravity)).0)
}

fn checked_model(strand: &StrandDef, gravity: Vector3<f64>) -> Result<StrandModel> {
    strand.check("strand")?;
    for axis in 0..3 {
        check_finite(|| format!("gravity[{axis}]"), gravity[axis])?;
    }
    Ok(StrandModel::new(strand.element_lengths.clone(), strand.natural.clone(), strand.material, strand.freedoms))
}

/// The equilibrium of a strand with a fixed root, from the shape `curvatures`. If numbers turn non-finite, the result is the last
/// finite shape with its residual.
pub fn search(
    model: &StrandModel,
    mut curvatures: Vec<[f64; 3]>,
    root: &Frame,
    gravity: Vector3<f64>,
    options: &EquilibriumOptions,
    rules: &Rules,
    bench: &mut Bench<f64>,
) -> (Vec<[f64; 3]>, Equilibrium) {
    for (row, natural) in curvatures.iter_mut().zip(&model.natural) {
        for axis in 0..3 {
            if !model.freedoms.contains(axis) {
                row[axis] = natural[axis];
            }
        }
    }
    let Bench { workspace, elimination } = bench;
    let iterate = &mut workspace.iterate;
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let rotation = rotation_matrix(root);
    let newton_options = StepOptions { max_iterations: 100, tolerance: NEWTON_TOLERANCE, ..StepOptions::default() };
    let first = natural_time(model, gravity);
    let mut k = first;
    let mut found = Equilibrium::default();
    let mut rule_index = rules.next_for_angle(0, model.largest_angle(&curvatures));
    for _ in 0..options.max_steps {
        rule_index = rules.next_for_angle(rule_index, model.largest_angle(&curvatures));
        let rule = rules.rule(rule_index);
        let problem = Problem { root: &rotation, lengths: &model.lengths, axes: &axes[..free], rule, tension_at_start: true };
        iterate.kinematics.update(&rotation, &model.lengths, &curvatures, rule);
        draw_on(model, &rule.weights, gravity, k, iterate);
        iterate.curvatures.clone_from(&curvatures);
        let step = newton::minimise_one(&problem, &newton_options, iterate, elimination);
        found.iterations += step.iterations;
        if step.quarantined || !iterate.curvatures.iter().flatten().all(|x| x.is_finite()) {
            found.residual = f64::INFINITY;
            return (curvatures, found);
        }
        curvatures.clone_from(&iterate.curvatures);
        let weight = weights(model, &rule.weights, gravity);
        found.residual = imbalance(model, &iterate.kinematics, &curvatures, &weight, gravity);
        if found.residual <= options.tolerance {
            if !options.check_stability {
                found.converged = true;
                return (curvatures, found);
            }
            let (eigenvalue, mode) = softest(model, &iterate.kinematics, &weight);
            found.smallest_eigenvalue = Some(eigenvalue);
            if eigenvalue >= -NEUTRAL || found.saddles == MAX_SADDLES {
                found.converged = eigenvalue >= -NEUTRAL;
                return (curvatures, found);
            }
            leave_saddle(model, &mode, &mut curvatures);
            found.saddles += 1;
            k = first;
        } else if !step.converged
            && found.residual < NEAR_SADDLE
            && options.check_stability
            && found.saddles < MAX_SADDLES
            && let (eigenvalue, mode) = softest(model, &iterate.kinematics, &weight)
            && eigenvalue < -NEUTRAL
        {
            // Where symmetry holds the strand near a saddle, damped iterations only creep towards it: leave it at once.
            leave_saddle(model, &mode, &mut curvatures);
            found.saddles += 1;
            k = first;
        } else {
            k = if step.converged { (k * GROWTH).min(LARGEST_STEP * first) } else { k / GROWTH };
        }
    }
    if options.check_stability {
        let rule = rules.rule(rule_index);
        iterate.kinematics.update(&rotation, &model.lengths, &curvatures, rule);
        let weight = weights(model, &rule.weights, gravity);
        found.residual = imbalance(model, &iterate.kinematics, &curvatures, &weight, gravity);
        found.smallest_eigenvalue = Some(softest(model, &iterate.kinematics, &weight).0);
    }
    (curvatures, found)
}

/// The time in which gravity or, without gravity, elasticity moves the strand by its length.
fn natural_time(model: &StrandModel, gravity: Vector3<f64>) -> f64 {
    let length = model.length();
    let fall = (length / gravity.norm()).sqrt();
    let stiffest = model.stiffness.iter().fold(0.0_f64, |a, b| a.max(*b));
    let elastic = length * length * (model.linear_density / stiffest).sqrt();
    if fall.is_finite() { fall } else { elastic }
}

/// The weight of each quadrature point, N.
pub(crate) fn weights(model: &StrandModel, rule_weights: &[f64], gravity: Vector3<f64>) -> Vec<Vec3<f64>> {
    let weight = Vec3::from(gravity * model.linear_density);
    model.lengths.iter().flat_map(|length| rule_weights.iter().map(move |w| weight.scale(w * length))).collect()
}

/// The springs of a proximal step of k seconds from the current kinematics.
fn draw_on(model: &StrandModel, rule_weights: &[f64], gravity: Vector3<f64>, k: f64, iterate: &mut Iterate<f64>) {
    let Iterate { kinematics, system, point_base, curvature_base, point_target, curvature_target, .. } = iterate;
    let points = kinematics.points.len();
    system.resize(model.element_count(), points);
    point_base.clear();
    point_base.resize(points, Vec3::zero());
    curvature_base.clear();
    curvature_base.resize(model.element_count(), [0.0; 3]);
    point_target.resize(points, Vec3::zero());
    curvature_target.clear();
    curvature_target.extend_from_slice(&model.natural);
    let fall = Vec3::from(gravity * (k * k));
    for (element, length) in model.lengths.iter().enumerate() {
        for (node, weight) in rule_weights.iter().enumerate() {
            let p = element * rule_weights.len() + node;
            system.point_stiffness[p] = model.linear_density * weight * length / (k * k);
            point_target[p] = kinematics.points[p].position + fall;
        }
        system.curvature_stiffness[element] = model.stiffness.map(|stiffness| stiffness * length);
    }
}

/// The largest unbalanced moment on a free curvature, relative as in [`EquilibriumOptions::tolerance`].
pub(crate) fn imbalance(
    model: &StrandModel,
    kinematics: &Kinematics<f64>,
    curvatures: &[[f64; 3]],
    weight: &[Vec3<f64>],
    gravity: Vector3<f64>,
) -> f64 {
    let pull = generalised(kinematics, |p| weight[p]);
    let length = model.length();
    let stiffest = model.stiffness.iter().fold(0.0_f64, |a, b| a.max(*b));
    let curved = model.natural.iter().map(|row| Vec3(*row).norm_squared()).fold(0.0, f64::max).sqrt();
    // The elastic term is for nearly weightless strands: their moments balance to the rounding of EI κ.
    let scale = model.linear_density * gravity.norm() * length * length + 1e-4 * stiffest * (1.0 / length + curved);
    let mut largest = 0.0_f64;
    for element in 0..model.element_count() {
        for axis in 0..3 {
            if model.freedoms.contains(axis) {
                let strain = curvatures[element][axis] - model.natural[element][axis];
                let moment = pull[element][axis] / model.lengths[element] - model.stiffness[axis] * strain;
                largest = largest.max(moment.abs() / scale);
            }
        }
    }
    largest
}

/// The smallest eigenvalue of the exact static Hessian against the elastic stiffness, and its eigenvector as curvatures, one row
/// per element. Both NaN where the eigenvalues could not be found.
pub(crate) fn softest(model: &StrandModel, kinematics: &Kinematics<f64>, weight: &[Vec3<f64>]) -> (f64, Vec<[f64; 3]>) {
    let count = model.element_count();
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let mut system = ChainSystem::default();
    system.resize(count, weight.len());
    system.point_force.copy_from_slice(weight);
    for (element, length) in model.lengths.iter().enumerate() {
        system.curvature_stiffness[element] = model.stiffness.map(|stiffness| stiffness * length);
    }
    let hessian = dense::assemble(kinematics, &system, &axes[..free]).matrix;
    let root: Vec<f64> = (0..count * free).map(|i| system.curvature_stiffness[i / free][axes[i % free]].sqrt()).collect();
    let scaled = Mat::from_fn(count * free, count * free, |i, j| hessian[(i, j)] / (root[i] * root[j]));
    let mut mode = vec![[0.0; 3]; count];
    let Ok(eigen) = scaled.self_adjoint_eigen(Side::Lower) else {
        return (f64::NAN, mode);
    };
    let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    let softest = (0..values.len()).min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    for i in 0..count * free {
        mode[i / free][axes[i % free]] = eigen.U()[(i, softest)] / root[i];
    }
    (values[softest], mode)
}

/// Moves off a saddle along a mode. Both directions are equivalent; it takes the one whose largest change is positive.
fn leave_saddle(model: &StrandModel, mode: &[[f64; 3]], curvatures: &mut [[f64; 3]]) {
    let (mut turned, mut largest) = (0.0, 0.0_f64);
    for (row, length) in mode.iter().zip(&model.lengths) {
        turned += length * Vec3(*row).norm_squared().sqrt();
        for x in row {
            if x.abs() > largest.abs() * (1.0 + 1e-9) {
                largest = *x;
            }
        }
    }
    let fraction = KICK / turned * largest.signum();
    for (row, change) in curvatures.iter_mut().zip(mode) {
        for axis in 0..3 {
            row[axis] += fraction * change[axis];
        }
    }
}
