//! The curves of `tests/data/friction/`, with their strands.

use std::path::PathBuf;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::experiments::{Coefficient, Observable, Recording, RootMotion};
use superhelix::io::{Measured, RecordedCurve};
use superhelix::splines::PoseSpline;
use superhelix::{Frame, Material, StrandDef};

/// A recorded curve, the strand that it is of (its friction coefficients those that were true), and what is known about it.
pub struct Case {
    pub strand: StrandDef,
    pub recording: Recording,
    pub motion: RootMotion,
    /// Standard deviation of the noise.
    pub noise: f64,
}

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/friction").join(name)
}

fn json(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(data(name)).unwrap()).unwrap()
}

/// The case of a curve's file: NAME_NOISE.csv.
pub fn case(file: &str) -> Case {
    let name = &file[..file.rfind('_').unwrap()];
    let scene = json(&format!("{name}.scene.json"));
    let def = &scene["strands"][0];
    let number = |key: &str| def[key].as_f64().unwrap();
    let list = |value: &Value| value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<_>>();
    let mut strand = StrandDef::straight(number("length"), def["elements"].as_u64().unwrap() as usize);
    let radius = list(&def["radius"]);
    strand.material = Material {
        radius: [radius[0], radius[1]],
        density: number("density"),
        youngs_modulus: number("youngs_modulus"),
        poisson_ratio: number("poisson_ratio"),
        internal_friction: number("internal_friction"),
        viscosity: number("viscosity"),
        air_drag: number("air_drag"),
    };
    let natural = list(&def["natural_curvatures"][0]);
    strand.natural.fill([natural[0], natural[1], natural[2]]);
    let turned = list(&def["root"]["rotation"]);
    strand.root.rotation = UnitQuaternion::new_normalize(Quaternion::new(turned[3], turned[0], turned[1], turned[2]));

    let curve = RecordedCurve::read(data(file)).unwrap();
    let poses = curve.root.unwrap().into_iter().map(|origin| Frame { origin, rotation: strand.root.rotation }).collect();
    let motion = RootMotion::Recorded(PoseSpline::new(curve.times.clone(), poses).unwrap());
    let observable = match curve.measured {
        Measured::Span => Observable::Span,
        Measured::Depth => Observable::Depth,
        Measured::Offset => Observable::Offset(Vector3::x()),
        Measured::Angle => Observable::Angle(Vector3::x()),
    };
    let noise = json("true.json")[name]["noise"][file].as_f64().unwrap();
    Case { strand, recording: Recording { times: curve.times, values: curve.values, observable }, motion, noise }
}

/// The true value of a coefficient.
pub fn truth(case: &Case, coefficient: Coefficient) -> f64 {
    *coefficient.of(&mut case.strand.material.clone())
}
