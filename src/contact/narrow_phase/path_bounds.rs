//! Boxes around a strand's motion through a step, and around its elements'.

use nalgebra::Vector3;

use crate::contact::contact_point::StrandPath;
use crate::contact::shape::Bounds;

/// Boxes of a strand's motion through a step. Made once per iterate, used for all bodies.
#[derive(Debug, Clone)]
pub struct PathBounds {
    /// Of all of it, world.
    pub whole: Bounds,
    /// Of its elements.
    pub elements: Vec<Bounds>,
}

impl Default for PathBounds {
    fn default() -> Self {
        Self { whole: Bounds::EMPTY, elements: Vec::new() }
    }
}

impl PathBounds {
    /// Updates the boxes to a path.
    pub fn update(&mut self, path: &StrandPath) {
        self.elements.clear();
        self.whole = Bounds::EMPTY;
        for (start, now) in path.start.elements.iter().zip(path.now.elements) {
            let mut bounds = Bounds::EMPTY;
            for (element, origin) in [(start, path.start.origin), (now, path.now.origin)] {
                // An arc lies within half its length of the middle of its ends.
                let left = origin + Vector3::from(element.origin_left);
                let right = origin + Vector3::from(element.origin_right());
                bounds = bounds.union(&Bounds::around(0.5 * (left + right), Vector3::repeat(0.5 * element.length)));
            }
            self.whole = self.whole.union(&bounds);
            self.elements.push(bounds);
        }
    }
}
