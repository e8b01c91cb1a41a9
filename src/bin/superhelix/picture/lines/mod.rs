//! Strands as lines that can be told apart: coloured by their roots, sorted by depth, dimmer with distance, each with a thin dark edge that
//! parts it from those behind.
//!
//! Files:
//!
//! - `cover.rs`: Bodies behind and among the strands: shaded, and hiding what is behind them.

mod cover;

use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Rect, Stroke, Transform};

use super::colour::Colour;
use super::framing::window::Window;
use super::moment::Moment;
use super::view::View;
use cover::Cover;

/// How far behind a body's surface, in pixels, a thread is hidden: less is the surface's and the thread's own coarseness.
const BEHIND: f32 = 3.0;

/// Edges of a strand that are drawn, sorted and lit as one.
const EDGES_A_PIECE: usize = 3;

struct Piece {
    depth: f32,
    colour: Colour,
    points: Vec<[f32; 2]>,
}

/// Draws a moment whose strands have such colours, in a cell of a sheet whose pen for one strand would be 2.6 pixels wide at the usual size.
pub fn draw(moment: &Moment, view: &View, window: &Window, colours: &[Colour]) -> Option<Pixmap> {
    let [width, height] = window.cell;
    let mut pixmap = Pixmap::new(width as u32, height as u32)?;
    paint_ground(&mut pixmap);
    let cover = Cover::of(&moment.bodies, view, window);
    cover.draw(&mut pixmap);
    // Few strands get a pen one can see, many a fine one that lets them be told apart.
    let pen =
        (2.6 - 0.55 * (moment.strands.len().max(1) as f32).log10()).clamp(0.75, 2.4) * (width / 340.0).clamp(0.5, 3.0).sqrt();
    let mut pieces = Vec::new();
    for (strand, colour) in moment.strands.iter().zip(colours) {
        let seen: Vec<[f32; 3]> = strand.iter().map(|point| view.look(*point)).collect();
        let mut start = 0;
        while start + 1 < seen.len() {
            let end = (start + EDGES_A_PIECE).min(seen.len() - 1);
            let middle = seen[(start + end) / 2];
            if !cover.hides(window.place(middle.into()), middle[2], BEHIND / window.scale) {
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
    Some(pixmap)
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
        points: seen.iter().map(|point| window.place((*point).into())).collect(),
    }
}

/// A ground that is a little lighter above.
fn paint_ground(cell: &mut Pixmap) {
    let (width, height) = (cell.width() as f32, cell.height() as f32);
    let bands = 48;
    for band in 0..bands {
        let share = band as f32 / bands as f32;
        let (top, below) = ((share * height).floor(), ((band + 1) as f32 / bands as f32 * height).floor());
        if let Some(rect) = Rect::from_xywh(0.0, top, width, below - top) {
            let mut paint = Paint::default();
            paint.set_color(Colour::CELL.lit(1.22 - 0.34 * share).to_skia(1.0));
            paint.anti_alias = false;
            cell.fill_path(&PathBuilder::from_rect(rect), &paint, FillRule::Winding, Transform::identity(), None);
        }
    }
    if let Some(rect) = Rect::from_xywh(0.5, 0.5, width - 1.0, height - 1.0) {
        let mut paint = Paint::default();
        paint.set_color(Colour::RULE.to_skia(1.0));
        cell.stroke_path(&PathBuilder::from_rect(rect), &paint, &Stroke::default(), Transform::identity(), None);
    }
}
