//! Samples a smooth motion through poses, for hosts that have recorded poses of a head.

use crate::capi::base::buffers::{FRAME_FORMATS, Reader, VECTOR_FORMATS, Writer, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::{SHX_FORMAT_FRAME, shx_input, shx_output};
use crate::error::{Error, Result, check_finite};
use crate::math::splines::pose_spline::PoseSpline;
use crate::memory;

/// The engine's error, with the names of the C function.
fn in_words_of_c(error: Error) -> Error {
    error.renamed("times", "pose_times").renamed("frames", "poses")
}

/// Samples the smooth motion through recorded poses, such as those of a head: poses->count frames
/// (SHX_FORMAT_FRAME, m), at pose_times (as many, s, strictly increasing, at least one). The motion is cubic
/// between poses, exact at them, continuous in velocity, and constant before the first and after the last.
/// Successive poses must differ by less than half a turn.
/// times: count times, s. Writes for each the frame (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for quaternions
/// alone), the velocity of its origin (m/s) and its angular velocity (rad/s; SHX_FORMAT_F32X3 or _F64X3), in
/// world axes: zero outside the poses' times, and one-sided at the first and the last. Any of the outputs may
/// be null, but not all. Pass frames to shx_solver_set_root_frames, and the velocities at the first time to
/// shx_strand_def.root_velocity and .root_angular_velocity.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (a value that is not finite, times that do not
/// increase, a quaternion that is not of unit length), SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_sample_motion(
    pose_times: *const f64,
    poses: *const shx_input,
    times: *const f64,
    count: usize,
    frames: *const shx_output,
    velocities: *const shx_output,
    angular_velocities: *const shx_output,
) -> shx_result {
    let body = || -> Result<()> {
        if frames.is_null() && velocities.is_null() && angular_velocities.is_null() {
            return Err(Error::NullArgument { argument: "frames (and velocities and angular_velocities)".into() });
        }
        // SAFETY: the caller's poses, as many times, count times, and memory for the outputs.
        let (reader, pose_times, times, frames, velocities, angular_velocities) = unsafe {
            let reader = Reader::new("poses", poses, &[SHX_FORMAT_FRAME])?;
            let pose_times = array("pose_times", "poses.count", pose_times, reader.count())?;
            (
                reader,
                pose_times,
                array("times", "count", times, count)?,
                Writer::optional("frames", frames, FRAME_FORMATS, count)?,
                Writer::optional("velocities", velocities, VECTOR_FORMATS, count)?,
                Writer::optional("angular_velocities", angular_velocities, VECTOR_FORMATS, count)?,
            )
        };
        if reader.count() == 0 {
            return Err(Error::invalid("poses.count", 0, "at least one pose"));
        }
        for (index, time) in times.iter().enumerate() {
            check_finite(|| format!("times[{index}]"), *time)?;
        }
        let mut samples = memory::list(reader.count())?;
        for index in 0..reader.count() {
            samples.push(reader.frame("poses", index)?);
        }
        let motion = PoseSpline::new(memory::collected(pose_times.iter().copied())?, samples).map_err(in_words_of_c)?;
        for (index, time) in times.iter().enumerate() {
            if let Some(frames) = &frames {
                frames.frame(index, &motion.at(*time));
            }
            let (linear, angular) = motion.velocity(*time);
            if let Some(velocities) = &velocities {
                velocities.vector(index, linear.into());
            }
            if let Some(angular_velocities) = &angular_velocities {
                angular_velocities.vector(index, angular.into());
            }
        }
        Ok(())
    };
    call("shx_sample_motion", body)
}
