//! superhelix: a hair engine that others build into their programs.

pub mod capi;
pub mod chain;
pub mod contact;
pub mod energy;
pub mod error;
pub mod files;
pub mod groom;
pub mod haptics;
pub mod math;
mod memory;
pub mod meter;
mod platform;
pub mod rod;
pub mod solver;
pub mod step;
pub mod study;
pub mod styling;
pub mod workers;
