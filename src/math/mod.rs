//! Numbers: lanes, entire functions, small vectors and matrices, quadrature, splines, rigid poses and their motion.
//!
//! Files:
//!
//! - `disjoint_sets.rs`: Disjoint sets of indices that are joined one by one (union and find, with paths halved).
//! - `frame.rs`: A rigid pose: the position and orientation of a strand's root or of one of its cross-sections.
//! - `lane.rs`: The number type of the kernels: one `f64`, or one number per strand, side by side in a vector register.
//! - `levenberg_marquardt.rs`: The loop of Levenberg and Marquardt's method: iterations of trial steps with more and more damping, until one of them lowers the cost.
//! - `point_tree.rs`: Nearest-point queries in space: a balanced k-d tree (Bentley 1975) in one array.
//! - `prefetch.rs`: Memory prefetch: strands are scattered in memory, and waiting for each in turn takes longer than the work on it.
//! - `quadrature.rs`: Gauss–Legendre rules on [0, 1], and the choice of a rule for an element.
//! - `random.rs`: Stateless seeded random numbers.
//! - `rotation.rs`: Rotation vectors, and the smooth motion of a pose from one frame to the next.
//! - `vector.rs`: 3-vectors and 3×3 matrices over lanes, for the kernels.
//! - `functions/`: Functions of a number with the same bits on every machine.
//! - `lanes/`: Packed numbers: one register of the machine's vector unit.
//! - `splines/`: Splines through points and poses, and rational B-splines.

pub(crate) mod disjoint_sets;
pub mod frame;
pub mod functions;
pub mod lane;
pub mod lanes;
pub(crate) mod levenberg_marquardt;
pub(crate) mod point_tree;
pub(crate) mod prefetch;
pub mod quadrature;
pub(crate) mod random;
pub mod rotation;
pub mod splines;
pub mod vector;
