//! A set of polylines as a groom file has them: points in the file's own units, root first.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::hair::HairHeader;
use crate::files::{bytes, hair, obj, tfx};

/// Where a set of curves came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurvesFormat {
    /// Made in memory, from no file.
    Memory,
    /// Cem Yuksel's `.hair`.
    Hair,
    /// TressFX 2 `.tfx`: text.
    TfxV2Text,
    /// TressFX 3 `.tfx`: binary, three floats a point.
    TfxV3,
    /// TressFX 4 `.tfx`: binary, four floats a point.
    TfxV4,
    /// Wavefront `.obj` with `v` and `l` lines.
    Obj,
}

impl CurvesFormat {
    /// A short name for people: "hair", "tfx 2 (text)", "tfx 3", "tfx 4", "obj", "memory".
    pub fn name(self) -> &'static str {
        match self {
            CurvesFormat::Memory => "memory",
            CurvesFormat::Hair => "hair",
            CurvesFormat::TfxV2Text => "tfx 2 (text)",
            CurvesFormat::TfxV3 => "tfx 3",
            CurvesFormat::TfxV4 => "tfx 4",
            CurvesFormat::Obj => "obj",
        }
    }
}

/// Polylines in a file's own units, root first. Every strand has at least two points and every number is finite.
///
/// Grooms state no unit and no up axis: [`Curves::scaled`] and [`Curves::to_z_up`] bring them into the engine's metres and,
/// where wanted, its default axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    pub(super) format: CurvesFormat,
    pub(super) counts: Vec<u32>,
    /// Index of each strand's first point, and the number of points at the end.
    pub(super) starts: Vec<usize>,
    pub(super) points: Vec<[f32; 3]>,
    pub(super) extras: Extras,
}

/// What a file may say beyond the points. Lists "a point" are in the order of the points, lists "a strand" of the strands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extras {
    /// Thickness a point, in file units (`.hair`).
    pub thickness: Option<Vec<f32>>,
    /// Transparency a point, 0 to 1 (`.hair`).
    pub transparency: Option<Vec<f32>>,
    /// Red, green, blue a point, 0 to 1 (`.hair`, `.tfx`).
    pub colors: Option<Vec<[f32; 3]>>,
    /// Whether a point is held (does not move with the simulation), a point (`.tfx` 4: w = 0; `.tfx` 2 and 3: "both ends held").
    pub held: Option<Vec<bool>>,
    /// Thickness factor a strand (`.tfx` 4).
    pub strand_thickness: Option<Vec<f32>>,
    /// Texture coordinates of the root, a strand (`.tfx`).
    pub strand_uvs: Option<Vec<[f32; 2]>>,
    /// The rest of a `.hair` file's head, so that it can be written back as it was.
    pub hair_header: Option<HairHeader>,
}

impl Curves {
    /// Reads a groom: `.hair`, `.tfx` (versions 2, 3 and 4) or `.obj` with polylines, told apart by content first and by the
    /// name's extension where content does not say.
    ///
    /// # Errors
    /// [`Error::File`] when the file cannot be read, is of no known format, or is truncated, oversized or nonsense: the text
    /// says where and what was expected. [`Error::OutOfMemory`].
    pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
        let path = path.as_ref();
        let bytes = bytes::read_file(path)?;
        Self::read_from_bytes(&path.display().to_string(), &bytes)
    }

    /// [`Curves::read`] from memory. `name` stands for the path in errors, and its extension counts as one.
    ///
    /// # Errors
    /// As [`Curves::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
        todo!()
    }

    /// Curves from strands of points, root first.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a strand with fewer than two points or a point that is not finite.
    pub fn from_strands<S: AsRef<[[f32; 3]]>>(strands: &[S]) -> Result<Curves> {
        todo!()
    }

    /// Curves from one list of points, root first, and the number of points of each strand.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a count is below two, the counts do not add up to the number of points, or a point is
    /// not finite.
    pub fn from_counts(counts: Vec<u32>, points: Vec<[f32; 3]>) -> Result<Curves> {
        todo!()
    }

    /// The format that the curves were read from.
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

    /// Where strand `index` lies in [`Curves::points`] and in the lists of [`Extras`] that are a point.
    ///
    /// # Panics
    /// When there is no such strand.
    pub fn strand_range(&self, index: usize) -> std::ops::Range<usize> {
        self.starts[index]..self.starts[index + 1]
    }

    /// The points of strand `index`, root first, in file units.
    ///
    /// # Panics
    /// When there is no such strand, as slices do.
    pub fn strand(&self, index: usize) -> &[[f32; 3]] {
        &self.points[self.strand_range(index)]
    }

    /// The strands in order, each a slice of points, root first.
    pub fn strands(&self) -> impl ExactSizeIterator<Item = &[[f32; 3]]> + '_ {
        self.starts.windows(2).map(|ends| &self.points[ends[0]..ends[1]])
    }

    /// What the file says beyond the points.
    pub fn extras(&self) -> &Extras {
        &self.extras
    }

    /// The length of strand `index` along its edges, in file units.
    ///
    /// # Panics
    /// When there is no such strand.
    pub fn strand_length(&self, index: usize) -> f64 {
        todo!()
    }

    /// The smallest and largest coordinates of all points, in file units; `None` when there are no strands.
    pub fn bounding_box(&self) -> Option<([f32; 3], [f32; 3])> {
        todo!()
    }

    /// The same curves with every point (and thickness a point) multiplied by `factor`: metres a file unit makes metres.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when `factor` is not a finite number above zero, or a point overflows.
    pub fn scaled(&self, factor: f64) -> Result<Curves> {
        todo!()
    }

    /// The same curves turned from y up to z up: (x, y, z) becomes (x, -z, y). [`crate::files::motion::Motion::to_z_up`] turns
    /// a motion the same way.
    pub fn to_z_up(&self) -> Curves {
        todo!()
    }
}
