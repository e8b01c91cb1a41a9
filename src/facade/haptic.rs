//! Force feedback: a tool in a hand, through a haptic device, in simulated hair.
//!
//! [`haptic`] makes two ends: the [`Tool`] goes with the solver at its rate, the [`Device`] with the device at 1 kHz, on another thread.
//! Nothing blocks.

pub use crate::haptics::{Device, ForceLaw, HapticOptions, HapticState, Mode, Tool, haptic};
