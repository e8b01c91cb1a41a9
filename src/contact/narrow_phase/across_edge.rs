//! A strand across an edge of a solid: the separating plane.

use super::descent::Sample;
use crate::contact::shape::Surface;

/// The surface at a minimum inside a solid. If the nearest faces change there, the strand lies across the edge between them,
/// and the separating plane goes through that edge across the strand: its normal is the one between theirs without a component
/// along the strand. A face's own normal would push the strand along itself, to which no strand yields.
pub(in crate::contact) fn across_edge(
    lowest: &Sample<Surface>,
    mut around: [Sample<Surface>; 2],
    ask: impl Fn(f64) -> Option<Sample<Surface>>,
) -> Surface {
    /// Faces that meet more sharply than twice the angle of this sine are two sides of something thin, not of an edge.
    const BLUNT: f64 = 0.3;
    /// Normals that turn by less along the strand are of one surface.
    const EDGE: f64 = 0.2;
    /// The faces are sampled inside, and no further from the edge than this, m.
    const BESIDE: f64 = 1e-5;
    let surface = lowest.found;
    if around[1].slope - around[0].slope < EDGE {
        return surface;
    }
    for (end, beside) in around.iter_mut().enumerate() {
        while beside.value >= 0.0 || (beside.s - lowest.s).abs() > BESIDE {
            match ask(lowest.s + 0.2 * (beside.s - lowest.s)) {
                Some(sample) if (sample.slope < 0.0) == (end == 0) && sample.s != lowest.s => *beside = sample,
                _ => return surface,
            }
        }
    }
    let [falling, rising] = around;
    let turn = rising.slope - falling.slope;
    if turn < EDGE {
        return surface;
    }
    let between = (falling.found.normal * rising.slope - rising.found.normal * falling.slope) / turn;
    let cosine = between.norm();
    if cosine < BLUNT {
        return surface;
    }
    let at = surface.point + surface.normal * surface.distance;
    let (normal, distance) = (between / cosine, surface.distance / cosine);
    Surface { point: at - normal * distance, normal, distance, ..surface }
}
