//! The curves of a USD layer at a time, as polylines in the world.
//!
//! Linear curves are their points. Cubic curves and NURBS become points, four per span, and data per control point is
//! interpolated along. Placements (`xformOp`s of the prim and its ancestors) are applied; without any the numbers stay unchanged.

use nalgebra::{Matrix3, Matrix4, Vector3};

use super::usd_controls::{Bad, Basis, Controls, narrow, wide};
use super::usda_layer::{CurvesPrim, Layer};
use super::usda_values::{Attribute, Interpolation, indexed};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::math::splines::spline::{SplineEnds, SplineKind};

/// The times at which any curve of the layer has samples, in time codes, ascending; empty for static curves.
pub(in crate::files) fn times(layer: &Layer) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    for (_, curves) in layer.curves() {
        times.extend(curves.points.times().chain(curves.counts.times()));
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// All curves at a time.
pub(in crate::files) fn at(layer: &Layer, file: &str, time: f64) -> Result<Curves> {
    let mut all = All::default();
    for (index, prim) in layer.curves() {
        let one = One { layer, file, index, prim, time };
        one.add(&mut all)?;
    }
    if all.counts.is_empty() {
        return Err(Error::file(file, "has no curves: no BasisCurves or NurbsCurves with points"));
    }
    let extras = Extras {
        thickness: all.thickness.0,
        transparency: all.transparency.0,
        colors: all.colors.0,
        velocities: all.velocities.0,
        arclengths: all.arclengths,
        held: all.held.0,
        strand_thickness: all.strand_thickness.0,
        strand_uvs: all.strand_uvs.0,
        hair_header: None,
        metres_per_unit: Some(layer.metres_per_unit),
        up: Some(layer.up),
    };
    Curves::from_parts(CurvesFormat::Usda, all.counts, all.points, extras)
}

/// Numbers that only some prims have: the others get zeros.
struct Optional<T>(Option<Vec<T>>);

impl<T> Default for Optional<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T: Copy> Optional<T> {
    /// Appends a prim's data after `before` entries of other prims; a prim has `count`.
    fn add(&mut self, items: Option<Vec<T>>, before: usize, count: usize, otherwise: T) {
        match (&mut self.0, items) {
            (None, None) => {}
            (None, Some(items)) => {
                let mut list = vec![otherwise; before];
                list.extend(items);
                self.0 = Some(list);
            }
            (Some(list), Some(items)) => list.extend(items),
            (Some(list), None) => list.resize(before + count, otherwise),
        }
    }
}

#[derive(Default)]
struct All {
    counts: Vec<u32>,
    points: Vec<[f32; 3]>,
    thickness: Optional<f32>,
    transparency: Optional<f32>,
    colors: Optional<[f32; 3]>,
    velocities: Optional<[f32; 3]>,
    /// From the first spline on, including earlier polylines.
    arclengths: Option<Vec<f32>>,
    held: Optional<bool>,
    strand_thickness: Optional<f32>,
    strand_uvs: Optional<[f32; 2]>,
}

/// Arclength of each point along its polyline.
fn along_edges(points: &[[f32; 3]], counts: &[u32]) -> Vec<f32> {
    let (mut rest, mut arclengths) = (points, Vec::with_capacity(points.len()));
    for count in counts {
        let (strand, others) = rest.split_at(*count as usize);
        rest = others;
        let mut arclength = 0.0;
        arclengths.push(0.0);
        for pair in strand.windows(2) {
            arclength += (wide(pair[1]) - wide(pair[0])).norm();
            arclengths.push(arclength as f32);
        }
    }
    arclengths
}

/// The curves of a prim at a time.
struct One<'a> {
    layer: &'a Layer,
    file: &'a str,
    index: usize,
    prim: &'a CurvesPrim,
    time: f64,
}

impl One<'_> {
    fn error(&self, reason: impl std::fmt::Display) -> Error {
        Error::file(self.file, format_args!("{}: {reason}", self.layer.path(self.index)))
    }

    fn add(&self, all: &mut All) -> Result<()> {
        let bad: Bad<'_> = &|reason| self.error(reason);
        let points = self.points()?;
        if points.is_empty() {
            // A prim for hair that does not exist yet.
            return Ok(());
        }
        let counts = self.prim.counts.at(self.time).map_or(&[][..], Vec::as_slice);
        let total: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        if total != points.len() as u64 {
            let (said, there) = (counts.len(), points.len());
            return Err(self.error(format_args!("curveVertexCounts has {said} curves of {total} points, and points has {there}")));
        }
        if let Some(curve) = counts.iter().position(|count| *count < 2) {
            return Err(self.error(format_args!("curve {curve} has {} points; expected at least two", counts[curve])));
        }
        let basis = self.basis_of(counts)?;
        let controls = Controls { counts, total: points.len() };
        let made = controls.vectors(&basis, &points, bad)?;
        let mut made_counts = controls.counts(&basis, bad)?;
        let before = (all.points.len(), all.counts.len());
        let (point_count, curve_count) = (made.len(), counts.len());

        let moved = Moved::of(self)?;
        all.points.extend(match &moved {
            None => made.clone(),
            Some(moved) => moved.points(&made).ok_or_else(|| self.error("a placed point is outside the range of floats"))?,
        });
        if !matches!(basis, Basis::Linear) {
            let place = |point: &[f32; 3]| moved.as_ref().map_or(wide(*point), |moved| moved.place(wide(*point)));
            let placed: Vec<Vector3<f64>> = points.iter().map(place).collect();
            let arclengths = controls.arclengths(&basis, &placed, bad)?;
            all.arclengths.get_or_insert_with(|| along_edges(&all.points[..before.0], &all.counts)).extend(arclengths);
        } else if let Some(arclengths) = &mut all.arclengths {
            arclengths.extend(along_edges(&all.points[before.0..], &made_counts));
        }
        let velocities = match self.prim.velocities.vectors_at(self.time) {
            Some(list) => {
                controls.check("velocities", list.len(), bad)?;
                Some(controls.vectors(&basis, &list, bad)?)
            }
            None => None,
        };
        let velocities = match (&moved, velocities) {
            (Some(moved), velocities) => {
                let placed = moved.velocities(&made, velocities.as_deref(), self.layer.time_codes_per_second);
                placed.map_err(|()| self.error("a placed velocity is outside the range of floats"))?
            }
            (None, velocities) => velocities,
        };
        all.velocities.add(velocities, before.0, point_count, [0.0; 3]);

        let thickness = match self.singles_at(&self.prim.widths) {
            Some(widths) => {
                let how = self.prim.widths.interpolation.unwrap_or(if widths.len() == 1 && points.len() != 1 {
                    Interpolation::Constant
                } else {
                    Interpolation::Vertex
                });
                let mut widths = controls.numbers(&basis, &widths, how, "widths", bad)?;
                if let Some(moved) = &moved {
                    widths.iter_mut().for_each(|width| *width = (f64::from(*width) * moved.scale) as f32);
                }
                Some(widths)
            }
            None => None,
        };
        all.thickness.add(thickness, before.0, point_count, 0.0);
        let opacities = indexed(self.prim.opacities.at(self.time), self.prim.opacity_indices.at(self.time))
            .map_err(|index| self.error(format_args!("primvars:displayOpacity:indices has {index}, which is not an entry")))?;
        let transparency = match opacities {
            Some(list) => {
                let how = self.prim.opacities.interpolation.unwrap_or(Interpolation::Constant);
                let mut list = controls.numbers(&basis, &list, how, "primvars:displayOpacity", bad)?;
                list.iter_mut().for_each(|opacity| *opacity = 1.0 - *opacity);
                Some(list)
            }
            None => None,
        };
        all.transparency.add(transparency, before.0, point_count, 0.0);
        let colors = indexed(self.prim.colors.at(self.time), self.prim.color_indices.at(self.time))
            .map_err(|index| self.error(format_args!("primvars:displayColor:indices has {index}, which is not an entry")))?;
        let colors = match colors {
            Some(list) => {
                let how = self.prim.colors.interpolation.unwrap_or(Interpolation::Constant);
                Some(controls.triples(&basis, &list, how, "primvars:displayColor", bad)?)
            }
            None => None,
        };
        all.colors.add(colors, before.0, point_count, [0.0; 3]);

        // What this library's own files hold beyond USD's own names.
        let held = self.prim.held.at(self.time).filter(|held| matches!(basis, Basis::Linear) && held.len() == points.len());
        all.held.add(held.map(|held| held.iter().map(|held| *held != 0).collect()), before.0, point_count, false);
        let thickness = self.prim.strand_thickness.at(self.time).filter(|list| list.len() == curve_count);
        all.strand_thickness.add(thickness.cloned(), before.1, curve_count, 1.0);
        let uvs = indexed(self.prim.uvs.at(self.time), self.prim.uv_indices.at(self.time))
            .map_err(|index| self.error(format_args!("primvars:st:indices has {index}, which is not an entry")))?;
        all.strand_uvs.add(uvs.filter(|list| list.len() == curve_count), before.1, curve_count, [0.0; 2]);
        all.counts.append(&mut made_counts);
        Ok(())
    }

    /// Points, interpolated between samples.
    fn points(&self) -> Result<Vec<[f32; 3]>> {
        self.prim.points.vectors_at(self.time).map_or_else(|| Ok(Vec::new()), Ok)
    }

    fn singles_at(&self, attribute: &Attribute<Vec<f32>>) -> Option<Vec<f32>> {
        match attribute.between(self.time) {
            Some((before, after, fraction)) if before.len() == after.len() => {
                let pairs = before.iter().zip(after);
                Some(pairs.map(|(a, b)| (f64::from(*a) + (f64::from(*b) - f64::from(*a)) * fraction) as f32).collect())
            }
            _ => attribute.at(self.time).cloned(),
        }
    }

    fn basis_of(&self, counts: &[u32]) -> Result<Basis<'_>> {
        let prim = self.prim;
        if prim.nurbs {
            let orders = prim.orders.at(self.time).map_or(&[][..], Vec::as_slice);
            if orders.len() != counts.len() {
                let (said, wanted) = (orders.len(), counts.len());
                return Err(self.error(format_args!("order has {said} numbers; expected one per curve, {wanted}")));
            }
            let knots = prim.knots.at(self.time).map_or(&[][..], Vec::as_slice);
            let wanted: u64 = counts.iter().zip(orders).map(|(count, order)| u64::from(*count) + u64::from(*order)).sum();
            if knots.len() as u64 != wanted {
                let expected = "expected, over the curves, the points and the order of each";
                return Err(self.error(format_args!("knots has {} numbers; {expected}: {wanted}", knots.len())));
            }
            let weights = prim.weights.at(self.time).map(Vec::as_slice);
            let points: u64 = counts.iter().map(|count| u64::from(*count)).sum();
            if let Some(weights) = weights.filter(|weights| weights.len() as u64 != points) {
                let there = weights.len();
                return Err(self.error(format_args!("pointWeights has {there} numbers; expected one per point, {points}")));
            }
            return Ok(Basis::Nurbs { orders, knots, weights });
        }
        match prim.kind.as_deref().unwrap_or("cubic") {
            "linear" => {}
            "cubic" => {}
            other => return Err(self.error(format_args!("type is {other:?}; expected \"linear\" or \"cubic\""))),
        }
        let ends = match prim.wrap.as_deref().unwrap_or("nonperiodic") {
            "nonperiodic" => SplineEnds::Open,
            "pinned" => SplineEnds::Pinned,
            "periodic" => return Err(self.error("wrap is \"periodic\": a closed curve has no root and cannot be a strand")),
            other => return Err(self.error(format_args!("wrap is {other:?}; expected \"nonperiodic\" or \"pinned\""))),
        };
        if prim.kind.as_deref() == Some("linear") {
            return Ok(Basis::Linear);
        }
        let kind = match prim.basis.as_deref().unwrap_or("bezier") {
            "bezier" => SplineKind::Bezier,
            "bspline" => SplineKind::BSpline,
            "catmullRom" => SplineKind::CatmullRom,
            other => {
                return Err(self.error(format_args!("basis is {other:?}; expected \"bezier\", \"bspline\" or \"catmullRom\"")));
            }
        };
        Ok(Basis::Cubic(kind, ends))
    }
}

/// A placement that is not the identity.
struct Moved {
    matrix: Matrix4<f64>,
    /// Per time code.
    rate: Option<Matrix4<f64>>,
    /// The cube root of its factor on volumes, which multiplies widths.
    scale: f64,
}

impl Moved {
    fn of(one: &One<'_>) -> Result<Option<Self>> {
        let matrix = |time: f64| one.layer.world(one.index, time, one.file);
        let now = matrix(one.time)?;
        let moves = one.layer.ancestry(one.index).any(|prim| prim.placement.as_ref().is_some_and(|placement| placement.moves()));
        if now == Matrix4::identity() && !moves {
            return Ok(None);
        }
        // Placements are linear between samples: a difference over a small part of a frame is exact but for rounding, and at a
        // sample it is the mean of both sides.
        const PART: f64 = 1e-3;
        let rate = if moves { Some((matrix(one.time + PART)? - matrix(one.time - PART)?) / (2.0 * PART)) } else { None };
        let scale = now.fixed_view::<3, 3>(0, 0).determinant().abs().cbrt();
        Ok(Some(Self { matrix: now, rate, scale }))
    }

    fn points(&self, points: &[[f32; 3]]) -> Option<Vec<[f32; 3]>> {
        points.iter().map(|point| narrow(self.place(wide(*point)))).collect()
    }

    fn place(&self, point: Vector3<f64>) -> Vector3<f64> {
        let placed = self.matrix * point.push(1.0);
        (placed / placed.w).xyz()
    }

    /// The points' own velocities, and those of the placement.
    fn velocities(
        &self,
        points: &[[f32; 3]],
        own: Option<&[[f32; 3]]>,
        codes: f64,
    ) -> std::result::Result<Option<Vec<[f32; 3]>>, ()> {
        if own.is_none() && self.rate.is_none() {
            return Ok(None);
        }
        let linear: Matrix3<f64> = self.matrix.fixed_view::<3, 3>(0, 0).into();
        let placed = points.iter().enumerate().map(|(index, point)| {
            let mut velocity = own.map_or(Vector3::zeros(), |own| linear * wide(own[index]));
            if let Some(rate) = &self.rate {
                velocity += (rate * wide(*point).push(1.0)).xyz() * codes;
            }
            narrow(velocity)
        });
        placed.collect::<Option<Vec<_>>>().map(Some).ok_or(())
    }
}
