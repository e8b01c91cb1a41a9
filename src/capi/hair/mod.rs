//! Strands: their definitions, roots, shapes, materials, elements and rest.
//!
//! Files:
//!
//! - `level_of_detail.rs`: Changes the number of elements of simulated strands.
//! - `materials.rs`: Materials of simulated strands.
//! - `motion.rs`: Samples a smooth motion through poses, for hosts that have recorded poses of a head.
//! - `restyling.rs`: Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.
//! - `roots.rs`: Roots: the host moves them, the strands follow.
//! - `settle.rs`: Puts strands at rest in their equilibrium under gravity.
//! - `shape.rs`: A strand's curvatures: natural ones, current ones, and their rates.
//! - `strand_def.rs`: Definitions of strands.
//! - `strands.rs`: Adds, removes and lists strands, and reads properties of each.
//! - `targets.rs`: Targets: curves to which strands are drawn, with a weight along their length.
//! - `wisp.rs`: Wisps: a guide of a groom represents the hairs around it.

pub mod level_of_detail;
pub mod materials;
pub mod motion;
pub mod restyling;
pub mod roots;
pub mod settle;
pub mod shape;
pub mod strand_def;
pub mod strands;
pub mod targets;
pub mod wisp;
