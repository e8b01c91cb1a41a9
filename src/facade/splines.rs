//! Splines: curves from control points, poses over time.
//!
//! ```
//! use superhelix::Frame;
//! use superhelix::nalgebra::Vector3;
//! use superhelix::splines::PoseSpline;
//!
//! let at = |x: f64| Frame { origin: Vector3::new(x, 0.0, 0.0), ..Frame::default() };
//! let motion = PoseSpline::new(vec![0.0, 1.0, 2.0], vec![at(0.0), at(0.1), at(0.2)])?;
//! assert!((motion.at(1.5).origin.x - 0.15).abs() < 1e-12);
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::math::splines::pose_spline::PoseSpline;
pub use crate::math::splines::spline::{MAX_POINTS_PER_SPAN, Spline, SplineEnds, SplineKind};
