//! How islands' iterations end, and are left so while others, made anew by what a later search finds, go on.

use super::island::Island;

/// How an island's iteration ended: all that is told of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ending {
    /// See [`Island::converged`].
    pub converged: bool,
    relaxed: bool,
    good_enough: bool,
    lost: bool,
    residual: f64,
}

impl Island {
    /// How it ended, if it has, and no second attempt is to follow.
    pub fn ending(&self) -> Option<Ending> {
        let Self { converged, relaxed, good_enough, lost, residual, .. } = *self;
        (self.done && !self.is_to_relax()).then_some(Ending { converged, relaxed, good_enough, lost, residual })
    }

    /// Leaves it as it ended: made anew, it is the same, and would end there again.
    pub fn keep(&mut self, ending: Ending) {
        let Ending { converged, relaxed, good_enough, lost, residual } = ending;
        (self.done, self.converged, self.relaxed) = (true, converged, relaxed);
        (self.good_enough, self.lost, self.residual) = (good_enough, lost, residual);
    }
}
