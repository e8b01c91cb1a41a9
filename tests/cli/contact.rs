//! `superhelix run`, `bake` and `picture` with bodies, contact and attachments.

use std::path::Path;

use crate::support::{difference, directory, errors, numbers, run, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;
/// How deep surfaces may be in each other in these scenes, m: a fifth of what contact tolerates by default.
const TOLERANCE: f64 = 1e-5;
/// The default of `contact.tolerance`, m: so deep a strand may lie between its touches.
const BETWEEN_TOUCHES: f64 = 5e-5;

/// A limp strand of 20 cm along x whose surface lies on the plane z = 0.
fn lying() -> Value {
    json!({"elements": 8, "length": 0.2, "youngs_modulus": 1e6, "root": {"origin": [0, 0, 50e-6]}})
}

fn scene_of(strands: Value, seconds: f64) -> Value {
    json!({
        "version": 1, "time_step": 1.0 / 60.0, "duration": seconds, "output_interval": seconds, "strands": strands,
        "output": ["points", "contacts", "wrenches", "attachments"]
    })
}

fn vector(value: &Value) -> [f64; 3] {
    numbers(value).try_into().unwrap()
}

fn sum<'a>(vectors: impl Iterator<Item = &'a Value>) -> Vec<f64> {
    vectors.fold(vec![0.0; 3], |sum, value| sum.iter().zip(numbers(value)).map(|(a, b)| a + b).collect())
}

fn last(series: &Value) -> &Value {
    series.as_array().unwrap().last().unwrap()
}

#[test]
fn contacts_bear_the_weight_and_act_on_the_collider_as_well() {
    for model in ["penalty", "regularised", "at_points", "hard", "coulomb"] {
        let scene = with(scene_of(json!([lying()]), 1.0), "/colliders", json!([{"shape": "halfspace"}]));
        let scene = with(scene, "/contact", json!({"model": model}));
        let result = run(&directory(&format!("weight_{model}")), &scene);
        let contacts = last(&result["contacts"]).as_array().unwrap();
        assert!(!contacts.is_empty());
        let force = sum(contacts.iter().map(|contact| &contact["force"]));
        let on_collider = numbers(&last(&result["colliders"][0]["wrenches"])["force"]);
        assert!((0..3).all(|axis| (force[axis] + on_collider[axis]).abs() < 1e-15), "{force:?} {on_collider:?}");
        let root = numbers(&last(&result["strands"][0]["wrenches"])["force"]);
        let weight = 1300.0 * std::f64::consts::PI * 50e-6 * 50e-6 * 0.2 * GRAVITY;
        // Coulomb's contacts are solved to 1e-6 and hard ones to 1e-4; the penalty models still swing a little.
        let allowed = match model {
            "coulomb" => 1e-5,
            "hard" => 1e-4,
            _ => 2e-2,
        };
        assert!((force[2] - root[2] - weight).abs() < allowed * weight, "{model}: {force:?} {root:?} {weight}");
        for contact in contacts {
            assert_eq!((&contact["strand"], &contact["collider"], &contact["feature"]), (&json!(0), &json!(0), &json!(0)));
            assert!(difference(&numbers(&contact["normal"]), &[0.0, 0.0, 1.0]) < 1e-12);
            let at = vector(&contact["position"]);
            assert!((at[0] - contact["arclength"].as_f64().unwrap()).abs() < 1e-6, "{contact}");
            assert!((at[2] - 50e-6 - contact["gap"].as_f64().unwrap()).abs() < 1e-12, "{contact}");
        }
        let told = &result["report"]["contact"];
        assert!(told["contacts_max"].as_u64().unwrap() as usize >= contacts.len());
        assert_eq!(told["unconverged"], 0);
        assert!(told["penetration_max"].as_f64().unwrap() < if allowed < 1e-3 { TOLERANCE } else { 1e-3 }, "{told}");
    }
}

#[test]
fn a_colliders_friction_is_coulombs_coefficient() {
    // Across the slope only the root, and what stiffness the strand has, hold it.
    let way = |share: f64, keys: Value| {
        let angle = (0.4 * share).atan();
        let scene =
            with(scene_of(json!([lying()]), 0.5), "/gravity", json!([0.0, GRAVITY * angle.sin(), -GRAVITY * angle.cos()]));
        let mut scene = with(scene, "/contact", json!({"model": "coulomb"}));
        for (pointer, value) in keys.as_object().unwrap() {
            scene = with(scene, pointer, value.clone());
        }
        let result = run(&directory("slope"), &scene);
        let points = result["strands"][0]["points"].as_array().unwrap();
        difference(&numbers(&points[0][32]), &numbers(&points[points.len() - 1][32]))
    };
    let collider = |friction: f64| json!([{"shape": "halfspace", "friction": friction}]);
    let slides = 1e-3;
    assert!(way(0.99, json!({"/colliders": collider(0.4)})) < 1e-5);
    assert!(way(1.01, json!({"/colliders": collider(0.4)})) > slides);
    // The collider's times the strand's; the strand's alone where no collider says anything.
    let half = |friction: Value| json!({"/colliders": collider(0.8), "/strands/0/contact": {"friction": friction}});
    assert!(way(0.99, half(json!(0.5))) < 1e-5);
    assert!(way(1.01, half(json!({"along": 0.5, "against": 0.5}))) > slides);
    let common = |friction: f64| json!({"model": "coulomb", "strands": {"friction": friction}});
    let alone = |friction: f64| json!({"/colliders": [{"shape": "halfspace"}], "/contact": common(friction)});
    assert!(way(0.99, alone(0.4)) < 1e-5);
    assert!(way(1.01, alone(0.4)) > slides);
}

/// A box of half edges 3, 2 and 1 cm as the faces of an OBJ file, in centimetres.
const BOX: &str = "v -3 -2 -1\nv 3 -2 -1\nv 3 2 -1\nv -3 2 -1\nv -3 -2 1\nv 3 -2 1\nv 3 2 1\nv -3 2 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn corners() -> Value {
    let corner = |index: u32| [0.03, 0.02, 0.01].map(|half| half * if index.is_multiple_of(2) { -1.0 } else { 1.0 });
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for (x, y, z) in (0..8).map(|index| (index & 1, index >> 1 & 1, index >> 2)) {
        corners.push([corner(x)[0], corner(y)[1], corner(z)[2]]);
    }
    json!(corners)
}

/// Triangles of [`corners`], outward.
fn faces() -> Value {
    json!([
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5]
    ])
}

/// A strand that falls onto a body about the origin, and is no longer than the box.
fn falling(body: Value) -> Value {
    let strand = json!({"elements": 6, "length": 0.05, "youngs_modulus": 1e8, "air_drag": 1e-5,
        "root": {"origin": [-0.025, 0.001, 0.012]}});
    let scene = with(scene_of(json!([strand]), 0.4), "/contact", json!({"tolerance": TOLERANCE}));
    with(scene, "/colliders", json!([body]))
}

fn bake(directory: &Path) -> String {
    let (mesh, grid) = (directory.join("box.obj"), directory.join("box.shxgrid"));
    std::fs::write(&mesh, BOX).unwrap();
    let output = superhelix(&[
        "bake",
        mesh.to_str().unwrap(),
        "--scale",
        "0.01",
        "--cell",
        "0.001",
        "--band",
        "0.004",
        "--out",
        grid.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("12 triangles") && said.contains("70 x 50 x 30"), "{said}");
    "box.shxgrid".into()
}

#[test]
fn bad_bakes_are_explained() {
    let directory = directory("bad_bakes");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_string();
    std::fs::write(path("box.obj"), BOX).unwrap();
    // Without half of its faces.
    std::fs::write(path("open.obj"), BOX.lines().take(11).collect::<Vec<_>>().join("\n")).unwrap();
    for (mesh, cell, band, named) in [
        ("none.obj", "0.1", "0.1", "none.obj"),
        ("open.obj", "0.1", "0.1", "open.obj: mesh is too open to have an inside"),
        ("box.obj", "0", "0.1", "--cell"),
        ("box.obj", "0.1", "-1", "--band"),
        ("box.obj", "1e-5", "0.1", "--cell is 0.00001"),
    ] {
        let (mesh, grid) = (path(mesh), path("out.shxgrid"));
        let output = superhelix(&["bake", &mesh, "--cell", cell, "--band", band, "--out", &grid]);
        assert_eq!(output.status.code(), Some(1), "{named}");
        assert!(errors(&output).contains(named), "{named}: {}", errors(&output));
        assert!(!Path::new(&grid).exists());
    }
}

/// A box without a quarter of one of its smallest faces has its other faces where they were.
#[test]
fn a_mesh_with_an_opening_is_baked() {
    use superhelix::io::distance_grid;
    let directory = directory("open_bake");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_string();
    let (mesh, grid) = (path("open.obj"), path("open.shxgrid"));
    std::fs::write(&mesh, BOX.replace("f 4 1 5 8", "v -3 0 0\nf 4 1 9\nf 1 5 9\nf 5 8 9")).unwrap();
    let output = superhelix(&["bake", &mesh, "--cell", "0.07", "--band", "0.23", "--out", &grid]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let grid = distance_grid::read(&grid).unwrap();
    for (point, distance) in [([0.5, 0.1, 1.1], 0.1), ([1.0, 0.0, 0.8], -0.2), ([3.1, 0.3, -0.2], 0.1), ([0.0, -1.6, 0.0], -0.4)]
    {
        let found = grid.closest(point.into()).unwrap().distance;
        assert!((found - distance).abs() < 1e-5, "{point:?}: {found}");
    }
}

#[test]
fn the_example_scenes_are_good() {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes");
    let directory = directory("examples");
    for name in ["incline", "braid_tie", "shoulder", "combed_sphere"] {
        let text = std::fs::read_to_string(format!("{scenes}/{name}.json")).unwrap();
        // The first two as they stand, of the others the first steps.
        let duration = text.lines().find(|line| line.contains("\"duration\"")).unwrap();
        let text = if name.len() < 10 && name != "shoulder" { text } else { text.replace(duration, "  \"duration\": 0.025,") };
        let (output, result) = run_text(&directory, &text);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", errors(&output));
        let report = &result.unwrap()["report"];
        assert_eq!((&report["unconverged"], &report["contact"]["unconverged"]), (&json!(0), &json!(0)), "{name}: {report}");
        assert!(report["contact"]["constraint_error_max"].as_f64().unwrap() < 1e-8, "{name}: {report}");
        assert!(report["contact"]["penetration_max"].as_f64().unwrap() < TOLERANCE, "{name}: {report}");
    }
}

#[test]
fn no_shape_lets_a_strand_in() {
    let directory = directory("shapes");
    let grid = bake(&directory);
    // Signed distances of points, and by how much a shape may be off them.
    let rounded = |p: [f64; 3], half: [f64; 3], radius: f64| {
        let out: f64 = (0..3).map(|axis| (p[axis].abs() - half[axis]).max(0.0).powi(2)).sum::<f64>();
        let inside = (0..3).map(|axis| p[axis].abs() - half[axis]).fold(f64::NEG_INFINITY, f64::max).min(0.0);
        out.sqrt() + inside - radius
    };
    let cuboid = move |p: [f64; 3]| rounded(p, [0.03, 0.02, 0.01], 0.0);
    let ball = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt() - 0.01;
    let ellipsoid = |p: [f64; 3]| {
        // Towards the middle: that is further than straight to the surface.
        let level = ((p[0] / 0.03).powi(2) + (p[1] / 0.02).powi(2) + (p[2] / 0.01).powi(2)).sqrt();
        p.iter().map(|x| x * x).sum::<f64>().sqrt() * (1.0 - 1.0 / level)
    };
    type Distance<'a> = &'a dyn Fn([f64; 3]) -> f64;
    let cases: [(Value, Distance, f64); 9] = [
        (json!({"shape": "sphere", "radius": 0.01}), &ball, 0.0),
        (
            json!({"shape": "capsule", "a": [0, -0.02, 0], "b": [0, 0.02, 0], "radius": 0.01}),
            &|p| rounded(p, [0.0, 0.02, 0.0], 0.01),
            0.0,
        ),
        (json!({"shape": "ellipsoid", "semi_axes": [0.03, 0.02, 0.01]}), &ellipsoid, 0.0),
        (json!({"shape": "box", "half_edges": [0.03, 0.02, 0.01]}), &cuboid, 0.0),
        (json!({"shape": "halfspace", "normal": [0, 0, 2], "pose": {"origin": [0, 0, 0.01]}}), &|p| p[2] - 0.01, 0.0),
        (json!({"shape": "hull", "points": corners()}), &cuboid, 0.0),
        (json!({"shape": "mesh", "file": "box.obj", "scale": 0.01}), &cuboid, 0.0),
        (json!({"shape": "mesh", "vertices": corners(), "triangles": faces(), "sides": "front", "depth": 0.005}), &cuboid, 0.0),
        // Edges are rounded by a cell.
        (json!({"shape": "grid", "file": grid}), &cuboid, 1e-3),
    ];
    for (body, distance, off) in cases {
        let result = run(&directory, &falling(body.clone()));
        assert!(!last(&result["contacts"]).as_array().unwrap().is_empty(), "{body}");
        assert_eq!(result["report"]["contact"]["unconverged"], 0, "{body}: {}", result["report"]);
        let points = last(&result["strands"][0]["points"]).as_array().unwrap();
        let nearest = points.iter().map(|point| distance(vector(point))).fold(f64::INFINITY, f64::min);
        // Its axis stays a radius away, to the tolerance; samples are not where it touches, so it is no nearer than that.
        assert!(nearest > 50e-6 - TOLERANCE - off, "{body}: {nearest}");
        assert!(nearest < 2e-3, "{body}: the strand must come near it: {nearest}");
        let thick = run(&directory, &with(falling(body.clone()), "/colliders/0/thickness", json!(0.001)));
        let points = last(&thick["strands"][0]["points"]).as_array().unwrap();
        let thick = points.iter().map(|point| distance(vector(point))).fold(f64::INFINITY, f64::min);
        assert!(thick > 1.05e-3 - TOLERANCE - off, "{body}: thickness: {thick}");
    }
}

#[test]
fn colliders_move_and_deform() {
    let directory = directory("moving");
    // A hanging strand; a box that comes from the side in 0.4 s and stays.
    let strand = json!({"elements": 5, "length": 0.1, "air_drag": 1e-4, "viscosity": 0.05,
        "root": {"rotation": [0, 0.5f64.sqrt(), 0, 0.5f64.sqrt()]}});
    let scene = |body: Value| with(scene_of(json!([strand]), 1.0), "/colliders", json!([body]));
    let (there, here) = ([-0.06, 0.0, -0.08], [0.0, 0.0, -0.08]);
    let pose = |at: [f64; 3]| [at[0], at[1], at[2], 0.0, 0.0, 0.0, 1.0];
    let moved = |by: [f64; 3]| -> Value {
        let corners = corners();
        json!(
            corners
                .as_array()
                .unwrap()
                .iter()
                .map(|corner| {
                    let corner = vector(corner);
                    [0, 1, 2].map(|axis| corner[axis] + by[axis])
                })
                .collect::<Vec<_>>()
        )
    };
    let times = [0.0, 0.4];
    let tip = |scene: &Value| vector(&last(&run(&directory, scene)["strands"][0]["points"])[32]);
    let still = tip(&scene(json!({"shape": "box", "half_edges": [0.03, 0.02, 0.01], "pose": {"origin": there}})));
    assert!(still[0].abs() < 1e-9, "{still:?}");
    let motion = json!({"times": times, "frames": [pose(there), pose(here)]});
    let cuboid = tip(&scene(json!({"shape": "box", "half_edges": [0.03, 0.02, 0.01], "motion": motion})));
    assert!(cuboid[0] > 0.03, "{cuboid:?}");
    let mesh = tip(&scene(json!({"shape": "mesh", "vertices": corners(), "triangles": faces(), "motion": motion})));
    let deformation = json!({"times": times, "vertices": [moved(there), moved(here)]});
    let deforming = json!({"shape": "mesh", "vertices": corners(), "triangles": faces(), "deformation": deformation});
    let deforming = tip(&scene(deforming));
    // The same box three times, and a strand that leans on it: the difference comes from friction along different paths.
    assert!(difference(&mesh, &cuboid) < 2e-3, "{mesh:?} {cuboid:?}");
    assert!(difference(&deforming, &mesh) < 2e-3, "{deforming:?} {mesh:?}");
}

#[test]
fn strands_collide_by_their_groups() {
    let directory = directory("groups");
    let floor = json!({"shape": "halfspace", "pose": {"origin": [0, 0, -0.02]}});
    let lowest = |strand: Value, floor: Value| {
        let strand = with(with(lying(), "/contact", strand), "/elements", json!(4));
        let scene = with(scene_of(json!([strand]), 0.5), "/colliders", json!([floor]));
        let result = run(&directory, &with(scene, "/groups", json!(["head", "bangs", "tail"])));
        let points = last(&result["strands"][0]["points"]).as_array().unwrap();
        points.iter().map(|point| vector(point)[2]).fold(f64::INFINITY, f64::min)
    };
    for contact in [json!(null), json!(true), json!({"group": 2}), json!({"mask": 1})] {
        assert!(lowest(contact.clone(), floor.clone()) > -0.02 - TOLERANCE, "{contact}");
    }
    assert!(lowest(json!({"radius": 0}), floor.clone()) > -0.02 - BETWEEN_TOUCHES);
    assert!((lowest(json!({"radius": 0.005}), floor.clone()) - -0.015).abs() < 1e-4);
    for contact in [json!(false), json!({"group": 0}), json!({"mask": 2}), json!({"exempt_length": 1})] {
        assert!(lowest(contact.clone(), floor.clone()) < -0.03, "{contact}");
    }
    assert!(lowest(json!({"group": 4}), with(floor.clone(), "/mask", json!(4))) > -0.02 - TOLERANCE);
    assert!(lowest(json!({"group": 4}), with(floor.clone(), "/mask", json!(3))) < -0.03);
    assert!(lowest(json!({"mask": 4}), with(floor.clone(), "/group", json!(5))) > -0.02 - TOLERANCE);
    // The same by names.
    let named = |group: Value, mask: Value| lowest(json!({ "group": group }), with(floor.clone(), "/mask", mask));
    assert!(named(json!("bangs"), json!(["tail", "bangs"])) > -0.02 - TOLERANCE);
    assert!(named(json!(["bangs", "tail"]), json!("tail")) > -0.02 - TOLERANCE);
    assert!(named(json!("bangs"), json!(["head", "tail"])) < -0.03);
}

#[test]
fn strands_collide_with_each_other_if_the_scene_says_so() {
    let directory = directory("hair");
    // One lies across below another that falls on it.
    let strands = json!([
        {"elements": 4, "length": 0.1, "youngs_modulus": 2e10, "root": {"origin": [0, 0, 0]}},
        {"elements": 4, "length": 0.1, "youngs_modulus": 1e7, "air_drag": 1e-5,
         "root": {"origin": [0.02, -0.03, 0.006], "rotation": [0, 0, 0.5f64.sqrt(), 0.5f64.sqrt()]}}
    ]);
    let scene = scene_of(strands, 0.3);
    let result = run(&directory, &with(scene.clone(), "/hair_contact", json!({"wisp_radius": 1e-3, "friction": 0.3})));
    let contacts = last(&result["contacts"]).as_array().unwrap();
    assert!(!contacts.is_empty());
    for contact in contacts {
        assert_eq!((&contact["strand"], &contact["other"]), (&json!(0), &json!(1)));
        assert!((contact["arclength"].as_f64().unwrap() - 0.02).abs() < 0.01, "{contact}");
        assert!((contact["other_arclength"].as_f64().unwrap() - 0.03).abs() < 0.01, "{contact}");
        assert!(contact["gap"].as_f64().unwrap() > -TOLERANCE);
    }
    let without = run(&directory, &scene);
    assert!(last(&without["contacts"]).as_array().unwrap().is_empty());
    assert!(without["report"].get("contact").is_none(), "free when off");
    let tip = |result: &Value| vector(&last(&result["strands"][1]["points"])[32])[2];
    assert!((tip(&result) - tip(&without)).abs() > 1e-3, "{} {}", tip(&result), tip(&without));
    // One that touches nothing is passed through.
    let off = run(&directory, &with(with(scene, "/hair_contact", json!(true)), "/strands/0/contact", json!(false)));
    assert!(last(&off["contacts"]).as_array().unwrap().is_empty());
    assert_eq!(off["report"]["contact"]["contacts_max"], 0);
}

#[test]
fn a_scene_drawn_into_itself_rests_where_overlap_is_permitted() {
    // Two strands across each other, half a wisp's radius too near, the first a millimetre in the ground.
    let strand =
        |origin: Value, rotation: Value| json!({"elements": 4, "length": 0.1, "root": {"origin": origin, "rotation": rotation}});
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let strands =
        json!([strand(json!([0, 0, -1e-3]), json!([0, 0, 0, 1])), strand(json!([0.05, -0.05, 5e-4]), json!([0, 0, half, half]))]);
    let moved = |allowed: bool| {
        let scene = with(scene_of(strands.clone(), 1.0), "/colliders", json!([{"shape": "halfspace"}]));
        let scene = with(scene, "/contact", json!({"allow_overlaps": allowed, "strands": {"exempt_length": 0.01}}));
        let scene = with(scene, "/hair_contact", json!({"wisp_radius": 1e-3}));
        let scene = with(scene, "/posing", json!([{"do": "take", "shape": "rest"}]));
        let result = run(&directory(&format!("overlaps_{allowed}")), &scene);
        let flat = |state: &Value| state.as_array().unwrap().iter().flat_map(numbers).collect::<Vec<f64>>();
        let points = result["strands"].as_array().unwrap().iter().map(|strand| &strand["points"]);
        points.map(|points| difference(&flat(&points[0]), &flat(last(points)))).fold(0.0, f64::max)
    };
    assert!(moved(false) > 1e-4);
    assert!(moved(true) < 1e-9);
}

#[test]
fn attachments_hold() {
    let directory = directory("attachments");
    // Not straight: of a straight one the length alone says how far down a point is.
    let hanging = |x: f64| {
        json!({"elements": 6, "length": 0.12, "air_drag": 5e-5, "viscosity": 0.02, "natural_curvatures": [[0, -8, 0]],
            "root": {"origin": [x, 0, 0], "rotation": [0, 0.5f64.sqrt(), 0, 0.5f64.sqrt()]}})
    };
    let scene = |attachments: Value| {
        let scene = with(scene_of(json!([hanging(0.0), hanging(0.02)]), 1.0), "/attachments", attachments);
        with(scene, "/output", json!(["points", "frames", "attachments"]))
    };
    let state = |result: &Value, index: usize| last(&result["attachments"][index]["states"]).clone();
    let holds = |result: &Value, index: usize| {
        let state = state(result, index);
        assert_eq!(state["status"], "holds", "{state}");
        assert!(state["error"].as_f64().unwrap() < 1e-9, "{state}");
    };
    let at = |result: &Value, strand: usize, sample: usize| vector(&last(&result["strands"][strand]["points"])[sample]);

    // A point, moved; another that stays where it began.
    let motion = json!({"times": [0, 0.5], "frames": [[0, 0, -0.12, 0, 0, 0, 1], [0.05, 0, -0.1, 0, 0, 0, 1]]});
    let result = run(
        &directory,
        &scene(json!([
            {"kind": "point", "strand": 0, "arclength": 0.12, "motion": motion},
            {"kind": "point", "strand": 1, "arclength": 0.06}
        ])),
    );
    holds(&result, 0);
    holds(&result, 1);
    assert!(difference(&at(&result, 0, 32), &[0.05, 0.0, -0.1]) < 1e-9);
    let began = vector(&result["strands"][1]["points"][0][16]);
    assert!(difference(&at(&result, 1, 16), &began) < 1e-9);

    // A direction and a frame: the strand leaves halfway between down and x.
    let (sin, cos) = std::f64::consts::FRAC_PI_8.sin_cos();
    for (kind, target) in [
        ("direction", json!({"origin": [0.02, 0, -0.1], "rotation": [0, sin, 0, cos]})),
        ("frame", json!([0.02, 0, -0.1, 0, sin, 0, cos])),
    ] {
        let result = run(&directory, &scene(json!([{"kind": kind, "strand": 0, "arclength": 0.12, "target": target}])));
        holds(&result, 0);
        let frame = numbers(&last(&result["strands"][0]["frames"])[32]);
        assert!(difference(&frame[..3], &[0.02, 0.0, -0.1]) < 1e-9);
        let (x, y, z, w) = (frame[3], frame[4], frame[5], frame[6]);
        let tangent = [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)];
        assert!(difference(&tangent, &[0.5f64.sqrt(), 0.0, -0.5f64.sqrt()]) < 1e-6, "{kind}: {tangent:?}");
    }

    // A tie, and a compliant constraint.
    let result = run(
        &directory,
        &scene(json!([
            {"kind": "tie", "strand": 0, "arclength": 0.06, "other": 1, "other_arclength": 0.06},
            {"kind": "point", "strand": 1, "arclength": 0.12, "target": [0.05, 0, -0.1], "compliance": 100}
        ])),
    );
    holds(&result, 0);
    assert!(difference(&at(&result, 0, 16), &at(&result, 1, 16)) < 1e-9);
    let (force, gave) = (numbers(&state(&result, 1)["force"]), at(&result, 1, 32));
    let off = [0.05 - gave[0], -gave[1], -0.1 - gave[2]];
    assert!(difference(&force.iter().map(|f| 100.0 * f).collect::<Vec<_>>(), &off) < 1e-9, "{force:?} {off:?}");
    assert!(off[0] > 1e-6);
}

#[test]
fn a_strand_is_drawn_through_a_ring_and_leaves_it() {
    let strand = json!({"elements": 6, "length": 0.12, "air_drag": 2e-5});
    let frames: Vec<[f64; 7]> = vec![[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [-0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]];
    let scene = scene_of(json!([with(strand, "/root_motion", json!({"times": [0.0, 0.5], "frames": frames}))]), 0.6);
    let ring = json!({"kind": "slide", "strand": 0, "arclength": 0.05, "target": [0.05, 0, 0], "friction": {"along": 0.1, "against": 0.2}});
    let result = run(&directory("ring"), &with(with(scene, "/attachments", json!([ring])), "/output_interval", json!(0.1)));
    let states = result["attachments"][0]["states"].as_array().unwrap();
    let along: Vec<f64> = states.iter().map(|state| state["arclength"].as_f64().unwrap()).collect();
    assert_eq!(along[0], 0.05);
    assert!(along[..4].windows(2).all(|pair| pair[1] > pair[0]), "{along:?}");
    assert_eq!(states.last().unwrap()["status"], "released", "{states:?}");
    assert_eq!(states[2]["status"], "holds");
}

#[test]
fn bodies_are_in_the_picture() {
    let directory = directory("bodies_picture");
    let scene = falling(json!({"shape": "sphere", "radius": 0.01}));
    run(&directory, &scene);
    let path = |name: &str| directory.join(name).to_str().unwrap().to_string();
    let draw = |scene: &str, out: &str| {
        let arguments = ["picture", &path("result.json"), "--scene", &path(scene), "--out", &path(out), "--up", "z"];
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        std::fs::read(path(out)).unwrap()
    };
    std::fs::write(path("empty.json"), with(scene, "/colliders", json!([])).to_string()).unwrap();
    let (with_body, without) = (draw("scene.json", "with.png"), draw("empty.json", "without.png"));
    assert_eq!(with_body[..8], [0x89, b'P', b'N', b'G', 13, 10, 26, 10]);
    assert_ne!(with_body, without);
    assert_eq!(draw("scene.json", "again.png"), with_body, "the same picture every time");

    std::fs::write(path("other.json"), small_scene().to_string()).unwrap();
    run(&directory, &small_scene());
    let output = superhelix(&["picture", &path("result.json"), "--scene", &path("other.json"), "--out", &path("x.png")]);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("points"), "{}", errors(&output));
}
