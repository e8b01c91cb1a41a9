//! Where on a mesh follicles stand: meshes as scalps, maps of density, nearness to a groom's roots.

use std::path::{Path, PathBuf};

use clap::Args;
use nalgebra::Vector3;
use superhelix::hair::{Amount, Density, GuideRoots, RootRegion, Scalp, ScatterOptions, Scattered};
use superhelix::io::{Curves, ObjMesh, Texture, obj_mesh};
use superhelix::{Error, Frame};

use crate::shell::failure::Failure;

/// How densely follicles stand; several maps are multiplied.
#[derive(Debug, Args)]
pub struct DensityArguments {
    /// Relative densities: a text file with a number of 0 or above for each vertex of the mesh.
    #[arg(long, value_name = "NUMBERS.txt")]
    density: Option<PathBuf>,
    /// Relative densities painted over the texture coordinates of the mesh: white is densest, black and what is transparent is bare. The
    /// picture's lower left corner is u = 0, v = 0.
    #[arg(long, value_name = "PICTURE.png")]
    density_picture: Option<PathBuf>,
}

impl DensityArguments {
    /// Whether there is a map.
    pub fn is_given(&self) -> bool {
        self.density.is_some() || self.density_picture.is_some()
    }

    /// The maps, which are of `mesh`.
    pub fn read(&self, mesh: &Mesh) -> Result<Vec<Density>, Failure> {
        let mut maps = Vec::new();
        if let Some(path) = &self.density {
            maps.push(read_vertex_densities(path)?);
        }
        if let Some(path) = &self.density_picture {
            mesh.check_textured("--density-picture")?;
            maps.push(read_picture(path)?);
        }
        Ok(maps)
    }
}

/// Where a mesh's file is in the world.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    /// Metres a unit of the file.
    pub scale: f64,
    /// Of the file's origin and axes; none where they are the world's.
    pub pose: Option<Frame>,
}

impl Placement {
    /// A file in the world's axes.
    pub fn scaled(scale: f64) -> Self {
        Self { scale, pose: None }
    }

    /// A point of the file, m.
    pub fn place(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let point = point * self.scale;
        self.pose.map_or(point, |pose| pose.origin + pose.rotation * point)
    }
}

/// A mesh that follicles stand on, m.
#[derive(Debug)]
pub struct Mesh {
    path: PathBuf,
    /// The mesh; with texture coordinates where the file has one at every corner.
    pub scalp: Scalp,
    textured: bool,
}

impl Mesh {
    /// Reads it.
    pub fn read(path: &Path, placed: Placement) -> Result<Self, Failure> {
        let (mesh, texture) = obj_mesh::read_textured(path)?;
        Self::new(path, mesh, texture, placed)
    }

    /// What was read of a file.
    pub fn new(path: &Path, mesh: ObjMesh, texture: Option<Texture>, placed: Placement) -> Result<Self, Failure> {
        let textured = texture.is_some();
        let scalp = scalp_of(mesh, texture, placed).map_err(|error| Failure::file(path, error))?;
        Ok(Self { path: path.to_owned(), scalp, textured })
    }

    /// Refuses a mesh without texture coordinates, which `flag` needs.
    pub fn check_textured(&self, flag: &str) -> Result<(), Failure> {
        if self.textured {
            return Ok(());
        }
        let reason =
            format!("{flag} needs texture coordinates at every corner of its faces (\"vt\", \"f 1/1 2/2 3/3\"; primvars:st)");
        Err(Failure::file(&self.path, reason))
    }

    /// Follicles, as densely as all maps together say, and near some places where there are any.
    pub fn scatter(
        &self,
        amount: Amount,
        mut maps: Vec<Density>,
        near: Option<(GuideRoots, RootRegion)>,
        seed: u64,
    ) -> Result<Scattered, Error> {
        let by_roots = near.is_some();
        maps.extend(near.map(|(roots, region)| Density::Roots(roots, region)));
        let options = ScatterOptions { amount, density: Density::Product(maps), seed };
        self.scalp.scatter(&options).map_err(|error| match error {
            Error::InvalidArgument { argument, value, expected } if argument == "density" && by_roots => {
                Error::InvalidArgument { argument, value, expected: format!("{expected} (with what is near the roots)") }
            }
            other => other,
        })
    }
}

/// A complaint of the library in the words of the command line.
pub fn in_flags(error: Error) -> Failure {
    match error {
        Error::InvalidArgument { argument, value, expected } => {
            Failure::Other(format!("--{} is {value}; expected {expected}", argument.replace('_', "-")))
        }
        other => Failure::from(other),
    }
}

/// A mesh that was read, as a scalp, m.
pub fn scalp_of(mesh: ObjMesh, texture: Option<Texture>, placed: Placement) -> Result<Scalp, Error> {
    let vertices = mesh.vertices.iter().map(|vertex| placed.place(vertex)).collect();
    Scalp::new(vertices, mesh.triangles, texture.map(|texture| texture.corners()), Vector3::x())
}

/// The numbers of a text file, one for each vertex.
pub fn read_vertex_densities(path: &Path) -> Result<Density, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    let numbers: Result<Vec<f64>, _> = text.split_ascii_whitespace().map(str::parse).collect();
    let numbers = numbers.map_err(|error| Failure::file(path, format!("{error}: expected a number for each vertex")))?;
    Ok(Density::Vertices(numbers))
}

/// A picture's brightness (ITU-R BT.709's weights, of the pixels' numbers as they are) times its opacity, from the bottom row up.
pub fn read_picture(path: &Path) -> Result<Density, Failure> {
    let bytes = std::fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    let picture = tiny_skia::Pixmap::decode_png(&bytes)
        .map_err(|error| Failure::file(path, format!("cannot be read as a picture in PNG: {error}")))?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let of = |pixel: &tiny_skia::PremultipliedColorU8| {
        let [red, green, blue] = [pixel.red(), pixel.green(), pixel.blue()].map(f64::from);
        (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255.0
    };
    let values = picture.pixels().chunks(width).rev().flatten().map(of).collect();
    Ok(Density::Picture { width, height, values })
}

/// The roots of a groom's strands, m.
pub fn groom_roots(path: &Path, scale: f64) -> Result<Vec<Vector3<f64>>, Failure> {
    Ok(Curves::read(path)?.strands().map(|strand| Vector3::from(strand[0].map(f64::from)) * scale).collect())
}
