//! Which guides a strand follows, and with what weights.
//!
//! A guide's weight is (R − d)/(R d), d its root's distance and R that of the nearest root that is no longer among the strand's guides
//! (Franke and Nielson 1980, after Shepard; they square it, which comes 3 to 5 % less close to strands left out of real grooms): it is 0
//! where the guide leaves the strand's guides, so that strands change without jumps over the scalp, and 1 at the guide's own root.

use nalgebra::Vector3;

use super::settings::{MOST_GUIDES, RenderSettings};
use crate::error::{Error, Result};
use crate::math::point_tree::PointTree;

/// Candidates that are looked at for each guide that is wanted.
const CANDIDATES: usize = 4;

/// Guides at binding.
pub(super) struct Guides {
    tree: PointTree,
    roots: Vec<Vector3<f64>>,
    tips: Vec<Vector3<f64>>,
    lengths: Vec<f64>,
}

impl Guides {
    pub fn new(points: &[Vector3<f64>], per_strand: usize) -> Self {
        let guides = || points.chunks(per_strand);
        let roots: Vec<_> = guides().map(|guide| guide[0]).collect();
        Self {
            tree: PointTree::new(&roots),
            tips: guides().map(|guide| guide[per_strand - 1]).collect(),
            lengths: guides().map(|guide| guide.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()).collect(),
            roots,
        }
    }

    /// Whether two guides part: their tips are too much farther from each other than their roots.
    fn part(&self, a: usize, b: usize, settings: &RenderSettings) -> bool {
        let farther = (self.tips[a] - self.tips[b]).norm() - (self.roots[a] - self.roots[b]).norm();
        farther > settings.max_tip_distance || farther > settings.max_tip_ratio * self.lengths[a].min(self.lengths[b])
    }

    /// The guides of a strand with that root, nearest first, and their weights, which sum to 1.
    pub fn of(&self, root: Vector3<f64>, settings: &RenderSettings, found: &mut Vec<(f64, u32)>) -> Result<Followed> {
        let wanted = settings.guides_per_strand;
        self.tree.nearest(root, CANDIDATES * wanted + 1, found);
        let Some((_, first)) = found.first().copied() else {
            return Err(Error::invalid("guides", "empty", "at least one"));
        };
        found.retain(|(_, guide)| !self.part(first as usize, *guide as usize, settings));
        let count = found.len().min(wanted);
        let distance = |k: usize| found[k].0.sqrt();
        // Without a next one the border is put where the farthest still counts.
        let border = if found.len() > wanted { distance(wanted) } else { 1.5 * distance(count - 1) };
        let mut followed = Followed { guides: [first; MOST_GUIDES], weights: [0.0; MOST_GUIDES], count };
        let mut sum = 0.0;
        for k in 0..count {
            followed.guides[k] = found[k].1;
            let away = distance(k);
            let nearness = if away < 1e-9 * border { f64::INFINITY } else { (border - away) / (border * away) };
            followed.weights[k] = nearness;
            sum += nearness;
        }
        if sum.is_finite() && sum > 0.0 {
            followed.weights[..count].iter_mut().for_each(|weight| *weight /= sum);
        } else {
            // On a guide's root, or all equally far: the nearest alone.
            followed.weights = [0.0; MOST_GUIDES];
            followed.weights[0] = 1.0;
        }
        Ok(followed)
    }
}

/// Whom a strand follows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Followed {
    /// Those beyond `count` repeat the first.
    pub guides: [u32; MOST_GUIDES],
    pub weights: [f64; MOST_GUIDES],
    pub count: usize,
}
