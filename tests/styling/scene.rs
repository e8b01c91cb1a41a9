//! Hair that hangs from a row of follicles.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::HairType;
use superhelix::{Frame, Material, Solver, SolverOptions, StrandContact, StrandDef, StrandId};

pub const STEP: f64 = 1.0 / 120.0;

/// A hair of `length` that leaves `origin` downwards, turned about its tangent.
pub fn hanging(origin: Vector3<f64>, turn: f64, length: f64, natural: &[[f64; 3]]) -> StrandDef {
    let mut def = StrandDef::straight(length, natural.len());
    def.natural = natural.to_vec();
    def.material = Material { viscosity: 5e-3, ..HairType::Ga1.measured().material() };
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    let about = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), turn);
    def.root = Frame { origin, rotation: down * about };
    def
}

/// A row of hairs along x, 4 mm apart, at rest, with contact.
pub fn row(count: usize, length: f64, natural: &[[f64; 3]]) -> (Solver, Vec<StrandId>) {
    let mut options = SolverOptions::default();
    options.step.tolerance = 1e-6;
    let mut solver = Solver::new(options).unwrap();
    let x = |k: usize| 4e-3 * (k as f64 - 0.5 * (count - 1) as f64);
    let defs: Vec<StrandDef> = (0..count).map(|k| hanging(Vector3::x() * x(k), 0.7 * k as f64, length, natural)).collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 5e-3, ..StrandContact::default() })).unwrap();
    solver.settle(&ids, &Default::default()).unwrap();
    (solver, ids)
}

/// Points of a strand from root to tip.
pub fn points(solver: &Solver, id: StrandId, count: usize) -> Vec<Vector3<f64>> {
    let length: f64 = solver.element_lengths(id).unwrap().iter().sum();
    let arclengths: Vec<f64> = (0..count).map(|k| length * k as f64 / (count - 1) as f64).collect();
    let mut points = Vec::new();
    solver.sample_at(id, &arclengths, |_, sample| points.push(sample.position)).unwrap();
    points
}

/// The largest distance between the points of two shapes.
pub fn apart(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}
