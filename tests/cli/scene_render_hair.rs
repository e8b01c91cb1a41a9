//! `superhelix run`: the render hair that a scene asks for, against `superhelix interpolate` from the cache of the same run.

use std::path::Path;

use crate::support::{errors, small_scene, superhelix, with};
use serde_json::{Value, json};
use superhelix::io::{CurveCache, Curves};

/// A square of 20 cm in the plane z = 0, facing up, in centimetres; its corners raised by `lift`.
fn square(path: &Path, lift: f64) {
    let uv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let corners = format!("v -10 -10 {lift}\nv 10 -10 0\nv 10 10 {lift}\nv -10 10 0\n");
    std::fs::write(path, corners + uv + "f 1/1 2/2 3/3 4/4\n").unwrap();
}

/// Strands on a square, carried about z as it turns; the last written state is not a whole interval after the one before.
fn scene() -> Value {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let strand = json!({
        "elements": 3, "length": 0.05, "contact": false, "hair": { "type": "african" },
        "follicles": { "file": "square.obj", "scale": 0.01, "count": 20, "seed": 5 },
        "root_motion": { "times": [0.0, 0.05], "frames": [[0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, half, half]] }
    });
    let scene = with(with(small_scene(), "/strands", json!([strand])), "/duration", json!(0.047));
    with(with(scene, "/samples", json!(17)), "/threads", json!(2))
}

/// What `run` leaves of a scene with that `render_hair`: the process's output; files are in `place`.
fn run(place: &Path, render_hair: &Value) -> std::process::Output {
    let path = |name: &str| place.join(name).display().to_string();
    std::fs::write(path("scene.json"), with(scene(), "/render_hair", render_hair.clone()).to_string()).unwrap();
    superhelix(&["run", &path("scene.json"), "--out", &path("result.json"), "--cache", &path("strands.usda"), "--quiet"])
}

fn well(output: &std::process::Output) {
    assert_eq!(output.status.code(), Some(0), "{}", errors(output));
}

fn directory(name: &str) -> std::path::PathBuf {
    let place = crate::support::directory(&format!("scene_render_hair_{name}"));
    square(&place.join("square.obj"), 0.0);
    place
}

/// Every file of a directory, or the file, with its bytes.
fn bytes(path: &Path) -> Vec<(String, Vec<u8>)> {
    if !path.is_dir() {
        return vec![(String::new(), std::fs::read(path).unwrap())];
    }
    let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        entries.map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap())).collect();
    files.sort();
    files
}

#[test]
fn a_scene_makes_the_render_hair_that_interpolate_makes_of_its_cache() {
    let place = directory("same");
    // A mesh in metres: interpolate takes it in the guides' unit.
    let metres = "v -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0.1 0.1 0\nv -0.1 0.1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(place.join("metres.obj"), metres).unwrap();
    std::fs::write(place.join("numbers.txt"), "1 2 0.5 1\n").unwrap();
    std::fs::write(place.join("roots.obj"), "v 0.01 0.02 0\nv 0.01 0.02 1\nl 1 2\nv -0.05 0.03 0\nv 0 0 1\nl 3 4\n").unwrap();
    let mut picture = tiny_skia::Pixmap::new(2, 2).unwrap();
    picture.pixels_mut()[0] = tiny_skia::PremultipliedColorU8::from_rgba(255, 255, 255, 255).unwrap();
    picture.pixels_mut()[1] = tiny_skia::PremultipliedColorU8::from_rgba(90, 90, 90, 255).unwrap();
    picture.save_png(place.join("picture.png")).unwrap();
    // A scalp that deforms, a mesh for each of the six written states.
    std::fs::create_dir_all(place.join("meshes")).unwrap();
    for frame in 0..6 {
        let text = metres.replacen("v 0.1 0.1 0", &format!("v 0.1 0.1 {}", 0.003 * f64::from(frame * frame)), 1);
        std::fs::write(place.join(format!("meshes/head.{frame:04}.obj")), text).unwrap();
    }
    // The same in one file, in its own unit, with samples at other times than the states.
    let corners = |lift: f64| format!("[(-10, -10, 0), (10, -10, 0), (10, 10, {lift}), (-10, 10, 0)]");
    let samples = format!("0: {}, 1: {}, 2: {}", corners(0.0), corners(2.0), corners(1.0));
    let mesh = "int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, 2, 3]\npoint3f[] points.timeSamples";
    let text =
        format!("#usda 1.0\n(upAxis = \"Z\" timeCodesPerSecond = 40)\ndef Mesh \"head\"\n{{\n{mesh} = {{ {samples} }}\n}}\n");
    std::fs::write(place.join("head.usda"), text).unwrap();
    let every_setting = json!({
        "out": "render.usda", "every": 2, "count": 50, "scalp": { "file": "metres.obj", "within": 0.05 }, "points": 9,
        "space": "curvature", "guides_per_strand": 2, "curliness": 0.4, "max_tip_distance": 0.2, "max_tip_ratio": 0.9, "wisps": 2,
        "wisp_profile": [1, 0.5, 0.1], "frizz": 0.001, "frizz_waves": 4, "length_variation": 0.3, "radius": 5e-5,
        "tip_radius": 1e-5, "taper_from": 0.3, "radius_variation": 0.2, "seed": 7, "flatness": 0.2, "clump_noise": 0.002,
        "clump_noise_waves": 2, "flyaways": 0.2, "flyaway_distance": 0.003, "taper_shape": -0.3, "preserve_length": false,
        "clearance": 0.003
    });
    let flags = "--every 2 --count 50 --scalp metres.obj --within 0.05 --points 9 --space curvature --guides-per-strand 2 \
                 --curliness 0.4 --max-tip-distance 0.2 --max-tip-ratio 0.9 --wisps 2 --wisp-profile 1,0.5,0.1 --frizz 0.001 \
                 --frizz-waves 4 --length-variation 0.3 --radius 5e-5 --tip-radius 1e-5 --taper-from 0.3 --radius-variation 0.2 \
                 --seed 7 --flatness 0.2 --clump-noise 0.002 --clump-noise-waves 2 --flyaways 0.2 --flyaway-distance 0.003 \
                 --taper-shape -0.3 --free-length --clearance 0.003";
    let painted = json!({ "out": "render.usda", "count": 30, "max_tip_ratio": 0,
                          "scalp": { "file": "metres.obj", "density": "numbers.txt", "density_picture": "picture.png" } });
    let cases = [
        (json!({ "out": "render.usda" }), "render.usda", ""),
        (every_setting, "render.usda", flags),
        (
            painted,
            "render.usda",
            "--count 30 --max-tip-ratio 0 --scalp metres.obj --density numbers.txt --density-picture picture.png",
        ),
        (
            json!({ "out": "render.usda", "count": 40, "scalp": { "file": "meshes" }, "curliness": "measured" }),
            "render.usda",
            "--count 40 --scalp meshes --curliness measured",
        ),
        (
            json!({ "out": "render.usda", "count": 40, "scalp": { "file": "metres.obj", "whole": true } }),
            "render.usda",
            "--count 40 --scalp metres.obj --whole-scalp",
        ),
        (
            json!({ "out": "render.usda", "count": 40, "scalp": { "file": "head.usda" } }),
            "render.usda",
            "--count 40 --scalp head.usda",
        ),
        (
            json!({ "out": "render.usda", "roots": { "file": "roots.obj", "metres_per_unit": 1 } }),
            "render.usda",
            "--roots roots.obj",
        ),
        (
            json!({ "out": "render.usda", "roots": { "file": "roots.obj", "metres_per_unit": 1, "shapes": true } }),
            "render.usda",
            "--roots roots.obj --shapes",
        ),
        (json!({ "out": "frames", "count": 30 }), "frames", "--count 30"),
    ];
    let mut all = Vec::new();
    for (index, (section, out, flags)) in cases.into_iter().enumerate() {
        well(&run(&place, &section));
        let other = place.join(format!("other{index}")).join(out);
        std::fs::create_dir_all(other.parent().unwrap()).unwrap();
        // Flags that name files name them in the directory.
        let place_of = |flag: &str| if place.join(flag).exists() { place.join(flag).display().to_string() } else { flag.into() };
        let flags = flags.split_ascii_whitespace().map(place_of);
        let (cache, other_path) = (place.join("strands.usda").display().to_string(), other.display().to_string());
        // A scene's strands are kept out of its colliders, of which there are none.
        let command = ["interpolate".to_string(), cache, "--no-body".into(), "--out".into(), other_path].into_iter().chain(flags);
        well(&superhelix(&command.collect::<Vec<_>>()));
        let (one, other) = (bytes(&place.join(out)), bytes(&other));
        assert!(one.len() == other.len() && one == other, "case {index}: the files differ");
        all.push(one);
    }
    // Each case is another hair, so that none of them can pass by a setting that is not read.
    assert!((0..all.len()).all(|k| (0..k).all(|j| all[j] != all[k])));
    let cache = CurveCache::read(place.join("render.usda")).unwrap();
    assert!(cache.times().len() == 6 && cache.frame(5).unwrap().extras().velocities.is_some());
    assert_eq!(Curves::read(place.join("frames/render.0006.hair")).unwrap().strand_count(), 30);
    // Frames that are there are not mixed with others unless the scene says so.
    let again = run(&place, &json!({ "out": "frames", "count": 30 }));
    assert_eq!(again.status.code(), Some(1));
    assert!(errors(&again).contains("is there already"), "{}", errors(&again));
    well(&run(&place, &json!({ "out": "frames", "count": 31, "overwrite": true })));
    assert_eq!(Curves::read(place.join("frames/render.0001.hair")).unwrap().strand_count(), 31);
}

#[test]
fn the_example_scene_writes_its_render_hair() {
    let place = directory("example");
    let path = |name: &str| place.join(name).display().to_string();
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes/render_hair.json"), path("scene.json")).unwrap();
    well(&superhelix(&["run", &path("scene.json"), "--out", &path("result.json"), "--quiet"]));
    let cache = CurveCache::read(path("render.usda")).unwrap();
    assert_eq!((cache.times().len(), cache.frame(30).unwrap().strand_count()), (31, 2000));
}

#[test]
fn roots_stand_where_the_scalp_and_the_groom_are_in_the_scene() {
    let place = directory("placed");
    let roots = |section: Value| {
        well(&run(&place, &with(section, "/out", json!("render.usda"))));
        let curves = CurveCache::read(place.join("render.usda")).unwrap().frame(0).unwrap();
        curves.strands().map(|strand| strand[0].map(f64::from)).collect::<Vec<_>>()
    };
    // The guides' own square, upright in the plane x = 0.02 by its pose: z of the mesh is x, x is -z.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = json!({ "origin": [0.02, 0, 0], "rotation": [0, half, 0, half] });
    let found = roots(json!({ "count": 40, "scalp": { "file": "square.obj", "scale": 0.01, "pose": pose, "within": 1 } }));
    assert_eq!(found.len(), 40);
    for [x, y, z] in &found {
        assert!((x - 0.02).abs() < 1e-6 && y.abs() <= 0.1 && z.abs() <= 0.1, "{x} {y} {z}");
    }
    assert!(found.iter().any(|root| root[2] < -0.05) && found.iter().any(|root| root[2] > 0.05));
    std::fs::write(place.join("roots.obj"), "v 1 2 3\nv 1 2 4\nl 1 2\n").unwrap();
    let found = roots(json!({ "roots": { "file": "roots.obj", "metres_per_unit": 0.01, "pose": pose } }));
    let [x, y, z] = found[0];
    assert!(found.len() == 1 && (x - 0.05).abs() < 1e-6 && (y - 0.02).abs() < 1e-6 && (z + 0.01).abs() < 1e-6, "{found:?}");
}

/// At t = 0 the strands are those of the file, wherever the guides are and whatever is mixed; later they have moved, and are as long.
#[test]
fn strands_have_the_shapes_of_a_groom() {
    let place = directory("shapes");
    let wave = |k: usize, x: f64| {
        let s = 0.25 * k as f64;
        format!("v {x} {} {}\n", 0.3 * (7.0 * s).sin(), 5.0 * s)
    };
    let text: String = (0..3).flat_map(|strand| (0..=4).map(move |k| wave(k, 4.0 * strand as f64 - 3.0))).collect();
    let lines: String =
        (0..3).map(|strand| (1..=5).fold("l".into(), |line: String, k| format!("{line} {}", 5 * strand + k)) + "\n").collect();
    std::fs::write(place.join("waves.obj"), text + &lines).unwrap();
    let pose = json!({ "origin": [0.01, 0, 0] });
    let roots = json!({ "file": "waves.obj", "metres_per_unit": 0.01, "pose": pose, "shapes": true });
    let section =
        json!({ "out": "render.usda", "roots": roots, "points": 65, "length_variation": 0, "frizz": 0.003, "curliness": 0.7 });
    well(&run(&place, &section));
    let cache = CurveCache::read(place.join("render.usda")).unwrap();
    let (first, last, file) = (cache.frame(0).unwrap(), cache.frame(5).unwrap(), Curves::read(place.join("waves.obj")).unwrap());
    for strand in 0..3 {
        // Every sixteenth point is at a quarter of the length, close to a point of the file.
        let wanted: Vec<[f64; 3]> = file
            .strand(strand)
            .iter()
            .map(|[x, y, z]| [0.01 * f64::from(*x) + 0.01, 0.01 * f64::from(*y), 0.01 * f64::from(*z)])
            .collect();
        let length: f64 =
            wanted.windows(2).map(|edge| (0..3).map(|k| (edge[1][k] - edge[0][k]).powi(2)).sum::<f64>().sqrt()).sum();
        for point in first.strand(strand) {
            let point = point.map(f64::from);
            let to = |edge: &[[f64; 3]]| {
                let along: [f64; 3] = std::array::from_fn(|k| edge[1][k] - edge[0][k]);
                let from: [f64; 3] = std::array::from_fn(|k| point[k] - edge[0][k]);
                let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
                let share = (dot(from, along) / dot(along, along)).clamp(0.0, 1.0);
                (0..3).map(|k| (from[k] - share * along[k]).powi(2)).sum::<f64>().sqrt()
            };
            let off = wanted.windows(2).map(to).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-6, "{strand}: {off}");
        }
        // What curls of the guides do to the way along it is looked at from point to point alone.
        for (frame, permitted) in [(&first, 0.002), (&last, 0.03)] {
            let found = frame.strand_length(strand) / length;
            assert!((found - 1.0).abs() < permitted, "{strand}: {found}");
        }
        let (before, after) = (first.strand(strand)[64], last.strand(strand)[64]);
        assert!((0..3).any(|k| (before[k] - after[k]).abs() > 0.01), "{before:?} {after:?}");
    }
}

#[test]
fn bad_sections_are_named() {
    let place = directory("refused");
    for (frame, lift) in [(0, 0.0), (1, 1.0)] {
        std::fs::create_dir_all(place.join("two")).unwrap();
        square(&place.join(format!("two/head.{frame}.obj")), lift);
    }
    std::fs::write(place.join("three.txt"), "1 2 3").unwrap();
    std::fs::write(place.join("bare.txt"), "0 0 0 0").unwrap();
    std::fs::write(place.join("word.txt"), "1 2 3 four").unwrap();
    std::fs::write(place.join("bare.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").unwrap();
    let mesh = "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\npoint3f[] points.timeSamples";
    let corners = "[(0, 0, 0), (1, 0, 0), (1, 1, 0)]";
    let text = format!("#usda 1.0\ndef Mesh \"head\"\n{{\n{mesh} = {{ 0: {corners}, 1: {corners} }}\n}}\n");
    std::fs::write(place.join("short.usda"), text).unwrap();
    let scalp = |more: Value| {
        let mut scalp = json!({ "file": "square.obj", "scale": 0.01 });
        more.as_object().unwrap().iter().for_each(|(key, value)| scalp[key] = value.clone());
        scalp
    };
    let cases = [
        ("out", json!(3), "out", "3"),
        ("out", json!("render.hair"), "out", "\"render.hair\""),
        ("overwrite", json!("yes"), "overwrite", "\"yes\""),
        ("count", json!(0), "count", "0"),
        ("count", json!(10_000_001), "count", "10000001"),
        ("every", json!(0), "every", "0"),
        ("points", json!(1), "points", "1"),
        ("points", json!(4097), "points", "4097"),
        ("space", json!("time"), "space", "\"time\""),
        ("guides_per_strand", json!(5), "guides_per_strand", "5"),
        ("curliness", json!(1.5), "curliness", "1.5"),
        ("curliness", json!("much"), "curliness", "\"much\""),
        ("max_tip_distance", json!(0), "max_tip_distance", "0"),
        ("max_tip_ratio", json!(-1), "max_tip_ratio", "-1"),
        ("wisps", json!(0), "wisps", "0"),
        ("wisp_profile", json!([1, 2]), "wisp_profile", "[1,2]"),
        ("wisp_profile", json!([1, -2, 0]), "wisp_profile[1]", "-2"),
        ("frizz", json!(-0.5), "frizz", "-0.5"),
        ("frizz_waves", json!(1001), "frizz_waves", "1001"),
        ("length_variation", json!(1), "length_variation", "1"),
        ("preserve_length", json!("yes"), "preserve_length", "\"yes\""),
        ("flatness", json!(1.5), "flatness", "1.5"),
        ("clump_noise", json!(-1), "clump_noise", "-1"),
        ("clump_noise_waves", json!(1001), "clump_noise_waves", "1001"),
        ("flyaways", json!(2), "flyaways", "2"),
        ("flyaway_distance", json!(-1), "flyaway_distance", "-1"),
        ("taper_shape", json!(1), "taper_shape", "1"),
        ("clearance", json!(0), "clearance", "0"),
        ("bodies", json!(3), "bodies", "3"),
        ("radius", json!(-1), "radius", "-1"),
        ("tip_radius", json!("thin"), "tip_radius", "\"thin\""),
        ("taper_from", json!(1), "taper_from", "1"),
        ("radius_variation", json!(1.25), "radius_variation", "1.25"),
        ("seed", json!(-1), "seed", "-1"),
        ("colour", json!("red"), "colour", "\"red\""),
        ("scalp", json!("square.obj"), "scalp", "\"square.obj\""),
        ("scalp", json!({}), "scalp.file", "is missing"),
        ("scalp", scalp(json!({ "file": "none.obj" })), "scalp.file", "\"none.obj\""),
        ("scalp", scalp(json!({ "file": "two" })), "scalp.file", "has 2 meshes"),
        ("scalp", scalp(json!({ "file": "short.usda" })), "scalp.file", "has samples from 0 to 0.041666666666666664 s"),
        ("scalp", scalp(json!({ "file": "three.txt" })), "scalp.file", "\"three.txt\""),
        ("scalp", scalp(json!({ "scale": 0 })), "scalp.scale", "0"),
        ("scalp", scalp(json!({ "within": 0 })), "scalp.within", "0"),
        ("scalp", scalp(json!({ "within": 1e-9, "pose": { "origin": [9, 9, 9] } })), "scalp.within", "above zero on less than"),
        ("scalp", scalp(json!({ "within": 0.01, "whole": true })), "scalp.whole", "within"),
        ("scalp", scalp(json!({ "whole": 1 })), "scalp.whole", "1"),
        ("scalp", scalp(json!({ "density": "three.txt" })), "scalp.density", "3"),
        ("scalp", scalp(json!({ "density": "bare.txt" })), "scalp.density", "0 everywhere"),
        ("scalp", scalp(json!({ "density": "word.txt" })), "scalp.density", "\"word.txt\""),
        ("scalp", scalp(json!({ "density_picture": "word.txt" })), "scalp.density_picture", "\"word.txt\""),
        ("scalp", json!({ "file": "bare.obj", "density_picture": "word.txt" }), "scalp.density_picture", "texture coordinates"),
        ("scalp", scalp(json!({ "pose": { "origin": [1] } })), "scalp.pose.origin", "[1]"),
        ("scalp", scalp(json!({ "spacing": 1 })), "scalp.spacing", "1"),
        ("roots", json!({ "file": "none.obj" }), "roots.file", "\"none.obj\""),
        ("roots", json!({ "file": "square.obj", "metres_per_unit": 0 }), "roots.file", "\"square.obj\""),
    ];
    let refuse = |section: Value, key: &str, shown: &str| {
        let output = run(&place, &section);
        let message = errors(&output);
        assert_eq!(output.status.code(), Some(2), "{key} {shown}: {message}");
        assert!(message.contains("scene.json: ") && message.trim_end().lines().count() == 1, "{message}");
        assert!(message.contains(&format!("render_hair.{key} ")) && message.contains(shown), "{key}, {shown}: {message}");
        for name in ["result.json", "strands.usda", "render.usda"] {
            assert!(!place.join(name).exists(), "{key}: {name} is written");
        }
    };
    for (key, value, path, shown) in cases {
        let mut section = json!({ "out": "render.usda" });
        section[key] = value;
        refuse(section, path, shown);
    }
    refuse(json!({}), "out", "is missing");
    std::fs::write(place.join("groom.obj"), "v 0 0 0\nv 0 0 1\nl 1 2\n").unwrap();
    refuse(json!({ "out": "render.usda", "roots": { "file": "groom.obj" } }), "roots.metres_per_unit", "is missing");
    let no_truth = json!({ "file": "groom.obj", "metres_per_unit": 1, "shapes": 1 });
    refuse(json!({ "out": "render.usda", "roots": no_truth }), "roots.shapes", "1");
    let groom = json!({ "file": "groom.obj", "metres_per_unit": 1 });
    refuse(json!({ "out": "render.usda", "roots": groom, "count": 7 }), "count", "7");
    refuse(json!({ "out": "render.usda", "roots": groom, "scalp": { "file": "square.obj" } }), "scalp", "roots");
}
