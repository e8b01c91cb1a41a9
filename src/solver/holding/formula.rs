//! By which formula held strands take their step. A two-step formula makes an impact ring: a strand that something presses takes the step, and
//! the one after it, by implicit Euler. One that nothing presses, however near it is, goes as it would alone.

use super::{Holding, Scene};
use crate::contact::held_strand::HeldStrand;
use crate::contact::island::Island;
use crate::memory::recycled;
use crate::step::options::Integrator;

impl Holding {
    /// Before the first iteration: the step of strands that would run into what they are near begins again by implicit Euler. What the
    /// others have done for that is the first half of their first iteration.
    pub(super) fn foresee_pressing(&mut self, scene: &mut Scene, h: f64) {
        if scene.setting.options.integrator != Integrator::SecondOrder {
            return;
        }
        let Self { strands, islands, packs, count, island_count, at_work, asked, pressed, .. } = self;
        let (strands, islands) = (&mut strands[..*count], &mut islands[..*island_count]);
        // Of the islands that have touches and strands on their own formula.
        let is_asked = |island: &Island, strands: &[HeldStrand]| {
            island.strands.iter().any(|held| !strands[*held as usize].first_order) && island.has_touches()
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
        // (What it takes is counted when it would be due.)
        meter.uncounted(|| packs.linearise(strands, islands, scene.workers, meter, |held| asked[held.island as usize]));
        for held in strands.iter_mut().filter(|held| asked[held.island as usize]) {
            held.looked_ahead = true;
        }
        if meter.is_halted() {
            return;
        }
        pressed.clear();
        for (island, _) in islands.iter_mut().zip(&*asked).filter(|(_, asked)| **asked) {
            island.about_to_press(strands, pressed);
        }
        for held in &*pressed {
            let held = &mut strands[*held as usize];
            held.begins_again = !held.first_order;
        }
        Self::restart(scene, packs, strands, h);
    }

    /// After an island's contact problem: marks those of its strands for a new beginning that a touch presses and that are not on implicit
    /// Euler yet. What nobody foresaw is little.
    pub(super) fn begin_pressed_again(island: &Island, strands: &mut [HeldStrand]) {
        for joint in island.joints.iter().filter(|joint| joint.presses()) {
            for end in joint.ends() {
                let held = &mut strands[end.held as usize];
                held.begins_again |= !held.first_order;
            }
        }
    }
}
