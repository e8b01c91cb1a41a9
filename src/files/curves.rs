//! Curves of a groom file: polylines in the file's own units, root first.

use std::path::Path;

use super::io::bytes;
use super::strands::hair::HairHeader;
use super::strands::raw_strands::RawStrands;
use super::strands::{alembic, hair, numpy, ply, strand_data, tfx};
use super::usd::usda;
use super::wavefront::obj;
use crate::error::{Error, Result, check_positive};

/// The origin of a set of curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurvesFormat {
    /// Built in memory, without a file.
    Memory,
    /// Cem Yuksel's `.hair`.
    Hair,
    /// TressFX 2 `.tfx`: text.
    TfxV2Text,
    /// TressFX 3 `.tfx`: binary, three floats per point.
    TfxV3,
    /// TressFX 4 `.tfx`: binary, four floats per point.
    TfxV4,
    /// Wavefront `.obj` with `v` and `l` lines.
    Obj,
    /// USD as text, `.usda`: its `BasisCurves` and `NurbsCurves`.
    Usda,
    /// `.data`: counts and points, nothing more.
    StrandData,
    /// `.ply`: the points of strands.
    Ply,
    /// `.npy` and `.npz` of NumPy: an array of strands by points by three.
    Numpy,
    /// Alembic's `.abc` (Ogawa): curves of straight pieces.
    Alembic,
}

impl CurvesFormat {
    /// A short name for messages: "hair", "tfx 2 (text)", "tfx 3", "tfx 4", "obj", "usda", "data", "ply",
    /// "numpy", "alembic", "memory".
    pub fn name(self) -> &'static str {
        match self {
            CurvesFormat::Memory => "memory",
            CurvesFormat::Hair => "hair",
            CurvesFormat::TfxV2Text => "tfx 2 (text)",
            CurvesFormat::TfxV3 => "tfx 3",
            CurvesFormat::TfxV4 => "tfx 4",
            CurvesFormat::Obj => "obj",
            CurvesFormat::Usda => "usda",
            CurvesFormat::StrandData => "data",
            CurvesFormat::Ply => "ply",
            CurvesFormat::Numpy => "numpy",
            CurvesFormat::Alembic => "alembic",
        }
    }

    /// The format of a file name's extension, if it can be written: `.hair`, `.tfx` (version 4), `.obj` or `.usda`.
    pub fn of_name(path: impl AsRef<Path>) -> Option<Self> {
        match path.as_ref().extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "hair" => Some(CurvesFormat::Hair),
            "tfx" => Some(CurvesFormat::TfxV4),
            "obj" => Some(CurvesFormat::Obj),
            "usda" => Some(CurvesFormat::Usda),
            _ => None,
        }
    }
}

/// Polylines in a file's own units, root first. There is at least one strand, every strand has at least two points, and every
/// number is finite. Points of a strand may coincide, and strands may be shorter than a hair is wide: real grooms have both.
///
/// Only USD has a unit and an up axis ([`Extras::metres_per_unit`], [`Extras::up`]): [`Curves::scaled`] and [`Curves::to_z_up`]
/// convert grooms to the engine's metres and its default axes.
///
/// ```
/// use superhelix::io::Curves;
///
/// let curves = Curves::from_strands(&[vec![[0.0, 0.0, 0.0], [0.0, 0.0, -10.0]], vec![[1.0, 0.0, 0.0], [1.0, 0.0, -8.0]]])?;
/// assert_eq!((curves.strand_count(), curves.point_count()), (2, 4));
/// assert_eq!(curves.strand(1)[1], [1.0, 0.0, -8.0]);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    pub(super) format: CurvesFormat,
    pub(super) counts: Vec<u32>,
    /// Index of each strand's first point, and the number of points at the end.
    pub(super) starts: Vec<usize>,
    pub(super) points: Vec<[f32; 3]>,
    pub(super) extras: Extras,
}

/// The axis that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UpAxis {
    /// +y.
    Y,
    /// +z.
    Z,
}

/// Optional data of a file beside the points. Lists "per point" follow the order of the points, lists "per strand" that of the
/// strands.
///
/// ```
/// use superhelix::io::{Curves, Extras};
///
/// let curves = Curves::from_strands(&[[[0.0, 0.0, 0.0], [0.0, 0.0, -10.0]]])?;
/// let thick = curves.with_extras(Extras { thickness: Some(vec![0.01, 0.005]), metres_per_unit: Some(0.01), ..Extras::default() })?;
/// assert_eq!(thick.extras().metres_per_unit, Some(0.01));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extras {
    /// Thickness (diameter) per point, in file units (`.hair`, `.usda`).
    pub thickness: Option<Vec<f32>>,
    /// Transparency per point, 0 to 1 (`.hair`, `.usda`).
    pub transparency: Option<Vec<f32>>,
    /// Red, green, blue per point, 0 to 1 (`.hair`, `.tfx`, `.usda`).
    pub colors: Option<Vec<[f32; 3]>>,
    /// Whether each point is held, that is, moves with the head alone. In `.tfx` 4 these are the points whose fourth number is 0;
    /// in `.tfx` 2 and 3, if the file asks for both ends to be held, the first two and the last two points of each strand.
    pub held: Option<Vec<bool>>,
    /// Velocity per point, file units per second (`.usda`).
    pub velocities: Option<Vec<[f32; 3]>>,
    /// Arclength of each point along its strand, file units, from 0 at the root, where the file's curves are not polylines
    /// (`.usda`). It exceeds the total length of the edges.
    pub arclengths: Option<Vec<f32>>,
    /// Thickness factor per strand (`.tfx` 3 and 4, `.usda` of this library).
    pub strand_thickness: Option<Vec<f32>>,
    /// Texture coordinates of the root, per strand (`.tfx`, `.usda`).
    pub strand_uvs: Option<Vec<[f32; 2]>>,
    /// The rest of a `.hair` file's header, to write it back unchanged.
    pub hair_header: Option<HairHeader>,
    /// Metres per file unit, if the file has it (`.usda`).
    pub metres_per_unit: Option<f64>,
    /// The up axis, if the file has it (`.usda`).
    pub up: Option<UpAxis>,
}

impl Curves {
    /// Reads a groom: `.hair`, `.tfx` (versions 2, 3 and 4), `.obj` with polylines, `.usda`, `.abc`, `.data`, `.ply`, `.npy` or `.npz`. The
    /// content decides the format, and the extension where the content does not. Strands of a `.ply` file that does not say how
    /// many points they have are found as by [`RawStrands`]. A `.usda` file with time samples gives the first
    /// ([`CurveCache`](crate::files::curve_cache::CurveCache) reads all of them), and cubic curves become points, four per span.
    ///
    /// # Errors
    /// [`Error::File`] when the file cannot be read, has no known format, or is truncated, oversized or invalid: the text says
    /// where, and what was expected. [`Error::OutOfMemory`].
    pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
        let path = path.as_ref();
        let bytes = bytes::read_file(path)?;
        Self::read_from_bytes(&path.display().to_string(), &bytes)
    }

    /// [`Curves::read`] from memory. `name` replaces the path in errors, and its extension counts.
    ///
    /// # Errors
    /// As [`Curves::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
        if bytes.starts_with(b"HAIR") {
            return hair::read_from_bytes(name, bytes);
        }
        if bytes.starts_with(&[0x1f, 0x8b]) {
            return Err(Error::file(name, "is compressed (gzip): uncompress it first"));
        }
        if ply::is_ply(bytes) || numpy::is_npy(bytes) || numpy::is_npz(bytes) {
            return RawStrands::read_from_bytes(name, bytes, None)?.into_curves(name);
        }
        if alembic::is_alembic(bytes) {
            return alembic::read(name, bytes);
        }
        if let Some(what) = usda::other_scene_format(bytes) {
            return Err(Error::file(name, what));
        }
        if bytes.starts_with(b"#usda") {
            return usda::read_from_bytes(name, bytes);
        }
        let extension = Path::new(name).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "hair" => hair::read_from_bytes(name, bytes),
            "tfx" => tfx::read_from_bytes(name, bytes),
            "obj" => obj::read_from_bytes(name, bytes),
            "usda" | "usd" => usda::read_from_bytes(name, bytes),
            "data" => strand_data::read_from_bytes(name, bytes),
            _ if tfx::is_text(bytes) || tfx::is_binary(bytes) => tfx::read_from_bytes(name, bytes),
            _ => Err(Error::file(
                name,
                "is not a known groom format; expected .hair, .tfx (version 2, 3 or 4), .obj, .usda, .abc, .data, .ply, .npy or .npz",
            )),
        }
    }

    /// Writes curves to a file whose name ends in .hair, .tfx, .obj or .usda. [`TfxVersion::of`](tfx::TfxVersion::of) chooses the
    /// version of a .tfx file.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`path`) for another name; else as the writers of the formats: [`hair::write`], [`tfx::write`],
    /// [`obj::write`], [`usda::write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        match CurvesFormat::of_name(path) {
            Some(CurvesFormat::Hair) => hair::write(path, self),
            Some(CurvesFormat::Obj) => obj::write(path, self),
            Some(CurvesFormat::Usda) => usda::write(path, self),
            Some(_) => tfx::write(path, self, tfx::TfxVersion::of(self)),
            None => Err(Error::invalid("path", path.display(), "a name that ends in .hair, .tfx, .obj or .usda")),
        }
    }

    /// What a file of this format cannot hold of these curves, in words: "colours", "velocities". Empty when nothing is lost
    /// (numbers never are: all formats hold the same floats, opacities of `.usda` to an ulp of 1).
    pub fn lost_in(&self, format: CurvesFormat) -> Vec<&'static str> {
        use CurvesFormat::{Hair, Memory, TfxV2Text, TfxV3, TfxV4, Usda};
        let extras = &self.extras;
        let among = |formats: &[CurvesFormat]| formats.contains(&format);
        let held_kept = match format {
            TfxV2Text | TfxV3 => tfx::holds_both_ends(self) || extras.held.as_ref().is_none_or(|held| !held.contains(&true)),
            _ => among(&[TfxV4, Usda]),
        };
        let rows = [
            ("thickness", extras.thickness.is_some(), among(&[Hair, Usda])),
            ("transparency", extras.transparency.is_some(), among(&[Hair, Usda])),
            ("colours", extras.colors.is_some(), among(&[Hair, TfxV3, TfxV4, Usda])),
            ("velocities", extras.velocities.is_some(), among(&[Usda])),
            ("lengths of curves between points", extras.arclengths.is_some(), among(&[])),
            ("which points are held", extras.held.is_some(), held_kept),
            ("thickness factors of strands", extras.strand_thickness.is_some(), among(&[TfxV3, TfxV4, Usda])),
            ("texture coordinates of roots", extras.strand_uvs.is_some(), among(&[TfxV2Text, TfxV3, TfxV4, Usda])),
            ("the defaults of a .hair file", extras.hair_header.is_some(), among(&[Hair, Usda])),
            ("the text of a .hair file", extras.hair_header.is_some(), among(&[Hair])),
            ("the unit", extras.metres_per_unit.is_some(), among(&[Usda])),
            ("the up axis", extras.up.is_some(), among(&[Usda])),
        ];
        let lost = rows.iter().filter(|(_, there, kept)| *there && !kept && format != Memory);
        lost.map(|(what, _, _)| *what).collect()
    }

    /// Curves from strands of points, root first.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no strands, a strand with fewer than two points, or a point that is not finite.
    pub fn from_strands<S: AsRef<[[f32; 3]]>>(strands: &[S]) -> Result<Curves> {
        let mut counts = Vec::with_capacity(strands.len());
        let mut points = Vec::with_capacity(strands.iter().map(|strand| strand.as_ref().len()).sum());
        for (index, strand) in strands.iter().enumerate() {
            let count = u32::try_from(strand.as_ref().len())
                .map_err(|_| Error::invalid(format!("strands[{index}]"), strand.as_ref().len(), "at most 4294967295 points"))?;
            counts.push(count);
            points.extend_from_slice(strand.as_ref());
        }
        Self::from_counts(counts, points)
    }

    /// Curves from one list of points, root first, and the number of points of each strand.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when there are no strands, a count is below two, the counts do not add up to the number of
    /// points, or a point is not finite.
    pub fn from_counts(counts: Vec<u32>, points: Vec<[f32; 3]>) -> Result<Curves> {
        if counts.is_empty() {
            return Err(Error::invalid("counts", "empty", "at least one strand"));
        }
        if let Some(index) = counts.iter().position(|count| *count < 2) {
            return Err(Error::invalid(format!("counts[{index}]"), counts[index], "at least two points"));
        }
        let total: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        if total != points.len() as u64 {
            return Err(Error::invalid("points", format!("{} points", points.len()), format!("{total}, the sum of the counts")));
        }
        if let Some(index) = points.iter().position(|point| !point.iter().all(|value| value.is_finite())) {
            return Err(Error::invalid(format!("points[{index}]"), format!("{:?}", points[index]), "finite numbers"));
        }
        Self::from_parts(CurvesFormat::Memory, counts, points, Extras::default())
    }

    /// The same curves with other extras: for example a thickness for each point of a cache.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a list does not have one entry per point (or strand), or a number is not finite.
    pub fn with_extras(self, extras: Extras) -> Result<Curves> {
        let (points, strands) = (self.point_count(), self.strand_count());
        fn check<const N: usize>(name: &str, list: Option<&[[f32; N]]>, wanted: usize) -> Result<()> {
            let Some(list) = list else { return Ok(()) };
            if list.len() != wanted {
                return Err(Error::invalid(format!("extras.{name}"), format!("{} entries", list.len()), format!("{wanted}")));
            }
            match list.iter().position(|entry| !entry.iter().all(|value| value.is_finite())) {
                Some(index) => {
                    Err(Error::invalid(format!("extras.{name}[{index}]"), format!("{:?}", list[index]), "finite numbers"))
                }
                None => Ok(()),
            }
        }
        fn singles(list: &Option<Vec<f32>>) -> Option<&[[f32; 1]]> {
            list.as_ref().map(|list| list.as_chunks().0)
        }
        check("thickness", singles(&extras.thickness), points)?;
        check("transparency", singles(&extras.transparency), points)?;
        check("colors", extras.colors.as_deref(), points)?;
        check("velocities", extras.velocities.as_deref(), points)?;
        check("arclengths", singles(&extras.arclengths), points)?;
        check("strand_thickness", singles(&extras.strand_thickness), strands)?;
        check("strand_uvs", extras.strand_uvs.as_deref(), strands)?;
        if let Some(held) = &extras.held
            && held.len() != points
        {
            return Err(Error::invalid("extras.held", format!("{} entries", held.len()), format!("{points}")));
        }
        if let Some(header) = &extras.hair_header {
            let [red, green, blue] = header.color;
            let numbers = [[header.thickness, header.transparency, red, green, blue]];
            check("hair_header", Some(&numbers), 1)?;
        }
        if let Some(unit) = extras.metres_per_unit {
            check_positive(|| "extras.metres_per_unit".to_owned(), unit)?;
        }
        Ok(Curves { extras, ..self })
    }

    /// Curves from checked fields: at least one strand, counts of at least two that add up to the number of points, finite
    /// numbers, lists of the right length.
    pub(super) fn from_parts(format: CurvesFormat, counts: Vec<u32>, points: Vec<[f32; 3]>, extras: Extras) -> Result<Curves> {
        let mut starts = bytes::list(counts.len() + 1)?;
        let mut start = 0;
        starts.push(start);
        starts.extend(counts.iter().map(|count| {
            start += *count as usize;
            start
        }));
        debug_assert!(start == points.len() && !counts.is_empty());
        Ok(Curves { format, counts, starts, points, extras })
    }

    /// The format that the curves come from.
    pub fn format(&self) -> CurvesFormat {
        self.format
    }

    /// Number of strands.
    pub fn strand_count(&self) -> usize {
        self.counts.len()
    }

    /// Number of points of all strands.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Points of each strand.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// All points, strand after strand, in file units.
    pub fn points(&self) -> &[[f32; 3]] {
        &self.points
    }

    /// The range of strand `index` in [`Curves::points`], and in the per-point lists of [`Extras`].
    ///
    /// # Panics
    /// When there is no such strand.
    pub fn strand_range(&self, index: usize) -> std::ops::Range<usize> {
        self.starts[index]..self.starts[index + 1]
    }

    /// The points of strand `index`, root first, in file units.
    ///
    /// # Panics
    /// When there is no such strand.
    pub fn strand(&self, index: usize) -> &[[f32; 3]] {
        &self.points[self.strand_range(index)]
    }

    /// The strands in order, each a slice of points, root first.
    pub fn strands(&self) -> impl ExactSizeIterator<Item = &[[f32; 3]]> + '_ {
        self.starts.windows(2).map(|ends| &self.points[ends[0]..ends[1]])
    }

    /// The file's optional data.
    pub fn extras(&self) -> &Extras {
        &self.extras
    }

    /// The length of strand `index` along its edges, in file units.
    ///
    /// # Panics
    /// When there is no such strand.
    pub fn strand_length(&self, index: usize) -> f64 {
        let edge =
            |pair: &[[f32; 3]]| (0..3).map(|axis| (f64::from(pair[1][axis]) - f64::from(pair[0][axis])).powi(2)).sum::<f64>();
        self.strand(index).windows(2).map(|pair| edge(pair).sqrt()).sum()
    }

    /// The smallest and the largest coordinates of all points, in file units.
    pub fn bounding_box(&self) -> ([f32; 3], [f32; 3]) {
        self.points.iter().fold((self.points[0], self.points[0]), |(low, high), point| {
            (std::array::from_fn(|axis| low[axis].min(point[axis])), std::array::from_fn(|axis| high[axis].max(point[axis])))
        })
    }

    /// The same curves with every point, arclength, velocity and thickness multiplied by `factor`: with the metres per file unit,
    /// the result is in metres. Thickness factors ([`Extras::strand_thickness`]) stay the same.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when `factor` is not a finite number above zero, or takes a number outside the range of f32.
    pub fn scaled(&self, factor: f64) -> Result<Curves> {
        check_positive(|| "factor".to_owned(), factor)?;
        let mut scaled = self.clone();
        let lengths = scaled.points.iter_mut().flatten();
        let lengths = lengths.chain(scaled.extras.thickness.iter_mut().flatten());
        let lengths = lengths.chain(scaled.extras.arclengths.iter_mut().flatten());
        let lengths = lengths.chain(scaled.extras.velocities.iter_mut().flatten().flatten());
        for length in lengths.chain(scaled.extras.hair_header.iter_mut().map(|header| &mut header.thickness)) {
            let value = (f64::from(*length) * factor) as f32;
            if !value.is_finite() {
                return Err(Error::invalid("factor", factor, format!("one that keeps {length} below 3.4e38")));
            }
            *length = value;
        }
        scaled.extras.metres_per_unit = scaled.extras.metres_per_unit.map(|unit| unit / factor);
        Ok(scaled)
    }

    /// The same curves turned from y up to z up: (x, y, z) becomes (x, -z, y). [`crate::files::motion::Motion::to_z_up`] turns a
    /// motion the same way.
    pub fn to_z_up(&self) -> Curves {
        let mut turned = self.clone();
        for vector in turned.points.iter_mut().chain(turned.extras.velocities.iter_mut().flatten()) {
            *vector = [vector[0], -vector[2], vector[1]];
        }
        turned.extras.up = turned.extras.up.map(|_| UpAxis::Z);
        turned
    }
}
