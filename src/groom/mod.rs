//! From measured and modelled hair to strands.
//!
//! Files:
//!
//! - `drawn.rs`: A groom as it was drawn: curves in metres, and the strands that rest as these curves are.
//! - `fit.rs`: A strand from a curve: the Super-Helix whose centreline comes closest at equal arclength.
//! - `guide_roots.rs`: The region that guides' roots stand in: how far they are apart, how near other places are to them, and places among them where no scalp is known.
//! - `hair_handle.rs`: Hair handle: what a hand feels of hair, as one structure of the three groups of properties that Bonanni and Kmoch 2008, section 2, name.
//! - `hair_parameters.rs`: What the strands of a head share, and the five sliders by which people change it.
//! - `hair_type.rs`: Kinds of hair as they were measured.
//! - `outside.rs`: Curves drawn inside a body, brought out of it: by the least that does, edge by edge from the root, every edge as long as it was.
//! - `polyline.rs`: A polyline by arclength: what a strand is fitted to.
//! - `pose.rs`: Strands posed by hand: dragged by a point, brushed, bent and turned element by element, cut, grown, mirrored.
//! - `render_hair.rs`: Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006, section 4.1.
//! - `rest_shape.rs`: Natural shapes that hold a strand where it is drawn: equilibrium is K(q − qⁿ) = f(q), hence qⁿ = q − K⁻¹ f(q).
//! - `scalp.rs`: A scalp: a triangle mesh on which follicles stand, and which may deform.
//! - `stability.rs`: Whether a strand that is held up in a shape stays in it when touched, and how much stiffer it must be to do so.
//! - `variation.rs`: How strands differ from each other and along themselves: seeded, the same whoever asks, in whatever order.
//! - `wisp.rs`: Wisps: a guide of a groom stands for the hairs around it, which lie and move together.

pub mod drawn;
pub mod fit;
pub mod guide_roots;
pub mod hair_handle;
pub mod hair_parameters;
pub mod hair_type;
pub mod outside;
pub mod polyline;
pub mod pose;
pub mod render_hair;
pub mod rest_shape;
pub mod scalp;
pub use crate::math::spline;
pub mod stability;
pub mod variation;
pub mod wisp;
