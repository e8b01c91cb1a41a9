//! From measured and modelled hair to strands.
//!
//! Files:
//!
//! - `apart.rs`: Moves curves apart that run through each other: guides that each stand for a wisp as thick as a pencil lead.
//! - `drawn.rs`: A groom as it was drawn: curves in metres, and the strands that rest as these curves are.
//! - `fit.rs`: Fits a strand to a curve: finds the Super-Helix whose centreline comes closest at equal arclength.
//! - `guide_choice.rs`: Chooses a few curves of a groom as guides: those from which the others can best be interpolated, as measured.
//! - `guide_roots.rs`: The region of the guides' roots: their spacing, the distance of other places from them, and random places among them where no scalp is known.
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, in the three groups of properties of Bonanni and Kmoch 2008, section 2: geometry, bending, friction.
//! - `hair_parameters.rs`: Parameters that the strands of a head share, and five high-level sliders that change them.
//! - `hair_type.rs`: Measured types of hair: four of Bertails et al. 2006, appendix B, and four of Bonanni and Kmoch 2008, table 1, whose source is Wortmann et al. 2006.
//! - `outside.rs`: Brings curves out of a body: a curve drawn inside it moves out by as little as possible, edge by edge from the root, and keeps every edge's length.
//! - `polyline.rs`: A polyline by arclength, the input of a fit.
//! - `pose.rs`: Posing strands by hand: drag a point, brush, bend and turn elements, cut, grow, mirror.
//! - `render_hair.rs`: Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006, section 4.1.
//! - `rest_shape.rs`: Natural shapes that hold a strand in its drawn shape: equilibrium is K(q − qⁿ) = f(q), hence qⁿ = q − K⁻¹ f(q).
//! - `rooting.rs`: Puts the roots of curves on a scalp: the first stretch of a curve bends after its root, the remainder stays where it is.
//! - `scalp.rs`: A scalp: a triangle mesh with follicles, which may deform.
//! - `stability.rs`: Whether a strand that is held up in a shape stays there when disturbed, and how much stiffer it must be to do so.
//! - `usable.rs`: Which strands of a file can be used, and why the others cannot.
//! - `variation.rs`: Random variation between strands and along them: seeded, and independent of the order of queries.
//! - `wisp.rs`: Wisps: a guide of a groom represents the hairs around it, which lie and move together.

pub mod apart;
pub mod drawn;
pub mod fit;
pub mod guide_choice;
pub mod guide_roots;
pub mod hair_handle;
pub mod hair_parameters;
pub mod hair_type;
pub mod outside;
pub mod polyline;
pub mod pose;
pub mod render_hair;
pub mod rest_shape;
pub mod rooting;
pub mod scalp;
pub use crate::math::spline;
pub mod stability;
pub mod usable;
pub mod variation;
pub mod wisp;
