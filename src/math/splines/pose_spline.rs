//! A smooth rigid motion through sampled poses.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};
use crate::math::frame::Frame;
use crate::math::functions::entire::Stumpff;
use crate::math::rotation::{from_rotation_vector, rotation_vector};

/// A motion through poses at given times: continuous in velocity and angular velocity, exact at the samples, at rest before the
/// first and after the last.
///
/// Between two samples the position is the cubic with the samples' velocities at its ends, and the rotation vector relative to
/// the first of the two is a cubic likewise. The velocities at samples are those of the parabola through a sample and its two
/// neighbours; at the first and the last sample the parabola goes through the nearest three. A motion with constant velocity and
/// constant angular velocity is thus reproduced exactly, and a smooth one to third order in the sampling interval. The velocity
/// jumps where the motion begins or ends, unless the samples come to rest there.
///
/// Neighbouring samples must differ by less than half a turn: the motion takes the shorter of the two rotations.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSpline {
    times: Vec<f64>,
    frames: Vec<Frame>,
    /// Velocity (m/s, world) and angular velocity (rad/s, in the sample's own axes) at each sample.
    rates: Vec<(Vector3<f64>, Vector3<f64>)>,
}

impl PoseSpline {
    /// A motion through `frames` (m) at `times` (s). Quaternions are negated where that makes neighbours continuous.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when there is no sample, the counts differ, times are not finite and strictly increasing, a
    /// pose is not finite, or two samples are so far apart for their times that the velocity is not a finite number.
    pub fn new(times: Vec<f64>, mut frames: Vec<Frame>) -> Result<Self> {
        if times.is_empty() {
            return Err(Error::invalid("times", "empty", "at least one sample"));
        }
        if times.len() != frames.len() {
            return Err(Error::invalid("frames", format!("{} frames", frames.len()), format!("{}, one per time", times.len())));
        }
        for (index, time) in times.iter().enumerate() {
            check_finite(|| format!("times[{index}]"), *time)?;
            if index > 0 && *time <= times[index - 1] {
                return Err(Error::invalid(
                    format!("times[{index}]"),
                    time,
                    format!("more than {}, the one before", times[index - 1]),
                ));
            }
        }
        for (index, frame) in frames.iter().enumerate() {
            for (axis, value) in frame.origin.iter().enumerate() {
                check_finite(|| format!("frames[{index}].origin[{axis}]"), *value)?;
            }
            for (axis, value) in frame.rotation_xyzw().iter().enumerate() {
                check_finite(|| format!("frames[{index}].rotation[{axis}]"), *value)?;
            }
        }
        for index in 1..frames.len() {
            let before = frames[index - 1].rotation;
            let rotation = &mut frames[index].rotation;
            if before.coords.dot(&rotation.coords) < 0.0 {
                *rotation = UnitQuaternion::new_unchecked(-rotation.into_inner());
            }
        }
        let rates = rates(&times, &frames);
        if let Some(index) = rates.iter().position(|(linear, angular)| !(linear + angular).iter().all(|value| value.is_finite()))
        {
            return Err(Error::invalid(
                format!("frames[{index}]"),
                format!("{:?} at {} s", frames[index].origin.as_slice(), times[index]),
                "a finite velocity from and to its neighbours",
            ));
        }
        Ok(Self { times, frames, rates })
    }

    /// Times of the samples, s, strictly increasing.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Poses at the samples. Neighbouring quaternions have a dot product that is not negative.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// From the first sample to the last, s; 0 for a single sample.
    pub fn duration(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// The pose at a time (s): exactly a sample's at its time, constant before the first and after the last. NaN counts as before
    /// the first.
    pub fn at(&self, time: f64) -> Frame {
        let Some(span) = self.span(time) else {
            return if time >= self.times[0] { self.frames[self.frames.len() - 1] } else { self.frames[0] };
        };
        if span.fraction == 0.0 {
            return self.frames[span.index];
        }
        let (origin, turn) = (span.cubic(span.position_ends()), span.cubic(span.turn_ends()));
        Frame { origin: span.from.origin + origin, rotation: span.from.rotation * from_rotation_vector(turn) }
    }

    /// Velocity of the origin (m/s) and angular velocity (rad/s), both in world axes, at a time (s). Zero before the first sample
    /// and after the last; at these two, that of the motion between them. Zero for a single sample.
    pub fn velocity(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        let last = self.times.len() - 1;
        if last > 0 && time == self.times[last] {
            let (linear, angular) = &self.rates[last];
            return (*linear, self.frames[last].rotation * angular);
        }
        let Some(span) = self.span(time) else { return (Vector3::zeros(), Vector3::zeros()) };
        let (turn, rate) = (span.cubic(span.turn_ends()), span.cubic_rate(span.turn_ends()));
        let angular = right_jacobian(&turn) * rate;
        (span.cubic_rate(span.position_ends()), span.from.rotation * (from_rotation_vector(turn) * angular))
    }

    /// The interval that holds a time: from its first sample inclusive to the next exclusive. `None` outside.
    fn span(&self, time: f64) -> Option<Span<'_>> {
        let index = self.times.partition_point(|sample| *sample <= time).checked_sub(1)?;
        let step = self.times.get(index + 1)? - self.times[index];
        let fraction = (time - self.times[index]) / step;
        let (frames, rates) = (&self.frames, &self.rates);
        Some(Span {
            index,
            from: &frames[index],
            to: &frames[index + 1],
            rates: [&rates[index], &rates[index + 1]],
            step,
            fraction,
        })
    }

    /// The motion with `change` applied to every pose. The caller guarantees one and the same rigid change of axes, so that the
    /// checked properties still hold.
    pub(crate) fn map_frames(&self, change: impl Fn(&Frame) -> Frame) -> Self {
        let frames: Vec<Frame> = self.frames.iter().map(change).collect();
        let rates = rates(&self.times, &frames);
        Self { times: self.times.clone(), frames, rates }
    }
}

/// A stretch between two samples, and how far along it a time is.
struct Span<'a> {
    index: usize,
    from: &'a Frame,
    to: &'a Frame,
    rates: [&'a (Vector3<f64>, Vector3<f64>); 2],
    step: f64,
    fraction: f64,
}

impl Span<'_> {
    /// The end of the position cubic relative to its start, and its rates at both ends.
    fn position_ends(&self) -> [Vector3<f64>; 3] {
        [self.to.origin - self.from.origin, self.rates[0].0, self.rates[1].0]
    }

    /// The end of the rotation vector relative to the start, and its rates at both ends.
    fn turn_ends(&self) -> [Vector3<f64>; 3] {
        let turn = rotation_vector(&(self.from.rotation.inverse() * self.to.rotation));
        [turn, self.rates[0].1, inverse_right_jacobian(&turn) * self.rates[1].1]
    }

    /// The cubic from 0 to `end` with these rates at its ends.
    fn cubic(&self, [end, first, last]: [Vector3<f64>; 3]) -> Vector3<f64> {
        let u = self.fraction;
        end * (u * u * (3.0 - 2.0 * u)) + (first * ((1.0 - u) * (1.0 - u) * u) - last * (u * u * (1.0 - u))) * self.step
    }

    /// The rate of [`Span::cubic`].
    fn cubic_rate(&self, [end, first, last]: [Vector3<f64>; 3]) -> Vector3<f64> {
        let u = self.fraction;
        end * (6.0 * u * (1.0 - u) / self.step) + first * ((1.0 - u) * (1.0 - 3.0 * u)) + last * (u * (3.0 * u - 2.0))
    }
}

/// Velocities at the samples from the mean velocities between them: linear in time through the two nearest means, which equals
/// the parabola through three samples.
fn rates(times: &[f64], frames: &[Frame]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // The mean angular velocity has the same components in the axes of either sample, since the turn is about that axis.
    let means: Vec<_> = frames
        .windows(2)
        .zip(&steps)
        .map(|(pair, step)| {
            let turn = rotation_vector(&(pair[0].rotation.inverse() * pair[1].rotation));
            ((pair[1].origin - pair[0].origin) / *step, turn / *step)
        })
        .collect();
    let at = |sample: usize| match means.len() {
        0 => (Vector3::zeros(), Vector3::zeros()),
        1 => means[0],
        count => {
            // The intervals before and after the sample, or the two nearest to an end; and the sample's distance from the middle
            // of the first, in units of the distance between their middles.
            let first = sample.saturating_sub(1).min(count - 2);
            let (before, after) = (steps[first], steps[first + 1]);
            let offset = match sample {
                0 => -before,
                _ if sample == count => before + 2.0 * after,
                _ => before,
            };
            let weight = offset / (before + after);
            let blend = |a: Vector3<f64>, b: Vector3<f64>| a + (b - a) * weight;
            (blend(means[first].0, means[first + 1].0), blend(means[first].1, means[first + 1].1))
        }
    };
    (0..times.len()).map(at).collect()
}

/// The matrix that takes the rate of a rotation vector to the angular velocity in the turning axes.
pub(crate) fn right_jacobian(turn: &Vector3<f64>) -> Matrix3<f64> {
    let entire = Stumpff::at(turn.norm_squared());
    let cross = turn.cross_matrix();
    Matrix3::identity() - cross * entire.c2 + cross * cross * entire.c3
}

/// The inverse of [`right_jacobian`], for at most half a turn.
fn inverse_right_jacobian(turn: &Vector3<f64>) -> Matrix3<f64> {
    let entire = Stumpff::at(turn.norm_squared());
    let cross = turn.cross_matrix();
    // (1 - (x/2) cot(x/2)) / x^2 without its cancellation.
    Matrix3::identity() + cross * 0.5 - cross * cross * (entire.b() / (2.0 * entire.c2))
}
