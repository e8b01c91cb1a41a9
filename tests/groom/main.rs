//! From curves to strands and from guides to render hair: fits, rest shapes, hair types, posing, scalps.

mod fit_curves;
mod fit_polylines;
#[path = "../friction_cases/mod.rs"]
mod friction_cases;
mod friction_fit;
mod hair_types;
mod posing;
mod posing_living;
mod render_bodies;
mod render_hair;
mod render_image;
mod render_looks;
mod render_own_shapes;
mod rest_shapes;
mod scalp;
mod wisp;
