//! From measured and modelled hair to strands.

pub mod fit;
pub mod guide_roots;
pub mod hair_handle;
pub mod hair_parameters;
pub mod hair_type;
pub mod outside;
pub mod polyline;
pub mod pose;
pub mod render_hair;
pub mod rest_shape;
pub mod scalp;
pub use crate::math::spline;
pub mod stability;
pub mod variation;
pub mod wisp;
