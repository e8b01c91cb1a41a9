//! The step of a strand that forces from outside hold at stations, one Newton iteration at a time, so that between iterations somebody
//! else can say what the forces are: contact and constraints, which may tie many strands together.
//!
//! Each iteration has two halves. [`Held::linearise`] gives what the stations would do without forces, and their Delassus operator;
//! [`Held::advance`] goes the way that the forces lead to, a descent of the Lagrangian Φ(q) − Σ λ·r(q) with the forces λ as they are
//! then. The step ends where neither the forces nor the shape change any more. It is of implicit Euler, or of second order where that
//! is asked for and the strand has a past.

use nalgebra::Vector3;

use super::damping::Damping;
use super::iterate::{Iterate, Problem, choose_start, forces, foresee, place_trial, wrench};
use super::members::One;
use super::options::Integrator;
use super::scratch::Bench;
use super::stages::{self, StageTimes};
use super::state::RuleScratch;
use super::{Setting, StrandOutcome, keep, newton, whole};
use crate::chain::delassus::Delassus;
use crate::chain::load::{Load, Station};
use crate::chain::response::ResponseScratch;
use crate::chain::system::LinearSolve;
use crate::math::lane::MAX_LANES;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::freedoms::Freedoms;
use crate::rod::kinematics::{ElementState, Kinematics, element_states};

/// A bond between a station and the world: what it holds, and how far that is from holding at the present iterate.
#[derive(Debug, Clone, Copy)]
pub struct WorldBond {
    /// The projector on the directions that it holds, world axes.
    pub held: Mat3<f64>,
    /// From where it holds to where the station is, along those directions, m.
    pub off: Vec3<f64>,
}

/// Springs on the bonds are made stiffer by that factor where they do not do, up to so many times what is tried first; then the rotations
/// are held back too.
const STIFFER: f64 = 16.0;
const STIFFEST: f64 = 256.0;

/// One strand in the course of its step.
#[derive(Debug)]
pub struct Held {
    bench: Bench<f64>,
    /// The strand's elements as the step found them, from where the root was then.
    start: Vec<ElementState<f64>>,
    start_origin: Vector3<f64>,
    origin: Vector3<f64>,
    rotation: Mat3<f64>,
    offset: Vec3<f64>,
    times: StageTimes<f64>,
    freedoms: Freedoms,
    rule: usize,
    potential: (f64, f64),
    /// The strand's elements as the iteration began, and the potential and its rounding there.
    guess: Vec<ElementState<f64>>,
    guessed: (f64, f64),
    damping: Damping,
    before: Option<f64>,
    stations: Vec<Station>,
    loads: Vec<Load<f64>>,
    forces: Vec<Vec3<f64>>,
    /// The bonds with the world, one a station where there are any, and the stiffness of the springs on them, N/m; zero: none.
    bonds: Vec<Option<WorldBond>>,
    spring: f64,
    /// How far each station would go in this iteration without forces, world axes, m.
    pub free: Vec<Vec3<f64>>,
    /// What forces at the stations add to that.
    pub delassus: Delassus,
    scratch: ResponseScratch,
    /// How far some point of it has gone at most since this was set to zero, iteration by iteration, m; infinite at a step's begin.
    pub gone: f64,
    /// How it goes.
    pub outcome: StrandOutcome,
}

impl Default for Held {
    fn default() -> Self {
        Self {
            bench: Bench::default(),
            start: Vec::new(),
            start_origin: Vector3::zeros(),
            origin: Vector3::zeros(),
            rotation: Mat3::zero(),
            offset: Vec3::zero(),
            times: StageTimes { index: 0, k: 0.0, way: 0.0 },
            freedoms: Freedoms::default(),
            rule: 0,
            potential: (0.0, 0.0),
            guess: Vec::new(),
            guessed: (0.0, 0.0),
            damping: Damping::new(0.0),
            before: None,
            stations: Vec::new(),
            loads: Vec::new(),
            forces: Vec::new(),
            bonds: Vec::new(),
            spring: 0.0,
            free: Vec::new(),
            delassus: Delassus::default(),
            scratch: ResponseScratch::default(),
            gone: f64::INFINITY,
            outcome: StrandOutcome::default(),
        }
    }
}

impl Held {
    /// Begins a step of `h` seconds; `first_order`: by implicit Euler whatever the setting says.
    pub fn begin(&mut self, one: &One, setting: &Setting, h: f64, first_order: bool) {
        let workspace = &mut self.bench.workspace;
        let two_step = setting.options.integrator == Integrator::SecondOrder && stages::leans_on_past(one.state, h);
        self.times = if two_step && !first_order {
            stages::start_backward_difference(one, setting, h, workspace).0
        } else {
            stages::start_euler(one, setting, h, workspace)
        };
        let loaded = &workspace.loaded;
        element_states(loaded.rotation, loaded.lengths.iter().copied(), &loaded.curvatures, &mut self.start);
        self.start_origin = one.state.root.origin;
        (self.rotation, self.offset) = stages::move_roots(h, one, workspace);
        self.origin = workspace.roots[0].origin;
        (self.freedoms, self.rule) = (one.model.freedoms, one.state.rule);
        workspace.last_stage = 0;

        let rule = setting.rules.rule(self.rule);
        let axes = self.freedoms.axes();
        let super::workspace::Workspace { loaded, iterate, stages, .. } = workspace;
        stages::assemble_terms(self.times.k, self.offset, &rule.weights, loaded, &stages[0], iterate);
        stages::lead(self.times.way, self.freedoms, loaded, None, iterate);
        let problem = Problem {
            root: &self.rotation,
            lengths: &loaded.lengths,
            axes: &axes[..self.freedoms.count()],
            rule,
            tension_at_start: false,
        };
        self.potential = choose_start(&problem, iterate);
        self.guessed = self.potential;
        self.guess.clone_from(&iterate.kinematics.elements);
        iterate.system.point_tension.clear();
        iterate.system.exact = false;
        self.damping = Damping::new(newton::usual_damping(iterate));
        (self.before, self.gone) = (None, f64::INFINITY);
        self.outcome = StrandOutcome { converged: false, quarantined: !self.potential.0.is_finite(), ..StrandOutcome::default() };
        self.stations.clear();
        self.loads.clear();
        self.forces.clear();
        self.bonds.clear();
        self.spring = 0.0;
    }

    /// Makes room for so many stations.
    pub fn make_room(&mut self, stations: usize) {
        fn reserve<T>(list: &mut Vec<T>, count: usize) {
            list.reserve(count.saturating_sub(list.len()));
        }
        reserve(&mut self.stations, stations);
        reserve(&mut self.loads, stations);
        reserve(&mut self.forces, stations);
        reserve(&mut self.free, stations);
        reserve(&mut self.delassus.columns, 9 * stations * stations);
    }

    /// The strand as the step found it: where its root was, and its elements from there.
    pub fn start(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.start_origin, &self.start)
    }

    /// The same at the present iterate for the step's end.
    pub fn now(&self) -> (Vector3<f64>, &[ElementState<f64>]) {
        (self.origin, &self.bench.workspace.iterate.kinematics.elements)
    }

    /// Where a station is in a strand whose root's origin and elements are given.
    pub fn place((origin, elements): (Vector3<f64>, &[ElementState<f64>]), station: &Station) -> Vector3<f64> {
        origin + Vector3::from(position(elements, station))
    }

    /// First half of an iteration: forces will act at `stations` (from root to tip); `guess` are those that the iteration before came
    /// to, which bend the matrix. `bonds`: none, or one a station that a bond holds to the world.
    ///
    /// Where the strand's own matrix is not positive definite, as under pressure between clamps, springs on the bonds are added to it (an
    /// augmented Lagrangian): they cost the solution nothing, since what they pull with is taken off the bonds' forces again
    /// ([`Held::pulled`]), and unlike damping they hold nothing back that the bonds leave free.
    pub fn linearise(&mut self, stations: &[Station], guess: &[Vec3<f64>], bonds: &[Option<WorldBond>]) {
        let Self { bench: Bench { workspace, elimination }, loads, spring, .. } = self;
        let iterate = &mut workspace.iterate;
        self.stations.clear();
        self.stations.extend_from_slice(stations);
        self.bonds.clear();
        self.bonds.extend_from_slice(bonds);
        loads.clear();
        loads.extend(stations.iter().zip(guess).map(|(station, force)| Load::at(&iterate.kinematics, station, *force)));
        forces(iterate);
        let axes = self.freedoms.axes();
        let axes = &axes[..self.freedoms.count()];
        self.damping.begin();
        let usual = if self.bonds.is_empty() { 0.0 } else { usual_spring(iterate, guess) };
        *spring = spring.min(STIFFEST * usual);
        set_springs(loads, &self.bonds, *spring, &iterate.kinematics);
        for tries in 0..=newton::MAX_DAMPINGS {
            iterate.system.rotation_stiffness = self.damping.value;
            let found = elimination.solve_loaded(&iterate.kinematics, &iterate.system, loads, axes, &mut iterate.change);
            if found.repaired == 0.0 || tries == newton::MAX_DAMPINGS {
                break;
            }
            if *spring < STIFFEST * usual {
                *spring = (*spring * STIFFER).clamp(usual, STIFFEST * usual);
                set_springs(loads, &self.bonds, *spring, &iterate.kinematics);
            } else {
                self.damping.grow();
            }
        }
        self.delassus.update(elimination, &iterate.kinematics, loads, axes);
        self.forces.clear();
        self.forces.resize(stations.len(), Vec3::zero());
        elimination.direction(
            &iterate.kinematics,
            loads,
            &self.forces,
            axes,
            &mut self.scratch,
            &mut iterate.change,
            &mut self.free,
        );
    }

    /// What the spring on a station's bond pulls at it with in the linear model beside what is told of it: to be added to the force that
    /// the model has there, N.
    pub fn pulled(&self, station: usize) -> Vec3<f64> {
        match self.bonds.get(station) {
            Some(Some(bond)) if self.spring > 0.0 => bond.off.scale(self.spring),
            _ => Vec3::zero(),
        }
    }

    /// Second half: goes the way that `forces` on the stations (with [`Held::pulled`]) lead to. Gives how far an element may still be from
    /// where the iteration would end with such forces, rad; infinite where the strand is lost.
    pub fn advance(&mut self, setting: &Setting, forces: &[Vec3<f64>]) -> f64 {
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        for station in 0..forces.len() {
            let pulled = self.pulled(station);
            self.forces[station] -= pulled;
        }
        let Self { bench: Bench { workspace, elimination }, loads, .. } = self;
        let axes = self.freedoms.axes();
        let axes = &axes[..self.freedoms.count()];
        let super::workspace::Workspace { loaded, iterate, .. } = workspace;
        let (told, moved, change) = (&self.forces, &mut self.free, &mut iterate.change);
        let found = elimination.direction(&iterate.kinematics, loads, told, axes, &mut self.scratch, change, moved);
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        self.outcome.iterations += 1;
        let rotation = found.rotation_squared.sqrt();
        if !(rotation.is_finite() && found.descent.is_finite()) {
            self.outcome.quarantined = true;
            return f64::INFINITY;
        }
        let limit = crate::chain::elimination::Elimination::<f64>::ROTATION_LIMIT;
        let problem = Problem {
            root: &self.rotation,
            lengths: &loaded.lengths,
            axes,
            rule: setting.rules.rule(self.rule),
            tension_at_start: false,
        };
        let holding = Holding::new(&self.stations, forces, &self.bonds, self.spring, &iterate.kinematics);
        let from = holding.lagrangian(self.potential, &iterate.kinematics.elements);
        let mut part = if rotation > limit { limit / rotation } else { 1.0 };
        let mut next = None;
        for _ in 0..newton::MAX_HALVINGS {
            iterate.trial_curvatures.clone_from(&iterate.curvatures);
            for (row, change) in iterate.trial_curvatures.iter_mut().zip(&iterate.change) {
                for axis in 0..3 {
                    row[axis] += part * change[axis];
                }
            }
            let potential = place_trial(&problem, iterate);
            let trial = holding.lagrangian(potential, &iterate.trial.elements);
            if trial.0 <= from.0 - newton::ARMIJO * part * found.descent + from.1 {
                next = Some((potential, trial));
                break;
            }
            part *= 0.5;
        }
        let Some((potential, trial)) = next else {
            // No way down that rounding lets us see: as good as the potential can tell.
            self.outcome.residual = rotation;
            return rotation;
        };
        self.gone += farthest(&iterate.kinematics.elements, &iterate.trial.elements);
        std::mem::swap(&mut iterate.kinematics, &mut iterate.trial);
        std::mem::swap(&mut iterate.curvatures, &mut iterate.trial_curvatures);
        let promised = 0.5 * (found.descent + self.damping.value * found.rotation_sum);
        self.damping.learn(if promised >= 8.0 * from.1 { (from.0 - trial.0) / promised } else { 1.0 });
        self.potential = potential;
        let newton = self.damping.value == 0.0 && part == 1.0;
        let left = newton::constant(rotation, self.before) * rotation;
        self.outcome.residual = if newton && iterate.system.exact { rotation * left.min(1.0) } else { rotation };
        self.before = newton.then_some(rotation);
        if setting.options.exact_hessian {
            let mut gone = [0.0; MAX_LANES];
            gone[0] = part;
            foresee(iterate, axes, &gone);
            iterate.system.exact = true;
        }
        self.outcome.residual
    }

    /// By how much the Lagrangian with the present forces is higher at the present iterate than where the iteration began, beyond what rounding may
    /// do, J. Above zero, the iterate is not the minimum but another stationary point: a chain that is folded another way has one.
    pub fn rise(&self) -> f64 {
        let kinematics = &self.bench.workspace.iterate.kinematics;
        let holding = Holding::new(&self.stations, &self.forces, &[], 0.0, kinematics);
        let now = holding.lagrangian(self.potential, &kinematics.elements);
        let began = holding.lagrangian(self.guessed, &self.guess);
        (now.0 - began.0 - now.1 - began.1).max(0.0)
    }

    /// Bends all elements by so much more, 1/m about n1 and n2: the iteration goes on from there. (Of freedoms that are held none.)
    pub fn bend(&mut self, curvature: [f64; 2], setting: &Setting) {
        let super::workspace::Workspace { loaded, iterate, .. } = &mut self.bench.workspace;
        let axes = self.freedoms.axes();
        let axes = &axes[..self.freedoms.count()];
        let size = (curvature[0] * curvature[0] + curvature[1] * curvature[1]).sqrt();
        let change = match (self.freedoms.contains(1), self.freedoms.contains(2)) {
            (true, true) => [0.0, curvature[0], curvature[1]],
            (true, false) => [0.0, size, 0.0],
            (false, true) => [0.0, 0.0, size],
            (false, false) => return,
        };
        iterate.trial_curvatures.clone_from(&iterate.curvatures);
        for row in &mut iterate.trial_curvatures {
            for axis in 0..3 {
                row[axis] += change[axis];
            }
        }
        let rule = setting.rules.rule(self.rule);
        let problem = Problem { root: &self.rotation, lengths: &loaded.lengths, axes, rule, tension_at_start: false };
        self.potential = place_trial(&problem, iterate);
        self.gone += farthest(&iterate.kinematics.elements, &iterate.trial.elements);
        std::mem::swap(&mut iterate.kinematics, &mut iterate.trial);
        std::mem::swap(&mut iterate.curvatures, &mut iterate.trial_curvatures);
        self.before = None;
    }

    /// Ends the step: its end becomes the strand's state, unless it is not finite, or has not converged and is bent by more than
    /// `most_elastic` (J): it is then come to nowhere.
    pub fn end(
        &mut self,
        one: &mut One,
        setting: &Setting,
        h: f64,
        most_elastic: f64,
        scratch: &mut RuleScratch,
    ) -> StrandOutcome {
        let workspace = &mut self.bench.workspace;
        let axes = self.freedoms.axes();
        forces(&mut workspace.iterate);
        let super::workspace::Workspace { iterate, stages, .. } = &mut *workspace;
        stages::finish_stage(self.times.k, self.offset, &axes[..self.freedoms.count()], iterate, &mut stages[0]);
        let (mut force, mut torque) = wrench(&iterate.kinematics, &iterate.system.point_force);
        for (station, pull) in self.stations.iter().zip(&self.forces) {
            force += *pull;
            torque += position(&iterate.kinematics.elements, station).cross(*pull);
        }
        (workspace.wrench_force, workspace.wrench_torque) = (force, torque);
        whole::measure_roots(one, h, workspace);
        let mut outcomes = [self.outcome; MAX_LANES];
        whole::energies(one, setting, workspace, &mut outcomes);
        self.outcome = outcomes[0];
        let nowhere = !self.outcome.converged && self.outcome.energies.elastic > most_elastic;
        self.outcome.quarantined |= nowhere || whole::finiteness(workspace) != 0.0;
        if self.outcome.quarantined {
            self.outcome.converged = false;
        } else {
            keep(one, 0, setting, h, workspace, scratch);
        }
        self.outcome
    }
}

/// How far the elements' ends are from where they were, at most.
fn farthest(elements: &[ElementState<f64>], were: &[ElementState<f64>]) -> f64 {
    let tip = |elements: &[ElementState<f64>]| elements.last().map_or(Vec3::zero(), ElementState::origin_right);
    let ends = elements.iter().zip(were).map(|(now, then)| (now.origin_left - then.origin_left).norm_squared());
    ends.fold((tip(elements) - tip(were)).norm_squared(), f64::max).sqrt()
}

fn position(elements: &[ElementState<f64>], station: &Station) -> Vec3<f64> {
    let element = &elements[station.element];
    let point = element.point(station.s);
    let mut local = point.local;
    if station.lever != [0.0; 3] {
        let (theta, z) = (element.kappa.scale(station.s), element.kappa_squared * (station.s * station.s));
        local += crate::rod::segment::frame(theta, z, &point.c).apply(Vec3(station.lever));
    }
    element.origin_left + element.frame_left.apply(local)
}

/// The stiffness of the springs to try first: of the order of the strand's own, with what its forces may take off it.
fn usual_spring(iterate: &Iterate<f64>, forces: &[Vec3<f64>]) -> f64 {
    let inertia: f64 = iterate.system.point_stiffness.iter().sum();
    let shortest = iterate.kinematics.elements.iter().map(|element| element.length).fold(f64::INFINITY, f64::min);
    forces.iter().map(|force| force.norm_squared().sqrt() / shortest).fold(inertia, f64::max)
}

fn set_springs(loads: &mut [Load<f64>], bonds: &[Option<WorldBond>], spring: f64, kinematics: &Kinematics<f64>) {
    if spring > 0.0 {
        for (load, bond) in loads.iter_mut().zip(bonds).filter_map(|(load, bond)| Some((load, bond.as_ref()?))) {
            *load = load.with_stiffness(kinematics, &bond.held.scale(spring));
        }
    }
}

/// What the stations are held by in an iteration.
struct Holding<'a> {
    stations: &'a [Station],
    forces: &'a [Vec3<f64>],
    bonds: &'a [Option<WorldBond>],
    spring: f64,
    /// Where the bonds hold their stations.
    anchors: Vec<Vec3<f64>>,
}

impl<'a> Holding<'a> {
    fn new(
        stations: &'a [Station],
        forces: &'a [Vec3<f64>],
        bonds: &'a [Option<WorldBond>],
        spring: f64,
        now: &Kinematics<f64>,
    ) -> Self {
        let bonds = if spring > 0.0 { bonds } else { &[] };
        let anchor = |(station, bond): (&Station, &Option<WorldBond>)| {
            position(&now.elements, station) - bond.as_ref().map_or(Vec3::zero(), |bond| bond.off)
        };
        Self { stations, forces, bonds, spring, anchors: stations.iter().zip(bonds).map(anchor).collect() }
    }

    /// A potential and its rounding, less the forces' work, and with the springs' energy.
    fn lagrangian(&self, (mut value, mut noise): (f64, f64), elements: &[ElementState<f64>]) -> (f64, f64) {
        for (index, (station, force)) in self.stations.iter().zip(self.forces).enumerate() {
            let at = position(elements, station);
            value -= at.dot(*force);
            noise += 8.0 * f64::EPSILON * (at.norm_squared() * force.norm_squared()).sqrt();
            if let Some(Some(bond)) = self.bonds.get(index) {
                let off = bond.held.apply(at - self.anchors[index]);
                value += 0.5 * self.spring * off.norm_squared();
                noise += 8.0 * f64::EPSILON * self.spring * (at.norm_squared() * off.norm_squared()).sqrt();
            }
        }
        (value, noise)
    }
}
