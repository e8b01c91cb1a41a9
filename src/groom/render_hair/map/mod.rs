//! The map of render hair: which guides each strand follows, and how.
//!
//! Files:
//!
//! - `binding.rs`: Binds render strands to guides: which guides each strand follows, its place among them, and its random numbers.
//! - `image.rs`: Serialises the map.
//! - `sections.rs`: Maps a patch of scalp to the cross-section of the hair on it.
//! - `strand.rs`: A render strand in the map: the guides that it follows, and how.
//! - `weights.rs`: Chooses the guides that a strand follows, and their weights.
//! - `wisps.rs`: Wisps: divides the strands of each first guide among well-separated middles.
//! - `without.rs`: Removes guides from a map.

pub(super) mod binding;
pub(super) mod image;
pub(super) mod sections;
pub(super) mod strand;
pub(super) mod weights;
pub(super) mod wisps;
pub(super) mod without;
