//! `superhelix convert` and `superhelix lock`, and grooms and caches in USD text through the other commands.

use crate::support::{data, directory, errors, run_text, small_scene, superhelix, with};
use serde_json::{Value, json};
use superhelix::io::{CurveCache, Curves, UpAxis};

#[track_caller]
fn succeed(arguments: &[&str]) -> (String, String) {
    let output = superhelix(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", errors(&output));
    (String::from_utf8(output.stdout.clone()).unwrap(), errors(&output))
}

#[test]
fn a_groom_goes_through_every_format() {
    let directory = directory("convert");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    let groom = data("amd_ponytail_back.tfx");
    let original = Curves::read(&groom).unwrap();
    let (_, said) = succeed(&["convert", &groom, &path("a.usda"), "--unit", "0.0031", "--strict"]);
    assert_eq!(said, "");
    let usda = Curves::read(path("a.usda")).unwrap();
    assert_eq!(
        (usda.points(), usda.extras().metres_per_unit, usda.extras().up),
        (original.points(), Some(0.0031), Some(UpAxis::Y))
    );
    let (info, _) = succeed(&["info", &path("a.usda")]);
    assert!(info.contains("0.0031 m, y up: the file says so") && !info.contains("guess"), "{info}");
    let (_, said) = succeed(&["convert", &path("a.usda"), &path("b.tfx"), "--tfx-version", "3"]);
    assert!(said.contains("tfx 3 has no place for the unit, the up axis"), "{said}");
    // Through text and back: the bytes of the groom.
    assert!(std::fs::read(path("b.tfx")).unwrap() == std::fs::read(&groom).unwrap());
    for (name, format) in [("c.hair", "hair"), ("c.obj", "obj"), ("c.tfx", "tfx 3"), ("d.usda", "usda")] {
        let (answer, _) = succeed(&["convert", &groom, &path(name)]);
        assert!(answer.contains(&format!("{format}, 517 strands, 8272 points")), "{answer}");
        assert_eq!(Curves::read(path(name)).unwrap().points(), original.points(), "{name}");
    }
    // Changed during conversion.
    succeed(&["convert", &path("a.usda"), &path("e.usda"), "--scale", "0.0031", "--to-z-up", "--every", "100"]);
    let changed = Curves::read(path("e.usda")).unwrap();
    let [x, y, z] = original.strand(100)[3].map(|value| (f64::from(value) * 0.0031) as f32);
    assert_eq!((changed.strand_count(), changed.strand(1)[3]), (6, [x, -z, y]));
    assert_eq!((changed.extras().metres_per_unit, changed.extras().up), (Some(1.0), Some(UpAxis::Z)));

    for (arguments, said) in [
        (vec!["convert", &groom, "x.png"], "no known format"),
        (vec!["convert", &data("blender_curly.hair"), &path("u.tfx"), "--tfx-version", "4"], "strand 0 has"),
        (vec!["convert", &groom, &path("s.obj"), "--strict"], "no place for which points are held"),
        (vec!["convert", &groom, &path("s.hair"), "--tfx-version", "4"], "no .tfx file"),
        (vec!["convert", &path("e.usda"), &path("f.usda"), "--to-z-up"], "z up already"),
        (vec!["convert", directory.to_str().unwrap(), &path("f.usda")], "give --fps"),
        (vec!["convert", &groom, &path("s.usda"), "--unit", "0"], "above zero"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(said), "{arguments:?}: {}", errors(&output));
    }
    assert!(!directory.join("s.obj").exists() && !directory.join("u.tfx").exists());
}

/// A groom that is written to itself would be lost where the format has no place for all of it.
#[test]
fn a_groom_is_not_written_over_itself() {
    let directory = directory("convert_itself");
    let groom = directory.join("groom.tfx");
    std::fs::copy(data("amd_ponytail_back.tfx"), &groom).unwrap();
    let before = std::fs::read(&groom).unwrap();
    let other = directory.join(".").join("groom.tfx");
    for output in [&groom, &other] {
        let output = superhelix(&["convert".as_ref(), groom.as_os_str(), output.as_os_str()]);
        assert_eq!(output.status.code(), Some(1));
        assert!(errors(&output).contains("groom.tfx") && errors(&output).contains("another file"), "{}", errors(&output));
    }
    assert!(std::fs::read(&groom).unwrap() == before);
}

#[test]
fn a_simulation_leaves_a_cache_with_velocities_and_reads_the_unit() {
    let directory = directory("usda_cache");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    succeed(&["convert", &data("sintel_hair_001.tfx"), &path("groom.usda"), "--unit", "0.01", "--every", "40"]);
    let (answer, _) = succeed(&[
        "simulate",
        &path("groom.usda"),
        "--duration",
        "0.2",
        "--fps",
        "30",
        "--elements",
        "4",
        "--natural",
        "as-drawn",
        "--bare",
        "--out",
        &path("cache"),
        "--format",
        "usda",
        "--samples",
        "9",
        "--json",
        "--picture",
        &path("sheet.png"),
        "--moments",
        "2",
    ]);
    let answer: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!((answer["metres_per_unit"].as_f64(), answer["cache_frames"].as_u64()), (Some(0.01), Some(7)));
    let cache = CurveCache::read(path("cache/hair.usda")).unwrap();
    assert_eq!((cache.times().len(), cache.time_codes_per_second()), (7, 30.0));
    let (before, now, after) = (cache.frame(3).unwrap(), cache.frame(4).unwrap(), cache.frame(5).unwrap());
    assert_eq!((now.counts(), now.extras().metres_per_unit), (&[9; 6][..], Some(0.01)));
    // Velocities are those of the points, to the accuracy of a difference over two frames of falling hair, a tenth.
    let velocities = now.extras().velocities.as_ref().unwrap();
    let (mut apart, mut fastest) = (0.0_f64, 0.0_f64);
    for (index, velocity) in velocities.iter().enumerate() {
        for axis in 0..3 {
            let difference = f64::from(after.points()[index][axis] - before.points()[index][axis]) * 15.0;
            apart = apart.max((difference - f64::from(velocity[axis])).abs());
            fastest = fastest.max(difference.abs());
        }
    }
    assert!(fastest > 10.0 && apart < 0.1 * fastest, "{apart} {fastest}");
    succeed(&["picture", &path("cache/hair.usda"), "--out", &path("again.png"), "--moments", "3", "--quiet"]);
    // To frames and back: the points, not the velocities.
    let (_, said) = succeed(&["convert", &path("cache/hair.usda"), &path("frames"), "--fps", "30"]);
    assert!(said.contains("velocities"), "{said}");
    succeed(&["convert", &path("frames"), &path("back.usda"), "--fps", "30", "--unit", "0.01"]);
    let back = CurveCache::read(path("back.usda")).unwrap();
    assert_eq!((back.times().len(), back.frame(6).unwrap().points()), (7, cache.frame(6).unwrap().points()));
    assert_eq!(back.frame(6).unwrap().extras().velocities, None);

    let groom = path("groom.usda");
    for (arguments, said) in [
        (vec!["simulate", &groom, "--duration", "0.1", "--out", &path("cache"), "--format", "usda"], "is there already"),
        (vec!["simulate", &groom, "--duration", "0.1", "--up", "z"], "says that y is up: give --up y"),
        (vec!["convert", &path("frames"), &path("x.hair"), "--fps", "30"], "no other format has frames"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(said), "{arguments:?}: {}", errors(&output));
    }
}

#[test]
fn a_lock_is_a_scene_and_hair_in_a_scene_is_the_same() {
    let directory = directory("lock");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    let make = |more: &[&str], out: &str| -> Value {
        let lock = path(out);
        let mut arguments = vec!["lock", "--strands", "3", "--elements", "8", "--length", "0.1", "--out", &lock];
        arguments.extend(more);
        succeed(&arguments);
        serde_json::from_str(&std::fs::read_to_string(&lock).unwrap()).unwrap()
    };
    let african = make(&["--type", "african", "--alike"], "african.json");
    let strands = african["strands"].as_array().unwrap();
    assert_eq!(strands.len(), 3);
    let row = strands[2]["natural_curvatures"][5].as_array().unwrap();
    let p = 0.01 / (2.0 * std::f64::consts::PI);
    let square = 1e-6 + p * p;
    assert!(
        (row[1].as_f64().unwrap() * square / 1e-3 - 1.0).abs() < 1e-12
            && (row[0].as_f64().unwrap() * square / p - 1.0).abs() < 1e-12
    );
    let paper = make(&["--type", "african", "--alike", "--curl", "paper"], "paper.json");
    assert!((paper["strands"][0]["natural_curvatures"][0][1].as_f64().unwrap() - 1000.0).abs() < 1e-9);
    assert_ne!(make(&["--seed", "1"], "a.json"), make(&["--seed", "2"], "b.json"));
    let stiff = make(&["--stiffness", "1", "--alike"], "stiff.json");
    assert!((stiff["strands"][0]["youngs_modulus"].as_f64().unwrap() / 16e9 - 1.0).abs() < 1e-12);
    succeed(&["run", &path("african.json"), "--out", &path("result.json"), "--settle"]);

    // A strand's `hair` in a scene makes the same strand as the library, and what the strand says itself wins.
    let scene = with(
        small_scene(),
        "/strands/0",
        json!({
            "elements": 4, "length": 0.1,
            "hair": { "type": "caucasian2", "sliders": { "curliness": 0.5 }, "variation": { "between": 0.1, "along": 0.1, "seed": 3 }, "strand": 2 },
            "density": 1000
        }),
    );
    let scene = with(scene, "/output", json!(["curvatures"]));
    let scene = with(scene, "/duration", json!(0.0));
    let (output, result) = run_text(&directory, &scene.to_string());
    let result = result.unwrap_or_else(|| panic!("{}", errors(&output)));
    use superhelix::hair::{CurlFormula, HairParameters, Sliders};
    let hair = superhelix::hair::HairType::Caucasian2.measured().parameters(CurlFormula::Exact).unwrap();
    let variation = superhelix::hair::Variation { between: 0.1, along: 0.1, seed: 3, ..Default::default() };
    let hair = HairParameters { variation, ..hair }.with_sliders(&Sliders { curliness: 0.5, ..Sliders::default() }).unwrap();
    let expected = hair.strand(2, &[0.025; 4]).unwrap().natural;
    let found = result.to_string();
    assert!(found.contains(&serde_json::to_string(&expected).unwrap()), "{found} should have {expected:?}");

    for (pointer, value, said) in [
        ("/type", json!("blond"), "strands[0].hair.type"),
        ("/curl", json!("wavy"), "strands[0].hair.curl"),
        ("/ellipticity", json!(0.5), "strands[0].hair.ellipticity"),
        ("/sliders", json!({ "curliness": 2 }), "strands[0].hair.sliders.curliness"),
        ("/sliders", json!({ "shine": 1 }), "strands[0].hair.sliders.shine"),
        ("/variation", json!({ "along": 0.5 }), "strands[0].hair.variation.along"),
        ("/strand", json!(-1), "strands[0].hair.strand"),
    ] {
        let bad = with(scene.clone(), &format!("/strands/0/hair{pointer}"), value);
        let (output, _) = run_text(&directory, &bad.to_string());
        assert_eq!(output.status.code(), Some(2), "{pointer}: {}", errors(&output));
        assert!(errors(&output).contains(said), "{}", errors(&output));
    }
    for (arguments, said) in [
        (vec!["lock", "--type", "blond", "--out", "x"], "expected one of asian"),
        (vec!["lock", "--curliness", "1.5", "--out", "x"], "--curliness is 1.5; expected a number from -1 to 1"),
        (vec!["lock", "--radius", "0", "--out", "x"], "--radius is 0"),
        (vec!["lock", "--direction", "0,0,0", "--out", "x"], "--direction"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(said), "{arguments:?}: {}", errors(&output));
    }
}
