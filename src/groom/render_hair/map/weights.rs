//! Chooses the guides that a strand follows, and their weights.
//!
//! A guide's weight is (R − d)/(R d), where d is its root's distance and R that of the nearest root beyond the strand's guides
//! (Franke and Nielson 1980, after Shepard; they square it, which fits strands left out of real grooms less well). It is 0 where
//! the guide leaves the strand's guides, so that strands vary continuously over the scalp, and 1 at the guide's own root.
//!
//! The weights are then corrected to reproduce what is linear over the scalp (moving least squares, Lancaster and Salkauskas
//! 1981): a linear function of the position multiplies them, such that the weighted mean of the guides' roots is the strand's
//! root. What guides do alike, or in proportion to their positions, strands between them then do too.

use nalgebra::{Matrix3, Vector3};

use crate::error::{Error, Result};
use crate::groom::render_hair::settings::{MAX_GUIDES, RenderSettings};
use crate::math::point_tree::PointTree;

/// Candidates examined per wanted guide.
const CANDIDATES: usize = 4;

/// A direction with less than this fraction of the roots' spread counts as having none: across the scalp, and where only two
/// guides count.
const MIN_SPREAD: f64 = 0.03;
/// The lower bound on weights: it limits extrapolation beyond the guides.
const MIN_WEIGHT: f64 = -0.25;

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

    /// The guides of a strand with this root, nearest first, and their weights, which sum to 1.
    pub fn of(&self, root: Vector3<f64>, settings: &RenderSettings, found: &mut Vec<(f64, u32)>) -> Result<Followed> {
        let wanted = settings.guides_per_strand;
        self.tree.nearest(root, CANDIDATES * wanted + 1, found);
        let Some((_, first)) = found.first().copied() else {
            return Err(Error::invalid("guides", "empty", "at least one"));
        };
        found.retain(|(_, guide)| !self.part(first as usize, *guide as usize, settings));
        let count = found.len().min(wanted);
        let distance = |k: usize| found[k].0.sqrt();
        // Without a next one the border is where the farthest still counts.
        let border = if found.len() > wanted { distance(wanted) } else { 1.5 * distance(count - 1) };
        let mut followed = Followed { guides: [first; MAX_GUIDES], weights: [0.0; MAX_GUIDES], count };
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
            self.reproduce(root, &mut followed);
        } else {
            // On a guide's root, or at equal distances: the nearest alone.
            followed.weights = [0.0; MAX_GUIDES];
            followed.weights[0] = 1.0;
        }
        Ok(followed)
    }
}

impl Guides {
    /// Changes weights that sum to 1 such that the weighted mean of the guides' roots meets the strand's root, as far as limits
    /// permit.
    fn reproduce(&self, root: Vector3<f64>, followed: &mut Followed) {
        let of = |k: usize| self.roots[followed.guides[k] as usize];
        let count = followed.count;
        let middle: Vector3<f64> = (0..count).map(|k| of(k) * followed.weights[k]).sum();
        let mut spread = Matrix3::zeros();
        for k in 0..count {
            let away = of(k) - middle;
            spread += away * away.transpose() * followed.weights[k];
        }
        let size = spread.trace();
        if size <= 0.0 || size.is_nan() {
            return;
        }
        // Inverted at size one, since squares of small positions are lost; directions without spread stay (Tikhonov).
        let spread = spread / size;
        let Some(inverse) = (spread * spread + Matrix3::identity() * (MIN_SPREAD * MIN_SPREAD)).try_inverse() else { return };
        let slope = inverse * spread * (root - middle) / size;
        let changes: [f64; MAX_GUIDES] =
            std::array::from_fn(|k| if k < count { followed.weights[k] * slope.dot(&(of(k) - middle)) } else { 0.0 });
        let mut fraction: f64 = 1.0;
        for k in 0..count {
            if changes[k] < 0.0 {
                fraction = fraction.min((followed.weights[k] - MIN_WEIGHT) / -changes[k]);
            }
        }
        for k in 0..count {
            followed.weights[k] += fraction * changes[k];
        }
    }
}

/// The guides that a strand follows.
#[derive(Debug, Clone, Copy)]
pub(in crate::groom::render_hair) struct Followed {
    /// Those beyond `count` repeat the first.
    pub guides: [u32; MAX_GUIDES],
    pub weights: [f64; MAX_GUIDES],
    pub count: usize,
}
