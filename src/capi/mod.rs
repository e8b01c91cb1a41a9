//! The C ABI: opaque handles, definitions that can grow, result codes, and one guard on every entry point.
//!
//! `include/superhelix.h` is generated from this floor (`tests/capi/header.rs`), so the comments here are written for the C
//! programmer who reads it there. Nothing here is process-wide but the host's allocator: no table of solvers, no logger, no pool, no panic hook, and the
//! only thread-local variables (the last error's text, the host's floating-point mode) have no destructor, since one would keep
//! the library mapped after `dlclose`.
//!
//! # Safety
//! Every function trusts its caller in what a C function must: a pointer that is not null points to as many items as the
//! function's comment says, handles come from their create function and were not destroyed, and callbacks return normally.
//! Everything else is checked.
//!
//! Files:
//!
//! - `allocator.rs`: The host's allocator, for the C libraries: a global allocator that goes to the system until the host gives its own.
//! - `attachment.rs`: Strands, bodies and constraints that follow one pose.
//! - `bodies.rs`: Bodies: what strands are kept out of.
//! - `body_def.rs`: What a body is made from.
//! - `buffers.rs`: The caller's memory: arrays, strided inputs and outputs.
//! - `constraints.rs`: Hard constraints: pins, clamps, ties and rings.
//! - `contact.rs`: How contact is answered, and what strands are to it.
//! - `contact_events.rs`: Contacts that begin and end, in a buffer that the host drains.
//! - `contacts.rs`: The list of contacts: where something met strands at the end of the last substep.
//! - `curve_cache.rs`: Caches: curves over time with velocities, in one .usda file.
//! - `curve_data.rs`: All that groom files may say beside the points: out of curves, and into files.
//! - `curves.rs`: Groom files in, cache frames out.
//! - `debug_draw.rs`: Debug drawing by callback.
//! - `distance_grid.rs`: Meshes baked into signed distance grids.
//! - `errors.rs`: Result codes, and the text of the last error of each thread.
//! - `fit.rs`: Strands from polylines, and natural shapes that hold them up.
//! - `fit_curves.rs`: Strands from many curves at once.
//! - `floating_point.rs`: The floating-point mode: a host may have set flush-to-zero, another rounding direction or trapping exceptions.
//! - `friction_fit.rs`: Friction coefficients from a recorded curve.
//! - `guard.rs`: The one guard that every entry point goes through: null handle, re-entry, poisoned state, floating-point mode, panics.
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, and the experiment that measures it.
//! - `hair_type.rs`: Kinds of hair, sliders, and the strands of a head that vary.
//! - `haptic.rs`: Haptic objects: a tool in a hand.
//! - `haptic_def.rs`: What a haptic object is made from, and what an update tells.
//! - `level_of_detail.rs`: Living strands on more or fewer elements.
//! - `log.rs`: Messages to the host.
//! - `materials.rs`: Materials of living strands.
//! - `output_transform.rs`: From the engine's space to the host's: other units, other axes, mirrored.
//! - `overlaps.rs`: What strands overlap as they are, and having it allowed.
//! - `parallel.rs`: The host's task system behind the engine's `ParallelFor`.
//! - `pose_def.rs`: How strands are posed: what the calls of `posing.rs` are told.
//! - `posing.rs`: Living strands posed: dragged, brushed, an element changed, cut, grown, mirrored.
//! - `push_out.rs`: Curves drawn inside a body, pushed out of it.
//! - `render_def.rs`: What render hair is made from, and how it is evaluated.
//! - `render_hair.rs`: Render hair: many strands from few guides.
//! - `restyling.rs`: Shapes taken as they are: as natural shapes, as rest shapes under gravity, as shapes to come back to.
//! - `ring_comb.rs`: Combs whose teeth hold the strands that they meet until these are combed.
//! - `roots.rs`: Roots: the host moves them, the strands follow.
//! - `sample_outputs.rs`: The three places in the caller's memory that samples go to.
//! - `sampling.rs`: Where strands are: points, frames, velocities, and what they do to their follicles.
//! - `scalp.rs`: Follicles on a mesh: scattered, or by texture coordinates; their frames as the mesh deforms.
//! - `settings.rs`: Settings by name and by error: what to choose without reading the price list.
//! - `settle.rs`: Static rest: strands put into their equilibrium under gravity.
//! - `shape.rs`: A strand's curvatures: natural ones, present ones, and their rates.
//! - `solver.rs`: Making, stepping and freeing a solver.
//! - `solver_def.rs`: What a solver is made from.
//! - `solver_options.rs`: The options of a living solver.
//! - `spline.rs`: Cubic curves made into points.
//! - `state.rs`: The whole state of a solver: images of it, and a hash.
//! - `step.rs`: Steps, within limits or not, and what they report.
//! - `step_limits.rs`: What a step may cost.
//! - `strand_def.rs`: What a strand is made from.
//! - `strands.rs`: Adding, removing and listing strands, and what can be asked of each.
//! - `styling.rs`: Styling: clips, scissors, hot plates, and styles that are fixed.
//! - `styling_tool.rs`: Styling tools: their bodies, from a few numbers.
//! - `suggest.rs`: How many elements a strand needs.
//! - `summary.rs`: A solver in one line, for a reader who wants to know once what runs.
//! - `thread.rs`: Work on a thread of its own.
//! - `types.rs`: Plain data that crosses the border.
//! - `version.rs`: Which library this is.
//! - `versioned.rs`: Structures that may grow.
//! - `wind.rs`: Wind as a field.
//! - `wisp.rs`: Wisps: what a guide of a groom stands for.
//! - `wrenches.rs`: Wrenches into the caller's memory: those on follicles and those on bodies.
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
pub mod wind;
pub mod wisp;
mod wrenches;
