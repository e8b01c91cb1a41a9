//! Curves of a groom before they are strands: which can be used, which are guides, and where they are moved to.
//!
//! Files:
//!
//! - `apart.rs`: Moves curves apart that run through each other: guides that each stand for a wisp as thick as a pencil lead.
//! - `drawn.rs`: A groom as it was drawn: curves in metres, and the strands that rest as these curves are.
//! - `guide_choice.rs`: Chooses a few curves of a groom as guides: those from which the others can best be interpolated, as measured.
//! - `guide_roots.rs`: The region of the guides' roots: their spacing, the distance of other places from them, and random places among them where no scalp is known.
//! - `outside.rs`: Brings curves out of a body: a curve drawn inside it moves out by as little as possible, edge by edge from the root, and keeps every edge's length.
//! - `polyline.rs`: A polyline by arclength, the input of a fit.
//! - `rooting.rs`: Puts the roots of curves on a scalp: the first stretch of a curve bends after its root, the remainder stays where it is.
//! - `usable.rs`: Which strands of a file can be used, and why the others cannot.

pub mod apart;
pub mod drawn;
pub mod guide_choice;
pub mod guide_roots;
pub mod outside;
pub mod polyline;
pub mod rooting;
pub mod usable;
