//! The region of the guides' roots: their spacing, the distance of other places from them, and random places among them where no
//! scalp is known.

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::point_tree::PointTree;
use crate::math::random::Seeded;

/// Nearest roots, including the root itself, from which a triangle's corners are chosen.
const NEIGHBOURS: usize = 7;

/// Nearest roots whose directions decide whether a place is among them, and their largest distance that counts, relative to their
/// spacing.
const AROUND: usize = 8;
const REACH: f64 = 2.5;
/// A place is among roots if the mean of their directions is shorter than the first limit, and beside them if it is longer than
/// the second.
const AMONG: f64 = 0.5;
const BESIDE: f64 = 0.65;

/// 1 up to `from`, 0 from `to` on, linear in between.
fn fading(value: f64, from: f64, to: f64) -> f64 {
    ((to - value) / (to - from)).clamp(0.0, 1.0)
}

/// Guides' roots with nearest-neighbour queries. Immutable: any threads may use them at the same time.
///
/// ```
/// use superhelix::hair::GuideRoots;
/// use superhelix::nalgebra::Vector3;
///
/// let roots = (0..25).map(|k| Vector3::new(0.01 * f64::from(k % 5), 0.01 * f64::from(k / 5), 0.0)).collect();
/// let roots = GuideRoots::new(roots)?;
/// assert!((roots.spacing().expect("more than one") - 0.01).abs() < 1e-9);
/// assert_eq!(roots.among(100, 3).len(), 100);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct GuideRoots {
    roots: Vec<Vector3<f64>>,
    tree: PointTree,
}

impl PartialEq for GuideRoots {
    fn eq(&self, other: &Self) -> bool {
        self.roots == other.roots
    }
}

impl GuideRoots {
    /// From positions, m.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`roots`) for none, or numbers that are not finite.
    pub fn new(roots: Vec<Vector3<f64>>) -> Result<Self> {
        if roots.is_empty() {
            return Err(Error::invalid("roots (count)", 0, "at least one"));
        }
        for (index, root) in roots.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("roots[{index}][{axis}]"), root[axis])?;
            }
        }
        Ok(Self { tree: PointTree::new(&roots), roots })
    }

    /// The distance within which nine tenths of the roots have another beside them, not counting those at the same place, m;
    /// `None` if all are at one place.
    pub fn spacing(&self) -> Option<f64> {
        let mut found = Vec::new();
        let mut all: Vec<f64> = self.roots.iter().filter_map(|root| self.beside(root, &mut found)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() * 9 / 10).copied()
    }

    /// The distance to the nearest root at a different place.
    fn beside(&self, root: &Vector3<f64>, found: &mut Vec<(f64, u32)>) -> Option<f64> {
        // The nearest is the root itself; more of them only where roots coincide.
        let mut count = 2;
        loop {
            self.tree.nearest(*root, count, found);
            if let Some((squared, _)) = found.iter().find(|(squared, _)| *squared > 0.0) {
                return Some(squared.sqrt());
            }
            if count >= self.roots.len() {
                return None;
            }
            count *= 4;
        }
    }

    /// How much each place belongs to the region: 1 up to the distance `within` (m) from the nearest root, then falling linearly
    /// to 0 at twice the distance. As densities of vertices for [`Scalp::scatter`](crate::groom::scalp::Scalp::scatter) they are as
    /// coarse as the mesh; [`Density::Roots`](crate::groom::scalp::Density::Roots) is not.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`within`) unless it is above zero.
    pub fn nearness(&self, places: &[Vector3<f64>], within: f64) -> Result<Vec<f64>> {
        check_positive(|| "within".into(), within)?;
        let mut found = Vec::new();
        let mut near = |place: &Vector3<f64>| {
            self.tree.nearest(*place, 1, &mut found);
            let distance = found.first().map_or(f64::INFINITY, |(squared, _)| squared.sqrt());
            fading(distance / within, 1.0, 2.0)
        };
        Ok(places.iter().map(&mut near).collect())
    }

    /// How close a place is to the roots: 1 up to three quarters of the distance `within` (m) from the nearest, then falling
    /// linearly to 0 at that distance.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`within`) unless it is above zero.
    pub fn near(&self, place: Vector3<f64>, within: f64) -> Result<f64> {
        check_positive(|| "within".into(), within)?;
        let mut nearest = Vec::new();
        self.tree.nearest(place, 1, &mut nearest);
        let distance = nearest.first().map_or(f64::INFINITY, |(squared, _)| squared.sqrt());
        Ok(fading(distance / within, 0.75, 1.0))
    }

    /// How far the roots cover a place, by their spacing (`spacing`, m). Among the roots: 1 up to one spacing from the nearest, 0
    /// from a quarter farther on. Beside them: 1 up to three tenths of the spacing, 0 from six tenths on. So hair grows among the
    /// guides, not on faces, ears and necks beside them.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`spacing`) unless it is above zero.
    pub fn cover(&self, place: Vector3<f64>, spacing: f64) -> Result<f64> {
        check_positive(|| "spacing".into(), spacing)?;
        let mut found = Vec::new();
        self.tree.nearest(place, AROUND, &mut found);
        let away = found.first().map_or(f64::INFINITY, |(squared, _)| squared.sqrt()) / spacing;
        // Directions to roots on all sides cancel; those to the roots of a straight border have a mean of 2/π, and more farther
        // out.
        let directions = found
            .iter()
            .map(|(_, root)| self.roots[*root as usize] - place)
            .filter(|direction| direction.norm() <= REACH * spacing);
        let (sum, count) = directions.fold((Vector3::zeros(), 0.0), |(sum, count), direction| {
            (sum + direction.try_normalize(0.0).unwrap_or_default(), count + 1.0)
        });
        let lopsided = if count > 1.0 { sum.norm() / count } else { 1.0 };
        let among = fading(lopsided, AMONG, BESIDE) * fading(away, 1.0, 1.25);
        Ok(among.max(fading(away, 0.3, 0.6)))
    }

    /// Random places in triangles of a root and two of the six nearest to it, taking the roots in turn: where render strands may
    /// grow if no scalp is known. The same seed gives the same places.
    pub fn among(&self, count: usize, seed: u64) -> Vec<Vector3<f64>> {
        let numbers = [12, 13, 14, 15].map(|purpose| Seeded::new(seed, purpose));
        let mut found = Vec::new();
        let neighbours: Vec<Vec<u32>> = self
            .roots
            .iter()
            .take(count)
            .map(|root| {
                self.tree.nearest(*root, NEIGHBOURS, &mut found);
                found.iter().map(|(_, index)| *index).collect()
            })
            .collect();
        let place = |index: usize| {
            let (root, near) = (self.roots[index % self.roots.len()], &neighbours[index % self.roots.len()]);
            let [first, second, a, b] = numbers.map(|numbers| numbers.unit(index as u64));
            let pick = |fraction: f64| self.roots[near[(fraction * near.len() as f64) as usize] as usize] - root;
            let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
            root + pick(first) * a + pick(second) * b
        };
        (0..count).map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lattice of 1 cm in a plane, with one root doubled.
    fn lattice() -> GuideRoots {
        let mut roots: Vec<_> = (0..100).map(|k| Vector3::new(0.01 * f64::from(k % 10), 0.01 * f64::from(k / 10), 0.3)).collect();
        roots.push(roots[44]);
        GuideRoots::new(roots).expect("finite roots")
    }

    #[test]
    fn the_spacing_is_that_of_the_lattice() {
        assert!((lattice().spacing().expect("a spacing") - 0.01).abs() < 1e-15);
        let one = GuideRoots::new(vec![Vector3::x(); 9]).expect("finite roots");
        assert_eq!(one.spacing(), None);
        assert_eq!(one.among(5, 3), [Vector3::x(); 5]);
    }

    #[test]
    fn nearness_falls_from_one_to_nothing() {
        let places = [0.0, 0.01, 0.015, 0.02, 0.5].map(|away| Vector3::new(-away, 0.0, 0.3));
        let near = lattice().nearness(&places, 0.01).expect("a distance");
        for (value, expected) in near.iter().zip([1.0, 1.0, 0.5, 0.0, 0.0]) {
            assert!((value - expected).abs() < 1e-12, "{near:?}");
        }
        for (away, expected) in [(0.0, 1.0), (0.015, 1.0), (0.0175, 0.5), (0.02, 0.0), (0.5, 0.0)] {
            let near = lattice().near(Vector3::new(-away, 0.0, 0.3), 0.02).expect("a distance");
            assert!((near - expected).abs() < 1e-12, "{away}: {near}");
        }
        for distance in [0.0, f64::NAN] {
            assert!(lattice().near(Vector3::x(), distance).is_err() && lattice().cover(Vector3::x(), distance).is_err());
        }
    }

    #[test]
    fn roots_cover_places_among_them_and_a_hem() {
        // A lattice of 1 cm with a hole of 4 cm.
        let roots: Vec<_> = (0..400)
            .map(|k| Vector3::new(0.01 * f64::from(k % 20), 0.01 * f64::from(k / 20), 0.3))
            .filter(|root| (root - Vector3::new(0.1, 0.1, 0.3)).norm() > 0.02)
            .collect();
        let roots = GuideRoots::new(roots).expect("finite roots");
        let spacing = roots.spacing().expect("a spacing");
        let cover = |x: f64, y: f64| roots.cover(Vector3::new(x, y, 0.3), spacing).expect("a spacing");
        // Full cover everywhere among them.
        for k in 0..400 {
            let (x, y) = (0.03 + 0.04 * f64::from(k % 20) / 20.0, 0.03 + 0.04 * f64::from(k / 20) / 20.0);
            assert_eq!(cover(x, y), 1.0, "{x} {y}");
        }
        // Bare in the middle of the hole, and more than six tenths of a spacing outside the border.
        assert_eq!(cover(0.1, 0.1), 0.0);
        for away in [0.0065, 0.01, 0.05] {
            assert_eq!(cover(-away, 0.1), 0.0, "{away}");
        }
        assert!(cover(-0.0025, 0.1) == 1.0 && cover(-0.0045, 0.1) > 0.0);
    }

    #[test]
    fn places_among_the_roots_fill_the_region_and_nothing_else() {
        let roots = lattice();
        let places = roots.among(20_000, 1);
        assert!(places.iter().all(|p| (p.z - 0.3).abs() < 1e-12));
        // Inside the lattice, each quarter with its fraction. The lattice's middle is 0.045; the fraction of a quarter varies by
        // 1/(2 sqrt(20000)) = 0.0035, and border roots reach inward only, the same on all sides.
        let mut quarters = [0_usize; 4];
        for p in &places {
            assert!((-1e-12..=0.09 + 1e-12).contains(&p.x) && (-1e-12..=0.09 + 1e-12).contains(&p.y), "{p}");
            quarters[usize::from(p.x > 0.045) + 2 * usize::from(p.y > 0.045)] += 1;
        }
        assert!(quarters.iter().all(|count| (count.abs_diff(5000)) < 400), "{quarters:?}");
        assert_eq!(places[..100], roots.among(100, 1)[..]);
        assert_ne!(places[..100], roots.among(100, 2)[..]);
    }

    #[test]
    fn bad_roots_are_named() {
        let text = |roots: Vec<Vector3<f64>>| GuideRoots::new(roots).expect_err("bad roots").to_string();
        assert!(text(vec![]).contains("roots (count)"));
        assert!(text(vec![Vector3::zeros(), Vector3::new(0.0, f64::NAN, 0.0)]).contains("roots[1][1]"));
    }
}
