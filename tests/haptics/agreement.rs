//! How far two records of a force are apart.

use nalgebra::Vector3;

use super::scene::TICK;

pub type Forces = Vec<Vector3<f64>>;

pub fn rms(values: &[Vector3<f64>]) -> f64 {
    (values.iter().map(Vector3::norm_squared).sum::<f64>() / values.len() as f64).sqrt()
}

/// Rms of the difference of two forces' means over `ticks`, over that of the first.
pub fn difference(one: &Forces, other: &Forces, ticks: usize) -> f64 {
    let means = |forces: &Forces| -> Forces {
        forces.windows(ticks).map(|forces| forces.iter().sum::<Vector3<f64>>() / ticks as f64).collect()
    };
    let (one, other) = (means(one), means(other));
    let apart: Forces = one.iter().zip(&other).map(|(a, b)| a - b).collect();
    rms(&apart) / rms(&one)
}

/// The forces of a simulation's steps, drawn straight from one to the next, at each tick.
pub fn drawn(steps: &[(f64, Vector3<f64>)], ticks: usize) -> Forces {
    let at = |tick: usize| {
        let t = tick as f64 * TICK;
        let next = steps.partition_point(|(time, _)| *time <= t);
        if next == 0 || next == steps.len() {
            return steps[next.min(steps.len() - 1)].1;
        }
        let ((before, from), (after, to)) = (steps[next - 1], steps[next]);
        from.lerp(&to, (t - before) / (after - before))
    };
    (0..ticks).map(at).collect()
}
