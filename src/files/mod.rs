//! Files: grooms, motions and caches, read and written.
//!
//! A groom becomes [`curves::Curves`], the motion of a head [`motion::Motion`], a measured curve
//! [`recorded_curve::RecordedCurve`], a head or another body [`obj_mesh::ObjMesh`], over time [`mesh_cache::MeshCache`], or
//! [`distance_grid`]. Simulated frames go to [`sequence::SequenceWriter`], one file per frame, or to
//! [`curve_cache::CurveCacheWriter`], one file with velocities. Every reader checks the lengths in a file against the bytes
//! present before it allocates; its errors say what it found, where, and what it expected. No function keeps a file open or
//! shares state between calls: any thread may call any of them.
//!
//! Files:
//!
//! - `alembic.rs`: Alembic files (`.abc`, Ogawa): the curves of their first sample, in the world of the file.
//! - `bvh.rs`: Motion capture in Biovision's `.bvh`: a tree of joints, then one row of numbers per frame.
//! - `bytes.rs`: Reading and writing whole files, and little-endian numbers in bytes.
//! - `curve_cache.rs`: A cache in one file: curves over time, with velocities, as the time samples of a `.usda` file.
//! - `curves.rs`: Curves of a groom file: polylines in the file's own units, root first.
//! - `distance_grid.rs`: Files of signed distance grids, as `DistanceGrid::bake` makes them.
//! - `hair.rs`: Cem Yuksel's `.hair` files.
//! - `mesh_cache.rs`: A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.
//! - `motion.rs`: The motion of a head: poses over time, from a table (`.csv`) or from motion capture (`.bvh`).
//! - `motion_csv.rs`: A motion as a table: one sample per line under the header `time_s,px_m,py_m,pz_m,qw,qx,qy,qz`.
//! - `numpy.rs`: NumPy's `.npy` and `.npz` files that hold strands: an array of strands by points by three, root first.
//! - `obj.rs`: Wavefront OBJ with polylines: `v x y z` for each point, `l a b c ...` for each strand.
//! - `obj_lines.rs`: Line parsing of Wavefront OBJ that the readers of curves and meshes share.
//! - `obj_mesh.rs`: Wavefront OBJ with faces: `v x y z` for each vertex, `f a b c ...` for each triangle or polygon.
//! - `ogawa.rs`: The container of Alembic files (Ogawa): groups of groups and data, objects with properties in them, and their first samples.
//! - `part_file.rs`: Part files: a file is written under a hidden name beside its target, so that no reader ever sees half of it.
//! - `ply.rs`: Stanford `.ply` files as reconstructions of hair write them: text or binary, of either byte order.
//! - `point_strands.rs`: The strands of a point cloud: which points make up each strand, where the file does not say.
//! - `polygon.rs`: Triangulation of polygons in space, ear by ear (Meisters 1975), as seen along the normal of their area (Newell).
//! - `raw_strands.rs`: Strands as a file has them: of any number of points, none included, and of numbers that need not be finite.
//! - `recorded_curve.rs`: A recorded curve as a table: `time_s`, one measured column, and the root's position if it was recorded.
//! - `sequence.rs`: A cache as a sequence of files: simulated frames in `stem.0001.obj`, `stem.0002.obj` and so on.
//! - `strand_attributes.rs`: Numbers that a groom file has for each of its strands, by name: primvars of USD, parameters of Alembic, arrays of NumPy, properties of `.ply`.
//! - `strand_data.rs`: `.data` files of strands, as in the hair data sets of the University of Southern California and of Digital Salon.
//! - `text.rs`: Lines and words of text files, with line numbers for errors.
//! - `tfx.rs`: TressFX `.tfx` files: tells the three versions apart, reads and writes them.
//! - `tfx_binary.rs`: TressFX 3 and 4 `.tfx` files: a header of numbers and byte offsets, then sections.
//! - `tfx_text.rs`: TressFX 2 `.tfx` files: text.
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
mod alembic;
mod bvh;
mod bytes;
pub mod curve_cache;
pub mod curves;
pub mod distance_grid;
pub mod hair;
pub mod mesh_cache;
pub mod motion;
mod motion_csv;
mod numpy;
pub mod obj;
mod obj_lines;
pub mod obj_mesh;
mod ogawa;
pub mod part_file;
mod ply;
pub mod point_strands;
mod polygon;
pub mod raw_strands;
pub mod recorded_curve;
pub mod sequence;
pub mod strand_attributes;
pub mod strand_data;
mod text;
pub mod tfx;
mod tfx_binary;
mod tfx_text;
mod usd_controls;
mod usd_curves;
mod usd_mesh;
mod usd_placement;
mod usd_primvars;
pub mod usda;
mod usda_layer;
mod usda_samples;
mod usda_scan;
mod usda_values;
