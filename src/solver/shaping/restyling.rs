//! Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.

use crate::error::{Error, Result};
use crate::groom::rest_shape::held_up;
use crate::groom::stability::Stability;
use crate::math::quadrature::{Rule, Rules};
use crate::rod::definition::{check_frozen, check_rows};
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::strands::strand::Strand;
use crate::step::equilibrium::{softest, weights};
use crate::step::state::rotation_matrix;

/// The quadrature of a strand's next step: a balance computed with it is exact to rounding there.
fn coming_rule<'a>(strand: &Strand, rules: &'a Rules) -> &'a Rule {
    let Strand { model, state, .. } = strand;
    rules.rule(rules.next_for_angle(state.rule, model.largest_angle(&state.curvatures)))
}

impl Solver {
    /// Makes current shapes the natural ones: without weight the strands would rest in them; with it they sag from here. Nothing
    /// moves at once, velocities stay, elastic energies become zero. Discards the earlier natural shapes that
    /// [`Solver::set_element_count`] keeps.
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

    /// Makes current shapes the rest shapes under the solver's gravity, with fixed roots: natural curvatures become qⁿ = q − K⁻¹
    /// f(q) (f: the weight), exactly for the solver's own quadrature. Velocities stay: moving strands keep moving about their new
    /// rest; [`Solver::set_shapes`] with [`Solver::shapes`] stops them. Wind, contacts and constraints do not count: a strand
    /// that leans on something is held up as if nothing were there. The rest need not be stable: see [`Solver::shape_stability`].
    /// Discards the earlier natural shapes that [`Solver::set_element_count`] keeps.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a strand that is too limp for finite curvatures to
    /// hold it up.
    pub fn take_rest_shapes(&mut self, ids: &[StrandId]) -> Result<()> {
        let mut made: Vec<_> = self.indices(ids)?.into_iter().map(|index| (index, Vec::new())).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.workers.for_each(&mut made, |(index, natural), scratch| {
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

    /// How firmly each strand would rest in its current shape under the solver's gravity, with its root fixed, once
    /// [`Solver::take_rest_shapes`] has made it a rest shape; and how much stiffer it would have to be. In the order of `ids`.
    /// Changes nothing. Costs the cube of the number of elements; never uses a host's task system, like [`Solver::settle`].
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn shape_stability(&self, ids: &[StrandId]) -> Result<Vec<Stability>> {
        let mut found: Vec<_> =
            self.indices(ids)?.into_iter().map(|index| (index, Stability { smallest_eigenvalue: f64::NAN })).collect();
        let (strands, rules, gravity) = (&self.strands, &*self.rules, self.options.gravity);
        self.workers.for_each_on_own(&mut found, |(index, stability), scratch| {
            let Strand { model, state, .. } = &strands[*index];
            let rule = coming_rule(&strands[*index], rules);
            let kinematics = &mut scratch.step.one.workspace.iterate.kinematics;
            kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
            stability.smallest_eigenvalue = softest(model, kinematics, &weights(model, &rule.weights, gravity)).0;
        });
        Ok(found.into_iter().map(|(_, stability)| stability).collect())
    }

    /// Current curvatures of many strands, rad/m: one row per element, strand after strand in the order of `ids`. The host may
    /// keep them as initial shapes for [`Solver::set_shapes`]; the solver itself keeps none.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`.
    pub fn shapes(&self, ids: &[StrandId]) -> Result<Vec<[f64; 3]>> {
        let indices = self.indices(ids)?;
        Ok(indices.into_iter().flat_map(|index| self.strands[index].state.curvatures.iter().copied()).collect())
    }

    /// Puts many strands into shapes, at rest relative to their roots; rows as returned by [`Solver::shapes`]. Clears
    /// quarantines.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a wrong number of rows, a number that is not finite,
    /// or a frozen freedom that is not at its natural value. Nothing has then changed.
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
