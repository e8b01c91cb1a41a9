//! A step in one piece for strands side by side: computed in the workspace, and made their state only on demand.

use super::loaded;
use super::members::{Pack, StepEnd};
use crate::chain::system::LinearSolve;
use crate::energy::Energies;
use crate::math::frame::Frame;
use crate::math::lane::{Kernel, Lane, MAX_LANES, Precision};
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, lane_of_elements};
use crate::rod::strand::StrandModel;
use crate::step::at_points::contacts::Touching;
use crate::step::context::StepContext;
use crate::step::integrator::{linearly_implicit, stages, tableau};
use crate::step::options::Integrator;
use crate::step::root_velocity::root_velocity;
use crate::step::workspace::Workspace;
use crate::step::{Setting, StrandOutcome};

/// Takes strands through a step of `h` seconds with any integrator but the reference. The strands stay unchanged, and the
/// workspace holds the result. With the second-order integrator all of them must have a usable history, or none.
pub struct Take<'a, T, S> {
    /// The strands.
    pub members: &'a dyn Pack,
    /// The surroundings and the options.
    pub setting: &'a Setting<'a>,
    /// Seconds.
    pub h: f64,
    /// Scratch.
    pub workspace: &'a mut Workspace<T>,
    /// The linear solve.
    pub solver: &'a mut S,
}

impl<T: Lane, S: LinearSolve<T>> Kernel for Take<'_, T, S> {
    type Output = [StrandOutcome; MAX_LANES];
    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { members, setting, h, workspace, solver } = self;
        let mut outcomes = [StrandOutcome::default(); MAX_LANES];
        let mut context = StepContext { members, setting, h, workspace: &mut *workspace, solver, outcomes: &mut outcomes };
        let touches = members.point_contact().is_some();
        match setting.options.integrator {
            Integrator::LinearlyImplicit if !touches => linearly_implicit::take(&mut context),
            Integrator::SecondOrder => stages::two_step(&mut context),
            _ => stages::take(&tableau::IMPLICIT_EULER, &mut context),
        }
        if touches || setting.options.integrator != Integrator::LinearlyImplicit {
            let (force, torque) =
                crate::step::newton::iterate::wrench(&workspace.iterate.kinematics, &workspace.iterate.system.point_force);
            (workspace.wrench_force, workspace.wrench_torque) = (force, torque);
            measure_roots(members, h, workspace);
        }
        list_contacts(members, setting, workspace);
        energies(members, setting, workspace, &mut outcomes);
        let finiteness = finiteness(workspace);
        for lane in 0..workspace.loaded.count {
            outcomes[lane].quarantined |= finiteness.lane(lane) != 0.0;
            outcomes[lane].converged &= !outcomes[lane].quarantined;
        }
        outcomes
    }
}

/// Zero in the lanes where every number of the new state is finite; NaN in the others.
#[inline(always)]
pub(in crate::step) fn finiteness<T: Lane>(workspace: &Workspace<T>) -> T {
    let stage = &workspace.stages[workspace.last_stage];
    let mut sum = T::zero();
    for (row, rate) in workspace.iterate.curvatures.iter().zip(&stage.rates) {
        for axis in 0..3 {
            // Zero times a number is zero where the number is finite, and only there.
            sum += T::zero() * row[axis];
            sum += T::zero() * rate[axis];
        }
    }
    for v in &stage.velocities {
        sum += T::zero() * v.0[0];
        sum += T::zero() * v.0[1];
        sum += T::zero() * v.0[2];
    }
    sum
}

/// The energies at the end of the step.
#[inline(always)]
pub(in crate::step) fn energies<T: Lane>(
    members: &dyn Pack,
    setting: &Setting,
    workspace: &Workspace<T>,
    outcomes: &mut [StrandOutcome; MAX_LANES],
) {
    let (loaded, iterate) = (&workspace.loaded, &workspace.iterate);
    let velocities = &workspace.stages[workspace.last_stage].velocities;
    let rule = setting.rules.rule(members.state(0).rule);
    let (mut kinetic, mut elastic, mut weighted) = (T::zero(), T::zero(), Vec3::zero());
    for (element, length) in loaded.lengths.iter().enumerate() {
        let (mut speeds, mut places) = (T::zero(), Vec3::zero());
        for (node, weight) in rule.weights.iter().enumerate() {
            let p = element * rule.len() + node;
            speeds += velocities[p].norm_squared() * T::splat(*weight);
            places += iterate.kinematics.points[p].position.scale(T::splat(*weight));
        }
        kinetic += speeds * *length;
        weighted += places.scale(*length);
        for axis in 0..3 {
            let strain = iterate.curvatures[element][axis] - loaded.natural[element][axis];
            elastic += *length * loaded.stiffness[axis] * strain * strain;
        }
    }
    let half = T::splat(0.5);
    let (kinetic, elastic) = (half * loaded.linear_density * kinetic, half * elastic);
    for lane in 0..loaded.count {
        let (units, model) = (&loaded.units[lane], members.model(lane));
        // First moment of length: metres squared.
        let weighted = loaded::lane_of(&weighted, lane, units.length * units.length);
        let origin = Vec3::from(workspace.roots[lane].origin).scale(model.length());
        outcomes[lane].energies = Energies {
            kinetic: kinetic.lane(lane) * units.energy(),
            elastic: elastic.lane(lane) * units.energy(),
            gravity: -model.linear_density * setting.surroundings.gravity.dot(weighted + origin),
        };
    }
}

/// The roots' mean velocities over the step; the roots are at its end.
#[inline(always)]
pub fn measure_roots<T: Lane>(members: &dyn Pack, h: f64, workspace: &mut Workspace<T>) {
    for lane in 0..workspace.loaded.count {
        workspace.root_velocities[lane] = root_velocity(&members.state(lane).root, &workspace.roots[lane], h);
    }
}

/// Gives a strand whose step is saved its contacts. The step after one with contact has no history: its formula would throw back what a
/// surface has stopped.
pub fn give_contacts<T: Lane>(members: &mut dyn Pack, lane: usize, workspace: &Workspace<T>) {
    if members.point_contact().is_none() {
        return;
    }
    let mut touches = false;
    for (_, contact) in workspace.point_contacts.iter().filter(|(of, _)| *of == lane) {
        members.take_contact(lane, contact);
        touches = true;
    }
    if touches {
        members.parts(lane).1.history.step = 0.0;
    }
    members.take_depth(lane, workspace.iterate.contacts.depth[lane]);
}

/// Lists the contacts of the pack's strands at the end of the step.
fn list_contacts<T: Lane>(members: &dyn Pack, setting: &Setting, workspace: &mut Workspace<T>) {
    workspace.point_contacts.clear();
    let Some(options) = members.point_contact() else { return };
    let Workspace { loaded, iterate, roots, point_contacts, .. } = workspace;
    let rule = setting.rules.rule(members.state(0).rule);
    let touching = Touching { members, options, rule, units: &loaded.units, roots };
    for lane in 0..loaded.count {
        touching.for_each_contact(iterate, lane, |contact| point_contacts.push((lane, contact)));
    }
}

/// The end of the step of one strand.
pub struct End<'a, T> {
    /// The result.
    pub workspace: &'a Workspace<T>,
    /// Its lane.
    pub lane: usize,
}

impl<T: Lane> StepEnd for End<'_, T> {
    fn root(&self) -> Frame {
        self.workspace.roots[self.lane]
    }
    fn write(&self, model: &StrandModel, curvatures: &mut Vec<[f64; 3]>, elements: &mut Vec<ElementState<f64>>) {
        curvatures.clear();
        curvatures.resize(model.element_count(), [0.0; 3]);
        write_curvatures(self.workspace, self.lane, model, curvatures);
        elements.clear();
        if T::PRECISION == Precision::F64 {
            lane_of_elements(&self.workspace.iterate.kinematics.elements, self.lane, elements);
        }
    }
}

#[inline(always)]
fn write_curvatures<T: Lane>(workspace: &Workspace<T>, lane: usize, model: &StrandModel, curvatures: &mut [[f64; 3]]) {
    let per_length = 1.0 / workspace.loaded.units[lane].length;
    for (row, lanes) in curvatures.iter_mut().zip(&workspace.iterate.curvatures) {
        for axis in 0..3 {
            row[axis] = lanes[axis].lane(lane) * per_length;
        }
    }
    if T::PRECISION == Precision::F32 {
        for (element, (row, compensation)) in curvatures.iter_mut().zip(&workspace.iterate.compensation).enumerate() {
            for axis in 0..3 {
                if model.freedoms.contains(axis) {
                    row[axis] += compensation[axis].lane(lane) * per_length;
                } else {
                    row[axis] = model.natural[element][axis];
                }
            }
        }
    }
}

/// Makes the end of the step the state of one strand.
pub fn save<T: Lane>(members: &mut dyn Pack, lane: usize, setting: &Setting, h: f64, workspace: &Workspace<T>) {
    T::call(Save { members, lane, setting, h, workspace });
}

struct Save<'a, T> {
    members: &'a mut dyn Pack,
    lane: usize,
    setting: &'a Setting<'a>,
    h: f64,
    workspace: &'a Workspace<T>,
}

impl<T: Lane> Kernel for Save<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { members, lane, setting, h, workspace } = self;
        let units = &workspace.loaded.units[lane];
        let (model, state) = members.parts(lane);
        let stage = &workspace.stages[workspace.last_stage];
        if setting.options.integrator == Integrator::SecondOrder {
            std::mem::swap(&mut state.history.curvatures, &mut state.curvatures);
            std::mem::swap(&mut state.history.velocities, &mut state.velocities);
            state.curvatures.resize(state.history.curvatures.len(), [0.0; 3]);
            state.velocities.resize(state.history.velocities.len(), Vec3::zero());
            (state.history.root, state.history.step) = (state.root, h);
        } else {
            state.history.step = 0.0;
        }
        let (per_length, speed) = (1.0 / units.length, units.speed());
        write_curvatures(workspace, lane, model, &mut state.curvatures);
        for (row, lanes) in state.rates.iter_mut().zip(&stage.rates) {
            for axis in 0..3 {
                row[axis] = lanes[axis].lane(lane) * (per_length / units.time);
            }
        }
        for (velocity, lanes) in state.velocities.iter_mut().zip(&stage.velocities) {
            *velocity = loaded::lane_of(lanes, lane, speed);
        }
        state.wrench_force = loaded::lane_of(&workspace.wrench_force, lane, units.force());
        state.wrench_torque = loaded::lane_of(&workspace.wrench_torque, lane, units.energy());
        let root = workspace.roots[lane];
        (state.root_velocity, state.root_angular_velocity) = workspace.root_velocities[lane];
        state.root = root;
    }
}
