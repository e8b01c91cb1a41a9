//! Functions of a number with the same bits on every machine.
//!
//! Files:
//!
//! - `entire.rs`: Stumpff's entire functions, from which a helix is made, exact through zero curvature.
//! - `trigonometry.rs`: Sine and cosine with the same bits on every machine and at every lane width.

pub mod entire;
pub mod trigonometry;
