//! Letters as strokes: enough for labels, drawn with the same pen as the strands.

use tiny_skia::{LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::picture::colour::Colour;

/// Strokes of a character on a grid 4 wide and 6 high, y down: two digits a point, a space between strokes.
fn strokes(character: char) -> &'static str {
    match character {
        '0' | 'O' => "103041453616050110",
        '1' => "112026 1636",
        '2' => "01103041420646",
        '3' => "01103041423313 334445361605",
        '4' => "36300444",
        '5' => "40000312324345361605",
        '6' => "413010010516364544331304",
        '7' => "004016",
        '8' => "103041423313020110 1304051636454433",
        '9' => "423313020110304145361605",
        'A' => "062046 1434",
        'B' => "00063645443303 0030414233",
        'C' => "4130100105163645",
        'D' => "00063645413000",
        'E' => "40000646 0333",
        'F' => "400006 0333",
        'G' => "41301001051636454323",
        'H' => "0006 4046 0343",
        'I' => "1030 2026 1636",
        'J' => "4045361605",
        'K' => "0006 400346",
        'L' => "000646",
        'M' => "0600234046",
        'N' => "06004640",
        'P' => "06003041423303",
        'Q' => "103041453616050110 2446",
        'R' => "06003041423303 2346",
        'S' => "413010010213334445361605",
        'T' => "0040 2026",
        'U' => "000516364540",
        'V' => "002640",
        'W' => "0016233640",
        'X' => "0046 4006",
        'Y' => "002340 2326",
        'Z' => "00400646",
        '.' => "2626",
        ',' => "2617",
        ':' => "2222 2525",
        '-' => "1333",
        '+' => "1333 2224",
        '=' => "1232 1434",
        '/' => "0640",
        '_' => "0646",
        '(' => "30212536",
        ')' => "10212516",
        '\'' | '’' => "2021",
        '%' => "0640 0110 3645",
        ' ' => "",
        // A box: the character has no drawing, and hiding that would falsify the label.
        _ => "0040460600",
    }
}

/// Small letters are capitals of this size.
const SMALL: f32 = 0.82;

/// Distance from one character to the next and height of a capital, in grid units.
const ADVANCE: f32 = 6.0;
const HEIGHT: f32 = 6.0;

fn character_scale(character: char) -> f32 {
    if character.is_lowercase() { SMALL } else { 1.0 }
}

/// Width of a line of text whose capitals are `height` pixels high.
pub fn width(text: &str, height: f32) -> f32 {
    let units: f32 = text.chars().map(|character| ADVANCE * character_scale(character)).sum();
    (units - 2.0).max(0.0) * height / HEIGHT
}

/// Draws a line of text with its left end and baseline at `(x, y)`; capitals are `height` pixels high.
pub fn draw(pixmap: &mut Pixmap, text: &str, x: f32, y: f32, height: f32, colour: Colour) {
    let unit = height / HEIGHT;
    let mut builder = PathBuilder::new();
    let mut left = x;
    for character in text.chars() {
        let scale = unit * character_scale(character);
        let capital = character.to_uppercase().next().unwrap_or(character);
        for stroke in strokes(capital).split(' ').filter(|stroke| !stroke.is_empty()) {
            let digits: Vec<f32> = stroke.bytes().map(|digit| f32::from(digit - b'0')).collect();
            let points: Vec<(f32, f32)> =
                digits.chunks_exact(2).map(|point| (left + point[0] * scale, y + (point[1] - HEIGHT) * scale)).collect();
            builder.move_to(points[0].0, points[0].1);
            for (index, point) in points.iter().enumerate().skip(1) {
                // A dot is a stroke of no length; the pen needs a little of it.
                let nudge = if *point == points[index - 1] { 0.05 } else { 0.0 };
                builder.line_to(point.0 + nudge, point.1);
            }
        }
        left += ADVANCE * scale;
    }
    let Some(path) = builder.finish() else { return };
    let mut paint = Paint::default();
    paint.set_color(colour.to_skia(1.0));
    let stroke =
        Stroke { width: (height * 0.11).max(1.0), line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_drawing_stays_on_its_grid() {
        for character in ('0'..='9').chain('A'..='Z').chain(".,:-+=/_()%'’ ".chars()) {
            for stroke in strokes(character).split(' ').filter(|stroke| !stroke.is_empty()) {
                assert!(stroke.len().is_multiple_of(2) && stroke.len() >= 4, "{character}");
                assert!(stroke.bytes().step_by(2).all(|x| (b'0'..=b'4').contains(&x)), "{character}");
                assert!(stroke.bytes().skip(1).step_by(2).all(|y| (b'0'..=b'7').contains(&y)), "{character}");
            }
        }
    }

    #[test]
    fn different_letters_look_different() {
        let drawing = |text: &str| {
            let mut pixmap = Pixmap::new(40, 40).unwrap();
            draw(&mut pixmap, text, 5.0, 30.0, 20.0, Colour::WHITE);
            pixmap.take()
        };
        let all: Vec<char> = ('0'..='9').chain('A'..='Z').filter(|character| *character != 'O').collect();
        for (index, first) in all.iter().enumerate() {
            assert!(drawing(&first.to_string()).iter().any(|byte| *byte > 0));
            for second in &all[index + 1..] {
                assert_ne!(drawing(&first.to_string()), drawing(&second.to_string()), "{first} {second}");
            }
        }
    }
}
