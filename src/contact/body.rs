//! Bodies: shapes that strands stay outside of, with their poses and motions.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::shape::{Bounds, Mesh, Shape, Surface};
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;
use crate::math::pose_motion::PoseMotion;
use crate::math::rotation::rotation_vector;

/// What a body is made of. [`BodyDef::new`] gives a body at the origin that touches every strand, with their own friction.
///
/// ```
/// use std::sync::Arc;
///
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{BodyDef, Frame, Shape, Solver, SolverOptions};
///
/// let shape = Arc::new(Shape::new_sphere(0.09)?);
/// let head = BodyDef {
///     pose: Frame { origin: Vector3::new(0.0, 0.0, 1.7), ..Frame::default() },
///     thickness: 1e-3,
///     ..BodyDef::new(shape)
/// };
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_bodies(vec![head])?;
/// assert_eq!(solver.body(ids[0])?.thickness, 1e-3);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct BodyDef {
    /// Shape in the body's own axes. Bodies may share one.
    pub shape: Arc<Shape>,
    /// Where the body is, world.
    pub pose: Frame,
    /// How far outside its shape the body's surface lies, m, zero or above.
    pub thickness: f64,
    /// Multiplies the strands' coefficients of Coulomb friction, zero or above.
    pub friction: f64,
    /// Multiplies the strands' coefficients of viscous friction, zero or above.
    pub viscous_friction: f64,
    /// Bits of the groups that the body belongs to.
    pub group: u32,
    /// Bits of the groups with which it collides. A strand and a body collide if each is in a group of the other's mask.
    pub mask: u32,
}

impl BodyDef {
    /// A body with this shape at the world's origin, without thickness, with the strands' own friction, in the first group,
    /// colliding with all.
    pub fn new(shape: Arc<Shape>) -> Self {
        Self { shape, pose: Frame::default(), thickness: 0.0, friction: 1.0, viscous_friction: 1.0, group: 1, mask: u32::MAX }
    }
}

/// A body in motion. Changes need exclusive access; any number of threads may read.
#[derive(Debug, Clone)]
pub struct Body {
    def: BodyDef,
    /// Its motion; the present pose is the one in `def`.
    pub(crate) motion: PoseMotion,
    pub(crate) bending: Option<Box<Bending>>,
}

/// A mesh's vertices in motion.
#[derive(Debug, Clone)]
pub(crate) struct Bending {
    pub from: Vec<Vector3<f64>>,
    pub to: Vec<Vector3<f64>>,
    pub duration: f64,
    pub elapsed: f64,
}

impl Body {
    /// A body at rest.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when thickness or a coefficient of friction is not finite and zero or above, or the pose is not finite.
    pub fn new(def: BodyDef) -> Result<Self> {
        check_not_negative(|| "thickness".into(), def.thickness)?;
        check_not_negative(|| "friction".into(), def.friction)?;
        check_not_negative(|| "viscous_friction".into(), def.viscous_friction)?;
        check_pose("pose", &def.pose)?;
        Ok(Self { motion: PoseMotion::at(def.pose), def, bending: None })
    }

    /// Its definition, with the present pose.
    pub fn def(&self) -> &BodyDef {
        &self.def
    }

    /// Sets thickness (m) and the coefficients of friction (1; N·s/m).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when one is not finite and zero or above; nothing is changed then.
    pub fn set_surface(&mut self, thickness: f64, friction: f64, viscous_friction: f64) -> Result<()> {
        check_not_negative(|| "thickness".into(), thickness)?;
        check_not_negative(|| "friction".into(), friction)?;
        check_not_negative(|| "viscous_friction".into(), viscous_friction)?;
        (self.def.thickness, self.def.friction, self.def.viscous_friction) = (thickness, friction, viscous_friction);
        Ok(())
    }

    /// Sets the bits of its groups and of those with which it collides.
    pub fn set_filter(&mut self, group: u32, mask: u32) {
        (self.def.group, self.def.mask) = (group, mask);
    }

    /// Whether it collides with something of these groups and this mask.
    pub fn meets(&self, group: u32, mask: u32) -> bool {
        self.def.group & mask != 0 && group & self.def.mask != 0
    }

    /// Sends it to a pose in `duration` seconds, starting with its present velocity; in 0 seconds: within the coming substep.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the pose is not finite or the duration not finite and zero or above; nothing is changed
    /// then.
    pub fn move_to(&mut self, pose: Frame, duration: f64) -> Result<()> {
        check_pose("pose", &pose)?;
        check_not_negative(|| "duration".into(), duration)?;
        self.motion.send(pose, duration);
        Ok(())
    }

    /// Puts it at a pose, at rest, without passing what lies between.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the pose is not finite; nothing is changed then.
    pub fn place(&mut self, pose: Frame) -> Result<()> {
        check_pose("pose", &pose)?;
        self.def.pose = pose;
        self.motion = PoseMotion::at(pose);
        Ok(())
    }

    /// Sends a mesh's vertices (m, the body's axes) to new positions in `duration` seconds, each along a straight line at
    /// constant speed; in 0 seconds: within the coming substep. The tree of its boxes is refitted in every substep.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when the shape is no mesh; [`Error::InvalidArgument`] when the count is not the mesh's, a number
    /// is not finite, or the duration not finite and zero or above. Nothing is changed then.
    pub fn set_vertices(&mut self, vertices: &[Vector3<f64>], duration: f64) -> Result<()> {
        check_not_negative(|| "duration".into(), duration)?;
        let Some(mesh) = self.def.shape.mesh() else {
            return Err(Error::Unsupported {
                argument: "body".into(),
                value: "of a shape without vertices to set".into(),
                hint: "only triangle meshes deform".into(),
            });
        };
        mesh.check_replacement(vertices)?;
        let from = mesh.vertices();
        match &mut self.bending {
            Some(bending) => {
                bending.from.copy_from_slice(from);
                bending.to.copy_from_slice(vertices);
                (bending.duration, bending.elapsed) = (duration, 0.0);
            }
            None => {
                self.bending = Some(Box::new(Bending { from: from.to_vec(), to: vertices.to_vec(), duration, elapsed: 0.0 }));
            }
        }
        Ok(())
    }

    /// Makes a motion of duration 0 take the coming `h` seconds.
    pub(crate) fn ready(&mut self, h: f64) {
        self.motion.begin(h);
        if let Some(bending) = self.bending.as_deref_mut().filter(|bending| bending.duration == 0.0) {
            bending.duration = h;
        }
    }

    /// Prepares the body for a substep of `h` seconds: a motion of duration 0 takes it, and a deforming mesh gets its start and
    /// end.
    pub fn begin(&mut self, h: f64) {
        self.motion.begin(h);
        let Some(bending) = &mut self.bending else {
            // A shape shared with a body that deforms, as it was in the middle of its motion.
            self.rest();
            return;
        };
        if bending.duration == 0.0 {
            bending.duration = h;
        }
        let Some(mesh) = Arc::make_mut(&mut self.def.shape).deforming_mut() else { return };
        if bending.elapsed >= bending.duration {
            mesh.rest();
            self.bending = None;
        } else {
            let part = |time: f64| if time >= bending.duration * (1.0 - 1e-12) { 1.0 } else { time / bending.duration };
            mesh.advance(&bending.from, &bending.to, part(bending.elapsed), part(bending.elapsed + h));
        }
    }

    /// The body during the coming substep of `h` seconds; after [`Body::begin`]. `index` identifies it in contacts.
    pub fn at(&self, index: u32, h: f64) -> BodyAt<'_> {
        let BodyDef { friction, viscous_friction, group, mask, .. } = self.def;
        BodyAt {
            friction,
            viscous_friction,
            group,
            mask,
            ..BodyAt::new(index, &self.def.shape, self.motion.pose, self.motion.after(h), self.def.thickness)
        }
    }

    /// Ends the mesh's motion of the last substep.
    pub(crate) fn rest(&mut self) {
        if self.def.shape.mesh().is_some_and(Mesh::is_moving)
            && let Some(mesh) = Arc::make_mut(&mut self.def.shape).deforming_mut()
        {
            mesh.rest();
        }
    }

    /// The body at its present pose, at rest; a mesh as [`Body::rest`] leaves it.
    pub(crate) fn still(&self, index: u32) -> BodyAt<'_> {
        let BodyDef { friction, viscous_friction, group, mask, thickness, .. } = self.def;
        let pose = self.def.pose;
        BodyAt { friction, viscous_friction, group, mask, ..BodyAt::new(index, &self.def.shape, pose, pose, thickness) }
    }

    /// The largest distance of its shape from its pose's origin, m; zero for an infinite shape.
    pub(crate) fn radius(&self) -> f64 {
        radius(&self.def.shape.bounds())
    }

    /// Moves a mesh whose vertices travel further than `most` (m) in the coming `dt` seconds to its target at once. True if it
    /// did.
    pub(crate) fn end_bending_where_it_jumps(&mut self, dt: f64, most: f64) -> bool {
        let Some(bending) = &mut self.bending else { return false };
        let left = if bending.duration > 0.0 { (bending.duration - bending.elapsed).max(0.0) } else { dt };
        let part = if left > dt { dt / bending.duration } else { 1.0 };
        let farthest = bending.from.iter().zip(&bending.to).map(|(from, to)| (to - from).norm_squared()).fold(0.0, f64::max);
        if left == 0.0 || farthest.sqrt() * part <= most {
            return false;
        }
        if left <= dt {
            bending.from.clone_from(&bending.to);
        }
        left <= dt
    }

    /// Advances its motion by the `h` seconds of a substep.
    pub fn finish(&mut self, h: f64) {
        self.motion.advance(h);
        self.def.pose = self.motion.pose;
        if let Some(bending) = &mut self.bending {
            bending.elapsed += h;
            if bending.elapsed >= bending.duration * (1.0 - 1e-12) {
                bending.elapsed = bending.duration;
            }
        }
    }

    /// Bytes on the heap, without the shape's.
    pub fn heap_bytes(&self) -> usize {
        let of = |bending: &Bending| (bending.from.capacity() + bending.to.capacity()) * size_of::<Vector3<f64>>();
        self.bending.as_deref().map_or(0, |bending| size_of::<Bending>() + of(bending))
    }
}

pub(crate) fn check_pose(argument: impl std::fmt::Display, pose: &Frame) -> Result<()> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}.origin[{axis}]"), pose.origin[axis])?;
    }
    for (axis, value) in pose.rotation_xyzw().iter().enumerate() {
        check_finite(|| format!("{argument}.rotation[{axis}]"), *value)?;
    }
    Ok(())
}

fn radius(bounds: &Bounds) -> f64 {
    let corners = || bounds.corners().map(|corner| corner.norm()).into_iter().fold(0.0, f64::max);
    if bounds.low.x.is_finite() { corners() } else { 0.0 }
}

/// A body during a substep.
#[derive(Debug, Clone, Copy)]
pub struct BodyAt<'a> {
    /// Its index in the solver.
    pub index: u32,
    /// Its shape; a deforming mesh with its vertices at the substep's start and end.
    pub shape: &'a Shape,
    /// Pose at the substep's start.
    pub start: Frame,
    /// Pose at its end.
    pub end: Frame,
    /// How far outside its shape the surface lies, m.
    pub thickness: f64,
    /// Multiplies the strands' Coulomb friction.
    pub friction: f64,
    /// Multiplies the strands' viscous friction.
    pub viscous_friction: f64,
    /// Groups that it is in.
    pub group: u32,
    /// Groups with which it collides.
    pub mask: u32,
    /// A box around the shape (without its thickness) during the substep, world.
    pub bounds: Bounds,
    /// The angle by which it turns, rad.
    pub turn: f64,
    /// The largest distance of its shape from its pose's origin, m; 0 for an infinite shape.
    pub radius: f64,
    pub(super) axes_start: Matrix3<f64>,
    pub(super) axes_end: Matrix3<f64>,
}

impl<'a> BodyAt<'a> {
    /// A body that moves from pose to pose.
    pub fn new(index: u32, shape: &'a Shape, start: Frame, end: Frame, thickness: f64) -> Self {
        let (axes_start, axes_end) = (*start.rotation.to_rotation_matrix().matrix(), *end.rotation.to_rotation_matrix().matrix());
        let turn = rotation_vector(&(start.rotation.inverse() * end.rotation)).norm();
        let local = shape.bounds();
        let (bounds, radius) = if local.low.x.is_finite() {
            let corners = local.corners();
            let radius = corners.iter().map(|corner| corner.norm_squared()).fold(0.0, f64::max).sqrt();
            let place =
                |frame: &Frame, axes: &Matrix3<f64>| Bounds::of_points(corners.map(|corner| frame.origin + axes * corner));
            // A point that turns by an angle φ about the pose's origin leaves its chord by at most r (1 − cos φ/2) ≤ r φ²/8.
            let bounds = place(&start, &axes_start).union(&place(&end, &axes_end));
            (bounds.grown(radius * (0.125 * turn * turn).min(1.0)), radius)
        } else {
            (local, 0.0)
        };
        let (friction, viscous_friction, group, mask) = (1.0, 1.0, 1, u32::MAX);
        Self {
            index,
            shape,
            start,
            end,
            thickness,
            friction,
            viscous_friction,
            group,
            mask,
            bounds,
            turn,
            radius,
            axes_start,
            axes_end,
        }
    }

    /// The same with another motion.
    pub fn with_motion(&self, [start, end]: [Frame; 2]) -> Self {
        let Self { friction, viscous_friction, group, mask, .. } = *self;
        Self { friction, viscous_friction, group, mask, ..Self::new(self.index, self.shape, start, end, self.thickness) }
    }

    /// Half of the shape's least extent, m: a strand passed at once by more shows no trace of it.
    pub fn half_extent(&self) -> f64 {
        let bounds = self.shape.bounds();
        0.5 * (bounds.high - bounds.low).min() + self.thickness
    }

    /// Its surface nearest to a point of the world at the substep's end, see [`Shape::closest`].
    pub fn closest_at_end(&self, at: Vector3<f64>, within: f64) -> Option<Surface> {
        self.shape.closest(self.axes_end.tr_mul(&(at - self.end.origin)), within)
    }

    /// The same, or else a distance (m) that the surface surely has from the point.
    #[inline]
    pub(super) fn closest_or_least_at_end(&self, at: Vector3<f64>, within: f64) -> std::result::Result<Surface, f64> {
        self.shape.closest_or_least(self.axes_end.tr_mul(&(at - self.end.origin)), within)
    }

    /// Its surface nearest to a point of the world when the substep began, see [`Shape::closest`]; a mesh that deforms is taken as it is at
    /// the end.
    pub(super) fn closest_at_start(&self, at: Vector3<f64>, within: f64) -> Option<Surface> {
        self.shape.closest(self.axes_start.tr_mul(&(at - self.start.origin)), within)
    }

    /// The depth of a point of the world in the body when the substep began, m, if it is no more than `within`; a mesh that
    /// deforms is taken as it is at the end.
    pub fn depth_at_start(&self, at: Vector3<f64>, within: f64) -> f64 {
        self.closest_at_start(at, within).map_or(0.0, |surface| self.thickness - surface.distance)
    }

    /// Whether it is a mesh whose vertices move in the substep.
    pub fn deforms(&self) -> bool {
        self.shape.mesh().is_some_and(Mesh::is_moving)
    }

    /// A direction of the body's own axes at the substep's end, world.
    pub fn to_world(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.axes_end * direction
    }

    /// The position of a point of its surface at the substep's end, world.
    pub fn surface_at_end(&self, surface: &Surface) -> Vector3<f64> {
        self.end.origin + self.axes_end * surface.point
    }

    /// Whether its surface may be in a box of the world in the substep.
    pub fn is_near(&self, around: &Bounds) -> bool {
        self.bounds.grown(self.thickness).meets(around)
    }

    /// Whether it collides with something of these groups and this mask.
    pub fn meets(&self, group: u32, mask: u32) -> bool {
        self.group & mask != 0 && group & self.mask != 0
    }

    /// Whether all that moves straight (in the body's axes) within a box of the world stays further than `margin` (m) from the
    /// shape. False where that is not plain at once. `slack` (m): how far such paths may leave the box.
    pub(super) fn is_clear_of(&self, region: &Bounds, margin: f64, slack: f64) -> bool {
        match self.shape.plane() {
            Some(normal) => {
                let (middle, half) = (0.5 * (region.low + region.high), 0.5 * (region.high - region.low));
                [(&self.start, &self.axes_start), (&self.end, &self.axes_end)].into_iter().all(|(frame, axes)| {
                    let normal = axes * normal;
                    normal.dot(&(middle - frame.origin)) - normal.abs().dot(&half) > margin
                })
            }
            None => !region.meets(&self.bounds.grown(margin + slack)),
        }
    }

    /// Displacement of the body's material point at a point of its surface during the substep, world, m.
    pub fn carried(&self, surface: &Surface) -> Vector3<f64> {
        let mut before = surface.point;
        if let Some(mesh) = self.shape.mesh()
            && mesh.is_moving()
        {
            let (start, end) = (mesh.corners_before(surface.feature), mesh.corners(surface.feature));
            for corner in 0..3 {
                before += (start[corner] - end[corner]) * surface.weights[corner];
            }
        }
        (self.end.origin - self.start.origin) + self.axes_end * surface.point - self.axes_start * before
    }
}
