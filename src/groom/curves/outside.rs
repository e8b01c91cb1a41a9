//! Brings curves out of a body: a curve drawn inside it moves out by as little as possible, edge by edge from the root, and keeps
//! every edge's length.

use nalgebra::Vector3;

use crate::contact::shape::Shape;
use crate::error::{Error, Result, check_not_negative};

/// How steeply a curve that starts inside comes out: depth lost per arclength.
const SLOPE: f64 = 0.5;
/// Points this much too close are close enough, m.
const CLOSE: f64 = 1e-5;
/// Largest number of rounds of pushing points out and restoring edge lengths, and of steps of a point.
const MAX_ROUNDS: u32 = 60;

/// A path out may lead no farther than this many times the depth, plus this, m.
const FAR_OF_DEPTH: f64 = 2.0;
const FAR: f64 = 5e-3;

/// What was done to a curve.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BroughtOut {
    /// Points that were deeper than permitted.
    pub inside: usize,
    /// Depth of the deepest one, m.
    pub deepest: f64,
    /// The largest displacement of a point, m.
    pub moved: f64,
    /// Whether no path out was found: the curve is then unchanged.
    pub stuck: bool,
}

/// Brings a curve (m, root first, in the shape's axes) out of a shape: every point to at least `clearance` metres (0 or above)
/// from its surface. The root stays. If the root is closer or inside, the points after it may be as deep as a path out at a slope
/// of one half requires. Edges keep their lengths. A curve clear of the shape stays unchanged, and so does one that would have to
/// move by more than twice its depth plus 5 mm. Bounded: 120 rounds over the points.
///
/// # Errors
/// [`Error::InvalidArgument`] for a number that is not finite or a clearance below zero.
pub fn bring_out(points: &mut [Vector3<f64>], shape: &Shape, clearance: f64) -> Result<BroughtOut> {
    check_not_negative(|| "clearance".into(), clearance)?;
    if let Some(index) = points.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
        return Err(Error::invalid(format!("points[{index}]"), format!("{:?}", points[index].as_slice()), "finite numbers"));
    }
    let drawn = Drawn::new(points, shape, clearance);
    let mut brought = BroughtOut::default();
    for (point, wanted) in points.iter().zip(&drawn.wanted) {
        if let Some(depth) = drawn.depth(point, *wanted) {
            brought.inside += 1;
            brought.deepest = brought.deepest.max(depth.signed);
        }
    }
    if brought.inside == 0 {
        return Ok(brought);
    }
    let far = FAR_OF_DEPTH * (brought.deepest + clearance) + FAR;
    // First each point along its shortest path out. Where neighbouring points would separate (an ear with two sides), whole runs
    // in the same direction.
    for way in [Drawn::push_each, Drawn::push_runs] {
        if let Some(moved) = drawn.out(points, way).filter(|moved| *moved <= far) {
            brought.moved = moved;
            return Ok(brought);
        }
        points.copy_from_slice(&drawn.points);
    }
    brought.stuck = true;
    Ok(brought)
}

/// A point that is too deep.
struct Depth {
    /// The depth beyond the permitted one, m.
    by: f64,
    /// The direction out.
    normal: Vector3<f64>,
    /// Its depth in the shape, m.
    signed: f64,
}

/// A curve as drawn.
struct Drawn<'a> {
    shape: &'a Shape,
    points: Vec<Vector3<f64>>,
    edges: Vec<f64>,
    /// The target distance of each point, m.
    wanted: Vec<f64>,
}

impl<'a> Drawn<'a> {
    fn new(points: &[Vector3<f64>], shape: &'a Shape, clearance: f64) -> Self {
        let edges: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        let mut wanted = Vec::with_capacity(points.len());
        if let Some(root) = points.first() {
            let mut rises = shape.closest(*root, clearance).map_or(clearance, |surface| surface.distance);
            wanted.push(rises);
            wanted.extend(edges.iter().map(|edge| {
                rises += SLOPE * edge;
                clearance.min(rises)
            }));
        }
        Self { shape, points: points.to_vec(), edges, wanted }
    }

    fn depth(&self, point: &Vector3<f64>, wanted: f64) -> Option<Depth> {
        let surface = self.shape.closest(*point, wanted - CLOSE)?;
        Some(Depth { by: wanted - surface.distance, normal: surface.normal, signed: -surface.distance })
    }

    /// Pushes points out and restores edge lengths until none is too deep; returns the largest displacement of a point.
    fn out(&self, points: &mut [Vector3<f64>], push: fn(&Self, &mut [Vector3<f64>]) -> bool) -> Option<f64> {
        let is_out = (0..MAX_ROUNDS).any(|_| {
            let pushed = push(self, points);
            if pushed {
                self.follow(points);
            }
            !pushed
        });
        let moved = points.iter().zip(&self.points).fold(0.0, |most, (now, before)| f64::max(most, (now - before).norm()));
        is_out.then_some(moved)
    }

    /// Restores the edges' lengths, from the root on.
    fn follow(&self, points: &mut [Vector3<f64>]) {
        for k in 1..points.len() {
            let way = points[k] - points[k - 1];
            // (A point that was pushed onto the one before continues in the drawn direction.)
            let along = way.try_normalize(0.0).or_else(|| (self.points[k] - self.points[k - 1]).try_normalize(0.0));
            points[k] = points[k - 1] + along.unwrap_or_else(Vector3::zeros) * self.edges[k - 1];
        }
    }

    /// Pushes each point that is too deep along its shortest path out. False if there is none.
    fn push_each(&self, points: &mut [Vector3<f64>]) -> bool {
        let mut pushed = false;
        for (point, wanted) in points.iter_mut().zip(&self.wanted).skip(1) {
            if let Some(depth) = self.depth(point, *wanted) {
                *point += depth.normal * depth.by;
                pushed = true;
            }
        }
        pushed
    }

    /// Pushes runs of successive points that are too deep in the same direction, each as far as it takes. False if there are
    /// none.
    fn push_runs(&self, points: &mut [Vector3<f64>]) -> bool {
        let depths: Vec<Option<Depth>> =
            points.iter().zip(&self.wanted).map(|(point, wanted)| self.depth(point, *wanted)).collect();
        let mut pushed = false;
        let mut k = 1;
        while k < points.len() {
            let end = (k..points.len()).find(|k| depths[*k].is_none()).unwrap_or(points.len());
            let sum: Vector3<f64> = depths[k..end].iter().flatten().map(|depth| depth.normal * depth.by).sum();
            if let Some(direction) = sum.try_normalize(0.0) {
                for (point, wanted) in points[k..end].iter_mut().zip(&self.wanted[k..end]) {
                    // Nowhere along the path is the surface closer than this.
                    for _ in 0..MAX_ROUNDS {
                        let Some(depth) = self.depth(point, *wanted) else { break };
                        *point += direction * depth.by;
                    }
                }
                pushed = true;
            }
            k = end + 1;
        }
        pushed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.1;

    fn lengths(points: &[Vector3<f64>]) -> Vec<f64> {
        points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect()
    }

    #[test]
    fn a_chord_through_a_ball_goes_round_it() {
        let ball = Shape::new_sphere(RADIUS).unwrap();
        // From a root on the surface to at most a centimetre deep, and out again.
        let mut points: Vec<_> =
            (0..41).map(|k| Vector3::new(-0.0436 + 0.004 * f64::from(k), 0.09, 0.002 * f64::from(k % 2))).collect();
        let drawn = points.clone();
        let brought = bring_out(&mut points, &ball, 5e-4).unwrap();
        assert!(brought.inside > 10 && !brought.stuck && (brought.deepest - 0.01).abs() < 1e-3, "{brought:?}");
        assert_eq!(points[0], drawn[0]);
        for (now, before) in lengths(&points).iter().zip(lengths(&drawn)) {
            assert!((now - before).abs() < 1e-12);
        }
        for (k, point) in points.iter().enumerate().skip(1) {
            assert!(point.norm() > RADIUS + 5e-4 - 2.0 * CLOSE, "point {k}: {}", point.norm() - RADIUS);
        }
        // A depth of 1 cm moves by about that, and no point by much more than the deepest plus the shortening by bending round
        // the ball.
        assert!(brought.moved < 0.025, "{brought:?}");
    }

    #[test]
    fn clear_strands_are_unchanged_and_deep_roots_come_out_at_one_in_two() {
        let floor = Shape::new_half_space(Vector3::y()).unwrap();
        let mut points: Vec<_> = (0..21).map(|k| Vector3::new(0.01 * f64::from(k), 0.02, 0.0)).collect();
        let drawn = points.clone();
        assert_eq!(bring_out(&mut points, &floor, 1e-3).unwrap(), BroughtOut::default());
        assert_eq!(points, drawn);
        let mut points: Vec<_> = (0..21).map(|k| Vector3::new(0.01 * f64::from(k), -0.02, 0.0)).collect();
        let brought = bring_out(&mut points, &floor, 1e-3).unwrap();
        assert_eq!((points[0].y, brought.stuck), (-0.02, false));
        assert!((brought.deepest - 0.02).abs() < 1e-12);
        for (k, point) in points.iter().enumerate() {
            assert!(point.y > (-0.02 + 0.005 * k as f64).min(1e-3) - 2.0 * CLOSE, "{k}: {}", point.y);
        }
        // Through a thin plate, half of it closer to one side and half to the other: all of it goes to one.
        let plate = Shape::new_box(Vector3::new(0.1, 0.002, 0.1)).unwrap();
        let mut points: Vec<_> =
            (0..41).map(|k| Vector3::new(-0.15 + 0.005 * f64::from(k), 0.004 - 0.00025 * f64::from(k), 0.0)).collect();
        let brought = bring_out(&mut points, &plate, 1e-3).unwrap();
        assert!(brought.inside > 10 && !brought.stuck, "{brought:?}");
        assert!(points.iter().all(|point| plate.closest(*point, 1e-3 - 2.0 * CLOSE).is_none()), "{points:?}");
        assert!(bring_out(&mut points, &floor, -1.0).is_err());
        points[3].x = f64::NAN;
        assert!(bring_out(&mut points, &floor, 0.0).unwrap_err().to_string().contains("points[3]"));
    }
}
