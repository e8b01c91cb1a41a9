//! Starts of the search: the curve's curvature in twist-free frames, and for each element the helix that it resembles.
//!
//! In such frames the curvature at a place is a complex number, k(s) = κ1 + iκ2, and that of a helix rotates at the rate of its
//! twist: k(s) = c exp(iκ0 s). So an element's twist is the rate at which its stretch of curvature rotates, and c is the mean
//! with that rotation removed.

use super::search::keep_apart;
use super::shape::Shape;
use super::target::Target;
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::rotation::arc_tangent;
use crate::math::vector::Vec3;

/// The nodes between elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Nodes {
    /// All elements are equal.
    Equal,
    /// Shorter where the curvature varies: the error of a constant over a length ℓ is of the order of its variation times ℓ³. So
    /// half of the spacing distributes the cube root of the variation evenly; the other half is length.
    Varied,
    /// Alternately longer and shorter, this often along the strand: for strands that no other start brings to a good end.
    Waves(u32),
}

/// A start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub nodes: Nodes,
    pub twisted: bool,
}

/// The starts, in the order of trial (`docs/notebook/groom_fit.md` compares them on real grooms).
pub(super) const STARTS: [Start; 8] = [
    Start { nodes: Nodes::Varied, twisted: false },
    Start { nodes: Nodes::Varied, twisted: true },
    Start { nodes: Nodes::Waves(1), twisted: false },
    Start { nodes: Nodes::Equal, twisted: true },
    Start { nodes: Nodes::Equal, twisted: false },
    Start { nodes: Nodes::Waves(1), twisted: true },
    Start { nodes: Nodes::Waves(2), twisted: false },
    Start { nodes: Nodes::Waves(2), twisted: true },
];

/// The turning at a corner of the polyline, spread evenly from `from` to `to`, relative to the length.
#[derive(Debug, Clone, Copy)]
struct Turning {
    from: f64,
    to: f64,
    /// About n1 and n2 of twist-free frames, rad.
    turn: [f64; 2],
}

/// What starts are built from.
#[derive(Debug, Default)]
pub(super) struct StartScratch {
    corners: Vec<(f64, Vec3<f64>)>,
    turnings: Vec<Turning>,
    /// Stretches and their densities of nodes: the end, and the density.
    densities: Vec<(f64, f64)>,
    /// The angle about the tangent from the twist-free frames to the target normal, at places along the curve.
    angles: Vec<(f64, f64)>,
    parts: Vec<TurningPart>,
}

/// A part of a turning.
#[derive(Debug, Clone, Copy)]
struct TurningPart {
    middle: f64,
    turn: [f64; 2],
}

/// How much more coherent, in squares, the curvature must be about a twisted axis for the twist to be accepted.
const BELIEVED: f64 = 1.05;
/// Corners that an element can resolve: closer ones are merged.
const CORNERS: f64 = 24.0;

impl StartScratch {
    /// Reads the curve's corners at the resolution of this many elements.
    pub fn look_at(&mut self, target: &Target, elements: usize) {
        let samples = target.coarse();
        let least = 1.0 / (CORNERS * elements as f64);
        self.corners.clear();
        self.corners.push((0.0, samples[0].target));
        for (index, sample) in samples.iter().enumerate().skip(1) {
            let (before, at) = self.corners[self.corners.len() - 1];
            let long = sample.arclength - before >= least && (sample.target - at).norm_squared() > 0.0;
            if index + 1 == samples.len() {
                // The tip replaces a corner that is too close to it, but never the root.
                if !long && self.corners.len() > 1 {
                    self.corners.pop();
                }
                self.corners.push((1.0, sample.target));
            } else if long {
                self.corners.push((sample.arclength, sample.target));
            }
        }
        self.turn_along(target);
        self.find_densities();
    }

    /// Transports a frame along the corners without twist and records its turning, and the direction of the target normals in it.
    fn turn_along(&mut self, target: &Target) {
        self.turnings.clear();
        self.angles.clear();
        let mut frame = [target.root.0.column(0), target.root.0.column(1), target.root.0.column(2)];
        let samples = target.coarse();
        let mut next = 0;
        let mut angle = 0.0_f64;
        for edge in 0..self.corners.len() - 1 {
            let ((from, a), (to, b)) = (self.corners[edge], self.corners[edge + 1]);
            let chord = b - a;
            let size = chord.norm_squared().sqrt();
            if size > 0.0 {
                let turn = carry(&mut frame, chord.scale(1.0 / size));
                // A given direction of the root has half of the first edge to turn to the curve's.
                let before = if edge == 0 { 0.0 } else { 0.5 * (self.corners[edge - 1].0 + from) };
                if turn != [0.0; 2] {
                    self.turnings.push(Turning { from: before, to: 0.5 * (from + to), turn });
                }
            }
            while next < samples.len() && (samples[next].arclength <= to || edge + 2 == self.corners.len()) {
                if let Some(wanted) = samples[next].normal {
                    let (sine, cosine) = (wanted.dot(frame[2]), wanted.dot(frame[1]));
                    let here = angle_of(sine, cosine);
                    let whole = ((angle - here) / std::f64::consts::TAU).round();
                    angle = here + whole * std::f64::consts::TAU;
                    self.angles.push((samples[next].arclength, angle));
                }
                next += 1;
            }
        }
    }

    /// Computes the density of nodes.
    fn find_densities(&mut self) {
        let turnings = &self.turnings;
        self.densities.clear();
        let curvature = |index: usize| {
            let Turning { from, to, turn } = turnings[index];
            turn.map(|turn| turn / (to - from).max(f64::MIN_POSITIVE))
        };
        let mut sum = 0.0;
        let mut end = 0.0;
        for (index, turning) in turnings.iter().enumerate() {
            let (a, b) = (curvature(index.saturating_sub(1)), curvature((index + 1).min(turnings.len() - 1)));
            let variation = ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt().cbrt();
            // A stretch without turning before this one has its density.
            sum += variation * (turning.to - end);
            end = turning.to;
            self.densities.push((end, variation));
        }
        if let Some((last, density)) = self.densities.last_mut() {
            sum += *density * (1.0 - *last);
            *last = 1.0;
        }
        for (_, density) in &mut self.densities {
            *density += sum;
        }
        if sum == 0.0 || !sum.is_finite() {
            self.densities.clear();
            self.densities.push((1.0, 1.0));
        }
    }

    /// The nodes of this many elements, none of them shorter than `least` times the length of equal ones.
    pub fn nodes(&self, kind: Nodes, count: usize, least: f64, nodes: &mut Vec<f64>) {
        let equal = 1.0 / count as f64;
        nodes.clear();
        nodes.push(0.0);
        match kind {
            Nodes::Equal => nodes.extend((1..count).map(|index| index as f64 * equal)),
            Nodes::Waves(waves) => {
                let waves = f64::from(waves);
                let weight = |index: usize| {
                    let middle = (index as f64 + 0.5) * equal;
                    1.0 + 0.45 * sine_cosine(std::f64::consts::PI * ((waves + 1.0) * middle + 0.618 * waves)).1
                };
                let sum: f64 = (0..count).map(weight).sum();
                let mut node = 0.0;
                for index in 0..count - 1 {
                    node += weight(index) / sum;
                    nodes.push(node);
                }
            }
            Nodes::Varied => {
                let mut sum = 0.0;
                let mut left = 0.0;
                for (right, density) in &self.densities {
                    sum += density * (right - left);
                    left = *right;
                }
                let (mut done, mut left) = (0.0, 0.0);
                for (right, density) in &self.densities {
                    let stretch = density * (right - left);
                    while nodes.len() < count && done + stretch >= sum * nodes.len() as f64 * equal {
                        nodes.push(left + (sum * nodes.len() as f64 * equal - done) / density);
                    }
                    done += stretch;
                    left = *right;
                }
                while nodes.len() < count {
                    nodes.push(1.0);
                }
            }
        }
        nodes.push(1.0);
        keep_apart(nodes, least * equal);
    }

    /// Sets the curvatures of a shape with given nodes, with or without twist; target normals determine the twist if there are
    /// any.
    pub fn curvatures(&mut self, shape: &mut Shape, twisted: bool, target: &Target) {
        let count = shape.nodes.len() - 1;
        shape.rows.clear();
        let mut carried = 0.0_f64;
        let mut first = 0;
        for element in 0..count {
            let (left, right) = (shape.nodes[element], shape.nodes[element + 1]);
            let length = right - left;
            while first < self.turnings.len() && self.turnings[first].to <= left {
                first += 1;
            }
            self.parts.clear();
            for turning in self.turnings[first..].iter().take_while(|turning| turning.from < right) {
                let (from, to) = (turning.from.max(left), turning.to.min(right));
                let part = (to - from) / (turning.to - turning.from);
                if part > 0.0 {
                    let turn = turning.turn.map(|turn| turn * part);
                    self.parts.push(TurningPart { middle: 0.5 * (from + to) - left, turn });
                }
            }
            let plain = about(&self.parts, 0.0);
            let (mut rate, mut sum) = (0.0, plain);
            if target.has_normals() {
                rate = (self.angle_at(right) - self.angle_at(left)) / length;
                sum = about(&self.parts, rate);
            } else if twisted {
                let wanted = going_round(&self.parts);
                let there = about(&self.parts, wanted);
                if square(there) > BELIEVED * square(plain) {
                    (rate, sum) = (wanted, there);
                }
            }
            let (sine, cosine) = sine_cosine(carried);
            let [re, im] = sum;
            shape.rows.push([rate, (re * cosine + im * sine) / length, (im * cosine - re * sine) / length]);
            carried += rate * length;
        }
    }

    /// The target normal's angle at an arclength.
    fn angle_at(&self, arclength: f64) -> f64 {
        let next = self.angles.partition_point(|(place, _)| *place < arclength).clamp(1, self.angles.len() - 1);
        let ((from, a), (to, b)) = (self.angles[next - 1], self.angles[next]);
        a + (b - a) * ((arclength - from) / (to - from)).clamp(0.0, 1.0)
    }
}

/// Turns a frame's first axis to a direction along the shortest path; returns the rotation vector along the other two.
fn carry(frame: &mut [Vec3<f64>; 3], direction: Vec3<f64>) -> [f64; 2] {
    let across = frame[0].cross(direction);
    let (sine, cosine) = (across.norm_squared().sqrt(), frame[0].dot(direction));
    let turn = if sine > 1e-12 {
        let factor = angle_of(sine, cosine) / sine;
        [across.dot(frame[1]) * factor, across.dot(frame[2]) * factor]
    } else if cosine > 0.0 {
        [0.0; 2]
    } else {
        // Straight back there is no shortest path: any transverse axis will do.
        frame[2] = -frame[2];
        [std::f64::consts::PI, 0.0]
    };
    if sine > 1e-12 {
        // R v = v cos + across × v + across (across·v)/(1 + cos).
        let factor = across.dot(frame[1]) / (1.0 + cosine).max(1e-300);
        frame[1] = frame[1].scale(cosine) + across.cross(frame[1]) + across.scale(factor);
    }
    frame[0] = direction;
    // Keeps rounding errors from adding up along the curve.
    let n1 = frame[1] - direction.scale(direction.dot(frame[1]));
    frame[1] = n1.scale(1.0 / n1.norm_squared().sqrt());
    frame[2] = direction.cross(frame[1]);
    turn
}

/// The angle whose sine and cosine have this ratio, −π to π: the same bits on every machine.
fn angle_of(sine: f64, cosine: f64) -> f64 {
    if sine == 0.0 && cosine == 0.0 {
        return 0.0;
    }
    let angle = arc_tangent(sine.abs(), cosine.abs());
    let angle = if cosine < 0.0 { std::f64::consts::PI - angle } else { angle };
    if sine < 0.0 { -angle } else { angle }
}

fn square([re, im]: [f64; 2]) -> f64 {
    re * re + im * im
}

/// Σ turn exp(−i rate s): the turning about axes that rotate at a rate.
fn about(parts: &[TurningPart], rate: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for part in parts {
        let (sine, cosine) = if rate == 0.0 { (0.0, 1.0) } else { sine_cosine(rate * part.middle) };
        sum[0] += part.turn[0] * cosine + part.turn[1] * sine;
        sum[1] += part.turn[1] * cosine - part.turn[0] * sine;
    }
    sum
}

/// The rate at which the curvature rotates: the mean rate of its phase from one part to the next, weighted by both.
fn going_round(parts: &[TurningPart]) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for pair in parts.windows(2) {
        let ([a, b], distance) = ([pair[0].turn, pair[1].turn], pair[1].middle - pair[0].middle);
        let (re, im) = (a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]);
        let weight = (re * re + im * im).sqrt();
        if weight > 0.0 {
            sum += weight * angle_of(im, re);
            weights += weight * distance;
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}
