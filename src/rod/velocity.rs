//! Velocities and velocity-product accelerations along a strand from the rates of its curvatures (`docs/mathematics.md`).

use super::kinematics::Kinematics;
use super::segment;
use crate::math::vector::Vec3;

/// How the root moves: linear and angular velocity, linear and angular acceleration, world axes.
#[derive(Debug, Clone, Copy)]
pub struct RootMotion {
    /// m/s.
    pub velocity: Vec3<f64>,
    /// rad/s.
    pub angular_velocity: Vec3<f64>,
    /// m/s².
    pub acceleration: Vec3<f64>,
    /// rad/s².
    pub angular_acceleration: Vec3<f64>,
}

impl RootMotion {
    /// A root that does not move.
    pub fn still() -> Self {
        let zero = Vec3::zero();
        Self { velocity: zero, angular_velocity: zero, acceleration: zero, angular_acceleration: zero }
    }
}

/// Calls `emit(point index, velocity, acceleration without q̈)` for every quadrature point, for curvature rates `rates`:
/// v = v_root + ω_root×r + J q̇, a = a_root + α_root×r + ω×(ω×r) + … + J̇ q̇, all of them relative to the world.
pub fn for_each_point(
    kinematics: &Kinematics<f64>,
    rates: &[[f64; 3]],
    root: &RootMotion,
    mut emit: impl FnMut(usize, Vec3<f64>, Vec3<f64>),
) {
    let (mut v_left, mut omega) = (root.velocity, root.angular_velocity);
    let (mut a_left, mut alpha) = (root.acceleration, root.angular_acceleration);
    for (index, element) in kinematics.elements.iter().enumerate() {
        let rate = Vec3(rates[index]);
        let at = |s: f64, c: &crate::math::entire::Stumpff<f64>, local: Vec3<f64>| {
            let theta = element.kappa.scale(s);
            let z = element.kappa_squared * s * s;
            let rho = element.frame_left.apply(local);
            let moved = element.frame_left.apply(segment::chord_gradient(theta, z, c).apply(rate)).scale(s * s);
            let bent = element.frame_left.apply(segment::second_variation(element.kappa, rate, s, element.kappa_squared, c));
            let velocity = v_left + omega.cross(rho) + moved;
            let acceleration = a_left + alpha.cross(rho) + omega.cross(omega.cross(rho)) + omega.cross(moved).scale(2.0) + bent;
            (velocity, acceleration)
        };
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let (velocity, acceleration) = at(point.s, &point.c, point.local);
            emit(p, velocity, acceleration);
        }
        let (velocity, acceleration) = at(element.length, &element.c, element.end);
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
        alpha = alpha + omega.cross(spin) + turned;
        omega += spin;
        (v_left, a_left) = (velocity, acceleration);
    }
}
