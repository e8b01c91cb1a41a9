//! What changes living strands: posing, cutting, growing, clips, heat, rest shapes, level of detail, attachments, targets.
//!
//! These are the arguments and results of methods of [`Solver`](crate::Solver).
//!
//! ```
//! use superhelix::editing::{DragTarget, EquilibriumOptions, Growth, PoseOptions, Stiffening};
//! use superhelix::nalgebra::Vector3;
//! use superhelix::{Solver, SolverOptions, StrandDef};
//!
//! let mut solver = Solver::new(SolverOptions::default())?;
//! let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
//!
//! // Let it hang, cut it, and drag its tip to a place.
//! let found = solver.settle(&ids, &EquilibriumOptions::default())?;
//! assert!(found[0].converged);
//! solver.cut(&ids, &[0.15])?;
//! let target = DragTarget { arclength: 0.15, position: Vector3::new(0.08, 0.02, -0.06) };
//! let dragged = solver.drag(&ids, &[target], &PoseOptions::default())?;
//! assert!(dragged[0].distance < 1e-3);
//!
//! // Take that shape as the style: stiff enough to rest in it.
//! let scales = solver.stiffen(&ids, Stiffening::YoungsModulus, 0.05)?;
//! assert!(scales[0] >= 1.0);
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::contact::permitted_overlap::PermittedOverlap;
pub use crate::groom::pose::{
    Brush, Brushed, DragTarget, Dragged, ElementChange, Growth, Plane, PoseOptions, StrandShape, mirrored,
};
pub use crate::groom::stability::{Stability, Stiffening, stability_under_gravity};
pub use crate::math::rotation::PoseMove;
pub use crate::rod::target::definition::TargetDef;
pub use crate::rod::turning::{Coarse, LARGEST_TURN, Shapes, coarse_strands, largest_turn};
pub use crate::solver::Overlap;
pub use crate::solver::attachment::Attachment;
pub use crate::solver::shaping::clips::ClipDef;
pub use crate::solver::shaping::heating::{HeatDef, HeatedShape};
pub use crate::solver::shaping::scissors::Cut;
pub use crate::step::equilibrium::{Equilibrium, EquilibriumOptions};
pub use crate::step::regrid::Regrid;
