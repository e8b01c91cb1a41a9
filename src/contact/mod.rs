//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod bonds;
pub mod contact_space;
pub mod gauss_seidel;
pub mod grid;
pub mod hair_pairs;
pub mod held_strand;
pub mod helix_distance;
pub mod island;
pub mod joint;
pub mod law;
pub mod nearest;
pub mod options;
pub mod pieces;
mod rank;
pub mod segment_distance;
pub mod system;
pub mod touch;
pub mod touches;
