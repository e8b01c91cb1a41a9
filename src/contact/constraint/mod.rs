//! Constraints of a step, and their laws.
//!
//! Files:
//!
//! - `law.rs`: The laws of constraints, each with its exact solve for one constraint alone.
//! - `step_constraint.rs`: Constraints of one step: a contact of a strand with a body or another strand, or a part of a bilateral constraint.

pub mod law;
pub mod step_constraint;
