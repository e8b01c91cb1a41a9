//! Groom files, fits, hair types and scalps.
//!
//! Files:
//!
//! - `curve_cache.rs`: Caches: curves over time with velocities, in one .usda file.
//! - `curve_data.rs`: Optional data of groom files beside the points: read from curves, written to files.
//! - `curves.rs`: Reads groom files, writes cache frames.
//! - `fit.rs`: Fits strands to polylines, and finds natural shapes that hold them up.
//! - `fit_curves.rs`: Fits strands to many curves at once.
//! - `friction_fit.rs`: Fits friction coefficients to a recorded curve.
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, and the experiment that measures it.
//! - `hair_type.rs`: Hair types, sliders, and random variation between the strands of a head.
//! - `scalp.rs`: Follicles on a mesh: scattered, or by texture coordinates; their frames as the mesh deforms.
//! - `spline.rs`: Samples cubic curves as points.

pub mod curve_cache;
pub mod curve_data;
pub mod curves;
pub mod fit;
pub mod fit_curves;
pub mod friction_fit;
pub mod hair_handle;
pub mod hair_type;
pub mod scalp;
pub mod spline;
