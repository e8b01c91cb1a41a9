//! The head and the scalp of `superhelix prepare`.

use std::path::Path;

use nalgebra::Vector3;
use serde::Serialize;
use superhelix::Shape;
use superhelix::io::obj_mesh;
use superhelix::shapes::{DistanceGrid, Mesh, Sides};

use super::arguments::PrepareArguments;
use crate::shell::failure::Failure;
use crate::surfaces::baked_body;
use crate::surfaces::surface::Surface;

/// How far behind the faces of an open mesh strands are still pushed to the front, m.
const DEPTH: f64 = 0.02;

/// What the strands grow on and stay out of.
#[derive(Debug)]
pub struct Head {
    /// What carries roots, if anything does.
    pub scalp: Option<Mesh>,
    /// What keeps strands out, if anything does.
    pub body: Option<Body>,
}

/// What keeps strands out.
#[derive(Debug)]
pub struct Body {
    /// In the strands' axes, m.
    pub shape: Shape,
    /// Its mesh.
    pub surface: Surface,
    /// What the report says of it.
    pub report: BodyReport,
}

/// What the report says of a head.
#[derive(Debug, Clone, Serialize)]
pub struct BodyReport {
    /// The mesh's path.
    pub mesh: String,
    /// Its triangles.
    pub triangles: usize,
    /// What keeps hair off: "grid", or the "front" of a mesh without an inside.
    pub sides: &'static str,
    /// Distance of the grid's nodes, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<f64>,
}

impl Head {
    /// Reads the meshes, of `scale` metres a unit unless the flags say otherwise.
    pub fn read(arguments: &PrepareArguments, scale: f64) -> Result<Self, Failure> {
        let scale = arguments.head_scale.unwrap_or(scale);
        let body = arguments.head.as_deref().map(|path| Body::read(path, scale, arguments.quiet)).transpose()?;
        let scalp = match (&arguments.scalp, &body) {
            (Some(path), _) => Some(carrier(path, read_surface(path, scale)?)?),
            (None, Some(body)) => Some(carrier(Path::new(&body.report.mesh), body.surface.clone())?),
            (None, None) => None,
        };
        Ok(Self { scalp, body })
    }
}

fn read_surface(path: &Path, scale: f64) -> Result<Surface, Failure> {
    let file = obj_mesh::read(path)?;
    Ok(Surface { vertices: file.vertices.iter().map(|vertex| vertex * scale).collect(), triangles: file.triangles })
}

/// A mesh that roots are put on, from either side.
fn carrier(path: &Path, surface: Surface) -> Result<Mesh, Failure> {
    Mesh::new(surface.vertices, surface.triangles, Sides::Both).map_err(|error| Failure::file(path, error))
}

impl Body {
    fn read(path: &Path, scale: f64, quiet: bool) -> Result<Self, Failure> {
        let surface = read_surface(path, scale)?;
        let mut report =
            BodyReport { mesh: path.display().to_string(), triangles: surface.triangles.len(), sides: "grid", cell: None };
        let shape = match baked_body::bake_anew(path, &surface.vertices, &surface.triangles, None) {
            Ok(grid) => {
                report.cell = Some(grid.cell());
                Shape::new_grid(grid)
            }
            Err(error) => {
                if !quiet {
                    eprintln!("warning: the head stays a mesh whose front keeps strands off: {error}");
                }
                report.sides = "front";
                let sides = Sides::Front { depth: DEPTH };
                Shape::new_mesh(surface.vertices.clone(), surface.triangles.clone(), sides)
                    .map_err(|error| Failure::file(path, error))?
            }
        };
        Ok(Self { shape, surface, report })
    }

    /// The grid, if it has an inside.
    pub fn grid(&self) -> Option<&DistanceGrid> {
        self.shape.grid()
    }

    /// Signed distance of a point, m: negative inside; none where it is farther than hair needs to know.
    pub fn distance(&self, point: Vector3<f64>) -> Option<f64> {
        self.shape.closest(point, 0.0).map(|surface| surface.distance)
    }
}
