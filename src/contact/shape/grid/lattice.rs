//! The nodes at which a distance grid is baked.

use nalgebra::Vector3;

use crate::contact::shape::Mesh;
use crate::error::{Error, Result};

/// Nodes in rows along x, sheets of rows along y, one above the other along z.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    /// The lowest node, m.
    pub low: Vector3<f64>,
    /// Distance of neighbours, m.
    pub cell: f64,
    /// Nodes along x, y and z.
    pub counts: [u32; 3],
}

impl Lattice {
    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.counts.iter().map(|count| *count as usize).product()
    }

    /// How far apart neighbours along an axis are in a list of all nodes.
    pub fn stride(&self, axis: usize) -> usize {
        self.counts[..axis].iter().map(|count| *count as usize).product()
    }

    /// A number for each node, in order.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn map(&self, mut number: impl FnMut(Vector3<f64>, [u32; 3]) -> f32) -> Result<Vec<f32>> {
        let mut values = Vec::new();
        values.try_reserve_exact(self.len()).map_err(|_| Error::OutOfMemory { bytes: self.len() * size_of::<f32>() })?;
        for k in 0..self.counts[2] {
            for j in 0..self.counts[1] {
                for i in 0..self.counts[0] {
                    let place = [i, j, k];
                    values.push(number(self.low + Vector3::from(place.map(f64::from)) * self.cell, place));
                }
            }
        }
        Ok(values)
    }

    /// Distance of a mesh from each node, m: signed for a solid mesh, else without sign.
    pub fn distances(&self, mesh: &Mesh) -> Result<Vec<f32>> {
        let mut at_most = f64::INFINITY;
        self.map(|node, place| {
            if place[0] == 0 {
                at_most = f64::INFINITY;
            }
            let distance = mesh.signed_distance(&node, at_most);
            // The next node's distance differs by at most the distance to it.
            at_most = distance.abs() + 1.001 * self.cell;
            distance as f32
        })
    }
}
