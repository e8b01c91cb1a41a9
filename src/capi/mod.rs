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
//! - `allocator.rs`: The host's allocator, for the C libraries: a global allocator that goes to the system until the host gives its own.
//! - `attachment.rs`: Strands, bodies and constraints that follow one pose.
//! - `bodies.rs`: Bodies, which strands stay outside of.
//! - `body_def.rs`: Definitions of bodies.
//! - `buffers.rs`: The caller's memory: arrays, strided inputs and outputs, checked completely before anything is read or written.
//! - `constraints.rs`: Bilateral constraints: pins, clamps, ties and rings.
//! - `contact.rs`: Contact options, and contact parameters of strands.
//! - `contact_events.rs`: Contact begin and end events, in a buffer that the host drains.
//! - `contacts.rs`: The list of contacts at the end of the last substep.
//! - `curve_cache.rs`: Caches: curves over time with velocities, in one .usda file.
//! - `curve_data.rs`: Optional data of groom files beside the points: read from curves, written to files.
//! - `curves.rs`: Reads groom files, writes cache frames.
//! - `debug_draw.rs`: Debug drawing by callback.
//! - `distance_grid.rs`: Bakes meshes into signed distance grids.
//! - `errors.rs`: Result codes, and the text of the last error of each thread.
//! - `fit.rs`: Fits strands to polylines, and finds natural shapes that hold them up.
//! - `fit_curves.rs`: Fits strands to many curves at once.
//! - `floating_point.rs`: The floating-point mode: sets the default of IEEE 754 inside the library, and the host's own outside.
//! - `friction_fit.rs`: Fits friction coefficients to a recorded curve.
//! - `guard.rs`: The one guard that every entry point goes through: null handle, re-entry, poisoned state, floating-point mode, panics.
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, and the experiment that measures it.
//! - `hair_type.rs`: Hair types, sliders, and random variation between the strands of a head.
//! - `haptic.rs`: Haptic objects: a tool in a hand.
//! - `haptic_def.rs`: Definitions of haptic objects, and the state after an update.
//! - `haptic_ring_comb.rs`: Ring combs in the hand: a haptic object leads them, and the hand feels what the strands on their teeth pull with.
//! - `level_of_detail.rs`: Changes the number of elements of simulated strands.
//! - `log.rs`: Messages to the host.
//! - `materials.rs`: Materials of simulated strands.
//! - `motion.rs`: Samples a smooth motion through poses, for hosts that have recorded poses of a head.
//! - `output_transform.rs`: Output transforms from the engine's space to the host's: other units, other axes, mirrored.
//! - `overlaps.rs`: Overlaps of strands in the current scene, and permitted overlaps.
//! - `parallel.rs`: The host's task system behind the engine's `ParallelFor`.
//! - `pose_def.rs`: Definitions and options of posing, for the functions of `posing.rs`.
//! - `posing.rs`: Poses simulated strands: drag, brush, change elements, cut, grow, mirror.
//! - `push_out.rs`: Pushes curves out of a body.
//! - `render_def.rs`: Definitions of render hair and of its evaluation.
//! - `render_hair.rs`: Render hair: many strands from few guides.
//! - `restyling.rs`: Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.
//! - `ring_comb.rs`: Ring combs: their teeth hold the strands that they meet until these are combed.
//! - `roots.rs`: Roots: the host moves them, the strands follow.
//! - `sample_outputs.rs`: Sample outputs in the caller's memory: points, frames, velocities.
//! - `sampling.rs`: Samples strands: points, frames, velocities, and wrenches on follicles.
//! - `scalp.rs`: Follicles on a mesh: scattered, or by texture coordinates; their frames as the mesh deforms.
//! - `settings.rs`: Settings by name, and by permitted error.
//! - `settle.rs`: Puts strands at rest in their equilibrium under gravity.
//! - `shape.rs`: A strand's curvatures: natural ones, current ones, and their rates.
//! - `solver.rs`: Creates, steps and destroys a solver.
//! - `solver_def.rs`: Definitions of solvers.
//! - `solver_options.rs`: Reads and changes a solver's options.
//! - `spline.rs`: Samples cubic curves as points.
//! - `state.rs`: Snapshots of a solver's state, and a hash of it.
//! - `step.rs`: Steps, with or without limits, and their reports.
//! - `step_limits.rs`: Limits on the cost of a step.
//! - `strand_def.rs`: Definitions of strands.
//! - `strands.rs`: Adds, removes and lists strands, and reads properties of each.
//! - `styling.rs`: Styling: clips, scissors, hot plates and frozen styles.
//! - `styling_tool.rs`: Styling tools: their bodies, from a few numbers.
//! - `suggest.rs`: Suggests a number of elements for a strand.
//! - `summary.rs`: A one-line summary of a solver for the log.
//! - `targets.rs`: Targets: curves to which strands are drawn, with a weight along their length.
//! - `thread.rs`: Runs work on a separate thread.
//! - `types.rs`: Plain data that crosses the border.
//! - `version.rs`: The library's version and build.
//! - `versioned.rs`: Versioned structures, which may grow.
//! - `wind.rs`: Wind as a field.
//! - `wisp.rs`: Wisps: a guide of a groom represents the hairs around it.
//! - `wrenches.rs`: Writes wrenches on follicles and bodies to the caller's memory.
// Comments here are those of the C header too, plain text: ids[i] is not a link.
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(unsafe_code, non_camel_case_types)]
#![allow(clippy::missing_safety_doc)] // said once, above

pub mod allocator;
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
pub mod debug_draw;
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
pub mod haptic_ring_comb;
pub mod level_of_detail;
pub mod log;
pub mod materials;
pub mod motion;
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
pub mod targets;
mod thread;
pub mod types;
pub mod version;
mod versioned;
pub mod wind;
pub mod wisp;
mod wrenches;
