//! Strands that are drawn inside a body or through each other: how many, how deep, and what becomes of them.

use clap::ValueEnum;
use serde::Serialize;
use superhelix::editing::Overlap;
use superhelix::hair::GroomStrand;

/// What counts as inside a body, m deep: roots lie in the skin, and a grid rounds off what is finer than its cells.
pub const INSIDE: f64 = 2e-3;

/// What becomes of strands that are drawn inside the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Becomes {
    /// They are drawn again outside it, by the least that does.
    BroughtOut,
    /// They stay as drawn.
    Kept,
    /// Contact pushes them out, and strands apart, as soon as the run begins.
    Parted,
}

/// Contact parts fewer strands than this part of all with ease.
const FEW: f64 = 0.05;

/// One line on standard error before the first step where contact will part many strands that are drawn through each other: `overlaps` and `radii`
/// (m) of all. Wisps are, where another's surface reaches beyond their centreline; else they lie as close as hair is drawn.
pub fn warn_of_hair_in_hair(overlaps: &[Overlap], radii: impl Iterator<Item = f64>, name: &str, to_keep: &str) {
    let through = overlaps.iter().zip(radii).filter(|(overlap, radius)| overlap.hair > *radius);
    let (count, deepest) =
        through.fold((0, 0.0_f64), |(count, deepest), (overlap, _)| (count + 1_u32, deepest.max(overlap.hair)));
    if f64::from(count) > FEW * overlaps.len() as f64 {
        eprintln!(
            "warning: {name}: {count} of {} strands are drawn up to {:.1} mm into others; contact parts them, and where they are \
             entangled that takes long and may fail. To let them keep their shape: {to_keep}",
            overlaps.len(),
            deepest * 1e3
        );
    }
}

/// What was drawn inside the body.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct DrawnInside {
    /// What becomes of it.
    pub becomes: Becomes,
    /// Strands with points inside it, or nearer than they are wide, beyond what their roots are; where none are brought out, strands
    /// more than 2 mm inside.
    pub strands: usize,
    /// The deepest of the points, m.
    pub deepest: f64,
    /// How far a point was moved at most to be outside, m.
    pub moved: f64,
    /// Strands that begin inside: those that no way out was found for, or all where none was looked for.
    pub left: usize,
}

impl DrawnInside {
    /// Of all strands, which were to be brought out; none where nothing was inside.
    pub fn brought_out(strands: &[GroomStrand]) -> Option<Self> {
        let mut all = Self::nothing(Becomes::BroughtOut);
        for brought in strands.iter().map(|strand| &strand.brought_out).filter(|brought| brought.inside > 0) {
            all.strands += 1;
            all.deepest = all.deepest.max(brought.deepest);
            all.moved = all.moved.max(brought.moved);
            all.left += usize::from(brought.stuck);
        }
        (all.strands > 0).then_some(all)
    }

    /// Of all strands, by their overlaps as the run begins; none where nothing is inside.
    pub fn left(becomes: Becomes, overlaps: &[Overlap]) -> Option<Self> {
        let mut all = Self::nothing(becomes);
        for depth in overlaps.iter().map(|overlap| overlap.bodies).filter(|depth| *depth > INSIDE) {
            all.strands += 1;
            all.deepest = all.deepest.max(depth);
        }
        all.left = all.strands;
        (all.strands > 0).then_some(all)
    }

    fn nothing(becomes: Becomes) -> Self {
        Self { becomes, strands: 0, deepest: 0.0, moved: 0.0, left: 0 }
    }

    /// One line on standard error before the first step when strands lose their shape: how many of all, and what lets them keep it.
    pub fn warn(&self, name: &str, strands: usize, body: &str, to_keep: &str) {
        let lost = match self.becomes {
            Becomes::BroughtOut if self.moved > INSIDE => {
                let stay = match self.left {
                    0 => String::new(),
                    left => format!(" ({left} stay: no path out was found)"),
                };
                format!("they are drawn again outside it, by up to {:.1} mm{stay}. To leave them as drawn", self.moved * 1e3)
            }
            Becomes::Parted => "contact pushes them out, and they lose their shape. To let them keep it".into(),
            Becomes::BroughtOut | Becomes::Kept => return,
        };
        let (inside, deepest) = (self.strands, self.deepest * 1e3);
        eprintln!(
            "warning: {name}: {inside} of {strands} strands are drawn up to {deepest:.1} mm inside {body}; {lost}: {to_keep}"
        );
    }

    /// The report's line.
    pub fn in_words(&self) -> String {
        let became = match self.becomes {
            Becomes::BroughtOut if self.left > 0 => {
                format!("pushed out by {:.1} mm at most; {} stay: no path out was found", self.moved * 1e3, self.left)
            }
            Becomes::BroughtOut => format!("pushed out by {:.1} mm at most", self.moved * 1e3),
            Becomes::Kept => "kept".into(),
            Becomes::Parted => "parted by contact".into(),
        };
        format!("drawn inside: {} strands, {:.1} mm deep at most; {became}\n", self.strands, self.deepest * 1e3)
    }
}
