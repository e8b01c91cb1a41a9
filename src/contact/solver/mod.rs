//! The contact-space problem and its solution: the forces with which all laws hold.
//!
//! Files:
//!
//! - `bilateral_elimination.rs`: Direct elimination of bilateral constraints.
//! - `block_newton.rs`: All contacts of one block (a strand, or strands joined by bilateral constraints) at once, with those of other blocks fixed.
//! - `conjugate.rs`: Gauss–Seidel sweeps over a problem's subdomains side by side, accelerated.
//! - `contact_space.rs`: The contact-space problem: the strands' responses at their attached points, and the constraints between these.
//! - `dense.rs`: Small dense systems of equations.
//! - `gauss_seidel.rs`: The contact-space problem solved by nonsmooth block Gauss–Seidel.
//! - `patch.rs`: Patches: where sweeps over a large problem make no progress it is for a few closely coupled contacts.
//! - `rank.rs`: Cholesky's factorisation of a positive semidefinite matrix with pivoting: rows that depend on others are left out.
//! - `sparse_newton.rs`: Newton's iteration on all contacts of a large problem at once, for where its forces are nearly right.
//! - `subdomains.rs`: The subdomains of a large problem, a binary tree.
//! - `system.rs`: The contact-space problem prepared for iteration.

pub mod bilateral_elimination;
pub(super) mod block_newton;
pub(super) mod conjugate;
pub mod contact_space;
pub(super) mod dense;
pub mod gauss_seidel;
pub(super) mod patch;
pub(super) mod rank;
pub(super) mod sparse_newton;
pub mod subdomains;
pub mod system;
