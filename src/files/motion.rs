//! The motion of a head: poses over time, from a table (`.csv`) or from motion capture (`.bvh`).
//!
//! Files:
//!
//! - `bvh.rs`: Motion capture in Biovision's `.bvh`: a tree of joints, then one row of numbers per frame.
//! - `motion_csv.rs`: A motion as a table: one sample per line under the header `time_s,px_m,py_m,pz_m,qw,qx,qy,qz`.

pub(super) mod bvh;
pub(super) mod motion_csv;

use std::path::Path;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::io::bytes;
use crate::error::{Error, Result, check_positive};
use crate::math::frame::Frame;
use crate::math::splines::pose_spline::PoseSpline;

/// Options for reading a motion.
///
/// ```
/// use superhelix::io::MotionOptions;
///
/// // A .bvh in centimetres; the joint that carries the hair.
/// let options = MotionOptions { joint: Some("Head".into()), metres_per_unit: Some(0.01) };
/// assert_ne!(options.metres_per_unit, MotionOptions::default().metres_per_unit);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionOptions {
    /// `.bvh` only: the joint to read, by its exact name. `None`: the first joint whose name contains "head", in upper or lower
    /// case.
    pub joint: Option<String>,
    /// `.bvh` only: metres per file unit, a finite number above zero. `None`: 1, for a file in metres. Motion capture is often in
    /// centimetres (0.01) or inches (0.0254), and the files do not say so.
    pub metres_per_unit: Option<f64>,
}

impl MotionOptions {
    fn check(&self) -> Result<()> {
        self.metres_per_unit.map_or(Ok(()), |scale| check_positive(|| "metres_per_unit".to_owned(), scale))
    }

    /// Refuses options that a table cannot use, rather than ignoring them.
    fn check_unused(&self, name: &str) -> Result<()> {
        if let Some(joint) = &self.joint {
            return Err(Error::invalid("joint", format!("{joint:?}"), format!("none: {name} is a table of one motion")));
        }
        if let Some(scale) = self.metres_per_unit {
            return Err(Error::invalid("metres_per_unit", scale, format!("none: {name} is a table in metres")));
        }
        Ok(())
    }
}

/// A rigid motion: poses at increasing times, smooth in between, at rest before the first and after the last.
///
/// ```
/// use superhelix::Frame;
/// use superhelix::io::Motion;
///
/// let table = b"time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n0,0,0,1.7,1,0,0,0\n1,0.1,0,1.7,1,0,0,0\n";
/// let motion = Motion::read_from_bytes("walk.csv", table, &Default::default())?;
/// assert_eq!(motion.duration(), 1.0);
/// let pose: Frame = motion.at(0.5);
/// assert!((pose.origin.x - 0.05).abs() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    spline: PoseSpline,
}

impl Motion {
    /// Reads a motion; of the [`MotionOptions`] only the joint may be given.
    ///
    /// # Errors
    /// As [`Motion::read_with`].
    pub fn read(path: impl AsRef<Path>, joint: Option<&str>) -> Result<Motion> {
        Self::read_with(path, &MotionOptions { joint: joint.map(str::to_owned), metres_per_unit: None })
    }

    /// Reads a motion from a `.csv` table with the header `time_s,px_m,py_m,pz_m,qw,qx,qy,qz`, or from a `.bvh` file.
    ///
    /// # Errors
    /// [`crate::error::Error::File`] with the line number; [`crate::error::Error::InvalidArgument`] for options out of range or
    /// without meaning for the format; [`crate::error::Error::OutOfMemory`].
    pub fn read_with(path: impl AsRef<Path>, options: &MotionOptions) -> Result<Motion> {
        let path = path.as_ref();
        options.check()?;
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?, options)
    }

    /// [`Motion::read_with`] from memory. `name` replaces the path in errors, and its extension counts.
    ///
    /// # Errors
    /// As [`Motion::read_with`].
    pub fn read_from_bytes(name: &str, bytes: &[u8], options: &MotionOptions) -> Result<Motion> {
        options.check()?;
        let extension = Path::new(name).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let is_bvh = match extension.to_ascii_lowercase().as_str() {
            "bvh" => true,
            "csv" => false,
            _ if bytes.trim_ascii_start().starts_with(b"HIERARCHY") => true,
            _ if bytes.trim_ascii_start().starts_with(b"time_s") => false,
            _ => return Err(Error::file(name, "is not a known motion format; expected .csv or .bvh")),
        };
        let (times, frames) = if is_bvh {
            bvh::read(name, bytes, options.joint.as_deref(), options.metres_per_unit.unwrap_or(1.0))?
        } else {
            options.check_unused(name)?;
            motion_csv::read(name, bytes)?
        };
        // The readers have checked each sample; their differences remain.
        Self::from_samples(times, frames).map_err(|error| Error::file(name, error))
    }

    /// A motion from samples: times in s, finite and strictly increasing, and as many poses.
    ///
    /// # Errors
    /// As [`PoseSpline::new`].
    pub fn from_samples(times: Vec<f64>, frames: Vec<Frame>) -> Result<Motion> {
        Ok(Motion { spline: PoseSpline::new(times, frames)? })
    }

    /// Times of the samples, s, strictly increasing.
    pub fn times(&self) -> &[f64] {
        self.spline.times()
    }

    /// Poses at the samples. Neighbouring quaternions have a dot product that is not negative.
    pub fn frames(&self) -> &[Frame] {
        self.spline.frames()
    }

    /// From the first sample to the last, s; 0 for a single sample.
    pub fn duration(&self) -> f64 {
        self.spline.duration()
    }

    /// The pose at a time (s): exact at samples, smooth in between, constant outside. See [`PoseSpline::at`].
    pub fn at(&self, time: f64) -> Frame {
        self.spline.at(time)
    }

    /// Velocity (m/s) and angular velocity (rad/s), both in world axes, at a time (s). See [`PoseSpline::velocity`].
    pub fn velocity(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        self.spline.velocity(time)
    }

    /// The curve through the samples.
    pub fn spline(&self) -> &PoseSpline {
        &self.spline
    }

    /// The same motion with z up instead of y up: (x, y, z) becomes (x, -z, y) both in the world and in the moving frame, so that
    /// an unturned frame stays unturned. [`crate::files::curves::Curves::to_z_up`] turns a groom the same way.
    pub fn to_z_up(&self) -> Motion {
        Motion {
            spline: self.spline.map_frames(|frame| {
                let (origin, q) = (frame.origin, frame.rotation.quaternion());
                // A quarter turn about x on both sides of the rotation: its axis turns along, its angle stays.
                Frame {
                    origin: Vector3::new(origin.x, -origin.z, origin.y),
                    rotation: UnitQuaternion::new_unchecked(Quaternion::new(q.w, q.i, -q.k, q.j)),
                }
            }),
        }
    }
}
