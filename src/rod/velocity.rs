//! Velocities and velocity-product accelerations along a strand from the rates of its curvatures (`docs/theory/mathematics.md`).

use super::kinematics::{ElementState, Kinematics};
use super::segment;
use crate::math::functions::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// How the root moves: linear and angular velocity, linear and angular acceleration, world axes.
#[derive(Debug, Clone, Copy)]
pub struct RootMotion<T = f64> {
    /// m/s.
    pub velocity: Vec3<T>,
    /// rad/s.
    pub angular_velocity: Vec3<T>,
    /// m/s².
    pub acceleration: Vec3<T>,
    /// rad/s².
    pub angular_acceleration: Vec3<T>,
}

impl<T: Lane> RootMotion<T> {
    /// A root at rest.
    pub fn still() -> Self {
        let zero = Vec3::zero();
        Self { velocity: zero, angular_velocity: zero, acceleration: zero, angular_acceleration: zero }
    }
}

/// Velocity and acceleration (without q̈) of an element's left end, and the rates of its own frame.
#[derive(Clone, Copy)]
struct LeftEnd<T> {
    velocity: Vec3<T>,
    acceleration: Vec3<T>,
    omega: Vec3<T>,
    alpha: Vec3<T>,
}

impl<T: Lane> LeftEnd<T> {
    /// Velocity and acceleration of the element's point at arclength `s`.
    #[inline(always)]
    fn point(&self, element: &ElementState<T>, rate: Vec3<T>, s: T, c: &Stumpff<T>, local: Vec3<T>) -> (Vec3<T>, Vec3<T>) {
        let theta = element.kappa.scale(s);
        let z = element.kappa_squared * s * s;
        let rho = element.frame_left.apply(local);
        let moved = element.frame_left.apply(segment::chord_gradient(theta, z, c).apply(rate)).scale(s * s);
        let bent = element.frame_left.apply(segment::second_variation(element.kappa, rate, s, element.kappa_squared, c));
        let (omega, alpha) = (self.omega, self.alpha);
        let velocity = self.velocity + omega.cross(rho) + moved;
        let turning = omega.cross(omega.cross(rho)) + omega.cross(moved).scale(T::splat(2.0));
        (velocity, self.acceleration + alpha.cross(rho) + turning + bent)
    }
}

/// Calls `emit(point index, velocity, acceleration without q̈)` for every quadrature point, for curvature rates `rates`:
/// v = v_root + ω_root×r + J q̇, a = a_root + α_root×r + ω×(ω×r) + … + J̇ q̇, all of them relative to the world.
#[inline(always)]
pub fn for_each_point<T: Lane>(
    kinematics: &Kinematics<T>,
    rates: &[[T; 3]],
    root: &RootMotion<T>,
    mut emit: impl FnMut(usize, Vec3<T>, Vec3<T>),
) {
    let mut left = LeftEnd {
        velocity: root.velocity,
        acceleration: root.acceleration,
        omega: root.angular_velocity,
        alpha: root.angular_acceleration,
    };
    for (index, element) in kinematics.elements.iter().enumerate() {
        let rate = Vec3(rates[index]);
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let (velocity, acceleration) = left.point(element, rate, point.s, &point.c, point.local);
            emit(p, velocity, acceleration);
        }
        let (velocity, acceleration) = left.point(element, rate, element.length, &element.c, element.end);
        let theta = element.kappa.scale(element.length);
        let z = element.kappa_squared * element.length * element.length;
        let spin = element.frame_left.apply(segment::mean_frame(theta, z, &element.c).apply(rate)).scale(element.length);
        let turned = element.frame_left.apply(segment::second_rotation(
            element.kappa,
            rate,
            element.length,
            element.kappa_squared,
            &element.c,
        ));
        let alpha = left.alpha + left.omega.cross(spin) + turned;
        left = LeftEnd { velocity, acceleration, omega: left.omega + spin, alpha };
    }
}
