//! Conversion of data per control point of a prim's curves into data per point of its polylines.

use nalgebra::Vector3;

use super::usda_values::Interpolation;
use crate::error::{Error, Result};
use crate::math::splines::nurbs::Nurbs;
use crate::math::splines::spline::{Spline, SplineEnds, SplineKind};

/// Points per span of a cubic curve or NURBS.
const PER_SPAN: usize = 4;
/// Chords between two of these points; arclengths of NURBS are their sums.
const CHORDS: usize = 8;

/// How the control points of a curve become points.
pub(super) enum Basis<'a> {
    Linear,
    Cubic(SplineKind, SplineEnds),
    Nurbs { orders: &'a [u32], knots: &'a [f64], weights: Option<&'a [f64]> },
}

/// Makes an error from a fault of the prim's curves.
pub(super) type Bad<'a> = &'a dyn Fn(std::fmt::Arguments<'_>) -> Error;

pub(super) fn wide(point: [f32; 3]) -> Vector3<f64> {
    Vector3::from(point.map(f64::from))
}

/// As floats, if they are in range.
pub(super) fn narrow(point: Vector3<f64>) -> Option<[f32; 3]> {
    let narrowed = [point.x as f32, point.y as f32, point.z as f32];
    narrowed.iter().all(|value| value.is_finite()).then_some(narrowed)
}

/// The control points of a prim's curves: converts data per control point into data per point.
pub(super) struct Controls<'a> {
    pub counts: &'a [u32],
    pub total: usize,
}

impl Controls<'_> {
    pub fn check(&self, what: &str, there: usize, bad: Bad<'_>) -> Result<()> {
        if there == self.total {
            return Ok(());
        }
        Err(bad(format_args!("{what} has {there} entries; expected one per point, {}", self.total)))
    }

    /// The range of each curve's control points.
    fn ranges(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        self.counts.iter().scan(0_usize, |start, count| {
            let range = *start..*start + *count as usize;
            *start = range.end;
            Some(range)
        })
    }

    fn spline(&self, kind: SplineKind, ends: SplineEnds, curve: usize, bad: Bad<'_>) -> Result<Spline> {
        Spline::new(kind, ends, self.counts[curve] as usize).map_err(|error| bad(format_args!("curve {curve}: {error}")))
    }

    /// Numbers of points of the curves made.
    pub fn counts(&self, basis: &Basis<'_>, bad: Bad<'_>) -> Result<Vec<u32>> {
        let ranges = self.ranges().enumerate();
        match basis {
            Basis::Linear => Ok(self.counts.to_vec()),
            Basis::Cubic(kind, ends) => {
                ranges.map(|(curve, _)| Ok(self.spline(*kind, *ends, curve, bad)?.point_count(PER_SPAN) as u32)).collect()
            }
            Basis::Nurbs { .. } => {
                let mut counts = Vec::with_capacity(self.counts.len());
                self.each_nurbs(basis, bad, |nurbs, _| counts.push(nurbs.parameters(PER_SPAN).len() as u32))?;
                Ok(counts)
            }
        }
    }

    fn each_nurbs(
        &self,
        basis: &Basis<'_>,
        bad: Bad<'_>,
        mut each: impl FnMut(&Nurbs<'_>, std::ops::Range<usize>),
    ) -> Result<()> {
        let Basis::Nurbs { orders, knots, weights } = basis else { return Ok(()) };
        let mut knot = 0;
        for (curve, range) in self.ranges().enumerate() {
            let end = knot + range.len() + orders[curve] as usize;
            let nurbs = Nurbs::new(
                orders[curve] as usize,
                &knots[knot..end],
                weights.map(|weights| &weights[range.clone()]),
                range.len(),
            );
            each(&nurbs.map_err(|error| bad(format_args!("curve {curve}: {error}")))?, range);
            knot = end;
        }
        Ok(())
    }

    /// Converts three numbers per control point to three per point.
    pub fn vectors(&self, basis: &Basis<'_>, vectors: &[[f32; 3]], bad: Bad<'_>) -> Result<Vec<[f32; 3]>> {
        let narrow =
            |vector: Vector3<f64>| narrow(vector).ok_or_else(|| bad(format_args!("a point is outside the range of floats")));
        let mut made = Vec::new();
        match basis {
            Basis::Linear => return Ok(vectors.to_vec()),
            Basis::Cubic(kind, ends) => {
                for (curve, range) in self.ranges().enumerate() {
                    let spline = self.spline(*kind, *ends, curve, bad)?;
                    let controls: Vec<Vector3<f64>> = vectors[range].iter().map(|vector| wide(*vector)).collect();
                    let (points, _) =
                        spline.points(&controls, PER_SPAN).map_err(|error| bad(format_args!("curve {curve}: {error}")))?;
                    for point in points {
                        made.push(narrow(point)?);
                    }
                }
            }
            Basis::Nurbs { .. } => {
                let mut failure = None;
                self.each_nurbs(basis, bad, |nurbs, range| {
                    for place in nurbs.parameters(PER_SPAN) {
                        match narrow(nurbs.at(place, |control| wide(vectors[range.start + control]))) {
                            Ok(point) => made.push(point),
                            Err(error) => failure = Some(error),
                        }
                    }
                })?;
                if let Some(error) = failure {
                    return Err(error);
                }
            }
        }
        Ok(made)
    }

    /// Arclength of each point along its curve, from 0 at each root, for control points already placed; `None` for polylines.
    pub fn arclengths(&self, basis: &Basis<'_>, controls: &[Vector3<f64>], bad: Bad<'_>) -> Result<Vec<f32>> {
        let mut made = Vec::new();
        match basis {
            Basis::Linear => {}
            Basis::Cubic(kind, ends) => {
                for (curve, range) in self.ranges().enumerate() {
                    let spline = self.spline(*kind, *ends, curve, bad)?;
                    let (_, arclengths) =
                        spline.points(&controls[range], PER_SPAN).map_err(|error| bad(format_args!("curve {curve}: {error}")))?;
                    made.extend(arclengths.iter().map(|arclength| *arclength as f32));
                }
            }
            Basis::Nurbs { .. } => self.each_nurbs(basis, bad, |nurbs, range| {
                let along = |parts: usize| {
                    let places = nurbs.parameters(parts * PER_SPAN);
                    let points: Vec<_> =
                        places.iter().map(|place| nurbs.at(*place, |control| controls[range.start + control])).collect();
                    let mut arclength = 0.0;
                    let edges = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
                    let sums = edges.map(|edge| {
                        arclength += edge;
                        arclength
                    });
                    std::iter::once(0.0).chain(sums).step_by(parts).collect::<Vec<f64>>()
                };
                // Chords fall short by the square of their length: Richardson's extrapolation.
                let (coarse, fine) = (along(CHORDS / 2), along(CHORDS));
                made.extend(coarse.iter().zip(&fine).map(|(coarse, fine)| (fine + (fine - coarse) / 3.0) as f32));
            })?,
        }
        match made.iter().all(|arclength| arclength.is_finite()) {
            true => Ok(made),
            false => Err(bad(format_args!("a curve is longer than floats reach"))),
        }
    }

    /// Three numbers each, with the given interpolation: three per point.
    pub fn triples(
        &self,
        basis: &Basis<'_>,
        items: &[[f32; 3]],
        how: Interpolation,
        what: &str,
        bad: Bad<'_>,
    ) -> Result<Vec<[f32; 3]>> {
        let at_controls =
            self.spread(basis, items, how, what, bad, |a, b, fraction| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * fraction))?;
        match at_controls {
            Spread::Controls(list) => self.vectors(basis, &list, bad),
            Spread::Points(list) => Ok(list),
        }
    }

    /// One number each, with the given interpolation: one per point.
    pub fn numbers(&self, basis: &Basis<'_>, items: &[f32], how: Interpolation, what: &str, bad: Bad<'_>) -> Result<Vec<f32>> {
        match self.spread(basis, items, how, what, bad, |a, b, fraction| a + (b - a) * fraction)? {
            Spread::Controls(list) if matches!(basis, Basis::Linear) => Ok(list),
            Spread::Controls(list) => {
                let vectors: Vec<[f32; 3]> = list.into_iter().map(|number| [number, 0.0, 0.0]).collect();
                Ok(self.vectors(basis, &vectors, bad)?.into_iter().map(|[number, _, _]| number).collect())
            }
            Spread::Points(list) => Ok(list),
        }
    }

    /// Expands data for all curves, per curve, per end of a span or per control point to data per control point or, where a basis
    /// would bend it, per point.
    fn spread<T: Copy>(
        &self,
        basis: &Basis<'_>,
        items: &[T],
        how: Interpolation,
        what: &str,
        bad: Bad<'_>,
        mix: impl Fn(T, T, f32) -> T,
    ) -> Result<Spread<T>> {
        let wrong = |expected: usize, of: &str| {
            Err(bad(format_args!("{what} has {} entries; expected {expected}, one {of}", items.len())))
        };
        let made_counts = self.counts(basis, bad)?;
        match how {
            Interpolation::Constant if items.len() != 1 => wrong(1, "for all curves"),
            Interpolation::Constant => Ok(Spread::Points(vec![items[0]; made_counts.iter().map(|count| *count as usize).sum()])),
            Interpolation::Uniform if items.len() != self.counts.len() => wrong(self.counts.len(), "per curve"),
            Interpolation::Uniform => Ok(Spread::Points(
                items.iter().zip(&made_counts).flat_map(|(item, count)| std::iter::repeat_n(*item, *count as usize)).collect(),
            )),
            Interpolation::Vertex | Interpolation::FaceVarying if items.len() != self.total => wrong(self.total, "per point"),
            Interpolation::Vertex | Interpolation::FaceVarying => Ok(Spread::Controls(items.to_vec())),
            Interpolation::Varying if matches!(basis, Basis::Linear) => match items.len() == self.total {
                true => Ok(Spread::Controls(items.to_vec())),
                false => wrong(self.total, "per point"),
            },
            Interpolation::Varying => {
                let each = |count: &u32| (*count as usize - 1) / PER_SPAN;
                let ends: usize = made_counts.iter().map(|count| each(count) + 1).sum();
                if items.len() != ends {
                    return wrong(ends, "per end of a span");
                }
                let (mut made, mut first) = (Vec::new(), 0);
                for count in &made_counts {
                    for point in 0..*count as usize {
                        let (span, step) = (point / PER_SPAN, point % PER_SPAN);
                        let begin = items[first + span];
                        let end = items[first + (span + 1).min(each(count))];
                        made.push(if step == 0 { begin } else { mix(begin, end, step as f32 / PER_SPAN as f32) });
                    }
                    first += each(count) + 1;
                }
                Ok(Spread::Points(made))
            }
        }
    }
}

/// Data per control point, or per point.
enum Spread<T> {
    Controls(Vec<T>),
    Points(Vec<T>),
}
