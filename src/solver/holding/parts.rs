//! Strands that touches leave deep take the substep again, in parts: those of islands that have not come to their end, each half from where the one
//! before has left them, and halves of halves, as often as free strands' steps may be halved
//! ([`StepOptions::max_subdivisions`](crate::step::options::StepOptions::max_subdivisions)). The others have gone on, and are not seen meanwhile.

use super::{ContactTally, Holding, Scene};
use crate::contact::body::BodyAt;
use crate::contact::joint::Joint;
use crate::contact::nearest_pair::depth;
use crate::contact::options::ContactOptions;
use crate::solver::report::Wrench;
use crate::solver::strand::Tally;
use crate::step::StrandOutcome;

/// Surfaces that are so many tolerances in each other are deep.
const DEEP: f64 = 10.0;

impl Holding {
    /// Which strands took the last substep in parts, by their index.
    pub fn in_parts(&self) -> impl Iterator<Item = usize> {
        self.strands[..self.count].iter().filter(|held| held.takes_parts).map(|held| held.index as usize)
    }

    /// Marks the strands that are to take the substep in parts. True if there are any.
    pub(super) fn choose_parts(&mut self, options: &ContactOptions) -> bool {
        let mut some = false;
        if options.model.is_soft() {
            return some;
        }
        for island in self.islands[..self.island_count].iter().filter(|island| island.failed() && !island.is_constrained()) {
            let is_deep =
                |joint: &Joint| !joint.deep && depth(joint, &self.strands, options.tolerance) > DEEP * options.tolerance;
            let overlooked = island.strands.iter().any(|held| self.strands[*held as usize].overlooked);
            if overlooked || island.ending.lost || island.joints.iter().any(is_deep) {
                some = true;
                for held in &island.strands {
                    self.strands[*held as usize].takes_parts = true;
                }
            }
        }
        some
    }

    /// Takes the marked strands through the two halves of a substep of `h` seconds, which may be halved `levels` times more.
    pub(super) fn take_parts(
        &mut self,
        scene: &mut Scene,
        h: f64,
        levels: u32,
        tally: &mut Tally,
        contact: &mut ContactTally,
        wrenches: &mut [Wrench],
    ) {
        let mut shorter = self.shorter.take().unwrap_or_default();
        shorter.forget();
        let mut bodies = (scene.copies)();
        for held in self.strands[..self.count].iter_mut().filter(|held| held.takes_parts) {
            let StrandOutcome { iterations, .. } = held.held.outcome;
            held.held.outcome = StrandOutcome { converged: true, substeps: 0, iterations, ..StrandOutcome::default() };
        }
        let half = 0.5 * h;
        let (mut told, mut found) = (ContactTally::default(), vec![Wrench::default(); wrenches.len()]);
        for _ in 0..2 {
            let mut marked = self.strands[..self.count].iter().filter(|held| held.takes_parts).map(|held| held.index).peekable();
            for (index, strand) in scene.strands.iter_mut().enumerate() {
                strand.held = marked.next_if_eq(&(index as u32)).is_some();
            }
            found.fill(Wrench::default());
            bodies.iter_mut().for_each(|body| body.begin(half));
            let copies = || bodies.clone();
            let at: Vec<BodyAt> = bodies.iter().enumerate().map(|(k, body)| body.at(k as u32, half)).collect();
            // Constraints hold none of them.
            let mut part = Scene { strands: &mut *scene.strands, constraints: &mut [], bodies: &at, copies: &copies, ..*scene };
            shorter.take(&mut part, half, levels, &mut Tally::default(), &mut told, &mut found);
            bodies.iter_mut().for_each(|body| body.finish(half));
            let of_part = shorter.strands[..shorter.count].iter().map(|held| &held.held.outcome);
            for (held, part) in self.strands[..self.count].iter_mut().filter(|held| held.takes_parts).zip(of_part) {
                held.held.outcome.add_held_part(part);
            }
        }
        for held in self.strands[..self.count].iter().filter(|held| held.takes_parts) {
            scene.strands[held.index as usize].fared = (&held.held.outcome).into();
            tally.add(&held.held.outcome);
        }
        contact.add_parts(&told);
        for (wrench, found) in wrenches.iter_mut().zip(&found) {
            wrench.force += found.force;
            wrench.torque += found.torque;
        }
        self.contacts.append(&mut shorter.contacts);
        self.touching.remember_parts(&shorter.touching);
        self.shorter = Some(shorter);
    }
}

impl ContactTally {
    /// Adds what the parts of a substep came to.
    fn add_parts(&mut self, parts: &Self) {
        self.touches += parts.touches;
        self.roots_inside += parts.roots_inside;
        self.searches = self.searches.max(parts.searches);
        self.iterations = self.iterations.max(parts.iterations);
        self.sweeps += parts.sweeps;
        self.unconverged += parts.unconverged;
        self.residual = self.residual.max(parts.residual);
        self.penetration = self.penetration.max(parts.penetration);
    }
}
