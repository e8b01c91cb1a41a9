//! One strand by itself: material, freedoms, kinematics.
//!
//! Files:
//!
//! - `definition.rs`: The definition of a strand, as a host gives it.
//! - `freedoms.rs`: Which of a strand's curvatures may change.
//! - `kinematics.rs`: Positions of all quadrature points of a strand, from the curvatures and the root's rotation: one pass from root to tip.
//! - `material.rs`: The material and section of a strand, and the stiffnesses and densities that follow.
//! - `section.rs`: What strands of one make share: section, material, freedoms, and the numbers that follow from them.
//! - `segment.rs`: Kinematics of one helical segment in the frame of its left end, and its first and second variations.
//! - `strand.rs`: The constants of a strand: its elements, material, natural shape and freedoms.
//! - `target.rs`: The target of a strand: a curve in motion to which the strand is drawn, with a weight along it.
//! - `turning.rs`: How far elements turn: a helix cannot bend its own axis, so a tight coil needs about four elements per turn.
//! - `uniform_points.rs`: Points of several strands side by side: how a whole groom is read at once.
//! - `velocity.rs`: Velocities and velocity-product accelerations along a strand from the rates of its curvatures.

pub mod definition;
pub mod freedoms;
pub mod kinematics;
pub mod material;
pub mod section;
pub mod segment;
pub mod strand;
pub mod target;
pub mod turning;
pub mod uniform_points;
pub mod velocity;
