//! How long a run of `superhelix simulate` is, and the motion that it follows.

use superhelix::io::Motion;

use super::arguments::SimulateArguments;
use crate::shell::failure::Failure;

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
    match (arguments.head_motion.read(arguments.up)?, arguments.duration) {
        (Some((motion, left)), duration) => Ok((Some(motion), duration.unwrap_or(left))),
        (None, Some(duration)) => Ok((None, duration)),
        (None, None) => Err(Failure::Other("without --motion, --duration must say how long to simulate".into())),
    }
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
