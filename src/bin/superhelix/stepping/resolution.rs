//! Says when helical elements are too long for the curl that they carry.

use superhelix::StrandDef;
pub use superhelix::editing::Shapes;
use superhelix::editing::coarse_strands;

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
