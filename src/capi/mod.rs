//! The C ABI: opaque handles, definitions that can grow, result codes, and one guard on every entry point.
//!
//! `include/superhelix.h` is generated from this folder (`tests/capi/header.rs`), so the comments here address C programmers.
//! Nothing here is process-wide but the host's allocator: no table of solvers, no logger, no pool, no panic hook. The only thread-local variables (the
//! last error's text, the host's floating-point mode) have no destructor, which would keep the library mapped after `dlclose`.
//!
//! # Safety
//! Every function trusts its caller where a C function must: a pointer that is not null points to as many items as the
//! function's comment says, handles come from their create function and were not destroyed, and callbacks return normally.
//! Everything else is checked.
//!
//! Files:
//!
//! - `base/`: What every call goes through: the guard, errors, versioned structures, the caller's memory, messages and threads.
//! - `groom/`: Groom files, fits, hair types and scalps.
//! - `hair/`: Strands: their definitions, roots, shapes, materials, elements and rest.
//! - `reading/`: Samples of strands, wrenches, and debug drawing.
//! - `render/`: Render hair.
//! - `scene/`: Bodies, contact, constraints, and what moves together.
//! - `simulation/`: Solvers: their options, steps and reports, snapshots, settings, wind.
//! - `tools/`: Styling, posing, combs, and tools in a hand.
// Comments here are those of the C header too, plain text: ids[i] is not a link.
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(unsafe_code, non_camel_case_types)]
#![allow(clippy::missing_safety_doc)] // said once, above

pub mod base;
pub mod groom;
pub mod hair;
pub mod reading;
pub mod render;
pub mod scene;
pub mod simulation;
pub mod tools;
