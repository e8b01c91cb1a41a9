//! Wavefront OBJ: curves and meshes.
//!
//! Files:
//!
//! - `obj.rs`: Wavefront OBJ with polylines: `v x y z` for each point, `l a b c ...` for each strand.
//! - `obj_lines.rs`: Line parsing of Wavefront OBJ that the readers of curves and meshes share.
//! - `obj_mesh.rs`: Wavefront OBJ with faces: `v x y z` for each vertex, `f a b c ...` for each triangle or polygon.
//! - `polygon.rs`: Triangulation of polygons in space, ear by ear (Meisters 1975), as seen along the normal of their area (Newell).

pub mod obj;
pub(super) mod obj_lines;
pub mod obj_mesh;
pub(super) mod polygon;
