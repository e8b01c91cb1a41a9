//! `superhelix run`: strands of a scene that are drawn to curves.

use serde_json::{Value, json};

use crate::support::{difference, directory, errors, numbers, run, run_text, small_scene, with};

/// Two strands that leave along x, and a scene that lasts half a second.
fn scene(targets: Value) -> Value {
    let strand = small_scene()["strands"][0].clone();
    let strand = with(strand, "/natural_curvatures", json!([[0.0, 0.0, 0.0]]));
    let other = with(strand.clone(), "/root", json!({"origin": [0.0, 0.05, 0.0]}));
    let scene = with(with(small_scene(), "/strands", json!([strand, other])), "/duration", json!(0.5));
    let scene = with(with(scene, "/time_step", json!(0.005)), "/output_interval", json!(0.1));
    if targets.is_null() { scene } else { with(scene, "/targets", targets) }
}

fn tips(result: &Value, strand: usize) -> Vec<Vec<f64>> {
    result["strands"][strand]["tips"].as_array().unwrap().iter().map(|tip| numbers(tip).to_vec()).collect()
}

#[test]
fn a_strand_holds_the_shape_in_which_it_starts() {
    let place = directory("scene_targets_start");
    let free = run(&place, &scene(Value::Null));
    let held = run(&place, &scene(json!([{"strands": 0, "weights": [[0, 1]]}])));
    // The first stays, the other falls as it did, to the bit.
    let (first, last) = (tips(&held, 0)[0].clone(), tips(&held, 0)[5].clone());
    assert!(difference(&first, &last) < 1e-5, "{first:?} {last:?}");
    assert_eq!(tips(&held, 1), tips(&free, 1));
    assert!(difference(&tips(&free, 0)[0], &tips(&free, 0)[5]) > 0.02);

    // With its root it goes along.
    let motion = json!({"times": [0, 0.25, 0.5, 0.75], "frames": [[0, 0, 0, 0, 0, 0, 1], [0, 0, 0.05, 0, 0, 0, 1], [0, 0, 0.1, 0, 0, 0, 1], [0, 0, 0.15, 0, 0, 0, 1]]});
    let moving = with(scene(json!([{"strands": 0, "weights": [[0, 1]]}])), "/strands/0/root_motion", motion);
    let result = run(&place, &moving);
    let last = tips(&result, 0)[5].clone();
    assert!(difference(&last, &[0.1, 0.0, 0.1]) < 1e-4, "{last:?}");
}

#[test]
fn strands_follow_curves_with_their_roots() {
    let place = directory("scene_targets_curves");
    let curve = |z: f64| json!([[0.0, 0.0, z], [0.05, 0.0, z], [0.1, 0.0, z]]);
    let other = |z: f64| json!([[0.0, 0.05, z], [0.05, 0.05, z], [0.1, 0.05, z]]);
    let points = json!([[curve(0.0), other(0.0)], [curve(0.1), other(-0.1)]]);
    let targets = json!([{"times": [0, 0.5], "points": points, "weights": [[0, 1]]}]);
    let result = run(&place, &scene(targets.clone()));
    for (strand, z) in [(0, 0.1), (1, -0.1)] {
        let last = tips(&result, strand)[5].clone();
        assert!(difference(&last, &[0.1, 0.05 * strand as f64, z]) < 1e-4, "{strand}: {last:?}");
        let half = tips(&result, strand)[3].clone();
        assert!(difference(&half, &[0.1, 0.05 * strand as f64, 0.6 * z]) < 1e-3, "{strand}: {half:?}");
    }

    // From files, every second curve of centimetres: the same, to what the file's digits say.
    let write = |name: &str, z: f64| {
        let mut text = String::new();
        for (curve, y) in [0.0, 9.0, 5.0, 9.0].iter().enumerate() {
            for x in [0.0, 5.0, 10.0] {
                text += &format!("v {x} {y} {}\n", if curve == 0 { 100.0 * z } else { -100.0 * z });
            }
        }
        for curve in 0..4 {
            text += &format!("l {} {} {}\n", 3 * curve + 1, 3 * curve + 2, 3 * curve + 3);
        }
        std::fs::write(place.join(name), text).unwrap();
    };
    write("begin.obj", 0.0);
    write("end.obj", 0.1);
    let files =
        json!([{"times": [0, 0.5], "files": ["begin.obj", "end.obj"], "metres_per_unit": 0.01, "every": 2, "weights": [[0, 1]]}]);
    let from_files = run(&place, &scene(files));
    for strand in [0, 1] {
        for (one, other) in tips(&result, strand).iter().zip(&tips(&from_files, strand)) {
            assert!(difference(one, other) < 1e-6, "{one:?} {other:?}");
        }
    }
}

#[test]
fn a_run_in_parts_ends_as_one_run() {
    let place = directory("scene_targets_parts");
    let targets = json!([{"weights": [[0, 1], [1, 0.1]], "time_constant": 0.05}]);
    let motion = json!({"times": [0, 0.5], "frames": [[0, 0, 0, 0, 0, 0, 1], [0, 0, 0.1, 0, 0, 0, 1]]});
    let scene = with(scene(targets), "/strands/0/root_motion", motion);
    let whole = run(&place, &scene);
    let path = |name: &str| place.join(name).to_str().unwrap().to_string();
    std::fs::write(place.join("parts.json"), scene.to_string()).unwrap();
    let part = |flags: &[&str]| {
        let arguments: Vec<String> = ["run".to_string(), path("parts.json"), "--out".into(), path("part.json"), "--quiet".into()]
            .into_iter()
            .chain(flags.iter().map(|flag| flag.to_string()))
            .collect();
        let output = crate::support::superhelix(&arguments);
        assert!(output.status.success(), "{}", errors(&output));
    };
    part(&["--until", "2", "--snapshot", &path("half.shx")]);
    part(&["--resume", &path("half.shx")]);
    let ended: Value = serde_json::from_str(&std::fs::read_to_string(place.join("part.json")).unwrap()).unwrap();
    assert_eq!(ended["state_hash"], whole["state_hash"]);
}

#[test]
fn bad_targets_are_refused_by_name() {
    let place = directory("scene_targets_refused");
    let curve = json!([[0, 0, 0], [0.1, 0, 0]]);
    for (target, key) in [
        (json!({"strands": 2}), "targets[0].strands"),
        (json!({"weights": []}), "targets[0].weights"),
        (json!({"weights": [[0, 2]]}), "targets[0].weights[0][1]"),
        (json!({"weights": [[0.5, 1], [0.4, 1]]}), "targets[0].weights[1]"),
        (json!({"time_constant": 0}), "targets[0].time_constant"),
        (json!({"files": ["a.obj"]}), "targets[0].files"),
        (json!({"times": [0]}), "targets[0].files"),
        (json!({"times": [0], "files": ["none.obj"]}), "targets[0].files[0]"),
        (json!({"times": [0, 1], "points": [[curve]]}), "targets[0].points"),
        (json!({"times": [0], "points": [[curve]]}), "targets[0].points[0]"),
        (json!({"strands": 0, "times": [0], "points": [[[[0, 0, 0]]]]}), "targets[0].points[0]"),
        (json!({"strands": 0, "times": [0], "points": [[[[0, 0, 0], [0, 0, 0]]]]}), "targets[0].points[0]"),
        (json!({"curves": 1}), "targets[0].curves"),
    ] {
        let (output, result) = run_text(&place, &scene(json!([target])).to_string());
        assert_eq!(output.status.code(), Some(2), "{target}");
        assert!(result.is_none() && errors(&output).contains(key), "{target}: {}", errors(&output));
    }
    let (output, _) = run_text(&place, &scene(json!([{"strands": 1}, {}])).to_string());
    assert!(output.status.code() == Some(2) && errors(&output).contains("targets[1]"), "{}", errors(&output));
}
