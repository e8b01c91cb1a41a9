//! Materials of simulated strands: read, change, and stiffen as a shape requires.

use crate::error::{Error, Result};
pub use crate::groom::stability::Stiffening;
use crate::rod::kinematics::Kinematics;
use crate::rod::material::Material;
use crate::rod::strand::StrandModel;
use crate::solver::Solver;
use crate::solver::id::StrandId;

impl Solver {
    /// A strand's section and material.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn material(&self, id: StrandId) -> Result<&Material> {
        Ok(&self.strand("id", id)?.model.material)
    }

    /// Changes sections and materials of strands, one for each or one for all: from then on they behave as if created with them.
    /// Shapes, natural shapes, velocities and freedoms stay, and so do the radii of contact ([`Solver::set_contact`]); energies
    /// are those of the new material. A strand at rest is then no longer at rest: [`Solver::take_rest_shapes`] makes its shape a
    /// rest shape again.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `materials[i].field`, or for a count that is
    /// neither 1 nor that of the strands. Nothing has then changed.
    pub fn set_materials(&mut self, ids: &[StrandId], materials: &[Material]) -> Result<()> {
        if materials.len() != ids.len() && materials.len() != 1 {
            let expected = format!("{}, one per strand, or 1 for all", ids.len());
            return Err(Error::invalid("materials (count)", materials.len(), expected));
        }
        for (k, material) in materials.iter().enumerate() {
            // Named only on failure: a name for each would cost more than the checks.
            material.check("materials").or_else(|_| material.check(&format!("materials[{k}]")))?;
        }
        let indices = self.indices(ids)?;
        let (gravity, mut kinematics) = (self.options.gravity, Kinematics::default());
        for (k, index) in indices.into_iter().enumerate() {
            let material = &materials[if materials.len() == 1 { 0 } else { k }];
            let strand = &mut self.strands[index];
            let section = self.sections.of(material, strand.model.freedoms);
            strand.model = StrandModel::of_section(strand.model.lengths.to_vec(), strand.model.natural.to_vec(), section);
            strand.update_energies(gravity, &self.rules, &mut kinematics);
        }
        Ok(())
    }

    /// Stiffens strands that would not rest stably in their current shapes, by as little as possible, and makes the shapes rest
    /// shapes ([`Solver::take_rest_shapes`], of all named strands). Afterwards the smallest eigenvalue of the static Hessian
    /// against the elastic stiffness is at least `margin` (0 to less than 1; 0 is exactly at the limit). Returns the factors, 1
    /// or above, in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a margin out of range, an identifier given twice, or
    /// a strand for which no finite stiffness is enough. Nothing has then changed.
    pub fn stiffen(&mut self, ids: &[StrandId], by: Stiffening, margin: f64) -> Result<Vec<f64>> {
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let scales = self.shape_stability(ids)?.iter().map(|found| by.scale(found, margin)).collect::<Result<Vec<f64>>>()?;
        let stiffer = |(index, scale): (&usize, &f64)| by.applied(&self.strands[*index].model.material, *scale);
        let materials: Vec<Material> = indices.iter().zip(&scales).map(stiffer).collect();
        for (k, material) in materials.iter().enumerate() {
            if material.check("material").is_err() {
                let expected = "one that a finite stiffness holds up";
                return Err(Error::invalid(format!("ids[{k}]"), "a strand whose weight is too much for its stiffness", expected));
            }
        }
        let before: Vec<Material> = indices.iter().map(|index| self.strands[*index].model.material).collect();
        if !ids.is_empty() {
            self.set_materials(ids, &materials)?;
            if let Err(error) = self.take_rest_shapes(ids) {
                self.set_materials(ids, &before)?;
                return Err(error);
            }
        }
        Ok(scales)
    }
}
