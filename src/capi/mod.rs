//! The C ABI: opaque handles, definitions that can grow, result codes, and one guard on every entry point.
//!
//! `include/superhelix.h` is generated from this floor (`tests/capi/header.rs`), so the comments here are written for the C
//! programmer who reads it there. Nothing here is process-wide: no table of solvers, no logger, no pool, no panic hook, and the
//! only thread-local variables (the last error's text, the host's floating-point mode) have no destructor, since one would keep
//! the library mapped after `dlclose`.
//!
//! # Safety
//! Every function trusts its caller in what a C function must: a pointer that is not null points to as many items as the
//! function's comment says, handles come from their create function and were not destroyed, and callbacks return normally.
//! Everything else is checked.
// Comments here are those of the C header too, plain text: ids[i] is not a link.
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(unsafe_code, non_camel_case_types)]
#![allow(clippy::missing_safety_doc)] // said once, above

pub mod attachment;
pub mod bodies;
pub mod body_def;
mod buffers;
pub mod constraints;
pub mod contact;
pub mod contact_events;
pub mod contacts;
pub mod curve_cache;
pub mod curve_data;
pub mod curves;
pub mod distance_grid;
pub mod errors;
pub mod fit;
pub mod fit_curves;
mod floating_point;
pub mod friction_fit;
pub mod guard;
pub mod hair_handle;
pub mod hair_type;
pub mod haptic;
pub mod haptic_def;
pub mod level_of_detail;
pub mod log;
pub mod materials;
mod output_transform;
pub mod overlaps;
pub mod parallel;
pub mod pose_def;
pub mod posing;
pub mod push_out;
pub mod render_def;
pub mod render_hair;
pub mod restyling;
pub mod ring_comb;
pub mod roots;
mod sample_outputs;
pub mod sampling;
pub mod scalp;
pub mod settings;
pub mod settle;
pub mod shape;
pub mod solver;
pub mod solver_def;
pub mod solver_options;
pub mod spline;
pub mod state;
pub mod step;
pub mod step_limits;
pub mod strand_def;
pub mod strands;
pub mod styling;
pub mod styling_tool;
pub mod suggest;
mod summary;
mod thread;
pub mod types;
pub mod version;
mod versioned;
pub mod wisp;
mod wrenches;
