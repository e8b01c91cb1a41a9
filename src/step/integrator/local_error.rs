//! The error that one step adds to the positions of a strand's points, estimated from the step itself, world axes (Milne's
//! device; Hairer, Nørsett and Wanner 1993, section III.7).

use super::tableau::Tableau;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;
use crate::step::workspace::Workspace;

/// Backward differences against the parabola through the last two velocities, with ω = h/h₋. The formula errs by c h³r‴, c =
/// (1+ω)²/(6ω(1+2ω)), to one side, the parabola by (1/6 + 1/4ω) h³r‴ to the other.
#[inline(always)]
pub fn of_backward_differences<T: Lane>(ratio: T, offset: Vec3<T>, workspace: &Workspace<T>) -> T {
    let (one, six) = (T::one(), T::splat(6.0));
    let h = workspace.loaded.step;
    let formula = (one + ratio) * (one + ratio) / (six * ratio * (one + ratio + ratio));
    let parabola = T::splat(1.0 / 6.0) + one / (T::splat(4.0) * ratio);
    let fraction = formula / (formula + parabola);
    let bend = T::splat(0.5) * h * ratio;
    let mut worst = T::zero();
    for (p, point) in workspace.iterate.kinematics.points.iter().enumerate() {
        let (now, then) = (workspace.loaded.velocities[p], workspace.loaded.past_velocities[p]);
        let predicted = now.scale(h) + (now - then).scale(bend);
        let moved = (point.position - workspace.iterate.point_base[p]) + offset;
        worst = worst.larger((moved - predicted).norm_squared());
    }
    fraction * worst.sqrt()
}

/// Two stages against the third-order quadrature of the velocities at the start and at both stages; one stage (implicit Euler)
/// against the trapezoidal rule.
#[inline(always)]
pub fn of_stages<T: Lane>(tableau: &Tableau, workspace: &Workspace<T>) -> T {
    let c = tableau.times[0];
    let middle = 1.0 / (6.0 * c * (1.0 - c));
    let end = 0.5 - middle * c;
    let first = T::splat(1.0 - middle - end);
    let (middle, end) = (T::splat(middle - tableau.below[1][0]), T::splat(end - tableau.gamma));
    let mut worst = T::zero();
    for (p, start) in workspace.loaded.velocities.iter().enumerate() {
        let off = if tableau.stages == 1 {
            (*start - workspace.stages[0].velocities[p]).scale(T::splat(0.5))
        } else {
            let (one, two) = (workspace.stages[0].velocities[p], workspace.stages[1].velocities[p]);
            start.scale(first) + one.scale(middle) + two.scale(end)
        };
        worst = worst.larger(off.norm_squared());
    }
    workspace.loaded.step * worst.sqrt()
}
