//! Packs: strands that take a step side by side, one per lane.

use crate::math::frame::Frame;
use crate::rod::kinematics::ElementState;
use crate::rod::strand::StrandModel;
use crate::rod::target::TargetAt;
use crate::step::at_points::surfaces::{DepthAtPoints, PointContact, PointContactOptions, Surfaces};
use crate::step::integrator::stages;
use crate::step::options::Integrator;
use crate::step::state::StrandState;

/// Strands with one pack key ([`PackKey`]).
pub trait Pack {
    /// How many there are: 1 to the number of lanes.
    fn count(&self) -> usize;
    /// A strand's constants.
    fn model(&self, lane: usize) -> &StrandModel;
    /// A strand's state.
    fn state(&self, lane: usize) -> &StrandState;
    /// A strand's constants, and its mutable state.
    fn parts(&mut self, lane: usize) -> (&StrandModel, &mut StrandState);
    /// The root's pose at a time in seconds after the start of the step.
    fn root_at(&self, lane: usize, seconds: f64) -> Frame;
    /// What draws a strand, if anything does.
    fn target(&self, lane: usize) -> Option<TargetAt<'_>>;
    /// How bodies meet the strands at their points, if they do; the same for all of them.
    fn point_contact(&self) -> Option<PointContactOptions> {
        None
    }
    /// Calls `ask` with the surfaces that a strand may touch.
    fn with_surfaces(&self, _lane: usize, _ask: &mut dyn FnMut(&dyn Surfaces)) {}
    /// Takes down the contacts of a strand at the end of its step, from root to tip, and last how deep it is in bodies.
    fn take_contact(&mut self, _lane: usize, _contact: &PointContact) {}
    /// See [`Pack::take_contact`].
    fn take_depth(&mut self, _lane: usize, _depth: DepthAtPoints) {}
    /// Whether the end of a strand's step may become its state.
    fn may_keep(&mut self, _lane: usize, _end: &dyn StepEnd) -> bool {
        true
    }
}

/// A strand at the end of a step.
pub trait StepEnd {
    /// The root's pose.
    fn root(&self) -> Frame;
    /// Writes the curvatures, and the elements in world axes about the root; none where the step was taken in f32.
    fn write(&self, model: &StrandModel, curvatures: &mut Vec<[f64; 3]>, elements: &mut Vec<ElementState<f64>>);
}

/// The pack key: what strands must share to step side by side, as one number. It holds the number of elements, the quadrature
/// rule, the free curvatures, the active terms (drag, internal friction along each axis, a target, contact at points), and whether the
/// step uses the history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct PackKey(u64);

impl PackKey {
    /// The key of a strand in a step of `h` seconds; `drawn`: whether a target draws it; `touches`: whether bodies may meet it at its points.
    pub fn of(model: &StrandModel, state: &StrandState, [drawn, touches]: [bool; 2], integrator: Integrator, h: f64) -> Self {
        let history = integrator == Integrator::SecondOrder && stages::uses_history(state, h);
        let mut terms =
            u64::from(model.material.air_drag > 0.0) | u64::from(history) << 1 | u64::from(drawn) << 5 | u64::from(touches) << 6;
        for axis in 0..3 {
            terms |= u64::from(model.dissipation[axis] > 0.0) << (axis + 2);
        }
        let (elements, rule) = (model.element_count() as u64, state.rule as u64);
        Self(elements << 32 | rule << 16 | u64::from(model.freedoms.bits()) << 8 | terms)
    }
}

/// A single strand.
pub struct One<'a> {
    /// Constants.
    pub model: &'a StrandModel,
    /// State.
    pub state: &'a mut StrandState,
    /// The root's path.
    pub root_at: &'a dyn Fn(f64) -> Frame,
    /// What draws it.
    pub target: Option<TargetAt<'a>>,
    /// What it may touch.
    pub touches: Option<OneTouches<'a>>,
}

/// What a single strand may touch at its points, and where its contacts are taken down.
pub struct OneTouches<'a> {
    /// How contact is answered.
    pub options: PointContactOptions,
    /// The surfaces.
    pub surfaces: &'a dyn Surfaces,
    /// Its contacts at the end of the step.
    pub contacts: &'a mut Vec<PointContact>,
    /// How deep it is in bodies then.
    pub depth: &'a mut DepthAtPoints,
}

impl Pack for One<'_> {
    fn count(&self) -> usize {
        1
    }
    fn model(&self, _lane: usize) -> &StrandModel {
        self.model
    }
    fn state(&self, _lane: usize) -> &StrandState {
        self.state
    }
    fn parts(&mut self, _lane: usize) -> (&StrandModel, &mut StrandState) {
        (self.model, self.state)
    }
    fn root_at(&self, _lane: usize, seconds: f64) -> Frame {
        (self.root_at)(seconds)
    }
    fn target(&self, _lane: usize) -> Option<TargetAt<'_>> {
        self.target
    }
    fn point_contact(&self) -> Option<PointContactOptions> {
        self.touches.as_ref().map(|touches| touches.options)
    }
    fn with_surfaces(&self, _lane: usize, ask: &mut dyn FnMut(&dyn Surfaces)) {
        if let Some(touches) = &self.touches {
            ask(touches.surfaces);
        }
    }
    fn take_contact(&mut self, _lane: usize, contact: &PointContact) {
        if let Some(touches) = &mut self.touches {
            touches.contacts.push(*contact);
        }
    }
    fn take_depth(&mut self, _lane: usize, depth: DepthAtPoints) {
        if let Some(touches) = &mut self.touches {
            *touches.depth = depth;
        }
    }
}
