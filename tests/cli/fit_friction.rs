//! `superhelix fit-friction`, on curves that the independent oracle made (`tests/data/friction/`).

use crate::support::{directory, errors, superhelix};
use serde_json::Value;

fn data(name: &str) -> String {
    format!("{}/tests/data/friction/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn fit(curve: &str, scene: &str, flags: &[&str]) -> std::process::Output {
    superhelix(&[&["fit-friction", curve, "--scene", scene], flags].concat())
}

/// The answer of a call that must end well.
fn answer(curve: &str, scene: &str, flags: &[&str]) -> Value {
    let output = fit(&data(curve), &data(scene), &[flags, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_air_drag_of_a_pendulum_is_found_and_reported() {
    let answer = answer("pendulum_20.csv", "pendulum.scene.json", &["--fit", "air_drag", "--direction", "1,0,0"]);
    let found = &answer["coefficients"][0];
    assert_eq!(
        (&found["name"], &found["unit"], &found["verdict"]),
        (&"air_drag".into(), &"kg/(m s)".into(), &"determined".into())
    );
    let number = |key: &str| found[key].as_f64().unwrap_or_else(|| panic!("{key}: {found}"));
    assert!((number("value") - 8e-6).abs() < 3.0 * number("standard_error") && number("standard_error") < 0.04 * 8e-6);
    assert!(number("excluded_below") < 8e-6 && number("excluded_above") > 8e-6 && number("step_shift").abs() < 1e-3);
    assert_eq!((&answer["samples"], &answer["compared"]), (&181.into(), &181.into()));
    assert!((answer["noise"].as_f64().unwrap() / 0.004 - 1.0).abs() < 0.2 && answer["residual_unit"] == "m");
    assert_eq!((&answer["version"], &answer["converged"], &answer["unconverged"]), (&1.into(), &true.into(), &0.into()));
}

#[test]
fn a_shaken_curl_is_fitted_by_the_numbers_of_its_oscillation() {
    let directory = directory("fit_friction_oscillation");
    let table = std::fs::read_to_string(data("curl_shaken_20.csv")).unwrap();
    let without_root: Vec<String> = table.lines().map(|line| line.split(',').take(2).collect::<Vec<_>>().join(",")).collect();
    let (curve, fitted) = (directory.join("curve.csv"), directory.join("fitted.csv"));
    std::fs::write(&curve, without_root.join("\n")).unwrap();
    let flags = ["--fit", "internal_friction", "--internal-friction-range", "1e-11,1e-9", "--grid-points", "5"];
    let oscillation = ["--amplitude", "0.01", "--frequency", "3", "--discard", "0.25", "--out", fitted.to_str().unwrap()];
    let output = fit(curve.to_str().unwrap(), &data("curl_shaken.scene.json"), &[&flags[..], &oscillation].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    let value: f64 = text.strip_prefix("internal_friction: ").unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((value / 1e-10 - 1.0).abs() < 0.2 && text.contains("over 106 of 121 samples"), "{text}");
    let table = std::fs::read_to_string(&fitted).unwrap();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    assert!(table.starts_with("time_s,recorded,fitted\n0.25,") && rows.len() == 106);
    let square = rows.iter().map(|row| (row[1] - row[2]).powi(2)).sum::<f64>() / 106.0;
    assert!((square.sqrt() / 0.0022 - 1.0).abs() < 0.2, "{}", square.sqrt());
}

#[test]
fn what_a_curve_does_not_determine_is_reported() {
    let flags = ["--fit", "internal_friction", "--grid-points", "3"];
    let answer = answer("straight_shaken_05.csv", "straight_shaken.scene.json", &flags);
    let found = &answer["coefficients"][0];
    assert_eq!(
        (&found["verdict"], &found["excluded_below"], &found["excluded_above"]),
        (&"undetermined".into(), &Value::Null, &Value::Null)
    );
    let output = fit(&data("straight_shaken_05.csv"), &data("straight_shaken.scene.json"), &flags);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success() && text.contains("not determined by this curve") && text.contains("no value of the grid"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_fitted_is_named() {
    let directory = directory("fit_friction_errors");
    let bad = directory.join("bad.csv");
    std::fs::write(&bad, "time_s,span_m\n0,0.1\n0,0.2\n").unwrap();
    let (curl, scene, pendulum) = (data("curl_shaken_05.csv"), data("curl_shaken.scene.json"), data("pendulum_05.csv"));
    let gamma = ["--fit", "internal_friction"];
    let cases: &[(&str, &str, &[&str], i32, &str)] = &[
        (&curl, &scene, &[], 1, "--fit"),
        (&curl, &scene, &["--fit", "friction"], 1, "friction"),
        (&curl, &scene, &["--fit", "air_drag", "--fit", "air_drag"], 1, "--fit[1] is air_drag"),
        ("no_such_curve.csv", &scene, &gamma, 1, "no_such_curve.csv"),
        (bad.to_str().unwrap(), &scene, &gamma, 1, "line 3: time_s is 0"),
        (&curl, "no_such_scene.json", &gamma, 1, "no_such_scene.json"),
        (&curl, &curl, &gamma, 2, "curl_shaken_05.csv"),
        (&curl, &scene, &["--fit", "internal_friction", "--strand", "1"], 1, "--strand is 1"),
        (&curl, &scene, &["--fit", "internal_friction", "--internal-friction-range", "1e-9"], 1, "--internal-friction-range"),
        (
            &curl,
            &scene,
            &["--fit", "internal_friction", "--internal-friction-range", "1,0.5"],
            1,
            "--internal-friction-range[1] is 0.5",
        ),
        (&curl, &scene, &["--fit", "internal_friction", "--viscosity-range", "1,2"], 1, "--viscosity-range"),
        (&curl, &scene, &["--fit", "internal_friction", "--direction", "1,0,0"], 1, "--direction"),
        (&pendulum, &scene, &["--fit", "air_drag"], 1, "--direction is missing"),
        (&pendulum, &scene, &["--fit", "air_drag", "--direction", "0,0,0"], 1, "--direction is [0.0, 0.0, 0.0]"),
        (&pendulum, &scene, &["--fit", "air_drag", "--direction", "1,0"], 1, "--direction is [1.0, 0.0]"),
        (&curl, &scene, &["--fit", "internal_friction", "--amplitude", "0.01", "--frequency", "3"], 1, "root_x_m"),
        (&curl, &scene, &["--fit", "internal_friction", "--amplitude", "0.01"], 1, "--frequency"),
        (&curl, &scene, &["--fit", "internal_friction", "--lead-in", "-1"], 1, "--lead-in is -1"),
        (&curl, &scene, &["--fit", "internal_friction", "--discard", "9"], 1, "the curve's times (count to compare) is 0"),
        (&curl, &scene, &["--fit", "internal_friction", "--grid-points", "1"], 1, "--grid-points is 1"),
    ];
    for (curve, scene, flags, status, named) in cases {
        let output = fit(curve, scene, flags);
        let text = errors(&output);
        assert!(output.status.code() == Some(*status) && text.contains(named), "{flags:?}: {:?}, {text}", output.status);
        assert!(output.stdout.is_empty(), "{flags:?}");
    }
}
