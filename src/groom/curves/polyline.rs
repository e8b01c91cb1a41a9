//! A polyline by arclength, the input of a fit.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};

/// Distinct points, and the arclength at each.
#[derive(Debug, Clone)]
pub(in crate::groom) struct Polyline {
    pub points: Vec<Vector3<f64>>,
    pub arclengths: Vec<f64>,
    /// Their indices among the given points.
    pub kept: Vec<usize>,
}

/// A polyline with a shorter total length cannot be distinguished from a point in f64 arithmetic on metres.
const SHORTEST: f64 = 1e-12;

/// Points closer together than this fraction of the length define no direction.
const NEARLY_DOUBLED: f64 = 1e-6;

impl Polyline {
    /// Checks the points and removes repeated ones.
    pub fn new(points: &[Vector3<f64>]) -> Result<Self> {
        let mut kept = Vec::with_capacity(points.len());
        let mut distinct: Vec<Vector3<f64>> = Vec::with_capacity(points.len());
        let mut arclengths = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (index, point) in points.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("points[{index}][{axis}]"), point[axis])?;
            }
            if let Some(last) = distinct.last() {
                let edge = (point - last).norm();
                if edge == 0.0 {
                    continue;
                }
                length += edge;
            }
            kept.push(index);
            distinct.push(*point);
            arclengths.push(length);
        }
        if distinct.len() < 2 || !(length > SHORTEST && length.is_finite()) {
            return Err(Error::invalid(
                "points",
                format!("{} points, {} of them distinct, of length {length} m", points.len(), distinct.len()),
                format!("a polyline of at least two distinct points, longer than {SHORTEST} m"),
            ));
        }
        Ok(Self { points: distinct, arclengths, kept })
    }

    /// Sets arclengths that are known better, one per given point.
    pub fn set_arclengths(&mut self, arclengths: &[f64]) -> Result<()> {
        for (index, arclength) in arclengths.iter().enumerate() {
            check_finite(|| format!("arclengths[{index}]"), *arclength)?;
        }
        let first = arclengths[self.kept[0]];
        if first != 0.0 {
            return Err(Error::invalid(format!("arclengths[{}]", self.kept[0]), first, "0, at the root"));
        }
        for kept in self.kept.windows(2) {
            let (from, to) = (arclengths[kept[0]], arclengths[kept[1]]);
            if to <= from {
                let expected = format!("above {from}, that of the distinct point before it");
                return Err(Error::invalid(format!("arclengths[{}]", kept[1]), to, expected));
            }
        }
        let length = arclengths[self.kept[self.kept.len() - 1]];
        if length <= SHORTEST {
            return Err(Error::invalid("arclengths", length, format!("a length above {SHORTEST} m")));
        }
        for (own, kept) in self.arclengths.iter_mut().zip(&self.kept) {
            *own = arclengths[*kept];
        }
        Ok(())
    }

    /// Measures arclength along the means of runs of points, each run at least `run` long from end to end: noise within a run
    /// adds nothing. Between the runs' middles arclength grows linearly with the point's index.
    pub fn measure_along_runs(&mut self, run: f64) {
        let last = self.points.len() - 1;
        // Knots: index among the points, position.
        let mut knots: Vec<(f64, Vector3<f64>)> = vec![(0.0, self.points[0])];
        let mut begin = 1;
        for index in 1..last {
            // The middle of a run averages the noise; its two ends measure its length.
            if (self.points[index] - self.points[begin]).norm() >= run || index + 1 == last {
                let count = index + 1 - begin;
                let mean = self.points[begin..=index].iter().sum::<Vector3<f64>>() / count as f64;
                knots.push((0.5 * (begin + index) as f64, mean));
                begin = index + 1;
            }
        }
        knots.push((last as f64, self.points[last]));
        let mut length = 0.0;
        let mut ends = vec![0.0];
        for pair in knots.windows(2) {
            length += (pair[1].1 - pair[0].1).norm();
            ends.push(length);
        }
        if length <= SHORTEST {
            return;
        }
        let mut knot = 0;
        for (index, arclength) in self.arclengths.iter_mut().enumerate() {
            while knot + 2 < knots.len() && index as f64 > knots[knot + 1].0 {
                knot += 1;
            }
            let fraction = (index as f64 - knots[knot].0) / (knots[knot + 1].0 - knots[knot].0);
            *arclength = ends[knot] + (ends[knot + 1] - ends[knot]) * fraction;
        }
    }

    /// The arclength of the last point.
    pub fn length(&self) -> f64 {
        self.arclengths[self.arclengths.len() - 1]
    }

    /// The initial direction of the polyline: towards the first point that is clearly distinct.
    pub fn direction(&self) -> Vector3<f64> {
        let least = NEARLY_DOUBLED * self.length();
        let away = self.points[1..].iter().map(|point| point - self.points[0]).find(|away| away.norm() > least);
        away.unwrap_or(self.points[1] - self.points[0]).normalize()
    }

    /// A frame with n0 in a unit direction, and n1 as close as possible to `normal`; without one (or along it), to a world axis
    /// far from the direction.
    pub fn frame_along(n0: Vector3<f64>, normal: Option<Vector3<f64>>) -> UnitQuaternion<f64> {
        let across = |axis: Vector3<f64>| axis - n0 * n0.dot(&axis);
        let wanted = normal.map(across).filter(|across| across.norm() > 1e-6).unwrap_or_else(|| {
            across(if n0.x.abs() <= n0.y.abs() && n0.x.abs() <= n0.z.abs() {
                Vector3::x()
            } else if n0.y.abs() <= n0.z.abs() {
                Vector3::y()
            } else {
                Vector3::z()
            })
        });
        let n1 = wanted.normalize();
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_basis_unchecked(&[n0, n1, n0.cross(&n1)]))
    }
}
