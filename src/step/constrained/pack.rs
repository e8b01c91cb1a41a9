//! A pack of constrained strands: the work of [`super::step`] that is the same for all of them, side by side.
//!
//! The strands of a pack have one [`PackKey`](crate::step::pack::members::PackKey) and begin together; each then takes its own path, and
//! may wait while others go on: no lane's result depends on the others.

use super::loads::PackLoads;
use super::step::{ConstrainedStep, Lanes, running};
use crate::chain::elimination::Elimination;
use crate::chain::response::ResponseScratch;
use crate::chain::system::{Direction, LinearSolve};
use crate::math::lane::{Kernel, Lane, MAX_LANES};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::freedoms::Freedoms;
use crate::rod::kinematics::{ElementState, element_states, lane_of_elements};
use crate::step::integrator::stages::{self, StageTimes};
use crate::step::newton::iterate::{Problem, choose_start, forces, place_trial, predict_tension, wrench};
use crate::step::newton::line_search::{self, LineSearch, Merit};
use crate::step::options::Integrator;
use crate::step::pack::loaded::lane_of;
use crate::step::pack::members::Pack;
use crate::step::pack::whole;
use crate::step::scratch::Bench;
use crate::step::state::RuleScratch;
use crate::step::workspace::Workspace;
use crate::step::{Setting, StrandOutcome, keep, newton};

/// A pack during its strands' step.
#[derive(Debug)]
pub struct ConstrainedPack<T> {
    bench: Bench<T>,
    /// The elements at the start of the step.
    start: Vec<ElementState<T>>,
    rotation: Mat3<T>,
    offset: Vec3<T>,
    times: StageTimes<T>,
    freedoms: Freedoms,
    rule: usize,
    /// The lanes with a lagged tension, from which the geometric terms of the exact Hessian come. The others have no such
    /// terms.
    exact: u32,
    loads: PackLoads<T>,
    moved: Vec<Vec3<T>>,
    scratch: ResponseScratch<T>,
}

impl<T: Lane> Default for ConstrainedPack<T> {
    fn default() -> Self {
        Self {
            bench: Bench::default(),
            start: Vec::new(),
            rotation: Mat3::zero(),
            offset: Vec3::zero(),
            times: StageTimes { index: 0, k: T::zero(), span: T::zero() },
            freedoms: Freedoms::default(),
            rule: 0,
            exact: 0,
            loads: PackLoads::default(),
            moved: Vec::new(),
            scratch: ResponseScratch::default(),
        }
    }
}

impl<T: Lane> ConstrainedPack<T> {
    /// Makes room for this many material points.
    pub fn make_room(&mut self, material_points: usize) {
        self.loads.make_room(material_points);
        self.moved.reserve(material_points.saturating_sub(self.moved.len()));
    }

    /// Begins a step of `h` seconds of strands with one pack key, a lane each; `first_order`: by implicit Euler, whatever the
    /// setting.
    pub fn begin(&mut self, members: &dyn Pack, setting: &Setting, h: f64, first_order: bool, strands: Lanes) {
        T::call(Begin { pack: self, members, setting, h, first_order, strands });
    }

    /// First half of an iteration, of strands whose material points were set by [`ConstrainedStep::hold`].
    pub fn linearise(&mut self, strands: Lanes) {
        T::call(Linearise { pack: self, strands });
    }

    /// Second half: moves the strands as their forces ([`ConstrainedStep::pull`]) say.
    pub fn advance(&mut self, setting: &Setting, strands: Lanes) {
        T::call(Advance { pack: self, setting, strands });
    }

    /// Adds a bend to all elements of one strand, 1/m about n1 and n2: the iteration goes on from there. (Frozen freedoms get
    /// none.)
    pub fn bend(&mut self, lane: usize, curvature: [f64; 2], setting: &Setting, constrained: &mut ConstrainedStep) {
        let size = (curvature[0] * curvature[0] + curvature[1] * curvature[1]).sqrt();
        let change = match (self.freedoms.contains(1), self.freedoms.contains(2)) {
            (true, true) => [0.0, curvature[0], curvature[1]],
            (true, false) => [0.0, size, 0.0],
            (false, true) => [0.0, 0.0, size],
            (false, false) => return,
        };
        let Workspace { loaded, iterate, .. } = &mut self.bench.workspace;
        iterate.trial_curvatures.clone_from(&iterate.curvatures);
        for row in &mut iterate.trial_curvatures {
            for axis in 0..3 {
                row[axis].set_lane(lane, row[axis].lane(lane) + change[axis]);
            }
        }
        let axes = self.freedoms.axes();
        let rule = setting.rules.rule(self.rule);
        let axes = &axes[..self.freedoms.count()];
        let problem = Problem { root: &self.rotation, lengths: &loaded.lengths, axes, rule, tension_at_start: false };
        constrained.potential = Merit::of_lane(place_trial(&problem, iterate), lane);
        lane_of_elements(&iterate.trial.elements, lane, &mut constrained.trial);
        constrained.accept();
        std::mem::swap(&mut iterate.kinematics, &mut iterate.trial);
        std::mem::swap(&mut iterate.curvatures, &mut iterate.trial_curvatures);
        constrained.before = None;
        constrained.stretch.forget();
    }

    /// Computes the end of the step, before [`ConstrainedPack::end`].
    pub fn finish(&mut self, members: &dyn Pack, setting: &Setting, h: f64, strands: Lanes) {
        T::call(Finish { pack: self, members, setting, h, strands });
    }

    /// Ends the step of one strand: its end becomes the strand's state, unless it is not finite, or has not converged and is
    /// bent by more than `max_elastic` (J), which means that it has diverged.
    #[allow(clippy::too_many_arguments, reason = "a strand, and what its step is of")]
    pub fn end(
        &self,
        lane: usize,
        member: &mut dyn Pack,
        setting: &Setting,
        h: f64,
        max_elastic: f64,
        scratch: &mut RuleScratch,
        constrained: &mut ConstrainedStep,
    ) {
        let outcome = &mut constrained.outcome;
        let nowhere = !outcome.converged && outcome.energies.elastic > max_elastic;
        outcome.quarantined |= nowhere || !constrained.finite;
        if outcome.quarantined {
            outcome.converged = false;
        } else {
            keep(member, lane, setting, h, &self.bench.workspace, scratch);
        }
    }

    /// Newton's direction with the forces in place; the strands get the displacements of their material points along it.
    #[inline(always)]
    fn direct(&mut self, strands: Lanes) -> Direction<T> {
        let axes = self.freedoms.axes();
        let axes = &axes[..self.freedoms.count()];
        let Bench { workspace, elimination } = &mut self.bench;
        let iterate = &mut workspace.iterate;
        let (change, moved, loads) = (&mut iterate.change, &mut self.moved, &self.loads);
        let found =
            elimination.direction(&iterate.kinematics, &loads.loads, &loads.forces, axes, &mut self.scratch, change, moved);
        for (lane, constrained) in running(strands) {
            constrained.unconstrained.clear();
            constrained.unconstrained.extend(constrained.slots.iter().map(|slot| lane_of(&moved[*slot as usize], lane, 1.0)));
        }
        found
    }
}

struct Begin<'a, 'b, T> {
    pack: &'a mut ConstrainedPack<T>,
    members: &'a dyn Pack,
    setting: &'a Setting<'a>,
    h: f64,
    first_order: bool,
    strands: Lanes<'a, 'b>,
}

impl<T: Lane> Kernel for Begin<'_, '_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { pack, members, setting, h, first_order, strands } = self;
        let workspace = &mut pack.bench.workspace;
        let two_step = setting.options.integrator == Integrator::SecondOrder && stages::uses_history(members.state(0), h);
        pack.times = if two_step && !first_order {
            stages::start_backward_difference(members, setting, h, workspace).0
        } else {
            stages::start_euler(members, setting, h, workspace)
        };
        let loaded = &workspace.loaded;
        element_states(loaded.rotation, loaded.lengths.iter().copied(), &loaded.curvatures, &mut pack.start);
        (pack.rotation, pack.offset) = stages::move_roots(h, members, workspace);
        (pack.freedoms, pack.rule) = (members.model(0).freedoms, members.state(0).rule);
        workspace.last_stage = 0;

        let rule = setting.rules.rule(pack.rule);
        let axes = pack.freedoms.axes();
        let axes = &axes[..pack.freedoms.count()];
        let Workspace { loaded, iterate, stages, roots, .. } = workspace;
        loaded.targets.load(members, h, rule, &loaded.units);
        stages::assemble_terms(pack.times.k, pack.offset, &rule.weights, loaded, &stages[0], iterate);
        stages::lead(pack.times.span, pack.freedoms, loaded, None, iterate);
        let problem = Problem { root: &pack.rotation, lengths: &loaded.lengths, axes, rule, tension_at_start: false };
        let potential = choose_start(&problem, iterate, Some(&loaded.rotation));
        iterate.system.point_tension.clear();
        (iterate.system.exact, pack.exact) = (false, 0);
        pack.loads.clear();
        let usual = newton::usual_damping(iterate);
        for (lane, constrained) in running(strands) {
            lane_of_elements(&pack.start, lane, &mut constrained.start);
            lane_of_elements(&iterate.kinematics.elements, lane, &mut constrained.now);
            (constrained.start_origin, constrained.origin) = (members.state(lane).root.origin, roots[lane].origin);
            constrained.begin(Merit::of_lane(potential, lane), usual.lane(lane));
        }
    }
}

struct Linearise<'a, 'b, T> {
    pack: &'a mut ConstrainedPack<T>,
    strands: Lanes<'a, 'b>,
}

impl<T: Lane> Kernel for Linearise<'_, '_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { pack, strands } = self;
        let axes = pack.freedoms.axes();
        let axes = &axes[..pack.freedoms.count()];
        let iterate = &mut pack.bench.workspace.iterate;
        forces(iterate);
        for (lane, constrained) in running(strands) {
            constrained.load(iterate, lane, pack.exact >> lane & 1 == 1);
        }
        pack.loads.lay_out(iterate.kinematics.elements.len(), strands);
        for tries in 0..=newton::MAX_DAMPINGS {
            pack.loads.fill(strands);
            let Bench { workspace, elimination } = &mut pack.bench;
            let iterate = &mut workspace.iterate;
            let damping =
                |lane: usize| strands.get(lane).and_then(Option::as_ref).map_or(0.0, |constrained| constrained.damping.value);
            iterate.system.rotation_stiffness = T::from_lanes(damping);
            let found =
                elimination.solve_loaded(&iterate.kinematics, &iterate.system, &pack.loads.loads, axes, &mut iterate.change);
            // A strand that is good keeps its damping and its system.
            let mut good = true;
            for (_, constrained) in running(strands).filter(|(lane, _)| found.repaired.lane(*lane) != 0.0) {
                if tries < newton::MAX_DAMPINGS {
                    constrained.stiffen();
                    good = false;
                }
            }
            if good {
                break;
            }
        }
        let Bench { workspace, elimination } = &pack.bench;
        for (lane, constrained) in running(strands) {
            constrained.delassus.update(elimination, &workspace.iterate.kinematics, lane, &constrained.loads, axes);
        }
        pack.loads.rest();
        pack.direct(strands);
    }
}

struct Advance<'a, 'b, T> {
    pack: &'a mut ConstrainedPack<T>,
    setting: &'a Setting<'a>,
    strands: Lanes<'a, 'b>,
}

impl<T: Lane> Kernel for Advance<'_, '_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { pack, setting, strands } = self;
        pack.loads.pull(strands);
        let found = pack.direct(strands);
        let axes = pack.freedoms.axes();
        let axes = &axes[..pack.freedoms.count()];
        let Workspace { loaded, iterate, .. } = &mut pack.bench.workspace;
        let limit = Elimination::<T>::ROTATION_LIMIT;
        let rule = setting.rules.rule(pack.rule);
        let problem = Problem { root: &pack.rotation, lengths: &loaded.lengths, axes, rule, tension_at_start: false };
        let (mut part, mut from, mut rotation) = ([0.0; MAX_LANES], [Merit::default(); MAX_LANES], [0.0; MAX_LANES]);
        let mut potential = [Merit::default(); MAX_LANES];
        let mut moving = 0;
        for (lane, constrained) in running(strands) {
            constrained.outcome.iterations += 1;
            rotation[lane] = found.rotation_squared.lane(lane).sqrt();
            if !(rotation[lane].is_finite() && found.descent.lane(lane).is_finite()) {
                (constrained.outcome.quarantined, constrained.residual) = (true, f64::INFINITY);
                continue;
            }
            from[lane] = constrained.lagrangian(constrained.potential, &constrained.now);
            part[lane] = line_search::first_fraction(rotation[lane], limit);
            part[lane] *= constrained.stretch.along(&iterate.change, &found, lane, constrained.damping.value);
            moving |= 1 << lane;
        }
        let search = LineSearch { problem: &problem, descent: found.descent, from: &from, trusted: 0 };
        // No decrease above rounding: as good as the potential can tell.
        let (pending, to) = search.run(iterate, &mut part, moving, |iterate, lane, at| {
            let Some(constrained) = &mut strands[lane] else { return at };
            lane_of_elements(&iterate.trial.elements, lane, &mut constrained.trial);
            potential[lane] = at;
            constrained.lagrangian(at, &constrained.trial)
        });
        moving &= !pending;
        std::mem::swap(&mut iterate.kinematics, &mut iterate.trial);
        std::mem::swap(&mut iterate.curvatures, &mut iterate.trial_curvatures);
        for (lane, constrained) in running(strands) {
            if pending >> lane & 1 == 1 {
                (constrained.outcome.residual, constrained.residual) = (rotation[lane], rotation[lane]);
            }
            if moving >> lane & 1 == 0 {
                constrained.stretch.forget();
                continue;
            }
            constrained.accept();
            constrained.potential = potential[lane];
            constrained.stretch.went(part[lane]);
            line_search::teach(&mut constrained.damping, &found, lane, from[lane], to[lane]);
            let newton = constrained.damping.value == 0.0 && part[lane] == 1.0;
            let quadratic = newton && pack.exact >> lane & 1 == 1;
            constrained.outcome.residual = line_search::left(rotation[lane], quadratic, constrained.before);
            constrained.residual = constrained.outcome.residual;
            constrained.before = newton.then_some(rotation[lane]);
        }
        if setting.options.exact_hessian && moving != 0 {
            pack.predict_tension(&part, moving);
        }
    }
}

impl<T: Lane> ConstrainedPack<T> {
    /// The lagged tension of the lanes that have moved, by a fraction `part` of the direction each. The others keep theirs.
    #[inline(always)]
    fn predict_tension(&mut self, part: &[f64; MAX_LANES], moved: u32) {
        let axes = self.freedoms.axes();
        let iterate = &mut self.bench.workspace.iterate;
        std::mem::swap(&mut iterate.system.point_tension, &mut iterate.spare_tension);
        predict_tension(iterate, &axes[..self.freedoms.count()], part);
        let others = ((1_u32 << T::LANES) - 1) & !moved;
        if others != 0 {
            let moved = T::mask(moved);
            if self.exact == 0 {
                iterate.spare_tension.clear();
            }
            iterate.spare_tension.resize(iterate.system.point_tension.len(), Vec3::zero());
            for (now, before) in iterate.system.point_tension.iter_mut().zip(&iterate.spare_tension) {
                (0..3).for_each(|axis| now.0[axis] = T::select(moved, now.0[axis], before.0[axis]));
            }
        }
        self.exact |= moved;
        iterate.system.exact = true;
    }
}

struct Finish<'a, 'b, T> {
    pack: &'a mut ConstrainedPack<T>,
    members: &'a dyn Pack,
    setting: &'a Setting<'a>,
    h: f64,
    strands: Lanes<'a, 'b>,
}

impl<T: Lane> Kernel for Finish<'_, '_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { pack, members, setting, h, strands } = self;
        let workspace = &mut pack.bench.workspace;
        let axes = pack.freedoms.axes();
        forces(&mut workspace.iterate);
        let Workspace { iterate, stages, .. } = &mut *workspace;
        stages::finish_stage(pack.times.k, pack.offset, &axes[..pack.freedoms.count()], iterate, &mut stages[0]);
        let (force, torque) = wrench(&iterate.kinematics, &iterate.system.point_force);
        (workspace.wrench_force, workspace.wrench_torque) = (force, torque);
        for (lane, constrained) in running(strands) {
            let (force, torque) = constrained.wrench(lane_of(&force, lane, 1.0), lane_of(&torque, lane, 1.0));
            for axis in 0..3 {
                workspace.wrench_force.0[axis].set_lane(lane, force.0[axis]);
                workspace.wrench_torque.0[axis].set_lane(lane, torque.0[axis]);
            }
        }
        whole::measure_roots(members, h, workspace);
        let mut outcomes = [StrandOutcome::default(); MAX_LANES];
        whole::energies(members, setting, workspace, &mut outcomes);
        let finiteness = whole::finiteness(workspace);
        for (lane, constrained) in running(strands) {
            (constrained.outcome.energies, constrained.finite) = (outcomes[lane].energies, finiteness.lane(lane) == 0.0);
        }
    }
}
