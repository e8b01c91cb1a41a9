//! Integrators: one method of time stepping a file, and what they share.
//!
//! Files:
//!
//! - `dynamics.rs`: The equations of motion in the curvatures, M(q) q̈ = f(q, q̇, t), as a residual and its derivatives.
//! - `linearly_implicit.rs`: The linearly implicit step of the papers (Bertails et al. 2006, section 3.4; Bergbom 2007, section 4.2.8), with its second-order terms.
//! - `local_error.rs`: The error that one step adds to the positions of a strand's points, estimated from the step itself, world axes (Milne's device; Hairer, Nørsett and Wanner 1993, section III.7).
//! - `radau.rs`: Radau IIA of three stages (order 5, L-stable, stiffly accurate) on M(q) q̈ = f(q, q̇, t).
//! - `reference.rs`: The reference integrator: Radau IIA of order 5 in the curvatures, with step doubling.
//! - `stages.rs`: Runge–Kutta steps as minimisations.
//! - `tableau.rs`: Singly diagonally implicit Runge–Kutta methods, stiffly accurate and L-stable, that share one Newton.

pub mod dynamics;
pub mod linearly_implicit;
pub mod local_error;
pub mod radau;
pub mod reference;
pub mod stages;
pub mod tableau;
