//! What a search of a strand and a body adds to its contacts, and the side of the body on which a strand is kept that ran into it.

use super::Search;
use crate::contact::contact_point::{ContactPoint, Partner, StrandPoint};
use crate::contact::narrow_phase::descent::Sample;
use crate::contact::narrow_phase::element_path::ElementPath;
use crate::contact::narrow_phase::ground::{Ground, Node};
use crate::contact::narrow_phase::undetected_overlap;
use crate::contact::shape::{Ball, Surface};

impl Search<'_, '_> {
    /// Adds overlap between two nodes with triangles that have no contact there.
    pub(super) fn add_undetected_overlaps(
        &mut self,
        ground: &Ground,
        path: &ElementPath,
        nodes: &[Node; 2],
        close: &[Ball],
        from: usize,
    ) {
        for ball in close {
            // A triangle has one minimum.
            let of_it =
                |contact: &ContactPoint| matches!(contact.partner, Partner::Body { feature, .. } if feature == ball.triangle);
            if self.out[from..].iter().any(|contact| of_it(contact) && contact.point.s >= nodes[0].s) {
                continue;
            }
            if let Some(found) = undetected_overlap::find(ground, path, nodes, ball, self.thickness) {
                self.scratch.more.push(found);
            }
        }
    }

    /// Adds the deepest points beside nodes that are inside a mesh, where no contact is.
    pub(super) fn add_points_below(&mut self, ground: &Ground, path: &ElementPath, nodes: &[Node], from: usize) {
        for (k, node) in nodes.iter().enumerate() {
            let Some(from_node) = node.sample.filter(|sample| sample.value < 0.0) else { continue };
            let left = k.checked_sub(1).map(|left| &nodes[left]);
            let Some(towards) = (if from_node.slope < 0.0 { nodes.get(k + 1) } else { left }) else { continue };
            let (low, high, gap) = (node.s.min(towards.s), node.s.max(towards.s), from_node.value - self.thickness);
            let is_deeper = |contact: &ContactPoint| (low..=high).contains(&contact.point.s) && contact.gap < gap;
            if !self.out[from..].iter().any(is_deeper) {
                self.scratch.more.extend(undetected_overlap::deepest(ground, path, from_node, towards));
            }
        }
    }

    pub(super) fn add(&mut self, index: usize, sample: &Sample<Surface>) {
        self.push(index, sample.s, &sample.found, sample.value - self.thickness);
    }

    pub(super) fn push(&mut self, index: usize, s: f64, surface: &Surface, gap: f64) {
        self.out.push(ContactPoint {
            point: StrandPoint { strand: self.path.index, element: index as u32, s },
            partner: Partner::Body { body: self.body.index, feature: surface.feature },
            normal: self.body.axes_end * surface.normal,
            gap,
            carried: self.body.carried(surface),
        });
    }

    /// Keeps a piece of strand that ran into the body on the side from which it came.
    #[allow(clippy::too_many_arguments)] // Each is another thing, and all are needed.
    pub(super) fn keep_side(
        &mut self,
        index: usize,
        path: &ElementPath,
        piece: f64,
        from: usize,
        s: f64,
        hit: &Surface,
        ground: &Ground,
    ) {
        /// Cosine of the angle up to which the nearest surface's normal counts as that of the side that was hit.
        const ALIKE: f64 = 0.7;
        let (now, _) = path.now.at(s);
        let gap = hit.normal.dot(&(now - hit.point)) - self.thickness;
        if gap >= self.within {
            return;
        }
        // It is still on its side where the nearest surface is much like the one that was hit; outside, even where a corner
        // lies between: hair that is drawn round a chin cuts through it on the straight path of a step. Its depth is then that
        // of the nearest surface, not that of the plane at the hit.
        let nearest = ground.ask(|| path.start.at(s).0, now, None).filter(|nearest| {
            let same = nearest.normal.dot(&hit.normal);
            same >= ALIKE || same > 0.0 && nearest.distance >= self.thickness
        });
        let least = if nearest.is_some() { 0.0 } else { ALIKE };
        let normal = self.body.axes_end * hit.normal;
        let mut kept = from;
        let mut deepest: Option<ContactPoint> = None;
        for contact in from..self.out.len() {
            let other = self.out[contact];
            if (other.point.s - s).abs() > piece || other.normal.dot(&normal) >= least {
                self.out[kept] = other;
                kept += 1;
            } else if deepest.is_none_or(|deepest| other.gap < deepest.gap) {
                deepest = Some(other);
            }
        }
        self.out.truncate(kept);
        match nearest {
            Some(nearest) => {
                let gap = nearest.distance - self.thickness;
                let is_beside = |out: &[ContactPoint], gap: f64| {
                    out.iter().any(|contact| (contact.point.s - s).abs() <= piece && contact.gap <= 0.5 * gap)
                };
                // Outside the only contacts are near ones.
                if gap < 0.0 && !is_beside(&self.out[from..], gap) {
                    self.push(index, s, &nearest, gap);
                }
                // What is deeper in the body, up to its far side, came with it: the plane at the hit separates it.
                if let Some(behind) =
                    deepest.filter(|behind| behind.gap < gap.min(0.0) && !is_beside(&self.out[from..], behind.gap))
                {
                    let gap = hit.normal.dot(&(path.now.at(behind.point.s).0 - hit.point)) - self.thickness;
                    if gap < 0.0 {
                        self.push(index, behind.point.s, hit, gap);
                    }
                }
            }
            None => self.push(index, s, hit, gap),
        }
    }
}
