//! Combs, brushes, fingers, hot plates and barrels: their bodies, and combs that catch the strands they meet.
//!
//! ```
//! use superhelix::nalgebra::Vector3;
//! use superhelix::tools::{RingComb, RingCombOptions, Tool};
//! use superhelix::{Frame, Solver, SolverOptions, StrandDef};
//!
//! let mut solver = Solver::new(SolverOptions::default())?;
//! let ids = solver.add_strands(&[StrandDef::straight(0.2, 10)])?;
//! let at = |x: f64| Frame { origin: Vector3::new(x, 0.0, -0.05), ..Frame::default() };
//! let mut comb = RingComb::new(&Tool::COMB, &at(0.1), &RingCombOptions::default())?;
//! for step in 1..=10 {
//!     comb.before_step(&mut solver, &ids, &at(0.1 + 0.001 * f64::from(step)), 1.0 / 60.0)?;
//!     solver.step(1.0 / 60.0, 1)?;
//!     let report = comb.after_step(&mut solver)?;
//!     assert!(report.wrench.force.iter().all(|component| component.is_finite())); // N, on the comb
//! }
//! comb.release(&mut solver)?;
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::styling::tools::MAX_TEETH;
pub use crate::styling::{RingComb, RingCombOptions, RingCombReport, Tool};
