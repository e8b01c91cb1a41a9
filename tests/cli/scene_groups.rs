//! `superhelix run`: strands of a scene that are some of a groom's or of follicles, by attribute, index or map, and what is said of them by name.

use std::path::Path;

use serde_json::{Value, json};
use superhelix::io::Curves;

use crate::support::{data, difference, directory, errors, numbers, run, run_text, small_scene, superhelix, with};

const STRANDS: usize = 9;

/// A groom in centimetres of strands in a row along x that leave along z, 1 cm apart, with what a grooming tool says of each.
fn groom(place: &Path) {
    let x = |strand: usize| strand as f64;
    let points: Vec<String> = (0..STRANDS)
        .flat_map(|strand| (0..5).map(move |point| format!("({}, 0, {})", x(strand), 2.0 * f64::from(point))))
        .collect();
    let list = |value: &dyn Fn(usize) -> String| (0..STRANDS).map(value).collect::<Vec<_>>().join(", ");
    let text = format!(
        r#"#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def BasisCurves "hair"
{{
    uniform token type = "linear"
    int[] curveVertexCounts = [{}]
    point3f[] points = [{}]
    int[] primvars:part = [{}] (
        interpolation = "uniform"
    )
    float[] primvars:stiff = [{}] (
        interpolation = "uniform"
    )
    float[] widths = [0.02] (
        interpolation = "constant"
    )
}}
"#,
        list(&|_| "5".into()),
        points.join(", "),
        list(&|strand| (strand % 3).to_string()),
        list(&|strand| (10.0 + strand as f64).to_string()),
    );
    std::fs::write(place.join("groom.usda"), text).unwrap();
}

/// A strip of 10 cm along x with texture coordinates, and a picture whose left half is black.
fn strip(place: &Path) {
    let text = "v -0.005 -0.1 0\nv 0.095 -0.1 0\nv 0.095 0.1 0\nv -0.005 0.1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::fs::write(place.join("strip.obj"), text).unwrap();
    let mut file = std::fs::File::create(place.join("half.png")).unwrap();
    let mut encoder = png::Encoder::new(&mut file, 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header().unwrap().write_image_data(&[0, 255]).unwrap();
}

/// An item of the groom, of bare hairs.
fn item(further: Value) -> Value {
    let mut item = json!({ "groom": { "file": "groom.usda", "elements": 3, "wisp": null, "natural": "as_drawn" } });
    for (key, value) in further.as_object().unwrap() {
        item[key] = value.clone();
    }
    item
}

fn scene(strands: Value) -> Value {
    with(small_scene(), "/strands", strands)
}

/// The scene that `pose` makes, from which can be read what came of strands.
fn posed(place: &Path, scene: &Value) -> Value {
    let (scene_path, posed_path) = (place.join("scene.json"), place.join("posed.json"));
    std::fs::write(&scene_path, scene.to_string()).unwrap();
    let output = superhelix(&["pose".as_ref(), scene_path.as_os_str(), "--out".as_ref(), posed_path.as_os_str()]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&std::fs::read(posed_path).unwrap()).unwrap()
}

/// Which strands of the groom there are, by their roots.
fn which(scene: &Value) -> Vec<usize> {
    let x = |strand: &Value| strand["root"]["origin"][0].as_f64().unwrap();
    scene["strands"].as_array().unwrap().iter().map(|strand| (100.0 * x(strand)).round() as usize).collect()
}

#[test]
fn attributes_of_the_groom_are_maps() {
    let place = directory("scene_attributes");
    groom(&place);
    let maps = json!({
        // From 10 to 18 in the file.
        "youngs_modulus": { "attribute": "stiff", "range": [10, 18], "black": 1e9, "white": 5e9 },
        // The widths are diameters in the file's unit.
        "radius": { "attribute": "thickness", "black": 0, "white": 0.005 },
        "friction": { "attribute": "part" },
    });
    let made = posed(&place, &scene(json!([item(json!({ "maps": maps }))])));
    assert_eq!(which(&made), (0..STRANDS).collect::<Vec<_>>());
    for (strand, made) in made["strands"].as_array().unwrap().iter().enumerate() {
        let near = |value: &Value, expected: f64| {
            let value = value.as_f64().unwrap();
            assert!((value - expected).abs() <= 1e-6 * expected, "{value} for {expected} of {strand}");
        };
        near(&made["youngs_modulus"], 1e9 + 5e8 * strand as f64);
        near(&made["radius"][0], 1e-4);
        near(&made["contact"]["friction"], (strand % 3) as f64);
    }
    // Strands of every second curve have what is said of these.
    let mut every = item(json!({ "maps": { "youngs_modulus": { "attribute": "stiff" } } }));
    every["groom"]["every"] = json!(2);
    let made = posed(&place, &scene(json!([every])));
    let moduli: Vec<f64> =
        made["strands"].as_array().unwrap().iter().map(|strand| strand["youngs_modulus"].as_f64().unwrap()).collect();
    assert_eq!(moduli, [10.0, 12.0, 14.0, 16.0, 18.0]);
}

#[test]
fn an_item_stands_for_the_strands_that_its_conditions_hold_for() {
    let place = directory("scene_groups");
    groom(&place);
    strip(&place);
    let mesh = json!({ "file": "strip.obj" });
    let painted = |test: &str| json!({ "mesh": mesh, "picture": "half.png", test: 0.5 });
    for (only, expected) in [
        (json!({ "attribute": "part", "is": 2 }), vec![2, 5, 8]),
        (json!({ "attribute": "part", "is_not": 2 }), vec![0, 1, 3, 4, 6, 7]),
        (json!({ "attribute": "part", "is": [0, 2] }), vec![0, 2, 3, 5, 6, 8]),
        (json!({ "attribute": "stiff", "at_least": 12, "below": 15 }), vec![2, 3, 4]),
        (json!({ "attribute": "stiff", "range": [10, 18], "black": 0, "white": 1, "at_least": 0.75 }), vec![6, 7, 8]),
        (json!({ "indices": [[1, 3], 7] }), vec![1, 2, 3, 7]),
        (painted("at_least"), vec![5, 6, 7, 8]),
        (painted("below"), vec![0, 1, 2, 3, 4]),
        (json!([{ "attribute": "part", "is_not": 1 }, painted("below"), { "indices": [[1, 8]] }]), vec![2, 3]),
    ] {
        // The middle of the strip is between strands 4 and 5: the fourth is a little left of it.
        let made = posed(&place, &scene(json!([item(json!({ "only": only }))])));
        assert_eq!(which(&made), expected, "{only}");
    }
    // Follicles: both halves together are all of them, each as it is without the other.
    let half = |test: &str| {
        json!({
            "elements": 3, "length": 0.1, "hair": { "type": "african", "variation": { "between": 0.2, "seed": 3 } },
            "follicles": { "file": "strip.obj", "count": 30, "seed": 2 }, "only": { "picture": "half.png", test: 0.5 }
        })
    };
    let mut whole = half("below");
    whole.as_object_mut().unwrap().remove("only");
    let whole = posed(&place, &scene(json!([whole])));
    let halves = posed(&place, &scene(json!([half("below"), half("at_least")])));
    let (whole, halves) = (whole["strands"].as_array().unwrap(), halves["strands"].as_array().unwrap());
    assert_eq!((whole.len(), halves.len()), (30, 30));
    let left = halves.iter().filter(|strand| strand["root"]["origin"][0].as_f64().unwrap() < 0.045).count();
    assert!(left > 10 && left < 20, "{left}");
    assert!(whole.iter().all(|strand| halves.contains(strand)));
}

#[test]
fn targets_and_posing_mean_strands_by_name() {
    let place = directory("scene_names");
    groom(&place);
    let bangs = item(json!({ "name": "bangs", "only": { "attribute": "part", "is": 2 } }));
    let rest =
        item(json!({ "name": "rest", "only": { "attribute": "part", "is_not": 2 }, "youngs_modulus": 4e9, "contact": false }));
    // A strand more of the same name, that is no groom's.
    let single = with(small_scene()["strands"][0].clone(), "/name", json!("bangs"));
    let strands = json!([bangs, rest, single]);
    let timed = |scene: Value| with(with(scene, "/duration", json!(0.2)), "/gravity", json!([9.81, 0, 0]));
    let free = run(&place, &timed(scene(strands.clone())));
    let held = timed(with(scene(strands.clone()), "/targets", json!([{ "strands": "bangs", "weights": [[0, 1]] }])));
    let tips = |result: &Value, strand: usize| -> Vec<Vec<f64>> {
        result["strands"][strand]["tips"].as_array().unwrap().iter().map(numbers).collect()
    };
    let moved = |result: &Value, strand: usize| difference(&tips(result, strand)[0], tips(result, strand).last().unwrap());
    let is_bangs = |strand: usize| strand < 3 || strand == 9;
    let check = |result: &Value| {
        for strand in 0..10 {
            assert_eq!(result["strands"][strand]["name"], if is_bangs(strand) { "bangs" } else { "rest" });
            if is_bangs(strand) {
                assert!(moved(result, strand) < 1e-3 && moved(&free, strand) > 1e-2, "{strand}: {}", moved(result, strand));
            } else {
                assert_eq!(tips(result, strand), tips(&free, strand));
            }
        }
    };
    let result = run(&place, &held);
    assert_eq!(result["strands"].as_array().unwrap().len(), 10);
    check(&result);
    // A list of items and names is the same; and so is the scene that pose writes, in which each strand is an item.
    check(&run(&place, &with(held.clone(), "/targets/0/strands", json!([2, "bangs", 0]))));
    for strands in [json!("bangs"), json!([0, 2])] {
        let made = posed(&place, &with(held.clone(), "/targets/0/strands", strands));
        assert_eq!(made["targets"][0]["strands"], json!([0, 1, 2, 9]));
        check(&run(&place, &made));
    }
    // Posing.
    let cut = json!([{ "do": "cut", "strands": "bangs", "arclength": 0.03 }]);
    let made = posed(&place, &with(scene(strands), "/posing", cut));
    for (strand, made) in made["strands"].as_array().unwrap().iter().enumerate() {
        let length: f64 = numbers(&made["element_lengths"]).iter().sum();
        assert!((length < 0.031) == is_bangs(strand), "{strand}: {length}");
        assert_eq!(made["youngs_modulus"] == json!(4e9), (3..9).contains(&strand), "{strand}");
    }
}

#[test]
fn what_selects_nothing_or_is_not_there_is_named() {
    let place = directory("scene_groups_bad");
    groom(&place);
    strip(&place);
    let plain = small_scene()["strands"][0].clone();
    let only = |only: Value| item(json!({ "only": only }));
    let map = |map: Value| item(json!({ "maps": { "friction": map } }));
    let hair = json!({ "groom": { "file": data("blender_wavy.hair"), "metres_per_unit": 1, "every": 500 } });
    let obj = "v 0 0 0\nv 0 0 1\nl 1 2\n";
    std::fs::write(place.join("bare.obj"), obj).unwrap();
    for (strand, key, shown) in [
        (map(json!({ "attribute": "stif" })), "strands[0].maps.friction.attribute", "part, stiff"),
        (map(json!({ "attribute": 3 })), "maps.friction.attribute", "name of an attribute"),
        (map(json!({ "attribute": "stiff", "black": 1 })), "maps.friction.black", "neither"),
        (map(json!({ "attribute": "stiff", "range": [0, 1] })), "maps.friction.range", "black and white"),
        (map(json!({ "attribute": "stiff", "black": 0, "white": 1, "range": [2, 2] })), "maps.friction.range", "different"),
        (map(json!({ "attribute": "stiff", "picture": "half.png" })), "maps.friction.attribute", "beside picture"),
        (map(json!({ "picture": "half.png", "black": 0, "white": 1 })), "maps.mesh", "missing"),
        (map(json!({ "attribute": "stiff", "black": -20, "white": -30 })), "maps.friction", "0 or more"),
        (with(hair, "/maps", json!({ "friction": { "attribute": "stiff" } })), "maps.friction.attribute", "blender_wavy.hair"),
        (
            json!({ "groom": { "file": "bare.obj", "metres_per_unit": 1 }, "maps": { "friction": { "attribute": "stiff" } } }),
            "maps.friction.attribute",
            "no attributes",
        ),
        (
            with(plain.clone(), "/maps", json!({ "mesh": { "file": "strip.obj" }, "friction": { "attribute": "stiff" } })),
            "maps.friction.attribute",
            "groom",
        ),
        (
            only(json!({ "attribute": "part", "is": 7 })),
            "strands[0].only",
            "none of 9 strands; values of strands[0].only are 0 to 2",
        ),
        (only(json!({ "attribute": "part" })), "strands[0].only", "is_not"),
        (only(json!({ "attribute": "parts", "is": 7 })), "strands[0].only.attribute", "part, stiff"),
        (only(json!({ "is": 7 })), "strands[0].only", "attribute"),
        (only(json!({ "indices": [9] })), "strands[0].only.indices", "below 9"),
        (only(json!({ "indices": [[3, 1]] })), "strands[0].only.indices[0][1]", "3 to"),
        (only(json!({ "indices": ["a"] })), "strands[0].only.indices[0]", "[first, last]"),
        (only(json!({ "indices": [1], "is": 2 })), "strands[0].only.is", "beside indices"),
        (only(json!([])), "strands[0].only", "list of conditions"),
        (only(json!({ "picture": "half.png", "below": 0.5 })), "strands[0].only.mesh", "missing"),
        (only(json!({ "group": "a" })), "strands[0].only.group", "known"),
        (with(plain.clone(), "/only", json!({ "indices": [0] })), "strands[0].only", "without groom or follicles"),
        (with(plain.clone(), "/name", json!("")), "strands[0].name", "a name"),
    ] {
        let (output, result) = run_text(&place, &scene(json!([strand])).to_string());
        let message = errors(&output);
        assert_eq!((output.status.code(), result), (Some(2), None), "{key}: {message}");
        assert!(message.contains(key) && message.contains(shown), "{key}, {shown}: {message}");
    }
    let named = scene(json!([with(plain.clone(), "/name", json!("bangs"))]));
    for (scene, key, shown) in [
        (with(named.clone(), "/targets", json!([{ "strands": "bang" }])), "targets[0].strands", "bangs"),
        (with(named.clone(), "/targets", json!([{ "strands": [] }])), "targets[0].strands", "at least one"),
        (with(named.clone(), "/targets", json!([{ "strands": ["bangs", 1] }])), "targets[0].strands[1]", "0 to 0"),
        (with(named.clone(), "/targets", json!([{ "strands": 0 }, { "strands": "bangs" }])), "targets[1]", "before"),
        (with(named, "/posing", json!([{ "do": "cut", "strands": "b", "arclength": 1 }])), "posing[0].strands", "bangs"),
        (with(scene(json!([plain])), "/targets", json!([{ "strands": "b" }])), "targets[0].strands", "none of the scene"),
    ] {
        let (output, _) = run_text(&place, &scene.to_string());
        let message = errors(&output);
        assert!(output.status.code() == Some(2) && message.contains(key) && message.contains(shown), "{key}, {shown}: {message}");
    }
}

/// A strand of which the file says nothing is an error of a map, and among the others for a condition.
#[test]
fn strands_without_a_number_are_named() {
    let place = directory("scene_groups_without");
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float part\n\
                element strand 2\nproperty int nsegs\nend_header\n0 0 0 1\n0 0 0.1 1\n0.01 0 0 nan\n0.01 0 0.1 1\n1\n1\n";
    std::fs::write(place.join("two.ply"), text).unwrap();
    let item = |further: Value| {
        let item = json!({ "groom": { "file": "two.ply", "metres_per_unit": 1, "wisp": null, "natural": "as_drawn" } });
        with(with(item, "/maps", Value::Null), "/only", further)
    };
    let (output, _) = run_text(
        &place,
        &scene(json!([with(item(Value::Null), "/maps", json!({ "friction": { "attribute": "part" } }))])).to_string(),
    );
    let message = errors(&output);
    assert!(message.contains("maps.friction") && message.contains("no number for strand 1"), "{message}");
    for (only, expected) in [
        (json!({ "attribute": "part", "is": 1 }), vec![0]),
        (json!({ "attribute": "part", "at_least": -5 }), vec![0]),
        (json!({ "attribute": "part", "is_not": 1 }), vec![1]),
    ] {
        assert_eq!(which(&posed(&place, &scene(json!([item(only)])))), expected);
    }
    // And the command that says what a file has says it of it.
    assert_eq!(Curves::read(place.join("two.ply")).unwrap().strand_count(), 2);
    let output = superhelix(&["info".as_ref(), place.join("two.ply").as_os_str()]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("attribute             part: 1; 1 strands have none"), "{text}");
}
