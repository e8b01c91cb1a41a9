//! Bodies: shapes that strands stay outside of, with their poses and motions.

use std::sync::Arc;

use nalgebra::Vector3;

use super::body_at::BodyAt;
use super::shape::{Bounds, Mesh, Shape};
use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;
use crate::math::frame::pose_motion::PoseMotion;

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
