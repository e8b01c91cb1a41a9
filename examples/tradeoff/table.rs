//! src/study/measured.rs from tradeoff.csv.
use std::path::Path;

pub fn write(_directory: &Path) {}
