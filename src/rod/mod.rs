//! One strand at rest in itself: material, freedoms, kinematics.

pub mod definition;
pub mod freedoms;
pub mod kinematics;
pub mod material;
pub mod section;
pub mod segment;
pub mod strand;
pub mod turning;
pub mod uniform_points;
pub mod velocity;
