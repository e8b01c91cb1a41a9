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

/// The largest turn Ωℓ of an element of a strand, rad.
pub fn largest_turn(strand: &StrandDef) -> f64 {
    strand
        .element_lengths
        .iter()
        .zip(&strand.natural)
        .map(|(length, [k0, k1, k2])| k0.hypot(*k1).hypot(*k2) * length)
        .fold(0.0, f64::max)
}

/// The strands whose elements turn by more than a quarter turn: a helix cannot bend its own axis, so that such an element moves
/// too stiffly.
pub fn coarse_strands<'a>(strands: impl Iterator<Item = &'a StrandDef>) -> Vec<Coarse> {
    strands
        .enumerate()
        .filter_map(|(index, strand)| {
            let turn = largest_turn(strand);
            let advised = (strand.element_lengths.len() as f64 * turn / FRAC_PI_2).ceil();
            (turn > FRAC_PI_2 * (1.0 + 1e-9)).then_some(Coarse { strand: index, turn, advised: advised as usize })
        })
        .collect()
}

/// Warns on standard error, in one line whatever the number of strands. `name` names a strand.
pub fn warn<'a>(strands: impl Iterator<Item = &'a StrandDef>, name: impl Fn(usize) -> String) {
    let coarse = coarse_strands(strands);
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
