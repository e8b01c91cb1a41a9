//! Alembic files (`.abc`, Ogawa): the curves of their first sample, in the world of the file.
//!
//! Read: `Curves` of straight pieces, and Catmull–Rom curves as the polyline of their points, through all transforms above them. Refused:
//! files of the older HDF5 kind, other cubic curves, periodic ones. Alembic states neither unit nor axis; by custom y is up.
//!
//! Files:
//!
//! - `ogawa.rs`: The container of Alembic files (Ogawa): groups of groups and data, objects with properties in them, and their first samples.

pub(super) mod ogawa;

use nalgebra::{Matrix4, Point3, Unit, Vector3};

use super::strand_attributes::{Collected, FileAttribute};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::bytes;
use ogawa::{Archive, Compound, Kind, Object};

/// Deepest nesting of objects.
const DEEPEST: usize = 64;

/// An object takes at least so many bytes of a file.
const LEAST_OBJECT: usize = 16;
/// Objects may share points, but not more than so many times over.
const SHARED: usize = 4;

/// Most numbers of a value of a parameter.
const WIDEST: usize = 16;

/// Parameters for each curve may take as many times the bytes of the file: those that are there once for all curves take more.
const EXPANDED: usize = 64;

/// Whether a file begins as Alembic files do, of either kind.
pub(in crate::files) fn is_alembic(bytes: &[u8]) -> bool {
    bytes.starts_with(b"Ogawa") || bytes.starts_with(b"\x89HDF\r\n")
}

/// Reads the curves of an Alembic file.
pub(in crate::files) fn read(name: &str, bytes: &[u8]) -> Result<Curves> {
    if !bytes.starts_with(b"Ogawa") {
        return Err(Error::file(name, "is an Alembic file of the older kind (HDF5): export it as Ogawa"));
    }
    let found = Found::of(name, bytes, None)?;
    if found.counts.is_empty() {
        return Err(Error::file(name, "has no curves"));
    }
    Curves::from_parts(CurvesFormat::Alembic, found.counts, found.points, Extras::default())
}

/// The parameters of the curves of a file that [`read`] reads.
pub(super) fn attributes(name: &str, bytes: &[u8]) -> Result<Vec<FileAttribute>> {
    let found = Found::of(name, bytes, Some(Collected::default()))?;
    Ok(found.attributes.map(Collected::finish).unwrap_or_default())
}

struct Found<'a> {
    name: &'a str,
    /// Bytes of the file.
    size: usize,
    /// Objects so far.
    objects: usize,
    counts: Vec<u32>,
    points: Vec<[f32; 3]>,
    /// Parameters of the curves, if they are wanted.
    attributes: Option<Collected>,
}

impl<'a> Found<'a> {
    fn of(name: &'a str, bytes: &'a [u8], attributes: Option<Collected>) -> Result<Self> {
        let archive = Archive::read(name, bytes)?;
        let mut found = Found { name, size: bytes.len(), objects: 0, counts: Vec::new(), points: Vec::new(), attributes };
        found.walk(&archive.top()?, &Matrix4::identity(), 0)?;
        Ok(found)
    }

    fn walk(&mut self, object: &Object<'_>, above: &Matrix4<f64>, depth: usize) -> Result<()> {
        if depth > DEEPEST {
            return Err(Error::file(self.name, format_args!("has objects nested deeper than {DEEPEST}")));
        }
        self.objects += 1;
        if self.objects > self.size / LEAST_OBJECT {
            return Err(Error::file(self.name, "has more objects than fit: some are in each other"));
        }
        let mut here = *above;
        let properties = object.properties()?;
        if object.is("AbcGeom_Xform")
            && let Some(transform) = properties.compound(".xform")?
        {
            let local = self.local(object, &transform)?;
            let inherits = transform.values(".inherits")?.is_none_or(|values| values.bytes.first() != Some(&0));
            here = if inherits { above * local } else { local };
        }
        if object.is("AbcGeom_Curve")
            && let Some(geometry) = properties.compound(".geom")?
        {
            let before = self.counts.len();
            self.take(object, &geometry, &here)?;
            let counts = &self.counts[before..];
            if let Some(attributes) = &mut self.attributes {
                take_parameters(attributes, &geometry, counts)?;
                if 8 * attributes.number_count() > EXPANDED * self.size {
                    return Err(self.complain(object, format_args!("has more parameters of curves than fit")));
                }
            }
        }
        for child in object.children()? {
            self.walk(&child, &here, depth + 1)?;
        }
        Ok(())
    }

    fn complain(&self, object: &Object<'_>, what: std::fmt::Arguments<'_>) -> Error {
        Error::file(self.name, format_args!("object \"{}\" {what}", object.name()))
    }

    /// The matrix of an object's transform.
    fn local(&self, object: &Object<'_>, transform: &Compound<'_>) -> Result<Matrix4<f64>> {
        let (Some(operations), Some(values)) = (transform.values(".ops")?, transform.values(".vals")?) else {
            return Ok(Matrix4::identity());
        };
        let numbers = values.floats(self.name)?;
        let mut rest = &numbers[..];
        let mut matrix = Matrix4::identity();
        for operation in operations.bytes {
            let kind = operation >> 4;
            let channels = [3, 3, 4, 16, 1, 1, 1].get(usize::from(kind)).copied().filter(|channels| *channels <= rest.len());
            let Some(channels) = channels else {
                return Err(self.complain(object, format_args!("has a transform that is broken")));
            };
            let (own, others) = rest.split_at(channels);
            rest = others;
            matrix *= match kind {
                0 => Matrix4::new_nonuniform_scaling(&Vector3::new(own[0], own[1], own[2])),
                1 => Matrix4::new_translation(&Vector3::new(own[0], own[1], own[2])),
                2 => turn(Vector3::new(own[0], own[1], own[2]), own[3]),
                // Rows of vectors that stand on the left.
                3 => Matrix4::from_column_slice(own),
                4 => turn(Vector3::x(), own[0]),
                5 => turn(Vector3::y(), own[0]),
                _ => turn(Vector3::z(), own[0]),
            };
        }
        Ok(matrix)
    }

    /// Takes the curves of an object.
    fn take(&mut self, object: &Object<'_>, geometry: &Compound<'_>, world: &Matrix4<f64>) -> Result<()> {
        if let Some(kind) = geometry.values("curveBasisAndType")? {
            // Cubic, linear or of variable order; periodic; the basis, of which 3 is Catmull-Rom.
            match kind.bytes {
                [1, 0, ..] | [0, 0, 3, ..] => {}
                [_, 1, ..] => return Err(self.complain(object, format_args!("has periodic curves"))),
                [0 | 2, ..] => {
                    let what = format_args!("has cubic curves whose points are not on them: export it as poly curves");
                    return Err(self.complain(object, what));
                }
                _ => return Err(self.complain(object, format_args!("has curves of an unknown kind"))),
            }
        }
        let (Some(points), Some(counts)) = (geometry.values("P")?, geometry.values("nVertices")?) else {
            return Err(self.complain(object, format_args!("has curves without \"P\" or \"nVertices\"")));
        };
        if counts.pod != Kind::INT32 && counts.pod != Kind::UINT32 {
            return Err(self.complain(object, format_args!("has numbers of points that are no integers of 32 bits")));
        }
        let numbers = points.floats(self.name)?;
        let first = self.counts.len();
        let mut total = 0_u64;
        bytes::reserve(&mut self.counts, counts.bytes.len() / 4)?;
        for (curve, count) in counts.bytes.as_chunks::<4>().0.iter().enumerate() {
            let count = u32::from_le_bytes(*count);
            if count < 2 || count > i32::MAX as u32 {
                let what = format_args!("has a curve ({curve}) of {} points; expected at least two", count as i32);
                return Err(self.complain(object, what));
            }
            self.counts.push(count);
            total += u64::from(count);
        }
        if total * 3 != numbers.len() as u64 {
            let (curves, has) = (self.counts.len() - first, numbers.len() / 3);
            let what = format_args!("has {curves} curves of {total} points in all, and \"P\" has {has}");
            return Err(self.complain(object, what));
        }
        if 12 * (self.points.len() + numbers.len() / 3) > SHARED * self.size {
            return Err(self.complain(object, format_args!("shares its points with too many others")));
        }
        bytes::reserve(&mut self.points, numbers.len() / 3)?;
        for point in numbers.as_chunks::<3>().0 {
            let place = world.transform_point(&Point3::from(*point));
            let place = [place.x as f32, place.y as f32, place.z as f32];
            if !place.iter().all(|number| number.is_finite()) {
                return Err(self.complain(object, format_args!("has a point at {place:?}; expected finite numbers")));
            }
            self.points.push(place);
        }
        Ok(())
    }
}

/// Takes the parameters of an object's curves that have numbers for each curve or point, or once for all.
fn take_parameters(attributes: &mut Collected, geometry: &Compound<'_>, counts: &[u32]) -> Result<()> {
    take_parameter(attributes, geometry, "width", counts)?;
    if let Some(parameters) = geometry.compound(".arbGeomParams")? {
        for name in parameters.names() {
            take_parameter(attributes, &parameters, &name, counts)?;
        }
    }
    attributes.end_object(counts.len());
    Ok(())
}

fn take_parameter(attributes: &mut Collected, of: &Compound<'_>, name: &str, counts: &[u32]) -> Result<()> {
    // With indices, values and indices are properties of their own.
    let (values, indices) = match of.compound(name)? {
        Some(indexed) => (indexed.values(".vals")?, indexed.values(".indices")?.and_then(|indices| indices.numbers())),
        None => (of.values(name)?, None),
    };
    let Some((width, numbers)) = values.and_then(|values| Some((values.extent, values.numbers()?))) else { return Ok(()) };
    if !(1..=WIDEST).contains(&width) {
        return Ok(());
    }
    let there = indices.as_ref().map_or(numbers.len() / width, Vec::len);
    let points: usize = counts.iter().map(|count| *count as usize).sum();
    let step = |count: &u32| match there {
        1 => 0,
        there if there == counts.len() => 1,
        _ => *count as usize,
    };
    if ![1, counts.len(), points].contains(&there) {
        return Ok(());
    }
    let (mut first, mut all) = (0, Vec::with_capacity(width * counts.len()));
    for count in counts {
        let place = indices.as_ref().map_or(first, |indices| indices[first] as usize);
        let Some(value) = place.checked_mul(width).and_then(|at| numbers.get(at..)?.get(..width)) else { return Ok(()) };
        all.extend_from_slice(value);
        first += step(count);
    }
    attributes.add(name, width, all);
    Ok(())
}

/// A turn about an axis by an angle in degrees.
fn turn(axis: Vector3<f64>, degrees: f64) -> Matrix4<f64> {
    Unit::try_new(axis, 0.0).map_or_else(Matrix4::identity, |axis| Matrix4::from_axis_angle(&axis, degrees.to_radians()))
}
