//! A groom on the command line: its unit, statistics, material, and the strands made of it.
//!
//! Files:
//!
//! - `material_arguments.rs`: The material on the command line: a kind of hair, flags that change single values of it, and sliders.
//! - `statistics.rs`: Numbers about a groom: lengths, turning, what is degenerate, and what its unit may be.
//! - `stiffening_arguments.rs`: `--stiffen`: strands made stiff enough to rest as they are drawn.
//! - `strands.rs`: A groom's curves made into strands: what the flags ask for, and the strands that are left out.
//! - `unit.rs`: Metres a unit of a groom: what a flag says, else what the file says; and strands in metres.
//! - `wisp_arguments.rs`: What a guide of a groom stands for, on the command line.

pub mod material_arguments;
pub mod statistics;
pub mod stiffening_arguments;
pub mod strands;
pub mod unit;
pub mod wisp_arguments;
