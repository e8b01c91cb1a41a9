//! Places follicles by texture coordinates.

use std::ops::RangeInclusive;

use super::{BORDER, Follicle, Scalp};
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::random::Seeded;

/// Approximate number of triangles per cell of the grid.
const CROWD: usize = 2;
/// Attempts to offset a follicle without leaving the scalp, each half as far as the one before.
const TRIES: u32 = 8;

/// Random offsets in texture coordinates, which hide rows (Bergbom 2007, section 5.4.1: a regular layout looks like "Manhattan").
///
/// ```
/// use superhelix::hair::{Jitter, Scalp};
/// use superhelix::nalgebra::Vector3;
///
/// let corners = vec![Vector3::zeros(), Vector3::new(0.3, 0.0, 0.0), Vector3::new(0.0, 0.3, 0.0)];
/// let uvs = vec![[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]];
/// let scalp = Scalp::new(corners, vec![[0, 1, 2]], Some(uvs), Vector3::x())?;
/// let follicles = scalp.follicles_at(&[[0.25, 0.25]], Jitter { amplitude: 0.0, seed: 0 })?;
/// assert!((scalp.place(&follicles[0]) - Vector3::new(0.075, 0.075, 0.0)).norm() < 1e-9);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jitter {
    /// The largest offset in u and in v; 0 for none.
    pub amplitude: f64,
    /// Seed.
    pub seed: u64,
}

/// Triangles over the texture plane, in a search grid.
struct Atlas<'a> {
    uvs: &'a [[[f64; 2]; 3]],
    low: [f64; 2],
    cell: [f64; 2],
    cells: [usize; 2],
    /// The start of each cell's list.
    starts: Vec<usize>,
    list: Vec<u32>,
}

impl<'a> Atlas<'a> {
    fn new(uvs: &'a [[[f64; 2]; 3]]) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for uv in uvs.iter().flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(uv[axis]);
                high[axis] = high[axis].max(uv[axis]);
            }
        }
        let side = ((uvs.len() / CROWD).max(1) as f64).sqrt().ceil() as usize;
        let cells = [side, side];
        let cell = [0, 1].map(|axis| ((high[axis] - low[axis]) / side as f64).max(1e-300));
        let mut atlas = Self { uvs, low, cell, cells, starts: vec![0; side * side + 1], list: Vec::new() };
        for pass in 0..2 {
            let mut next = atlas.starts.clone();
            for (index, corners) in uvs.iter().enumerate() {
                let rows = atlas.range(1, corners);
                let columns = atlas.range(0, corners);
                for row in rows {
                    for column in columns.clone() {
                        let at = row * side + column;
                        if pass == 0 {
                            next[at + 1] += 1;
                        } else {
                            atlas.list[next[at]] = index as u32;
                            next[at] += 1;
                        }
                    }
                }
            }
            if pass == 0 {
                for at in 0..side * side {
                    next[at + 1] += next[at];
                }
                atlas.list = vec![0; next[side * side]];
                atlas.starts = next;
            }
        }
        atlas
    }

    /// The cells along an axis that a triangle may overlap.
    fn range(&self, axis: usize, corners: &[[f64; 2]; 3]) -> RangeInclusive<usize> {
        let values = corners.map(|uv| uv[axis]);
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // A little wider: a place on a border must find the triangles on both sides.
        let more = BORDER * (most - least) + BORDER * self.cell[axis];
        self.column(axis, least - more)..=self.column(axis, most + more)
    }

    fn column(&self, axis: usize, value: f64) -> usize {
        // Clamped to the border; NaN does not get here.
        (((value - self.low[axis]) / self.cell[axis]).max(0.0) as usize).min(self.cells[axis] - 1)
    }

    /// The place with these coordinates; if there are several (an overlapping texture), that of the first triangle.
    fn find(&self, uv: [f64; 2]) -> Option<Follicle> {
        let at = self.column(1, uv[1]) * self.cells[0] + self.column(0, uv[0]);
        let mut found: Option<u32> = None;
        let mut shares = [0.0; 2];
        for index in &self.list[self.starts[at]..self.starts[at + 1]] {
            let [a, b, c] = self.uvs[*index as usize];
            let edge = |p: [f64; 2]| [p[0] - a[0], p[1] - a[1]];
            let (e1, e2, p) = (edge(b), edge(c), edge(uv));
            let turn = e1[0] * e2[1] - e1[1] * e2[0];
            if turn == 0.0 {
                continue;
            }
            let (x, y) = ((p[0] * e2[1] - p[1] * e2[0]) / turn, (e1[0] * p[1] - e1[1] * p[0]) / turn);
            if x >= -BORDER && y >= -BORDER && x + y <= 1.0 + BORDER && found.is_none_or(|before| *index < before) {
                let (x, y) = (x.max(0.0), y.max(0.0));
                let over = (x + y).max(1.0);
                found = Some(*index);
                shares = [x / over, y / over];
            }
        }
        found.map(|triangle| Follicle { triangle, shares })
    }
}

impl Scalp {
    /// The follicles at given texture coordinates, each first offset at random by up to `jitter` (or by less where that would
    /// leave the scalp).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a scalp without texture coordinates, numbers that are not finite, or coordinates without a
    /// triangle, naming the first.
    pub fn follicles_at(&self, uvs: &[[f64; 2]], jitter: Jitter) -> Result<Vec<Follicle>> {
        let Some(own) = &self.uvs else {
            return Err(Error::invalid("scalp", "without texture coordinates", "one that was made with them"));
        };
        check_not_negative(|| "jitter".into(), jitter.amplitude)?;
        let atlas = Atlas::new(own);
        let numbers = [9, 10].map(|purpose| Seeded::new(jitter.seed, purpose));
        let mut follicles = Vec::with_capacity(uvs.len());
        for (index, uv) in uvs.iter().enumerate() {
            for axis in 0..2 {
                check_finite(|| format!("uvs[{index}][{axis}]"), uv[axis])?;
            }
            let there = atlas.find(*uv).ok_or_else(|| {
                Error::invalid(format!("uvs[{index}]"), format!("{uv:?}"), "coordinates that lie on a triangle of the scalp")
            })?;
            let offset = numbers.map(|numbers| jitter.amplitude * (2.0 * numbers.unit(index as u64) - 1.0));
            let offsets = (0..TRIES).map(|k| 0.5_f64.powi(k as i32)).take_while(|_| jitter.amplitude > 0.0);
            let mut tries = offsets.filter_map(|fraction| atlas.find([0, 1].map(|axis| uv[axis] + fraction * offset[axis])));
            follicles.push(tries.next().unwrap_or(there));
        }
        Ok(follicles)
    }
}
