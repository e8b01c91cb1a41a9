//! Numbers: frames, entire functions, small vectors and matrices.
pub mod frame;
pub mod pose_spline;
