//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod body;
mod body_sweep;
pub mod bonds;
pub mod contact_space;
mod descent;
mod element_path;
pub mod gauss_seidel;
pub mod grid;
mod ground;
pub mod hair_pairs;
pub mod held_strand;
pub mod helix_distance;
pub mod island;
pub mod joint;
pub mod law;
pub mod nearest;
pub mod options;
mod overlooked;
pub mod pieces;
mod rank;
pub mod segment_distance;
pub mod shape;
pub mod strand_body;
mod sweep;
pub mod system;
pub mod touch;
pub mod touches;
