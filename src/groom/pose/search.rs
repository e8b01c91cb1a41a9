//! The Levenberg–Marquardt search on a strand's curvatures.
//!
//! It minimises, in units of length squared,
//!
//! ```text
//! ½ L³ Σ ℓ cᵢ (κᵢ − κᵢ*)² + ½ W Σ w |r − t|² + ½ H L² φ² + ½ H Σ min(gap, 0)²,
//! ```
//!
//! where κ* is the preferred shape, c the strand's relative stiffness, t targets of material points, φ the tip's angle to its
//! target direction and gap the distance to a body. W grows until everything in reach is reached.

use nalgebra::Vector3;

use super::elimination::{Model, PoseElimination, Step};
use super::springs::Spring;
use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::{ContactPoint, StrandCurve, StrandPath};
use crate::contact::narrow_phase::path_bounds::PathBounds;
use crate::contact::narrow_phase::strand_body::{self, Span};
use crate::math::levenberg_marquardt::{self, DampedLeastSquares, Trial};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, element_states};

/// A material point and its target.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pull {
    pub element: usize,
    /// Arclength from the element's left end.
    pub s: f64,
    /// Relative to the root's origin, world axes.
    pub target: Vec3<f64>,
    pub weight: f64,
}

/// Bodies that a strand stays out of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Obstacles<'a> {
    pub bodies: &'a [BodyAt<'a>],
    /// The first metres, which are exempt.
    pub span: Span<'static>,
    /// The centreline's distance from the bodies' surfaces.
    pub distance: f64,
}

/// The task for one strand.
#[derive(Debug)]
pub(super) struct Task<'a> {
    pub root: Mat3<f64>,
    pub origin: Vector3<f64>,
    pub lengths: &'a [f64],
    /// L.
    pub length: f64,
    /// Curvatures that may change.
    pub free: &'a [[bool; 3]],
    /// c.
    pub charge: [f64; 3],
    /// κ*.
    pub anchor: &'a [[f64; 3]],
    /// By element and arclength.
    pub pulls: &'a [Pull],
    /// The tip's direction.
    pub tip: Option<Vec3<f64>>,
    pub obstacles: Option<Obstacles<'a>>,
}

/// W and H.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    pub pull: f64,
    pub hard: f64,
}

/// When a search ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    /// Largest number of iterations.
    pub most: u32,
    /// The search ends after an iteration that reduces the cost by less than this fraction
    pub gain: f64,
    /// and turns no frame by more than this, rad;
    pub turn: f64,
    /// or when everything is within this distance of its target, m.
    pub near: f64,
}

/// A strand in one shape.
#[derive(Debug, Default)]
pub(super) struct State {
    pub elements: Vec<ElementState<f64>>,
    pub contacts: Vec<ContactPoint>,
    /// The total cost.
    pub cost: f64,
    /// Σ w |r − t|².
    pub distance: f64,
    /// The cost other than bending and pulls, m².
    pub hard: f64,
    /// The largest depth in a body, m.
    pub depth: f64,
}

/// The most that a frame may turn in an iteration, rad.
const TURN_LIMIT: f64 = 0.6;
/// How often an iteration increases its damping before it gives up.
const TRIALS: usize = 12;
/// How much damping grows after a failed step, and shrinks after a good one.
const MORE: f64 = 10.0;
const LESS: f64 = 0.2;
/// A smaller relative gain counts as none.
const ROUNDING: f64 = 1e-14;
/// The first damping.
const LEAST_DAMPING: f64 = 1e-2;
/// The same in units of the pulling force times the length.
const PULLED: f64 = 1e-3;
/// A step this many times too long is damped, not shortened: its direction means nothing.
const FAR: f64 = 2.0;
/// Contacts closer than this fraction of the strand's length may be hit by a step.
const NEAR: f64 = 0.05;
/// Rounds in which contacts that a step would pass through are added as obstacles.
const ROUNDS: usize = 4;
/// Newton's method replaces Gauss–Newton where an iteration gains less than this fraction.
const SLOW: f64 = 0.3;

/// Memory of searches.
#[derive(Default)]
pub(super) struct Search {
    pub state: State,
    trial: State,
    rows: Vec<[f64; 3]>,
    start: Vec<ElementState<f64>>,
    springs: Vec<Spring>,
    stiffness: Vec<[f64; 3]>,
    force: Vec<[f64; 3]>,
    in_the_way: Vec<bool>,
    bounds: PathBounds,
    body_search: strand_body::BodySearchScratch,
    elimination: PoseElimination,
    step: Step,
    /// Iterations since [`Search::begin`].
    pub iterations: u32,
    damping: f64,
}

impl Search {
    /// Starts with a strand in its current shape: bodies are detected along the motion from there.
    pub fn begin(&mut self, task: &Task, rows: &[[f64; 3]]) {
        element_states(task.root, task.lengths.iter().copied(), rows, &mut self.start);
        self.iterations = 0;
    }

    /// Evaluates `state` at a shape.
    fn place(&mut self, task: &Task, rows: &[[f64; 3]], weights: Weights) {
        let state = &mut self.trial;
        element_states(task.root, task.lengths.iter().copied(), rows, &mut state.elements);
        let mut bent = 0.0;
        for (element, row) in rows.iter().enumerate() {
            for axis in 0..3 {
                let off = row[axis] - task.anchor[element][axis];
                bent += task.lengths[element] * task.charge[axis] * off * off;
            }
        }
        state.distance = 0.0;
        for pull in task.pulls {
            let at = state.elements[pull.element].point(pull.s).position;
            state.distance += pull.weight * (pull.target - at).norm_squared();
        }
        let mut hard = 0.0;
        if let (Some(direction), Some(last)) = (task.tip, state.elements.last()) {
            let spring = Spring::at(last, state.elements.len() - 1, last.length);
            let (_, angle) = spring.turned(last, direction, 1.0);
            hard += (task.length * angle).powi(2);
        }
        state.contacts.clear();
        state.depth = 0.0;
        if let Some(obstacles) = &task.obstacles {
            let curve = |elements| StrandCurve { origin: task.origin, elements };
            let path = StrandPath { index: 0, start: curve(&self.start), now: curve(&state.elements), permitted_overlap: None };
            self.bounds.update(&path);
            let (span, distance, within) = (obstacles.span, obstacles.distance, NEAR * task.length);
            for body in obstacles.bodies {
                let scratch = &mut self.body_search;
                strand_body::contacts(&path, &self.bounds, span, distance, body, within, scratch, &mut state.contacts);
            }
            state.contacts.sort_by(|a, b| (a.point.element.cmp(&b.point.element)).then(a.point.s.total_cmp(&b.point.s)));
            for contact in &state.contacts {
                let depth = (-contact.gap).max(0.0);
                state.depth = state.depth.max(depth);
                hard += depth * depth;
            }
        }
        state.hard = hard;
        state.cost = 0.5 * (task.length.powi(3) * bent + weights.pull * state.distance + weights.hard * hard);
    }

    /// Descends from `rows`, which ends as the best shape found.
    pub fn descend(&mut self, task: &Task, rows: &mut Vec<[f64; 3]>, weights: Weights, end: &End) {
        self.place(task, rows, weights);
        std::mem::swap(&mut self.state, &mut self.trial);
        self.damping = 0.0;
        let mut descent = Descent { search: self, task, rows, weights, end, exact: false, scale: 0.0, turned: 0.0 };
        levenberg_marquardt::minimise(&mut descent, end.most as usize, TRIALS);
    }

    /// The step from the current state. Contacts that it would pass through are added as obstacles.
    fn direction(&mut self, task: &Task, rows: &[[f64; 3]], weights: Weights, exact: bool) {
        self.in_the_way.clear();
        self.in_the_way.extend(self.state.contacts.iter().map(|contact| contact.gap < 0.0));
        self.model(task, rows);
        for _ in 0..ROUNDS {
            self.springs.clear();
            springs(task, &self.state, weights, &self.in_the_way, &mut self.springs);
            let model = Model {
                elements: &self.state.elements,
                springs: &self.springs,
                stiffness: &self.stiffness,
                force: &self.force,
                free: task.free,
                exact,
            };
            self.elimination.solve(&model, &mut self.step);
            let mut met = false;
            for (contact, in_the_way) in self.state.contacts.iter().zip(&mut self.in_the_way) {
                if !*in_the_way && contact.gap + moved(&self.state, &self.step, contact) < 0.0 {
                    (*in_the_way, met) = (true, true);
                }
            }
            if !met {
                break;
            }
        }
    }

    /// Springs on the curvatures themselves.
    fn model(&mut self, task: &Task, rows: &[[f64; 3]]) {
        self.stiffness.clear();
        self.force.clear();
        let unit = task.length.powi(3);
        for (element, row) in rows.iter().enumerate() {
            let own = task.charge.map(|charge| unit * task.lengths[element] * charge);
            self.force.push(std::array::from_fn(|axis| own[axis] * (task.anchor[element][axis] - row[axis])));
            self.stiffness.push(own.map(|own| own + self.damping * unit * task.lengths[element]));
        }
    }

    /// `self.rows` is `rows` after a fraction of the step.
    fn advance(&mut self, task: &Task, rows: &[[f64; 3]], fraction: f64) {
        self.rows.clear();
        for (element, row) in rows.iter().enumerate() {
            let change = &self.step.rows[element];
            let free = &task.free[element];
            self.rows.push(std::array::from_fn(|axis| if free[axis] { row[axis] + fraction * change[axis] } else { row[axis] }));
        }
    }
}

/// A search on its way.
struct Descent<'a> {
    search: &'a mut Search,
    task: &'a Task<'a>,
    rows: &'a mut Vec<[f64; 3]>,
    weights: Weights,
    end: &'a End,
    /// Whether Newton's method has taken over.
    exact: bool,
    /// The damping that counts.
    scale: f64,
    /// The largest rotation by the iteration's step, rad.
    turned: f64,
}

impl DampedLeastSquares for Descent<'_> {
    fn cost(&self) -> f64 {
        self.search.state.cost
    }

    fn begin(&mut self) -> bool {
        self.search.iterations += 1;
        self.turned = 0.0;
        // What pulls holds back, where it does, as much as a stiffness of about this.
        self.scale = LEAST_DAMPING + PULLED * self.weights.pull * self.search.state.distance.sqrt() / self.task.length;
        true
    }

    fn trial(&mut self) -> Trial {
        let search = &mut *self.search;
        search.direction(self.task, self.rows, self.weights, self.exact);
        if search.step.gain <= ROUNDING * search.state.cost {
            return Trial::Exhausted;
        }
        if self.exact && search.step.turn > FAR * TURN_LIMIT {
            return Trial::TooLong;
        }
        let fraction = if search.step.turn > TURN_LIMIT { TURN_LIMIT / search.step.turn } else { 1.0 };
        search.advance(self.task, self.rows, fraction);
        let next = std::mem::take(&mut search.rows);
        search.place(self.task, &next, self.weights);
        search.rows = next;
        Trial::Placed { cost: search.trial.cost, promised: search.step.gain * fraction * (2.0 - fraction) }
    }

    fn accept(&mut self, ratio: f64) {
        let search = &mut *self.search;
        // A step that is held back says nothing of how far there is to go.
        self.turned = if search.damping < self.scale { search.step.turn } else { f64::INFINITY };
        if ratio > 0.5 {
            search.damping = if search.damping > 1e-3 * self.scale { LESS * search.damping } else { 0.0 };
        } else if ratio < 0.1 {
            search.damping = (10.0 * search.damping).max(LEAST_DAMPING);
        }
        std::mem::swap(&mut search.state, &mut search.trial);
        std::mem::swap(self.rows, &mut search.rows);
    }

    fn damp(&mut self) {
        self.search.damping = (MORE * self.search.damping).max(self.scale);
    }

    fn ends(&mut self, gained: f64) -> bool {
        let near = self.search.state.distance + self.search.state.hard < self.end.near * self.end.near;
        self.exact = gained < SLOW;
        near || gained < ROUNDING || gained < self.end.gain && self.turned < self.end.turn
    }
}

/// How far the step takes a touching place from its body.
fn moved(state: &State, step: &Step, contact: &ContactPoint) -> f64 {
    let index = contact.point.element as usize;
    let element = &state.elements[index];
    let place = Spring::at(element, index, contact.point.s);
    let (psi, rho) = step.left[index];
    let displacement = rho + psi.cross(place.local) + place.jacobian.apply(Vec3(step.rows[index]));
    element.frame_left.apply(displacement).dot(contact.normal.into())
}

/// The springs of a state, by element.
fn springs(task: &Task, state: &State, weights: Weights, in_the_way: &[bool], out: &mut Vec<Spring>) {
    let mut contacts = state.contacts.iter().zip(in_the_way).filter(|(_, in_the_way)| **in_the_way).peekable();
    let mut pulls = task.pulls.iter().peekable();
    let last = state.elements.len() - 1;
    for (index, element) in state.elements.iter().enumerate() {
        while let Some(pull) = pulls.next_if(|pull| pull.element == index) {
            let off = pull.target - element.point(pull.s).position;
            out.push(Spring::at(element, index, pull.s).pulled(element, off, weights.pull * pull.weight));
        }
        while let Some((contact, _)) = contacts.next_if(|(contact, _)| contact.point.element as usize == index) {
            let place = Spring::at(element, index, contact.point.s);
            out.push(place.pushed(element, contact.normal.into(), -contact.gap, weights.hard));
        }
        if index == last
            && let Some(direction) = task.tip
        {
            let stiffness = weights.hard * task.length * task.length;
            out.push(Spring::at(element, index, element.length).turned(element, direction, stiffness).0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::shape::Shape;
    use crate::math::frame::Frame;

    /// Forces and stiffnesses of the curvatures against differences of the total cost: two points, a direction, a body that the
    /// strand penetrates, and springs to another shape, all at once.
    #[test]
    fn forces_and_stiffness_are_the_derivatives_of_the_cost() {
        let lengths = [0.05, 0.03, 0.06, 0.04];
        let rows = [[3.0, 12.0, -4.0], [-8.0, 6.0, 9.0], [1.0, -15.0, 2.0], [5.0, 0.0, 11.0]];
        let free = [[true; 3], [true, true, false], [true; 3], [false, true, true]];
        let sphere = Shape::new_sphere(0.03).unwrap();
        let root = Frame::default();
        let origin = Vector3::new(0.1, 0.2, 0.3);
        let pose = Frame { origin: origin + Vector3::new(0.055, 0.012, 0.0), ..root };
        let bodies = [BodyAt::new(0, &sphere, pose, pose, 0.0)];
        let pulls = [
            Pull { element: 1, s: 0.02, target: Vec3([0.05, 0.03, 0.01]), weight: 0.7 },
            Pull { element: 3, s: 0.04, target: Vec3([0.02, 0.1, -0.05]), weight: 1.0 },
        ];
        let task = Task {
            root: Mat3::identity(),
            origin,
            lengths: &lengths,
            length: 0.18,
            free: &free,
            charge: [0.7, 1.0, 1.5],
            anchor: &[[0.0; 3]; 4],
            pulls: &pulls,
            tip: Some(Vec3([0.6, 0.0, 0.8])),
            obstacles: Some(Obstacles { bodies: &bodies, span: Span::default(), distance: 1e-4 }),
        };
        let weights = Weights { pull: 30.0, hard: 20.0 };
        let mut search = Search::default();
        search.begin(&task, &rows);
        search.place(&task, &rows, weights);
        std::mem::swap(&mut search.state, &mut search.trial);
        assert!(search.state.depth > 1e-3, "the strand is in the sphere: {}", search.state.depth);
        search.direction(&task, &rows, weights, true);
        // With strong damping the step is the force over the damping.
        let mut force = [[0.0; 3]; 4];
        search.damping = 1e9;
        search.direction(&task, &rows, weights, true);
        let unit = task.length.powi(3) * search.damping;
        for (element, row) in search.step.rows.iter().enumerate() {
            force[element] = row.map(|change| change * unit * lengths[element]);
        }
        let largest = force.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        for element in 0..4 {
            for axis in 0..3 {
                if !free[element][axis] {
                    assert_eq!(force[element][axis], 0.0);
                    continue;
                }
                let step = 1e-4 / lengths[element];
                let mut cost = |step: f64| {
                    let mut moved = rows;
                    moved[element][axis] += step;
                    search.place(&task, &moved, weights);
                    search.trial.cost
                };
                let slope = (cost(step) - cost(-step)) / (2.0 * step);
                let off = (force[element][axis] + slope).abs();
                assert!(off < 2e-6 * largest, "{element} {axis}: {} {slope}", force[element][axis]);
            }
        }
    }
}
