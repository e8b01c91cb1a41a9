//! Rods of the reference solutions as strands: lengths in L = 0.1 m, gravity along −z, Γ = ρS g L³/EI1.

pub mod judge;
pub mod modes;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::{Material, StrandDef};

/// The strand's length, m.
pub const LENGTH: f64 = 0.1;
/// Gravity, m/s².
pub const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// The reference file.
pub fn reference() -> Value {
    serde_json::from_str(include_str!("../../data/reference/physics.json")).unwrap()
}

/// A JSON number.
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A JSON list of three numbers.
pub fn triple(value: &Value) -> Vector3<f64> {
    Vector3::new(number(&value[0]), number(&value[1]), number(&value[2]))
}

/// The rows of a JSON list, of which there is at least one.
pub fn rows(value: &Value) -> &Vec<Value> {
    let rows = value.as_array().unwrap();
    assert!(!rows.is_empty());
    rows
}

/// Sections a1/a2 = `aspect`, Young's modulus as Γ wants it.
pub fn material(gamma: f64, aspect: f64, poisson_ratio: f64) -> Material {
    let (density, mean) = (1300.0, 50e-6_f64);
    let (a1, a2) = (mean * aspect.sqrt(), mean / aspect.sqrt());
    let youngs_modulus = 4.0 * density * -GRAVITY.z * LENGTH.powi(3) / (a2 * a2 * gamma);
    Material { radius: [a1, a2], density, youngs_modulus, poisson_ratio, ..Material::default() }
}

/// The clamp whose axes n0, n1, n2 are given.
pub fn clamp(n0: Vector3<f64>, n1: Vector3<f64>) -> UnitQuaternion<f64> {
    let frame = Matrix3::from_columns(&[n0, n1, n0.cross(&n1)]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame))
}

/// A clamp from a JSON matrix whose columns are the axes.
pub fn clamp_from(value: &Value) -> UnitQuaternion<f64> {
    let column = |j: usize| Vector3::new(number(&value[0][j]), number(&value[1][j]), number(&value[2][j]));
    clamp(column(0), column(1))
}

/// Clamped downwards; κ1 > 0 curls towards +x.
pub fn down() -> UnitQuaternion<f64> {
    clamp(-Vector3::z(), -Vector3::y())
}

/// `count` equal elements of natural curvatures `natural`, in 1/L.
pub fn strand(count: usize, material: Material, root: UnitQuaternion<f64>, natural: [f64; 3]) -> StrandDef {
    let mut def = StrandDef::straight(LENGTH, count);
    def.material = material;
    def.root.rotation = root;
    def.natural = vec![natural.map(|k| k / LENGTH); count];
    def
}
