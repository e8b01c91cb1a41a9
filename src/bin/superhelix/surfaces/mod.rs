//! Meshes on the command line: surfaces to draw, scalps, bodies baked into grids.
//!
//! Files:
//!
//! - `baked_body.rs`: A mesh that hair is kept out of, baked into a grid of distances, which is kept beside the mesh for the next time.
//! - `moving_scalp.rs`: A scalp that deforms, and the roots that stand on it.
//! - `region.rs`: Where on a mesh follicles stand: meshes as scalps, maps of density, nearness to a groom's roots.
//! - `surface.rs`: Surfaces of bodies as triangles, for pictures.

pub mod baked_body;
pub mod moving_scalp;
pub mod region;
pub mod surface;
