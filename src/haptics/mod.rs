//! Force feedback: a tool in a hand, through a haptic device, in simulated hair. See `docs/theory/haptics.md`.
//!
//! Two sides share two triple buffers and nothing else. [`Tool`] is the simulation's: before a step it sends the tool's bodies to where the device has
//! them, after it it publishes what touches them. [`Device`] is that of the device's thread: it takes what is newest and answers with a force.
//!
//! Files:
//!
//! - `coupling.rs`: The virtual coupling between the device and the tool in the simulation (Colgate, Stanley and Brown 1995).
//! - `device.rs`: The side of the device's thread: a pose in, a force out, in bounded time, without waiting, without allocating.
//! - `exchange.rs`: A triple buffer: one thread publishes, another takes the newest, and neither ever waits for the other.
//! - `explicit_law.rs`: The explicit force of Bonanni and Kmoch (2008, section 3.3).
//! - `geometry.rs`: Where a strand that goes straight through a point comes nearest to a body of the tool: as the tool goes on, the strand slides along it and around it.
//! - `local_model.rs`: What the simulation hands over after a step: what touches the tool, and how it answers until the next one.
//! - `options.rs`: What a haptic object is made from.
//! - `passivity.rs`: Passivity, observed and kept (Hannaford and Ryu 2002).
//! - `tool.rs`: The simulation's side: bodies that go where the device has them, and what touches them, handed over after every step.
//! - `touch_forces.rs`: The device's own solve: Signorini's and Coulomb's laws at the touches of a local model, with the tool where the hand has it now.

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
