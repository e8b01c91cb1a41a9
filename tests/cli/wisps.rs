//! `superhelix simulate` of grooms with first-day settings: a style holds as firmly as requested, and hair drawn into a head comes
//! out of it.

use std::path::Path;

use serde_json::{Value, json};

use super::support::{data, directory, errors, run_text, small_scene, superhelix, with};

fn simulate(arguments: &[&str]) -> Value {
    let output = superhelix(&[&["simulate", "--json", "--quiet"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Three seconds of a motion, and a second in which the head stays where it is then.
fn motion(directory: &Path, name: &str) -> String {
    let text = std::fs::read_to_string(data(name)).unwrap();
    let (head, rows) = text.split_once('\n').unwrap();
    let time = |row: &str| row.split(',').next().unwrap().parse::<f64>().unwrap();
    let mut kept: Vec<String> = rows.lines().filter(|row| time(row) <= 3.0).map(str::to_owned).collect();
    let (last, pose) = (time(kept.last().unwrap()), kept.last().unwrap().split_once(',').unwrap().1.to_owned());
    kept.extend((1..=30).map(|k| format!("{},{pose}", last + f64::from(k) / 30.0)));
    let path = directory.join(name);
    std::fs::write(&path, format!("{head}\n{}\n", kept.join("\n"))).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The bust in a directory of its own: what is baked of it is kept beside it.
fn bust_in(directory: &Path) -> String {
    let head = directory.join("bust.obj");
    std::fs::copy(data("sintel_bust.obj"), &head).unwrap();
    head.to_str().unwrap().to_string()
}

/// Every n-th strand of each groom, with the head that it was drawn on where available.
const GROOMS: [(&str, &str, &str); 6] = [
    ("sintel_hair_001.tfx", "0.01", "6"),
    ("amd_ponytail_tail.tfx", "0.0031", "16"),
    ("amd_ponytail_back.tfx", "0.0031", "16"),
    ("blender_wavy.hair", "1", "60"),
    ("blender_curly.hair", "1", "60"),
    ("fibermesh_1k.tfx", "0.0012", "20"),
];

/// After 3 s of a walk or of jumping and a second of rest: within 2, 5 and 15 % of its length at hold 1, 0.7 and 0.4; bare hair further off; volume
/// within a tenth at 0.7; every step converged; not more than half a percent of the points deeper than 2 mm in the head.
#[test]
fn a_style_holds_as_firmly_as_requested() {
    let directory = directory("wisps_hold");
    let bust = bust_in(&directory);
    for (name, motion_name) in [("walk", "walk_figure8_head.csv"), ("jumping", "cmu_jumping_jacks_head.csv")] {
        let motion = motion(&directory, motion_name);
        for (groom, scale, every) in GROOMS {
            if name == "jumping" && every == "60" {
                continue;
            }
            let path = data(groom);
            let mut fixed = vec![path.as_str(), "--scale", scale, "--every", every, "--motion", &motion];
            if groom.starts_with("sintel") {
                fixed.extend(["--body", &bust]);
            }
            let mut before = 0.0;
            for (flags, most) in [
                (&["--hold", "1"][..], 0.02),
                (&["--hold", "0.7"], 0.05),
                (&[], 0.1),
                (&["--hold", "0.4"], 0.15),
                (&["--bare"], 1.0),
            ] {
                let report = simulate(&[&fixed[..], flags].concat());
                let style = &report["style"];
                let (distance, volume) = (style["distance"].as_f64().unwrap(), style["volume"].as_f64().unwrap());
                println!("{groom} {name} {flags:?}: {distance:.4} of a length, volume {volume:.3}");
                assert!(distance < most, "{groom} {flags:?}: {distance}");
                // (Where nothing moves by more than a millionth there is nothing to compare.)
                assert!(distance > 0.7 * before || distance < 1e-3, "{groom} {flags:?}: {distance} after {before}");
                before = distance;
                if flags == ["--bare"] {
                    continue;
                }
                let unconverged = (report["report"]["unconverged"].as_u64(), report["report"]["quarantined"].as_u64());
                assert_eq!(unconverged, (Some(0), Some(0)), "{groom} {flags:?}");
                if flags == ["--hold", "0.7"] {
                    assert!((volume - 1.0).abs() < 0.1, "{groom}: {volume}");
                }
                if let Some(inside) = style.get("inside") {
                    assert!(inside["share"].as_f64().unwrap() < 5e-3, "{groom} {flags:?}: {inside}");
                }
            }
        }
    }
}

/// How many strands rest as drawn, and what was done for the others, is said.
#[test]
fn strands_that_rest_as_drawn_are_reported() {
    let groom = data("amd_ponytail_tail.tfx");
    let fixed = [groom.as_str(), "--scale", "0.0031", "--every", "40", "--duration", "0.1"];
    let report = simulate(&[&fixed[..], &["--bare"]].concat());
    let (strands, resting) = (report["strands"].as_u64().unwrap(), &report["resting"]);
    let (stable, limp) = (resting["by_themselves"].as_u64().unwrap(), resting["limp"].as_u64().unwrap());
    assert!(limp > 0 && stable + limp == strands, "{resting}");
    let report = simulate(&[&fixed[..], &["--hold", "0.1"]].concat());
    let resting = &report["resting"];
    assert_eq!(resting["limp"], 0, "{resting}");
    assert!(resting["stiffened"].as_u64().unwrap() > 0 && resting["factor"]["max"].as_f64().unwrap() > 1.0, "{resting}");
    let output = superhelix(&[&["simulate"], &fixed[..], &["--bare"]].concat());
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains(&format!("{limp} are too limp and will sag")), "{said}");
    // Strands that should not rest as drawn are not reported as resting.
    assert!(simulate(&[&fixed[..], &["--natural", "as-drawn"]].concat()).get("resting").is_none());
}

/// Hair drawn centimetres into a head: outside of it by default, inside on request, pushed out by contact on another.
#[test]
fn hair_drawn_inside_a_head_is_brought_out() {
    let directory = directory("wisps_inside");
    let bust = bust_in(&directory);
    let groom = directory.join("inside.obj");
    let curves = superhelix::io::Curves::read(data("sintel_hair_001.tfx")).unwrap();
    // A place well inside the skull.
    let roots: Vec<[f32; 3]> = curves.strands().map(|strand| strand[0]).collect();
    let middle: Vec<f32> = (0..3).map(|axis| roots.iter().map(|root| root[axis]).sum::<f32>() / roots.len() as f32).collect();
    let mut text = String::new();
    let mut count = 0;
    for strand in curves.strands().step_by(20) {
        // A root on the scalp, all else 2.5 cm nearer to the middle of the head.
        for (k, point) in strand.iter().enumerate() {
            let share = (k as f32 / 8.0).min(1.0) * 2.5;
            let to: Vec<f32> = (0..3).map(|axis| middle[axis] - point[axis]).collect();
            let distance = to.iter().map(|x| x * x).sum::<f32>().sqrt();
            let moved: Vec<f32> = (0..3).map(|axis| point[axis] + to[axis] / distance * share).collect();
            text += &format!("v {} {} {}\n", moved[0], moved[1], moved[2]);
        }
        let points: Vec<String> = (1..=strand.len()).map(|k| (count + k).to_string()).collect();
        text += &format!("l {}\n", points.join(" "));
        count += strand.len();
    }
    std::fs::write(&groom, text).unwrap();
    let fixed = [groom.to_str().unwrap(), "--scale", "0.01", "--duration", "0.3", "--body", &bust];
    let inside = |flags: &[&str]| {
        let report = simulate(&[&fixed[..], flags].concat());
        assert_eq!(report["report"]["quarantined"], 0);
        println!("{flags:?}: {} {}", report["drawn_inside"], report["style"]);
        let inside = &report["style"]["inside"];
        let [deepest, at_start] = ["deepest", "deepest_at_start"].map(|key| inside[key].as_f64().unwrap());
        assert!(at_start <= deepest && (at_start > 2e-3) == (inside["share_at_start"] != 0.0), "{inside}");
        (
            report["drawn_inside"].clone(),
            inside["share_at_start"].as_f64().unwrap(),
            report["style"]["distance"].as_f64().unwrap(),
        )
    };
    let (told, share, moved) = inside(&[]);
    assert!(told["strands"].as_u64().unwrap() > 4 && told["deepest"].as_f64().unwrap() > 5e-3, "{told}");
    assert_eq!(told["left"], 0, "{told}");
    assert!(share < 5e-3 && moved < 1e-3, "{share} {moved}");
    let (told, kept, moved) = inside(&["--drawn-inside", "kept"]);
    assert!(kept > 0.1 && moved < 1e-3, "{kept} {moved}");
    assert!(told["becomes"] == "kept" && told["strands"].as_u64().unwrap() > 4 && told["left"] == told["strands"], "{told}");
    let (told, parted, _) = inside(&["--drawn-inside", "parted"]);
    assert!(told["becomes"] == "parted" && told["deepest"].as_f64().unwrap() > 5e-3 && parted == kept, "{told} {parted}");
    assert_eq!(inside(&["--allow-overlaps"]).1, kept);
}

/// A groom drawn deep into a ball: before the first step a line says so and names the flag that keeps the strands' shape. Not where it is given, and not for hair
/// that only its roots bring near the ball.
#[test]
fn hair_drawn_inside_a_head_is_warned_of() {
    let directory = directory("wisps_warned");
    let (head, groom) = (directory.join("ball.obj"), directory.join("groom.obj"));
    ball(&head, [0.0; 3], 0.1);
    // (Root, tip.) Three that stand on the ball, and two chords from its surface, 15 mm inside it at their deepest, and out again.
    let curves: [[[f64; 3]; 2]; 5] = [
        [[0.1, 0.0, 0.0], [0.3, 0.0, 0.0]],
        [[0.0, 0.1, 0.0], [0.0, 0.3, 0.0]],
        [[-0.1, 0.0, 0.0], [-0.3, 0.0, 0.0]],
        [[-0.0527, 0.085, 0.0], [0.15, 0.085, 0.0]],
        [[0.0, 0.085, -0.0527], [0.0, 0.085, 0.15]],
    ];
    let draw = |curves: &[[[f64; 3]; 2]]| {
        let mut text = String::new();
        for ([root, tip], count) in curves.iter().zip(0..) {
            for k in 0..=20 {
                let at = [0, 1, 2].map(|axis| root[axis] + (tip[axis] - root[axis]) * f64::from(k) / 20.0);
                text += &format!("v {} {} {}\n", at[0], at[1], at[2]);
            }
            let points: Vec<String> = (1..=21).map(|k| (21 * count + k).to_string()).collect();
            text += &format!("l {}\n", points.join(" "));
        }
        std::fs::write(&groom, text).unwrap();
    };
    let body = head.to_str().unwrap();
    let fixed = ["simulate", groom.to_str().unwrap(), "--scale", "1", "--body", body, "--duration", "0.1", "--json"];
    let run = |flags: &[&str]| {
        let output = superhelix(&[&fixed[..], flags].concat());
        let said = errors(&output);
        assert_eq!(output.status.code(), Some(0), "{said}");
        let warning = said.lines().find(|line| line.contains("strands are drawn")).map(str::to_owned);
        (warning, serde_json::from_slice::<Value>(&output.stdout).unwrap()["drawn_inside"].clone())
    };
    draw(&curves);
    for (flags, becomes, way) in [
        (&[][..], "brought-out", "; they are drawn again outside it, by up to "),
        (&["--hair-contact", "0.0005"], "brought-out", "; they are drawn again outside it, by up to "),
        (&["--drawn-inside", "parted"], "parted", "; contact pushes them out, and they lose their shape."),
    ] {
        let (warning, told) = run(flags);
        let warning = warning.unwrap();
        let start = format!("warning: {}: 2 of 5 strands are drawn up to 1", groom.display());
        assert!(warning.starts_with(&start) && warning.contains(&format!(" mm inside {body}{way}")), "{warning}");
        assert!(warning.ends_with(": --allow-overlaps (--drawn-inside kept)"), "{warning}");
        assert!(told["becomes"] == becomes && told["strands"] == 2, "{told}");
        assert!((told["deepest"].as_f64().unwrap() - 0.015).abs() < 1.5e-3, "{told}");
    }
    for flags in [&["--allow-overlaps"][..], &["--drawn-inside", "kept"]] {
        let (warning, told) = run(flags);
        assert_eq!(warning, None);
        assert!(told["becomes"] == "kept" && told["strands"] == 2 && told["left"] == 2, "{told}");
    }
    assert_eq!(run(&["--quiet"]).0, None);
    draw(&curves[..3]);
    assert_eq!(run(&[]).0, None);
    assert_eq!(run(&["--drawn-inside", "parted"]), (None, Value::Null));
}

/// A scene's strands are left to contact where it does not permit their overlaps: one line says so, and looking for them changes no bit.
#[test]
fn strands_of_a_scene_inside_colliders_are_warned_of() {
    let directory = directory("wisps_scene");
    // Below the floor by so much, along x; one above it.
    let scene = |depth: f64, contact: Value| {
        let strand = |z: f64| json!({"elements": 4, "length": 0.1, "root": {"origin": [0, 50.0 * z, z]}});
        let scene = with(small_scene(), "/strands", json!([strand(-depth), strand(0.01)]));
        with(with(scene, "/colliders", json!([{"shape": "halfspace"}])), "/contact", contact)
    };
    let warning = |scene: &Value| {
        let (output, result) = run_text(&directory, &scene.to_string());
        let warning = errors(&output).lines().find(|line| line.contains("strands are drawn")).map(str::to_owned);
        (warning, result.unwrap()["state_hash"].clone())
    };
    let (said, hash) = warning(&scene(0.01, json!({})));
    let said = said.unwrap();
    assert!(said.starts_with("warning: ") && said.contains("1 of 2 strands are drawn up to 10.1 mm inside colliders;"), "{said}");
    assert!(said.ends_with(": \"allow_overlaps\": true in \"contact\""), "{said}");
    let paths = ["scene.json", "quiet.json"].map(|name| directory.join(name).to_str().unwrap().to_owned());
    let output = superhelix(&["run", &paths[0], "--out", &paths[1], "--quiet"]);
    assert!(output.status.success() && errors(&output).is_empty());
    let quiet: Value = serde_json::from_str(&std::fs::read_to_string(&paths[1]).unwrap()).unwrap();
    assert_eq!(quiet["state_hash"], hash);
    assert_eq!(warning(&scene(0.01, json!({"allow_overlaps": true}))).0, None);
    // As deep as roots may be in the skin.
    assert_eq!(warning(&scene(0.001, json!({}))).0, None);
}

/// Curls that are drawn through each other are told of before a run, and what came of that after it; hair that lies in hair is not.
#[test]
fn strands_of_a_scene_drawn_through_each_other_are_warned_of() {
    let directory = directory("wisps_through_each_other");
    let scene = |apart: f64, curl: f64, allow: bool| {
        let strand = |k: u32| {
            let turn = if k.is_multiple_of(2) { 0.3 } else { -0.3 };
            json!({"elements": 6, "length": 0.1, "natural_curvatures": vec![[0.0, curl, turn * curl]; 6],
                "root": {"origin": [0, apart * f64::from(k), 0]}})
        };
        let scene = with(small_scene(), "/strands", (0..12).map(strand).collect());
        let scene = with(with(scene, "/duration", json!(0.05)), "/contact", json!({"allow_overlaps": allow}));
        with(scene, "/hair_contact", json!({"wisp_radius": 3e-3}))
    };
    let warnings = |scene: &Value| {
        let (output, result) = run_text(&directory, &scene.to_string());
        let lines = errors(&output);
        let about = |what: &str| lines.lines().find(|line| line.contains(what)).map(str::to_owned);
        (about("into others"), about("did not converge"), result.unwrap()["report"].clone())
    };
    let (drawn, left, report) = warnings(&scene(4e-3, 120.0, false));
    let (drawn, left) = (drawn.unwrap(), left.unwrap());
    assert!(
        drawn.contains("12 of 12 strands are drawn up to ") && drawn.ends_with(": \"allow_overlaps\": true in \"contact\""),
        "{drawn}"
    );
    let (unconverged, steps) = (report["unconverged"].as_u64().unwrap(), report["steps"].as_u64().unwrap());
    assert!(unconverged > 0 && report["unfinished"].as_u64().unwrap() <= unconverged, "{report}");
    assert!(left.contains(&format!("{unconverged} of {} strand steps did not converge", 12 * steps)), "{left}");
    // With less work more is left, and what was cut off is told apart.
    let (_, less, report) = warnings(&with(scene(4e-3, 120.0, false), "/max_work", json!(1000)));
    let unfinished = report["unfinished"].as_u64().unwrap();
    assert!(unfinished >= unconverged && less.unwrap().contains(&format!(", {unfinished} of them because")), "{report}");
    // Few iterations are a choice.
    let (_, chosen, report) = warnings(&with(scene(4e-3, 120.0, false), "/contact", json!({"max_iterations": 3})));
    assert!(chosen.is_none() && report["unconverged"].as_u64().unwrap() > 0, "{report}");
    for kept in [scene(4e-3, 120.0, true), scene(5e-3, 0.0, false)] {
        let (drawn, left, report) = warnings(&kept);
        assert_eq!((drawn, left), (None, None), "{report}");
    }
}

#[test]
fn bad_wisps_are_explained() {
    let groom = data("fibermesh_1k.tfx");
    for (flags, expected) in [
        (&["--hold", "1.5"][..], "--hold is 1.5; expected a number from 0 to 1"),
        (&["--hold", "-0.1"], "--hold is -0.1"),
        (&["--hairs", "0"], "--hairs is 0; expected a number from 1 to 1e6"),
        (&["--bare", "--hold", "0.5"], "cannot be used with"),
        (&["--drawn-inside", "gone"], "--drawn-inside"),
    ] {
        let output = superhelix(&[&["simulate", &groom, "--scale", "0.0012", "--duration", "0.1"], flags].concat());
        assert_eq!(output.status.code(), Some(1), "{flags:?}");
        assert!(errors(&output).contains(expected), "{flags:?}: {}", errors(&output));
    }
}

/// A ball in the head's place, by its latitudes and longitudes.
fn ball(path: &Path, centre: [f64; 3], radius: f64) {
    const ROWS: usize = 24;
    let angle = |k: usize| std::f64::consts::PI * k as f64 / ROWS as f64;
    let mut text = String::new();
    for (row, column) in (0..=ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| (row, column))) {
        let [x, y, z] = centre;
        let across = radius * angle(row).sin();
        let point = [x + across * angle(column).cos(), y + radius * angle(row).cos(), z + across * angle(column).sin()];
        text += &format!("v {} {} {}\n", point[0], point[1], point[2]);
    }
    for (row, column) in (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| (row, column))) {
        let number = |row: usize, column: usize| row * 2 * ROWS + column % (2 * ROWS) + 1;
        let [a, b, c, d] = [number(row, column), number(row, column + 1), number(row + 1, column), number(row + 1, column + 1)];
        // (At the poles one of the two has no area.)
        if row > 0 {
            text += &format!("f {a} {b} {c}\n");
        }
        if row < ROWS - 1 {
            text += &format!("f {b} {d} {c}\n");
        }
    }
    std::fs::write(path, text).unwrap();
}

/// Around a head limp hair whips no faster than without one, except for what bending around the head may add: a step must end
/// where forces lead (a chain folded another way is stationary as well).
#[test]
fn a_head_kicks_no_hair() {
    let directory = directory("wisps_kicks");
    let (motion, head) = (motion(&directory, "cmu_jumping_jacks_head.csv"), directory.join("ball.obj"));
    ball(&head, [0.3, 72.0, 28.0], 17.0);
    let groom = data("amd_ponytail_tail.tfx");
    for substeps in ["1", "2"] {
        let fixed = [&groom, "--scale", "0.0031", "--motion", &motion, "--bare", "--every", "2", "--elements", "6", "--substeps"];
        let fastest = |body: &[&str]| {
            let report = simulate(&[&fixed[..], &[substeps], body].concat());
            report["style"]["fastest_tip"].as_f64().unwrap()
        };
        let (free, held) = (fastest(&[]), fastest(&["--body", head.to_str().unwrap()]));
        println!("{substeps} substeps: {held:.2} m/s, free {free:.2}");
        assert!(held < 1.05 * free, "{held} {free}");
    }
}
