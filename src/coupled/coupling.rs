//! Couples strands into islands by their constraints, at first and whenever new ones are found. Islands on which nothing new acts keep theirs.

use super::constrained_strand::{Attachment, ConstrainedStrand};
use super::coupled_step::CoupledStep;
use super::island::Island;
use crate::contact::constraint::step_constraint::StepConstraint;

impl CoupledStep {
    /// Couples the constraints' strands into islands, to be solved `rough`ly first where that is of use. Islands that have not been dissolved
    /// stay; none of the constraints acts on their strands.
    pub fn tie(&mut self, rough: bool) {
        self.sets.reset(self.count);
        for constraint in &self.constraints {
            if let Some(second) = constraint.second {
                self.sets.join(constraint.first.strand, second.strand);
            }
        }
        for island in &self.islands[..self.island_count] {
            island.strands.windows(2).for_each(|pair| self.sets.join(pair[0], pair[1]));
            island.pass_on_progress(&mut self.strands);
        }
        self.number_islands();
        for constrained in &mut self.strands[..self.count] {
            constrained.rest.forget_wakes();
        }
        for island in &mut self.islands[..self.island_count] {
            // Strands on which nothing new acts are coupled as before.
            let ended = |constrained: &u32| self.strands[*constrained as usize].ended;
            if island.strands.iter().all(|constrained| ended(constrained).is_some())
                && let Some(ending) = island.strands.first().and_then(ended)
            {
                island.keep(ending);
            }
            if let [alone] = island.strands[..]
                && let Some(progress) = self.strands[alone as usize].progress.take()
            {
                island.resume(progress);
            }
        }
        for constraint in self.constraints.drain(..) {
            let island = &mut self.islands[self.strands[constraint.first.strand as usize].island as usize];
            let number = island.constraints.len() as u32;
            island.constraints.push(constraint);
            for (k, end) in constraint.ends().enumerate() {
                let attachment = Attachment {
                    constraint: number,
                    second: k == 1,
                    material_point: end.material_point,
                    modelled: constraint.modelled[k],
                };
                self.strands[end.strand as usize].attachments.push(attachment);
            }
        }
        if rough {
            self.islands[..self.island_count].iter_mut().for_each(Island::begin_roughly);
        }
    }

    /// Numbers the islands by their first strands: those that stay, and new ones, which have no constraints yet.
    fn number_islands(&mut self) {
        std::mem::swap(&mut self.islands, &mut self.former);
        let former_count = std::mem::take(&mut self.island_count);
        for k in 0..self.count {
            let lowest = self.sets.lowest(k as u32) as usize;
            if lowest < k {
                self.strands[k].island = self.strands[lowest].island;
            } else {
                self.islands.resize_with(self.islands.len().max(self.island_count + 1), Island::default);
                let island = &mut self.islands[self.island_count];
                let former = self.strands[k].island as usize;
                if former < former_count && !self.former[former].strands.is_empty() {
                    std::mem::swap(island, &mut self.former[former]);
                    island.begin();
                } else {
                    island.clear();
                }
                self.strands[k].island = self.island_count as u32;
                self.island_count += 1;
            }
            let strands = &mut self.islands[self.strands[k].island as usize].strands;
            // (One that stays has all of its strands already.)
            if strands.last().is_none_or(|last| *last < k as u32) {
                strands.push(k as u32);
            }
        }
    }
}

impl Island {
    /// Lets its strands know how far its iteration has come.
    fn pass_on_progress(&self, strands: &mut [ConstrainedStrand]) {
        let (ended, unfinished) = (self.ended(), self.unfinished());
        for constrained in &self.strands {
            let constrained = &mut strands[*constrained as usize];
            (constrained.ended, constrained.progress) = (ended, unfinished.clone());
            if ended.is_some_and(|ending| ending.is_converged()) {
                constrained.rest.settle();
            }
        }
    }

    /// Gives up its strands, to be coupled again, and adds its constraints to `constraints`.
    pub fn dissolve(&mut self, strands: &mut [ConstrainedStrand], constraints: &mut Vec<StepConstraint>) {
        self.pass_on_progress(strands);
        for constrained in self.strands.drain(..) {
            // Attachments are made again; the models of resting strands are not.
            for end in strands[constrained as usize].attachments.drain(..) {
                self.constraints[end.constraint as usize].modelled[usize::from(end.second)] = end.modelled;
            }
        }
        constraints.append(&mut self.constraints);
    }
}
