//! How long a run of `superhelix simulate` is, and the motion that it follows.

use superhelix::io::{Motion, MotionOptions};

use super::arguments::SimulateArguments;
use crate::shell::failure::Failure;
use crate::shell::up::Up;

/// Most frames of a run: nine hours of film at 30 a second.
const MAX_FRAMES: f64 = 1e6;

/// Frames of a run, the one at the start included.
pub fn count_frames(duration: f64, fps: f64) -> Result<usize, Failure> {
    let frames = (duration * fps + 1e-9).floor() + 1.0;
    if frames > MAX_FRAMES {
        return Err(Failure::Other(format!(
            "{duration} s at {fps} frames a second are {frames:.0} frames; expected {MAX_FRAMES} at most"
        )));
    }
    Ok(frames as usize)
}

/// The motion in the groom's axes, and how long to simulate.
pub fn read_motion(arguments: &SimulateArguments) -> Result<(Option<Motion>, f64), Failure> {
    let Some(path) = &arguments.motion else {
        let duration = arguments
            .duration
            .ok_or_else(|| Failure::Other("without --motion, --duration must say how long to simulate".into()))?;
        return Ok((None, duration));
    };
    let options = MotionOptions { joint: arguments.motion_joint.clone(), metres_per_unit: arguments.motion_scale };
    let motion = Motion::read_with(path, &options)?;
    let motion = match (arguments.motion_up, arguments.up) {
        (Up::Y, Up::Z) => motion.to_z_up(),
        (Up::Z, Up::Y) => {
            return Err(Failure::Other("--motion-up z with --up y is not in this version: turn the groom to z up".into()));
        }
        _ => motion,
    };
    let left = motion.duration() - arguments.start;
    if left <= 0.0 {
        let length = motion.duration();
        return Err(Failure::Other(format!("--start is {}; expected less than the motion's {length} s", arguments.start)));
    }
    Ok((Some(motion), arguments.duration.unwrap_or(left)))
}

/// Says where a --duration is no whole number of frames, and so ends after the last of them.
pub fn warn_of_duration(arguments: &SimulateArguments, frame_count: usize) {
    let last = (frame_count - 1) as f64 / arguments.fps;
    if let Some(duration) = arguments.duration.filter(|duration| !arguments.quiet && *duration > last * (1.0 + 1e-9) + 1e-9) {
        eprintln!(
            "warning: --duration is {duration}, which is no whole number of frames at {} a second: the last of the {frame_count} frames is at {last} s",
            arguments.fps
        );
    }
}
