//! Signed distance grids: how they are baked, and what is asked of them.
//!
//! Files:
//!
//! - `bake_open.rs`: Signed distances of a mesh that is not quite closed: winding numbers give the sign.
//! - `distance_grid.rs`: Signed distance grid: a closed surface as distances at the nodes of a lattice, cubic in between.
//! - `hessian_bounds.rs`: Bounds on the second derivatives of a distance grid's field, block by block of cells.
//! - `lattice.rs`: The nodes at which a distance grid is baked.
//! - `planes.rs`: The tangent plane at every node of a distance grid, for look-ups by the hundred thousand.
//! - `tricubic.rs`: Tricubic interpolation of a lattice of numbers, with its slopes: Catmull and Rom's cubic along each axis.

mod bake_open;
mod distance_grid;
mod hessian_bounds;
mod lattice;
mod planes;
mod tricubic;

pub(crate) use distance_grid::node_count;
pub use distance_grid::{DistanceGrid, NODE_LIMIT};
pub(crate) use planes::PlaneField;
