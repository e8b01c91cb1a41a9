//! The integration formula of constrained strands. A two-step formula rings after an impact: a strand that something presses
//! takes the step, and the next one, by implicit Euler. A strand that nothing presses, however near it is, steps as it would
//! alone.

use super::constrained_strand::{ConstrainedStrand, Formula, LookAhead, StrandEnd};
use super::coupled_step::{CoupledScene, CoupledStep, Stepping};
use super::island::Island;
use super::packs::Packs;
use crate::memory::recycled;
use crate::meter::Meter;
use crate::step::options::Integrator;

impl CoupledStep {
    /// Before the first iteration: strands that would run into something near begin the step again by implicit Euler. The work
    /// done for this prediction is the first half of the others' first iteration.
    pub fn predict_pressed<S: Default + Send>(&mut self, stepping: &Stepping<S>, scene: &mut dyn CoupledScene) {
        if stepping.setting.options.integrator != Integrator::SecondOrder {
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
        let meter = stepping.meter;
        stepping.workers.for_each(&mut refreshed, |island, _| {
            if !meter.is_halted() {
                island.refresh(strands, stepping.bodies);
            }
        });
        *at_work = recycled(refreshed);
        // (Its cost is counted when it would be due.)
        meter.uncounted(|| {
            packs.linearise(strands, islands, stepping.workers, meter, |constrained| asked[constrained.island as usize])
        });
        for constrained in strands.iter_mut().filter(|constrained| asked[constrained.island as usize]) {
            constrained.look_ahead = LookAhead::Done;
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
        restart(packs, strands, meter, scene);
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

/// Begins the step of the strands marked for it again, by implicit Euler.
pub(super) fn restart(packs: &mut Packs, strands: &mut [ConstrainedStrand], meter: &Meter, scene: &mut dyn CoupledScene) {
    let is_marked = |constrained: &ConstrainedStrand| constrained.formula == Formula::ToBeginAgain;
    if !strands.iter().any(is_marked) || meter.is_halted() {
        return;
    }
    scene.begin_again(packs, strands);
    for constrained in strands.iter_mut().filter(|constrained| is_marked(constrained)) {
        (constrained.formula, constrained.look_ahead) = (Formula::ImplicitEuler, LookAhead::None);
        constrained.rest.stir();
        // What it came to before is gone. If time ran out meanwhile, not even its pack has begun.
        constrained.end = StrandEnd::AsBegun;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::constraint::step_constraint::StepConstraint;

    /// A scene whose time is up before any pack is begun.
    struct NoTime;

    impl CoupledScene for NoTime {
        fn add_bilateral(&self, _: &[ConstrainedStrand], _: &mut Vec<StepConstraint>) {}
        fn begin_again(&mut self, _: &mut Packs, _: &mut [ConstrainedStrand]) {}
    }

    #[test]
    fn a_strand_whose_time_ran_out_as_it_began_again_ends_as_it_began() {
        let mut strands = [ConstrainedStrand::default(), ConstrainedStrand::default()];
        strands.iter_mut().for_each(|strand| strand.end = StrandEnd::Iterated);
        strands[0].formula = Formula::ToBeginAgain;
        restart(&mut Packs::default(), &mut strands, &Meter::unlimited(), &mut NoTime);
        assert_eq!(strands.each_ref().map(|strand| strand.end), [StrandEnd::AsBegun, StrandEnd::Iterated]);
        assert_eq!(strands[0].formula, Formula::ImplicitEuler);
    }
}
