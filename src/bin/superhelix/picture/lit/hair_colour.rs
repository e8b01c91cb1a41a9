//! Colours of hair.

use clap::ValueEnum;

/// A colour by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "kebab-case")]
pub enum HairColour {
    /// Black.
    Black,
    /// Dark brown.
    DarkBrown,
    /// Brown.
    Brown,
    /// Reddish brown.
    Auburn,
    /// Copper red.
    Red,
    /// Dark blond.
    DarkBlond,
    /// Blond.
    Blond,
    /// Grey.
    Grey,
}

/// How much hairs of a head differ: exponents from 1 less to 1 more of these, in darkness and in redness.
const DARKNESS: f32 = 0.22;
const REDNESS: f32 = 0.12;

impl HairColour {
    /// What is left of light that went through a hair once, linear red, green and blue.
    fn passed(self) -> [f32; 3] {
        match self {
            HairColour::Black => [0.014, 0.012, 0.011],
            HairColour::DarkBrown => [0.050, 0.028, 0.017],
            HairColour::Brown => [0.125, 0.066, 0.034],
            HairColour::Auburn => [0.165, 0.055, 0.023],
            HairColour::Red => [0.33, 0.10, 0.03],
            HairColour::DarkBlond => [0.27, 0.17, 0.087],
            HairColour::Blond => [0.50, 0.355, 0.20],
            HairColour::Grey => [0.56, 0.545, 0.53],
        }
    }

    /// The same for a hair of the head; `darker` and `redder` are numbers of the hair's from -1 to 1.
    pub fn of_thread(self, darker: f32, redder: f32) -> [f32; 3] {
        let [red, green, blue] = self.passed().map(|share| share.powf(1.0 + DARKNESS * darker));
        [red, green.powf(1.0 + REDNESS * redder), blue.powf(1.0 + REDNESS * redder)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn darker_hair_lets_less_light_through_and_all_hair_is_warm() {
        let of = |colour: HairColour| colour.of_thread(0.0, 0.0);
        let order = [HairColour::Black, HairColour::DarkBrown, HairColour::Brown, HairColour::DarkBlond, HairColour::Blond];
        for pair in order.windows(2) {
            assert!((0..3).all(|channel| of(pair[0])[channel] < of(pair[1])[channel]), "{pair:?}");
        }
        for colour in HairColour::value_variants() {
            let [red, green, blue] = of(*colour);
            assert!(red > green && green > blue && red < 1.0, "{colour:?}");
        }
    }
}
