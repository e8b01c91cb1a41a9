//! Springs on places of a strand during posing.

use crate::math::functions::entire::Stumpff;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::ElementState;
use crate::rod::segment;

/// A spring at a place of an element, in the axes of the element's left end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spring {
    pub element: usize,
    /// Arclength from the element's left end.
    pub s: f64,
    pub c: Stumpff<f64>,
    /// The place.
    pub local: Vec3<f64>,
    /// Its variation by δκ.
    pub jacobian: Mat3<f64>,
    pub stiffness: Mat3<f64>,
    pub force: Vec3<f64>,
    /// Holds the direction of the strand there.
    pub turning: Option<Turning>,
}

/// A spring against rotation, in the same axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning {
    /// Rotation of the frame there by δκ.
    pub psi: Mat3<f64>,
    pub stiffness: Mat3<f64>,
    pub moment: Vec3<f64>,
}

impl Spring {
    /// A place without a spring.
    pub fn at(element: &ElementState<f64>, index: usize, s: f64) -> Self {
        let point = element.point(s);
        let (theta, z) = (element.kappa.scale(s), element.kappa_squared * (s * s));
        Self {
            element: index,
            s,
            c: point.c,
            local: point.local,
            jacobian: segment::chord_gradient(theta, z, &point.c).scale(s * s),
            stiffness: Mat3::zero(),
            force: Vec3::zero(),
            turning: None,
        }
    }

    /// With a pull by `off` (world axes) of a stiffness.
    pub fn pulled(mut self, element: &ElementState<f64>, off: Vec3<f64>, stiffness: f64) -> Self {
        self.stiffness = Mat3::identity().scale(stiffness);
        self.force = element.frame_left.apply_transposed(off).scale(stiffness);
        self
    }

    /// With a push along a unit normal (world axes) by `depth`, of a stiffness.
    pub fn pushed(mut self, element: &ElementState<f64>, normal: Vec3<f64>, depth: f64, stiffness: f64) -> Self {
        let n = element.frame_left.apply_transposed(normal);
        for i in 0..3 {
            for j in 0..3 {
                self.stiffness.0[i][j] = stiffness * n.0[i] * n.0[j];
            }
        }
        self.force = n.scale(stiffness * depth);
        self
    }

    /// With a turn towards a direction (a unit vector, world axes); returns the angle to it as well.
    pub fn turned(mut self, element: &ElementState<f64>, direction: Vec3<f64>, stiffness: f64) -> (Self, f64) {
        let (theta, z) = (element.kappa.scale(self.s), element.kappa_squared * (self.s * self.s));
        let tangent = segment::frame(theta, z, &self.c).column(0);
        let wanted = element.frame_left.apply_transposed(direction);
        let axis = tangent.cross(wanted);
        let (sine, cosine) = (axis.norm_squared().sqrt(), tangent.dot(wanted));
        let angle = sine.atan2(cosine);
        // Opposite to the target any transverse axis is as good: n1.
        let axis = if sine > 1e-9 {
            axis.scale(angle / sine)
        } else if cosine < 0.0 {
            segment::frame(theta, z, &self.c).column(1).scale(angle)
        } else {
            axis
        };
        let mut across = Mat3::identity().scale(stiffness);
        for i in 0..3 {
            for j in 0..3 {
                across.0[i][j] -= stiffness * tangent.0[i] * tangent.0[j];
            }
        }
        self.turning = Some(Turning {
            psi: segment::mean_frame(theta, z, &self.c).scale(self.s),
            stiffness: across,
            moment: axis.scale(stiffness),
        });
        (self, angle)
    }
}
