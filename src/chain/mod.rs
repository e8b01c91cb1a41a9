//! The linear systems of one strand: the linear-time elimination from tip to root, and the dense reference it is tested against.
//!
//! Files:
//!
//! - `axes.rs`: The free curvatures as a compile-time constant of the kernels: a kernel computes nothing for a frozen curvature.
//! - `delassus.rs`: The Delassus operator of a strand, J H⁻¹ Jᵀ: how far its loaded material points move under forces at them.
//! - `dense.rs`: The dense reference: the whole 3N×3N matrix, assembled from Jacobians and second derivatives.
//! - `displacement.rs`: Displacements of the points to first order in a change of the curvatures, J δκ: one pass from root to tip.
//! - `downstream.rs`: The elimination along a strand for least squares (fits and poses), with the symbols of `super::elimination`.
//! - `elimination.rs`: The linear-time solve: elimination from tip to root, then one pass from root to tip.
//! - `force.rs`: Generalised forces of forces on the points, f = Σ Jᵀ f_p: one pass from tip to root.
//! - `load.rs`: Loads at material points: forces between the quadrature points, or at the end of a rigid lever, from contacts and constraints.
//! - `response.rs`: The direction that forces at material points add to an eliminated system: one pass from the points to the root and one back, in linear time.
//! - `system.rs`: The quadratic model of one strand that the linear solves share: springs and forces at the quadrature points and at the curvatures.

pub(crate) mod axes;
pub mod delassus;
pub mod dense;
pub mod displacement;
pub(crate) mod downstream;
pub mod elimination;
pub mod force;
pub mod load;
pub mod response;
pub mod system;
