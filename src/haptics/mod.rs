//! Force feedback: a tool in a hand, through a haptic device, in simulated hair. See `docs/notebook/haptics.md`.
//!
//! Two sides share two triple buffers and nothing else. [`Tool`] is the simulation's: before a step it sends the tool's bodies to where the device has
//! them, after it it publishes what touches them. [`Device`] is that of the device's thread: it takes what is newest and answers with a force.

mod coupling;
pub mod device;
pub mod exchange;
pub mod explicit_law;
mod geometry;
mod local_model;
pub mod options;
pub mod passivity;
pub mod tool;
mod touch_forces;

pub use device::{Device, HapticState};
pub use options::{ForceLaw, HapticOptions, Mode};
pub use tool::Tool;

use crate::error::Result;
use crate::solver::Solver;
use crate::solver::id::BodyId;
use exchange::exchange;

/// A haptic object: `bodies` of a solver, which move as one rigid tool from where they are now, in the hand.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) naming `options.field`, or `bodies` where there are none or one comes twice;
/// [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`;
/// [`Error::Unsupported`](crate::error::Error::Unsupported) for [`Mode::HandOver`] by [`ForceLaw::Contact`] with a penalty model of contact.
pub fn haptic(solver: &Solver, bodies: &[BodyId], options: &HapticOptions) -> Result<(Tool, Device)> {
    options.check("options")?;
    let (poses, newest_pose) = exchange(device::POSE_NUMBERS);
    let (models, newest_model) = exchange(local_model::capacity(options));
    let tool = Tool::new(solver, bodies, options, newest_pose, models)?;
    let device = Device::new(options, tool.handle(), tool.teeth(solver)?, poses, newest_model);
    Ok((tool, device))
}
