//! The papers' step (Bertails et al. 2006, section 3.4; document 004, section 4.2.8), kept with its second-order terms: elasticity and
//! Kelvin–Voigt friction implicit; gravity, drag, internal friction γ and velocity products explicit; one linear solve:
//! (M + h²K + hμK) Δ = h [A − K(q + h q̇ − qⁿ) − (μK + γ) q̇], q̇ ← q̇ + Δ, q ← q + h q̇.

use super::newton;
use super::stages::root_velocity;
use super::state::{StrandState, rotation_matrix};
use super::workspace::Workspace;
use super::{Setting, StrandOutcome};
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use crate::rod::velocity::{self, RootMotion};

/// Takes one strand through a step; see [`super::take`].
pub fn take(setting: &Setting, state: &mut StrandState, root: &Frame, h: f64, workspace: &mut Workspace) -> StrandOutcome {
    let Setting { model, surroundings, options, rules } = *setting;
    let rule = rules.rule(state.rule);
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    // The root's mean velocity over the step, and the acceleration to it from the last one.
    let (velocity_end, angular_end) = root_velocity(&state.root, root, h);
    let motion = RootMotion {
        velocity: state.root_velocity.into(),
        angular_velocity: state.root_angular_velocity.into(),
        acceleration: ((velocity_end - state.root_velocity) / h).into(),
        angular_acceleration: ((angular_end - state.root_angular_velocity) / h).into(),
    };

    workspace.kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
    let points = workspace.kinematics.points.len();
    workspace.system.resize(model.element_count(), points);
    workspace.system.exact = false;
    let density = model.linear_density;
    let per_element = rule.len();
    {
        let system = &mut workspace.system;
        let (gravity, wind, drag) = (surroundings.gravity, surroundings.wind, model.material.air_drag);
        velocity::for_each_point(&workspace.kinematics, &state.rates, &motion, |p, v, a| {
            let weight = rule.weights[p % per_element] * model.lengths[p / per_element];
            let force = (gravity - a).scale(density) - (v - wind).scale(drag);
            system.point_stiffness[p] = density * weight;
            system.point_force[p] = force.scale(h * weight);
        });
        for (element, length) in model.lengths.iter().enumerate() {
            for axis in 0..3 {
                let (stiffness, viscosity) = (model.stiffness[axis], model.material.viscosity * model.stiffness[axis]);
                let (strain, rate) = (state.curvatures[element][axis] - model.natural[element][axis], state.rates[element][axis]);
                system.curvature_stiffness[element][axis] = length * (h * h * stiffness + h * viscosity);
                system.curvature_force[element][axis] =
                    -h * length * (stiffness * (strain + h * rate) + (viscosity + model.material.internal_friction) * rate);
            }
        }
    }
    let found = newton::direction(workspace, &axes[..free], options.linear_solver);
    let finite = found.rotation_squared.is_finite() && found.descent.is_finite();
    let outcome = StrandOutcome {
        iterations: 1,
        converged: finite,
        quarantined: !finite,
        condition: found.condition,
        ..StrandOutcome::default()
    };
    if outcome.quarantined {
        return outcome;
    }

    // The follicle feels weight, drag and inertia of the whole motion: a = J q̈ + what needs no q̈.
    let accelerations: &[[f64; 3]] = &workspace.change;
    let inertia = &mut workspace.system.point_force;
    velocity::for_each_point(&workspace.kinematics, accelerations, &RootMotion::still(), |p, change, _| {
        let weight = rule.weights[p % per_element] * model.lengths[p / per_element];
        inertia[p] = (inertia[p] - change.scale(density * weight)).scale(1.0 / h);
    });
    (state.wrench_force, state.wrench_torque) = newton::wrench(&workspace.kinematics, inertia);

    for (element, change) in workspace.change.iter().enumerate() {
        for axis in 0..3 {
            if model.freedoms.contains(axis) {
                state.rates[element][axis] += change[axis];
                state.curvatures[element][axis] += h * state.rates[element][axis];
            } else {
                state.rates[element][axis] = 0.0;
                state.curvatures[element][axis] = model.natural[element][axis];
            }
        }
    }
    state.root_velocity = velocity_end;
    state.root_angular_velocity = angular_end;
    state.root = *root;

    workspace.kinematics.update(&rotation_matrix(root), &model.lengths, &state.curvatures, rule);
    let root_motion =
        RootMotion { velocity: Vec3::from(velocity_end), angular_velocity: Vec3::from(angular_end), ..RootMotion::still() };
    let velocities = &mut state.velocities;
    velocity::for_each_point(&workspace.kinematics, &state.rates, &root_motion, |p, v, _| velocities[p] = v);
    outcome
}
