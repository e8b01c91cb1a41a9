//! The integration formula of constrained strands. A two-step formula rings after an impact: a strand that something presses
//! takes the step, and the next one, by implicit Euler. A strand that nothing presses, however near it is, steps as it would
//! alone.

use super::{ConstrainedSubstep, Scene};
use crate::contact::constrained_strand::ConstrainedStrand;
use crate::contact::island::Island;
use crate::memory::recycled;
use crate::step::options::Integrator;

impl ConstrainedSubstep {
    /// Before the first iteration: strands that would run into something near begin the step again by implicit Euler. The work
    /// done for this prediction is the first half of the others' first iteration.
    pub(super) fn predict_pressed(&mut self, scene: &mut Scene, h: f64) {
        if scene.setting.options.integrator != Integrator::SecondOrder {
            return;
        }
        let Self { strands, islands, packs, count, island_count, at_work, asked, pressed, .. } = self;
        let (strands, islands) = (&mut strands[..*count], &mut islands[..*island_count]);
        // Islands with contacts and with strands that use their own formula.
        let is_asked = |island: &Island, strands: &[ConstrainedStrand]| {
            island.strands.iter().any(|constrained| !strands[*constrained as usize].formula.is_first_order())
                && island.has_contacts()
        };
        asked.clear();
        asked.extend(islands.iter().map(|island| is_asked(island, strands)));
        if !asked.contains(&true) {
            return;
        }
        let mut refreshed: Vec<&mut Island> = recycled(std::mem::take(at_work));
        refreshed.extend(islands.iter_mut().zip(&*asked).filter(|(_, asked)| **asked).map(|(island, _)| island));
        let meter = scene.meter;
        scene.workers.for_each(&mut refreshed, |island, _| {
            if !meter.is_halted() {
                island.refresh(strands, scene.bodies);
            }
        });
        *at_work = recycled(refreshed);
        // (Its cost is counted when it would be due.)
        meter.uncounted(|| {
            packs.linearise(strands, islands, scene.workers, meter, |constrained| asked[constrained.island as usize])
        });
        for constrained in strands.iter_mut().filter(|constrained| asked[constrained.island as usize]) {
            constrained.looked_ahead = true;
        }
        if meter.is_halted() {
            return;
        }
        pressed.clear();
        for (island, _) in islands.iter_mut().zip(&*asked).filter(|(_, asked)| **asked) {
            island.about_to_press(strands, pressed);
        }
        for constrained in &*pressed {
            strands[*constrained as usize].mark_pressed();
        }
        Self::restart(scene, packs, strands, h);
    }

    /// After an island's contact problem: marks strands under pressure that are not on implicit Euler yet, so that they begin
    /// again. Few are left to be found here.
    pub(super) fn begin_pressed_again(island: &Island, strands: &mut [ConstrainedStrand]) {
        for constraint in island.constraints.iter().filter(|constraint| constraint.presses()) {
            for end in constraint.ends() {
                strands[end.strand as usize].mark_pressed();
            }
        }
    }
}
