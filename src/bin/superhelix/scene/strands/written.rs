//! Strands as a scene file.

use std::io::Write;
use std::path::Path;

use nalgebra::Vector3;
use serde_json::{Value, json};
use superhelix::StrandDef;

use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;

/// Writes a scene of a second in which the strands stand where they were fitted, one strand a line.
pub fn write(path: &Path, strands: &[StrandDef], gravity: Vector3<f64>) -> Result<(), Failure> {
    let mut file = AtomicFile::create(path)?;
    let fail = |error: std::io::Error| Failure::file(path, format!("cannot be written: {error}"));
    let number = |value: f64| Value::from(value).to_string();
    let [x, y, z] = [gravity.x, gravity.y, gravity.z].map(number);
    let head = format!(
        "{{\n  \"version\": 1,\n  \"gravity\": [{x}, {y}, {z}],\n  \"time_step\": {},\n  \"duration\": 1.0,\n  \"output_interval\": {},\n  \"output\": [\"points\"],\n  \"strands\": [",
        number(1.0 / 60.0),
        number(1.0 / 30.0)
    );
    file.write_all(head.as_bytes()).map_err(fail)?;
    for (index, strand) in strands.iter().enumerate() {
        let separator = if index == 0 { "\n    " } else { ",\n    " };
        file.write_all(format!("{separator}{}", one(strand)).as_bytes()).map_err(fail)?;
    }
    file.write_all(b"\n  ]\n}\n").map_err(fail)?;
    file.commit()
}

/// A strand as an object of a scene file.
pub fn one(strand: &StrandDef) -> Value {
    let material = &strand.material;
    let [x, y, z]: [f64; 3] = strand.root.origin.into();
    let mut value = json!({
        "element_lengths": strand.element_lengths,
        "radius": material.radius,
        "density": material.density,
        "youngs_modulus": material.youngs_modulus,
        "poisson_ratio": material.poisson_ratio,
        "internal_friction": material.internal_friction,
        "viscosity": material.viscosity,
        "air_drag": material.air_drag,
        "natural_curvatures": strand.natural,
        "root": { "origin": [x, y, z], "rotation": strand.root.rotation_xyzw() },
    });
    if let Some(initial) = &strand.initial {
        value["initial_curvatures"] = json!(initial);
    }
    value
}
