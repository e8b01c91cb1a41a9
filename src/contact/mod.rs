//! Contact and bilateral constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.
//!
//! Files:
//!
//! - `body.rs`: Bodies: shapes that strands stay outside of, with their poses and motions.
//! - `body_at.rs`: A body during a substep: where it is at its start and end, and what is asked of it there.
//! - `contact_point.rs`: Contact points: a material point of a strand, a strand's curve at one time, and a contact point between a strand and its partner.
//! - `options.rs`: Options of contact: the model, its tolerances, and the contact properties of strands.
//! - `passage_bounds.rs`: What is found out at little cost about many places of a strand on their ways past a body, four at a time.
//! - `permitted_overlap.rs`: Permitted overlaps of a strand with others and with bodies, along its length.
//! - `point_surfaces.rs`: The surfaces of bodies that a strand's quadrature points may touch, for contact at points (`step/at_points/contacts.rs`).
//! - `broad_phase/`: Which strands may touch which: boxes on a grid, strands cut into pieces, pairs kept from step to step.
//! - `ccd/`: What happens between the beginning and the end of a step: collisions on the way, sides kept, strands that stayed clear.
//! - `constraint/`: Constraints of a step, and their laws.
//! - `narrow_phase/`: Where an element touches a body, and two strands each other: exact on the helices.
//! - `shape/`: Shapes of bodies, in their own axes: where their surface is nearest to a point, how large they are.
//! - `solver/`: The contact-space problem and its solution: the forces with which all laws hold.

pub mod body;
pub mod body_at;
pub mod broad_phase;
pub mod ccd;
pub mod constraint;
pub mod contact_point;
pub mod narrow_phase;
pub mod options;
mod passage_bounds;
pub mod permitted_overlap;
pub mod point_surfaces;
pub mod shape;
pub mod solver;
