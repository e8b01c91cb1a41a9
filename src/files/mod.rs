//! Files: grooms in, motions in, caches out.
//!
//! A groom is read into [`curves::Curves`], head motion into [`motion::Motion`], a measured curve into
//! [`recorded_curve::RecordedCurve`], a head or another body into [`obj_mesh::ObjMesh`] or [`distance_grid`]; simulated frames leave through
//! [`sequence::SequenceWriter`]. Every reader checks the lengths that a file states against the bytes that are there before it
//! asks for memory, and says what it found, where, and what it expected. Nothing here keeps a file open or shares state between
//! calls: all functions may be called from any thread.
mod bvh;
mod bytes;
pub mod curves;
pub mod distance_grid;
pub mod hair;
pub mod motion;
mod motion_csv;
pub mod obj;
mod obj_lines;
pub mod obj_mesh;
mod polygon;
pub mod recorded_curve;
pub mod sequence;
mod text;
pub mod tfx;
mod tfx_binary;
mod tfx_text;
