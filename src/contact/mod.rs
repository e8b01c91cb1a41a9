//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod bonds;
pub mod contact_space;
pub mod gauss_seidel;
pub mod law;
pub mod options;
mod rank;
pub mod system;
pub mod touch;
