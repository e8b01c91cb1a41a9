//! The population of strands: add, remove, list.

use std::sync::Arc;

use super::strand::Strand;
use crate::error::{Error, Result};
use crate::memory;
use crate::rod::section::Section;
use crate::solver::Solver;
use crate::solver::definition::{StrandDef, Workers};
use crate::solver::id::{self, StrandId};

/// An upper bound on a worker's bytes per element of the longest strand during creation.
const SCRATCH_OF_AN_ELEMENT: usize = 8192;

/// A strand under creation.
struct Made<'a> {
    id: StrandId,
    def: &'a StrandDef,
    section: Arc<Section>,
    strand: Option<Strand>,
}

impl Solver {
    /// Adds strands, all or none, and returns their identifiers in the order of the definitions.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `strands[i].field`; [`Error::OutOfMemory`] when all identifiers are in use, or memory
    /// runs out.
    pub fn add_strands(&mut self, strands: &[StrandDef]) -> Result<Vec<StrandId>> {
        for (index, def) in strands.iter().enumerate() {
            // Named only on failure: a name for each would cost more than the checks.
            def.check("strands").or_else(|_| def.check(&format!("strands[{index}]")))?;
        }
        if self.strands.len() + strands.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: strands.len().saturating_mul(size_of::<Strand>()) });
        }
        let bytes = strands.iter().map(|def| Strand::bytes_of(def, &self.rules)).fold(0, usize::saturating_add);
        let threads = if let Workers::Pool(threads) = self.options.workers { threads } else { 1 };
        let longest = strands.iter().map(|def| def.element_lengths.len()).max().unwrap_or(0);
        let bytes = bytes.saturating_add(longest.saturating_mul(SCRATCH_OF_AN_ELEMENT).saturating_mul(threads));
        self.slots.reserve(strands.len())?;
        self.make_room(strands.len())?;
        let mut ids = memory::list(strands.len())?;
        let mut made: Vec<Made> = memory::list(strands.len())?;
        memory::check_room(bytes)?;
        for def in strands {
            let Some(id) = self.slots.insert(self.strands.len() + made.len()) else {
                // Only retired slots lead here; the identifiers issued so far are withdrawn.
                made.iter().for_each(|made| self.slots.remove(made.id));
                return Err(Error::OutOfMemory { bytes: size_of::<Strand>() });
            };
            made.push(Made { id, def, section: self.sections.of(&def.material, def.freedoms), strand: None });
        }
        let (gravity, rules) = (self.options.gravity, &*self.rules);
        self.workers.for_each_on_own(&mut made, |Made { id, def, section, strand }, workspace| {
            let strand = strand.insert(Strand::new(*id, def, section.clone(), rules));
            strand.update_energies(gravity, rules, &mut workspace.step.one.workspace.iterate.kinematics);
        });
        ids.extend(made.iter().map(|made| made.id));
        self.strands.extend(made.into_iter().filter_map(|made| made.strand));
        Ok(ids)
    }

    /// Reserves memory for this many more strands. Grows by an eighth at least, so that adding one by one is not slow, and not by
    /// a factor of two like a plain list: most of a solver's memory is here.
    pub(in crate::solver) fn make_room(&mut self, more: usize) -> Result<()> {
        let (length, capacity) = (self.strands.len(), self.strands.capacity());
        if length + more > capacity {
            memory::reserve(&mut self.strands, (length + more).max(capacity + capacity / 8) - length)?;
        }
        Ok(())
    }

    /// Removes strands, all or none, and the constraints on them. The others keep their identifiers and their order.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for an identifier given twice.
    pub fn remove_strands(&mut self, ids: &[StrandId]) -> Result<()> {
        let indices = self.indices(ids)?;
        let mut gone = vec![false; self.strands.len()];
        for (k, index) in indices.iter().enumerate() {
            if std::mem::replace(&mut gone[*index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", ids[k].bits()), "each strand once"));
            }
        }
        let is_gone = |id: StrandId| self.slots.index(id).is_some_and(|index| gone[index]);
        let gone_constraints: Vec<bool> =
            self.constraints.iter().map(|held| is_gone(held.def.strand) || held.other().is_some_and(is_gone)).collect();
        self.drop_constraints(&gone_constraints);
        for id in ids {
            self.slots.remove(*id);
        }
        let Some(first) = indices.iter().min() else { return Ok(()) };
        self.constrained_substep.forget();
        let mut index = 0;
        self.strands.retain(|_| {
            index += 1;
            !gone[index - 1]
        });
        for (index, strand) in self.strands.iter().enumerate().skip(*first) {
            self.slots.moved(strand.id, index);
        }
        // Half empty is too much; an eighth is kept in reserve.
        if self.strands.len() <= self.strands.capacity() / 2 {
            self.strands.shrink_to(self.strands.len() + self.strands.len() / 8);
        }
        Ok(())
    }

    /// Whether an identifier names a strand of this solver.
    pub fn has_strand(&self, id: StrandId) -> bool {
        self.slots.index(id).is_some()
    }

    /// Number of strands.
    pub fn strand_count(&self) -> usize {
        self.strands.len()
    }

    /// All identifiers, in the order in which the strands were added.
    pub fn strand_ids(&self) -> Vec<StrandId> {
        self.strands.iter().map(|strand| strand.id).collect()
    }
}
