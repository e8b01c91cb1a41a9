//! Some rows of a picture while it is made.

use std::ops::Range;

use super::skin::Skin;
use super::studio::Studio;
use super::triangle::{Raster, cover};
use crate::picture::framing::window::Window;

/// Samples of bodies along a pixel's side.
const FINE: usize = 3;
const SAMPLES: usize = FINE * FINE;

/// Pixels, linear, and the bodies in them.
#[derive(Debug)]
pub struct Band {
    /// Which rows of the picture.
    pub rows: Range<usize>,
    /// Pixels of a row.
    pub width: usize,
    /// Row by row.
    pub pixels: Vec<[f32; 3]>,
    /// Depth of the bodies' samples (towards the viewer), a pixel's together; minus infinity where there is none. Empty without bodies.
    depths: Vec<[f32; SAMPLES]>,
    /// Nearest and farthest of a pixel.
    range: Vec<[f32; 2]>,
    /// How far behind a body's surface a thread is hidden.
    margin: f32,
}

/// A sample of a body: which one, which triangle, the corners' shares.
type Found = (u32, u32, [f32; 3]);

impl Band {
    /// Rows of one colour.
    pub fn new(rows: Range<usize>, width: usize, ground: [f32; 3]) -> Self {
        let pixels = vec![ground; rows.len() * width];
        Self { rows, width, pixels, depths: Vec::new(), range: Vec::new(), margin: 0.0 }
    }

    /// Draws bodies; threads up to `margin` behind their surface will show.
    pub fn draw_bodies(&mut self, skins: &[Skin], window: &Window, studio: &Studio, margin: f32) {
        if skins.iter().all(|skin| skin.triangles.is_empty()) {
            return;
        }
        self.margin = margin;
        self.depths = vec![[f32::NEG_INFINITY; SAMPLES]; self.pixels.len()];
        let mut found: Vec<[Found; SAMPLES]> = vec![[(0, 0, [0.0; 3]); SAMPLES]; self.pixels.len()];
        let fine = |place: [f32; 2]| place.map(|value| value * FINE as f32);
        let raster = Raster { width: self.width * FINE, rows: self.rows.start * FINE..self.rows.end * FINE };
        let (first_row, width) = (self.rows.start, self.width);
        for (body, skin) in skins.iter().enumerate() {
            for (index, triangle) in skin.triangles.iter().enumerate() {
                let corners = triangle.map(|vertex| skin.vertices[vertex as usize]);
                cover(corners.map(|corner| fine(window.place(corner))), &raster, |x, y, shares| {
                    let depth = (0..3).map(|k| shares[k] * corners[k].z).sum::<f32>();
                    let (pixel, sample) = ((y / FINE - first_row) * width + x / FINE, y % FINE * FINE + x % FINE);
                    if depth > self.depths[pixel][sample] {
                        self.depths[pixel][sample] = depth;
                        found[pixel][sample] = (body as u32, index as u32, shares);
                    }
                });
            }
        }
        self.range = self.depths.iter().map(|depths| [extreme(depths, f32::max), extreme(depths, f32::min)]).collect();
        for pixel in 0..self.pixels.len() {
            self.light_bodies(pixel, &found[pixel], skins, studio);
        }
    }

    /// Where all samples of a pixel are near each other, their mean is lit once.
    fn light_bodies(&mut self, pixel: usize, found: &[Found; SAMPLES], skins: &[Skin], studio: &Studio) {
        let covered: Vec<&Found> =
            (0..SAMPLES).filter(|k| self.depths[pixel][*k] > f32::NEG_INFINITY).map(|k| &found[k]).collect();
        if covered.is_empty() {
            return;
        }
        let at = |(body, triangle, shares): &Found| {
            let skin = &skins[*body as usize];
            let corners = skin.triangles[*triangle as usize].map(|vertex| skin.vertices[vertex as usize]);
            let normals = skin.normals[*triangle as usize];
            let place = corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2];
            (place, normals[0] * shares[0] + normals[1] * shares[1] + normals[2] * shares[2])
        };
        let whole = covered.len() == SAMPLES && self.range[pixel][0] - self.range[pixel][1] < self.margin;
        let groups = if whole { vec![&covered[..]] } else { covered.chunks(1).collect() };
        let (mut light, weight) = ([0.0; 3], 1.0 / groups.len() as f32);
        for group in groups {
            let (place, normal) = group.iter().map(|found| at(found)).reduce(|a, b| (a.0 + b.0, a.1 + b.1)).unwrap_or_default();
            let normal = normal.try_normalize(0.0).unwrap_or_else(nalgebra::Vector3::z);
            let here = studio.body(place / group.len() as f32, normal);
            (0..3).for_each(|channel| light[channel] += weight * here[channel]);
        }
        let share = covered.len() as f32 / SAMPLES as f32;
        for channel in 0..3 {
            let value = &mut self.pixels[pixel][channel];
            *value += (light[channel] - *value) * share;
        }
    }

    /// Blends light into a pixel, which must be one of the band's, as far as no body is in front.
    pub fn blend(&mut self, x: usize, y: usize, depth: f32, mut opacity: f32, light: [f32; 3]) {
        let pixel = (y - self.rows.start) * self.width + x;
        if let Some([nearest, farthest]) = self.range.get(pixel) {
            let depth = depth + self.margin;
            if depth < *farthest {
                return;
            }
            if depth < *nearest {
                let hidden = self.depths[pixel].iter().filter(|body| **body > depth).count();
                opacity *= 1.0 - hidden as f32 / SAMPLES as f32;
            }
        }
        for (value, light) in self.pixels[pixel].iter_mut().zip(light) {
            *value += (light - *value) * opacity;
        }
    }
}

fn extreme(depths: &[f32; SAMPLES], pick: fn(f32, f32) -> f32) -> f32 {
    depths.iter().copied().reduce(pick).unwrap_or(f32::NEG_INFINITY)
}
