//! `superhelix simulate`: what the hair touches.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use nalgebra::Vector3;
use serde::Serialize;
use superhelix::contact::body::BodyDef;
use superhelix::contact::options::{ContactModel, ContactOptions, StrandContact};
use superhelix::contact::shape::{Shape, Sides};
use superhelix::files::obj_mesh;
use superhelix::math::frame::Frame;
use superhelix::solver::Solver;
use superhelix::solver::id::{BodyId, StrandId};

use crate::argument_values::{not_negative, positive};
use crate::failure::Failure;
use crate::head::Head;
use crate::scene::contact::MODELS;
use crate::surface::Surface;

/// What the hair touches, and how that is answered.
#[derive(Debug, Args)]
pub struct BodyArguments {
    /// A mesh that moves with the head and keeps the hair out: .obj with faces, in the groom's units and axes. Closed, or open (a bust):
    /// then it keeps hair in front of its faces.
    #[arg(long, value_name = "MESH.obj")]
    body: Option<PathBuf>,
    /// How far behind the faces of an open mesh hair is still pushed to the front, m. Default: 0.02.
    #[arg(long, value_name = "METRES", requires = "body", value_parser = positive)]
    body_depth: Option<f64>,
    /// How touches are answered: penalty, regularised or coulomb (docs/scene_format.md). Default: coulomb.
    #[arg(long, value_name = "MODEL", value_parser = model)]
    contact: Option<ContactModel>,
    /// Strands touch each other: the radius of the wisp that each stands for, m.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    hair_contact: Option<f64>,
    /// So much of each strand, from its root, touches nothing, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = not_negative)]
    exempt: f64,
    /// What the groom overlaps as it is drawn, strands in strands and in the body, is allowed: only what comes on top of it is kept apart.
    #[arg(long)]
    allow_overlaps: bool,
}

fn model(text: &str) -> Result<ContactModel, String> {
    let names: Vec<&str> = MODELS.iter().map(|(name, _)| *name).collect();
    let found = MODELS.iter().find(|(name, _)| *name == text);
    found.map(|(_, model)| *model).ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

/// What the report says of it.
#[derive(Debug, Clone, Serialize)]
pub struct BodyReport {
    /// The mesh's path.
    pub mesh: String,
    /// Its triangles.
    pub triangles: usize,
    /// Which sides of it keep hair off: "solid" or "front".
    pub sides: &'static str,
}

/// A mesh on the head.
#[derive(Debug)]
pub struct HeadBody {
    shape: Arc<Shape>,
    /// What the report says of it.
    pub report: BodyReport,
}

impl BodyArguments {
    /// Whether anything touches the hair.
    pub fn touches(&self) -> bool {
        self.body.is_some() || self.hair_contact.is_some()
    }

    /// How contact is answered.
    pub fn options(&self) -> ContactOptions {
        let defaults = ContactOptions::default();
        ContactOptions { model: self.contact.unwrap_or(defaults.model), hair: self.hair_contact.is_some(), ..defaults }
    }

    /// Reads the mesh, in metres a unit of `scale`.
    pub fn read(&self, scale: f64) -> Result<Option<HeadBody>, Failure> {
        let Some(path) = &self.body else { return Ok(None) };
        let file = obj_mesh::read(path)?;
        let vertices: Vec<Vector3<f64>> = file.vertices.iter().map(|vertex| vertex * scale).collect();
        let depth = self.body_depth.unwrap_or(0.02);
        // A mesh that holds a volume is solid, unless a depth says that only its front is meant.
        let solid = match self.body_depth {
            None => Shape::new_mesh(vertices.clone(), file.triangles.clone(), Sides::Solid).ok(),
            Some(_) => None,
        };
        let (shape, sides) = match solid {
            Some(shape) => (shape, "solid"),
            None => {
                let shape = Shape::new_mesh(vertices, file.triangles.clone(), Sides::Front { depth });
                (shape.map_err(|error| Failure::file(path, error))?, "front")
            }
        };
        let report = BodyReport { mesh: path.display().to_string(), triangles: file.triangles.len(), sides };
        Ok(Some(HeadBody { shape: Arc::new(shape), report }))
    }

    /// Gives strands their contact, `own` but for what these arguments say, and adds the body.
    pub fn begin(
        &self,
        solver: &mut Solver,
        strands: &[StrandId],
        own: StrandContact,
        body: Option<&HeadBody>,
    ) -> Result<Option<BodyId>, Failure> {
        if !self.touches() {
            return Ok(None);
        }
        let wisp_radius = self.hair_contact.unwrap_or(0.0);
        let contact = StrandContact { wisp_radius, exempt_length: self.exempt, ..own };
        solver.set_contact(strands, Some(&contact))?;
        let bodies = body.map(|body| BodyDef::new(Arc::clone(&body.shape)));
        let added = solver.add_bodies(bodies.into_iter().collect())?;
        if self.allow_overlaps {
            solver.allow_overlaps(strands)?;
        }
        Ok(added.first().copied())
    }
}

impl HeadBody {
    /// Where it is, `elapsed` seconds after the start: its axes are the world's at the start.
    pub fn pose(head: &Head, elapsed: f64) -> Frame {
        let mut frames = Vec::with_capacity(1);
        head.roots(elapsed, &[Frame::default()], &mut frames);
        frames[0]
    }

    /// Its surface `elapsed` seconds after the start, world, m.
    pub fn surface(&self, head: &Head, elapsed: f64) -> Surface {
        let pose = Self::pose(head, elapsed);
        let mesh = self.shape.mesh().map(|mesh| (mesh.vertices(), mesh.triangles()));
        let (vertices, triangles) = mesh.unwrap_or_default();
        Surface { vertices: vertices.iter().map(|at| pose.origin + pose.rotation * at).collect(), triangles: triangles.to_vec() }
    }
}
