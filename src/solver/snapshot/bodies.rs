//! Bodies in a snapshot: shapes (each once, however many bodies share it), poses and motions.

use std::sync::Arc;

use nalgebra::Vector3;

use super::SnapshotShapes;
use super::bytes::{Reader, Writer, bad, of_part};
use crate::contact::body::{Bending, Body, BodyDef};
use crate::contact::shape::{Mesh, Parts, Shape, Sides};
use crate::error::Result;
use crate::files::distance_grid;
use crate::solver::bodies::SceneBody;
use crate::solver::id::{BodyId, SlotMap};
use crate::solver::report::Wrench;

/// Marks a shape that is stored elsewhere, by its content's hash.
const REFERENCE: u32 = 9;

impl Writer {
    /// All bodies, with static shapes as `shapes` says; `id` writes the end of each.
    pub fn bodies(&mut self, bodies: &[SceneBody], shapes: SnapshotShapes, id: impl Fn(&mut Self, &SceneBody)) {
        let mut owners: Vec<&SceneBody> = Vec::new();
        let mut known = std::collections::HashMap::new();
        let mut of = Vec::with_capacity(bodies.len());
        for body in bodies {
            of.push(*known.entry(Arc::as_ptr(&body.body.def().shape)).or_insert_with(|| {
                owners.push(body);
                owners.len() as u32 - 1
            }));
        }
        self.u64(owners.len() as u64);
        for owner in owners {
            match (shapes, owner.content()) {
                (SnapshotShapes::Referenced, Some(content)) => {
                    self.u32(REFERENCE);
                    self.content(content);
                }
                _ => self.shape(&owner.body.def().shape),
            }
        }
        self.u64(bodies.len() as u64);
        for (body, shape) in bodies.iter().zip(of) {
            self.u32(shape);
            self.body(body);
            id(self, body);
        }
    }

    /// A content's hash.
    pub fn content(&mut self, content: u128) {
        self.bytes(&content.to_le_bytes());
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
        self.pose_move(body.motion.going.as_ref());
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

    pub fn shape(&mut self, shape: &Shape) {
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
                let size = distance_grid::size(grid.counts());
                self.u64(size as u64);
                if !self.only_counts(size) {
                    distance_grid::write_in_pieces(grid, |piece| self.bytes(piece));
                }
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
    /// All bodies; `slots` are their identifiers', `find` finds shapes stored elsewhere.
    pub fn bodies(&mut self, slots: &SlotMap<BodyId>, find: &dyn Fn(u128) -> Result<Arc<Shape>>) -> Result<Vec<SceneBody>> {
        let shapes = (0..self.count(4 + 8)?).map(|_| self.owned_shape(find)).collect::<Result<Vec<_>>>()?;
        let count = self.count(4 + 7 * 8)?;
        (0..count)
            .map(|index| {
                let shape = self.u32()?;
                let Some((shape, content)) = shapes.get(shape as usize) else {
                    return Err(bad(format!("body {index} has shape {shape} of {}", shapes.len())));
                };
                let (body, wrench) = self.body(shape.clone())?;
                let body = SceneBody { wrench, ..SceneBody::new(self.id("body", slots, index)?, body) };
                let deforms = self.flag()?;
                if deforms && body.body.def().shape.mesh().is_none() {
                    return Err(bad("a body deforms that is not a mesh"));
                }
                if let Some(content) = content.filter(|_| !deforms) {
                    body.content.get_or_init(|| content);
                }
                Ok(SceneBody { deforms, user_data: self.u64()?, ..body })
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
        body.motion.going = self.finite_pose_move("a body's motion")?;
        if self.flag()? {
            let count = vertices.filter(|_| deforms).ok_or_else(|| bad("a body deforms that is not a mesh"))?;
            let (from, to) = (self.finite_vectors(count)?, self.finite_vectors(count)?);
            let (duration, elapsed) = (self.finite("a deformation")?, self.finite("a deformation")?);
            if duration < 0.0 || elapsed < 0.0 {
                return Err(bad(format!("a deformation takes {duration} s, of which {elapsed} are done")));
            }
            body.bending = Some(Box::new(Bending { from, to, duration, elapsed }));
        }
        Ok((body, Wrench { force: self.vector()?, torque: self.vector()? }))
    }

    /// A shape, and its content's hash if known.
    fn owned_shape(&mut self, find: &dyn Fn(u128) -> Result<Arc<Shape>>) -> Result<(Arc<Shape>, Option<u128>)> {
        match self.u32()? {
            REFERENCE => {
                let content = u128::from_le_bytes(self.take()?);
                Ok((find(content)?, Some(content)))
            }
            sort => Ok((Arc::new(self.shape_of_sort(sort)?), None)),
        }
    }

    /// A shape stored in full.
    pub fn shape(&mut self) -> Result<Shape> {
        let sort = self.u32()?;
        self.shape_of_sort(sort)
    }

    fn shape_of_sort(&mut self, sort: u32) -> Result<Shape> {
        let shape = match sort {
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
            other => return Err(bad(format!("a shape has type {other}"))),
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
