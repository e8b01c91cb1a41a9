//! Which strands there are: adding, removing, listing.

use super::Solver;
use super::definition::StrandDef;
use super::id::{self, StrandId};
use super::strand::Strand;
use crate::error::{Error, Result};
use crate::rod::kinematics::Kinematics;

impl Solver {
    /// Adds strands, all or none; their identifiers come in the order of the definitions.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `strands[i].field`; [`Error::OutOfMemory`] when all identifiers are in use.
    pub fn add_strands(&mut self, strands: &[StrandDef]) -> Result<Vec<StrandId>> {
        for (index, def) in strands.iter().enumerate() {
            def.check(&format!("strands[{index}]"))?;
        }
        if self.strands.len() + strands.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: strands.len().saturating_mul(size_of::<Strand>()) });
        }
        self.strands.reserve(strands.len());
        let mut ids = Vec::with_capacity(strands.len());
        let mut kinematics = Kinematics::default();
        for def in strands {
            let Some(id) = self.slots.insert(self.strands.len()) else {
                // Only retired slots can bring us here; what was added is taken back.
                self.remove_strands(&ids)?;
                return Err(Error::OutOfMemory { bytes: size_of::<Strand>() });
            };
            let mut strand = Strand::new(id, def, &self.rules);
            strand.update_energies(self.options.gravity, &self.rules, &mut kinematics);
            self.strands.push(strand);
            ids.push(id);
        }
        Ok(ids)
    }

    /// Removes strands, all or none. The others keep their identifiers and their order.
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
        for id in ids {
            self.slots.remove(*id);
        }
        let mut index = 0;
        self.strands.retain(|_| {
            index += 1;
            !gone[index - 1]
        });
        for (index, strand) in self.strands.iter().enumerate() {
            self.slots.moved(strand.id, index);
        }
        Ok(())
    }

    /// Whether an identifier names a living strand of this solver.
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
