//! Places for the roots of render strands where no scalp is known: among those of the guides.

use nalgebra::Vector3;

/// Nearest roots from which a triangle's corners are taken.
const NEIGHBOURS: usize = 6;

/// A number in [0, 1) from a counter (SplitMix64).
fn unit(seed: u64, counter: u64) -> f64 {
    let mut z =
        seed.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Random places in triangles of a root and two of those near it, each root in turn.
pub fn roots_among(roots: &[Vector3<f64>], count: usize, seed: u64) -> Vec<Vector3<f64>> {
    let neighbours: Vec<Vec<usize>> = roots
        .iter()
        .map(|root| {
            let mut near: Vec<(f64, usize)> =
                roots.iter().enumerate().map(|(index, other)| ((other - root).norm_squared(), index)).collect();
            let last = NEIGHBOURS.min(near.len() - 1);
            near.select_nth_unstable_by(last, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            near.truncate(last + 1);
            near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            near.into_iter().map(|(_, index)| index).collect()
        })
        .collect();
    (0..count)
        .map(|index| {
            let one = index % roots.len();
            let number = |k: u64| unit(seed, 4 * index as u64 + k);
            let pick = |k: u64| roots[neighbours[one][(number(k) * neighbours[one].len() as f64) as usize]];
            let (a, b) = (number(2), number(3));
            let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
            roots[one] + (pick(0) - roots[one]) * a + (pick(1) - roots[one]) * b
        })
        .collect()
}
