//! `superhelix run`: strands of a scene that come from a groom.

use crate::support::{data, difference, directory, errors, numbers, run, run_text, small_scene, with};
use serde_json::{Value, json};
use superhelix::io::Curves;

const SCALE: f64 = 0.01;
const EVERY: usize = 40;

fn scene(groom: Value) -> Value {
    let strand = json!({"groom": groom, "radius": [8e-5, 8e-5], "internal_friction": 1e-9, "contact": false});
    let one = small_scene()["strands"][0].clone();
    with(with(small_scene(), "/strands", json!([one, strand])), "/duration", json!(1.0))
}

#[test]
fn a_groom_stands_where_it_is_put_and_hangs_as_it_is_drawn() {
    let place = directory("scene_groom");
    let file = data("sintel_hair_001.tfx");
    // The file has y up, the scene z: a quarter turn about x, and ten centimetres aside.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = json!({"origin": [0.1, 0, 0], "rotation": [half, 0, 0, half]});
    let groom = json!({"file": file, "metres_per_unit": SCALE, "every": EVERY, "tolerance": 5e-4, "pose": pose});
    let result = run(&place, &scene(groom));
    let strands = result["strands"].as_array().unwrap();
    let curves = Curves::read(&file).unwrap();
    let count = curves.strand_count().div_ceil(EVERY);
    assert_eq!(strands.len(), 1 + count);
    for k in 0..count {
        let tips = strands[1 + k]["tips"].as_array().unwrap();
        let [x, y, z] = curves.strand(k * EVERY).last().unwrap().map(|x| SCALE * f64::from(x));
        let (first, last) = (numbers(&tips[0]), numbers(tips.last().unwrap()));
        assert!(difference(&first, &[x + 0.1, -z, y]) < 5e-4, "{k}: {first:?}");
        assert!(difference(&first, &last) < 1e-6, "{k}: {first:?} {last:?}");
    }
    // The strand before it falls as it did.
    let tips = strands[0]["tips"].as_array().unwrap();
    assert!(difference(&numbers(&tips[0]), &numbers(tips.last().unwrap())) > 1e-3);

    // Not made to rest, it sags.
    let drawn = json!({"file": file, "metres_per_unit": SCALE, "every": EVERY, "elements": 6, "natural": "as_drawn", "wisp": null, "pose": pose});
    let result = run(&place, &scene(drawn));
    let sags = |strand: &Value| {
        let tips = strand["tips"].as_array().unwrap();
        difference(&numbers(&tips[0]), &numbers(tips.last().unwrap())) > 1e-4
    };
    assert!(result["strands"].as_array().unwrap()[1..].iter().all(sags));
}

/// Each curve is a wisp unless the scene says otherwise, and keeps its style where single hairs as thin as hair is do not.
#[test]
fn strands_of_a_groom_are_wisps() {
    let place = directory("scene_groom_wisps");
    let file = data("sintel_hair_001.tfx");
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = json!({"rotation": [half, 0, 0, half]});
    let moved = |wisp: Option<Value>| {
        let groom = json!({"file": file, "metres_per_unit": SCALE, "every": EVERY, "pose": pose});
        let groom = if let Some(wisp) = wisp { with(groom, "/wisp", wisp) } else { groom };
        let scene = with(scene(groom), "/strands/1/radius", json!([3.5e-5, 3.5e-5]));
        // A gust of half a second.
        let result = run(&place, &with(with(scene, "/wind", json!([3.0, 0, 0])), "/strands/1/air_drag", json!(5e-6)));
        let strands = result["strands"].as_array().unwrap()[1..].to_vec();
        let tips = strands.iter().map(|strand| strand["tips"].as_array().unwrap().clone());
        tips.map(|tips| difference(&numbers(&tips[0]), &numbers(tips.last().unwrap()))).fold(0.0, f64::max)
    };
    let (usual, firm, bare) = (moved(None), moved(Some(json!({"hold": 0.9}))), moved(Some(Value::Null)));
    println!("moved by {usual} m, {firm} held firmly, {bare} bare");
    assert!(firm < 0.6 * usual && usual < 0.5 * bare, "{firm} {usual} {bare}");
}

#[test]
fn a_groom_that_is_none_is_refused_by_name() {
    let place = directory("scene_groom_refused");
    let file = data("sintel_hair_001.tfx");
    let good = json!({"file": file, "metres_per_unit": SCALE, "every": EVERY});
    for (groom, key, shown) in [
        (json!({"metres_per_unit": 1}), "strands[1].groom.file", "is missing"),
        (json!({"file": "none.tfx", "metres_per_unit": 1}), "strands[1].groom.file", "none.tfx"),
        (json!({"file": file}), "strands[1].groom.metres_per_unit", "does not say its unit"),
        (with(good.clone(), "/metres_per_unit", json!(0)), "strands[1].groom.metres_per_unit", "0"),
        (with(good.clone(), "/every", json!(0)), "strands[1].groom.every", "0"),
        (with(good.clone(), "/elements", json!(0)), "strands[1].groom.elements", "0"),
        (with(good.clone(), "/natural", json!("limp")), "strands[1].groom.natural", "limp"),
        (with(good.clone(), "/colour", json!("red")), "strands[1].groom.colour", "red"),
        // Hair of less than its own width.
        (with(good.clone(), "/metres_per_unit", json!(1e-7)), "strands[1].groom.file", "its strand 0"),
        (with(good.clone(), "/wisp", json!({"hold": 1.5})), "strands[1].groom.wisp.hold", "1.5"),
        (with(good.clone(), "/wisp", json!({"hairs": 0})), "strands[1].groom.wisp.hairs", "0"),
        (with(good.clone(), "/wisp", json!({"hair": 3})), "strands[1].groom.wisp.hair", "3"),
        (json!(7), "strands[1].groom", "7"),
    ] {
        let (output, result) = run_text(&place, &scene(groom).to_string());
        let message = errors(&output);
        assert_eq!((output.status.code(), result), (Some(2), None), "{key}: {message}");
        assert!(message.contains(key) && message.contains(shown), "{key}, {shown}: {message}");
    }
    let (output, _) = run_text(&place, &with(scene(good), "/strands/1/length", json!(0.1)).to_string());
    assert!(errors(&output).contains("strands[1].length"), "{}", errors(&output));
}
