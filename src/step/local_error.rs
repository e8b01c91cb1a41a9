//! The error that one step adds to the positions of a strand's points, told from the step itself (Milne's device; Hairer, Nørsett and
//! Wanner 1993, section III.7), in metres. Positions are relative to the root's origin at the step's start, world axes.

use super::tableau::Tableau;
use super::workspace::Workspace;
use crate::math::vector::Vec3;

/// Backward differences against the parabola through the last two velocities, ω = h/h₋: the formula errs by c h³r‴,
/// c = (1+ω)²/(6ω(1+2ω)), to one side, the parabola by (1/6 + 1/4ω) h³r‴ to the other.
pub fn of_backward_differences(
    ratio: f64,
    h: f64,
    velocities: &[Vec3<f64>],
    past_velocities: &[Vec3<f64>],
    offset: Vec3<f64>,
    workspace: &Workspace,
) -> f64 {
    let formula = (1.0 + ratio) * (1.0 + ratio) / (6.0 * ratio * (1.0 + 2.0 * ratio));
    let parabola = 1.0 / 6.0 + 1.0 / (4.0 * ratio);
    let share = formula / (formula + parabola);
    let bend = 0.5 * h * ratio;
    let mut worst = 0.0_f64;
    for (p, point) in workspace.kinematics.points.iter().enumerate() {
        let (now, then) = (velocities[p], past_velocities[p]);
        let predicted = workspace.base[p] + now.scale(h) + (now - then).scale(bend);
        worst = worst.max((point.position + offset - predicted).norm_squared());
    }
    share * worst.sqrt()
}

/// Two stages against the quadrature of order 3 on the velocities at the start and at both stages; one stage (implicit Euler) against
/// the trapezoid.
pub fn of_stages(tableau: &Tableau, h: f64, velocities: &[Vec3<f64>], workspace: &Workspace) -> f64 {
    let c = tableau.times[0];
    let mut worst = 0.0_f64;
    for (p, start) in velocities.iter().enumerate() {
        let off = if tableau.stages == 1 {
            (*start - workspace.stages[0].velocities[p]).scale(0.5)
        } else {
            let middle = 1.0 / (6.0 * c * (1.0 - c));
            let end = 0.5 - middle * c;
            let first = 1.0 - middle - end;
            let (one, two) = (workspace.stages[0].velocities[p], workspace.stages[1].velocities[p]);
            start.scale(first) + one.scale(middle - tableau.below[1][0]) + two.scale(end - tableau.gamma)
        };
        worst = worst.max(off.norm_squared());
    }
    h * worst.sqrt()
}
