//! Which strands are tied together: their wisps give way to each other there.

use super::{Constraint, ConstraintStatus, Hold};
use crate::contact::broad_phase::hair_pairs::Tie;
use crate::solver::id::StrandId;

/// The ties of a scene. `strand` gives the index under which a strand is looked for; ties of others are left out.
pub(in crate::solver) fn ties(
    constraints: &[Constraint],
    strand: impl Fn(StrandId) -> Option<usize>,
) -> impl Iterator<Item = Tie> {
    constraints.iter().filter_map(move |constraint| match constraint.def.hold {
        Hold::Tie { other, arclength } if constraint.state.status != ConstraintStatus::Released => Some(Tie {
            strands: [strand(constraint.def.strand)? as u32, strand(other)? as u32],
            along: [constraint.state.arclength, arclength],
        }),
        _ => None,
    })
}
