//! `superhelix fit`.

use crate::support::{data, difference, directory, errors, numbers, superhelix};
use serde_json::Value;
use superhelix::io::{Curves, Extras, UpAxis, obj};

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
fn fitted_strands_are_wisps_unless_they_are_to_be_bare() {
    use superhelix::{Material, Wisp};
    let place = directory("fit_wisps");
    let scene = place.join("scene.json").display().to_string();
    let groom = data("sintel_hair_001.tfx");
    let hair = Material { radius: [1e-4; 2], youngs_modulus: 3e9, ..Material::default() };
    for (flags, wisp) in [
        (vec!["--bare"], Wisp::bare()),
        (vec![], Wisp::default()),
        (vec!["--hold", "0.9", "--hairs", "50"], Wisp { hold: 0.9, hairs: 50.0 }),
    ] {
        let fixed = ["fit", &groom, "--every", "80", "--scale", "0.01", "--elements", "6", "--out", &scene];
        let material = ["--radius", "1e-4", "--youngs-modulus", "3e9"];
        let output = superhelix(&[&fixed[..], &material, &flags].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let written: Value = serde_json::from_str(&std::fs::read_to_string(&scene).unwrap()).unwrap();
        let strand = &written["strands"][0];
        let expected = wisp.material(&hair).unwrap();
        // (The section of the default kind of hair is an ellipse.)
        let [a, b] = [0, 1].map(|axis| numbers(&strand["radius"])[axis]);
        assert!(((a * b).sqrt() / expected.radius[0] - 1.0).abs() < 1e-12, "{strand}");
        let stiffer = strand["youngs_modulus"].as_f64().unwrap() / expected.youngs_modulus;
        // (A strand that its own stiffness does not let rest as drawn is made stiffer.)
        assert!(if wisp == Wisp::bare() { (stiffer - 1.0).abs() < 1e-12 } else { stiffer > 1.0 - 1e-12 }, "{stiffer}");
    }
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

/// Three strands of a wave, as a file of the given unit.
fn waves(path: &std::path::Path, metres_per_unit: Option<f64>) {
    let wave = |index: u32| {
        let at = |k: u32| {
            let s = 0.5 * k as f32;
            [2.0 * index as f32 + (0.9 * s).sin(), -s, (0.5 * s).cos()]
        };
        (0..31).map(at).collect::<Vec<_>>()
    };
    let curves = Curves::from_strands(&[wave(0), wave(1), wave(2)]).unwrap();
    let extras = Extras { metres_per_unit, up: Some(UpAxis::Y), ..Extras::default() };
    curves.with_extras(extras).unwrap().write(path).unwrap();
}

#[test]
fn the_unit_is_the_files_where_it_says_one() {
    let place = directory("fit_unit");
    let (groom, scene) = (place.join("waves.usda"), place.join("scene.json"));
    waves(&groom, Some(0.01));
    let fit = |more: &[&str]| {
        let fixed = ["fit", groom.to_str().unwrap(), "--tolerance", "0.002", "--out", scene.to_str().unwrap(), "--json"];
        let output = superhelix(&[&fixed, more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        let written: Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
        let lengths = written["strands"][0]["element_lengths"].as_array().unwrap();
        let length: f64 = lengths.iter().map(|length| length.as_f64().unwrap()).sum();
        (answer["rows"][0]["max_metres"]["max"].as_f64().unwrap(), length)
    };
    let (error, length) = fit(&[]);
    assert!(error <= 0.002 && (0.15..0.25).contains(&length), "{error} {length}");
    // A flag wins.
    let (_, twice) = fit(&["--scale", "0.02"]);
    assert!((twice / length - 2.0).abs() < 1e-6, "{twice} {length}");
    let hair = place.join("waves.hair");
    waves(&hair, None);
    let output = superhelix(&["fit", hair.to_str().unwrap(), "--tolerance", "0.002"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("waves.hair: does not say its unit: --tolerance needs --scale"), "{}", errors(&output));
}

#[test]
fn strands_are_as_long_as_the_files_splines() {
    let place = directory("fit_splines");
    let (groom, scene) = (place.join("quarter.usda"), place.join("scene.json"));
    // A quarter circle of 10 cm, exactly, by rational quadratics: 15.7 cm, of which the four chords that it is drawn by are 0.3 % short.
    let quarter = "#usda 1.0\n(\n    metersPerUnit = 0.01\n    upAxis = \"Y\"\n)\ndef NurbsCurves \"q\" {\nint[] curveVertexCounts = [3]\n\
        int[] order = [3]\ndouble[] knots = [0,0,0,1,1,1]\ndouble[] pointWeights = [1,0.7071067811865476,1]\n\
        point3f[] points = [(10,0,0),(10,10,0),(0,10,0)]\n}\n";
    std::fs::write(&groom, quarter).unwrap();
    let arguments =
        ["fit", groom.to_str().unwrap(), "--elements", "4", "--out", scene.to_str().unwrap(), "--natural", "as-drawn"];
    let output = superhelix(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let written: Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    let lengths = written["strands"][0]["element_lengths"].as_array().unwrap();
    let length: f64 = lengths.iter().map(|length| length.as_f64().unwrap()).sum();
    assert!((length / (0.05 * std::f64::consts::PI) - 1.0).abs() < 1e-6, "{length}");
}

#[test]
fn a_groom_curls_by_the_sliders() {
    let place = directory("fit_curliness");
    let (groom, scene, result) = (place.join("waves.usda"), place.join("scene.json"), place.join("result.json"));
    waves(&groom, Some(0.01));
    let fit = |more: &[&str]| -> Value {
        let fixed = ["fit", groom.to_str().unwrap(), "--elements", "24", "--out", scene.to_str().unwrap()];
        let output = superhelix(&[&fixed, more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap()
    };
    let rows = |scene: &Value, strand: usize, key: &str| -> Vec<f64> {
        scene["strands"][strand][key].as_array().unwrap().iter().flat_map(numbers).collect()
    };
    let own = fit(&[]);
    for natural in ["sag-free", "as-drawn"] {
        let own = rows(&fit(&["--natural", natural]), 1, "natural_curvatures");
        for (slider, factor) in [("-1", 0.0), ("-0.25", 0.75)] {
            let curled = fit(&["--natural", natural, "--curliness", slider]);
            let wanted: Vec<f64> = own.iter().map(|value| factor * value).collect();
            assert!(difference(&rows(&curled, 1, "natural_curvatures"), &wanted) < 1e-9);
        }
    }
    // At rest the hair spans less from root to tip the curlier it is, until its waves fold over (at two and a half times their angle, here 0.25).
    let spans: Vec<f64> = ["-1", "-0.5", "-0.25", "0", "0.05", "0.1", "0.2"]
        .iter()
        .map(|slider| {
            let scene_now = fit(&["--curliness", slider]);
            // It begins as it was drawn.
            assert!(*slider == "0" || rows(&scene_now, 1, "initial_curvatures") == rows(&own, 1, "initial_curvatures"));
            let output = superhelix(&["run", scene.to_str().unwrap(), "--settle", "--out", result.to_str().unwrap()]);
            assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
            let result: Value = serde_json::from_slice(&std::fs::read(&result).unwrap()).unwrap();
            let points = result["strands"][1]["points"][0].as_array().unwrap();
            let (root, tip) = (numbers(&points[0]), numbers(points.last().unwrap()));
            root.iter().zip(&tip).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
        })
        .collect();
    assert!(spans.windows(2).all(|pair| pair[1] < pair[0]), "{spans:?}");
    // Discipline below 0 makes strands differ and strays; above, it leaves shapes alone.
    let rough = fit(&["--discipline", "-0.5"]);
    let strayed = difference(&rows(&rough, 0, "natural_curvatures"), &rows(&own, 0, "natural_curvatures"));
    assert!((10.0..200.0).contains(&strayed), "{strayed}");
    assert_ne!(fit(&["--discipline", "-0.5", "--seed", "3"])["strands"][0], rough["strands"][0]);
    assert_eq!(rows(&fit(&["--discipline", "1"]), 0, "natural_curvatures"), rows(&own, 0, "natural_curvatures"));
    for (more, expected) in [
        (["--curliness", "2"], "--curliness is 2; expected a number from -1 to 1"),
        (["--curliness", "0.5"], "--stiffen with --curliness"),
        (["--discipline", "-0.5"], "--stiffen with --discipline below 0"),
    ] {
        let output = superhelix(&[&["fit", groom.to_str().unwrap(), "--stiffen", "0.1"][..], &more].concat());
        assert_eq!(output.status.code(), Some(1));
        assert!(errors(&output).contains(expected), "{}", errors(&output));
    }
}

#[test]
fn fit_skips_curves_without_shape_and_refuses_impossible_requests() {
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
