//! A cache in one file: curves over time, with velocities, as the time samples of a `.usda` file.

use std::io::{BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::io::bytes;
use super::io::part_file::PartFile;
use super::usd::usd_curves;
use super::usd::usda::{self, LayerHead, Vector};
use super::usd::usda_layer::Wanted;
use super::usd::usda_samples::SampledLayer;
use crate::error::{Error, Result, check_finite, check_positive};
use crate::files::curves::{Curves, Extras};

/// The curves of a `.usda` file at its time samples. Frames are built on demand; the file stays in memory as read.
#[derive(Debug)]
pub struct CurveCache {
    samples: SampledLayer,
}

impl CurveCache {
    /// Reads a `.usda` file. Static curves are one frame at time 0.
    ///
    /// # Errors
    /// [`Error::File`], [`Error::OutOfMemory`]: as [`Curves::read`]. Errors in the numbers of single frames appear when those are
    /// built.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
    }

    /// [`CurveCache::read`] from memory. `name` stands for the path in errors.
    ///
    /// # Errors
    /// As [`CurveCache::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        Ok(Self { samples: SampledLayer::read(name, bytes, Wanted::Curves, usd_curves::times)? })
    }

    /// The times of the frames, s, ascending; at least one.
    pub fn times(&self) -> &[f64] {
        &self.samples.times
    }

    /// Time codes (frames) per second.
    pub fn time_codes_per_second(&self) -> f64 {
        self.samples.layer.time_codes_per_second
    }

    /// The curves of a frame, with their velocities (file units per second) where the file has them.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when there is no such frame; else as [`Curves::read`].
    pub fn frame(&self, index: usize) -> Result<Curves> {
        match self.samples.codes.get(index) {
            Some(code) => usd_curves::at(&self.samples.layer, &self.samples.name, *code),
            None => Err(Error::invalid("index", index, format!("below {}, the number of frames", self.samples.codes.len()))),
        }
    }

    /// The curves at a time, s. Points, velocities and widths are interpolated linearly between frames, and constant before the
    /// first and after the last.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite; else as [`Curves::read`].
    pub fn at(&self, time: f64) -> Result<Curves> {
        let code = self.samples.code_at(time)?;
        usd_curves::at(&self.samples.layer, &self.samples.name, code)
    }
}

/// The time code of a time. A frame's number that was divided into a time comes back as that number.
fn code_of(time: f64, per_second: f64) -> f64 {
    let code = time * per_second;
    if (code - code.round()).abs() <= 2.0 * f64::EPSILON * code.abs() { code.round() } else { code }
}

/// The time (s) that a reader of a cache finds for a frame written at `time`. Files have time codes, so its last bit may differ.
pub fn time_as_read(time: f64, time_codes_per_second: f64) -> f64 {
    code_of(time, time_codes_per_second) / time_codes_per_second
}

/// Writes curves over time into one `.usda` file, one frame per call. Memory grows by 32 bytes per frame. The file appears when
/// it is finished; dropping the writer earlier leaves nothing. A killed process leaves hidden files (`.name.0.part` and so on)
/// beside it, which the next writer of the same path removes.
#[derive(Debug)]
pub struct CurveCacheWriter {
    path: PathBuf,
    per_second: f64,
    first: Curves,
    /// The points' samples, and the velocities' if there are any: text in files beside the target.
    points: Option<Spool>,
    velocities: Option<Spool>,
    extents: Vec<(f64, [f32; 3], [f32; 3])>,
}

/// Text beside the target; dropping it deletes the file.
#[derive(Debug)]
struct Spool {
    writer: BufWriter<PartFile>,
}

impl Spool {
    fn create(target: &Path) -> Result<Self> {
        Ok(Self { writer: BufWriter::new(PartFile::create(target)?) })
    }

    fn sample(&mut self, code: f64, vectors: &[[f32; 3]]) -> std::io::Result<()> {
        write!(self.writer, "            {code}: ")?;
        usda::write_list(&mut self.writer, vectors.iter().map(|vector| Vector(*vector)))?;
        self.writer.write_all(b",\n")
    }

    fn copy_to(&mut self, out: &mut impl Write) -> std::io::Result<()> {
        self.writer.flush()?;
        let file = &mut self.writer.get_mut().file;
        file.seek(SeekFrom::Start(0))?;
        let mut reader = BufReader::new(file);
        let mut chunk = vec![0; 1 << 16];
        loop {
            match reader.read(&mut chunk)? {
                0 => return Ok(()),
                read => out.write_all(&chunk[..read])?,
            }
        }
    }
}

impl CurveCacheWriter {
    /// Starts a cache. `first` gives the curves' numbers of points and everything constant over time (widths, colours, unit,
    /// axis); its points are not written. `time_codes_per_second` is the unit of frames' times, above zero: usually the frames
    /// per second.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`]; [`Error::File`] when no file can be created beside `path`.
    pub fn create(path: impl AsRef<Path>, first: &Curves, time_codes_per_second: f64) -> Result<Self> {
        check_positive(|| "time_codes_per_second".to_owned(), time_codes_per_second)?;
        let path = path.as_ref();
        let points = Some(Spool::create(path)?);
        let velocities = first.extras().velocities.is_some().then(|| Spool::create(path)).transpose()?;
        Ok(Self {
            path: path.to_owned(),
            per_second: time_codes_per_second,
            first: first.clone(),
            points,
            velocities,
            extents: Vec::new(),
        })
    }

    /// Writes a frame: its time (s, after that of the last frame), the points of all strands and, if `first` had any, their
    /// velocities in file units per second.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite or not after the last one, for points or velocities that are not
    /// finite or not as many as those of `first`, and for velocities where `first` had none; [`Error::File`] when it cannot be
    /// written. After that error the cache is unusable.
    pub fn write(&mut self, time: f64, points: &[[f32; 3]], velocities: Option<&[[f32; 3]]>) -> Result<()> {
        check_finite(|| "time".to_owned(), time)?;
        let code = code_of(time, self.per_second);
        check_finite(|| "time".to_owned(), code)?;
        if let Some((before, ..)) = self.extents.last()
            && code <= *before
        {
            return Err(Error::invalid("time", time, format!("after {}, the frame before", before / self.per_second)));
        }
        let (Some(spool), written) = (&mut self.points, self.extents.len()) else {
            return Err(Error::file(&self.path, "failed to be written before"));
        };
        if velocities.is_some() != self.velocities.is_some() {
            let (there, wanted) = if velocities.is_some() { ("given", "none") } else { ("not given", "some") };
            return Err(Error::invalid("velocities", there, format!("{wanted}, as in the curves that the cache began with")));
        }
        for (name, list) in [("points", Some(points)), ("velocities", velocities)] {
            let Some(list) = list else { continue };
            if list.len() != self.first.point_count() {
                return Err(Error::invalid(name, format!("{} entries", list.len()), format!("{}", self.first.point_count())));
            }
            if let Some(index) = list.iter().position(|vector| !vector.iter().all(|value| value.is_finite())) {
                return Err(Error::invalid(format!("{name}[{index}]"), format!("{:?}", list[index]), "finite numbers"));
            }
        }
        let result = spool.sample(code, points).and_then(|()| match (&mut self.velocities, velocities) {
            (Some(spool), Some(velocities)) => spool.sample(code, velocities),
            _ => Ok(()),
        });
        if let Err(error) = result {
            (self.points, self.velocities) = (None, None);
            return Err(Error::file(&self.path, format_args!("cannot be written: frame {written}: {error}")));
        }
        let frame = Curves { points: points.to_vec(), extras: Extras::default(), ..self.first.clone() };
        let (low, high) = frame.bounding_box();
        let half = {
            let (still, own) = (usda::extent(&self.first).0, self.first.bounding_box().0);
            own[0] - still[0]
        };
        self.extents.push((code, low.map(|value| value - half), high.map(|value| value + half)));
        Ok(())
    }

    /// Frames written so far.
    pub fn frame_count(&self) -> usize {
        self.extents.len()
    }

    /// Finishes the file and moves it into place.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when no frame was written; [`Error::File`].
    pub fn finish(mut self) -> Result<()> {
        let (Some((first, ..)), Some((last, ..))) = (self.extents.first(), self.extents.last()) else {
            return Err(Error::invalid("frames", 0, "at least one"));
        };
        let extras = self.first.extras();
        let head = LayerHead {
            metres_per_unit: extras.metres_per_unit.unwrap_or(1.0),
            up: extras.up.unwrap_or(super::curves::UpAxis::Y),
            times: Some((self.per_second, *first, *last)),
        };
        let mut whole = Spool::create(&self.path)?;
        let failed = |error: std::io::Error| Error::file(&self.path, format_args!("cannot be written: {error}"));
        let Some(points) = &mut self.points else { return Err(Error::file(&self.path, "failed to be written before")) };
        let out = &mut whole.writer;
        let mut write = || {
            head.write(out)?;
            usda::write_counts(out, self.first.counts())?;
            writeln!(out, "        float3[] extent.timeSamples = {{")?;
            for (code, low, high) in &self.extents {
                writeln!(out, "            {code}: [{}, {}],", Vector(*low), Vector(*high))?;
            }
            writeln!(out, "        }}\n        point3f[] points.timeSamples = {{")?;
            points.copy_to(out)?;
            writeln!(out, "        }}")?;
            if let Some(velocities) = &mut self.velocities {
                writeln!(out, "        vector3f[] velocities.timeSamples = {{")?;
                velocities.copy_to(out)?;
                writeln!(out, "        }}")?;
            }
            usda::write_constant(out, &self.first)?;
            writeln!(out, "    }}\n}}")?;
            out.flush()
        };
        write().map_err(failed)?;
        let part = whole.writer.into_inner().map_err(|error| failed(error.into_error()))?;
        part.take_name(&self.path).map_err(failed)
    }
}
