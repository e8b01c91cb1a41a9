//! Guides at one moment, as points.

use nalgebra::{UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};

/// Points of guides at one moment: a solver's strands, or curves from a cache.
#[derive(Debug, Clone, Copy)]
pub struct GuideSamples<'a> {
    /// The points of guide g start at item g·P, where P is the number of points per strand: uniform in arclength, root first, m.
    pub points: &'a [Vector3<f64>],
    /// The orientation of each guide's follicle: any frame that moves with the head. Without them the roots' positions determine
    /// the head's rotation (the rigid rotation that best matches their positions at binding).
    pub roots: Option<&'a [UnitQuaternion<f64>]>,
    /// Velocities of the points, m/s.
    pub velocities: Option<&'a [Vector3<f64>]>,
    /// Angular velocities of the follicles, rad/s, to go with `velocities`; without them the velocities of all roots determine
    /// them.
    pub root_angular_velocities: Option<&'a [Vector3<f64>]>,
}

impl<'a> GuideSamples<'a> {
    /// Points only.
    pub fn at_rest(points: &'a [Vector3<f64>]) -> Self {
        Self { points, roots: None, velocities: None, root_angular_velocities: None }
    }

    /// Checks numbers and counts; `guides` is the required number, or `None` to derive it from the points.
    pub(in crate::groom::render_hair) fn check(&self, per_strand: usize, guides: Option<usize>) -> Result<usize> {
        let points = self.points.len();
        let count = guides.unwrap_or(points / per_strand);
        if count == 0 || points != count * per_strand {
            let expected = match guides {
                Some(guides) => format!("{} points, {per_strand} for each of {guides} guides", guides * per_strand),
                None => format!("{per_strand} points for each guide, and at least one guide"),
            };
            return Err(Error::invalid("guides.points (count)", points, expected));
        }
        vectors("points", self.points, points)?;
        if let Some(roots) = self.roots
            && roots.len() != count
        {
            return Err(Error::invalid("guides.roots (count)", roots.len(), format!("{count}, one for each guide")));
        }
        if let Some(velocities) = self.velocities {
            vectors("velocities", velocities, points)?;
        }
        if let Some(velocities) = self.root_angular_velocities {
            if self.velocities.is_none() {
                return Err(Error::invalid("guides.root_angular_velocities", "there", "none without velocities"));
            }
            vectors("root_angular_velocities", velocities, count)?;
        }
        Ok(count)
    }
}

fn vectors(name: &str, list: &[Vector3<f64>], needed: usize) -> Result<()> {
    if list.len() != needed {
        return Err(Error::invalid(format!("guides.{name} (count)"), list.len(), needed.to_string()));
    }
    for (index, vector) in list.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("guides.{name}[{index}][{axis}]"), vector[axis])?;
        }
    }
    Ok(())
}

/// Polylines at uniform arclengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Resampled {
    /// The positions, curve after curve.
    pub points: Vec<Vector3<f64>>,
    /// The interpolated values.
    pub values: Option<Vec<Vector3<f64>>>,
}

/// Resamples polylines of any numbers of points at `per_strand` points each, uniform in arclength: guides from a cache. `counts`
/// are the points of each curve, at least one. `values` per point (velocities, say) are interpolated as well. A curve without
/// length has all its points at its root.
///
/// # Errors
/// [`Error::InvalidArgument`] for counts that are zero or do not add up, a list of another length, points that are not finite.
pub fn resampled(
    points: &[Vector3<f64>],
    counts: &[u32],
    values: Option<&[Vector3<f64>]>,
    per_strand: usize,
) -> Result<Resampled> {
    if per_strand < 2 {
        return Err(Error::invalid("per_strand", per_strand, "2 or more: root and tip"));
    }
    let total: u64 = counts.iter().map(|count| u64::from(*count)).sum();
    if total != points.len() as u64 {
        return Err(Error::invalid("guides.points (count)", points.len(), format!("{total}, the sum of the counts")));
    }
    vectors("points", points, points.len())?;
    if let Some(values) = values {
        vectors("velocities", values, points.len())?;
    }
    let mut out = Vec::with_capacity(counts.len() * per_strand);
    let mut out_values = values.map(|_| Vec::with_capacity(counts.len() * per_strand));
    let (mut first, mut lengths) = (0, Vec::new());
    for (index, count) in counts.iter().enumerate() {
        let count = *count as usize;
        if count == 0 {
            return Err(Error::invalid(format!("guides.point_counts[{index}]"), 0, "one or more"));
        }
        let curve = &points[first..first + count];
        lengths.clear();
        lengths.push(0.0);
        for edge in curve.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + (edge[1] - edge[0]).norm());
        }
        let length = lengths[count - 1];
        let mut edge = 0;
        for place in 0..per_strand {
            let wanted = length * place as f64 / (per_strand - 1) as f64;
            while edge + 2 < count && lengths[edge + 1] < wanted {
                edge += 1;
            }
            let (next, span) = ((edge + 1).min(count - 1), lengths[(edge + 1).min(count - 1)] - lengths[edge]);
            let fraction = if span > 0.0 { ((wanted - lengths[edge]) / span).clamp(0.0, 1.0) } else { 0.0 };
            out.push(curve[edge] + (curve[next] - curve[edge]) * fraction);
            if let (Some(out), Some(values)) = (&mut out_values, values) {
                let values = &values[first..first + count];
                out.push(values[edge] + (values[next] - values[edge]) * fraction);
            }
        }
        first += count;
    }
    Ok(Resampled { points: out, values: out_values })
}
