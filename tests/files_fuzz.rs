//! Mutilated files: whatever the bytes, a reader returns a sound result or an error, and allocates no more memory than a few
//! times the file's size.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use peak_alloc::PeakAlloc;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use superhelix::io::{
    CurveCache, Curves, Extras, MeshCache, Motion, MotionOptions, RecordedCurve, TfxVersion, distance_grid, hair, obj, obj_mesh,
    tfx, usda,
};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// One test, because memory is counted for the whole process: tests beside it would be counted in.
#[test]
fn readers_survive_anything_and_ask_for_little() {
    whole_files_are_read_within_the_memory_limit();
    no_number_in_a_head_makes_a_reader_ask_for_much();
    small_prims_take_little();
    mutilated_files_are_survived();
    noise_is_survived();
}

/// The most memory that was in use during a call beyond what was before, bytes.
fn peak<T>(call: impl FnOnce() -> T) -> (T, usize) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let result = call();
    (result, MEMORY.peak_usage().saturating_sub(before))
}

fn data(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The first lines of a text file.
fn lines(name: &str, count: usize) -> Vec<u8> {
    let bytes = data(name);
    let end = bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n').nth(count - 1).unwrap().0 + 1;
    bytes[..end].to_vec()
}

/// Small files with the heads of real ones: the name to read each under, and its bytes.
fn seeds() -> &'static [(&'static str, Vec<u8>)] {
    static SEEDS: OnceLock<Vec<(&'static str, Vec<u8>)>> = OnceLock::new();
    SEEDS.get_or_init(make_seeds)
}

fn make_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let word = |bytes: &mut Vec<u8>, at: usize, number: u32| bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
    let mut wavy = data("blender_wavy.hair")[..128 + 4 * 32 * 12].to_vec();
    word(&mut wavy, 4, 4);
    word(&mut wavy, 8, 4 * 32);
    let curly = Curves::read_from_bytes("curly.hair", &data("blender_curly.hair")).unwrap();
    let few = Curves::from_strands(&curly.strands().take(5).collect::<Vec<_>>()).unwrap();
    let mut tail = data("amd_ponytail_back.tfx")[..296 + 6 * 16 * 12].to_vec();
    word(&mut tail, 4, 6);
    let mut sintel = data("sintel_hair_001.tfx")[..160 + 3 * 32 * 16].to_vec();
    word(&mut sintel, 4, 3);
    let text = String::from_utf8(lines("fibermesh_1k.tfx", 10 + 6 * 7)).unwrap().replace("numStrands 1000", "numStrands 6");
    let capture = String::from_utf8(lines("walk_figure8_first240.bvh", 147 + 6)).unwrap().replace("Frames: 240", "Frames: 6");
    let recorded =
        std::fs::read_to_string(format!("{}/tests/data/friction/pendulum_05.csv", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let recorded: Vec<&str> = recorded.lines().take(40).collect();
    vec![
        ("wavy.hair", wavy),
        ("curly.hair", hair::write_to_bytes("curly.hair", &few).unwrap()),
        ("tail.tfx", tail),
        ("sintel.tfx", sintel),
        ("text.tfx", text.into_bytes()),
        ("curly.obj", obj::write_to_bytes(&few)),
        ("few.data", strand_data(&few)),
        ("table.csv", lines("walk_figure8_head.csv", 40)),
        ("walk.bvh", capture.into_bytes()),
        ("pendulum.curve", recorded.join("\n").into_bytes()),
        ("bust.mesh", bust()),
        ("strip.mesh", strip()),
        ("written.tfx", tfx::write_to_bytes("written.tfx", &even(), TfxVersion::V3).unwrap()),
        ("placed.usda", std::fs::read(format!("{}/tests/data/usd/placed.usda", env!("CARGO_MANIFEST_DIR"))).unwrap()),
        ("groom.usda", groom()),
        ("written.usda", usda::write_to_bytes(&even())),
        ("head.usdmesh", usd_mesh()),
        ("ball.shxgrid", ball()),
    ]
}

/// Strands as a `.data` file has them.
fn strand_data(curves: &Curves) -> Vec<u8> {
    let mut bytes = (curves.strand_count() as u32).to_le_bytes().to_vec();
    for strand in curves.strands() {
        bytes.extend((strand.len() as u32).to_le_bytes());
        bytes.extend(strand.iter().flatten().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}

/// Strands of as many points, with all that can go along.
fn even() -> Curves {
    let numbers = |count: usize| (0..count).map(|index| 0.1 * index as f32).collect::<Vec<f32>>();
    let points: Vec<[f32; 3]> = numbers(12).iter().map(|x| [*x, 1.0, -x]).collect();
    let extras = Extras {
        thickness: Some(numbers(12)),
        transparency: Some(numbers(12)),
        colors: Some(points.clone()),
        velocities: Some(points.clone()),
        held: Some(vec![true; 12]),
        strand_thickness: Some(numbers(3)),
        strand_uvs: Some(vec![[0.1, 0.2]; 3]),
        ..Extras::default()
    };
    Curves::from_counts(vec![4; 3], points).unwrap().with_extras(extras).unwrap()
}

/// The cubic curves of a real file, cut down to three, with its widths and primvars.
fn groom() -> Vec<u8> {
    let text =
        std::fs::read_to_string(format!("{}/tests/data/usd/arnold_groom_sphere.usda", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let first = |line: &str, count: usize| -> String {
        let (head, list) = line.split_once("= [").unwrap();
        let items: Vec<&str> = if list.starts_with('(') { list.split("), ").collect() } else { list.split(", ").collect() };
        let join = if list.starts_with('(') { "), " } else { ", " };
        format!("{head}= [{}{}]", items[..count].join(join), if list.starts_with('(') { ")" } else { "" })
    };
    let line = |name: &str, count: usize| {
        first(text.lines().find(|line| line.trim_start().starts_with(name)).unwrap(), count).replace("        ", "    ")
    };
    let [counts, points, widths] =
        [("int[] curveVertexCounts", 3), ("point3f[] points", 39), ("float[] widths", 39)].map(|(name, count)| line(name, count));
    let head = "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\ndef BasisCurves \"groom_sphere\" (\n    apiSchemas = []\n)\n{\n";
    let basis = "    uniform token basis = \"bspline\"\n";
    let color = "    color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]\n    int[] primvars:displayColor:indices = [0]\n";
    format!("{head}{basis}{counts}\n{points}\n{widths} (\n        interpolation = \"vertex\"\n    )\n{color}}}\n").into_bytes()
}

/// Some vertices of a head, with triangles of all notations and a polygon that is not convex.
fn bust() -> Vec<u8> {
    let text = String::from_utf8(data("sintel_bust.obj")).unwrap();
    let vertices: Vec<&str> = text.lines().filter(|line| line.starts_with('v')).take(40).collect();
    let faces = "f 1 2 3\nf 4/1 5/2 6/3\nf -1//1 -3//2 -5//3\nf 8/1/1 11/1/1 9/1/1\n";
    let polygon = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.3 0\nv 0 1 0\nf -5 -4 -3 -2 -1\n";
    format!("# a bust\n{}\n{faces}{polygon}", vertices.join("\n")).into_bytes()
}

/// A strip with texture coordinates.
fn strip() -> Vec<u8> {
    let row = |k: u32| format!("v {k} 0 0.1\nv {k} 1 -0.1\nvt 0.{k} 0\nvt 0.{k} 1 0\n");
    let face = |k: u32| format!("f {0}/{0} {1}/{1} {2}/-1 {3}/{3}\n", 2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2);
    ((0..9).map(row).collect::<String>() + &(0..8).map(face).collect::<String>()).into_bytes()
}

/// A strip of quads as USD text, moving and placed.
fn usd_mesh() -> Vec<u8> {
    let points = |y: u32| (0..10).map(|k| format!("({}, {y}, {})", k / 2, k % 2)).collect::<Vec<_>>().join(", ");
    let indices =
        (0..4).map(|k| format!("{}, {}, {}, {}", 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1)).collect::<Vec<_>>().join(", ");
    let uvs = (0..16).map(|k| format!("(0.{k}, 1)")).collect::<Vec<_>>().join(", ");
    format!(
        "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\ndef Xform \"root\"\n{{\n    float3 xformOp:scale = (1, 2, 1)\n    \
         uniform token[] xformOpOrder = [\"xformOp:scale\"]\n    def Mesh \"head\"\n    {{\n        int[] faceVertexCounts = [4, 4, 4, 4]\n        \
         int[] faceVertexIndices = [{indices}]\n        uniform token orientation = \"leftHanded\"\n        point3f[] points.timeSamples = {{\n            \
         0: [{}],\n            1: [{}],\n        }}\n        texCoord2f[] primvars:st = [{uvs}] (\n            interpolation = \"faceVarying\"\n        \
         )\n    }}\n}}\n",
        points(0),
        points(3)
    )
    .into_bytes()
}

/// A small grid of distances.
fn ball() -> Vec<u8> {
    let at = |node: u32, axis: u32| f64::from(node / 6_u32.pow(axis) % 6) - 2.5;
    let values = (0..216).map(|node| ((0..3).map(|axis| at(node, axis).powi(2)).sum::<f64>().sqrt() - 1.8) as f32);
    let low = nalgebra::Vector3::repeat(-2.5);
    let grid = superhelix::shapes::DistanceGrid::from_parts(low, 1.0, 0.7, [6; 3], values.collect()).unwrap();
    distance_grid::write_to_bytes(&grid).unwrap()
}

fn is_mesh(name: &str) -> bool {
    name.ends_with(".mesh")
}

fn is_motion(name: &str) -> bool {
    name.ends_with(".csv") || name.ends_with(".bvh")
}

/// A measured curve; the name is this test's.
fn is_recorded_curve(name: &str) -> bool {
    name.ends_with(".curve")
}

/// Reads and checks what comes out. The number of points or samples, if any did, and the memory that it took.
fn read(name: &str, bytes: &[u8]) -> (Option<usize>, usize) {
    if is_motion(name) {
        let (result, memory) = peak(|| Motion::read_from_bytes(name, bytes, &MotionOptions::default()));
        let motion = result.ok();
        if let Some(motion) = &motion {
            assert!(motion.times().windows(2).all(|pair| pair[0] < pair[1]));
            let middle = motion.at(motion.times()[0] + 0.5 * motion.duration());
            assert!(middle.origin.iter().all(|value| value.is_finite()) && (middle.rotation.norm() - 1.0).abs() < 1e-9);
        }
        return (motion.map(|motion| motion.times().len()), memory);
    }
    if is_recorded_curve(name) {
        let (result, memory) = peak(|| RecordedCurve::read_from_bytes(name, bytes));
        let curve = result.ok();
        if let Some(curve) = &curve {
            assert!(curve.times.windows(2).all(|pair| pair[0] < pair[1]) && curve.times.len() == curve.values.len());
            assert!(curve.values.iter().chain(&curve.times).all(|value| value.is_finite()));
            assert!(curve.root.as_ref().is_none_or(|root| root.len() == curve.times.len()));
        }
        return (curve.map(|curve| curve.times.len()), memory);
    }
    if is_mesh(name) {
        let (result, memory) = peak(|| obj_mesh::read_from_bytes(name, bytes));
        let mesh = result.ok();
        if let Some(mesh) = &mesh {
            assert!(mesh.vertices.iter().flatten().all(|value| value.is_finite()) && !mesh.triangles.is_empty());
            let count = mesh.vertices.len() as u32;
            assert!(mesh.triangles.iter().all(|[a, b, c]| a != b && b != c && c != a && [a, b, c].iter().all(|at| **at < count)));
        }
        let (textured, more) = peak(|| obj_mesh::read_textured_from_bytes(name, bytes));
        if let Ok((with, texture)) = textured {
            assert_eq!(Some(&with), mesh.as_ref());
            if let Some(texture) = texture {
                assert_eq!(texture.triangles.len(), with.triangles.len());
                assert!(texture.corners().iter().flatten().flatten().all(|value| value.is_finite()));
            }
        }
        let memory = memory.max(more);
        return (mesh.map(|mesh| mesh.vertices.len()), memory);
    }
    if name.ends_with(".usdmesh") {
        let (result, memory) = peak(|| MeshCache::read_from_bytes(name, bytes));
        let cache = result.ok();
        if let Some(cache) = &cache {
            let mesh = cache.first();
            let count = mesh.vertices.len() as u32;
            assert!(mesh.vertices.iter().flatten().all(|value| value.is_finite()) && !mesh.triangles.is_empty());
            assert!(mesh.triangles.iter().flatten().all(|at| *at < count));
            assert!(cache.texture().is_none_or(|texture| texture.corners().len() == mesh.triangles.len()));
            for time in cache.times().iter().take(4) {
                let (vertices, memory) = peak(|| cache.vertices(*time));
                assert!(memory <= permitted_overlap(name, bytes.len()), "{name}, at {time}: {memory}");
                assert!(
                    vertices.is_ok_and(|vertices| vertices.iter().flatten().all(|value| value.is_finite()))
                        || *time > cache.times()[0]
                );
            }
        }
        return (cache.map(|cache| cache.first().vertices.len()), memory);
    }
    if name.ends_with(".shxgrid") {
        let (result, memory) = peak(|| distance_grid::read_from_bytes(name, bytes));
        let grid = result.ok();
        if let Some(grid) = &grid {
            assert!(grid.values().iter().all(|value| value.is_finite()));
            assert_eq!(grid.counts().iter().product::<u32>() as usize, grid.values().len());
        }
        // In curves' points, of twelve bytes.
        return (grid.map(|grid| grid.values().len() / 3), memory);
    }
    let (result, memory) = peak(|| Curves::read_from_bytes(name, bytes));
    if name.ends_with(".usda") && result.is_ok() {
        // All frames that a reader may ask for, each within the same bounds.
        let cache = CurveCache::read_from_bytes(name, bytes).unwrap();
        assert!(cache.times().windows(2).all(|pair| pair[0] < pair[1]));
        for index in 0..cache.times().len().min(4) {
            let (frame, memory) = peak(|| cache.frame(index));
            assert!(memory <= permitted_overlap(name, bytes.len()), "{name}, frame {index}: {memory}");
            if let Ok(frame) = frame {
                assert!(frame.points().iter().flatten().all(|value| value.is_finite()));
            }
        }
    }
    let curves = result.ok();
    if let Some(curves) = &curves {
        assert!(curves.strands().all(|strand| strand.len() >= 2));
        assert_eq!(curves.counts().iter().map(|count| *count as usize).sum::<usize>(), curves.point_count());
        assert!(curves.points().iter().flatten().all(|value| value.is_finite()));
    }
    (curves.map(|curves| curves.point_count()), memory)
}

/// The permitted memory for a file of this many bytes, beside some for the text of an error. A point takes 12 bytes, as little as two of an OBJ
/// file name one, and Vec grows by doubling; a sample of a motion with its velocities takes 168. A control point of a USD file takes eight
/// bytes at least, is kept and becomes four points, which carry all else that curves have.
fn permitted_overlap(name: &str, bytes: usize) -> usize {
    let times = match name {
        _ if is_motion(name) || is_recorded_curve(name) => 24,
        _ if name.ends_with(".usda") || name.ends_with(".usdmesh") => 48,
        _ => 8,
    };
    times * bytes + 8192
}

fn whole_files_are_read_within_the_memory_limit() {
    for (name, bytes) in seeds() {
        let (count, memory) = read(name, bytes);
        assert!(count.is_some(), "{name}: {:?}", Curves::read_from_bytes(name, bytes));
        assert!(memory <= permitted_overlap(name, bytes.len()), "{name}: {memory} for {}", bytes.len());
        // The measurement sees at least what is handed out.
        assert!(memory >= 12 * count.unwrap_or_default(), "{name}: {memory}");
    }
    for name in
        ["blender_curly.hair", "amd_ponytail_tail.tfx", "sintel_hair_001.tfx", "fibermesh_1k.tfx", "cmu_jumping_jacks.bvh"]
    {
        let bytes = data(name);
        let (count, memory) = read(name, &bytes);
        assert!(count.is_some() && memory <= 4 * bytes.len(), "{name}: {memory} for {}", bytes.len());
    }
}

fn no_number_in_a_head_makes_a_reader_ask_for_much() {
    for (name, bytes) in seeds() {
        // Every 32-bit word of the head, with the numbers that overflow sums and products.
        for at in (0..bytes.len().min(296) - 4).step_by(4) {
            for number in [
                0,
                1,
                2,
                0xffff,
                0x10000,
                0x0555_5556,
                0x1555_5556,
                0x2000_0001,
                0x7fff_ffff,
                0x8000_0000,
                u32::MAX - 1,
                u32::MAX,
            ] {
                let mut changed = bytes.clone();
                changed[at..at + 4].copy_from_slice(&number.to_le_bytes());
                let (_, memory) = read(name, &changed);
                assert!(memory <= permitted_overlap(name, bytes.len()), "{name}, {number:#x} at {at}: {memory}");
            }
        }
        // Every number of a text's head.
        if let Ok(text) = std::str::from_utf8(bytes) {
            for word in text.split_whitespace().take(200).filter(|word| word.parse::<f64>().is_ok()) {
                for number in ["0", "-1", "65536", "2147483648", "4294967295", "18446744073709551615", "1e308", "nan"] {
                    let (_, memory) = read(name, text.replacen(word, number, 1).as_bytes());
                    assert!(memory <= permitted_overlap(name, bytes.len() + 20), "{name}, {number} for {word}: {memory}");
                }
            }
        }
    }
}

/// The least that a prim of USD text can say, thousands of times, side by side and in each other.
fn small_prims_take_little() {
    for prim in [
        "def\"\"{",
        "def BasisCurves\"\"{",
        "def BasisCurves\"\"{t points=[]",
        "def\"\"{t xformOp=1 ",
        "def Mesh\"\"{",
        "def Mesh\"\"{t points=[]",
    ] {
        for text in [
            format!("#usda 1.0\n{}", format!("{prim}}}").repeat(3000)),
            format!("#usda 1.0\n{}{}", prim.repeat(3000), "}".repeat(3000)),
        ] {
            for name in ["prims.usda", "prims.usdmesh"] {
                let (_, memory) = read(name, text.as_bytes());
                assert!(memory <= permitted_overlap(name, text.len()), "{name}, {prim}: {memory} for {}", text.len());
            }
        }
    }
}

/// One thing that happens to a file.
#[derive(Debug, Clone)]
enum Accident {
    Byte(prop::sample::Index, u8),
    Word(prop::sample::Index, u32),
    Cut(prop::sample::Index),
    Append(Vec<u8>),
    Delete(prop::sample::Index, usize),
    Double(prop::sample::Index, usize),
}

impl Accident {
    fn happen(&self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            return;
        }
        let length = bytes.len();
        match self {
            Accident::Byte(at, byte) => bytes[at.index(length)] = *byte,
            Accident::Word(at, word) => {
                let at = at.index(length) & !3;
                let end = (at + 4).min(length);
                bytes[at..end].copy_from_slice(&word.to_le_bytes()[..end - at]);
            }
            Accident::Cut(at) => bytes.truncate(at.index(length)),
            Accident::Append(more) => bytes.extend(more),
            Accident::Delete(at, count) => {
                let at = at.index(length);
                bytes.drain(at..(at + count).min(length));
            }
            Accident::Double(at, count) => {
                let at = at.index(length);
                let piece = bytes[at..(at + count).min(length)].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
}

fn accident() -> impl Strategy<Value = Accident> {
    let place = || any::<prop::sample::Index>();
    let digits = prop::sample::select(b"0123456789-+.eE \n\r\tnaifl{}/,#".to_vec());
    prop_oneof![
        (place(), any::<u8>()).prop_map(|(at, byte)| Accident::Byte(at, byte)),
        (place(), digits).prop_map(|(at, byte)| Accident::Byte(at, byte)),
        (place(), any::<u32>()).prop_map(|(at, word)| Accident::Word(at, word)),
        (place(), prop::sample::select(vec![0, 1, 2, 0x7f80_0000, 0x7fff_ffff, 0xffff_ffff]))
            .prop_map(|(at, word)| Accident::Word(at, word)),
        place().prop_map(Accident::Cut),
        prop::collection::vec(any::<u8>(), 1..40).prop_map(Accident::Append),
        (place(), 1..200_usize).prop_map(|(at, count)| Accident::Delete(at, count)),
        (place(), 1..200_usize).prop_map(|(at, count)| Accident::Double(at, count)),
    ]
}

fn mutilated_files_are_survived() {
    let accidents = prop::collection::vec(accident(), 1..6);
    let mut runner = TestRunner::new(ProptestConfig {
        cases: ProptestConfig::default().cases.max(20_000),
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    runner
        .run(&(0..seeds().len(), accidents, any::<bool>()), |(which, accidents, in_head)| {
            let (name, seed) = &seeds()[which];
            // Half of the time all happens in the first 300 bytes, where the counts are.
            let (mut bytes, rest) = if in_head { (seed[..300].to_vec(), &seed[300..]) } else { (seed.clone(), &seed[..0]) };
            accidents.iter().for_each(|accident| accident.happen(&mut bytes));
            bytes.extend(rest);
            let (count, memory) = read(name, &bytes);
            prop_assert!(memory <= permitted_overlap(name, bytes.len()), "{name}: {memory} for {}", bytes.len());
            WHOLE.fetch_add(usize::from(count.is_some()), Ordering::Relaxed);
            Ok(())
        })
        .unwrap();
    // Some mutations keep the file valid (a changed digit): both outcomes occurred.
    let whole = WHOLE.load(Ordering::Relaxed);
    assert!((1000..19_000).contains(&whole), "{whole} of 20000 were read");
}

/// Mutilated files that were read all the same.
static WHOLE: AtomicUsize = AtomicUsize::new(0);

fn noise_is_survived() {
    let names =
        ["a.hair", "a.tfx", "a.obj", "a.csv", "a.bvh", "a.curve", "a.mesh", "a.shxgrid", "a", "HAIR", "a.usda", "a.usdmesh"];
    let mut runner = TestRunner::new(ProptestConfig {
        cases: ProptestConfig::default().cases.max(10_000),
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    runner
        .run(&(0..names.len(), prop::collection::vec(any::<u8>(), 0..600)), |(which, bytes)| {
            // Noise alone would hardly ever begin as a layer does.
            let bytes =
                if names[which] == "a.usda" { [&b"#usda 1.0\ndef BasisCurves \"c\" {"[..], &bytes].concat() } else { bytes };
            let (_, memory) = read(names[which], &bytes);
            prop_assert!(memory <= permitted_overlap(names[which], bytes.len()));
            Ok(())
        })
        .unwrap();
}
