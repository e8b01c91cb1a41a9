//! The strands of a scene: their definitions, materials and elements, the motion of their roots, and what draws them.
//!
//! Files:
//!
//! - `editing.rs`: Edits strands: motions of roots, natural and current shapes, rest.
//! - `level_of_detail.rs`: Changes the number of elements of simulated strands.
//! - `materials.rs`: Materials of simulated strands: read, change, and stiffen as a shape requires.
//! - `population.rs`: The population of strands: add, remove, list.
//! - `sections.rs`: Sections that strands share: a new strand equal to one of the last few gets the same one.
//! - `strand.rs`: One strand of a solver: constants, state, the root's motion, and the result of the last step.
//! - `targets.rs`: Targets: curves, of a rig for example, to which strands are drawn with a weight along their length.

pub(crate) mod editing;
pub(super) mod level_of_detail;
pub(super) mod materials;
pub(super) mod population;
pub(super) mod sections;
pub(super) mod strand;
pub(super) mod targets;
