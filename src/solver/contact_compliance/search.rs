//! A quick search for places where a strand is near a tool's bodies and may soon be in contact. Contacts under pressure are known
//! from the step.
//!
//! Distances change no faster than arclength, so distant strands are skipped in large strides. Where points a few millimetres
//! apart enclose a minimum, secants of the slope find it.

use nalgebra::Vector3;

use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::StrandCurve;
use crate::rod::strand::place_on;

/// Points along a strand are at most this far apart, m, and turn by at most this from one to the next, rad.
const SPACING: f64 = 8e-3;
const TURN: f64 = 0.5;
/// Secants per minimum, and the slope that counts as level.
const MAX_SECANTS: usize = 4;
/// Surfaces count as this round, m, until something better is known.
const ROUND: f64 = 1e-3;
const LEVEL: f64 = 0.02;

/// A place of a strand near a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearPlace {
    /// Index of the body.
    pub body: usize,
    /// Arclength from the root, m.
    pub along: f64,
    /// Unit normal, world, from the body to the strand.
    pub normal: Vector3<f64>,
    /// Between the surfaces, m.
    pub gap: f64,
}

/// Points along a strand.
#[derive(Debug, Clone, Copy)]
struct Point {
    element: usize,
    s: f64,
    along: f64,
    at: Vector3<f64>,
}

/// Points and places found, kept for their memory.
#[derive(Debug, Default)]
pub(super) struct Search {
    points: Vec<Point>,
    pub found: Vec<NearPlace>,
}

impl Search {
    /// Finds the places beyond `exempt` (m of arclength) whose surface, `radius` (m) from the centreline, is closer than `within`
    /// (m) to one of the bodies that are `met`.
    pub fn find(
        &mut self,
        curve: &StrandCurve,
        [exempt, radius, within]: [f64; 3],
        bodies: &[BodyAt],
        met: impl Fn(&BodyAt) -> bool,
    ) {
        self.found.clear();
        self.points.clear();
        for (body, at) in bodies.iter().enumerate().filter(|(_, body)| met(body)) {
            if self.points.is_empty() {
                self.place_points(curve, exempt);
            }
            self.pass(curve, body, at, radius + at.thickness, within);
        }
    }

    fn place_points(&mut self, curve: &StrandCurve, exempt: f64) {
        let mut along = 0.0;
        for (element, state) in curve.elements.iter().enumerate() {
            let turn = state.kappa_squared.sqrt() * state.length;
            let pieces = (state.length / SPACING).max(turn / TURN).ceil().max(1.0);
            let from = if element == 0 { 0 } else { 1 };
            for piece in from..=pieces as usize {
                let s = state.length * piece as f64 / pieces;
                if along + s >= exempt {
                    self.points.push(Point { element, s, along: along + s, at: curve.position(element, s) });
                }
            }
            along += state.length;
        }
    }

    /// The whole strand against one body.
    fn pass(&mut self, curve: &StrandCurve, body: usize, at: &BodyAt, thickness: f64, within: f64) {
        let reach = thickness + within;
        // Nothing is known beyond a stride.
        let farthest = reach + 0.1;
        let back = at.end.rotation.inverse();
        let closest = |point: Vector3<f64>| at.shape.closest(back * (point - at.end.origin), farthest);
        let distance = |point: &Point| closest(point.at).map_or(farthest, |surface| surface.distance);
        let points = &self.points;
        // The last two points evaluated.
        let mut seen: [Option<(usize, f64)>; 2] = [None; 2];
        let mut next = 0;
        while next < points.len() || seen[1].is_some() {
            let now = points.get(next).map(|point| (next, distance(point)));
            if let Some((middle, least)) = seen[1] {
                let [before, after] = [seen[0], now].map(|other| other.unwrap_or((middle, f64::INFINITY)));
                let span = (points[after.0].along - points[middle].along).max(points[middle].along - points[before.0].along);
                if least <= before.1 && least < after.1 && least - span <= reach {
                    let ends = [points[before.0].along, points[after.0].along];
                    let in_world = |point| closest(point).map(|near| (near.distance, at.end.rotation * near.normal));
                    if let Some((along, distance, normal)) = lowest(curve, &points[middle], ends, in_world)
                        && distance < reach
                    {
                        self.found.push(NearPlace { body, along, normal, gap: distance - thickness });
                    }
                }
            }
            seen = [seen[1], now];
            let Some((_, far)) = now else { break };
            let leap = points[next].along + (far - reach);
            next += 1;
            while next + 1 < points.len() && points[next].along < leap {
                next += 1;
            }
        }
    }
}

/// The lowest place between two arclengths, starting from a point between them: its arclength, distance and normal (world).
fn lowest(
    curve: &StrandCurve,
    from: &Point,
    ends: [f64; 2],
    closest: impl Fn(Vector3<f64>) -> Option<(f64, Vector3<f64>)>,
) -> Option<(f64, f64, Vector3<f64>)> {
    let look = |element: usize, s: f64, at: Vector3<f64>| {
        let (distance, normal) = closest(at)?;
        Some((distance, normal, normal.dot(&curve.tangent(element, s))))
    };
    let mut along = from.along;
    let (distance, normal, mut slope) = look(from.element, from.s, from.at)?;
    let mut best = (along, distance, normal);
    let mut step = -slope * (distance.max(0.0) + ROUND);
    for _ in 0..MAX_SECANTS {
        let to = (along + step).clamp(ends[0], ends[1]);
        if slope.abs() <= LEVEL || to == along {
            break;
        }
        let (element, s) = place_on(curve.elements.iter().map(|element| element.length), to);
        let Some((distance, normal, there)) = look(element, s, curve.position(element, s)) else { break };
        if distance < best.1 {
            best = (to, distance, normal);
        }
        let bend = (there - slope) / (to - along);
        step = if bend > 0.0 { -there / bend } else { -there * (distance.max(0.0) + ROUND) };
        (along, slope) = (to, there);
    }
    Some(best)
}
