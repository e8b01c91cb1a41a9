//! Contacts that a search between iterations finds and no constraint represents: they are added to the islands' constraints. Those whose
//! strands have gone elsewhere meanwhile are let go.

use super::ContactDetection;
use crate::contact::constraint::law::Law;
use crate::contact::constraint::step_constraint::{ConstraintEnd, Give, SAME_SIDE, StepConstraint};
use crate::coupled::constrained_strand::ConstrainedStrand;
use crate::coupled::coupled_step::Stepping;
use crate::coupled::island::Island;
use crate::coupled::nearest_pair::has_departed;

/// An undetected contact is a known one, seen from where the strands are now, if it is no further from it along the strand than
/// this fraction of the distance that the surfaces keep between their centres. Side by side the two would be one force in two
/// places, which no solve can tell apart.
const SAME_PLACE: f64 = 0.5;
/// A strand whose element is further from convergence than this, rad, while its iteration goes on, and that has more new
/// contacts than this, is not near its final place.
const WILD: f64 = 1.0;
const CROWD: usize = 20;

impl ContactDetection {
    /// Of the contacts found last of the strands that are `asked`: overlaps at the present iterate that no constraint represents. `None` if the
    /// meter has halted it: strands with contacts still count as moved.
    fn undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        asked: impl Fn(u32) -> bool,
    ) -> Option<Vec<StepConstraint>> {
        let (mut undetected, mut left_deep, mut halted) =
            (std::mem::take(&mut self.undetected), std::mem::take(&mut self.left_deep), false);
        undetected.clear();
        for (index, (constrained, contact)) in self.found(strands).enumerate() {
            halted = stepping.meter.is_halted_at(index);
            if halted {
                break;
            }
            let is_given_up = || islands[strands[constrained as usize].island as usize].is_given_up();
            if contact.gap >= -stepping.options.tolerance || !asked(constrained) || is_given_up() {
                continue;
            }
            let mut constraint = self.constraint(stepping, strands, constrained, contact);
            if constraint.deep {
                // It yields: its depth means nothing, but is reported.
                left_deep.extend(constraint.ends());
                continue;
            }
            let first = &strands[constrained as usize];
            let a = first.end_state(&constraint.first.material_point);
            let other = constraint.second.map(|end| (&strands[end.strand as usize], end.material_point));
            let (b, contact) = other
                .map_or((a, &first.contact), |(strand, material_point)| (strand.end_state(&material_point), &strand.contact));
            let (law, u) = constraint.evaluate([a, b], [&first.contact, contact], stepping.options, stepping.h);
            let overlaps = matches!(law, Law::Contact(law) if law.normal.dot(&u) < -stepping.options.tolerance);
            if overlaps && !is_reported(&constraint, strands, islands, stepping.options.tolerance) {
                undetected.push(constraint);
            }
        }
        for end in left_deep.drain(..) {
            strands[end.strand as usize].left_deep = true;
        }
        self.left_deep = left_deep;
        if halted {
            let with_contacts: Vec<u32> = self.found(strands).map(|(constrained, _)| constrained).collect();
            with_contacts.iter().for_each(|constrained| strands[*constrained as usize].search_all_of_it());
        }
        (!halted).then_some(undetected)
    }

    /// Marks strands and islands with contacts that no constraint represents, after the last search. False if the meter has
    /// halted it.
    pub fn report_undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
    ) -> bool {
        let undetected = self.undetected(stepping, strands, islands, |_| true);
        for end in undetected.iter().flatten().flat_map(StepConstraint::ends) {
            let strand = &mut strands[end.strand as usize];
            strand.has_undetected = true;
            islands[strand.island as usize].progress.ending.doubt();
        }
        let whole = undetected.is_some();
        self.undetected = undetected.unwrap_or_default();
        whole
    }

    /// Adds the undetected contacts of the last search to the islands' constraints, and `lets_go` of those whose strands have departed.
    /// `None` if there are neither; else how many were added. The constraints of their strands' islands are then in `constraints`, from which islands are
    /// formed again.
    pub fn add_undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
        constraints: &mut Vec<StepConstraint>,
        lets_go: bool,
    ) -> Option<usize> {
        constraints.clear();
        let mut undetected = self.undetected(stepping, strands, islands, |_| true)?;
        leave_wild_ones(&mut undetected, strands, islands);
        let departed = if lets_go { departed(strands, islands, stepping.options.tolerance) } else { Vec::new() };
        if undetected.is_empty() && departed.is_empty() {
            self.undetected = undetected;
            return None;
        }
        let gone = departed.iter().map(|(island, index)| &islands[*island].constraints[*index]);
        let changed: Vec<u32> = undetected.iter().chain(gone).flat_map(StepConstraint::ends).map(|end| end.strand).collect();
        Some(self.dissolve(changed, undetected, departed, strands, islands, constraints))
    }

    /// The same for `asked` strands (ascending), whose islands are formed again whether anything is new or not. False if the meter has halted it.
    pub fn add_undetected_of<S>(
        &mut self,
        asked: &[u32],
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
        constraints: &mut Vec<StepConstraint>,
    ) -> bool {
        constraints.clear();
        let is_asked = |constrained: u32| asked.binary_search(&constrained).is_ok();
        let Some(undetected) = self.undetected(stepping, strands, islands, is_asked) else { return false };
        self.dissolve(asked.to_vec(), undetected, Vec::new(), strands, islands, constraints);
        true
    }

    /// Dissolves the islands of `changed` strands. Puts their constraints in `constraints`, without those that have `departed` (by island and index,
    /// ascending), and with the `undetected` ones, whose number it returns.
    fn dissolve(
        &mut self,
        changed: Vec<u32>,
        mut undetected: Vec<StepConstraint>,
        departed: Vec<(usize, usize)>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
        constraints: &mut Vec<StepConstraint>,
    ) -> usize {
        let mut dissolved: Vec<usize> = changed.iter().map(|strand| strands[*strand as usize].island as usize).collect();
        dissolved.sort_unstable();
        dissolved.dedup();
        let mut departed = departed.into_iter().peekable();
        for k in dissolved {
            let first = constraints.len();
            islands[k].dissolve(strands, constraints);
            if departed.peek().is_some_and(|(island, _)| *island == k) {
                let all = constraints.split_off(first).into_iter().enumerate();
                constraints.extend(
                    all.filter(|(index, _)| departed.next_if_eq(&(k, *index)).is_none()).map(|(_, constraint)| constraint),
                );
            }
        }
        for strand in changed {
            let strand = &mut strands[strand as usize];
            (strand.ended, strand.progress) = (None, None);
        }
        let (known_of, added) = (&mut self.known_of, undetected.len());
        known_of.reset(strands.len());
        for constraint in undetected.drain(..) {
            known_of.take_in(constraints);
            let (mut give, mut nearest) = (Give::No, None);
            let known = known_of.strand(constraint.first.strand).map(|index| (index, &constraints[index]));
            for (index, known) in known.filter(|(_, known)| known.is_with(&constraint)) {
                // A yielding pair of surfaces yields everywhere.
                give = give.max(known.give);
                let apart = apart(known, &constraint, strands);
                let turned = known.turned(&constraint);
                let same = !known.deep && turned < 1.0 - SAME_SIDE && apart <= SAME_PLACE * constraint.margin();
                // A point in a crease has two contacts.
                let unlike = apart + turned * constraint.margin();
                if same && nearest.is_none_or(|(_, least)| unlike <= least) {
                    nearest = Some((index, unlike));
                }
            }
            // A known contact moves to its deepest point; any other is new, also beside a yielding one.
            let constraint = StepConstraint { give, ..constraint };
            match nearest {
                Some((known, _)) if constraints[known].has_left(&constraint) => {
                    constraints.push(StepConstraint { in_crease: true, ..constraint })
                }
                Some((known, _)) => {
                    let StepConstraint { force, in_crease, .. } = constraints[known];
                    constraints[known] = StepConstraint { force, in_crease, ..constraint };
                }
                None => constraints.push(constraint),
            }
        }
        self.undetected = undetected;
        added
    }
}

/// The contacts that press strands which have departed from each other, by island and index, ascending.
fn departed(strands: &[ConstrainedStrand], islands: &[Island], tolerance: f64) -> Vec<(usize, usize)> {
    let mut departed = Vec::new();
    for (k, island) in islands.iter().enumerate().filter(|(_, island)| !island.is_given_up()) {
        for (index, constraint) in island.constraints.iter().enumerate() {
            let is_exact = !constraint.deep && constraint.give == Give::No;
            if is_exact && constraint.presses() && has_departed(constraint, strands, tolerance) {
                departed.push((k, index));
            }
        }
    }
    departed
}

/// Removes the new contacts of strands that are far from convergence and overlap many others there: their real contacts are
/// visible when they have come nearer to it. (Thousands of such contacts would hold the strands of a tangle.)
fn leave_wild_ones(undetected: &mut Vec<StepConstraint>, strands: &[ConstrainedStrand], islands: &[Island]) {
    let is_wild = |constrained: u32| {
        strands[constrained as usize].residual > WILD && !islands[strands[constrained as usize].island as usize].phase.has_ended()
    };
    let mut ends: Vec<u32> = undetected
        .iter()
        .flat_map(StepConstraint::ends)
        .map(|end| end.strand)
        .filter(|constrained| is_wild(*constrained))
        .collect();
    ends.sort_unstable();
    let wild: Vec<u32> = ends.chunk_by(|a, b| a == b).filter(|ends| ends.len() > CROWD).map(|ends| ends[0]).collect();
    undetected.retain(|constraint| !constraint.ends().any(|end| wild.binary_search(&end.strand).is_ok()));
}

/// The constraints of which a strand is the first end, the last first.
#[derive(Debug, Default)]
pub(super) struct KnownOf {
    last: Vec<Option<usize>>,
    before: Vec<Option<usize>>,
}

impl KnownOf {
    /// For this number of strands, without constraints.
    fn reset(&mut self, strands: usize) {
        self.last.clear();
        self.last.resize(strands, None);
        self.before.clear();
    }

    /// Adds the new entries of a list of constraints.
    fn take_in(&mut self, constraints: &[StepConstraint]) {
        for (index, constraint) in constraints.iter().enumerate().skip(self.before.len()) {
            self.before.push(self.last[constraint.first.strand as usize].replace(index));
        }
    }

    fn strand(&self, constrained: u32) -> impl Iterator<Item = usize> {
        std::iter::successors(self.last[constrained as usize], |index| self.before[*index])
    }
}

/// Whether an existing constraint already represents the overlap of this contact: it is as deep elsewhere, and yields or is
/// beside it.
fn is_reported(constraint: &StepConstraint, strands: &[ConstrainedStrand], islands: &[Island], tolerance: f64) -> bool {
    let strand = &strands[constraint.first.strand as usize];
    let known = strand.attachments.iter().map(|end| &islands[strand.island as usize].constraints[end.constraint as usize]);
    let beside = |known: &StepConstraint| apart(known, constraint, strands) <= SAME_PLACE * constraint.margin();
    let mut as_deep = known.filter(|known| known.is_with(constraint) && !known.deep && known.gap <= constraint.gap + tolerance);
    as_deep.any(|known| known.give != Give::No || beside(known))
}

/// The larger distance of two contacts of a strand with the same partner, along the strand or along the partner, m.
fn apart(one: &StepConstraint, other: &StepConstraint, strands: &[ConstrainedStrand]) -> f64 {
    let along = |end: &ConstraintEnd| strands[end.strand as usize].along(&end.material_point);
    let off = |a: &ConstraintEnd, b: &ConstraintEnd| (along(a) - along(b)).abs();
    let first = off(&one.first, &other.first);
    match (&one.second, &other.second) {
        (Some(a), Some(b)) => first.max(off(a, b)),
        _ => first,
    }
}
