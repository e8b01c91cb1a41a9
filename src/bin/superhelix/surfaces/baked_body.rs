//! A mesh that hair is kept out of, baked into a grid of distances, which is kept beside the mesh for the next time.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::io::distance_grid;
use superhelix::shapes::{Bounds, DistanceGrid, Mesh};

use crate::shell::failure::Failure;

/// Nodes apart, of the body's longest side, and the least and most of that, m.
const CELL_OF_SIDE: f64 = 0.01;
const LEAST_CELL: f64 = 1e-3;
const MAX_CELL: f64 = 5e-3;
/// How far the grid reaches beyond the surface, m: what hair goes in a step of 1/60 s at 2 m/s.
const BAND: f64 = 0.035;

/// A grid, and where it is kept.
#[derive(Debug)]
pub struct Baked {
    pub grid: DistanceGrid,
    /// None where it could not be written.
    pub kept: Option<PathBuf>,
}

/// Bakes a mesh (m), or takes what was baked of the same numbers before: the file beside `path` whose name says their hash.
pub fn bake(
    path: &Path,
    vertices: &[Vector3<f64>],
    triangles: &[[u32; 3]],
    cell: Option<f64>,
    quiet: bool,
) -> Result<Baked, Failure> {
    let cell = cell.unwrap_or_else(|| usual_cell(vertices));
    let place = place(path, vertices, triangles, cell);
    if place.is_file() {
        match distance_grid::read(&place) {
            Ok(grid) => return Ok(Baked { grid, kept: Some(place) }),
            Err(error) if !quiet => eprintln!("warning: {error}; baked again"),
            Err(_) => {}
        }
    }
    if !quiet {
        let mesh = Mesh::for_baking(vertices.to_vec(), triangles.to_vec()).map_err(|error| Failure::file(path, error))?;
        let [x, y, z] = DistanceGrid::baked_counts(&mesh, cell, BAND).map_err(|error| Failure::file(path, error))?;
        eprintln!("baking {} into {x} x {y} x {z} distances {cell:.4} m apart ...", path.display());
    }
    let grid = bake_anew(path, vertices, triangles, Some(cell))?;
    let kept = match distance_grid::write(&place, &grid) {
        Ok(()) => {
            if !quiet {
                eprintln!("kept for the next time: {}", place.display());
            }
            Some(place)
        }
        Err(error) => {
            if !quiet {
                eprintln!("warning: {error}; it will be baked again the next time");
            }
            None
        }
    };
    Ok(Baked { grid, kept })
}

/// Bakes a mesh (m) and keeps nothing.
pub fn bake_anew(
    path: &Path,
    vertices: &[Vector3<f64>],
    triangles: &[[u32; 3]],
    cell: Option<f64>,
) -> Result<DistanceGrid, Failure> {
    let mesh = Mesh::for_baking(vertices.to_vec(), triangles.to_vec()).map_err(|error| Failure::file(path, error))?;
    let cell = cell.unwrap_or_else(|| usual_cell(vertices));
    DistanceGrid::bake(&mesh, cell, BAND).map_err(|error| Failure::file(path, error))
}

/// The distance of nodes that suits a body of that size, m.
fn usual_cell(vertices: &[Vector3<f64>]) -> f64 {
    let bounds = Bounds::of_points(vertices.iter().copied());
    ((bounds.high - bounds.low).max() * CELL_OF_SIDE).clamp(LEAST_CELL, MAX_CELL)
}

/// Where the grid of these numbers is kept. (The hash may be another in another version of the standard library: then it is baked again.)
fn place(path: &Path, vertices: &[Vector3<f64>], triangles: &[[u32; 3]], cell: f64) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    for number in vertices.iter().flatten().chain([&cell, &BAND]) {
        number.to_bits().hash(&mut hasher);
    }
    triangles.hash(&mut hasher);
    let mut name = path.as_os_str().to_owned();
    name.push(format!(".{:016x}.shxgrid", hasher.finish()));
    PathBuf::from(name)
}
