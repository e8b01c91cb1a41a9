//! The motion that all strands share: that of their roots.

use nalgebra::{Matrix3, Vector3};

use crate::contact::broad_phase::pieces::Wisp;
use crate::contact::contact_point::{StrandCurve, StrandPath};

/// The pose of a strand's root.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root {
    /// m, world.
    pub origin: Vector3<f64>,
    /// Its axes, in columns.
    pub frame: Matrix3<f64>,
}

/// The roots of the strands with a wisp radius.
pub(super) fn roots_of<'a>(
    strands: &[StrandPath<'a>],
    wisps: &[Wisp],
    curve: impl Fn(&StrandPath<'a>) -> StrandCurve<'a>,
    roots: &mut Vec<Root>,
) {
    let taking_part = strands.iter().zip(wisps).filter(|(_, wisp)| wisp.radius > 0.0);
    roots.clear();
    roots.extend(taking_part.filter_map(|(strand, _)| {
        let curve = curve(strand);
        let first = curve.elements.first()?;
        Some(Root { origin: curve.origin, frame: first.frame_left.into() })
    }));
}

/// A rotation and a translation.
#[derive(Debug)]
pub(super) struct RigidMotion {
    /// The rotation.
    pub turn: Matrix3<f64>,
    from: Vector3<f64>,
    to: Vector3<f64>,
}

/// Roots share no rotation if their mean rotation is shorter than this (1 for equal rotations).
const SHARED: f64 = 0.5;

impl RigidMotion {
    /// The common motion of roots: the mean of their rotations and of their origins. (Not that of the strands' points: two
    /// strands that pass through each other may look like one body that turned.)
    pub fn shared(roots: &[Root], later: &[Root]) -> Self {
        let (mut from, mut to, mut turns, mut count) = (Vector3::zeros(), Vector3::zeros(), Matrix3::zeros(), 0.0);
        for (then, now) in roots.iter().zip(later) {
            let turn = now.frame * then.frame.transpose();
            if (turn.norm_squared() + then.origin.norm_squared() + now.origin.norm_squared()).is_finite() {
                (from, to, turns, count) = (from + then.origin, to + now.origin, turns + turn, count + 1.0);
            }
        }
        if count == 0.0 {
            return Self { turn: Matrix3::identity(), from, to };
        }
        let svd = (turns / count).svd(true, true);
        let turn = match (svd.u, svd.v_t) {
            (Some(u), Some(v_t)) if svd.singular_values.min() > SHARED && (u * v_t).determinant() > 0.0 => u * v_t,
            _ => Matrix3::identity(),
        };
        Self { turn, from: from / count, to: to / count }
    }

    /// Where it takes a point.
    pub fn of(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.to + self.turn * (point - self.from)
    }
}
