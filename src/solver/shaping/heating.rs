//! Heat: hair takes on its shape between hot plates or on a hot barrel.

use nalgebra::Vector3;

use super::crossing::Curve;
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_finite, check_not_negative, check_positive};
use crate::math::frame::Frame;
use crate::solver::Solver;
use crate::solver::id::StrandId;

/// The natural shape that heated hair takes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HeatedShape {
    /// Straight and untwisted: plates.
    #[default]
    Straight,
    /// Its current shape: a barrel.
    Present,
}

/// A heated region and its effect.
///
/// ```
/// use superhelix::editing::{HeatDef, HeatedShape};
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Frame, Solver, SolverOptions, StrandDef};
///
/// // Hot plates straighten what is between them.
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let curl = StrandDef { natural: vec![[0.0, 40.0, 0.0]; 8], ..StrandDef::straight(0.2, 8) };
/// let ids = solver.add_strands(&[curl])?;
/// let plates = HeatDef {
///     frame: Frame::default(),
///     half_edges: Vector3::new(0.3, 0.3, 0.3),
///     shape: HeatedShape::Straight,
///     rate: 1.0,
/// };
/// solver.heat_strands(&ids, &plates, 1.0)?;
/// assert!(solver.natural_curvatures(ids[0])?[0][1] < 20.0);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatDef {
    /// Pose of the hot box, world.
    pub frame: Frame,
    /// Half its edges, m, above zero, along the frame's axes.
    pub half_edges: Vector3<f64>,
    /// The shape that hair in it takes on.
    pub shape: HeatedShape,
    /// Rate, 1/s, zero or above: in a second the remaining difference falls to e^-rate.
    pub rate: f64,
}

/// e^-x for x ≥ 0, by halvings of x: the same bits on every machine.
fn decay(x: f64) -> f64 {
    // A thousandth of x to second order; its error is x³/(12·1024²) of an exponent.
    let part = x / 1024.0;
    (0..10).fold((1.0 - 0.5 * part).max(0.0) / (1.0 + 0.5 * part), |power, _| power * power)
}

impl Solver {
    /// Heats strands for `seconds`. Where an element is in the box, its natural twist and curvatures move towards straight, or
    /// towards the current ones; an element partly inside moves proportionally slower. Frozen curvatures stay. Nothing moves at
    /// once. Discards the natural shape that [`Solver::set_element_count`] keeps for a heated strand. Returns the heated length
    /// of each strand, m, in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a field of `heat`, or `seconds`, out of range, or
    /// an identifier given twice. Nothing has then changed.
    pub fn heat_strands(&mut self, ids: &[StrandId], heat: &HeatDef, seconds: f64) -> Result<Vec<f64>> {
        for axis in 0..3 {
            check_positive(|| format!("heat.half_edges[{axis}]"), heat.half_edges[axis])?;
            check_finite(|| format!("heat.frame.origin[{axis}]"), heat.frame.origin[axis])?;
        }
        check_not_negative(|| "heat.rate".into(), heat.rate)?;
        check_not_negative(|| "seconds".into(), seconds)?;
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let mut hot = Vec::with_capacity(indices.len());
        for index in indices {
            let strand = &mut self.strands[index];
            let stretches = Curve::of(strand).stretches_in(&heat.frame, &heat.half_edges);
            hot.push(stretches.iter().map(|[from, to]| to.along - from.along).sum());
            if stretches.is_empty() {
                continue;
            }
            let model = &mut strand.model;
            let freedoms = model.freedoms;
            let mut start = 0.0;
            for (element, length) in model.lengths.iter().enumerate() {
                let end = start + length;
                let inside = |[from, to]: &[super::crossing::CurvePlace; 2]| (to.along.min(end) - from.along.max(start)).max(0.0);
                let fraction = stretches.iter().map(inside).sum::<f64>() / length;
                start = end;
                if fraction == 0.0 {
                    continue;
                }
                let left = decay(heat.rate * seconds * fraction.min(1.0));
                for axis in (0..3).filter(|axis| freedoms.contains(*axis)) {
                    let aim = if heat.shape == HeatedShape::Present { strand.state.curvatures[element][axis] } else { 0.0 };
                    model.natural[element][axis] = aim + (model.natural[element][axis] - aim) * left;
                }
            }
            strand.authored = None;
            strand.energies.elastic = strand.model.elastic_energy(&strand.state.curvatures);
        }
        Ok(hot)
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn decays_as_the_exponential() {
        for x in [0.0, 1e-6, 0.1, 1.0, 5.0, 20.0] {
            assert!((super::decay(x) - f64::exp(-x)).abs() < 1e-6 * (1.0 + x), "{x}");
        }
        assert_eq!(super::decay(1e9), 0.0);
    }
}
