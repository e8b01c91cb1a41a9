//! Medians and spreads.

/// The median of some values, and the distance of the quartiles relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// The median.
    pub median: f64,
    /// (third quartile − first quartile) / median.
    pub spread: f64,
    /// The least.
    pub least: f64,
}

impl Summary {
    /// Of at least one value.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
            low + (high - low) * place.fract()
        };
        let median = at(0.5);
        Self { median, spread: (at(0.75) - at(0.25)) / median.abs(), least: sorted[0] }
    }

    /// All values times a factor.
    pub fn times(self, factor: f64) -> Self {
        Self { median: self.median * factor, spread: self.spread, least: self.least * factor }
    }
}
