//! Wavefront OBJ polylines.

use superhelix::Error;
use superhelix::io::{Curves, CurvesFormat, obj};

fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn a_groom_comes_back_to_the_bit() {
    for name in ["blender_curly.hair", "amd_ponytail_tail.tfx", "fibermesh_1k.tfx"] {
        let curves = Curves::read(data(name)).unwrap();
        let again = obj::read_from_bytes("again.obj", &obj::write_to_bytes(&curves)).unwrap();
        assert_eq!(again.format(), CurvesFormat::Obj);
        assert_eq!(again.counts(), curves.counts());
        let bits = |curves: &Curves| curves.points().iter().flatten().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert!(bits(&again) == bits(&curves), "{name}");
    }
    let odd = Curves::from_strands(&[[[f32::MIN_POSITIVE / 8.0, -0.0, f32::MAX], [1.0 / 3.0, 1e-30, -16777217.0]]]).unwrap();
    let again = obj::read_from_bytes("again.obj", &obj::write_to_bytes(&odd)).unwrap();
    assert!(again.points().iter().flatten().zip(odd.points().iter().flatten()).all(|(a, b)| a.to_bits() == b.to_bits()));
}

#[test]
fn other_programs_can_read_the_text() {
    let curves = Curves::from_strands(&[vec![[0.0, 0.5, 1.0], [0.25, 0.0, 0.0]], vec![[1.0; 3], [2.0; 3], [3.0; 3]]]).unwrap();
    let text = String::from_utf8(obj::write_to_bytes(&curves)).unwrap();
    assert_eq!(text, "# superhelix: 2 strands, 5 points\nv 0 0.5 1\nv 0.25 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nl 1 2\nl 3 4 5\n");
}

#[test]
fn lines_of_other_programs_are_read() {
    let text =
        b"# made elsewhere\r\nmtllib a.mtl\no hair\nv 1 2 3\nv 4 5 6\ng one\nusemtl brown\nl -2 -1\n\nv 7 8 9\ns off\nl 3 1 3\n";
    let curves = obj::read_from_bytes("other.obj", text).unwrap();
    assert_eq!(curves.counts(), [2, 3]);
    assert_eq!(curves.strand(0), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(curves.strand(1), [[7.0, 8.0, 9.0], [1.0, 2.0, 3.0], [7.0, 8.0, 9.0]]);
}

#[test]
fn nonsense_is_refused_with_line_and_value() {
    for (text, parts) in [
        ("", &["no polylines"][..]),
        ("v 1 2 3\n", &["no polylines"]),
        ("v 1 2\nl 1 1\n", &["line 1", "v 1 2"]),
        ("v 1 2 3 4\nl 1 1\n", &["line 1"]),
        ("v 1 2 inf\nl 1 1\n", &["line 1", "inf"]),
        ("v 1 2 1e400\nl 1 1\n", &["line 1", "1e400"]),
        ("v 1 2 3\nl 1\n", &["line 2", "1 points"]),
        ("v 1 2 3\nl 1 0\n", &["line 2", "\"0\"", "1 to 1"]),
        ("v 1 2 3\nl 1 2\n", &["line 2", "\"2\"", "1 to 1"]),
        ("v 1 2 3\nl 1 -2\n", &["line 2", "\"-2\""]),
        ("v 1 2 3\nl 1 -9223372036854775808\n", &["line 2"]),
        ("v 1 2 3\nl 1 1/1\n", &["line 2", "1/1"]),
        ("v 1 2 3\nv 1 2 3\nl 1 1\n", &["vertex 2", "no polyline"]),
        ("v 1 2 3\nf 1 1 1\n", &["line 2", "f 1 1 1", "polylines"]),
    ] {
        match obj::read_from_bytes("wrong.obj", text.as_bytes()) {
            Err(Error::File { path, reason }) => {
                assert_eq!(path, "wrong.obj");
                parts.iter().for_each(|part| assert!(reason.contains(part), "{reason:?} should say {part:?}"));
            }
            other => panic!("{text:?}: {other:?}"),
        }
    }
}
