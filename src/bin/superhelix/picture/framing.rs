//! What the cells of a picture show: every view at one scale, following the middle of the roots.
//!
//! Files:
//!
//! - `window.rs`: What part of the world a cell shows.

pub mod window;

use super::moment::Moment;
use super::view::View;
use window::Window;

/// How far bodies may make the picture larger on each side, in sizes of the strands.
const BODY_ROOM: f32 = 0.25;

/// What all cells of one view show: middle and extent, relative to the middle of the moment's roots.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    low: [f32; 3],
    high: [f32; 3],
    /// Of bodies, of which a part may be shown.
    bodies: Option<[[f32; 2]; 2]>,
}

impl Extent {
    /// Of nothing yet.
    fn new() -> Self {
        Extent { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3], bodies: None }
    }

    fn add(&mut self, moment: &Moment, view: &View) {
        let middle = view.look(middle_of_roots(moment));
        for point in moment.strands.iter().flatten() {
            let seen = view.look(*point);
            for axis in 0..3 {
                self.low[axis] = self.low[axis].min(seen[axis] - middle[axis]);
                self.high[axis] = self.high[axis].max(seen[axis] - middle[axis]);
            }
        }
        for vertex in moment.bodies.iter().flat_map(|body| &body.vertices) {
            let seen = view.look((*vertex).map(|value| value as f32).into());
            let [low, high] = self.bodies.get_or_insert([[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]]);
            for axis in 0..2 {
                low[axis] = low[axis].min(seen[axis] - middle[axis]);
                high[axis] = high[axis].max(seen[axis] - middle[axis]);
            }
        }
    }

    /// With bodies, as far as they do not make the strands too small.
    fn with_bodies(mut self) -> Self {
        let room = BODY_ROOM * (0..3).map(|axis| self.size(axis)).fold(0.0, f32::max);
        if let Some([low, high]) = self.bodies {
            for axis in 0..2 {
                self.low[axis] = self.low[axis].min(low[axis].max(self.low[axis] - room));
                self.high[axis] = self.high[axis].max(high[axis].min(self.high[axis] + room));
            }
        }
        self
    }

    /// Its size along an axis of the view.
    pub fn size(&self, axis: usize) -> f32 {
        self.high[axis] - self.low[axis]
    }
}

/// The middle of a moment's roots: cells follow it, so that a walking head stays in the picture.
fn middle_of_roots(moment: &Moment) -> [f32; 3] {
    let count = moment.strands.len() as f64;
    [0, 1, 2].map(|axis| (moment.strands.iter().map(|strand| f64::from(strand[0][axis])).sum::<f64>() / count) as f32)
}

/// Views of some moments.
#[derive(Debug, Clone)]
pub struct Framing {
    /// What is drawn, each with its extent.
    pub views: Vec<(View, Extent)>,
    /// Width and height of a cell, pixels.
    pub cell: [u32; 2],
    /// Pixels a unit.
    pub scale: f32,
    /// The largest width of the views, file units.
    pub wide: f32,
}

/// Looks at moments one after the other before they are drawn.
#[derive(Debug)]
pub struct Finder {
    views: Vec<(View, Extent)>,
}

impl Finder {
    /// For some views, at least one.
    pub fn new(views: &[View]) -> Self {
        Self { views: views.iter().map(|view| (*view, Extent::new())).collect() }
    }

    /// Takes a moment of at least one strand.
    pub fn add(&mut self, moment: &Moment) {
        self.views.iter_mut().for_each(|(view, extent)| extent.add(moment, view));
    }

    /// Cells of a width (pixels) that show all moments; `shape` is the least and the most of their height over their width, `label` pixels of
    /// the height are kept free.
    pub fn framing(self, cell_width: u32, shape: [f32; 2], label: f32) -> Framing {
        let views: Vec<(View, Extent)> = self.views.into_iter().map(|(view, extent)| (view, extent.with_bodies())).collect();
        let largest = |axis: usize| views.iter().map(|(_, extent)| extent.size(axis)).fold(0.0, f32::max).max(f32::MIN_POSITIVE);
        let (wide, high) = (largest(0), largest(1));
        let width = cell_width as f32;
        let height = (width * (high / wide).clamp(shape[0], shape[1])).round();
        // A border of 6 % keeps strands off the cell's edge.
        let scale = (0.88 * width / wide).min((0.88 * height - label) / high);
        Framing { views, cell: [cell_width, height as u32], scale, wide }
    }
}

impl Framing {
    /// What view number `index` shows of a moment.
    pub fn window(&self, index: usize, moment: &Moment) -> Window {
        let (view, extent) = &self.views[index];
        let middle = view.look(middle_of_roots(moment));
        let between = |axis: usize| middle[axis] + (extent.low[axis] + extent.high[axis]) / 2.0;
        Window {
            cell: self.cell.map(|side| side as f32),
            middle: [between(0), between(1)],
            scale: self.scale,
            depth: [middle[2] + extent.low[2], middle[2] + extent.high[2]],
        }
    }
}
