//! Styling, posing, combs, and tools in a hand.
//!
//! Files:
//!
//! - `haptic.rs`: Haptic objects: a tool in a hand.
//! - `haptic_def.rs`: Definitions of haptic objects, and the state after an update.
//! - `haptic_ring_comb.rs`: Ring combs in the hand: a haptic object leads them, and the hand feels what the strands on their teeth pull with.
//! - `pose_def.rs`: Definitions and options of posing, for the functions of `posing.rs`.
//! - `posing.rs`: Poses simulated strands: drag, brush, change elements, cut, grow, mirror.
//! - `ring_comb.rs`: Ring combs: their teeth hold the strands that they meet until these are combed.
//! - `styling.rs`: Styling: clips, scissors, hot plates and frozen styles.
//! - `styling_tool.rs`: Styling tools: their bodies, from a few numbers.

pub mod haptic;
pub mod haptic_def;
pub mod haptic_ring_comb;
pub mod pose_def;
pub mod posing;
pub mod ring_comb;
pub mod styling;
pub mod styling_tool;
