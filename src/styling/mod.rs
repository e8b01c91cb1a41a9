//! Styling by hand: bodies of tools, and combs whose teeth hold the strands that they meet until these are combed
//! (`docs/theory/styling_tools.md`).
//!
//! Clips, scissors, hot plates and frozen styles are methods of [`Solver`](crate::solver::Solver).
//!
//! Files:
//!
//! - `ring_comb.rs`: A ring comb: a strand sticks to the first tooth that it meets and slides along it as through a ring with friction.
//! - `tools.rs`: The bodies of styling tools, from a few numbers.

pub mod ring_comb;
pub mod tools;

pub use ring_comb::{RingComb, RingCombOptions, RingCombReport};
pub use tools::Tool;
