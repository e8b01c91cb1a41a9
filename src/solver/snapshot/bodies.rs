//! Bodies: shapes (each once, however many bodies share it), where they are and how they move.

use std::sync::Arc;

use nalgebra::Vector3;

use super::bytes::{Reader, Writer, bad, of_part};
use crate::contact::body::{Bending, Body, BodyDef};
use crate::contact::shape::{Mesh, Parts, Shape, Sides};
use crate::error::Result;
use crate::files::distance_grid;
use crate::solver::bodies::SceneBody;
use crate::solver::id::{BodyId, SlotMap};
use crate::solver::report::Wrench;

impl Writer {
    /// All bodies; `id` writes what stands at the end of each.
    pub fn bodies(&mut self, bodies: &[SceneBody], id: impl Fn(&mut Self, &SceneBody)) {
        let mut shapes: Vec<&Arc<Shape>> = Vec::new();
        let mut known = std::collections::HashMap::new();
        let mut of = Vec::with_capacity(bodies.len());
        for body in bodies {
            let shape = &body.body.def().shape;
            of.push(*known.entry(Arc::as_ptr(shape)).or_insert_with(|| {
                shapes.push(shape);
                shapes.len() as u32 - 1
            }));
        }
        self.u64(shapes.len() as u64);
        for shape in shapes {
            self.shape(shape);
        }
        self.u64(bodies.len() as u64);
        for (body, shape) in bodies.iter().zip(of) {
            self.u32(shape);
            self.body(body);
            id(self, body);
        }
    }

    fn body(&mut self, body: &SceneBody) {
        let SceneBody { body, wrench, .. } = body;
        let def = body.def();
        self.frame(&def.pose);
        self.f64(def.thickness);
        self.f64(def.friction);
        self.f64(def.viscous_friction);
        self.u32(def.group);
        self.u32(def.mask);
        self.way(body.way.going.as_ref());
        self.flag(body.bending.is_some());
        if let Some(bending) = body.bending.as_deref() {
            self.vectors(&bending.from);
            self.vectors(&bending.to);
            self.f64(bending.duration);
            self.f64(bending.elapsed);
        }
        self.vector(wrench.force);
        self.vector(wrench.torque);
    }

    fn shape(&mut self, shape: &Shape) {
        match shape.parts() {
            Parts::Sphere { radius } => {
                self.u32(1);
                self.f64(radius);
            }
            Parts::Capsule { a, b, radius } => {
                self.u32(2);
                self.vectors(&[a, b]);
                self.f64(radius);
            }
            Parts::Ellipsoid { semi_axes } => {
                self.u32(3);
                self.vector(semi_axes);
            }
            Parts::Cuboid { half_edges } => {
                self.u32(4);
                self.vector(half_edges);
            }
            Parts::HalfSpace { normal } => {
                self.u32(5);
                self.vector(normal);
            }
            Parts::Hull(mesh) => {
                self.u32(6);
                self.mesh(mesh);
            }
            Parts::Mesh(mesh) => {
                self.u32(7);
                self.mesh(mesh);
            }
            Parts::Grid(grid) => {
                self.u32(8);
                // Fails only for want of memory: then the image says so by holding no grid.
                let bytes = distance_grid::write_to_bytes(grid).unwrap_or_default();
                self.u64(bytes.len() as u64);
                self.0.extend_from_slice(&bytes);
            }
        }
    }

    fn mesh(&mut self, mesh: &Mesh) {
        let (sides, depth) = match mesh.sides() {
            Sides::Solid => (1, 0.0),
            Sides::Front { depth } => (2, depth),
            Sides::Both => (3, 0.0),
        };
        self.u32(sides);
        self.f64(depth);
        self.u64(mesh.triangles().len() as u64);
        mesh.triangles().iter().flatten().for_each(|vertex| self.u32(*vertex));
        self.u64(mesh.vertices().len() as u64);
        self.vectors(mesh.vertices());
        self.flag(mesh.is_moving());
        if mesh.is_moving() {
            self.vectors(mesh.vertices_before());
        }
    }
}

impl Reader<'_> {
    /// All bodies; `slots` are their identifiers'.
    pub fn bodies(&mut self, slots: &SlotMap<BodyId>) -> Result<Vec<SceneBody>> {
        let shapes = (0..self.count(4 + 8)?).map(|_| Ok(Arc::new(self.shape()?))).collect::<Result<Vec<_>>>()?;
        let count = self.count(4 + 7 * 8)?;
        (0..count)
            .map(|index| {
                let shape = self.u32()?;
                let Some(shape) = shapes.get(shape as usize) else {
                    return Err(bad(format!("body {index} has shape {shape} of {}", shapes.len())));
                };
                let (body, wrench) = self.body(shape.clone())?;
                Ok(SceneBody { id: self.id("body", slots, index)?, body, wrench })
            })
            .collect()
    }

    fn body(&mut self, shape: Arc<Shape>) -> Result<(Body, Wrench)> {
        let def = BodyDef {
            shape,
            pose: self.finite_frame("a body's pose")?,
            thickness: self.f64()?,
            friction: self.f64()?,
            viscous_friction: self.f64()?,
            group: self.u32()?,
            mask: self.u32()?,
        };
        let vertices = def.shape.mesh().map(|mesh| mesh.vertices().len());
        let deforms = matches!(def.shape.parts(), Parts::Mesh(_));
        let mut body = Body::new(def).map_err(|error| of_part("a body", &error))?;
        body.way.going = self.finite_way("a body's way")?;
        if self.flag()? {
            let count = vertices.filter(|_| deforms).ok_or_else(|| bad("a body deforms that is no mesh"))?;
            let (from, to) = (self.finite_vectors(count)?, self.finite_vectors(count)?);
            let (duration, elapsed) = (self.finite("a deformation")?, self.finite("a deformation")?);
            if duration < 0.0 || elapsed < 0.0 {
                return Err(bad(format!("a deformation takes {duration} s, of which {elapsed} are done")));
            }
            body.bending = Some(Box::new(Bending { from, to, duration, elapsed }));
        }
        Ok((body, Wrench { force: self.vector()?, torque: self.vector()? }))
    }

    fn shape(&mut self) -> Result<Shape> {
        let shape = match self.u32()? {
            1 => Shape::new_sphere(self.f64()?),
            2 => {
                let (a, b) = (self.vector()?, self.vector()?);
                Shape::new_capsule(a, b, self.f64()?)
            }
            3 => Shape::new_ellipsoid(self.vector()?),
            4 => Shape::new_box(self.vector()?),
            5 => Shape::half_space_of_unit(self.vector()?),
            6 => Shape::hull_of_mesh(self.mesh()?),
            7 => Ok(Shape::from(self.mesh()?)),
            8 => {
                let count = self.count(1)?;
                distance_grid::read_from_bytes("a distance grid", self.bytes(count)?).map(Shape::new_grid)
            }
            other => return Err(bad(format!("a shape is of sort {other}"))),
        };
        shape.map_err(|error| of_part("a shape", &error))
    }

    fn mesh(&mut self) -> Result<Mesh> {
        let (sides, depth) = (self.u32()?, self.f64()?);
        let sides = match sides {
            1 => Sides::Solid,
            2 => Sides::Front { depth },
            3 => Sides::Both,
            other => return Err(bad(format!("a mesh has sides {other}"))),
        };
        let count = self.count(3 * 4)?;
        let triangles = (0..count).map(|_| Ok([self.u32()?, self.u32()?, self.u32()?])).collect::<Result<Vec<_>>>()?;
        let count = self.count(3 * 8)?;
        let vertices = self.finite_vectors(count)?;
        let before = if self.flag()? { self.finite_vectors(count)? } else { vertices.clone() };
        Mesh::in_motion(before, vertices, triangles, sides).map_err(|error| of_part("a mesh", &error))
    }

    fn finite_vectors(&mut self, count: usize) -> Result<Vec<Vector3<f64>>> {
        (0..count).map(|_| self.finite_vector("a vertex")).collect()
    }
}
