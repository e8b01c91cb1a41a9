//! The step of coupled strands: strands that contacts and bilateral constraints act on, in islands of those that constraints
//! couple. It knows nothing of a scene: the solver puts strands, constraints and bodies in, has Newton's iterations done, and reads
//! where strands end.
//!
//! Files:
//!
//! - `constrained_strand.rs`: A strand during a step in which contacts or bilateral constraints act on it.
//! - `contact_limit.rs`: The largest number of contacts of a strand.
//! - `coupled_strands.rs`: The strands that are constrained in a step, and their islands: constraints couple strands, directly or through others.
//! - `dormant.rs`: Dormant contacts, left out of an island's contact problems for a while.
//! - `ending.rs`: How islands' iterations end: further attempts for islands that have not converged.
//! - `formula.rs`: The integration formula of constrained strands.
//! - `island.rs`: Islands: strands coupled by constraints, directly or through others.
//! - `island_problem.rs`: The contact problem of an island's Newton iteration: the constraints in it, and its solution.
//! - `iterations.rs`: Newton iterations of all islands.
//! - `kink.rs`: Strands that lie exactly along what presses them.
//! - `nearest_pair.rs`: The depth of contacts between strands, from the points where the strands are nearest.
//! - `packs.rs`: Constrained strands side by side: their distribution to packs, and each half of an iteration pack by pack.
//! - `pushing.rs`: Removes the depth of yielding contacts.
//! - `solitary.rs`: Newton iterations of strands that share no constraint with others: what touches them is bodies, or holds them in place.

pub mod constrained_strand;
pub(crate) mod contact_limit;
pub(crate) mod coupled_step;
pub(crate) mod detection;
mod dormant;
pub mod ending;
mod formula;
pub mod island;
pub mod island_problem;
pub(crate) mod iterations;
pub mod kink;
pub mod nearest_pair;
pub(crate) mod packs;
mod pushing;
pub(crate) mod solitary;
mod stages;
