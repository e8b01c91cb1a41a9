//! A smooth rigid motion through samples of it.

use nalgebra::Vector3;

use crate::error::Result;
use crate::math::frame::Frame;

/// A motion through poses at given times: continuous in velocity and angular velocity, exact at the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSpline {
    times: Vec<f64>,
    frames: Vec<Frame>,
}

impl PoseSpline {
    /// A motion through `frames` at `times` (s).
    ///
    /// # Errors
    /// [`crate::error::Error::InvalidArgument`] when there is no sample, the counts differ, or times are not finite and strictly increasing.
    pub fn new(times: Vec<f64>, frames: Vec<Frame>) -> Result<Self> {
        todo!()
    }

    /// Times of the samples, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Poses at the samples.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// From the first sample to the last, s; 0 for a single sample.
    pub fn duration(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// The pose at a time (s): exactly a sample's at its time, held before the first and after the last.
    pub fn at(&self, time: f64) -> Frame {
        todo!()
    }

    /// Velocity of the origin (m/s) and angular velocity (rad/s), both in world axes, at a time (s). Zero outside the samples.
    pub fn velocity(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        todo!()
    }
}
