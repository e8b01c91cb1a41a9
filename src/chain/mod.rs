//! The linear systems of one strand: the linear-time elimination from tip to root, and the dense reference it is tested against.

pub(crate) mod axes;
pub mod delassus;
pub mod dense;
pub mod displacement;
pub(crate) mod downstream;
pub mod elimination;
pub mod force;
pub mod load;
pub mod pivot;
pub mod response;
pub mod system;
