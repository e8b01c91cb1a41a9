//! Strands as lit threads: sorted by depth, dimmer with distance, each with a thin dark edge that parts it from those behind.

use tiny_skia::{LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

use super::bodies::Cover;
use super::colour::Colour;
use super::view::View;

/// How large a cell is and what part of the world it shows.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// Width and height of the cell, pixels.
    pub cell: [f32; 2],
    /// What lies in the middle of the cell (right, up), in the view's axes.
    pub middle: [f32; 2],
    /// Pixels a unit.
    pub scale: f32,
    /// Nearest and farthest, towards the viewer, for dimming.
    pub depth: [f32; 2],
}

impl Window {
    /// Where a point of the view is in the cell, pixels.
    pub fn place(&self, right: f32, up: f32) -> [f32; 2] {
        let [width, height] = self.cell;
        [width / 2.0 + (right - self.middle[0]) * self.scale, height / 2.0 - (up - self.middle[1]) * self.scale]
    }
}

/// How far behind a body's surface, in pixels, a thread is hidden: less is the surface's and the thread's own coarseness.
const BEHIND: f32 = 3.0;

/// Edges of a strand that are drawn, sorted and lit as one.
const EDGES_A_PIECE: usize = 3;

struct Piece {
    depth: f32,
    colour: Colour,
    points: Vec<[f32; 2]>,
}

/// Draws strands into a cell, but for what `cover` hides. `pen` is the width of a thread in pixels.
pub fn draw(
    pixmap: &mut Pixmap,
    strands: &[&[[f32; 3]]],
    colours: &[Colour],
    view: &View,
    window: &Window,
    cover: &Cover,
    pen: f32,
) {
    let mut pieces = Vec::new();
    for (strand, colour) in strands.iter().zip(colours) {
        let seen: Vec<[f32; 3]> = strand.iter().map(|point| view.look(*point)).collect();
        let mut start = 0;
        while start + 1 < seen.len() {
            let end = (start + EDGES_A_PIECE).min(seen.len() - 1);
            let middle = seen[(start + end) / 2];
            if !cover.hides(window.place(middle[0], middle[1]), middle[2], BEHIND / window.scale) {
                pieces.push(piece(&seen[start..=end], *colour, window));
            }
            start = end;
        }
    }
    // Stable, so that pieces at the same depth keep the order of the file: the same picture every time.
    pieces.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    let edge = Stroke { width: pen * 2.2, line_cap: LineCap::Butt, line_join: LineJoin::Round, ..Stroke::default() };
    let thread = Stroke { width: pen, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    let mut paint = Paint::default();
    for piece in &pieces {
        let mut builder = PathBuilder::new();
        builder.move_to(piece.points[0][0], piece.points[0][1]);
        for point in &piece.points[1..] {
            builder.line_to(point[0], point[1]);
        }
        // A piece without extent (a doubled point, a strand seen end on) has nothing to draw.
        let Some(path) = builder.finish() else { continue };
        paint.set_color(Colour::CELL.lit(0.55).to_skia(0.35));
        pixmap.stroke_path(&path, &paint, &edge, Transform::identity(), None);
        paint.set_color(piece.colour.to_skia(0.92));
        pixmap.stroke_path(&path, &paint, &thread, Transform::identity(), None);
    }
}

fn piece(seen: &[[f32; 3]], colour: Colour, window: &Window) -> Piece {
    let depth = seen.iter().map(|point| point[2]).sum::<f32>() / seen.len() as f32;
    let (first, last) = (seen[0], seen[seen.len() - 1]);
    let along = nalgebra::Vector3::from(last) - nalgebra::Vector3::from(first);
    // Light from above the viewer's left shoulder: a thread is bright where it lies across the light (Kajiya and Kay 1989).
    let light = nalgebra::Vector3::new(-0.45, 0.62, 0.64).normalize();
    let across = along.try_normalize(0.0).map_or(1.0, |along| (1.0 - along.dot(&light).powi(2)).max(0.0).sqrt());
    // Strands in one plane facing the viewer are all as near as can be.
    let room = window.depth[1] - window.depth[0];
    let nearness = if room > 0.0 { ((depth - window.depth[0]) / room).clamp(0.0, 1.0) } else { 1.0 };
    let lit = colour.lit(0.45 + 0.6 * across).mixed(Colour::WHITE, 0.35 * across.powi(24) * nearness);
    Piece {
        depth,
        colour: lit.mixed(Colour::CELL, 0.62 * (1.0 - nearness)),
        points: seen.iter().map(|point| window.place(point[0], point[1])).collect(),
    }
}
