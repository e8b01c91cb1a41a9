//! From measured and modelled hair to strands.
//!
//! Files:
//!
//! - `fit.rs`: Fits a strand to a curve: finds the Super-Helix whose centreline comes closest at equal arclength.
//! - `pose.rs`: Posing strands by hand: drag a point, brush, bend and turn elements, cut, grow, mirror.
//! - `render_hair.rs`: Render hair: a hundred thousand strands from a thousand guides, by the semi-interpolating scheme of Bertails et al. 2006, section 4.1.
//! - `rest_shape.rs`: Natural shapes that hold a strand in its drawn shape: equilibrium is K(q − qⁿ) = f(q), hence qⁿ = q − K⁻¹ f(q).
//! - `scalp.rs`: A scalp: a triangle mesh with follicles, which may deform.
//! - `stability.rs`: Whether a strand that is held up in a shape stays there when disturbed, and how much stiffer it must be to do so.
//! - `curves/`: Curves of a groom before they are strands: which can be used, which are guides, and where they are moved to.
//! - `hair/`: Kinds of hair: measured types, sliders, random variation, and what a hand feels.

pub mod curves;
pub mod fit;
pub mod hair;
pub mod pose;
pub mod render_hair;
pub mod rest_shape;
pub mod scalp;
pub use crate::math::splines::spline;
pub mod stability;
