//! `superhelix run`: errors for bad scenes and bad usage.

use crate::support::{directory, errors, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};

/// Runs a scene that must be refused with status 2, by a message that names the file, the key and the value; nothing is written.
fn refuse(directory: &std::path::Path, scene: &str, key: &str, value: &str) {
    std::fs::write(directory.join("result.json"), "").unwrap();
    let (output, result) = run_text(directory, scene);
    let message = errors(&output);
    assert_eq!(output.status.code(), Some(2), "{key} {value}: {message}");
    assert!(result.is_none(), "{key}: a result is written");
    assert!(message.contains("scene.json"), "the file is not named: {message}");
    assert!(message.contains(key), "`{key}` is not named: {message}");
    assert!(message.contains(value), "the value `{value}` is not shown: {message}");
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    assert_eq!(std::fs::read_dir(directory).unwrap().count(), 1, "{key}: something is left behind");
}

#[test]
fn unknown_keys_are_named_at_every_level() {
    let directory = directory("unknown");
    let motion = json!({"times": [0], "frames": [[0, 0, 0, 0, 0, 0, 1]], "loop": true});
    for (pointer, value, key, shown) in [
        ("/time_stepp", json!(0.1), "time_stepp", "0.1"),
        ("/newton", json!({"tolerence": 0.125}), "newton.tolerence", "0.125"),
        ("/strands/0/raduis", json!([1, 2]), "strands[0].raduis", "[1,2]"),
        ("/strands/0/root", json!({"orgin": [0, 0, 0]}), "strands[0].root.orgin", "[0,0,0]"),
        ("/strands/0/root_motion", motion, "strands[0].root_motion.loop", "true"),
        ("/output", json!([{"kind": "points", "sample": 3}]), "output[0].sample", "3"),
    ] {
        refuse(&directory, &with(small_scene(), pointer, value).to_string(), key, shown);
    }
    let two = with(small_scene(), "/strands", json!([small_scene()["strands"][0], small_scene()["strands"][0]]));
    refuse(&directory, &with(two, "/strands/1/Length", json!(3)).to_string(), "strands[1].Length", "3");
}

#[test]
fn keys_that_stand_twice_are_named_at_every_level() {
    let directory = directory("twice");
    let text = small_scene().to_string();
    refuse(&directory, &text.replacen('{', "{\"duration\": 7.5,", 1), "duration", "twice");
    refuse(&directory, &text.replacen("\"length\":", "\"length\": 0.3, \"length\":", 1), "strands[0].length", "0.1");
    let newton = with(small_scene(), "/newton", json!({"tolerance": 0.5})).to_string();
    refuse(&directory, &newton.replacen("\"tolerance\":", "\"tolerance\":0.25,\"tolerance\":", 1), "newton.tolerance", "0.5");
}

#[test]
fn values_out_of_range_are_named() {
    let directory = directory("range");
    let frame = json!([0, 0, 0, 0, 0, 0, 1]);
    let motion = |times: Value, frames: Value| json!({"times": times, "frames": frames});
    let cases: Vec<(&str, Value, &str, &str)> = vec![
        ("/version", json!(2), "version", "2"),
        ("/version", json!("1"), "version", "\"1\""),
        ("/gravity", json!([0, 0]), "gravity", "[0,0]"),
        ("/gravity", json!([0, 0, "g"]), "gravity[2]", "\"g\""),
        ("/wind", json!(null), "wind", "null"),
        ("/integrator", json!("euler"), "integrator", "\"euler\""),
        ("/time_step", json!(0), "time_step", "0"),
        ("/time_step", json!(-0.5), "time_step", "-0.5"),
        ("/time_step", json!("fast"), "time_step", "\"fast\""),
        ("/time_step", json!(1e-30), "time_step", "1e-30"),
        ("/duration", json!(1e8), "duration", "100000000"),
        ("/duration", json!(1e-12), "duration", "1e-12"),
        ("/duration", json!(-1), "duration", "-1"),
        ("/output_interval", json!(0), "output_interval", "0"),
        ("/output_interval", json!(1e-20), "output_interval", "1e-20"),
        ("/output_interval", json!(1e-9), "duration", "0.05"),
        ("/precision", json!("f16"), "precision", "\"f16\""),
        ("/threads", json!(0), "threads", "0"),
        ("/threads", json!(257), "threads", "257"),
        ("/threads", json!(1.5), "threads", "1.5"),
        ("/newton", json!({"max_iterations": 0}), "newton.max_iterations", "0"),
        ("/newton", json!({"tolerance": 0}), "newton.tolerance", "0"),
        ("/newton", json!(7), "newton", "7"),
        ("/reference_tolerance", json!(-1e-8), "reference_tolerance", "-1e-8"),
        ("/reference_tolerance", json!(1.0), "reference_tolerance", "1"),
        ("/quadrature_tolerance", json!(0), "quadrature_tolerance", "0"),
        ("/quadrature_tolerance", json!(0.1), "quadrature_tolerance", "0.1"),
        ("/solver", json!("lu"), "solver", "\"lu\""),
        ("/strands", json!({}), "strands", "{}"),
        ("/strands/0", json!(17), "strands[0]", "17"),
        ("/strands/0/elements", json!(0), "strands[0].elements", "0"),
        ("/strands/0/elements", json!(1e12), "strands[0].elements", "1000000000000"),
        ("/strands/0/elements", json!(2.5), "strands[0].elements", "2.5"),
        ("/strands/0/length", json!(-0.2), "strands[0].length", "-0.2"),
        ("/strands/0/element_lengths", json!([0.1]), "strands[0].elements", "3"),
        ("/strands/0/radius", json!([5e-5, 0]), "strands[0].radius[1]", "0"),
        ("/strands/0/radius", json!(5e-5), "strands[0].radius", "0.00005"),
        ("/strands/0/density", json!(-1300), "strands[0].density", "-1300"),
        ("/strands/0/youngs_modulus", json!(0), "strands[0].youngs_modulus", "0"),
        ("/strands/0/poisson_ratio", json!(0.75), "strands[0].poisson_ratio", "0.75"),
        ("/strands/0/internal_friction", json!(-1), "strands[0].internal_friction", "-1"),
        ("/strands/0/viscosity", json!(-2), "strands[0].viscosity", "-2"),
        ("/strands/0/air_drag", json!(-3), "strands[0].air_drag", "-3"),
        ("/strands/0/natural_curvatures", json!([]), "strands[0].natural_curvatures", "0"),
        ("/strands/0/natural_curvatures", json!([[0, 0, 0], [0, 0, 0]]), "strands[0].natural_curvatures", "2"),
        ("/strands/0/natural_curvatures", json!([[0, 0]]), "strands[0].natural_curvatures[0]", "[0,0]"),
        ("/strands/0/initial_curvatures", json!([[0, true, 0]]), "strands[0].initial_curvatures[0][1]", "true"),
        ("/strands/0/initial_rates", json!([0, 0, 0]), "strands[0].initial_rates[0]", "0"),
        ("/strands/0/freedoms", json!([]), "strands[0].freedoms", "[]"),
        ("/strands/0/freedoms", json!(["twist", "bend3"]), "strands[0].freedoms[1]", "\"bend3\""),
        ("/strands/0/freedoms", json!(["twist", "twist"]), "strands[0].freedoms[1]", "\"twist\""),
        ("/strands/0/root", json!({"origin": [0, 0]}), "strands[0].root.origin", "[0,0]"),
        ("/strands/0/root", json!({"rotation": [0, 0, 0, 2]}), "strands[0].root.rotation", "2"),
        ("/strands/0/root_motion", motion(json!([]), json!([])), "strands[0].root_motion.frames", "0"),
        ("/strands/0/root_motion", motion(json!([0, 1]), json!([frame])), "strands[0].root_motion.frames", "1"),
        ("/strands/0/root_motion", motion(json!([0, 0]), json!([frame, frame])), "strands[0].root_motion.times[1]", "0"),
        ("/strands/0/root_motion", motion(json!([0]), json!([[0, 0, 0, 3, 0, 0, 1]])), "strands[0].root_motion.frames[0]", "3"),
        ("/output", json!(["tip"]), "output[0]", "\"tip\""),
        ("/output", json!(["tips", "tips"]), "output[1]", "\"tips\""),
        ("/output", json!("tips"), "output", "\"tips\""),
        ("/output", json!([{"kind": "tips", "samples": 4}]), "output[0].samples", "4"),
        ("/samples", json!(1), "samples", "1"),
        ("/hair_contact", json!("no"), "hair_contact", "\"no\""),
    ];
    for (pointer, value, key, shown) in cases {
        refuse(&directory, &with(small_scene(), pointer, value).to_string(), key, shown);
    }
    // A frozen freedom cannot start anywhere else than at its natural value.
    let frozen =
        with(with(small_scene(), "/strands/0/freedoms", json!(["twist"])), "/strands/0/initial_curvatures", json!([[1, 13, 3]]));
    refuse(&directory, &frozen.to_string(), "strands[0].initial_curvatures[0][1]", "13");
}

#[test]
fn unsupported_requests_are_reported() {
    let directory = directory("absent");
    let dense = with(with(small_scene(), "/precision", json!("f32")), "/solver", json!("dense_svd"));
    refuse(&directory, &dense.to_string(), "precision", "f32");
}

/// Refuses a scene with one collider.
fn refuse_collider(directory: &std::path::Path, collider: Value, key: &str, value: &str) {
    refuse(directory, &with(small_scene(), "/colliders", json!([collider])).to_string(), &format!("colliders[0]{key}"), value);
}

#[test]
fn bad_colliders_are_named() {
    let directory = directory("colliders");
    let sphere = json!({"shape": "sphere", "radius": 0.1});
    for (pointer, value, key, shown) in [
        ("/shape", json!("ball"), ".shape", "\"ball\""),
        ("/shape", json!(3), ".shape", "3"),
        ("/radius", json!(-0.25), ".radius", "-0.25"),
        ("/radius", json!("large"), ".radius", "\"large\""),
        ("/size", json!(2), ".size", "2"),
        ("/normal", json!([0, 0, 1]), ".normal", "[0,0,1]"),
        ("/thickness", json!(-1), ".thickness", "-1"),
        ("/friction", json!(-0.5), ".friction", "-0.5"),
        ("/friction", json!({"along": 1, "against": 1}), ".friction", "along"),
        ("/viscous_friction", json!(-2), ".viscous_friction", "-2"),
        ("/group", json!(-1), ".group", "-1"),
        ("/mask", json!(4294967296u64), ".mask", "4294967296"),
        ("/mask", json!(1.5), ".mask", "1.5"),
        ("/pose", json!([0, 0, 0]), ".pose", "[0,0,0]"),
        ("/pose", json!({"rotation": [0, 0, 0, 2]}), ".pose.rotation", "2"),
        ("/pose", json!({"position": [1, 2, 3]}), ".pose.position", "[1,2,3]"),
        ("/motion", json!({"times": [1, 0], "frames": []}), ".motion.times[1]", "0"),
        ("/deformation", json!({}), ".deformation", "{}"),
    ] {
        refuse_collider(&directory, with(sphere.clone(), pointer, value), key, shown);
    }
    refuse(&directory, &with(small_scene(), "/colliders", json!({})).to_string(), "colliders", "{}");
    for (collider, key, shown) in [
        (json!(7), "", "7"),
        (json!({"radius": 1}), ".shape", "missing"),
        (json!({"shape": "sphere"}), ".radius", "missing"),
        (json!({"shape": "capsule", "a": [0, 0, 0], "b": [0, 0, 0], "radius": 0.1}), ".b", "0.0"),
        (json!({"shape": "capsule", "a": [0, 0], "b": [0, 0, 0], "radius": 0.1}), ".a", "[0,0]"),
        (json!({"shape": "ellipsoid", "semi_axes": [1, 0, 1]}), ".semi_axes[1]", "0"),
        (json!({"shape": "box", "half_edges": [1, 1, -3]}), ".half_edges[2]", "-3"),
        (json!({"shape": "halfspace", "normal": [0, 0, 0]}), ".normal", "0.0"),
        (json!({"shape": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}), ".points", "3"),
        (json!({"shape": "hull"}), ".file", "missing"),
        (json!({"shape": "hull", "points": [[0, 0, 0]], "file": "a.obj"}), ".file", "a.obj"),
        (json!({"shape": "mesh"}), ".file", "missing"),
        (json!({"shape": "mesh", "file": "no_such.obj"}), ".file", "no_such.obj"),
        (json!({"shape": "mesh", "file": ""}), ".file", "\"\""),
        (json!({"shape": "mesh", "file": 3}), ".file", "3"),
        (json!({"shape": "mesh", "file": "a.obj", "scale": 0}), ".scale", "0"),
        (json!({"shape": "mesh", "vertices": [], "triangles": [], "scale": 2}), ".scale", "2"),
        (json!({"shape": "mesh", "vertices": [[0, 0, 0]]}), ".triangles", "missing"),
        (json!({"shape": "mesh", "vertices": [[0, 0, 0]], "triangles": [[0, 0]]}), ".triangles[0]", "[0,0]"),
        (json!({"shape": "mesh", "vertices": [[0, 0, 0]], "triangles": [[0, 1, 2]]}), ".triangles[0][1]", "1"),
        (json!({"shape": "grid", "file": "no_such.shxgrid"}), ".file", "no_such.shxgrid"),
    ] {
        refuse_collider(&directory, collider, key, shown);
    }
    let triangle = json!({"shape": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]]});
    refuse_collider(&directory, triangle.clone(), ".triangles[0]", "edge");
    refuse_collider(&directory, with(triangle.clone(), "/sides", json!("inside")), ".sides", "\"inside\"");
    refuse_collider(&directory, with(triangle.clone(), "/sides", json!("front")), ".depth", "missing");
    let both = with(triangle, "/sides", json!("both"));
    refuse_collider(&directory, with(both.clone(), "/depth", json!(0.5)), ".depth", "0.5");
    for (deformation, key, shown) in [
        (json!({"times": [0]}), ".deformation.files", "missing"),
        (json!({"times": [0, 1], "vertices": [[]]}), ".deformation.vertices", "1"),
        (json!({"times": [0], "vertices": [[[0, 0, 0]]]}), ".deformation.vertices[0]", "1 vertices"),
        (json!({"times": [0], "vertices": [[]], "files": []}), ".deformation.vertices", "beside files"),
        (json!({"times": [0], "files": ["no_such.obj"]}), ".deformation.files[0]", "no_such.obj"),
        (json!({"times": [0], "vertices": [[[0, 0, 0], [1, 0, 0], [2, 0, 0]]]}), ".deformation", "area"),
    ] {
        refuse_collider(&directory, with(both.clone(), "/deformation", deformation), key, shown);
    }
    // One collider that says what its friction is, one that does not, and a strand that does not either.
    let two = json!([with(sphere.clone(), "/friction", json!(0.5)), sphere]);
    refuse(&directory, &with(small_scene(), "/colliders", two).to_string(), "colliders[1].friction", "missing");
}

#[test]
fn bad_contact_is_named() {
    let directory = directory("contact");
    for (pointer, value, key, shown) in [
        ("/contact", json!(true), "contact", "true"),
        ("/contact", json!({"modell": "hard"}), "contact.modell", "\"hard\""),
        ("/contact", json!({"model": "soft"}), "contact.model", "\"soft\""),
        ("/contact", json!({"stiffness": 0}), "contact.stiffness", "0"),
        ("/contact", json!({"damping": -1}), "contact.damping", "-1"),
        ("/contact", json!({"regularisation_depth": 0}), "contact.regularisation_depth", "0"),
        ("/contact", json!({"tolerance": -2}), "contact.tolerance", "-2"),
        ("/contact", json!({"residual": 2}), "contact.residual", "2"),
        ("/contact", json!({"residual": 0}), "contact.residual", "0"),
        ("/contact", json!({"separation_speed": 0}), "contact.separation_speed", "0"),
        ("/contact", json!({"max_iterations": 0}), "contact.max_iterations", "0"),
        ("/contact", json!({"max_sweeps": 1e7}), "contact.max_sweeps", "10000000"),
        ("/contact", json!({"strands": {"wisp_radius": 1}}), "contact.strands.wisp_radius", "1"),
        ("/contact", json!({"strands": {"radius": -1}}), "contact.strands.radius", "-1"),
        ("/hair_contact", json!({"wisp_radius": 0}), "hair_contact.wisp_radius", "0"),
        ("/hair_contact", json!({"radius": 1}), "hair_contact.radius", "1"),
        ("/hair_contact", json!({"friction": {"along": 1}}), "hair_contact.friction.against", "missing"),
        ("/hair_contact", json!(1), "hair_contact", "1"),
        ("/strands/0/contact", json!(3), "strands[0].contact", "3"),
        ("/strands/0/contact", json!({"wisp": 1}), "strands[0].contact.wisp", "1"),
        ("/strands/0/contact", json!({"wisp_radius": -1}), "strands[0].contact.wisp_radius", "-1"),
        ("/strands/0/contact", json!({"friction": "rough"}), "strands[0].contact.friction", "\"rough\""),
        ("/strands/0/contact", json!({"friction": {"along": -1, "against": 1}}), "strands[0].contact.friction.along", "-1"),
        ("/strands/0/contact", json!({"viscous_friction": -1}), "strands[0].contact.viscous_friction", "-1"),
        ("/strands/0/contact", json!({"hair_friction": -3}), "strands[0].contact.hair_friction", "-3"),
        ("/strands/0/contact", json!({"exempt_length": -1}), "strands[0].contact.exempt_length", "-1"),
        ("/strands/0/contact", json!({"group": "all"}), "strands[0].contact.group", "\"all\""),
        ("/strands/0/contact", json!({"mask": ["all"]}), "strands[0].contact.mask[0]", "\"all\""),
        ("/groups", json!(["head", "head"]), "groups[1]", "\"head\""),
        ("/strands/0/root_motion", json!({"motion": "head"}), "strands[0].root_motion.motion", "\"head\""),
        ("/motions", json!({"head": {"times": [0], "frames": []}}), "motions.head.frames", "a list of 0"),
        ("/strands/0/contact", json!({"mask": -1}), "strands[0].contact.mask", "-1"),
    ] {
        refuse(&directory, &with(small_scene(), pointer, value).to_string(), key, shown);
    }
}

#[test]
fn bad_attachments_are_named() {
    let directory = directory("attached");
    let point = json!({"kind": "point", "strand": 0, "arclength": 0.05});
    let tie = json!({"kind": "tie", "strand": 0, "arclength": 0.05, "other": 0, "other_arclength": 0.1});
    let slide = with(point.clone(), "/kind", json!("slide"));
    for (base, pointer, value, key, shown) in [
        (&point, "/kind", json!("nail"), ".kind", "\"nail\""),
        (&point, "/strand", json!(1), ".strand", "1"),
        (&point, "/strand", json!(-1), ".strand", "-1"),
        (&point, "/arclength", json!(0.11), ".arclength", "0.11"),
        (&point, "/arclength", json!(-0.01), ".arclength", "-0.01"),
        (&point, "/friction", json!(0.5), ".friction", "0.5"),
        (&point, "/target", json!([1, 2]), ".target", "[1,2]"),
        (&point, "/target", json!([0, 0, 0, 0, 0, 0, 3]), ".target", "3"),
        (&point, "/target", json!({"place": 1}), ".target.place", "1"),
        (&point, "/motion", json!({"times": [0]}), ".motion.frames", "missing"),
        (&point, "/compliance", json!(-1), ".compliance", "-1"),
        (&point, "/other", json!(0), ".other", "0"),
        (&slide, "/friction", json!(-0.5), ".friction", "-0.5"),
        (&slide, "/compliance", json!(0.5), ".compliance", "0.5"),
        (&tie, "/target", json!([0, 0, 0]), ".target", "[0,0,0]"),
        (&tie, "/other", json!(2), ".other", "2"),
        (&tie, "/other_arclength", json!(0.2), ".other_arclength", "0.2"),
        (&tie, "/other_arclength", json!(0.05), ".other_arclength", "0.05"),
    ] {
        let scene = with(small_scene(), "/attachments", json!([with(base.clone(), pointer, value)]));
        refuse(&directory, &scene.to_string(), &format!("attachments[0]{key}"), shown);
    }
    for key in ["kind", "strand", "arclength"] {
        let mut without = point.clone();
        without.as_object_mut().unwrap().remove(key);
        let scene = with(small_scene(), "/attachments", json!([without]));
        refuse(&directory, &scene.to_string(), &format!("attachments[0].{key}"), "missing");
    }
    refuse(&directory, &with(small_scene(), "/attachments", json!([3])).to_string(), "attachments[0]", "3");
}

#[test]
fn missing_keys_are_named() {
    let directory = directory("missing");
    for (parent, key, path) in [
        ("", "version", "version"),
        ("", "time_step", "time_step"),
        ("", "duration", "duration"),
        ("", "strands", "strands"),
        ("/strands/0", "elements", "strands[0].elements"),
        ("/strands/0", "length", "strands[0].length"),
    ] {
        let mut scene = small_scene();
        scene.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key);
        refuse(&directory, &scene.to_string(), path, "missing");
    }
}

#[test]
fn what_is_not_json_is_refused_with_its_place() {
    let directory = directory("syntax");
    let text = small_scene().to_string();
    refuse(&directory, "", "", "line 1");
    refuse(&directory, "[]", "the document", "[]");
    refuse(&directory, &text[..text.len() - 9], "", "EOF");
    refuse(&directory, &(text.clone() + "{}"), "", "trailing");
    refuse(&directory, &text.replacen(':', ": /* never closed", 1), "", "/*");
    refuse(&directory, &text.replacen("\"duration\":", "\"duration\": 1e999, \"x\":", 1), "duration", "1e999");
    refuse(&directory, &text.replacen("\"duration\":", "\"duration\": NaN, \"x\":", 1), "duration", "NaN");
    refuse(&directory, &"[".repeat(100_000), "", "recursion");
}

#[test]
fn everything_else_that_fails_has_status_1() {
    let directory = directory("status");
    let scene = directory.join("scene.json");
    std::fs::write(&scene, small_scene().to_string()).unwrap();
    let scene = scene.to_str().unwrap();
    let missing = directory.join("no_such_directory").join("result.json");
    for (arguments, named) in [
        (vec!["run", "no_such_scene.json", "--out", "result.json"], "no_such_scene.json"),
        (vec!["run", scene, "--out", missing.to_str().unwrap()], "no_such_directory"),
        (vec!["run", scene, "--out", directory.to_str().unwrap()], "directory"),
        (vec!["run", scene], "--out"),
        (vec!["run", scene, "--out", "x.json", "--outt"], "--outt"),
        (vec!["walk"], "walk"),
        (vec![], "Usage"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}", errors(&output));
        assert!(errors(&output).contains(named), "{arguments:?}: {}", errors(&output));
    }
    assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 1, "something is left behind");
    for question in ["--help", "--version"] {
        assert_eq!(superhelix(&[question]).status.code(), Some(0));
    }
}

#[test]
fn a_bad_scene_leaves_an_old_result_alone() {
    let directory = directory("old");
    let (scene, result) = (directory.join("scene.json"), directory.join("result.json"));
    std::fs::write(&scene, with(small_scene(), "/time_step", json!(-1)).to_string()).unwrap();
    std::fs::write(&result, "old").unwrap();
    let output = superhelix(&["run".as_ref(), scene.as_os_str(), "--out".as_ref(), result.as_os_str()]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&result).unwrap(), "old");
}
