//! Nearest point of a triangle.

use nalgebra::Vector3;

/// Which part of a triangle is nearest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Its inside.
    Face,
    /// The edge from vertex i to the next.
    Edge(u8),
    /// A vertex.
    Vertex(u8),
}

/// Weights of the corners `a`, `b`, `c` in the nearest point to `p`, and which part it lies on (Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.5). No tolerances, so that triangles may be of any size. A triangle that has lost its area
/// (while a mesh deforms) gives the nearest point of an edge or a corner.
#[inline]
pub(super) fn closest(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>, p: &Vector3<f64>) -> ([f64; 3], Part) {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ([1.0, 0.0, 0.0], Part::Vertex(0));
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return ([0.0, 1.0, 0.0], Part::Vertex(1));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return ([0.0, 0.0, 1.0], Part::Vertex(2));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3 {
        let v = d1 / (d1 - d3);
        return ([1.0 - v, v, 0.0], Part::Edge(0));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6 {
        let w = d2 / (d2 - d6);
        return ([1.0 - w, 0.0, w], Part::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 && d4 - d3 + d5 - d6 > 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return ([0.0, 1.0 - w, w], Part::Edge(1));
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        return ([1.0, 0.0, 0.0], Part::Vertex(0));
    }
    let below = 1.0 / sum;
    let (v, w) = (vb * below, vc * below);
    ([1.0 - v - w, v, w], Part::Face)
}
