//! Numbers: lanes, entire functions, small vectors and matrices, quadrature, splines, rigid poses and their motion.
//!
//! Files:
//!
//! - `disjoint_sets.rs`: Disjoint sets of indices that are joined one by one (union and find, with paths halved).
//! - `entire.rs`: Stumpff's entire functions, from which a helix is made, exact through zero curvature.
//! - `frame.rs`: A rigid pose: the position and orientation of a strand's root or of one of its cross-sections.
//! - `lane.rs`: The number type of the kernels: one `f64`, or one number per strand, side by side in a vector register.
//! - `levenberg_marquardt.rs`: The loop of Levenberg and Marquardt's method: iterations of trial steps with more and more damping, until one of them lowers the cost.
//! - `nurbs.rs`: Points of rational B-splines of any order, by de Boor's algorithm.
//! - `point_spline.rs`: A path through points with continuous acceleration: the cubic spline.
//! - `point_tree.rs`: Nearest-point queries in space: a balanced k-d tree (Bentley 1975) in one array.
//! - `pose_motion.rs`: The motion of a pose that a host sends from frame to frame: bodies and the targets of constraints.
//! - `pose_spline.rs`: A smooth rigid motion through sampled poses.
//! - `prefetch.rs`: Memory prefetch: strands are scattered in memory, and waiting for each in turn takes longer than the work on it.
//! - `quadrature.rs`: Gauss–Legendre rules on [0, 1], and the choice of a rule for an element.
//! - `quadrature_limits.rs`: How far an element may turn for each Gauss–Legendre rule to integrate its inertia to a tolerance.
//! - `random.rs`: Stateless seeded random numbers.
//! - `rotation.rs`: Rotation vectors, and the smooth motion of a pose from one frame to the next.
//! - `spline.rs`: Cubic curves sampled as points, for grooms given by control points.
//! - `trigonometry.rs`: Sine and cosine with the same bits on every machine and at every lane width.
//! - `vector.rs`: 3-vectors and 3×3 matrices over lanes, for the kernels.
//! - `lanes/`: Packed numbers: one register of the machine's vector unit.

pub(crate) mod disjoint_sets;
pub mod entire;
pub mod frame;
pub mod lane;
pub mod lanes;
pub(crate) mod levenberg_marquardt;
pub mod nurbs;
pub mod point_spline;
pub(crate) mod point_tree;
pub mod pose_motion;
pub mod pose_spline;
pub(crate) mod prefetch;
pub mod quadrature;
mod quadrature_limits;
pub(crate) mod random;
pub mod rotation;
pub mod spline;
pub mod trigonometry;
pub mod vector;
