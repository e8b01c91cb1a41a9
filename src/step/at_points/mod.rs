//! Contact at points: the surfaces of bodies near a strand's quadrature points, and the springs that hold the points outside.
//!
//! Files:
//!
//! - `contacts.rs`: Contact at the quadrature points.
//! - `halfway.rs`: The places between a strand's quadrature points at which surfaces are asked for (`probes.rs`): halfway from each point to the next, and the tip.
//! - `places.rs`: What is known of the places of a strand at which the surfaces of bodies are asked for (`probes.rs`).
//! - `probes.rs`: Where the surfaces of bodies are about a strand's quadrature points (`contacts.rs`).
//! - `springs.rs`: The springs that contact gives to the quadrature points (`contacts.rs`), in lanes.
//! - `surfaces.rs`: What contact at points asks of the bodies' surfaces, and what it finds (`contacts.rs`).
//! - `touches.rs`: The surfaces near a quadrature point (`contacts.rs`): of two bodies, or the two sides of a crease in one.

pub mod contacts;
mod halfway;
mod places;
pub(super) mod probes;
pub mod springs;
pub mod surfaces;
pub(super) mod touches;
