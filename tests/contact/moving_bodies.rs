//! Bodies in motion.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::contact::body::Body;
use superhelix::{BodyDef, Frame, Shape};

fn sphere() -> BodyDef {
    BodyDef::new(Arc::new(Shape::new_sphere(0.1).unwrap()))
}

#[test]
fn a_body_arrives_where_it_was_sent_and_rests() {
    let mut body = Body::new(sphere()).unwrap();
    let target =
        Frame { origin: Vector3::new(0.3, 0.0, 0.1), rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.8, 0.1)) };
    body.move_to(target, 0.03).unwrap();
    let mut place = body.def().pose;
    for _ in 0..3 {
        body.begin(0.01);
        let at = body.at(0, 0.01);
        assert_eq!(at.start, place);
        // Its box contains the sphere throughout the motion.
        for u in [0.0, 0.3, 0.7, 1.0] {
            let centre = at.start.origin.lerp(&at.end.origin, u);
            assert!(at.bounds.holds(&(centre + Vector3::x() * 0.1)) && at.bounds.holds(&(centre - Vector3::z() * 0.1)));
        }
        place = at.end;
        body.finish(0.01);
    }
    assert_eq!(body.def().pose, target);
    body.begin(0.01);
    assert_eq!(body.at(0, 0.01).end, target);
    body.finish(0.01);
    assert_eq!(body.def().pose, target);
    // At once: within one substep.
    body.move_to(Frame::default(), 0.0).unwrap();
    body.begin(0.004);
    assert_eq!(body.at(0, 0.004).end, Frame::default());
    assert_eq!(body.at(0, 0.004).start, target);
}

#[test]
fn moves_follow_each_other_smoothly() {
    // Frame after frame the velocity at a move's start is that at the last one's end.
    let mut body = Body::new(sphere()).unwrap();
    let at = |k: f64| Frame { origin: Vector3::new(0.1 * k, 0.0, 0.02 * k * k), rotation: UnitQuaternion::identity() };
    let (mut before, h) = (body.def().pose.origin, 1e-4);
    let mut speeds = Vec::new();
    for frame in 1..5 {
        body.move_to(at(f64::from(frame)), 0.02).unwrap();
        for _ in 0..200 {
            body.begin(h);
            body.finish(h);
            speeds.push((body.def().pose.origin - before) / h);
            before = body.def().pose.origin;
        }
    }
    // Continuous velocity: it changes by the acceleration (below 6·way/duration² of way 0.2 m) times the substep.
    for pair in speeds.windows(2) {
        assert!((pair[1] - pair[0]).norm() < 6.0 * 0.2 / 0.02f64.powi(2) * h, "{} {}", pair[0], pair[1]);
    }
}

#[test]
fn bad_bodies_are_refused_by_name() {
    let says = |result: superhelix::Result<()>, text: &str| {
        let error = result.unwrap_err().to_string();
        assert!(error.starts_with(text), "{error}");
    };
    says(Body::new(BodyDef { thickness: -0.1, ..sphere() }).map(|_| ()), "thickness is -0.1");
    says(Body::new(BodyDef { friction: f64::NAN, ..sphere() }).map(|_| ()), "friction is NaN");
    says(Body::new(BodyDef { viscous_friction: -1.0, ..sphere() }).map(|_| ()), "viscous_friction is -1");
    let mut body = Body::new(sphere()).unwrap();
    let nowhere = Frame { origin: Vector3::new(0.0, f64::INFINITY, 0.0), ..Frame::default() };
    says(body.move_to(nowhere, 1.0), "pose.origin[1] is inf");
    says(body.place(nowhere), "pose.origin[1] is inf");
    says(body.move_to(Frame::default(), -1.0), "duration is -1");
    says(body.set_surface(0.0, 0.0, f64::NAN), "viscous_friction is NaN");
    body.set_filter(0b01, 0b10);
    assert!(body.meets(0b10, 0b01) && !body.meets(0b10, 0b10) && !body.meets(0b01, 0b01));
}
