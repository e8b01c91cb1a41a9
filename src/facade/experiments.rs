//! Experiments with strands: friction coefficients from a recorded motion, combing force, equilibria that buckle.

pub use crate::analysis::branch::{Branch, BranchEnd, BranchOptions, BranchPoint, Critical, CriticalKind, Load, follow, switch};
pub use crate::analysis::combing::{CombingCurve, CombingTest};
pub use crate::analysis::friction_fit::{
    Coefficient, FittedCoefficient, FrictionFit, FrictionFitOptions, LARGEST_RELATIVE_ERROR, Sought, Start, Verdict, fit_friction,
};
pub use crate::analysis::recording::{Observable, Recording, RootMotion};
