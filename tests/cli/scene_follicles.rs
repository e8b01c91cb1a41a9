//! `superhelix run`: strands that are placed on a mesh, and the cache of a run; `superhelix pose` of such scenes.

use std::path::Path;

use crate::support::{data, difference, directory, errors, numbers, run, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};
use superhelix::io::CurveCache;

/// A square of 20 cm in the plane z = 0, facing up, in centimetres.
fn square(place: &Path) {
    std::fs::write(place.join("square.obj"), "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n").unwrap();
}

/// Strands on the square, which a frame 30 cm aside carries a quarter turn about z in the scene's time; the motion has two samples only.
fn scene() -> Value {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let strand = json!({
        "elements": 2, "length": 0.05, "contact": false,
        "hair": { "type": "caucasian2", "variation": { "between": 0.1, "root_turn": 1.0, "seed": 3 } },
        "follicles": { "file": "square.obj", "scale": 0.01, "count": 12, "pose": { "origin": [0.3, 0, 0.1] }, "seed": 5 },
        "root_motion": { "times": [0.0, 0.05], "frames": [[0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, half, half]] }
    });
    let scene = with(small_scene(), "/strands", json!([small_scene()["strands"][0], strand]));
    with(with(scene, "/samples", json!(5)), "/output", json!(["points", "frames", "velocities", "curvatures"]))
}

fn roots(result: &Value, time: usize) -> Vec<Vec<f64>> {
    let strands = result["strands"].as_array().unwrap();
    strands[1..].iter().map(|strand| numbers(&strand["frames"][time][0])).collect()
}

#[test]
fn strands_stand_on_a_mesh_and_go_with_it() {
    let place = directory("scene_follicles");
    square(&place);
    let result = run(&place, &scene());
    let first = roots(&result, 0);
    assert_eq!(first.len(), 12);
    let last = result["times"].as_array().unwrap().len() - 1;
    for time in 0..=last {
        let now = roots(&result, time);
        // The first root's rotation is that of all, at any time: roots move rigidly with the mesh, not along paths of their own.
        let turn = now[0][1].atan2(now[0][0]) - first[0][1].atan2(first[0][0]);
        for (now, first) in now.iter().zip(&first) {
            let (sine, cosine) = turn.sin_cos();
            let carried = [cosine * first[0] - sine * first[1], sine * first[0] + cosine * first[1], first[2]];
            assert!(difference(&now[..3], &carried) < 1e-12, "{time}: {now:?} {carried:?}");
            // n0 is the normal, up all the time: what the quaternion takes x to.
            let [x, y, z, w] = [now[3], now[4], now[5], now[6]];
            let n0 = [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)];
            assert!(difference(&n0, &[0.0, 0.0, 1.0]) < 1e-9, "{n0:?}");
        }
    }
    // On the mesh, where its pose is; and turned by a quarter at the end.
    for root in &first {
        assert!((root[2] - 0.1).abs() < 1e-12 && (root[0] - 0.3).abs() <= 0.1 && root[1].abs() <= 0.1, "{root:?}");
    }
    assert!(roots(&result, last).iter().zip(&first).all(|(now, first)| (now[1] - first[0]).abs() < 1e-9));
    // They start with the motion's velocity there, rigidly: a quarter turn in 0.05 s (samples of velocities along a curl are good to 1e-4).
    let rate = std::f64::consts::FRAC_PI_2 / 0.05;
    for (strand, root) in first.iter().enumerate() {
        let velocity = numbers(&result["strands"][1 + strand]["velocities"][0][0]);
        assert!(difference(&velocity, &[-rate * root[1], rate * root[0], 0.0]) < 1e-3 * rate * root[0], "{velocity:?} {root:?}");
    }
    // Neighbours of a kind differ.
    let shapes: Vec<Vec<f64>> = (1..13).map(|strand| numbers(&result["strands"][strand]["curvatures"][0][0])).collect();
    assert!(shapes.windows(2).all(|pair| difference(&pair[0], &pair[1]) > 1e-3));
}

#[test]
fn a_posed_scene_has_the_strands_of_the_scene() {
    let place = directory("scene_follicles_posed");
    square(&place);
    // A groom before the others: items of the list are not strands.
    let groom = json!({ "groom": { "file": data("sintel_hair_001.tfx"), "metres_per_unit": 0.01, "every": 60, "elements": 4 },
                        "contact": { "radius": 1e-4 } });
    let mut scene = scene();
    scene["strands"].as_array_mut().unwrap().insert(0, groom);
    let (given, posed) = (place.join("given.json"), place.join("posed.json"));
    std::fs::write(&given, scene.to_string()).unwrap();
    let output = superhelix(&["pose".as_ref(), given.as_os_str(), "--out".as_ref(), posed.as_os_str()]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let document: Value = serde_json::from_str(&std::fs::read_to_string(&posed).unwrap()).unwrap();
    let (one, other) = (run(&place, &scene), run(&place, &document));
    let strands = |result: &Value| result["strands"].as_array().unwrap().clone();
    assert_eq!((strands(&one).len(), strands(&other).len()), (4 + 1 + 12, 4 + 1 + 12));
    for (index, (one, other)) in strands(&one).iter().zip(strands(&other)).enumerate() {
        for (one, other) in one["points"].as_array().unwrap().iter().zip(other["points"].as_array().unwrap()) {
            for (one, other) in one.as_array().unwrap().iter().zip(other.as_array().unwrap()) {
                assert!(difference(&numbers(one), &numbers(other)) < 1e-9, "strand {index}: {one} {other}");
            }
        }
    }
}

#[test]
fn a_run_leaves_a_cache_that_becomes_render_hair() {
    let place = directory("scene_cache");
    square(&place);
    let [scene_path, result_path, cache, render] =
        ["scene.json", "result.json", "strands.usda", "render.usda"].map(|name| place.join(name).display().to_string());
    std::fs::write(&scene_path, scene().to_string()).unwrap();
    let output = superhelix(&["run", &scene_path, "--out", &result_path, "--cache", &cache, "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let result: Value = serde_json::from_str(&std::fs::read_to_string(&result_path).unwrap()).unwrap();
    let frames = CurveCache::read(&cache).unwrap();
    assert!(difference(frames.times(), &numbers(&result["times"])) < 1e-12);
    for index in 0..frames.times().len() {
        let curves = frames.frame(index).unwrap();
        assert_eq!((curves.strand_count(), curves.point_count()), (13, 65));
        let velocities = curves.extras().velocities.clone().unwrap();
        for strand in 0..13 {
            for point in 0..5 {
                let at = 5 * strand + point;
                let of = |name: &str| numbers(&result["strands"][strand][name][index][point]);
                let wide = |numbers: [f32; 3]| numbers.map(f64::from);
                assert!(difference(&of("points"), &wide(curves.points()[at])) < 1e-7);
                assert!(difference(&of("velocities"), &wide(velocities[at])) < 1e-6 * (1.0 + of("velocities")[1].abs()));
            }
        }
    }
    let output = superhelix(&["interpolate", &cache, "--count", "30", "--out", &render, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let said: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((said["guides"].as_u64(), said["velocities"].as_bool()), (Some(13), Some(true)));
    let output = superhelix(&["run", &scene_path, "--out", &result_path, "--cache", "strands.hair"]);
    assert!(output.status.code() == Some(1) && errors(&output).contains("strands.hair: is no .usda file"));
}

#[test]
fn follicles_that_cannot_be_are_refused_by_name() {
    let place = directory("scene_follicles_refused");
    square(&place);
    std::fs::write(place.join("numbers.txt"), "1 2 3").unwrap();
    let at = "/strands/1/follicles";
    for (scene, key, shown) in [
        (with(scene(), at, json!({"count": 3})), "strands[1].follicles.file", "is missing"),
        (with(scene(), at, json!({"file": "none.obj", "count": 3})), "strands[1].follicles.file", "none.obj"),
        (with(scene(), at, json!({"file": "square.obj"})), "strands[1].follicles.count", "is missing"),
        (with(scene(), at, json!({"file": "square.obj", "count": 0})), "strands[1].follicles.count", "0"),
        (with(scene(), at, json!({"file": "square.obj", "count": 3, "spacing": 0.1})), "strands[1].follicles.spacing", "count"),
        (with(scene(), at, json!({"file": "square.obj", "spacing": -1})), "strands[1].follicles.spacing", "-1"),
        (with(scene(), at, json!({"file": "square.obj", "spacing": 1e-9})), "strands[1].follicles.spacing", "0.000000001"),
        (
            with(scene(), at, json!({"file": "square.obj", "count": 3, "density": "numbers.txt"})),
            "strands[1].follicles.density",
            "3",
        ),
        (with(scene(), at, json!({"file": "square.obj", "count": 3, "colour": 1})), "strands[1].follicles.colour", "1"),
        (with(scene(), "/strands/1/root", json!({})), "strands[1].root", "follicles"),
        (with(scene(), "/strands/1/root_motion/local", json!({"rotation": [0, 0, 0, 2]})), "strands[1].root_motion.local", "2"),
    ] {
        let (output, result) = run_text(&place, &scene.to_string());
        let text = errors(&output);
        assert!(output.status.code() == Some(2) && result.is_none(), "{text}");
        assert!(text.contains(key) && text.contains(shown), "{key}, {shown}: {text}");
    }
}
