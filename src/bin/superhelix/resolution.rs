//! Says when helical elements are too long for the curl that they carry.

use std::f64::consts::FRAC_PI_2;

use superhelix::solver::definition::StrandDef;

/// A strand with an element that turns by more than a quarter turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coarse {
    /// Which of the strands looked at.
    pub strand: usize,
    /// The largest turn of one of its elements, rad.
    pub turn: f64,
    /// How many elements of equal length would bring it to a quarter turn.
    pub advised: usize,
}

/// The largest turn Ωℓ of an element in the shape that a strand starts with, or is drawn to, rad.
///
/// `shapes` says which: a natural shape that only makes up for gravity may be curled where no strand ever goes.
pub fn largest_turn(strand: &StrandDef, shapes: Shapes) -> f64 {
    let of = |rows: &[[f64; 3]]| {
        let turns = strand.element_lengths.iter().zip(rows).map(|(length, [k0, k1, k2])| k0.hypot(*k1).hypot(*k2) * length);
        turns.fold(0.0, f64::max)
    };
    let initial = strand.initial.as_deref().map(of);
    match shapes {
        Shapes::Initial => initial.unwrap_or_else(|| of(&strand.natural)),
        Shapes::All => of(&strand.natural).max(initial.unwrap_or(0.0)),
    }
}

/// Which shapes of a strand count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shapes {
    /// The one it starts with.
    Initial,
    /// The natural one as well.
    All,
}

/// The strands whose elements turn by more than a quarter turn: a helix cannot bend its own axis, so that such an element moves
/// too stiffly.
pub fn coarse_strands<'a>(strands: impl Iterator<Item = &'a StrandDef>, shapes: Shapes) -> Vec<Coarse> {
    strands
        .enumerate()
        .filter_map(|(index, strand)| {
            let turn = largest_turn(strand, shapes);
            let advised = (strand.element_lengths.len() as f64 * turn / FRAC_PI_2).ceil();
            (turn > FRAC_PI_2 * (1.0 + 1e-9)).then_some(Coarse { strand: index, turn, advised: advised as usize })
        })
        .collect()
}

/// Warns on standard error, in one line whatever the number of strands. `name` names a strand.
pub fn warn<'a>(strands: impl Iterator<Item = &'a StrandDef>, shapes: Shapes, name: impl Fn(usize) -> String) {
    let coarse = coarse_strands(strands, shapes);
    let Some(worst) = coarse.iter().max_by(|a, b| a.turn.total_cmp(&b.turn)) else { return };
    let others = match coarse.len() {
        1 => String::new(),
        count => format!(" (and {} other strands likewise)", count - 1),
    };
    eprintln!(
        "warning: {}: an element turns by {:.2} rad, and a helix cannot bend its own axis: \
         above pi/2 a strand moves too stiffly; {} elements would do{others}",
        name(worst.strand),
        worst.turn,
        worst.advised
    );
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
