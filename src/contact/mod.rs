//! Contact and constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.
//!
//! Files:
//!
//! - `across_edge.rs`: A strand across an edge of a solid: the plane that holds it off.
//! - `bilateral_elimination.rs`: Bonds solved directly.
//! - `block_newton.rs`: All touches of one block (a strand, or strands that bonds join) at once, those of other blocks as they are.
//! - `body.rs`: Bodies: what strands are kept out of, where they are and how they move.
//! - `body_sweep.rs`: Where an element of a strand runs into a body on its way through a step (`sweep.rs`, piece by piece).
//! - `broad_phase.rs`: Which boxes of many overlap: a uniform grid, sorted by counting.
//! - `conjugate.rs`: Sweeps of Gauss–Seidel over a problem's parts side by side, accelerated.
//! - `constrained_strand.rs`: A strand in the course of a step in which touches or constraints hold it: its stations, and what the joints of its island make of them.
//! - `contact_point.rs`: The words of contact: a material point of a strand, a strand's curve at one time, and a touch, which is where something meets it.
//! - `contact_space.rs`: The problem in contact space: how the touched points of every strand answer to forces, and which touches there are.
//! - `dense.rs`: Small dense systems of equations.
//! - `descent.rs`: The minimum of a distance along a curve between two places where it falls and rises.
//! - `dormant.rs`: Touches that have no part in an island's contact problems for a while.
//! - `element_path.rs`: One element during a step as seen from a body: its points at the start and at the present iterate in the body's axes.
//! - `ending.rs`: How islands' iterations end; what is tried where one does not come to its end.
//! - `gauss_seidel.rs`: The contact-space problem solved by nonsmooth block Gauss–Seidel.
//! - `ground.rs`: What lies under an element: the body's distance at places of it.
//! - `hair_pairs.rs`: Hair against hair: which strands may touch, kept from step to step, and where they do.
//! - `helix_distance.rs`: Closest points of two pieces of helices: exact, by Newton's iteration from the closest points of their chords.
//! - `island.rs`: Strands that joints tie together, directly or through others.
//! - `island_problem.rs`: The contact problem of an island's Newton iteration: which joints have a part in it, and its solution.
//! - `kink.rs`: Strands that lie exactly along what presses them.
//! - `law.rs`: The laws that touches obey, each with its exact solve for one touch alone.
//! - `nearest.rs`: The point of a strand that is nearest to a point, from one nearby.
//! - `nearest_pair.rs`: Where two strands are nearest each other near a touch, and how deep they are in each other there.
//! - `options.rs`: How contact is answered, and what strands and bodies are to it.
//! - `partition.rs`: A large problem in parts that threads sweep side by side.
//! - `patch.rs`: Where sweeps over a large problem do not get on it is for a few touches that hang together closely.
//! - `path_clearance.rs`: Whether a strand that has stepped freely stayed clear of a body all the way: a bound on the distance, place by place and time by time.
//! - `permitted_overlap.rs`: How far a strand may be in others and in bodies, place by place.
//! - `pieces.rs`: Strands cut into pieces that bend little, each known by its chord: what the search for pairs works on.
//! - `pushing.rs`: Touches that give way are brought out after all, where there is a way.
//! - `rank.rs`: Cholesky's factorisation of a positive semidefinite matrix with pivots by size: rows that depend on others are left out.
//! - `segment_distance.rs`: Closest points of two straight segments.
//! - `sides.rs`: Whether two moving pieces of strands plainly keep their sides to each other.
//! - `step_constraint.rs`: What holds strands at stations during a step: a touch with a body or another strand, a constraint's part.
//! - `strand_body.rs`: Strand against body: where a strand's elements touch a body, or soon may.
//! - `strand_contacts.rs`: Where two strands touch, or soon may: from pairs of their pieces, exact on the helices.
//! - `subdomains.rs`: The parts of a large problem, a binary tree.
//! - `sweep.rs`: Where a piece of a strand runs into something on its way through a step.
//! - `system.rs`: The contact-space problem made ready for iteration.
//! - `undetected_overlap.rs`: Where a piece of a strand overlaps a mesh between the places that were looked at.
//! - `shape/`: Shapes of bodies, in their own axes: where their surface is nearest to a point, how large they are.

mod across_edge;
pub mod bilateral_elimination;
mod block_newton;
pub mod body;
mod body_sweep;
pub mod broad_phase;
mod conjugate;
pub mod constrained_strand;
pub mod contact_point;
pub mod contact_space;
mod dense;
mod descent;
mod dormant;
mod element_path;
pub mod ending;
pub mod gauss_seidel;
mod ground;
pub mod hair_pairs;
pub mod helix_distance;
pub mod island;
pub mod island_problem;
pub mod kink;
pub mod law;
pub mod nearest;
pub mod nearest_pair;
pub mod options;
mod partition;
mod patch;
pub mod path_clearance;
pub mod permitted_overlap;
pub mod pieces;
mod pushing;
mod rank;
pub mod segment_distance;
pub mod shape;
mod sides;
pub mod step_constraint;
pub mod strand_body;
pub mod strand_contacts;
mod subdomains;
mod sweep;
pub mod system;
mod undetected_overlap;
