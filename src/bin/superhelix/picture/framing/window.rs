//! What part of the world a cell shows.

use nalgebra::Vector3;

/// How large a cell is and what it shows.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// Width and height of the cell, pixels.
    pub cell: [f32; 2],
    /// What lies in the middle of the cell (right, up), in the view's axes.
    pub middle: [f32; 2],
    /// Pixels a unit.
    pub scale: f32,
    /// Farthest and nearest, towards the viewer.
    pub depth: [f32; 2],
}

impl Window {
    /// Where a point (right, up, towards the viewer) is in the cell, pixels, y down.
    pub fn place(&self, seen: Vector3<f32>) -> [f32; 2] {
        let [width, height] = self.cell;
        [width / 2.0 + (seen.x - self.middle[0]) * self.scale, height / 2.0 - (seen.y - self.middle[1]) * self.scale]
    }
}
