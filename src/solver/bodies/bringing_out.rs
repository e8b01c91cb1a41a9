//! Brings curves out of a body of the scene before they become strands.

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::groom::curves::outside::{self, BroughtOut};
use crate::solver::Solver;
use crate::solver::id::BodyId;

impl Solver {
    /// Brings curves out of a body at its current pose, as [`outside::bring_out`] does: `points` (m, world), curve after curve,
    /// `counts` points each. Returns results in the order of the curves. Does not change the scene.
    ///
    /// # Errors
    /// [`Error::InvalidId`] (`body`); [`Error::InvalidArgument`] for a clearance below zero, numbers that are not finite, or
    /// counts that do not add up to the points. No point has then moved.
    pub fn bring_out(
        &mut self,
        body: BodyId,
        clearance: f64,
        counts: &[usize],
        points: &mut [Vector3<f64>],
    ) -> Result<Vec<BroughtOut>> {
        let index = self.body_index(|| "body".into(), body)?;
        let all = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count));
        if all != Some(points.len()) {
            let sum = all.map_or("too many".into(), |sum| sum.to_string());
            return Err(Error::invalid("counts", format!("{sum} in all"), format!("{}, as many as points", points.len())));
        }
        self.rest_bodies();
        let body = self.bodies[index].body.still(index as u32);
        let to_body = body.end.rotation.inverse();
        let (mut rest, mut done) = (&points[..], Vec::with_capacity(counts.len()));
        for (k, count) in counts.iter().enumerate() {
            let (curve, others) = rest.split_at(*count);
            rest = others;
            let mut moved: Vec<_> = curve.iter().map(|point| to_body * (point - body.end.origin)).collect();
            let brought = outside::bring_out(&mut moved, body.shape, clearance + body.thickness)
                .map_err(|error| error.renamed("points", &format!("curve {k}, points")))?;
            done.push((brought, moved));
        }
        let mut rest = points;
        for (brought, moved) in &done {
            let (curve, others) = rest.split_at_mut(moved.len());
            rest = others;
            // (An unmoved curve keeps its bits, and so does a root.)
            if brought.moved > 0.0 {
                for (point, moved) in curve.iter_mut().zip(moved).skip(1) {
                    *point = body.end.origin + body.end.rotation * moved;
                }
            }
        }
        Ok(done.into_iter().map(|(brought, _)| brought).collect())
    }
}
