//! The step of coupled strands: strands that contacts and bilateral constraints act on, in islands of those that constraints
//! couple. It knows nothing of a scene: the solver puts strands, constraints and bodies in, has Newton's iterations done, and reads
//! where strands end.
//!
//! Files:
//!
//! - `constrained_strand.rs`: A strand during a step in which contacts or bilateral constraints act on it.
//! - `contact_limit.rs`: The largest number of contacts of a strand.
//! - `coupled_step.rs`: The step of coupled strands: the strands that are constrained in it, their constraints, and their islands, since constraints couple strands.
//! - `coupling.rs`: Couples strands into islands by their constraints, at first and whenever new ones are found.
//! - `deep_strands.rs`: Strands that a soft model has left deep in bodies.
//! - `detection.rs`: Contact detection in a step: contacts of constrained strands with bodies and other strands, as constraints, and their warm start.
//! - `formula.rs`: The integration formula of constrained strands.
//! - `island.rs`: Islands: strands coupled by constraints, directly or through others.
//! - `iterations.rs`: Newton iterations of all islands.
//! - `nearest_pair.rs`: The depth of contacts between strands, and whether the strands are still there, from the points where the strands are nearest.
//! - `packs.rs`: Constrained strands side by side: their distribution to packs, and each half of an iteration pack by pack.
//! - `solitary.rs`: Newton iterations of strands that share no constraint with others: what touches them is bodies, or holds them in place.
//! - `stages.rs`: The stages of a coupled step and their order.

pub mod constrained_strand;
pub(crate) mod contact_limit;
pub(crate) mod coupled_step;
mod coupling;
mod deep_strands;
pub(crate) mod detection;
mod formula;
pub mod island;
pub(crate) mod iterations;
pub mod nearest_pair;
pub(crate) mod packs;
pub(crate) mod solitary;
mod stages;
