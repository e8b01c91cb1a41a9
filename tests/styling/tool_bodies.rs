use nalgebra::Vector3;
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::tools::Tool;
use superhelix::{Error, Frame, Solver, SolverOptions};

const ALL: [Tool; 5] = [Tool::COMB, Tool::BRUSH, Tool::FINGER, Tool::PLATES, Tool::BARREL];

#[test]
fn tools_have_the_bodies_that_they_say() {
    let pose = Frame { origin: Vector3::new(0.1, 0.2, 0.3), rotation: from_rotation_vector(Vector3::new(0.3, -0.2, 0.5)) };
    for tool in ALL {
        let bodies = tool.bodies(&pose, 2e-3).unwrap();
        assert_eq!(bodies.len(), tool.body_count());
        assert_eq!(tool.frames(&pose, 2e-3).unwrap().len(), bodies.len());
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let ids = solver.add_bodies(bodies).unwrap();
        solver.set_body_frames(&ids, &tool.frames(&pose, 1e-3).unwrap(), 0.01).unwrap();
    }
}

/// Distances from places of the world to a tool's nearest body say where its teeth, tips and faces are.
#[test]
fn bodies_are_where_the_numbers_put_them() {
    let pose = Frame { origin: Vector3::new(0.1, 0.2, 0.3), rotation: from_rotation_vector(Vector3::new(0.3, -0.2, 0.5)) };
    let gap = |tool: Tool, opening: f64, local: [f64; 3]| {
        let world = pose.origin + pose.rotation * Vector3::from(local);
        let bodies = tool.bodies(&pose, opening).unwrap();
        let distance = |body: &superhelix::BodyDef| {
            let at = body.pose.rotation.inverse() * (world - body.pose.origin);
            body.shape.closest(at, 1.0).unwrap().distance
        };
        bodies.iter().map(distance).fold(f64::INFINITY, f64::min)
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    // Between the two teeth in the middle of twelve; at the tip of one.
    near(gap(Tool::COMB, 0.0, [0.0, 0.0, 10e-3]), 0.75e-3);
    near(gap(Tool::COMB, 0.0, [1.25e-3, 0.0, 30e-3]), 0.0);
    near(gap(Tool::FINGER, 0.0, [0.0, 0.0, 71e-3]), 1e-3);
    near(gap(Tool::PLATES, 2e-3, [0.02, 0.0, 0.0]), 1e-3);
    near(gap(Tool::PLATES, 2e-3, [0.02, 6e-3, 0.0]), 1e-3);
    near(gap(Tool::BARREL, 0.0, [0.03, 0.0, 13.5e-3]), 1e-3);
    near(gap(Tool::BARREL, 0.0, [60e-3, 0.0, 0.0]), 0.0);
    // Rows of a brush stand half a spacing aside of each other.
    near(gap(Tool::BRUSH, 0.0, [1e-3, -7.5e-3, 15e-3]), 0.0);
    near(gap(Tool::BRUSH, 0.0, [-1e-3, -2.5e-3, 15e-3]), 0.0);
}

#[test]
fn bad_numbers_are_named() {
    let name = |tool: Tool, opening: f64| match tool.bodies(&Frame::default(), opening) {
        Err(Error::InvalidArgument { argument, .. }) => argument,
        other => panic!("{other:?}"),
    };
    let comb = |teeth, length| Tool::Comb { teeth, spacing: 2e-3, length, radius: 1e-3 };
    assert_eq!(name(comb(0, 0.02), 0.0), "tool.tooth_count");
    assert_eq!(name(comb(3, 0.5e-3), 0.0), "tool.length");
    assert_eq!(name(Tool::Finger { length: 0.05, radius: -1.0 }, 0.0), "tool.radius");
    assert_eq!(name(Tool::Plates { width: f64::NAN, depth: 0.02, thickness: 1e-3 }, 0.0), "tool.width");
    assert_eq!(name(Tool::PLATES, -1.0), "opening");
}
