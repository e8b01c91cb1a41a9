//! Bodies behind and among the strands: shaded, and hiding what is behind them.

use nalgebra::Vector3;
use tiny_skia::{Pixmap, PixmapPaint, Transform};

use crate::picture::colour::Colour;
use crate::picture::framing::window::Window;
use crate::picture::view::View;
use crate::surfaces::surface::Surface;

/// Samples along a pixel's side.
const FINE: usize = 3;

/// What bodies cover of a cell.
#[derive(Debug)]
pub struct Cover {
    width: usize,
    height: usize,
    /// Towards the viewer, a sample each; minus infinity where no body is.
    depth: Vec<f32>,
    /// Brightness, a sample each.
    light: Vec<f32>,
}

impl Cover {
    /// Looks at bodies.
    pub fn of(bodies: &[Surface], view: &View, window: &Window) -> Self {
        let [width, height] = window.cell.map(|side| side as usize * FINE);
        let mut cover = Self { width, height, depth: vec![f32::NEG_INFINITY; width * height], light: vec![0.0; width * height] };
        for body in bodies {
            let seen: Vec<[f32; 3]> =
                body.vertices.iter().map(|vertex| view.look((*vertex).map(|value| value as f32).into())).collect();
            for triangle in &body.triangles {
                cover.add(triangle.map(|vertex| seen[vertex as usize]), window);
            }
        }
        cover
    }

    fn add(&mut self, seen: [[f32; 3]; 3], window: &Window) {
        let corners = seen.map(Vector3::from);
        let Some(normal) = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).try_normalize(0.0) else { return };
        // A sheet seen from behind is as bright as from the front.
        let normal = if normal.z < 0.0 { -normal } else { normal };
        let light = 0.30 + 0.70 * normal.dot(&Vector3::new(-0.45, 0.62, 0.64).normalize()).max(0.0);
        let [a, b, c] = seen.map(|[right, up, _]| {
            let [x, y] = window.place([right, up, 0.0].into());
            [x * FINE as f32, y * FINE as f32]
        });
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let range = |axis: usize, size: usize| {
            let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
            (low.floor().clamp(0.0, size as f32) as usize)..(high.ceil().clamp(0.0, size as f32) as usize)
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let (px, py) = (x as f32 + 0.5, y as f32 + 0.5);
                let of = |from: [f32; 2], to: [f32; 2]| {
                    ((to[0] - from[0]) * (py - from[1]) - (to[1] - from[1]) * (px - from[0])) / area
                };
                let (for_a, for_b, for_c) = (of(b, c), of(c, a), of(a, b));
                if for_a < 0.0 || for_b < 0.0 || for_c < 0.0 {
                    continue;
                }
                let depth = for_a * seen[0][2] + for_b * seen[1][2] + for_c * seen[2][2];
                let sample = y * self.width + x;
                if depth > self.depth[sample] {
                    (self.depth[sample], self.light[sample]) = (depth, light);
                }
            }
        }
    }

    /// Whether a place of the cell (pixels), `depth` towards the viewer, is behind a body by more than `margin`.
    pub fn hides(&self, [x, y]: [f32; 2], depth: f32, margin: f32) -> bool {
        let (x, y) = ((x * FINE as f32) as isize, (y * FINE as f32) as isize);
        let inside = (0..self.width as isize).contains(&x) && (0..self.height as isize).contains(&y);
        inside && self.depth[y as usize * self.width + x as usize] > depth + margin
    }

    /// Draws what is covered.
    pub fn draw(&self, cell: &mut Pixmap) {
        if self.depth.iter().all(|depth| *depth == f32::NEG_INFINITY) {
            return;
        }
        let Some(mut picture) = Pixmap::new(cell.width(), cell.height()) else { return };
        let across = self.width / FINE;
        for (index, pixel) in picture.pixels_mut().iter_mut().enumerate() {
            let (left, top) = (index % across * FINE, index / across * FINE);
            let (mut light, mut covered) = (0.0, 0.0);
            for sample in (0..FINE * FINE).map(|sample| (top + sample / FINE) * self.width + left + sample % FINE) {
                if self.depth[sample] > f32::NEG_INFINITY {
                    light += self.light[sample];
                    covered += 1.0;
                }
            }
            if covered > 0.0 {
                *pixel = Colour::BODY.lit(light / covered).to_skia(covered / (FINE * FINE) as f32).premultiply().to_color_u8();
            }
        }
        cell.draw_pixmap(0, 0, picture.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
    }
}
