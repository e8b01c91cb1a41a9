//! The Levenberg–Marquardt search on one strand.

use nalgebra::Vector3;

use super::linearised::{Damping, FitElimination, Freedom, State, Step, Weights};
use super::samples::Sample;
use super::shape::{Root, Shape};
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::levenberg_marquardt::{self, DampedLeastSquares, Trial};
use crate::math::rotation::from_rotation_vector;
use crate::math::vector::Mat3;

/// Options of a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search {
    pub freedom: Freedom,
    pub weights: Weights,
    /// Largest number of iterations.
    pub iterations: usize,
    /// The search ends after an iteration that reduces the cost by less than this fraction.
    pub least_gain: f64,
    /// A mean squared distance below this counts as zero.
    pub enough: f64,
    /// The least length of an element, relative to that of equal elements.
    pub least_length: f64,
}

/// Memory of the search.
#[derive(Default)]
pub(super) struct SearchScratch {
    state: State,
    trial_state: State,
    trial: Shape,
    elimination: FitElimination,
    step: Step,
}

/// Weight of permanent springs for what the samples do not determine, against the mean squared distance.
const RIDGE: f64 = 1e-12;
/// The first damping.
const FIRST_DAMPING: f64 = 1e-6;
/// Below this mean squared distance twist and spacing are charged in proportion to it: the charge is for noise of that size.
const CHARGED_WHOLE: f64 = 1e-6;
/// The most that a frame may turn about its tangent in an iteration, rad: beyond lie other, mostly worse minima.
const TURN_LIMIT: f64 = 0.5;
/// How often an iteration increases its damping before it gives up.
const TRIALS: usize = 8;

impl SearchScratch {
    /// Improves `shape`; returns the cost, and the mean squared distance alone.
    pub fn minimise(&mut self, shape: &mut Shape, samples: &[Sample], search: &Search) -> (f64, f64) {
        let weights = search.weights;
        self.state.place(shape, samples, &weights);
        let mut descent = Descent { scratch: self, shape, samples, search, weights, damping: FIRST_DAMPING, slow: 0 };
        levenberg_marquardt::minimise(&mut descent, search.iterations, TRIALS);
        (self.state.cost, self.state.distance)
    }

    /// The squared distances of the samples at the end of the last search.
    pub fn squared_distances(&self) -> impl Iterator<Item = f64> + '_ {
        self.state.squared_distances()
    }

    /// The largest of them.
    pub fn largest(&self) -> f64 {
        self.squared_distances().fold(0.0, f64::max)
    }

    /// `trial` is `shape` after the step, limited where an element would become too short.
    fn advance(&mut self, shape: &Shape, search: &Search) {
        self.trial.copy_from(shape);
        let (mut turn, mut largest) = (0.0_f64, 0.0_f64);
        for (index, change) in self.step.rows.iter().enumerate() {
            turn += change[0] * shape.length(index);
            largest = largest.max(turn.abs());
        }
        if largest > TURN_LIMIT {
            self.step.shorten(TURN_LIMIT / largest);
        }
        let tilt = from_rotation_vector(Vector3::from(self.step.tilt.0)).to_rotation_matrix().into_inner();
        self.trial.root = Root(shape.root.0.mul(&Mat3::from(tilt)));
        for (node, change) in self.trial.nodes[1..].iter_mut().zip(&self.step.nodes) {
            *node += change;
        }
        if search.freedom.nodes {
            keep_apart(&mut self.trial.nodes, search.least_length / shape.rows.len() as f64);
        }
        // The step keeps its changes of bending in twist-free frames: to first order that is the same, but otherwise a large
        // change of twist would turn the bending of everything after it.
        let (mut before, mut after) = (0.0, 0.0);
        for (index, change) in self.step.rows.iter().enumerate() {
            let row = shape.rows[index];
            let twist = row[0] + change[0];
            let (old, new) = (row[0] * shape.length(index), twist * self.trial.length(index));
            let turn = (after + 0.5 * new) - (before + 0.5 * old);
            (before, after) = (before + old, after + new);
            let bend = [row[1] + change[1] - turn * row[2], row[2] + change[2] + turn * row[1]];
            let (sine, cosine) = sine_cosine(turn);
            self.trial.rows[index] = [twist, bend[0] * cosine + bend[1] * sine, bend[1] * cosine - bend[0] * sine];
        }
    }
}

/// A search on its way.
struct Descent<'a> {
    scratch: &'a mut SearchScratch,
    shape: &'a mut Shape,
    samples: &'a [Sample],
    search: &'a Search,
    weights: Weights,
    damping: f64,
    /// Iterations in a row that gained little.
    slow: u32,
}

impl DampedLeastSquares for Descent<'_> {
    fn cost(&self) -> f64 {
        self.scratch.state.cost
    }

    fn begin(&mut self) -> bool {
        let (state, wanted) = (&mut self.scratch.state, &self.search.weights);
        if state.distance < self.search.enough {
            return false;
        }
        let fraction = (state.distance / CHARGED_WHOLE).min(1.0);
        if fraction < 1.0 || self.weights.twist < wanted.twist {
            self.weights.twist = wanted.twist * fraction;
            self.weights.spacing = wanted.spacing * fraction;
            state.weigh(&self.weights);
        }
        true
    }

    fn trial(&mut self) -> Trial {
        let SearchScratch { state, elimination, step, .. } = &mut *self.scratch;
        let count = self.shape.rows.len() as f64;
        let springs = Damping {
            tilt: self.damping + RIDGE,
            curvature: self.damping + RIDGE,
            node: (100.0 * self.damping + RIDGE) * count * count,
        };
        elimination.solve(self.shape, state, &self.weights, self.search.freedom, &springs, step);
        self.scratch.advance(self.shape, self.search);
        let SearchScratch { trial, trial_state, step, .. } = &mut *self.scratch;
        trial_state.place(trial, self.samples, &self.weights);
        Trial::Placed { cost: trial_state.cost, promised: step.gain }
    }

    fn accept(&mut self, ratio: f64) {
        self.damping *= if ratio > 0.75 {
            0.25
        } else if ratio < 0.25 {
            4.0
        } else {
            0.5
        };
        std::mem::swap(&mut self.scratch.state, &mut self.scratch.trial_state);
        std::mem::swap(self.shape, &mut self.scratch.trial);
    }

    fn damp(&mut self) {
        self.damping *= 4.0;
    }

    fn ends(&mut self, gained: f64) -> bool {
        self.slow = if gained < self.search.least_gain { self.slow + 1 } else { 0 };
        gained == 0.0 || self.slow == 2
    }
}

/// Moves inner nodes that are closer than `least` apart, or out of order; the ends stay.
pub(super) fn keep_apart(nodes: &mut [f64], least: f64) {
    let last = nodes.len() - 1;
    for index in 1..last {
        nodes[index] = nodes[index].max(nodes[index - 1] + least);
    }
    for index in (1..last).rev() {
        nodes[index] = nodes[index].min(nodes[index + 1] - least);
    }
}
