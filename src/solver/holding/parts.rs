//! Strands of islands that have not come to their end take the substep again, in parts: where touches are left deep, and always where they are
//! few, which costs little. Each half begins where the one before has left them; there are halves of halves, as often as free strands' steps
//! may be halved ([`StepOptions::max_subdivisions`](crate::step::options::StepOptions::max_subdivisions)). The others have gone on, and are not
//! seen meanwhile: an island that comes deeper into them so than it was left goes back to that.

use super::account::{Account, ContactTally};
use super::{Holding, Scene};
use crate::contact::body::{Body, BodyAt};
use crate::contact::held_strand::HeldStrand;
use crate::contact::island::{FEW, Island};
use crate::contact::touch::Partner;
use crate::meter::Stopped;
use crate::solver::deep_places::CurrentScene;
use crate::solver::report::Wrench;
use crate::solver::strand::{Holds, Strand, Tally};
use crate::step::StrandOutcome;

/// Surfaces that are so many tolerances in each other are deep.
const DEEP: f64 = 2.0;

/// A strand that is to take the substep in parts.
#[derive(Debug)]
pub(super) struct Parted {
    /// Its place among the held strands.
    held: usize,
    /// As the substep found it.
    before: Strand,
}

/// What parts came to.
#[derive(Debug, Default)]
pub(super) struct Parts {
    told: ContactTally,
    /// On the bodies, by the last of them.
    wrenches: Vec<Wrench>,
    /// Of the strands that have kept them.
    outcomes: Vec<StrandOutcome>,
}

impl Holding {
    /// Marks the islands that are to take the substep in parts, and gives their strands as the substep found them.
    pub(super) fn choose_parts(&mut self, scene: &Scene) -> Vec<Parted> {
        let deep = DEEP * scene.options.tolerance;
        for island in self.islands[..self.island_count].iter_mut() {
            let may = island.failed() && !island.is_constrained() && !scene.options.model.is_soft();
            // (A tangle of large ones that cannot be held takes a while each time. What two surfaces push into each other no part gets out.)
            let large = !scene.is_part && (island.ending.lost || island.left.newly > deep);
            let few = island.strands.len() <= FEW && !island.joints.iter().any(|joint| joint.deep);
            island.takes_parts = may && (few || large);
        }
        let strands = &self.strands;
        let taking = (0..self.count).filter(|held| self.takes_parts(*held));
        taking.map(|held| Parted { held, before: scene.strands[strands[held].index as usize].clone() }).collect()
    }

    /// Takes the islands in question through the two halves of a substep of `h` seconds, which may be halved `levels` times more. They end as
    /// whole steps have left them where that is less deep.
    pub(super) fn take_parts(&mut self, scene: &mut Scene, h: f64, levels: u32, parted: &[Parted]) -> Parts {
        let index = |holding: &Self, parted: &Parted| holding.strands[parted.held].index as usize;
        let whole: Vec<Strand> = parted.iter().map(|parted| scene.strands[index(self, parted)].clone()).collect();
        let bodies = Self::bodies_at_end(scene, h);
        while self.islands[..self.island_count].iter().any(|island| island.takes_parts) {
            for parted in parted.iter().filter(|parted| self.takes_parts(parted.held)) {
                scene.strands[index(self, parted)].clone_from(&parted.before);
            }
            let mut parts = self.take_halves(scene, h, levels);
            if scene.meter.stopped() != Stopped::No {
                // Some are in the middle of it.
                for (parted, whole) in parted.iter().zip(&whole) {
                    scene.strands[index(self, parted)].clone_from(whole);
                }
                self.islands[..self.island_count].iter_mut().for_each(|island| island.takes_parts = false);
                return Parts::default();
            }
            // Of the parts' own ends the first ones are on the way, and none knows of the others.
            parts.told.penetration = 0.0;
            let (left, mut some_go_back) = (self.depths(scene, &bodies, |held| self.takes_parts(held)), false);
            for (k, island) in self.islands[..self.island_count].iter_mut().enumerate().filter(|(_, island)| island.takes_parts) {
                let most = island.left.deep.max(DEEP * scene.options.tolerance) + scene.options.tolerance;
                // (Where strands had to stay as the step found them, there is nothing to go back to.)
                island.takes_parts = left[k] <= most || island.ending.lost;
                some_go_back |= !island.takes_parts;
                parts.told.penetration = parts.told.penetration.max(left[k]);
            }
            if !some_go_back {
                return parts;
            }
            // The others take their parts anew: some of what they met in them ends elsewhere now.
            for (parted, whole) in parted.iter().zip(&whole).filter(|(parted, _)| !self.takes_parts(parted.held)) {
                scene.strands[index(self, parted)].clone_from(whole);
            }
        }
        Parts::default()
    }

    fn take_halves(&mut self, scene: &mut Scene, h: f64, levels: u32) -> Parts {
        let mut shorter = self.shorter.take().unwrap_or_default();
        shorter.forget();
        let mut bodies = (scene.copies)();
        let taking: Vec<usize> = (0..self.count).filter(|held| self.takes_parts(*held)).collect();
        let begin = |held: &usize| {
            let StrandOutcome { iterations, .. } = self.strands[*held].held.outcome;
            StrandOutcome { converged: true, substeps: 0, iterations, ..StrandOutcome::default() }
        };
        let mut outcomes: Vec<StrandOutcome> = taking.iter().map(begin).collect();
        let (half, mut told) = (0.5 * h, ContactTally::default());
        let mut wrenches = vec![Wrench::default(); bodies.len()];
        for _ in 0..2 {
            scene.strands.iter_mut().for_each(|strand| strand.holds = Holds::No);
            for held in &taking {
                scene.strands[self.strands[*held].index as usize].holds = Holds::Yes;
            }
            wrenches.fill(Wrench::default());
            bodies.iter_mut().for_each(|body| body.begin(half));
            let copies = || bodies.clone();
            let at: Vec<BodyAt> = bodies.iter().enumerate().map(|(k, body)| body.at(k as u32, half)).collect();
            // Constraints hold none of them.
            let (strands, constraints) = (&mut *scene.strands, &mut [][..]);
            let mut part = Scene { strands, constraints, bodies: &at, copies: &copies, is_part: true, ..*scene };
            let account = Account { tally: &mut Tally::default(), contact: &mut told, wrenches: &mut wrenches };
            shorter.take(&mut part, half, levels, account);
            bodies.iter_mut().for_each(|body| body.finish(half));
            for (outcome, part) in outcomes.iter_mut().zip(&shorter.strands[..shorter.count]) {
                outcome.add_held_part(&part.held.outcome);
            }
        }
        for (held, outcome) in taking.iter().zip(&outcomes) {
            scene.strands[self.strands[*held].index as usize].last = outcome.into();
        }
        self.shorter = Some(shorter);
        Parts { told, wrenches, outcomes }
    }

    /// Adds what strands came to in parts to what is told of the others.
    pub(super) fn add_parts(&mut self, parts: &Parts, account: Account) {
        let taking: Vec<usize> = (0..self.count).filter(|held| self.takes_parts(*held)).collect();
        for (held, outcome) in taking.into_iter().zip(&parts.outcomes) {
            self.strands[held].held.outcome = *outcome;
            account.tally.add(outcome);
        }
        account.contact.add_parts(&parts.told);
        for (wrench, found) in account.wrenches.iter_mut().zip(&parts.wrenches) {
            wrench.force += found.force;
            wrench.torque += found.torque;
        }
        if let Some(shorter) = self.shorter.as_deref_mut().filter(|_| !parts.outcomes.is_empty()) {
            self.contacts.append(&mut shorter.contacts);
            self.touching.remember_parts(&shorter.touching);
        }
    }

    /// Whether a strand takes the substep in parts: the end that the whole has for it is not to be.
    pub(super) fn takes_parts(&self, held: usize) -> bool {
        self.islands[self.strands[held].island as usize].takes_parts
    }

    /// Tells the islands how deep their strands are where some of them go along with their roots after all, or are rolled back: where the iteration left
    /// these no longer counts. (Not in a part of a substep, nor of islands that take parts: there nobody asks.)
    pub(super) fn tell_replaced(&mut self, scene: &Scene, h: f64) {
        let is_replaced = |held: &HeldStrand| held.carried || held.held.outcome.quarantined;
        if scene.is_part || scene.meter.is_halted() || !self.strands[..self.count].iter().any(is_replaced) {
            return;
        }
        let islands = &self.islands[..self.island_count];
        let any = |island: &Island| island.strands.iter().any(|held| is_replaced(&self.strands[*held as usize]));
        let asked: Vec<bool> = islands.iter().map(|island| !island.takes_parts && any(island)).collect();
        let depths = self.depths(scene, &Self::bodies_at_end(scene, h), |held| asked[self.strands[held].island as usize]);
        for (island, (depth, asked)) in self.islands.iter_mut().zip(depths.into_iter().zip(asked)) {
            if asked {
                island.left.deep = depth;
            }
        }
    }

    /// Where bodies rest when a substep of `h` seconds is over. Not in a part of one, where nobody is to ask.
    fn bodies_at_end(scene: &Scene, h: f64) -> Vec<Body> {
        let mut bodies = if scene.is_part { Vec::new() } else { (scene.copies)() };
        for body in &mut bodies {
            body.begin(h);
            body.finish(h);
            body.rest();
        }
        bodies
    }

    /// How deep the islands of the strands in question are in what there is, m: as everything is now, whatever touches there were. Of a part of a
    /// substep that cannot be told: other strands are elsewhere then.
    fn depths(&self, scene: &Scene, bodies: &[Body], asked: impl Fn(usize) -> bool + Sync) -> Vec<f64> {
        let mut depths = vec![0.0_f64; self.island_count];
        if scene.is_part {
            return depths;
        }
        let held = &self.strands[..self.count];
        let island = |index: usize| {
            let found = held.binary_search_by_key(&(index as u32), |held| held.index);
            found.ok().filter(|place| asked(*place)).map(|place| held[place].island as usize)
        };
        let bodies: Vec<BodyAt> = bodies.iter().enumerate().map(|(k, body)| body.still(k as u32)).collect();
        let Scene { ref strands, slots, ref constraints, workers, options, .. } = *scene;
        let now = CurrentScene { strands, slots, constraints, bodies: &bodies, hair: options.hair, workers };
        for deep in now.deep_places(|index| island(index).is_some()) {
            let (place, other) = match deep.partner {
                // The root is where the host has put it.
                Partner::Body { .. } if deep.place.element == 0 && deep.place.s == 0.0 => continue,
                Partner::Body { .. } => (deep.place, None),
                Partner::Strand(other) => (deep.place, Some(other)),
            };
            for island in [Some(place), other].into_iter().flatten().filter_map(|place| island(place.strand as usize)) {
                depths[island] = depths[island].max(now.depth(&deep));
            }
        }
        depths
    }
}

impl ContactTally {
    /// Adds what the parts of a substep came to.
    fn add_parts(&mut self, parts: &Self) {
        self.touches += parts.touches;
        self.searches = self.searches.max(parts.searches);
        self.iterations = self.iterations.max(parts.iterations);
        self.sweeps += parts.sweeps;
        self.unconverged += parts.unconverged;
        self.residual = self.residual.max(parts.residual);
        self.penetration = self.penetration.max(parts.penetration);
    }
}
