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
//! - `curve_cache.rs`: A cache in one file: curves over time, with velocities, as the time samples of a `.usda` file.
//! - `curves.rs`: Curves of a groom file: polylines in the file's own units, root first.
//! - `distance_grid.rs`: Files of signed distance grids, as `DistanceGrid::bake` makes them.
//! - `mesh_cache.rs`: A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.
//! - `motion.rs`: The motion of a head: poses over time, from a table (`.csv`) or from motion capture (`.bvh`).
//! - `recorded_curve.rs`: A recorded curve as a table: `time_s`, one measured column, and the root's position if it was recorded.
//! - `sequence.rs`: A cache as a sequence of files: simulated frames in `stem.0001.obj`, `stem.0002.obj` and so on.
//! - `io/`: Whole files, bytes, and lines of text.
//! - `strands/`: Files of strands, a format a file, and what their readers share.
//! - `usd/`: USD as text: scanner, layers, curves and meshes.
//! - `wavefront/`: Wavefront OBJ: curves and meshes.
pub mod curve_cache;
pub mod curves;
pub mod distance_grid;
pub mod io;
pub mod mesh_cache;
pub mod motion;
pub mod recorded_curve;
pub mod sequence;
pub mod strands;
pub mod usd;
pub mod wavefront;
