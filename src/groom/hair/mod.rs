//! Kinds of hair: measured types, sliders, random variation, and what a hand feels.
//!
//! Files:
//!
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, in the three groups of properties of Bonanni and Kmoch 2008, section 2: geometry, bending, friction.
//! - `hair_parameters.rs`: Parameters that the strands of a head share, and five high-level sliders that change them.
//! - `hair_type.rs`: Measured types of hair: four of Bertails et al. 2006, appendix B, and four of Bonanni and Kmoch 2008, table 1, whose source is Wortmann et al. 2006.
//! - `variation.rs`: Random variation between strands and along them: seeded, and independent of the order of queries.
//! - `wisp.rs`: Wisps: a guide of a groom represents the hairs around it, which lie and move together.

pub mod hair_handle;
pub mod hair_parameters;
pub mod hair_type;
pub mod variation;
pub mod wisp;
