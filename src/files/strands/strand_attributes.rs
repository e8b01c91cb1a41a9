//! Numbers that a groom file has for each of its strands, by name: primvars of USD, parameters of Alembic, arrays of NumPy, properties of `.ply`.

use std::path::Path;

use super::{alembic, numpy, ply};
use crate::error::Result;
use crate::files::curves::{Curves, CurvesFormat};
use crate::files::io::bytes;
use crate::files::usd::usda;

/// Numbers of the strands of a groom file, by name: one for each strand, in the order of [`Curves`].
///
/// What a file has for each point counts at the root, what it has once for all strands counts for each. Of several components, such as
/// those of a colour, each is an attribute of its own: `name[0]`, `name[1]`.
///
/// | file | attributes |
/// |---|---|
/// | `.usda` | numeric primvars of its curves, without `primvars:` |
/// | `.abc` | `arbGeomParams` of its curves, and `width` |
/// | `.npz` | arrays of numbers beside the strands, of a number or up to 16 for each strand or point |
/// | `.ply` | properties of `vertex` beside `x`, `y`, `z`, and of `strand` |
/// | any | what [`Extras`](crate::files::curves::Extras) has: `thickness`, `transparency`, `color[0]` to `[2]`, `strand_thickness`, `uv[0]` and `[1]` |
///
/// Attributes of another number of values are left out.
///
/// ```
/// use superhelix::io::StrandAttributes;
///
/// let file = r#"#usda 1.0
/// def BasisCurves "hair"
/// {
///     uniform token type = "linear"
///     int[] curveVertexCounts = [2, 2]
///     point3f[] points = [(0, 0, 0), (0, 0, -1), (1, 0, 0), (1, 0, -1)]
///     int[] primvars:part = [0, 2] (
///         interpolation = "uniform"
///     )
/// }
/// "#;
/// let attributes = StrandAttributes::read_from_bytes("hair.usda", file.as_bytes())?;
/// assert_eq!(attributes.get("part"), Some(&[0.0, 2.0][..]));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StrandAttributes {
    list: Vec<(String, Vec<f64>)>,
}

/// What an attribute has values for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::files) enum Domain {
    Strands,
    Points,
}

/// An attribute as a file has it.
#[derive(Debug)]
pub(in crate::files) struct FileAttribute {
    pub name: String,
    pub domain: Domain,
    /// Numbers of each value.
    pub width: usize,
    pub numbers: Vec<f64>,
}

/// Attributes of the strands of several objects of a file: strands of an object that lacks one have NaN.
#[derive(Debug, Default)]
pub(in crate::files) struct Collected {
    list: Vec<FileAttribute>,
    /// Those of objects before this one.
    strands: usize,
}

impl Collected {
    /// Adds an attribute of the next object: `width` numbers for each of its strands.
    pub fn add(&mut self, name: &str, width: usize, numbers: Vec<f64>) {
        let known = self.list.iter().position(|other| other.name == name && other.width == width);
        let at = known.unwrap_or(self.list.len());
        if known.is_none() {
            self.list.push(FileAttribute { name: name.to_owned(), domain: Domain::Strands, width, numbers: Vec::new() });
        }
        let all = &mut self.list[at].numbers;
        all.resize(self.strands * width, f64::NAN);
        all.extend(numbers);
    }

    /// Ends an object of so many strands.
    pub fn end_object(&mut self, strands: usize) {
        self.strands += strands;
    }

    /// Numbers so far.
    pub fn number_count(&self) -> usize {
        self.list.iter().map(|attribute| attribute.numbers.len()).sum()
    }

    /// All of them.
    pub fn finish(mut self) -> Vec<FileAttribute> {
        for attribute in &mut self.list {
            attribute.numbers.resize(self.strands * attribute.width, f64::NAN);
        }
        self.list
    }
}

impl StrandAttributes {
    /// Reads the attributes of a groom file of any format that [`Curves::read`] reads.
    ///
    /// # Errors
    /// As [`Curves::read`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
    }

    /// [`StrandAttributes::read`] from memory. `name` replaces the path in errors, and its extension counts.
    ///
    /// # Errors
    /// As [`StrandAttributes::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        let curves = Curves::read_from_bytes(name, bytes)?;
        let mut attributes = of_extras(&curves);
        if ply::is_ply(bytes) {
            attributes.extend(ply::attributes(name, bytes)?);
        } else if numpy::is_npz(bytes) {
            attributes.extend(numpy::attributes(name, bytes, [curves.strand_count(), curves.counts()[0] as usize])?);
        } else if alembic::is_alembic(bytes) {
            attributes.extend(alembic::attributes(name, bytes)?);
        } else if curves.format() == CurvesFormat::Usda {
            attributes.extend(usda::attributes(name, bytes)?);
        }
        let mut list: Vec<(String, Vec<f64>)> = Vec::new();
        for attribute in attributes {
            for (name, values) in attribute.per_strand(&curves) {
                if list.iter().all(|(other, _)| *other != name) {
                    list.push((name, values));
                }
            }
        }
        Ok(Self { list })
    }

    /// The names, in the order of the file.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|(name, _)| name.as_str())
    }

    /// The number of each strand; NaN for strands that have none. `None` for a name that the file does not have.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.list.iter().find(|(other, _)| other == name).map(|(_, values)| values.as_slice())
    }
}

impl FileAttribute {
    /// Its components, with the number of each strand.
    fn per_strand(self, curves: &Curves) -> Vec<(String, Vec<f64>)> {
        let Self { name, domain, width, numbers } = self;
        let wanted = match domain {
            Domain::Strands => curves.strand_count(),
            Domain::Points => curves.point_count(),
        };
        if width == 0 || numbers.len() != width * wanted {
            return Vec::new();
        }
        let place = |strand: usize| match domain {
            Domain::Strands => strand,
            Domain::Points => curves.strand_range(strand).start,
        };
        let number = |number: f64| if number.is_finite() { number } else { f64::NAN };
        let component = |component: usize| {
            let values = (0..curves.strand_count()).map(|strand| number(numbers[width * place(strand) + component]));
            (if width == 1 { name.clone() } else { format!("{name}[{component}]") }, values.collect())
        };
        (0..width).map(component).collect()
    }
}

fn of_extras(curves: &Curves) -> Vec<FileAttribute> {
    let extras = curves.extras();
    let mut all = Vec::new();
    let mut add = |name: &str, domain, width, numbers: Option<&[f32]>| {
        if let Some(numbers) = numbers {
            let numbers = numbers.iter().map(|number| f64::from(*number)).collect();
            all.push(FileAttribute { name: name.to_owned(), domain, width, numbers });
        }
    };
    add("thickness", Domain::Points, 1, extras.thickness.as_deref());
    add("transparency", Domain::Points, 1, extras.transparency.as_deref());
    add("color", Domain::Points, 3, extras.colors.as_ref().map(|colors| colors.as_flattened()));
    add("strand_thickness", Domain::Strands, 1, extras.strand_thickness.as_deref());
    add("uv", Domain::Strands, 2, extras.strand_uvs.as_ref().map(|uvs| uvs.as_flattened()));
    all
}
