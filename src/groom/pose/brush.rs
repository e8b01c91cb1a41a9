//! A brush that carries the strands inside it along.

use nalgebra::Vector3;

use super::drag::{HARD, leave_bodies, prepare};
use super::search::{End, Pull, Weights};
use super::{PoseOptions, PoseScratch, StrandShape, Surroundings};
#[cfg(doc)]
use crate::error::Error;
use crate::error::{Result, check_finite, check_not_negative, check_positive};
use crate::math::vector::Vec3;
use crate::rod::kinematics::element_states;
use crate::step::state::rotation_matrix;

/// A ball that moves and carries the hair inside it along.
///
/// ```
/// use superhelix::editing::{Brush, PoseOptions};
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let brush = Brush {
///     centre: Vector3::new(0.15, 0.0, 0.0),
///     radius: 0.04,
///     falloff: 2.0,
///     movement: Vector3::new(0.0, 0.02, 0.0),
/// };
/// let brushed = solver.brush(&ids, &brush, &PoseOptions::default())?;
/// assert!(brushed[0].touched);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Brush {
    /// Its initial centre, world, m.
    pub centre: Vector3<f64>,
    /// m; above zero.
    pub radius: f64,
    /// How its effect falls off from its centre: a point at distance d follows the fraction (1 − d²/radius²)^falloff of the
    /// movement. Zero or above; 0 for a uniform effect.
    pub falloff: f64,
    /// Its movement, m.
    pub movement: Vector3<f64>,
}

/// The result of a brush on one strand.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Brushed {
    /// Whether the strand has points in the brush. If not, nothing changed.
    pub touched: bool,
    /// Root mean square distance of its points in the brush from their targets, m.
    pub distance: f64,
    /// Its remaining depth in a body, m.
    pub depth: f64,
    /// Iterations.
    pub iterations: u32,
}

/// W: the weight of the brush's pull against bending.
const PULL: f64 = 1e4;
/// When its search ends.
const END: End = End { most: 12, gain: 1e-2, turn: f64::INFINITY, near: 0.0 };
/// Points per element that are examined: this many per brush radius, with a minimum and a maximum.
const POINTS_PER_RADIUS: f64 = 4.0;
const MIN_POINTS: f64 = 3.0;
const MAX_POINTS: f64 = 16.0;

impl Brush {
    /// The fraction of the movement that a point follows; `None` outside.
    fn fraction(&self, at: Vector3<f64>) -> Option<f64> {
        let rest = 1.0 - (at - self.centre).norm_squared() / (self.radius * self.radius);
        (rest > 0.0).then(|| if self.falloff == 0.0 { 1.0 } else { rest.powf(self.falloff) })
    }
}

impl StrandShape {
    /// Moves a brush over the strand, with its root fixed: the points inside follow as far as the strand's lengths and its
    /// bending permit, by least squares. A strand without points in the brush stays the same to the bit.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an invalid shape, brush or option; the shape is then unchanged.
    #[doc(hidden)] // `Solver::brush` is the public one: this takes bodies as the solver has them.
    pub fn brush(
        &mut self,
        brush: &Brush,
        options: &PoseOptions,
        surroundings: &Surroundings,
        scratch: &mut PoseScratch,
    ) -> Result<Brushed> {
        self.check("shape")?;
        options.check("options", self.curvatures.len())?;
        surroundings.check("surroundings", self)?;
        check_brush("brush", brush)?;
        Ok(self.brush_checked(brush, options, options.movable.as_deref(), surroundings, scratch))
    }

    /// The same for checked arguments; `movable` is this strand's part of the options'.
    pub(crate) fn brush_checked(
        &mut self,
        brush: &Brush,
        options: &PoseOptions,
        movable: Option<&[bool]>,
        surroundings: &Surroundings,
        scratch: &mut PoseScratch,
    ) -> Brushed {
        let length = self.length();
        if (self.root.origin - brush.centre).norm() > length + brush.radius || !self.follow(brush, length, scratch) {
            return Brushed::default();
        }
        prepare(self, options.natural_pull, movable, surroundings, scratch);
        let PoseScratch { search, free, anchor, pulls, rows, elements: _ } = scratch;
        let mut task = self.task(options, surroundings, free, anchor, pulls);
        rows.clone_from(&self.curvatures);
        search.begin(&task, rows);
        search.descend(&task, rows, Weights { pull: PULL, hard: HARD }, &END);
        let whole: f64 = task.pulls.iter().map(|pull| pull.weight).sum();
        let distance = (search.state.distance / whole).sqrt();
        leave_bodies(&mut task, search, rows);
        self.curvatures.copy_from_slice(rows);
        Brushed { touched: true, distance, depth: search.state.depth, iterations: search.iterations }
    }

    /// Creates the pulls on the points in the brush; returns whether there are any.
    fn follow(&self, brush: &Brush, length: f64, scratch: &mut PoseScratch) -> bool {
        let PoseScratch { pulls, elements, .. } = scratch;
        element_states(rotation_matrix(&self.root), self.element_lengths.iter().copied(), &self.curvatures, elements);
        pulls.clear();
        for (index, element) in elements.iter().enumerate() {
            let middle = self.root.origin + 0.5 * Vector3::from(element.origin_left + element.origin_right());
            if (middle - brush.centre).norm() > 0.5 * element.length + brush.radius {
                continue;
            }
            let count = (POINTS_PER_RADIUS * element.length / brush.radius).ceil().clamp(MIN_POINTS, MAX_POINTS);
            for k in 0..count as usize {
                let s = (k as f64 + 0.5) / count * element.length;
                let at = element.point(s).position;
                if let Some(fraction) = brush.fraction(self.root.origin + Vector3::from(at)) {
                    let target = at + Vec3::from(brush.movement).scale(fraction);
                    pulls.push(Pull { element: index, s, target, weight: fraction * element.length / (count * length) });
                }
            }
        }
        // A fraction that rounds to zero pulls at nothing.
        pulls.retain(|pull| pull.weight > 0.0);
        !pulls.is_empty()
    }
}

/// Checks every value.
pub(crate) fn check_brush(argument: &str, brush: &Brush) -> Result<()> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}.centre[{axis}]"), brush.centre[axis])?;
        check_finite(|| format!("{argument}.movement[{axis}]"), brush.movement[axis])?;
    }
    check_positive(|| format!("{argument}.radius"), brush.radius)?;
    check_not_negative(|| format!("{argument}.falloff"), brush.falloff)
}
