//! The linear systems of one strand: the linear-time elimination from tip to root, and the dense reference it is tested against.
//!
//! Files:
//!
//! - `axes.rs`: The free curvatures as a constant of the kernels: what no free curvature needs is not computed at all.
//! - `delassus.rs`: The Delassus operator of a strand, J H⁻¹ Jᵀ: how far its stations move under forces at them.
//! - `dense.rs`: The dense reference: the whole 3N×3N matrix assembled from Jacobians and second derivatives, solved by Cholesky's factorisation.
//! - `displacement.rs`: How the points move, to first order, when the curvatures change: J δκ, in one pass from root to tip.
//! - `downstream.rs`: The elimination of `super::elimination`, whose symbols are used, for least squares over a strand: fits and poses.
//! - `elimination.rs`: The linear-time solve: elimination from tip to root, then one pass from root to tip.
//! - `force.rs`: Generalised forces: what forces on the points are to the curvatures, f = Σ Jᵀ f_p, in one pass from tip to root.
//! - `load.rs`: Forces on material points between the quadrature points, and on points held out from the strand by a rigid lever.
//! - `pivot.rs`: The small symmetric pivots of the elimination: Cholesky's factorisation, and the repair of one that is not positive definite.
//! - `reduced.rs`: An element's freedoms once they are eliminated, and their changes from the left end's: the forward and the back substitution of the solves.
//! - `response.rs`: The direction that forces at stations lead strands in whose system is eliminated.
//! - `system.rs`: The quadratic model of one strand that the linear solves share: what pulls at the quadrature points and at the curvatures.

pub(crate) mod axes;
pub mod delassus;
pub mod dense;
pub mod displacement;
pub(crate) mod downstream;
pub mod elimination;
pub mod force;
pub mod load;
pub mod pivot;
pub(crate) mod reduced;
pub mod response;
pub mod system;
