//! Bodies beside a cache of frames: a mesh that goes with the roots, or one for each frame.

use nalgebra::{Matrix3, Vector3};

use crate::shell::failure::Failure;
use crate::surfaces::moving_scalp::ScalpFiles;
use crate::surfaces::surface::Surface;

/// How much of the roots' spread across their longest extent there must be for them to say how a head is turned.
const SPREAD: f64 = 1e-4;

/// A mesh and how it moves.
#[derive(Debug)]
pub struct CacheBody {
    mesh: ScalpFiles,
    /// The strands' roots at the first frame.
    roots: Vec<Vector3<f64>>,
    /// Metres a unit of the cache.
    unit: f64,
}

impl CacheBody {
    /// From a mesh and the strands' roots at the first frame, in units of `unit` metres.
    pub fn new(mesh: ScalpFiles, roots: Vec<Vector3<f64>>, unit: f64) -> Self {
        Self { mesh, roots, unit }
    }

    /// The surface at a frame, whose roots are these, in the cache's units.
    pub fn surface(&self, frame: usize, roots: &[Vector3<f64>]) -> Result<Surface, Failure> {
        let mut vertices: Vec<Vector3<f64>> = self.mesh.vertices(frame)?.iter().map(|vertex| vertex / self.unit).collect();
        if frame > 0 && !self.mesh.moves() {
            let (turn, from, to) = rigid(&self.roots, roots).ok_or_else(|| {
                let why = "--body: the strands' roots lie on a line and do not say how it is turned; give a mesh for each frame";
                Failure::Other(why.into())
            })?;
            vertices.iter_mut().for_each(|vertex| *vertex = to + turn * (*vertex - from));
        }
        Ok(Surface { vertices, triangles: self.mesh.rest.scalp.triangles().to_vec() })
    }
}

/// The turn, about which point, and where that point goes, that bring places closest to others (Kabsch 1976); none where they lie on a line.
fn rigid(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<(Matrix3<f64>, Vector3<f64>, Vector3<f64>)> {
    let middle = |places: &[Vector3<f64>]| places.iter().sum::<Vector3<f64>>() / places.len() as f64;
    let (here, there) = (middle(from), middle(to));
    let spread = from.iter().zip(to).map(|(a, b)| (b - there) * (a - here).transpose()).sum::<Matrix3<f64>>();
    let svd = spread.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    if svd.singular_values[1] <= SPREAD * svd.singular_values[0] {
        return None;
    }
    let side = Vector3::new(1.0, 1.0, (u * v_t).determinant().signum());
    Some((u * Matrix3::from_diagonal(&side) * v_t, here, there))
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    #[test]
    fn roots_say_how_a_head_is_turned_unless_they_lie_on_a_line() {
        let roots: Vec<Vector3<f64>> =
            (0..9).map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), 0.1 * f64::from(k * k % 5))).collect();
        let turn = Rotation3::from_scaled_axis(Vector3::new(0.4, -1.9, 0.7));
        let away = Vector3::new(5.0, 1.0, -2.0);
        let moved: Vec<_> = roots.iter().map(|root| turn * root + away).collect();
        let (found, from, to) = rigid(&roots, &moved).unwrap();
        let nose = Vector3::new(2.0, -3.0, 4.0);
        assert!((to + found * (nose - from) - (turn * nose + away)).norm() < 1e-12);
        // In a plane as well: a head is not mirrored.
        let flat: Vec<_> = roots.iter().map(|root| Vector3::new(root.x, root.y, 0.0)).collect();
        let moved: Vec<_> = flat.iter().map(|root| turn * root).collect();
        assert!((rigid(&flat, &moved).unwrap().0 - turn.matrix()).norm() < 1e-12);
        let line: Vec<_> = (0..9).map(|k| Vector3::x() * f64::from(k)).collect();
        assert!(rigid(&line, &line).is_none() && rigid(&line[..1], &line[..1]).is_none());
    }
}
