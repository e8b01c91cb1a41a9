//! A shape taken apart, for images of a scene, and put together again to the bit.

use nalgebra::Vector3;

use super::{DistanceGrid, Kind, Mesh, Shape, Sides};
use crate::error::{Error, Result};

/// What a shape is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Parts<'a> {
    Sphere { radius: f64 },
    Capsule { a: Vector3<f64>, b: Vector3<f64>, radius: f64 },
    Ellipsoid { semi_axes: Vector3<f64> },
    Cuboid { half_edges: Vector3<f64> },
    HalfSpace { normal: Vector3<f64> },
    Hull(&'a Mesh),
    Mesh(&'a Mesh),
    Grid(&'a DistanceGrid),
}

impl Shape {
    /// What it is made of.
    pub(crate) fn parts(&self) -> Parts<'_> {
        match &self.0 {
            Kind::Sphere { radius } => Parts::Sphere { radius: *radius },
            Kind::Capsule { a, b, radius } => Parts::Capsule { a: *a, b: *b, radius: *radius },
            Kind::Ellipsoid { semi_axes } => Parts::Ellipsoid { semi_axes: *semi_axes },
            Kind::Cuboid { half_edges } => Parts::Cuboid { half_edges: *half_edges },
            Kind::HalfSpace { normal } => Parts::HalfSpace { normal: *normal },
            Kind::Hull(mesh) => Parts::Hull(mesh),
            Kind::Mesh(mesh) => Parts::Mesh(mesh),
            Kind::Grid(grid) => Parts::Grid(grid),
        }
    }

    /// A half-space whose normal is a unit vector already: normalising again would change its bits.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the normal's length is not 1 within rounding.
    pub(crate) fn half_space_of_unit(normal: Vector3<f64>) -> Result<Self> {
        if (normal.norm() - 1.0).abs() <= 1e-12 {
            Ok(Self(Kind::HalfSpace { normal }))
        } else {
            Err(Error::invalid("normal", format!("{:?}", normal.as_slice()), "a unit vector"))
        }
    }

    /// A hull from the mesh that it was made into.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the mesh is not closed.
    pub(crate) fn hull_of_mesh(mesh: Mesh) -> Result<Self> {
        match mesh.sides() {
            Sides::Solid => Ok(Self(Kind::Hull(mesh))),
            other => Err(Error::invalid("sides", format!("{other:?}"), "Solid")),
        }
    }
}
