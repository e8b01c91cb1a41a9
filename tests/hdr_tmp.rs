//! Temporary.
#[path = "capi/header.rs"]
mod header;
