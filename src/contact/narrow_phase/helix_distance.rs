//! Closest points of two pieces of helices: exact, by Newton's iteration from the closest points of their chords.

use nalgebra::Vector3;

use crate::contact::contact_point::StrandCurve;
use crate::math::functions::entire::Stumpff;
use crate::math::lane::{Kernel, Lane};
use crate::math::vector::Vec3;
use crate::rod::segment;

/// An arc of an element.
#[derive(Debug, Clone, Copy)]
pub struct Arc<'a> {
    /// Its strand's curve.
    pub curve: StrandCurve<'a>,
    /// Its element.
    pub element: usize,
    /// Arclength of its ends from the element's left end, m.
    pub s: [f64; 2],
}

/// A point of a helix with its derivatives along the arclength.
#[derive(Debug, Clone, Copy)]
pub struct HelixPoint {
    /// Position, world, m.
    pub position: Vector3<f64>,
    /// Unit tangent.
    pub tangent: Vector3<f64>,
    /// Curvature vector, 1/m.
    pub bend: Vector3<f64>,
}

impl Arc<'_> {
    /// The point at arclength `s` of the element.
    #[inline(always)]
    pub fn at(&self, s: f64) -> HelixPoint {
        let element = &self.curve.elements[self.element];
        let (theta, z) = (element.kappa.scale(s), element.kappa_squared * (s * s));
        let c = Stumpff::at(z);
        let local = segment::chord(theta, z, &c).scale(s);
        let turn = segment::frame(theta, z, &c);
        let [_, k1, k2] = element.kappa.0;
        // Derivative of the tangent: R (κ × e0).
        let bend = turn.apply(Vec3([0.0, k2, -k1]));
        let world = |v: Vec3<f64>| Vector3::from(element.frame_left.apply(v));
        HelixPoint {
            position: self.curve.origin + Vector3::from(element.origin_left) + world(local),
            tangent: world(Vec3([turn.0[0][0], turn.0[1][0], turn.0[2][0]])),
            bend: world(bend),
        }
    }
}

/// A pair of points of two arcs.
#[derive(Debug, Clone, Copy)]
pub struct PointPair {
    /// Arclength of the points in their elements, m.
    pub s: [f64; 2],
    /// The points.
    pub points: [HelixPoint; 2],
    /// From the second to the first, m.
    pub apart: Vector3<f64>,
    /// Derivatives of half the squared distance along the first and the second arclength, m.
    pub slope: [f64; 2],
}

impl PointPair {
    /// Whether the distance is the same along both, to rounding (the Hessian is singular): straight pieces side by side.
    pub fn is_flat(&self) -> bool {
        let [p, q] = &self.points;
        let cosine = p.tangent.dot(&q.tangent);
        (1.0 + self.apart.dot(&p.bend)) * (1.0 - self.apart.dot(&q.bend)) - cosine * cosine < 1e-7
    }
}

#[inline(always)]
fn pair(a: &Arc, b: &Arc, s: [f64; 2]) -> PointPair {
    let points = [a.at(s[0]), b.at(s[1])];
    let apart = points[0].position - points[1].position;
    PointPair { s, points, apart, slope: [apart.dot(&points[0].tangent), -apart.dot(&points[1].tangent)] }
}

/// Iterations at most; three are usual.
const MAX_ITERATIONS: usize = 40;

/// A closest pair near `start` (arclengths in the elements, m), each within its arc; where `held` is true the start's arclength stays.
///
/// Newton's iteration on half the squared distance, with the arcs' ends as bounds; where the Hessian is not positive its bend is left out,
/// and what is singular then (arcs along each other) is damped. Each step is halved until the distance falls.
pub fn closest(a: &Arc, b: &Arc, start: [f64; 2], held: [bool; 2]) -> PointPair {
    f64::call(Closest { a, b, start, held })
}

struct Closest<'a> {
    a: &'a Arc<'a>,
    b: &'a Arc<'a>,
    start: [f64; 2],
    held: [bool; 2],
}

impl Kernel for Closest<'_> {
    type Output = PointPair;
    #[inline(always)]
    fn run(self) -> PointPair {
        closest_from(self.a, self.b, self.start, self.held)
    }
}

#[inline(always)]
fn closest_from(a: &Arc, b: &Arc, start: [f64; 2], held: [bool; 2]) -> PointPair {
    let bounds = [a.s, b.s];
    let clamp = |k: usize, s: f64| s.max(bounds[k][0]).min(bounds[k][1]);
    let mut now = pair(a, b, [clamp(0, start[0]), clamp(1, start[1])]);
    let scale = (a.s[1] - a.s[0]).max(b.s[1] - b.s[0]);
    let tolerance = 1e-12 * scale;
    for _ in 0..MAX_ITERATIONS {
        let fixed = [0, 1].map(|k| {
            let outwards = (now.s[k] <= bounds[k][0] && now.slope[k] > 0.0) || (now.s[k] >= bounds[k][1] && now.slope[k] < 0.0);
            held[k] || outwards
        });
        let [p, q] = &now.points;
        let cross = -p.tangent.dot(&q.tangent);
        let mut diagonal = [1.0 + now.apart.dot(&p.bend), 1.0 - now.apart.dot(&q.bend)];
        let damped = !(diagonal[0] > 0.0 && diagonal[0] * diagonal[1] - cross * cross > 1e-9);
        if damped && !fixed[0] && !fixed[1] {
            diagonal = [1.0 + 1e-6; 2];
        }
        let room = [0, 1].map(|k| [bounds[k][0] - now.s[k], bounds[k][1] - now.s[k]]);
        let step = bounded_step(now.slope, diagonal, cross, fixed, room);
        let mut fraction = 1.0;
        let half = now.apart.norm_squared();
        let next = loop {
            let s = [clamp(0, now.s[0] + fraction * step[0]), clamp(1, now.s[1] + fraction * step[1])];
            if (s[0] - now.s[0]).abs().max((s[1] - now.s[1]).abs()) <= tolerance {
                return now;
            }
            let next = pair(a, b, s);
            if next.apart.norm_squared() <= half {
                break next;
            }
            fraction *= 0.5;
        };
        let (moved, fell) = ((next.s[0] - now.s[0]).abs().max((next.s[1] - now.s[1]).abs()), half - next.apart.norm_squared());
        now = next;
        // An undamped step of 1e-5 of the arc leaves its square.
        let last = if damped { 1e-9 } else { 1e-5 } * scale;
        if (fraction == 1.0 && moved < last) || fell <= 1e-15 * half {
            break;
        }
    }
    now
}

/// The least of slope·x + ½ x·Hx with x within `room`, H of the given diagonal and off-diagonal, positive definite; fixed x stay 0.
#[inline(always)]
fn bounded_step(slope: [f64; 2], diagonal: [f64; 2], cross: f64, fixed: [bool; 2], room: [[f64; 2]; 2]) -> [f64; 2] {
    let within = |k: usize, x: f64| x.max(room[k][0]).min(room[k][1]);
    // The best of one where the other is given.
    let best = |k: usize, other: f64| {
        let stiffness = if diagonal[k] > 1e-3 { diagonal[k] } else { 1.0 };
        within(k, -(slope[k] + cross * other) / stiffness)
    };
    match fixed {
        [true, true] => [0.0; 2],
        [false, true] => [best(0, 0.0), 0.0],
        [true, false] => [0.0, best(1, 0.0)],
        [false, false] => {
            let determinant = diagonal[0] * diagonal[1] - cross * cross;
            let free = [
                (cross * slope[1] - diagonal[1] * slope[0]) / determinant,
                (cross * slope[0] - diagonal[0] * slope[1]) / determinant,
            ];
            let clamped = [within(0, free[0]), within(1, free[1])];
            let value = |x: [f64; 2]| {
                slope[0] * x[0]
                    + slope[1] * x[1]
                    + 0.5 * (diagonal[0] * x[0] * x[0] + diagonal[1] * x[1] * x[1])
                    + cross * x[0] * x[1]
            };
            // Outside, the least lies on an edge that the free one is beyond.
            let on_first = [clamped[0], best(1, clamped[0])];
            let on_second = [best(0, clamped[1]), clamped[1]];
            match [free[0] == clamped[0], free[1] == clamped[1]] {
                [true, true] => free,
                [false, true] => on_first,
                [true, false] => on_second,
                [false, false] if value(on_first) <= value(on_second) => on_first,
                [false, false] => on_second,
            }
        }
    }
}

/// The direction of `apart`, or where the points coincide that across both tangents, or across the first.
pub fn direction(pair: &PointPair) -> Vector3<f64> {
    let [p, q] = &pair.points;
    let unit = |v: Vector3<f64>, least: f64| v.try_normalize(least);
    unit(pair.apart, 1e-12).or_else(|| unit(p.tangent.cross(&q.tangent), 1e-6)).unwrap_or_else(|| {
        let axis = if p.tangent.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
        p.tangent.cross(&axis).normalize()
    })
}
