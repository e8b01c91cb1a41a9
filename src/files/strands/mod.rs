//! Files of strands, a format a file, and what their readers share.
//!
//! Files:
//!
//! - `alembic.rs`: Alembic files (`.abc`, Ogawa): the curves of their first sample, in the world of the file.
//! - `hair.rs`: Cem Yuksel's `.hair` files.
//! - `numpy.rs`: NumPy's `.npy` and `.npz` files that hold strands: an array of strands by points by three, root first.
//! - `ply.rs`: Stanford `.ply` files as reconstructions of hair write them: text or binary, of either byte order.
//! - `point_strands.rs`: The strands of a point cloud: which points make up each strand, where the file does not say.
//! - `raw_strands.rs`: Strands as a file has them: of any number of points, none included, and of numbers that need not be finite.
//! - `strand_attributes.rs`: Numbers that a groom file has for each of its strands, by name: primvars of USD, parameters of Alembic, arrays of NumPy, properties of `.ply`.
//! - `strand_data.rs`: `.data` files of strands, as in the hair data sets of the University of Southern California and of Digital Salon.
//! - `tfx.rs`: TressFX `.tfx` files: tells the three versions apart, reads and writes them.
//! - `tfx_binary.rs`: TressFX 3 and 4 `.tfx` files: a header of numbers and byte offsets, then sections.
//! - `tfx_text.rs`: TressFX 2 `.tfx` files: text.

pub(super) mod alembic;
pub mod hair;
pub(super) mod numpy;
pub(super) mod ply;
pub mod point_strands;
pub mod raw_strands;
pub mod strand_attributes;
pub mod strand_data;
pub mod tfx;
pub(super) mod tfx_binary;
pub(super) mod tfx_text;
