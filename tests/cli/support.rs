//! Shared code of the command-line tests: the binary, a separate directory for each test, scenes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};

/// Runs the binary.
pub fn superhelix<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_superhelix")).args(arguments).output().expect("the binary starts")
}

/// An empty directory for one test.
pub fn directory(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cli_{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A file of the test data.
pub fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Standard error as text.
pub fn errors(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A small scene: one strand that falls from the horizontal.
pub fn small_scene() -> Value {
    json!({
        "version": 1,
        "time_step": 0.01,
        "duration": 0.05,
        "output_interval": 0.01,
        "strands": [{
            "elements": 3, "length": 0.1,
            "radius": [60e-6, 50e-6], "density": 1300, "youngs_modulus": 2e9, "poisson_ratio": 0.4,
            "natural_curvatures": [[1.0, 12.0, 3.0]]
        }],
        "output": ["tips"]
    })
}

/// Sets the value at a JSON pointer, making the last key if it is not there.
pub fn with(mut scene: Value, pointer: &str, value: Value) -> Value {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = scene.pointer_mut(parent).unwrap_or_else(|| panic!("{pointer}"));
    match parent {
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        other => other[key] = value,
    }
    scene
}

/// Runs a scene given as text: the output of the process and the result, if one was written.
pub fn run_text(directory: &Path, scene: &str) -> (Output, Option<Value>) {
    let (scene_path, result_path) = (directory.join("scene.json"), directory.join("result.json"));
    std::fs::write(&scene_path, scene).unwrap();
    let _ = std::fs::remove_file(&result_path);
    let output = superhelix(&["run".as_ref(), scene_path.as_os_str(), "--out".as_ref(), result_path.as_os_str()]);
    let result = std::fs::read_to_string(&result_path).ok().map(|text| serde_json::from_str(&text).unwrap());
    (output, result)
}

/// Runs a scene that must end well.
pub fn run(directory: &Path, scene: &Value) -> Value {
    let (output, result) = run_text(directory, &scene.to_string());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    result.expect("a result is written")
}

/// Numbers of a list.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap_or_else(|| panic!("{value}")).iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Largest difference between two lists of numbers.
pub fn difference(one: &[f64], other: &[f64]) -> f64 {
    assert_eq!(one.len(), other.len());
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}
