//! A strand from a polyline: the Super-Helix whose centreline comes closest at equal arclength.
//!
//! Two starts: the polyline's turning without twist, spread over the elements; and element by element from the root, the three
//! curvatures of each found from several guesses (the element before, the mean turning, and that with the twist of a helix to either
//! side), so that a curl is not mistaken for a straight line. From each start all curvatures and the root's direction together, by
//! Levenberg and Marquardt's method on the squared distance; its linear systems are those of a step (a spring from every quadrature
//! point to the polyline) and take linear time. The better end is kept.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::polyline::Polyline;
pub use super::rest_shape::{natural_under_gravity, natural_under_gravity_with};
use crate::chain::elimination::Elimination;
use crate::chain::system::{ChainSystem, LinearSolve};
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::math::quadrature::Rule;
use crate::math::rotation::from_rotation_vector;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::definition::MAX_ELEMENTS;
use crate::rod::kinematics::Kinematics;

/// How to fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Helical elements of the fitted strand, 1 to [`MAX_ELEMENTS`].
    pub element_count: usize,
}

/// A fitted strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root frame: at the first point; its direction begins as the first edge's and is fitted with the rest.
    pub root: Frame,
    /// Element lengths, m; their sum is the polyline's length.
    pub element_lengths: Vec<f64>,
    /// Curvature rows.
    pub curvatures: Vec<[f64; 3]>,
    /// Root mean square of the distance between the polyline's points and the centreline at the same arclength, m.
    pub rms_error: f64,
    /// The largest such distance, m.
    pub max_error: f64,
}

/// Weight of the pull towards the present curvatures that keeps unobservable ones (twist of a straight piece) where they are,
/// against the squared distance, both without dimension.
const RIDGE: f64 = 1e-9;

/// Weight of a strand's own twist, (κ0 L)² against the squared distance over L²: a twist that moves the centreline by less than what it
/// costs is noise, and an element that turns by many radians for nothing cannot bend its axis when it is simulated. A curl of sixty
/// radians is worth 4e-3 L of distance in its cost and moves by far less, since the distance is stiff there.
const TWIST_WEIGHT: f64 = 4e-9;

/// Fits a strand to a polyline of at least two distinct points, in metres, root first. Doubled points are skipped.
///
/// # Errors
/// [`Error::InvalidArgument`] for points that are not finite, fewer than two distinct ones, or a number of elements out of range.
pub fn fit_polyline(points: &[Vector3<f64>], options: &FitOptions) -> Result<Fit> {
    let count = options.element_count;
    if count == 0 || count > MAX_ELEMENTS {
        return Err(Error::invalid("element_count", count, format!("1 to {MAX_ELEMENTS}")));
    }
    let polyline = Polyline::new(points)?;
    let length = polyline.length();
    let lengths = vec![length / count as f64; count];
    let root = polyline.root_rotation();
    let turnings = polyline.turnings(root);
    // An element's share of the turning says how many points it needs; a polyline's corners need no more.
    let turning: f64 = turnings.iter().map(|(_, turn)| turn.norm()).sum();
    let nodes = (8.0 + turning / count as f64).min(24.0) as usize;
    let rule = Rule::gauss_legendre(nodes);

    let matrix = Mat3::from(root.to_rotation_matrix().into_inner());
    let mut problem = Problem { polyline: &polyline, rule: &rule, scale: length, work: Work::default() };
    let mut starts = vec![spread(&polyline, &turnings, &lengths)];
    if 3 * count <= polyline.points.len() {
        // With fewer points than that an element sees little but noise.
        starts.push(problem.element_by_element(&matrix, &lengths, &turnings));
    }
    let mut best: Option<(f64, Vec<[f64; 3]>, Mat3<f64>)> = None;
    for start in starts {
        let (rows, turned) = problem.refine(&lengths, matrix, start);
        let cost = problem.cost(&lengths, &turned, &rows);
        if best.as_ref().is_none_or(|(least, _, _)| cost < *least) {
            best = Some((cost, rows, turned));
        }
    }
    let (_, curvatures, matrix) = best.unwrap_or_else(|| (0.0, vec![[0.0; 3]; count], matrix));

    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix.into()));
    let (rms_error, max_error) = distances(&polyline, &matrix, &lengths, &curvatures);
    Ok(Fit { root: Frame { origin: polyline.points[0], rotation }, element_lengths: lengths, curvatures, rms_error, max_error })
}

/// Curvatures without twist: each corner's turning spread evenly between the middles of the edges that meet there.
fn spread(polyline: &Polyline, turnings: &[(f64, Vector3<f64>)], lengths: &[f64]) -> Vec<[f64; 3]> {
    let mut rows = vec![Vector3::<f64>::zeros(); lengths.len()];
    let length = lengths[0];
    for (corner, (arclength, turn)) in turnings.iter().enumerate() {
        // Corner k lies between edges k and k + 1.
        let from = 0.5 * (polyline.arclengths[corner] + arclength);
        let to = 0.5 * (arclength + polyline.arclengths[corner + 2]);
        let last = lengths.len() - 1;
        let (first_element, last_element) = (((from / length) as usize).min(last), ((to / length) as usize).min(last));
        for (element, row) in rows.iter_mut().enumerate().take(last_element + 1).skip(first_element) {
            let (left, right) = (element as f64 * length, (element + 1) as f64 * length);
            let shared = (right.min(to) - left.max(from)).max(0.0);
            *row += turn * (shared / (to - from) / length);
        }
    }
    rows.into_iter().map(|row| [0.0, row.y, row.z]).collect()
}

/// Root mean square and largest distance at the polyline's points.
fn distances(polyline: &Polyline, root: &Mat3<f64>, lengths: &[f64], curvatures: &[[f64; 3]]) -> (f64, f64) {
    let (mut frame, mut origin, mut element, mut start) = (*root, Vec3::from(polyline.points[0]), 0, 0.0);
    let state = |index: usize, frame, origin| {
        crate::rod::kinematics::element_state(Vec3(curvatures[index]), lengths[index], frame, origin)
    };
    let mut now = state(0, frame, origin);
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    for (point, arclength) in polyline.points.iter().zip(&polyline.arclengths) {
        while *arclength > start + lengths[element] && element + 1 < lengths.len() {
            start += lengths[element];
            element += 1;
            (frame, origin) = (now.frame_right(), now.origin_right());
            now = state(element, frame, origin);
        }
        let off = now.point((arclength - start).min(lengths[element])).position - Vec3::from(*point);
        sum += off.norm_squared();
        largest = largest.max(off.norm_squared());
    }
    ((sum / polyline.points.len() as f64).sqrt(), largest.sqrt())
}

/// Scratch of the least squares.
#[derive(Default)]
struct Work {
    kinematics: Kinematics<f64>,
    system: ChainSystem<f64>,
    elimination: Elimination<f64>,
    targets: Vec<Vec3<f64>>,
    change: Vec<[f64; 3]>,
}

struct Problem<'a> {
    polyline: &'a Polyline,
    rule: &'a Rule,
    /// The length by which distances and curvatures are measured.
    scale: f64,
    work: Work,
}

impl Problem<'_> {
    /// A first guess: each element fitted to its stretch of the polyline, from where the ones before it ended.
    fn element_by_element(&mut self, root: &Mat3<f64>, lengths: &[f64], turnings: &[(f64, Vector3<f64>)]) -> Vec<[f64; 3]> {
        let (mut frame, mut origin) = (*root, Vec3::<f64>::zero());
        let mut rows: Vec<[f64; 3]> = Vec::with_capacity(lengths.len());
        // `turnings` are in frames without twist; `carried` turns them into the axes of the frames built here.
        let mut start = 0.0;
        let mut carried = 0.0_f64;
        let mut next = 0;
        for length in lengths {
            let mut turn = Vector3::<f64>::zeros();
            let mut last_angle: Option<f64> = None;
            let (mut twist, mut turned) = (0.0, 0.0);
            while next < turnings.len() && turnings[next].0 <= start + length {
                let here = turnings[next].1;
                turn += here;
                // The bend's direction about the tangent: how it wanders is the curve's torsion.
                let size = here.norm();
                if size > 1e-3 {
                    let angle = here.z.atan2(here.y);
                    if let Some(last) = last_angle {
                        let full = std::f64::consts::TAU;
                        twist += (angle - last + 0.5 * full).rem_euclid(full) - 0.5 * full;
                    }
                    last_angle = Some(angle);
                }
                turned += size;
                next += 1;
            }
            let mean = Vector3::new(0.0, turn.y, turn.z) / *length;
            let (sine, cosine) = carried.sin_cos();
            let mean = [0.0, mean.y * cosine + mean.z * sine, mean.z * cosine - mean.y * sine];
            let mut starts = vec![mean];
            if let Some(last) = rows.last() {
                starts.push(*last);
            }
            let size = turned / length;
            let base = (mean[1] * mean[1] + mean[2] * mean[2]).sqrt();
            if twist.abs() > 0.3 && base > 0.0 {
                for sign in [1.0, -1.0] {
                    starts.push([sign * twist / length, mean[1] / base * size, mean[2] / base * size]);
                }
            }
            let mut best = ([0.0; 3], f64::INFINITY);
            for guess in starts {
                let (row, error) = self.fit_element(start, *length, frame, origin, guess);
                if error < best.1 {
                    best = (row, error);
                }
            }
            let element = crate::rod::kinematics::element_state(Vec3(best.0), *length, frame, origin);
            (frame, origin) = (element.frame_right(), element.origin_right());
            carried += best.0[0] * length;
            rows.push(best.0);
            start += length;
        }
        rows
    }

    /// One element against its stretch, from one start: its curvatures and the squared distance left.
    fn fit_element(&mut self, start: f64, length: f64, frame: Mat3<f64>, origin: Vec3<f64>, guess: [f64; 3]) -> ([f64; 3], f64) {
        let shifted: Vec<Vec3<f64>> = self.targets(start, &[length]).into_iter().map(|t| t - origin).collect();
        self.work.targets = shifted;
        let (rows, _) = self.minimise(&[length], frame, vec![guess], false, 12);
        let error = self.cost(&[length], &frame, &rows);
        (rows[0], error)
    }

    /// All elements together.
    fn refine(&mut self, lengths: &[f64], root: Mat3<f64>, rows: Vec<[f64; 3]>) -> (Vec<[f64; 3]>, Mat3<f64>) {
        self.work.targets = self.targets(0.0, lengths);
        self.minimise(lengths, root, rows, true, 60)
    }

    /// Where the polyline is at the quadrature points, relative to its first point.
    fn targets(&self, start: f64, lengths: &[f64]) -> Vec<Vec3<f64>> {
        let mut out = Vec::with_capacity(lengths.len() * self.rule.len());
        let mut left = start;
        for length in lengths {
            for node in &self.rule.nodes {
                out.push(Vec3::from(self.polyline.at(left + node * length) - self.polyline.points[0]));
            }
            left += length;
        }
        out
    }

    fn cost(&mut self, lengths: &[f64], root: &Mat3<f64>, rows: &[[f64; 3]]) -> f64 {
        self.work.kinematics.update(root, lengths, rows, self.rule);
        let mut sum = 0.0;
        for (p, point) in self.work.kinematics.points.iter().enumerate() {
            let weight = self.rule.weights[p % self.rule.len()] * lengths[p / self.rule.len()];
            sum += weight * (point.position - self.work.targets[p]).norm_squared();
        }
        let twist: f64 = rows.iter().zip(lengths).map(|(row, length)| row[0] * row[0] * length).sum();
        sum + TWIST_WEIGHT * self.scale.powi(4) * twist
    }

    /// Levenberg and Marquardt's method from `rows` towards `work.targets`.
    fn minimise(
        &mut self,
        lengths: &[f64],
        mut root: Mat3<f64>,
        mut rows: Vec<[f64; 3]>,
        turn_root: bool,
        iterations: usize,
    ) -> (Vec<[f64; 3]>, Mat3<f64>) {
        let points = lengths.len() * self.rule.len();
        self.work.system.resize(lengths.len(), points);
        self.work.system.exact = false;
        // Weights w ℓ make the cost an integral of squared distance, in m³; a curvature enters as κ·scale².
        let ridge = self.scale.powi(4);
        let mut damping = 1e-2;
        let mut cost = self.cost(lengths, &root, &rows);
        for _ in 0..iterations {
            self.cost(lengths, &root, &rows);
            let work = &mut self.work;
            for p in 0..points {
                let weight = self.rule.weights[p % self.rule.len()] * lengths[p / self.rule.len()];
                work.system.point_stiffness[p] = weight;
                work.system.point_force[p] = (work.targets[p] - work.kinematics.points[p].position).scale(weight);
            }
            let mut better = false;
            for _ in 0..8 {
                let work = &mut self.work;
                for (element, length) in lengths.iter().enumerate() {
                    let spring = (damping * 1e-3 + RIDGE) * length * ridge;
                    let twist = TWIST_WEIGHT * length * ridge;
                    work.system.curvature_stiffness[element] = [spring + twist, spring, spring];
                    work.system.curvature_force[element] = [-twist * rows[element][0], 0.0, 0.0];
                }
                let turn = if turn_root {
                    let stiffness = (damping * 1e-3 + RIDGE) * self.scale.powi(3);
                    work.elimination.solve_with_turning_root(&work.kinematics, &work.system, stiffness, &mut work.change).1
                } else {
                    work.elimination.solve(&work.kinematics, &work.system, &[0, 1, 2], &mut work.change);
                    Vec3::zero()
                };
                let trial_root = turned(&root, turn);
                let trial: Vec<[f64; 3]> = rows
                    .iter()
                    .zip(&work.change)
                    .map(|(row, change)| std::array::from_fn(|axis| row[axis] + change[axis]))
                    .collect();
                let trial_cost = self.cost(lengths, &trial_root, &trial);
                if trial_cost < cost {
                    better = cost - trial_cost > 1e-6 * cost;
                    (rows, root, cost) = (trial, trial_root, trial_cost);
                    damping = (damping * 0.1).max(1e-9);
                    break;
                }
                damping *= 10.0;
                self.cost(lengths, &root, &rows);
            }
            if !better {
                break;
            }
        }
        (rows, root)
    }
}

/// The root's frame turned by a rotation vector in its own axes.
fn turned(root: &Mat3<f64>, turn: Vec3<f64>) -> Mat3<f64> {
    let rotation = from_rotation_vector(turn.into()).to_rotation_matrix().into_inner();
    root.mul(&Mat3::from(rotation))
}
