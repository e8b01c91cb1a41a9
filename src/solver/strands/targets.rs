//! Targets: curves, of a rig for example, to which strands are drawn with a weight along their length.

use super::strand::Strand;
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_not_negative};
use crate::math::vector::Vec3;
use crate::memory;
use crate::rod::kinematics::Kinematics;
use crate::rod::target::Target;
use crate::rod::target::definition::TargetDef;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::step::state::rotation_matrix;

impl Solver {
    /// Draws strands to curves. The curves are what the strands should be after the next `over_seconds` of simulated time: a strand's
    /// target moves there from where it is, smoothly like a root ([`Solver::set_root_frames`]); 0: within the next substep. The
    /// first target of a strand is there at once and stands still. Weights and the time constant hold from now on. Call it for
    /// every frame; a target that is not set again stays where it arrived.
    ///
    /// Where the weight is w, a point of the strand comes to its place with the time constant τ (1 − w)/w, without overshoot,
    /// against weight, stiffness and contact. At weight 1 it is there within a step, as well as a strand that keeps its length
    /// and its number of elements can be; at 0 it is free, to the bit. The pull is implicit: stable for every step and every
    /// weight. Roots are not moved: set their frames as ever. Frozen strands do not follow.
    ///
    /// Snapshots contain targets. A root that is teleported or jumps takes its target along, or to its end. [`Solver::settle`]
    /// does not feel targets, and [`Integrator::Reference`](crate::step::options::Integrator::Reference) refuses them.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `targets[i].field`, for counts that differ, or for a time that is negative or not finite;
    /// [`Error::InvalidId`]; [`Error::OutOfMemory`]. Nothing has then changed.
    pub fn set_targets(&mut self, ids: &[StrandId], targets: &[TargetDef], over_seconds: f64) -> Result<()> {
        check_not_negative(|| "over_seconds".into(), over_seconds)?;
        if targets.len() != ids.len() {
            let expected = format!("{} targets, one per strand", ids.len());
            return Err(crate::error::Error::invalid("targets (count)", targets.len(), expected));
        }
        let indices = self.indices(ids)?;
        let mut made = memory::list(ids.len())?;
        for (k, (index, def)) in indices.iter().zip(targets).enumerate() {
            let argument = format!("targets[{k}]");
            def.check(&argument)?;
            let strand = &self.strands[*index];
            let target = Target::new(def, strand.model.length(), strand.target.as_deref(), over_seconds);
            made.push(Box::new(target.map_err(|error| error.inside(&argument))?));
        }
        for (index, target) in indices.into_iter().zip(made) {
            self.strands[index].target = Some(target);
        }
        Ok(())
    }

    /// Lets strands go: nothing draws them any more. Strands without a target stay as they are.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn clear_targets(&mut self, ids: &[StrandId]) -> Result<()> {
        for index in self.indices(ids)? {
            self.strands[index].target = None;
        }
        Ok(())
    }

    /// How far strands are from their targets, m, in the order of `ids`: the root mean square over a strand's length, where
    /// each point counts by its weight. `None` for a strand without a target, or with one that draws no part of it.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn target_distances(&self, ids: &[StrandId]) -> Result<Vec<Option<f64>>> {
        let mut kinematics = Kinematics::default();
        Ok(self.indices(ids)?.into_iter().map(|index| self.target_distance(&self.strands[index], &mut kinematics)).collect())
    }

    fn target_distance(&self, strand: &Strand, kinematics: &mut Kinematics<f64>) -> Option<f64> {
        let Strand { model, state, target: Some(target), .. } = strand else { return None };
        let rule = self.rules.rule(state.rule);
        kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
        let origin = Vec3::from(state.root.origin);
        let (mut squares, mut weights) = (0.0, 0.0);
        target.for_each_point(0.0, &model.lengths, &rule.nodes, |p, pull| {
            let weight = pull.weight * rule.weights[p % rule.len()] * model.lengths[p / rule.len()];
            squares += weight * (origin + kinematics.points[p].position - pull.position).norm_squared();
            weights += weight;
        });
        (weights > 0.0).then(|| (squares / weights).sqrt())
    }
}
