//! Alembic files (Ogawa): curves under transforms, as Blender nests them, from a file that is written here by the format's layout; and
//! files that are broken.

use superhelix::io::{Curves, CurvesFormat, StrandAttributes};

/// What a place holds.
enum Node {
    Group(Vec<Node>),
    Data(Vec<u8>),
    Nothing,
}

use Node::{Data, Group, Nothing};

const IS_DATA: u64 = 1 << 63;

/// Writes a node; returns what a group that holds it says of its place.
fn place(node: &Node, bytes: &mut Vec<u8>) -> u64 {
    match node {
        Nothing => 0,
        Data(content) if content.is_empty() => IS_DATA,
        Data(content) => {
            let at = bytes.len() as u64;
            bytes.extend((content.len() as u64).to_le_bytes());
            bytes.extend(content);
            at | IS_DATA
        }
        Group(children) if children.is_empty() => 0,
        Group(children) => {
            let places: Vec<u64> = children.iter().map(|child| place(child, bytes)).collect();
            let at = bytes.len() as u64;
            bytes.extend((places.len() as u64).to_le_bytes());
            places.iter().for_each(|place| bytes.extend(place.to_le_bytes()));
            at
        }
    }
}

/// A sample: a key, then the numbers.
fn sample(content: impl IntoIterator<Item = u8>) -> Node {
    Data([0xab; 16].into_iter().chain(content).collect())
}

fn floats(numbers: &[f32]) -> Node {
    Group(vec![sample(numbers.iter().flat_map(|number| number.to_le_bytes())), Data(Vec::new())])
}

/// A compound of properties: name, bits of its header's first word, content.
fn compound(properties: Vec<(&str, u32, Node)>) -> Node {
    let (mut headers, mut children) = (Vec::new(), Vec::new());
    for (name, info, content) in properties {
        // Metadata of its own, of no letters.
        headers.extend((info | 0xff << 20).to_le_bytes());
        if info & 3 != 0 {
            headers.push(1);
        }
        headers.push(name.len() as u8);
        headers.extend(name.bytes());
        headers.push(0);
        children.push(content);
    }
    children.push(Data(headers));
    Group(children)
}

const COMPOUND: u32 = 0;

/// A scalar or an array of a type, which one sample holds.
fn scalar(pod: u32) -> u32 {
    1 | pod << 4
}

fn array(pod: u32) -> u32 {
    2 | pod << 4
}

/// The same of several numbers a value.
fn vectors(pod: u32, numbers: u32) -> u32 {
    array(pod) | numbers << 12
}

/// An object of properties and of children with their names and metadata.
fn object(properties: Node, children: Vec<(&str, &str, Node)>) -> Node {
    let (mut all, mut headers) = (vec![properties], Vec::new());
    for (name, metadata, child) in children {
        headers.extend((name.len() as u32).to_le_bytes());
        headers.extend(name.bytes());
        headers.push(0xff);
        headers.extend((metadata.len() as u32).to_le_bytes());
        headers.extend(metadata.bytes());
        all.push(child);
    }
    headers.extend([0; 32]);
    all.push(Data(headers));
    Group(all)
}

fn archive(top: Node) -> Vec<u8> {
    let mut bytes = b"Ogawa\xff\x00\x01".to_vec();
    bytes.extend([0; 8]);
    let version = || Data(vec![1, 0, 0, 0]);
    let root = Group(vec![version(), version(), top, Data(Vec::new()), Data(Vec::new()), Data(Vec::new())]);
    let at = place(&root, &mut bytes);
    bytes[8..16].copy_from_slice(&at.to_le_bytes());
    bytes
}

const CURVES: &str = "schemaObjTitle=AbcGeom_Curve_v2:.geom;schema=AbcGeom_Curve_v2";
const XFORM: &str = "schemaObjTitle=AbcGeom_Xform_v3:.xform;schema=AbcGeom_Xform_v3";

/// Two curves of two and three points; `kind` is their type, wrap and basis.
fn curves(kind: [u8; 4], points: usize) -> Node {
    curves_with(kind, points, Vec::new())
}

/// The same with further properties.
fn curves_with(kind: [u8; 4], points: usize, further: Vec<(&str, u32, Node)>) -> Node {
    let numbers: Vec<f32> = (0..3 * points).map(|k| k as f32).collect();
    let counts = [2_u32, 3].iter().flat_map(|count| count.to_le_bytes()).collect::<Vec<u8>>();
    let mut properties = vec![
        ("P", array(10), floats(&numbers)),
        ("nVertices", array(6), Group(vec![sample(counts), Data(Vec::new())])),
        ("curveBasisAndType", scalar(1), Group(vec![sample(kind)])),
    ];
    properties.extend(further);
    let geometry = compound(properties);
    object(compound(vec![(".geom", COMPOUND, geometry)]), Vec::new())
}

/// A transform of such operations.
fn transform(operations: &[u8], values: &[f64], child: Node) -> Node {
    let values = Group(vec![sample(values.iter().flat_map(|number| number.to_le_bytes()))]);
    let xform = compound(vec![
        (".ops", scalar(1), Group(vec![sample(operations.iter().copied())])),
        (".vals", scalar(11), values),
        (".inherits", scalar(0), Group(vec![sample([1])])),
    ]);
    object(compound(vec![(".xform", COMPOUND, xform)]), vec![("hair", CURVES, child)])
}

fn read(bytes: &[u8]) -> Result<Curves, String> {
    Curves::read_from_bytes("hair.abc", bytes).map_err(|error| error.to_string())
}

#[test]
fn curves_stand_where_the_transforms_above_them_say() {
    let linear = [1, 0, 0, 0];
    let plain = archive(object(Nothing, vec![("hair", CURVES, curves(linear, 5))]));
    let found = read(&plain).expect("curves");
    assert_eq!((found.format(), found.counts()), (CurvesFormat::Alembic, &[2, 3][..]));
    let numbers: Vec<f32> = found.points().iter().flatten().copied().collect();
    assert_eq!(numbers, (0..15).map(|k| k as f32).collect::<Vec<_>>());
    // First a quarter turn about z, then twice as large, then moved: in the file the outermost stands first.
    let moved = transform(&[0x10, 0x00, 0x60], &[10.0, 0.0, 0.0, 2.0, 2.0, 2.0, 90.0], curves(linear, 5));
    let found = read(&archive(object(Nothing, vec![("above", XFORM, moved)]))).expect("curves");
    for (place, k) in found.points().iter().zip(0..) {
        let [x, y, z] = [0, 1, 2].map(|axis| (3 * k + axis) as f32);
        let expected = [10.0 - 2.0 * y, 2.0 * x, 2.0 * z];
        assert!((0..3).all(|axis| (place[axis] - expected[axis]).abs() < 1e-4), "{place:?} {expected:?}");
    }
    // A matrix, rows of vectors that stand on the left: y up from z up, and moved by 7 along the new x.
    let rows = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 7.0, 0.0, 0.0, 1.0];
    let found =
        read(&archive(object(Nothing, vec![("above", XFORM, transform(&[0x30], &rows, curves(linear, 5)))]))).expect("curves");
    assert_eq!(found.points()[1], [3.0 + 7.0, 5.0, -4.0]);
}

#[test]
fn parameters_of_curves_are_attributes() {
    let whole = |numbers: &[i32]| Group(vec![sample(numbers.iter().flat_map(|number| number.to_le_bytes())), Data(Vec::new())]);
    let indexed = compound(vec![(".vals", vectors(10, 1), floats(&[0.25, 0.5])), (".indices", vectors(5, 1), whole(&[1, 0]))]);
    let parameters = compound(vec![
        ("part", vectors(6, 1), whole(&[-3, 4])),
        ("stiff", vectors(10, 1), floats(&[1.0, 9.0, 2.0, 9.0, 9.0])),
        ("dye", vectors(10, 3), floats(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])),
        ("all", vectors(10, 1), floats(&[7.0])),
        ("indexed", COMPOUND, indexed),
        ("odd", vectors(10, 1), floats(&[1.0, 2.0, 3.0])),
        ("word", vectors(12, 1), floats(&[1.0, 2.0])),
    ]);
    let further = vec![("width", vectors(10, 1), floats(&[0.1, 0.1, 0.2, 0.1, 0.1])), (".arbGeomParams", COMPOUND, parameters)];
    let hair = || curves([1, 0, 0, 0], 5);
    let top = object(Nothing, vec![("bare", CURVES, hair()), ("hair", CURVES, curves_with([1, 0, 0, 0], 5, further))]);
    let bytes = archive(top);
    let attributes = StrandAttributes::read_from_bytes("hair.abc", &bytes).expect("attributes");
    let names: Vec<&str> = attributes.names().collect();
    assert_eq!(names, ["width", "part", "stiff", "dye[0]", "dye[1]", "dye[2]", "all", "indexed"]);
    for (name, expected) in
        [("part", [-3.0, 4.0]), ("stiff", [1.0, 2.0]), ("dye[1]", [2.0, 5.0]), ("all", [7.0, 7.0]), ("indexed", [0.5, 0.25])]
    {
        let values = attributes.get(name).unwrap();
        assert!(values.len() == 4 && values[..2].iter().all(|value| value.is_nan()), "{name}: {values:?}");
        assert_eq!(values[2..], expected, "{name}");
    }
    for at in 0..bytes.len() {
        for value in [0, 1, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[at] = value;
            let _ = StrandAttributes::read_from_bytes("hair.abc", &damaged);
        }
    }
}

#[test]
fn curves_that_are_not_read_and_broken_files_are_told() {
    let of = |child: Node| archive(object(Nothing, vec![("hair", CURVES, child)]));
    for (kind, word) in [([0, 0, 1, 0], "cubic"), ([1, 1, 0, 0], "periodic"), ([9, 0, 0, 0], "unknown")] {
        let text = read(&of(curves(kind, 5))).expect_err("refused");
        assert!(text.contains(word) && text.contains("\"hair\""), "{text}");
    }
    assert!(read(&of(curves([0, 0, 3, 0], 5))).is_ok());
    let text = read(&of(curves([1, 0, 0, 0], 4))).expect_err("refused");
    assert!(text.contains("5 points") && text.contains('4'), "{text}");
    assert!(read(&archive(object(Nothing, Vec::new()))).expect_err("empty").contains("no curves"));
    assert!(read(b"\x89HDF\r\n\x1a\n").expect_err("older").contains("HDF5"));
    // Every byte changed, and every length: an error or curves, but no panic and no hang.
    let whole = archive(object(Nothing, vec![("above", XFORM, transform(&[0x60], &[90.0], curves([1, 0, 0, 0], 5)))]));
    assert!(read(&whole).is_ok());
    let mut errors = 0;
    for at in 0..whole.len() {
        errors += usize::from(read(&whole[..at]).is_err());
        for value in [0, 1, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] = value;
            let _ = read(&damaged);
        }
    }
    assert!(errors > whole.len() * 9 / 10, "{errors}");
}
