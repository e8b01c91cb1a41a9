//! `follicles` of a strand: places on a mesh, at each of which one such strand stands.

use std::path::Path;

use superhelix::hair::{Amount, Density, MAX_FOLLICLES, ScatterOptions};
use superhelix::io::obj_mesh;
use superhelix::{Error, Frame};

use crate::scene::colliders::{file_complaint, path_of};
use crate::scene::pose::read_pose;
use crate::shell::json::{Complaint, Entries, Node};
use crate::surfaces::region::{Placement, read_vertex_densities, scalp_of};

/// Reads `follicles`: frames whose first axis is the mesh's normal, and whose second lies along u, or x without texture coordinates.
pub fn read(node: &Node, directory: &Path) -> Result<Vec<Frame>, Complaint> {
    let entries = node.object(&["file", "scale", "pose", "count", "spacing", "density", "seed"])?;
    let file = entries.require("file")?;
    let scale = entries.or("scale", 1.0, Node::positive)?;
    let pose = entries.or("pose", Frame::default(), read_pose)?;
    let amount = match (entries.get("count"), entries.get("spacing")) {
        (Some(count), None) => Amount::Count(count.whole(1..=MAX_FOLLICLES as u64)? as usize),
        (None, Some(spacing)) => Amount::Spacing(spacing.positive()?),
        (Some(_), Some(spacing)) => return Err(spacing.complain("no such key beside count")),
        (None, None) => return Err(Complaint::new(entries.path("count"), "is missing; expected it or spacing")),
    };
    let seed = entries.or("seed", 0, |node| node.whole(0..=u64::from(u32::MAX)))?;
    let (mesh, texture) = obj_mesh::read_textured(path_of(file, directory)?).map_err(|error| file_complaint(file, &error))?;
    let scalp = scalp_of(mesh, texture, Placement::scaled(scale)).map_err(|error| file_complaint(file, &error))?;
    let density = read_density(&entries, directory)?;
    let scattered = scalp.scatter(&ScatterOptions { amount, density, seed }).map_err(|error| match error {
        Error::InvalidArgument { argument, value, expected } => Complaint::value(entries.path(&argument), value, expected),
        other => Complaint::new(&node.key, other.to_string()),
    })?;
    let frames = scalp.frames(scalp.vertices(), &scattered.follicles);
    let frames = frames.map_err(|error| Complaint::new(&node.key, error.to_string()))?;
    Ok(frames.iter().map(|frame| pose.compose(frame)).collect())
}

/// Numbers of a text file, one for each vertex.
fn read_density(entries: &Entries, directory: &Path) -> Result<Density, Complaint> {
    let Some(file) = entries.get_unless_null("density") else { return Ok(Density::Product(Vec::new())) };
    let read = read_vertex_densities(&path_of(file, directory)?);
    read.map_err(|failure| Complaint::new(&file.key, format!("is {}: {failure}", file.value)))
}
