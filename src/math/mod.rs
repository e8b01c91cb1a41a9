//! Numbers: lanes, entire functions, small vectors and matrices, quadrature, rigid poses and their motion.
//!
//! Files:
//!
//! - `entire.rs`: The entire functions of which a helix is made, exact through zero curvature.
//! - `frame.rs`: A rigid pose: where a strand's root or one of its cross-sections sits and how it is turned.
//! - `lane.rs`: The number type that kernels are written over: one `f64`, or several strands side by side in a vector register.
//! - `levenberg_marquardt.rs`: The loop of Levenberg and Marquardt's method: iterations of trial steps with more and more damping, until one of them lowers the cost.
//! - `nurbs.rs`: Points of rational B-splines of any order, by de Boor's algorithm.
//! - `point_spline.rs`: A way through points with continuous acceleration: the cubic spline.
//! - `point_tree.rs`: Points in space, found by nearness: a balanced k-d tree (Bentley 1975) kept in one array.
//! - `pose_spline.rs`: A smooth rigid motion through samples of it.
//! - `prefetch.rs`: Asking for memory before it is needed: strands lie all over it, and waiting for each in turn takes longer than the work on it.
//! - `quadrature.rs`: Gauss–Legendre rules on [0, 1], and how many points a segment needs.
//! - `quadrature_limits.rs`: How far elements may turn for a Gauss–Legendre rule to integrate their inertia to a tolerance.
//! - `random.rs`: Seeded numbers without a state.
//! - `rotation.rs`: Rotation vectors, and the smooth motion of a pose from one frame to the next.
//! - `spline.rs`: Cubic curves made into points: what grooms that are given by control points are fitted through.
//! - `trigonometry.rs`: Sine and cosine of our own, so that every machine and every lane width gives the same bits.
//! - `vector.rs`: 3-vectors and 3×3 matrices over lanes, for the kernels.
//! - `way.rs`: A pose that a host sends from frame to frame: bodies and the targets of constraints.
//! - `lanes/`: Packed numbers: one register of the machine's vector unit, by its instructions.

pub mod entire;
pub mod frame;
pub mod lane;
pub mod lanes;
pub(crate) mod levenberg_marquardt;
pub mod nurbs;
pub mod point_spline;
pub(crate) mod point_tree;
pub mod pose_spline;
pub(crate) mod prefetch;
pub mod quadrature;
mod quadrature_limits;
pub(crate) mod random;
pub mod rotation;
pub mod spline;
pub mod trigonometry;
pub mod vector;
pub mod way;
