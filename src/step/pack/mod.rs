//! Strands that take a step side by side, one per lane of a pack.
//!
//! Files:
//!
//! - `loaded.rs`: The numbers of a pack's strands in lanes, and their transfer into them and back.
//! - `members.rs`: Packs: strands that take a step side by side, one per lane.
//! - `packs.rs`: The choice of lanes for a pack of strands: by precision, by the machine's instructions, and by the number of strands.
//! - `single.rs`: Steps of one strand at a time, for strands outside any pack.
//! - `targets.rs`: The targets of a pack's strands in lanes: what draws each quadrature point at the end of a stage.
//! - `whole.rs`: A step in one piece for strands side by side: computed in the workspace, and made their state only on demand.

pub mod loaded;
pub mod members;
pub mod packs;
pub mod single;
pub mod targets;
pub mod whole;
