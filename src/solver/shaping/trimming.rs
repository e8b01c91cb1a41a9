//! Cuts simulated strands and lets them grow.

use crate::error::{Error, Result};
use crate::groom::pose::{Growth, check_cut, cut_lengths};
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::segment;
use crate::rod::strand::StrandModel;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::strands::strand::{Authored, Strand};
use crate::step::regrid;
use crate::step::state::{Earlier, History, StrandState, rotation_matrix};

/// A strand with a new length.
struct Trimmed {
    index: usize,
    model: StrandModel,
    state: StrandState,
    authored: Option<Box<Authored>>,
}

impl Solver {
    /// Cuts strands at arclengths from the root (m, one each), at any time in a run: the rest keeps its shape, its natural shape
    /// and its velocities exactly, history included, and loses the mass of the removed part. The cut element becomes shorter,
    /// with the same helix. A strand that is cut at its length stays as it is.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `arclengths[i]` if it is not above zero and at
    /// most the strand's length, or if a constraint holds a point beyond it; for an identifier given twice; for counts that
    /// differ. Nothing has then changed.
    pub fn cut(&mut self, ids: &[StrandId], arclengths: &[f64]) -> Result<()> {
        if arclengths.len() != ids.len() {
            return Err(Error::invalid("arclengths (count)", arclengths.len(), format!("{}, one per strand", ids.len())));
        }
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let mut made = Vec::with_capacity(indices.len());
        for (k, (index, arclength)) in indices.into_iter().zip(arclengths).enumerate() {
            let name = format!("arclengths[{k}]");
            let strand = &self.strands[index];
            check_cut(&name, *arclength, strand.model.length(), format_args!("ids[{k}], 0x{:016x}", strand.id.bits()))?;
            let lengths = cut_lengths(&strand.model.lengths, *arclength);
            if *lengths == *strand.model.lengths {
                continue;
            }
            self.check_held(&name, index, lengths.iter().sum())?;
            made.push(cut(strand, index, lengths, *arclength, &self.rules));
        }
        self.take_up(made);
        Ok(())
    }

    /// Lets strands grow at their tips, all by the same length, at any time in a run: the existing part keeps shape and
    /// velocities, and the new part moves rigidly with the tip. Without a new element the last one becomes longer, and its
    /// velocities become the nearest polynomial. The natural shape grows in the same way. A natural shape kept by
    /// [`Solver::set_element_count`] grows by elements as well.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a field of `growth`, or an identifier given twice.
    /// Nothing has then changed.
    pub fn grow(&mut self, ids: &[StrandId], growth: &Growth) -> Result<()> {
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        growth.check("growth", 1)?;
        for index in &indices {
            growth.check("growth", self.strands[*index].model.element_count())?;
        }
        let made = indices.into_iter().map(|index| grown(&self.strands[index], index, growth, &self.rules)).collect();
        self.take_up(made);
        Ok(())
    }

    fn take_up(&mut self, made: Vec<Trimmed>) {
        if made.is_empty() {
            return;
        }
        // The warm start's contacts are at arclengths that may be gone.
        self.constrained_substep.forget();
        let mut kinematics = Kinematics::default();
        for Trimmed { index, model, state, authored } in made {
            let strand = &mut self.strands[index];
            if model.length() > strand.model.length() {
                strand.frozen = None;
            }
            (strand.model, strand.state, strand.authored) = (model, state, authored);
            strand.shrink();
            strand.update_energies(self.options.gravity, &self.rules, &mut kinematics);
        }
    }

    /// Checks that no constraint holds a point of a strand beyond a length.
    pub(super) fn check_held(&self, argument: &str, index: usize, length: f64) -> Result<()> {
        let id = self.strands[index].id;
        for constraint in &self.constraints {
            let at = |strand: StrandId, arclength: f64| (strand == id).then_some(arclength);
            let ends = [at(constraint.def.strand, constraint.state.arclength), constraint.tied(id)];
            if let Some(held) = ends.into_iter().flatten().find(|held| *held > length * (1.0 + 1e-9)) {
                let bits = id.bits();
                let what =
                    format!("a change to the length {length} m of strand 0x{bits:016x}, which a constraint holds at {held} m");
                return Err(Error::invalid(
                    argument,
                    what,
                    "a strand that no constraint holds beyond it: remove the constraint first",
                ));
            }
        }
        Ok(())
    }
}

/// Whether nothing of a strand moves or has moved: its state is then that of a new strand.
fn is_still(state: &StrandState) -> bool {
    let zero = |vector: nalgebra::Vector3<f64>| vector == nalgebra::Vector3::zeros();
    state.history.step == 0.0
        && state.rates.iter().flatten().chain(state.velocities.iter().flat_map(|v| &v.0)).all(|x| *x == 0.0)
        && zero(state.root_velocity)
        && zero(state.root_angular_velocity)
}

/// Natural rows on the remaining elements.
fn truncated(authored: Option<&Authored>, arclength: f64) -> Option<Box<Authored>> {
    authored.map(|authored| {
        let lengths = cut_lengths(&authored.lengths, arclength);
        let natural = authored.natural[..lengths.len()].to_vec();
        Box::new(Authored { lengths: lengths.into(), natural: natural.into() })
    })
}

fn cut(strand: &Strand, index: usize, lengths: Vec<f64>, arclength: f64, rules: &Rules) -> Trimmed {
    let Strand { model, state, .. } = strand;
    let last = lengths.len() - 1;
    let fraction = lengths[last] / model.lengths[last];
    let rows = |rows: &[[f64; 3]]| rows[..=last].to_vec();
    let rule = rules.rule(state.rule);
    // A polynomial on the element is one on its part.
    let mut coefficients = Vec::new();
    let mut velocities = |list: &[Vec3<f64>]| {
        let mut out = list[..(last + 1) * rule.len()].to_vec();
        if fraction < 1.0 {
            let own = &list[last * rule.len()..(last + 1) * rule.len()];
            for (node, place) in rule.nodes.iter().enumerate() {
                rule.interpolation(place * fraction, &mut coefficients);
                let terms = coefficients.iter().zip(own);
                out[last * rule.len() + node] = terms.fold(Vec3::zero(), |sum, (c, v)| sum + v.scale(*c));
            }
        }
        out
    };
    let mut new = StrandState {
        curvatures: rows(&state.curvatures),
        rates: rows(&state.rates),
        velocities: velocities(&state.velocities),
        history: History::default(),
        ..state.clone()
    };
    if state.history.step > 0.0 {
        let history = &state.history;
        let earlier =
            Earlier { curvatures: rows(&history.curvatures), velocities: velocities(&history.velocities), root: history.root };
        new.history = History::new(history.step, earlier);
    }
    let model = StrandModel::of_section(lengths, rows(&model.natural), model.section().clone());
    if is_still(&new) {
        new.velocities_from_rates(&model, rules);
    }
    Trimmed { index, model, state: new, authored: truncated(strand.authored.as_deref(), arclength) }
}

fn grown(strand: &Strand, index: usize, growth: &Growth, rules: &Rules) -> Trimmed {
    let Strand { model, state, authored, .. } = strand;
    // First as elements of their own.
    let whole = Growth { elements: growth.elements.max(1), ..*growth };
    let more = whole.elements;
    let longer = StrandModel::of_section(whole.lengths(&model.lengths), whole.rows(&model.natural), model.section().clone());
    let mut rates = state.rates.clone();
    rates.resize(rates.len() + more, [0.0; 3]);
    let mut new = StrandState {
        curvatures: whole.rows(&state.curvatures),
        rates,
        velocities: state.velocities.clone(),
        history: History::default(),
        ..state.clone()
    };
    if is_still(state) {
        new.velocities_from_rates(&longer, rules);
    } else {
        follow_tip(&longer, &mut new, model.element_count(), rules);
    }
    let authored = authored.as_deref().map(|authored| {
        Box::new(Authored { lengths: whole.lengths(&authored.lengths).into(), natural: whole.rows(&authored.natural).into() })
    });
    if growth.elements > 0 {
        return Trimmed { index, model: longer, state: new, authored };
    }
    let joined = StrandModel::of_section(growth.lengths(&model.lengths), model.natural.to_vec(), model.section().clone());
    let (mut state, _) = regrid::take(&longer, &new, &joined, rules);
    // The same helix continues: the fit's result is not needed.
    state.curvatures = strand.state.curvatures.clone();
    if is_still(&state) {
        state.velocities_from_rates(&joined, rules);
    }
    Trimmed { index, model: joined, state, authored }
}

/// Velocities of the elements from `first` on: rigid with the end of the one before.
fn follow_tip(model: &StrandModel, state: &mut StrandState, first: usize, rules: &Rules) {
    let rule = rules.rule(state.rule);
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
    let mut spin = Vec3::from(state.root_angular_velocity);
    for (element, rate) in kinematics.elements[..first].iter().zip(&state.rates) {
        let theta = element.kappa.scale(element.length);
        let turn = segment::mean_frame(theta, element.kappa_squared * element.length * element.length, &element.c);
        spin += element.frame_left.apply(turn.apply(Vec3(*rate))).scale(element.length);
    }
    let mut coefficients = Vec::new();
    rule.interpolation(1.0, &mut coefficients);
    let own = &state.velocities[(first - 1) * rule.len()..first * rule.len()];
    let at_tip = coefficients.iter().zip(own).fold(Vec3::zero(), |sum, (c, v)| sum + v.scale(*c));
    let tip = kinematics.elements[first - 1].origin_right();
    for point in &kinematics.points[first * rule.len()..] {
        state.velocities.push(at_tip + spin.cross(point.position - tip));
    }
}
