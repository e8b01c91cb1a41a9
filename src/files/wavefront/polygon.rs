//! Triangulation of polygons in space, ear by ear (Meisters 1975), as seen along the normal of their area (Newell).

use nalgebra::Vector3;

/// A vertex that a face names twice. Sorts the corners.
pub(in crate::files) fn named_twice(corners: &mut [u32]) -> Option<u32> {
    corners.sort_unstable();
    corners.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

/// Cuts a polygon of at least three corners into two triangles fewer than it has corners, with its winding, onto `out`. Takes the
/// ear with the shortest cut first. False if no ear is left: the polygon crosses itself or has no area, and `out` may have some
/// triangles. A triangle is taken as it is.
pub(in crate::files) fn cut(vertices: &[Vector3<f64>], corners: &[u32], out: &mut Vec<[u32; 3]>) -> bool {
    if let [a, b, c] = *corners {
        out.push([a, b, c]);
        return true;
    }
    let Some(flat) = flatten(vertices, corners) else { return false };
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut cuts: Vec<f64> = (0..left.len()).map(|at| cut_length(&flat, &left, at)).collect();
    while left.len() > 3 {
        // The first of the shortest; infinity marks a corner that is no ear.
        let mut at = 0;
        for candidate in 1..left.len() {
            if cuts[candidate] < cuts[at] {
                at = candidate;
            }
        }
        if cuts[at] == f64::INFINITY {
            return false;
        }
        let [before, after] = beside(left.len(), at);
        out.push([left[before], left[at], left[after]].map(|corner| corners[corner]));
        left.remove(at);
        cuts.remove(at);
        // A cut ear changes only its neighbours: other obstacles to a cut remain.
        let count = left.len();
        for neighbour in [(at + count - 1) % count, at % count] {
            cuts[neighbour] = cut_length(&flat, &left, neighbour);
        }
    }
    out.push([left[0], left[1], left[2]].map(|corner| corners[corner]));
    turn(&flat, left[0], left[1], left[2]) > 0.0
}

/// The corners in the plane in which their polygon's area is largest, anticlockwise; `None` if it has no area.
fn flatten(vertices: &[Vector3<f64>], corners: &[u32]) -> Option<Vec<[f64; 2]>> {
    let at = |index: usize| vertices[corners[index % corners.len()] as usize];
    // Relative to a corner and to the polygon's size: large coordinates keep their digits.
    let first = at(0);
    let size = (1..corners.len()).map(|index| (at(index) - first).amax()).fold(0.0, f64::max);
    let of = |index: usize| (at(index) - first) / size;
    let normal: Vector3<f64> = (1..corners.len() - 1).map(|index| of(index).cross(&of(index + 1))).sum();
    let normal = normal.try_normalize(1e-12)?;
    let right = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let up = normal.cross(&right);
    Some((0..corners.len()).map(|index| [of(index).dot(&right), of(index).dot(&up)]).collect())
}

fn beside(count: usize, at: usize) -> [usize; 2] {
    [(at + count - 1) % count, (at + 1) % count]
}

/// Twice the area of a triangle, above zero if it is anticlockwise.
fn turn(flat: &[[f64; 2]], a: usize, b: usize, c: usize) -> f64 {
    let ([ax, ay], [bx, by], [cx, cy]) = (flat[a], flat[b], flat[c]);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// The squared length of the cut that removes a corner; infinite if the corner is no ear.
fn cut_length(flat: &[[f64; 2]], left: &[usize], at: usize) -> f64 {
    let [before, after] = beside(left.len(), at);
    let (a, b, c) = (left[before], left[at], left[after]);
    if turn(flat, a, b, c) <= 0.0 {
        return f64::INFINITY;
    }
    let inside = |p: usize| {
        ![a, b, c].contains(&p) && turn(flat, a, b, p) >= 0.0 && turn(flat, b, c, p) >= 0.0 && turn(flat, c, a, p) >= 0.0
    };
    if left.iter().any(|p| inside(*p)) {
        return f64::INFINITY;
    }
    (flat[a][0] - flat[c][0]).powi(2) + (flat[a][1] - flat[c][1]).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(vertices: &[Vector3<f64>], triangles: &[[u32; 3]]) -> (f64, f64) {
        let mut sum = Vector3::zeros();
        let mut absolute = 0.0;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| vertices[corner as usize]);
            let area = (b - a).cross(&(c - a)) / 2.0;
            sum += area;
            absolute += area.norm();
        }
        (sum.norm(), absolute)
    }

    #[test]
    fn polygons_are_covered_once() {
        // A star, a comb with a collinear spine, a spiral; in an oblique plane.
        let star: Vec<[f64; 2]> = (0..14)
            .map(|index| {
                let (angle, radius) = (f64::from(index) * std::f64::consts::TAU / 14.0, if index % 2 == 0 { 1.0 } else { 0.2 });
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        let mut comb = vec![[0.0, 0.0], [8.0, 0.0]];
        for tooth in (0..4).rev() {
            let x = 2.0 * f64::from(tooth);
            comb.extend([[x + 2.0, 1.0], [x + 1.5, 3.0], [x + 1.0, 1.0]]);
        }
        comb.push([0.0, 1.0]);
        let spiral: Vec<[f64; 2]> = (0..60)
            .map(|index| {
                let (turn, radius) = if index < 30 { (f64::from(index), 1.0) } else { (f64::from(59 - index), 0.7) };
                let radius = radius + 0.1 * turn;
                [radius * (0.35 * turn).cos(), radius * (0.35 * turn).sin()]
            })
            .collect();
        for polygon in [star, comb, spiral] {
            let (right, up) = (Vector3::new(0.6, 0.8, 0.0), Vector3::new(0.0, 0.0, 1.0));
            let vertices: Vec<Vector3<f64>> =
                polygon.iter().map(|[x, y]| Vector3::new(1e3, -2e3, 5.0) + 1e-2 * (right * *x + up * *y)).collect();
            let shoelace: f64 = (0..polygon.len())
                .map(|index| {
                    let ([ax, ay], [bx, by]) = (polygon[index], polygon[(index + 1) % polygon.len()]);
                    (ax * by - bx * ay) / 2.0
                })
                .sum();
            for forward in [true, false] {
                let mut corners: Vec<u32> = (0..polygon.len() as u32).collect();
                if !forward {
                    corners.reverse();
                }
                let mut triangles = Vec::new();
                assert!(cut(&vertices, &corners, &mut triangles));
                assert_eq!(triangles.len(), polygon.len() - 2);
                let (sum, absolute) = area(&vertices, &triangles);
                // Equal to the polygon's, and no triangle wound against the others: none overlap.
                assert!((sum - 1e-4 * shoelace.abs()).abs() < 1e-9 * sum.max(1e-4), "{sum} {shoelace}");
                assert!((sum - absolute).abs() < 1e-9 * sum);
            }
        }
    }

    #[test]
    fn invalid_polygons_are_reported() {
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        assert!(!cut(&bow, &[0, 1, 2, 3], &mut Vec::new()));
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| Vector3::new(x, 0.0, 0.0));
        assert!(!cut(&line, &[0, 1, 2, 3], &mut Vec::new()));
        assert!(!cut(&[Vector3::zeros(); 4], &[0, 1, 2, 3], &mut Vec::new()));
        assert_eq!(named_twice(&mut [4, 2, 4]), Some(4));
        assert_eq!(named_twice(&mut [4, 2, 3]), None);
    }
}
