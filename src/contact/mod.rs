//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod body;
pub mod shape;
pub mod strand_body;
pub mod touch;

mod descent;
mod element_path;
mod sweep;
