//! Balls in a head's empty eye sockets, so that it does not look hollow.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use crate::surfaces::surface::Surface;

/// Corners that a border must have to say that it lies on a ball.
const LEAST_CORNERS: usize = 12;
/// How far corners may be off the ball, rms, as a share of its radius. Lids were modelled on it; borders of necks and sleeves were not.
const OFF: f64 = 0.01;
/// How far corners must be off a plane, rms, as a share of how far they are from their middle: a level border lies on any ball.
const OFF_LEVEL: f64 = 0.05;
/// The ball's radius over that of the border's: lids keep an edge.
const UNDER: f64 = 0.99;
/// Where rings of corners lie, from the pole (0) over the border (1) to behind the lids.
const RINGS: [f64; 6] = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2];

/// A surface with balls in those of its openings whose borders lie on one.
pub fn filled(surface: &Surface) -> Surface {
    let mut surface = surface.clone();
    for border in borders(&surface.triangles) {
        let corners: Vec<Vector3<f64>> = border.iter().map(|vertex| surface.vertices[*vertex as usize]).collect();
        if let Some((centre, radius)) = ball(&corners) {
            add_cap(&mut surface, &corners, centre, UNDER * radius);
        }
    }
    surface
}

/// The closed borders of a mesh: vertices in order.
fn borders(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let sides = || triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)]);
    let all: BTreeSet<(u32, u32)> = sides().collect();
    let mut following: BTreeMap<u32, u32> =
        sides().filter(|(from, to)| !all.contains(&(*to, *from))).map(|(from, to)| (to, from)).collect();
    let mut borders = Vec::new();
    while let Some((first, mut at)) = following.pop_first() {
        let mut border = vec![first];
        while at != first {
            border.push(at);
            let Some(next) = following.remove(&at) else { break };
            at = next;
        }
        if at == first {
            borders.push(border);
        }
    }
    borders
}

/// The centre and the radius of the ball on whose surface places lie, if there is one.
fn ball(places: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    if places.len() < LEAST_CORNERS {
        return None;
    }
    // About their middle, at size one: |p|² = 2 c·p + (r² − |c|²).
    let count = places.len() as f64;
    let middle = places.iter().sum::<Vector3<f64>>() / count;
    let size = (places.iter().map(|place| (place - middle).norm_squared()).sum::<f64>() / count).sqrt();
    let spread = places.iter().map(|place| (place - middle) * (place - middle).transpose()).sum::<Matrix3<f64>>() / count;
    let level = spread.symmetric_eigenvalues().min().max(0.0).sqrt() <= OFF_LEVEL * size;
    if size <= 0.0 || level {
        return None;
    }
    let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for place in places {
        let place = (place - middle) / size;
        let row = Vector4::new(2.0 * place.x, 2.0 * place.y, 2.0 * place.z, 1.0);
        matrix += row * row.transpose();
        right += row * place.norm_squared();
    }
    let found = matrix.try_inverse()? * right;
    let centre = found.xyz();
    let radius = (found.w + centre.norm_squared()).sqrt();
    let off = places.iter().map(|place| (((place - middle) / size - centre).norm() - radius).powi(2)).sum::<f64>() / count;
    (off.sqrt() <= OFF * radius).then(|| (middle + centre * size, radius * size))
}

/// Adds the part of a ball that shows in a border.
fn add_cap(surface: &mut Surface, border: &[Vector3<f64>], centre: Vector3<f64>, radius: f64) {
    let Some(pole) = border.iter().map(|place| (place - centre).normalize()).sum::<Vector3<f64>>().try_normalize(1e-6) else {
        return;
    };
    let first = surface.vertices.len() as u32;
    let around = border.len() as u32;
    surface.vertices.push(centre + pole * radius);
    for ring in RINGS {
        for place in border {
            let out = (place - centre).normalize();
            let axis = pole.cross(&out).try_normalize(0.0).unwrap_or_else(|| pole.cross(&Vector3::ith(pole.iamin(), 1.0)));
            let (sine, cosine) = (ring * pole.angle(&out)).sin_cos();
            surface.vertices.push(centre + (pole * cosine + axis.cross(&pole) * sine) * radius);
        }
    }
    let corner = |ring: u32, k: u32| first + 1 + ring * around + k % around;
    for k in 0..around {
        surface.triangles.push([first, corner(0, k), corner(0, k + 1)]);
        for ring in 1..RINGS.len() as u32 {
            let [a, b, c, d] = [corner(ring - 1, k), corner(ring, k), corner(ring, k + 1), corner(ring - 1, k + 1)];
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CENTRE: Vector3<f64> = Vector3::new(5.0, 6.0, 7.0);

    /// A sphere of radius 2, less what lies above a height that grows to the sides as the edges of lids do.
    fn open_ball(bend: f64) -> Surface {
        let mut surface = Surface::ellipsoid(Vector3::repeat(2.0));
        surface.vertices.iter_mut().for_each(|vertex| *vertex += CENTRE);
        let low = |vertex: &u32| {
            let place = surface.vertices[*vertex as usize] - CENTRE;
            place.z < 1.2 - bend * place.x * place.x
        };
        let triangles = surface.triangles.iter().filter(|triangle| triangle.iter().all(low)).copied().collect();
        Surface { triangles, ..surface }
    }

    #[test]
    fn a_socket_gets_the_ball_that_its_lids_lie_on() {
        let ragged = open_ball(0.3);
        let whole = filled(&ragged);
        assert!(whole.triangles.len() > ragged.triangles.len());
        for vertex in &whole.vertices[ragged.vertices.len()..] {
            let away = (vertex - CENTRE).norm();
            assert!((away - UNDER * 2.0).abs() < 0.03, "{vertex}");
        }
        let top = whole.vertices[ragged.vertices.len()..].iter().map(|vertex| vertex.z).fold(f64::NEG_INFINITY, f64::max);
        assert!(top > 8.9, "the ball bulges out of the opening: {top}");
    }

    #[test]
    fn other_openings_stay_open() {
        let level = open_ball(0.0);
        assert_eq!(filled(&level).triangles, level.triangles);
        // A closed box, and one without its lid.
        let mut cuboid = Surface::cuboid(Vector3::new(1.0, 2.0, 3.0));
        assert_eq!(filled(&cuboid).triangles, cuboid.triangles);
        cuboid.triangles.truncate(10);
        assert_eq!(filled(&cuboid).triangles, cuboid.triangles);
    }
}
