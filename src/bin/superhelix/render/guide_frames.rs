//! Guides over time: a groom, a directory of frames, or a `.usda` file with time samples.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::Error;
use superhelix::internals::groom::curves::drawn::in_metres;
use superhelix::io::{CurveCache, Curves, CurvesFormat};
use superhelix::render::resampled;

use crate::shell::failure::Failure;
use crate::shell::frame_files::list_frames;

/// The files that guides come from.
#[derive(Debug)]
pub struct GuideFrames {
    source: Source,
    /// Frames a second of files that do not say.
    fps: Option<f64>,
}

#[derive(Debug)]
enum Source {
    /// A file a frame.
    Files(Vec<PathBuf>),
    /// All in one.
    Cache(PathBuf, Box<CurveCache>),
}

/// Guides at one moment, m and m/s: the same number of points each.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideFrame {
    /// The points of all guides, one guide after the other.
    pub points: Vec<Vector3<f64>>,
    /// Their velocities, where the file has them.
    pub velocities: Option<Vec<Vector3<f64>>>,
}

impl GuideFrames {
    /// Opens a groom, a directory of frames or a `.usda` file; `fps` are the frames a second of a directory.
    pub fn open(path: &Path, fps: Option<f64>) -> Result<Self, Failure> {
        let source = if !path.is_dir() && CurvesFormat::of_name(path) == Some(CurvesFormat::Usda) {
            Source::Cache(path.to_owned(), Box::new(CurveCache::read(path)?))
        } else {
            Source::Files(list_frames(&[path.to_owned()])?)
        };
        let frames = Self { source, fps };
        match (&frames.source, fps) {
            (Source::Cache(..), Some(_)) => Err(Failure::file(path, "says its frames' times itself: leave --fps out")),
            (Source::Files(_), Some(_)) if !path.is_dir() => Err(Failure::file(path, "is one frame: leave --fps out")),
            _ => Ok(frames),
        }
    }

    /// How many frames there are; at least one.
    pub fn count(&self) -> usize {
        match &self.source {
            Source::Files(paths) => paths.len(),
            Source::Cache(_, cache) => cache.times().len(),
        }
    }

    /// What frame `index` is called in errors.
    pub fn name(&self, index: usize) -> String {
        match &self.source {
            Source::Files(paths) => paths[index].display().to_string(),
            Source::Cache(path, cache) => format!("{}, at {} s", path.display(), cache.times()[index]),
        }
    }

    /// When frame `index` is, s, where that is known.
    pub fn time(&self, index: usize) -> Option<f64> {
        match &self.source {
            Source::Files(_) => self.fps.map(|fps| index as f64 / fps),
            Source::Cache(_, cache) => Some(cache.times()[index]),
        }
    }

    /// What times are counted in, a second, where they are known.
    pub fn per_second(&self) -> Option<f64> {
        match &self.source {
            Source::Files(_) => self.fps,
            Source::Cache(_, cache) => Some(cache.time_codes_per_second()),
        }
    }

    /// The curves of a frame.
    pub fn curves(&self, index: usize) -> Result<Curves, Failure> {
        Ok(match &self.source {
            Source::Files(paths) => Curves::read(&paths[index])?,
            Source::Cache(_, cache) => cache.frame(index)?,
        })
    }

    /// The guides of a frame, as [`guides_of`] makes them.
    pub fn guides(
        &self,
        index: usize,
        curves: &Curves,
        every: usize,
        per_strand: usize,
        scale: f64,
    ) -> Result<GuideFrame, Failure> {
        let made = guides_of(curves, every, per_strand, scale);
        made.map_err(|error| Failure::Other(format!("{}: {error}", self.name(index))))
    }
}

/// Each so many-th of some curves as a guide of `per_strand` points, m.
pub fn guides_of(curves: &Curves, every: usize, per_strand: usize, scale: f64) -> Result<GuideFrame, Error> {
    let kept: Vec<usize> = (0..curves.strand_count()).step_by(every).collect();
    let counts: Vec<u32> = kept.iter().map(|strand| curves.counts()[*strand]).collect();
    let of = |list: &[[f32; 3]]| -> Vec<Vector3<f64>> {
        kept.iter().flat_map(|strand| in_metres(&list[curves.strand_range(*strand)], scale)).collect()
    };
    let velocities = curves.extras().velocities.as_deref().map(of);
    let made = resampled(&of(curves.points()), &counts, velocities.as_deref(), per_strand)?;
    Ok(GuideFrame { points: made.points, velocities: made.values })
}

/// Velocities of things at a moment from where they are then, and at the moments before and after, as far as there are any: of the parabola
/// through the three, or the line through the two.
pub fn velocities(
    before: Option<(f64, &[Vector3<f64>])>,
    now: (f64, &[Vector3<f64>]),
    after: Option<(f64, &[Vector3<f64>])>,
) -> Option<Vec<Vector3<f64>>> {
    let rate = |(t0, a): (f64, &[Vector3<f64>]), (t1, b): (f64, &[Vector3<f64>])| -> Vec<Vector3<f64>> {
        a.iter().zip(b).map(|(a, b)| (b - a) / (t1 - t0)).collect()
    };
    match (before, after) {
        (None, None) => None,
        (Some(before), None) => Some(rate(before, now)),
        (None, Some(after)) => Some(rate(now, after)),
        (Some(before), Some(after)) => {
            let (back, ahead) = (now.0 - before.0, after.0 - now.0);
            let rates = rate(before, now).into_iter().zip(rate(now, after));
            Some(rates.map(|(left, right)| (left * ahead + right * back) / (back + ahead)).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_has_its_own_velocity() {
        let at = |time: f64| vec![Vector3::new(1.0 - 2.0 * time + 3.0 * time * time, time, 5.0)];
        let (a, b, c) = (at(0.1), at(0.4), at(0.5));
        let found = velocities(Some((0.1, &a)), (0.4, &b), Some((0.5, &c))).unwrap();
        assert!((found[0] - Vector3::new(-2.0 + 6.0 * 0.4, 1.0, 0.0)).norm() < 1e-12, "{found:?}");
        let ends = [velocities(None, (0.1, &a), Some((0.4, &b))), velocities(Some((0.1, &a)), (0.4, &b), None)];
        for end in ends {
            assert!((end.unwrap()[0] - (b[0] - a[0]) / 0.3).norm() < 1e-12);
        }
        assert!(velocities(None, (0.1, &a), None).is_none());
    }
}
