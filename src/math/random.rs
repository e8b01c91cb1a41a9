//! Stateless seeded random numbers: a number depends only on the seed, the item's index and the purpose, so neither the order of
//! work nor the number of threads can change it.

/// Mixes all bits of a number: the output function of SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014).
pub(crate) fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Numbers of one seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Seeded(u64);

impl Seeded {
    /// Numbers for one purpose: different purposes get different numbers from the same seed.
    pub fn new(seed: u64, purpose: u64) -> Self {
        Self(mixed(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)) ^ mixed(purpose.wrapping_mul(0xd134_2543_de82_ef95)))
    }

    /// 64 random bits for an index.
    pub fn bits(self, index: u64) -> u64 {
        mixed(self.0.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }

    /// Uniform in [0, 1).
    pub fn unit(self, index: u64) -> f64 {
        (self.bits(index) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Numbers from 0 to 1 in turn, for tests.
#[cfg(test)]
pub(crate) fn unit_numbers(seed: u64, purpose: u64) -> impl FnMut() -> f64 {
    let (random, mut count) = (Seeded::new(seed, purpose), 0);
    move || {
        count += 1;
        random.unit(count)
    }
}

/// Numbers from −1 to 1 in turn, for tests.
#[cfg(test)]
pub(crate) fn signed_numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut unit = unit_numbers(seed, 0);
    move || 2.0 * unit() - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_uniform_and_of_their_seed_and_purpose() {
        let count = 1 << 16;
        for (seed, purpose) in [(0, 0), (1, 0), (0, 1), (u64::MAX, 7)] {
            let numbers = Seeded::new(seed, purpose);
            let mut bins = [0_u32; 64];
            let mut product = 0.0;
            for index in 0..count {
                let value = numbers.unit(index);
                bins[(value * 64.0) as usize] += 1;
                product += (value - 0.5) * (numbers.unit(index + 1) - 0.5);
            }
            // Chi-square with 63 degrees of freedom: mean 63, deviation 11.2.
            let expected = count as f64 / 64.0;
            let chi: f64 = bins.iter().map(|bin| (f64::from(*bin) - expected).powi(2) / expected).sum();
            assert!((20.0..120.0).contains(&chi), "{chi}");
            // Correlation of neighbours: deviation (1/12)/sqrt(count).
            assert!((product / count as f64).abs() < 5.0 / 12.0 / (count as f64).sqrt(), "{product}");
        }
        assert_ne!(Seeded::new(1, 2).bits(3), Seeded::new(2, 1).bits(3));
        assert_ne!(Seeded::new(1, 2).bits(3), Seeded::new(1, 3).bits(3));
    }
}
