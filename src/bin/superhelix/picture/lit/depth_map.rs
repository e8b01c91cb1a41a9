//! Surfaces of bodies as a light sees them (a shadow map, Williams 1978).

use nalgebra::{Matrix3, Vector3};

use super::skin::Skin;
use super::threads::Threads;
use super::triangle::{Raster, cover};

/// The nearest surface to a light, or to the viewer.
#[derive(Debug)]
pub struct DepthMap {
    low: [f32; 2],
    texels_a_unit: f32,
    side: usize,
    nearest: Vec<f32>,
    /// How far behind a surface things still count as on it.
    margin: f32,
}

/// Texels about bodies.
const BORDER: usize = 2;

impl DepthMap {
    /// Looks along the third of some axes (rows). Surfaces are mapped as far as they may matter to the hair, on `side` texels each way.
    pub fn of(skins: &[Skin], threads: &Threads, axes: &Matrix3<f32>, side: usize) -> Self {
        if skins.iter().all(|skin| skin.triangles.is_empty()) {
            return Self { low: [0.0; 2], texels_a_unit: 1.0, side: 0, nearest: Vec::new(), margin: 0.0 };
        }
        let turned: Vec<Vec<Vector3<f32>>> =
            skins.iter().map(|skin| skin.vertices.iter().map(|vertex| axes * vertex).collect()).collect();
        let (low, high) = bounds(&turned.concat());
        // A floor that reaches far is mapped as far as hair may matter to it.
        let (hair_low, hair_high) = bounds(&threads.points.iter().map(|point| axes * point).collect::<Vec<_>>());
        let reach = (hair_high - hair_low).max();
        let low = low.sup(&(hair_low - Vector3::repeat(reach)));
        let high = high.inf(&(hair_high + Vector3::repeat(reach)));
        let size = (high - low).xy().max().max(f32::MIN_POSITIVE);
        let texels_a_unit = (side - 2 * BORDER) as f32 / size;
        let low = [low.x, low.y].map(|low| low - BORDER as f32 / texels_a_unit);
        let mut nearest = vec![f32::NEG_INFINITY; side * side];
        let raster = Raster { width: side, rows: 0..side };
        for (skin, vertices) in skins.iter().zip(&turned) {
            for triangle in &skin.triangles {
                let corners = triangle.map(|vertex| vertices[vertex as usize]);
                let flat = corners.map(|corner| [(corner.x - low[0]) * texels_a_unit, (corner.y - low[1]) * texels_a_unit]);
                cover(flat, &raster, |x, y, shares| {
                    let depth = (0..3).map(|k| shares[k] * corners[k].z).sum::<f32>();
                    let texel = &mut nearest[y * side + x];
                    *texel = texel.max(depth);
                });
            }
        }
        Self { low, texels_a_unit, side, nearest, margin: 3.0 / texels_a_unit }
    }

    /// How much of a place (in those axes) no surface is before, 0 to 1.
    #[inline]
    pub fn open(&self, place: Vector3<f32>) -> f32 {
        let x = (place.x - self.low[0]) * self.texels_a_unit - 0.5;
        let y = (place.y - self.low[1]) * self.texels_a_unit - 0.5;
        let last = self.side as f32 - 2.0;
        if !(x >= 1.0 && y >= 1.0 && x < last && y < last) {
            return 1.0;
        }
        let (column, row) = (x as usize, y as usize);
        // A tent three texels wide.
        let weights = |part: f32| [1.0 - part, 2.0 - part, 1.0 + part, part];
        let (across, down) = (weights(x - column as f32), weights(y - row as f32));
        let depth = place.z + self.margin;
        let mut sum = 0.0;
        for (k, down) in down.iter().enumerate() {
            let first = (row + k - 1) * self.side + column - 1;
            for (texel, across) in self.nearest[first..first + 4].iter().zip(across) {
                sum += if *texel > depth { 0.0 } else { down * across };
            }
        }
        // The weights of each way sum to 4.
        sum / 16.0
    }
}

/// Corners of the box about some points; a point of zeros where there are none.
pub fn bounds(points: &[Vector3<f32>]) -> (Vector3<f32>, Vector3<f32>) {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point)))
}
