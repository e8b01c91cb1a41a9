//! Bodies, contact, constraints, and what moves together.
//!
//! Files:
//!
//! - `attachment.rs`: Strands, bodies and constraints that follow one pose.
//! - `bodies.rs`: Bodies, which strands stay outside of.
//! - `body_def.rs`: Definitions of bodies.
//! - `constraints.rs`: Bilateral constraints: pins, clamps, ties and rings.
//! - `contact.rs`: Contact options, and contact parameters of strands.
//! - `contact_events.rs`: Contact begin and end events, in a buffer that the host drains.
//! - `contacts.rs`: The list of contacts at the end of the last substep.
//! - `distance_grid.rs`: Bakes meshes into signed distance grids.
//! - `overlaps.rs`: Overlaps of strands in the current scene, and permitted overlaps.
//! - `push_out.rs`: Pushes curves out of a body.

pub mod attachment;
pub mod bodies;
pub mod body_def;
pub mod constraints;
pub mod contact;
pub mod contact_events;
pub mod contacts;
pub mod distance_grid;
pub mod overlaps;
pub mod push_out;
