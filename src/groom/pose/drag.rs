//! Drags one strand by a point: Bergbom 2007, section 4.3, with a linear-time Jacobian.

use nalgebra::Vector3;

use super::search::{End, Obstacles, Pull, Search, Task, Weights};
use super::{PoseOptions, StrandShape, Surroundings};
use crate::error::{Error, Result, check_finite};
use crate::math::vector::Vec3;
use crate::rod::kinematics::ElementState;
use crate::step::state::rotation_matrix;

/// A point and its target.
///
/// ```
/// use superhelix::editing::{DragTarget, PoseOptions};
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let target = DragTarget { arclength: 0.2, position: Vector3::new(0.1, 0.08, 0.0) };
/// let dragged = solver.drag(&ids, &[target], &PoseOptions::default())?;
/// assert!(dragged[0].distance < 1e-3); // m
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragTarget {
    /// Arclength of the point from the root, m; above 0, at most the strand's length.
    pub arclength: f64,
    /// Its target position, world, m.
    pub position: Vector3<f64>,
}

/// The result of a drag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dragged {
    /// The point's remaining distance from its target, m. A target inside a body is replaced by the nearest place on its surface.
    pub distance: f64,
    /// The strand's remaining depth in a body, m: above 0 only where the movable elements are not enough.
    pub depth: f64,
    /// Iterations.
    pub iterations: u32,
}

/// Memory that is reused from strand to strand.
#[derive(Default)]
pub struct PoseScratch {
    pub(super) search: Search,
    pub(super) free: Vec<[bool; 3]>,
    pub(super) anchor: Vec<[f64; 3]>,
    pub(super) pulls: Vec<Pull>,
    pub(super) rows: Vec<[f64; 3]>,
    pub(super) elements: Vec<ElementState<f64>>,
}

impl std::fmt::Debug for PoseScratch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PoseScratch").finish_non_exhaustive()
    }
}

/// H: a body or a direction yields by less than 10⁻⁸ of the length to the bending of a strand by several turns.
pub(super) const HARD: f64 = 1e9;
/// W, from a shape near the preferred one to one that meets its target.
const FIRST: [f64; 2] = [1e3, 1e5];
const LAST: f64 = 1e9;
/// When a search with one of the first weights ends; `near` is relative to the length.
const ROUGH: End = End { most: 20, gain: 3e-2, turn: f64::INFINITY, near: 0.0 };
/// When a search with the last weight ends.
const FINE: End = End { most: 100, gain: 1e-4, turn: 1e-7, near: 1e-7 };
/// A target is reached within this fraction of the length.
const REACHED: f64 = 1e-6;
/// A body is cleared at a depth of at most this fraction of the length.
const LEFT: f64 = 1e-8;
/// When a search out of bodies ends.
const LEAVING: End = End { most: 40, gain: 1e-6, turn: 1e-7, near: 0.0 };

impl StrandShape {
    /// Drags a point of the strand to a target, with its root fixed: of the shapes that reach it, finds one near the preferred
    /// shape ([`PoseOptions::natural_pull`]) by the Levenberg–Marquardt method on the curvatures. Lengths do not change. A target
    /// out of reach is approached as far as the movable elements permit.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an invalid shape, target or option; the shape is then unchanged.
    #[doc(hidden)] // `Solver::drag` is the public one: this takes bodies as the solver has them.
    pub fn drag(
        &mut self,
        target: &DragTarget,
        options: &PoseOptions,
        surroundings: &Surroundings,
        scratch: &mut PoseScratch,
    ) -> Result<Dragged> {
        self.check("shape")?;
        options.check("options", self.curvatures.len())?;
        surroundings.check("surroundings", self)?;
        check_target("target", target, self.length())?;
        Ok(self.drag_checked(target, options, options.movable.as_deref(), surroundings, scratch))
    }

    /// The same for checked arguments; `movable` is this strand's part of the options'.
    pub(crate) fn drag_checked(
        &mut self,
        target: &DragTarget,
        options: &PoseOptions,
        movable: Option<&[bool]>,
        surroundings: &Surroundings,
        scratch: &mut PoseScratch,
    ) -> Dragged {
        let length = self.length();
        let (element, s) = self.material_point(target.arclength);
        let obstacles = surroundings.obstacles(options);
        let to = obstacles.map_or(target.position, |obstacles| outside(target.position, target.arclength, &obstacles));
        prepare(self, options.natural_pull, movable, surroundings, scratch);
        let PoseScratch { search, free, anchor, pulls, rows, elements: _ } = scratch;
        pulls.clear();
        pulls.push(Pull { element, s, target: Vec3::from(to - self.root.origin), weight: 1.0 });
        let mut task = self.task(options, surroundings, free, anchor, pulls);
        rows.clone_from(&self.curvatures);
        search.begin(&task, rows);
        for pull in FIRST {
            search.descend(&task, rows, Weights { pull, hard: HARD }, &ROUGH);
        }
        let (weights, fine) = (Weights { pull: LAST, hard: HARD }, End { near: FINE.near * length, ..FINE });
        search.descend(&task, rows, weights, &fine);
        if search.state.distance > (REACHED * length).powi(2) {
            task.unlock(search, rows, weights, &fine);
        }
        leave_bodies(&mut task, search, rows);
        self.curvatures.copy_from_slice(rows);
        let distance = (to - self.root.origin - Vector3::from(search.state.elements[element].point(s).position)).norm();
        Dragged { distance, depth: search.state.depth, iterations: search.iterations }
    }

    /// The search task for this shape, from the results of [`prepare`] and some pulls.
    pub(super) fn task<'a>(
        &'a self,
        options: &PoseOptions,
        surroundings: &Surroundings<'a>,
        free: &'a [[bool; 3]],
        anchor: &'a [[f64; 3]],
        pulls: &'a [Pull],
    ) -> Task<'a> {
        Task {
            root: rotation_matrix(&self.root),
            origin: self.root.origin,
            lengths: &self.element_lengths,
            length: self.length(),
            free,
            charge: surroundings.charge,
            anchor,
            pulls,
            tip: options.keep_tip_direction.then(|| self.tip_direction()),
            obstacles: surroundings.obstacles(options),
        }
    }
}

/// The curvatures that may change, and the preferred shape.
pub(super) fn prepare(
    shape: &StrandShape,
    fraction: f64,
    movable: Option<&[bool]>,
    surroundings: &Surroundings,
    scratch: &mut PoseScratch,
) {
    let PoseScratch { free, anchor, .. } = scratch;
    free.clear();
    anchor.clear();
    for (element, row) in shape.curvatures.iter().enumerate() {
        let may = movable.is_none_or(|movable| movable[element]);
        free.push(std::array::from_fn(|axis| may && surroundings.freedoms.contains(axis)));
        let natural = surroundings.natural.map_or(row, |natural| &natural[element]);
        anchor.push(std::array::from_fn(|axis| row[axis] + fraction * (natural[axis] - row[axis])));
    }
}

/// Brings what is still inside a body out of it, at the cost of everything else.
pub(super) fn leave_bodies(task: &mut Task, search: &mut Search, rows: &mut Vec<[f64; 3]>) {
    if task.obstacles.is_none() || search.state.depth <= LEFT * task.length {
        return;
    }
    let anchor = rows.clone();
    let mut task = Task { anchor: &anchor, pulls: &[], tip: None, ..*task };
    task.pulls = &[];
    search.descend(&task, rows, Weights { pull: 0.0, hard: HARD }, &LEAVING);
}

impl Task<'_> {
    /// A straight strand that is pulled or pushed along itself has no preferred side to bend to: this bends it a little and
    /// searches again.
    fn unlock(&self, search: &mut Search, rows: &mut Vec<[f64; 3]>, weights: Weights, end: &End) {
        let Some(pull) = self.pulls.first() else { return };
        let first = self.free.iter().position(|free| free.iter().any(|free| *free));
        let Some(first) = first.filter(|first| *first <= pull.element) else { return };
        let elements = &search.state.elements;
        let (from, at) = (elements[first].origin_left, elements[pull.element].point(pull.s).position);
        let along: f64 = self.lengths[first..pull.element].iter().sum::<f64>() + pull.s;
        let (now, wanted) = ((at - from).norm_squared().sqrt(), (pull.target - from).norm_squared().sqrt());
        // Only if the arc is nearly its chord, and the chord must become shorter.
        if now < along * (1.0 - 1e-4) || wanted > now * (1.0 - 1e-6) {
            return;
        }
        let stiffer = self.charge[1] > self.charge[2];
        let fraction = (1.0 - wanted / along).clamp(0.0, 0.5);
        let bend = (24.0 * fraction).sqrt() / along;
        let before = (search.state.cost, rows.clone());
        for (row, free) in rows[first..=pull.element].iter_mut().zip(&self.free[first..=pull.element]) {
            let axis = match (free[1], free[2]) {
                (true, true) => 1 + usize::from(stiffer),
                (true, false) => 1,
                (false, true) => 2,
                (false, false) => continue,
            };
            row[axis] += bend;
        }
        search.descend(self, rows, weights, end);
        if search.state.cost >= before.0 {
            *rows = before.1;
            search.descend(self, rows, weights, &End { most: 0, ..*end });
        }
    }
}

/// A target moved out of the bodies by the strand's clearance.
fn outside(mut target: Vector3<f64>, arclength: f64, obstacles: &Obstacles) -> Vector3<f64> {
    if arclength <= obstacles.span.exempt {
        return target;
    }
    // Out of one body and into another: a few rounds.
    for _ in 0..4 {
        let mut moved = false;
        for body in obstacles.bodies {
            let thickness = obstacles.distance + body.thickness;
            if let Some(surface) = body.closest_at_end(target, thickness) {
                target += body.to_world(&surface.normal) * (thickness - surface.distance);
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    target
}

/// Checks a target on a strand of this length.
pub(crate) fn check_target(argument: &str, target: &DragTarget, length: f64) -> Result<()> {
    let DragTarget { arclength, position } = target;
    if !(*arclength > 0.0 && *arclength <= length * (1.0 + 1e-9)) {
        let expected = format!("above 0, at most the strand's length, {length} m");
        return Err(Error::invalid(format!("{argument}.arclength"), arclength, expected));
    }
    for axis in 0..3 {
        check_finite(|| format!("{argument}.position[{axis}]"), position[axis])?;
    }
    Ok(())
}
