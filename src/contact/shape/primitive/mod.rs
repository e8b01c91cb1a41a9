//! Shapes given by a few numbers: the nearest point of each, exact.
//!
//! Files:
//!
//! - `capsule.rs`: Capsule: all points within a radius of a segment.
//! - `cuboid.rs`: Box about the origin, along the axes.
//! - `ellipsoid.rs`: Ellipsoid about the origin, along the axes: its exact nearest point.
//! - `half_space.rs`: Half of space, bounded by a plane through the origin.
//! - `sphere.rs`: Sphere about the origin.

pub(super) mod capsule;
pub(super) mod cuboid;
pub(super) mod ellipsoid;
pub(super) mod half_space;
pub(super) mod sphere;
