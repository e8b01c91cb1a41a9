//! Pieces of an element in a distance grid: the field and its gradient where a piece ends, and a bound on the Hessian, bound the field along
//! the piece to second order. A few pieces prove a strand clear that grows out of the surface, or touches it at a point.

use nalgebra::Vector3;

use super::{Element, FreePath, MAX_PIECES};
use crate::contact::body_at::BodyAt;
use crate::contact::shape::DistanceGrid;

/// A piece of an element during a part of the step.
#[derive(Debug, Clone, Copy, Default)]
struct Span {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    ends: [End; 2],
    /// That part of the step, from 0 to 1.
    time: [f64; 2],
}

/// An end of a piece.
#[derive(Debug, Clone, Copy, Default)]
struct End {
    /// Its positions at the beginning and the end of that part, the body's axes.
    path: [Vector3<f64>; 2],
    /// The field halfway between them, m: at least that where it is outside the grid.
    distance: f64,
    /// Its gradient there; none outside the grid.
    gradient: Option<Vector3<f64>>,
}

impl End {
    fn middle(&self) -> Vector3<f64> {
        0.5 * (self.path[0] + self.path[1])
    }

    fn half_path(&self) -> Vector3<f64> {
        0.5 * (self.path[1] - self.path[0])
    }
}

/// A distance grid, and how far a piece must stay out of it.
pub(super) struct Field<'a> {
    pub grid: &'a DistanceGrid,
    /// The most that it changes over a unit of distance.
    pub slope: f64,
    /// How many more places may be asked for.
    pub places: &'a mut u32,
}

/// Part of a piece about a place in it: what is between these corners, each as it lies off that place, with the field that is needed there (m); on
/// straight lines between corners, what is between theirs.
type Corners = [(Vector3<f64>, f64); 4];

impl Field<'_> {
    /// The field halfway along a path. None if no more places may be asked for.
    fn ask(&mut self, path: [Vector3<f64>; 2]) -> Option<End> {
        *self.places = self.places.checked_sub(1)?;
        let middle = 0.5 * (path[0] + path[1]);
        Some(match self.grid.with_gradient(&middle) {
            Some((distance, gradient)) => End { path, distance, gradient: Some(gradient) },
            None => End { path, distance: self.grid.clearance(&middle), gradient: None },
        })
    }

    /// Whether the bound from the middle of a piece proves all of it clear. `needed`: the least that the field must be at its ends, and on a straight
    /// line between them. `off_chord`: how far the piece's points may be off its chord.
    fn middle_keeps_clear(&mut self, paths: &[[Vector3<f64>; 2]; 2], needed: [f64; 2], off_chord: f64) -> bool {
        let Some(middle) = self.ask([0, 1].map(|time| 0.5 * (paths[0][time] + paths[1][time]))) else { return false };
        let centre = middle.middle();
        let corners =
            [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(end, time)| (paths[end][time] - centre, needed[end] + self.slope * off_chord));
        self.is_enough(&middle, &corners, || {
            let reach = corners.iter().map(|(off, _)| off.norm_squared()).fold(0.0, f64::max).sqrt();
            self.grid.hessian_bound(&centre, reach)
        })
    }

    /// Whether the bound from each end proves its half of a piece clear; see [`Field::middle_keeps_clear`].
    fn ends_keep_clear(&self, ends: &[End; 2], needed: [f64; 2], off_chord: f64) -> bool {
        let (middles, half_paths) = ([ends[0].middle(), ends[1].middle()], [ends[0].half_path(), ends[1].half_path()]);
        let (centre, half_path) = (0.5 * (middles[0] + middles[1]), 0.5 * (half_paths[0] + half_paths[1]));
        let hessian = || {
            let aside = half_paths[0].norm_squared().max(half_paths[1].norm_squared()).sqrt();
            self.grid.hessian_bound(&centre, 0.5 * (middles[1] - middles[0]).norm() + aside)
        };
        // Off its chord a piece is nowhere further than a line from nothing at its end to twice the most at its middle.
        let needed_midway = 0.5 * (needed[0] + needed[1]) + 2.0 * self.slope * off_chord;
        (0..2).all(|end| {
            let to_centre = centre - middles[end];
            let corners = [
                (-half_paths[end], needed[end]),
                (half_paths[end], needed[end]),
                (to_centre - half_path, needed_midway),
                (to_centre + half_path, needed_midway),
            ];
            self.is_enough(&ends[end], &corners, hessian)
        })
    }

    /// Whether the field is nowhere less than needed between corners about a place, by its slope, or by its gradient there and the bound on its
    /// Hessian. (Both bounds are concave: they are least at a corner.)
    fn is_enough(&self, at: &End, corners: &Corners, hessian: impl FnOnce() -> Option<f64>) -> bool {
        if corners.iter().all(|(off, needed)| at.distance - self.slope * off.norm() >= *needed) {
            return true;
        }
        let second_order = at.gradient.and_then(|gradient| Some((gradient, hessian()?)));
        second_order.is_some_and(|(gradient, hessian)| {
            corners.iter().all(|(off, needed)| at.distance + gradient.dot(off) - 0.5 * hessian * off.norm_squared() >= *needed)
        })
    }
}

impl FreePath<'_> {
    pub(super) fn is_clear_in_field(&self, body: &BodyAt, mut field: Field, element: &Element, exempt: f64, spare: f64) -> bool {
        let length = element.states[0].length;
        let left = if exempt > 0.0 { element.path(exempt) } else { element.left() };
        let ends = [left, element.right()];
        let needed = self.needed(body, element, [exempt, length], spare);
        if field.middle_keeps_clear(&ends, needed, element.off_chord(length - exempt)) {
            return true;
        }
        // None where a place of the strand, at some time, is deeper than it may be, and where no more may be asked for.
        let ask = |field: &mut Field, s: f64, path: [Vector3<f64>; 2]| {
            field.ask(path).filter(|end| end.distance >= self.needed(body, element, [s, s], spare)[0])
        };
        let (Some(left), Some(right)) = (ask(&mut field, exempt, ends[0]), ask(&mut field, length, ends[1])) else {
            return false;
        };
        let mut spans = [Span::default(); MAX_PIECES];
        spans[0] = Span { along: [exempt, length], ends: [left, right], time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Span { along: [from, to], ends, time } = spans[count];
            let needed = self.needed(body, element, [from, to], spare);
            if field.ends_keep_clear(&ends, needed, element.off_chord(to - from)) {
                continue;
            }
            if count + 2 > MAX_PIECES {
                return false;
            }
            let half_path = ends[0].half_path().norm_squared().max(ends[1].half_path().norm_squared()).sqrt();
            if 0.5 * (to - from) >= half_path {
                let s = 0.5 * (from + to);
                let Some(middle) = ask(&mut field, s, element.path_in(s, time)) else { return false };
                spans[count] = Span { along: [from, s], ends: [ends[0], middle], time };
                spans[count + 1] = Span { along: [s, to], ends: [middle, ends[1]], time };
            } else {
                let t = 0.5 * (time[0] + time[1]);
                for half in 0..2 {
                    let part = |end: usize| {
                        let [before, after] = ends[end].path;
                        let halfway = 0.5 * (before + after);
                        [[before, halfway], [halfway, after]][half]
                    };
                    let (Some(left), Some(right)) = (ask(&mut field, from, part(0)), ask(&mut field, to, part(1))) else {
                        return false;
                    };
                    let time = [[time[0], t], [t, time[1]]][half];
                    spans[count + half] = Span { along: [from, to], ends: [left, right], time };
                }
            }
            count += 2;
        }
        true
    }
}
