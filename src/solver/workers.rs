//! Who runs the strands of a step.

use crate::step::scratch::Scratch;

/// Workers with the scratch memory of a step.
pub(super) type Crew = crate::workers::Crew<Scratch>;
