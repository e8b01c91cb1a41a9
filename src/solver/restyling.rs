//! Shapes taken as they are at any moment of a run: as natural shapes, as rest shapes under gravity, as shapes to come back to.

use super::Solver;
use super::id::StrandId;
use super::strand::Strand;
use crate::error::{Error, Result};
use crate::groom::rest_shape::held_up;
use crate::groom::stability::Stability;
use crate::math::quadrature::{Rule, Rules};
use crate::rod::definition::{check_frozen, check_rows};
use crate::step::equilibrium::{softest, weights};
use crate::step::state::rotation_matrix;

/// The quadrature of a strand's coming step: a balance found with it is exact to rounding there.
fn coming_rule<'a>(strand: &Strand, rules: &'a Rules) -> &'a Rule {
    let Strand { model, state, .. } = strand;
    rules.rule(rules.next_for_angle(state.rule, model.largest_angle(&state.curvatures)))
}

impl Solver {
    /// Makes present shapes the natural ones: without weight the strands would rest in them; with it they sag from here. Nothing moves
    /// at once, velocities stay, elastic energies are zero. What [`Solver::set_element_count`] remembers of the natural shapes before is
    /// forgotten.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn take_natural_shapes(&mut self, ids: &[StrandId]) -> Result<()> {
        for index in self.indices(ids)? {
            let strand = &mut self.strands[index];
            strand.model.natural.copy_from_slice(&strand.state.curvatures);
            strand.authored = None;
            strand.energies.elastic = 0.0;
        }
        Ok(())
    }

    /// Makes present shapes those in which the strands rest under the solver's gravity, with their roots held where they are: natural curvatures
    /// become qⁿ = q − K⁻¹ f(q) (f: the weight), exactly for the solver's own quadrature. Velocities stay: what moves goes on to move, about
    /// its new rest; [`Solver::set_shapes`] with [`Solver::shapes`] stops it. Wind, touches and constraints are not counted: a strand that
    /// leans on something is held up as if nothing were there. The rest need not be stable: [`Solver::shape_stability`] tells. What
    /// [`Solver::set_element_count`] remembers of the natural shapes before is forgotten.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a strand that is too limp for finite curvatures to hold it.
    pub fn take_rest_shapes(&mut self, ids: &[StrandId]) -> Result<()> {
        let mut made: Vec<_> = self.indices(ids)?.into_iter().map(|index| (index, Vec::new())).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.crew.for_each(&mut made, |(index, natural), scratch| {
            let Strand { model, state, .. } = &strands[*index];
            let rule = coming_rule(&strands[*index], rules);
            let kinematics = &mut scratch.step.one.workspace.iterate.kinematics;
            *natural = held_up(model, &state.root, &state.curvatures, gravity, rule, kinematics);
        });
        if let Some(k) = made.iter().position(|(_, natural)| !natural.iter().flatten().all(|x| x.is_finite())) {
            let expected = "one that finite natural curvatures hold up";
            return Err(Error::invalid(format!("ids[{k}]"), "a strand whose weight is too much for its stiffness", expected));
        }
        for (index, natural) in made {
            let strand = &mut self.strands[index];
            strand.model.natural.copy_from_slice(&natural);
            strand.authored = None;
            strand.energies.elastic = strand.model.elastic_energy(&strand.state.curvatures);
        }
        Ok(())
    }

    /// How firmly each strand would rest in its present shape under the solver's gravity, its root held where it is, once
    /// [`Solver::take_rest_shapes`] has made it a rest shape; and by how much it would have to be stiffer. In the order of `ids`. Changes
    /// nothing. Costs the cube of the number of elements; a host's task system is not used, as in [`Solver::settle`].
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn shape_stability(&self, ids: &[StrandId]) -> Result<Vec<Stability>> {
        let mut found: Vec<_> =
            self.indices(ids)?.into_iter().map(|index| (index, Stability { smallest_eigenvalue: f64::NAN })).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.crew.for_each_on_own(&mut found, |(index, stability), scratch| {
            let Strand { model, state, .. } = &strands[*index];
            let rule = coming_rule(&strands[*index], rules);
            let kinematics = &mut scratch.step.one.workspace.iterate.kinematics;
            kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
            stability.smallest_eigenvalue = softest(model, kinematics, &weights(model, &rule.weights, gravity)).0;
        });
        Ok(found.into_iter().map(|(_, stability)| stability).collect())
    }

    /// Present curvatures of many strands, rad/m: a row an element, strand after strand in the order of `ids`. Kept by the host they are
    /// initial shapes for [`Solver::set_shapes`]; the solver itself remembers none.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn shapes(&self, ids: &[StrandId]) -> Result<Vec<[f64; 3]>> {
        let indices = self.indices(ids)?;
        Ok(indices.into_iter().flat_map(|index| self.strands[index].state.curvatures.iter().copied()).collect())
    }

    /// Puts many strands into shapes, at rest relative to their roots; rows as [`Solver::shapes`] gives them. Clears quarantines.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a number of rows that is not that of all elements, a number that
    /// is not finite, or a frozen freedom that is not at its natural value. Then nothing has changed.
    pub fn set_shapes(&mut self, ids: &[StrandId], rows: &[[f64; 3]]) -> Result<()> {
        let indices = self.indices(ids)?;
        let mut end = 0;
        let places: Vec<_> = indices
            .iter()
            .map(|index| {
                let start = end;
                end += self.strands[*index].model.element_count();
                (*index, start..end)
            })
            .collect();
        check_rows("curvatures", rows, end)?;
        for (k, (index, place)) in places.iter().enumerate() {
            let model = &self.strands[*index].model;
            check_frozen(format_args!("curvatures of ids[{k}]"), &rows[place.clone()], &model.natural, model.freedoms)?;
        }
        for (index, place) in places {
            self.put(index, rows[place].to_vec(), None);
        }
        Ok(())
    }
}
