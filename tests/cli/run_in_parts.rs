//! `superhelix run` in parts: a run continued from a snapshot equals a whole run, to the bit.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::support::{directory, errors, small_scene, superhelix, with};

/// A scene with all that a state consists of: a head that moves, a body, hair in contact, an attachment.
fn scene() -> Value {
    let strand = |y: f64| {
        json!({
            "elements": 4, "length": 0.08, "radius": [60e-6, 50e-6], "density": 1300, "youngs_modulus": 2e9, "poisson_ratio": 0.4,
            "natural_curvatures": [[1.0, 12.0, 3.0]], "root": { "origin": [0.0, y, 0.03] },
            "root_motion": { "times": [0.0, 0.05, 0.1], "frames": [[0, y, 0.03, 0, 0, 0, 1], [0.01, y, 0.03, 0, 0, 0, 1], [0, y, 0.03, 0, 0, 0, 1]] }
        })
    };
    let scene = with(small_scene(), "/duration", json!(0.095));
    let scene = with(scene, "/strands", json!([strand(0.0), strand(0.0004), strand(0.0009)]));
    let scene = with(scene, "/hair_contact", json!({ "wisp_radius": 3e-4, "friction": 0.2 }));
    let scene = with(scene, "/colliders", json!([{ "shape": "sphere", "radius": 0.02, "pose": { "origin": [0.04, 0.0, 0.0] } }]));
    let scene = with(scene, "/attachments", json!([{ "kind": "point", "strand": 2, "arclength": 0.04, "compliance": 1.0 }]));
    with(scene, "/output", json!(["tips", "curvatures", "energies", "wrenches", "attachments"]))
}

fn run(scene: &Path, out: &str, arguments: &[&str]) -> (Option<i32>, String, Option<Value>) {
    let out = scene.with_file_name(out);
    let mut all: Vec<PathBuf> = vec!["run".into(), scene.into(), "--out".into(), out.clone(), "--quiet".into()];
    for argument in arguments {
        let is_file = argument.contains('.');
        all.push(if is_file { scene.with_file_name(argument) } else { argument.into() });
    }
    let output = superhelix(&all);
    let result = std::fs::read_to_string(out).ok().map(|text| serde_json::from_str(&text).unwrap());
    (output.status.code(), errors(&output), result)
}

/// Adds the states of a later part to those of an earlier one.
fn append(earlier: &mut Value, later: &Value) {
    match (earlier, later) {
        (Value::Object(earlier), Value::Object(later)) => {
            for (key, value) in earlier.iter_mut().filter(|(key, _)| *key != "report") {
                append(value, &later[key]);
            }
        }
        (Value::Array(earlier), Value::Array(later)) => {
            // A list of things, or one with an entry a state.
            if earlier.first().is_some_and(|first| {
                first.get("tips").is_some() || first.get("wrenches").is_some() || first.get("states").is_some()
            }) {
                earlier.iter_mut().zip(later).for_each(|(earlier, later)| append(earlier, later));
            } else {
                earlier.extend(later.iter().cloned());
            }
        }
        (earlier, later) => *earlier = later.clone(),
    }
}

#[test]
fn a_run_in_parts_is_the_whole_run_to_the_bit() {
    let path = directory("parts_of_a_run").join("scene.json");
    std::fs::write(&path, scene().to_string()).unwrap();
    let (status, said, whole) = run(&path, "whole.json", &[]);
    assert_eq!(status, Some(0), "{said}");
    let mut whole = whole.unwrap();
    assert!(whole["report"]["contact"]["contacts_max"].as_u64().unwrap() > 0, "{}", whole["report"]);
    // States are 0 to 10, the last after half an interval.
    let parts: [&[&str]; 3] = [
        &["--until", "3", "--snapshot", "a.shxrun"],
        &["--resume", "a.shxrun", "--until", "4", "--snapshot", "b.shxrun"],
        &["--resume", "b.shxrun"],
    ];
    let mut joined: Option<Value> = None;
    for (k, part) in parts.into_iter().enumerate() {
        let (status, said, result) = run(&path, &format!("part{k}.json"), part);
        assert_eq!(status, Some(0), "{said}");
        match (&mut joined, result.unwrap()) {
            (Some(joined), later) => append(joined, &later),
            (joined, first) => *joined = Some(first),
        }
    }
    let mut joined = joined.unwrap();
    for result in [&mut whole, &mut joined] {
        result.as_object_mut().unwrap().remove("report");
    }
    assert_eq!(whole["times"].as_array().unwrap().len(), 11);
    assert_eq!(whole["state_hash"].as_str().unwrap().len(), 16);
    assert_eq!(joined, whole);
}

#[test]
fn bad_parts_are_refused() {
    let path = directory("bad_parts").join("scene.json");
    std::fs::write(&path, small_scene().to_string()).unwrap();
    let refused = |arguments: &[&str], wanted: &str| {
        let (status, said, result) = run(&path, "result.json", arguments);
        assert_eq!(status, Some(1), "{said}");
        assert!(said.contains(wanted) && result.is_none(), "{said}");
    };
    refused(&["--until", "6"], "--until is 6: the scene's states are 0 to 5");
    refused(&["--resume", "missing.shxrun"], "cannot be read");
    refused(&["--resume", "scene.json"], "is no snapshot");
    refused(&["--snapshot", "nowhere/a.shxrun"], "cannot be written");
    assert_eq!(run(&path, "part.json", &["--until", "2", "--snapshot", "a.shxrun"]).0, Some(0));
    refused(&["--resume", "a.shxrun", "--until", "2"], "--resume is of state 2, and the run is to end with state 2");
    let bytes = std::fs::read(path.with_file_name("a.shxrun")).unwrap();
    std::fs::write(path.with_file_name("cut.shxrun"), &bytes[..bytes.len() - 3]).unwrap();
    refused(&["--resume", "cut.shxrun"], "cut.shxrun: snapshot: its header has a body of");
    std::fs::write(&path, with(small_scene(), "/duration", json!(0.06)).to_string()).unwrap();
    refused(&["--resume", "a.shxrun"], "is a snapshot of another scene");
}
