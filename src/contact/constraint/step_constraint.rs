//! Constraints of one step: a contact of a strand with a body or another strand, or a part of a bilateral constraint. Every
//! Newton iteration evaluates the law of each and its relative displacement at the present iterate.
//!
//! Displacements are over the step. Their normal part is the gap at the end of the step, their tangential part the slip.
//!
//! Files:
//!
//! - `evaluation.rs`: The law of a constraint at an iterate, with the displacement on which it acts.

mod evaluation;

use nalgebra::Vector3;

use super::law::bilateral::ConstrainedAxes;
use crate::chain::load::MaterialPoint;
use crate::contact::options;

/// A strand has at least this thickness in the test for being behind a body, m.
const LEAST_MARGIN: f64 = 1e-5;

/// A body's surface is on the side found by the search while its normal has turned by no more than this cosine since.
pub const SAME_SIDE: f64 = 0.7;
/// Two normals belong to one face if one minus their cosine is less than this.
const ONE_FACE: f64 = 0.01;

/// One end of a constraint: a material point of a constrained strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstraintEnd {
    /// Index among the constrained strands of this step.
    pub strand: u32,
    /// The material point.
    pub material_point: MaterialPoint,
}

/// The state of a constraint's end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndState {
    /// Position at the start of the step, world, m.
    pub start: Vector3<f64>,
    /// Position at the present iterate, world, m.
    pub now: Vector3<f64>,
    /// Tangent at the present iterate, unit, from root to tip.
    pub tangent: Vector3<f64>,
}

/// The kind of a constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstraintKind {
    /// Contact with a body.
    Body {
        /// Index of the body.
        body: u32,
        /// Triangle of a mesh; 0 for other shapes.
        feature: u32,
        /// Unit normal at the end of the step, towards the strand.
        normal: Vector3<f64>,
        /// The normal found by the search: the side of the body on which the strand stays.
        side: Vector3<f64>,
        /// The body's point at the end of the step, world, m.
        point: Vector3<f64>,
        /// Displacement of that point during the step, m.
        carried: Vector3<f64>,
        /// Distance from centreline to surface: the strand's radius plus the body's thickness, m.
        margin: f64,
        /// Factors of the strand's friction: Coulomb, viscous.
        friction: [f64; 2],
    },
    /// Contact with another strand; the first end is on the strand of the lower index.
    Hair {
        /// Unit normal, from the second end to the first.
        normal: Vector3<f64>,
        /// Sum of both radii, m.
        margin: f64,
        /// Compliance of the surfaces until they are pushed apart (`pushing.rs`), m/N; zero with penalties.
        compliance: f64,
    },
    /// A point fixed in the world.
    Pin {
        /// Index of the bilateral constraint in the scene.
        bilateral: u32,
        /// The target at the end of the step.
        target: Vector3<f64>,
        /// The constrained axes.
        axes: ConstrainedAxes,
        /// Compliance, m/N.
        compliance: f64,
    },
    /// Two points tied together.
    Tie {
        /// Index of the bilateral constraint in the scene.
        bilateral: u32,
        /// Compliance, m/N.
        compliance: f64,
    },
    /// A ring that the strand slides through.
    Ring {
        /// Index of the bilateral constraint in the scene.
        bilateral: u32,
        /// Position at the end of the step.
        target: Vector3<f64>,
        /// Displacement during the step.
        carried: Vector3<f64>,
        /// Coulomb friction.
        friction: options::Friction,
    },
}

/// The state of a constraint at the last check.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Residual of its law, see [`Law::residual`](super::law::Law::residual).
    pub law_residual: f64,
    /// The law holds to the tolerance of a converged step.
    pub holds: bool,
    /// The law holds well enough for an island that makes no progress.
    pub nearly: bool,
    /// Its force has changed so much that the resting strand at this end must move.
    pub wakes: [bool; 2],
}

impl Standing {
    /// Before the first check.
    pub const UNKNOWN: Self = Self { law_residual: f64::INFINITY, holds: false, nearly: false, wakes: [true; 2] };

    /// The surfaces are apart and nothing presses them.
    pub fn apart() -> Self {
        Self { law_residual: 0.0, holds: true, nearly: true, wakes: [false; 2] }
    }
}

/// Whether and how a constraint that cannot be satisfied yields. One that yields has no friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Give {
    /// It does not yield.
    #[default]
    No,
    /// A contact yields a little.
    ALittle,
    /// Contacts and bilateral constraints yield more, until their strands converge.
    Much,
}

/// Whether a constraint takes part in contact problems (`dormant.rs`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Activity {
    /// It does, but may fall asleep.
    #[default]
    Active,
    /// A contact that is left out: nothing presses it, and its surfaces are further apart than the strands still move.
    Dormant,
    /// It was left out and closed again: it stays.
    Roused,
}

/// A constraint of the present step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepConstraint {
    /// The end on which +force acts.
    pub first: ConstraintEnd,
    /// The end on which −force acts; `None` if the partner is no strand.
    pub second: Option<ConstraintEnd>,
    /// Its kind.
    pub kind: ConstraintKind,
    /// Force of the last iteration, N, world axes.
    pub force: Vector3<f64>,
    /// Fraction of its viscous friction in force, 0 to 1 (penalty models): friction grows with the normal force from zero, so
    /// that a contact about to open behaves nearly as an open one.
    pub rubs: f64,
    /// Displacement over the step at the last evaluation, m.
    pub slip: Vector3<f64>,
    /// Gap of a contact at the last evaluation, m; for a bilateral constraint its distance from being satisfied.
    pub gap: f64,
    /// The surfaces overlapped when the step began: they separate at a limited speed and yield meanwhile (hard models).
    pub deep: bool,
    /// How it yields, if it or its strand did not converge (`ending.rs`).
    pub give: Give,
    /// Of a constraint that yields: the depth that is left, m, and the offset by which its spring pushes beyond it, m, zero or
    /// above (`pushing.rs`).
    pub off: f64,
    /// See `off`.
    pub pushed: f64,
    /// It is one of two faces of a body in a crease, and stays on its face.
    pub in_crease: bool,
    /// Whether it takes part.
    pub activity: Activity,
    /// Whether the linear model of the strand at either end includes it, as of its last iteration.
    pub modelled: [bool; 2],
    /// Its state at the last check.
    pub standing: Standing,
}

impl StepConstraint {
    /// A constraint that has not been checked yet.
    pub fn new(first: ConstraintEnd, second: Option<ConstraintEnd>, kind: ConstraintKind, force: Vector3<f64>) -> Self {
        Self {
            first,
            second,
            kind,
            force,
            rubs: 0.0,
            slip: Vector3::zeros(),
            gap: 0.0,
            deep: false,
            give: Give::No,
            off: 0.0,
            pushed: 0.0,
            in_crease: false,
            activity: Activity::Active,
            modelled: [true; 2],
            standing: Standing::UNKNOWN,
        }
    }

    /// The compliance with which it yields although it is to hold, m/N; zero: it does not.
    pub fn compliance(&self) -> f64 {
        match self.kind {
            ConstraintKind::Hair { compliance, .. } if !self.deep && self.give == Give::No => compliance,
            _ => 0.0,
        }
    }

    /// Whether it yields although it is to hold: until it is pushed, see [`StepConstraint::off`].
    pub fn is_compliant(&self) -> bool {
        self.compliance() > 0.0
    }

    /// Whether it is left out of contact problems.
    pub fn is_dormant(&self) -> bool {
        self.activity == Activity::Dormant
    }

    /// Its ends, the first one first.
    pub fn ends(&self) -> impl Iterator<Item = ConstraintEnd> + use<> {
        [Some(self.first), self.second].into_iter().flatten()
    }

    /// Whether a strand at this `gap` is inside or beyond a body that it was outside of when the step began: deeper than its
    /// radius.
    pub fn is_behind(&self, gap: f64) -> bool {
        matches!(self.kind, ConstraintKind::Body { margin, .. } if !self.deep && gap < -margin.max(LEAST_MARGIN))
    }

    /// Whether the force pulls the surfaces together, as an unconverged iteration may leave it. False for bilateral
    /// constraints, whose force has any sign.
    pub fn draws(&self) -> bool {
        match self.kind {
            ConstraintKind::Body { normal, .. } | ConstraintKind::Hair { normal, .. } => self.force.dot(&normal) < 0.0,
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => false,
        }
    }

    /// Whether the surfaces press each other under the present force.
    pub fn presses(&self) -> bool {
        self.pressure() > 0.0
    }

    /// Normal force between the surfaces, N; zero if it pulls, and for bilateral constraints.
    pub fn pressure(&self) -> f64 {
        match self.kind {
            ConstraintKind::Body { normal, .. } | ConstraintKind::Hair { normal, .. } => self.force.dot(&normal).max(0.0),
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => 0.0,
        }
    }

    /// Whether it is a contact.
    pub fn is_contact(&self) -> bool {
        matches!(self.kind, ConstraintKind::Body { .. } | ConstraintKind::Hair { .. })
    }

    /// Distance of the centrelines at which the surfaces of a contact meet, m, zero or above; zero for a bilateral constraint.
    pub fn margin(&self) -> f64 {
        match self.kind {
            ConstraintKind::Body { margin, .. } | ConstraintKind::Hair { margin, .. } => margin.max(0.0),
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => 0.0,
        }
    }

    /// Whether both are contacts of the same strand with the same partner.
    pub fn is_with(&self, other: &StepConstraint) -> bool {
        self.first.strand == other.first.strand
            && match (self.kind, other.kind) {
                (ConstraintKind::Body { body: a, .. }, ConstraintKind::Body { body: b, .. }) => a == b,
                (ConstraintKind::Hair { .. }, ConstraintKind::Hair { .. }) => {
                    self.second.map(|end| end.strand) == other.second.map(|end| end.strand)
                }
                _ => false,
            }
    }

    /// Difference of the surfaces of two contacts with the same partner ([`StepConstraint::is_with`]): one minus the cosine of
    /// their normals; zero between strands.
    pub fn turned(&self, other: &StepConstraint) -> f64 {
        match (self.kind, other.kind) {
            (ConstraintKind::Body { normal: a, .. }, ConstraintKind::Body { normal: b, .. }) => 1.0 - a.dot(&b),
            _ => 0.0,
        }
    }

    /// Whether this contact began on the face `found` of a crease and went to the other face at a later look: both faces then
    /// constrain the point.
    pub fn has_left(&self, found: &StepConstraint) -> bool {
        match (self.kind, found.kind) {
            (ConstraintKind::Body { side, .. }, ConstraintKind::Body { normal, .. }) => {
                1.0 - side.dot(&normal) < ONE_FACE && self.turned(found) > ONE_FACE
            }
            _ => false,
        }
    }

    /// The scene's bilateral constraint that it belongs to.
    pub fn bilateral(&self) -> Option<u32> {
        match self.kind {
            ConstraintKind::Pin { bilateral, .. }
            | ConstraintKind::Tie { bilateral, .. }
            | ConstraintKind::Ring { bilateral, .. } => Some(bilateral),
            ConstraintKind::Body { .. } | ConstraintKind::Hair { .. } => None,
        }
    }
}
