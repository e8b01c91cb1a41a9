//! Colours of equal weight to the eye, one a root position.

/// Red, green and blue, 0 to 1, as a screen has them (sRGB).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colour(pub [f32; 3]);

impl Colour {
    /// White.
    pub const WHITE: Colour = Colour([1.0; 3]);
    /// The paper behind the cells.
    pub const PAPER: Colour = Colour([0.075, 0.082, 0.098]);
    /// The ground of a cell.
    pub const CELL: Colour = Colour([0.105, 0.115, 0.135]);
    /// Bodies, in full light.
    pub const BODY: Colour = Colour([0.43, 0.46, 0.52]);
    /// Thin lines.
    pub const RULE: Colour = Colour([0.20, 0.22, 0.25]);
    /// Labels that matter.
    pub const LABEL: Colour = Colour([0.86, 0.88, 0.91]);
    /// Labels that matter less.
    pub const FAINT: Colour = Colour([0.52, 0.55, 0.60]);

    /// From lightness (0 to 1), chroma and hue (rad) of the Oklab space (Ottosson 2020), in which equal steps look equal.
    pub fn from_oklch(lightness: f32, chroma: f32, hue: f32) -> Self {
        let (a, b) = (chroma * hue.cos(), chroma * hue.sin());
        let cube = |value: f32| value * value * value;
        let l = cube(lightness + 0.396_337_78 * a + 0.215_803_76 * b);
        let m = cube(lightness - 0.105_561_346 * a - 0.063_854_17 * b);
        let s = cube(lightness - 0.089_484_18 * a - 1.291_485_5 * b);
        let linear = [
            4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
            -1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s,
            -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
        ];
        Self(linear.map(|value| {
            let value = value.clamp(0.0, 1.0);
            if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
        }))
    }

    /// This colour made brighter (`factor` above 1) or darker.
    pub fn lit(self, factor: f32) -> Self {
        Self(self.0.map(|value| (value * factor).clamp(0.0, 1.0)))
    }

    /// A mixture: 0 is this colour, 1 the other.
    pub fn mixed(self, other: Colour, share: f32) -> Self {
        Self([0, 1, 2].map(|axis| self.0[axis] + (other.0[axis] - self.0[axis]) * share))
    }

    /// For tiny-skia, with an opacity of 0 to 1.
    pub fn to_skia(self, opacity: f32) -> tiny_skia::Color {
        let [red, green, blue] = self.0.map(|value| value.clamp(0.0, 1.0));
        tiny_skia::Color::from_rgba(red, green, blue, opacity.clamp(0.0, 1.0)).unwrap_or(tiny_skia::Color::BLACK)
    }
}

/// A colour for each root, given as right, up, towards the viewer of the front view: hue by the direction from the middle around
/// the vertical, lightness by height.
pub fn by_root(roots: &[[f32; 3]]) -> Vec<Colour> {
    let count = roots.len().max(1) as f32;
    let middle: [f32; 3] = [0, 1, 2].map(|axis| roots.iter().map(|root| root[axis]).sum::<f32>() / count);
    let lowest = roots.iter().map(|root| root[1]).fold(f32::INFINITY, f32::min);
    let highest = roots.iter().map(|root| root[1]).fold(f32::NEG_INFINITY, f32::max);
    let rise = (highest - lowest).max(f32::MIN_POSITIVE);
    roots
        .iter()
        .map(|root| {
            let hue = (root[2] - middle[2]).atan2(root[0] - middle[0]);
            Colour::from_oklch(0.66 + 0.14 * (root[1] - lowest) / rise, 0.125, hue)
        })
        .collect()
}
