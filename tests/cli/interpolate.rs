//! `superhelix interpolate` and `superhelix place`.

use crate::support::{data, directory, errors, superhelix};
use serde_json::Value;
use superhelix::io::{CurveCache, Curves};

fn answer(arguments: &[&str]) -> Value {
    let output = superhelix(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn a_groom_is_filled_up_on_its_head() {
    let place = directory("interpolate");
    let out = place.join("render.hair").display().to_string();
    let (groom, bust) = (data("sintel_hair_001.tfx"), place.join("bust.obj").display().to_string());
    // The grid that it is baked into is kept beside it.
    std::fs::copy(data("sintel_bust.obj"), &bust).expect("a copy");
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
        "--body-cell",
        "0.008",
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
        // A centimetre, however coarse the mesh is.
        assert!(nearest < 1.001, "{nearest}");
    }
    assert_eq!(said["kept_out_of_body"].as_bool(), Some(true));
    let grids = std::fs::read_dir(&place).expect("a directory").map(|entry| entry.expect("an entry").path());
    let grid = grids.into_iter().find(|path| path.extension().is_some_and(|extension| extension == "shxgrid"));
    let grid = superhelix::io::distance_grid::read(grid.expect("a grid")).expect("a grid");
    let inside = |curves: &Curves| {
        let depths = curves.strands().flat_map(|strand| &strand[1..]).map(|point| {
            grid.closest(nalgebra::Vector3::from(point.map(f64::from)) * 0.01).map_or(0.0, |surface| -surface.distance)
        });
        let depths: Vec<f64> = depths.collect();
        depths.iter().filter(|depth| **depth > 1e-3).count() as f64 / depths.len() as f64
    };
    assert!(inside(&made) < 0.005, "{}", inside(&made));
    // Not kept out, and of a whole head: many lie in it, and some grow where no guide is near.
    let free: Vec<&str> =
        common.iter().copied().filter(|word| !["--scale", "--within", "0.01", "--body-cell", "0.008"].contains(word)).collect();
    let said = answer(&[&free[..], &["--scale", "0.01", "--no-body", "--whole-scalp"]].concat());
    assert_eq!(said["kept_out_of_body"].as_bool(), Some(false));
    let whole = Curves::read(&out).expect("a groom");
    assert!(inside(&whole) > 0.02, "{}", inside(&whole));
    let farthest = whole.strands().map(|strand| {
        let away = |root: &[f32; 3]| (0..3).map(|axis| (root[axis] - strand[0][axis]).powi(2)).sum::<f32>().sqrt();
        roots.iter().map(away).fold(f32::INFINITY, f32::min)
    });
    assert!(farthest.fold(0.0, f32::max) > 5.0);
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

/// Nine guides over a square of two units, bent along x, all moved by `place` at each of some frames.
fn write_guides(directory: &std::path::Path, frames: u32, place: &dyn Fn(u32, [f64; 3]) -> [f64; 3]) {
    std::fs::create_dir_all(directory).expect("a directory");
    for frame in 0..frames {
        let text: String = (0..9)
            .map(|guide| {
                let (x, z) = (f64::from(guide % 3) - 1.0, f64::from(guide / 3) - 1.0);
                let rows = [[x, 0.0, z], [x, 1.0, z], [x + 0.5, 3.0, z]].map(|point| place(frame, point));
                let first = 3 * guide + 1;
                let line = format!("l {first} {} {}\n", first + 1, first + 2);
                rows.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect::<String>() + &line
            })
            .collect();
        std::fs::write(directory.join(format!("hair.{:04}.obj", frame + 1)), text).expect("a frame");
    }
}

type Vectors = Vec<[f32; 3]>;

/// Every frame of a cache: its points and velocities.
fn frames_of(path: &str) -> Vec<(Vectors, Vectors)> {
    let cache = CurveCache::read(path).expect("a cache");
    let frame = |index: usize| {
        let curves = cache.frame(index).expect("a frame");
        (curves.points().to_vec(), curves.extras().velocities.clone().expect("velocities"))
    };
    (0..cache.times().len()).map(frame).collect()
}

#[test]
fn frames_come_with_velocities() {
    let place = directory("interpolate_velocities");
    let (cache, out) = (place.join("cache"), place.join("render.usda").display().to_string());
    // Along x as t^2, ten frames a second: the parabola through three frames is the motion itself.
    write_guides(&cache, 4, &|frame, [x, y, z]| [x + 100.0 * (0.1 * f64::from(frame)).powi(2), y, z]);
    let cache = cache.display().to_string();
    // Mixing alone: restoring the points' spacing would round once more.
    let plain = ["--curliness", "0", "--free-length", "--length-variation", "0", "--flyaways", "0"];
    let said = answer(
        &[&["interpolate", &cache, "--fps", "10", "--count", "40", "--points", "8", "--out", &out, "--json"][..], &plain]
            .concat(),
    );
    assert_eq!((said["frames"].as_u64(), said["velocities"].as_bool()), (Some(4), Some(true)));
    let frames = frames_of(&out);
    let file = CurveCache::read(&out).expect("a cache");
    assert!(file.times().iter().zip([0.0, 0.1, 0.2, 0.3]).all(|(time, expected)| (time - expected).abs() < 1e-15));
    // At the ends by the line to the frame beside; f32 at 10 units, differenced over a millisecond, leaves some 1e-3.
    for (index, expected) in [10.0, 20.0, 40.0, 50.0].into_iter().enumerate() {
        let (points, velocities) = &frames[index];
        assert_eq!(points.len(), 320);
        for ([x, y, z], (now, first)) in velocities.iter().zip(points.iter().zip(&frames[0].0)) {
            assert!((x - expected).abs() < 5e-3 && y.abs() < 5e-3 && z.abs() < 5e-3, "frame {index}: {x} {y} {z}");
            assert!((now[0] - first[0] - (index * index) as f32).abs() < 1e-5);
        }
    }
    // A file's own velocities are taken as they are, at its own times.
    let again = place.join("again.usda").display().to_string();
    let said = answer(
        &[&["interpolate", &out, "--count", "20", "--points", "8", "--scale", "1", "--out", &again, "--json"][..], &plain]
            .concat(),
    );
    assert_eq!((said["guides"].as_u64(), said["velocities"].as_bool()), (Some(40), Some(true)));
    for (index, (_, velocities)) in frames_of(&again).iter().enumerate() {
        let expected = [10.0, 20.0, 40.0, 50.0][index];
        assert!(velocities.iter().all(|[x, ..]| (x - expected).abs() < 1e-2), "{velocities:?}");
    }
    // Frames without times have none, and .hair has no place for them.
    let frames = place.join("frames").display().to_string();
    let said = answer(&["interpolate", &cache, "--count", "40", "--out", &frames, "--json"]);
    assert_eq!(said["velocities"].as_bool(), Some(false));
}

#[test]
fn roots_stay_on_a_scalp_that_deforms() {
    let place = directory("interpolate_scalp");
    // Stretched along x and tilted, evenly from frame to frame.
    let moved = |frame: u32, [x, y, z]: [f64; 3]| {
        let f = f64::from(frame);
        [x * (1.0 + 0.1 * f), y + 0.2 * f * x, z - 0.3 * f]
    };
    let (cache, scalp, out) = (place.join("cache"), place.join("scalp"), place.join("render.usda").display().to_string());
    write_guides(&cache, 3, &moved);
    let mesh = |directory: &std::path::Path, frames: u32, faces: &str| {
        std::fs::create_dir_all(directory).expect("a directory");
        for frame in 0..frames {
            let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]].map(|at| moved(frame, at));
            let text: String = corners.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
            let faces = if frame == 2 { faces } else { "f 1 2 3 4\n" };
            std::fs::write(directory.join(format!("head.{frame:04}.obj")), text + faces).expect("a mesh");
        }
        directory.display().to_string()
    };
    let scalp = mesh(&scalp, 3, "f 1 2 3 4\n");
    let cache = cache.display().to_string();
    let fixed =
        ["interpolate", &cache, "--fps", "2", "--count", "50", "--points", "6", "--within", "9", "--no-body", "--out", &out];
    answer(&[&fixed[..], &["--scalp", &scalp, "--json"]].concat());
    let frames = frames_of(&out);
    let expected = |frame: u32, root: [f32; 3]| moved(frame, root.map(f64::from));
    for (index, (points, velocities)) in frames.iter().enumerate() {
        for (strand, first) in points.chunks(6).zip(frames[0].0.chunks(6)) {
            let root = expected(index as u32, first[0]);
            assert!((0..3).all(|axis| (f64::from(strand[0][axis]) - root[axis]).abs() < 1e-5), "{:?} {root:?}", strand[0]);
        }
        // Half a second a frame, the same every frame.
        for (velocity, first) in velocities.chunks(6).zip(frames[0].0.chunks(6)) {
            let (a, b) = (expected(0, first[0]), expected(1, first[0]));
            let off = |axis: usize| (f64::from(velocity[0][axis]) - 2.0 * (b[axis] - a[axis])).abs();
            assert!((0..3).all(|axis| off(axis) < 2e-3), "frame {index}: {:?} {a:?} {b:?}", velocity[0]);
        }
    }
    // The same scalp as one file with time samples, at the guides' times; in its own unit; or a sample a frame where there are no times.
    let usda = |name: &str, unit: f64, up: char, codes: [f64; 3]| {
        let points = |frame: u32| {
            let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]].map(|at| moved(frame, at));
            corners.map(|at| format!("({}, {}, {})", at[0] / unit, at[1] / unit, at[2] / unit)).join(", ")
        };
        let samples: String = (0..3).map(|frame| format!("{}: [{}],\n", codes[frame as usize], points(frame))).collect();
        let text = format!(
            "#usda 1.0\n(\n metersPerUnit = {unit}\n upAxis = \"{up}\"\n timeCodesPerSecond = 10\n)\ndef Mesh \"head\"\n{{\n\
             int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, 2, 3]\npoint3f[] points.timeSamples = {{\n{samples}}}\n}}\n"
        );
        let path = place.join(name);
        std::fs::write(&path, text).expect("a mesh");
        path.display().to_string()
    };
    let head = usda("head.usda", 1.0, 'Y', [0.0, 5.0, 10.0]);
    for scalp in [&head, &usda("centimetres.usda", 0.01, 'Y', [0.0, 5.0, 10.0])] {
        answer(&[&fixed[..], &["--scalp", scalp, "--json"]].concat());
        for ((points, velocities), (others, theirs)) in frames.iter().zip(frames_of(&out)) {
            let near = |a: &Vectors, b: &Vectors, most: f32| {
                a.iter().zip(b).all(|(a, b)| (0..3).all(|axis| (a[axis] - b[axis]).abs() < most))
            };
            assert!(near(points, &others, 1e-5) && near(velocities, &theirs, 1e-2), "{scalp}");
        }
    }
    let untimed = place.join("untimed").display().to_string();
    answer(&[
        "interpolate",
        &cache,
        "--count",
        "50",
        "--points",
        "6",
        "--within",
        "9",
        "--no-body",
        "--scalp",
        &head,
        "--out",
        &untimed,
        "--json",
    ]);
    let last = Curves::read(format!("{untimed}/render.0003.hair")).expect("a frame");
    assert!(last.points().iter().zip(&frames[2].0).all(|(a, b)| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-5)));
    // One mesh stands still: roots then go with the guides, which are no rigid motion here.
    let one = format!("{scalp}/head.0000.obj");
    answer(&[&fixed[..], &["--scalp", &one, "--json"]].concat());
    // What does not go together is said.
    let few = mesh(&place.join("few"), 2, "");
    let other = mesh(&place.join("other"), 3, "f 1 2 3\nf 1 3 4\nf 4 3 2 1\n");
    let hair = place.join("render.hair").display().to_string();
    let (short, lying) = (usda("short.usda", 1.0, 'Y', [0.0, 5.0, 9.0]), usda("lying.usda", 1.0, 'Z', [0.0, 5.0, 10.0]));
    let single = format!("{cache}/hair.0001.obj");
    for (arguments, text) in [
        ([&fixed[..], &["--scalp", &few]].concat(), "has 2 meshes; expected one, or one for each of the guides' 3 frames"),
        ([&fixed[..], &["--scalp", &other]].concat(), "head.0002.obj: has other faces than"),
        (
            [&fixed[..], &["--scalp", &short]].concat(),
            "short.usda: has samples from 0 to 0.9 s, and the guides have a frame at 1 s",
        ),
        (
            vec!["interpolate", &out, "--no-body", "--scalp", &lying, "--out", &hair],
            "lying.usda: has z up, and the guides have y",
        ),
        (vec!["interpolate", &single, "--scalp", &short, "--out", &hair], "has 3 samples; expected one, or one for each"),
        (vec!["interpolate", &cache, "--out", &out], "give --fps"),
        (vec!["interpolate", &out, "--fps", "3", "--out", &out], "leave --fps out"),
        (vec!["interpolate", &cache, "--out", &hair], "render.hair: holds one frame, and there are 3"),
    ] {
        let output = superhelix(&arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(text), "{arguments:?}: {}", errors(&output));
    }
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

/// A square of 20 cm in the plane y = 0, facing up, in a mesh of centimetres, with texture coordinates from 0 to 1 along x and −z.
fn sheet(path: &std::path::Path) {
    let mut text = String::new();
    for k in 0..121 {
        let (x, z) = (2 * (k % 11) - 10, 10 - 2 * (k / 11));
        text += &format!("v {x} 0 {z}\nvt {} {}\n", f64::from(k % 11) / 10.0, f64::from(k / 11) / 10.0);
    }
    for k in (0..110).filter(|k| k % 11 < 10) {
        let [a, b, c, d] = [k + 1, k + 2, k + 13, k + 12];
        text += &format!("f {a}/{a} {b}/{b} {c}/{c} {d}/{d}\n");
    }
    std::fs::write(path, text).expect("a mesh");
}

/// A picture whose upper left quarter is white, the lower right one transparent, the others black.
fn checks(path: &std::path::Path) {
    let mut picture = tiny_skia::Pixmap::new(64, 64).expect("a picture");
    for (k, pixel) in picture.pixels_mut().iter_mut().enumerate() {
        let (right, low) = (k % 64 >= 32, k / 64 >= 32);
        let shade = if !right && !low { 255 } else { 0 };
        let opacity = if right && low { 0 } else { 255 };
        *pixel = tiny_skia::PremultipliedColorU8::from_rgba(shade, shade, shade, opacity).expect("a colour");
    }
    picture.save_png(path).expect("a file");
}

fn rows(path: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).expect("a table");
    text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().expect("a number")).collect()).collect()
}

#[test]
fn texture_coordinates_place_follicles_and_pictures_say_how_densely() {
    let place = directory("place_uv");
    let (mesh, picture, uvs) = (place.join("sheet.obj"), place.join("checks.png"), place.join("uvs.txt"));
    sheet(&mesh);
    checks(&picture);
    let (mesh, picture, out) =
        (mesh.display().to_string(), picture.display().to_string(), place.join("out.csv").display().to_string());
    std::fs::write(&uvs, "0.25, 0.5\n0.9 0.1\n").expect("a file");
    let uvs = uvs.display().to_string();
    let fixed = ["place", &mesh, "--scale", "0.01", "--out", &out, "--json"];
    answer(&[&fixed[..], &["--uvs", &uvs]].concat());
    let found = rows(&out);
    assert_eq!(found.len(), 2);
    for (row, [x, z]) in found.iter().zip([[-0.05, 0.0], [0.08, 0.08]]) {
        assert!((row[3] - x).abs() < 1e-12 && row[4].abs() < 1e-12 && (row[5] - z).abs() < 1e-12, "{row:?}");
        // n0 up, n1 along u, which is x: a quarter turn about z takes x to y; y to -x; half a turn about the normal more brings n1 to x.
        let [qx, qy, qz, qw] = [row[6], row[7], row[8], row[9]];
        let turn = |v: [f64; 3]| {
            let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(qw, qx, qy, qz));
            q * nalgebra::Vector3::from(v)
        };
        assert!((turn([1.0, 0.0, 0.0]) - nalgebra::Vector3::y()).norm() < 1e-9, "{row:?}");
        assert!((turn([0.0, 1.0, 0.0]) - nalgebra::Vector3::x()).norm() < 1e-9, "{row:?}");
    }
    // Jitter moves them a little, by the seed.
    answer(&[&fixed[..], &["--uvs", &uvs, "--jitter", "0.02", "--seed", "4"]].concat());
    for (row, still) in rows(&out).iter().zip(&found) {
        let away = ((row[3] - still[3]).abs(), (row[5] - still[5]).abs());
        assert!(away.0 <= 0.004 + 1e-12 && away.1 <= 0.004 + 1e-12 && away != (0.0, 0.0), "{away:?}");
    }
    // White is the upper left quarter: u below, v above a half. Bare half a pixel (1.6 mm) beyond the border.
    answer(&[&fixed[..], &["--count", "300", "--density-picture", &picture]].concat());
    let white = rows(&out);
    // Pictures repeat: half a pixel at the opposite borders sees white too.
    let in_white = |at: f64| !(0.004..=0.098).contains(&at);
    assert!(white.len() == 300 && white.iter().all(|row| in_white(row[3]) && in_white(row[5])), "{white:?}");
    assert!(white.iter().filter(|row| row[3] < 0.0 && row[5] < 0.0).count() > 270);
    // With what is near a groom's roots: both count.
    let groom = place.join("guides.obj");
    std::fs::write(&groom, "v -6 0 -6\nv -6 4 -6\nl 1 2\nv 6 0 6\nv 6 4 6\nl 3 4\n").expect("a groom");
    let groom = groom.display().to_string();
    answer(&[&fixed[..], &["--count", "60", "--density-picture", &picture, "--near", &groom, "--within", "0.02"]].concat());
    for row in rows(&out) {
        let away = (row[3] + 0.06).hypot(row[5] + 0.06);
        assert!(away < 0.06 && row[3] < 0.004 && row[5] < 0.004, "{row:?}");
    }
    // Render hair grows where the map says, however few the guides; without a map near them.
    let hair = place.join("render.hair").display().to_string();
    let grow = |more: &[&str]| {
        let fixed =
            ["interpolate", &groom, "--scale", "0.01", "--no-body", "--scalp", &mesh, "--count", "200", "--out", &hair, "--json"];
        answer(&[&fixed[..], more].concat());
        let curves = Curves::read(&hair).expect("a groom");
        curves.strands().map(|strand| strand[0]).collect::<Vec<_>>()
    };
    let everywhere = grow(&["--density-picture", &picture]);
    let in_white = |at: f32| in_white(0.01 * f64::from(at));
    assert!(everywhere.iter().all(|root| root[1].abs() < 1e-5 && in_white(root[0]) && in_white(root[2])));
    assert!(everywhere.iter().any(|root| root[0] < -9.0) && everywhere.iter().any(|root| root[0] > -1.0));
    let near = grow(&["--within", "0.01"]);
    assert!(near.iter().all(|root| (root[0].abs() - 6.0).hypot(root[2].abs() - 6.0) < 4.5), "{near:?}");
    // A .usda file takes the widths too, and says the unit.
    let usda = place.join("render.usda").display().to_string();
    answer(&["interpolate", &groom, "--scale", "0.01", "--count", "20", "--out", &usda, "--json"]);
    let made = Curves::read(&usda).expect("a groom");
    let widths = made.extras().thickness.as_ref().expect("widths");
    assert!(made.strand_count() == 20 && made.extras().metres_per_unit == Some(0.01) && (0.007..0.009).contains(&widths[0]));
    // Which is taken when it comes back.
    let said =
        answer(&["interpolate", &usda, "--count", "20", "--radius", "1e-4", "--radius-variation", "0", "--out", &hair, "--json"]);
    assert_eq!(said["guides"].as_u64(), Some(20));
    let widths = Curves::read(&hair).expect("a groom").extras().thickness.clone().expect("widths");
    assert!((widths[0] - 0.02).abs() < 1e-6, "{}", widths[0]);
    // Strands cut short by the seed are shorter.
    let length = |path: &str| {
        let curves = Curves::read(path).expect("a groom");
        let of = |strand: &[[f32; 3]]| {
            strand.windows(2).map(|e| (0..3).map(|k| (e[1][k] - e[0][k]).powi(2)).sum::<f32>().sqrt()).sum()
        };
        curves.strands().map(of).collect::<Vec<f32>>()
    };
    grow(&["--within", "0.01", "--length-variation", "0.5"]);
    let cut = length(&hair);
    assert!(cut.iter().all(|length| (1.99..4.01).contains(length)), "{cut:?}");
    assert!(cut.iter().any(|length| *length < 2.3) && cut.iter().any(|length| *length > 3.7));
}

#[test]
fn errors_are_reported() {
    let place = directory("interpolate_errors");
    let out = place.join("out.hair").display().to_string();
    let (groom, bust) = (data("sintel_hair_001.tfx"), data("sintel_bust.obj"));
    let density = place.join("density.txt");
    std::fs::write(&density, "1 2 three").expect("a file");
    let density = density.display().to_string();
    let uvs = place.join("uvs.txt");
    std::fs::write(&uvs, "0.5 0.5 0.5").expect("a file");
    let uvs = uvs.display().to_string();
    let mesh = place.join("sheet.obj");
    sheet(&mesh);
    let mesh = mesh.display().to_string();
    let cases: [(&[&str], &str); 17] = [
        (&["interpolate", &groom, "--out", &out, "--curliness", "2"], "0 to 1"),
        (&["interpolate", &groom, "--out", &out, "--wisp-profile", "1,2"], "three numbers"),
        (&["interpolate", &groom, "--out", &out, "--frizz-waves", "5000"], "--frizz-waves"),
        (&["interpolate", "no/such.tfx", "--out", &out], "no/such.tfx"),
        (&["interpolate", &groom, "--out", &out, "--scalp", &groom], "sintel_hair_001.tfx"),
        (&["place", &bust, "--out", &out], "--count"),
        (&["place", &bust, "--out", &out, "--count", "5", "--density", &density], "density.txt"),
        (&["place", &bust, "--out", &out, "--spacing", "1e-9"], "--spacing"),
        (
            &["interpolate", &groom, "--out", &out, "--length-variation", "1"],
            "--length-variation is 1; expected 0 to less than 1",
        ),
        (&["interpolate", &groom, "--out", &out, "--density", &density], "give --scalp"),
        (&["place", &bust, "--out", &out, "--count", "5", "--within", "0.01"], "--near"),
        (&["place", &bust, "--out", &out, "--count", "5", "--jitter", "0.01"], "--uvs"),
        (&["place", &bust, "--out", &out, "--count", "5", "--uvs", &uvs], "--uvs"),
        (&["place", &bust, "--out", &out, "--uvs", &uvs], "sintel_bust.obj: --uvs needs texture coordinates"),
        (&["place", &bust, "--out", &out, "--count", "5", "--density-picture", &uvs], "sintel_bust.obj: --density-picture needs"),
        (&["place", &mesh, "--out", &out, "--uvs", &uvs], "uvs.txt: 3 numbers"),
        (&["place", &mesh, "--out", &out, "--count", "5", "--density-picture", &uvs], "uvs.txt: cannot be read as a picture"),
    ];
    for (arguments, text) in cases {
        let output = superhelix(arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(text), "{arguments:?}: {}", errors(&output));
        assert!(!std::path::Path::new(&out).exists());
    }
}
