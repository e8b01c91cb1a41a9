//! Which way a head faces by its mesh: where it has relief. Nose, eyes and mouth bend the skin more than the back of a head.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::picture::view::Face;
use crate::shell::up::Up;
use crate::surfaces::surface::Surface;

/// The head is the top of the body, down to where that is as high as it is deep or wide; not before this share of the body, since a tuft is
/// no head.
const LEAST_HEAD: f64 = 0.02;
/// The mean direction of relief less that of skin must be as long as this for a head to say which way it faces.
const CLEAR: f64 = 0.05;
/// And that much longer than across: a head is the same on its left and its right.
const STRAIGHT: f64 = 3.0;

/// Vertices nearer than this, in sizes of the body, are one.
const SAME: f64 = 1e-6;

/// A sum of directions, level, and of their weights.
#[derive(Default)]
struct Mean(Vector3<f64>, f64);

impl Mean {
    fn add(&mut self, direction: Vector3<f64>, weight: f64) {
        self.0 += direction * weight;
        self.1 += weight;
    }

    fn value(&self) -> Option<Vector3<f64>> {
        (self.1 > 0.0).then(|| self.0 / self.1)
    }
}

/// The axis that is nearest to where the head bends most for its area; none where that is not clear.
pub fn face_of(body: &Surface, up: Up) -> Option<Face> {
    let (low, middle) = head(body, up)?;
    let way = |place: Vector3<f64>| {
        let mut way = place - middle;
        way[up.axis()] = 0.0;
        (place[up.axis()] >= low).then(|| way.try_normalize(0.0).unwrap_or_default())
    };
    let (mut skin, mut relief) = (Mean::default(), Mean::default());
    // The side of an edge that has been seen, by its ends: the normal there, until the triangle on the other side comes.
    let mut waiting: HashMap<[[i64; 3]; 2], Vector3<f64>> = HashMap::new();
    let grain = SAME * body.vertices.iter().map(|vertex| (vertex - middle).amax()).fold(f64::MIN_POSITIVE, f64::max);
    for triangle in &body.triangles {
        let corners = triangle.map(|corner| body.vertices[corner as usize]);
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let (area, Some(normal)) = (normal.norm() / 2.0, normal.try_normalize(0.0)) else { continue };
        // By place, since meshes have vertices twice where their texture is cut, and poles of many.
        let keys = corners.map(|corner| <[f64; 3]>::from((corner - middle) / grain).map(|value| value.round() as i64));
        if keys[0] == keys[1] || keys[1] == keys[2] || keys[2] == keys[0] {
            continue;
        }
        if let Some(way) = way(corners.iter().sum::<Vector3<f64>>() / 3.0) {
            skin.add(way, area);
        }
        for side in 0..3 {
            let (a, b) = (corners[side], corners[(side + 1) % 3]);
            let mut key = [keys[side], keys[(side + 1) % 3]];
            key.sort_unstable();
            let Some(other) = waiting.remove(&key) else {
                waiting.insert(key, normal);
                continue;
            };
            if let Some(way) = way((a + b) / 2.0) {
                relief.add(way, (b - a).norm() * normal.cross(&other).norm().atan2(normal.dot(&other)));
            }
        }
    }
    let ahead = relief.value()? - skin.value()?;
    let axis = ahead.iamax();
    let across = ahead[3 - axis - up.axis()];
    let clear = ahead[axis].abs() >= CLEAR.max(STRAIGHT * across.abs());
    clear.then(|| Face::along(axis, ahead[axis] > 0.0))
}

/// How low the head reaches, and its middle.
fn head(body: &Surface, up: Up) -> Option<(f64, Vector3<f64>)> {
    let mut vertices = body.vertices.clone();
    vertices.sort_by(|a, b| b[up.axis()].total_cmp(&a[up.axis()]));
    let (top, bottom) = (vertices.first()?[up.axis()], vertices.last()?[up.axis()]);
    let (mut least, mut most) = (vertices[0], vertices[0]);
    for vertex in &vertices {
        (least, most) = (least.inf(vertex), most.sup(vertex));
        let mut size = most - least;
        let height = size[up.axis()];
        size[up.axis()] = 0.0;
        if height >= size.amax().max(LEAST_HEAD * (top - bottom)) {
            break;
        }
    }
    Some((least[up.axis()], (least + most) / 2.0))
}

#[cfg(test)]
mod tests {
    use superhelix::io::obj_mesh;

    use super::*;

    const HEADS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms");

    fn turned(body: &Surface, turn: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Surface {
        Surface { vertices: body.vertices.iter().map(|vertex| turn(*vertex)).collect(), triangles: body.triangles.clone() }
    }

    #[test]
    fn heads_face_where_their_faces_are() {
        for (name, face, behind) in [
            ("sintel_bust.obj", Face::PlusZ, Face::MinusZ),
            ("amd_ponytail_head.obj", Face::MinusZ, Face::PlusZ),
            ("amd_ratboy_head.obj", Face::PlusZ, Face::MinusZ),
            ("mpfb_head.obj", Face::PlusZ, Face::MinusZ),
        ] {
            let mesh = obj_mesh::read(format!("{HEADS}/{name}")).expect("a mesh");
            let head = Surface { vertices: mesh.vertices, triangles: mesh.triangles };
            assert_eq!(face_of(&head, Up::Y), Some(face), "{name}");
            let about = turned(&head, |place| Vector3::new(-place.x, place.y, -place.z) * 0.01);
            assert_eq!(face_of(&about, Up::Y), Some(behind), "{name}");
            // From z through y into −x, z up.
            let aside = turned(&head, |place| Vector3::new(-place.z, place.x, place.y));
            let expected = if face == Face::PlusZ { Face::MinusX } else { Face::PlusX };
            assert_eq!(face_of(&aside, Up::Z), Some(expected), "{name}");
        }
    }

    #[test]
    fn a_shape_without_a_face_gives_no_direction() {
        for body in [
            Surface::default(),
            Surface::ellipsoid(Vector3::new(0.08, 0.12, 0.1)),
            Surface::capsule(Vector3::zeros(), Vector3::y(), 0.2),
            Surface::cuboid(Vector3::new(0.1, 0.2, 0.3)),
        ] {
            assert_eq!(face_of(&body, Up::Y), None);
            assert_eq!(face_of(&body, Up::Z), None);
        }
    }
}
