//! Strands as a file has them: of any number of points, none included, and of numbers that need not be finite.
//!
//! Reconstructions of hair contain such strands. [`Curves`] does not, so that everything built on it need not look; this is where
//! they can be told apart and counted.

use std::path::Path;

use super::point_strands::{self, StrandsBy};
use super::{hair, numpy, ply, strand_data};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, UpAxis};
use crate::files::io::bytes;

/// Strands of a file, root first, in the file's unit. There is at least one.
///
/// ```
/// use superhelix::io::RawStrands;
///
/// // Two strands of the data sets: one of two points, and one of a single point, for a hair that was not grown.
/// let numbers = [[0.0_f32, 0.0, 0.0], [0.0, -1.0, 0.0], [5.0, 0.0, f32::NAN]];
/// let point = |at: usize| numbers[at].iter().flat_map(|number| number.to_le_bytes());
/// let count = |count: u32| count.to_le_bytes().into_iter();
/// let bytes: Vec<u8> = count(2).chain(count(2)).chain(point(0)).chain(point(1)).chain(count(1)).chain(point(2)).collect();
/// let strands = RawStrands::read_from_bytes("two.data", &bytes, None)?;
/// assert_eq!(strands.strands().map(<[_]>::len).collect::<Vec<_>>(), [2, 1]);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RawStrands {
    format: CurvesFormat,
    by: StrandsBy,
    counts: Vec<u32>,
    points: Vec<[f32; 3]>,
    metres_per_unit: Option<f64>,
    up: Option<UpAxis>,
}

impl RawStrands {
    /// Reads the strands of a file of any format that [`Curves::read`] reads. `.hair`, `.data`, `.ply`, `.npy` and `.npz` files may hold
    /// strands of fewer than two points and numbers that are not finite; in the others these are errors.
    ///
    /// `points_per_strand` is for `.ply` files that do not say how many points each strand has: `None` finds it by the colours of
    /// the points or by the jumps between strands. In `.obj` files, lines of two points are joined where each begins at the end of the one
    /// before.
    ///
    /// # Errors
    /// As [`Curves::read`]. [`Error::File`] also for a `.ply` file whose strands cannot be told apart, or whose number of points is
    /// not a multiple of `points_per_strand`; [`Error::InvalidArgument`] for `points_per_strand` below 2.
    pub fn read(path: impl AsRef<Path>, points_per_strand: Option<u32>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?, points_per_strand)
    }

    /// [`RawStrands::read`] from memory. `name` replaces the path in errors, and its extension counts.
    ///
    /// # Errors
    /// As [`RawStrands::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8], points_per_strand: Option<u32>) -> Result<Self> {
        if let Some(count) = points_per_strand.filter(|count| *count < 2) {
            return Err(Error::invalid("points_per_strand", count, "2 or more"));
        }
        let extension = Path::new(name).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let stated =
            |format, (counts, points)| Self { format, by: StrandsBy::File, counts, points, metres_per_unit: None, up: None };
        if bytes.starts_with(b"HAIR") {
            return Ok(stated(CurvesFormat::Hair, hair::as_it_is(name, bytes)?));
        }
        if ply::is_ply(bytes) {
            return Self::of_ply(name, ply::read(name, bytes)?, points_per_strand);
        }
        if numpy::is_npy(bytes) || numpy::is_npz(bytes) {
            let array = if numpy::is_npy(bytes) { numpy::read_npy(name, bytes)? } else { numpy::read_npz(name, bytes)? };
            let counts = vec![array.points_per_strand; array.points.len() / array.points_per_strand as usize];
            return Ok(stated(CurvesFormat::Numpy, (counts, array.points)));
        }
        if extension.eq_ignore_ascii_case("data") {
            return Ok(stated(CurvesFormat::StrandData, strand_data::as_it_is(name, bytes)?));
        }
        let curves = Curves::read_from_bytes(name, bytes)?;
        let joined = (curves.format() == CurvesFormat::Obj).then(|| joined_lines(&curves)).flatten();
        let by = if joined.is_some() { StrandsBy::JoinedLines } else { StrandsBy::File };
        let (counts, points) = joined.unwrap_or_else(|| (curves.counts().to_vec(), curves.points().to_vec()));
        let extras = curves.extras();
        Ok(Self { format: curves.format(), by, counts, points, metres_per_unit: extras.metres_per_unit, up: extras.up })
    }

    fn of_ply(name: &str, file: ply::PlyStrands, points_per_strand: Option<u32>) -> Result<Self> {
        let made =
            |counts, by| Self { format: CurvesFormat::Ply, by, counts, points: Vec::new(), metres_per_unit: None, up: None };
        let total = file.points.len();
        let strands = match (file.counts, points_per_strand) {
            (Some(counts), _) => made(counts, StrandsBy::File),
            (None, Some(count)) if total.is_multiple_of(count as usize) => {
                made(vec![count; total / count as usize], StrandsBy::Caller)
            }
            (None, Some(count)) => {
                return Err(Error::file(name, format_args!("has {total} points, no multiple of {count} points per strand")));
            }
            (None, None) => {
                let colours =
                    file.colours.as_deref().and_then(point_strands::by_colours).map(|count| (count, StrandsBy::Colours));
                let found = colours.or_else(|| point_strands::by_jumps(&file.points).map(|count| (count, StrandsBy::Jumps)));
                let Some((count, by)) = found else {
                    let reason = "does not say how many points each strand has, and neither colours nor jumps tell: state it (100 is usual)";
                    return Err(Error::file(name, reason));
                };
                made(vec![count as u32; total / count], by)
            }
        };
        Ok(Self { points: file.points, ..strands })
    }

    /// The format of the file.
    pub fn format(&self) -> CurvesFormat {
        self.format
    }

    /// How points were told apart into strands.
    pub fn strands_by(&self) -> StrandsBy {
        self.by
    }

    /// Number of strands.
    pub fn strand_count(&self) -> usize {
        self.counts.len()
    }

    /// Number of points of all strands.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// The strands in order, each a slice of points, root first.
    pub fn strands(&self) -> impl Iterator<Item = &[[f32; 3]]> + '_ {
        let mut rest = &self.points[..];
        self.counts.iter().map(move |count| {
            let (strand, others) = rest.split_at(*count as usize);
            rest = others;
            strand
        })
    }

    /// Metres per file unit, if the file has it (`.usda`).
    pub fn metres_per_unit(&self) -> Option<f64> {
        self.metres_per_unit
    }

    /// The up axis, if the file has it (`.usda`).
    pub fn up(&self) -> Option<UpAxis> {
        self.up
    }

    /// The same as [`Curves`].
    pub(in crate::files) fn into_curves(self, name: &str) -> Result<Curves> {
        if let Some(strand) = self.counts.iter().position(|count| *count < 2) {
            let count = self.counts[strand];
            return Err(Error::file(name, format_args!("strand {strand} has {count} points; expected at least two")));
        }
        if let Some(point) = self.points.iter().position(|point| !point.iter().all(|number| number.is_finite())) {
            let value = self.points[point];
            return Err(Error::file(name, format_args!("point {point} is {value:?}; expected finite numbers")));
        }
        Curves::from_parts(self.format, self.counts, self.points, crate::files::curves::Extras::default())
    }
}

/// The strands of lines of two points, most of which begin at the end of the one before; `None` for other lines.
fn joined_lines(curves: &Curves) -> Option<(Vec<u32>, Vec<[f32; 3]>)> {
    let points = curves.points();
    let follows = |line: usize| line > 0 && points[2 * line] == points[2 * line - 1];
    let lines = curves.strand_count();
    let all_pairs = curves.counts().iter().all(|count| *count == 2);
    if !all_pairs || 2 * (0..lines).filter(|line| follows(*line)).count() < lines {
        return None;
    }
    let (mut counts, mut joined): (Vec<u32>, _) = (Vec::new(), Vec::with_capacity(points.len()));
    for line in 0..lines {
        match counts.last_mut() {
            Some(count) if follows(line) => *count += 1,
            _ => {
                counts.push(2);
                joined.push(points[2 * line]);
            }
        }
        joined.push(points[2 * line + 1]);
    }
    Some((counts, joined))
}
