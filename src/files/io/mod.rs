//! Whole files, bytes, and lines of text.
//!
//! Files:
//!
//! - `bytes.rs`: Reading and writing whole files, and little-endian numbers in bytes.
//! - `part_file.rs`: Part files: a file is written under a hidden name beside its target, so that no reader ever sees half of it.
//! - `text.rs`: Lines and words of text files, with line numbers for errors.

pub(super) mod bytes;
pub mod part_file;
pub(super) mod text;
