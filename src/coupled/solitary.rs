//! Newton iterations of strands that share no constraint with others: what touches them is bodies, or holds them in place. Each
//! is an island by itself, so that a pack takes all its iterations at once, while it is in a core's cache.
//!
//! A strand that begins its step again needs another pack, and waits until its pack is through.

use super::constrained_strand::{ConstrainedStrand, Formula, Solitary};
use super::coupled_step::{CoupledScene, CoupledStep, Scratch, Stepping};
use super::formula::restart;
use super::island::Island;
use super::island::ending::Next;
use super::iterations::distribute_work;
use super::packs::{MAX_LANES, Work, first_half, second_half, with_work};
use crate::meter::Stopped;
use crate::platform::Instant;
use crate::step::constrained::step::running;
use crate::step::options::Integrator;
use crate::workers::WorkerSet;

/// A solitary strand with its island.
pub(super) type Member<'a> = (&'a mut ConstrainedStrand, &'a mut Island);

/// What threads have spent on a round of packs, s.
#[derive(Debug, Clone, Copy, Default)]
struct Spent {
    /// On all of it.
    all: f64,
    /// On contact problems.
    contact: f64,
}

/// Whether a strand takes part in the next iteration.
fn goes_on(constrained: &ConstrainedStrand, island: &Island) -> bool {
    !island.phase.has_ended() && island.turn.has_iterations_left() && constrained.formula != Formula::ToBeginAgain
}

impl CoupledStep {
    /// The iterations that solitary strands have left until the next search.
    pub(super) fn iterate_solitary<S: Scratch>(&mut self, stepping: &Stepping<S>, scene: &mut dyn CoupledScene) {
        let Stepping { workers, meter, .. } = *stepping;
        loop {
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            let stopped = meter.stopped();
            if stopped != Stopped::No {
                return islands.iter_mut().filter(|island| island.turn.is_alone()).for_each(|island| island.stop(stopped));
            }
            distribute_work(islands, |island| !island.phase.has_ended(), meter.left());
            let spent = std::sync::Mutex::new(Spent::default());
            let begins = Instant::now();
            let mut next_islands = islands.iter_mut().enumerate().peekable();
            // Islands are in the order of their first strands.
            let members = strands.iter_mut().filter_map(|constrained| {
                let (_, island) = next_islands.next_if(|(k, _)| *k == constrained.island as usize)?;
                island.turn.has_iterations_left().then_some((constrained, island))
            });
            let place = |(constrained, _): &Member| (constrained.pack, constrained.lane);
            with_work(self.packs.all(), &mut self.solitary_work, members, place, |work| {
                workers.for_each_task(work, 1, 1, |works, scratch| {
                    for work in works {
                        let seconds = iterate_pack(work, stepping, scratch);
                        let mut spent = spent.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                        (spent.all, spent.contact) = (spent.all + seconds.all, spent.contact + seconds.contact);
                    }
                });
            });
            let spent = spent.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
            if spent.all > 0.0 {
                self.contact_seconds += begins.elapsed().as_secs_f64() * (spent.contact / spent.all);
            }
            let islands = &self.islands[..self.island_count];
            let waits = |constrained: &ConstrainedStrand| {
                let island = &islands[constrained.island as usize];
                !island.phase.has_ended() && island.turn.has_iterations_left()
            };
            if !meter.is_halted() && !self.strands[..self.count].iter().any(waits) {
                return;
            }
            restart(&mut self.packs, &mut self.strands[..self.count], meter, scene);
        }
    }
}

/// The iterations of a pack's strands.
fn iterate_pack<S: Scratch>(Work { pack, members }: &mut Work<Member>, stepping: &Stepping<S>, scratch: &mut S) -> Spent {
    let Stepping { setting, options, bodies, meter, h, .. } = *stepping;
    let second_order = setting.options.integrator == Integrator::SecondOrder;
    let (begins, alone) = (Instant::now(), WorkerSet::<S>::serial());
    let mut contact = 0.0;
    while !meter.is_halted() {
        for (constrained, island) in members.iter_mut().flatten() {
            if !island.phase.has_ended() || island.progress.ending.stopped != Stopped::No || !island.turn.has_iterations_left() {
                continue;
            }
            if let Some(kink) = island.kinks(&Solitary(constrained), options).first() {
                constrained.bend(kink, setting, pack);
                island.go_on();
            } else if island.try_again(&Solitary(constrained), options, h) == Next::BeginsAgain {
                constrained.formula = Formula::ToBeginAgain;
            }
        }
        let goes: [bool; MAX_LANES] =
            std::array::from_fn(|lane| members[lane].as_ref().is_some_and(|(constrained, island)| goes_on(constrained, island)));
        if !goes.contains(&true) {
            break;
        }
        for (_, (constrained, island)) in running(members).filter(|(lane, _)| goes[*lane]) {
            island.turn.take();
            island.refresh(&Solitary(constrained), bodies);
        }
        let at_work = running(members).filter(|(lane, _)| goes[*lane] && !meter.is_halted());
        first_half(pack, at_work.map(|(lane, (constrained, island))| (lane, &**island, &mut **constrained)), meter);
        let solves = Instant::now();
        for (_, (constrained, island)) in running(members).filter(|(lane, _)| goes[*lane]) {
            let strand = Solitary(constrained);
            island.find_ends(&strand);
            island.solve_or_diverge(&strand, options, h, scratch.as_mut(), &alone, meter);
            let may_begin_again =
                second_order && !island.phase.has_ended() && island.progress.iterations < options.max_iterations;
            if may_begin_again && island.presses() {
                constrained.mark_pressed();
            }
        }
        contact += solves.elapsed().as_secs_f64();
        // (Without a solved contact problem there are no forces.)
        let at_work =
            running(members).filter(|(lane, (_, island))| goes[*lane] && !island.phase.has_ended() && !meter.is_halted());
        let at_work = at_work.map(|(lane, (constrained, island))| (lane, &**island, &mut **constrained));
        let advanced = second_half(pack, setting, at_work, meter);
        for (_, (constrained, _)) in running(members).filter(|(lane, _)| advanced[*lane]) {
            constrained.advanced();
        }
        if meter.is_halted() {
            break;
        }
        for (_, (constrained, island)) in running(members).filter(|(lane, (_, island))| goes[*lane] && !island.phase.has_ended())
        {
            island.check(&Solitary(constrained), options, setting.options.tolerance, h);
        }
    }
    Spent { all: begins.elapsed().as_secs_f64(), contact }
}
