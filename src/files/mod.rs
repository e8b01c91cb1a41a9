//! Files: grooms in and out, motions in, caches in and out.
//!
//! A groom is read into [`curves::Curves`], head motion into [`motion::Motion`], a measured curve into
//! [`recorded_curve::RecordedCurve`], a head or another body into [`obj_mesh::ObjMesh`], over time
//! [`mesh_cache::MeshCache`], or [`distance_grid`]; simulated frames leave through
//! [`sequence::SequenceWriter`], a file a frame, or [`curve_cache::CurveCacheWriter`], one file with velocities. Every reader checks the lengths that a file states against the bytes that are there before it
//! asks for memory, and says what it found, where, and what it expected. Nothing here keeps a file open or shares state between
//! calls: all functions may be called from any thread.
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
mod part_file;
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
