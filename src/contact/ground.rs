//! What lies under an element: the body's distance at places of it.

use std::cell::Cell;

use nalgebra::Vector3;

use super::body::BodyAt;
use super::descent::Sample;
use super::shape::{Ball, Kind, Mesh, Patch, Sides, Surface};

/// A node of an element: the element is looked at there first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Arclength from the element's left end, m.
    pub s: f64,
    /// Where it was at the step's start, in the body's axes then.
    pub before: Vector3<f64>,
    /// Where it is, in the body's axes at the step's end.
    pub now: Vector3<f64>,
    /// Unit tangent there.
    pub tangent: Vector3<f64>,
    /// What was found there.
    pub sample: Option<Sample<Surface>>,
    /// What its distance is at least where nothing was found: the reach, or so much that nothing lies between it and its neighbours.
    pub clear: Clear,
}

/// What is known of a node where no surface was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Clear {
    /// The surface is farther than the reach.
    OfReach,
    /// The surface is at least this far, m, and nothing is in reach between the node and its neighbours.
    Of(f64),
}

/// What is asked for the distance of a point in the body's axes.
pub(super) struct Ground<'a> {
    /// The body.
    pub body: &'a BodyAt<'a>,
    /// Its mesh, if it is one.
    pub mesh: Option<&'a Mesh>,
    /// The mesh's triangles about the element.
    pub patch: &'a Patch,
    /// How far a mesh is looked at, m.
    pub reach: f64,
    /// The triangle found nearest last.
    pub hint: Cell<Option<u32>>,
}

impl Ground<'_> {
    /// The surface nearest to `now`, for a point that was at `before`; None if it is farther than the reach.
    pub fn ask(&self, before: impl FnOnce() -> Vector3<f64>, now: Vector3<f64>, inside: Option<bool>) -> Option<Surface> {
        self.ask_among(&self.patch.near, before, now, inside)
    }

    /// [`Ground::ask`] where of a mesh's triangles only some can be nearest.
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
            // A way shorter than the distance at its end crosses nothing that is at rest.
            let short = !mesh.is_moving() && (now - before).norm_squared() < surface.distance * surface.distance;
            if !short && self.patch.is_crossed(mesh, &before, &now) {
                surface.distance = -surface.distance;
                surface.normal = -surface.normal;
            }
        }
        Some(surface)
    }

    /// Whether the chord between two places goes through the surface of a solid mesh.
    pub fn is_pierced(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let solid = self.mesh.filter(|mesh| mesh.sides() == Sides::Solid);
        solid.is_some_and(|mesh| self.patch.is_pierced(mesh, from, to))
    }
}

/// What was found at a place of a curve.
pub(super) fn sample(s: f64, found: Surface, tangent: &Vector3<f64>) -> Sample<Surface> {
    Sample { s, value: found.distance, slope: found.normal.dot(tangent), found }
}
