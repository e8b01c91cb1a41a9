//! The region that guides' roots stand in: how far they are apart, how near other places are to them, and places among them where no scalp
//! is known.

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::point_tree::PointTree;
use crate::math::random::Seeded;

/// Nearest roots from which a triangle's corners are taken, the root itself among them.
const NEIGHBOURS: usize = 7;

/// Guides' roots, found by nearness. They do not change: any threads may use them at the same time.
#[derive(Debug, Clone)]
pub struct GuideRoots {
    roots: Vec<Vector3<f64>>,
    tree: PointTree,
}

impl GuideRoots {
    /// From places, m.
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

    /// The distance within which nine tenths of the roots have another beside them, those at the same place left out, m; none where all
    /// are at one place.
    pub fn spacing(&self) -> Option<f64> {
        let mut found = Vec::new();
        let mut all: Vec<f64> = self.roots.iter().filter_map(|root| self.beside(root, &mut found)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() * 9 / 10).copied()
    }

    /// The distance of the nearest root that is elsewhere.
    fn beside(&self, root: &Vector3<f64>, found: &mut Vec<(f64, u32)>) -> Option<f64> {
        // The nearest is the root itself; more of them only where roots are doubled.
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

    /// How much of a place belongs to the region: 1 up to the distance `within` (m) from the nearest root, from there on linearly less, 0
    /// from twice the distance on. A density for [`Scalp::scatter`](super::scalp::Scalp::scatter), whose mesh may be coarse.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`within`) unless it is above zero.
    pub fn nearness(&self, places: &[Vector3<f64>], within: f64) -> Result<Vec<f64>> {
        check_positive(|| "within".into(), within)?;
        let mut found = Vec::new();
        let mut near = |place: &Vector3<f64>| {
            self.tree.nearest(*place, 1, &mut found);
            let distance = found.first().map_or(f64::INFINITY, |(squared, _)| squared.sqrt());
            (2.0 - distance / within).clamp(0.0, 1.0)
        };
        Ok(places.iter().map(&mut near).collect())
    }

    /// Random places in triangles of a root and two of the six nearest to it, each root in turn: where render strands may grow when no scalp
    /// is known. The same seed gives the same places.
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
            let pick = |share: f64| self.roots[near[(share * near.len() as f64) as usize] as usize] - root;
            let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
            root + pick(first) * a + pick(second) * b
        };
        (0..count).map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lattice of 1 cm in a plane, one of its roots doubled.
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
        assert!(lattice().nearness(&places, 0.0).is_err() && lattice().nearness(&places, f64::NAN).is_err());
    }

    #[test]
    fn places_among_the_roots_fill_the_region_and_nothing_else() {
        let roots = lattice();
        let places = roots.among(20_000, 1);
        assert!(places.iter().all(|p| (p.z - 0.3).abs() < 1e-12));
        // Within the lattice, every quarter of it with its share. The lattice's middle is 0.045; a place's share of a quarter varies by
        // 1/(2 sqrt(20000)) = 0.0035, and border roots reach inward only, alike on all sides.
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
