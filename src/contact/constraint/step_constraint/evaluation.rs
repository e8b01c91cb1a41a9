//! The law of a constraint at an iterate, with the displacement on which it acts.

use nalgebra::{Matrix3, Vector3};

use super::{ConstraintKind, EndState, Give, StepConstraint};
use crate::contact::constraint::law::Law;
use crate::contact::constraint::law::bilateral::{BilateralLaw, ConstrainedAxes};
use crate::contact::constraint::law::coefficient::Coefficient;
use crate::contact::constraint::law::contact::{Contact, Friction};
use crate::contact::constraint::law::response::Response;
use crate::contact::constraint::law::ring::Ring;
use crate::contact::options::{self, ContactModel, ContactOptions, StrandContact};
use crate::math::vector::Mat3;
use crate::step::constrained::step::WorldConstraint;

impl StepConstraint {
    /// The law, and the relative displacement at the present iterate. `contact`: contact properties of the strands at both
    /// ends.
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
                let friction = if options.model.has_viscous_friction() {
                    self.viscous(scaled(pick(&contact[0].viscous_friction), friction[1]), normal, slip)
                } else {
                    Friction::Coulomb(scaled(pick(&contact[0].friction), friction[0]))
                };
                self.contact_law(normal, gap, start_gap, slip, friction, options, step)
            }
            ConstraintKind::Hair { normal, margin, .. } => {
                let slip = (a.now - a.start) - (b.now - b.start);
                let gap = normal.dot(&(a.now - b.now)) - margin;
                let start_gap = gap - normal.dot(&slip);
                let both = |first: &options::Friction, second: &options::Friction| {
                    Coefficient::of_two(scales(first, a.tangent), scales(second, b.tangent))
                };
                let friction = if options.model.has_viscous_friction() {
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

    /// The axes that a pin constrains. A lever that is constrained across a direction could lie against that direction; one
    /// that is far off is therefore pulled in by its end.
    fn pinned(&self, axes: ConstrainedAxes, off: &Vector3<f64>) -> ConstrainedAxes {
        let lever = Vector3::from(self.first.material_point.lever).norm();
        match axes {
            ConstrainedAxes::Across(_) | ConstrainedAxes::Along(_) if lever > 0.0 && off.norm() > 0.5 * lever => {
                ConstrainedAxes::All
            }
            axes => axes,
        }
    }

    /// The rigid constraint that it is between its first end, at `now`, and the world; `None` if it yields or has two ends.
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

    /// Viscous friction. The coefficient is that of the present direction of sliding. The direction hardly depends on the
    /// coefficient, so that Newton's iteration finds both at once, and the law is linear meanwhile.
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
            ContactModel::Penalty | ContactModel::AtPoints => {
                let damping = options.damping * options.stiffness;
                let depth_at_start = (-start_gap).max(0.0);
                (Response::Penalty { stiffness: options.stiffness, damping, depth_at_start }, 0.0)
            }
            ContactModel::RegularisedPenalty => {
                (Response::Regularised { stiffness: options.stiffness, depth: options.regularisation_depth }, 0.0)
            }
            // Initial overlap is removed at a limited speed. (For other contacts `start_gap` means nothing: on a curved surface
            // it is the gap of the initial point from the final tangent plane.)
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
