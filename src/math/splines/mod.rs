//! Splines through points and poses, and rational B-splines.
//!
//! Files:
//!
//! - `nurbs.rs`: Points of rational B-splines of any order, by de Boor's algorithm.
//! - `point_spline.rs`: A path through points with continuous acceleration: the cubic spline.
//! - `pose_spline.rs`: A smooth rigid motion through sampled poses.
//! - `spline.rs`: Cubic curves sampled as points, for grooms given by control points.

pub mod nurbs;
pub mod point_spline;
pub mod pose_spline;
pub mod spline;
