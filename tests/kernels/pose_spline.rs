//! The smooth motion through poses: exact at samples, continuous in velocity, exact for steady motion, of the promised order.

use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use superhelix::splines::PoseSpline;
use superhelix::{Error, Frame};

fn frame(origin: [f64; 3], turn: [f64; 3]) -> Frame {
    Frame { origin: Vector3::from(origin), rotation: UnitQuaternion::new(Vector3::from(turn)) }
}

/// Samples with uneven times and turns of up to 2.6 rad between them.
fn wild() -> PoseSpline {
    let times = vec![-1.0, -0.9, 0.2, 0.5, 1.7, 1.75, 3.0];
    let frames = (0..times.len())
        .map(|index| {
            let x = index as f64;
            frame([x.sin(), (2.0 * x).cos(), 0.3 * x * x], [1.5 * (1.1 * x).sin(), 1.9 * (0.7 * x).cos(), 0.4 * x])
        })
        .collect();
    PoseSpline::new(times, frames).unwrap()
}

#[test]
fn samples_are_met_exactly_and_ends_are_held() {
    let spline = wild();
    for (time, frame) in spline.times().iter().zip(spline.frames()) {
        assert_eq!(spline.at(*time), *frame);
    }
    let (first, last) = (spline.frames()[0], spline.frames()[6]);
    for time in [-1.0 - 1e-12, -1e300, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(spline.at(time), first);
        assert_eq!(spline.velocity(time), (Vector3::zeros(), Vector3::zeros()));
    }
    for time in [3.0 + 1e-12, 1e300, f64::INFINITY] {
        assert_eq!(spline.at(time), last);
        assert_eq!(spline.velocity(time), (Vector3::zeros(), Vector3::zeros()));
    }
    assert_eq!(spline.duration(), 4.0);
}

#[test]
fn pose_and_velocity_are_continuous_at_samples() {
    let spline = wild();
    for time in &spline.times()[1..6] {
        let (before, after) = (time - 1e-10, time + 1e-10);
        let (a, b) = (spline.at(before), spline.at(after));
        // Velocities are below 200 and accelerations below 5000 in these samples.
        assert!((a.origin - b.origin).norm() < 4e-8 && a.rotation.angle_to(&b.rotation) < 4e-8);
        let ((va, wa), (vb, wb)) = (spline.velocity(before), spline.velocity(after));
        assert!((va - vb).norm() < 1e-6 && (wa - wb).norm() < 1e-6, "{time}: {va} {vb} {wa} {wb}");
    }
}

#[test]
fn velocity_is_the_derivative_of_the_pose() {
    let spline = wild();
    let h = 1e-6;
    for step in 1..400 {
        let time = -1.0 + 0.01 * f64::from(step);
        if spline.times().iter().any(|sample| (sample - time).abs() < 2.0 * h) {
            continue;
        }
        let (a, b) = (spline.at(time - h), spline.at(time + h));
        let (linear, angular) = spline.velocity(time);
        let scale = 1.0 + linear.norm() + angular.norm();
        assert!(((b.origin - a.origin) / (2.0 * h) - linear).norm() < 1e-7 * scale, "{time}");
        let turn = (b.rotation * a.rotation.inverse()).scaled_axis() / (2.0 * h);
        assert!((turn - angular).norm() < 1e-7 * scale, "{time}: {turn} {angular}");
    }
}

#[test]
fn steady_motion_is_reproduced() {
    // Uneven times; a steady spin of up to 3 rad between samples about an oblique axis, and a parabola in space.
    let axis = Vector3::new(0.6, -0.48, 0.64);
    let start = UnitQuaternion::new(Vector3::new(0.3, 1.0, -2.0));
    let exact = |time: f64| Frame {
        origin: Vector3::new(1.0, 2.0, 3.0) + Vector3::new(-1.0, 0.5, 2.0) * time + Vector3::new(0.2, 0.1, -0.7) * (time * time),
        rotation: UnitQuaternion::new(axis * (1.5 * time)) * start,
    };
    for times in [vec![0.0, 0.1, 0.5, 2.5, 2.6, 4.0], vec![-1.0, 0.0, 2.0]] {
        let spline = PoseSpline::new(times.clone(), times.iter().map(|time| exact(*time)).collect()).unwrap();
        for step in 0..=500 {
            let time = times[0] + spline.duration() * f64::from(step) / 500.0;
            let (found, wanted) = (spline.at(time), exact(time));
            assert!((found.origin - wanted.origin).norm() < 1e-13, "{time}");
            assert!(found.rotation.angle_to(&wanted.rotation) < 1e-13, "{time}");
            let (linear, angular) = spline.velocity(time);
            let slope = Vector3::new(-1.0, 0.5, 2.0) + Vector3::new(0.4, 0.2, -1.4) * time;
            assert!((linear - slope).norm() < 1e-12, "{time} {linear}");
            assert!((angular - axis * 1.5).norm() < 1e-12, "{time} {angular}");
        }
    }
    // Two samples: a screw at constant rates.
    let spline =
        PoseSpline::new(vec![0.0, 2.0], vec![frame([0.0; 3], [0.0; 3]), frame([2.0, 0.0, 0.0], [3.0, 0.0, 0.0])]).unwrap();
    assert!((spline.at(0.5).rotation.scaled_axis() - Vector3::new(0.75, 0.0, 0.0)).norm() < 1e-14);
    assert_eq!(spline.at(0.5).origin, Vector3::new(0.5, 0.0, 0.0));
    assert!((spline.velocity(2.0).1 - Vector3::new(1.5, 0.0, 0.0)).norm() < 1e-14);
    // One sample: a pose that holds still.
    let still = PoseSpline::new(vec![5.0], vec![frame([1.0; 3], [1.0; 3])]).unwrap();
    assert_eq!((still.at(0.0), still.at(9.0), still.duration()), (still.frames()[0], still.frames()[0], 0.0));
    assert_eq!(still.velocity(5.0), (Vector3::zeros(), Vector3::zeros()));
}

/// Largest errors in position and rotation against a smooth motion sampled `count` times.
fn error(count: usize) -> (f64, f64) {
    let exact = |time: f64| Frame {
        origin: Vector3::new((3.0 * time).sin(), (2.0 * time).cos(), time.exp()),
        rotation: UnitQuaternion::new(Vector3::z() * (1.2 * (2.0 * time).sin()))
            * UnitQuaternion::new(Vector3::y() * (0.9 * (3.0 * time).cos()))
            * UnitQuaternion::new(Vector3::x() * (2.0 * time)),
    };
    let times: Vec<f64> = (0..count).map(|index| 2.0 * index as f64 / (count - 1) as f64).collect();
    let spline = PoseSpline::new(times.clone(), times.iter().map(|time| exact(*time)).collect()).unwrap();
    (0..2000).map(|step| 0.001 * f64::from(step)).fold((0.0, 0.0), |(position, angle): (f64, f64), time| {
        let (found, wanted) = (spline.at(time), exact(time));
        (position.max((found.origin - wanted.origin).norm()), angle.max(found.rotation.angle_to(&wanted.rotation)))
    })
}

#[test]
fn smooth_motion_is_approached_at_third_order() {
    let (coarse, fine) = (error(65), error(129));
    for (coarse, fine) in [(coarse.0, fine.0), (coarse.1, fine.1)] {
        let order = (coarse / fine).log2();
        assert!(order > 2.8 && fine < 2e-5, "order {order}, error {fine}");
    }
}

#[test]
fn bad_samples_are_refused() {
    let good = frame([0.0; 3], [0.0; 3]);
    let bad = Frame { origin: Vector3::new(0.0, f64::NAN, 0.0), ..good };
    let far = Frame { origin: Vector3::new(1e308, 0.0, 0.0), ..good };
    let opposite = Frame { origin: Vector3::new(-1e308, 0.0, 0.0), ..good };
    for (times, frames, said) in [
        (vec![], vec![], "times"),
        (vec![0.0, 1.0], vec![good], "frames"),
        (vec![0.0, 0.0], vec![good; 2], "times[1]"),
        (vec![1.0, 0.0], vec![good; 2], "times[1]"),
        (vec![0.0, f64::NAN], vec![good; 2], "times[1]"),
        (vec![f64::NEG_INFINITY, 0.0], vec![good; 2], "times[0]"),
        (vec![0.0, 1.0], vec![good, bad], "frames[1].origin[1]"),
        (vec![0.0, 1.0], vec![far, opposite], "frames[0]"),
        (vec![0.0, 1e-320, 1.0], vec![good, frame([1.0; 3], [0.0; 3]), good], "frames[0]"),
    ] {
        let result = PoseSpline::new(times, frames);
        assert!(matches!(&result, Err(Error::InvalidArgument { argument, .. }) if argument == said), "{said}: {result:?}");
    }
}

proptest! {
    /// Any samples, half turns and doubled poses among them: every pose is finite and a rotation to rounding.
    #[test]
    fn poses_are_orthonormal(
        samples in prop::collection::vec((1e-6..1.0_f64, prop::array::uniform3(-1.0..1.0_f64), prop::array::uniform3(-4.0..4.0_f64), any::<bool>()), 1..12),
        fractions in prop::collection::vec(-0.1..1.1_f64, 8),
    ) {
        let mut time = 0.0;
        let mut times = Vec::new();
        let mut frames: Vec<Frame> = Vec::new();
        for (step, origin, turn, half_turn) in samples {
            time += step;
            times.push(time);
            let rotation = match frames.last() {
                Some(before) if half_turn => before.rotation * UnitQuaternion::new(Vector3::from(turn).normalize() * std::f64::consts::PI),
                _ => UnitQuaternion::new(Vector3::from(turn)),
            };
            frames.push(Frame { origin: Vector3::from(origin), rotation });
        }
        let spline = PoseSpline::new(times, frames).unwrap();
        for fraction in fractions {
            let time = spline.times()[0] + fraction * spline.duration();
            let pose = spline.at(time);
            let matrix = pose.rotation.to_rotation_matrix().into_inner();
            prop_assert!((matrix.transpose() * matrix - nalgebra::Matrix3::identity()).amax() < 1e-14);
            let (linear, angular) = spline.velocity(time);
            prop_assert!(pose.origin.iter().chain(&linear).chain(&angular).all(|value| value.is_finite()));
        }
    }
}
