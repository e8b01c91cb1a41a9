//! `superhelix interpolate` and `superhelix place`.
#![cfg(feature = "cli")]

mod cli_support;

use cli_support::{data, directory, errors, superhelix};
use serde_json::Value;
use superhelix::files::curves::Curves;

fn answer(arguments: &[&str]) -> Value {
    let output = superhelix(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn a_groom_is_filled_up_on_its_head() {
    let place = directory("interpolate");
    let out = place.join("render.hair").display().to_string();
    let (groom, bust) = (data("sintel_hair_001.tfx"), data("sintel_bust.obj"));
    let common = [
        "interpolate",
        &groom,
        "--scale",
        "0.01",
        "--scalp",
        &bust,
        "--count",
        "800",
        "--within",
        "0.01",
        "--json",
        "--out",
        &out,
    ];
    let said =
        answer(&[&common[..], &["--curliness", "0.5", "--points", "12", "--radius", "5e-5", "--tip-radius", "2e-5"]].concat());
    assert_eq!((said["guides"].as_u64(), said["strands"].as_u64()), (Some(228), Some(800)));
    let made = Curves::read(&out).expect("a groom");
    assert_eq!((made.strand_count(), made.point_count()), (800, 9600));
    // Roots lie near the guides' in the groom's own units, tips hang as low as the guides do, widths taper.
    let guides = Curves::read(&groom).expect("a groom");
    let roots: Vec<[f32; 3]> = guides.strands().map(|strand| strand[0]).collect();
    let lowest = |curves: &Curves| curves.points().iter().map(|point| point[1]).fold(f32::INFINITY, f32::min);
    assert!((lowest(&made) - lowest(&guides)).abs() < 3.0, "{} {}", lowest(&made), lowest(&guides));
    for strand in made.strands() {
        let away = |root: &[f32; 3]| (0..3).map(|axis| (root[axis] - strand[0][axis]).powi(2)).sum::<f32>().sqrt();
        let nearest = roots.iter().map(away).fold(f32::INFINITY, f32::min);
        // Within a centimetre, thinning out to two; a triangle's size more, where the mesh is coarse.
        assert!(nearest < 3.5, "{nearest}");
    }
    let widths = made.extras().thickness.clone().expect("widths");
    // 0.1 mm and 0.04 mm in units of a centimetre, give or take a tenth.
    assert!((0.009..0.0111).contains(&widths[0]) && (0.0036..0.0044).contains(&widths[11]), "{} {}", widths[0], widths[11]);

    // The same seed the same bytes, on any number of threads; another seed others.
    let bytes = |more: &[&str]| {
        answer(&[&common[..], more].concat());
        std::fs::read(&out).expect("a file")
    };
    let one = bytes(&["--space", "curvature"]);
    assert!(bytes(&["--space", "curvature", "--threads", "2"]) == one);
    assert!(bytes(&["--space", "curvature", "--seed", "1"]) != one);
    assert!(bytes(&[]) != one);
}

#[test]
fn a_cache_is_filled_up_frame_by_frame() {
    let place = directory("interpolate_cache");
    let (cache, out) = (place.join("cache"), place.join("render").display().to_string());
    std::fs::create_dir_all(&cache).expect("a directory");
    // Guides that are shifted along x from frame to frame: so are the strands.
    for frame in 0..3 {
        let text: String = (0..9)
            .map(|guide| {
                let (x, z) = (f64::from(guide % 3) + 5.0 * f64::from(frame), f64::from(guide / 3));
                let first = 3 * guide + 1;
                format!("v {x} 0 {z}\nv {x} 1 {z}\nv {} 3 {z}\nl {first} {} {}\n", x + 0.5, first + 1, first + 2)
            })
            .collect();
        std::fs::write(cache.join(format!("hair.{:04}.obj", frame + 1)), text).expect("a frame");
    }
    let cache = cache.display().to_string();
    let arguments = ["interpolate", &cache, "--count", "60", "--points", "8", "--out", &out, "--json"];
    let said = answer(&arguments);
    assert_eq!((said["frames"].as_u64(), said["guides"].as_u64()), (Some(3), Some(9)));
    let read = |frame: u32| Curves::read(format!("{out}/render.{frame:04}.hair")).expect("a frame");
    let (first, last) = (read(1), read(3));
    for (a, b) in first.points().iter().zip(last.points()) {
        assert!((b[0] - a[0] - 10.0).abs() < 1e-5 && (b[1] - a[1]).abs() < 1e-5 && (b[2] - a[2]).abs() < 1e-5, "{a:?} {b:?}");
    }
    // Frames that are there are not mixed with others unless one says so.
    let again = superhelix(&arguments);
    assert_eq!(again.status.code(), Some(1));
    assert!(errors(&again).contains("is there already"), "{}", errors(&again));
    answer(&[&arguments[..], &["--overwrite"]].concat());
}

#[test]
fn follicles_are_placed() {
    let place = directory("place");
    let out = place.join("follicles.csv").display().to_string();
    let (bust, groom) = (data("sintel_bust.obj"), data("sintel_hair_001.tfx"));
    let said = answer(&[
        "place", &bust, "--scale", "0.01", "--count", "500", "--near", &groom, "--within", "0.02", "--out", &out, "--json",
    ]);
    assert_eq!(said["follicles"].as_u64(), Some(500));
    assert!(said["least_distance"].as_f64().expect("a distance") > 1e-3);
    let text = std::fs::read_to_string(&out).expect("a table");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("triangle,share_b,share_c,x_m,y_m,z_m,qx,qy,qz,qw"));
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|word| word.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 500);
    for row in &rows {
        assert!((row[6..].iter().map(|value| value * value).sum::<f64>() - 1.0).abs() < 1e-9);
    }
    let said = answer(&["place", &bust, "--scale", "0.01", "--spacing", "0.01", "--out", &out, "--json"]);
    assert!(said["least_distance"].as_f64().expect("a distance") >= 0.01);
}

#[test]
fn what_is_wrong_is_said() {
    let place = directory("interpolate_errors");
    let out = place.join("out.hair").display().to_string();
    let (groom, bust) = (data("sintel_hair_001.tfx"), data("sintel_bust.obj"));
    let density = place.join("density.txt");
    std::fs::write(&density, "1 2 three").expect("a file");
    let density = density.display().to_string();
    let cases: [(&[&str], &str); 8] = [
        (&["interpolate", &groom, "--out", &out, "--curliness", "2"], "0 to 1"),
        (&["interpolate", &groom, "--out", &out, "--wisp-profile", "1,2"], "three numbers"),
        (&["interpolate", &groom, "--out", &out, "--frizz-waves", "5000"], "--frizz-waves"),
        (&["interpolate", "no/such.tfx", "--out", &out], "no/such.tfx"),
        (&["interpolate", &groom, "--out", &out, "--scalp", &groom], "sintel_hair_001.tfx"),
        (&["place", &bust, "--out", &out], "--count"),
        (&["place", &bust, "--out", &out, "--count", "5", "--density", &density], "density.txt"),
        (&["place", &bust, "--out", &out, "--spacing", "1e-9"], "--spacing"),
    ];
    for (arguments, text) in cases {
        let output = superhelix(arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(text), "{arguments:?}: {}", errors(&output));
        assert!(!std::path::Path::new(&out).exists());
    }
}
