//! Implicit Euler as a minimisation: the step's end minimises
//! Φ(q) = Σ w ρS/(2h²) |r(q) − r_t − h v_t|² − Σ w ρS g·r + Σ w ν/(2h) |r − r_t − h·wind|² + ½ (q−qⁿ)ᵀK(q−qⁿ) + (q−q_t)ᵀD(q−q_t)/(2h).
//! Velocity products need no code: they are in r(q). The root moves first, rigidly; r_t stays in the world.

use super::newton::{self, Problem};
use super::options::StepOptions;
use super::state::{StrandState, rotation_matrix};
use super::workspace::Workspace;
use super::{StrandOutcome, Surroundings};
use crate::energy::{CurvatureQuadratic, PointQuadratic, drag, elastic, friction, gravity, inertia};
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::rotation_vector;
use crate::math::vector::Vec3;
use crate::rod::strand::StrandModel;

/// Takes one strand through a step; see [`super::take`].
#[allow(clippy::too_many_arguments)]
pub fn take(
    model: &StrandModel,
    state: &mut StrandState,
    root: &Frame,
    h: f64,
    surroundings: &Surroundings,
    options: &StepOptions,
    rules: &Rules,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let rule = rules.rule(state.rule);
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let end_rotation = rotation_matrix(root);
    let problem = Problem { root: &end_rotation, lengths: &model.lengths, axes: &axes[..free], rule };

    // Where the points are now, seen from where the root will be.
    let root_way = root.origin - state.root.origin;
    workspace.kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
    let way = Vec3::from(root_way);
    workspace.base.clear();
    workspace.base.extend(workspace.kinematics.points.iter().map(|point| point.position - way));

    assemble_terms(model, state, h, surroundings, rule.weights.as_slice(), workspace);

    // Start from where the rates lead, or from where it is, whichever is nearer to the minimum. Frozen curvatures are natural.
    workspace.curvatures.clone_from(&state.curvatures);
    for (row, natural) in workspace.curvatures.iter_mut().zip(&model.natural) {
        for axis in 0..3 {
            if !model.freedoms.contains(axis) {
                row[axis] = natural[axis];
            }
        }
    }
    workspace.trial_curvatures.clone_from(&workspace.curvatures);
    for (row, rate) in workspace.trial_curvatures.iter_mut().zip(&state.rates) {
        for axis in &axes[..free] {
            row[*axis] += h * rate[*axis];
        }
    }
    newton::choose_start(&problem, workspace);

    let outcome = newton::minimise(&problem, options, workspace);
    if outcome.quarantined {
        return outcome;
    }
    for ((row, rate), new) in state.curvatures.iter_mut().zip(&mut state.rates).zip(&workspace.curvatures) {
        for axis in 0..3 {
            rate[axis] = (new[axis] - row[axis]) / h;
            row[axis] = new[axis];
        }
    }
    for ((velocity, point), base) in state.velocities.iter_mut().zip(&workspace.kinematics.points).zip(&workspace.base) {
        *velocity = (point.position - *base).scale(1.0 / h);
    }
    (state.wrench_force, state.wrench_torque) = newton::wrench(&workspace.kinematics, &workspace.system.point_force);
    state.root_velocity = root_way / h;
    state.root_angular_velocity = state.root.rotation * (rotation_vector(&(state.root.rotation.inverse() * root.rotation)) / h);
    state.root = *root;
    outcome
}

/// Sums the terms of every point and curvature into a stiffness and a target.
fn assemble_terms(
    model: &StrandModel,
    state: &StrandState,
    h: f64,
    surroundings: &Surroundings,
    weights: &[f64],
    workspace: &mut Workspace,
) {
    let points = workspace.base.len();
    workspace.system.resize(model.element_count(), points);
    workspace.point_target.resize(points, Vec3::zero());
    workspace.curvature_target.resize(model.element_count(), [0.0; 3]);
    let per_element = weights.len();
    for (element, length) in model.lengths.iter().enumerate() {
        for (node, weight) in weights.iter().enumerate() {
            let p = element * per_element + node;
            let mut quadratic = PointQuadratic::zero();
            inertia::add(&mut quadratic, model.linear_density, h, state.velocities[p]);
            gravity::add(&mut quadratic, model.linear_density, surroundings.gravity);
            if model.material.air_drag > 0.0 {
                drag::add(&mut quadratic, model.material.air_drag, h, surroundings.wind);
            }
            workspace.system.point_stiffness[p] = quadratic.stiffness * (weight * length);
            workspace.point_target[p] = workspace.base[p] + quadratic.pull.scale(1.0 / quadratic.stiffness);
        }
        for axis in 0..3 {
            let start = state.curvatures[element][axis];
            let mut quadratic = CurvatureQuadratic::zero();
            elastic::add(&mut quadratic, model.stiffness[axis], model.natural[element][axis], start);
            if model.dissipation[axis] > 0.0 {
                friction::add(&mut quadratic, model.dissipation[axis], h);
            }
            workspace.system.curvature_stiffness[element][axis] = quadratic.stiffness * length;
            workspace.curvature_target[element][axis] = start + quadratic.pull / quadratic.stiffness;
        }
    }
}
