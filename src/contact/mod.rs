//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod grid;
pub mod hair_pairs;
pub mod helix_distance;
pub mod pieces;
pub mod segment_distance;
pub mod touch;
pub mod touches;
