//! USD as text: real files of other programs, valid layers, and every way in which one can be wrong. Reference numbers are of
//! Pixar's own library and of numpy (tests/oracle/make_usd_references.py).

use serde_json::Value;
use superhelix::Error;
use superhelix::io::{CurveCache, CurveCacheWriter, Curves, CurvesFormat, Extras, HairHeader, UpAxis, usda};

fn data(name: &str) -> String {
    format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn reference() -> Value {
    serde_json::from_str(&std::fs::read_to_string(data("usd/reference.json")).unwrap()).unwrap()
}

fn rows(value: &Value) -> Vec<[f64; 3]> {
    serde_json::from_value(value.clone()).unwrap()
}

/// Floats hold seven digits; the placements multiply by up to 4.
#[track_caller]
fn assert_near(found: &[[f32; 3]], expected: &[[f64; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        for axis in 0..3 {
            let (found, expected) = (f64::from(found[axis]), expected[axis]);
            assert!((found - expected).abs() <= 4e-7 * (1.0 + expected.abs()), "{found} {expected}");
        }
    }
}

#[test]
fn placements_are_those_of_pixars_library_at_and_between_samples() {
    let cache = CurveCache::read(data("usd/placed.usda")).unwrap();
    assert_eq!(cache.times(), [0.0, 10.0 / 30.0]);
    assert_eq!(cache.time_codes_per_second(), 30.0);
    let expected = &reference()["placed"];
    for (time, code) in [(0.0, "0"), (2.5 / 30.0, "2.5"), (10.0 / 30.0, "10")] {
        let curves = cache.at(time).unwrap();
        assert_eq!(curves.counts(), [2, 3, 2]);
        assert_near(curves.points(), &rows(&expected[code]));
    }
    let first = cache.frame(0).unwrap();
    assert_eq!((first.extras().metres_per_unit, first.extras().up), (Some(0.01), Some(UpAxis::Z)));
    assert_eq!(first, Curves::read(data("usd/placed.usda")).unwrap());
    assert_eq!(cache.at(-5.0).unwrap().points(), first.points());
    // Placements that move give velocities: those of the points between samples, to second order in the time between.
    let (time, h) = (0.1, 1e-3);
    let (before, now, after) = (cache.at(time - h).unwrap(), cache.at(time).unwrap(), cache.at(time + h).unwrap());
    let velocities = now.extras().velocities.as_ref().unwrap();
    // The prim's own points have no velocities: what the placement does is all. The prim "b" stands still in its own axes.
    for index in 5..7 {
        for axis in 0..3 {
            let difference = f64::from(after.points()[index][axis] - before.points()[index][axis]) / (2.0 * h);
            assert!((difference - f64::from(velocities[index][axis])).abs() < 1e-3, "{difference} {velocities:?}");
        }
    }
    assert_eq!(velocities[5], [3.0, 0.0, 0.0]);
}

#[test]
fn curves_of_another_program_have_its_points_and_velocities() {
    let cache = CurveCache::read(data("usd/arnold_motion_var_vel.usda")).unwrap();
    assert_eq!(cache.times(), [6.0, 7.0, 8.0, 9.0, 10.0].map(|code| code / 24.0));
    let expected = &reference()["moving"];
    for (index, code, points) in [(0, "6", 13), (3, "9", 19)] {
        let curves = cache.frame(index).unwrap();
        // The topology changes from frame to frame.
        assert_eq!(curves.counts(), [points; 11]);
        assert_near(curves.points(), &rows(&expected[code]["points"]));
        // The placement is a shift: velocities are the file's own.
        assert_near(curves.extras().velocities.as_ref().unwrap(), &rows(&expected[code]["velocities"]));
        assert_eq!(curves.extras().thickness.as_ref().unwrap().len(), 11 * points as usize);
    }
    let groom = Curves::read(data("usd/arnold_groom_sphere.usda")).unwrap();
    // 118 B-splines of 13 control points: 10 spans of four points and an end.
    assert_eq!((groom.format(), groom.strand_count()), (CurvesFormat::Usda, 118));
    assert!(groom.counts().iter().all(|count| *count == 41));
    assert_near(groom.strand(0), &rows(&reference()["sphere_first"]));
    assert_near(groom.strand(117), &rows(&reference()["sphere_last"]));
}

/// A layer with one prim of curves.
fn layer(kind: &str, attributes: &str) -> String {
    format!("#usda 1.0\n(\n    metersPerUnit = 1\n)\ndef {kind} \"c\"\n{{\n{attributes}\n}}\n")
}

fn controls() -> String {
    let points: Vec<String> = rows(&reference()["controls"]).iter().map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
    format!("int[] curveVertexCounts = [7]\npoint3f[] points = [{}]\n", points.join(", "))
}

#[test]
fn every_basis_gives_the_curve_that_its_definition_says() {
    let reference = reference();
    for basis in ["bspline", "bezier", "catmullRom"] {
        let text = layer("BasisCurves", &format!("{}uniform token basis = \"{basis}\"", controls()));
        let curves = usda::read_from_bytes("c.usda", text.as_bytes()).unwrap();
        assert_near(curves.points(), &rows(&reference[basis]));
    }
    // Pinned, the ends are the first and the last control point.
    for basis in ["bspline", "catmullRom"] {
        let text = format!("{}uniform token basis = \"{basis}\"\nuniform token wrap = \"pinned\"", controls());
        let curves = usda::read_from_bytes("c.usda", layer("BasisCurves", &text).as_bytes()).unwrap();
        assert_eq!(curves.point_count(), 6 * 4 + 1);
        assert_near(&[curves.points()[0], curves.points()[24]], &[[0.0; 3], [6.0, 3.0, 3.0]]);
    }
    let list = |name: &str| reference[name].to_string();
    let nurbs = format!(
        "{}int[] order = [4]\ndouble[] knots = {}\ndouble[] pointWeights = {}",
        controls(),
        list("knots"),
        list("weights")
    );
    let curves = usda::read_from_bytes("c.usda", layer("NurbsCurves", &nurbs).as_bytes()).unwrap();
    assert_near(curves.points(), &rows(&reference["nurbs"]));
}

/// A quarter circle by NURBS, three times as large and lifted; a polyline before and after it; a Bézier curve.
#[test]
fn splines_keep_their_lengths() {
    let quarter = "#usda 1.0\n(\n    metersPerUnit = 0.01\n)\n\
        def NurbsCurves \"q\" {\nint[] curveVertexCounts = [3]\nint[] order = [3]\ndouble[] knots = [0,0,0,1,1,1]\n\
        double[] pointWeights = [1,0.7071067811865476,1]\npoint3f[] points = [(1,0,0),(1,1,0),(0,1,0)]\n\
        double3 xformOp:translate = (0,5,0)\nfloat3 xformOp:scale = (3,3,3)\nuniform token[] xformOpOrder = [\"xformOp:translate\",\"xformOp:scale\"]\n}\n";
    let linear = "def BasisCurves \"l\" {\nuniform token type = \"linear\"\nint[] curveVertexCounts = [3]\n\
        point3f[] points = [(0,0,0),(0,0,1),(0,2,1)]\n}\n";
    let read = |text: &str| usda::read_from_bytes("q.usda", text.as_bytes()).unwrap();
    let arclengths = |text: &str| read(text).extras().arclengths.clone();
    let both = arclengths(&format!("{quarter}{linear}")).unwrap();
    assert_eq!(both.len(), 5 + 3);
    // The parameter is not the angle: the middle is at one half, by symmetry, and the whole is a quarter of a circle of radius 3. Four chords
    // are 0.4 % shorter.
    let whole = 1.5 * std::f32::consts::PI;
    assert!((both[4] / whole - 1.0).abs() < 1e-6 && (both[2] / whole - 0.5).abs() < 1e-6, "{both:?}");
    assert_eq!(both[5..], [0.0, 1.0, 3.0]);
    assert!(read(quarter).strand_length(0) < 0.997 * f64::from(whole));
    // Whichever comes first.
    let other =
        arclengths(&format!("#usda 1.0\n(\n    metersPerUnit = 0.01\n)\n{linear}{}", &quarter[quarter.find("def").unwrap()..]))
            .unwrap();
    assert_eq!((&other[..3], &other[3..]), (&both[5..], &both[..5]));
    // A parabola as a cubic Bézier curve, (t, t²) for t from 0 to 1: √5/2 + asinh(2)/4 long.
    let parabola = "#usda 1.0\ndef BasisCurves \"p\" {\nuniform token basis = \"bezier\"\nint[] curveVertexCounts = [4]\n\
        point3f[] points = [(0,0,0),(0.33333334,0,0),(0.6666667,0.33333334,0),(1,1,0)]\n}\n";
    let along = arclengths(parabola).unwrap();
    let exact = |t: f64| (0.5 * t * (1.0 + 4.0 * t * t).sqrt() + 0.25 * (2.0 * t).asinh()) as f32;
    for (point, arclength) in along.iter().enumerate() {
        assert!((arclength - exact(point as f64 / 4.0)).abs() < 1e-6, "{along:?}");
    }
    // Polylines alone are what their points say.
    assert_eq!(arclengths(&format!("#usda 1.0\n{linear}")), None);
    // Metres, and what no file holds.
    let metres = read(quarter).scaled(0.01).unwrap();
    assert!((metres.extras().arclengths.as_ref().unwrap()[4] - 0.01 * whole).abs() < 1e-7);
    assert_eq!(metres.lost_in(CurvesFormat::Usda), ["lengths of curves between points"]);
}

#[test]
fn widths_colours_and_opacities_go_with_the_points_however_they_are_said() {
    let linear = "uniform token type = \"linear\"\nint[] curveVertexCounts = [2, 3]\n\
                  point3f[] points = [(0,0,0),(0,0,1),(1,0,0),(1,0,1),(1,0,2)]\n";
    let read = |more: &str| usda::read_from_bytes("c.usda", layer("BasisCurves", &format!("{linear}{more}")).as_bytes()).unwrap();
    let widths = |text: &str| read(text).extras().thickness.clone().unwrap();
    assert_eq!(widths("float[] widths = [0.5] (interpolation = \"constant\")"), [0.5; 5]);
    assert_eq!(widths("float[] widths = [0.5]"), [0.5; 5]);
    assert_eq!(widths("float[] widths = [1, 2] (\n interpolation = \"uniform\"\n)"), [1.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(widths("float[] widths = [1, 2, 3, 4, 5]"), [1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(widths("float[] widths = [1, 2, 3, 4, 5] (interpolation = \"varying\")"), [1.0, 2.0, 3.0, 4.0, 5.0]);
    let indexed = "color3f[] primvars:displayColor = [(1,0,0),(0,1,0)] (interpolation = \"uniform\")\n\
                   int[] primvars:displayColor:indices = [1, 0]\nfloat[] primvars:displayOpacity = [0.25]";
    let curves = read(indexed);
    let [red, green] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(curves.extras().colors.as_ref().unwrap()[..], [green, green, red, red, red]);
    assert_eq!(curves.extras().transparency.as_ref().unwrap()[..], [0.75; 5]);
    // Along a cubic: a constant stays one, and varying widths go straight from span's end to span's end.
    let cubic = format!("{}uniform token basis = \"bspline\"\n", controls());
    let read = |more: &str| usda::read_from_bytes("c.usda", layer("BasisCurves", &format!("{cubic}{more}")).as_bytes()).unwrap();
    let varying = read("float[] widths = [1, 2, 4, 8, 16] (interpolation = \"varying\")").extras().thickness.clone().unwrap();
    assert_eq!(varying[..9], [1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0]);
    assert_eq!(varying[16], 16.0);
    let vertex = read("float[] widths = [3, 3, 3, 3, 3, 3, 3]").extras().thickness.clone().unwrap();
    assert!(vertex.iter().all(|width| (width - 3.0).abs() < 1e-6));
    // A placement that doubles everything doubles widths.
    let scaled = "float3 xformOp:scale = (2, 2, 2)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]\nfloat[] widths = [1]";
    assert!(read(scaled).extras().thickness.as_ref().unwrap().iter().all(|width| (width - 2.0).abs() < 1e-6));
}

/// Curves with everything that they can have.
fn everything() -> Curves {
    let strands: Vec<Vec<[f32; 3]>> =
        vec![vec![[0.1, -1e-30, 3.0], [0.3, 1.5e-7, 2.0]], vec![[1.0 / 3.0, 2.0, 3.0], [1e10, 0.0, -0.0], [5.0, 6.0, 7.5]]];
    let each = |scale: f32| (0..5).map(|index| scale * (index as f32 + 1.0 / 3.0)).collect::<Vec<f32>>();
    let vectors = |scale: f32| each(scale).iter().map(|x| [*x, -x, 0.5 * x]).collect::<Vec<_>>();
    let extras = Extras {
        arclengths: None,
        thickness: Some(each(1e-5)),
        transparency: Some(vec![0.0, 0.25, 0.5, 0.75, 1.0]),
        colors: Some(vectors(0.1)),
        velocities: Some(vectors(-3.0)),
        held: Some(vec![true, false, true, false, false]),
        strand_thickness: Some(vec![0.7, 1.3]),
        strand_uvs: Some(vec![[0.25, 0.1], [0.7, 0.9]]),
        hair_header: None,
        metres_per_unit: Some(0.0254),
        up: Some(UpAxis::Z),
    };
    Curves::from_strands(&strands).unwrap().with_extras(extras).unwrap()
}

#[test]
fn what_is_written_is_read_back_bit_for_bit() {
    let curves = everything();
    let bytes = usda::write_to_bytes(&curves);
    let again = usda::read_from_bytes("e.usda", &bytes).unwrap();
    assert_eq!((again.counts(), again.extras()), (curves.counts(), curves.extras()));
    let bits = |curves: &Curves| curves.points().iter().flatten().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&again), bits(&curves));
    assert!(curves.lost_in(CurvesFormat::Usda).is_empty());
    // And once more, to the byte.
    assert_eq!(usda::write_to_bytes(&again), bytes);
    for name in ["blender_wavy.hair", "blender_curly.hair", "amd_ponytail_back.tfx", "sintel_hair_001.tfx", "fibermesh_1k.tfx"] {
        let real = Curves::read(data(&format!("grooms/{name}"))).unwrap();
        let again = usda::read_from_bytes(name, &usda::write_to_bytes(&real)).unwrap();
        assert_eq!((again.counts(), again.points()), (real.counts(), real.points()), "{name}");
        assert_eq!(
            (&again.extras().held, &again.extras().strand_uvs),
            (&real.extras().held, &real.extras().strand_uvs),
            "{name}"
        );
    }
    // The defaults of a .hair file become numbers for all.
    let header = HairHeader { thickness: 0.5, transparency: 0.25, color: [0.1, 0.2, 0.3], ..HairHeader::default() };
    let plain = Curves::from_strands(&[[[0.0_f32; 3], [1.0; 3]]]).unwrap();
    let plain = plain.with_extras(Extras { hair_header: Some(header), ..Extras::default() }).unwrap();
    let again = usda::read_from_bytes("h.usda", &usda::write_to_bytes(&plain)).unwrap();
    let extras = again.extras();
    assert_eq!((extras.thickness.as_deref(), extras.transparency.as_deref()), (Some(&[0.5; 2][..]), Some(&[0.25; 2][..])));
    assert_eq!(extras.colors.as_deref(), Some(&[[0.1, 0.2, 0.3]; 2][..]));
}

#[test]
fn a_cache_has_its_frames_velocities_and_nothing_left_beside_it() {
    let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("usda_cache");
    let _ = std::fs::remove_dir_all(&directory);
    std::fs::create_dir_all(&directory).unwrap();
    let path = directory.join("hair.usda");
    let curves = everything();
    let mut writer = CurveCacheWriter::create(&path, &curves, 24.0).unwrap();
    let velocities = curves.extras().velocities.as_deref();
    let frame = |index: i32| {
        curves.points().iter().map(|point| point.map(|value| value * (1.0 + 0.1 * index as f32))).collect::<Vec<_>>()
    };
    for index in 0..4 {
        writer.write(f64::from(index) / 24.0, &frame(index), velocities).unwrap();
    }
    for (error, said) in [
        (writer.write(3.0 / 24.0, &frame(0), velocities), "time"),
        (writer.write(f64::NAN, &frame(0), velocities), "time"),
        (writer.write(1.0, &frame(0)[1..], velocities), "points"),
        (writer.write(1.0, &frame(0), None), "velocities"),
        (writer.write(1.0, &[[f32::NAN; 3]; 5], velocities), "points[0]"),
    ] {
        assert!(matches!(&error, Err(Error::InvalidArgument { argument, .. }) if argument == said), "{error:?}");
    }
    assert!(!path.exists() && writer.frame_count() == 4);
    writer.finish().unwrap();
    assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 1);
    let cache = CurveCache::read(&path).unwrap();
    assert_eq!(cache.times(), [0.0, 1.0 / 24.0, 2.0 / 24.0, 3.0 / 24.0]);
    for index in 0..4 {
        let read = cache.frame(index).unwrap();
        assert_eq!((read.points(), read.extras()), (&frame(index as i32)[..], curves.extras()), "{index}");
    }
    // Between frames: the mean, rounded once.
    let mean = cache.at(0.5 / 24.0).unwrap();
    let (a, b) = (frame(0), frame(1));
    for (index, point) in mean.points().iter().enumerate() {
        for axis in 0..3 {
            let expected = (f64::from(a[index][axis]) + f64::from(b[index][axis])) / 2.0;
            assert!((f64::from(point[axis]) - expected).abs() <= 1e-7 * expected.abs());
        }
    }
    assert!(matches!(cache.frame(4), Err(Error::InvalidArgument { .. })) && cache.at(f64::INFINITY).is_err());
    // Dropped unfinished, nothing is left; without frames there is nothing to finish.
    drop(CurveCacheWriter::create(directory.join("other.usda"), &curves, 24.0).unwrap());
    assert!(CurveCacheWriter::create(directory.join("other.usda"), &curves, 24.0).unwrap().finish().is_err());
    assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 1);
    assert!(CurveCacheWriter::create(directory.join("no/such/dir.usda"), &curves, 24.0).is_err());
    assert!(CurveCacheWriter::create(&path, &curves, 0.0).is_err());
}

#[test]
fn other_content_around_curves_is_skipped() {
    let text = r#"#usda 1.0
( "a layer"
    customLayerData = { string a = "}" ; int[] b = [1, 2] }
    doc = """three
lines ) """
    upAxis = 'Y'
    metersPerUnit = 0.1
)
# a comment ( [ {
over "untouched" { def BasisCurves "c" { int[] curveVertexCounts = [9] } }
class "abstract" { def BasisCurves "c" { int[] curveVertexCounts = [9] } }
def Xform "off" ( active = false ) { def BasisCurves "c" { int[] curveVertexCounts = [9] } }
def Xform "head" (
    prepend apiSchemas = ["SkelBindingAPI"]
    kind = "component"
    assetInfo = { asset identifier = @./a.usda@ }
)
{
    custom rel look = [ </a>, </b> ]
    token visibility.connect = </x.y>
    prepend rel other = </b>
    asset file = @@@it's@here@@@
    reorder nameChildren = ["a", "b"]
    matrix4d m = ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,1) )
    def BasisCurves "empty" { point3f[] points = [] }
    def BasisCurves "nothing" { point3f[] points = None }
    def BasisCurves "hair"
    {
        uniform token type = "linear" ; int[] curveVertexCounts = [2]
        point3f[] points = [(1, 2, 3), (4, 5, 6),] ( interpolation = "vertex" doc = "points" )
        normal3f[] normals.timeSamples = { 1: [(0,0,1)], 2: None, }
        string primvars:name = "a \" quote"
    }
}
"#;
    let curves = usda::read_from_bytes("p.usda", text.as_bytes()).unwrap();
    assert_eq!((curves.counts(), curves.points()), (&[2][..], &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]][..]));
    assert_eq!(curves.extras().metres_per_unit, Some(0.1));
    // The format's defaults.
    let plain = layer(
        "BasisCurves",
        "uniform token type = \"linear\" int[] curveVertexCounts = [2] point3f[] points = [(0,0,0),(0,0,1)]",
    );
    let plain = plain.replace("(\n    metersPerUnit = 1\n)\n", "");
    let curves = Curves::read_from_bytes("a file without an end", plain.as_bytes()).unwrap();
    assert_eq!((curves.extras().metres_per_unit, curves.extras().up), (Some(0.01), Some(UpAxis::Y)));
}

#[test]
fn nonsense_is_refused_with_place_and_value() {
    let reason = |bytes: &[u8]| match Curves::read_from_bytes("wrong.usda", bytes) {
        Err(Error::File { path, reason }) => {
            assert_eq!(path, "wrong.usda");
            reason
        }
        other => panic!("{other:?}"),
    };
    for (bytes, said) in [
        (&b"PXR-USDC\0\0"[..], "binary USD file: make it text first (python -m superhelix.usd convert groom.usdc groom.usda"),
        (b"PK\x03\x04", "archive (.usdz?): make it text first (python -m superhelix.usd convert groom.usdz groom.usda"),
        (b"Ogawa\xff", "Alembic"),
        (b"\x89HDF\r\n", "HDF5"),
        (b"usda", "#usda 1."),
        (b"#usda 1.0\n", "no curves"),
        (b"#usda 1.0\ndef \"a\" {", "line 2: the file ends inside /a, which begins at line 2"),
        (b"#usda 1.0\n\n}", "line 3"),
        (b"#usda 1.0\n(\n metersPerUnit = -1 )", "metersPerUnit is -1"),
        (b"#usda 1.0\n(\n upAxis = \"X\" )", "upAxis is \"X\""),
        (b"#usda 1.0\n(\n subLayers = [@a.usda@] )", "subLayers"),
        (b"#usda 1.0\ndef \"a\" ( prepend references = @b@</c> ) {}", "references"),
        (b"#usda 1.0\ndef \"a\" { variantSet \"v\" = { \"x\" { } } }", "variantSet"),
        (b"#usda 1.0\ndef \"a { }", "does not end"),
        (b"#usda 1.0\ndef \"a\" { int x = [1, 2 }", "expected a value"),
        (b"#usda 1.0\ndef \"a\" { int x = [1, (2, ", "not closed"),
        (b"#usda 1.0\nint x = 2", "outside of prims"),
    ] {
        let found = reason(bytes);
        assert!(found.contains(said), "{found:?} should say {said:?}");
    }
    let linear = "uniform token type = \"linear\"\nint[] curveVertexCounts = [2, 3]\n\
                  point3f[] points = [(0,0,0),(0,0,1),(1,0,0),(1,0,1),(1,0,2)]\n";
    for (replaced, with, said) in [
        ("[2, 3]", "[2, 2]", "2 curves of 4 points, and points has 5"),
        ("[2, 3]", "[4, 1]", "curve 1 has 1 points"),
        ("[2, 3]", "[2, -3]", "line 8: a curve's number of points is \"-3\""),
        ("[2, 3]", "[2, 4294967295]", "4294967297 points"),
        ("(1,0,2)", "(1,0,nan)", "line 9: a point is \"nan\"; expected a finite number"),
        ("(1,0,2)", "(1,0,1e39)", "\"1e39\""),
        ("(1,0,2)", "(1,0)", "expected ',' between the 3 numbers of a point"),
        ("(1,0,2)", "(1,0,2,3)", "expected ')' after the 3 numbers"),
        ("(1,0,2)]", "(1,0,2)", "expected ']' after a point 4"),
        ("\"linear\"", "\"wavy\"", "type is \"wavy\""),
        ("\"linear\"", "\"cubic\"", "curve 0"),
        ("int[]", "uniform token wrap = \"periodic\" int[]", "periodic"),
        ("int[]", "float[] widths = [1, 2] int[]", "widths has 2 entries; expected 5, one per point"),
        ("int[]", "float[] widths = [1, 2] (interpolation = \"constant\") int[]", "expected 1, one for all"),
        ("int[]", "float[] widths = [1] (interpolation = \"odd\") int[]", "interpolation is \"odd\""),
        ("int[]", "vector3f[] velocities = [(1, 0, 0)] int[]", "velocities has 1 entries; expected one per point, 5"),
        ("int[]", "color3f[] primvars:displayColor = [(1, 0, 0)] int[] primvars:displayColor:indices = [3] int[]", "has 3"),
        ("int[]", "point3f[] points.timeSamples = { 1: [(0,0,0)], 1: [(0,0,0)] } int[]", "time 1 is sampled twice"),
        ("int[]", "point3f[] points.timeSamples = { x: [] } int[]", "a time is \"x\""),
        ("int[]", "token[] xformOpOrder = [\"xformOp:scale\"] int[]", "/c: xformOp:scale is in xformOpOrder and has no value"),
        ("int[]", "token[] xformOpOrder = [\"xformOp:skew\"] double3 xformOp:skew = (1, 2, 3) int[]", "not a known operation"),
        ("int[]", "token[] xformOpOrder = [\"xformOp:scale\"] double3 xformOp:scale = (1, 2) int[]", "wrong number of values"),
    ] {
        let text = layer("BasisCurves", &linear.replacen(replaced, with, 1));
        let found = reason(text.as_bytes());
        assert!(found.contains(said), "{found:?} should say {said:?}");
    }
    let nurbs = format!("{}int[] order = [4]\ndouble[] knots = [0,0,0,0,1,2,3,4,4,4,4]\n", controls());
    for (replaced, with, said) in [
        ("[4]", "[]", "order has 0 numbers; expected one per curve, 1"),
        ("[4]", "[8]", "knots has 11 numbers"),
        ("[0,0,0,0,1,2", "[0,0,0,0,2,1", "knots[5]"),
        ("int[] order", "double[] pointWeights = [1] int[] order", "pointWeights has 1"),
        ("int[] order", "double[] pointWeights = [1,1,1,0,1,1,1] int[] order", "weights[3]"),
    ] {
        let found = reason(layer("NurbsCurves", &nurbs.replacen(replaced, with, 1)).as_bytes());
        assert!(found.contains(said), "{found:?} should say {said:?}");
    }
}

#[test]
fn deep_nesting_and_many_prims_are_no_danger() {
    let deep = format!("#usda 1.0\n{}{}", "def Xform \"a\" {".repeat(100_000), "}".repeat(100_000));
    assert!(
        matches!(usda::read_from_bytes("deep", deep.as_bytes()), Err(Error::File { reason, .. }) if reason.contains("no curves"))
    );
    let value = format!("#usda 1.0\ndef \"a\" {{ int x = {}{} }}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(
        matches!(usda::read_from_bytes("deep", value.as_bytes()), Err(Error::File { reason, .. }) if reason.contains("no curves"))
    );
    let many = format!("#usda 1.0\n{}", "def \"\"{}".repeat(200_000));
    assert!(usda::read_from_bytes("many", many.as_bytes()).is_err());
}

/// A strand of two points that begins at x, of a prim with these properties.
fn strand(name: &str, properties: &str, x: u32) -> String {
    format!(
        "def BasisCurves \"{name}\" {{ {properties} uniform token type = \"linear\" int[] curveVertexCounts = [2] point3f[] points = [({x},0,0),({x},0,1)] }}\n"
    )
}

fn first_numbers(text: &str) -> Vec<f32> {
    let curves = usda::read_from_bytes("p.usda", format!("#usda 1.0\n{text}").as_bytes()).unwrap();
    curves.strands().map(|strand| strand[0][0]).collect()
}

#[test]
fn invisible_prims_are_left_out() {
    let hidden = "token visibility = \"invisible\"";
    let seen = strand("a", "token visibility = \"inherited\"", 1);
    assert_eq!(first_numbers(&(seen.clone() + &strand("b", hidden, 2))), [1.0]);
    // The contents of a hidden prim are hidden, whatever they say, even if visibility comes after them.
    let group = format!("def Xform \"g\" {{ {} {hidden} }}\n", strand("c", "token visibility = \"inherited\"", 3));
    assert_eq!(first_numbers(&(group + &seen)), [1.0]);
    // Guides beside hair are left; where all are guides they are the groom.
    let guides = format!("def Scope \"g\" {{ token purpose = \"guide\" {} {} }}\n", strand("d", "", 4), strand("e", "", 5));
    assert_eq!(first_numbers(&(guides.clone() + &seen)), [1.0]);
    assert_eq!(first_numbers(&guides), [4.0, 5.0]);
    let render = format!("def Scope \"g\" {{ token purpose = \"proxy\" {} }}\n", strand("f", "token purpose = \"render\"", 6));
    assert_eq!(first_numbers(&(render + &guides)), [6.0]);
}

#[test]
fn what_would_be_read_in_part_is_refused() {
    let refused = |text: &str| match usda::read_from_bytes("p.usda", format!("#usda 1.0\n{text}").as_bytes()) {
        Err(Error::File { reason, .. }) => reason,
        other => panic!("{text}: {other:?}"),
    };
    let instancer = format!("def PointInstancer \"many\" {{ def Scope \"prototypes\" {{ {} }} }}", strand("a", "", 1));
    assert!(refused(&instancer).contains("PointInstancer"), "{}", refused(&instancer));
    let off = instancer.replace("\"many\"", "\"many\" (active = false)");
    assert_eq!(first_numbers(&(off + &strand("b", "", 2))), [2.0]);
    let joints = "int[] primvars:skel:jointIndices = [0, 0]";
    assert!(refused(&strand("a", joints, 1)).contains("skeleton"));
    let above = format!("def Scope \"s\" {{ {joints} {} }}", strand("a", "", 1));
    assert!(refused(&above).contains("skeleton"));
    let over_time = "token visibility.timeSamples = { 0: \"inherited\", 1: \"invisible\" }";
    assert!(refused(&strand("a", over_time, 1)).contains("visibility"));
}
