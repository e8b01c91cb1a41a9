//! Triangle meshes and convex hulls: where they are nearest to a point, over all of them or over a patch.
//!
//! Files:
//!
//! - `flat_triangle.rs`: A triangle in axes of its own, for many queries of how far points are from it.
//! - `hull.rs`: Convex hull of points, as a closed mesh.
//! - `normals.rs`: Normals that tell a mesh's sides: of faces, edges and vertices.
//! - `patch.rs`: The triangles of a mesh that are near a piece of strand.
//! - `query.rs`: Nearest points of a mesh, over all of it or over a few triangles picked beforehand (`patch.rs`).
//! - `triangle.rs`: Nearest point of a triangle.
//! - `triangle_mesh.rs`: Triangle mesh: its checks, its neighbours, its motion over a step.
//! - `winding.rs`: Winding numbers: how often a surface goes around a point, also a surface that is not quite closed.

mod flat_triangle;
pub(super) mod hull;
mod normals;
mod patch;
mod query;
mod triangle;
mod triangle_mesh;
pub(super) mod winding;

pub(in crate::contact) use patch::{Ball, Patch, Region, Tube};
pub use triangle_mesh::{Mesh, Sides};
