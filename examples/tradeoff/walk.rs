//! The recorded walk as a smooth function of time.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use superhelix::Frame;
use superhelix::io::Motion;

/// The scene's start in the recording, s.
const START: f64 = 1.0;
/// Width of the Gaussian that smooths it, s: it preserves the walk and removes the capture's noise, whose accelerations no frame
/// resolves. The recording itself has a jump of its acceleration at each sample, where the reference would have to stop.
const WIDTH: f64 = 0.015;
/// Samples beyond this many widths count for less than rounding.
const REACH: f64 = 8.5;

/// A head that walks.
#[derive(Debug, Clone)]
pub struct Walk {
    motion: Motion,
}

impl Walk {
    /// Reads the recording.
    pub fn read() -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/walk_figure8_head.csv");
        Self { motion: Motion::read(path, None).expect("the walk") }
    }

    /// The head's pose after `t` seconds, y up.
    pub fn at(&self, t: f64) -> Frame {
        let (times, frames) = (self.motion.times(), self.motion.frames());
        let middle = times[0] + START + t;
        let first = times.partition_point(|time| *time < middle - REACH * WIDTH);
        let (mut total, mut origin, mut rotation) = (0.0, Vector3::zeros(), Quaternion::new(0.0, 0.0, 0.0, 0.0));
        for (time, frame) in times.iter().zip(frames).skip(first).take_while(|(time, _)| **time < middle + REACH * WIDTH) {
            let weight = (-0.5 * ((time - middle) / WIDTH).powi(2)).exp();
            total += weight;
            origin += frame.origin * weight;
            // Neighbouring quaternions are on the same side.
            rotation += frame.rotation.quaternion() * weight;
        }
        Frame { origin: origin / total, rotation: UnitQuaternion::new_normalize(rotation) }
    }
}
