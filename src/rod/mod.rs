//! One strand at rest in itself: material, freedoms, kinematics.
pub mod freedoms;
pub mod material;
