//! superhelix: a hair engine that others build into their programs.
//!
//! Files:
//!
//! - `error.rs`: Errors that the caller can act on: each names the argument and the value.
//! - `memory.rs`: Fallible allocation: memory that grows with a host's numbers is reserved in advance, so that its lack is an error and not an abort.
//! - `meter.rs`: The budget of a substep: work, which is counted and the same on every machine; a deadline; and a flag with which the host cancels.
//! - `platform.rs`: Platform features: clock, threads, process ids.
//! - `workers.rs`: Runs work on many strands: on the calling thread, in a private pool, or by the host's task system.
//! - `capi/`: The C ABI: opaque handles, definitions that can grow, result codes, and one guard on every entry point.
//! - `chain/`: The linear systems of one strand: the linear-time elimination from tip to root, and the dense reference it is tested against.
//! - `contact/`: Contact and constraints: bodies and hair against hair.
//! - `energy/`: The terms of the incremental potential, one file per term.
//! - `files/`: Files: grooms, motions and caches, read and written.
//! - `groom/`: From measured and modelled hair to strands.
//! - `haptics/`: Force feedback: a tool in a hand, through a haptic device, in simulated hair.
//! - `math/`: Numbers: lanes, entire functions, small vectors and matrices, quadrature, splines, rigid poses and their motion.
//! - `rod/`: One strand by itself: material, freedoms, kinematics.
//! - `solver/`: The scene: strands, their roots, the step, and everything a host reads back.
//! - `step/`: Time integration of one strand.
//! - `study/`: Studies on top of the solver: what is asked of strands beside their motion, what a measurement says about them, what settings cost and are good for.
//! - `styling/`: Styling by hand: bodies of tools, and combs whose teeth hold the strands that they meet until these are combed.

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
