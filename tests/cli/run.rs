//! `superhelix run`: the results of good scenes.

use crate::support::{difference, directory, errors, numbers, run, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};

fn last_tip(result: &Value) -> Vec<f64> {
    numbers(result["strands"][0]["tips"].as_array().unwrap().last().unwrap())
}

#[test]
fn the_documented_example_runs_as_it_stands() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/reference/scene_format.md")).unwrap();
    let begin = text.find("```jsonc\n").unwrap() + 9;
    let example = &text[begin..begin + text[begin..].find("```").unwrap()];
    let (output, result) = run_text(&directory("documented"), example);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let result = result.unwrap();
    assert_eq!(result["version"], 1);
    // 60 intervals of 0.016666 s, and the end at 1 s.
    let times = numbers(&result["times"]);
    assert_eq!(times.len(), 62);
    assert_eq!((times[60], times[61]), (60.0 * 0.016666, 1.0));
    assert_eq!(result["strands"][0]["tips"].as_array().unwrap().len(), 62);
    for key in [
        "steps",
        "iterations_mean",
        "iterations_max",
        "unconverged",
        "unfinished",
        "quarantined",
        "subdivided",
        "error_max",
        "seconds",
    ] {
        assert!(result["report"][key].is_number(), "{key}");
    }
    assert!(last_tip(&result)[2] < -0.05, "a strand of hair that is held level must fall: {:?}", last_tip(&result));
}

#[test]
fn an_error_tolerance_subdivides_steps_and_halvings_can_be_forbidden() {
    let scene = with(with(small_scene(), "/error_tolerance", json!(1e-5)), "/max_subdivisions", json!(8));
    let result = run(&directory("parts"), &scene);
    assert!(result["report"]["subdivided"].as_u64().unwrap() > 0);
    let told = result["report"]["error_max"].as_f64().unwrap();
    assert!(told > 0.0 && told <= 1e-5, "{told}");
    let result = run(&directory("parts_forbidden"), &with(scene, "/max_subdivisions", json!(0)));
    assert_eq!(result["report"]["subdivided"], 0);
    assert!(result["report"]["error_max"].as_f64().unwrap() > 1e-5);
}

#[test]
fn times_are_exact_and_the_last_step_is_shorter() {
    let scene =
        with(with(with(small_scene(), "/time_step", json!(0.03)), "/output_interval", json!(0.1)), "/duration", json!(0.25));
    let result = run(&directory("times"), &scene);
    assert_eq!(numbers(&result["times"]), [0.0, 0.1, 0.2, 0.25]);
    // Three whole steps and a shorter one in each tenth of a second, one and a shorter one in the rest.
    assert_eq!(result["report"]["steps"], 10);

    let scene = with(with(small_scene(), "/duration", json!(0.1)), "/output_interval", json!(7.0));
    let result = run(&directory("times_long"), &scene);
    assert_eq!(numbers(&result["times"]), [0.0, 0.1]);
    assert_eq!(result["report"]["steps"], 10);

    let result = run(&directory("times_none"), &with(small_scene(), "/duration", json!(0)));
    assert_eq!(numbers(&result["times"]), [0.0]);
    assert_eq!(result["report"]["steps"], 0);
}

#[test]
fn free_fall_of_a_shorter_last_step_lasts_as_long() {
    // The whole strand hangs from a root that moves freely: the position at 0.05 s shows how long the simulation ran.
    let drag = |time_step: f64| {
        let scene = with(with(small_scene(), "/integrator", json!("implicit_euler")), "/time_step", json!(time_step));
        last_tip(&run(&directory("shorter"), &with(scene, "/output_interval", json!(0.05))))
    };
    let (fine, whole, shorter) = (drag(0.0001), drag(0.0005), drag(0.0006));
    assert!(difference(&whole, &fine) > 1e-7, "the error of implicit Euler must show");
    // 84 steps of which the last is shorter: an error in time of 0.0004 s would move the tip by 1e-4 m.
    assert!(difference(&shorter, &fine) < 2.0 * difference(&whole, &fine));
}

#[test]
fn every_key_that_matters_changes_the_motion() {
    let directory = directory("keys");
    let base = with(with(small_scene(), "/duration", json!(0.1)), "/strands/0/air_drag", json!(1e-5));
    let reference = last_tip(&run(&directory, &base));
    let cases = [
        ("/gravity", json!([0, -9.81, 0])),
        ("/wind", json!([0, 3, 0])),
        ("/integrator", json!("linearly_implicit")),
        ("/integrator", json!("implicit_euler")),
        ("/time_step", json!(0.005)),
        ("/duration", json!(0.09)),
        ("/newton", json!({"max_iterations": 1, "tolerance": 1e-12})),
        ("/strands/0/elements", json!(4)),
        ("/strands/0/length", json!(0.11)),
        ("/strands/0/radius", json!([50e-6, 60e-6])),
        ("/strands/0/density", json!(1200)),
        ("/strands/0/youngs_modulus", json!(1e9)),
        ("/strands/0/poisson_ratio", json!(0.1)),
        ("/strands/0/internal_friction", json!(1e-9)),
        ("/strands/0/viscosity", json!(0.05)),
        ("/strands/0/air_drag", json!(3e-5)),
        ("/strands/0/natural_curvatures", json!([[1, 12, 3], [1, 12, 3], [1, 12, 4]])),
        ("/strands/0/initial_curvatures", json!([[0, 0, 0]])),
        ("/strands/0/initial_rates", json!([[0, 50, 0]])),
        ("/strands/0/freedoms", json!(["bend1", "bend2"])),
        ("/strands/0/root", json!({"origin": [0.1, 0, 0], "rotation": [0, 0, 0, 1]})),
        ("/strands/0/root", json!({"rotation": [0, 0, 0.6, 0.8]})),
        ("/strands/0/root_motion", json!({"times": [0, 0.1], "frames": [[0, 0, 0, 0, 0, 0, 1], [0.1, 0, 0, 0, 0, 0, 1]]})),
    ];
    for (pointer, value) in cases {
        let tip = last_tip(&run(&directory, &with(base.clone(), pointer, value.clone())));
        assert!(difference(&tip, &reference) > 1e-7, "{pointer} {value} changed nothing");
    }
}

#[test]
fn keys_without_effect_on_the_result_change_nothing() {
    let directory = directory("how");
    let reference = last_tip(&run(&directory, &small_scene()));
    for (pointer, value) in [
        ("/precision", json!("f64")),
        ("/threads", json!(2)),
        ("/hair_contact", json!(false)),
        ("/colliders", json!([])),
        ("/attachments", json!([])),
        ("/reference_tolerance", json!(1e-6)),
        ("/integrator", json!("second_order")),
        ("/solver", json!("linear_time")),
        ("/strands/0/freedoms", json!(["bend2", "twist", "bend1"])),
        ("/strands/0/initial_curvatures", json!(null)),
        ("/strands/0/initial_rates", json!(null)),
        ("/strands/0/root_motion", json!(null)),
        ("/strands/0/internal_friction", json!(0)),
        ("/gravity", json!([0, 0, -9.81])),
    ] {
        let tip = last_tip(&run(&directory, &with(small_scene(), pointer, value.clone())));
        assert_eq!(tip, reference, "{pointer} {value}");
    }
    // Seven digits of every number, and what a tenth of a second makes of their rounding.
    let single = last_tip(&run(&directory, &with(small_scene(), "/precision", json!("f32"))));
    let off = difference(&single, &reference);
    assert!(off > 0.0 && off < 1e-5, "f32: {off:e} m");
    for solver in ["dense_cholesky", "dense_cg", "dense_svd"] {
        let tip = last_tip(&run(&directory, &with(small_scene(), "/solver", json!(solver))));
        assert!(difference(&tip, &reference) < 1e-7, "{solver}");
    }
    let mut lengths = small_scene();
    let strand = lengths["strands"][0].as_object_mut().unwrap();
    strand.remove("elements");
    strand.remove("length");
    let third = 0.1 / 3.0;
    strand.insert("element_lengths".into(), json!([third, third, third]));
    assert_eq!(last_tip(&run(&directory, &lengths)), reference);
}

#[test]
fn threads_give_the_same_bits() {
    let directory = directory("threads");
    let mut scene = with(small_scene(), "/output", json!(["tips", "curvatures", "rates", "energies"]));
    let strand = scene["strands"][0].clone();
    let strands: Vec<Value> =
        (0..9).map(|index| with(json!([strand]), "/0/length", json!(0.1 + 0.01 * f64::from(index)))[0].clone()).collect();
    scene["strands"] = json!(strands);
    let mut one = run(&directory, &scene);
    let mut three = run(&directory, &with(scene, "/threads", json!(3)));
    one["report"]["seconds"] = json!(0);
    three["report"]["seconds"] = json!(0);
    assert_eq!(one, three);
}

#[test]
fn every_output_has_its_shape() {
    let outputs = ["tips", "points", "frames", "velocities", "curvatures", "rates", "energies", "contacts", "wrenches"];
    let result = run(&directory("outputs"), &with(small_scene(), "/output", json!(outputs)));
    let strand = &result["strands"][0];
    for key in ["tips", "points", "frames", "velocities", "curvatures", "rates", "wrenches"] {
        assert_eq!(strand[key].as_array().unwrap().len(), 6, "{key}");
    }
    for (key, width) in [("points", 3), ("frames", 7), ("velocities", 3)] {
        assert_eq!(strand[key][5].as_array().unwrap().len(), 33, "{key}");
        assert_eq!(strand[key][5][32].as_array().unwrap().len(), width, "{key}");
    }
    assert_eq!(strand["points"][4][32], strand["tips"][4]);
    assert_eq!(numbers(&strand["frames"][4][7])[..3], numbers(&strand["points"][4][7]));
    assert!((numbers(&strand["frames"][4][7])[3..].iter().map(|q| q * q).sum::<f64>() - 1.0).abs() < 1e-12);
    assert_eq!(strand["curvatures"][0], json!([[1.0, 12.0, 3.0], [1.0, 12.0, 3.0], [1.0, 12.0, 3.0]]));
    assert_eq!(strand["rates"][0], json!([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]));
    assert_eq!(result["contacts"], json!([[], [], [], [], [], []]));
    assert_eq!(strand["wrenches"][5]["force"].as_array().unwrap().len(), 3);
    assert_eq!(strand["wrenches"][5]["torque"].as_array().unwrap().len(), 3);
    let energies = &result["energies"];
    assert_eq!(energies[0]["kinetic"], 0.0);
    assert_eq!(energies[0]["elastic"], 0.0);
    assert!(energies[5]["kinetic"].as_f64().unwrap() > 0.0);
    let sum =
        |index: usize| ["kinetic", "elastic", "gravity"].iter().map(|key| energies[index][key].as_f64().unwrap()).sum::<f64>();
    assert!(sum(5) < sum(0), "implicit Euler loses energy, it never gains it");

    let only_tips = run(&directory("outputs"), &small_scene());
    assert_eq!(only_tips["strands"][0].as_object().unwrap().keys().collect::<Vec<_>>(), ["tips"]);
    assert!(only_tips.get("energies").is_none());

    let samples =
        with(with(small_scene(), "/output", json!(["points", {"kind": "velocities", "samples": 2}])), "/samples", json!(5));
    let result = run(&directory("outputs"), &samples);
    assert_eq!(result["strands"][0]["points"][0].as_array().unwrap().len(), 5);
    assert_eq!(result["strands"][0]["velocities"][0].as_array().unwrap().len(), 2);
}

#[test]
fn a_strand_in_balance_weighs_on_its_follicle() {
    // n0 points down: the strand hangs straight and at rest.
    let strand = json!({
        "elements": 4, "length": 0.2, "radius": [50e-6, 50e-6], "density": 1300, "youngs_modulus": 2e9, "poisson_ratio": 0.48,
        "root": {"origin": [0, 0, 1], "rotation": [0, 0.5f64.sqrt(), 0, 0.5f64.sqrt()]}
    });
    let scene = json!({"version": 1, "time_step": 0.01, "duration": 0.1, "strands": [strand], "output": ["wrenches", "energies", "tips"]});
    let result = run(&directory("balance"), &scene);
    let mass = 1300.0 * std::f64::consts::PI * 50e-6 * 50e-6 * 0.2;
    let weight = mass * 9.81;
    let wrench = &result["strands"][0]["wrenches"][10];
    assert!(difference(&numbers(&wrench["force"]), &[0.0, 0.0, -weight]) < 1e-9 * weight, "{wrench}");
    // Its middle is at 0.9 m.
    assert!((result["energies"][0]["gravity"].as_f64().unwrap() - weight * 0.9).abs() < 1e-12 * weight);
    assert!(difference(&last_tip(&result), &[0.0, 0.0, 0.8]) < 1e-12);
}

#[test]
fn initial_state_and_freedoms_are_kept() {
    let scene = with(small_scene(), "/strands/0/initial_curvatures", json!([[1, 2, 3], [4, 5, 6], [7, 8, 9]]));
    let scene = with(scene, "/strands/0/initial_rates", json!([[0.5, 0.25, 0.125]]));
    let scene = with(scene, "/output", json!(["curvatures", "rates"]));
    let result = run(&directory("initial"), &scene);
    let strand = &result["strands"][0];
    assert_eq!(strand["curvatures"][0], json!([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]));
    assert_eq!(strand["rates"][0][2], json!([0.5, 0.25, 0.125]));

    let scene = with(with(small_scene(), "/strands/0/freedoms", json!(["bend2"])), "/output", json!(["curvatures"]));
    let result = run(&directory("freedoms"), &scene);
    let row = numbers(&result["strands"][0]["curvatures"][5][0]);
    assert_eq!(row[..2], [1.0, 12.0]);
    assert!((row[2] - 3.0).abs() > 1e-3, "the freedom that is left must move");
}

/// A root that moves evenly along x at 2 m/s for 0.2 s.
fn even_motion() -> Value {
    let times: Vec<f64> = (0..=20).map(|index| f64::from(index) * 0.01).collect();
    let frames: Vec<[f64; 7]> = times.iter().map(|time| [2.0 * time, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]).collect();
    json!({"times": times, "frames": frames})
}

#[test]
fn a_strand_starts_by_moving_with_its_root() {
    // Without gravity an even motion is no motion: nothing may stir in the strand's own frame.
    let scene = with(with(small_scene(), "/gravity", json!([0, 0, 0])), "/duration", json!(0.2));
    let scene =
        with(with(scene, "/strands/0/root_motion", even_motion()), "/output", json!(["curvatures", "points", "velocities"]));
    let result = run(&directory("even"), &scene);
    let strand = &result["strands"][0];
    for (index, time) in numbers(&result["times"]).iter().enumerate() {
        let root = numbers(&strand["points"][index][0]);
        assert!(difference(&root, &[2.0 * time, 0.0, 0.0]) < 1e-12);
        assert!(difference(&numbers(&strand["velocities"][index][32]), &[2.0, 0.0, 0.0]) < 1e-9, "time {time}");
        assert!(difference(&numbers(&strand["curvatures"][index][1]), &[1.0, 12.0, 3.0]) < 1e-7, "time {time}");
    }
}

#[test]
fn a_root_is_at_its_samples_and_held_outside_them() {
    let frames = json!([[0, 0, 0, 0, 0, 0, 1], [0.02, 0.01, 0, 0, 0, 0.6, 0.8], [0.03, 0.0, 0.01, 0.6, 0, 0, 0.8]]);
    let motion = json!({"times": [0.01, 0.03, 0.05], "frames": frames});
    let scene = with(with(small_scene(), "/strands/0/root_motion", motion), "/output", json!(["frames"]));
    let scene = with(with(scene, "/duration", json!(0.08)), "/strands/0/root", json!({"origin": [9, 9, 9]}));
    let result = run(&directory("samples"), &scene);
    for (index, sample) in [(0, 0), (1, 0), (3, 1), (5, 2), (8, 2)] {
        let root = numbers(&result["strands"][0]["frames"][index][0]);
        let expected = numbers(&frames[sample]);
        let sign = root[3..].iter().zip(&expected[3..]).map(|(one, other)| one * other).sum::<f64>().signum();
        let root: Vec<f64> = root.iter().enumerate().map(|(axis, value)| if axis < 3 { *value } else { sign * value }).collect();
        assert!(difference(&root, &expected) < 1e-9, "time {index}: {root:?} is not {expected:?}");
    }
    // Smooth in between: neither still nor beyond its neighbours' distance.
    let between = numbers(&result["strands"][0]["frames"][2][0]);
    assert!(between[0] > 0.001 && between[0] < 0.019, "{between:?}");
}

/// The head of the reference trajectory `head_yaw_n2`: yaw about z and sway along y, as in tests/oracle/make_references.py.
fn yawing_root(root: &Value, time: f64) -> [f64; 7] {
    let of = |key: &str| root[key].as_f64().unwrap();
    let swing = (std::f64::consts::TAU * of("f") * time).sin() * (1.0 - (-(of("ramp") * time).powi(2)).exp());
    let (yaw, half_tilt) = (of("yaw") * swing, of("tilt") / 2.0);
    let (half_sin, half_cos) = (yaw / 2.0).sin_cos();
    // The product of a turn by the yaw about z and one by the tilt about y.
    let rotation =
        [-half_sin * half_tilt.sin(), half_cos * half_tilt.sin(), half_sin * half_tilt.cos(), half_cos * half_tilt.cos()];
    let radius = of("radius");
    [radius * yaw.cos(), radius * yaw.sin() + of("amp") * swing, 0.0, rotation[0], rotation[1], rotation[2], rotation[3]]
}

#[test]
fn a_moving_head_gives_the_reference_trajectory() {
    let oracle: Value = serde_json::from_str(include_str!("../data/reference/oracle.json")).unwrap();
    let (case, directory) = (&oracle["head_yaw_n2"], directory("oracle"));
    let parameters = &case["parameters"];
    let times: Vec<f64> = (0..=240).map(|index| f64::from(index) / 480.0).collect();
    let frames: Vec<[f64; 7]> = times.iter().map(|time| yawing_root(&parameters["root"], *time)).collect();
    let tips = |steps: f64| {
        let strand = json!({
            "elements": parameters["N"], "length": parameters["L"], "radius": [parameters["a1"], parameters["a2"]],
            "density": parameters["rho"], "youngs_modulus": parameters["E"], "poisson_ratio": parameters["poisson"],
            "internal_friction": parameters["gamma"], "air_drag": parameters["drag"], "natural_curvatures": [parameters["qn"]],
            "root_motion": {"times": times, "frames": frames}
        });
        let scene = json!({
            "version": 1, "gravity": case["gravity"], "time_step": 1.0 / (60.0 * steps), "output_interval": 1.0 / 60.0,
            "duration": parameters["T"], "newton": {"tolerance": 1e-9}, "strands": [strand], "output": ["tips"]
        });
        let result = run(&directory, &scene);
        let tips: Vec<f64> = result["strands"][0]["tips"].as_array().unwrap()[1..].iter().flat_map(numbers).collect();
        tips
    };
    let reference: Vec<f64> = case["tip"].as_array().unwrap().iter().flat_map(numbers).collect();
    let length = parameters["L"].as_f64().unwrap();
    let (coarse, fine) = (tips(32.0), tips(64.0));
    let extrapolated: Vec<f64> = coarse.iter().zip(&fine).map(|(coarse, fine)| 2.0 * fine - coarse).collect();
    let (first, second) = (difference(&coarse, &reference) / length, difference(&fine, &reference) / length);
    assert!((1.7..2.3).contains(&(first / second)), "first order: {first} and {second}");
    assert!(difference(&extrapolated, &reference) / length < 1e-3, "{}", difference(&extrapolated, &reference) / length);
}

#[test]
fn numbers_are_restored_to_the_last_bit() {
    // Numbers that a parser which is right to an ulp only gets wrong.
    let rows = "[[1e-30, 2.2250738585072014e-308, 7.1202363472230444e-307]]";
    let scene = with(with(small_scene(), "/duration", json!(0)), "/output", json!(["curvatures"])).to_string();
    let scene = scene.replace("[[1.0,12.0,3.0]]", rows);
    assert!(scene.contains(rows));
    let (output, result) = run_text(&directory("bits"), &scene);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let row = numbers(&result.unwrap()["strands"][0]["curvatures"][0][0]);
    assert_eq!(row, [1e-30, 2.225_073_858_507_201_4e-308, 7.120_236_347_223_045e-307]);
}

#[test]
fn comments_are_allowed_where_json_allows_spaces() {
    let text = small_scene().to_string().replacen('{', "/* a // comment */ { // and \"another\": 1\n", 1) + "// the end";
    let (output, result) = run_text(&directory("comments"), &text);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    assert_eq!(result.unwrap()["times"].as_array().unwrap().len(), 6);
}

#[test]
fn a_result_replaces_the_old_one_and_leaves_nothing_else() {
    let directory = directory("replace");
    let (scene, result) = (directory.join("scene.json"), directory.join("result.json"));
    std::fs::write(&scene, small_scene().to_string()).unwrap();
    std::fs::write(&result, "old").unwrap();
    let output = superhelix(&["run".as_ref(), scene.as_os_str(), "--out".as_ref(), result.as_os_str()]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    assert!(std::fs::read_to_string(&result).unwrap().starts_with("{\"version\":1"));
    assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 2, "a temporary file is left behind");
    assert!(output.stdout.is_empty() && output.stderr.is_empty(), "a run that went well is quiet when nobody watches");
}

#[test]
fn coarse_elements_are_warned_about() {
    let (output, _) =
        run_text(&directory("coarse"), &with(small_scene(), "/strands/0/natural_curvatures", json!([[0, 200, 0]])).to_string());
    assert_eq!(output.status.code(), Some(0));
    assert!(errors(&output).contains("strands[0]") && errors(&output).contains("13 elements"), "{}", errors(&output));
}

#[test]
fn a_settled_scene_stays_where_it_is() {
    let directory = directory("settled");
    let (scene, result) = (directory.join("scene.json"), directory.join("result.json"));
    let scene_of = |value: &Value| std::fs::write(&scene, value.to_string()).unwrap();
    let mut tips = Vec::new();
    scene_of(&with(with(small_scene(), "/duration", json!(0.5)), "/newton", json!({"tolerance": 1e-9})));
    for flag in [None, Some("--settle")] {
        let mut arguments = vec!["run", scene.to_str().unwrap(), "--out", result.to_str().unwrap()];
        arguments.extend(flag);
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        assert!(errors(&output).is_empty());
        let result: Value = serde_json::from_str(&std::fs::read_to_string(&result).unwrap()).unwrap();
        tips.push((numbers(&result["strands"][0]["tips"][0]), last_tip(&result)));
    }
    assert!(difference(&tips[0].0, &tips[0].1) > 1e-3, "from its natural shape the strand falls: {tips:?}");
    assert!(difference(&tips[0].0, &tips[1].0) > 1e-3, "{tips:?}");
    assert!(difference(&tips[1].0, &tips[1].1) < 1e-8, "{tips:?}");
}

#[test]
fn what_a_killed_run_left_half_written_goes_with_the_next() {
    let directory = directory("killed");
    let first = run(&directory, &small_scene());
    // Without a lock: its writer is dead.
    let part = directory.join(".result.json.3.part");
    std::fs::write(&part, "{\"version\": 1, \"ti").unwrap();
    let second = run(&directory, &small_scene());
    assert!(!part.exists());
    assert_eq!(first["state_hash"], second["state_hash"]);
    let hidden =
        std::fs::read_dir(&directory).unwrap().flatten().filter(|entry| entry.file_name().to_str().unwrap().starts_with('.'));
    assert_eq!(hidden.count(), 0);
}
