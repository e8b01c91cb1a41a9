//! Changes the number of elements of simulated strands.

use super::strand::{Authored, Strand};
use crate::error::{Error, Result, check_positive};
use crate::math::quadrature::Rules;
use crate::rod::definition::MAX_ELEMENTS;
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::step::regrid::{self, Regrid};
use crate::step::state::StrandState;

/// Relative tolerance of the sum of given element lengths against a strand's length.
const LENGTH_TOLERANCE: f64 = 1e-9;

impl Solver {
    /// Changes strands to `element_count` elements each (1 to [`MAX_ELEMENTS`]) in their current state: shape, velocities and
    /// energies are preserved as well as that many elements can. A multiple of a strand's current number splits every element
    /// equally and is exact; a divisor joins neighbours; anything else keeps the grading of their lengths. Returns how close each
    /// strand is, in the order of `ids`.
    ///
    /// The strand's original natural shape (or the last one set) is kept: on any number of elements the natural curvatures are
    /// its means, so nothing is lost by going back and forth, and borders follow its grading. Where detail returns the strain is
    /// preserved, and the curve moves by the detail ([`Regrid::exact`] is then false). Moving roots continue. The cost is that of
    /// a few steps. No time passes.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] for a count out of range.
    pub fn set_element_count(&mut self, ids: &[StrandId], element_count: usize) -> Result<Vec<Regrid>> {
        if element_count == 0 || element_count > MAX_ELEMENTS {
            return Err(Error::invalid("element_count", element_count, format!("1 to {MAX_ELEMENTS}")));
        }
        let indices = self.indices(ids)?;
        Ok(self.regrid(&indices, |strand| {
            let authored = strand.authored.as_deref().map_or(&strand.model.lengths, |authored| &authored.lengths);
            regrid::graded(authored, element_count)
        }))
    }

    /// The same for one strand with elements of given lengths from root to tip, m; they must sum to the strand's length (within
    /// 1e-9).
    ///
    /// # Errors
    /// [`Error::InvalidId`]; [`Error::InvalidArgument`] for lengths that are not above zero, too many, none, or of another sum.
    pub fn set_element_lengths(&mut self, id: StrandId, lengths: &[f64]) -> Result<Regrid> {
        let index = self.index("id", id)?;
        if lengths.is_empty() || lengths.len() > MAX_ELEMENTS {
            return Err(Error::invalid("lengths (count)", lengths.len(), format!("1 to {MAX_ELEMENTS}")));
        }
        for (element, length) in lengths.iter().enumerate() {
            check_positive(|| format!("lengths[{element}]"), *length)?;
        }
        let (sum, length) = (lengths.iter().sum::<f64>(), self.strands[index].model.length());
        if (sum - length).abs() > LENGTH_TOLERANCE * length {
            return Err(Error::invalid("lengths (sum)", sum, format!("the strand's length, {length} m")));
        }
        Ok(self.regrid(&[index], |_| lengths.to_vec())[0])
    }

    fn regrid(&mut self, indices: &[usize], lengths: impl Fn(&Strand) -> Vec<f64> + Sync) -> Vec<Regrid> {
        let mut made: Vec<(usize, Option<Made>)> = indices.iter().map(|index| (*index, None)).collect();
        let (strands, rules) = (&self.strands, &*self.rules);
        self.workers.for_each(&mut made, |(index, made), _| {
            let strand = &strands[*index];
            *made = Some(on_elements(strand, lengths(strand), rules));
        });
        self.constrained_substep.forget_pairs();
        let (gravity, mut kinematics) = (self.options.gravity, Kinematics::default());
        let mut reports = Vec::with_capacity(made.len());
        for (index, made) in made {
            let Some(made) = made else { continue };
            let strand = &mut self.strands[index];
            if let Some((model, state)) = made.changed {
                let old = std::mem::replace(&mut strand.model, model);
                strand.state = state;
                strand.shrink();
                if strand.authored.is_none() {
                    strand.authored = Some(Box::new(Authored { lengths: old.lengths, natural: old.natural }));
                }
                let authored = strand.authored.as_deref();
                if authored.is_some_and(|authored| authored.lengths == strand.model.lengths) {
                    strand.authored = None;
                }
                strand.update_energies(gravity, &self.rules, &mut kinematics);
            }
            reports.push(made.report);
        }
        reports
    }
}

/// A strand on other elements; `None` if they are the same.
struct Made {
    changed: Option<(StrandModel, StrandState)>,
    report: Regrid,
}

fn on_elements(strand: &Strand, lengths: Vec<f64>, rules: &Rules) -> Made {
    let model = &strand.model;
    if *lengths == *model.lengths {
        return Made { changed: None, report: Regrid { exact: true, ..Regrid::default() } };
    }
    let (from, natural) = match strand.authored.as_deref() {
        Some(authored) => (&authored.lengths, &authored.natural),
        None => (&model.lengths, &model.natural),
    };
    let natural = regrid::means(&regrid::borders(from), natural, &regrid::borders(&lengths));
    let new = StrandModel::of_section(lengths, natural, model.section().clone());
    let (state, report) = regrid::take(model, &strand.state, &new, rules);
    Made { changed: Some((new, state)), report }
}
