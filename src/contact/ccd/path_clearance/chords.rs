//! Pieces of an element kept apart from a convex shape by planes.

use nalgebra::Vector3;

use super::{Element, FreePath, MAX_PIECES};
use crate::contact::body_at::BodyAt;
use crate::contact::shape::Separator;

/// A piece of an element, by its ends.
#[derive(Debug, Clone, Copy, Default)]
struct Chord {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    /// Positions of its first and its second end at the beginning and the end of that part, the body's axes.
    paths: [[Vector3<f64>; 2]; 2],
    /// That part of the step, from 0 to 1.
    time: [f64; 2],
}

impl FreePath<'_> {
    /// By chords of pieces: what moves straight from an arc to an arc stays as near to the chord that moves from chord to chord, and a plane
    /// between the shape and that chord in the middle of its motion bounds how near all of them come.
    pub(super) fn is_clear_by_chords(
        &self,
        body: &BodyAt,
        separator: &Separator,
        element: &Element,
        exempt: f64,
        spare: f64,
        chords: &mut u32,
    ) -> bool {
        let length = element.states[0].length;
        let mut pieces = [Chord::default(); MAX_PIECES];
        let left = if exempt > 0.0 { element.path(exempt) } else { element.left() };
        pieces[0] = Chord { along: [exempt, length], paths: [left, element.right()], time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Chord { along: [from, to], paths, time } = pieces[count];
            if *chords == 0 {
                return false;
            }
            *chords -= 1;
            let needed = self.needed(body, element, [from, to], spare);
            let off_chord = element.off_chord(to - from);
            let half_path =
                0.5 * (paths[0][1] - paths[0][0]).norm_squared().max((paths[1][1] - paths[1][0]).norm_squared()).sqrt();
            let midway = paths.map(|[a, b]| 0.5 * (a + b));
            let plane = separator.of_segment(midway);
            if (0..2).all(|end| plane.distance_of(paths[end]) >= needed[end] + off_chord) {
                continue;
            }
            if plane.distance < needed[0].min(needed[1]) - (off_chord + half_path) || count + 2 > MAX_PIECES {
                return false;
            }
            if off_chord >= half_path {
                let s = 0.5 * (from + to);
                let middle = element.path_in(s, time);
                pieces[count] = Chord { along: [from, s], paths: [paths[0], middle], time };
                pieces[count + 1] = Chord { along: [s, to], paths: [middle, paths[1]], time };
            } else {
                let t = 0.5 * (time[0] + time[1]);
                pieces[count] = Chord { along: [from, to], paths: [0, 1].map(|k| [paths[k][0], midway[k]]), time: [time[0], t] };
                pieces[count + 1] =
                    Chord { along: [from, to], paths: [0, 1].map(|k| [midway[k], paths[k][1]]), time: [t, time[1]] };
            }
            count += 2;
        }
        true
    }
}
