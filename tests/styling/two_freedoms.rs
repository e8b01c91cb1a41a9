//! Two freedoms an element (twist and bending about the soft axis) beside three: the error of tips. docs/theory/hair_types.md has the table:
//! `cargo test --test styling two_freedoms -- --nocapture`.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::HairType;
use superhelix::{Frame, Freedoms, Material, Solver, SolverOptions, StrandDef};

use crate::scene::points;

const LENGTH: f64 = 0.15;
const ELEMENTS: usize = 15;
const STEP: f64 = 1.0 / 240.0;

/// How the hair is asked to bend.
#[derive(Debug, Clone, Copy)]
enum Load {
    /// Hanging, let go from its natural shape.
    Hangs,
    /// Its root leaves level, n1 level: weight bends it about the limp axis.
    LimpWay,
    /// The same with n1 upright: weight bends it about the stiff axis.
    StiffWay,
    /// Hanging, the root shaken by 2 cm at 2 Hz in both directions.
    Shaken,
}

/// The tip's path from the root, in lengths: one point a step of two seconds.
fn path(kind: HairType, natural: [f64; 3], load: Load, freedoms: Freedoms) -> Vec<Vector3<f64>> {
    let mut options = SolverOptions::default();
    options.step.tolerance = 1e-6;
    let mut solver = Solver::new(options).unwrap();
    let mut def = StrandDef::straight(LENGTH, ELEMENTS);
    def.natural = vec![natural; ELEMENTS];
    def.material = Material { viscosity: 5e-3, ..kind.measured().material() };
    def.freedoms = freedoms;
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    let about = |angle: f64| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle);
    def.root.rotation = match load {
        Load::Hangs | Load::Shaken => down * about(0.4),
        // Level along x: n1 is y; turned by a quarter it is z.
        Load::LimpWay => about(0.0),
        Load::StiffWay => about(0.5 * PI),
    };
    let root = def.root;
    let id = solver.add_strands(&[def]).unwrap()[0];
    (1..=480)
        .map(|step| {
            let t = f64::from(step) * STEP;
            let mut origin = Vector3::zeros();
            if let Load::Shaken = load {
                origin = Vector3::new((4.0 * PI * t).sin(), (3.1 * PI * t).sin(), 0.0) * 0.02;
                solver.set_root_frames(&[id], &[Frame { origin, ..root }], STEP).unwrap();
            }
            solver.step(STEP, 1).unwrap();
            (points(&solver, id, 2)[1] - origin) / LENGTH
        })
        .collect()
}

/// Root mean square and largest distance of two paths, over the length.
fn off(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> (f64, f64) {
    let squares: Vec<f64> = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared()).collect();
    ((squares.iter().sum::<f64>() / squares.len() as f64).sqrt(), squares.iter().copied().fold(0.0, f64::max).sqrt())
}

#[test]
fn tips_of_two_freedoms_and_of_three() {
    let two = Freedoms::TWIST.union(Freedoms::BEND1);
    let shapes = [("straight", [0.0, 0.0, 0.0]), ("wavy", [4.0, 30.0, 0.0]), ("curly", [14.0, 110.0, 0.0])];
    let loads = [Load::Hangs, Load::LimpWay, Load::StiffWay, Load::Shaken];
    let mut table = [[(0.0, 0.0); 4]; 3];
    for (row, (name, natural)) in shapes.into_iter().enumerate() {
        for (column, load) in loads.into_iter().enumerate() {
            let [a, b] = [two, Freedoms::ALL].map(|freedoms| path(HairType::Ga1, natural, load, freedoms));
            table[row][column] = off(&a, &b);
            println!(
                "{name}, {load:?}: {:.1} % rms, {:.1} % at most",
                100.0 * table[row][column].0,
                100.0 * table[row][column].1
            );
        }
    }
    let [straight, ..] = table;
    // In the plane of the limp axis straight hair moves alike; across it two freedoms cannot follow at once: a strand without curvature has no
    // way to bend there except to twist first.
    assert!(straight[1].0 < 0.01, "{straight:?}");
    assert!(straight[2].0 > 0.1, "{straight:?}");
}
