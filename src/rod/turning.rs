//! How far elements turn: a helix cannot bend its own axis, so a tight coil needs about four elements per turn.

use std::f64::consts::FRAC_PI_2;

use super::definition::StrandDef;

/// The largest turn Ωℓ of an element, rad, up to which a strand moves faithfully.
pub const LARGEST_TURN: f64 = FRAC_PI_2;

/// A strand with an element that turns by more than a quarter turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coarse {
    /// Which of the examined strands.
    pub strand: usize,
    /// The largest turn of one of its elements, rad.
    pub turn: f64,
    /// How many elements of equal length would bring this turn down to a quarter turn.
    pub advised: usize,
}

/// Which shapes of a strand to examine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shapes {
    /// The initial shape: a natural shape that only compensates gravity may have curls that the strand never reaches.
    Initial,
    /// The natural shape as well.
    All,
}

/// The largest turn Ωℓ of elements, rad; one row of curvatures per element.
pub fn largest_turn(lengths: &[f64], rows: &[[f64; 3]]) -> f64 {
    let turns = lengths.iter().zip(rows).map(|(length, [k0, k1, k2])| (k0 * k0 + k1 * k1 + k2 * k2).sqrt() * length);
    turns.fold(0.0, f64::max)
}

/// The largest turn Ωℓ of an element in a strand's shapes, rad.
pub fn largest_turn_of(strand: &StrandDef, shapes: Shapes) -> f64 {
    let of = |rows: &[[f64; 3]]| largest_turn(&strand.element_lengths, rows);
    let initial = strand.initial.as_deref().map(of);
    match shapes {
        Shapes::Initial => initial.unwrap_or_else(|| of(&strand.natural)),
        Shapes::All => of(&strand.natural).max(initial.unwrap_or(0.0)),
    }
}

/// The strands with elements that turn by more than a quarter turn: such an element is too stiff.
pub fn coarse_strands<'a>(strands: impl Iterator<Item = &'a StrandDef>, shapes: Shapes) -> Vec<Coarse> {
    strands
        .enumerate()
        .filter_map(|(index, strand)| {
            let turn = largest_turn_of(strand, shapes);
            let advised = (strand.element_lengths.len() as f64 * turn / LARGEST_TURN).ceil();
            (turn > LARGEST_TURN * (1.0 + 1e-9)).then_some(Coarse { strand: index, turn, advised: advised as usize })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_that_turn_too_far_are_found_and_advice_is_enough() {
        let straight = StrandDef::straight(0.2, 4);
        let mut coil = StrandDef::straight(0.2, 4);
        coil.natural = vec![[0.0, 100.0, 0.0]; 4];
        let coarse = coarse_strands([&straight, &coil].into_iter(), Shapes::All);
        assert_eq!(coarse, [Coarse { strand: 1, turn: 5.0, advised: 13 }]);
        let mut finer = StrandDef::straight(0.2, 13);
        finer.natural = vec![[0.0, 100.0, 0.0]; 13];
        assert!(coarse_strands([&finer].into_iter(), Shapes::All).is_empty());
        coil.initial = Some(vec![[0.0; 3]; 4]);
        assert!(coarse_strands([&coil].into_iter(), Shapes::Initial).is_empty());
    }
}
