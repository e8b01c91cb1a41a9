//! What every call goes through: the guard, errors, versioned structures, the caller's memory, messages and threads.
//!
//! Files:
//!
//! - `allocator.rs`: The host's allocator, for the C libraries: a global allocator that goes to the system until the host gives its own.
//! - `buffers.rs`: The caller's memory: arrays, strided inputs and outputs, checked completely before anything is read or written.
//! - `errors.rs`: Result codes, and the text of the last error of each thread.
//! - `floating_point.rs`: The floating-point mode: sets the default of IEEE 754 inside the library, and the host's own outside.
//! - `guard.rs`: The one guard that every entry point goes through: null handle, re-entry, poisoned state, floating-point mode, panics.
//! - `log.rs`: Messages to the host.
//! - `parallel.rs`: The host's task system behind the engine's `ParallelFor`.
//! - `thread.rs`: Runs work on a separate thread.
//! - `types.rs`: Plain data that crosses the border.
//! - `version.rs`: The library's version and build.
//! - `versioned.rs`: Versioned structures, which may grow.

pub mod allocator;
pub(super) mod buffers;
pub mod errors;
pub(super) mod floating_point;
pub mod guard;
pub mod log;
pub mod parallel;
pub(super) mod thread;
pub mod types;
pub mod version;
pub(super) mod versioned;
