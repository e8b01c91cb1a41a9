//! Which way a head faces: by its relief, or, where that does not say, to where it has no hair.
//!
//! Files:
//!
//! - `relief.rs`: Which way a head faces by its mesh: where it has relief.

mod relief;

use nalgebra::Vector3;
use superhelix::hair::GuideRoots;

use super::view::Face;
use crate::shell::up::Up;
use crate::surfaces::surface::Surface;

/// Skin is bare that is farther from all roots than this, in the roots' distances from each other.
const BARE: f64 = 2.0;
/// But not nearer than this, in the roots' largest extent across: a root of each of a hundred thousand hairs may lie deeper in the skin than
/// it is from the next.
const NEAR: f64 = 0.08;
/// How far beside the middle of the roots the head's skin reaches, in their largest extent across: shoulders lie farther out.
const ASIDE: f64 = 0.75;
/// The mean direction of bare skin less that of covered skin must be as long as this for a head to say which way it faces.
const CLEAR: f64 = 0.4;

/// The axis along which a head with these roots faces; none where that is not clear.
pub fn face_of(roots: &[Vector3<f64>], body: &Surface, up: Up) -> Option<Face> {
    relief::face_of(body, up).or_else(|| bare_side(roots, body, up))
}

/// The axis that is nearest to where the head between its lowest and its highest root is bare; none where that is not clear.
fn bare_side(roots: &[Vector3<f64>], body: &Surface, up: Up) -> Option<Face> {
    let guides = GuideRoots::new(roots.to_vec()).ok()?;
    let low = roots.iter().copied().reduce(|low, root| low.inf(&root))?;
    let high = roots.iter().copied().reduce(|high, root| high.sup(&root))?;
    let level = |vector: Vector3<f64>| {
        let mut vector = vector;
        vector[up.axis()] = 0.0;
        vector
    };
    let across = level(high - low).amax();
    let (within, reach) = ((BARE * guides.spacing()?).max(NEAR * across), ASIDE * across);
    let middle = (low + high) / 2.0;
    let between = |vertex: &Vector3<f64>| vertex[up.axis()] > low[up.axis()] && vertex[up.axis()] < high[up.axis()];
    let skin: Vec<Vector3<f64>> =
        body.vertices.iter().filter(|vertex| between(vertex) && level(*vertex - middle).norm() < reach).copied().collect();
    let least = skin.iter().copied().reduce(|low, vertex| low.inf(&vertex))?;
    let most = skin.iter().copied().reduce(|high, vertex| high.sup(&vertex))?;
    let centre = (least + most) / 2.0;
    // `nearness` is 0 from twice its distance on.
    let nearness = guides.nearness(&skin, within / 2.0).ok()?;
    let (mut sums, mut counts) = ([Vector3::zeros(); 2], [0.0; 2]);
    for (vertex, near) in skin.iter().zip(nearness) {
        let side = usize::from(near > 0.0);
        sums[side] += level(vertex - centre).try_normalize(0.0).unwrap_or_default();
        counts[side] += 1.0;
    }
    if counts.contains(&0.0) {
        return None;
    }
    let ahead = sums[0] / counts[0] - sums[1] / counts[1];
    let axis = ahead.iamax();
    (ahead[axis].abs() >= CLEAR).then(|| Face::along(axis, ahead[axis] > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots on the upper half of a ball, but not where it faces.
    fn roots(ahead: Vector3<f64>, up: Vector3<f64>) -> Vec<Vector3<f64>> {
        let ball = Surface::ellipsoid(Vector3::repeat(0.1));
        ball.vertices.into_iter().filter(|place| place.dot(&up) > -0.03 && place.dot(&ahead) < 0.05).step_by(3).collect()
    }

    #[test]
    fn a_head_faces_where_it_is_bare() {
        let head = Surface::ellipsoid(Vector3::repeat(0.1));
        for (up, vertical, ways) in [
            (Up::Y, Vector3::y(), [(Vector3::z(), Face::PlusZ), (-Vector3::z(), Face::MinusZ), (Vector3::x(), Face::PlusX)]),
            (Up::Z, Vector3::z(), [(Vector3::y(), Face::PlusY), (-Vector3::y(), Face::MinusY), (-Vector3::x(), Face::MinusX)]),
        ] {
            for (ahead, face) in ways {
                assert_eq!(face_of(&roots(ahead, vertical), &head, up), Some(face));
            }
        }
    }

    #[test]
    fn fur_all_round_gives_no_direction() {
        let head = Surface::ellipsoid(Vector3::repeat(0.1));
        assert_eq!(face_of(&roots(Vector3::zeros(), Vector3::y()), &head, Up::Y), None);
        assert_eq!(face_of(&[], &head, Up::Y), None);
        assert_eq!(face_of(&[Vector3::zeros()], &head, Up::Y), None);
    }
}
