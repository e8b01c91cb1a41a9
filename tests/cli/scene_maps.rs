//! `superhelix run`: parameters of strands from pictures and numbers on a mesh, at their roots.

use std::path::Path;

use serde_json::{Value, json};

use crate::support::{data, directory, errors, numbers, run, small_scene, superhelix, with};

/// A square of 20 cm in the plane z = 0 with texture coordinates 0 to 1 along x and y.
fn square(place: &Path) {
    let text =
        "v -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0.1 0.1 0\nv -0.1 0.1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::fs::write(place.join("square.obj"), text).unwrap();
}

/// A picture of two pixels side by side: black, white.
fn picture(place: &Path) {
    let mut file = std::fs::File::create(place.join("half.png")).unwrap();
    let mut encoder = png::Encoder::new(&mut file, 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header().unwrap().write_image_data(&[0, 255]).unwrap();
}

/// Strands on the square with maps; posed, so that what came of them can be read.
fn posed(place: &Path, strand: Value) -> Vec<Value> {
    let scene = with(small_scene(), "/strands", json!([strand]));
    let (scene_path, posed_path) = (place.join("scene.json"), place.join("posed.json"));
    std::fs::write(&scene_path, scene.to_string()).unwrap();
    let output = superhelix(&["pose".as_ref(), scene_path.as_os_str(), "--out".as_ref(), posed_path.as_os_str()]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let scene: Value = serde_json::from_slice(&std::fs::read(posed_path).unwrap()).unwrap();
    scene["strands"].as_array().unwrap().clone()
}

fn strand(maps: Value) -> Value {
    json!({
        "elements": 4, "length": 0.1, "natural_curvatures": [[1, 20, 0]],
        "follicles": { "file": "square.obj", "count": 40, "seed": 2 },
        "maps": maps
    })
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn values_are_those_of_the_picture_and_of_the_vertices_at_the_root() {
    let place = directory("maps");
    square(&place);
    picture(&place);
    // 1 at the left side, 3 at the right.
    std::fs::write(place.join("curl.txt"), "1 3 3 1").unwrap();
    std::fs::write(place.join("length.txt"), "0.05 0.15 0.15 0.05").unwrap();
    let strands = posed(
        &place,
        strand(json!({
            "youngs_modulus": { "picture": "half.png", "black": 1e9, "white": 5e9 },
            "friction": { "picture": "half.png", "black": 0.1, "white": 0.5 },
            "radius": { "picture": "half.png", "black": 4e-5, "white": 8e-5 },
            "curl": { "vertices": "curl.txt" },
            "length": { "vertices": "length.txt" }
        })),
    );
    assert_eq!(strands.len(), 40);
    let mut sides = [0; 2];
    for strand in &strands {
        let u = (number(&strand["root"]["origin"][0]) + 0.1) / 0.2;
        sides[usize::from(u > 0.5)] += 1;
        // Between the middles of the two pixels, a quarter and three quarters, the brightness rises linearly.
        let bright = ((u - 0.25) / 0.5).clamp(0.0, 1.0);
        let near = |value: &Value, expected: f64| {
            assert!((number(value) / expected - 1.0).abs() < 1e-9, "{value} for {expected} at {u}");
        };
        near(&strand["youngs_modulus"], 1e9 + 4e9 * bright);
        near(&strand["contact"]["friction"], 0.1 + 0.4 * bright);
        near(&strand["radius"][0], 4e-5 + 4e-5 * bright);
        near(&strand["natural_curvatures"][2][1], 20.0 * (1.0 + 2.0 * u));
        let lengths = numbers(&strand["element_lengths"]);
        near(&json!(lengths.iter().sum::<f64>()), 0.05 + 0.1 * u);
        assert!(lengths.iter().all(|length| (length - lengths[0]).abs() < 1e-15));
    }
    assert!(sides.iter().all(|count| *count > 10), "{sides:?}");
}

#[test]
fn the_strands_of_a_groom_are_wisps_of_what_the_maps_say() {
    let place = directory("maps_groom");
    square(&place);
    std::fs::write(place.join("drag.txt"), "1e-6 5e-6 5e-6 1e-6").unwrap();
    let mut groom = String::new();
    for k in 0..6 {
        let x = -0.09 + 0.03 * f64::from(k);
        groom += &format!("v {x} 0 0\nv {x} 0.01 0.05\nv {x} 0.03 0.08\nl {} {} {}\n", 3 * k + 1, 3 * k + 2, 3 * k + 3);
    }
    std::fs::write(place.join("groom.obj"), groom).unwrap();
    let drag = json!({ "mesh": { "file": "square.obj" }, "air_drag": { "vertices": "drag.txt" } });
    let item = json!({ "groom": { "file": "groom.obj", "metres_per_unit": 1 }, "maps": drag });
    let strands = posed(&place, item);
    for (k, strand) in strands.iter().enumerate() {
        let u = (-0.09 + 0.03 * k as f64 + 0.1) / 0.2;
        // A wisp has the drag of its 200 hairs.
        assert!((number(&strand["air_drag"]) / (200.0 * (1e-6 + 4e-6 * u)) - 1.0).abs() < 1e-6, "{}", strand["air_drag"]);
    }
    // It runs.
    let scene = with(small_scene(), "/strands", json!([strand(json!({ "curl": { "vertices": "drag.txt" } }))]));
    assert_eq!(run(&place, &scene)["strands"].as_array().unwrap().len(), 40);
}

#[test]
fn bad_maps_are_named() {
    let place = directory("maps_bad");
    square(&place);
    picture(&place);
    std::fs::write(place.join("three.txt"), "1 2 3").unwrap();
    std::fs::write(place.join("bare.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let half = json!({ "picture": "half.png", "black": 0, "white": 1 });
    let groom = json!({ "groom": { "file": data("blender_wavy.hair"), "metres_per_unit": 1, "every": 500 } });
    for (strand, key, shown) in [
        (strand(json!({ "colour": half })), "maps.colour", "known"),
        (strand(json!({ "curl": { "vertices": "three.txt" } })), "maps.curl.vertices", "4 numbers"),
        (strand(json!({ "curl": { "vertices": "three.txt", "black": 1 } })), "maps.curl.black", "vertices"),
        (strand(json!({ "curl": { "picture": "half.png", "black": 1 } })), "maps.curl.white", "missing"),
        (strand(json!({ "curl": {} })), "maps.curl", "picture"),
        (strand(json!({ "mesh": { "file": "bare.obj" }, "curl": half })), "maps.curl.picture", "texture coordinates"),
        (strand(json!({ "density": half })), "density", "above zero"),
        (strand(json!({ "friction": { "picture": "half.png", "black": -1, "white": -1 } })), "maps.friction", "-1"),
        (with(small_scene()["strands"][0].clone(), "/maps", json!({ "curl": half })), "maps.mesh", "missing"),
        (with(groom, "/maps", json!({ "mesh": { "file": "square.obj" }, "length": half })), "maps.length", "shapes from a file"),
    ] {
        let scene = with(small_scene(), "/strands", json!([strand]));
        let path = place.join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        let output = superhelix(&["run".as_ref(), path.as_os_str(), "--out".as_ref(), place.join("result.json").as_os_str()]);
        let text = errors(&output);
        assert!(output.status.code() == Some(2) && text.contains(key) && text.contains(shown), "{key}, {shown}: {text}");
    }
}
