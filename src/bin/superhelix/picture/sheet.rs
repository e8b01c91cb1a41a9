//! The contact sheet: moments from left to right, the views one above the other, all at one scale.
//!
//! Files:
//!
//! - `lettering.rs`: Letters as strokes: enough for labels, drawn with the same pen as the strands.

mod lettering;

use tiny_skia::{Paint, PathBuilder, Pixmap, PixmapPaint, Stroke, Transform};

use super::cell::{Manner, Pen};
use super::colour::Colour;
use super::framing::Finder;
use super::lit::HairColour;
use super::moment::Moment;
use super::view::View;
use crate::shell::failure::Failure;

/// How the sheet is made.
#[derive(Debug, Clone)]
pub struct SheetOptions {
    /// Stands above everything; none: the cells alone, without any writing.
    pub title: Option<String>,
    /// From where; at least one.
    pub views: Vec<View>,
    /// How strands are drawn.
    pub manner: Manner,
    /// Colour of hair.
    pub hair: HairColour,
    /// Width of a cell, pixels.
    pub cell_width: u32,
    /// Metres a unit, if known: the scale bar then has a length in centimetres.
    pub metres_per_unit: Option<f64>,
}

const MARGIN: f32 = 28.0;
const GAP: f32 = 6.0;
const HEAD: f32 = 74.0;
const FOOT: f32 = 34.0;
/// Height of a cell over its width.
const SHAPE: [f32; 2] = [0.75, 1.6];
/// What a view's name needs of a cell's height.
const LABEL: f32 = 14.0;

/// Draws a sheet. There must be at least one moment, each with the same number of strands, at least one. `drawn` is called after each moment.
pub fn draw(moments: &[Moment], options: &SheetOptions, drawn: impl Fn()) -> Result<Pixmap, Failure> {
    let mut finder = Finder::new(&options.views);
    moments.iter().for_each(|moment| finder.add(moment));
    let framing = finder.framing(options.cell_width, SHAPE, LABEL);
    let pen = Pen::new(options.manner, options.hair, &moments[0], &framing);
    let [cell_width, cell_height] = framing.cell.map(|side| side as f32);
    let written = options.title.is_some();
    let [margin, head, foot] = if written { [MARGIN, HEAD, FOOT] } else { [0.0; 3] };

    let width = 2.0 * margin + moments.len() as f32 * (cell_width + GAP) - GAP;
    let height = head + framing.views.len() as f32 * (cell_height + GAP) - GAP + foot;
    let too_large =
        || Failure::Other(format!("a picture of {width} by {height} pixels cannot be made: ask for fewer or smaller frames"));
    let mut sheet = Pixmap::new(width as u32, height as u32).ok_or_else(too_large)?;
    sheet.fill(Colour::PAPER.to_skia(1.0));
    if let Some(title) = &options.title {
        let title_height = fitting_height(title, 15.0, width - 2.0 * margin);
        lettering::draw(&mut sheet, title, margin, 32.0, title_height, Colour::LABEL);
    }
    for (column, moment) in moments.iter().enumerate() {
        let x = margin + column as f32 * (cell_width + GAP);
        if written {
            let label_height = fitting_height(&moment.label, 11.0, cell_width);
            lettering::draw(&mut sheet, &moment.label, x, head - 10.0, label_height, Colour::LABEL);
        }
        for (row, (view, _)) in framing.views.iter().enumerate() {
            let y = head + row as f32 * (cell_height + GAP);
            let mut cell = pen.draw(moment, &framing, row).ok_or_else(too_large)?;
            if written {
                let colour = if options.manner == Manner::Hair { Colour::CELL } else { Colour::FAINT };
                lettering::draw(&mut cell, view.name, 10.0, 21.0, 9.0, colour);
            }
            sheet.draw_pixmap(x as i32, y as i32, cell.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        }
        drawn();
    }
    if written {
        let bar = scale_bar(framing.wide, framing.scale, options.metres_per_unit);
        draw_scale_bar(&mut sheet, margin, height - 14.0, &bar);
    }
    Ok(sheet)
}

/// The height of letters, at most `height`, at which a text is no wider than `room`.
fn fitting_height(text: &str, height: f32, room: f32) -> f32 {
    let width = lettering::width(text, height);
    if width > room { height * room / width } else { height }
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
    use crate::picture::view::Stand;
    use crate::shell::up::Up;

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
        let options = SheetOptions {
            title: Some("t".into()),
            views: [Stand::Front, Stand::Side].map(|stand| View::new(stand, Up::Y, None).unwrap()).to_vec(),
            manner: Manner::Lines,
            hair: HairColour::Brown,
            cell_width: 200,
            metres_per_unit: Some(1.0),
        };
        let cell_of = |moments: &[Moment], column: usize| {
            let sheet = draw(moments, &options, || ()).unwrap();
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
