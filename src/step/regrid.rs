//! Moves a strand to other elements while it is in motion: more of them near the camera, fewer far away
//! (`docs/theory/adaptive.md`).
//!
//! Where every old border between elements is also a new one, each new element is a piece of an old one: the same helix with the
//! same rates, so curve and velocities stay the same to rounding. Otherwise the curvatures start from the mean strain of the old
//! elements that a new one overlaps. A fit then minimises the squared distance to the old curve at equal arclength, weighed
//! against elastic energy (the Gauss–Newton method on the linear-time solve). The points' velocities, a field of their own,
//! become the nearest polynomials on the new elements: momentum stays, and kinetic energy does not grow. The rates are those
//! whose velocities are nearest to them by mass.

use super::state::{Earlier, History, StrandState, rotation_matrix};
use crate::chain::elimination::Elimination;
use crate::chain::system::{ChainSystem, LinearSolve};
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::rod::velocity::{self, RootMotion};

/// How closely the strand on its new elements matches the old one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Regrid {
    /// Whether the curve and its velocities are the same to rounding.
    pub exact: bool,
    /// Root mean square distance of the two curves at equal arclength, m.
    pub rms_distance: f64,
    /// The largest such distance, m.
    pub max_distance: f64,
}

/// Borders that differ by less than this fraction of the shorter element count as equal.
const SAME_BORDER: f64 = 1e-9;
/// Natural curvatures that differ by less than this fraction count as equal, because means round.
const SAME_CURVATURE: f64 = 1e-12;
/// s. The fit minimises ½ ρS |r − r_old|²/T² + ½ EI (κ − κ_start)²: distance counts against elastic energy as in a step of T.
/// Without the elastic term the strand could gain energy and spring apart (`docs/theory/adaptive.md`).
const ELASTIC_TIME: f64 = 3e-3;
/// A ridge for nearly limp strands, dimensionless (lengths in L): keeps what the distance does not determine.
const RIDGE: f64 = 1e-9;
/// The same for rates.
const RATE_RIDGE: f64 = 1e-10;
/// Largest number of Gauss–Newton iterations.
const MAX_ITERATIONS: usize = 40;
/// The turn that decides the fit's rule: it integrates across borders of the old elements, where the curve is not smooth.
const FIT_ANGLE: f64 = 15.0;

/// The old strand, for queries of its points.
struct Old<'a> {
    state: &'a StrandState,
    rules: &'a Rules,
    kinematics: Kinematics<f64>,
    /// Arclengths of the borders, root and tip included.
    borders: Vec<f64>,
    coefficients: Vec<f64>,
}

/// Arclengths of the borders between elements, root and tip included.
pub fn borders(lengths: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(lengths.len() + 1);
    let mut sum = 0.0;
    out.push(sum);
    for length in lengths {
        sum += length;
        out.push(sum);
    }
    out
}

/// The mean over each new element of rows that are constant on each old one.
pub fn means(old: &[f64], rows: &[[f64; 3]], new: &[f64]) -> Vec<[f64; 3]> {
    let mut first = 0;
    new.windows(2)
        .map(|here| {
            let (left, right) = (here[0], here[1]);
            while first + 2 < old.len() && same_or_before(old, first + 1, left) {
                first += 1;
            }
            let last = (first..rows.len()).find(|k| k + 2 >= old.len() || same_or_after(old, *k + 1, right)).unwrap_or(first);
            if last == first {
                // To the bit: a piece of one element.
                return rows[first];
            }
            let mut sum = [0.0; 3];
            let mut whole = 0.0;
            for k in first..=last {
                let shared = (old[k + 1].min(right) - old[k].max(left)).max(0.0);
                whole += shared;
                for axis in 0..3 {
                    sum[axis] += shared * rows[k][axis];
                }
            }
            sum.map(|x| x / whole)
        })
        .collect()
}

/// Whether border `k` is at `place` or before it, to rounding.
fn same_or_before(borders: &[f64], k: usize, place: f64) -> bool {
    borders[k] <= place + slack(borders, k)
}

/// Whether border `k` is at `place` or after it, to rounding.
fn same_or_after(borders: &[f64], k: usize, place: f64) -> bool {
    borders[k] >= place - slack(borders, k)
}

fn slack(borders: &[f64], k: usize) -> f64 {
    let before = borders[k] - borders[k - 1];
    let after = if k + 1 < borders.len() { borders[k + 1] - borders[k] } else { before };
    SAME_BORDER * before.min(after)
}

/// Whether every border of the old elements is also one of the new.
fn is_refinement(old: &[f64], new: &[f64]) -> bool {
    let mut k = 0;
    (1..old.len() - 1).all(|border| {
        let slack = slack(old, border);
        while k < new.len() && new[k] < old[border] - slack {
            k += 1;
        }
        k < new.len() && (new[k] - old[border]).abs() <= slack
    })
}

impl Old<'_> {
    fn element_at(&self, arclength: f64) -> usize {
        self.borders[1..self.borders.len() - 1].partition_point(|border| *border <= arclength)
    }

    /// Relative to the root, world axes.
    fn position(&self, arclength: f64) -> Vec3<f64> {
        let index = self.element_at(arclength);
        self.kinematics.elements[index].point(arclength - self.borders[index]).position
    }

    /// The interpolated velocity on element `index`, possibly a little beyond its ends.
    fn velocity_on(&mut self, index: usize, arclength: f64, velocities: &[Vec3<f64>]) -> Vec3<f64> {
        let rule = self.rules.rule(self.state.rule);
        let length = self.borders[index + 1] - self.borders[index];
        rule.interpolation((arclength - self.borders[index]) / length, &mut self.coefficients);
        let first = index * rule.len();
        self.coefficients.iter().enumerate().fold(Vec3::zero(), |sum, (k, c)| sum + velocities[first + k].scale(*c))
    }

    fn velocity(&mut self, arclength: f64) -> Vec3<f64> {
        self.velocity_on(self.element_at(arclength), arclength, &self.state.velocities)
    }

    /// The root's motion in the field of velocities. The state has only its mean over the step.
    fn root_motion(&mut self) -> RootMotion {
        let step = 1e-4 * self.borders[1];
        let velocities = &self.state.velocities;
        let velocity = self.velocity_on(0, 0.0, velocities);
        let slope = (self.velocity_on(0, step, velocities) - self.velocity_on(0, -step, velocities)).scale(0.5 / step);
        let tangent = rotation_matrix(&self.state.root).column(0);
        let spin = Vec3::from(self.state.root_angular_velocity).dot(tangent);
        RootMotion { velocity, angular_velocity: tangent.cross(slope) + tangent.scale(spin), ..RootMotion::still() }
    }
}

/// A strand's state on the elements of `new`, which has the same length, material and freedoms as `model`.
pub fn take(model: &StrandModel, state: &StrandState, new: &StrandModel, rules: &Rules) -> (StrandState, Regrid) {
    let (old_borders, new_borders) = (borders(&model.lengths), borders(&new.lengths));
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rules.rule(state.rule));
    let mut old = Old { state, rules, kinematics, borders: old_borders, coefficients: Vec::new() };

    // Strain is preserved, so that natural detail that returns with smaller elements brings no energy.
    let strain: Vec<[f64; 3]> = difference(&state.curvatures, &model.natural);
    let mut curvatures = sum(&new.natural, &means(&old.borders, &strain, &new_borders), new);
    let rates = means(&old.borders, &state.rates, &new_borders);
    // The root, the wrench and whatever else does not depend on elements stay the same.
    let mut out =
        StrandState { curvatures: Vec::new(), rates, velocities: Vec::new(), history: History::default(), ..state.clone() };
    let carried = means(&old.borders, &model.natural, &new_borders);
    let pairs = || new.natural.iter().flatten().zip(carried.iter().flatten());
    let same = pairs().all(|(a, b)| (a - b).abs() <= SAME_CURVATURE * (a.abs() + b.abs()));
    if same && is_refinement(&old.borders, &new_borders) {
        // Not natural + strain, which rounds. The old rule suits the smaller elements too, and can represent the old velocities.
        out.curvatures = means(&old.borders, &state.curvatures, &new_borders);
        out.velocities = resampled(&mut old, &new_borders, rules, out.rule, &state.velocities);
        if state.history.step > 0.0 {
            let earlier = Earlier {
                curvatures: means(&old.borders, &state.history.curvatures, &new_borders),
                velocities: resampled(&mut old, &new_borders, rules, out.rule, &state.history.velocities),
                root: state.history.root,
            };
            out.history = History::new(state.history.step, earlier);
        }
        let report = distances(&old, new, &out, &new_borders, rules);
        return (out, Regrid { exact: true, ..report });
    }
    fit(&old, new, &new_borders, &state.root, &mut curvatures, rules);
    out.curvatures = curvatures;
    out.rule = rules.next_for_angle(state.rule, new.largest_angle(&out.curvatures));
    out.velocities = resampled(&mut old, &new_borders, rules, out.rule, &state.velocities);
    project(&mut old, new, &new_borders, &mut out, rules);
    let report = distances(&old, new, &out, &new_borders, rules);
    (out, report)
}

fn difference(a: &[[f64; 3]], b: &[[f64; 3]]) -> Vec<[f64; 3]> {
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|axis| a[axis] - b[axis])).collect()
}

/// Natural curvatures and strain; a frozen freedom has none.
fn sum(natural: &[[f64; 3]], strain: &[[f64; 3]], model: &StrandModel) -> Vec<[f64; 3]> {
    let free = |axis: usize| if model.freedoms.contains(axis) { 1.0 } else { 0.0 };
    natural.iter().zip(strain).map(|(n, s)| std::array::from_fn(|axis| n[axis] + free(axis) * s[axis])).collect()
}

/// Velocities at the nodes of the new elements: on each the polynomial nearest to the old field in the mean square, so that
/// momentum stays and kinetic energy does not grow.
fn resampled(old: &mut Old, borders: &[f64], rules: &Rules, rule: usize, velocities: &[Vec3<f64>]) -> Vec<Vec3<f64>> {
    // The old field is a polynomial on each of its elements: the finer rule integrates its product with a new one exactly.
    let pieces = rules.rule(rule.max(old.state.rule));
    let rule = rules.rule(rule);
    let mut out = vec![Vec3::zero(); (borders.len() - 1) * rule.len()];
    let mut basis = Vec::new();
    for (element, here) in borders.windows(2).enumerate() {
        let (left, right) = (here[0], here[1]);
        let mut index = old.element_at(left + 1e-6 * (right - left));
        loop {
            let (from, to) = (left.max(old.borders[index]), right.min(old.borders[index + 1]));
            // The last piece extends to the end, which rounding may have put a little beyond.
            let is_last = index + 2 >= old.borders.len() || old.borders[index + 1] >= right - 1e-9 * (right - left);
            let to = if is_last { right } else { to };
            for (node, weight) in pieces.nodes.iter().zip(pieces.weights.iter()) {
                let arclength = from + node * (to - from);
                let fraction = weight * (to - from) / (right - left);
                let velocity = old.velocity_on(index, arclength, velocities);
                // The Lagrange polynomials of Gauss' nodes are orthogonal, and the integrals of their squares are the weights.
                rule.interpolation((arclength - left) / (right - left), &mut basis);
                for (k, value) in basis.iter().enumerate() {
                    out[element * rule.len() + k] += velocity.scale(fraction * value / rule.weights[k]);
                }
            }
            if is_last {
                break;
            }
            index += 1;
        }
    }
    out
}

/// The rule for integrals over a new element of an old strand's integrand.
fn fit_rule(model: &StrandModel, curvatures: &[[f64; 3]], rules: &Rules) -> usize {
    rules.for_angle(FIT_ANGLE.max(1.1 * model.largest_angle(curvatures)))
}

/// Fits the curvatures to the old curve.
fn fit(old: &Old, model: &StrandModel, borders: &[f64], root: &Frame, curvatures: &mut Vec<[f64; 3]>, rules: &Rules) {
    let rule = rules.rule(fit_rule(model, curvatures, rules));
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let rotation = rotation_matrix(root);
    let length = model.length();
    let unit = length.powi(4);
    let anchor = curvatures.clone();
    let ridge = model.stiffness.map(|stiffness| RIDGE * unit + ELASTIC_TIME * ELASTIC_TIME * stiffness / model.linear_density);
    let targets: Vec<Vec3<f64>> = (0..model.element_count())
        .flat_map(|element| rule.nodes.iter().map(move |node| (element, node)))
        .map(|(element, node)| old.position(borders[element] + node * model.lengths[element]))
        .collect();
    let weight = |p: usize| rule.weights[p % rule.len()] * model.lengths[p / rule.len()];
    let cost = |kinematics: &Kinematics<f64>, rows: &[[f64; 3]]| {
        let mut sum = 0.0;
        for (p, point) in kinematics.points.iter().enumerate() {
            sum += weight(p) * (point.position - targets[p]).norm_squared();
        }
        for (element, row) in rows.iter().enumerate() {
            for axis in 0..3 {
                let off = row[axis] - anchor[element][axis];
                sum += ridge[axis] * model.lengths[element] * off * off;
            }
        }
        sum
    };
    let mut system = ChainSystem::<f64>::default();
    system.resize(model.element_count(), targets.len());
    system.exact = false;
    let mut elimination = Elimination::default();
    let (mut kinematics, mut trial, mut change) = (Kinematics::default(), Kinematics::default(), Vec::new());
    kinematics.update(&rotation, &model.lengths, curvatures, rule);
    let mut least = cost(&kinematics, curvatures);
    let mut damping = 0.0;
    for _ in 0..MAX_ITERATIONS {
        for (p, point) in kinematics.points.iter().enumerate() {
            system.point_stiffness[p] = weight(p);
            system.point_force[p] = (targets[p] - point.position).scale(weight(p));
        }
        let mut gained = None;
        for _ in 0..8 {
            for (element, element_length) in model.lengths.iter().enumerate() {
                for axis in 0..3 {
                    let pull = ridge[axis] * element_length;
                    system.curvature_stiffness[element][axis] = pull + damping * unit * element_length;
                    system.curvature_force[element][axis] = pull * (anchor[element][axis] - curvatures[element][axis]);
                }
            }
            elimination.solve(&kinematics, &system, &axes[..free], &mut change);
            let mut rows = curvatures.clone();
            for (row, step) in rows.iter_mut().zip(&change) {
                for axis in &axes[..free] {
                    row[*axis] += step[*axis];
                }
            }
            trial.update(&rotation, &model.lengths, &rows, rule);
            let now = cost(&trial, &rows);
            if now < least {
                gained = Some(least - now);
                (*curvatures, least) = (rows, now);
                std::mem::swap(&mut kinematics, &mut trial);
                damping = if damping > 1e-8 { damping * 0.1 } else { 0.0 };
                break;
            }
            damping = (damping * 10.0).max(1e-7);
        }
        // 1e-20 L³ of squared distance is rounding.
        if gained.is_none_or(|gain| gain <= 1e-6 * least || least <= 1e-20 * length.powi(3)) {
            break;
        }
    }
}

/// The rates whose velocities are nearest to the old ones by mass.
fn project(old: &mut Old, model: &StrandModel, borders: &[f64], out: &mut StrandState, rules: &Rules) {
    let rule = rules.rule(fit_rule(model, &out.curvatures, rules));
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let root = old.root_motion();
    let rotation = rotation_matrix(&out.root);
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation, &model.lengths, &out.curvatures, rule);
    let mut system = ChainSystem::<f64>::default();
    system.resize(model.element_count(), kinematics.points.len());
    system.exact = false;
    velocity::for_each_point(&kinematics, &out.rates, &root, |p, v, _| system.point_force[p] = v);
    for p in 0..kinematics.points.len() {
        let (element, node) = (p / rule.len(), p % rule.len());
        let weight = rule.weights[node] * model.lengths[element];
        let wanted = old.velocity(borders[element] + rule.nodes[node] * model.lengths[element]);
        system.point_stiffness[p] = weight;
        system.point_force[p] = (wanted - system.point_force[p]).scale(weight);
    }
    let unit = model.length().powi(4);
    for (element, length) in model.lengths.iter().enumerate() {
        system.curvature_stiffness[element] = [RATE_RIDGE * unit * length; 3];
    }
    let mut change = Vec::new();
    Elimination::default().solve(&kinematics, &system, &axes[..free], &mut change);
    for (rate, step) in out.rates.iter_mut().zip(&change) {
        for axis in 0..3 {
            rate[axis] = if model.freedoms.contains(axis) { rate[axis] + step[axis] } else { 0.0 };
        }
    }
}

fn distances(old: &Old, model: &StrandModel, out: &StrandState, borders: &[f64], rules: &Rules) -> Regrid {
    let rule = rules.rule(fit_rule(model, &out.curvatures, rules));
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&out.root), &model.lengths, &out.curvatures, rule);
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    for (p, point) in kinematics.points.iter().enumerate() {
        let (element, node) = (p / rule.len(), p % rule.len());
        let off = point.position - old.position(borders[element] + rule.nodes[node] * model.lengths[element]);
        sum += rule.weights[node] * model.lengths[element] * off.norm_squared();
        largest = largest.max(off.norm_squared());
    }
    if let Some(last) = kinematics.elements.last() {
        largest = largest.max((last.origin_right() - old.position(borders[borders.len() - 1])).norm_squared());
    }
    Regrid { exact: false, rms_distance: (sum / model.length()).sqrt(), max_distance: largest.sqrt() }
}

/// Borders of `count` elements with the same grading: arclength as a piecewise linear function of the element's number in
/// `lengths`. A multiple of their number splits each equally, a divisor joins neighbours.
pub fn graded(lengths: &[f64], count: usize) -> Vec<f64> {
    let from = borders(lengths);
    let place = |k: usize| {
        // k · N / count in whole numbers, so that coincident borders agree to the bit.
        let product = k as u128 * lengths.len() as u128;
        let (whole, rest) = ((product / count as u128) as usize, product % count as u128);
        if rest == 0 { from[whole] } else { from[whole] + lengths[whole] * (rest as f64 / count as f64) }
    };
    if count == lengths.len() {
        return lengths.to_vec();
    }
    (0..count).map(|k| place(k + 1) - place(k)).collect()
}
