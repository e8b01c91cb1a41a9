//! Meshes of `.usda` files over time.

use nalgebra::Vector3;
use superhelix::io::{MeshCache, UpAxis, obj_mesh};

/// Two quads side by side in the plane y = 0, facing up, as usd-core 26.11 writes them: the head of the file, what is said of the prims above,
/// and more attributes of the mesh.
fn text(above: &str, more: &str) -> String {
    format!(
        r#"#usda 1.0
(
    defaultPrim = "root"
    metersPerUnit = 0.1
    timeCodesPerSecond = 10
    upAxis = "Z"
)

def Xform "root"
{{
    {above}

    def Mesh "head"
    {{
        float3[] extent = [(-100, 0, -100), (100, 0, 100)]
        int[] faceVertexCounts = [4, 4]
        int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
        point3f[] points = [(-1, 0, 1), (0, 0, 1), (0, 0, -1), (-1, 0, -1), (1, 0, 1), (1, 0, -1)]
        {more}
        float[] primvars:other = [1, 2] (
            interpolation = "uniform"
        )
        uniform token subdivisionScheme = "none"
    }}
}}

def BasisCurves "hair"
{{
    point3f[] points = "of no interest here"
}}
"#
    )
}

fn read(above: &str, more: &str) -> MeshCache {
    MeshCache::read_from_bytes("head.usda", text(above, more).as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

const UVS: &str = "texCoord2f[] primvars:st = [(0, 0), (0.5, 0), (0.5, 1), (0, 1), (1, 0), (1, 1)] (
            interpolation = \"faceVarying\"
        )
        int[] primvars:st:indices = [0, 1, 2, 3, 1, 4, 5, 2]";

/// The normals of all triangles, weighted by twice their area.
fn normals(vertices: &[Vector3<f64>], triangles: &[[u32; 3]]) -> Vec<Vector3<f64>> {
    let of = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|vertex| vertices[vertex as usize]);
        (b - a).cross(&(c - a))
    };
    triangles.iter().map(|triangle| of(*triangle)).collect()
}

#[test]
fn a_mesh_is_that_of_the_same_obj_file() {
    let cache = read("", UVS);
    let obj = "v -1 0 1\nv 0 0 1\nv 0 0 -1\nv -1 0 -1\nv 1 0 1\nv 1 0 -1\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\n\
               f 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n";
    let (mesh, texture) = obj_mesh::read_textured_from_bytes("head.obj", obj.as_bytes()).unwrap();
    assert_eq!(*cache.first(), mesh);
    assert_eq!(cache.texture().map(obj_mesh::Texture::corners), texture.map(|texture| texture.corners()));
    assert_eq!((cache.times(), cache.metres_per_unit(), cache.up()), (&[0.0][..], 0.1, UpAxis::Z));
    assert_eq!(cache.vertices(3.0).unwrap(), mesh.vertices);
    // One a vertex; none.
    let by_vertex = UVS.lines().next().unwrap().to_owned() + "\ninterpolation = \"vertex\")";
    assert_eq!(read("", &by_vertex).texture().unwrap().corners(), cache.texture().unwrap().corners());
    assert!(read("", "").texture().is_none());
    // The other way round.
    let turned = read("", "uniform token orientation = \"leftHanded\"");
    for (one, other) in normals(&mesh.vertices, &mesh.triangles).iter().zip(normals(&mesh.vertices, &turned.first().triangles)) {
        assert!(one.y > 0.5 && (one + other).norm() < 1e-12, "{one} {other}");
    }
}

#[test]
fn vertices_move_between_samples_and_with_their_parents() {
    let samples = "point3f[] points.timeSamples = {
            0: [(-1, 0, 1), (0, 0, 1), (0, 0, -1), (-1, 0, -1), (1, 0, 1), (1, 0, -1)],
            3: [(-1, 3, 1), (0, 0, 1), (0, 0, -1), (-1, 0, -1), (1, 0, 1), (1, 0, -5)],
        }";
    let cache = read("", samples);
    assert_eq!(cache.times(), [0.0, 0.3]);
    assert_eq!(cache.vertices(0.3).unwrap()[0], Vector3::new(-1.0, 3.0, 1.0));
    let middle = cache.vertices(0.1).unwrap();
    assert!((middle[0] - Vector3::new(-1.0, 1.0, 1.0)).norm() < 1e-6, "{}", middle[0]);
    assert!((middle[5].z + 1.0 + 4.0 / 3.0).abs() < 1e-6);
    // Outside samples are held.
    assert_eq!(cache.vertices(-1.0).unwrap(), cache.vertices(0.0).unwrap());
    assert_eq!(cache.vertices(9.0).unwrap(), cache.vertices(0.3).unwrap());
    assert!(cache.vertices(f64::NAN).unwrap_err().to_string().contains("time"));

    let placed = read(
        "double3 xformOp:translate = (1, 2, 3)
         float3 xformOp:scale = (2, 2, 2)
         float xformOp:rotateZ.timeSamples = { 0: 0, 10: 90 }
         uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\", \"xformOp:scale\"]",
        "",
    );
    assert_eq!(placed.times(), [0.0, 1.0]);
    assert!((placed.first().vertices[4] - Vector3::new(3.0, 2.0, 5.0)).norm() < 1e-12, "{}", placed.first().vertices[4]);
    let later = placed.vertices(1.0).unwrap()[4];
    assert!((later - Vector3::new(1.0, 4.0, 5.0)).norm() < 1e-12, "{later}");

    // A mirror image is not inside out.
    let mirrored = read("float3 xformOp:scale = (-1, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]", "");
    let mesh = mirrored.first();
    assert!(normals(&mesh.vertices, &mesh.triangles).iter().all(|normal| normal.y > 0.5));
}

#[test]
fn all_meshes_of_a_file_are_one() {
    let one = text("", UVS);
    let second = "def Mesh \"ear\"
{
    double3 xformOp:translate = (5, 0, 0)
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [2, 1, 0]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 0, 1)]
    texCoord2f[] primvars:st = [(0.25, 0), (1, 0), (0, 1)] (
        interpolation = \"faceVarying\"
    )
}
def Mesh \"empty\"
{
    point3f[] points = []
}
def Mesh \"hidden\" (
    active = false
)
{
    int[] faceVertexCounts = [3]
}
";
    let cache = MeshCache::read_from_bytes("two.usda", (one.clone() + second).as_bytes()).unwrap();
    let mesh = cache.first();
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (9, 5));
    assert_eq!(mesh.triangles[4], [8, 7, 6]);
    assert_eq!(mesh.vertices[7], Vector3::new(6.0, 0.0, 0.0));
    assert_eq!(cache.texture().unwrap().corners()[4], [[0.25, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    // Texture coordinates are those of all, or none.
    let without = second.replace("primvars:st", "primvars:rest");
    assert!(MeshCache::read_from_bytes("two.usda", (one + &without).as_bytes()).unwrap().texture().is_none());
}

#[test]
fn errors_name_their_prim() {
    let refused = |above: &str, more: &str, words: &str| {
        let error = MeshCache::read_from_bytes("head.usda", text(above, more).as_bytes()).unwrap_err().to_string();
        assert!(error.contains("head.usda") && error.contains(words), "{words}: {error}");
    };
    for (more, words) in [
        ("int[] faceVertexCounts = [4, 3]", "/root/head: faceVertexCounts has 2 faces of 7 corners, and faceVertexIndices has 8"),
        ("int[] faceVertexCounts = [6, 2]", "/root/head: face 0 names point 1 twice"),
        ("int[] faceVertexCounts = [2, 6]", "/root/head: face 0 has 2 corners; expected 3 to 1000"),
        ("int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 6, 2]", "/root/head: face 1 names point 6; points has 6"),
        ("int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, -1, 2]", "line 19"),
        ("int[] faceVertexIndices = [0, 2, 1, 3, 1, 4, 5, 2]", "/root/head: face 0 of 4 corners crosses itself"),
        ("int[] holeIndices = [1]", "/root/head: holeIndices"),
        ("uniform token orientation = \"upHanded\"", "/root/head: orientation is \"upHanded\""),
        (
            "int[] faceVertexCounts.timeSamples = { 0: [4, 4], 1: [8] }",
            "/root/head: faceVertexCounts changes over time; expected the same faces at all times",
        ),
        ("texCoord2f[] primvars:st = [(0, 0)] (interpolation = \"constant\")", "/root/head: primvars:st is constant or uniform"),
        (
            "texCoord2f[] primvars:st = [(0, 0)] (interpolation = \"faceVarying\")",
            "/root/head: primvars:st has 1 entries; expected one per corner, 8",
        ),
        ("texCoord2f[] primvars:st = [(0, 0)]\nint[] primvars:st:indices = [0, 3]", "/root/head: primvars:st:indices has 3"),
        ("point3f[] points = [(0, 0, inf)]", "line 19"),
        ("int[] faceVertexCounts = []", "has no meshes: no Mesh with faces"),
    ] {
        refused("", more, words);
    }
    refused("float3 xformOp:spin = (1, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:spin\"]", "", "/root/head: xformOp:spin");
    // Faces that are said again at every sample are the same faces.
    assert_eq!(read("", "int[] faceVertexCounts.timeSamples = { 0: [4, 4], 1: [4, 4] }").first().triangles.len(), 4);
    // Points that come and go are found when they are asked for.
    let fewer = read(
        "",
        "point3f[] points.timeSamples = { 0: [(-1, 0, 1), (0, 0, 1), (0, 0, -1), (-1, 0, -1), (1, 0, 1), (1, 0, -1)], 1: [(0, 0, 0)] }",
    );
    let error = fewer.vertices(0.1).unwrap_err().to_string();
    assert!(error.contains("has 1 points at 0.1 s; expected 6, as at 0 s"), "{error}");
    let binary = MeshCache::read_from_bytes("head.usdc", b"PXR-USDC....").unwrap_err().to_string();
    assert!(binary.contains("binary USD"), "{binary}");
}
