//! Permitted overlaps of a strand with others and with bodies, along its length. Grooms are drawn with wisps in wisps and hair
//! in heads; where such a groom is to rest as drawn, these overlaps must bear no force.

use crate::error::{Error, Result, check_not_negative};

/// The permitted overlap of a strand, given at material points along it, linear between them and constant beyond the first and the
/// last. It belongs to arclengths, not to elements, and stays when these change.
///
/// ```
/// use superhelix::{Solver, SolverOptions, StrandContact, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 5)])?;
/// solver.set_contact(&ids, Some(&StrandContact::default()))?;
/// let overlap = solver.allow_overlaps(&ids)?[0];
/// assert_eq!((overlap.bodies, overlap.hair), (0.0, 0.0)); // it overlaps nothing
/// let kept = solver.permitted_overlap(ids[0])?.cloned();
/// solver.set_permitted_overlaps(&ids, &[kept])?;
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PermittedOverlap {
    /// Arclengths of the material points from the root, m, ascending; the first zero or above. At least one.
    pub along: Vec<f64>,
    /// The fraction left of the wisp's radius at each material point, 0 to 1.
    pub wisp_fractions: Vec<f64>,
    /// The permitted depth of the strand's surface in a body at each material point, m, zero or above.
    pub sunk: Vec<f64>,
}

impl PermittedOverlap {
    /// Checks the lists; `name` goes before theirs in the error.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for lists of different lengths or without material points, or the first value out of range.
    pub fn check(&self, name: &str) -> Result<()> {
        let count = self.along.len();
        if count == 0 {
            return Err(Error::invalid(format!("{name}.along (count)"), count, "1 or more"));
        }
        for (list, length) in [("wisp_fractions", self.wisp_fractions.len()), ("sunk", self.sunk.len())] {
            if length != count {
                return Err(Error::invalid(format!("{name}.{list} (count)"), length, format!("{count}, one per material point")));
            }
        }
        for (k, along) in self.along.iter().enumerate() {
            check_not_negative(|| format!("{name}.along[{k}]"), *along)?;
            if k > 0 && *along <= self.along[k - 1] {
                return Err(Error::invalid(format!("{name}.along[{k}]"), along, format!("above {}", self.along[k - 1])));
            }
        }
        for (k, fraction) in self.wisp_fractions.iter().enumerate() {
            if !(0.0..=1.0).contains(fraction) {
                return Err(Error::invalid(format!("{name}.wisp_fractions[{k}]"), fraction, "0 to 1"));
            }
        }
        self.sunk.iter().enumerate().try_for_each(|(k, sunk)| check_not_negative(|| format!("{name}.sunk[{k}]"), *sunk))
    }

    /// The fraction left of the wisp's radius at an arclength (m), 0 to 1.
    pub fn wisp_fraction(&self, along: f64) -> f64 {
        self.between(&self.wisp_fractions, along)
    }

    /// The permitted depth in a body at an arclength (m), m.
    pub fn sunk(&self, along: f64) -> f64 {
        self.between(&self.sunk, along)
    }

    /// The least of [`PermittedOverlap::sunk`] between two arclengths (m), m.
    pub fn least_sunk(&self, from: f64, to: f64) -> f64 {
        let between = self.along.iter().zip(&self.sunk).filter(|(along, _)| (from..=to).contains(*along));
        between.map(|(_, sunk)| *sunk).fold(self.sunk(from).min(self.sunk(to)), f64::min)
    }

    /// The ends of a straight line between two arclengths (m) that is nowhere above [`PermittedOverlap::sunk`], m: that itself where no
    /// material point is between them.
    pub(in crate::contact) fn line_below(&self, from: f64, to: f64) -> [f64; 2] {
        let next = self.along.partition_point(|along| *along <= from);
        if self.along.get(next).is_none_or(|along| *along >= to) {
            return [from, to].map(|along| self.beside(&self.sunk, next, along));
        }
        [self.least_sunk(from, to); 2]
    }

    fn between(&self, values: &[f64], along: f64) -> f64 {
        self.beside(values, self.along.partition_point(|material_point| *material_point <= along), along)
    }

    /// A value at an arclength before the material point `next` and not before the one before it.
    fn beside(&self, values: &[f64], next: usize, along: f64) -> f64 {
        let next = next.clamp(1, self.along.len().max(2) - 1);
        let (Some(a), Some(b)) = (self.along.get(next - 1), self.along.get(next)) else { return values[0] };
        let t = ((along - a) / (b - a)).clamp(0.0, 1.0);
        values[next - 1] + t * (values[next] - values[next - 1])
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        (self.along.capacity() + self.wisp_fractions.capacity() + self.sunk.capacity()) * size_of::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_between_material_points_and_constant_beyond() {
        let permitted_overlap = PermittedOverlap {
            along: vec![0.01, 0.02, 0.04],
            wisp_fractions: vec![1.0, 0.5, 0.0],
            sunk: vec![0.0, 0.002, 0.001],
        };
        permitted_overlap.check("a").unwrap();
        for (along, fraction, sunk) in [
            (0.0, 1.0, 0.0),
            (0.015, 0.75, 0.001),
            (0.02, 0.5, 0.002),
            (0.03, 0.25, 0.0015),
            (0.04, 0.0, 0.001),
            (1.0, 0.0, 0.001),
        ] {
            assert!((permitted_overlap.wisp_fraction(along) - fraction).abs() < 1e-12, "{along}");
            assert!((permitted_overlap.sunk(along) - sunk).abs() < 1e-12, "{along}");
        }
        // A straight line below it all along, and at it between material points.
        for (from, to, ends) in
            [(0.0, 0.01, [0.0, 0.0]), (0.012, 0.018, [4e-4, 1.6e-3]), (0.02, 0.04, [0.002, 0.001]), (0.015, 0.05, [0.001; 2])]
        {
            let line = permitted_overlap.line_below(from, to);
            assert!((0..2).all(|end| (line[end] - ends[end]).abs() < 1e-12), "{from} {to}: {line:?}");
            for part in 0..=100 {
                let t = f64::from(part) / 100.0;
                assert!(line[0] + t * (line[1] - line[0]) <= permitted_overlap.sunk(from + t * (to - from)) + 1e-12);
            }
        }
        let one = PermittedOverlap { along: vec![0.01], wisp_fractions: vec![0.3], sunk: vec![0.1] };
        one.check("a").unwrap();
        assert_eq!([0.0, 0.01, 0.5].map(|along| one.wisp_fraction(along)), [0.3; 3]);
    }

    #[test]
    fn bad_lists_are_named() {
        let good = PermittedOverlap { along: vec![0.0, 0.1], wisp_fractions: vec![1.0, 0.5], sunk: vec![0.0, 0.1] };
        for (bad, named) in [
            (PermittedOverlap::default(), "a.along (count)"),
            (PermittedOverlap { sunk: vec![0.0], ..good.clone() }, "a.sunk (count)"),
            (PermittedOverlap { wisp_fractions: vec![0.0; 3], ..good.clone() }, "a.wisp_fractions (count)"),
            (PermittedOverlap { along: vec![0.0, 0.0], ..good.clone() }, "a.along[1]"),
            (PermittedOverlap { along: vec![-1.0, 0.0], ..good.clone() }, "a.along[0]"),
            (PermittedOverlap { along: vec![0.0, f64::NAN], ..good.clone() }, "a.along[1]"),
            (PermittedOverlap { wisp_fractions: vec![0.0, 1.1], ..good.clone() }, "a.wisp_fractions[1]"),
            (PermittedOverlap { wisp_fractions: vec![f64::NAN, 1.0], ..good.clone() }, "a.wisp_fractions[0]"),
            (PermittedOverlap { sunk: vec![0.0, -0.1], ..good.clone() }, "a.sunk[1]"),
        ] {
            let error = bad.check("a").unwrap_err().to_string();
            assert!(error.contains(named), "{error}");
        }
    }
}
