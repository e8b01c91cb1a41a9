//! Contact and bilateral constraints: bodies and hair against hair. Where strands are touched, and the forces that answer.
//!
//! Files:
//!
//! - `across_edge.rs`: A strand across an edge of a solid: the separating plane.
//! - `bilateral_elimination.rs`: Direct elimination of bilateral constraints.
//! - `block_newton.rs`: All contacts of one block (a strand, or strands joined by bilateral constraints) at once, with those of other blocks fixed.
//! - `body.rs`: Bodies: shapes that strands stay outside of, with their poses and motions.
//! - `body_sweep.rs`: Collisions of an element with a body during a step (`sweep.rs`, piece by piece).
//! - `broad_phase.rs`: Which boxes of many overlap: a uniform grid, sorted by counting.
//! - `conjugate.rs`: Gauss–Seidel sweeps over a problem's subdomains side by side, accelerated.
//! - `constrained_strand.rs`: A strand during a step in which contacts or bilateral constraints act on it.
//! - `contact_point.rs`: Contact points: a material point of a strand, a strand's curve at one time, and a contact point between a strand and its partner.
//! - `contact_space.rs`: The contact-space problem: the strands' responses at their attached points, and the constraints between these.
//! - `dense.rs`: Small dense systems of equations.
//! - `descent.rs`: The minimum of a distance along a curve between a point where it falls and one where it rises.
//! - `dormant.rs`: Dormant contacts, left out of an island's contact problems for a while.
//! - `element_path.rs`: One element during a step as seen from a body: its points at the start and at the present iterate in the body's axes.
//! - `ending.rs`: How islands' iterations end: further attempts for islands that have not converged.
//! - `gauss_seidel.rs`: The contact-space problem solved by nonsmooth block Gauss–Seidel.
//! - `ground.rs`: The distance of a body from points of an element.
//! - `hair_pairs.rs`: Pairs of strands that may be in contact, kept from step to step, and their contacts.
//! - `helix_distance.rs`: Closest points of two pieces of helices: exact, by Newton's iteration from the closest points of their chords.
//! - `island.rs`: Islands: strands coupled by constraints, directly or through others.
//! - `island_problem.rs`: The contact problem of an island's Newton iteration: the constraints in it, and its solution.
//! - `kink.rs`: Strands that lie exactly along what presses them.
//! - `law.rs`: The laws of constraints, each with its exact solve for one constraint alone.
//! - `nearest.rs`: The point of a strand that is nearest to a point, from one nearby.
//! - `nearest_pair.rs`: The depth of contacts between strands, from the points where the strands are nearest.
//! - `options.rs`: Options of contact: the model, its tolerances, and the contact properties of strands.
//! - `partition.rs`: Divides a large problem into subdomains that threads sweep side by side.
//! - `patch.rs`: Patches: where sweeps over a large problem make no progress it is for a few closely coupled contacts.
//! - `path_clearance.rs`: Whether a strand that has stepped unconstrained stayed clear of a body all the time: a bound on the distance, piece by piece and time by time.
//! - `permitted_overlap.rs`: Permitted overlaps of a strand with others and with bodies, along its length.
//! - `pieces.rs`: Strands cut into pieces that bend little, each represented by its chord: the input of the search for pairs.
//! - `point_surfaces.rs`: The surfaces of bodies that a strand's quadrature points may touch, for contact at points (`step/point_contacts.rs`).
//! - `pushing.rs`: Removes the depth of yielding contacts.
//! - `rank.rs`: Cholesky's factorisation of a positive semidefinite matrix with pivoting: rows that depend on others are left out.
//! - `segment_distance.rs`: Closest points of two straight segments.
//! - `sides.rs`: Whether two moving pieces of strands plainly keep their sides to each other.
//! - `step_constraint.rs`: Constraints of one step: a contact of a strand with a body or another strand, or a part of a bilateral constraint.
//! - `strand_body.rs`: Contacts of a strand's elements with a body.
//! - `strand_contacts.rs`: Contacts between two strands, from pairs of their pieces, exact on the helices.
//! - `subdomains.rs`: The subdomains of a large problem, a binary tree.
//! - `sweep.rs`: Collisions of a moving piece of a strand.
//! - `system.rs`: The contact-space problem prepared for iteration.
//! - `undetected_overlap.rs`: Overlap of a piece of a strand with a mesh between the sampled points, which sampling leaves undetected.
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
pub mod point_surfaces;
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
