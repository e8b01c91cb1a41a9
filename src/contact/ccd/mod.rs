//! What happens between the beginning and the end of a step: collisions on the way, sides kept, strands that stayed clear.
//!
//! Files:
//!
//! - `body_sweep.rs`: Collisions of an element with a body during a step (`sweep.rs`, piece by piece).
//! - `entrance.rs`: Where a straight way enters a body, found by sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996).
//! - `path_clearance.rs`: Whether a strand that has stepped unconstrained stayed clear of a body all the time: a bound on the distance, piece by piece and time by time.
//! - `sides.rs`: Whether two moving pieces of strands plainly keep their sides to each other.
//! - `sweep.rs`: Collisions of a moving piece of a strand.

pub(super) mod body_sweep;
pub(super) mod entrance;
pub mod path_clearance;
pub(super) mod sides;
pub(super) mod sweep;
