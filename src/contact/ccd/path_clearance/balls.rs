//! Pieces of an element in balls, for shapes that only know how far they are from a point.

use nalgebra::Vector3;

use super::{Element, FreePath, MAX_PIECES};
use crate::contact::body_at::BodyAt;

/// A piece of an element during a part of the step.
#[derive(Debug, Clone, Copy, Default)]
struct Piece {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    /// Position of its middle at the beginning and the end of that part, the body's axes.
    path: [Vector3<f64>; 2],
    /// That part of the step, from 0 to 1.
    time: [f64; 2],
}

impl FreePath<'_> {
    /// By balls about the middles of pieces, for shapes that only know how far they are from a point.
    pub(super) fn is_clear_by_balls(&self, body: &BodyAt, element: &Element, exempt: f64, spare: f64, balls: &mut u32) -> bool {
        let (length, slope) = (element.states[0].length, body.shape.distance_slope());
        let mut pieces = [Piece::default(); MAX_PIECES];
        // (The middle of its chord does for the whole element, and is at hand; it is no point of the strand, so that an overlap there proves nothing.)
        let path = if exempt > 0.0 { element.path(0.5 * (exempt + length)) } else { element.chord_middles() };
        pieces[0] = Piece { along: [exempt, length], path, time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Piece { along: [from, to], path: [a, b], time } = pieces[count];
            if *balls == 0 {
                return false;
            }
            *balls -= 1;
            let needed = self.needed(body, element, [from, to], spare);
            let needed = needed[0].max(needed[1]);
            let (half_piece, half_path) = (0.5 * (to - from), 0.5 * (b - a).norm());
            let enough = needed + slope * (half_piece + half_path);
            let middle = 0.5 * (a + b);
            let distance = body.shape.distance(middle, enough);
            if distance >= enough {
                continue;
            }
            if count + 2 > MAX_PIECES {
                return false;
            }
            if distance < needed && half_piece < 0.5 * length {
                return false;
            }
            if half_piece >= half_path {
                let s = 0.5 * (from + to);
                for along in [[from, s], [s, to]] {
                    pieces[count] = Piece { along, path: element.path_in(0.5 * (along[0] + along[1]), time), time };
                    count += 1;
                }
            } else {
                let t = 0.5 * (time[0] + time[1]);
                for (path, time) in [([a, middle], [time[0], t]), ([middle, b], [t, time[1]])] {
                    pieces[count] = Piece { along: [from, to], path, time };
                    count += 1;
                }
            }
        }
        true
    }
}
