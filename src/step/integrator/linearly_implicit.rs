//! The linearly implicit step of the papers (Bertails et al. 2006, section 3.4; Bergbom 2007, section 4.2.8), with its
//! second-order terms.
//!
//! Elasticity, Kelvin–Voigt friction and targets are implicit; gravity, drag, internal friction γ and velocity products explicit. It takes
//! one linear solve: (M + h²K + hμK) Δ = h [A − K(q + h q̇ − qⁿ) − (μK + γ) q̇], q̇ ← q̇ + Δ, q ← q + h q̇.

use nalgebra::Vector3;

use super::stages;
use crate::chain::system::LinearSolve;
use crate::energy::{drag, target};
use crate::math::lane::{Lane, Precision};
use crate::math::vector::Vec3;
use crate::rod::velocity::{self, RootMotion};
use crate::step::StrandOutcome;
use crate::step::context::StepContext;
use crate::step::newton::iterate::wrench;
use crate::step::pack::loaded::{self, Reads};
use crate::step::pack::members::Pack;
use crate::step::pack::whole;
use crate::step::workspace::Workspace;

/// Takes strands through a step of `h` seconds; see [`crate::step::pack::whole::Take`].
#[inline(always)]
pub fn take<T: Lane, S: LinearSolve<T>>(context: &mut StepContext<'_, T, S>) {
    let (members, setting, h) = (context.members, context.setting, context.h);
    let (workspace, solver, outcomes) = (&mut *context.workspace, &mut *context.solver, &mut *context.outcomes);
    let rule = setting.rules.rule(members.state(0).rule);
    let freedoms = members.model(0).freedoms;
    let (axes, free) = (freedoms.axes(), freedoms.count());
    workspace.loaded.load(members, setting.surroundings, h, Reads { velocities: false, history: false });
    let (end_rotation, _) = stages::move_roots(h, members, workspace);
    workspace.loaded.targets.load(members, h, rule, &workspace.loaded.units);
    whole::measure_roots(members, h, workspace);
    let (start, end) = root_motions(members, h, workspace);
    let Workspace { loaded, iterate, stages, .. } = workspace;
    let step = loaded.step;

    iterate.kinematics.update(&loaded.rotation, &loaded.lengths, &loaded.curvatures, rule);
    let points = iterate.kinematics.points.len();
    let per_element = rule.len();
    iterate.system.resize(loaded.lengths.len(), points);
    iterate.system.exact = false;
    iterate.system.rotation_stiffness = T::zero();
    {
        let system = &mut iterate.system;
        let (density, air_drag) = (loaded.linear_density, loaded.air_drag);
        velocity::for_each_point(&iterate.kinematics, &loaded.rates, &start, |p, v, a| {
            let weight = T::splat(rule.weights[p % per_element]) * loaded.lengths[p / per_element];
            let mut force = (loaded.gravity - a).scale(density);
            if loaded.has_drag {
                let wind = if loaded.has_air { loaded.air[p] } else { loaded.wind };
                force -= drag::resistance(v, wind, air_drag);
            }
            let mut inertia = density;
            if loaded.targets.are_present {
                let (place, velocity) = (loaded.targets.positions[p], loaded.targets.velocities[p]);
                let rate = loaded.targets.rates[p];
                let (spring, damping) = (target::spring(density, rate), target::damping(density, rate));
                let end = v + a.scale(step);
                let leads_to = iterate.kinematics.points[p].position + end.scale(step);
                force += (place - leads_to).scale(spring) + (velocity - end).scale(damping);
                inertia += step * (damping + step * spring);
            }
            system.point_stiffness[p] = inertia * weight;
            system.point_force[p] = force.scale(step * weight);
        });
        for (element, length) in loaded.lengths.iter().enumerate() {
            for axis in 0..3 {
                let (stiffness, dissipation) = (loaded.stiffness[axis], loaded.dissipation[axis]);
                let viscosity = loaded.viscosity[axis];
                let (curvature, rate) = (loaded.curvatures[element][axis], loaded.rates[element][axis]);
                let strain = curvature - loaded.natural[element][axis];
                system.curvature_stiffness[element][axis] = *length * (step * step * stiffness + step * viscosity);
                system.curvature_force[element][axis] =
                    -(step * *length * (stiffness * (strain + step * rate) + dissipation * rate));
            }
        }
    }
    let found = solver.solve(&iterate.kinematics, &iterate.system, &axes[..free], &mut iterate.change);
    for (lane, outcome) in outcomes.iter_mut().enumerate().take(loaded.count) {
        let finite = found.rotation_squared.lane(lane).is_finite() && found.descent.lane(lane).is_finite();
        *outcome = StrandOutcome {
            iterations: 1,
            converged: finite,
            quarantined: !finite,
            condition: found.condition,
            ..StrandOutcome::default()
        };
    }

    // The follicle carries weight, drag, targets' pulls and the inertia of the whole motion: a = J q̈ + the acceleration without q̈.
    let (inertia, stiffness) = (&mut iterate.system.point_force, &iterate.system.point_stiffness);
    let rate = T::one() / step;
    velocity::for_each_point(&iterate.kinematics, &iterate.change, &RootMotion::still(), |p, change, _| {
        inertia[p] = (inertia[p] - change.scale(stiffness[p])).scale(rate);
    });
    (workspace.wrench_force, workspace.wrench_torque) = wrench(&iterate.kinematics, inertia);

    let stage = &mut stages[0];
    stage.resize(loaded.lengths.len(), points);
    iterate.curvatures.resize(loaded.lengths.len(), [T::zero(); 3]);
    if T::PRECISION == Precision::F32 {
        iterate.compensation.resize(loaded.lengths.len(), [T::zero(); 3]);
    }
    for (element, row) in iterate.curvatures.iter_mut().enumerate() {
        for axis in 0..3 {
            if freedoms.contains(axis) {
                let rate = loaded.rates[element][axis] + iterate.change[element][axis];
                stage.rates[element][axis] = rate;
                if T::PRECISION == Precision::F32 {
                    let change = step * rate + loaded.compensation[element][axis];
                    (row[axis], iterate.compensation[element][axis]) = loaded.curvatures[element][axis].two_sum(change);
                } else {
                    row[axis] = loaded.curvatures[element][axis] + step * rate;
                }
            } else {
                stage.rates[element][axis] = T::zero();
                row[axis] = loaded.natural[element][axis];
            }
        }
    }
    iterate.kinematics.update(&end_rotation, &loaded.lengths, &iterate.curvatures, rule);
    let velocities = &mut stage.velocities;
    velocity::for_each_point(&iterate.kinematics, &stage.rates, &end, |p, v, _| velocities[p] = v);
    workspace.last_stage = 0;
}

/// The motion of the roots over the step as seen from its start and from its end: the step's mean velocity at its end, and the
/// acceleration from the last mean velocity to that.
#[inline(always)]
fn root_motions<T: Lane>(members: &dyn Pack, h: f64, workspace: &Workspace<T>) -> (RootMotion<T>, RootMotion<T>) {
    let (mut start, mut end) = (RootMotion::still(), RootMotion::still());
    for lane in 0..T::LANES {
        let member = workspace.loaded.member(lane);
        let (state, units) = (members.state(member), &workspace.loaded.units[lane]);
        let (velocity, angular) = workspace.root_velocities[member];
        let acceleration = (velocity - state.root_velocity) / h;
        let angular_acceleration = (angular - state.root_angular_velocity) / h;
        let put = |to: &mut Vec3<T>, from: Vector3<f64>, factor: f64| loaded::put(&mut to.0, lane, &from.into(), factor);
        let time = units.time;
        put(&mut start.velocity, state.root_velocity, 1.0 / units.speed());
        put(&mut start.angular_velocity, state.root_angular_velocity, time);
        put(&mut start.acceleration, acceleration, time / units.speed());
        put(&mut start.angular_acceleration, angular_acceleration, time * time);
        put(&mut end.velocity, velocity, 1.0 / units.speed());
        put(&mut end.angular_velocity, angular, time);
    }
    (start, end)
}
