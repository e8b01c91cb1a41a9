//! What was recorded of a strand: a number over time, what it is a measure of, and how the root moved meanwhile.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_not_negative};
use crate::math::frame::Frame;
use crate::math::splines::point_spline::PointSpline;
use crate::math::splines::pose_spline::PoseSpline;

/// What a recorded number says about the strand. c is the chord from root to tip, ĝ the direction of gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Observable {
    /// |c|: the distance from root to tip, m.
    Span,
    /// c·ĝ: how far the tip hangs below the root, m.
    Depth,
    /// c·d: how far the tip is from the root along the direction d (of any length above zero), m.
    Offset(Vector3<f64>),
    /// The angle of the chord against ĝ, towards d, rad, −π to π: atan2(c·d, c·ĝ). Of d only what is across gravity counts.
    Angle(Vector3<f64>),
}

impl Observable {
    /// The number for a chord (m), or why there is none: `down` is ĝ, if there is gravity.
    pub(super) fn measure(self, down: Option<Vector3<f64>>) -> Result<impl Fn(Vector3<f64>) -> f64> {
        let need_down = || {
            down.ok_or_else(|| {
                Error::invalid("options.solver.gravity", "zero", "gravity, which a depth or an angle is measured by")
            })
        };
        let (along, down, kind) = match self {
            Observable::Span => (Vector3::zeros(), Vector3::zeros(), 0),
            Observable::Depth => (Vector3::zeros(), need_down()?, 1),
            Observable::Offset(direction) => (unit("recording.direction", direction)?, Vector3::zeros(), 2),
            Observable::Angle(direction) => {
                let (down, direction) = (need_down()?, unit("recording.direction", direction)?);
                let across = direction - down * down.dot(&direction);
                if across.norm() < 1e-6 {
                    let shown = format!("{:?}", direction.as_slice());
                    return Err(Error::invalid("recording.direction", shown, "a direction that is not gravity's own"));
                }
                (across.normalize(), down, 3)
            }
        };
        Ok(move |chord: Vector3<f64>| match kind {
            0 => chord.norm(),
            1 => chord.dot(&down),
            2 => chord.dot(&along),
            _ => chord.dot(&along).atan2(chord.dot(&down)),
        })
    }
}

/// A recorded curve.
///
/// ```
/// use superhelix::experiments::{Observable, Recording, RootMotion};
///
/// let times: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
/// let values = times.iter().map(|t| 0.1 * (-t).exp() * (20.0 * t).cos()).collect();
/// let recording = Recording { times, values, observable: Observable::Span };
/// recording.check("recording")?;
/// let motion = RootMotion::Oscillation { amplitude: 0.01, frequency: 2.0, phase: 0.0, direction: None };
/// # drop(motion);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Times, s: finite, strictly increasing.
    pub times: Vec<f64>,
    /// As many numbers, in the unit of the observable.
    pub values: Vec<f64>,
    /// What the numbers are.
    pub observable: Observable,
}

impl Recording {
    /// Checks times and values; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for counts that differ, a number that is not finite, or times that do not increase.
    pub fn check(&self, argument: &str) -> Result<()> {
        let (times, values) = (&self.times, &self.values);
        if times.len() != values.len() {
            let expected = format!("{}, one a time", times.len());
            return Err(Error::invalid(format!("{argument}.values (count)"), values.len(), expected));
        }
        for (index, (time, value)) in times.iter().zip(values).enumerate() {
            check_finite(|| format!("{argument}.times[{index}]"), *time)?;
            check_finite(|| format!("{argument}.values[{index}]"), *value)?;
            if index > 0 && *time <= times[index - 1] {
                let expected = format!("more than {}, the one before", times[index - 1]);
                return Err(Error::invalid(format!("{argument}.times[{index}]"), time, expected));
            }
        }
        Ok(())
    }
}

/// How the root moved while the curve was recorded.
#[derive(Debug, Clone, PartialEq)]
pub enum RootMotion {
    /// Not at all: it is where the strand's definition has it.
    Still,
    /// About the pose of the definition, which keeps its rotation: r(t) = r + d̂ a sin(2π f t + φ).
    Oscillation {
        /// a, m.
        amplitude: f64,
        /// f, Hz; above zero.
        frequency: f64,
        /// φ, rad.
        phase: f64,
        /// d, of any length above zero; `None`: up, against gravity.
        direction: Option<Vector3<f64>>,
    },
    /// Through recorded poses, which replace that of the definition; held before the first and after the last. The rotation is the
    /// spline's; the position is the cubic spline with continuous acceleration ([`PointSpline`]) through the same points, because
    /// jumps of the acceleration would shake the strand: with 15 samples a period they shift a fitted viscosity by 11 %.
    Recorded(PoseSpline),
}

/// A root motion with everything found out that it needs.
pub(super) enum RootWay<'a> {
    Still(Frame),
    Oscillation { rest: Frame, swing: Vector3<f64>, frequency: f64, phase: f64 },
    Recorded { poses: &'a PoseSpline, points: PointSpline },
}

impl RootMotion {
    /// Checks the motion; `rest` is the definition's pose, `down` the direction of gravity if there is any.
    pub(super) fn way(&self, rest: Frame, down: Option<Vector3<f64>>) -> Result<RootWay<'_>> {
        Ok(match self {
            RootMotion::Still => RootWay::Still(rest),
            RootMotion::Recorded(poses) => {
                let points = poses.frames().iter().map(|frame| frame.origin).collect();
                RootWay::Recorded { poses, points: PointSpline::through(poses.times().to_vec(), points) }
            }
            RootMotion::Oscillation { amplitude, frequency, phase, direction } => {
                check_finite(|| "motion.amplitude".into(), *amplitude)?;
                check_not_negative(|| "motion.frequency".into(), *frequency)?;
                if *frequency == 0.0 {
                    return Err(Error::invalid("motion.frequency", frequency, "a frequency above zero (Hz)"));
                }
                check_finite(|| "motion.phase".into(), *phase)?;
                let up = match (direction, down) {
                    (Some(direction), _) => unit("motion.direction", *direction)?,
                    (None, Some(down)) => -down,
                    (None, None) => {
                        return Err(Error::invalid("motion.direction", "none", "a direction, since no gravity says what is up"));
                    }
                };
                RootWay::Oscillation { rest, swing: up * *amplitude, frequency: *frequency, phase: *phase }
            }
        })
    }
}

impl RootWay<'_> {
    /// The root's pose at a time.
    pub fn at(&self, time: f64) -> Frame {
        match self {
            RootWay::Still(frame) => *frame,
            RootWay::Oscillation { rest, swing, frequency, phase } => {
                let angle = TAU * frequency * time + phase;
                Frame { origin: rest.origin + swing * angle.sin(), rotation: rest.rotation }
            }
            RootWay::Recorded { poses, points } => Frame { origin: points.at(time), rotation: poses.at(time).rotation },
        }
    }

    /// Velocity (m/s) and angular velocity (rad/s) at a time, world axes.
    pub fn velocity(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            RootWay::Still(_) => (Vector3::zeros(), Vector3::zeros()),
            RootWay::Oscillation { swing, frequency, phase, .. } => {
                let rate = TAU * frequency;
                (swing * (rate * (rate * time + phase).cos()), Vector3::zeros())
            }
            RootWay::Recorded { poses, points } => (points.velocity(time), poses.velocity(time).1),
        }
    }
}

/// The direction of a vector that has one.
fn unit(argument: &str, direction: Vector3<f64>) -> Result<Vector3<f64>> {
    direction
        .try_normalize(0.0)
        .filter(|unit| unit.iter().all(|x| x.is_finite()))
        .ok_or_else(|| Error::invalid(argument, format!("{:?}", direction.as_slice()), "three finite numbers, not all zero"))
}
