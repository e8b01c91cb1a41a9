//! One strand of a solver: constants, state, the root's motion, and the result of the last step.

use std::sync::Arc;

use nalgebra::Vector3;

use super::sections;
use crate::contact::body_at::BodyAt;
use crate::contact::options::StrandContact;
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::contact::shape::Bounds;
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::PoseMove;
use crate::memory::BLOCK;
use crate::rod::kinematics::Kinematics;
use crate::rod::section::Section;
use crate::rod::strand::StrandModel;
use crate::rod::target::{Target, TargetAt};
use crate::solver::definition::StrandDef;
use crate::solver::id::StrandId;
use crate::solver::report::{Energies, StrandStatus};
use crate::solver::shaping::freezing::Frozen;
use crate::solver::stepping::divergence::Divergence;
use crate::step::options::Integrator;
use crate::step::pack::members::One;
use crate::step::scratch::StepScratch;
use crate::step::state::{Earlier, StrandState, rotation_matrix};
use crate::step::{Setting, StrandOutcome};

/// A strand and the solver's data about it.
#[derive(Debug, Clone)]
#[repr(C)] // In this order: sampling reads only the first cache lines.
pub(in crate::solver) struct Strand {
    pub model: StrandModel,
    pub state: StrandState,
    pub id: StrandId,
    pub user_data: u64,
    /// The original natural shape, if `model` has other elements.
    pub authored: Option<Box<Authored>>,
    /// The root's current move, and its elapsed seconds. Separate, because every step needs most of a strand's other numbers, and
    /// this only while the root moves.
    pub root_move: Option<Box<(PoseMove, f64)>>,
    pub energies: Energies,
    /// The last substep.
    pub last: SubstepResult,
    /// Whether contacts or constraints may act on it in this substep.
    pub constrained: Constrained,
    /// Whether it was near something in the last substep.
    pub touched: bool,
    /// Its contact parameters; `None` for no contact.
    pub contact: Option<Box<StrandContact>>,
    /// Its permitted overlap; `None` for none.
    pub permitted_overlap: Option<Arc<PermittedOverlap>>,
    /// Its record where it has diverged.
    pub divergence: Option<Box<Divergence>>,
    /// Set for a frozen strand.
    pub frozen: Option<Box<Frozen>>,
    /// What it is drawn to; `None` for nothing.
    pub target: Option<Box<Target>>,
}

/// Whether something constrains a strand in a substep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::solver) enum Constrained {
    /// Nothing does: it steps side by side with others.
    No,
    /// Nothing but bodies at its points, so that it steps side by side with others.
    AtPoints,
    /// Only a body near by may.
    Perhaps,
    /// The same, and it tries a step side by side with others.
    OnTrial,
    /// Something does, or may for more reasons than that.
    Yes,
}

/// What a strand keeps of a substep's result; the rest goes into the call's [`Tally`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::solver) struct SubstepResult {
    pub iterations: u32,
    pub converged: bool,
    pub quarantined: bool,
}

impl From<&StrandOutcome> for SubstepResult {
    fn from(outcome: &StrandOutcome) -> Self {
        Self { iterations: outcome.iterations, converged: outcome.converged, quarantined: outcome.quarantined }
    }
}

impl Default for SubstepResult {
    /// Nothing was done, and it converged.
    fn default() -> Self {
        Self { iterations: 0, converged: true, quarantined: false }
    }
}

/// A natural shape on its original elements.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::solver) struct Authored {
    pub lengths: Box<[f64]>,
    pub natural: Box<[[f64; 3]]>,
}

/// The results of the strands' substeps of one call. Sums of whole numbers and largest values: independent of the strands' order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::solver) struct Tally {
    pub iterations: u64,
    pub max_iterations: u32,
    pub unconverged: u32,
    pub quarantined: u32,
    pub residual: f64,
    pub condition: f64,
    pub subdivided: u32,
    pub error: f64,
    /// The unconverged ones that ended early, by the substep's budget.
    pub left: u32,
}

impl Tally {
    /// Counts one substep.
    pub fn add(&mut self, outcome: &StrandOutcome) {
        self.iterations += u64::from(outcome.iterations);
        self.max_iterations = self.max_iterations.max(outcome.iterations);
        self.quarantined += u32::from(outcome.quarantined);
        self.unconverged += u32::from(!outcome.converged && !outcome.quarantined);
        self.residual = self.residual.max(outcome.residual);
        self.condition = self.condition.max(outcome.condition);
        self.subdivided += u32::from(outcome.substeps > 1);
        self.error = self.error.max(outcome.error);
        self.left += u32::from(outcome.left);
    }

    /// Counts other strands' substeps.
    pub fn merge(&mut self, other: &Self) {
        self.iterations += other.iterations;
        self.max_iterations = self.max_iterations.max(other.max_iterations);
        self.quarantined += other.quarantined;
        self.unconverged += other.unconverged;
        self.residual = self.residual.max(other.residual);
        self.condition = self.condition.max(other.condition);
        self.subdivided += other.subdivided;
        self.error = self.error.max(other.error);
        self.left += other.left;
    }
}

/// What draws a strand with this target in the next substep.
pub(in crate::solver) fn drawn_by(target: &Option<Box<Target>>) -> Option<TargetAt<'_>> {
    target.as_deref().filter(|target| target.acts()).map(|target| TargetAt { target, from: 0.0 })
}

/// The root's pose after `elapsed` seconds of its move, or at rest.
pub(in crate::solver) fn root_after(root_move: &Option<Box<(PoseMove, f64)>>, rest: &Frame, elapsed: f64) -> Frame {
    match root_move.as_deref() {
        Some((root_move, done)) => {
            let time = done + elapsed;
            // A step meant to end with the move may miss its end by rounding.
            if time >= root_move.duration * (1.0 - 1e-12) { root_move.to } else { root_move.at(time) }
        }
        None => *rest,
    }
}

impl Strand {
    /// A strand from a checked definition.
    pub fn new(id: StrandId, def: &StrandDef, section: Arc<Section>, rules: &Rules) -> Self {
        let model = StrandModel::of_section(def.element_lengths.clone(), def.natural.clone(), section);
        let count = model.element_count();
        let curvatures = def.initial.clone().unwrap_or_else(|| def.natural.clone());
        let rates = def.initial_rates.clone().unwrap_or_else(|| vec![[0.0; 3]; count]);
        let state = StrandState::new(&model, rules, curvatures, rates, def.root, def.root_velocity, def.root_angular_velocity);
        Self {
            id,
            user_data: def.user_data,
            model,
            authored: None,
            state,
            root_move: None,
            energies: Energies::default(),
            last: SubstepResult::default(),
            constrained: Constrained::No,
            touched: false,
            contact: None,
            permitted_overlap: None,
            divergence: None,
            frozen: None,
            target: None,
        }
    }

    /// The root's poses at the start and the end of the next `h` seconds.
    pub fn root_during(&self, h: f64) -> [Frame; 2] {
        [self.state.root, root_after(&self.root_move, &self.state.root, h)]
    }

    /// A box around everything that its surface may reach while the root moves from pose to pose.
    pub fn reach(&self, contact: &StrandContact, root: &[Frame; 2]) -> Bounds {
        let reach = Vector3::repeat(self.model.length() + contact.radius);
        Bounds::around(root[0].origin, reach).union(&Bounds::around(root[1].origin, reach))
    }

    /// Whether it steps through this substep as a constrained strand.
    pub fn is_constrained(&self) -> bool {
        matches!(self.constrained, Constrained::Perhaps | Constrained::Yes)
    }

    pub fn status(&self) -> StrandStatus {
        if self.last.quarantined {
            StrandStatus::Quarantined
        } else if !self.last.converged {
            StrandStatus::Unconverged
        } else {
            StrandStatus::Ok
        }
    }

    /// Sends the root to `frame` in `duration` seconds, starting with its current velocity.
    pub fn move_root(&mut self, frame: Frame, duration: f64) {
        let to_local = self.state.root.rotation.inverse();
        let root_move = PoseMove {
            from: self.state.root,
            to: frame,
            velocity: self.instant_velocity(),
            angular_velocity: to_local * self.instant_angular_velocity(),
            duration,
        };
        // A root that moves every frame keeps its allocation.
        match &mut self.root_move {
            Some(place) => **place = (root_move, 0.0),
            None => self.root_move = Some(Box::new((root_move, 0.0))),
        }
    }

    /// Stops the root where it is.
    pub fn stop_root(&mut self) {
        self.root_move = None;
        self.state.root_velocity = Vector3::zeros();
        self.state.root_angular_velocity = Vector3::zeros();
    }

    /// The root's velocity at the end of the last move: that of the move's end if it finished.
    pub(in crate::solver) fn instant_velocity(&self) -> Vector3<f64> {
        match self.root_move.as_deref() {
            Some((root_move, elapsed)) if root_move.duration > 0.0 && *elapsed >= root_move.duration => {
                root_move.final_velocity()
            }
            _ => self.state.root_velocity,
        }
    }

    pub(in crate::solver) fn instant_angular_velocity(&self) -> Vector3<f64> {
        match self.root_move.as_deref() {
            Some((root_move, elapsed)) if root_move.duration > 0.0 && *elapsed >= root_move.duration => {
                self.state.root.rotation * root_move.final_angular_velocity()
            }
            _ => self.state.root_angular_velocity,
        }
    }

    /// Moves of root and target of duration 0 take the next substep of `h` seconds.
    pub fn begin_moves(&mut self, h: f64) {
        if let Some(target) = &mut self.target {
            target.begin(h);
        }
        if let Some((root_move, _)) = self.root_move.as_deref_mut()
            && root_move.duration == 0.0
        {
            root_move.duration = h;
        }
    }

    /// Advances the moves of root and target by `h` seconds; a move that ended a step ago is deleted, and the root rests.
    pub fn advance_moves(&mut self, h: f64) {
        if let Some(target) = &mut self.target {
            target.advance(h);
        }
        if let Some((root_move, elapsed)) = self.root_move.as_deref_mut() {
            if *elapsed >= root_move.duration {
                self.root_move = None;
            } else {
                *elapsed += h;
                if *elapsed >= root_move.duration * (1.0 - 1e-12) {
                    *elapsed = root_move.duration;
                }
            }
        }
    }

    /// Applies `work` to the strand as a single one, with its moving root.
    pub fn with_one<R>(&mut self, work: impl FnOnce(&mut One) -> R) -> R {
        let Self { model, state, root_move, target, .. } = self;
        let start = state.root;
        let root_at = |elapsed: f64| root_after(root_move, &start, elapsed);
        work(&mut One { model, state, root_at: &root_at, target: drawn_by(target), touches: None })
    }

    /// Records the result of a substep of `h` seconds with these `bodies`.
    pub fn ended(&mut self, outcome: StrandOutcome, setting: &Setting, h: f64, bodies: &[BodyAt], scratch: &mut StepScratch) {
        self.last = (&outcome).into();
        if outcome.quarantined {
            self.roll_back(h, bodies);
        } else if self.divergence.is_some() {
            self.clear_divergence();
        }
        self.advance_moves(h);
        if outcome.quarantined || setting.options.integrator == Integrator::Reference {
            let kinematics = &mut scratch.one.workspace.iterate.kinematics;
            self.update_energies(setting.surroundings.gravity.into(), setting.rules, kinematics);
        } else {
            self.energies = outcome.energies;
        }
    }

    /// Computes the energies from the state; `kinematics` is scratch memory.
    pub fn update_energies(&mut self, gravity: Vector3<f64>, rules: &Rules, kinematics: &mut Kinematics<f64>) {
        let rule = rules.rule(self.state.rule);
        kinematics.update(&rotation_matrix(&self.state.root), &self.model.lengths, &self.state.curvatures, rule);
        let mut energies = Energies { elastic: self.model.elastic_energy(&self.state.curvatures), ..Energies::default() };
        for (p, point) in kinematics.points.iter().enumerate() {
            let mass = self.model.linear_density * rule.weights[p % rule.len()] * self.model.lengths[p / rule.len()];
            energies.kinetic += 0.5 * mass * self.state.velocities[p].norm_squared();
            energies.gravity -= mass * gravity.dot(&(self.state.root.origin + Vector3::from(point.position)));
        }
        self.energies = energies;
    }

    /// An upper bound on the bytes of a strand of a definition: its lists, with the allocator's overhead, and the history once it
    /// has one.
    pub fn bytes_of(def: &StrandDef, rules: &Rules) -> usize {
        let elements = def.element_lengths.len();
        let shape = def.initial.as_ref().unwrap_or(&def.natural);
        let turn = |(row, length): (&[f64; 3], &f64)| Vector3::from(*row).norm() * length;
        let angle = shape.iter().zip(&def.element_lengths).map(turn).fold(0.0, f64::max);
        let points = elements.saturating_mul(rules.rule(rules.next_for_angle(0, angle)).len());
        let row = size_of::<[f64; 3]>();
        let rows = elements.saturating_mul(3 * row + size_of::<f64>()).saturating_add(points.saturating_mul(row));
        let pieces = 8 * BLOCK + size_of::<Section>() + size_of::<Earlier>();
        rows.saturating_add(elements.saturating_add(points).saturating_mul(row)).saturating_add(pieces)
    }

    /// Frees the lists' spare capacity.
    pub fn shrink(&mut self) {
        self.state.shrink();
    }

    /// Bytes on the heap, with its fraction of the section's.
    pub fn heap_bytes(&self) -> f64 {
        let lists = |lengths: &[f64], natural: &[[f64; 3]]| size_of_val(lengths) + size_of_val(natural);
        let authored =
            self.authored.as_ref().map_or(0, |authored| size_of::<Authored>() + lists(&authored.lengths, &authored.natural));
        let root_move = self.root_move.as_ref().map_or(0, |_| size_of::<(PoseMove, f64)>());
        let contact = self.contact.as_ref().map_or(0, |_| size_of::<StrandContact>());
        let permitted_overlap = self
            .permitted_overlap
            .as_ref()
            .map_or(0, |permitted_overlap| size_of::<PermittedOverlap>() + permitted_overlap.heap_bytes());
        let target = self.target.as_ref().map_or(0, |target| size_of::<Target>() + target.heap_bytes());
        let own = contact
            + permitted_overlap
            + target
            + authored
            + root_move
            + lists(&self.model.lengths, &self.model.natural)
            + self.state.heap_bytes();
        own as f64 + sections::fraction(self.model.section())
    }
}
