//! The motion of a head on the command line.

use std::path::PathBuf;

use clap::Args;
use nalgebra::Vector3;
use superhelix::io::{Motion, MotionOptions};

use crate::shell::argument_values::{not_negative, positive, triple};
use crate::shell::failure::Failure;
use crate::shell::up::Up;
use crate::stepping::head::Head;

/// A motion that roots follow rigidly.
#[derive(Debug, Args)]
pub struct MotionArguments {
    /// The head's motion: a .csv of poses or a .bvh. Without it the head stands still.
    #[arg(long, value_name = "HEAD.csv|.bvh")]
    pub motion: Option<PathBuf>,
    /// .bvh: name of the joint that carries the hair. Default: the first with "head" in its name.
    #[arg(long, value_name = "NAME", requires = "motion")]
    motion_joint: Option<String>,
    /// .bvh: metres a unit of the file. Default: 1.
    #[arg(long, value_name = "METRES", requires = "motion", value_parser = positive)]
    motion_scale: Option<f64>,
    /// The motion's axis that points up.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    motion_up: Up,
    /// Where in the motion to begin, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, requires = "motion", value_parser = not_negative)]
    start: f64,
    /// Where the head's joint sits in the groom, file units. Default: the middle of the roots.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = triple)]
    pivot: Option<Vector3<f64>>,
}

impl MotionArguments {
    /// The motion in the groom's axes, of which `up` points up, and how long it goes on after the start, s.
    pub fn read(&self, up: Up) -> Result<Option<(Motion, f64)>, Failure> {
        let Some(path) = &self.motion else { return Ok(None) };
        let options = MotionOptions { joint: self.motion_joint.clone(), metres_per_unit: self.motion_scale };
        let motion = Motion::read_with(path, &options)?;
        let motion = match (self.motion_up, up) {
            (Up::Y, Up::Z) => motion.to_z_up(),
            (Up::Z, Up::Y) => {
                return Err(Failure::Other("--motion-up z with --up y is not in this version: turn the groom to z up".into()));
            }
            _ => motion,
        };
        let left = motion.duration() - self.start;
        if left <= 0.0 {
            let length = motion.duration();
            return Err(Failure::Other(format!("--start is {}; expected less than the motion's {length} s", self.start)));
        }
        Ok(Some((motion, left)))
    }

    /// The head that follows the motion; `roots` are where it carries hair, m, and `scale` is metres a unit of the groom.
    pub fn head(&self, motion: Option<Motion>, roots: impl ExactSizeIterator<Item = Vector3<f64>>, scale: f64) -> Head {
        let count = roots.len() as f64;
        let joint = self.pivot.map_or_else(|| roots.sum::<Vector3<f64>>() / count, |pivot| pivot * scale);
        // A motion's clock may begin anywhere: --start counts from its first sample.
        let start = self.start + motion.as_ref().map_or(0.0, |motion| motion.times()[0]);
        Head::new(motion, start, joint)
    }
}
