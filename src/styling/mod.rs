//! Styling by hand: the bodies of tools from a few numbers, and combs whose teeth hold the strands that they meet until these are combed. See
//! `docs/theory/styling_tools.md`. Clips, scissors, hot plates and the freezing of a style are methods of [`Solver`](crate::solver::Solver).
//!
//! Files:
//!
//! - `ring_comb.rs`: A comb whose teeth hold the strands that they meet.
//! - `tools.rs`: The bodies of styling tools, from a few numbers.

pub mod ring_comb;
pub mod tools;

pub use ring_comb::{RingComb, RingCombOptions, RingCombReport};
pub use tools::Tool;
