//! `superhelix bake`: a mesh into a signed distance grid.

use std::path::PathBuf;

use clap::Args;
use superhelix::Error;
use superhelix::io::{distance_grid, obj_mesh};
use superhelix::shapes::{DistanceGrid, Mesh};

use crate::shell::argument_values::positive;
use crate::shell::failure::Failure;

/// Bakes a mesh into a grid of signed distances, a shape for scenes ("grid") that costs the same however fine the mesh is.
#[derive(Debug, Args)]
pub struct BakeArguments {
    /// The mesh: .obj with faces, closed but for small openings, wound anticlockwise seen from outside.
    #[arg(value_name = "MESH.obj")]
    mesh: PathBuf,
    /// Where the grid goes.
    #[arg(long, short, value_name = "GRID.shxgrid")]
    out: PathBuf,
    /// Distance of neighbouring nodes, m: what is finer is rounded off.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    cell: f64,
    /// How far the grid reaches beyond the surface, m: at least what a strand goes in a step.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    band: f64,
    /// Metres a unit of the mesh.
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = positive)]
    scale: f64,
}

/// Runs the command.
pub fn run(arguments: &BakeArguments) -> Result<(), Failure> {
    let file = obj_mesh::read(&arguments.mesh)?;
    let vertices = file.vertices.iter().map(|vertex| vertex * arguments.scale).collect();
    let mesh = Mesh::for_baking(vertices, file.triangles).map_err(|error| Failure::file(&arguments.mesh, error))?;
    let grid = DistanceGrid::bake(&mesh, arguments.cell, arguments.band).map_err(|error| match error {
        Error::InvalidArgument { ref argument, .. } if argument == "mesh" => Failure::file(&arguments.mesh, error),
        Error::InvalidArgument { argument, value, expected } => {
            Failure::Other(format!("--{argument} is {value}; expected {expected}"))
        }
        other => Failure::from(other),
    })?;
    distance_grid::write(&arguments.out, &grid)?;
    let [x, y, z] = grid.counts();
    let megabytes = 4e-6 * grid.values().len() as f64;
    crate::shell::answer::print_line(&format!(
        "{}: {} triangles in {x} x {y} x {z} nodes {} m apart, {megabytes:.1} MB",
        arguments.out.display(),
        mesh.triangles().len(),
        grid.cell()
    ))
}
