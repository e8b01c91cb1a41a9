//! How far a strand's elements are from bodies at least, from search to search: what has not gone that far overlaps with none, and need
//! not be searched.
//!
//! An element came to the place of the last search without having passed through anything, or its contacts there tell that it has. What goes
//! less far from there than the bodies are away does not pass through anything either.

use crate::contact::contact_point::ContactPoint;
use crate::contact::shape::STEEPEST_DISTANCE;

/// What is known of a strand's elements since the last search.
#[derive(Debug, Default)]
pub(super) struct Clearance {
    /// No gap along an element was smaller than this then, m, where those of its neighbours were no smaller, either: a contact at the end
    /// between two elements is listed with one of them.
    least: Vec<f64>,
    passed_over: Vec<bool>,
}

impl Clearance {
    /// Begins a search for contacts nearer than `within` (m) of all elements.
    pub fn pass_over_none(&mut self, elements: usize, within: f64) -> &[bool] {
        let Self { least, passed_over } = self;
        passed_over.clear();
        passed_over.resize(elements, false);
        least.clear();
        least.resize(elements, within);
        passed_over
    }

    /// Begins one that passes over elements that have gone no farther than `unseen` (m), or, while overlaps up to `tolerance` (m) are none, no
    /// farther than bodies are away. `gone`: how far they have gone since the last search, at most.
    pub fn pass_over(&mut self, gone: &[f64], within: f64, unseen: f64, tolerance: f64) -> &[bool] {
        let Self { least, passed_over } = self;
        passed_over.clear();
        passed_over.extend(gone.iter().enumerate().map(|(element, gone)| {
            let beside = element.saturating_sub(1)..(element + 2).min(least.len());
            let clear = least[beside].iter().copied().fold(f64::INFINITY, f64::min);
            *gone <= unseen || clear - STEEPEST_DISTANCE * gone >= -tolerance
        }));
        for ((least, passed_over), gone) in least.iter_mut().zip(&*passed_over).zip(gone) {
            *least = if *passed_over { *least - STEEPEST_DISTANCE * gone } else { within };
        }
        passed_over
    }

    /// Whether an element was passed over.
    pub fn has_passed_over(&self, element: usize) -> bool {
        self.passed_over.get(element) == Some(&true)
    }

    /// Takes in the contacts that the search has found.
    pub fn take_in(&mut self, contacts: &[ContactPoint]) {
        for contact in contacts {
            let least = &mut self.least[contact.point.element as usize];
            *least = least.min(contact.gap);
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::contact::contact_point::{Partner, StrandPoint};

    const WITHIN: f64 = 1e-3;
    const UNSEEN: f64 = 5e-6;
    const TOLERANCE: f64 = 5e-5;

    fn contact(element: u32, gap: f64) -> ContactPoint {
        ContactPoint {
            point: StrandPoint { strand: 0, element, s: 0.0 },
            partner: Partner::Body { body: 0, feature: 0 },
            normal: Vector3::z(),
            gap,
            carried: Vector3::zeros(),
        }
    }

    #[test]
    fn elements_are_searched_that_may_have_come_into_a_body_since_and_their_neighbours() {
        let mut clearance = Clearance::default();
        assert_eq!(clearance.pass_over_none(5, WITHIN), [false; 5]);
        clearance.take_in(&[contact(1, 4e-4), contact(1, 2e-4)]);
        // 0.2 mm is left, at a slope of 1.25, with the tolerance: two tenths of a millimetre may be gone.
        assert_eq!(clearance.pass_over(&[1e-4; 5], WITHIN, UNSEEN, TOLERANCE), [true; 5]);
        assert_eq!(clearance.pass_over(&[9e-5; 5], WITHIN, UNSEEN, TOLERANCE), [true; 5]);
        assert_eq!(clearance.pass_over(&[2e-5; 5], WITHIN, UNSEEN, TOLERANCE), [false, false, false, true, true]);
        assert!(clearance.has_passed_over(3) && !clearance.has_passed_over(0));
        // What was searched may go its whole way again.
        assert_eq!(clearance.pass_over(&[5e-4; 5], WITHIN, UNSEEN, TOLERANCE), [true; 5]);
        // The last two have gone 0.71 mm by now, and the others half a millimetre: for the third its neighbour counts.
        assert_eq!(clearance.pass_over(&[2e-4; 5], WITHIN, UNSEEN, TOLERANCE), [true, true, false, false, false]);
    }

    #[test]
    fn an_element_that_overlaps_is_searched_unless_it_has_not_moved() {
        let mut clearance = Clearance::default();
        clearance.pass_over_none(1, WITHIN);
        clearance.take_in(&[contact(0, -1e-4)]);
        assert_eq!(clearance.pass_over(&[4e-6], WITHIN, UNSEEN, TOLERANCE), [true]);
        assert_eq!(clearance.pass_over(&[6e-6], WITHIN, UNSEEN, TOLERANCE), [false]);
    }
}
