//! One strand at rest in itself: material, freedoms, kinematics.
//!
//! Files:
//!
//! - `definition.rs`: What a host says to make a strand.
//! - `freedoms.rs`: Which of a strand's curvatures may change: what a scene requires.
//! - `kinematics.rs`: Where all the quadrature points of a strand are, from the curvatures and the root's rotation: one pass from root to tip.
//! - `material.rs`: What a strand is made of: section, material, dissipation; and the stiffnesses and densities along it that follow.
//! - `section.rs`: What strands of one kind have in common: section, material, freedoms, and the numbers that follow from them.
//! - `segment.rs`: Kinematics of one helical segment in the frame of its left end, and its first and second variations.
//! - `strand.rs`: What does not change about a strand while it moves: its elements, its material, its natural shape, its freedoms.
//! - `turning.rs`: How far elements turn: a helix cannot bend its own axis, so that a tight coil needs about four elements a turn.
//! - `uniform_points.rs`: Where points of several strands are, worked out side by side: the way of reading a whole groom.
//! - `velocity.rs`: Velocities and velocity-product accelerations along a strand from the rates of its curvatures.

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
