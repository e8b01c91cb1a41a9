//! Signed distances of a mesh that is not quite closed: winding numbers give the sign.

use super::lattice::Lattice;
use crate::contact::shape::mesh::winding::Winding;
use crate::contact::shape::{Mesh, Sides};
use crate::error::{Error, Result};

/// A node is unclear whose winding number is farther than this from that of an inside (1, or more where parts overlap) or an outside (0).
const UNCLEAR: f32 = 0.2;
/// Most unclear nodes among those near the surface.
const MAX_UNCLEAR: f64 = 0.2;
/// A node nearer to the surface than this share of a cell is on it: it has no side, and none is asked of it. (Of a flat face along the
/// lattice a whole layer of nodes may be.)
const ON_IT: f64 = 1e-3;

/// Signed distances of a mesh at the nodes of a lattice, m.
///
/// # Errors
/// [`Error::InvalidArgument`] when the mesh is too open for an inside; [`Error::OutOfMemory`].
pub(super) fn distances(lattice: &Lattice, mesh: &Mesh) -> Result<Vec<f32>> {
    let mut distances = lattice.distances(mesh)?;
    let winding = Winding::new((0..mesh.triangles().len() as u32).map(|index| mesh.corners(index)).collect());
    let mut numbers = lattice.map(|node, _| winding.at(&node) as f32)?;
    // A mesh of two sides may be wound either way.
    if mesh.sides() == Sides::Both && near(lattice, &distances, &numbers).map(|number| f64::from(*number)).sum::<f64>() < 0.0 {
        numbers.iter_mut().for_each(|number| *number = -*number);
    }
    check(lattice, &distances, &numbers)?;
    close_openings(lattice, &mut distances, &numbers)?;
    for (distance, number) in distances.iter_mut().zip(&numbers) {
        if *number > 0.5 {
            *distance = -*distance;
        }
    }
    Ok(distances)
}

/// The winding numbers of the nodes within two cells of the mesh that are not on it.
fn near<'a>(lattice: &Lattice, distances: &'a [f32], numbers: &'a [f32]) -> impl Iterator<Item = &'a f32> {
    let asked = ON_IT * lattice.cell..2.0 * lattice.cell;
    distances.iter().zip(numbers).filter(move |(distance, _)| asked.contains(&f64::from(**distance))).map(|(_, number)| number)
}

/// Refuses a mesh about which too many winding numbers tell no side, or none an inside.
fn check(lattice: &Lattice, distances: &[f32], numbers: &[f32]) -> Result<()> {
    let is_unclear = |number: &&f32| **number < -UNCLEAR || (UNCLEAR..1.0 - UNCLEAR).contains(*number);
    let unclear = near(lattice, distances, numbers).filter(is_unclear).count();
    let fraction = unclear as f64 / near(lattice, distances, numbers).count().max(1) as f64;
    if fraction > MAX_UNCLEAR {
        return Err(Error::invalid(
            "mesh",
            format!(
                "too open to have an inside: {:.0} % of the places about it are neither inside nor outside by winding number",
                100.0 * fraction
            ),
            format!(
                "at most {:.0} %: a mesh that is closed but for small openings, its triangles anticlockwise seen from outside",
                100.0 * MAX_UNCLEAR
            ),
        ));
    }
    if !numbers.iter().any(|number| *number > 0.5) {
        return Err(Error::invalid(
            "mesh",
            "without an inside: nowhere on the lattice is its winding number above one half",
            "a mesh that is closed but for small openings, its triangles anticlockwise seen from outside",
        ));
    }
    Ok(())
}

/// Where neighbours lie on different sides without the mesh between them, an opening is closed: there the distance is that from where the
/// winding number is one half between them, and no node is farther from the surface than from there.
fn close_openings(lattice: &Lattice, distances: &mut [f32], numbers: &[f32]) -> Result<()> {
    let cell = lattice.cell as f32;
    let mut cap = lattice.map(|_, _| f32::INFINITY)?;
    let mut any = false;
    for axis in 0..3 {
        let stride = lattice.stride(axis);
        for first in 0..numbers.len() - stride {
            // The last of a row has no neighbour.
            if (first / stride + 1).is_multiple_of(lattice.counts[axis] as usize) {
                continue;
            }
            let second = first + stride;
            let (a, b) = (numbers[first] - 0.5, numbers[second] - 0.5);
            // Were the mesh between them, both distances to it would make up at most the cell.
            if (a > 0.0) != (b > 0.0) && distances[first] + distances[second] > cell * 1.0001 {
                let part = cell * a.abs() / (a.abs() + b.abs());
                cap[first] = cap[first].min(part);
                cap[second] = cap[second].min(cell - part);
                any = true;
            }
        }
    }
    if any {
        spread(lattice, &mut cap);
        distances.iter_mut().zip(&cap).for_each(|(distance, cap)| *distance = distance.min(*cap));
    }
    Ok(())
}

/// Spreads distances from node to node over all 26 neighbours, forward and back: at most a tenth too long.
fn spread(lattice: &Lattice, values: &mut [f32]) {
    let offsets: Vec<[i64; 3]> = (0..13).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]).collect();
    let counts = lattice.counts.map(i64::from);
    let mut take = |index: usize, turn: i64| {
        let place = [index as i64 % counts[0], index as i64 / counts[0] % counts[1], index as i64 / counts[0] / counts[1]];
        for offset in &offsets {
            let there: [i64; 3] = std::array::from_fn(|axis| place[axis] + turn * offset[axis]);
            if (0..3).all(|axis| (0..counts[axis]).contains(&there[axis])) {
                let other = (there[0] + counts[0] * (there[1] + counts[1] * there[2])) as usize;
                let distance = lattice.cell * (offset.iter().map(|step| (step * step) as f64).sum::<f64>()).sqrt();
                values[index] = values[index].min(values[other] + distance as f32);
            }
        }
    };
    let count = lattice.len();
    (0..count).for_each(|index| take(index, 1));
    (0..count).rev().for_each(|index| take(index, -1));
}
