//! From measured and modelled hair to strands.

pub mod fit;
pub mod polyline;
pub mod render_hair;
pub mod rest_shape;
pub mod scalp;
pub mod spline;
pub mod stability;
