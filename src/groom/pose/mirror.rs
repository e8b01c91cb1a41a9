//! Mirrors strands across a plane.
//!
//! With the reflection M and S = diag(1, 1, −1) the frame R becomes M R S, which is proper: n0 and n1 are mirrored, and n2 is
//! reversed. `R′ = R [κ]×` then gives the curvatures −Sκ = (−κ0, −κ1, κ2): a curl winds the other way.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::StrandShape;
use crate::error::{Error, Result, check_finite};
use crate::math::frame::Frame;
use crate::rod::definition::StrandDef;

/// A plane in space.
///
/// ```
/// use superhelix::editing::Plane;
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let images = solver.add_mirrored(&ids, &Plane::new(Vector3::zeros(), Vector3::x())?)?;
/// assert_eq!((images.len(), solver.strand_count()), (1, 2));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    point: Vector3<f64>,
    normal: Vector3<f64>,
}

impl Plane {
    /// The plane through a point (m) with a normal of any length above zero.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number that is not finite or a normal without direction.
    pub fn new(point: Vector3<f64>, normal: Vector3<f64>) -> Result<Self> {
        for axis in 0..3 {
            check_finite(|| format!("point[{axis}]"), point[axis])?;
            check_finite(|| format!("normal[{axis}]"), normal[axis])?;
        }
        // Scaled by its largest number first: squares of tiny or huge numbers are lost.
        let largest = normal.amax();
        if largest == 0.0 {
            return Err(Error::invalid("normal", format!("{:?}", normal.as_slice()), "a vector with a direction"));
        }
        Ok(Self { point, normal: (normal / largest).normalize() })
    }

    /// The image of a direction.
    pub fn direction(&self, direction: Vector3<f64>) -> Vector3<f64> {
        direction - self.normal * (2.0 * self.normal.dot(&direction))
    }

    /// The image of a point.
    pub fn position(&self, position: Vector3<f64>) -> Vector3<f64> {
        position - self.normal * (2.0 * self.normal.dot(&(position - self.point)))
    }

    /// The image of an angular velocity: it turns in the opposite sense about the image of its axis.
    pub fn spin(&self, spin: Vector3<f64>) -> Vector3<f64> {
        -self.direction(spin)
    }

    /// The image of a frame, with n2 reversed so that it is proper.
    pub fn frame(&self, frame: &Frame) -> Frame {
        // −M is half a turn about the normal, −S half a turn about the third axis.
        let half_turn = |axis: Vector3<f64>| Quaternion::from_parts(0.0, axis);
        let rotation = half_turn(self.normal) * frame.rotation.quaternion() * half_turn(Vector3::z());
        Frame { origin: self.position(frame.origin), rotation: UnitQuaternion::new_unchecked(rotation) }
    }
}

/// A row of curvatures, or of their rates, of a mirrored strand.
pub fn mirrored([twist, bend1, bend2]: [f64; 3]) -> [f64; 3] {
    // Not −0: a straight strand stays the same to the bit.
    [0.0 - twist, 0.0 - bend1, bend2]
}

impl StrandShape {
    /// The strand's image in a mirror: curls wind the other way.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a shape that cannot be used.
    pub fn mirrored(&self, plane: &Plane) -> Result<Self> {
        self.check("shape")?;
        Ok(Self {
            root: plane.frame(&self.root),
            element_lengths: self.element_lengths.clone(),
            curvatures: self.curvatures.iter().copied().map(mirrored).collect(),
        })
    }
}

impl StrandDef {
    /// The mirrored definition of a strand: natural and initial shape, rates and velocities are mirrored as well.
    #[must_use]
    pub fn mirrored(&self, plane: &Plane) -> Self {
        let rows = |rows: &[[f64; 3]]| rows.iter().copied().map(mirrored).collect::<Vec<_>>();
        Self {
            root: plane.frame(&self.root),
            natural: rows(&self.natural),
            initial: self.initial.as_deref().map(rows),
            initial_rates: self.initial_rates.as_deref().map(rows),
            root_velocity: plane.direction(self.root_velocity),
            root_angular_velocity: plane.spin(self.root_angular_velocity),
            ..self.clone()
        }
    }
}
