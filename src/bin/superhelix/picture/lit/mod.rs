//! Hair as it looks: threads lit by lamps and each other, bodies among them, on a quiet ground. No GPU; the same bytes for any number of
//! threads.
//!
//! Files:
//!
//! - `band.rs`: Some rows of a picture while it is made.
//! - `depth_map.rs`: Surfaces of bodies as a light sees them (a shadow map, Williams 1978).
//! - `eyes.rs`: Balls in a head's empty eye sockets, so that it does not look hollow.
//! - `fibre.rs`: How a hair scatters light: Marschner et al. 2003 ("Light scattering from human hair fibers") in the closed form of Karis 2016 ("Physically based hair shading in Unreal", SIGGRAPH course).
//! - `hair_colour.rs`: Colours of hair.
//! - `ribbons.rs`: Threads as ribbons that face the viewer: edges sorted from far to near, each blended by the share of a pixel that it covers.
//! - `shade_map.rs`: How much of a light reaches a place.
//! - `skin.rs`: The surface of a body, in a view's axes, with normals that are smooth where the surface is.
//! - `studio.rs`: The lights of a picture: a key from above the viewer's left shoulder, a rim from behind on the right, and a bright room about them.
//! - `threads.rs`: The hair of a picture, in a view's axes.
//! - `tone.rs`: From linear light to a screen.
//! - `triangle.rs`: The samples of a raster that a triangle covers.

mod band;
mod depth_map;
mod eyes;
mod fibre;
mod hair_colour;
mod ribbons;
mod shade_map;
mod skin;
mod studio;
mod threads;
mod tone;
mod triangle;

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use tiny_skia::Pixmap;

use super::framing::window::Window;
use super::moment::Moment;
use super::view::View;
use band::Band;
use depth_map::DepthMap;
use fibre::Fibre;
pub use hair_colour::HairColour;
use ribbons::{Ribbons, direction};
use skin::Skin;
use studio::{Dye, Studio};
use threads::{Threads, random};

/// Rows that are drawn together.
const BAND: usize = 16;
/// Threads are as wide as covers the box about the hair so often, but no wider than this share of the box's side.
const COVERS: f32 = 9.0;
const WIDEST: f32 = 0.0022;
/// How far behind a body's surface threads show, as a share of the picture's height: roots lie in the skin.
const SUNK: f32 = 0.004;
/// Edges of a strand between points at which shadows are looked up.
const SHADED_APART: usize = 6;
/// Texels each way of the map that says what bodies hide.
const HIDDEN_BY: usize = 256;
/// Strands that are lit together.
const LIT_TOGETHER: usize = 64;

/// How hair is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    /// Its colour.
    pub colour: HairColour,
    /// Width of a thread at its root, file units.
    pub width: f32,
}

impl Look {
    /// Threads of a width that makes a head of hair of them, however many there are.
    pub fn fitting(colour: HairColour, moment: &Moment, view: &View) -> Self {
        let (mut low, mut high, mut length) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2], 0.0f64);
        for strand in &moment.strands {
            for point in strand {
                let seen = view.look(*point);
                for axis in 0..2 {
                    (low[axis], high[axis]) = (low[axis].min(seen[axis]), high[axis].max(seen[axis]));
                }
            }
            length +=
                strand.windows(2).map(|edge| f64::from((Vector3::from(edge[1]) - Vector3::from(edge[0])).norm())).sum::<f64>();
        }
        let side = ((high[0] - low[0]) * (high[1] - low[1])).max(0.0).sqrt().max(0.3 * (high[1] - low[1]));
        let width = COVERS * side * side / (length as f32).max(f32::MIN_POSITIVE);
        Self { colour, width: width.min(WIDEST * side) }
    }
}

/// Draws a moment.
pub fn draw(moment: &Moment, view: &View, window: &Window, look: &Look) -> Option<Pixmap> {
    let [width, height] = window.cell.map(|side| side as usize);
    let mut picture = Pixmap::new(width as u32, height as u32)?;
    // Numbers are small and floats fine near the middle of the picture.
    let middle = [window.middle[0], window.middle[1], window.depth[1]];
    let seen = |point: [f32; 3]| {
        let point = view.look(point);
        [0, 1, 2].map(|axis| point[axis] - middle[axis])
    };
    let window = Window { middle: [0.0; 2], ..*window };
    let threads = Threads::new(&moment.strands, look.width, seen);
    let skins: Vec<Skin> = moment.bodies.iter().map(|body| Skin::of(&eyes::filled(body), seen)).collect();
    let studio = Studio::new(&threads, &skins);
    let shown = shown(&threads, &skins);
    let lights = light(&threads, &shown, &studio, &look.colour);
    let ribbons = Ribbons::new(&threads, &shown, &lights, &window);
    let lists = ribbons.share_out(BAND, height.div_ceil(BAND));
    let margin = SUNK * window.cell[1] / window.scale;
    picture.pixels_mut().par_chunks_mut(BAND * width).zip(&lists).enumerate().for_each(|(index, (pixels, edges))| {
        let first = index * BAND;
        let mut band = Band::new(first..(first + BAND).min(height), width, [0.0; 3]);
        for (row, pixels) in band.pixels.chunks_exact_mut(width).enumerate() {
            pixels.fill(tone::ground((first + row) as f32 / height as f32));
        }
        band.draw_bodies(&skins, &window, &studio, margin);
        edges.iter().for_each(|edge| ribbons.draw(*edge, &mut band));
        for (pixel, light) in pixels.iter_mut().zip(&band.pixels) {
            *pixel = tone::shown(*light);
        }
    });
    Some(picture)
}

/// Which points are not well behind a body, as the viewer sees them: the others need neither light nor drawing.
fn shown(threads: &Threads, skins: &[Skin]) -> Vec<bool> {
    let map = DepthMap::of(skins, threads, &Matrix3::identity(), HIDDEN_BY);
    threads.points.par_iter().map(|point| map.open(*point) > 0.0).collect()
}

/// What every point of every thread sends to the viewer; nothing where it is not shown.
fn light(threads: &Threads, shown: &[bool], studio: &Studio, colour: &HairColour) -> Vec<[f32; 3]> {
    let mut lights = vec![[0.0; 3]; threads.points.len()];
    let mut parts = Vec::new();
    let mut rest = &mut lights[..];
    for first in (0..threads.widths.len()).step_by(LIT_TOGETHER) {
        let last = (first + LIT_TOGETHER).min(threads.widths.len());
        let (part, behind) = rest.split_at_mut(threads.starts[last] - threads.starts[first]);
        parts.push((first..last, part));
        rest = behind;
    }
    parts.into_par_iter().for_each(|(range, mut part)| {
        for thread in range {
            let number = |purpose: u32| 2.0 * random(thread as u32, purpose) - 1.0;
            let dye = Studio::dye(Fibre { colour: colour.of_thread(number(2), number(3)), tilt: 0.03 * number(4) });
            let range = threads.starts[thread]..threads.starts[thread + 1];
            let (points, shown) = (&threads.points[range.clone()], &shown[range]);
            let (own, rest) = part.split_at_mut(points.len());
            light_thread(points, shown, studio, &dye, own);
            part = rest;
        }
    });
    lights
}

/// What reaches a hair changes slowly along it; what it does with that need not.
fn light_thread(points: &[Vector3<f32>], shown: &[bool], studio: &Studio, dye: &Dye, lights: &mut [[f32; 3]]) {
    let last = points.len() - 1;
    let shade = |k: usize| studio.shade(points[k], direction(points, k), dye);
    let mut before = None;
    for start in (0..last).step_by(SHADED_APART) {
        let end = (start + SHADED_APART).min(last);
        if !shown[start..=end].contains(&true) {
            before = None;
            continue;
        }
        let (from, to) = (before.unwrap_or_else(|| shade(start)), shade(end));
        for k in start..=end {
            let here = from.mixed(&to, (k - start) as f32 / (end - start) as f32);
            lights[k] = studio.hair(&here, direction(points, k), dye);
        }
        before = Some(to);
    }
}
