//! The numeric primvars of the curves of a USD layer, a value for each strand.

use super::usda_layer::{CurvesPrim, Layer};
use super::usda_scan::Scan;
use super::usda_values::{Attribute, Interpolation, flat, list};
use crate::error::{Error, Result};
use crate::files::strands::strand_attributes::{Collected, FileAttribute};

/// Most numbers of a value.
const WIDEST: usize = 4;

/// First words of the types whose values are numbers or tuples of them.
const NUMERIC: [&str; 12] =
    ["float", "double", "half", "int", "uint", "uchar", "bool", "color", "point", "normal", "vector", "texCoord"];

/// A primvar of curves, as in the file.
#[derive(Debug, Default)]
pub(in crate::files) struct Primvar {
    name: Box<str>,
    values: Attribute<Values>,
    indices: Attribute<Vec<u32>>,
}

impl Primvar {
    /// Whether values of a type are numbers or tuples of them.
    pub fn is_numeric(kind: &str) -> bool {
        NUMERIC.iter().any(|first| kind.starts_with(first))
    }

    fn named<'a>(all: &'a mut Vec<Self>, name: &str) -> &'a mut Self {
        let at = all.iter().position(|primvar| &*primvar.name == name).unwrap_or(all.len());
        if at == all.len() {
            all.push(Self { name: name.into(), ..Self::default() });
        }
        &mut all[at]
    }

    /// Takes the values of a primvar, or its indices. Returns whether they are numbers that can be taken; nothing has been read if not.
    pub fn take(scan: &mut Scan<'_>, all: &mut Vec<Self>, name: &str, over_time: bool) -> Result<bool> {
        let begin = scan.clone();
        let (name, is_indices) = name.strip_suffix(":indices").map_or((name, false), |name| (name, true));
        let primvar = Self::named(all, name);
        let taken = if is_indices {
            primvar.indices.read(scan, over_time, |scan| list(scan, "an index", |scan| scan.count("an index")))
        } else {
            primvar.values.read(scan, over_time, values)
        };
        if taken.is_err() {
            // Numbers that are not finite, or that no strand can have.
            *scan = begin;
            all.retain(|primvar| *primvar.name != *name);
        }
        Ok(taken.is_ok())
    }

    /// Where the interpolation of one that has been taken goes.
    pub fn interpolation_of<'a>(all: &'a mut [Self], name: &str) -> Option<&'a mut Option<Interpolation>> {
        let name = name.strip_prefix("primvars:")?;
        all.iter_mut().find(|primvar| &*primvar.name == name).map(|primvar| &mut primvar.values.interpolation)
    }

    /// The numbers of each curve, as many as a value has, at a time; `None` if there are not as many as its interpolation asks for.
    fn per_curve(&self, curves: &CurvesPrim, counts: &[u32], time: f64) -> Option<Values> {
        let Values { width, numbers } = self.values.at(time)?;
        let value = |place: usize| match self.indices.at(time) {
            Some(indices) => numbers.get(width * *indices.get(place)? as usize..)?.get(..*width),
            None => numbers.get(width * place..)?.get(..*width),
        };
        let there = self.indices.at(time).map_or(numbers.len() / width, Vec::len);
        let points: usize = counts.iter().map(|count| *count as usize).sum();
        let ends: usize = counts.iter().map(|count| curves.span_ends(*count)).sum();
        let per_curve: &dyn Fn(u32) -> usize = match self.values.interpolation {
            None | Some(Interpolation::Constant) if there == 1 => &|_| 0,
            None | Some(Interpolation::Uniform) if there == counts.len() => &|_| 1,
            None | Some(Interpolation::Vertex | Interpolation::FaceVarying) if there == points => &|count| count as usize,
            Some(Interpolation::Varying) if there == ends => &|count| curves.span_ends(count),
            _ => return None,
        };
        let (mut first, mut all) = (0, Vec::with_capacity(width * counts.len()));
        for count in counts {
            all.extend_from_slice(value(first)?);
            first += per_curve(*count);
        }
        Some(Values { width: *width, numbers: all })
    }
}

impl CurvesPrim {
    /// Ends of spans of a curve of so many points, for which varying primvars have values.
    fn span_ends(&self, points: u32) -> usize {
        let points = points as usize;
        match (self.kind.as_deref(), self.basis.as_deref(), self.wrap.as_deref()) {
            (Some("linear"), ..) => points,
            (_, None | Some("bezier"), _) => points / 3 + 1,
            (_, _, Some("pinned")) => points,
            _ => points.saturating_sub(2),
        }
    }
}

/// Values of as many numbers each, at least one.
#[derive(Debug, Default, Clone)]
struct Values {
    width: usize,
    numbers: Vec<f64>,
}

/// A list of numbers or tuples, or one of them.
fn values(scan: &mut Scan<'_>) -> Result<Values> {
    let mut all = Values { width: 1, numbers: Vec::new() };
    let one = |scan: &mut Scan<'_>, all: &mut Values| {
        let value = flat(scan, "a value", WIDEST)?;
        if !all.numbers.is_empty() && value.len() != all.width {
            return Err(scan.error(format_args!("a value of {} numbers after others of {}", value.len(), all.width)));
        }
        all.width = value.len();
        all.numbers.try_reserve(value.len()).map_err(|_| Error::OutOfMemory { bytes: 16 * all.numbers.len() })?;
        all.numbers.extend(value);
        Ok(())
    };
    if !scan.accept(b'[') {
        one(scan, &mut all)?;
        return Ok(all);
    }
    while !scan.accept(b']') {
        one(scan, &mut all)?;
        if !scan.accept(b',') {
            scan.expect(b']', "after a value")?;
            break;
        }
    }
    Ok(all)
}

/// The primvars of all curves at a time, in the order in which [`usd_curves`](super::usd_curves) reads them.
pub(super) fn at(layer: &Layer, time: f64) -> Vec<FileAttribute> {
    let mut all = Collected::default();
    for (_, prim) in layer.curves() {
        if prim.points.at(time).is_none_or(Vec::is_empty) {
            continue;
        }
        let counts = prim.counts.at(time).map_or(&[][..], Vec::as_slice);
        for primvar in &prim.primvars {
            if let Some(Values { width, numbers }) = primvar.per_curve(prim, counts, time) {
                all.add(&primvar.name, width, numbers);
            }
        }
        all.end_object(counts.len());
    }
    all.finish()
}
