//! Where an element touches a body, and two strands each other: exact on the helices.
//!
//! Files:
//!
//! - `across_edge.rs`: A strand across an edge of a solid: the separating plane.
//! - `descent.rs`: The minimum of a distance along a curve between a point where it falls and one where it rises.
//! - `element_path.rs`: One element during a step as seen from a body: its points at the start and at the present iterate in the body's axes.
//! - `ground.rs`: The distance of a body from points of an element.
//! - `helix_distance.rs`: Closest points of two pieces of helices: exact, by Newton's iteration from the closest points of their chords.
//! - `nearest.rs`: The point of a strand that is nearest to a point, from one nearby.
//! - `path_bounds.rs`: Boxes around a strand's motion through a step, and around its elements'.
//! - `segment_distance.rs`: Closest points of two straight segments.
//! - `strand_body.rs`: Contacts of a strand's elements with a body.
//! - `strand_contacts.rs`: Contacts between two strands, from pairs of their pieces, exact on the helices.
//! - `undetected_overlap.rs`: Overlap of a piece of a strand with a mesh between the sampled points, which sampling leaves undetected.

pub(super) mod across_edge;
pub(super) mod descent;
pub(super) mod element_path;
pub(super) mod ground;
pub mod helix_distance;
pub mod nearest;
pub mod path_bounds;
pub mod segment_distance;
pub mod strand_body;
pub mod strand_contacts;
pub(super) mod undetected_overlap;
