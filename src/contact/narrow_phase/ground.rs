//! The distance of a body from points of an element.

use std::cell::Cell;

use nalgebra::Vector3;

use super::descent::Sample;
use super::element_path::ElementPath;
use crate::contact::body_at::BodyAt;
use crate::contact::shape::{Ball, Kind, Mesh, Patch, Sides, Surface};

/// A node of an element, where the distance is sampled first.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Node {
    /// Arclength from the element's left end, m.
    pub s: f64,
    /// Position at the start of the step, in the body's axes then.
    pub before: Vector3<f64>,
    /// Position at the present iterate, in the body's axes at the end of the step.
    pub now: Vector3<f64>,
    /// Unit tangent there.
    pub tangent: Vector3<f64>,
    /// The surface found there.
    pub sample: Option<Sample<Surface>>,
    /// Set if no surface was sought: it is at least this far, m, and none is in reach between the node and its neighbours.
    pub far: Option<f64>,
}

/// What is needed for the distance of a point in the body's axes.
pub(in crate::contact) struct Ground<'a> {
    /// The body.
    pub body: &'a BodyAt<'a>,
    /// Its mesh, if it has one.
    pub mesh: Option<&'a Mesh>,
    /// The mesh's triangles about the element.
    pub patch: &'a Patch,
    /// The search distance of a mesh, m.
    pub reach: f64,
    /// The triangle that was nearest last.
    pub hint: Cell<Option<u32>>,
}

impl Ground<'_> {
    /// The surface nearest to `now`, for a point that was at `before`; `None` if it is further away than the reach.
    pub fn ask(&self, before: impl FnOnce() -> Vector3<f64>, now: Vector3<f64>, inside: Option<bool>) -> Option<Surface> {
        self.ask_among(&self.patch.near, before, now, inside)
    }

    /// [`Ground::ask`] if only some of a mesh's triangles can be nearest.
    pub fn ask_among(
        &self,
        balls: &[Ball],
        before: impl FnOnce() -> Vector3<f64>,
        now: Vector3<f64>,
        inside: Option<bool>,
    ) -> Option<Surface> {
        let Some(mesh) = self.mesh else {
            return match &self.body.shape.0 {
                Kind::Grid(grid) => grid.closest(now),
                _ => Some(self.body.shape.closest_smooth(now)),
            };
        };
        let mut surface = mesh.closest_among(balls, &self.hint, self.reach, inside, now)?;
        if mesh.sides() == Sides::Both {
            let before = before();
            // A path shorter than the distance at its end crosses nothing that is at rest.
            let short = !mesh.is_moving() && (now - before).norm_squared() < surface.distance * surface.distance;
            if !short && self.patch.is_crossed(mesh, &before, &now) {
                surface.distance = -surface.distance;
                surface.normal = -surface.normal;
            }
        }
        Some(surface)
    }

    /// [`Ground::ask_among`] for the point at an arclength of an element, as a sample there.
    pub fn sample_among(&self, balls: &[Ball], path: &ElementPath, s: f64, inside: Option<bool>) -> Option<Sample<Surface>> {
        let (now, tangent) = path.now.at(s);
        self.ask_among(balls, || path.start.at(s).0, now, inside).map(|surface| sample(s, surface, &tangent))
    }

    /// Whether the chord between two places goes through the surface of a solid mesh.
    pub fn is_pierced(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let solid = self.mesh.filter(|mesh| mesh.sides() == Sides::Solid);
        solid.is_some_and(|mesh| self.patch.is_pierced(mesh, from, to))
    }
}

/// The sample of a surface at a point of a curve.
pub(in crate::contact) fn sample(s: f64, found: Surface, tangent: &Vector3<f64>) -> Sample<Surface> {
    Sample { s, value: found.distance, slope: found.normal.dot(tangent), found }
}
