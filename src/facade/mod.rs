//! What Rust programs see: the public names, gathered from the modules that define them.
//!
//! Files:
//!
//! - `editing.rs`: What changes living strands: posing, cutting, growing, clips, heat, rest shapes, level of detail, attachments, targets.
//! - `experiments.rs`: Experiments with strands: friction coefficients from a recorded motion, combing force, equilibria that buckle.
//! - `hair.rs`: From measured and drawn hair to strands: kinds of hair, wisps, fits, scalps.
//! - `haptic.rs`: Force feedback: a tool in a hand, through a haptic device, in simulated hair.
//! - `io.rs`: Files: grooms, meshes, motions and distance grids in; caches of frames in and out.
//! - `reading.rs`: What a host reads back: points of strands in bulk, contact events, debug drawing, snapshots, compliance of strands at bodies.
//! - `render.rs`: Render hair: a hundred thousand strands that follow the simulated ones.
//! - `settings.rs`: Settings by the error that may be made: time steps, elements, tolerances that were measured to be good enough.
//! - `shapes.rs`: Shapes of bodies: primitives, hulls, triangle meshes, signed distance grids.
//! - `splines.rs`: Splines: curves from control points, poses over time.
//! - `tools.rs`: Combs, brushes, fingers, hot plates and barrels: their bodies, and combs that catch the strands they meet.

pub mod editing;
pub mod experiments;
pub mod hair;
pub mod haptic;
pub mod io;
pub mod reading;
pub mod render;
pub mod settings;
pub mod shapes;
pub mod splines;
pub mod tools;

pub use crate::contact::body::BodyDef;
pub use crate::contact::options::{ContactModel, ContactOptions, Friction, StrandContact};
pub use crate::contact::shape::Shape;
pub use crate::energy::Energies;
pub use crate::error::{Error, Result};
pub use crate::groom::curves::drawn::{Groom, GroomOptions};
pub use crate::groom::hair::wisp::Wisp;
pub use crate::math::frame::Frame;
pub use crate::math::lane::Precision;
pub use crate::math::lanes::InstructionSet;
pub use crate::meter::{StepLimits, Stopped, usual_work};
pub use crate::rod::definition::{MAX_ELEMENTS, StrandDef};
pub use crate::rod::freedoms::Freedoms;
pub use crate::rod::material::Material;
pub use crate::solver::bodies::{Contact, ContactPartner};
pub use crate::solver::constraints::{ConstraintDef, ConstraintState, ConstraintStatus, Hold};
pub use crate::solver::definition::{SolverOptions, UsualLimits};
pub use crate::solver::id::{BodyId, ConstraintId, StrandId};
pub use crate::solver::report::{ContactTally, Phases, Quadrature, StepReport, StrandStatus, Wrench};
pub use crate::solver::{Sample, Solver, WIND_BATCH, WindField};
pub use crate::step::options::{Integrator, LinearSolver, StepOptions};
pub use crate::workers::{ParallelFor, Workers};
