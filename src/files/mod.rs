//! Files: grooms in and out, motions in, caches in and out.
//!
//! A groom is read into [`curves::Curves`], head motion into [`motion::Motion`], a measured curve into
//! [`recorded_curve::RecordedCurve`], a head or another body into [`obj_mesh::ObjMesh`], over time
//! [`mesh_cache::MeshCache`], or [`distance_grid`]; simulated frames leave through
//! [`sequence::SequenceWriter`], a file a frame, or [`curve_cache::CurveCacheWriter`], one file with velocities. Every reader checks the lengths that a file states against the bytes that are there before it
//! asks for memory, and says what it found, where, and what it expected. Nothing here keeps a file open or shares state between
//! calls: all functions may be called from any thread.
//!
//! Files:
//!
//! - `bvh.rs`: Motion capture in Biovision's `.bvh`: a tree of joints, then a row of numbers a frame.
//! - `bytes.rs`: Whole files in and out, and little-endian numbers out of bytes.
//! - `curve_cache.rs`: A cache in one file: curves over time, with velocities, as time samples of a `.usda` file.
//! - `curves.rs`: A set of polylines as a groom file has them: points in the file's own units, root first.
//! - `distance_grid.rs`: Signed distance grids, as `DistanceGrid::bake` makes them.
//! - `hair.rs`: Cem Yuksel's `.hair` files.
//! - `mesh_cache.rs`: A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.
//! - `motion.rs`: The motion of a head: poses over time, from a table (`.csv`) or from motion capture (`.bvh`).
//! - `motion_csv.rs`: A motion as a table: `time_s,px_m,py_m,pz_m,qw,qx,qy,qz`, one sample a line, under that header.
//! - `obj.rs`: Wavefront OBJ with polylines: `v x y z` for each point, `l a b c ...` for each strand.
//! - `obj_lines.rs`: What the readers of Wavefront OBJ share: curves and meshes.
//! - `obj_mesh.rs`: Wavefront OBJ with faces: `v x y z` for each vertex, `f a b c ...` for each triangle or polygon.
//! - `part_file.rs`: Files that are written beside the one that they will become.
//! - `polygon.rs`: Polygons in space cut into triangles, ear by ear (Meisters 1975), as seen along the normal of their area (Newell).
//! - `recorded_curve.rs`: A recorded curve as a table: `time_s`, one column that is measured, and where the root was, if that was recorded.
//! - `sequence.rs`: A cache: simulated frames as a sequence of files, `stem.0001.obj`, `stem.0002.obj` and so on.
//! - `strand_data.rs`: `.data` files of strands, as the hair data sets of the University of Southern California and Digital Salon have them.
//! - `text.rs`: Lines and words of text files, with the line numbers that errors name.
//! - `tfx.rs`: TressFX `.tfx` files, read and written: which of the three versions one is.
//! - `tfx_binary.rs`: TressFX 3 and 4 `.tfx` files: a head of numbers and byte offsets, then sections.
//! - `tfx_text.rs`: TressFX 2 `.tfx` files: text.
//! - `usd_controls.rs`: What goes with the control points of a prim's curves made into what goes with the points of its polylines.
//! - `usd_curves.rs`: The curves of a USD layer at a time, as polylines in the world.
//! - `usd_mesh.rs`: The meshes of a USD layer: their faces as triangles, their texture coordinates, and their vertices at a time, in the world.
//! - `usd_placement.rs`: Where a prim of a USD file stands in the prim that it is in: its `xformOp`s.
//! - `usda.rs`: USD as text (`.usda`): curves in and out.
//! - `usda_layer.rs`: A USD text file as far as curves or meshes go.
//! - `usda_samples.rs`: A `.usda` file and the times at which it has samples: what readers of curves and of meshes over time share.
//! - `usda_scan.rs`: The words of a USD text file: numbers, names, strings, brackets, and values that nobody wants.
//! - `usda_values.rs`: Attributes of a USD text file: a value, values over time, or both.
mod bvh;
mod bytes;
pub mod curve_cache;
pub mod curves;
pub mod distance_grid;
pub mod hair;
pub mod mesh_cache;
pub mod motion;
mod motion_csv;
pub mod obj;
mod obj_lines;
pub mod obj_mesh;
pub mod part_file;
mod polygon;
pub mod recorded_curve;
pub mod sequence;
pub mod strand_data;
mod text;
pub mod tfx;
mod tfx_binary;
mod tfx_text;
mod usd_controls;
mod usd_curves;
mod usd_mesh;
mod usd_placement;
pub mod usda;
mod usda_layer;
mod usda_samples;
mod usda_scan;
mod usda_values;
