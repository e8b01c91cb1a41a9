//! Overlap of a piece of a strand with a mesh between the sampled points, which sampling leaves undetected.
//!
//! Along a chord the distance to one triangle is convex, along an arc of curvature κ convex but for κ: with g(s) = d(s) − κ/2
//! (s−a)(b−s) its tangents at the ends bound it from below. So no triangle with an overlap of more than the tolerance goes
//! undetected, however short the path over it. The same bound says where a piece near a convex shape has to be halved.

use nalgebra::Vector3;

use super::across_edge::across_edge;
use super::descent::{self, Sample};
use super::element_path::ElementPath;
use super::ground::{Ground, Node};
use crate::contact::shape::{Ball, Surface};

/// A smaller overlap is left, m: half of what a step may leave.
pub(in crate::contact) const TOLERANCE: f64 = 5e-6;

/// The point of the piece between two nodes that is nearest to a triangle, or the deepest beside it, if the surface is closer than `thickness` there.
/// Pieces whose ends are inside are left alone: for these the side from which they come decides.
pub(in crate::contact) fn find(
    ground: &Ground,
    path: &ElementPath,
    nodes: &[Node; 2],
    ball: &Ball,
    thickness: f64,
) -> Option<Sample<Surface>> {
    let triangle = ground.mesh?.flat(ball.triangle);
    let bar = thickness - TOLERANCE;
    let [left, right] = nodes;
    let value = |node: &Node| node.sample.map_or(ground.reach, |sample| sample.value);
    let (length, low) = (right.s - left.s, value(left).min(value(right)));
    if bar <= 0.0 || low < 0.0 || 0.5 * (value(left) + value(right) - length) >= bar {
        return None;
    }
    let bend = path.now.bend();
    let sagitta = 0.125 * bend * length * length;
    let heights = [triangle.height(&left.now), triangle.height(&right.now)];
    if heights[0] * heights[1] > 0.0 && heights[0].abs().min(heights[1].abs()) - sagitta >= bar {
        return None;
    }
    let alone = |s: f64, at: &Vector3<f64>, tangent: &Vector3<f64>| {
        let out = triangle.offset_to(at);
        let value = out.norm();
        Sample { s, value, slope: if value > 0.0 { out.dot(tangent) / value } else { 0.0 }, found: () }
    };
    let (a, b) = (alone(left.s, &left.now, &left.tangent), alone(right.s, &right.now, &right.tangent));
    if !(a.slope < 0.0 && b.slope > 0.0) || lowest_possible(&a, &b, bend) >= bar {
        return None;
    }
    let nearest = descent::lowest(a, b, 0.5 * TOLERANCE, |s| {
        let (at, tangent) = path.now.at(s);
        Some(alone(s, &at, &tangent))
    });
    if nearest.value >= bar {
        return None;
    }
    let found = ground.sample_among(&ground.patch.near, path, nearest.s, None).filter(|found| found.value < bar)?;
    // Where the piece goes through the triangle it is deeper on its way to another.
    let towards = if found.slope < 0.0 { right } else { left };
    let deepest = deepest(ground, path, found, towards).filter(|deepest| deepest.value < found.value);
    Some(deepest.unwrap_or(found))
}

/// The minimum of the distance to which it falls from a sample towards a node. None where it falls all the way.
pub(in crate::contact) fn deepest(
    ground: &Ground,
    path: &ElementPath,
    from: Sample<Surface>,
    towards: &Node,
) -> Option<Sample<Surface>> {
    let ask = |s: f64| ground.sample_among(&ground.patch.near, path, s, None);
    let (mut found, around) = descent::fallen(from, towards.s, towards.sample, 0.5 * TOLERANCE, ask)?;
    if found.value < 0.0 {
        found.found = across_edge(&found, around, ask);
    }
    Some(found)
}

/// A bound from below between two places of a distance that is convex but for `bend`: d″ ≥ −κ, so that d lies above the parabola
/// of that curvature through either end. Both are concave, so that the higher is least where they meet, or at an end.
pub(in crate::contact) fn lowest_possible<T>(a: &Sample<T>, b: &Sample<T>, bend: f64) -> f64 {
    let span = b.s - a.s;
    let (falls, rises) = (a.slope - 0.5 * bend * span, b.slope + 0.5 * bend * span);
    let cut = ((a.value - b.value + rises * span) / (rises - falls)).clamp(0.0, span);
    let meet = (a.value + falls * cut).min(b.value - rises * (span - cut)) + 0.5 * bend * cut * (span - cut);
    meet.min(a.value.min(b.value))
}
