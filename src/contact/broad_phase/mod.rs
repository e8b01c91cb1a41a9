//! Which strands may touch which: boxes on a grid, strands cut into pieces, pairs kept from step to step.
//!
//! Files:
//!
//! - `boxes.rs`: Which boxes of many overlap: a uniform grid, sorted by counting.
//! - `hair_pairs.rs`: Pairs of strands that may be in contact, kept from step to step, and their contacts.
//! - `pieces.rs`: Strands cut into pieces that bend little, each represented by its chord: the input of the search for pairs.

pub mod boxes;
pub mod hair_pairs;
pub mod pieces;
