//! The contact sheet: frames from left to right, the front view above the side view, all at one scale.

use tiny_skia::{FillRule, Paint, PathBuilder, Pixmap, PixmapPaint, Rect, Stroke, Transform};

use super::bodies::Cover;
use super::colour::{self, Colour};
use super::lettering;
use super::strands::{self, Window};
use super::view::{Face, Up, View};
use crate::failure::Failure;
use crate::surface::Surface;

/// One moment of the motion.
#[derive(Debug, Clone)]
pub struct Moment {
    /// What stands above it: a time or a frame number.
    pub label: String,
    /// Points of each strand, root first; the same strands in every moment.
    pub strands: Vec<Vec<[f32; 3]>>,
    /// Bodies among them, in the same units.
    pub bodies: Vec<Surface>,
}

/// How the sheet is made.
#[derive(Debug, Clone)]
pub struct SheetOptions {
    /// Stands above everything.
    pub title: String,
    /// The axis that points up.
    pub up: Up,
    /// The axis that the face looks along.
    pub face: Option<Face>,
    /// Width of a cell, pixels.
    pub cell_width: u32,
    /// Metres a unit, if known: the scale bar then has a length in centimetres.
    pub metres_per_unit: Option<f64>,
}

const MARGIN: f32 = 28.0;
const GAP: f32 = 6.0;
const HEAD: f32 = 74.0;
const FOOT: f32 = 34.0;
/// How far bodies may make the picture larger on each side, in sizes of the strands.
const BODY_ROOM: f32 = 0.15;

/// What all cells of one view show: middle and extent, relative to the middle of the moment's roots.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: [f32; 3],
    high: [f32; 3],
}

impl Extent {
    fn of(moments: &[Moment], middles: &[[f32; 3]], view: &View) -> Self {
        let mut extent = Extent { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };
        for (moment, middle) in moments.iter().zip(middles) {
            let middle = view.look(*middle);
            for point in moment.strands.iter().flatten() {
                let seen = view.look(*point);
                for axis in 0..3 {
                    extent.low[axis] = extent.low[axis].min(seen[axis] - middle[axis]);
                    extent.high[axis] = extent.high[axis].max(seen[axis] - middle[axis]);
                }
            }
        }
        extent.grow_to_bodies(moments, middles, view);
        extent
    }

    /// Bodies are in the picture as well, as far as they do not make the strands too small.
    fn grow_to_bodies(&mut self, moments: &[Moment], middles: &[[f32; 3]], view: &View) {
        let room = BODY_ROOM * (0..3).map(|axis| self.size(axis)).fold(0.0, f32::max);
        let (least, most) = (self.low.map(|low| low - room), self.high.map(|high| high + room));
        for (moment, middle) in moments.iter().zip(middles) {
            let middle = view.look(*middle);
            for vertex in moment.bodies.iter().flat_map(|body| &body.vertices) {
                let seen = view.look((*vertex).map(|value| value as f32).into());
                for axis in 0..2 {
                    let at = (seen[axis] - middle[axis]).clamp(least[axis], most[axis]);
                    self.low[axis] = self.low[axis].min(at);
                    self.high[axis] = self.high[axis].max(at);
                }
            }
        }
    }

    fn size(&self, axis: usize) -> f32 {
        self.high[axis] - self.low[axis]
    }
}

/// The middle of a moment's roots: the cells follow it, so that a walking head stays in the picture.
fn middle_of_roots(moment: &Moment) -> [f32; 3] {
    let count = moment.strands.len() as f64;
    [0, 1, 2].map(|axis| (moment.strands.iter().map(|strand| f64::from(strand[0][axis])).sum::<f64>() / count) as f32)
}

/// Draws a sheet. There must be at least one moment, each with the same number of strands, at least one.
pub fn draw(moments: &[Moment], options: &SheetOptions) -> Result<Pixmap, Failure> {
    let views = View::pair(options.up, options.face)?;
    let middles: Vec<[f32; 3]> = moments.iter().map(middle_of_roots).collect();
    let extents = views.map(|view| Extent::of(moments, &middles, &view));
    let wide = extents.iter().map(|extent| extent.size(0)).fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let high = extents.iter().map(|extent| extent.size(1)).fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let cell_width = options.cell_width as f32;
    let cell_height = (cell_width * (high / wide).clamp(0.75, 1.6)).round();
    // A border of 6 % keeps strands off the cell's edge, and the label's line keeps free of them.
    let scale = (0.88 * cell_width / wide).min((0.88 * cell_height - 14.0) / high);

    let width = 2.0 * MARGIN + moments.len() as f32 * (cell_width + GAP) - GAP;
    let height = HEAD + views.len() as f32 * (cell_height + GAP) - GAP + FOOT;
    let mut sheet = Pixmap::new(width as u32, height as u32).ok_or_else(|| {
        Failure::Other(format!("a picture of {width} by {height} pixels cannot be made: ask for fewer or smaller frames"))
    })?;
    sheet.fill(Colour::PAPER.to_skia(1.0));
    let title_height = fitting_height(&options.title, 15.0, width - 2.0 * MARGIN);
    lettering::draw(&mut sheet, &options.title, MARGIN, 32.0, title_height, Colour::LABEL);

    let first_roots: Vec<[f32; 3]> = moments[0].strands.iter().map(|strand| views[0].look(strand[0])).collect();
    let colours = colour::by_root(&first_roots);
    let longest = moments[0].strands.len().max(1);
    // Few strands get a pen one can see, many a fine one that lets them be told apart.
    let pen = (2.6 - 0.55 * (longest as f32).log10()).clamp(0.75, 2.4) * (cell_width / 340.0).clamp(0.5, 3.0).sqrt();

    for (column, moment) in moments.iter().enumerate() {
        let x = MARGIN + column as f32 * (cell_width + GAP);
        let label_height = fitting_height(&moment.label, 11.0, cell_width);
        lettering::draw(&mut sheet, &moment.label, x, HEAD - 10.0, label_height, Colour::LABEL);
        for (row, view) in views.iter().enumerate() {
            let y = HEAD + row as f32 * (cell_height + GAP);
            let Some(mut cell) = Pixmap::new(cell_width as u32, cell_height as u32) else { continue };
            paint_ground(&mut cell);
            let (extent, middle) = (extents[row], view.look(middles[column]));
            let between = |axis: usize| middle[axis] + (extent.low[axis] + extent.high[axis]) / 2.0;
            let window = Window {
                cell: [cell_width, cell_height],
                middle: [between(0), between(1)],
                scale,
                depth: [middle[2] + extent.low[2], middle[2] + extent.high[2]],
            };
            let cover = Cover::of(&moment.bodies, view, &window);
            cover.draw(&mut cell);
            let drawn: Vec<&[[f32; 3]]> = moment.strands.iter().map(Vec::as_slice).collect();
            strands::draw(&mut cell, &drawn, &colours, view, &window, &cover, pen);
            lettering::draw(&mut cell, view.name, 10.0, 21.0, 9.0, Colour::FAINT);
            sheet.draw_pixmap(x as i32, y as i32, cell.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        }
    }
    let bar = scale_bar(wide, scale, options.metres_per_unit);
    draw_scale_bar(&mut sheet, MARGIN, height - 14.0, &bar);
    Ok(sheet)
}

/// The height of letters, at most `height`, at which a text is no wider than `room`.
fn fitting_height(text: &str, height: f32, room: f32) -> f32 {
    let width = lettering::width(text, height);
    if width > room { height * room / width } else { height }
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

/// A round length, about a third of a cell: pixels and its label.
#[derive(Debug, Clone, PartialEq)]
struct ScaleBar {
    pixels: f32,
    label: String,
}

fn scale_bar(wide: f32, scale: f32, metres_per_unit: Option<f64>) -> ScaleBar {
    let wanted = f64::from(wide) / 3.0 * metres_per_unit.unwrap_or(1.0);
    let decade = 10f64.powf(wanted.log10().floor());
    let round =
        [5.0, 2.0, 1.0].into_iter().map(|step| step * decade).find(|length| *length <= wanted * (1.0 + 1e-9)).unwrap_or(decade);
    let pixels = (round / metres_per_unit.unwrap_or(1.0)) as f32 * scale;
    let number = |value: f64| format!("{}", (value * 1e6).round() / 1e6);
    let label = match metres_per_unit {
        Some(_) if round >= 0.999 => format!("{} m", number(round)),
        Some(_) if round >= 0.00999 => format!("{} cm", number(round * 100.0)),
        Some(_) => format!("{} mm", number(round * 1000.0)),
        None => format!("{} units", number(round)),
    };
    ScaleBar { pixels, label }
}

fn draw_scale_bar(sheet: &mut Pixmap, x: f32, y: f32, bar: &ScaleBar) {
    let mut builder = PathBuilder::new();
    builder.move_to(x, y - 7.0);
    builder.line_to(x, y);
    builder.line_to(x + bar.pixels, y);
    builder.line_to(x + bar.pixels, y - 7.0);
    if let Some(path) = builder.finish() {
        let mut paint = Paint::default();
        paint.set_color(Colour::LABEL.to_skia(1.0));
        let stroke = Stroke { width: 1.6, ..Stroke::default() };
        sheet.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
    }
    lettering::draw(sheet, &bar.label, x + bar.pixels + 9.0, y, 9.0, Colour::LABEL);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_bar_is_round_and_true() {
        let bar = scale_bar(0.7, 500.0, Some(1.0));
        assert_eq!(bar, ScaleBar { pixels: 100.0, label: "20 cm".into() });
        let bar = scale_bar(70.0, 5.0, Some(0.01));
        assert_eq!(bar.label, "20 cm");
        assert!((bar.pixels - 100.0).abs() < 1e-3);
        assert_eq!(scale_bar(70.0, 5.0, None).label, "20 units");
        assert_eq!(scale_bar(0.02, 5000.0, Some(1.0)).label, "5 mm");
        assert_eq!(scale_bar(9.0, 50.0, Some(1.0)).label, "2 m");
    }

    #[test]
    fn strands_are_drawn_in_their_cell_and_move_with_the_motion() {
        let strand = |shift: f32, tip: f32| vec![[shift, 0.0, 0.0], [shift + tip, -0.1, 0.0], [shift + tip, -0.2, 0.0]];
        let moment = |shift: f32, tip: f32| Moment {
            label: "t".into(),
            strands: vec![strand(shift, tip), strand(shift + 0.1, tip)],
            bodies: Vec::new(),
        };
        let options = SheetOptions { title: "t".into(), up: Up::Y, face: None, cell_width: 200, metres_per_unit: Some(1.0) };
        let cell_of = |moments: &[Moment], column: usize| {
            let sheet = draw(moments, &options).unwrap();
            let left = MARGIN as u32 + column as u32 * (200 + GAP as u32);
            (left + 2..left + 198)
                .flat_map(|x| (HEAD as u32 + 30..HEAD as u32 + 140).map(move |y| (x, y)))
                .map(|(x, y)| sheet.pixel(x, y).unwrap())
                .collect::<Vec<_>>()
        };
        let same = [moment(0.0, 0.0), moment(0.0, 0.05)];
        let carried = [moment(0.0, 0.0), moment(7.0, 0.05)];
        let bright = |cell: &[tiny_skia::PremultipliedColorU8]| {
            cell.iter().filter(|pixel| pixel.red().max(pixel.green()).max(pixel.blue()) > 90).count()
        };
        assert!(bright(&cell_of(&same, 0)) > 50);
        assert_ne!(cell_of(&same, 0), cell_of(&same, 1), "a bent strand must look bent");
        let (here, there) = (bright(&cell_of(&same, 1)), bright(&cell_of(&carried, 1)));
        assert!(here.abs_diff(there) < here / 5, "cells follow the roots: {here} and {there} bright pixels");
    }
}
