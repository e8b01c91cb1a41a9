//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.

pub mod options;
pub mod touch;
