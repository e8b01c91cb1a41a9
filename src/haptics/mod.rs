//! Force feedback: a tool in a hand, through a haptic device, in simulated hair. See `docs/theory/haptics.md`.
//!
//! Two sides share two triple buffers and nothing else. [`Tool`] belongs to the simulation: before a step it sends the tool's
//! bodies to the device's pose, and after the step it publishes their contacts. [`Device`] belongs to the device's thread: it
//! takes the newest message and returns a force.
//!
//! Files:
//!
//! - `contact_forces.rs`: The device's own contact solve: Signorini's and Coulomb's laws at the contacts of a local model, with the tool where the hand has it now.
//! - `coupling.rs`: The virtual coupling between the device and the tool in the simulation: a spring and a damper (Colgate, Stanley and Brown 1995).
//! - `device.rs`: The device's thread: takes a pose and returns a force, in bounded time, without waiting or allocating.
//! - `exchange.rs`: A triple buffer: one thread publishes, another takes the newest message, and neither ever waits for the other.
//! - `explicit_law.rs`: The explicit force of Bonanni and Kmoch (2008, section 3.3): F = β ṫ⊥ + f(γ) ṫ∥.
//! - `geometry.rs`: The nearest place of a tool's body to a straight strand through a point: as the tool moves on, the strand slides along it and around it.
//! - `local_model.rs`: The local model that the simulation hands over after a step: the contacts of the tool, and their response until the next step.
//! - `options.rs`: Options of a haptic object.
//! - `passivity.rs`: Passivity observer and controller (Hannaford and Ryu 2002): bounds the energy that the device gives to the hand.
//! - `ring_combs.rs`: Ring combs in the hand: their teeth hold the strands that they run into, and the hand feels what these pull with.
//! - `tool.rs`: The simulation's side: moves the tool's bodies with the device, and publishes their contacts after every step.

mod contact_forces;
mod coupling;
pub mod device;
pub mod exchange;
pub mod explicit_law;
mod geometry;
mod local_model;
pub mod options;
pub mod passivity;
mod ring_combs;
pub mod tool;

pub use device::{Device, HapticState};
pub use options::{ForceLaw, HapticOptions, Mode};
pub use tool::Tool;

use crate::error::Result;
use crate::solver::Solver;
use crate::solver::id::BodyId;
use exchange::exchange;

/// Creates a haptic object: `bodies` of a solver, which from now on move with the hand as one rigid tool.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) naming `options.field`, or `bodies` if it is empty or repeats
/// one; [`Error::InvalidId`](crate::error::Error::InvalidId) naming `bodies[i]`;
/// [`Error::Unsupported`](crate::error::Error::Unsupported) for [`Mode::HandOver`] by [`ForceLaw::Contact`] with a penalty model
/// of contact.
pub fn haptic(solver: &Solver, bodies: &[BodyId], options: &HapticOptions) -> Result<(Tool, Device)> {
    options.check("options")?;
    let (poses, newest_pose) = exchange(device::POSE_NUMBERS);
    let (models, newest_model) = exchange(local_model::capacity(options));
    let tool = Tool::new(solver, bodies, options, newest_pose, models)?;
    let device = Device::new(options, tool.handle(), tool.teeth(solver)?, poses, newest_model);
    Ok((tool, device))
}
