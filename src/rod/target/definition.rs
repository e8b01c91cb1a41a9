//! The definition of a target, as a host gives it.

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_positive};

/// The curve to which a strand is drawn, and how firmly along its length; see
/// [`Solver::set_targets`](crate::solver::Solver::set_targets).
///
/// ```
/// use superhelix::editing::TargetDef;
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// // The rig's curve: straight along x. The root follows it, the tip is free.
/// let curve = [Vector3::zeros(), Vector3::new(0.2, 0.0, 0.0)];
/// let target = TargetDef { points: &curve, weights: &[[0.0, 1.0], [0.5, 0.0]], ..TargetDef::default() };
/// solver.set_targets(&ids, &[target], 1.0 / 60.0)?;
/// solver.step(1.0 / 60.0, 2)?;
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetDef<'a> {
    /// The curve from root to tip, at least two points, m, world; straight in between. A curve of control points is sampled
    /// first ([`Spline`](crate::math::splines::spline::Spline)).
    pub points: &'a [Vector3<f64>],
    /// The arclength of the strand's point that belongs to each point of the curve, m, strictly ascending, 0 or more. Parts of a
    /// strand before the first and beyond the last are free. `None`: in proportion to the curve's own length, so that the
    /// strand's tip belongs to the last point.
    pub arclengths: Option<&'a [f64]>,
    /// Keys of the weight: a position on the strand from 0 (root) to 1 (tip), strictly ascending, and the weight there, 0 to 1.
    /// Linear between keys, constant beyond them. At least one.
    pub weights: &'a [[f64; 2]],
    /// The time constant with which a point of weight ½ comes to its place, s; above zero. Weight w has the time constant
    /// `time_constant`·(1 − w)/w.
    pub time_constant: f64,
}

impl Default for TargetDef<'_> {
    /// Weight 1 at the root, 0 at the tip, 0.1 s at ½. The points must be set.
    fn default() -> Self {
        Self { points: &[], arclengths: None, weights: &[[0.0, 1.0], [1.0, 0.0]], time_constant: 0.1 }
    }
}

/// Checks that numbers ascend strictly.
fn check_ascending(argument: &str, index: usize, value: f64, before: Option<f64>) -> Result<()> {
    match before {
        Some(before) if value <= before => {
            Err(Error::invalid(format!("{argument}[{index}]"), value, format!("more than {before}, the one before")))
        }
        _ => Ok(()),
    }
}

impl TargetDef<'_> {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for the first value that cannot be used.
    pub fn check(&self, argument: &str) -> Result<()> {
        if self.points.len() < 2 {
            return Err(Error::invalid(format!("{argument}.points"), format!("{} points", self.points.len()), "at least 2"));
        }
        for (index, point) in self.points.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("{argument}.points[{index}][{axis}]"), point[axis])?;
            }
        }
        if let Some(arclengths) = self.arclengths {
            let name = format!("{argument}.arclengths");
            if arclengths.len() != self.points.len() {
                let expected = format!("{}, one per point", self.points.len());
                return Err(Error::invalid(name, format!("{} numbers", arclengths.len()), expected));
            }
            for (index, arclength) in arclengths.iter().enumerate() {
                check_finite(|| format!("{name}[{index}]"), *arclength)?;
                if *arclength < 0.0 {
                    return Err(Error::invalid(format!("{name}[{index}]"), arclength, "0 or more"));
                }
                check_ascending(&name, index, *arclength, index.checked_sub(1).map(|before| arclengths[before]))?;
            }
        }
        if self.weights.is_empty() {
            return Err(Error::invalid(format!("{argument}.weights"), "no key", "at least one"));
        }
        for (index, [position, weight]) in self.weights.iter().enumerate() {
            if !(0.0..=1.0).contains(position) {
                return Err(Error::invalid(format!("{argument}.weights[{index}][0]"), position, "0 (root) to 1 (tip)"));
            }
            if !(0.0..=1.0).contains(weight) {
                return Err(Error::invalid(format!("{argument}.weights[{index}][1]"), weight, "0 to 1"));
            }
            let before = index.checked_sub(1).map(|before| self.weights[before][0]);
            check_ascending(&format!("{argument}.weights"), index, *position, before)?;
        }
        check_positive(|| format!("{argument}.time_constant"), self.time_constant)
    }

    /// The arclength on a strand of this length that belongs to each point.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for points that all coincide, without arclengths of their own.
    pub fn arclengths(&self, length: f64) -> Result<Vec<f64>> {
        if let Some(arclengths) = self.arclengths {
            return Ok(arclengths.to_vec());
        }
        let mut along = 0.0;
        let mut arclengths = Vec::with_capacity(self.points.len());
        arclengths.push(0.0);
        for edge in self.points.windows(2) {
            along += (edge[1] - edge[0]).norm();
            arclengths.push(along);
        }
        if !(along > 0.0 && along.is_finite()) {
            return Err(Error::invalid("points", format!("a curve {along} m long"), "a length above 0"));
        }
        arclengths.iter_mut().for_each(|arclength| *arclength *= length / along);
        // The strand's last quadrature point lies before its tip, whatever the rounding of its length.
        arclengths[self.points.len() - 1] = length;
        Ok(arclengths)
    }
}
