//! Wavefront OBJ meshes.

use superhelix::Error;
use superhelix::io::obj_mesh::MAX_CORNERS;
use superhelix::io::{ObjMesh, obj_mesh};
use superhelix::shapes::{Mesh, Sides};

fn read(text: &str) -> ObjMesh {
    obj_mesh::read_from_bytes("mesh.obj", text.as_bytes()).unwrap()
}

#[test]
fn a_head_is_read() {
    let mesh = obj_mesh::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/sintel_bust.obj")).unwrap();
    // Counted and measured with other software.
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (3046, 5952));
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for vertex in &mesh.vertices {
        for axis in 0..3 {
            (low[axis], high[axis]) = (low[axis].min(vertex[axis]), high[axis].max(vertex[axis]));
        }
    }
    for (found, expected) in low.iter().chain(&high).zip([-19.74136, 2.541244, -10.144863, 19.74136, 45.523857, 11.879967]) {
        assert!((found - expected).abs() < 6e-5, "{found} {expected}");
    }
    // 148 of its edges are on one triangle only: it is no solid, but all its triangles are wound alike.
    assert!(Mesh::new(mesh.vertices.clone(), mesh.triangles.clone(), Sides::Solid).is_err());
    assert!(Mesh::new(mesh.vertices, mesh.triangles, Sides::Front { depth: 0.02 }).is_ok());
}

#[test]
fn what_other_programs_write_is_read() {
    let mesh = read(
        "# made elsewhere\r\nmtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\nv 0 1 0 1 0.5 0.5 0.5\ns 1\n\
         usemtl red\ng one\nf 1/1/1 2/1/1 3/1/1\nf 1//1 -2//-1 -1//-1\nf 1/1 2/1 3/1 4/1\n",
    );
    assert_eq!(mesh.vertices.len(), 4);
    assert_eq!(mesh.vertices[2], nalgebra::Vector3::new(1.0, 1.0, 0.0));
    assert_eq!(mesh.triangles[..2], [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.triangles.len(), 4);
    // A kite whose corner lies inside the others' triangle: only one of its two cuts is inside it.
    let kite = read("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n");
    assert!(kite.triangles.iter().all(|triangle| triangle.contains(&1) && triangle.contains(&3)), "{:?}", kite.triangles);
    // A cube of quadrilaterals is closed and holds its volume.
    let cube = read(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
    );
    assert_eq!(cube.triangles.len(), 12);
    assert!(Mesh::new(cube.vertices, cube.triangles, Sides::Solid).is_ok());
}

#[test]
fn texture_coordinates_are_read_where_they_are_wanted() {
    let textured = |text: &str| obj_mesh::read_textured_from_bytes("mesh.obj", text.as_bytes());
    let corners = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";
    // A quadrilateral is cut somewhere: every corner keeps its own coordinates, here those of its place. Vertex 4 has another in the triangle.
    let text = format!("{corners}vt 0 0\nvt 1 0 0\nvt 1 0.5\nvt 0 0.5\nvt -3\nf 1/1 2/2 3/3 4/4\nf 1/1/9 -2/-3 4/5/\n");
    let (mesh, texture) = textured(&text).unwrap();
    assert_eq!(mesh, read(&text));
    let uvs = texture.expect("coordinates").corners();
    assert_eq!((mesh.triangles.len(), uvs.len()), (3, 3));
    for (triangle, uvs) in mesh.triangles.iter().zip(&uvs).take(2) {
        for (vertex, uv) in triangle.iter().zip(uvs) {
            let place = mesh.vertices[*vertex as usize];
            assert_eq!(*uv, [0.5 * place.x, 0.5 * place.y]);
        }
    }
    assert_eq!(uvs[2], [[0.0, 0.0], [1.0, 0.5], [-3.0, 0.0]]);
    // A corner without: the mesh is there, coordinates are not.
    for faces in ["f 1/1 2/1 3/1\nf 1 2 4\n", "f 1/1 2 3/1\n", "f 1//1 2//1 3//1\n"] {
        let text = format!("{corners}vt 0 0\n{faces}");
        assert_eq!(textured(&text).unwrap(), (read(&text), None));
    }
    for (text, parts) in [
        (format!("{corners}vt 0 0\nf 1/1 2/2 3/1\n"), ["line 6", "texture coordinate \"2\"", "1 to 1"]),
        (format!("{corners}vt 0 0\nf 1/1 2/0 3/1\n"), ["line 6", "texture coordinate \"0\"", "1 to 1"]),
        (format!("{corners}vt 0 nan\nf 1/1 2/1 3/1\n"), ["line 5", "v is", "nan"]),
        (format!("{corners}vt\nf 1/1 2/1 3/1\n"), ["line 5", "vt", "vt u v"]),
        (format!("{corners}vt 0 0 0 0\nf 1/1 2/1 3/1\n"), ["line 5", "vt 0 0 0 0", "vt u v"]),
    ] {
        let Err(Error::File { reason, .. }) = textured(&text) else { panic!("{text} was read") };
        for part in parts {
            assert!(reason.contains(part), "`{part}` is not in `{reason}`");
        }
        // Contact does not need them.
        read(&text);
    }
}

#[test]
fn nonsense_is_refused_with_line_and_value() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let many = |count: usize| {
        let mut text = String::new();
        (0..count).for_each(|index| text += &format!("v {} {} 0\n", (index as f64).cos(), (index as f64).sin()));
        text + "f" + &(1..=count).map(|index| format!(" {index}")).collect::<String>() + "\n"
    };
    let crossed = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n";
    for (text, parts) in [
        (String::new(), &["no faces"][..]),
        (triangle.into(), &["no faces"]),
        ("v 0 0\nf 1 1 1\n".into(), &["line 1", "v 0 0", "v x y z"]),
        ("v 0 0 0 1 1\n".into(), &["line 1", "v 0 0 0 1 1"]),
        ("v 0 0 0 red\n".into(), &["line 1", "red"]),
        ("v 0 nan 0\n".into(), &["line 1", "y", "nan"]),
        ("v 0 0 1e999\n".into(), &["line 1", "z", "1e999"]),
        (format!("{triangle}f 1 2\n"), &["line 4", "2 corners"]),
        (format!("{triangle}f 1 2 4\n"), &["line 4", "\"4\"", "1 to 3"]),
        (format!("{triangle}f 1 2 0\n"), &["line 4", "\"0\"", "1 to 3"]),
        (format!("{triangle}f 1 2 -4\n"), &["line 4", "\"-4\""]),
        (format!("f 1 2 3\n{triangle}"), &["line 1", "\"1\"", "1 to 0"]),
        (format!("{triangle}f 1 2 3/x\n"), &["line 4", "3/x"]),
        (format!("{triangle}f 1 2 3/1/1/1\n"), &["line 4", "3/1/1/1"]),
        (format!("{triangle}f 1 2 2\n"), &["line 4", "vertex 2 twice"]),
        (crossed.into(), &["line 5", "4 corners", "crosses itself"]),
        (format!("{triangle}l 1 2\n"), &["line 4", "l 1 2", "only faces"]),
        (many(MAX_CORNERS + 1), &["line 1002", "1000 corners"]),
    ] {
        let Err(Error::File { path, reason }) = obj_mesh::read_from_bytes("bad.obj", text.as_bytes()) else {
            panic!("{text} was read");
        };
        assert_eq!(path, "bad.obj");
        for part in parts {
            assert!(reason.contains(part), "`{part}` is not in `{reason}`");
        }
    }
}
