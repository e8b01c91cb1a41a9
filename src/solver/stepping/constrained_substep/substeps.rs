//! Substeps of a substep: islands that have not converged repeat it in two halves if contacts are left deep, and always if they
//! are small, which costs little. Each half begins where the one before has ended; halves are halved again as often as the
//! steps of unconstrained strands ([`StepOptions::max_subdivisions`](crate::step::options::StepOptions::max_subdivisions)). The
//! other strands are already at the end and are not seen meanwhile: an island that ends deeper in them than before keeps its
//! end of the whole substep. It has none where it has diverged. Strands that are left deep count as unconverged.
//!
//! What substeps can solve they solve soon. So halving is limited by work, and what they have not solved in one part of the host's
//! substep is not tried in its other parts.

use super::account::{Account, ContactTally};
use super::{ConstrainedSubstep, Scene};
use crate::contact::body::Body;
use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::Partner;
use crate::coupled::constrained_strand::{ConstrainedStrand, StrandEnd};
use crate::coupled::coupled_step::CoupledParts;
use crate::coupled::island::{FEW, Island, Phase};
use crate::meter::Stopped;
use crate::solver::bodies::deep_places::CurrentScene;
use crate::solver::report::Wrench;
use crate::solver::strands::strand::{Constrained, Strand, Tally};
use crate::step::StrandOutcome;

/// Overlap of more than this many tolerances is deep.
const DEEP: f64 = 2.0;

/// Substeps may leave an island deeper than the whole substep by this many tolerances: as much as two ways to ask for a depth differ.
const SLIGHTLY: f64 = 0.2;

/// No substep is halved again after as much work as so many iterations of its strands take. (In the soak substeps that solve an island take 37
/// of these in the median, and 240 at most in nineteen of twenty; others take 1400.)
const HALVING: u64 = 400;

/// A strand that is to take the substep in substeps.
#[derive(Debug)]
pub(super) struct BeforeSubsteps {
    /// Its index among the constrained strands.
    strand: usize,
    /// The strand before the substep.
    before: Strand,
}

/// The results of substeps.
#[derive(Debug, Default)]
pub(super) struct Substeps {
    reported: ContactTally,
    /// On the bodies, of the last substep.
    wrenches: Vec<Wrench>,
    /// Of the strands that keep their results.
    outcomes: Vec<StrandOutcome>,
}

impl ConstrainedSubstep {
    /// Selects the islands that take the substep in substeps, and returns their strands as they were before it.
    pub(super) fn choose_subdivided(&mut self, scene: &Scene) -> Vec<BeforeSubsteps> {
        let deep = DEEP * scene.options.tolerance;
        let Self { unsolved, coupled, .. } = self;
        let CoupledParts { strands, islands, .. } = coupled.parts();
        for island in islands {
            let may = island.failed() && !island.has_bilateral() && !scene.options.model.is_soft();
            // (A large tangle that cannot be satisfied is expensive. Substeps do not separate what two surfaces push into each
            // other.)
            let large = !scene.is_nested && (island.is_diverged() || island.left.newly > deep);
            let few = island.strands.len() <= FEW && !island.constraints.iter().any(|constraint| constraint.deep);
            let is_new = || !island.strands.iter().any(|strand| unsolved.contains(&strands[*strand as usize].index));
            if may && (few || large) && is_new() {
                island.phase = Phase::Subdivided;
            }
        }
        let before = |strand: usize| scene.strands[self.coupled.strands()[strand].index as usize].clone();
        self.subdivided().map(|strand| BeforeSubsteps { strand, before: before(strand) }).collect()
    }

    /// Takes the selected islands through the two halves of a substep of `h` seconds, which may be halved `levels` times more.
    /// Islands that the whole substep left less deep return to that.
    pub(super) fn take_substeps(&mut self, scene: &mut Scene, h: f64, levels: u32, taking: &[BeforeSubsteps]) -> Substeps {
        let index = |constrained_substep: &Self, taking: &BeforeSubsteps| {
            constrained_substep.coupled.strands()[taking.strand].index as usize
        };
        let whole: Vec<Strand> = taking.iter().map(|taking| scene.strands[index(self, taking)].clone()).collect();
        let (bodies, deep) = (Self::bodies_at_end(scene, h), DEEP * scene.options.tolerance);
        while self.coupled.islands().iter().any(Island::is_subdivided) {
            for taking in taking.iter().filter(|taking| self.is_subdivided(taking.strand)) {
                scene.strands[index(self, taking)].clone_from(&taking.before);
            }
            let mut substeps = self.take_halves(scene, h, levels);
            if scene.meter.stopped() != Stopped::No {
                // Some are in the middle of it.
                for (taking, whole) in taking.iter().zip(&whole) {
                    scene.strands[index(self, taking)].clone_from(whole);
                }
                let subdivided = self.coupled.parts().islands.iter_mut().filter(|island| island.is_subdivided());
                subdivided.for_each(|island| island.phase = Phase::Ended);
                return Substeps::default();
            }
            // The substeps' own depths are not those at the end, and do not include the other strands.
            substeps.reported.penetration = 0.0;
            let (left, mut some_go_back) = (self.depths(scene, &bodies, |constrained| self.is_subdivided(constrained)), false);
            for island in self.coupled.parts().islands.iter_mut().filter(|island| island.is_subdivided()) {
                let most = island.left.deep.max(deep) + SLIGHTLY * scene.options.tolerance;
                let deepest = deepest(island, &left);
                // (Strands that stayed as they were when the step began have no end to return to.)
                if deepest > most && !island.is_diverged() {
                    island.phase = Phase::Ended;
                    some_go_back = true;
                }
                substeps.reported.penetration = substeps.reported.penetration.max(deepest);
            }
            if !some_go_back {
                self.doubt_deep(scene, &mut substeps, &left, deep);
                if let (false, Some(shorter)) = (scene.is_nested, self.shorter.as_deref_mut()) {
                    // The gap at the place where a contact was found may be deeper than the search says.
                    shorter.contacts.iter_mut().for_each(|contact| contact.gap = contact.gap.max(-substeps.reported.penetration));
                }
                return substeps;
            }
            // The others repeat their substeps: some of the strands that they met now end elsewhere.
            for (taking, whole) in taking.iter().zip(&whole).filter(|(taking, _)| !self.is_subdivided(taking.strand)) {
                scene.strands[index(self, taking)].clone_from(whole);
            }
        }
        Substeps::default()
    }

    /// Strands that are `left` deeper than `deep` (m; by their index among the constrained strands) have not converged, whatever the
    /// substeps say, which do not see the strands outside. (What was as deep when the step began parts slowly.)
    fn doubt_deep(&self, scene: &mut Scene, substeps: &mut Substeps, left: &[f64], deep: f64) {
        let islands = self.coupled.islands();
        let mut doubted = vec![false; islands.len()];
        for (constrained, outcome) in self.subdivided().zip(&mut substeps.outcomes) {
            let strand = &self.coupled.strands()[constrained];
            let constraints = &islands[strand.island as usize].constraints;
            let parts = strand.left_deep || strand.attachments.iter().any(|end| constraints[end.constraint as usize].deep);
            if left[constrained] > deep && !parts {
                (outcome.converged, doubted[strand.island as usize]) = (false, true);
                scene.strands[strand.index as usize].last = (&*outcome).into();
            }
        }
        substeps.reported.unconverged += doubted.into_iter().map(u32::from).sum::<u32>();
    }

    fn take_halves(&mut self, scene: &mut Scene, h: f64, levels: u32) -> Substeps {
        let mut shorter = self.shorter.take().unwrap_or_default();
        shorter.forget();
        let mut bodies = (scene.copies)();
        let taking: Vec<usize> = self.subdivided().collect();
        let begin = |constrained: &usize| {
            let StrandOutcome { iterations, .. } = self.coupled.strands()[*constrained].step.outcome;
            StrandOutcome { converged: true, substeps: 0, iterations, ..StrandOutcome::default() }
        };
        let mut outcomes: Vec<StrandOutcome> = taking.iter().map(begin).collect();
        let (half, mut reported) = (0.5 * h, ContactTally::default());
        let halving_ends = if scene.is_nested { scene.halving_ends } else { scene.meter.spent() + self.halving_work(&taking) };
        let mut wrenches = vec![Wrench::default(); bodies.len()];
        for _ in 0..2 {
            scene.strands.iter_mut().for_each(|strand| strand.constrained = Constrained::No);
            for constrained in &taking {
                scene.strands[self.coupled.strands()[*constrained].index as usize].constrained = Constrained::Yes;
            }
            wrenches.fill(Wrench::default());
            bodies.iter_mut().for_each(|body| body.begin(half));
            let copies = || bodies.clone();
            let at: Vec<BodyAt> = bodies.iter().enumerate().map(|(k, body)| body.at(k as u32, half)).collect();
            // They have no bilateral constraints.
            let (strands, constraints) = (&mut *scene.strands, &mut [][..]);
            let mut part = Scene { strands, constraints, bodies: &at, copies: &copies, is_nested: true, halving_ends, ..*scene };
            let account = Account { tally: &mut Tally::default(), contact: &mut reported, wrenches: &mut wrenches };
            shorter.take(&mut part, half, levels, account);
            bodies.iter_mut().for_each(|body| body.finish(half));
            for (outcome, part) in outcomes.iter_mut().zip(shorter.coupled.strands()) {
                outcome.add_constrained_substep(&part.step.outcome);
            }
        }
        for (constrained, outcome) in taking.iter().zip(&outcomes) {
            scene.strands[self.coupled.strands()[*constrained].index as usize].last = outcome.into();
        }
        self.shorter = Some(shorter);
        Substeps { reported, wrenches, outcomes }
    }

    /// The work after which substeps of these strands are not halved again.
    fn halving_work(&self, taking: &[usize]) -> u64 {
        let half = |strand: &usize| {
            let strand = &self.coupled.strands()[*strand];
            strand.half_work_with(strand.attachments.len())
        };
        HALVING * taking.iter().map(|strand| 2 * half(strand)).sum::<u64>()
    }

    /// Notes which strands substeps have not solved.
    pub(super) fn note_unsolved(&mut self, taking: &[BeforeSubsteps], substeps: &Substeps) {
        let solved: Vec<usize> = self
            .subdivided()
            .zip(&substeps.outcomes)
            .filter(|(_, outcome)| outcome.converged)
            .map(|(strand, _)| strand)
            .collect();
        let unsolved = taking.iter().filter(|taking| solved.binary_search(&taking.strand).is_err());
        let strands = self.coupled.strands();
        self.unsolved.extend(unsolved.map(|taking| strands[taking.strand].index));
    }

    /// Adds the results of substeps to the report.
    pub(super) fn add_substeps(&mut self, substeps: &Substeps, account: Account) {
        let taking: Vec<usize> = self.subdivided().collect();
        for (constrained, outcome) in taking.into_iter().zip(&substeps.outcomes) {
            self.coupled.parts().strands[constrained].step.outcome = *outcome;
            account.tally.add(outcome);
        }
        account.contact.add_substeps(&substeps.reported);
        for (wrench, found) in account.wrenches.iter_mut().zip(&substeps.wrenches) {
            wrench.force += found.force;
            wrench.torque += found.torque;
        }
        if let Some(shorter) = self.shorter.as_deref_mut().filter(|_| !substeps.outcomes.is_empty()) {
            self.contacts.append(&mut shorter.contacts);
            self.coupled.detection().keep_warm_start_of(shorter.coupled.detection());
        }
    }

    /// Whether a strand takes the substep in substeps, so that its end of the whole one is dropped.
    pub(super) fn is_subdivided(&self, constrained: usize) -> bool {
        self.coupled.island_of(constrained).is_subdivided()
    }

    fn subdivided(&self) -> impl Iterator<Item = usize> {
        (0..self.coupled.strands().len()).filter(|constrained| self.is_subdivided(*constrained))
    }

    /// Measures the depth of islands with strands that move with their roots or are rolled back: for these the end of the
    /// iteration no longer counts. (Not within a nested substep, nor of islands that are subdivided.)
    pub(super) fn report_replaced(&mut self, scene: &Scene, h: f64) {
        let is_replaced =
            |constrained: &ConstrainedStrand| constrained.end == StrandEnd::WithRoot || constrained.step.outcome.quarantined;
        if scene.is_nested || scene.meter.is_halted() || !self.coupled.strands().iter().any(is_replaced) {
            return;
        }
        let (strands, islands) = (self.coupled.strands(), self.coupled.islands());
        let any = |island: &Island| island.strands.iter().any(|constrained| is_replaced(&strands[*constrained as usize]));
        let asked: Vec<bool> = islands.iter().map(|island| !island.is_subdivided() && any(island)).collect();
        let depths =
            self.depths(scene, &Self::bodies_at_end(scene, h), |constrained| asked[strands[constrained].island as usize]);
        for (island, asked) in self.coupled.parts().islands.iter_mut().zip(asked) {
            if asked {
                island.left.deep = deepest(island, &depths);
            }
        }
    }

    /// Copies of the bodies at rest at the end of a substep of `h` seconds; none in a nested substep, where they are not
    /// needed.
    fn bodies_at_end(scene: &Scene, h: f64) -> Vec<Body> {
        let mut bodies = if scene.is_nested { Vec::new() } else { (scene.copies)() };
        for body in &mut bodies {
            body.begin(h);
            body.finish(h);
            body.rest();
        }
        bodies
    }

    /// The depths of the `asked` strands, m, by their index among the constrained ones, in the current scene and independent of known
    /// contacts. Zero for the others, and in a nested substep, where other strands are elsewhere.
    fn depths(&self, scene: &Scene, bodies: &[Body], asked: impl Fn(usize) -> bool + Sync) -> Vec<f64> {
        let constrained = self.coupled.strands();
        let mut depths = vec![0.0_f64; constrained.len()];
        if scene.is_nested {
            return depths;
        }
        let strand = |index: usize| {
            let found = constrained.binary_search_by_key(&(index as u32), |constrained| constrained.index);
            found.ok().filter(|place| asked(*place))
        };
        let bodies: Vec<BodyAt> = bodies.iter().enumerate().map(|(k, body)| body.still(k as u32)).collect();
        let Scene { ref strands, slots, ref constraints, workers, options, .. } = *scene;
        let now = CurrentScene { strands, slots, constraints, bodies: &bodies, hair: options.hair, workers };
        for deep in now.deep_places(|index| strand(index).is_some()) {
            let (place, other) = match deep.partner {
                // The host has put the root there.
                Partner::Body { .. } if deep.point.element == 0 && deep.point.s == 0.0 => continue,
                Partner::Body { .. } => (deep.point, None),
                Partner::Strand(other) => (deep.point, Some(other)),
            };
            for strand in [Some(place), other].into_iter().flatten().filter_map(|place| strand(place.strand as usize)) {
                depths[strand] = depths[strand].max(now.depth(&deep));
            }
        }
        depths
    }
}

/// The deepest of an island's strands, whose `depths` these are.
fn deepest(island: &Island, depths: &[f64]) -> f64 {
    island.strands.iter().fold(0.0, |deepest, strand| depths[*strand as usize].max(deepest))
}

impl ContactTally {
    /// Adds the results of nested substeps.
    fn add_substeps(&mut self, substeps: &Self) {
        self.contacts += substeps.contacts;
        self.searches = self.searches.max(substeps.searches);
        self.iterations = self.iterations.max(substeps.iterations);
        self.sweeps += substeps.sweeps;
        self.unconverged += substeps.unconverged;
        self.residual = self.residual.max(substeps.residual);
        self.penetration = self.penetration.max(substeps.penetration);
    }
}
