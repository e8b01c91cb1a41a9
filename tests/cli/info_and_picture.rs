//! `superhelix info` and `superhelix picture`.

use crate::support::{data, directory, errors, superhelix};
use serde_json::Value;
use superhelix::io::{Curves, hair, obj};

#[test]
fn info_counts_the_contents_of_a_groom() {
    let output = superhelix(&["info", "--json", &data("blender_curly.hair")]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let info: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((info["format"].as_str(), info["strands"].as_u64()), (Some("hair"), Some(1234)));
    assert_eq!((info["points_per_strand"]["min"].as_f64(), info["points_per_strand"]["max"].as_f64()), (Some(7.0), Some(128.0)));
    let near = |value: &Value, expected: f64| (value.as_f64().unwrap() / expected - 1.0).abs() < 0.01;
    assert!(near(&info["length"]["median"], 0.088) && near(&info["length"]["max"], 0.333), "{}", info["length"]);
    assert!(near(&info["turning_degrees"]["median"], 390.0) && near(&info["turning_degrees"]["max"], 1321.0));
    assert_eq!(info["scale_guess"]["metres_per_unit"], 1.0);
    assert_eq!(info["strands_without_length"], 0);

    for (name, format, strands, scale) in [
        ("amd_ponytail_tail.tfx", "tfx 3", 474, None),
        ("fibermesh_1k.tfx", "tfx 2 (text)", 1000, Some(0.001)),
        ("sintel_hair_001.tfx", "tfx 4", 228, Some(0.01)),
    ] {
        let output = superhelix(&["info", "--json", &data(name)]);
        let info: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((info["format"].as_str(), info["strands"].as_u64()), (Some(format), Some(strands)), "{name}");
        if let Some(scale) = scale {
            assert_eq!(info["scale_guess"]["metres_per_unit"].as_f64(), Some(scale), "{name}");
        }
    }
}

#[test]
fn info_in_words_calls_its_guess_a_guess() {
    let output = superhelix(&["info", &data("sintel_hair_001.tfx")]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("tfx 4") && text.contains("228") && text.contains("a guess: 0.01 m a unit"), "{text}");
    assert!(text.contains("degenerate"), "{text}");
    let output = superhelix(&["info", "no_such_groom.hair"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("no_such_groom.hair"));
}

/// Writes five frames of three strands whose tips swing.
fn cache(directory: &std::path::Path, extension: &str) {
    for frame in 0..5 {
        let strands: Vec<Vec<[f32; 3]>> = (0..3)
            .map(|strand| {
                (0..8).map(|point| [strand as f32 * 0.05 + 0.004 * (frame * point) as f32, -0.02 * point as f32, 0.0]).collect()
            })
            .collect();
        let curves = Curves::from_strands(&strands).unwrap();
        let path = directory.join(format!("hair.{:04}.{extension}", frame + 1));
        if extension == "obj" { obj::write(&path, &curves).unwrap() } else { hair::write(&path, &curves).unwrap() }
    }
}

/// Width and height of a PNG file.
fn size(path: &std::path::Path) -> (u32, u32) {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes[..8], [0x89, b'P', b'N', b'G', 13, 10, 26, 10]);
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn a_cache_of_either_format_gives_the_same_sheet() {
    let directory = directory("picture_formats");
    let mut sheets = Vec::new();
    for extension in ["obj", "hair"] {
        let frames = directory.join(extension);
        std::fs::create_dir(&frames).unwrap();
        cache(&frames, extension);
        let sheet = directory.join(format!("{extension}.png"));
        let output = superhelix(&[
            "picture",
            frames.to_str().unwrap(),
            "--out",
            sheet.to_str().unwrap(),
            "--moments",
            "3",
            "--fps",
            "30",
            "--scale",
            "1",
            "--title",
            "swing",
            "--cell",
            "200",
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        // Three cells of 200 pixels, two gaps, two margins.
        assert_eq!(size(&sheet).0, 3 * 200 + 2 * 6 + 2 * 28);
        sheets.push(std::fs::read(&sheet).unwrap());
    }
    assert!(sheets[0] == sheets[1]);
}

#[test]
fn files_may_be_given_and_turned() {
    let directory = directory("picture_files");
    cache(&directory, "obj");
    let file = |index: usize| directory.join(format!("hair.{index:04}.obj")).to_str().unwrap().to_string();
    let sheet = |name: &str, flags: &[&str]| {
        let path = directory.join(name);
        let (one, five) = (file(1), file(5));
        let arguments = [&["picture", &one, &five, "--out", path.to_str().unwrap(), "--title", "t"], flags].concat();
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
        std::fs::read(path).unwrap()
    };
    let front = sheet("front.png", &[]);
    assert!(front == sheet("same.png", &["--face", "+z"]));
    assert!(front != sheet("back.png", &["--face", "-z"]));
    assert!(front != sheet("one.png", &["--every", "2"]));
}

#[test]
fn undrawable_input_is_reported_and_writes_nothing() {
    let directory = directory("picture_errors");
    let (empty, mixed) = (directory.join("empty"), directory.join("mixed"));
    std::fs::create_dir(&empty).unwrap();
    std::fs::create_dir(&mixed).unwrap();
    cache(&mixed, "obj");
    cache(&mixed, "hair");
    let sheet = directory.join("sheet.png");
    let groom = data("sintel_hair_001.tfx");
    let first = mixed.join("hair.0001.obj");
    for (inputs, named) in [
        (vec![empty.to_str().unwrap()], "no numbered .obj or .hair frames"),
        (vec![mixed.to_str().unwrap()], "several sequences"),
        (vec!["no_such_frame.obj"], "no_such_frame.obj"),
        (vec![first.to_str().unwrap(), groom.as_str()], "228 strands"),
        (vec![first.to_str().unwrap(), "--face", "+y"], "--face"),
        (vec![first.to_str().unwrap(), "--moments", "0"], "--moments"),
    ] {
        let output = superhelix(&[&["picture", "--out", sheet.to_str().unwrap()], &inputs[..]].concat());
        assert_eq!(output.status.code(), Some(1), "{inputs:?}: {}", errors(&output));
        assert!(errors(&output).contains(named), "{inputs:?}: {}", errors(&output));
        assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 2, "{inputs:?}: something is left behind");
    }
    let nowhere = directory.join("no_such_directory").join("sheet.png");
    let output = superhelix(&["picture", first.to_str().unwrap(), "--out", nowhere.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn suggested_elements_bring_the_groom_within_the_tolerance_and_fewer_do_not() {
    let groom = data("sintel_hair_001.tfx");
    let output = superhelix(&["info", &groom, "--json", "--suggest", "0.002", "--scale", "0.01"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let suggested = &answer["suggested"];
    assert_eq!(suggested["unmet"], 0);
    let looked_at = suggested["strands"].as_u64().unwrap();
    let every = (answer["strands"].as_u64().unwrap()).div_ceil(32);
    assert!((16..=32).contains(&looked_at));
    let most = suggested["elements"]["max"].as_f64().unwrap();
    // The same strands, fitted by `simulate`.
    let met = |elements: f64| {
        let numbers = [every.to_string(), elements.to_string()];
        let arguments = [
            "simulate",
            &groom,
            "--json",
            "--scale",
            "0.01",
            "--duration",
            "0.04",
            "--every",
            &numbers[0],
            "--elements",
            &numbers[1],
        ];
        let report: Value = serde_json::from_slice(&superhelix(&arguments).stdout).unwrap();
        assert_eq!(report["strands"].as_u64(), Some(looked_at));
        report["fit"]["max_metres"]["max"].as_f64().unwrap() <= 0.002 && report["fit"]["strands_with_coarse_elements"] == 0
    };
    assert!(met(most) && !met(most - 1.0));
    let alone = superhelix(&["info", &groom, "--suggest", "0.002"]);
    assert!(alone.status.code() == Some(1) && errors(&alone).contains("--scale"), "{}", errors(&alone));
}
