//! Numbers: lanes, entire functions, small vectors and matrices, quadrature, rigid poses and their motion.

pub mod entire;
pub mod frame;
pub mod lane;
pub mod lanes;
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
