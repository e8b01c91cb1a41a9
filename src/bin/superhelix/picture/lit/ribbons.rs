//! Threads as ribbons that face the viewer: edges sorted from far to near, each blended by the share of a pixel that it covers.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::band::Band;
use super::threads::{Threads, taper};
use crate::picture::framing::window::Window;

/// How much a thread hides where it covers all of a pixel.
const OPACITY: f32 = 0.95;

/// An end of an edge in a picture.
#[derive(Debug, Clone, Copy)]
struct End {
    /// Pixels, y down.
    at: [f32; 2],
    /// Towards the viewer, file units.
    depth: f32,
    /// Pixels.
    width: f32,
    /// Linear.
    light: [f32; 3],
}

/// The edges of all threads, from far to near.
#[derive(Debug)]
pub struct Ribbons<'a> {
    threads: &'a Threads,
    lights: &'a [[f32; 3]],
    /// Where the points are in the picture.
    places: Vec<[f32; 2]>,
    /// Pixels a unit.
    scale: f32,
    /// The point that each begins with, and its thread.
    edges: Vec<(u32, u32)>,
}

impl<'a> Ribbons<'a> {
    /// Sorts the edges of threads whose points have such light, but for those of which neither end is shown.
    pub fn new(threads: &'a Threads, shown: &[bool], lights: &'a [[f32; 3]], window: &Window) -> Self {
        let mut keys: Vec<(u32, u32, u32)> = Vec::with_capacity(threads.points.len());
        for (thread, (range, _)) in threads.strands().enumerate() {
            for point in (range.start..range.end - 1).filter(|point| shown[*point] || shown[*point + 1]) {
                let depth = threads.points[point].z + threads.points[point + 1].z;
                keys.push((sortable(depth), point as u32, thread as u32));
            }
        }
        // Edges at one depth stay in the order of the file, whoever sorts.
        keys.par_sort_unstable();
        let places = threads.points.iter().map(|point| window.place(*point)).collect();
        let scale = window.scale;
        Self { threads, lights, places, scale, edges: keys.into_iter().map(|(_, point, thread)| (point, thread)).collect() }
    }

    /// For each band of so many rows the edges that it may show, in order.
    pub fn share_out(&self, band_rows: usize, bands: usize) -> Vec<Vec<u32>> {
        let mut lists = vec![Vec::new(); bands];
        let row = |point: u32| self.places[point as usize][1];
        let band = |row: f32| (row / band_rows as f32).floor();
        for (index, (point, thread)) in self.edges.iter().enumerate() {
            let reach = 1.0 + self.threads.widths[*thread as usize] * self.scale;
            let (a, b) = (row(*point), row(point + 1));
            let (first, last) = (band(a.min(b) - reach).max(0.0), band(a.max(b) + reach).min(bands as f32 - 1.0));
            if first <= last {
                (first as usize..=last as usize).for_each(|band| lists[band].push(index as u32));
            }
        }
        lists
    }

    /// Blends an edge into a band.
    pub fn draw(&self, edge: u32, band: &mut Band) {
        let (point, thread) = self.edges[edge as usize];
        let (first, next) = (self.threads.starts[thread as usize], self.threads.starts[thread as usize + 1]);
        let width = self.threads.widths[thread as usize] * self.scale;
        let end = |point: u32| {
            let along = (point as usize - first) as f32 / (next - first - 1) as f32;
            let (at, depth) = (self.places[point as usize], self.threads.points[point as usize].z);
            End { at, depth, width: width * taper(along), light: self.lights[point as usize] }
        };
        stroke(end(point), end(point + 1), band);
    }
}

/// A number that sorts as the float does.
fn sortable(value: f32) -> u32 {
    let bits = value.to_bits();
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

/// Blends an edge: column by column where it is flat, row by row where it is steep, every one whose middle lies between the ends, so that the
/// edges of a thread neither overlap nor leave gaps.
fn stroke(mut a: End, mut b: End, band: &mut Band) {
    let flat = (b.at[0] - a.at[0]).abs() >= (b.at[1] - a.at[1]).abs();
    let (main, cross) = if flat { (0, 1) } else { (1, 0) };
    if b.at[main] < a.at[main] {
        std::mem::swap(&mut a, &mut b);
    }
    let run = b.at[main] - a.at[main];
    if run <= 0.0 || !run.is_finite() {
        return;
    }
    let slope = (b.at[cross] - a.at[cross]) / run;
    let slant = (1.0 + slope * slope).sqrt();
    let rows = (band.rows.start as f32, band.rows.end as f32);
    let columns = (0.0, band.width as f32);
    let (main_range, cross_range) = if flat { (columns, rows) } else { (rows, columns) };
    let clamped = |value: f32, (low, high): (f32, f32)| value.clamp(low, high) as usize;
    for step in clamped((a.at[main] - 0.5).ceil(), main_range)..clamped((b.at[main] - 0.5).ceil(), main_range) {
        let away = step as f32 + 0.5 - a.at[main];
        let share = away / run;
        let mix = |from: f32, to: f32| from + (to - from) * share;
        let (middle, width) = (a.at[cross] + slope * away, mix(a.width, b.width));
        // A pixel's middle this far from the ribbon's sees nothing of it; nearer, what a box of a pixel's width does.
        let (reach, most) = (0.5 * (width + 1.0), width.min(1.0));
        let depth = mix(a.depth, b.depth);
        let light = [0, 1, 2].map(|channel| mix(a.light[channel], b.light[channel]));
        let span = reach * slant;
        for other in clamped((middle - span - 0.5).ceil(), cross_range)..clamped((middle + span - 0.5).floor() + 1.0, cross_range)
        {
            let distance = (other as f32 + 0.5 - middle).abs() / slant;
            let covered = (reach - distance).min(most);
            if covered > 0.0 {
                let (x, y) = if flat { (step, other) } else { (other, step) };
                band.blend(x, y, depth, OPACITY * covered, light);
            }
        }
    }
}

/// The direction of a thread at one of its points, of length 1.
pub fn direction(points: &[Vector3<f32>], at: usize) -> Vector3<f32> {
    let (before, after) = (points[at.saturating_sub(1)], points[(at + 1).min(points.len() - 1)]);
    (after - before).try_normalize(0.0).unwrap_or_else(Vector3::y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_sort_as_their_bits() {
        let values = [f32::NEG_INFINITY, -3.5, -1e-20, 0.0, 1e-20, 2.0, f32::INFINITY];
        assert!(values.windows(2).all(|pair| sortable(pair[0]) < sortable(pair[1])));
    }

    #[test]
    fn a_thread_covers_its_area_however_it_lies_and_however_thin_it_is() {
        // The mean of the taper over the length is (1 + (1 + 0.3) / 2) / 2.
        let (length, mean) = (60.0, 0.825);
        for (turn, width) in [(0.0f32, 0.3), (0.3, 0.3), (0.9, 0.3), (1.4, 2.5), (2.6, 2.5)] {
            let window = Window { cell: [100.0, 100.0], middle: [0.0, 0.0], scale: 1.0, depth: [0.0, 1.0] };
            let strand: Vec<[f32; 3]> = (0..41)
                .map(|k| {
                    let along = (k as f32 / 40.0 - 0.5) * length;
                    [along * turn.cos(), along * turn.sin(), 0.0]
                })
                .collect();
            let mut threads = Threads::new(&[strand], width, |point| point);
            threads.widths[0] = width;
            let lights = vec![[1.0; 3]; 41];
            let ribbons = Ribbons::new(&threads, &[true; 41], &lights, &window);
            let mut band = Band::new(0..100, 100, [0.0; 3]);
            (0..40).for_each(|edge| ribbons.draw(edge, &mut band));
            let sum: f32 = band.pixels.iter().map(|pixel| pixel[0]).sum();
            let expected = OPACITY * width * length * mean;
            assert!((sum / expected - 1.0).abs() < 0.04, "{turn} {width}: {sum} for {expected}");
        }
    }
}
