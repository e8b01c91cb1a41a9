//! The trajectories of the independent oracle (`tests/oracle/`), with their strands.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::{Frame, Material, StrandDef};

/// One trajectory.
pub struct Case {
    pub name: String,
    pub def: StrandDef,
    pub root: Option<YawRoot>,
    pub times: Vec<f64>,
    pub tips: Vec<Vector3<f64>>,
    /// How far the oracle moved when it halved its step, m.
    #[allow(dead_code, reason = "not every test that has the cases asks")]
    pub uncertainty: f64,
}

/// The head motion of the references: yaw about z and sway along y, eased in.
#[derive(Clone, Copy)]
pub struct YawRoot {
    radius: f64,
    tilt: f64,
    amp: f64,
    yaw: f64,
    f: f64,
    ramp: f64,
}

impl YawRoot {
    pub fn at(&self, t: f64) -> Frame {
        let w = 2.0 * std::f64::consts::PI * self.f;
        let (ct, st) = (self.tilt.cos(), self.tilt.sin());
        let tilted = Matrix3::new(ct, 0.0, st, 0.0, 1.0, 0.0, -st, 0.0, ct);
        let ease = 1.0 - (-(self.ramp * t).powi(2)).exp();
        let (a, y) = (self.yaw * (w * t).sin() * ease, self.amp * (w * t).sin() * ease);
        let turn = Matrix3::new(a.cos(), -a.sin(), 0.0, a.sin(), a.cos(), 0.0, 0.0, 0.0, 1.0);
        let origin = turn * Vector3::new(self.radius, 0.0, 0.0) + Vector3::new(0.0, y, 0.0);
        let m = turn * tilted;
        // Not from_matrix, which iterates to 1e-6 of a turn only.
        let rotation = UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(m));
        Frame { origin, rotation }
    }
}

pub fn all() -> Vec<Case> {
    let all: Value = serde_json::from_str(include_str!("../data/reference/oracle.json")).unwrap();
    let number = |p: &Value, key: &str| p.get(key).and_then(Value::as_f64).unwrap_or(0.0);
    let triple = |v: &Value| Vector3::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap(), v[2].as_f64().unwrap());
    all.as_object()
        .unwrap()
        .iter()
        .map(|(name, case)| {
            let p = &case["parameters"];
            let count = p["N"].as_u64().unwrap() as usize;
            let mut def = StrandDef::straight(number(p, "L"), count);
            def.material = Material {
                radius: [number(p, "a1"), number(p, "a2")],
                density: number(p, "rho"),
                youngs_modulus: number(p, "E"),
                poisson_ratio: number(p, "poisson"),
                internal_friction: number(p, "gamma"),
                viscosity: number(p, "mu"),
                air_drag: number(p, "drag"),
            };
            if let Some(natural) = p.get("qn") {
                def.natural = vec![triple(natural).into(); count];
            }
            let root = p.get("root").map(|r| YawRoot {
                radius: number(r, "radius"),
                tilt: number(r, "tilt"),
                amp: number(r, "amp"),
                yaw: number(r, "yaw"),
                f: number(r, "f"),
                ramp: number(r, "ramp"),
            });
            if let Some(root) = root {
                def.root = root.at(0.0);
            }
            let times = case["t"].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
            let tips = case["tip"].as_array().unwrap().iter().map(triple).collect();
            Case { name: name.clone(), def, root, times, tips, uncertainty: number(case, "step_halving_error_m") }
        })
        .collect()
}
