//! Strands made of a groom: how well they fit, how they rest.

use serde::Serialize;
use superhelix::Material;
use superhelix::editing::{Shapes, coarse_strands};
use superhelix::hair::GroomStrand;

use crate::groom::statistics::Spread;

/// How well strands follow the groom's polylines.
#[derive(Debug, Serialize)]
pub struct FitReport {
    /// Root mean square distance a strand, m.
    pub rms_metres: Option<Spread>,
    /// Largest distance a strand, m.
    pub max_metres: Option<Spread>,
    /// Strands with an element that turns by more than a quarter turn: more elements are advised.
    pub strands_with_coarse_elements: usize,
}

impl FitReport {
    /// Of strands.
    pub fn of(strands: &[GroomStrand]) -> Self {
        Self {
            rms_metres: Spread::of(strands.iter().map(|strand| strand.fit_error.0).collect()),
            max_metres: Spread::of(strands.iter().map(|strand| strand.fit_error.1).collect()),
            strands_with_coarse_elements: coarse_strands(strands.iter().map(|strand| &strand.definition), Shapes::Initial).len(),
        }
    }
}

/// How strands rest in the shapes that they were drawn in.
#[derive(Debug, Serialize)]
pub struct Resting {
    /// Strands that their own stiffness lets rest as drawn.
    pub by_themselves: usize,
    /// Strands that were made stiffer to rest so more firmly.
    pub stiffened: usize,
    /// By how much, of these.
    pub factor: Option<Spread>,
    /// Strands that do not rest as drawn, and sag at a touch.
    pub limp: usize,
}

impl Resting {
    /// Of strands of the material `before` that are to rest as drawn; none where they are not.
    pub fn of(strands: &[GroomStrand], before: &Material) -> Option<Self> {
        let bending = |material: &Material| material.youngs_modulus * (material.radius[0] * material.radius[1]).powi(2);
        let (mut resting, mut factors) = (Self { by_themselves: 0, stiffened: 0, factor: None, limp: 0 }, Vec::new());
        for strand in strands {
            let factor = bending(&strand.definition.material) / bending(before);
            let stable = strand.stability?.is_stable();
            if factor > 1.0 + 1e-9 {
                factors.push(factor);
            } else if !stable {
                resting.limp += 1;
            }
            resting.by_themselves += usize::from(stable);
        }
        resting.stiffened = factors.len();
        resting.factor = Spread::of(factors);
        Some(resting)
    }

    /// For people, with how many strands there are.
    pub fn in_words(&self, strands: usize) -> String {
        let mut text = format!("rest as drawn: {} of {strands} strands by their own stiffness", self.by_themselves);
        if let Some(factor) = &self.factor {
            text += &format!(
                "; {} made stiffer to rest firmly, {:.1} times (median), {:.1} times at most",
                self.stiffened, factor.median, factor.max
            );
        }
        if self.limp > 0 {
            text += &format!("; {} are too limp and will sag (--hold, --stiffen)", self.limp);
        }
        text + "\n"
    }
}
