//! A mesh whose vertices move: samples in time, straight and even between them, held before the first and after the last.

use std::path::Path;

use nalgebra::Vector3;

use crate::scene::colliders::{read_mesh, read_vectors};
use crate::scene::pose::read_times;
use crate::shell::json::{Complaint, Node};

/// Vertices over time.
#[derive(Debug)]
pub struct Deformation {
    times: Vec<f64>,
    samples: Vec<Vec<Vector3<f64>>>,
}

impl Deformation {
    /// Reads `times` with `files` or `vertices`, one a time, of `count` vertices each.
    pub fn read(node: &Node, count: usize, scale: f64, directory: &Path) -> Result<Self, Complaint> {
        let entries = node.object(&["times", "files", "vertices"])?;
        let times = read_times(entries.require("times")?)?;
        if let (Some(_), Some(vertices)) = (entries.get("files"), entries.get("vertices")) {
            return Err(vertices.complain("no such key beside files"));
        }
        let list = entries.get("vertices").map_or_else(|| entries.require("files"), Ok)?;
        let items = list.list()?;
        if times.is_empty() || items.len() != times.len() {
            let expected = format!("as many as times has ({}), at least one", times.len());
            return Err(Complaint::value(&list.key, format!("a list of {}", items.len()), expected));
        }
        let mut samples = Vec::with_capacity(items.len());
        for item in &items {
            let vertices = match item.value.is_string() {
                true => read_mesh(item, scale, directory)?.0,
                false => read_vectors(item)?,
            };
            if vertices.len() != count {
                let expected = format!("{count} vertices, as the mesh has");
                return Err(Complaint::value(&item.key, format!("of {} vertices", vertices.len()), expected));
            }
            samples.push(vertices);
        }
        Ok(Self { times, samples })
    }

    /// The vertices at a time (s), m, in the body's axes.
    pub fn at(&self, time: f64) -> Vec<Vector3<f64>> {
        let next = self.times.partition_point(|sample| *sample <= time);
        let (Some(before), Some(after)) = (next.checked_sub(1), self.times.get(next)) else {
            return self.samples[next.min(self.samples.len() - 1)].clone();
        };
        let share = (time - self.times[before]) / (after - self.times[before]);
        let ends = self.samples[before].iter().zip(&self.samples[next]);
        ends.map(|(from, to)| from + (to - from) * share).collect()
    }
}
