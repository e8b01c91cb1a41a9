//! Time integration of one strand.
pub mod options;
