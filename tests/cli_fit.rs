//! `superhelix fit`.
#![cfg(feature = "cli")]

mod cli_support;

use cli_support::{data, directory, errors, superhelix};
use serde_json::Value;
use superhelix::files::curves::Curves;
use superhelix::files::obj;

#[test]
fn fit_says_how_close_strands_come() {
    let groom = data("amd_ponytail_tail.tfx");
    let output = superhelix(&["fit", &groom, "--elements", "3,6", "--every", "20", "--threads", "2", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    for (row, elements) in rows.iter().zip([3, 6]) {
        assert_eq!((row["elements"].as_u64(), row["strands"].as_u64()), (Some(elements), Some(24)));
        let of = |what: &str, rank: &str| row[what][rank].as_f64().unwrap();
        assert!(of("rms", "p50") <= of("rms", "p95") && of("rms", "max") <= of("max", "max"), "{row}");
        assert!(of("distance", "max") <= of("max", "max") * (1.0 + 1e-12) && of("max", "max") < 0.03, "{row}");
        assert_eq!(of("element_count", "max"), elements as f64);
    }
    let p95 = |row: usize| rows[row]["rms"]["p95"].as_f64().unwrap();
    assert!(p95(1) < p95(0), "{} {}", p95(0), p95(1));

    let output = superhelix(&["fit", &groom, "--elements", "4", "--every", "40"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("474") || text.contains("12 strands"), "{text}");
    assert!(text.contains("per cent of the length"), "{text}");
}

#[test]
fn fit_keeps_a_tolerance_and_writes_a_scene_that_runs() {
    let place = directory("fit_scene");
    let scene = place.join("scene.json").display().to_string();
    let groom = data("sintel_hair_001.tfx");
    let output = superhelix(&[
        "fit",
        &groom,
        "--every",
        "40",
        "--scale",
        "0.01",
        "--tolerance",
        "0.0004",
        "--radius",
        "1e-4",
        "--out",
        &scene,
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let row = &answer["rows"][0];
    assert_eq!((row["unmet"].as_u64(), row["strands"].as_u64()), (Some(0), Some(6)), "{row}");
    assert!(row["max_metres"]["max"].as_f64().unwrap() <= 0.0004);
    let elements = row["element_count"]["max"].as_f64().unwrap();
    assert!((2.0..=40.0).contains(&elements), "{row}");

    // Sag-free as fitted: the strands are where the groom is, and stay.
    let result = place.join("result.json").display().to_string();
    let output = superhelix(&["run", &scene, "--out", &result]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let result: Value = serde_json::from_slice(&std::fs::read(&result).unwrap()).unwrap();
    let written: Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    assert_eq!(written["strands"].as_array().unwrap().len(), 6);
    let curves = Curves::read(groom).unwrap();
    for strand in 0..6 {
        let root = curves.strand(40 * strand)[0];
        let origin = &written["strands"][strand]["root"]["origin"];
        for axis in 0..3 {
            assert!((origin[axis].as_f64().unwrap() - 0.01 * f64::from(root[axis])).abs() < 1e-12);
        }
    }
    assert!(result.is_object());
}

#[test]
fn fit_leaves_out_what_has_no_shape_and_refuses_what_it_cannot_do() {
    let place = directory("fit_refuses");
    let path = place.join("groom.obj");
    let good: Vec<[f32; 3]> = (0..6).map(|k| [0.01 * k as f32, 0.002 * (k * k) as f32, 0.0]).collect();
    obj::write(&path, &Curves::from_strands(&[vec![[0.5; 3]; 3], good]).unwrap()).unwrap();
    let path = path.display().to_string();
    let output = superhelix(&["fit", &path, "--elements", "3", "--json"]);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((answer["rows"][0]["strands"].as_u64(), answer["skipped"][0]["strand"].as_u64()), (Some(1), Some(0)), "{answer}");
    let bare = place.join("bare.obj");
    obj::write(&bare, &Curves::from_strands(&[vec![[0.5; 3]; 3]]).unwrap()).unwrap();
    let bare = bare.display().to_string();
    for (arguments, expected) in [
        (vec!["fit", &bare], "no strand can be fitted"),
        (vec!["fit", "no_such_groom.hair"], "no_such_groom.hair"),
        (vec!["fit", &path, "--tolerance", "0.001"], "--scale"),
        (vec!["fit", &path, "--elements", "0"], "--elements"),
        (vec!["fit", &path, "--starts", "9"], "--starts"),
        (vec!["fit", &path, "--out", "scene.json"], "--scale"),
        (vec!["fit", &path, "--scale", "1", "--out", "/no/such/directory/scene.json"], "/no/such/directory"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(expected), "{arguments:?}: {}", errors(&output));
    }
}
