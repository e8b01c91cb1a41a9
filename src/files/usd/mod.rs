//! USD as text: scanner, layers, curves and meshes.
//!
//! Files:
//!
//! - `usd_controls.rs`: Conversion of data per control point of a prim's curves into data per point of its polylines.
//! - `usd_curves.rs`: The curves of a USD layer at a time, as polylines in the world.
//! - `usd_mesh.rs`: The meshes of a USD layer as triangles in the world: faces, texture coordinates, and vertices at a time.
//! - `usd_placement.rs`: The placement of a prim of a USD file in its parent: its `xformOp`s.
//! - `usd_primvars.rs`: The numeric primvars of the curves of a USD layer, a value for each strand.
//! - `usda.rs`: USD as text (`.usda`): reads and writes curves. `mesh_cache` reads meshes over time.
//! - `usda_layer.rs`: A layer of a USD text file: its units, axes and time, its curve or mesh prims, and the placements of their ancestors.
//! - `usda_samples.rs`: A `.usda` file and the times of its samples: shared by the readers of curves and of meshes over time.
//! - `usda_scan.rs`: The scanner of USD text files: numbers, names, strings, brackets, and values to skip.
//! - `usda_values.rs`: Attributes of a USD text file: a value, values over time, or both.

pub(super) mod usd_controls;
pub(super) mod usd_curves;
pub(super) mod usd_mesh;
pub(super) mod usd_placement;
pub(super) mod usd_primvars;
pub mod usda;
pub(super) mod usda_layer;
pub(super) mod usda_samples;
pub(super) mod usda_scan;
pub(super) mod usda_values;
