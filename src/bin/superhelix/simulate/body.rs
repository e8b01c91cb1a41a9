//! `superhelix simulate`: what the hair touches.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use serde::Serialize;
use superhelix::hair::GroomStrand;
use superhelix::io::obj_mesh;
use superhelix::shapes::Sides;
use superhelix::{BodyDef, BodyId, ContactModel, ContactOptions, Frame, Material, Shape, Solver, StrandContact, StrandId};

use crate::scene::contact::MODELS;
use crate::shell::argument_values::{not_negative, positive};
use crate::shell::failure::Failure;
use crate::stepping::drawn_inside::{Becomes, DrawnInside};
use crate::stepping::head::Head;
use crate::surfaces::baked_body;
use crate::surfaces::baked_body::Baked;
use crate::surfaces::surface::Surface;

/// What the hair touches, and how that is answered.
#[derive(Debug, Args)]
pub struct BodyArguments {
    /// A mesh that moves with the head and keeps the hair out: .obj with faces, in the groom's units and axes. Closed, or open (a bust):
    /// then it keeps hair in front of its faces.
    #[arg(long, value_name = "MESH.obj")]
    body: Option<PathBuf>,
    /// What the mesh becomes: a grid of distances, which costs the same however fine it is and is kept beside it for the next time, or the mesh
    /// itself. Default: a grid where the mesh has an inside (open at the neck is no matter).
    #[arg(long, value_enum, value_name = "WHAT", requires = "body")]
    body_as: Option<BodyAs>,
    /// Distance of the grid's nodes, m: what is finer is rounded off. Default: a hundredth of the body's longest side, 1 to 5 mm.
    #[arg(long, value_name = "METRES", requires = "body", value_parser = positive)]
    body_cell: Option<f64>,
    /// How far behind the faces of an open mesh hair is still pushed to the front, m: of a mesh that is not made a grid. Default: 0.02.
    #[arg(long, value_name = "METRES", requires = "body", value_parser = positive)]
    body_depth: Option<f64>,
    /// How touches are answered: penalty, regularised, at_points or coulomb (docs/reference/scene_format.md). Default: coulomb.
    #[arg(long, value_name = "MODEL", value_parser = model)]
    contact: Option<ContactModel>,
    /// Strands touch each other: the radius of the wisp that each stands for, m.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    hair_contact: Option<f64>,
    /// So much of each strand, from its root, touches nothing, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = not_negative)]
    exempt: f64,
    /// What becomes of strands that are drawn inside the body. What is left of that, and strands drawn into each other, may stay as they begin,
    /// unless they are parted: only what comes on top of it is kept apart.
    #[arg(long, value_enum, value_name = "WHAT", default_value_t = Becomes::BroughtOut)]
    drawn_inside: Becomes,
    /// The same as --drawn-inside kept.
    #[arg(long, conflicts_with = "drawn_inside")]
    allow_overlaps: bool,
}

/// What a mesh becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BodyAs {
    /// A grid of signed distances.
    Grid,
    /// The mesh itself.
    Mesh,
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
    /// What keeps hair off: "grid", a "solid" mesh, or the "front" of one.
    pub sides: &'static str,
    /// Distance of the grid's nodes, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<f64>,
    /// Where the grid is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<String>,
}

/// A mesh on the head.
#[derive(Debug)]
pub struct HeadBody {
    shape: Arc<Shape>,
    vertices: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
    /// What the report says of it.
    pub report: BodyReport,
}

impl BodyArguments {
    /// The mesh's file.
    pub fn path(&self) -> Option<&Path> {
        self.body.as_deref()
    }

    /// Whether anything touches the hair.
    pub fn touches(&self) -> bool {
        self.body.is_some() || self.hair_contact.is_some()
    }

    /// Whether what is drawn inside is brought out before it is made a strand.
    pub fn brings_out(&self) -> bool {
        self.becomes() == Becomes::BroughtOut
    }

    fn becomes(&self) -> Becomes {
        if self.allow_overlaps { Becomes::Kept } else { self.drawn_inside }
    }

    /// What strands of this material are to contact: `hair` is what one of their hairs is.
    pub fn contact(&self, hair: StrandContact, material: &Material) -> StrandContact {
        let [a1, a2] = material.radius;
        StrandContact { radius: a1.max(a2), wisp_radius: self.hair_contact.unwrap_or(0.0), exempt_length: self.exempt, ..hair }
    }

    /// How contact is answered.
    pub fn options(&self) -> ContactOptions {
        let defaults = ContactOptions::default();
        ContactOptions { model: self.contact.unwrap_or(defaults.model), hair: self.hair_contact.is_some(), ..defaults }
    }

    /// Reads the mesh, in metres a unit of `scale`, and makes it what it is to be.
    pub fn read(&self, scale: f64, quiet: bool) -> Result<Option<HeadBody>, Failure> {
        let Some(path) = &self.body else { return Ok(None) };
        if self.body_as == Some(BodyAs::Grid) && self.body_depth.is_some() {
            return Err(Failure::Other("--body-depth is of a mesh that is not made a grid: give --body-as mesh".into()));
        }
        let file = obj_mesh::read(path)?;
        let vertices: Vec<Vector3<f64>> = file.vertices.iter().map(|vertex| vertex * scale).collect();
        let triangles = file.triangles;
        let mut report =
            BodyReport { mesh: path.display().to_string(), triangles: triangles.len(), sides: "grid", cell: None, grid: None };
        let as_grid = self.body_as != Some(BodyAs::Mesh) && self.body_depth.is_none();
        let baked = as_grid.then(|| baked_body::bake(path, &vertices, &triangles, self.body_cell, quiet)).transpose();
        let shape = match baked {
            Ok(Some(Baked { grid, kept })) => {
                (report.cell, report.grid) = (Some(grid.cell()), kept.map(|path| path.display().to_string()));
                Shape::new_grid(grid)
            }
            Err(error) if self.body_as == Some(BodyAs::Grid) || self.body_cell.is_some() => return Err(error),
            without => {
                if let Err(error) = without
                    && !quiet
                {
                    eprintln!("warning: the body stays a mesh, which costs more: {error}");
                }
                let shape;
                (shape, report.sides) = self.mesh(path, &vertices, &triangles)?;
                shape
            }
        };
        Ok(Some(HeadBody { shape: Arc::new(shape), vertices, triangles, report }))
    }

    /// A mesh that holds a volume is solid, unless a depth says that only its front is meant.
    fn mesh(&self, path: &Path, vertices: &[Vector3<f64>], triangles: &[[u32; 3]]) -> Result<(Shape, &'static str), Failure> {
        let new = |sides| Shape::new_mesh(vertices.to_vec(), triangles.to_vec(), sides);
        if self.body_depth.is_none()
            && let Ok(solid) = new(Sides::Solid)
        {
            return Ok((solid, "solid"));
        }
        let front = new(Sides::Front { depth: self.body_depth.unwrap_or(0.02) });
        Ok((front.map_err(|error| Failure::file(path, error))?, "front"))
    }

    /// Gives strands their contact and adds the body. What was drawn inside it, with the strands as they were made of the groom.
    pub fn begin(
        &self,
        solver: &mut Solver,
        strands: &[StrandId],
        made: &[GroomStrand],
        contact: StrandContact,
        body: Option<&HeadBody>,
    ) -> Result<(Option<BodyId>, Option<DrawnInside>), Failure> {
        if !self.touches() {
            return Ok((None, None));
        }
        solver.set_contact(strands, Some(&contact))?;
        let bodies = body.map(|body| BodyDef::new(Arc::clone(&body.shape)));
        let added = solver.add_bodies(bodies.into_iter().collect())?;
        let becomes = self.becomes();
        let overlaps = if becomes == Becomes::Parted { solver.overlaps(strands)? } else { solver.allow_overlaps(strands)? };
        let drawn_inside = match becomes {
            Becomes::BroughtOut => DrawnInside::brought_out(made),
            Becomes::Kept | Becomes::Parted => DrawnInside::left(becomes, &overlaps),
        };
        Ok((added.first().copied(), drawn_inside))
    }
}

impl HeadBody {
    /// What keeps hair out, in the axes that it has at the start.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Where it is, `elapsed` seconds after the start: its axes are the world's at the start.
    pub fn pose(head: &Head, elapsed: f64) -> Frame {
        let mut frames = Vec::with_capacity(1);
        head.roots(elapsed, &[Frame::default()], &mut frames);
        frames[0]
    }

    /// Its surface `elapsed` seconds after the start, world, m.
    pub fn surface(&self, head: &Head, elapsed: f64) -> Surface {
        let pose = Self::pose(head, elapsed);
        let (vertices, triangles) = (&self.vertices, &self.triangles);
        Surface { vertices: vertices.iter().map(|at| pose.origin + pose.rotation * at).collect(), triangles: triangles.clone() }
    }
}
