//! What holds strands at stations during a step: a touch with a body or another strand, a constraint's part. Each Newton iteration asks
//! it for its law and for the relative displacement that there is at the present iterate.
//!
//! The displacement over the step has the gap at the step's end as its normal part and the slip over the step as its tangential part.

use nalgebra::{Matrix3, Vector3};

use super::law::Law;
use super::law::bilateral::{BilateralLaw, ConstrainedAxes};
use super::law::coefficient::Coefficient;
use super::law::contact::{Contact, Friction};
use super::law::response::Response;
use super::law::ring::Ring;
use super::options::{self, ContactModel, ContactOptions, StrandContact};
use crate::chain::load::MaterialPoint;
use crate::math::vector::Mat3;
use crate::step::constrained_step::WorldConstraint;

/// A strand is as thick as this at least where it is asked whether it is behind a body, m.
const LEAST_MARGIN: f64 = 1e-5;

/// A body's surface is on the side that was found while its normal has turned by no more than this cosine since.
pub const SAME_SIDE: f64 = 0.7;
/// Where one less the cosine between two normals is less, they are of one face.
const ONE_FACE: f64 = 0.01;

/// One end of a joint: which of the held strands, and where on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstraintEnd {
    /// Index among the strands held in this step.
    pub strand: u32,
    /// Where.
    pub material_point: MaterialPoint,
}

/// Where an end is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndState {
    /// At the step's start, world, m.
    pub start: Vector3<f64>,
    /// At the present iterate for the step's end.
    pub now: Vector3<f64>,
    /// The tangent there now, unit, root to tip.
    pub tangent: Vector3<f64>,
}

/// What a joint is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstraintKind {
    /// A body's surface.
    Body {
        /// Index of the body.
        body: u32,
        /// Which triangle of a mesh.
        feature: u32,
        /// Unit normal at the step's end, towards the strand.
        normal: Vector3<f64>,
        /// The normal that the search found: which side of the body the strand is to stay on.
        side: Vector3<f64>,
        /// The body's point at the step's end.
        point: Vector3<f64>,
        /// How far that point goes in the step.
        carried: Vector3<f64>,
        /// From centreline to surface: the strand's radius and the body's thickness, m.
        margin: f64,
        /// Multiplies the strand's friction: Coulomb's, viscous.
        friction: [f64; 2],
    },
    /// Another strand's surface; the first end is the strand of the lower index.
    Hair {
        /// Unit normal, from the second end to the first.
        normal: Vector3<f64>,
        /// Sum of both radii, m.
        margin: f64,
    },
    /// A point of the world.
    Pin {
        /// Which constraint.
        bilateral: u32,
        /// Where the end is held at the step's end.
        target: Vector3<f64>,
        /// Along which axes.
        axes: ConstrainedAxes,
        /// m/N.
        compliance: f64,
    },
    /// Two ends held together.
    Tie {
        /// Which constraint.
        bilateral: u32,
        /// m/N.
        compliance: f64,
    },
    /// A ring that the strand slides through.
    Ring {
        /// Which constraint.
        bilateral: u32,
        /// Where it is at the step's end.
        target: Vector3<f64>,
        /// How far it goes in the step.
        carried: Vector3<f64>,
        /// Coulomb's coefficient.
        friction: options::Friction,
    },
}

/// How a joint stood when it was last looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// The law's residual, see [`Law::residual`].
    pub law_residual: f64,
    /// Whether it holds as exactly as a step's end asks.
    pub holds: bool,
    /// Whether it holds nearly enough for an island that does not get on.
    pub nearly: bool,
    /// Whether its force has changed so much that the strand at either end cannot stay where it is.
    pub wakes: [bool; 2],
}

impl Standing {
    /// Before the first look.
    pub const UNKNOWN: Self = Self { law_residual: f64::INFINITY, holds: false, nearly: false, wakes: [true; 2] };

    /// Where surfaces are apart and nothing presses them.
    pub fn apart() -> Self {
        Self { law_residual: 0.0, holds: true, nearly: true, wakes: [false; 2] }
    }
}

/// Whether a joint gives way where it cannot be held. One that does does not rub.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Give {
    /// It holds.
    #[default]
    No,
    /// A touch gives way a little.
    ALittle,
    /// Touches and constraints give way by more, until their strands come to an end.
    Much,
}

/// A joint of the present step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepConstraint {
    /// Where +force acts.
    pub first: ConstraintEnd,
    /// Where −force acts; none where the partner is not a strand.
    pub second: Option<ConstraintEnd>,
    /// What it is.
    pub kind: ConstraintKind,
    /// The force, N, world axes: the last iteration's.
    pub force: Vector3<f64>,
    /// How much of its viscous friction there is, in the models that have it, 0 to 1: friction begins with the force that presses, so that what is all but
    /// apart is nearly as what is apart.
    pub rubs: f64,
    /// Displacement over the step at the last evaluation.
    pub slip: Vector3<f64>,
    /// Gap at the last evaluation (touches), m, or how far a constraint was from holding.
    pub gap: f64,
    /// The surfaces were in each other when the step began: they part, but give way to each other meanwhile (the hard models).
    pub deep: bool,
    /// How it gives way, if it could not be held, or held a strand that did not come to its end (`ending.rs`).
    pub give: Give,
    /// How far it is from where it is to be, m, and by how much more than that its spring pushes: zero or above; of what gives way (`pushing.rs`).
    pub off: f64,
    /// See `off`.
    pub pushed: f64,
    /// It is one of a body's faces in a crease, and stays on that.
    pub in_crease: bool,
    /// A touch that has no part in contact problems for now: nothing presses it, and its surfaces are further apart than strands still go.
    pub dormant: bool,
    /// It was dormant, and came to touch after all: it is not again.
    pub roused: bool,
    /// Whether it is in the linear model that the strand at either end has from its last iteration.
    pub modelled: [bool; 2],
    /// How it stood at the last check.
    pub standing: Standing,
}

impl StepConstraint {
    /// One that nobody has looked at yet.
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
            dormant: false,
            roused: false,
            modelled: [true; 2],
            standing: Standing::UNKNOWN,
        }
    }

    /// Its ends, the first one first.
    pub fn ends(&self) -> impl Iterator<Item = ConstraintEnd> + use<> {
        [Some(self.first), self.second].into_iter().flatten()
    }

    /// Whether a strand at such a `gap` is in a body that it was not in when the step began, or beyond it: deeper than its radius.
    pub fn is_behind(&self, gap: f64) -> bool {
        matches!(self.kind, ConstraintKind::Body { margin, .. } if !self.deep && gap < -margin.max(LEAST_MARGIN))
    }

    /// Whether the force holds surfaces together, as an iteration may leave it that is not at its end. A constraint's may.
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

    /// How hard the surfaces press each other under the present force, N; zero where they draw, and of a constraint.
    pub fn pressure(&self) -> f64 {
        match self.kind {
            ConstraintKind::Body { normal, .. } | ConstraintKind::Hair { normal, .. } => self.force.dot(&normal).max(0.0),
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => 0.0,
        }
    }

    /// Whether it is a touch, not a constraint.
    pub fn is_contact(&self) -> bool {
        matches!(self.kind, ConstraintKind::Body { .. } | ConstraintKind::Hair { .. })
    }

    /// From centre to centre where the surfaces of a touch just meet, m, zero or above; zero of a constraint.
    pub fn margin(&self) -> f64 {
        match self.kind {
            ConstraintKind::Body { margin, .. } | ConstraintKind::Hair { margin, .. } => margin.max(0.0),
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => 0.0,
        }
    }

    /// Whether both are touches of the same strand with the same partner.
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

    /// How unlike the surfaces of two touches that are [`StepConstraint::is_with`] each other are: one less the cosine between their normals; zero
    /// of hair.
    pub fn turned(&self, other: &StepConstraint) -> f64 {
        match (self.kind, other.kind) {
            (ConstraintKind::Body { normal: a, .. }, ConstraintKind::Body { normal: b, .. }) => 1.0 - a.dot(&b),
            _ => 0.0,
        }
    }

    /// Whether `found` is a face of a crease that this touch began on and left for the other face when it was looked at again: both hold
    /// the point.
    pub fn has_left(&self, found: &StepConstraint) -> bool {
        match (self.kind, found.kind) {
            (ConstraintKind::Body { side, .. }, ConstraintKind::Body { normal, .. }) => {
                1.0 - side.dot(&normal) < ONE_FACE && self.turned(found) > ONE_FACE
            }
            _ => false,
        }
    }

    /// The constraint that it is of.
    pub fn bilateral(&self) -> Option<u32> {
        match self.kind {
            ConstraintKind::Pin { bilateral, .. }
            | ConstraintKind::Tie { bilateral, .. }
            | ConstraintKind::Ring { bilateral, .. } => Some(bilateral),
            ConstraintKind::Body { .. } | ConstraintKind::Hair { .. } => None,
        }
    }

    /// The law, and the relative displacement at the present iterate. `contact`: what the ends' strands are to contact.
    pub fn evaluate(
        &mut self,
        ends: [EndState; 2],
        contact: [&StrandContact; 2],
        options: &ContactOptions,
        step: f64,
    ) -> (Law, Vector3<f64>) {
        let [a, b] = ends;
        match self.kind {
            ConstraintKind::Body { normal, point, carried, margin, friction, .. } => {
                let slip = a.now - a.start - carried;
                let gap = normal.dot(&(a.now - point)) - margin;
                let start_gap = gap - normal.dot(&slip);
                let pick = |friction: &options::Friction| scales(friction, a.tangent);
                let scaled = |c: Coefficient, by: f64| Coefficient { mean: c.mean * by, lean: c.lean * by };
                let friction = if options.model.is_soft() {
                    self.viscous(scaled(pick(&contact[0].viscous_friction), friction[1]), normal, slip)
                } else {
                    Friction::Coulomb(scaled(pick(&contact[0].friction), friction[0]))
                };
                self.contact_law(normal, gap, start_gap, slip, friction, options, step)
            }
            ConstraintKind::Hair { normal, margin } => {
                let slip = (a.now - a.start) - (b.now - b.start);
                let gap = normal.dot(&(a.now - b.now)) - margin;
                let start_gap = gap - normal.dot(&slip);
                let both = |first: &options::Friction, second: &options::Friction| {
                    Coefficient::of_two(scales(first, a.tangent), scales(second, b.tangent))
                };
                let friction = if options.model.is_soft() {
                    self.viscous(both(&contact[0].viscous_friction, &contact[1].viscous_friction), normal, slip)
                } else {
                    Friction::Coulomb(both(&contact[0].hair_friction, &contact[1].hair_friction))
                };
                self.contact_law(normal, gap, start_gap, slip, friction, options, step)
            }
            ConstraintKind::Pin { target, axes, compliance, .. } => {
                let u = a.now - target;
                let bilateral = BilateralLaw { axes: self.pinned(axes, &u), compliance };
                self.slip = a.now - a.start;
                self.gap = bilateral.directions().map(|d| d.dot(&u).powi(2)).sum::<f64>().sqrt();
                (Law::Bilateral(bilateral), u)
            }
            ConstraintKind::Tie { compliance, .. } => {
                let u = a.now - b.now;
                self.slip = (a.now - a.start) - (b.now - b.start);
                self.gap = u.norm();
                (Law::Bilateral(BilateralLaw { axes: ConstrainedAxes::All, compliance }), u)
            }
            ConstraintKind::Ring { target, carried, friction, .. } => {
                let off = a.now - target;
                let slip = a.now - a.start - carried;
                let across = off - a.tangent * a.tangent.dot(&off);
                self.slip = slip;
                self.gap = across.norm();
                let u = across + a.tangent * a.tangent.dot(&slip);
                (Law::Ring(Ring { tangent: a.tangent, friction: scales(&friction, a.tangent) }), u)
            }
        }
    }

    /// The axes that a pin holds. A lever that is held across a direction may lie against it too: one that is far off is drawn to its very
    /// end.
    fn pinned(&self, axes: ConstrainedAxes, off: &Vector3<f64>) -> ConstrainedAxes {
        let lever = Vector3::from(self.first.material_point.lever).norm();
        match axes {
            ConstrainedAxes::Across(_) | ConstrainedAxes::Along(_) if lever > 0.0 && off.norm() > 0.5 * lever => {
                ConstrainedAxes::All
            }
            axes => axes,
        }
    }

    /// What it holds to the world without giving way, with its first end at `now`.
    pub fn world_constraint(&self, now: &Vector3<f64>) -> Option<WorldConstraint> {
        let ConstraintKind::Pin { target, axes, compliance: 0.0, .. } = self.kind else { return None };
        if self.give != Give::No {
            return None;
        }
        let u = now - target;
        let bilateral = BilateralLaw { axes: self.pinned(axes, &u), compliance: 0.0 };
        let (mut projector, mut off) = (Matrix3::zeros(), Vector3::zeros());
        for d in bilateral.directions() {
            projector += d * d.transpose();
            off += d * d.dot(&u);
        }
        Some(WorldConstraint {
            projector: Mat3(std::array::from_fn(|i| std::array::from_fn(|j| projector[(i, j)]))),
            off: off.into(),
        })
    }

    /// Viscous friction of a touch that rubs. The coefficient is that of the way it slides at the present iterate: which way that is hardly
    /// depends on it, so that Newton's iteration finds both at once, and the law is linear meanwhile.
    fn viscous(&self, coefficient: Coefficient, normal: Vector3<f64>, slip: Vector3<f64>) -> Friction {
        if self.rubs == 0.0 {
            return Friction::None;
        }
        let direction = (slip - normal * normal.dot(&slip)).try_normalize(0.0);
        Friction::Viscous(Coefficient::uniform(
            self.rubs * direction.map_or(coefficient.mean, |direction| coefficient.at(&direction)),
        ))
    }

    #[allow(clippy::too_many_arguments, reason = "the parts of one law")]
    fn contact_law(
        &mut self,
        normal: Vector3<f64>,
        gap: f64,
        start_gap: f64,
        slip: Vector3<f64>,
        friction: Friction,
        options: &ContactOptions,
        step: f64,
    ) -> (Law, Vector3<f64>) {
        (self.gap, self.slip) = (gap, slip);
        let (response, allowed) = match options.model {
            ContactModel::Penalty => {
                let damping = options.damping * options.stiffness;
                let depth_at_start = (-start_gap).max(0.0);
                (Response::Penalty { stiffness: options.stiffness, damping, depth_at_start }, 0.0)
            }
            ContactModel::RegularisedPenalty => {
                (Response::Regularised { stiffness: options.stiffness, depth: options.regularisation_depth }, 0.0)
            }
            // What is in each other at the start is parted at a limited speed. (Of other touches `start_gap` says nothing: along a curved
            // surface it is that of the start's place under the tangent plane at the end.)
            ContactModel::Coulomb if self.deep => (Response::Hard, (start_gap + options.separation_speed * step).min(0.0)),
            ContactModel::Coulomb => (Response::Hard, 0.0),
        };
        let u = normal * (gap - allowed) + (slip - normal * normal.dot(&slip));
        (Law::Contact(Contact { normal, response, friction }), u)
    }
}

fn scales(friction: &options::Friction, tangent: Vector3<f64>) -> Coefficient {
    Coefficient::of_scales(friction.along, friction.against, tangent)
}
