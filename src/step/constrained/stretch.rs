//! How far a damped iteration of a constrained strand goes along its direction.
//!
//! Contacts that press a strand along itself make its matrix indefinite, and damping λ makes it positive. Along a soft direction a damped
//! iteration then goes a small part of the way only, and the next one goes on the same way: the error falls by a few hundredths at a time.
//!
//! Where an iteration has the direction of the one before, d′ = c d, it goes on for t d′ instead, to where the force along d vanishes. There
//! are two estimates of t, and the smaller one counts. The strand's own matrix H, with H d′ = f′ − λ θ′ for the rotations θ′ along d′, says
//!
//! t = f′·d′ / (d′·H d′) = f′·d′ / (f′·d′ − λ θ′·θ′).
//!
//! What else moves, it does not know. The secant does: the strand went p d, and the force fell from f·d to f′·d = f′·d′ / c, so that
//!
//! t = p f′·d′ / (c² f·d − c f′·d′).

use crate::chain::system::Direction;
use crate::math::lane::Lane;

/// Two directions are the same if the cosine between them, as changes of curvature, is at least this.
const SAME: f64 = 0.9;
/// The farthest that an iteration goes, in lengths of its direction, and the largest turn of an element beyond its length, rad: far from
/// the end of the iteration contacts' planes mean little.
const FARTHEST: f64 = 64.0;
const LARGEST_TURN: f64 = 0.01;

/// The last damped iteration of a strand.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    /// Its direction d: changes of the elements' curvatures, 1/m. Empty if there was none.
    direction: Vec<[f64; 3]>,
    /// f·d, J.
    descent: f64,
    /// p.
    part: f64,
}

impl Stretch {
    /// Forgets the last iteration.
    pub fn forget(&mut self) {
        self.direction.clear();
    }

    /// The last iteration went this part of its direction.
    pub fn went(&mut self, part: f64) {
        self.part = part;
    }

    /// How far an iteration with this `damping` λ, N·m/rad, is to go along its direction `change` in a lane, in lengths of it: 1 or more.
    #[inline(always)]
    pub fn along<T: Lane>(&mut self, change: &[[T; 3]], found: &Direction<T>, lane: usize, damping: f64) -> f64 {
        if damping == 0.0 {
            self.forget();
            return 1.0;
        }
        let (mut both, mut now_squared, mut before_squared) = (0.0, 0.0, 0.0);
        for (change, before) in change.iter().zip(&self.direction) {
            for (now, before) in change.iter().map(|now| now.lane(lane)).zip(before) {
                both += now * before;
                now_squared += now * now;
                before_squared += before * before;
            }
        }
        let is_same = both > 0.0 && both * both >= SAME * SAME * now_squared * before_squared;
        self.direction.clear();
        self.direction.extend(change.iter().map(|change| [0, 1, 2].map(|axis| change[axis].lane(lane))));
        let descent = found.descent.lane(lane);
        let before = std::mem::replace(&mut self.descent, descent);
        if !is_same {
            return 1.0;
        }
        let times = both / before_squared;
        let falls = [descent - damping * found.rotation_sum.lane(lane), times * (times * before - descent) / self.part];
        let far = falls.map(|falls| if falls > 0.0 { descent / falls } else { 1.0 });
        let most = (LARGEST_TURN / found.rotation_squared.lane(lane).sqrt()).clamp(1.0, FARTHEST);
        far[0].min(far[1]).clamp(1.0, most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(descent: f64, rotation_sum: f64) -> Direction<f64> {
        Direction { descent, rotation_squared: 1e-8, rotation_sum, repaired: 0.0, condition: 0.0 }
    }

    /// Where a strand is before each iteration with one of these dampings, and in the end: along one rotation that its matrix resists by
    /// `own`, and all that moves with it by `stiffness`.
    fn iterate(own: f64, stiffness: f64, dampings: &[f64]) -> Vec<f64> {
        let (mut stretch, mut at) = (Stretch::default(), vec![1e-3]);
        for damping in dampings {
            let now = at[at.len() - 1];
            let force = -stiffness * now;
            let d = force / (own + damping);
            let far = stretch.along(&[[0.0, d, 0.0]], &direction(force * d, d * d), 0, *damping);
            stretch.went(far);
            at.push(now + far * d);
        }
        at
    }

    #[test]
    fn a_damped_iteration_that_goes_on_the_same_way_goes_all_of_it() {
        // (The second value is the way left after the first iteration, which is not stretched.)
        for stiffness in [0.05, 0.1, 0.3] {
            for dampings in [[1.0, 1.0], [1.0, 0.5], [0.5, 2.0]] {
                for own in [0.02, stiffness] {
                    let at = iterate(own, stiffness, &dampings);
                    assert!(at[1] > 0.3e-3 && at[2].abs() < 1e-12, "{own}, {stiffness}: {at:?}");
                }
            }
        }
        // It goes 64 lengths of its direction at most.
        let at = iterate(1e-3, 1e-3, &[1.0, 1.0]);
        assert!((at[2] / at[1] - (1.0 - FARTHEST * 1e-3 / 1.001)).abs() < 1e-9, "{at:?}");
        // Nor to beyond the lowest point of its own model.
        let at = iterate(0.5, 0.1, &[1.0, 1.0]);
        assert!((at[2] / at[1] - 0.8).abs() < 1e-9, "{at:?}");
    }

    #[test]
    fn other_directions_and_forces_that_do_not_fall_are_not_stretched() {
        let mut stretch = Stretch::default();
        let mut along_damped = |change: [f64; 3], descent: f64, turn: f64, damping: f64| {
            let found = Direction { rotation_squared: turn * turn, ..direction(descent, 0.99 * descent) };
            let far = stretch.along(&[change], &found, 0, damping);
            stretch.went(1.0);
            far
        };
        // Undamped iterations are neither stretched nor remembered.
        for damping in [0.0, 1.0] {
            assert_eq!(along_damped([0.0, 1.0, 0.0], 1.0, 1e-4, damping), 1.0);
        }
        assert!(along_damped([0.0, 1.0, 0.0], 0.9, 1e-4, 1.0) > 8.0);
        assert_eq!(along_damped([0.0, 1.0, 0.0], 0.8, 1e-4, 0.0), 1.0);
        let mut along = |change: [f64; 3], descent: f64, turn: f64| along_damped(change, descent, turn, 1.0);
        assert_eq!(along([0.0, 1.0, 0.0], 1.0, 1e-4), 1.0);
        assert_eq!(along([0.0, 0.0, 1.0], 1.0, 1e-4), 1.0);
        assert_eq!(along([0.0, 0.0, -1.0], 1.0, 1e-4), 1.0);
        assert!((along([0.0, 0.0, -1.0], 0.9, 1e-4) - 9.0).abs() < 1e-12);
        assert_eq!(along([0.0, 0.0, -1.0], 0.95, 1e-4), 1.0);
        // An element turns by a hundredth at most, if not by the direction itself.
        assert!((along([0.0, 0.0, -1.0], 0.9, 0.4 * LARGEST_TURN) - 2.5).abs() < 1e-12);
        assert_eq!(along([0.0, 0.0, -1.0], 0.8, 2.0 * LARGEST_TURN), 1.0);
    }
}
