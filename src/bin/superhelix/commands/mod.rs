//! Commands of a file or two each.
//!
//! Files:
//!
//! - `bake.rs`: `superhelix bake`: a mesh into a signed distance grid.
//! - `bench.rs`: `superhelix bench`: what the engine costs on this machine, on one card.
//! - `convert.rs`: `superhelix convert`: a groom, or a cache of frames, in another format.
//! - `fit.rs`: `superhelix fit`: strands for the curves of a groom, and how close they come.
//! - `fit_friction.rs`: `superhelix fit-friction`: friction coefficients from a recorded curve.
//! - `interpolate.rs`: `superhelix interpolate`: render strands from the guides of a groom or of a cache.
//! - `lock.rs`: `superhelix lock`: a lock of hair of a kind, as a scene.
//! - `place.rs`: `superhelix place`: follicles scattered over a mesh, or put where texture coordinates say.
//! - `pose.rs`: `superhelix pose`: a scene whose strands are posed, as a scene.
//! - `settings.rs`: `superhelix settings`: what to set for a preset or for an error that may be made.
//! - `info/`: `superhelix info`: what a groom file holds.

pub mod bake;
pub mod bench;
pub mod convert;
pub mod fit;
pub mod fit_friction;
pub mod info;
pub mod interpolate;
pub mod lock;
pub mod place;
pub mod pose;
pub mod settings;
