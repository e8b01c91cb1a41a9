//! `superhelix settings`, and presets of `superhelix simulate`.

use crate::support::{data, errors, superhelix};
use serde_json::Value;
use superhelix::settings::{HairShape, Preset, Scenes, suggest_settings};

fn answer(arguments: &[&str]) -> Value {
    let output = superhelix(&[&["settings", "--json"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", errors(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn presets_and_errors_equal_the_librarys() {
    let curl = HairShape { curvature: 1.0 / 0.01_f64.hypot(0.005 / (2.0 * std::f64::consts::PI)), length: 0.15 };
    let expected = Preset::Balanced.settings(&curl, 1.0 / 24.0).unwrap();
    let said =
        answer(&["--preset", "balanced", "--length", "0.15", "--curl-radius", "0.01", "--curl-step", "0.005", "--fps", "24"]);
    assert_eq!(said["integrator"], "second_order");
    assert_eq!((&said["substeps"], &said["elements"]), (&expected.substeps.into(), &expected.elements.into()));
    assert_eq!(
        (&said["tolerance"], &said["max_iterations"]),
        (&expected.step.tolerance.into(), &expected.step.max_iterations.into())
    );
    assert_eq!(said["quadrature_tolerance"], expected.step.quadrature_tolerance);
    assert_eq!(said["measured_error"].as_f64(), expected.error);

    let straight = HairShape { curvature: 0.0, length: 0.2 };
    let scenes = Scenes::WALK.union(Scenes::CALM_SWAY);
    let expected = suggest_settings(0.1, scenes, &straight, 1.0 / 30.0).unwrap();
    for error in [["--error", "0.1"], ["--error-mm", "20"]] {
        let said = answer(&[error[0], error[1], "--scenes", "walk,calm_sway"]);
        assert_eq!((&said["substeps"], &said["elements"]), (&expected.substeps.into(), &expected.elements.into()));
    }
}

#[test]
fn unattainable_accuracy_is_an_error_that_names_the_attainable() {
    for (arguments, words) in [
        (&["--error", "1e-9"] as &[&str], "target_error is 0.000000001"),
        (&["--error", "0.1", "--curl-radius", "1e-4"], "curvature is"),
        (&["--error", "-1"], "above zero"),
        (&["--preset", "best"], "expected one of preview, balanced, accurate"),
        (&["--error", "0.1", "--scenes", "dance"], "\"dance\" is none of"),
        (&["--preset", "preview", "--error", "0.1"], "cannot be used with"),
        (&["--preset", "preview", "--scenes", "walk"], "cannot be used with"),
        (&[], "required"),
    ] {
        let output = superhelix(&[&["settings"], arguments].concat());
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(words), "{arguments:?}: {}", errors(&output));
    }
}

#[test]
fn simulate_takes_a_preset_and_flags_win() {
    let groom = data("fibermesh_1k.tfx");
    let run = |flags: &[&str]| -> Value {
        let common =
            ["simulate", &groom, "--scale", "0.0012", "--every", "200", "--duration", "0.1", "--fps", "30", "--json", "--quiet"];
        let output = superhelix(&[&common, flags].concat());
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let recipe = Preset::Preview.recipe();
    let plain = run(&["--preset", "preview"]);
    assert!(plain["time_step"].as_f64().unwrap() <= recipe.longest_step * (1.0 + 1e-9));
    assert!(plain["elements"].as_u64().unwrap() >= u64::from(recipe.fewest_elements));
    let own = run(&["--preset", "preview", "--substeps", "7", "--elements", "6"]);
    assert_eq!(own["elements"], 6);
    assert!((own["time_step"].as_f64().unwrap() - 1.0 / 210.0).abs() < 1e-12);
}
