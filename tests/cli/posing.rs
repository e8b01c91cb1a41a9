//! Strands posed from scene files and by `superhelix pose`; rest shapes and stiffening on the command line.

use std::f64::consts::FRAC_1_SQRT_2 as HALF;
use std::path::Path;

use crate::support::{data, difference, directory, errors, numbers, run, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};

/// Two strands, the second 5 cm beside the first.
fn scene() -> Value {
    let mut scene = with(small_scene(), "/output", json!(["tips", "curvatures"]));
    let mut second = scene["strands"][0].clone();
    second["root"] = json!({ "origin": [0.0, 0.05, 0.0] });
    second["elements"] = json!(6);
    scene["strands"].as_array_mut().unwrap().push(second);
    scene
}

fn tips(result: &Value, strand: usize) -> Vec<Vec<f64>> {
    result["strands"][strand]["tips"].as_array().unwrap().iter().map(numbers).collect()
}

fn pose(directory: &Path, scene: &Value, flags: &[&str]) -> Value {
    let (from, to) = (directory.join("scene.json"), directory.join("posed.json"));
    std::fs::write(&from, scene.to_string()).unwrap();
    let _ = std::fs::remove_file(&to);
    let mut arguments = vec!["pose", from.to_str().unwrap(), "--out", to.to_str().unwrap()];
    arguments.extend(flags);
    let output = superhelix(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_str(&std::fs::read_to_string(&to).unwrap()).unwrap()
}

#[test]
fn strands_begin_posed_and_a_posed_scene_runs_alike() {
    let directory = directory("posing");
    let posing = json!([
        { "do": "drag", "strands": [0], "target": [0.06, 0.02, 0.01], "elements": [1, 2] },
        { "do": "brush", "centre": [0.09, 0.05, 0.0], "radius": 0.03, "movement": [0.0, 0.0, 0.01], "strands": [1] },
        { "do": "change_element", "strands": [1], "element": 5, "bend": [0.3, 0.0] },
        { "do": "cut", "arclength": 0.095, "strands": [1] },
        { "do": "grow", "length": 0.01, "elements": 1, "strands": [0] },
        { "do": "material", "youngs_modulus": 3e9, "strands": [1] },
        { "do": "mirror", "normal": [0, 1, 0], "strands": [1] },
        { "do": "take", "shape": "rest" }
    ]);
    let scene = with(scene(), "/posing", posing);
    let result = run(&directory, &scene);
    assert_eq!(result["strands"].as_array().unwrap().len(), 3, "an image was added");
    // All rest where they were put.
    for strand in 0..3 {
        let tips = tips(&result, strand);
        assert!(difference(&tips[0], tips.last().unwrap()) < 1e-9);
    }
    let (one, image) = (&tips(&result, 1)[0], &tips(&result, 2)[0]);
    assert!(difference(&[one[0], -one[1], one[2]], image) < 1e-15);
    let rows = |strand: usize| result["strands"][strand]["curvatures"][0].as_array().unwrap().clone();
    assert_eq!((rows(0).len(), rows(1).len()), (4, 6));
    assert_eq!(numbers(&rows(0)[0]), [1.0, 12.0, 3.0], "the first element was not to change");

    let posed = pose(&directory, &scene, &[]);
    assert!(posed.get("posing").is_none());
    assert_eq!(posed["strands"][1]["youngs_modulus"], json!(3e9));
    let lengths: f64 = numbers(&posed["strands"][1]["element_lengths"]).iter().sum();
    assert!((lengths - 0.095).abs() < 1e-15);
    let again = run(&directory, &posed);
    for strand in 0..3 {
        // Quaternions and numbers are written so that they are read as they were.
        assert_eq!(tips(&result, strand), tips(&again, strand));
    }
}

#[test]
fn a_drag_reaches_its_target_and_bodies_are_kept_out_of() {
    let directory = directory("posing_drag");
    let target = [0.05, 0.03, -0.02];
    let mut scene = with(scene(), "/posing", json!([{ "do": "drag", "strands": [1], "target": [0.05, 0.03, -0.02] }]));
    let result = run(&directory, &scene);
    assert!(difference(&tips(&result, 1)[0], &target) < 1e-6);
    scene["posing"] = json!([{ "do": "drag", "strands": [1], "target": [0.09, 0.05, -0.01] }]);
    scene["strands"][1]["natural_curvatures"] = json!([[0.0, 0.0, 0.0]]);
    scene["colliders"] = json!([{ "shape": "sphere", "radius": 0.015, "pose": { "origin": [0.09, 0.05, -0.02] } }]);
    let result = run(&directory, &scene);
    // The target lies in the sphere, 1 cm above its middle: the tip is at its top, the strand's semi-axis away.
    let tip = &tips(&result, 1)[0];
    assert!(difference(tip, &[0.09, 0.05, -0.005 + 60e-6]) < 1e-6, "{tip:?}");
}

#[test]
fn shapes_are_taken_and_strands_stiffened_by_flags() {
    let directory = directory("posing_rest");
    // Upright, long and limp.
    let mut scene = with(scene(), "/strands/0/root", json!({ "rotation": [0.0, -HALF, 0.0, HALF] }));
    scene["strands"][0]["length"] = json!(0.4);
    scene["strands"][0]["natural_curvatures"] = json!([[0.0, 0.5, 0.0]]);
    scene["duration"] = json!(0.5);
    scene["strands"][0]["viscosity"] = json!(0.01);
    let posed = pose(&directory, &scene, &["--take", "natural"]);
    assert_eq!(posed["strands"][0]["natural_curvatures"], json!([[0.0, 0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.5, 0.0]]));
    let posed = pose(&directory, &scene, &["--take", "rest", "--stiffen", "0.1"]);
    let modulus = |strand: usize| posed["strands"][strand]["youngs_modulus"].as_f64().unwrap();
    assert!(modulus(0) > 2.1e9 && modulus(1) == 2e9, "{} {}", modulus(0), modulus(1));
    let stands = tips(&run(&directory, &posed), 0);
    assert!(difference(&stands[0], stands.last().unwrap()) < 1e-8);
    let thicker = pose(&directory, &scene, &["--take", "rest", "--stiffen", "0.1", "--stiffen-by", "radius"]);
    let share = numbers(&thicker["strands"][0]["radius"])[0] / 60e-6;
    assert!((share * share - modulus(0) / 2e9).abs() < 1e-9, "stiffness by the fourth power, weight by the square: {share}");

    let path = directory.join("scene.json");
    let out = directory.join("result.json");
    let flags = ["run", path.to_str().unwrap(), "--out", out.to_str().unwrap(), "--stiffen", "0.1"];
    let output = superhelix(&flags);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("--take rest"), "{}", errors(&output));
    let output = superhelix(&[&flags[..], &["--take", "rest"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let result: Value = serde_json::from_str(&std::fs::read_to_string(&out).unwrap()).unwrap();
    let stands = tips(&result, 0);
    assert!(difference(&stands[0], stands.last().unwrap()) < 1e-8);
}

#[test]
fn a_groom_is_stiffened_where_it_would_fall() {
    let directory = directory("posing_groom");
    let (groom, out) = (data("sintel_hair_001.tfx"), directory.join("fit.json"));
    let fit = |flags: &[&str]| {
        let mut arguments = vec![
            "fit",
            &groom,
            "--elements",
            "6",
            "--scale",
            "0.05",
            "--every",
            "5",
            "--youngs-modulus",
            "1e7",
            "--bare",
            "--out",
            out.to_str().unwrap(),
        ];
        arguments.extend(flags);
        superhelix(&arguments)
    };
    let moduli = || -> Vec<f64> {
        let scene: Value = serde_json::from_str(&std::fs::read_to_string(&out).unwrap()).unwrap();
        scene["strands"].as_array().unwrap().iter().map(|strand| strand["youngs_modulus"].as_f64().unwrap()).collect()
    };
    let output = fit(&["--stiffen", "0.05"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let stiffer = moduli();
    assert!(stiffer.iter().all(|modulus| *modulus >= 1e7) && stiffer.iter().any(|modulus| *modulus > 1e7), "{stiffer:?}");
    assert_eq!(fit(&[]).status.code(), Some(0));
    assert!(moduli().iter().all(|modulus| *modulus == 1e7));
    let output = fit(&["--stiffen", "0.05", "--natural", "as-drawn"]);
    assert!(output.status.code() == Some(1) && errors(&output).contains("--natural sag-free"), "{}", errors(&output));
    assert_eq!(fit(&["--stiffen", "1"]).status.code(), Some(1));
}

#[test]
fn bad_operations_are_named() {
    let directory = directory("posing_bad");
    for (operation, named) in [
        (json!({ "do": "comb" }), "posing[0].do"),
        (json!({ "strands": [0] }), "posing[0].do is missing"),
        (json!({ "do": "drag" }), "posing[0].target is missing"),
        (json!({ "do": "drag", "target": [0, 0, 1], "strands": [2] }), "posing[0].strands[0] is 2"),
        (json!({ "do": "drag", "target": [0, 0, 1], "strands": [1, 1] }), "posing[0].strands"),
        (json!({ "do": "drag", "target": [0, 0, 1], "arclength": 0.2 }), "posing[0].arclength is 0.2"),
        (json!({ "do": "drag", "target": [0, 0, 1], "natural_pull": 2 }), "posing[0].natural_pull is 2"),
        (json!({ "do": "drag", "target": [0, 0, 1], "elements": [3, 1] }), "posing[0].elements"),
        (json!({ "do": "drag", "target": [0, 0, 1], "radius": 1 }), "posing[0].radius"),
        (json!({ "do": "brush", "centre": [0, 0, 0], "movement": [0, 0, 1], "radius": 0 }), "posing[0].radius is 0"),
        (json!({ "do": "change_element", "element": 5, "twist": 1 }), "posing[0].element is 5"),
        (json!({ "do": "cut", "arclength": -1 }), "posing[0].arclength is -1"),
        (json!({ "do": "grow", "length": 0.1, "curvatures": [0, 0, 0] }), "posing[0].curvatures"),
        (json!({ "do": "mirror", "normal": [0, 0, 0] }), "posing[0].normal"),
        (json!({ "do": "material", "density": 0 }), "posing[0].density is 0"),
        (json!({ "do": "take", "shape": "natural", "stiffen": "radius" }), "posing[0].stiffen"),
        (json!({ "do": "take", "shape": "rest", "margin": 0.1 }), "posing[0].margin"),
        (json!({ "do": "take", "shape": "rest", "stiffen": "radius", "margin": 1 }), "posing[0].margin is 1"),
    ] {
        let (output, result) = run_text(&directory, &with(scene(), "/posing", json!([operation])).to_string());
        assert_eq!(output.status.code(), Some(2), "{operation}: {}", errors(&output));
        assert!(errors(&output).contains(named), "{operation}: {}", errors(&output));
        assert!(result.is_none());
    }
    let mut held = with(scene(), "/posing", json!([{ "do": "cut", "arclength": 0.05 }]));
    held["attachments"] = json!([{ "kind": "point", "strand": 0, "arclength": 0.08 }]);
    let (output, _) = run_text(&directory, &held.to_string());
    assert!(output.status.code() == Some(2) && errors(&output).contains("posing[0].arclength"), "{}", errors(&output));
}
