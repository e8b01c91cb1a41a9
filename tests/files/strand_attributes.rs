//! Attributes of strands from every kind of file that has them; values that no strand can have.

use superhelix::io::{Curves, Extras, StrandAttributes, hair};

use super::numpy::{npy, npz};

fn of(name: &str, bytes: &[u8]) -> StrandAttributes {
    StrandAttributes::read_from_bytes(name, bytes).expect("attributes")
}

fn names(attributes: &StrandAttributes) -> Vec<&str> {
    attributes.names().collect()
}

/// Two prims: of a strand of two points and one of three, and of one strand of four.
fn usda(first: &str, second: &str) -> StrandAttributes {
    let text = format!(
        r#"#usda 1.0
def Xform "head"
{{
    def BasisCurves "left"
    {{
        uniform token type = "linear"
        int[] curveVertexCounts = [2, 3]
        point3f[] points = [(0, 0, 0), (0, 0, -1), (1, 0, 0), (1, 0, -1), (1, 0, -2)]
{first}
    }}
    def BasisCurves "empty"
    {{
        int[] curveVertexCounts = []
        point3f[] points = []
        float[] primvars:part = [7]
    }}
    def BasisCurves "right"
    {{
        uniform token type = "cubic"
        uniform token basis = "catmullRom"
        int[] curveVertexCounts = [4]
        point3f[] points = [(3, 0, 0), (3, 0, -1), (3, 0, -2), (3, 0, -3)]
{second}
    }}
}}
"#
    );
    of("head.usda", text.as_bytes())
}

fn primvar(line: &str, how: &str) -> String {
    format!("        {line} (\n            interpolation = \"{how}\"\n        )\n")
}

#[test]
fn primvars_of_every_interpolation_count_at_the_root() {
    let first = [
        primvar("int[] primvars:part = [0, 2]", "uniform"),
        primvar("float primvars:stiff = 0.25", "constant"),
        primvar("double[] primvars:drag = [1, 2, 3, 4, 5]", "vertex"),
        primvar("half[] primvars:wide = [1, 2, 3, 4, 5]", "varying"),
        primvar("color3f[] primvars:dye = [(0.1, 0.2, 0.3), (0.4, 0.5, 0.6)]", "uniform"),
        primvar("float[] primvars:kind = [10, 20, 30]", "uniform"),
        "        int[] primvars:kind:indices = [2, 1]\n".to_owned(),
        "        float[] primvars:moving.timeSamples = { 1: [5, 6], 2: [7, 8] }\n".to_owned(),
        primvar("bool[] primvars:tied = [0, 1]", "uniform"),
    ];
    let second = [
        primvar("int[] primvars:part = [5]", "uniform"),
        // Ends of spans: a Catmull-Rom curve of four points has one span.
        primvar("float[] primvars:wide = [8, 9]", "varying"),
        primvar("float[] primvars:only_right = [4, 3, 2, 1]", "vertex"),
    ];
    let attributes = usda(&first.concat(), &second.concat());
    let lacks = f64::NAN;
    for (name, expected) in [
        ("part", [0.0, 2.0, 5.0]),
        ("stiff", [0.25, 0.25, lacks]),
        ("drag", [1.0, 3.0, lacks]),
        ("wide", [1.0, 3.0, 8.0]),
        ("dye[0]", [0.1, 0.4, lacks]),
        ("dye[2]", [0.3, 0.6, lacks]),
        ("kind", [30.0, 20.0, lacks]),
        ("moving", [5.0, 6.0, lacks]),
        ("tied", [0.0, 1.0, lacks]),
        ("only_right", [lacks, lacks, 4.0]),
    ] {
        let values = attributes.get(name).unwrap_or_else(|| panic!("{name} of {:?}", names(&attributes)));
        let same = |(value, expected): (&f64, &f64)| value == expected || value.is_nan() && expected.is_nan();
        assert!(values.len() == 3 && values.iter().zip(&expected).all(same), "{name}: {values:?}");
    }
    assert_eq!(attributes.get("dye"), None);
}

#[test]
fn primvars_that_strands_cannot_have_are_left_out() {
    let first = [
        primvar("float[] primvars:few = [1, 2, 3]", "uniform"),
        primvar("float[] primvars:endless = [1, inf]", "uniform"),
        primvar("string[] primvars:word = [\"a\", \"b\"]", "uniform"),
        primvar("float[] primvars:astray = [1]", "uniform"),
        "        int[] primvars:astray:indices = [0, 1]\n".to_owned(),
        primvar("matrix4d primvars:turn = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))", "constant"),
        primvar("float[] primvars:good = [1, 2]", "uniform"),
        "        float[] primvars:bare\n        custom float[] own = [1, 2]\n".to_owned(),
    ];
    let attributes = usda(&first.concat(), "");
    assert_eq!(names(&attributes), ["good"]);
    // The curves are read as they were.
    assert!(StrandAttributes::read_from_bytes("broken.usda", b"#usda 1.0\ndef BasisCurves \"a\" {").is_err());
}

#[test]
fn extras_are_attributes() {
    let curves = Curves::from_strands(&[vec![[0.0_f32; 3], [0.0, 0.0, 1.0]], vec![[1.0, 0.0, 0.0], [1.0, 0.0, 1.0]]]).unwrap();
    let extras = Extras {
        thickness: Some(vec![0.5, 0.1, 0.25, 0.1]),
        colors: Some(vec![[0.0, 0.5, 1.0], [9.0; 3], [0.125, 0.0, 0.0], [9.0; 3]]),
        ..Extras::default()
    };
    let bytes = hair::write_to_bytes("two.hair", &curves.with_extras(extras).unwrap()).unwrap();
    let attributes = of("two.hair", &bytes);
    assert_eq!(names(&attributes), ["thickness", "color[0]", "color[1]", "color[2]"]);
    assert_eq!(attributes.get("thickness"), Some(&[0.5, 0.25][..]));
    assert_eq!(attributes.get("color[2]"), Some(&[1.0, 0.0][..]));
}

#[test]
fn properties_of_ply_count_at_the_root() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty uchar part\n\
                property float stiff\nelement strand 2\nproperty int nsegs\nproperty int label\nend_header\n\
                0 0 0 3 0.5\n0 0 1 9 9\n1 0 0 4 nan\n1 0 1 9 9\n1 0 2 9 9\n1 7\n2 8\n";
    let attributes = of("two.ply", text.as_bytes());
    assert_eq!(names(&attributes), ["part", "stiff", "label"]);
    assert_eq!(attributes.get("part"), Some(&[3.0, 4.0][..]));
    assert_eq!(attributes.get("label"), Some(&[7.0, 8.0][..]));
    let stiff = attributes.get("stiff").unwrap();
    assert!(stiff[0] == 0.5 && stiff[1].is_nan(), "{stiff:?}");
}

#[test]
fn arrays_beside_the_strands_are_attributes_whatever_their_type() {
    let floats = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    // Two strands of four points.
    let positions = npy("<f4", "(2, 4, 3)", &floats(&(0..24).map(|k| k as f32).collect::<Vec<_>>()));
    let members = [
        ("label.npy", npy("<i8", "(2,)", &[(-3_i64).to_le_bytes(), 5_i64.to_le_bytes()].concat())),
        ("small.npy", npy("|i1", "(2,)", &[0xfe, 7])),
        ("tied.npy", npy("|b1", "(2,)", &[0, 1])),
        ("count.npy", npy("<u2", "(2,)", &[0xff, 0xff, 1, 0])),
        ("stiff.npy", npy("<f8", "(2,)", &[0.1_f64.to_le_bytes(), 1e9_f64.to_le_bytes()].concat())),
        ("at_points.npy", npy("<f4", "(2, 4)", &floats(&[1.0, 9.0, 9.0, 9.0, 2.0, 9.0, 9.0, 9.0]))),
        ("normal.npy", npy("<f4", "(2, 2)", &floats(&[1.0, 2.0, 3.0, 4.0]))),
        ("tangents.npy", npy("<f4", "(2, 4, 1)", &floats(&[6.0, 9.0, 9.0, 9.0, 5.0, 9.0, 9.0, 9.0]))),
        ("other.npy", npy("<f4", "(3,)", &floats(&[1.0, 2.0, 3.0]))),
        ("words.npy", npy("<U1", "(2,)", &[0; 8])),
    ];
    let with_positions = [&[("positions.npy", positions.clone())][..], &members].concat();
    // Without that name, the strands are the only array of their shape.
    let unnamed = [&members[..], &[("hair.npy", positions)]].concat();
    for bytes in [npz(&with_positions), npz(&unnamed)] {
        let attributes = of("two.npz", &bytes);
        for (name, expected) in [
            ("label", [-3.0, 5.0]),
            ("small", [-2.0, 7.0]),
            ("tied", [0.0, 1.0]),
            ("count", [65535.0, 1.0]),
            ("stiff", [0.1, 1e9]),
            ("at_points", [1.0, 2.0]),
            ("normal[0]", [1.0, 3.0]),
            ("normal[1]", [2.0, 4.0]),
            ("tangents", [6.0, 5.0]),
        ] {
            assert_eq!(attributes.get(name), Some(&expected[..]), "{name} of {:?}", names(&attributes));
        }
        assert_eq!(attributes.names().count(), 9);
    }
}
