//! `superhelix prepare`: strands as reconstructions write them, with their defects, made ready; and the scene that comes of them run.

use std::path::{Path, PathBuf};

use serde_json::Value;

use superhelix::io::Curves;

use super::numpy::{self, npz};
use super::support::{difference, directory, errors, numbers, superhelix};

/// Radius of the head, m.
const HEAD: f32 = 0.09;
/// Points of a strand, and strands without defects.
const POINTS: usize = 100;
const SOUND: usize = 240;

type Strand = Vec<[f32; 3]>;

/// A ball of triangles, y up, and its file.
fn ball(path: &Path, radius: f32) {
    const RINGS: usize = 24;
    const AROUND: usize = 48;
    let mut text = String::new();
    for ring in 1..RINGS {
        let (sin, cos) = (std::f32::consts::PI * ring as f32 / RINGS as f32).sin_cos();
        for place in 0..AROUND {
            let (y, x) = (std::f32::consts::TAU * place as f32 / AROUND as f32).sin_cos();
            text += &format!("v {} {} {}\n", radius * sin * x, radius * cos, radius * sin * y);
        }
    }
    text += &format!("v 0 {radius} 0\nv 0 {} 0\n", -radius);
    let at = |ring: usize, place: usize| ring * AROUND + place % AROUND + 1;
    let [top, bottom] = [(RINGS - 1) * AROUND + 1, (RINGS - 1) * AROUND + 2];
    for place in 0..AROUND {
        text += &format!("f {top} {} {}\n", at(0, place + 1), at(0, place));
        text += &format!("f {bottom} {} {}\n", at(RINGS - 2, place), at(RINGS - 2, place + 1));
        for ring in 0..RINGS - 2 {
            let [a, b, c, d] = [at(ring, place), at(ring, place + 1), at(ring + 1, place + 1), at(ring + 1, place)];
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    std::fs::write(path, text).unwrap();
}

/// A strand of the upper half of the head, `index` of `SOUND`: it rises by a centimetre and falls along a meridian.
fn strand(index: usize) -> Strand {
    // Even over the cap: the golden angle.
    let height = 1.0 - 0.8 * (index as f32 + 0.5) / SOUND as f32;
    let (polar, turn) = (height.acos(), 2.399_963_2 * index as f32);
    let length = 0.11 + 0.01 * (index as f32).sin();
    let point = |k: usize| {
        let along = length * k as f32 / (POINTS - 1) as f32;
        let (sin, cos) = (polar + along / (HEAD + 0.01)).sin_cos();
        let out = HEAD + 0.01 * (1.0 - (-along / 0.02).exp());
        [out * sin * turn.cos(), out * cos, out * sin * turn.sin()]
    };
    (0..POINTS).map(point).collect()
}

fn straight(from: [f32; 3], to: [f32; 3]) -> Strand {
    let point = |k: usize| std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * k as f32 / (POINTS - 1) as f32);
    (0..POINTS).map(point).collect()
}

/// Sound strands, and after them eight with defects; the indices of these are `SOUND` and on.
fn groom() -> Vec<Strand> {
    let mut strands: Vec<Strand> = (0..SOUND).map(strand).collect();
    let mut broken = strand(3);
    broken[40] = [0.0, f32::NAN, 0.0];
    let mut near = strand(7);
    near.iter_mut().for_each(|point| point[0] += 3e-5);
    let mut turned = strand(20);
    turned.iter_mut().for_each(|point| *point = [point[0] * 1.003, point[1] * 1.003, point[2]]);
    turned.reverse();
    // Turned about the vertical, so that it is no twin: 5 mm off the scalp.
    let off =
        strand(11).iter().map(|[x, y, z]| [1.055 * (0.995 * x + 0.1 * z), 1.055 * y, 1.055 * (0.995 * z - 0.1 * x)]).collect();
    strands.extend([
        broken,
        vec![[0.0, HEAD, 0.0]; POINTS],
        strand(5),
        near,
        turned,
        off,
        straight([0.0, HEAD, 0.001], [0.0, -HEAD - 0.02, 0.0]),
        // In at one side of a chord that is 5 mm deep, and out at the other.
        straight([-0.029, 0.085, 0.0], [0.12, 0.085, 0.0]),
    ]);
    strands
}

const BROKEN: usize = SOUND;
const NOTHING: usize = SOUND + 1;
const TWIN: usize = SOUND + 2;
const NEAR: usize = SOUND + 3;
const TURNED: usize = SOUND + 4;
const OFF: usize = SOUND + 5;
const THROUGH: usize = SOUND + 6;
const CHORD: usize = SOUND + 7;

fn floats(strands: &[Strand]) -> Vec<u8> {
    strands.iter().flatten().flatten().flat_map(|number| number.to_le_bytes()).collect()
}

/// A `.ply` of points alone, with further properties after x, y and z, given as bytes for each strand.
fn ply(strands: &[Strand], properties: &str, further: impl Fn(usize) -> Vec<u8>) -> Vec<u8> {
    let count: usize = strands.iter().map(Vec::len).sum();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment made\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
         {properties}end_header\n"
    )
    .into_bytes();
    for (index, strand) in strands.iter().enumerate() {
        for point in strand {
            bytes.extend(point.iter().flat_map(|number| number.to_le_bytes()));
            bytes.extend(further(index));
        }
    }
    bytes
}

fn npy(strands: &[Strand], double: bool) -> Vec<u8> {
    let shape = format!("({}, {POINTS}, 3)", strands.len());
    if double {
        let numbers = strands.iter().flatten().flatten().flat_map(|number| f64::from(*number).to_le_bytes());
        return numpy::npy("<f8", &shape, &numbers.collect::<Vec<u8>>());
    }
    numpy::npy("<f4", &shape, &floats(strands))
}

fn data(strands: &[Strand]) -> Vec<u8> {
    let mut bytes = (strands.len() as u32).to_le_bytes().to_vec();
    for strand in strands {
        bytes.extend((strand.len() as u32).to_le_bytes());
        bytes.extend(floats(std::slice::from_ref(strand)));
    }
    bytes
}

fn hair(strands: &[Strand]) -> Vec<u8> {
    let points: usize = strands.iter().map(Vec::len).sum();
    let mut bytes = b"HAIR".to_vec();
    for number in [strands.len() as u32, points as u32, 3, 0] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.resize(128, 0);
    bytes.extend(strands.iter().flat_map(|strand| (strand.len() as u16 - 1).to_le_bytes()));
    bytes.extend(floats(strands));
    bytes
}

/// Polylines as one line for each edge.
fn edges(strands: &[Strand]) -> Vec<u8> {
    let mut text = String::new();
    for [x, y, z] in strands.iter().flatten() {
        text += &format!("v {x} {y} {z}\n");
    }
    let mut first = 1;
    for strand in strands {
        (first..first + strand.len() - 1).for_each(|k| text += &format!("l {k} {}\n", k + 1));
        first += strand.len();
    }
    text.into_bytes()
}

fn prepare(arguments: &[&str]) -> Value {
    let output = superhelix(&[&["prepare", "--json", "--quiet"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn refused(arguments: &[&str], words: &[&str]) {
    let output = superhelix(&[&["prepare", "--quiet"], arguments].concat());
    let text = errors(&output);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(words.iter().all(|word| text.contains(word)), "{text}");
}

fn write(directory: &Path, name: &str, bytes: &[u8]) -> String {
    let path = directory.join(name);
    std::fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

fn head_in(directory: &Path) -> String {
    let path = directory.join("head.obj");
    ball(&path, HEAD);
    path.to_str().unwrap().to_owned()
}

/// Index and reason of every strand that was dropped.
fn dropped(report: &Value) -> Vec<(usize, String)> {
    let one = |dropped: &Value| (dropped["strand"].as_u64().unwrap() as usize, dropped["reason"].as_str().unwrap().to_owned());
    report["strands"]["dropped"].as_array().unwrap().iter().map(one).collect()
}

#[test]
fn every_layout_gives_the_same_strands_and_every_defect_is_told() {
    let directory = directory("prepare_layouts");
    let head = head_in(&directory);
    let strands = groom();
    let finite: Vec<Strand> =
        strands.iter().enumerate().filter(|(k, _)| *k != BROKEN).map(|(_, strand)| strand.clone()).collect();
    let colour = |strand: usize| vec![(strand * 37 % 251) as u8, (strand % 13) as u8, 7, 255];
    let colours = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
    let normals = "property float nx\nproperty float ny\nproperty float nz\n";
    let further = vec![("scalp.npy", npy(&[strand(1)], false)), ("positions.npy", npy(&strands, false))];
    let layouts = [
        ("colours.ply", ply(&strands, colours, colour), "colours"),
        ("normals.ply", ply(&strands, normals, |_| vec![0; 12]), "jumps"),
        ("strands.npz", npz(&further), "file"),
        ("strands.npy", npy(&strands, true), "file"),
        ("strands.data", data(&strands), "file"),
        ("strands.hair", hair(&strands), "file"),
        ("edges.obj", edges(&finite), "joined lines"),
    ];
    for (name, bytes, by) in layouts {
        let path = write(&directory, name, &bytes);
        let report = prepare(&[&path, "--head", &head, "--guides", "30", "--dry-run"]);
        let complete = name != "edges.obj";
        // Without the strand that text cannot hold, all others have another index.
        let index = |strand: usize| if complete { strand } else { strand - 1 };
        assert_eq!(report["strands_by"], by, "{name}");
        assert_eq!(report["strands_in_file"], strands.len() - usize::from(!complete), "{name}");
        let mut expected = vec![
            (BROKEN, "not_finite"),
            (index(NOTHING), "too_short"),
            (index(TWIN), "duplicate"),
            (index(NEAR), "near_duplicate"),
            (index(THROUGH), "inside_head"),
        ];
        if !complete {
            expected.remove(0);
        }
        let expected: Vec<(usize, String)> = expected.into_iter().map(|(strand, why)| (strand, why.to_owned())).collect();
        assert_eq!(dropped(&report), expected, "{name}");
        assert_eq!(report["strands"]["turned"], serde_json::json!([index(TURNED)]), "{name}");
        assert_eq!(report["strands"]["kept"], SOUND + 3, "{name}");
        // The one that was 5 mm off moved farthest.
        let far = report["strands"]["roots"]["max"].as_f64().unwrap();
        assert!((far - 0.005).abs() < 5e-4, "{name}: {far}");
        // The chord was brought out: as deep as it is, or a little more, since the ball has corners.
        let inside = &report["strands"]["inside"];
        let deepest = inside["deepest"].as_f64().unwrap();
        assert!((deepest - 0.005).abs() < 1e-3, "{name}: {deepest}");
        assert_eq!(inside["left"], serde_json::json!([]), "{name}");
        assert_eq!(report["guides"]["strands"].as_array().unwrap().len(), 30, "{name}");
        assert!(report["files"].is_null());
    }
    assert!(OFF < CHORD && std::fs::read_dir(&directory).unwrap().count() == 8, "a dry run writes nothing");
}

#[test]
fn strands_of_a_single_point_are_told_and_stated_numbers_of_points_are_used() {
    let directory = directory("prepare_counts");
    let mut strands: Vec<Strand> = (0..60).map(strand).collect();
    strands.insert(2, vec![[0.0, HEAD, 0.0]]);
    strands.push(Vec::new());
    let path = write(&directory, "grown.data", &data(&strands));
    let report = prepare(&[&path, "--guides", "12", "--dry-run"]);
    assert_eq!(dropped(&report), [(2, "too_few_points".to_owned()), (61, "too_few_points".to_owned())]);
    // Segments, in text, and big-endian numbers beside points.
    strands.pop();
    let count: usize = strands.iter().map(Vec::len).sum();
    let mut text =
        format!("ply\nformat ascii 1.0\nelement vertex {count}\nproperty double x\nproperty double y\nproperty double z\n");
    text += &format!("element strand {}\nproperty ushort nsegs\nend_header\n", strands.len());
    strands.iter().flatten().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    strands.iter().for_each(|strand| text += &format!("{}\n", strand.len() - 1));
    let path = write(&directory, "segments.ply", text.as_bytes());
    let report = prepare(&[&path, "--guides", "12", "--dry-run"]);
    assert_eq!((report["strands_by"].as_str(), dropped(&report)), (Some("file"), vec![(2, "too_few_points".to_owned())]));
    // One strand's points do not tell; the caller can.
    let path = write(&directory, "one.ply", &ply(&[strand(0)], "", |_| Vec::new()));
    refused(&[&path, "--dry-run"], &["one.ply", "how many points each strand has"]);
    let report = prepare(&[&path, "--points-per-strand", "50", "--guides", "1", "--dry-run"]);
    assert_eq!((report["strands_in_file"].as_u64(), report["strands_by"].as_str()), (Some(2), Some("caller")));
    refused(&[&path, "--points-per-strand", "33", "--dry-run"], &["100 points", "33"]);
}

#[test]
fn a_file_that_begins_at_the_tips_is_turned_as_a_whole() {
    let directory = directory("prepare_turned");
    let head = head_in(&directory);
    let mut strands: Vec<Strand> = (0..80).map(strand).collect();
    // Longer ones would end on the head's lower half.
    strands.iter_mut().for_each(|strand| {
        let root = strand[0];
        *strand = straight(root, root.map(|number| 1.8 * number));
        strand.reverse();
    });
    let path = write(&directory, "turned.data", &data(&strands));
    let report = prepare(&[&path, "--head", &head, "--guides", "12", "--dry-run"]);
    assert_eq!(report["strands"]["turned"].as_array().unwrap().len(), 80);
    assert_eq!(report["strands"]["kept"], 80);
}

/// A walk of a second, as a table.
fn walk(directory: &Path) -> PathBuf {
    let mut text = String::from("time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n");
    for k in 0..=60 {
        let time = f64::from(k) / 60.0;
        let (sin, cos) = (0.1 * (6.0 * time).sin()).sin_cos();
        text += &format!("{time},0,{},{},{cos},0,{sin},0\n", 1.6 + 0.02 * (12.0 * time).sin(), 1.2 * time);
    }
    let path = directory.join("walk.csv");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn the_scene_runs_as_it_is_with_its_head_and_render_hair() {
    let directory = directory("prepare_scene");
    let head = head_in(&directory);
    let path = write(&directory, "strands.npz", &npz(&[("positions.npy", npy(&groom(), false))]));
    let out = directory.join("ready");
    let picture = directory.join("sheet.png");
    let walk = walk(&directory);
    let [out_text, walk_text, picture_text] = [&out, &walk, &picture].map(|path| path.to_str().unwrap());
    let arguments =
        [&path, "--head", &head, "--guides", "40", "--motion", walk_text, "--out", out_text, "--picture", picture_text];
    let report = prepare(&arguments);
    // The report is the one that lies beside the scene.
    let written: Value = serde_json::from_slice(&std::fs::read(out.join("report.json")).unwrap()).unwrap();
    assert_eq!(written, report);
    assert!(std::fs::read(&picture).unwrap().starts_with(b"\x89PNG"));
    // What was prepared rests as it was reconstructed: to a thousandth of the wisps' radius.
    let still = report["guides"]["still"]["max"].as_f64().unwrap();
    assert!(still < 1e-6, "{still}");
    let guides = &report["guides"];
    let random = guides["tried"].as_array().unwrap().iter().find(|tried| tried["way"] == "random").unwrap();
    assert!(guides["represented"]["rms"].as_f64().unwrap() <= random["rms"].as_f64().unwrap());
    assert_eq!(guides["apart"]["pairs_left"], 0);

    let result = directory.join("result.json");
    let scene = out.join("scene.json");
    let output = superhelix(&["run", scene.to_str().unwrap(), "--out", result.to_str().unwrap(), "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let result: Value = serde_json::from_slice(&std::fs::read(result).unwrap()).unwrap();
    assert_eq!(result["strands"].as_array().unwrap().len(), 40);
    assert_eq!((result["report"]["unconverged"].as_u64(), result["report"]["quarantined"].as_u64()), (Some(0), Some(0)));
    // Roots go with the head: as far from its middle at the end as at the start, which is the head's radius.
    let at = |strand: &Value, moment: usize| numbers(&strand["points"][moment][0]);
    let times = result["times"].as_array().unwrap().len();
    assert_eq!(times, 31);
    for strand in result["strands"].as_array().unwrap() {
        let (start, end) = (at(strand, 0), at(strand, times - 1));
        let radius = start.iter().map(|number| number * number).sum::<f64>().sqrt();
        assert!((radius - f64::from(HEAD)).abs() < 1e-3, "{radius}");
        // The walk goes 1.2 m along z.
        assert!((end[2] - start[2] - 1.2).abs() < 0.05, "{start:?} {end:?}");
    }
    // The first frame of the render hair is the strands as they were prepared, but for what the head keeps off and for their points being
    // others: two millimetres and half the bulge of an edge.
    let (made, prepared) =
        (Curves::read(out.join("render/render.0001.hair")).unwrap(), Curves::read(out.join("strands.hair")).unwrap());
    assert_eq!(made.strand_count(), prepared.strand_count());
    let tip = |curves: &Curves, strand: usize| curves.strand(strand).last().unwrap().map(f64::from);
    let apart = |strand| difference(&tip(&made, strand), &tip(&prepared, strand));
    let far = (0..made.strand_count()).map(apart).fold(0.0, f64::max);
    assert!(far < 2e-3, "{far}");
    let frames = std::fs::read_dir(out.join("render")).unwrap().count();
    assert_eq!(frames, times);
    // Nothing is replaced unless that is said.
    refused(&arguments, &["is there already", "--overwrite"]);
    assert_eq!(prepare(&[&arguments[..], &["--overwrite"]].concat())["guides"], report["guides"]);
}

#[test]
fn meshes_and_units_that_do_not_fit_are_named() {
    let directory = directory("prepare_refusals");
    let head = head_in(&directory);
    let strands: Vec<Strand> = (0..60).map(strand).collect();
    let path = write(&directory, "strands.data", &data(&strands));
    refused(
        &[&path, "--head", &head, "--head-scale", "0.01", "--dry-run"],
        &["head.obj", "does not carry these strands", "--head-scale"],
    );
    refused(&[&path, "--unit", "0.001", "--dry-run"], &["--scale", "1 mm"]);
    refused(&[&path, "--curliness", "0.3", "--dry-run"], &["--curliness"]);
    refused(&[&path], &["--out"]);
    let broken = write(&directory, "broken.npz", &npz(&[("texture.npy", npy(&strands, false)[..900].to_vec())]));
    refused(&[&broken, "--dry-run"], &["broken.npz"]);
    let mesh = write(
        &directory,
        "mesh.ply",
        b"ply\nformat ascii 1.0\nelement vertex 0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n",
    );
    refused(&[&mesh, "--dry-run"], &["mesh.ply", "faces"]);
}
